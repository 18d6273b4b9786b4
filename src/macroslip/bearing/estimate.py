"""The inside of a spherical roller bearing from what its maker publishes.

A catalogue page gives the boundary dimensions, the load ratings and the axial factors, and not one
dimension of the rollers. Dimensions that the page leaves open are sampled here within accepted
ranges; every sample is a bearing that can exist and has the static load rating of the page. The
result is an estimate with its scatter, **not the maker's drawing**.

* Contact angle: e = 1.5 tan(alpha) (ISO 281), e as printed, with two decimals.
* Outer raceway: a sphere that meets the face of the outer ring at the shoulder diameter, R^2 =
  (D1/2)^2 + (B/2)^2.
* Roller length: from the static load rating, C0 = 44 (1 - Dw cos(alpha)/Dpw) i Z L Dw cos(alpha)
  (ISO 76), on which makers
  agree within 15 % for one size; not from the dynamic rating, in which they differ by up to 37 %.
* Roller diameter: the room that sphere and inner ring leave between them.
* Number of rollers: from their spacing; or from the overrolling frequencies, BPFO + BPFI = Z per
  turn of the shaft,
  which give the roller diameter too: (BPFI - BPFO)/Z = Dw cos(alpha)/Dpw.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from macroslip.arrays import FloatArray
from macroslip.bearing.bearing import Bearing
from macroslip.bearing.load_ratings import dynamic_load_rating, fatigue_load_limit
from macroslip.bearing.sampled import (
    E_ROUNDING,
    SAMPLES,
    Accepted,
    Estimated,
    Rollers,
    check_bore,
    check_positive,
    entry,
    fitting,
    short_number,
    stated,
    within,
)
from macroslip.errors import InputError

STATIC_RATING = Accepted(0.93, 1.07)
"""Static load rating of the formula over the page's: makers differ by up to 15 % for one size."""
SPACING = Accepted(1.06, 1.22)
"""Distance of neighbouring roller centres over roller diameter: the cage needs the rest."""
INNER_WALL = Accepted(0.18, 0.27)
"""Thinnest place of the inner ring under the rollers over (outside - bore)/2."""
OUTER_WALL = Accepted(0.14, 0.20)
"""Thinnest place of the outer ring over (outside - bore)/2, where the shoulder is not published: 90
% of a maker's bearings of 500 mm bore and more.
"""
CHAMFER = Accepted(0.0, 0.03)
"""Axial distance from the ring's face to the edge of the outer raceway over width."""
END_CLEARANCE = Accepted(0.0, 0.08)
"""Axial distance from the roller's end to the ring's face over width."""
SLENDERNESS = Accepted(0.9, 2.2)
"""Roller length over diameter."""
OSCULATION = Accepted(0.97, 0.99)
CLEARANCE = Accepted(0.5 / 3000, 1.5 / 3000)
"""Diametral operating clearance over bore: 0.2 mm at 600 mm, of 0.31 to 0.48 mm before mounting."""
FREQUENCY_ROUNDING = 0.005
"""Half of the last digit of overrolling frequencies per turn."""

ROWS = 2
_NOTE = "estimate: median of what fits the maker's page, not the maker's drawing"
_ON_SPHERE = "from sphere, roller diameter and contact angle"
_OSCULATION = ("1", 3, "E", "usual for spherical roller bearings")
#: Unit, decimals, tag and note of the sampled dimensions.
_WRITTEN = {
    "rollers_per_row": ("1", 0, "E", _NOTE),
    "roller_diameter": ("mm", 1, "E", _NOTE),
    "roller_length": ("mm", 1, "E", f"from the static load rating, ISO 76; {_NOTE}"),
    "contact_angle": ("deg", 2, "D", "from e = 1.5 tan(contact angle), ISO 281"),
    "outer_raceway_radius": ("mm", 1, "E", _NOTE),
    "diametral_clearance": ("mm", 3, "E", "operating; in proportion to the bore"),
}
#: Steel, cage and surfaces are taken from this bearing.
_STEEL_OF = "skf-240-600-bc"
_STEEL = (
    "youngs_modulus", "poisson_ratio", "density", "cage_youngs_modulus", "cage_poisson_ratio", "composite_roughness",
    "hardness", "thermal_conductivity", "specific_heat",
)  # fmt: skip


