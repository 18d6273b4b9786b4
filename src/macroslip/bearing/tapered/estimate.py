"""The inside of a tapered roller bearing from what its maker publishes.

A catalogue page gives boundary dimensions, load ratings and axial factors, sometimes the place of
the load centre, and of the inside nothing. What the page leaves open is sampled here within accepted
proportions, as for spherical roller bearings, and the result is an estimate with its scatter, **not
the maker's drawing**.

* Angle of the outer raceway: e = 1.5 tan(α_o), or Y = 0.4 cot(α_o) of a single row and Y1 = 0.45
  cot(α_o) of a double row (ISO 281), as printed, with two decimals.
* Pitch diameter: near the mean of bore and outside diameter; without these from the fatigue load
  limit, C_u = C0/8.2 (100 mm/Dpw)^0.3 (ISO 281).
* Rollers: from the static load rating C0 = 44 (1 - Dw cos(α_o)/Dpw) i Z L Dw cos(α_o) (ISO 76), their
  spacing and slenderness. The dynamic rating is no check: makers publish up to 40 % more than ISO 281.
* Half-angle of the rollers and inner raceway: from the common apex, tan(β) = Dw/Dpw sin(α_o - β).
* Distance of the rows: from the load centres, A/(cos(β) cos(α_o)) - A cos(α) behind the rollers'
  middles, where the page has them; else from the width.

Height and sphere of the rib contact and the preload are on no maker's page: they are usual values.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from macroslip.arrays import FloatArray
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
from macroslip.bearing.tapered.bearing import ARRANGEMENTS, TaperedBearing
from macroslip.bearing.tapered.geometry import half_cone_angle
from macroslip.errors import InputError

STATIC_RATING = Accepted(0.84, 1.04)
"""Static load rating of the formula over the page's: 0.85 for a bearing 32216."""
SPACING = Accepted(1.10, 1.26)
"""Distance of neighbouring rollers' middles over their diameter: 1.25 for a bearing 32216."""
SLENDERNESS = Accepted(1.2, 1.9)
"""Roller length over diameter."""
PITCH = Accepted(0.97, 1.01)
"""Pitch diameter over the mean of bore and outside diameter."""
PITCH_OF_LIMIT = Accepted(0.88, 1.03)
"""Pitch diameter over that of the fatigue load limit by ISO 281, which tends to be too large:
0.83 and 0.92 of two spherical roller bearings."""
INNER_WALL = Accepted(0.14, 0.26)
"""Thickness of the inner ring at the rollers' middles over (outside - bore)/2: 0.20 of a 32216."""
OUTER_WALL = Accepted(0.17, 0.31)
"""Thickness of the outer ring there over (outside - bore)/2: 0.25 of a 32216."""
RIB = Accepted(0.05, 0.16)
"""Axial room between the rollers' large ends and the face over the width of a row."""
GAP = Accepted(0.15, 0.45)
"""Axial room between the mid-plane and the rollers' small ends over their length, without a width."""
CONTACT_HEIGHT = Accepted(0.05, 0.11)
"""Height of the rib contact over the roller's diameter."""
SPHERE_RATIO = Accepted(0.85, 0.95)
"""Radius of the sphere of the large end over that end's distance from the apex."""
_PRELOAD = Accepted(0.0, 5.2e-4)
"""Preload of double rows over the pitch diameter: 0 to 0.4 mm at 768 mm."""
_ANGLES_AGREE = 0.03
"""Part by which the angles of two printed factors may differ."""

