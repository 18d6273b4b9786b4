"""A bearing with its cages: the numbers that do not change with time.

They are prepared as a frozen object and as records for compiled functions.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from macroslip.bearing import Bearing, geometry
from macroslip.bearing.geometry import AXIAL_SIGNS, initial_angles, row_names
from macroslip.constants import GRAVITY
from macroslip.contact.mechanisms import Laws
from macroslip.contact.table import Box
from macroslip.lubricant import Lubricant
from macroslip.roller.model import RollerModel, TableReport, roller_model
from macroslip.roller.model import with_tables as rollers_with_tables
from macroslip.whole.cage import Cage, inner_radii
from macroslip.whole.pocket import POCKET, Pocket, prepare_pocket
from macroslip.whole.tractions import addresses_of_evaluations

#: Numbers of a `WholeBearing` as compiled functions take them.
BEARING = np.dtype(
    [
        ("roller_mass", "f8"),  # m [kg]
        ("radius", "f8"),  # r [m]
        ("pitch_radius", "f8"),  # r~ [m]
        ("inner_radius", "f8"),  # nominal r~_in [m]
        ("outer_radius", "f8"),  # r~_out [m]
        ("orbit_ratio", "f8"),  # Ω/Ω_in of pure rolling [-]
        ("lever", "f8"),  # r cos α/r~ [-]
        ("cage_mass", "f8"),  # M_c, mass of one cage [kg]
        ("cage_weight", "f8"),  # weight of one cage in the bearing plane, along −Y0 [N]
        ("radial_play", "f8"),  # distance from the axis at which rollers hold a cage [m]
        ("guide_friction", "f8"),  # friction of each cage's guide at the pitch radius [N]
        ("land_drag", "f8"),  # drag of a ring's land on each cage at the pitch radius [N s/m]
        ("land_turns", "f8"),  # 1 where that ring is the inner one, which turns; otherwise 0
        ("cages", "i8"),  # number of cages
        ("translates", "i8"),  # 1 where the cages can leave the bearing's axis; otherwise 0
        ("pocket", POCKET),  # forces between a roller and the spars of its pocket
    ]
)
#: Numbers that differ between rollers.
POSITION = np.dtype(
    [
        ("row", "i8"),  # index of its row
        ("cage", "i8"),  # index of its cage
        ("angle", "f8"),  # of its pocket at the first sample [rad]
        ("cosine", "f8"),  # of that angle
        ("sine", "f8"),  # of that angle
        ("inner_radius", "f8"),  # effective r~_in [m], see `macroslip.whole.cage.inner_radii`
    ]
)


@dataclass(frozen=True)
class WholeBearing:
    """Rollers, pockets and cages of a bearing."""

    models: dict[str, RollerModel]  #: By row
    positions: np.ndarray  #: Shape (n,). Rollers, downwind row first.
    pocket: Pocket  #: Forces between a roller and its spars
    roller_mass: float  #: m [kg]
    radius: float  #: r [m]
    pitch_radius: float  #: r~ [m]
    inner_radius: float  #: Nominal r~_in [m]
    outer_radius: float  #: r~_out [m]
    orbit_ratio: float  #: Ω/Ω_in of pure rolling [-]
    lever: float  #: r cos α/r~ [-]
    cages: int  #: Number of cages, one or two
    cage_mass: float  #: Of one cage [kg]
    cage_weight: float  #: Weight of one cage in the bearing plane, along −Y0 [N]
    translates: bool  #: Whether the cages can leave the bearing's axis, see `macroslip.whole.cage`
    #: Distance by which a cage can leave the axis before rollers hold it radially [m]
    radial_play: float
    guide_friction: float  #: Brakes each cage at the pitch radius [N]
    #: Of a ring's land on each cage at the pitch radius [N s/m], see `macroslip.whole.cage.Cage`
    land_drag: float
    land_turns: float  #: 1 where that ring is the inner one, which turns; otherwise 0


class Assembly(NamedTuple):
    """A bearing with its cages as compiled functions take it."""

    bearing: np.ndarray  #: Shape (1,), of `BEARING`. Numbers of the bearing
    bodies: np.ndarray  #: Shape (rows,), of `macroslip.roller.model.BODY`. A roller of each row
    tables: np.ndarray  #: The flat array of their tables
    positions: np.ndarray  #: Shape (n,), of `POSITION`. Numbers of each roller
    evaluate_raceway: int  #: Address of the function that evaluates a raceway contact
    evaluate_cage: int  #: Address of the function that evaluates a cage's contact


def whole_bearing(
    bearing: Bearing,
    lubricant: Lubricant,
    cage: Cage,
    *,
    tilt: float,
    laws: Laws,
    gravity: bool = True,
    drag: bool = True,
) -> WholeBearing:
    """Prepare a bearing with its cages.

    Parameters
    ----------
    bearing : Bearing
    lubricant : Lubricant
    cage : Cage
    tilt : float
        Angle of the shaft [rad]; the hub end is up where it is positive.
    laws : Laws
        Laws of the contacts.
    gravity : bool
        Whether rollers, and the cage if `cage.weight` says so, have weight.
    drag : bool
        Whether oil drags on the rollers along their orbit.

    Returns
    -------
    WholeBearing

    Raises
    ------
    InputError
        Pockets that do not fit between the rollers, unknown laws, values that the lubricant lacks,
        or curvatures that do not make a Hertz contact.
    """
    cage.check_fit(bearing)
    count = bearing.rollers_per_row
    names = row_names(bearing)
    models = {
        row: roller_model(
            bearing, lubricant, AXIAL_SIGNS[row], tilt=tilt, gravity=gravity, drag=drag, laws=laws
        )
        for row in names
    }
    model = models[names[0]]
    cages = len(names) if cage.arrangement == "per-row" else 1
    weighs = gravity and cage.weight
    positions = np.zeros(len(names) * count, POSITION)
    positions["row"] = np.repeat(np.arange(len(names)), count)
    positions["cage"] = positions["row"] if cages > 1 else 0
    positions["angle"] = np.concatenate([initial_angles(row, count) for row in names])
    positions["cosine"] = np.cos(positions["angle"])
    positions["sine"] = np.sin(positions["angle"])
    positions["inner_radius"] = inner_radii(
        bearing, cage.diameter_deviations(len(names), count).ravel()
    )
    return WholeBearing(
        models=models,
        positions=positions,
        pocket=prepare_pocket(cage, bearing, lubricant, model.laws.cage.interface.hertz.stiffness),
        roller_mass=2.0 / model.mobility,
        radius=model.radius,
        pitch_radius=bearing.pitch_radius,
        inner_radius=geometry.inner_contact_radius(bearing),
        outer_radius=model.outer_radius,
        orbit_ratio=model.orbit_ratio,
        lever=model.radius * math.cos(bearing.contact_angle) / bearing.pitch_radius,
        cages=cages,
        cage_mass=float(cage.mass) / cages,
        cage_weight=float(cage.mass) / cages * GRAVITY * math.cos(tilt) if weighs else 0.0,
        translates=weighs if cage.axis is None else cage.axis == "free",
        radial_play=float(cage.gap if cage.land_clearance is None else 0.5 * cage.land_clearance),
        guide_friction=float(cage.guide_friction),
        land_drag=cage.land_drag(bearing.pitch_radius, lubricant.viscosity) / cages,
        land_turns=float(cage.guided_by == "inner-ring"),
    )


def with_tables(bearing: WholeBearing, box: Box) -> tuple[Assembly, TableReport]:
    """The bearing with tables of its contacts for the states of a box.

    The oil in a pocket is as wide as its play leaves it; without play roughness keeps surfaces
    apart.
    """
    pocket = bearing.pocket
    # Rollers run through their play beside the motion of the rings: ahead as fast as they fall
    # through it, and behind up to twice as fast, where oil brakes them too.
    fall = math.sqrt(2.0 * GRAVITY * bearing.radial_play)
    slowest = max(box.slowest - 2.0 * fall, 0.0)
    box = box._replace(slowest=slowest, fastest=box.fastest + fall)
    rollers, report = rollers_with_tables(
        bearing.models, box, max(pocket.half_gap, pocket.least_film)
    )
    numbers = np.zeros(1, BEARING)
    for name in BEARING.names or ():
        value = getattr(bearing, name)
        numbers[name] = tuple(value) if name == "pocket" else value
    bodies = np.concatenate([roller.body for roller in rollers.values()])
    tables = next(iter(rollers.values())).tables
    return Assembly(numbers, bodies, tables, bearing.positions, *addresses_of_evaluations()), report
