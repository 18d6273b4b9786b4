"""A film law of one's own: Dowson and Higginson's smallest film of a line contact. own_laws.yaml names it.

    python own_film.py

compares the law's derivatives with differences, which every new law should survive. Importing this file, or naming it
with --laws, registers the law.
"""

from typing import NamedTuple

from macroslip import Bearing, Lubricant
from macroslip.compiled import jit
from macroslip.film import film_law as film_law
from macroslip.roller.model import interfaces


class DowsonHigginson(NamedTuple):
    """The law's numbers for one interface."""

    scale: float  # h at 1 N and 1 m/s [m]
    load_group: float  # W per Q^(2/3) [N^(-2/3)]


def prepare(interface):
    """The numbers for an interface: plain Python, called once for each.

    H = 2.65 U^0.7 G^0.54 W^-0.13 with H = h/R, U = eta0 u_e/(E' R), G = alpha_p E', W = w/(E' R). The elliptical
    contact is taken as a line, w = 3Q/(4a), as the other film laws do.
    """
    radius, modulus, oil = interface.rolling_radius, interface.modulus, interface.lubricant
    load_group = 0.75 / interface.hertz.semi_axis_across / (modulus * radius)
    speed_group = oil.viscosity / (modulus * radius)
    material = oil.pressure_viscosity * modulus
    return DowsonHigginson(2.65 * radius * speed_group**0.7 * material**0.54 * load_group**-0.13, load_group)


@jit
def thickness(law, load, entrainment_speed):
    """h [m], dh/du_e [s] and dh/dQ [m/N]; W goes with Q^(2/3), since a goes with Q^(1/3)."""
    height = law.scale * entrainment_speed**0.7 * load ** (-0.13 * 2.0 / 3.0)
    return height, 0.7 * height / entrainment_speed, -0.13 * 2.0 / 3.0 * height / load


@jit
def in_range(law, load, entrainment_speed):
    """Whether W is between 3e-5 and 3e-4, where the formula was fitted (from memory of the literature)."""
    return 3e-5 <= law.load_group * load ** (2.0 / 3.0) <= 3e-4


film_law.register(
    "dowson-higginson",
    DowsonHigginson,
    reference="Dowson, Proc. Inst. Mech. Engrs. 182 (1967) 151",
    prepare=prepare,
    thickness=thickness,
    in_range=in_range,
)

if __name__ == "__main__":
    for interface in interfaces(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")):
        law, point = prepare(interface), (20e3, 0.4)  # load [N], entrainment speed [m/s]
        height, by_speed, by_load = thickness(law, *point)
        worst = 0.0
        for position, derivative in ((0, by_load), (1, by_speed)):
            change = 1e-6 * point[position]
            up, down = (
                [*point[:position], point[position] + sign * change, *point[position + 1 :]] for sign in (1, -1)
            )
            difference = (thickness(law, *up)[0] - thickness(law, *down)[0]) / (2.0 * change)
            worst = max(worst, abs(derivative / difference - 1.0))
        print(f"{interface.name:5}: h = {1e6 * height:.3f} um, derivatives agree with differences to {worst:.0e}")
