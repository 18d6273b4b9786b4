"""Steps of a roller's slip by the Radau IIA method of order 5, and the set-up of all steps.

The stage equations are those of v(t) = v0 + [u2(t) − u2(t0)] − (r²/I_z') ∫ F dt: the ring's speed
u2 enters by its exact difference and only the forces are integrated numerically. Multiplied by the
inverse of the method's matrix and divided by h r²/I_z' they read, in newtons,

    R_i = Σ_j (A⁻¹)_ij (v_j − v0 − u2_j + u2_0)/(h r²/I_z') + F_i + F_o + F_c |_i = 0,

so a tolerance on the residual is a tolerance on force, however stiff the contact. Every stage has
its own derivative of the force, and Newton's matrix A⁻¹/(h r²/I_z') + diag(F') is exact.

Hairer and Wanner, Solving Ordinary Differential Equations II, Springer (1996),
doi:10.1007/978-3-642-05221-7.
"""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit_inline
from macroslip.imposed import tuning
from macroslip.imposed.held_slip import held_exponent, held_slip
from macroslip.imposed.root import left_by_curvature
from macroslip.imposed.state import evaluate, locate
from macroslip.imposed.zones import FIRM, FREE
from macroslip.mechanics.spin import magnitude, net_force
from macroslip.ring.orbit import interval_of

_ROOT_6 = math.sqrt(6.0)
#: Stage times c and matrix A of Radau IIA, order 5 (table IV.5.6).
NODES = ((4.0 - _ROOT_6) / 10.0, (4.0 + _ROOT_6) / 10.0, 1.0)
MATRIX = np.array(
    [
        [
            (88.0 - 7.0 * _ROOT_6) / 360.0,
            (296.0 - 169.0 * _ROOT_6) / 1800.0,
            (-2.0 + 3.0 * _ROOT_6) / 225.0,
        ],
        [
            (296.0 + 169.0 * _ROOT_6) / 1800.0,
            (88.0 + 7.0 * _ROOT_6) / 360.0,
            (-2.0 - 3.0 * _ROOT_6) / 225.0,
        ],
        [(16.0 - _ROOT_6) / 36.0, (16.0 + _ROOT_6) / 36.0, 1.0 / 9.0],
    ]
)
WEIGHTS = (float(MATRIX[2, 0]), float(MATRIX[2, 1]), float(MATRIX[2, 2]))
#: Weights of Simpson's rule.
SIMPSON = (1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0)
_INVERSE = np.linalg.inv(MATRIX)
A11, A12, A13, A21, A22, A23, A31, A32, A33 = _INVERSE.ravel().tolist()
_EIGENVALUES = np.linalg.eigvals(_INVERSE)
#: Real eigenvalue of A⁻¹.
EIGENVALUE = float(min(_EIGENVALUES, key=lambda z: abs(z.imag)).real)


@jit_inline
def set_step(path, now, attempt, length, held):
    """Set up the stages of a step that begins now.

    Parameters
    ----------
    path : Path
    now : record of `macroslip.imposed.state.STATE`
        State at the start of the step.
    attempt : record of `macroslip.imposed.state.ATTEMPT`
        Its length, scale, times, weights and stations are written.
    length : float
        Length of the step, > 0 [s].
    held : bool
        Whether the step is held, that is of two stages; it has three otherwise.
    """
    attempt.length = length
    attempt.scale = 1.0 / (length * path.body.mobility)
    attempt.held = 1 if held else 0
    interval = now.interval
    films = now.at.log_film_balance
    for k in range(3):
        attempt.weights[k] = SIMPSON[k] if held else WEIGHTS[k]
        if held and k == 0:
            attempt.times[0] = now.time
            attempt.at[0] = now.at
            continue
        part = 0.5 * k if held else NODES[k]
        # The last stage is the end, without rounding.
        since = length if k == 2 else part * length
        attempt.times[k] = now.time + since
        interval = interval_of(path.motion, attempt.times[k], interval)
        # The search for the films' load begins where that of the stage before ended.
        attempt.at[k].log_film_balance = films
        locate(path, attempt.times[k], interval, attempt.at[k])
        films = attempt.at[k].log_film_balance
    attempt.end_interval = interval


@jit_inline
def shift(forces, change):
    """Change the forces by a small change of slip [m/s], to first order.

    The change of the cage's force and of rolling resistance is all given to the cage; the rest is
    left as it is.
    """
    inner = forces.inner_slope * change
    outer = forces.outer_slope * change
    forces.inner += inner
    forces.outer += outer
    forces.cage += forces.slope * change - inner - outer
    forces.cage_load += forces.cage_load_slope * change


