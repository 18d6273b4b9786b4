"""Data of a double-row spherical or a single-row cylindrical roller bearing."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Self

from macroslip.bearing import fields, geometry, load_ratings
from macroslip.bearing.profile import LOGARITHMIC, LONGEST_LOGARITHMIC, PROFILES
from macroslip.bearing.rollers import no_roller, overlapping
from macroslip.errors import InputError
from macroslip.input.fields import Choice, Positive, Quantity
from macroslip.input.files import Source
from macroslip.input.record import Record
from macroslip.input.units import (
    ANGLE,
    FORCE,
    LENGTH,
    NUMBER,
    PRESSURE,
)

#: Relative difference allowed between given and computed positions of the roller centre: drawings
#: round.
SPHERE_TOLERANCE = 0.01
#: Number of rows of rollers by the kind of bearing.
_ROWS = {"spherical": 2, "cylindrical": 1}
#: States of a mounted bearing for which its clearance may be given.
CLEARANCE_STATES = ("warm", "cold")
_CLEARANCE_STATE = Choice(
    "state of the clearance: warm, in operation, or cold, with all parts at one temperature",
    lambda: CLEARANCE_STATES,
)
_PROFILE = Choice(
    "profile of a cylindrical roller that touches its raceways along a line: straight, or "
    "logarithmic by ISO/TS 16281",
    lambda: PROFILES,
)
_Optional = float | None
#: Young's moduli of steel [Pa], for which the approach of a line contact is known.
_STEEL = (195e9, 220e9)
#: Ratings and mass are within this factor of those by the standard and of solid rings: makers
#: differ by far less, and a wrong unit by more.
_SIZE_FACTOR = 30.0


class Bearing(Record):
    """Data of a double-row spherical or a single-row cylindrical roller bearing.

    The rows of a spherical roller bearing are identical and mirrored. A cylindrical roller bearing
    has no osculations: its rollers touch straight raceways, crowned ones with a
    `roller_crown_radius` in an ellipse, straight ones and those with a logarithmic profile, by
    `roller_profile`, along a line. Contact angle and row offset are 0, and `outer_raceway_radius`
    is the radius of a cylinder.

    Attributes are in SI units (m, N, rad, Pa, kg); `provenance` gives the source of each. Lengths
    and angles have no sign, except the clearance, which is negative for a preloaded bearing. Raises
    InputError if a value is missing, out of range, or inconsistent with the others.

    Examples
    --------
    >>> bearing = Bearing.read("skf-240-600-bc")
    >>> bearing.roller_diameter, bearing.provenance["roller_diameter"].tag
    (0.07, 'E')
    >>> bearing.replace(diametral_clearance=1e-4).provenance["diametral_clearance"]
    Provenance(value=0.0001, unit='m', tag='U', note='', range=None)
    """

    noun: ClassVar[str] = "bearing"
    sections: ClassVar[Mapping[str, str]] = {
        "out_of_round": "out-of-roundness of the outer raceway, as a housing that gives way makes "
        "it: waves of the clearance"
    }

    name: fields.Name
    title: fields.Title = ""

    bore_diameter: fields.BoreDiameter = None
    outside_diameter: fields.OutsideDiameter = None
    width: Annotated[_Optional, Positive("width of the bearing", LENGTH, 5)] = None
    dynamic_load_rating: Annotated[
        _Optional, Positive("basic dynamic radial load rating C", FORCE, 1e9)
    ] = None
    static_load_rating: Annotated[
        _Optional, Positive("basic static radial load rating C0", FORCE, 1e9)
    ] = None
    fatigue_load_limit: fields.FatigueLoadLimit = None
    axial_factor_e: Annotated[
        _Optional, Positive("ratio e of axial to radial load between Y1 and Y2", NUMBER, 5)
    ] = None
    axial_factor_y1: Annotated[
        _Optional, Positive("axial load factor Y1, at or below e", NUMBER, 100)
    ] = None
    axial_factor_y2: Annotated[
        _Optional, Positive("axial load factor Y2, above e", NUMBER, 100)
    ] = None
    axial_factor_y0: Annotated[_Optional, Positive("static axial load factor Y0", NUMBER, 100)] = (
        None
    )
    mass: fields.Mass = None

    rollers_per_row: fields.RollersPerRow
    roller_diameter: Annotated[float, Positive("largest roller diameter", LENGTH, 1)]
    roller_length: Annotated[float, Positive("roller length", LENGTH, 2)]
    contact_angle: Annotated[
        float,
        Quantity(
            "angle of the contact normals to the radial plane", ANGLE, 0, math.pi / 4, below=True
        ),
    ]
    pitch_radius: Annotated[
        float, Positive("distance of the roller centres from the bearing axis", LENGTH, 5)
    ]
    outer_raceway_radius: Annotated[
        float, Positive("radius of the outer raceway sphere", LENGTH, 10)
    ]
    row_offset: Annotated[
        float, Quantity("axial distance of the roller centres from the mid-plane", LENGTH, 0, 5)
    ]
    osculation_inner: Annotated[
        _Optional,
        Quantity(
            "roller contour radius / contour radius of the inner raceway",
            NUMBER,
            0.9,
            1,
            above=True,
            below=True,
        ),
    ] = None
    osculation_outer: Annotated[
        _Optional,
        Quantity(
            "roller contour radius / radius of the outer raceway sphere",
            NUMBER,
            0.9,
            1,
            above=True,
            below=True,
        ),
    ] = None
    roller_crown_radius: Annotated[
        _Optional, Positive("radius of a cylindrical roller's crown along its axis", LENGTH, 1000)
    ] = None
    roller_profile: Annotated[str | None, _PROFILE] = None
    diametral_clearance: Annotated[
        float, Quantity("diametral clearance, mounted; negative for preload", LENGTH, -1e-3, 5e-3)
    ]
    clearance_state: Annotated[str, _CLEARANCE_STATE] = "warm"
    out_of_round_second: Annotated[
        _Optional,
        Quantity("wave with two crests: its part of the radial clearance", LENGTH, -1e-3, 1e-3),
    ] = None
    out_of_round_third: Annotated[
        _Optional,
        Quantity("wave with three crests: its part of the radial clearance", LENGTH, -1e-3, 1e-3),
    ] = None
    out_of_round_angle: Annotated[
        _Optional,
        Quantity(
            "place of a crest of both, from horizontal; 0 if not given", ANGLE, -math.pi, math.pi
        ),
    ] = None

    youngs_modulus: Annotated[
        float, Quantity("Young's modulus of rollers and raceways", PRESSURE, 1e9, 1e12)
    ]
    poisson_ratio: Annotated[
        float, Quantity("Poisson ratio of rollers and raceways", NUMBER, 0, 0.5, below=True)
    ]
    density: fields.RollerDensity
    cage_youngs_modulus: fields.CageYoungsModulus
    cage_poisson_ratio: fields.CagePoissonRatio
    composite_roughness: fields.CompositeRoughness
    hardness: fields.Hardness

    thermal_conductivity: fields.ThermalConductivity = None
    specific_heat: fields.SpecificHeat = None

    @property
    def kind(self) -> str:
        """The kind of bearing: `spherical` (double-row) or `cylindrical` (single-row)."""
        is_crowned = self.roller_crown_radius is not None
        return "cylindrical" if is_crowned or self.touches_along_line else "spherical"

    @property
    def touches_along_line(self) -> bool:
        """Whether rollers touch their raceways along a line, and not in an ellipse."""
        return self.roller_profile is not None

    @property
    def rows(self) -> int:
        """Number of rows of rollers: 2 in a spherical roller bearing, 1 in a cylindrical one."""
        return _ROWS[self.kind]

    @property
    def nominal_contact_angle(self) -> float:
        """Contact angle by which the standards rate it [rad]."""
        return self.contact_angle

    @classmethod
    def from_dict(cls, entries: Mapping[str, Any], source: Source | None = None) -> Self:
        """Build a bearing from the content of a file, as `Record.from_dict` does.

        Raises InputError, in one sentence, for the file of a tapered roller bearing.
        """
        if entries.get("kind") == "tapered":
            raise InputError(
                "this is the file of a tapered roller bearing",
                where=(source or Source()).where("kind"),
                allowed="a spherical or a cylindrical roller bearing",
                remedy="Case files take it; in Python read_bearing of macroslip.bearing.kinds does.",
            )
        return super().from_dict(entries, source)

    def _inconsistencies(self, source: Source) -> Iterator[InputError]:
        kind = list(_kind(self, source))
        yield from kind
        if kind:
            return
        # Positions or shapes that contradict each other make all that is computed from them
        # meaningless.
        contradictions = [*_contradictions(self, source), *no_roller(self, source)]
        yield from contradictions
        yield from overlapping(self, source)
        if not contradictions:
            faults = [*_rows(self, source), *_rings(self, source)]
            yield from faults or _sizes(self, source)


def _kind(bearing: Bearing, source: Source) -> Iterator[InputError]:
    """Yield osculations that are missing, and values that a cylindrical bearing cannot have."""
    osculations = ("osculation_inner", "osculation_outer")
    if bearing.kind != "cylindrical":
        if missing := [key for key in osculations if getattr(bearing, key) is None]:
            yield InputError(
                f"{' and '.join(missing)} {'is' if len(missing) == 1 else 'are'} missing",
                where=source.where(missing[0]),
                allowed="both, above 0.9 and below 1",
                remedy="Add what is missing. A cylindrical roller bearing has a "
                "roller_profile, straight or logarithmic, in their place, or a "
                "roller_crown_radius: with a drop d of the roller's contour at its ends, "
                "roller_length²/(8 d).",
            )
        return
    shape = "roller_profile" if bearing.touches_along_line else "roller_crown_radius"
    yield from _profile(bearing, source)
    for key in (*osculations, "contact_angle", "row_offset"):
        if getattr(bearing, key):
            yield InputError(
                f"{key} is {bearing.written(key)}, and {shape} tells of a cylindrical roller "
                "bearing",
                where=source.where(key, "value"),
                allowed="no value" if key in osculations else "0",
                remedy=f"Remove {shape} from a spherical roller bearing, or {key} from a "
                "cylindrical one."
                if key in osculations
                else f"Remove {shape} from a spherical roller bearing.",
            )


def _profile(bearing: Bearing, source: Source) -> Iterator[InputError]:
    """Yield what a roller that touches along a line cannot have."""
    if not bearing.touches_along_line:
        return
    if bearing.roller_crown_radius is not None:
        yield InputError(
            f"roller_crown_radius is {bearing.written('roller_crown_radius')}, and roller_profile "
            f"is {bearing.roller_profile}: a roller has one or the other",
            where=source.where("roller_profile"),
            allowed="roller_profile, or roller_crown_radius",
            remedy="Remove roller_crown_radius if the maker tells of straight rollers or of a "
            "logarithmic profile, and roller_profile if he tells of a crown.",
        )
    longest = LONGEST_LOGARITHMIC * bearing.roller_diameter
    is_logarithmic = bearing.roller_profile == LOGARITHMIC
    if is_logarithmic and bearing.roller_length > longest:
        yield InputError(
            f"roller_length is {bearing.written('roller_length')}, and the standard's logarithmic "
            f"profile of so long a roller is another one, straight in its middle",
            where=source.where("roller_length", "value"),
            allowed=f"up to {LONGEST_LOGARITHMIC:g} times roller_diameter, "
            f"{bearing.written('roller_length', longest)}, with roller_profile: logarithmic",
            remedy="Set roller_profile: straight.",
        )
    low, high = _STEEL
    if not low <= bearing.youngs_modulus <= high:
        yield InputError(
            f"youngs_modulus is {bearing.written('youngs_modulus')}, and the approach of a line "
            "contact is known of steel on steel",
            where=source.where("youngs_modulus", "value"),
            allowed=f"{bearing.written('youngs_modulus', low)} to "
            f"{bearing.written('youngs_modulus', high)} with roller_profile",
            remedy="Give a roller_crown_radius in place of roller_profile.",
        )


def _contradictions(bearing: Bearing, source: Source) -> Iterator[InputError]:
    centre = bearing.outer_raceway_radius - bearing.roller_diameter / 2
    for key, expected, formula in (
        ("pitch_radius", centre * math.cos(bearing.contact_angle), "cos(contact_angle)"),
        ("row_offset", centre * math.sin(bearing.contact_angle), "sin(contact_angle)"),
    ):
        difference = abs(getattr(bearing, key) - expected)
        if difference > SPHERE_TOLERANCE * abs(expected):
            yield InputError(
                f"{key} is {bearing.written(key)}, but rollers that touch the outer raceway sphere "
                f"have (outer_raceway_radius - roller_diameter/2) {formula} = "
                f"{bearing.written(key, expected)}",
                where=source.where(key, "value"),
                allowed=f"agreement within {SPHERE_TOLERANCE:.0%}",
                remedy="Check pitch_radius, row_offset, outer_raceway_radius, roller_diameter and "
                "contact_angle.",
            )


def _rows(bearing: Bearing, source: Source) -> Iterator[InputError]:
    space = geometry.envelope(bearing)
    if space.nearest < 0.0 and bearing.rows > 1:
        overlap = bearing.written("row_offset", -2.0 * space.nearest)
        coincide = bearing.row_offset == 0.0
        fault = (
            "both rows lie in one plane"
            if coincide
            else f"the rollers of the two rows overlap by {overlap}"
        )
        yield InputError(
            f"{fault}: row_offset is {bearing.written('row_offset')}, roller_length "
            f"{bearing.written('roller_length')}",
            where=source.where("row_offset", "value"),
            allowed="rollers that end before the mid-plane: row_offset > roller_length/2 "
            "cos(contact_angle) + end radius sin(contact_angle) = "
            f"{bearing.written('row_offset', bearing.row_offset - space.nearest)}",
            remedy="Check roller_length, contact_angle and outer_raceway_radius.",
        )
    if bearing.width is not None and space.farthest > bearing.width / 2:
        yield InputError(
            f"the rollers reach {bearing.written('width', space.farthest)} from the mid-plane, "
            f"farther than the faces of a bearing of width {bearing.written('width')}",
            where=source.where("width", "value"),
            allowed=f"a width of at least {bearing.written('width', 2.0 * space.farthest)} for "
            "these rollers",
            remedy="Check width, roller_length, contact_angle and outer_raceway_radius.",
        )


def _rings(bearing: Bearing, source: Source) -> Iterator[InputError]:
    bore = bearing.bore_diameter
    outside = bearing.outside_diameter
    if bore is not None and outside is not None and bore >= outside:
        yield InputError(
            f"bore_diameter is {bearing.written('bore_diameter')}",
            where=source.where("bore_diameter", "value"),
            allowed=f"less than outside_diameter, {bearing.written('bore_diameter', outside)}",
            remedy="Check both diameters.",
        )
    inside = geometry.envelope(bearing).inside
    if bore is not None and inside <= bore / 2 and (outside is None or bore < outside):
        yield InputError(
            f"bore_diameter is {bearing.written('bore_diameter')}, so that nothing is left of the "
            "inner ring below the rollers",
            where=source.where("bore_diameter", "value"),
            allowed=f"below {bearing.written('bore_diameter', 2.0 * inside)}, the smallest "
            "diameter of the inner raceway",
            remedy="Check bore_diameter, outer_raceway_radius, roller_diameter and roller_length.",
        )
    if outside is not None and outside / 2 <= bearing.outer_raceway_radius:
        yield InputError(
            f"outside_diameter is {bearing.written('outside_diameter')}, smaller than the outer "
            "raceway sphere",
            where=source.where("outside_diameter", "value"),
            allowed="above "
            f"{bearing.written('outside_diameter', 2.0 * bearing.outer_raceway_radius)}, twice "
            "outer_raceway_radius",
            remedy="Check outside_diameter and outer_raceway_radius, which is no diameter.",
        )


def _sizes(bearing: Bearing, source: Source) -> Iterator[InputError]:
    """Yield load ratings and a mass that no bearing of this size has: they have another unit."""
    pitch = 2.0 * bearing.pitch_radius
    static = load_ratings.static_load_rating_of(bearing)
    limit = load_ratings.fatigue_load_limit(static, pitch)
    expected = {"static_load_rating": static, "fatigue_load_limit": limit}
    projected = bearing.roller_diameter * math.cos(bearing.contact_angle)
    gamma = projected / pitch
    if 0.01 <= gamma <= 0.30:
        expected["dynamic_load_rating"] = load_ratings.dynamic_load_rating_of(bearing)
    bore = bearing.bore_diameter
    outside = bearing.outside_diameter
    width = bearing.width
    if bore is not None and outside is not None and width is not None and bore < outside:
        face = math.pi / 4.0 * (outside**2 - bore**2)
        volume = face * width
        expected["mass"] = bearing.density * volume
    for key, value in expected.items():
        size = getattr(bearing, key)
        lowest = value / _SIZE_FACTOR
        highest = value * _SIZE_FACTOR
        if size is not None and not lowest <= size <= highest:
            yield InputError(
                f"{key} is {bearing.written(key)}, and rings and rollers of this size have "
                f"{bearing.written(key, value)}",
                where=source.where(key, "value"),
                allowed=f"{bearing.written(key, lowest)} to {bearing.written(key, highest)}",
                remedy="Check its unit, and marks between its digits.",
            )
