"""The slip equation with its three energies as a general ODE y' = f(t, y), compiled, for solvers of any kind.

State: y = (v [m/s], E_inner, E_outer, E_cage in a unit of energy). Everything the equation needs lies in one array of
numbers, because a solver written in C passes a pointer on and nothing else. The rates are those of any roller; the Jacobian
is exact where slip is the same all over a contact, as in the paper's model, in which the comparison is made.
"""

from __future__ import annotations

import numba
import numpy as np

from benchmarks.histories import History
from macroslip.compiled import jit, jit_inline
from macroslip.mechanics.spin import (
    CONDITIONS,
    FORCES,
    net_force,
    powers,
    slip_forces,
    write_conditions,
)
from macroslip.ring.orbit import Motion, instant, interval_of
from macroslip.roller.model import BODY

#: What stands at the start of the array: number of samples, interval found last, evaluations so far, unit of energy [J], position
#: at the first sample [rad], the roller, and room for what its functions write. Motion and tables follow.
WORK = np.dtype(
    [
        ("samples", "i8"), ("interval", "i8"), ("evaluations", "i8"), ("energy_unit", "f8"), ("start_angle", "f8"),
        ("body", BODY), ("at", CONDITIONS), ("forces", FORCES), ("power", "f8", (3,)),
    ]
)  # fmt: skip
_SIZE = WORK.itemsize // 8


def pack(history: History, energy_unit: float = 1.0) -> np.ndarray:
    """All numbers of a history in one array, for `rates` and `jacobian`."""
    motion = history.motion
    work = np.zeros(1, WORK)
    work["samples"], work["energy_unit"], work["start_angle"] = (
        motion.time.size,
        energy_unit,
        history.start_angle,
    )
    work["body"] = history.roller.body
    series = (motion.time, motion.shaft_speed, motion.shaft_angle, motion.displacement.ravel())
    return np.concatenate([work.view(np.float64), *series, history.roller.tables])


def evaluations(d: np.ndarray) -> float:
    """Force evaluations so far."""
    return float(d[:_SIZE].view(WORK)["evaluations"][0])


@jit_inline
def _motion(d, samples):
    k, n = _SIZE, samples
    return Motion(
        d[k : k + n],
        d[k + n : k + 2 * n],
        d[k + 2 * n : k + 3 * n],
        d[k + 3 * n : k + 6 * n].reshape(n, 3),
    )


@jit_inline
def _evaluate(time, slip, d, work):
    """Write conditions and forces; returns du2/dt [m/s²]."""
    motion, body = _motion(d, work.samples), work.body
    k = interval_of(motion, time, work.interval)
    work.interval = k
    work.evaluations += 1
    tables = d[_SIZE + 6 * work.samples :]
    write_conditions(body, tables, work.start_angle, instant(motion, k, time), work.at)
    slip_forces(body, tables, work.at, slip, work.forces)
    acceleration = (motion.shaft_speed[k + 1] - motion.shaft_speed[k]) / (
        motion.time[k + 1] - motion.time[k]
    )
    return -body.orbit_ratio * body.outer_radius * acceleration


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
    work = d[:_SIZE].view(WORK)[0]
    rate[0] = _evaluate(time, state[0], d, work) - work.body.mobility * net_force(work.forces)
    powers(work.body, work.at, work.forces, state[0], work.power)
    for i in range(3):
        rate[i + 1] = work.power[i] / work.energy_unit


@jit
def jacobian(time, state, matrix, d):
    """Write ∂y'/∂y into the first column of `matrix`, shape (4, 4); the others are zero and left alone.

    Parameters are those of `rates`. The evaluation counts as one.
    """
    work = d[:_SIZE].view(WORK)[0]
    slip = state[0]
    _evaluate(time, slip, d, work)
    forces = work.forces
    surface_speed = work.at.ring_speed - slip
    cage_slope = forces.slope - forces.inner_slope - forces.outer_slope
    by_slip = cage_slope * surface_speed - forces.cage
    matrix[0, 0] = -work.body.mobility * forces.slope
    matrix[1, 0] = (
        np.sign(forces.inner * slip) * (forces.inner_slope * slip + forces.inner) / work.energy_unit
    )
    matrix[2, 0] = (
        np.sign(forces.outer * slip) * (forces.outer_slope * slip + forces.outer) / work.energy_unit
    )
    matrix[3, 0] = np.sign(forces.cage * surface_speed) * by_slip / work.energy_unit


def c_rates(signature, length: int) -> numba.core.ccallback.CFunc:
    """`rates` as a C function f(t, y*, y'*, d*) for histories whose array has `length` numbers."""

    def plain(time, state, rate, d):
        rates(time, numba.carray(state, (4,)), numba.carray(rate, (4,)), numba.carray(d, (length,)))

    return numba.cfunc(signature)(plain)