@jit_inline
def residuals(scale, z1, z2, z3, f1, f2, f3):
    """Residuals of the three stage equations, as forces.

    Parameters
    ----------
    scale : float
        1/(h r²/I_z') [N s/m].
    z1, z2, z3 : float
        Stage increments z_i = v_i − v0 − (u2_i − u2_0) [m/s].
    f1, f2, f3 : float
        Net forces at the stages [N].

    Returns
    -------
    tuple of float
        R_1, R_2 and R_3 [N].
    """
    first = A11 * z1 + A12 * z2 + A13 * z3
    second = A21 * z1 + A22 * z2 + A23 * z3
    third = A31 * z1 + A32 * z2 + A33 * z3
    return scale * first + f1, scale * second + f2, scale * third + f3


@jit_inline
def newton_update(scale, d1, d2, d3, residual):
    """Newton correction of the three stage slips: solves [scale A⁻¹ + diag(d)] Δ = −R.

    There is no pivoting: for d ≥ 0 all leading minors are positive.

    Parameters
    ----------
    scale : float
        1/(h r²/I_z') [N s/m].
    d1, d2, d3 : float
        Slopes of the net force by slip at the stages [N s/m].
    residual : tuple of float
        R_1, R_2 and R_3 [N].

    Returns
    -------
    tuple of float
        Changes Δ of slip at the stages [m/s].
    """
    # Reciprocals are taken once: divisions would be most of the time.
    per_first = 1.0 / (scale * A11 + d1)
    m12 = scale * A12
    m13 = scale * A13
    q2 = scale * A21 * per_first
    q3 = scale * A31 * per_first
    per_second = 1.0 / (scale * A22 + d2 - q2 * m12)
    m23 = scale * A23 - q2 * m13
    r2 = -residual[1] + q2 * residual[0]
    p3 = (scale * A32 - q3 * m12) * per_second
    m33 = scale * A33 + d3 - q3 * m13 - p3 * m23
    r3 = -residual[2] + q3 * residual[0] - p3 * r2
    x3 = r3 / m33
    x2 = (r2 - m23 * x3) * per_second
    x1 = (-residual[0] - m12 * x2 - m13 * x3) * per_first
    return x1, x2, x3


@jit_inline
def collocation(part, z1, z2, z3):
    """Collocation polynomial of a step: increment of slip and its derivative.

    Parameters
    ----------
    part : float
        Part of the step [-]; above 1 the polynomial is continued beyond it.
    z1, z2, z3 : float
        Increments at the stages [m/s].

    Returns
    -------
    increment : float
        Increment at the part of the step [m/s].
    rate : float
        Its derivative by the part [m/s].

    Examples
    --------
    >>> increment, rate = collocation(0.5, NODES[0] ** 3, NODES[1] ** 3, 1.0)
    >>> round(increment, 12), round(rate, 12)
    (0.125, 0.75)
    """
    a = NODES[0]
    b = NODES[1]
    # Newton's divided differences through (0, 0), (a, z1), (b, z2), (1, z3).
    first = z1 / a
    between = (z2 - z1) / (b - a)
    last = (z3 - z2) / (1.0 - b)
    second = (between - first) / b
    third = (last - between) / (1.0 - a) - second
    from_a = part - a
    from_b = part - b
    increment = part * (first + from_a * (second + from_b * third))
    third_rate = from_a * from_b + part * (2.0 * part - a - b)
    rate = first + second * (2.0 * part - a) + third * third_rate
    return increment, rate


@jit_inline
def sample_between(path, now, attempt, part, sample):
    """Write conditions, slip and its rate at a point within a solved step.

    Parameters
    ----------
    path : macroslip.imposed.state.Path
    now : record of `macroslip.imposed.state.STATE`
        State at the start of the step.
    attempt : record of `macroslip.imposed.state.ATTEMPT`
        The step, solved.
    part : float
        Part of the step, 0 to 1 [-].
    sample : record of `macroslip.imposed.state.STEP_SAMPLE`
        Its conditions, slip and rate are written.
    """
    time = now.time + part * attempt.length
    sample.at.log_film_balance = attempt.at[1].log_film_balance
    locate(path, time, interval_of(path.motion, time, now.interval), sample.at)
    increment, sample.rate = collocation(
        part, attempt.increment[0], attempt.increment[1], attempt.increment[2]
    )
    sample.slip = now.slip + sample.at.ring_speed - now.at.ring_speed + increment


@jit_inline
def force_tolerance(tolerance, microslip):
    """Unbalanced force that is allowed, over the sum of the force magnitudes [-].

    It goes with the tolerance of the integration.
    """
    if microslip:
        share = min(tuning.MICROSLIP_FORCE_SHARE * tolerance, tuning.MICROSLIP_FORCE_TOLERANCE)
    else:
        share = min(tuning.FORCE_SHARE * tolerance, tuning.LARGEST_FORCE_TOLERANCE)
    return max(tuning.FORCE_TOLERANCE, share)


