"""Two-stage collocation steps for a firmly held roller with microslip (held steps).

Its slip is what the balance of the instant asks. There collocation at the middle and the end of the
step, with the energy by Simpson's rule, takes two force evaluations in place of three, and is no
worse, since slip forgets what it was within a small part of the step: L-stable, and of order 2
where slip has a memory (its stability function is (1 + z/4)/(1 − 3z/4 + z²/4)).
"""

from __future__ import annotations

import math

from macroslip.compiled import jit_inline
from macroslip.imposed import tuning
from macroslip.imposed.held_slip import held_exponent, held_slip
from macroslip.imposed.radau import (
    correct,
    evaluate_stages,
    force_tolerance,
    foresee,
    foresee_by_bend,
    let_evaluate,
    new_bend,
    stiffness_of,
    write_increment,
)
from macroslip.imposed.state import evaluate
from macroslip.imposed.zones import FIRM
from macroslip.mechanics.spin import magnitude, net_force


@jit_inline
def follows_loads(path, now, zone, length):
    """True if a roller is in balance and its slip relaxes within a small part of a step.

    Parameters
    ----------
    path : macroslip.imposed.state.Path
    now : record of `macroslip.imposed.state.STATE`
        State at the start of the step.
    zone : int
        Class of the sample interval: `FREE`, `EDGE` or `FIRM`.
    length : float
        Length of the step [s].

    Returns
    -------
    bool
    """
    if zone != FIRM or not path.body.microslip:
        return False
    held = path.body.mobility * now.forces.slope * length > tuning.QUASI_STATIC
    allowed = tuning.SETTLED_FORCE * magnitude(now.forces)
    return held and abs(net_force(now.forces)) <= allowed


@jit_inline
def held_update(scale, d2, d3, residual_2, residual_3):
    """Newton correction of the two stage slips of a held step.

    It solves the linearised equations R_2 = scale (v_3 − …) + F_2 and R_3 = scale (3 v_3 − 4 v_2 +
    …) + F_3.

    Parameters
    ----------
    scale : float
        1/(h r²/I_z') [N s/m].
    d2, d3 : float
        Slopes of the net force by slip at the middle and at the end, > 0 [N s/m].
    residual_2, residual_3 : float
        Residuals R_2 and R_3 [N].

    Returns
    -------
    tuple of float
        Changes of slip at the middle and at the end [m/s].

    Examples
    --------
    >>> held_update(1.0, 2.0, 3.0, 16.0, 8.0)
    (-5.5, -5.0)
    """
    last = 3.0 * scale + d3
    determinant = last * d2 + 4.0 * scale * scale
    change_3 = (-residual_3 * d2 - 4.0 * scale * residual_2) / determinant
    return (-residual_2 - scale * change_3) / d2, change_3


@jit_inline
def solve_held(path, now, attempt, before, sums):
    """Solve the stage equations of a held step.

    They are not solved where Newton's method would need a better guess than is available.

    Parameters
    ----------
    path : macroslip.imposed.state.Path
    now : record of `macroslip.imposed.state.STATE`
        State at the start of the step.
    attempt : record of `macroslip.imposed.state.ATTEMPT`
        Its slips, increments, forces and residual are written.
    before : record of `macroslip.imposed.state.BEFORE`
        Its exponent is used; its bend is used and renewed.
    sums : record of `macroslip.imposed.state.SUMS`
        Counts the evaluations.

    Returns
    -------
    bool
        Whether the equations were solved.
    """
    scale = attempt.scale
    slip = now.slip
    at = now.at
    middle = attempt.at[1]
    end = attempt.at[2]
    second = attempt.forces[1]
    third = attempt.forces[2]
    attempt.forces[0] = now.forces
    attempt.slip[0] = slip
    attempt.increment[0] = 0.0
    force_part = force_tolerance(path.limits.tolerance, path.body.microslip)
    attempt.slip[1] = held_slip(slip, at, middle, before.exponent)
    evaluate(path, middle, attempt.slip[1], second)
    # The middle first, with the end as far ahead as the middle: its solution makes a good guess of
    # the end.
    increment = attempt.slip[1] - slip - (middle.ring_speed - at.ring_speed)
    residual = scale * 2.0 * increment + net_force(second)
    stiffness = 2.0 * scale + second.slope
    ahead = attempt.slip[1] - residual / stiffness
    attempt.slip[2] = held_slip(
        ahead,
        middle,
        end,
        held_exponent(at, slip, middle, ahead, before.exponent),
    )
    evaluate(path, end, attempt.slip[2], third)
    sums.evaluations += 2
    for k in range(1, 3):
        write_increment(now, attempt, k)
    let_evaluate(attempt, 1)
    attempt.unbalanced = math.inf
    change = 0.0
    stiffness = 0.0
    for iteration in range(tuning.HELD_ITERATIONS):
        residual_2 = scale * attempt.increment[2] + net_force(second)
        residual_3 = scale * (3.0 * attempt.increment[2] - 4.0 * attempt.increment[1]) + net_force(
            third
        )
        size = max(abs(residual_2), abs(residual_3))
        allowed = force_part * min(magnitude(second), magnitude(third))
        if not math.isfinite(size) or second.slope <= 0.0 or third.slope <= 0.0:
            return False
        if iteration > 0:
            if iteration == 1:
                before.bend = new_bend(before.bend, size, stiffness, change)
            if size > 0.9 * attempt.unbalanced and size > allowed:
                return False
            foresee(attempt, min(size, size * size / attempt.unbalanced), 1)
        update = held_update(scale, second.slope, third.slope, residual_2, residual_3)
        changes = (0.0, update[0], update[1])
        change = max(abs(update[0]), abs(update[1]))
        stiffness = stiffness_of(attempt, 1)
        if iteration == 0:
            foresee_by_bend(attempt, before.bend, stiffness, changes, 1)
        attempt.unbalanced = size
        if correct(now, attempt, changes, 1, force_part, 0.0):
            attempt.unbalanced = max(attempt.left[1], attempt.left[2])
            return True
        evaluate_stages(path, now, attempt, sums)
    return False
