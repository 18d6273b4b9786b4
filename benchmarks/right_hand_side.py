"""The slip equation with its three energies as a general ODE y' = f(t, y), compiled, for solvers of any kind.

State: y = (v [m/s], E_inner, E_outer, E_cage in a unit of energy). Everything the equation needs lies in one array of
numbers, because a solver written in C passes a pointer on and nothing else.
"""

from __future__ import annotations

import numba
import numpy as np

from benchmarks.histories import History
from macroslip.compiled import jit
from macroslip.film.masjedi_khonsari import MasjediKhonsari
from macroslip.integrate.measures import powers
from macroslip.ring.orbit import Motion, instant, interval_of
from macroslip.roller.contact_force import PlainContact
from macroslip.roller.films import NoFilms
from macroslip.roller.forces import net_force, slip_forces, station
from macroslip.roller.model import RollerModel
from macroslip.traction.barus_crook import BarusCrook

#: Places in the array: number of samples, interval found last, evaluations so far, unit of energy, start angle, model.
SAMPLES, INTERVAL, EVALUATIONS, ENERGY_UNIT, START_ANGLE, _MODEL = range(6)
_SCALARS = len(RollerModel._fields) - 4
_FILM, _TRACTION = len(MasjediKhonsari._fields), len(BarusCrook._fields)
_INNER = _MODEL + _SCALARS
_OUTER = _INNER + _FILM + _TRACTION
_CAGE = _OUTER + _FILM + _TRACTION
_MOTION = _CAGE + _FILM + _TRACTION


def pack(history: History, energy_unit: float = 1.0) -> np.ndarray:
    """All numbers of a history in one array, for `rates` and `jacobian`; the laws are the package's default ones."""
    model, motion = history.model, history.motion
    numbers = [motion.time.size, 0.0, 0.0, energy_unit, history.start_angle, *model[:_SCALARS]]
    for contact in (model.inner, model.outer, model.cage):
        numbers += [*contact.film, *contact.traction]
    series = (motion.time, motion.shaft_speed, motion.shaft_angle, motion.displacement.ravel())
    return np.concatenate([np.array(numbers), *series])


@jit
def _contact(d, k):
    return PlainContact(MasjediKhonsari(d[k], d[k + 1], d[k + 2], d[k + 3]), BarusCrook(d[k + 4], d[k + 5], d[k + 6]))


@jit
def unpack(d):
    """Model and motion from the array that `pack` makes; the motion's arrays are views of it."""
    k = _MODEL
    model = RollerModel(
        d[k],
        d[k + 1],
        d[k + 2],
        d[k + 3],
        d[k + 4],
        d[k + 5],
        d[k + 6],
        d[k + 7],
        d[k + 8],
        d[k + 9],
        d[k + 10],
        d[k + 11],
        NoFilms(),
        _contact(d, _INNER),
        _contact(d, _OUTER),
        _contact(d, _CAGE),
    )
    n = int(d[SAMPLES])
    k = _MOTION
    displacement = d[k + 3 * n : k + 6 * n].reshape(n, 3)
    return model, Motion(d[k : k + n], d[k + n : k + 2 * n], d[k + 2 * n : k + 3 * n], displacement)


@jit
def _station_at(time, d, model, motion):
    interval = interval_of(motion, time, int(d[INTERVAL]))
    d[INTERVAL] = interval
    return station(model, d[START_ANGLE], instant(motion, interval, time))


@jit
def rates(time, state, rate, d):
    """Write y' into `rate`, shape (4,).

    Parameters
    ----------
    time : float
        [s].
    state : ndarray, shape (4,)
        y.
    rate : ndarray, shape (4,)
        Filled with dv/dt [m/s²] and the powers [units of energy per second].
    d : ndarray
        From `pack`; the interval found and the count of evaluations are kept up to date in it.

    Notes
    -----
    dv/dt = du2/dt − (r²/I_z')(F_i + F_o + F_c); the shaft speed is linear between samples, so du2/dt is exact.
    """
    model, motion = unpack(d)
    at = _station_at(time, d, model, motion)
    d[EVALUATIONS] += 1.0
    k = int(d[INTERVAL])
    acceleration = (motion.shaft_speed[k + 1] - motion.shaft_speed[k]) / (motion.time[k + 1] - motion.time[k])
    forces = slip_forces(model, at, state[0])
    inner, outer, cage = powers(model, at, forces, state[0])
    rate[0] = -model.orbit_ratio * model.outer_radius * acceleration
    rate[0] -= model.mobility * net_force(forces)
    rate[1] = inner / d[ENERGY_UNIT]
    rate[2] = outer / d[ENERGY_UNIT]
    rate[3] = cage / d[ENERGY_UNIT]


@jit
def jacobian(time, state, matrix, d):
    """Write ∂y'/∂y into the first column of `matrix`, shape (4, 4); the others are zero and left alone.

    Parameters are those of `rates`. The evaluation counts as one.
    """
    model, motion = unpack(d)
    at = _station_at(time, d, model, motion)
    d[EVALUATIONS] += 1.0
    slip = state[0]
    forces = slip_forces(model, at, slip)
    surface_speed = at.ring_speed - slip
    cage_slope = forces.slope - forces.inner_slope - forces.outer_slope
    by_slip = cage_slope * surface_speed - forces.cage
    matrix[0, 0] = -model.mobility * forces.slope
    matrix[1, 0] = np.sign(forces.inner * slip) * (forces.inner_slope * slip + forces.inner) / d[ENERGY_UNIT]
    matrix[2, 0] = np.sign(forces.outer * slip) * (forces.outer_slope * slip + forces.outer) / d[ENERGY_UNIT]
    matrix[3, 0] = np.sign(forces.cage * surface_speed) * by_slip / d[ENERGY_UNIT]


def c_rates(signature, length: int) -> numba.core.ccallback.CFunc:
    """`rates` as a C function f(t, y*, y'*, d*) for histories whose array has `length` numbers."""

    def plain(time, state, rate, d):
        rates(time, numba.carray(state, (4,)), numba.carray(rate, (4,)), numba.carray(d, (length,)))

    return numba.cfunc(signature)(plain)
