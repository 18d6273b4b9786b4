"""The stage equations of a step, solved by Newton's iteration to a tolerance on force."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from macroslip.compiled import jit_part
from macroslip.integrate.radau_step import collocation, newton_update, residuals
from macroslip.integrate.sealed import has_microslip, stage_forces_of, station_of
from macroslip.integrate.tuning import (
    BEND_SAFETY,
    FORCE_TOLERANCE,
    FORGET,
    ITERATIONS,
    LAST_REST,
    MICROSLIP_FORCE_SHARE,
    MICROSLIP_FORCE_TOLERANCE,
)
from macroslip.ring.orbit import instant
from macroslip.roller.forces import magnitude, net_force, shifted
from macroslip.roller.stage_forces import AtStages


class Stages(NamedTuple):
    """Solution of the stage equations.

    Attributes
    ----------
    converged : bool
    v1, v2, v3 : float
        Slip at the stages [m/s].
    s1, s2, s3 : float
        Its increments by forces, v_i − v0 − (u2_i − u2_0) [m/s].
    f1, f2, f3 : SlipForces
    unbalanced : float
        Largest force left at a stage [N].
    evaluations : int
        Force evaluations it took.
    bend : float
        Residual left by Newton's correction over the square of the correction [N s²/m²]; infinite while it is not known.
    """

    converged: bool
    v1: float
    v2: float
    v3: float
    s1: float
    s2: float
    s3: float
    f1: Any
    f2: Any
    f3: Any
    unbalanced: float
    evaluations: int
    bend: float


@jit_part
def force_tolerance(tolerance, microslip):
    """Part of the sum of force magnitudes that may stay unbalanced, by the tolerance of the integration."""
    if not microslip:
        return FORCE_TOLERANCE
    return max(FORCE_TOLERANCE, min(MICROSLIP_FORCE_SHARE * tolerance, MICROSLIP_FORCE_TOLERANCE))


@jit_part
def solve_stages(path, state, step, guess, smooth, bend):
    """Solve the stage equations from a first guess.

    Parameters
    ----------
    path : Path
    state : State
        Before the step.
    step : Step
    guess : tuple of float
        First guess of slip at the stages [m/s].
    smooth : bool
        Whether forces bend from step to step in the same way, as those of a contact with microslip.
    bend : float
        As the last step left it [N s²/m²].

    Returns
    -------
    Stages
    """
    model, scale, slip, forces = path.model, step.scale, state.slip, state.forces
    at, at1, at2, at3 = state.at, step.at1, step.at2, step.at3
    v1, v2, v3 = guess
    d1 = at1.ring_speed - at.ring_speed
    d2 = at2.ring_speed - at.ring_speed
    d3 = at3.ring_speed - at.ring_speed
    force_part = force_tolerance(path.limits.tolerance, has_microslip(model))
    round_off = 4e-15 * scale * (path.limits.speed_scale + abs(slip))
    converged, unbalanced, evaluations, change, foreseen = False, math.inf, 0, 0.0, math.inf
    f1, f2, f3 = forces, forces, forces
    s1, s2, s3 = v1 - slip - d1, v2 - slip - d2, v3 - slip - d3
    for iteration in range(ITERATIONS):
        f1, f2, f3 = stage_forces_of(model, AtStages(at1, at2, at3, v1, v2, v3))
        evaluations += 3
        s1, s2, s3 = v1 - slip - d1, v2 - slip - d2, v3 - slip - d3
        rest = residuals(scale, s1, s2, s3, net_force(f1), net_force(f2), net_force(f3))
        size = max(abs(rest.first), abs(rest.second), abs(rest.third))
        if (
            abs(rest.first) <= force_part * magnitude(f1) + round_off
            and abs(rest.second) <= force_part * magnitude(f2) + round_off
            and abs(rest.third) <= force_part * magnitude(f3) + round_off
        ):
            converged = True
            unbalanced = size
            break
        if not math.isfinite(size) or (iteration > 2 and size > 0.9 * unbalanced):
            break
        # Newton's residuals shrink quadratically: the next one is predicted from the last two, or with a known bend from
        # the first correction, and where it is small enough the forces follow to first order, without an evaluation.
        if iteration > 0:
            foreseen = size * size / unbalanced
            if iteration == 1:
                bend = max(size / (change * change), FORGET * bend if bend < math.inf else 0.0)
        u1, u2, u3 = newton_update(scale, f1.slope, f2.slope, f3.slope, rest)
        change = max(abs(u1), abs(u2), abs(u3))
        if iteration == 0:
            foreseen = BEND_SAFETY * bend * change * change if smooth else math.inf
        unbalanced = size
        v1 += u1
        v2 += u2
        v3 += u3
        least = min(magnitude(f1), magnitude(f2), magnitude(f3))
        is_close = iteration == 0 or size <= LAST_REST * least + round_off
        if is_close and foreseen <= force_part * least + round_off:
            f1, f2, f3 = shifted(f1, u1), shifted(f2, u2), shifted(f3, u3)
            s1, s2, s3 = v1 - slip - d1, v2 - slip - d2, v3 - slip - d3
            converged = True
            unbalanced = foreseen
            break
    return Stages(converged, v1, v2, v3, s1, s2, s3, f1, f2, f3, unbalanced, evaluations, bend)


@jit_part
def between_stages(path, state, step, stages, interval, part):
    """Station, slip [m/s] and rate of its increment [m/s] at a part of a step, which lies in `interval` there."""
    increment, rate = collocation(part, stages.s1, stages.s2, stages.s3)
    now = instant(path.motion, interval, state.time + part * step.length)
    there = station_of(path.model, path.start_angle, now)
    return there, state.slip + there.ring_speed - state.at.ring_speed + increment, rate
