"""Backward Euler on the spin, one step, with a nonlinear solver that stops on a relative change of spin.

This is the paper's method with its one hidden parameter made visible: where the iteration stops. A change of spin that
looks negligible is a large force in a gripped contact, because dF/dv reaches 1e13 N s/m there.
"""

from __future__ import annotations

import math

from macroslip.compiled import jit
from macroslip.integrate.sealed import forces_of
from macroslip.integrate.tuning import SECANT_ITERATIONS
from macroslip.roller.forces import net_force


@jit
def _defect(model, at, before, spin, step):
    """ω − ω_n − h (r/I_z') (F_i + F_o + F_c)(ω) [rad/s]."""
    forces = forces_of(model, at, at.ring_speed - model.radius * spin)
    return spin - before - step * model.mobility / model.radius * net_force(forces)


@jit
def backward_euler_step(model, at, spin, step, tolerance):
    """Spin after one implicit step of I_z' dω/dt = r (F_i + F_o + F_c) (16).

    Parameters
    ----------
    model : RollerModel
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
    to_force = model.radius / (step * model.mobility)
    older = spin
    older_defect = _defect(model, at, spin, older, step)
    newer = older + 1.5e-8 * max(abs(older), 1e-3)
    newer_defect = _defect(model, at, spin, newer, step)
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
        newer, newer_defect = trial, _defect(model, at, spin, trial, step)
        evaluations += 1
        if change <= tolerance * abs(newer) or newer_defect == 0.0 or newer == older:
            return newer, evaluations, abs(newer_defect) * to_force
    return math.nan, evaluations, math.inf