_NOTE = "estimate: median of what fits the maker's page, not the maker's drawing"
_UNPUBLISHED = "usual; on no maker's page"
#: Unit, decimals, tag and note of the sampled dimensions.
_WRITTEN = {
    "rollers_per_row": ("1", 0, "E", _NOTE),
    "roller_diameter": ("mm", 1, "E", _NOTE),
    "roller_length": ("mm", 1, "E", f"from the static load rating, ISO 76; {_NOTE}"),
    "outer_angle": ("deg", 2, "D", "from the axial factor, ISO 281"),
    "pitch_radius": ("mm", 1, "E", _NOTE),
    "row_offset": ("mm", 1, "E", _NOTE),
    "preload": ("mm", 3, "E", _UNPUBLISHED),
}
_RIB = {
    "sphere_ratio": ("1", 2, "E", _UNPUBLISHED),
    "contact_height": ("mm", 2, "E", _UNPUBLISHED),
}
#: Steel and surfaces are taken from this bearing.
_STEEL_OF = "tdo-main-bearing"
_STEEL = ("youngs_modulus", "poisson_ratio", "density", "composite_roughness", "hardness")


@dataclass(frozen=True)
class TaperedPage:
    """Numbers that a maker publishes of a tapered roller bearing, SI units.

    Ratings and the axial factor are those of the page: of one row for a single-row bearing. Raises
    InputError if the values contradict each other.
    """

    rows: int  #: 1 or 2
    static_load_rating: float  #: C0 [N]
    arrangement: str = "O"  #: O or X; of single rows the one in which the pair is mounted
    #: Boundary dimensions d, D, and T or B [m]; those of a double row may be unknown.
    bore: float | None = None
    outside: float | None = None
    width: float | None = None
    axial_factor_e: float | None = None  #: e [-]
    axial_factor_y: float | None = None  #: Y of a single row, Y1 of a double row [-]
    #: a [m]: of a single row the load centre's distance from the back face of the inner ring, of a
    #: double row the distance of both load centres.
    load_centre: float | None = None
    distance: float | None = None  #: Of the rollers' middles of two single rows on one shaft [m]
    dynamic_load_rating: float | None = None  #: C [N]
    fatigue_load_limit: float | None = None  #: C_u or P_u [N]
    mass: float | None = None  #: [kg]

    def __post_init__(self) -> None:
        """InputError for numbers that no page has, that are missing, or contradict each other."""
        check_positive(self)
        if self.arrangement not in ARRANGEMENTS:
            raise InputError(
                f"arrangement is {self.arrangement!r}", allowed=" or ".join(ARRANGEMENTS)
            )
        if self.axial_factor_e is None and self.axial_factor_y is None:
            raise InputError(
                "neither e nor Y is given, from which the contact angle follows",
                allowed="e, or Y of a single and Y1 of a double row",
                remedy="Take one of them from the maker's page.",
            )
        self._check_size()
        self._check_angle()

    def _check_size(self) -> None:
        if self.bore is not None and self.outside is not None:
            check_bore(self.bore, self.outside)
        elif self.fatigue_load_limit is None:
            raise InputError(
                "the size of the bearing is not given",
                allowed="bore and outside diameter, or the fatigue load limit, from which ISO 281 "
                "has the pitch diameter",
                remedy="Give --bore and --outside, or --cu.",
            )
        if (self.rows == 1) != (self.distance is not None):
            raise InputError(
                "the distance of the two rows is missing"
                if self.rows == 1
                else "a distance of two bearings is given for a double-row bearing",
                allowed="a length for two single-row bearings, nothing for a double-row one",
                remedy="--distance is that of the rollers' middles of two single rows on one shaft.",
            )

    def _check_angle(self) -> None:
        if self.axial_factor_e is None or self.axial_factor_y is None:
            return
        by_e = self.axial_factor_e / 1.5
        by_y = _cotangent_factor(self.rows) / self.axial_factor_y
        difference = abs(by_e / by_y - 1.0)
        if difference > _ANGLES_AGREE:
            raise InputError(
                f"e and Y mean two different contact angles, {math.degrees(math.atan(by_e)):.2f} and "
                f"{math.degrees(math.atan(by_y)):.2f} deg",
                allowed=f"e Y within {100 * _ANGLES_AGREE:g} % of "
                f"{1.5 * _cotangent_factor(self.rows):.3g}",
                remedy="Check both; Y of a single row is 0.4 cot, Y1 of a double row 0.45 cot of the "
                "contact angle.",
            )


