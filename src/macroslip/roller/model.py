"""Numbers and laws of a roller that do not change with time, and their record for compiled code."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from functools import partial
from typing import NamedTuple

import numpy as np

from macroslip.bearing import Bearing, geometry
from macroslip.bearing.geometry import AXIAL_SIGNS, initial_angles, row_names
from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.constants import GRAVITY
from macroslip.contact.hertz import series_stiffness
from macroslip.contact.laws import POCKET_GAP, PreparedContact, PreparedLaws, prepare
from macroslip.contact.look_up import PLANE, REST_SPEED, TRACTION
from macroslip.contact.mechanisms import Laws
from macroslip.contact.strips import strips_of
from macroslip.contact.table import (
    COARSEST,
    Box,
    TableErrors,
    Tables,
    cage_values,
    film_values,
    oil_values,
    write_plane,
    write_traction,
)
from macroslip.lubricant import Lubricant
from macroslip.mechanics.film_sharing import (
    REACH_NODES,
    film_load_is_negligible,
    film_reach,
    reach_forces,
)
from macroslip.ring.balance import RingGeometry

#: Least load of planes [N], and least speed of oil's as part of the fastest.
_LIGHTEST = 1e-4
_SLOWEST = 1e-4

#: A contact of a roller.
CONTACT = np.dtype(
    [
        ("traction", TRACTION),  # table of a raceway's traction
        ("oil", PLANE),  # table of a raceway's oil, or of friction and oil at the cage
        ("film", PLANE),  # table of ln h and the asperities' share
        # Of the paper's closed form, see `macroslip.contact.closed_form.BarusCrook`:
        ("conductance", "f8"),  # 2π a b η0 over Q^(2/3) [N^(1/3) s]
        ("pressure_exponent", "f8"),  # α_p p0 over Q^(1/3) [N^(−1/3)]
        ("heating", "f8"),  # √(β η0/(8k)) [s/m]; zero without heating
        ("boundary_friction", "f8"),  # µ_b [-]
        ("full_slip", "f8"),  # slip from which on asperities slide [m/s]
        ("push", "f8"),  # pull of rolling resistance on the roller's centre over its shear [-]
        ("curvature", "f8"),  # κ r/u2, power by the lag over lag and ring speed [-]
        ("spin_ratio", "f8"),  # s/u2, −power by the skew moment over moment and ring speed [1/m]
    ]
)
#: The contact of a tapered roller with its rib.
RIB = np.dtype(
    [
        ("traction", TRACTION),  # table of its traction
        ("share", "f8"),  # load of the rib over that of the outer raceway [-]
        ("speed", "f8"),  # speed of the rib over that of the raceways past the roller [-]
        ("arm", "f8"),  # e, arm of its friction about the roller's axis over r [-]
        ("pull", "f8"),  # g, arm of its friction about the bearing's axis over R̃ [-]
    ]
)
#: Waves of an outer ring out of round, as `RingGeometry` has them.
WAVES = ("second_x", "second_y", "third_x", "third_y")
#: Numbers of a `RollerModel` as compiled functions take them, and what tables and laws add.
BODY = np.dtype(
    [
        ("radius", "f8"),  # r [m]
        ("mobility", "f8"),  # r²/I_z' [1/kg]
        ("stiffness", "f8"),  # K of inner and outer contact in series [N/m^1.5]
        ("cos_contact_angle", "f8"),  # cos α [-]
        ("sin_contact_angle", "f8"),  # s sin α, s the row's axial sign [-]
        ("radial_play", "f8"),  # half the diametral clearance [m]
        ("orbit_ratio", "f8"),  # Ω/Ω_in of pure rolling [-]
        ("outer_radius", "f8"),  # r~_out [m]
        ("weight_in_plane", "f8"),  # weight's part along −Y0 [N]
        ("weight_along_axis", "f8"),  # weight's part along +Z0 [N]
        ("centrifugal", "f8"),  # m r~ [kg m]
        ("drag", "f8"),  # ½ C_D ρ f A r~² [N s²]
        ("line_stiffness", "f8"),  # C of line contacts [N/m^(10/9)]; 0 with elliptical ones
        ("profile_depth", "f8"),  # depth of the profile of line contacts [m]
        ("second_x", "f8"),  # c2 cos 2ψ of an outer ring out of round [m]
        ("second_y", "f8"),  # c2 sin 2ψ of an outer ring out of round [m]
        ("third_x", "f8"),  # c3 cos 3ψ of an outer ring out of round [m]
        ("third_y", "f8"),  # c3 sin 3ψ of an outer ring out of round [m]
        ("closed_form", "i8"),  # 1 where traction has the paper's closed form
        ("microslip", "i8"),  # 1 where slip varies over the raceway contacts
        ("oily", "i8"),  # 1 with rolling resistance
        ("compliance", "f8"),  # K^(−2/3): elastic approach over load^(2/3) [m/N^(2/3)]
        ("faded_load", "f8"),  # elastic load from which on the films' load is negligible [N]
        # Reciprocal of the largest body force along the contact normal [1/N], 0 without one.
        ("per_body_force", "f8"),
        # Play above which film load is zero at any speed [m], by raceway that the body force loads
        # (outer, inner) and by body force, as `reach_forces` returns it.
        ("film_reach", "f8", (2, REACH_NODES)),
        ("highest_load", "f8"),  # largest load of the tables [N]
        ("highest_speed", "f8"),  # largest speed w of the tables [m/s]
        ("inner", CONTACT),  # contact with the inner raceway
        ("outer", CONTACT),  # contact with the outer raceway
        ("cage", CONTACT),  # contact with the cage
        ("ribbed", "i8"),  # 1 for a tapered roller
        ("rib", RIB),  # contact with the rib
    ]
)


class RibNumbers(NamedTuple):
    """Numbers of a tapered roller's rib contact that do not depend on its load."""

    share: float  #: Load of the rib over that of the outer raceway [-]
    speed: float  #: Speed of the rib over that of the raceways past the roller, R_P/R_i [-]
    arm: float  #: e = ρ_P/r, arm of its friction about the roller's axis over r [-]
    pull: float  #: g = 1 + ζ_P sin α/R̃, its arm about the bearing's axis over R̃ [-]