@jit_inline
def stiffness_of(attempt, first):
    """Largest slope of the net force by slip at the stages of a step, from one stage on [N s/m]."""
    slope = 0.0
    for k in range(first, 3):
        slope = max(slope, abs(attempt.forces[k].slope))
    return slope


@jit_inline
def new_bend(bend, size, stiffness, change):
    """Relative curvature of the residual, renewed from what a Newton correction has left [s/m].

    It is the residual over stiffness and squared correction, so that a contact that stiffens with its
    load has the same. Half of what was known is forgotten.
    """
    kept = tuning.FORGET * bend if bend < math.inf else 0.0
    weight = stiffness * change * change
    return max(size / weight, kept) if weight > 0.0 else math.inf


@jit_inline
def foresee_by_bend(attempt, bend, stiffness, change, first):
    """Write what a Newton correction leaves at stages, by the curvature that earlier ones had.

    Parameters
    ----------
    attempt : record of `macroslip.imposed.state.ATTEMPT`
        Its `left` is written [N].
    bend : float
        As of `new_bend` [s/m].
    stiffness : float
        Largest slope of the net force [N s/m].
    change : tuple of float
        Changes of slip by stage [m/s].
    first : int
        Number of the first stage that changes.
    """
    for k in range(first, 3):
        attempt.left[k] = tuning.BEND_SAFETY * bend * stiffness * change[k] * change[k]


@jit_inline
def foresee(attempt, left, first):
    """Write what a Newton correction leaves at stages from one on, the same at all [N].

    Where forces followed the correction before, what that left is left still.
    """
    for k in range(first, 3):
        kept = 0.0 if attempt.stale[k] else attempt.left[k]
        attempt.left[k] = max(left, kept)


@jit_inline
def write_increment(now, attempt, k):
    """Write the increment of slip by forces [m/s] that follows from the slip at stage `k`."""
    ring_change = attempt.at[k].ring_speed - now.at.ring_speed
    attempt.increment[k] = attempt.slip[k] - now.slip - ring_change


@jit_inline
def let_evaluate(attempt, first):
    """Let forces be evaluated at all stages of a step from one on, and at no other."""
    for k in range(3):
        attempt.stale[k] = 1 if k >= first else 0


@jit_inline
def _evaluate_stage(path, now, attempt, sums, k):
    """Write forces and increment of slip at stage `k` of a step, and count the evaluation."""
    evaluate(path, attempt.at[k], attempt.slip[k], attempt.forces[k])
    write_increment(now, attempt, k)
    sums.evaluations += 1


@jit_inline
def evaluate_stages(path, now, attempt, sums):
    """Write forces and increments of slip at the stages of a step whose forces are stale.

    Parameters
    ----------
    path : macroslip.imposed.state.Path
    now : record of `macroslip.imposed.state.STATE`
        State at the start of the step.
    attempt : record of `macroslip.imposed.state.ATTEMPT`
        Its slips are given; forces and increments are written.
    sums : record of `macroslip.imposed.state.SUMS`
        Counts the evaluations.
    """
    for k in range(3):
        if attempt.stale[k]:
            _evaluate_stage(path, now, attempt, sums, k)


@jit_inline
def _evaluate_held_stages(path, now, attempt, before, sums):
    """Write forces and increments at the stages of a firmly held roller's step, one after another.

    From the forces at a stage follows the slip of balance there, and from that a better guess of the
    slip at the next one. With microslip the steps of three stages that are left for such a roller are
    mostly those in which the cage's load passes zero, where no guess along the load is good.
    `before` is a record of `macroslip.imposed.state.BEFORE`.
    """
    balance = net_force(now.forces)
    for k in range(3):
        _evaluate_stage(path, now, attempt, sums, k)
        forces = attempt.forces[k]
        if k == 2 or forces.slope <= 0.0:
            continue
        at = attempt.at[k]
        slip = attempt.slip[k] - (net_force(forces) - balance) / forces.slope
        exponent = held_exponent(now.at, now.slip, at, slip, before.exponent)
        attempt.slip[k + 1] = held_slip(slip, at, attempt.at[k + 1], exponent)