@dataclass(frozen=True)
class MakersPage:
    """Numbers that a maker publishes of a bearing, SI units.

    Raises InputError if the values contradict each other. `Bearing` has their ranges.
    """

    #: Boundary dimensions d, D, B [m].
    bore: float
    outside: float
    width: float
    static_load_rating: float  #: C0 [N]
    axial_factor_e: float  #: e [-]
    shoulder: float | None = None  #: Diameter of the outer ring's shoulder D1 [m]
    groove: float | None = (
        None  #: Width of the lubrication groove in the outer ring [m]; the raceways begin beside it
    )
    #: C and C_u or P_u [N]; without them the values of ISO 281 are used.
    dynamic_load_rating: float | None = None
    fatigue_load_limit: float | None = None
    #: [-]; without them 0.45, 0.67 and 0.44 cot(alpha).
    axial_factor_y1: float | None = None
    axial_factor_y2: float | None = None
    axial_factor_y0: float | None = None
    mass: float | None = None  #: [kg]
    #: Overrolling frequencies of outer and inner ring per turn of the shaft [-]; both or none.
    bpfo: float | None = None
    bpfi: float | None = None

    def __post_init__(self) -> None:
        check_positive(self)
        check_bore(self.bore, self.outside)
        if self.shoulder is not None and not self.bore < self.shoulder < self.outside:
            allowed = (
                f"between bore and outside diameter, {1e3 * self.bore:g} mm and "
                f"{1e3 * self.outside:g} mm"
            )
            remedy = "It is the diameter at the outer ring's faces, D1 in catalogues."
            raise InputError(
                f"shoulder is {1e3 * self.shoulder:g} mm", allowed=allowed, remedy=remedy
            )
        if self.groove is not None and not self.groove < self.width:
            raise InputError(
                f"groove is {1e3 * self.groove:g} mm",
                allowed=f"below the width, {1e3 * self.width:g} mm",
            )
        if (self.bpfo is None) != (self.bpfi is None):
            check = "only one overrolling frequency is given"
            raise InputError(check, allowed="both bpfo and bpfi, or none", remedy="Add the other.")
        if self.bpfo is None or self.bpfi is None:
            return
        count = self.bpfo + self.bpfi
        nearest = round(count)
        is_whole = abs(count - nearest) <= 0.05
        if not is_whole or nearest < 3 or not self.bpfo < self.bpfi:
            raise InputError(
                f"bpfo is {self.bpfo:g} and bpfi {self.bpfi:g} per turn of the shaft, together "
                f"{count:g}",
                allowed="a sum that is the whole number of rollers in a row, within 0.05, and bpfo "
                "below bpfi",
                remedy="Divide frequencies in hertz by the shaft's speed in turns per second.",
            )


def estimate_bearing(
    page: MakersPage, name: str, title: str = "", *, seed: int = 1
) -> Estimated[Bearing]:
    """Estimate the inside of a bearing from its maker's page.

    The samples are independent and uniform within the accepted ranges of this module, rejected
    where the parts do not fit. Length, spacing, sphere and angle of the median bearing agree with
    each other, as in every sample.

    Parameters
    ----------
    page : MakersPage
        Boundary dimensions, ratings and factors of the catalogue.
    name : str
        Short name of the bearing.
    title : str
        Title of the bearing.
    seed : int
        Of the random numbers; the same page and seed give the same bearing.

    Returns
    -------
    Estimated
        The bearing of the medians, and the samples in SI units.

    Raises
    ------
    InputError
        If no bearing within the accepted proportions fits the page.

    References
    ----------
    ISO 76:2006; ISO 281:2007; Harris and Kotzalas, Essential Concepts of Bearing Technology (2006),
    for the overrolling frequencies.

    Examples
    --------
    >>> page = MakersPage(0.63, 0.92, 0.29, 17600e3, 0.30, shoulder=0.828, groove=0.0565)
    >>> bearing, samples = estimate_bearing(page, "my-240-630")
    >>> diameter, length = 1e3 * bearing.roller_diameter, 1e3 * bearing.roller_length
    >>> bearing.rollers_per_row, round(diameter, 1), round(length, 1)
    (29, 75.4, 104.0)
    """
    tried = _draw(page, np.random.default_rng(seed))
    drawn = _fitting(page, tried)
    bearing = _record(page, drawn, name, title)
    return Estimated(bearing, drawn)