@dataclass(frozen=True)
class RollerModel:
    """One roller on its imposed orbit."""

    radius: float  #: r [m]
    #: r²/I_z' [1/kg], acceleration of the contact's surface speed per tangential force
    mobility: float
    #: K of inner and outer contact in series [N/m^1.5]; with line contacts of the ellipses for them
    stiffness: float
    cos_contact_angle: float  #: cos α [-]
    sin_contact_angle: float  #: s sin α, s the row's axial sign [-]
    radial_play: float  #: Half the diametral clearance [m]
    orbit_ratio: float  #: Ω/Ω_in = r~_in/(r~_in + r~_out) [-]
    outer_radius: float  #: r~_out [m]
    weight_in_plane: float  #: Part of the roller's weight in the bearing plane, along −Y0 [N]
    weight_along_axis: float  #: Part of the roller's weight along +Z0 [N]
    centrifugal: float  #: m r~ [kg m]; times Ω² it is the centrifugal force (21)-(23)
    drag: float  #: ½ C_D ρ f A r~² [N s²]; times Ω² it is the drag (24)-(26)
    second_x: float  #: c2 cos 2ψ of an outer ring out of round [m]
    second_y: float  #: c2 sin 2ψ of an outer ring out of round [m]
    third_x: float  #: c3 cos 3ψ of an outer ring out of round [m]
    third_y: float  #: c3 sin 3ψ of an outer ring out of round [m]
    line_stiffness: float  #: C of line contacts [N/m^(10/9)]; 0 with elliptical ones
    profile_depth: float  #: Depth of the profile of line contacts [m]
    laws: PreparedLaws  #: Of the three contacts
    rib: RibNumbers | None = None  #: Of a tapered roller

    @property
    def curved(self) -> bool:
        """Whether slip may vary over its contacts, or asperities touch."""
        return self.laws.inner.curved


