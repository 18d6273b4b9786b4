"""Data of a double-row tapered roller bearing, or of two single-row ones on one shaft."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Self

from macroslip.bearing import fields
from macroslip.bearing.profile import profile_crown
from macroslip.bearing.rollers import no_roller, overlapping
from macroslip.bearing.tapered import geometry
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

#: Arrangements of the two rows: O, the outer rings' back faces meet (large ends of the rollers away
#: from the mid-plane), and X, their front faces meet.
ARRANGEMENTS = ("O", "X")
_KIND = Choice("kind of the bearing", lambda: ("tapered",))
_ARRANGEMENT = Choice(
    "O, large ends of the rollers away from the mid-plane, or X, towards it",
    lambda: ARRANGEMENTS,
)
_Optional = float | None
#: Difference up to which angles of two drawings share an apex [rad].
_ANGLE_ROUNDING = math.radians(0.02)
#: Keys that bearings of other kinds have.
_OF_OTHERS = (
    "osculation",
    "osculation_inner",
    "osculation_outer",
    "diametral_clearance",
    "contact_angle",
    "roller_crown_radius",
    "roller_profile",
)


class TaperedBearing(Record):
    """Data of a double-row tapered roller bearing, or of two single-row ones on one shaft.

    Both rows are alike and mirrored. In O arrangement the row that carries thrust along +Z0 lies
    upwind of the mid-plane, in X arrangement downwind, as in a spherical roller bearing: rows are
    named by the thrust that they carry, not by their place.

    Attributes are in SI units (m, N, rad, Pa, kg); `provenance` gives the source of each. Raises
    InputError if a value is missing, out of range, or inconsistent with the others.

    Examples
    --------
    >>> bearing = TaperedBearing.read("tdo-main-bearing")
    >>> bearing.arrangement, bearing.provenance["rib_contact_height"].tag
    ('O', 'E')
    >>> round(1e3 * bearing.replace(preload=2e-4).preload, 3)
    0.2
    """

    noun: ClassVar[str] = "tapered bearing"
    sections: ClassVar[Mapping[str, str]] = {
        "rib": "contact of the rollers' large ends with the rib of the inner ring"
    }

    kind: Annotated[str, _KIND] = "tapered"
    name: fields.Name
    title: fields.Title = ""
    arrangement: Annotated[str, _ARRANGEMENT]

    bore_diameter: fields.BoreDiameter = None
    outside_diameter: fields.OutsideDiameter = None
    width: Annotated[_Optional, Positive("width of the bearing with both rows", LENGTH, 5)] = None
    dynamic_load_rating: Annotated[
        _Optional, Positive("basic dynamic radial load rating C of both rows", FORCE, 1e9)
    ] = None
    static_load_rating: Annotated[
        _Optional, Positive("basic static radial load rating C0 of both rows", FORCE, 1e9)
    ] = None
    fatigue_load_limit: fields.FatigueLoadLimit = None
    mass: fields.Mass = None

    rollers_per_row: fields.RollersPerRow
    roller_diameter: Annotated[float, Positive("diameter of a roller at its middle", LENGTH, 1)]
    roller_length: Annotated[float, Positive("effective length of a roller", LENGTH, 2)]
    outer_angle: Annotated[
        float,
        Quantity(
            "half-angle of the outer ring's raceway (cup angle), the nominal contact angle",
            ANGLE,
            math.radians(5),
            math.radians(45),
        ),
    ]
    inner_angle: Annotated[
        _Optional,
        Quantity(
            "half-angle of the inner ring's raceway (cone angle), which follows from the apex",
            ANGLE,
            0.0,
            math.radians(45),
        ),
    ] = None
    pitch_radius: Annotated[
        float, Positive("distance of the rollers' middles from the bearing axis", LENGTH, 5)
    ]
    row_offset: Annotated[
        float, Positive("axial distance of the rollers' middles from the mid-plane", LENGTH, 5)
    ]
    preload: Annotated[
        float,
        Quantity(
            "axial interference of both rows together, mounted and warm; negative is play",
            LENGTH,
            -5e-3,
            2e-3,
        ),
    ]
    rib_sphere_ratio: Annotated[
        float,
        Quantity(
            "radius of the large end's sphere over the distance of that end from the apex",
            NUMBER,
            0.4,
            0.99,
        ),
    ]
    rib_contact_height: Annotated[
        float, Positive("height of the rib contact above the line of the inner raceway", LENGTH, 1)
    ]
    rib_oil_supply: Annotated[
        float,
        Quantity("film at the rib over the film with a full inlet", NUMBER, 0.01, 1),
    ] = 1.0

    youngs_modulus: Annotated[
        float, Quantity("Young's modulus of rollers and rings", PRESSURE, 1e9, 1e12)
    ]
    poisson_ratio: Annotated[
        float, Quantity("Poisson ratio of rollers and rings", NUMBER, 0, 0.5, below=True)
    ]
    density: fields.RollerDensity
    composite_roughness: fields.CompositeRoughness
    hardness: fields.Hardness
    rib_roughness: Annotated[
        float, Positive("composite RMS roughness of the large end and the rib", LENGTH, 1e-4)
    ]
    cage_youngs_modulus: fields.CageYoungsModulus = 210e9
    cage_poisson_ratio: fields.CagePoissonRatio = 0.3
    thermal_conductivity: fields.ThermalConductivity = None
    specific_heat: fields.SpecificHeat = None
    #: Fields of other kinds of bearings, whose geometry tapered rollers share at their middles.
    osculation_inner: ClassVar[None] = None
    osculation_outer: ClassVar[None] = None
    #: Rollers touch their raceways along a line, and not in an ellipse.
    touches_along_line: ClassVar[bool] = True
    out_of_round_second: ClassVar[None] = None
    out_of_round_third: ClassVar[None] = None
    out_of_round_angle: ClassVar[None] = None
    #: Play is that of the balance of the ring, in which preload is.
    diametral_clearance: ClassVar[float] = 0.0

    @classmethod
    def from_dict(cls, entries: Mapping[str, Any], source: Source | None = None) -> Self:
        """Build a bearing from the content of a file, as `Record.from_dict` does.

        Raises InputError, in one sentence, for osculations or clearances of other kinds of bearings,
        and for a skew.
        """
        where = source or Source()
        strange = [key for key in _OF_OTHERS if key in entries]
        if strange:
            raise InputError(
                f"a tapered roller bearing has no {' and no '.join(strange)}: its rollers touch along "
                "lines, and it has a preload",
                where=where.where(strange[0]),
                allowed="kind: tapered without them, with preload in place of a clearance",
                remedy=f"Remove {' and '.join(strange)}.",
            )
        if "skew" in entries:
            raise InputError(
                "skew is no property of a tapered roller bearing: the friction of the rib turns its "
                "rollers, and by how much is not computed",
                where=where.where("skew"),
                allowed="kind: tapered without it; rollers stand straight",
                remedy="Remove skew.",
            )
        return super().from_dict(entries, source)

    @property
    def rows(self) -> int:
        """Number of rows of rollers."""
        return 2

    @property
    def nominal_contact_angle(self) -> float:
        """Contact angle by which the standards rate it [rad], that of the outer raceway."""
        return self.outer_angle

    @property
    def contact_angle(self) -> float:
        """Angle of the rollers' axes to the bearing's axis [rad], along whose normal a roller is held."""
        beta, _ = geometry.cone(self.roller_diameter, 2.0 * self.pitch_radius, self.outer_angle)
        return self.outer_angle - beta

    @property
    def roller_crown_radius(self) -> float:
        """Radius of the crown that the logarithmic profile has at the roller's middle [m]."""
        return profile_crown(self.roller_length, self.roller_diameter)

    def _inconsistencies(self, source: Source) -> Iterator[InputError]:
        faults = [*no_roller(self, source), *overlapping(self, source)]
        if not faults:
            faults = [*_no_common_apex(self, source), *_rows_beside_each_other(self, source)]
        yield from faults
        if not faults:
            yield from _rib_beside_the_end(self, source)


