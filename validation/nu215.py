"""Five signs of slip in an oil-lubricated cylindrical roller bearing NU 215, right or wrong.

Dawoud, Beitler and Schwarze (2022 and 2023, by their abstracts) measured the slip of cage and rollers of that bearing: the
set slips up to loads above the maker's minimum; more oil flow and more speed raise slip; a cage that rollers guide slips
least; a bearing without clearance does not slip, and a cage of brass slips more than one of polyamide at medium clearance and
less at large clearance. Their loads, speeds, oil, clearances and cages are not in the abstracts. Here all of these are
assumed, and signs alone are compared: no number is claimed. Rollers have the logarithmic profile of such bearings, and
beside it a crown.

python -m validation.nu215
"""

from __future__ import annotations

import math
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from macroslip import Bearing, BearingLoads, Cage, Case, Lubricant, Window, simulate
from macroslip.rating.iso import minimum_load_of_rollers
from macroslip.rating.kinds import ratings_of

BEARING = Bearing.read(Path(__file__).with_name("data") / "nu215.yaml")
#: The bearing by the contour of its rollers; a crown of 10 m has a drop of 3.2 µm at the ends.
CONTOURS = {
    "logarithmic": BEARING,
    "crowned": BEARING.replace(roller_profile=None, roller_crown_radius=10.0),
}
#: A mineral oil of VG 320 at 80 °C is as viscous as one of VG 46 at 40 °C.
OIL = Lubricant.read("vg320-mineral").at("80 degC")
#: Slip [-] from which on a set slips.
SLIPS = 0.05
LOADS = (500.0, 1000.0, 2000.0, 4000.0)
#: Load of the comparisons [N], below the maker's minimum.
LIGHT = 500.0
SPEEDS = (1000.0, 1500.0, 3000.0)
#: Diametral clearances [m]: interference, medium, large.
TIGHT, MEDIUM, LARGE = -10e-6, 40e-6, 100e-6
#: Lands of a cage that a ring guides [m], by the ring.
LANDS = {"inner-ring": 0.0905, "outer-ring": 0.1165}
#: Masses [kg] and moduli [Pa] of cages.
CAGES = {"brass": (0.35, 105e9), "polyamide": (0.06, 4e9)}


class Sign(NamedTuple):
    """A measured sign, and what the program has."""

    measured: str
    computed: str
    verdict: str  #: `right`, `wrong`, or what it depends on


@lru_cache
def slip(
    load: float = LIGHT,
    rpm: float = 1500.0,
    supply: str | float = "flooded",
    guided_by: str = "rollers",
    clearance: float = MEDIUM,
    cage: str = "brass",
    contour: str = "logarithmic",
) -> float:
    """Slip of the cage, 1 − speed over that of pure rolling [-], under a constant radial load [N]."""
    mass, modulus = CAGES[cage]
    lands = {}
    if guided_by != "rollers":
        lands = {
            "land_diameter": LANDS[guided_by],
            "land_width": 6e-3,
            "land_clearance": 4e-4,
        }
    speed = rpm * math.pi / 30.0
    bearing = CONTOURS[contour].replace(diametral_clearance=clearance, cage_youngs_modulus=modulus)
    result = simulate(
        Case(
            bearing=bearing,
            lubricant=OIL,
            loads=BearingLoads.constant([0.0, -load, 0.0], speed, 0.8),
            oil_supply=supply,
            dynamics="whole-bearing",
            cage=Cage(gap=2e-4, mass=mass, guided_by=guided_by, **lands),
            window=Window(start=0.5),
            contact_details=False,
            rating=False,
        )
    )
    if result.status.any():
        raise RuntimeError(f"{load} N, {rpm} rpm: status {int(result.status.max())}")
    return -float(result.cage_slip[0])


def _text(values: dict[str, float]) -> str:
    return ", ".join(f"{name} {100.0 * value:.0f} %" for name, value in values.items())


def _verdict(right: bool) -> str:
    return "right" if right else "wrong"


def gripping_load(rpm: float, contour: str) -> float:
    """Load [N] at which slip falls to `SLIPS`, between two of `LOADS` in their logarithms."""
    slips = np.array([slip(load, rpm, contour=contour) for load in LOADS])
    return float(np.exp(np.interp(-math.log(SLIPS), -np.log(slips), np.log(LOADS))))


def ends_above_the_minimum(contour: str) -> Sign:
    """The load at which the set ceases to slip, beside the least load that makers require."""
    least = minimum_load_of_rollers(ratings_of(BEARING).dynamic)
    ends = {rpm: gripping_load(rpm, contour) for rpm in (SPEEDS[1], SPEEDS[2])}
    above = [end > least for end in ends.values()]
    verdict = _verdict(all(above)) if all(above) or not any(above) else "depends on the speed"
    text = ", ".join(f"to {end / 1e3:.1f} kN at {rpm:g} r/min" for rpm, end in ends.items())
    return Sign(
        "the set slips up to loads above the maker's minimum",
        f"by more than 5 % {text}; minimum {least / 1e3:.1f} kN",
        verdict,
    )


def rises_with_oil(contour: str) -> Sign:
    """Slip over how full inlets are."""
    values = {
        str(supply): slip(supply=supply, contour=contour) for supply in (0.5, "skf", "flooded")
    }
    first, second, third = values.values()
    right = first <= second <= third and first < third
    return Sign("more oil raises slip", _text(values), _verdict(right))


def rises_with_speed(contour: str) -> Sign:
    """Slip over the shaft's speed."""
    values = {f"{rpm:g} r/min": slip(rpm=rpm, contour=contour) for rpm in SPEEDS}
    first, second, third = values.values()
    return Sign("more speed raises slip", _text(values), _verdict(first < second < third))


def least_where_rollers_guide(contour: str) -> Sign:
    """Slip by what guides the cage."""
    guides = ("rollers", "inner-ring", "outer-ring")
    values = {guide: slip(guided_by=guide, contour=contour) for guide in guides}
    right = values["rollers"] == min(values.values())
    return Sign("a cage that rollers guide slips least", _text(values), _verdict(right))


def changes_with_clearance(contour: str) -> Sign:
    """Slip of both cages over the clearance."""
    values = {
        f"{cage}, {1e6 * clearance:g} µm": slip(clearance=clearance, cage=cage, contour=contour)
        for clearance in (TIGHT, MEDIUM, LARGE)
        for cage in CAGES
    }
    tight, other_tight, brass, polyamide, wide_brass, wide_polyamide = values.values()
    is_tight_right = max(tight, other_tight) < SLIPS
    # Slip is good to a point.
    is_cage_right = brass > polyamide + 0.01 and wide_brass < wide_polyamide - 0.01
    verdict = f"clearance {_verdict(is_tight_right)}, cages {_verdict(is_cage_right)}"
    return Sign(
        "no slip without clearance; brass more than polyamide at medium, less at large clearance",
        _text(values),
        verdict,
    )


SIGNS = (
    ends_above_the_minimum,
    rises_with_oil,
    rises_with_speed,
    least_where_rollers_guide,
    changes_with_clearance,
)


def main() -> None:
    """Print the five rows of both contours."""
    print("| measured | rollers | slip of the cage here | sign |\n|---|---|---|---|")
    for sign in SIGNS:
        for contour in CONTOURS:
            shown = sign(contour)
            row = (shown.measured, contour, shown.computed, shown.verdict)
            print(f"| {' | '.join(row)} |", flush=True)


if __name__ == "__main__":
    main()
