"""A traction law of one's own: the Barus film without shear heating. 18_own_law.py simulates with it.

    python own_law.py

prints the force in the base bearing's contacts. Importing this file, or naming it with --laws, registers the law.
"""

import math

import numpy as np

from macroslip import Bearing, Lubricant
from macroslip.contact.interface import interfaces
from macroslip.contact.registry import register_traction


def traction(interface, load, film_thickness, slip):
    """F [N] at loads [N], films [m] and slips above zero [m/s]: 2 pi a b eta0 slip/h times the integral below."""
    hertz, oil = interface.hertz, interface.lubricant
    root = load ** (1 / 3)
    area = 2 * math.pi * hertz.semi_axis_across * hertz.semi_axis_along * root**2
    return (
        area
        * oil.viscosity
        * slip
        / film_thickness
        * patch(oil.pressure_viscosity * hertz.pressure * root)
    )


def patch(p):
    """Integral of s exp(P s) over 0 <= s <= 1; a series where the closed form cancels."""
    series = 0.5 + p * (1 / 3 + p * (1 / 8 + p / 30))
    large = np.maximum(p, 0.01)
    return np.where(p < 0.01, series, (np.exp(large) * (large - 1) + 1) / large**2)


register_traction(
    "isothermal-barus", traction, reference="Barus, American Journal of Science 45 (1893) 87"
)

if __name__ == "__main__":
    for interface in interfaces(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")):
        print(
            f"{interface.name:5}: F = {traction(interface, 2e3, 1e-6, 1e-4):.4g} N at 2 kN, 1 um and 0.1 mm/s"
        )