@jit_inline
def correct(now, attempt, change, first, force_part, round_off):
    """Correct the slips of stages, and let their forces follow to first order where that suffices.

    Parameters
    ----------
    now : record of `macroslip.imposed.state.STATE`
        State at the start of the step.
    attempt : record of `macroslip.imposed.state.ATTEMPT`
        Its slips are changed. By what the correction leaves at each stage, `left`, forces and
        increments follow, or are marked as stale.
    change : tuple of float
        Changes of slip by stage [m/s].
    first : int
        Number of the first stage that changes.
    force_part : float
        Force that may stay unbalanced over the sum of force magnitudes [-].
    round_off : float
        Force that may stay unbalanced by rounding [N].

    Returns
    -------
    bool
        Whether forces are stale at no stage.
    """
    # Forces of a poor guess may be far larger than those of the solution.
    least = math.inf
    for k in range(first, 3):
        attempt.slip[k] += change[k]
        if attempt.left[k] < math.inf:
            shift(attempt.forces[k], change[k])
            write_increment(now, attempt, k)
        least = min(least, magnitude(attempt.forces[k]))
    allowed = force_part * least + round_off
    solved = True
    for k in range(first, 3):
        attempt.stale[k] = 0 if attempt.left[k] <= allowed else 1
        solved = solved and attempt.stale[k] == 0
    return solved


@jit_inline
def _is_balanced(path, attempt, residual, force_part, round_off):
    """True if the residuals of all stages [N] are as small as is asked."""
    balanced = True
    for k in range(3):
        forces = attempt.forces[k]
        allowed = force_part * magnitude(forces) + path.limits.grain * abs(forces.slope) + round_off
        balanced = balanced and abs(residual[k]) <= allowed
    return balanced


@jit_inline
def _foresee_first(path, zone, attempt, before, update):
    """Write what the first correction of a step will leave unbalanced at its stages.

    Without microslip a roller under load may stick and slide in one step: its forces do not bend in
    the same way twice.
    """
    if path.body.microslip or zone == FREE:
        foresee_by_bend(attempt, before.bend, stiffness_of(attempt, 0), update, 0)
    elif path.body.closed_form:
        left_by_curvature(path.body, path.flat, attempt, update)
    else:
        for k in range(3):
            attempt.left[k] = math.inf


@jit_inline
def solve_stages(path, now, zone, attempt, before, sums):
    """Solve the stage equations of a step of three stages by Newton's method.

    Newton's residuals shrink quadratically: what a correction leaves at a stage is foreseen from the
    last two of them, or from the first correction and the curvature of the forces, and where it is
    small enough the forces there follow to first order, without an evaluation.

    Parameters
    ----------
    path : macroslip.imposed.state.Path
    now : record of `macroslip.imposed.state.STATE`
        State at the start of the step.
    zone : int
        Class of the sample interval: `FREE`, `EDGE` or `FIRM`.
    attempt : record of `macroslip.imposed.state.ATTEMPT`
        Its slips are the first guess; slips, increments, forces and what is left are written.
    before : record of `macroslip.imposed.state.BEFORE`
        Its bend is used and renewed.
    sums : record of `macroslip.imposed.state.SUMS`
        Counts the evaluations.

    Returns
    -------
    bool
        Whether the equations were solved.
    """
    limits = path.limits
    force_part = force_tolerance(limits.tolerance, path.body.microslip)
    round_off = 4e-15 * attempt.scale * (limits.speed_scale + abs(now.slip))
    attempt.unbalanced = math.inf
    change = 0.0
    stiffness = 0.0
    first = attempt.forces[0]
    second = attempt.forces[1]
    third = attempt.forces[2]
    let_evaluate(attempt, 0)
    for iteration in range(tuning.ITERATIONS):
        if iteration == 0 and zone == FIRM and not path.body.microslip:
            _evaluate_held_stages(path, now, attempt, before, sums)
        else:
            evaluate_stages(path, now, attempt, sums)
        residual = residuals(
            attempt.scale,
            attempt.increment[0],
            attempt.increment[1],
            attempt.increment[2],
            net_force(first),
            net_force(second),
            net_force(third),
        )
        size = max(abs(residual[0]), abs(residual[1]), abs(residual[2]))
        if _is_balanced(path, attempt, residual, force_part, round_off):
            attempt.unbalanced = size
            return True
        if not math.isfinite(size) or (iteration > 2 and size > 0.9 * attempt.unbalanced):
            return False
        update = newton_update(attempt.scale, first.slope, second.slope, third.slope, residual)
        if iteration == 0:
            _foresee_first(path, zone, attempt, before, update)
        else:
            if iteration == 1:
                before.bend = new_bend(before.bend, size, stiffness, change)
            least = min(magnitude(first), magnitude(second), magnitude(third))
            is_close = size <= tuning.LAST_RESIDUAL * least + round_off
            foresee(attempt, size * size / attempt.unbalanced if is_close else math.inf, 0)
        change = max(abs(update[0]), abs(update[1]), abs(update[2]))
        stiffness = stiffness_of(attempt, 0)
        attempt.unbalanced = size
        if correct(now, attempt, update, 0, force_part, round_off):
            attempt.unbalanced = max(attempt.left[0], attempt.left[1], attempt.left[2])
            return True
    return False
