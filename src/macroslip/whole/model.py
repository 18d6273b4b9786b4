"""A bearing with its cages: all that does not change with time.

It is prepared as a frozen object and as records for compiled functions.
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

_NUMBERS = (
    "roller_mass", "radius", "pitch_radius", "inner_radius", "outer_radius", "orbit_ratio", "lever", "cage_mass",
    "cage_weight", "radial_play", "guide_friction", "land_drag", "land_turns",
)  # fmt: skip
#: The numbers of a `WholeBearing`.
BEARING = np.dtype(
    [
        *((name, "f8") for name in _NUMBERS),
        ("cages", "i8"),
        ("translates", "i8"),
        ("pocket", POCKET),
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
    """All rollers, pockets and cages."""

    models: dict[str, RollerModel]  #: By row
    positions: np.ndarray  #: Shape (n,). Rollers, downwind row first.
    pocket: Pocket
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

    bearing: np.ndarray  #: shape (1,)
    bodies: np.ndarray  #: Shape (rows,). A roller of each row.
    tables: np.ndarray  #: The flat array of their tables
    positions: np.ndarray  #: shape (n,)
    #: Addresses of the evaluations of a raceway contact and of a cage's contact, see
    #: `macroslip.whole.tractions`.
    evaluate_raceway: int
    evaluate_cage: int


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
    for name in (*_NUMBERS, "cages", "translates"):
        numbers[name] = getattr(bearing, name)
    numbers["pocket"] = tuple(pocket)
    bodies = np.concatenate([roller.body for roller in rollers.values()])
    tables = next(iter(rollers.values())).tables
    return Assembly(numbers, bodies, tables, bearing.positions, *addresses_of_evaluations()), report
