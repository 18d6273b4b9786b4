"""A traction law of one's own: the Barus film without shear heating. 05_use_own_law.py simulates with it.

    python own_law.py

compares the law's derivatives with differences, which every new law should survive. Importing this file registers the
law. Keep a law in a file that is imported, not in the script that runs it: only then do compiled kernels stay on disk.
"""

import math
from typing import NamedTuple

from macroslip import Bearing, Lubricant
from macroslip.compiled import jit
from macroslip.roller.model import interfaces
from macroslip.traction import traction_law as traction_law


class IsothermalBarus(NamedTuple):
    """The law's numbers for one interface; a load Q [N] turns them into values by powers of Q."""

    conductance: float  # 2 pi a b eta0 per Q^(2/3) [N^(1/3) s]
    pressure_exponent: float  # P = alpha_p p0 per Q^(1/3) [N^(-1/3)]


def prepare(interface):
    """The numbers for an interface: plain Python, called once for each."""
    hertz, lubricant = interface.hertz, interface.lubricant
    return IsothermalBarus(
        conductance=2.0 * math.pi * hertz.semi_axis_across * hertz.semi_axis_along * lubricant.viscosity,
        pressure_exponent=lubricant.pressure_viscosity * hertz.pressure,
    )


@jit
def patch(p):
    """Integral of s exp(P s) over 0 <= s <= 1, and its derivative; a series where the closed form cancels."""
    if p < 0.01:
        return 0.5 + p * (1 / 3 + p * (1 / 8 + p / 30)), 1 / 3 + p * (1 / 4 + p / 10)
    growth = math.exp(p)
    return (growth * (p - 1.0) + 1.0) / p**2, (growth * (p * p - 2.0 * p + 2.0) - 2.0) / p**3


@jit
def traction(law, load, film_thickness, slip):
    """F [N], dF/dslip [N s/m], dF/dh [N/m] and dF/dQ [-]; F has the sign of the slip."""
    root = load ** (1.0 / 3.0)
    exponent = law.pressure_exponent * root
    value, by_exponent = patch(exponent)
    slope = law.conductance * root * root / film_thickness * value
    force = slope * slip
    by_load = force / load * (2.0 / 3.0 + by_exponent / value * exponent / 3.0)
    return force, slope, -force / film_thickness, by_load


@jit
def rising_slip(law, load, film_thickness):
    """Slip up to which traction surely rises with slip: without heating, any."""
    return math.inf


traction_law.register(
    "isothermal-barus",
    IsothermalBarus,
    reference="Barus, American Journal of Science 45 (1893) 87",
    prepare=prepare,
    traction=traction,
    rising_slip=rising_slip,
)

if __name__ == "__main__":
    for interface in interfaces(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")):
        law, point = prepare(interface), (2000.0, 1e-6, 1e-4)  # load [N], film thickness [m], slip [m/s]
        force, by_slip, by_film, by_load = traction(law, *point)
        worst = 0.0
        for position, derivative in ((0, by_load), (1, by_film), (2, by_slip)):
            change = 1e-6 * point[position]
            up, down = (
                [*point[:position], point[position] + sign * change, *point[position + 1 :]] for sign in (1, -1)
            )
            difference = (traction(law, *up)[0] - traction(law, *down)[0]) / (2.0 * change)
            worst = max(worst, abs(derivative / difference - 1.0))
        print(f"{interface.name:5}: F = {force:.5g} N, derivatives agree with differences to {worst:.0e}")