def _cotangent_factor(rows: int) -> float:
    """Y over cot(contact angle) of a single row, Y1 over it of a double row, ISO 281."""
    return 0.4 if rows == 1 else 0.45


def estimate_tapered_bearing(
    page: TaperedPage, name: str, title: str = "", *, seed: int = 1
) -> Estimated[TaperedBearing]:
    """Estimate the inside of a tapered roller bearing from its maker's page.

    The samples are independent and uniform within the accepted ranges of this module, rejected
    where the parts do not fit. Of a single-row bearing the result is a pair of them on one shaft.

    Parameters
    ----------
    page : TaperedPage
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
    ISO 76:2006; ISO 281:2007.

    Examples
    --------
    A bearing 32216, of which rollers of 17 x 22.7 mm, 16 of them, were measured:

    >>> page = TaperedPage(1, 260e3, bore=0.08, outside=0.14, width=0.03525, axial_factor_e=0.42,
    ...                    load_centre=0.030, distance=0.12)
    >>> bearing, samples = estimate_tapered_bearing(page, "two-32216")
    >>> [bearing.provenance[key].range for key in ("roller_diameter", "roller_length")]
    [(14.6, 18.8), (21.5, 25.6)]
    """
    tried = _draw(page, np.random.default_rng(seed))
    drawn = _fitting(page, tried)
    bearing = _record(page, drawn, name, title)
    return Estimated(bearing, drawn)


def _draw(page: TaperedPage, rng: np.random.Generator) -> dict[str, FloatArray]:
    """Sample dimensions that the page leaves open; number and size of the rollers follow."""
    rounding = E_ROUNDING * rng.uniform(-1.0, 1.0, SAMPLES)
    alpha = _angles(page, rounding)
    if page.bore is not None and page.outside is not None:
        pitch = 0.5 * (page.bore + page.outside) * PITCH.drawn(rng)
    else:
        pitch = _pitch_of_limit(page) * PITCH_OF_LIMIT.drawn(rng)
    rating = page.static_load_rating * STATIC_RATING.drawn(rng)
    spacing = SPACING.drawn(rng)
    slenderness = SLENDERNESS.drawn(rng)
    diameter = 0.1 * pitch
    for _ in range(30):
        sine = np.minimum(spacing * diameter / pitch, 1.0)
        count = np.pi / np.arcsin(sine)
        cosine = np.cos(alpha)
        projected = 44e6 * page.rows * count * cosine
        room = 1.0 - diameter * cosine / pitch
        diameter = np.sqrt(rating / (projected * slenderness * room))
        diameter = np.minimum(diameter, 0.5 * pitch)
    count = np.round(count)
    room = 1.0 - diameter * np.cos(alpha) / pitch
    drawn = {
        "rollers_per_row": count,
        "roller_diameter": diameter,
        "roller_length": rating / (44e6 * page.rows * count * np.cos(alpha) * diameter * room),
        "outer_angle": alpha,
        "pitch_radius": 0.5 * pitch,
        "preload": pitch * _PRELOAD.drawn(rng) if page.rows == 2 else np.zeros(SAMPLES),
        "sphere_ratio": SPHERE_RATIO.drawn(rng),
        "contact_height": diameter * CONTACT_HEIGHT.drawn(rng),
    }
    rib = RIB.drawn(rng)
    row_offset = _row_offset(page, drawn, rib, GAP.drawn(rng))
    return drawn | {"row_offset": row_offset}


