"""A film law of one's own: Dowson and Higginson's smallest film of a line contact. own_laws.yaml names it.

    python own_film.py

prints the film of the base bearing's contacts. Importing this file, or naming it with --laws, registers the law.
"""

from macroslip import Bearing, Lubricant
from macroslip.contact.interface import interfaces
from macroslip.contact.registry import register_film


def groups(interface, load, speed):
    """W and U. The elliptical contact is taken as a line, w = 3Q/(4a), as the other film laws do."""
    stiffness = interface.modulus * interface.rolling_radius
    across = interface.hertz.semi_axis_across * load ** (1 / 3)
    return 0.75 * load / across / stiffness, interface.lubricant.viscosity * speed / stiffness


def thickness(interface, load, speed):
    """h [m] at loads [N] and entrainment speeds [m/s]: H = 2.65 U^0.7 G^0.54 W^-0.13 with H = h/R, G = alpha_p E'."""
    w, u = groups(interface, load, speed)
    material = interface.lubricant.pressure_viscosity * interface.modulus
    return interface.rolling_radius * 2.65 * u**0.7 * material**0.54 * w**-0.13


def in_range(interface, load, speed):
    """Whether W is between 3e-5 and 3e-4, where the formula was fitted (from memory of the literature)."""
    w, _ = groups(interface, load, speed)
    return (w >= 3e-5) & (w <= 3e-4)


register_film(
    "dowson-higginson",
    thickness,
    reference="Dowson, Proc. Inst. Mech. Engrs. 182 (1967) 151",
    in_range=in_range,
)

if __name__ == "__main__":
    for interface in interfaces(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")):
        print(
            f"{interface.name:5}: h = {1e6 * thickness(interface, 20e3, 0.4):.3f} um at 20 kN and 0.4 m/s"
        )