class Roller(NamedTuple):
    """A roller as compiled functions take it."""

    body: np.ndarray  #: Shape (1,), of `BODY`. Its numbers and laws
    tables: np.ndarray  #: The flat array of its tables


class TableReport(NamedTuple):
    """Errors and size of a roller's tables, as a result reports them."""

    typical_error: float  #: Median of the relative errors of force and power [-]
    worst_error: float  #: Largest of these [-]
    size: int  #: Size of the tables [bytes]


def ring_geometry(bearing: Bearing, model: RollerModel) -> RingGeometry:
    """Geometry and stiffness of a bearing for the balance of its ring.

    Parameters
    ----------
    bearing : Bearing
    model : RollerModel
        A roller of the first row.

    Returns
    -------
    macroslip.ring.balance.RingGeometry
    """
    count = bearing.rollers_per_row
    rows = row_names(bearing)
    angles = np.concatenate([initial_angles(row, count) for row in rows])
    signs = np.repeat([AXIAL_SIGNS[row] for row in rows], count)
    return RingGeometry(
        cosine=np.cos(angles),
        sine=np.sin(angles),
        axial=signs * model.sin_contact_angle,
        cos_contact_angle=model.cos_contact_angle,
        radial_play=model.radial_play,
        stiffness=model.stiffness,
        orbit_ratio=model.orbit_ratio,
        line_stiffness=model.line_stiffness,
        profile_depth=model.profile_depth,
        **{name: getattr(model, name) for name in WAVES},
    )


def roller_model(
    bearing: Bearing,
    lubricant: Lubricant,
    axial_sign: int,
    *,
    tilt: float,
    gravity: bool = True,
    drag: bool = True,
    laws: Laws = Laws.paper(),
) -> RollerModel:
    """Numbers and laws of a roller of one row on its imposed orbit.

    The drag (24)-(26) acts on the area 2 r l with the density of the lubricant times its fill
    factor.

    Parameters
    ----------
    bearing : Bearing
        Its dimensions and materials.
    lubricant : Lubricant
        The oil of the contacts, and of the drag.
    axial_sign : int
        +1 for the downwind and −1 for the upwind row.
    tilt : float
        Tilt of the shaft [rad]: the hub end is up, so that weight has a part along +Z0.
    gravity : bool
        Whether the roller has weight.
    drag : bool
        Whether the lubricant resists its orbit.
    laws : Laws
        The chosen mechanisms.

    Returns
    -------
    RollerModel
        The roller, in SI units.

    Raises
    ------
    InputError
        For unknown laws, values the lubricant lacks, or curvatures that do not make a Hertz
        contact.
    """
    radius = geometry.roller_radius(bearing)
    mass = geometry.roller_mass(bearing.density, radius, bearing.roller_length)
    prepared = prepare(laws, bearing, lubricant, axial_sign)
    weight = mass * GRAVITY if gravity else 0.0
    density = lubricant.fill_factor * lubricant.density if drag else 0.0
    area = 2.0 * radius * bearing.roller_length
    second = bearing.out_of_round_second or 0.0
    third = bearing.out_of_round_third or 0.0
    crest = bearing.out_of_round_angle or 0.0
    line_stiffness, profile_depth = _line_numbers(bearing)
    return RollerModel(
        radius=radius,
        mobility=radius**2 / geometry.spin_inertia(mass, radius),
        stiffness=series_stiffness(prepared.inner.interface.hertz, prepared.outer.interface.hertz),
        cos_contact_angle=math.cos(bearing.contact_angle),
        sin_contact_angle=axial_sign * math.sin(bearing.contact_angle),
        radial_play=0.5 * bearing.diametral_clearance,
        orbit_ratio=geometry.orbit_ratio(bearing),
        outer_radius=geometry.outer_contact_radius(bearing),
        weight_in_plane=weight * math.cos(tilt),
        weight_along_axis=weight * math.sin(tilt),
        centrifugal=mass * bearing.pitch_radius,
        drag=0.5 * lubricant.drag_coefficient * density * area * bearing.pitch_radius**2,
        second_x=second * math.cos(2.0 * crest),
        second_y=second * math.sin(2.0 * crest),
        third_x=third * math.cos(3.0 * crest),
        third_y=third * math.sin(3.0 * crest),
        line_stiffness=line_stiffness,
        profile_depth=profile_depth,
        laws=prepared,
        rib=_rib_numbers(bearing) if prepared.rib else None,
    )