def _draw(page: MakersPage, rng: np.random.Generator) -> dict[str, FloatArray]:
    """Sample the dimensions that the page leaves open.

    Diameter, number and length of the rollers follow from them.
    """
    height = 0.5 * (page.outside - page.bore)
    rounding = E_ROUNDING * rng.uniform(-1.0, 1.0, SAMPLES)
    e = page.axial_factor_e + rounding
    alpha = np.arctan(e / 1.5)
    edge = page.width * (0.5 - CHAMFER.drawn(rng))
    wall = OUTER_WALL.drawn(rng)
    sphere = (
        0.5 * page.outside - wall * height
        if page.shoulder is None
        else np.hypot(0.5 * page.shoulder, edge)
    )
    drawn = {
        "contact_angle": alpha,
        "outer_raceway_radius": sphere,
        "osculation": OSCULATION.drawn(rng),
        "diametral_clearance": page.bore * CLEARANCE.drawn(rng),
    }
    inside = 0.5 * page.bore + height * INNER_WALL.drawn(rng)
    rating = page.static_load_rating * STATIC_RATING.drawn(rng)
    spacing = SPACING.drawn(rng)
    cosine = np.cos(alpha)
    diameter = np.full(SAMPLES, 0.5 * height)
    count = np.zeros(SAMPLES)
    gamma = None
    if page.bpfo is not None and page.bpfi is not None:
        both = round(page.bpfo + page.bpfi)
        count = np.full(SAMPLES, float(both))
        frequency_rounding = FREQUENCY_ROUNDING * rng.uniform(-2.0, 2.0, SAMPLES)
        gamma = (page.bpfi - page.bpfo + frequency_rounding) / count
        diameter = 2.0 * gamma * sphere / (1.0 + gamma)
    # The room for the inner ring depends little on the roller length, and the length little on the
    # diameter.
    for _ in range(30):
        centre = sphere - 0.5 * diameter
        if gamma is None:
            pitch = 2.0 * centre * cosine
            half_pitch = np.minimum(spacing * diameter / pitch, 1.0)
            count = np.pi / np.arcsin(half_pitch)
        length = _length(rating, count, diameter, alpha, centre * cosine)
        if gamma is None:
            drop = _drop(drawn["osculation"] * sphere, length)
            inner_height = inside + 0.5 * length * np.sin(alpha)
            diameter = sphere + drop - inner_height / cosine
            diameter = np.clip(diameter, 0.05 * height, height)
    count = np.round(count)
    centre = sphere - 0.5 * diameter
    length = _length(rating, count, diameter, alpha, centre * cosine)
    return drawn | {
        "rollers_per_row": count,
        "roller_diameter": diameter,
        "roller_length": length,
        "pitch_radius": centre * cosine,
        "row_offset": centre * np.sin(alpha),
    }


def _length(rating, count, diameter, alpha, pitch_radius):
    """Roller length [m] of a static load rating [N], ISO 76 solved for L."""
    projected = diameter * np.cos(alpha)
    gamma = projected / (2.0 * pitch_radius)
    return rating / (44e6 * (1.0 - gamma) * ROWS * count * projected)


def _drop(contour, length):
    """How much smaller than in its middle a barrel's radius is at its ends [m]."""
    square = contour**2 - 0.25 * length**2
    return contour - np.sqrt(np.maximum(square, 0.0))


def _fitting(page: MakersPage, drawn: dict[str, FloatArray]) -> dict[str, FloatArray]:
    sine = np.sin(drawn["contact_angle"])
    cosine = np.cos(drawn["contact_angle"])
    diameter = drawn["roller_diameter"]
    length = drawn["roller_length"]
    contour = drawn["osculation"] * drawn["outer_raceway_radius"]
    end = 0.5 * diameter - _drop(contour, length)
    along = 0.5 * length * cosine
    across = end * sine
    half_pitch = np.pi / drawn["rollers_per_row"]
    chord = 2.0 * drawn["pitch_radius"] * np.sin(half_pitch)
    spacing = chord / diameter
    farthest = drawn["row_offset"] + along + across
    clearance = 0.5 - farthest / page.width
    inside = drawn["pitch_radius"] - 0.5 * length * sine - end * cosine
    wall = (inside - 0.5 * page.bore) / (page.outside - page.bore)
    passed = {
        "a sphere inside the outer ring": drawn["outer_raceway_radius"] < 0.49 * page.outside,
        "roller length over diameter": within(length / diameter, SLENDERNESS),
        # Rounding the number of rollers shifts their spacing by up to half a roller.
        "spacing of the rollers": within(
            spacing, SPACING, 0.5 / drawn["rollers_per_row"].clip(3.0)
        ),
        "inner ring under the rollers": within(2.0 * wall, INNER_WALL, 0.005),
        "clearance between roller ends and faces": within(clearance, END_CLEARANCE),
        "rows apart": drawn["row_offset"] - along - across > 0.0,
        "raceways beside the groove": drawn["row_offset"] - along + across
        > 0.5 * (page.groove or 0.0),
    }
    if page.bpfo is not None:
        # Number and diameter are known; then they decide on spacing and ring.
        passed["spacing of the rollers"] = spacing > 1.0
        passed["inner ring under the rollers"] = wall > 0.0
    values_checked = (
        "the overrolling frequencies" if page.bpfo is not None else "shoulder and groove"
    )
    return fitting(
        drawn,
        passed,
        allowed="the published values of one double-row spherical roller bearing",
        remedy="Check the values and their units, static load rating and e above all; try "
        f"without {values_checked}.",
    )