def _angles(page: TaperedPage, rounding: NDArray) -> FloatArray:
    """Angle of the outer raceway [rad] from the axial factor, within its rounding."""
    if page.axial_factor_e is not None:
        e = page.axial_factor_e + rounding
        return np.arctan(e / 1.5)
    assert page.axial_factor_y is not None, "a page has e or Y"
    y = page.axial_factor_y + rounding
    return np.arctan(_cotangent_factor(page.rows) / y)


def _pitch_of_limit(page: TaperedPage) -> float:
    """Pitch diameter [m] of C_u = C0/8.2 (100 mm/Dpw)^0.3, ISO 281."""
    assert page.fatigue_load_limit is not None, "a page has d and D, or C_u"
    ratio = page.static_load_rating / (8.2 * page.fatigue_load_limit)
    return 0.1 * ratio ** (1.0 / 0.3)


def _load_centre(drawn: Mapping[str, NDArray]) -> FloatArray:
    """Distance of the load centre behind the rollers' middles [m]."""
    beta = np.vectorize(half_cone_angle)(
        drawn["roller_diameter"], 2.0 * drawn["pitch_radius"], drawn["outer_angle"]
    )
    alpha = drawn["outer_angle"] - beta
    outer_angle = drawn["outer_angle"]
    apex = drawn["pitch_radius"] / np.sin(alpha)
    cosines = np.cos(beta) * np.cos(outer_angle)
    along_axis = apex * np.cos(alpha)
    return apex / cosines - along_axis


def _row_offset(
    page: TaperedPage, drawn: Mapping[str, NDArray], rib: NDArray, gap: NDArray
) -> FloatArray:
    """Axial distance of the rollers' middles from the mid-plane [m]."""
    if page.distance is not None:
        return np.full(SAMPLES, 0.5 * page.distance)
    if page.load_centre is not None:
        centre = _load_centre(drawn)
        towards = centre if page.arrangement == "X" else -centre
        return 0.5 * page.load_centre + towards
    # The angle of the roller's axis is a few degrees below that of the outer raceway.
    reach = 0.5 * drawn["roller_length"] * np.cos(drawn["outer_angle"])
    if page.width is not None:
        return 0.5 * page.width * (1.0 - rib) - reach
    return reach + gap * drawn["roller_length"]


def _fitting(page: TaperedPage, drawn: dict[str, FloatArray]) -> dict[str, FloatArray]:
    """Keep the samples whose parts fit into the bearing."""
    length = drawn["roller_length"]
    diameter = drawn["roller_diameter"]
    radius = drawn["pitch_radius"]
    cosine = np.cos(drawn["outer_angle"])
    reach = 0.5 * length * cosine
    half_pitch = np.pi / drawn["rollers_per_row"]
    spacing = 2.0 * radius * np.sin(half_pitch) / diameter
    passed = {
        "roller length over diameter": within(length / diameter, SLENDERNESS),
        # Rounding the number of rollers shifts their spacing by up to half a roller.
        "spacing of the rollers": within(spacing, SPACING, 0.5 / drawn["rollers_per_row"]),
        "rows apart": drawn["row_offset"] > reach,
    }
    if page.bore is not None and page.outside is not None:
        height = 0.5 * (page.outside - page.bore)
        across = 0.5 * diameter * cosine
        inner = radius - across - 0.5 * page.bore
        outer = 0.5 * page.outside - radius - across
        passed["inner ring under the rollers"] = within(inner / height, INNER_WALL)
        passed["outer ring over the rollers"] = within(outer / height, OUTER_WALL)
    if page.width is not None:
        half = page.width if page.rows == 1 else 0.5 * page.width
        passed["rollers within the width"] = 2.0 * reach < half * (1.0 - RIB.low)
        if page.rows == 1 and page.load_centre is not None:
            rib = page.load_centre - _load_centre(drawn) - reach
            passed["rib beside the large ends"] = within(rib / half, RIB)
        if page.rows == 2:
            passed["rollers within the width"] &= drawn["row_offset"] + reach < half
    return fitting(
        drawn,
        passed,
        allowed="the published values of one tapered roller bearing, single-row or double-row",
        remedy="Check the values and their units, static load rating, number of rows and axial "
        "factor above all.",
    )


