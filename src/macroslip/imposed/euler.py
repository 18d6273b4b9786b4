"""The paper's explicit and backward Euler method for the spin, with a fixed step.

Explicit Euler is unstable in the load zone (the paper's Appendix A). Backward Euler has a hidden
parameter, where its iteration stops: a change of spin that looks negligible is a large force in a
gripped contact, because dF/dv reaches 1e13 N s/m there. Slip is formed as u2 − r ω and so carries
the round-off of the surface speeds; that is part of both methods.
"""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.imposed import tuning
from macroslip.imposed.state import STATE, SUMS, evaluate, frame, locate, start_at, write_point
from macroslip.imposed.status import COMPLETED, IMPOSSIBLE_SLIP, NO_ROOT, NOT_FINITE, UNDER_WAY
from macroslip.mechanics.spin import CONDITIONS, FORCES, net_force
from macroslip.ring.orbit import interval_of
from macroslip.roller.step import write_stage

#: Rule and bounds of the Euler methods.
RULE = np.dtype(
    [
        # Length of a step [s].
        ("step", "f8"),
        # 1 for backward Euler, 0 for explicit Euler.
        ("implicit", "i8"),
        # Relative change of spin at which the iteration of backward Euler stops [-].
        ("tolerance", "f8"),
        # Slip beyond which the integration stops as unstable [m/s]. Friction pulls a roller's
        # surface towards the speed of the rings and of the cage only, so its true slip never leaves
        # the range these speeds span.
        ("largest_slip", "f8"),
        # End of the integration [s]; the last step is shortened to meet it.
        ("end", "f8"),
    ]
)
#: Mutable state of an integration at a fixed step, from which the next call goes on.
FIXED_WORK = np.dtype(
    [
        ("now", STATE),  # state of the roller
        ("end", CONDITIONS),  # conditions at the end of the step
        ("forces", FORCES),  # forces there, at a spin that is tried
        ("spin", "f8"),  # ω relative to the orbiting frame [rad/s]
        ("sums", SUMS),  # running totals
    ]
)


@jit_inline
def _defect(path, work, spin, step):
    """Residual of backward Euler, ω − ω_n − h (r/I_z') (F_i + F_o + F_c)(ω) [rad/s]."""
    body = path.body
    at = work.end
    evaluate(path, at, at.ring_speed - body.radius * spin, work.forces)
    work.sums.evaluations += 1
    per_force = step * body.mobility / body.radius
    return spin - work.spin - per_force * net_force(work.forces)


@jit_inline
def backward_euler_step(path, work, step, tolerance):
    """Implicit Euler step of the spin equation I_z' dω/dt = r (F_i + F_o + F_c) (16).

    The iteration is the secant method started from the last spin, as MINPACK's hybrid method
    reduces to in one unknown, held inside a bracket once there is one.

    Parameters
    ----------
    path : macroslip.imposed.state.Path
    work : record of `FIXED_WORK`
        State before the step, and the conditions at its end.
    step : float
        Length of the step, > 0 [s].
    tolerance : float
        Relative change of ω at which the iteration stops [-].

    Returns
    -------
    spin : float
        ω after the step, relative to the orbiting frame [rad/s]; NaN if the iteration did not stop.
    unbalanced : float
        Force that the stopped iteration leaves unbalanced [N]; infinite if it did not stop.
    """
    to_force = path.body.radius / (step * path.body.mobility)
    older = work.spin
    older_defect = _defect(path, work, older, step)
    newer = older + 1.5e-8 * max(abs(older), 1e-3)
    newer_defect = _defect(path, work, newer, step)
    low = -math.inf
    high = math.inf
    for _ in range(tuning.SECANT_ITERATIONS):
        for candidate, defect in ((older, older_defect), (newer, newer_defect)):
            if defect <= 0.0 and candidate > low:
                low = candidate
            if defect >= 0.0 and candidate < high:
                high = candidate
        slope = newer_defect - older_defect
        trial = (
            newer - newer_defect * (newer - older) / slope if slope != 0.0 else newer - newer_defect
        )
        if not low <= trial <= high and math.isfinite(low) and math.isfinite(high):
            trial = 0.5 * (low + high)
        if not math.isfinite(trial):
            break
        change = abs(trial - newer)
        older = newer
        older_defect = newer_defect
        newer = trial
        newer_defect = _defect(path, work, trial, step)
        if change <= tolerance * abs(newer) or newer_defect == 0.0 or newer == older:
            return newer, abs(newer_defect) * to_force
    return math.nan, math.inf


@jit
def integrate_fixed_step(path, work, steps):
    """Integrate the spin of one roller with explicit or backward Euler.

    It ends with the history, or where the buffer is full. As `macroslip.imposed.solve.integrate`,
    with a `RULE` for limits and one stage a step: the state at which its forces are evaluated, its
    start or its end.
    """
    body = path.body
    motion = path.motion
    rule = path.limits
    now = work.now
    sums = work.sums
    start = motion.time[0]
    if sums.begun == 0:
        sums.begun = 1
        now.time = start
        now.interval = 0
        start_at(path, now, sums)
        work.spin = (now.at.ring_speed - now.slip) / body.radius
    for count in range(steps.size):
        if now.time >= rule.end:
            # Explicit Euler evaluates the end for no step.
            write_point(path, now, steps[count])
            return COMPLETED, count + 1
        after = min(start + (sums.steps + 1) * rule.step, rule.end)
        span = after - now.time
        interval = interval_of(motion, after, now.interval)
        row = steps[count]
        locate(path, after, interval, work.end)
        frame(now, row, 1, after)
        row.weight[0] = span
        if rule.implicit:
            work.spin, unbalanced = backward_euler_step(path, work, span, rule.tolerance)
            sums.unbalanced = max(sums.unbalanced, unbalanced)
        else:
            row.time[0] = now.time
            write_stage(row, 0, body, now.at, now.forces, now.slip, now.powers[:])
            per_force = span * body.mobility / body.radius
            work.spin += per_force * net_force(now.forces)
        slip = work.end.ring_speed - body.radius * work.spin
        if not math.isfinite(slip):
            return NO_ROOT if rule.implicit else NOT_FINITE, count
        now.slip = slip
        if abs(slip) > rule.largest_slip:
            now.time = after
            return IMPOSSIBLE_SLIP, count
        now.time = after
        now.interval = interval
        start_at(path, now, sums)
        sums.steps += 1
        if rule.implicit:
            row.time[0] = after
            write_stage(row, 0, body, now.at, now.forces, now.slip, now.powers[:])
    return UNDER_WAY, steps.size