def _no_common_apex(bearing: TaperedBearing, source: Source) -> Iterator[InputError]:
    """Yield an angle of the inner raceway whose lines of contact do not meet those of the outer one."""
    if bearing.inner_angle is None:
        return
    beta, apex = geometry.cone(
        bearing.roller_diameter, 2.0 * bearing.pitch_radius, bearing.outer_angle
    )
    expected = bearing.outer_angle - 2.0 * beta
    if abs(bearing.inner_angle - expected) > _ANGLE_ROUNDING:
        yield InputError(
            f"outer and inner raceway share no apex with the rollers: inner_angle is "
            f"{bearing.written('inner_angle')}, and the apex of the outer raceway, "
            f"{bearing.written('roller_length', apex)} from the rollers' middles, asks for "
            f"{bearing.written('inner_angle', expected)}",
            where=source.where("inner_angle", "value"),
            allowed="outer_angle less twice the rollers' half-angle β, tan β = (roller_diameter/"
            f"(2 pitch_radius)) sin(outer_angle − β), within {math.degrees(_ANGLE_ROUNDING):g} deg",
            remedy="Check the angles, roller_diameter and pitch_radius, or leave inner_angle out.",
        )


def _rows_beside_each_other(bearing: TaperedBearing, source: Source) -> Iterator[InputError]:
    """Yield rollers that reach beyond the apex or over the mid-plane."""
    beta, apex = geometry.cone(
        bearing.roller_diameter, 2.0 * bearing.pitch_radius, bearing.outer_angle
    )
    axis_angle = bearing.outer_angle - beta
    reach = bearing.roller_length / 2.0 * math.cos(axis_angle)
    if apex <= bearing.roller_length / 2.0:
        yield InputError(
            f"the rollers' small ends lie beyond the apex, which is "
            f"{bearing.written('roller_length', apex)} from their middles",
            where=source.where("outer_angle", "value"),
            allowed="an apex farther than roller_length/2",
            remedy="Check outer_angle, pitch_radius and roller_length.",
        )
    if bearing.row_offset <= reach:
        yield InputError(
            f"the rollers of the two rows overlap: row_offset is {bearing.written('row_offset')}",
            where=source.where("row_offset", "value"),
            allowed="above roller_length/2 cos(angle of the rollers' axes) = "
            f"{bearing.written('row_offset', reach)}",
            remedy="Check row_offset, which is half the distance of the two rows' middles, and "
            "roller_length.",
        )


def _rib_beside_the_end(bearing: TaperedBearing, source: Source) -> Iterator[InputError]:
    """Yield a rib contact that does not lie on the roller's large end."""
    beta, apex = geometry.cone(
        bearing.roller_diameter, 2.0 * bearing.pitch_radius, bearing.outer_angle
    )
    end = apex + bearing.roller_length / 2.0
    highest = end * math.sin(beta)
    if bearing.rib_contact_height >= highest:
        yield InputError(
            f"rib.contact_height is {bearing.written('rib_contact_height')}, above the middle of "
            "the roller's large end",
            where=source.where("rib", "contact_height"),
            allowed=f"below {bearing.written('rib_contact_height', highest)}",
            remedy="Check rib.contact_height: usual are 5 to 15 % of the roller's diameter.",
        )