def _record(page: MakersPage, drawn: Mapping[str, NDArray], name: str, title: str) -> Bearing:
    """The bearing of the medians.

    Centres of the rollers lie on the sphere of the medians, as in every sample.
    """
    entries = {
        key: entry(np.median(drawn[key]), drawn[key], *how)
        for key, how in _WRITTEN.items()
        if key in drawn
    }
    for side in ("inner", "outer"):
        entries[f"osculation_{side}"] = entry(
            np.median(drawn["osculation"]), drawn["osculation"], *_OSCULATION
        )
    alpha = math.radians(entries["contact_angle"]["value"])
    sphere = entries["outer_raceway_radius"]["value"]
    roller_radius = 0.5 * entries["roller_diameter"]["value"]
    centre = 1e-3 * (sphere - roller_radius)
    pitch_radius = centre * math.cos(alpha)
    row_offset = centre * math.sin(alpha)
    on_sphere = ("mm", 1, "E", _ON_SPHERE)
    entries["pitch_radius"] = entry(pitch_radius, drawn["pitch_radius"], *on_sphere)
    entries["row_offset"] = entry(row_offset, drawn["row_offset"], *on_sphere)
    entries |= _published(page) | _ratings(page, entries)
    known = Bearing.read(_STEEL_OF).as_dict()
    same = {key: known[key] for key in _STEEL}
    return Bearing.from_dict({"name": name, "title": title} | entries | same)


def _published(page: MakersPage) -> dict[str, dict]:
    published = {
        "bore_diameter": (page.bore, "mm", "d"),
        "outside_diameter": (page.outside, "mm", "D"),
        "width": (page.width, "mm", "B"),
        "dynamic_load_rating": (page.dynamic_load_rating, "kN", "C"),
        "static_load_rating": (page.static_load_rating, "kN", "C0"),
        "fatigue_load_limit": (page.fatigue_load_limit, "kN", "C_u or P_u"),
        "axial_factor_e": (page.axial_factor_e, "1", "e"),
        "axial_factor_y1": (page.axial_factor_y1, "1", "Y1"),
        "axial_factor_y2": (page.axial_factor_y2, "1", "Y2"),
        "axial_factor_y0": (page.axial_factor_y0, "1", "Y0"),
        "mass": (page.mass, "kg", "mass"),
    }
    scales = {"mm": 1e3, "kN": 1e-3}
    return {
        key: stated(
            short_number(value * scales.get(unit, 1.0)), unit, "V", f"maker's page, {symbol}"
        )
        for key, (value, unit, symbol) in published.items()
        if value is not None
    }


def _ratings(page: MakersPage, entries: Mapping[str, dict]) -> dict[str, dict]:
    """Entries of ratings and factors that the page leaves out.

    They follow by the standards from the median geometry.
    """
    rollers = Rollers.of(entries, "contact_angle")
    ratings = {}
    if page.dynamic_load_rating is None:
        rating = dynamic_load_rating(ROWS, *rollers)
        note = "ISO 281 from the estimated inside; makers publish up to a third more"
        ratings["dynamic_load_rating"] = stated(round(rating / 1e3), "kN", "D", note)
    if page.fatigue_load_limit is None:
        limit = fatigue_load_limit(page.static_load_rating, rollers.pitch)
        ratings["fatigue_load_limit"] = stated(round(limit / 1e3), "kN", "D", "ISO 281")
    for name, factor in (("y1", 0.45), ("y2", 0.67), ("y0", 0.44)):
        if getattr(page, f"axial_factor_{name}") is None:
            value = round(factor / math.tan(rollers.contact_angle), 2)
            note = f"{factor} cot(contact angle)"
            ratings[f"axial_factor_{name}"] = stated(value, "1", "D", note)
    return ratings
