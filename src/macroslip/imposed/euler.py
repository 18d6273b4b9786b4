"""The paper's two Euler methods on the spin, over a whole history at a fixed step.

Explicit Euler is unstable in the load zone (the paper's Appendix A). Backward Euler has a hidden parameter, where its
iteration stops: a change of spin that looks negligible is a large force in a gripped contact, because dF/dv reaches
1e13 N s/m there. Slip is formed as u2 − r ω and so carries the round-off of the surface speeds; that is part of both methods.
"""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.imposed.radau import forces_of, station_of
from macroslip.imposed.status import COMPLETED, IMPOSSIBLE_SLIP, NO_ROOT, NOT_FINITE, UNDER_WAY
from macroslip.imposed.tuning import SECANT_ITERATIONS
from macroslip.ring.orbit import interval_of
from macroslip.roller.forces import net_force, powers
from macroslip.roller.step import write_stage

#: Rule and bounds.
#:
#: step : [s]
#: implicit : 1 for backward Euler, 0 for explicit Euler
#: tolerance : of the nonlinear iteration of backward Euler, relative change of spin
#: largest_slip : slip beyond which the integration stops as unstable [m/s]. Friction pulls a roller's surface towards the speed of
#:     the rings and of the cage only, so its true slip never leaves the range these speeds span.
#: end : of the integration [s]; the last step is shortened to meet it
RULE = np.dtype([("step", "f8"), ("implicit", "i8"), ("tolerance", "f8"), ("largest_slip", "f8"), ("end", "f8")])


@jit_inline
def _defect(path, at, before, spin, step):
    """ω − ω_n − h (r/I_z') (F_i + F_o + F_c)(ω) [rad/s]."""
    body = path.body
    forces = forces_of(path, at, at.ring_speed - body.radius * spin)
    return spin - before - step * body.mobility / body.radius * net_force(forces)


@jit
def backward_euler_step(path, at, spin, step, tolerance):
    """Spin after one implicit step of I_z' dω/dt = r (F_i + F_o + F_c) (16).

    Parameters
    ----------
    path : Path
    at : Station
        At the end of the step.
    spin : float
        ω at the start, relative to the orbiting frame [rad/s].
    step : float
        [s].
    tolerance : float
        The iteration stops when ω changes by less than this part of itself.

    Returns
    -------
    spin : float
        ω after the step [rad/s]; NaN if the iteration did not stop.
    evaluations : int
        Force evaluations used.
    defect : float
        Force the stopped iteration leaves unbalanced [N].

    Notes
    -----
    The iteration is the secant method started from the last spin, as MINPACK's hybrid method reduces to in one unknown,
    held inside a bracket once there is one.
    """
    to_force = path.body.radius / (step * path.body.mobility)
    older = spin
    older_defect = _defect(path, at, spin, older, step)
    newer = older + 1.5e-8 * max(abs(older), 1e-3)
    newer_defect = _defect(path, at, spin, newer, step)
    evaluations = 2
    low, high = -math.inf, math.inf
    for _ in range(SECANT_ITERATIONS):
        for candidate, defect in ((older, older_defect), (newer, newer_defect)):
            if defect <= 0.0 and candidate > low:
                low = candidate
            if defect >= 0.0 and candidate < high:
                high = candidate
        slope = newer_defect - older_defect
        trial = newer - newer_defect * (newer - older) / slope if slope != 0.0 else newer - newer_defect
        if not low <= trial <= high and math.isfinite(low) and math.isfinite(high):
            trial = 0.5 * (low + high)
        if not math.isfinite(trial):
            break
        change = abs(trial - newer)
        older, older_defect = newer, newer_defect
        newer, newer_defect = trial, _defect(path, at, spin, trial, step)
        evaluations += 1
        if change <= tolerance * abs(newer) or newer_defect == 0.0 or newer == older:
            return newer, evaluations, abs(newer_defect) * to_force
    return math.nan, evaluations, math.inf


@jit
def integrate_fixed_step(path, memory, steps):
    """Integrate the spin of one roller with explicit or backward Euler, until its history ends or the buffer is full.

    Parameters
    ----------
    path : Path
        With a `RULE` for limits.
    memory : record of `macroslip.imposed.solve.MEMORY`
        Zeros but for the slip at the first sample; then as the last call left it.
    steps : ndarray of `STEP`, shape (m,)
        Filled from the start, with one stage a step: the state at which its forces are evaluated, its start or its end.

    Returns
    -------
    status : int
        A `Status`; UNDER_WAY where the buffer is full.
    count : int
        Rows that were written.
    """
    body, motion, rule = path.body, path.motion, path.limits
    start = motion.time[0]
    if memory.begun == 0:
        memory.time, memory.begun = start, 1
        memory.spin = (station_of(path, start, 0).ring_speed - memory.slip) / body.radius
    at, spin = station_of(path, memory.time, memory.interval), memory.spin
    slip = at.ring_speed - body.radius * spin
    forces = forces_of(path, at, slip)
    time, interval, row, status = memory.time, memory.interval, 0, UNDER_WAY
    while row < steps.size:
        if time >= rule.end:
            status = COMPLETED
            break
        after = min(start + (memory.count[0] + 1) * rule.step, rule.end)
        span = after - time
        interval = interval_of(motion, after, interval)
        reached, before = station_of(path, after, interval), powers(body, at, forces, slip)
        if rule.implicit:
            spin, used, unbalanced = backward_euler_step(path, reached, spin, span, rule.tolerance)
            memory.count[2] += used
            memory.unbalanced = max(memory.unbalanced, unbalanced)
        else:
            spin += span * body.mobility / body.radius * net_force(forces)
        slip_before, slip = slip, reached.ring_speed - body.radius * spin
        if not math.isfinite(slip):
            status = NO_ROOT if rule.implicit else NOT_FINITE
            break
        if abs(slip) > rule.largest_slip:
            time, status = after, IMPOSSIBLE_SLIP
            break
        forces_before, forces = forces, forces_of(path, reached, slip)
        memory.count[0] += 1
        memory.count[2] += 1
        one = steps[row]
        if rule.implicit:
            write_stage(one, 0, after, span, body, reached, forces, slip, powers(body, reached, forces, slip))
        else:
            write_stage(one, 0, time, span, body, at, forces_before, slip_before, before)
        one.start, one.end, one.stages, one.stretch, one.sampled = time, after, 1, memory.count[0], 0
        one.power_before[0], one.power_before[1], one.power_before[2] = before
        row, time, at = row + 1, after, reached
    memory.time, memory.interval, memory.slip, memory.spin = time, interval, slip, spin
    return status, row
