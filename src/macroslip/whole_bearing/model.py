"""Everything about a bearing with its cages that does not change with time, as tuples for the compiled kernels."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from macroslip.bearing import geometry
from macroslip.bearing.geometry import AXIAL_SIGNS, ROWS, initial_angles
from macroslip.constants import GRAVITY
from macroslip.mechanisms import Laws
from macroslip.roller.films import Films, NoFilms
from macroslip.roller.model import interfaces, roller_model
from macroslip.whole_bearing.cage import Cage, inner_radii
from macroslip.whole_bearing.pocket import Pocket, prepare_pocket

if TYPE_CHECKING:
    from macroslip.bearing import Bearing
    from macroslip.lubricant import Lubricant


class Rollers(NamedTuple):
    """What differs between rollers; downwind row first.

    Attributes
    ----------
    row, cage : ndarray of int, shape (n,)
        Index of the roller's row and of its cage.
    angle, cosine, sine : ndarray, shape (n,)
        Of its pocket at the first sample [rad], with its cosine and sine.
    inner_radius : ndarray, shape (n,)
        Effective r~_in [m], see `macroslip.whole_bearing.cage.inner_radii`.
    """

    row: np.ndarray
    cage: np.ndarray
    angle: np.ndarray
    cosine: np.ndarray
    sine: np.ndarray
    inner_radius: np.ndarray


class RowModels(NamedTuple):
    """A `RollerModel` of each row."""

    downwind: Any
    upwind: Any


class WholeBearing(NamedTuple):
    """All rollers, pockets and cages.

    Attributes
    ----------
    models : RowModels
    bodies : tuple of two RollerModel
        The same without contacts and films: kernels pick a row's numbers out of these without copying its contacts.
    films : Films or NoFilms
        The oil around a roller, the same in both rows; in the pockets as wide as their play leaves it.
    rollers : Rollers
    pocket : Pocket
    roller_mass, radius, pitch_radius, inner_radius, outer_radius : float
        m [kg]; r, r~ and nominal r~_in, r~_out [m].
    lever : float
        r cos α/r~ [-].
    cages : int
        Number of cages, one or two.
    cage_mass : float
        Of one cage [kg].
    cage_weight : float
        Weight of one cage in the bearing plane, along −Y0 [N].
    translates : bool
        Whether the cages can leave the bearing's axis, see `macroslip.whole_bearing.guidance`.
    radial_play : float
        Distance by which a cage can leave the axis before rollers hold it radially [m].
    guide_friction : float
        Brakes each cage at the pitch radius [N].
    """

    models: Any
    bodies: Any
    films: Any
    rollers: Rollers
    pocket: Pocket
    roller_mass: float
    radius: float
    pitch_radius: float
    inner_radius: float
    outer_radius: float
    lever: float
    cages: int
    cage_mass: float
    cage_weight: float
    translates: bool
    radial_play: float
    guide_friction: float


def _pocket_films(films: Films | NoFilms, pocket: Pocket) -> Films | NoFilms:
    """The films with the true width of the pockets; without play roughness keeps surfaces apart."""
    if isinstance(films, NoFilms):
        return films
    return films._replace(pocket_gap=max(pocket.half_gap, pocket.least_film))


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
    """Prepare a bearing with its cages; parameters as for `macroslip.roller.model.roller_model`.

    Raises
    ------
    InputError
        If the pockets do not fit, and as `roller_model`.
    """
    cage.check_fit(bearing)
    count = bearing.rollers_per_row
    models = RowModels(
        *(
            roller_model(bearing, lubricant, AXIAL_SIGNS[row], tilt=tilt, gravity=gravity, drag=drag, laws=laws)
            for row in ROWS
        )
    )
    angles = np.concatenate([initial_angles(row, count) for row in ROWS])
    row = np.repeat(np.arange(len(ROWS)), count)
    cages = 2 if cage.arrangement == "per-row" else 1
    radius = geometry.roller_radius(bearing)
    weighs = gravity and cage.weight
    pocket = prepare_pocket(cage, bearing, lubricant, interfaces(bearing, lubricant)[2].hertz.stiffness)
    return WholeBearing(
        models=models,
        bodies=tuple(model._replace(films=0.0, inner=0.0, outer=0.0, cage=0.0) for model in models),
        films=_pocket_films(models[0].films, pocket),
        rollers=Rollers(
            row=row,
            cage=row if cages == 2 else np.zeros_like(row),
            angle=angles,
            cosine=np.cos(angles),
            sine=np.sin(angles),
            inner_radius=inner_radii(bearing, cage.diameter_deviations(count).ravel()),
        ),
        pocket=pocket,
        roller_mass=2.0 / models[0].mobility,
        radius=radius,
        pitch_radius=bearing.pitch_radius,
        inner_radius=geometry.inner_contact_radius(bearing),
        outer_radius=geometry.outer_contact_radius(bearing),
        lever=radius * math.cos(bearing.contact_angle) / bearing.pitch_radius,
        cages=cages,
        cage_mass=float(cage.mass) / cages,
        cage_weight=float(cage.mass) / cages * GRAVITY * math.cos(tilt) if weighs else 0.0,
        translates=weighs,
        radial_play=float(cage.gap),
        guide_friction=float(cage.guide_friction),
    )


def with_rollers(bearing: WholeBearing, models: RowModels) -> WholeBearing:
    """The bearing with the same rollers given otherwise (by tables, for example), made from the bearing's own `films`."""
    return bearing._replace(models=models, films=models.downwind.films)