def _line_numbers(bearing: Bearing) -> tuple[float, float]:
    """C and d of the line contacts of a cylindrical roller, 0 with elliptical ones.

    Of a tapered roller too: the balance of its ring finds its loads.
    """
    if bearing.kind != "cylindrical" or not bearing.touches_along_line:
        return 0.0, 0.0
    inner, _ = strips_of(bearing)
    return inner.coefficient * inner.length, inner.depth


def _rib_numbers(bearing: TaperedBearing) -> RibNumbers:
    """Numbers of the rib of a tapered roller bearing."""
    row = tapered_geometry(bearing)
    return RibNumbers(
        share=row.rib_share,
        speed=row.rib_radius / row.inner_radius,
        arm=row.rib_radius_on_roller / row.roller_radius,
        pull=1.0 + row.rib_station * math.sin(row.axis_angle) / row.pitch_radius,
    )


def body_force(model: RollerModel, shaft_speed: float) -> float:
    """Largest weight and centrifugal force of a roller [N] up to a shaft speed [rad/s]."""
    weight = abs(model.weight_in_plane) + abs(model.weight_along_axis)
    return weight + model.centrifugal * (model.orbit_ratio * shaft_speed) ** 2


def with_tables(
    models: dict[str, RollerModel], box: Box, pocket_gap: float = POCKET_GAP
) -> tuple[dict[str, Roller], TableReport]:
    """Rollers of both rows with the tables of their contacts.

    Tables are made, or read from the cache.

    Parameters
    ----------
    models : dict of RollerModel
        By row, of the same bearing, oil and laws.
    box : Box
        States that the tables hold.
    pocket_gap : float
        Largest gap between a roller and its spar [m].

    Returns
    -------
    rollers : dict of Roller
        By row.
    report : TableReport
    """
    tables = Tables()
    rollers = {}
    errors = []
    first = np.zeros(1, BODY)
    model = next(iter(models.values()))
    for name in ("inner", "outer", "cage"):
        errors += _write_contact(first[0][name], tables, getattr(model.laws, name), box, pocket_gap)
    if model.rib and model.laws.rib:
        errors.append(_write_rib(first[0], tables, model.laws.rib, model.rib, box))
    flat = tables.flat()
    for row, row_model in models.items():
        body = first.copy()
        _write_numbers(body[0], row_model, box)
        rollers[row] = Roller(body, flat)
    if body[0]["oily"]:
        most = _largest_body_force(model, box)
        load = _faded_load(rollers, most, box)
        reach = _film_reach(rollers, most, box)
        for roller in rollers.values():
            roller.body[0]["faded_load"] = load
            roller.body[0]["per_body_force"] = 1.0 / most if most > 0.0 else 0.0
            roller.body[0]["film_reach"] = reach
    typical = max((error.typical for error in errors), default=0.0)
    worst = max((error.worst for error in errors), default=0.0)
    return rollers, TableReport(typical, worst, flat.nbytes)


def _write_rib(
    body: np.void, tables: Tables, law: PreparedContact, rib: RibNumbers, box: Box
) -> TableErrors:
    """Write table and numbers of a tapered roller's rib; the errors of its table."""
    body["ribbed"] = 1
    for name in RibNumbers._fields:
        body["rib"][name] = getattr(rib, name)
    # Coarse bounds, so that loads and speeds a little apart share their table.
    load = 2.0 ** math.ceil(math.log2(rib.share * box.load))
    own = box._replace(
        load=load, slowest=rib.speed * box.slowest, fastest=round(rib.speed * box.fastest, 12)
    )
    return write_traction(body["rib"]["traction"], tables, law, own)