def _record(
    page: TaperedPage, drawn: Mapping[str, NDArray], name: str, title: str
) -> TaperedBearing:
    """The bearing of the medians."""
    entries = {key: entry(np.median(drawn[key]), drawn[key], *how) for key, how in _WRITTEN.items()}
    if page.distance is not None:
        middle = short_number(500.0 * page.distance)
        entries["row_offset"] = stated(middle, "mm", "U", "half the distance of both rows")
        entries["preload"] = stated(0, "mm", "E", "a choice: neither preload nor play")
    known = TaperedBearing.read(_STEEL_OF).as_dict()
    rib = {key: entry(np.median(drawn[key]), drawn[key], *how) for key, how in _RIB.items()}
    rib |= {key: known["rib"][key] for key in ("oil_supply", "roughness")}
    entries |= _published(page) | _ratings(page, entries)
    same = {key: known[key] for key in _STEEL}
    words = {"name": name, "title": title, "kind": "tapered", "arrangement": page.arrangement}
    return TaperedBearing.from_dict(words | entries | {"rib": rib} | same)


def _published(page: TaperedPage) -> dict[str, dict]:
    """Entries of the page's own values; ratings of a pair are those of both rows together."""
    scales = {"mm": 1e3, "kN": 1e-3, "kg": 1.0}
    values = {
        "bore_diameter": (page.bore, "mm", "V", "maker's page, d"),
        "outside_diameter": (page.outside, "mm", "V", "maker's page, D"),
        "mass": (page.mass, "kg", "V", "maker's page, mass"),
    }
    if page.rows == 2:
        values |= {
            "width": (page.width, "mm", "V", "maker's page, T or B"),
            "dynamic_load_rating": (page.dynamic_load_rating, "kN", "V", "maker's page, C"),
            "static_load_rating": (page.static_load_rating, "kN", "V", "maker's page, C0"),
            "fatigue_load_limit": (page.fatigue_load_limit, "kN", "V", "maker's page, C_u or P_u"),
        }
    else:
        twice = "of two rows together, from the maker's page of one, ISO"
        dynamic = page.dynamic_load_rating
        limit = page.fatigue_load_limit
        values |= {
            "dynamic_load_rating": (
                None if dynamic is None else 2.0 ** (7.0 / 9.0) * dynamic, "kN", "D", f"{twice} 281",
            ),
            "static_load_rating": (2.0 * page.static_load_rating, "kN", "D", f"{twice} 76"),
            "fatigue_load_limit": (
                None if limit is None else 2.0 * limit, "kN", "D", f"{twice} 281",
            ),
        }  # fmt: skip
    return {
        key: stated(short_number(float(f"{value * scales[unit]:.5g}")), unit, tag, note)
        for key, (value, unit, tag, note) in values.items()
        if value is not None
    }


def _ratings(page: TaperedPage, entries: Mapping[str, dict]) -> dict[str, dict]:
    """Entries of C and C_u where the page leaves them out, by ISO 281 from the medians."""
    rollers = Rollers.of(entries, "outer_angle")
    ratings = {}
    if page.dynamic_load_rating is None:
        rating = dynamic_load_rating(2, *rollers, kind="tapered")
        note = "ISO 281 from the estimated inside; makers publish up to 40 % more"
        ratings["dynamic_load_rating"] = (rating, note)
    if page.fatigue_load_limit is None:
        both = page.static_load_rating * (2.0 if page.rows == 1 else 1.0)
        ratings["fatigue_load_limit"] = (fatigue_load_limit(both, rollers.pitch), "ISO 281")
    return {
        key: stated(short_number(float(f"{1e-3 * value:.4g}")), "kN", "D", note)
        for key, (value, note) in ratings.items()
    }