def _write_contact(
    record: np.void, tables: Tables, contact: PreparedContact, box: Box, pocket_gap: float
) -> list[TableErrors]:
    """Write tables and numbers of one contact; the errors of its traction's table, if any."""
    errors = []
    record["boundary_friction"] = contact.boundary_friction
    record["full_slip"] = contact.full_slip
    slowest = _SLOWEST * box.fastest
    # With the closed form every evaluation looks the film up. Elsewhere samples of contacts do, for
    # which the spacing of the coarsest tables serves at any tolerance: ln h is good to 1e-4.
    film_box = box if contact.closed_form is not None else box._replace(fineness=COARSEST)
    films = partial(film_values, contact)
    write_plane(record["film"], tables, films, _LIGHTEST, REST_SPEED, film_box)
    if contact.closed_form is not None:
        for name in ("conductance", "pressure_exponent", "heating"):
            record[name] = getattr(contact.closed_form, name)
    elif contact.name != "cage":
        errors.append(write_traction(record["traction"], tables, contact, box))
    if contact.name == "cage":
        write_plane(
            record["oil"],
            tables,
            partial(cage_values, contact, pocket_gap),
            _LIGHTEST,
            slowest,
            box,
        )
    elif contact.rolling is not None:
        write_plane(record["oil"], tables, partial(oil_values, contact), _LIGHTEST, slowest, box)
        # Beside its shear the inclined pressure pushes by −2 R/r of it.
        record["push"] = 1.0 - 2.0 * contact.rolling.share_1
    return errors


def _write_numbers(body: np.void, model: RollerModel, box: Box) -> None:
    for member in fields(model):
        if member.type == "float":
            body[member.name] = getattr(model, member.name)
    laws = model.laws
    body["closed_form"] = laws.inner.closed_form is not None
    body["microslip"] = laws.inner.shape.microslip
    body["oily"] = laws.inner.rolling is not None
    body["compliance"] = model.stiffness ** (-2.0 / 3.0)
    body["faded_load"] = math.inf
    body["film_reach"] = math.inf
    body["highest_load"] = box.load
    body["highest_speed"] = box.fastest
    for name in ("inner", "outer"):
        shape = getattr(laws, name).shape
        if shape.microslip:
            body[name]["curvature"] = shape.curvature_ratio * shape.roller_radius
            body[name]["spin_ratio"] = shape.spin_ratio
            body[name]["traction"]["side"] = math.copysign(1.0, shape.spin_ratio)


def _largest_body_force(model: RollerModel, box: Box) -> float:
    """Largest body force along the contact normal in all states of the box [N]."""
    return body_force(model, box.fastest / (model.orbit_ratio * model.outer_radius))


def _faded_load(rollers: dict[str, Roller], most: float, box: Box) -> float:
    """Elastic load [N] from which on the film load is negligible, for all states of the box.

    Films grow with speed, and carry more the less the body force, up to `most` [N], presses on one
    of them.
    """
    roller = next(iter(rollers.values()))
    load = 1.0
    while not all(
        film_load_is_negligible(
            roller.body[0], roller.tables.ctypes.data, load, outward, box.fastest
        )
        for outward in (-most, 0.0, most)
    ):
        load *= 1.1
    return load


def _film_reach(rollers: dict[str, Roller], most: float, box: Box) -> np.ndarray:
    """Plays above which film load is zero, as `film_reach` of `BODY` has them [m].

    Films grow with speed, and shrink with the body force, up to `most` [N], that presses on one of
    them.
    """
    roller = next(iter(rollers.values()))
    body = roller.body[0]
    tables = roller.tables.ctypes.data
    return np.array(
        [
            [film_reach(body, tables, way * force, box.fastest) for force in reach_forces(most)]
            for way in (1.0, -1.0)
        ]
    )
