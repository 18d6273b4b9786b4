"""Steps of a roller's slip: Radau IIA (order 5, L-stable), and two-stage collocation where a roller is firmly held.

The stage equations are those of v(t) = v0 + [u2(t) − u2(t0)] − (r²/I_z') ∫ F dt: the ring's speed u2 enters by its exact
difference and only the forces are integrated numerically. Multiplied by the inverse of the method's matrix and divided
by h r²/I_z' they read, in newtons,

    R_i = Σ_j (A⁻¹)_ij (v_j − v0 − u2_j + u2_0)/(h r²/I_z') + F_i + F_o + F_c |_i = 0,

so a tolerance on the residual is a tolerance on force, however stiff the contact. Every stage has its own derivative of
the force, and Newton's matrix A⁻¹/(h r²/I_z') + diag(F') is exact.

A firmly held roller with microslip slips as the balance of the instant asks. There collocation at the middle and the end of
the step, with the energy by Simpson's rule, takes two force evaluations in place of three, and is no worse, since slip
forgets what it was within a small part of the step: L-stable, and of order 2 where slip has a memory (its stability function is
(1 + z/4)/(1 − 3z/4 + z²/4)).

References
----------
Hairer and Wanner, Solving Ordinary Differential Equations II, Springer (1996), doi:10.1007/978-3-642-05221-7.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.contact.look_up import rising_slip
from macroslip.imposed.tuning import (
    BEND_SAFETY,
    FORCE_TOLERANCE,
    FORGET,
    GRIPPED,
    HELD_ITERATIONS,
    HOT_CHANGE,
    ITERATIONS,
    LAST_REST,
    LEAST_CHANGE,
    LIMIT_EXPONENT,
    MICROSLIP_FORCE_SHARE,
    MICROSLIP_FORCE_TOLERANCE,
    MOST_AHEAD,
    MOST_QUICKENING,
    QUASI_STATIC,
    SETTLED_FORCE,
    SMALL_CHANGE,
    STEEPEST,
)
from macroslip.imposed.zones import EDGE, FIRM
from macroslip.ring.orbit import instant, interval_of
from macroslip.roller.forces import SlipForces, magnitude, net_force, powers, slip_forces, station

_ROOT_6 = math.sqrt(6.0)
#: Stage times c and matrix A of Radau IIA, order 5 (table IV.5.6).
NODES = ((4.0 - _ROOT_6) / 10.0, (4.0 + _ROOT_6) / 10.0, 1.0)
MATRIX = np.array(
    [
        [(88.0 - 7.0 * _ROOT_6) / 360.0, (296.0 - 169.0 * _ROOT_6) / 1800.0, (-2.0 + 3.0 * _ROOT_6) / 225.0],
        [(296.0 + 169.0 * _ROOT_6) / 1800.0, (88.0 + 7.0 * _ROOT_6) / 360.0, (-2.0 - 3.0 * _ROOT_6) / 225.0],
        [(16.0 - _ROOT_6) / 36.0, (16.0 + _ROOT_6) / 36.0, 1.0 / 9.0],
    ]
)
WEIGHTS = (float(MATRIX[2, 0]), float(MATRIX[2, 1]), float(MATRIX[2, 2]))
#: Weights of Simpson's rule.
SIMPSON = (1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0)
A11, A12, A13, A21, A22, A23, A31, A32, A33 = (float(x) for x in np.linalg.inv(MATRIX).ravel())
#: Real eigenvalue of A⁻¹.
EIGENVALUE = float(min(np.linalg.eigvals(np.linalg.inv(MATRIX)), key=lambda z: abs(z.imag)).real)
#: √B at which Crook's shear stress peaks (B = 2.2767).
_ROOT_HEATING_AT_PEAK = 1.5088


class Path(NamedTuple):
    """The way of one roller and how it is to be integrated.

    Attributes
    ----------
    body, tables
        The roller (`macroslip.roller.model.Roller`).
    motion : Motion
    start_angle : float
        Position φ at the first sample [rad].
    limits : record of `macroslip.imposed.solve.LIMITS`
    """

    body: Any
    tables: np.ndarray
    motion: Any
    start_angle: float
    limits: Any


class State(NamedTuple):
    """A roller at one time [s]: sample interval that holds it, slip [m/s], station, forces, and powers of its contacts [W]."""

    time: float
    interval: int
    slip: float
    at: Any
    forces: Any
    powers: tuple


class Step(NamedTuple):
    """A step from a state on: its length [s], 1/(h r²/I_z') [N s/m], and times [s] and stations of its three stages.

    `interval` is the sample interval it ends in, `weights` are those of its stages in the energy, and `held` whether its
    stages are the start, the middle and the end.
    """

    length: float
    scale: float
    interval: int
    times: tuple
    at1: Any
    at2: Any
    at3: Any
    weights: tuple
    held: bool


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


class Memory(NamedTuple):
    """Results of a step that the next one needs for its first guess.

    Attributes
    ----------
    exponent : float
        Power of the load that the slip of a held roller follows.
    bend : float
        As in `Stages`.
    length : float
        Of the last step of three stages [s]; 0 where another has come since.
    s1, s2, s3 : float
        The increments of slip by forces at its stages [m/s].
    """

    exponent: float
    bend: float
    length: float
    s1: float
    s2: float
    s3: float


@jit
def evaluate(path, time, interval, slip):
    """Station and forces of the roller at a time [s] in a sample interval, slipping at `slip` [m/s]."""
    at = station(path.body, path.tables, path.start_angle, instant(path.motion, interval, time))
    return at, slip_forces(path.body, path.tables, at, slip)


@jit_inline
def forces_of(path, at, slip):
    """Forces at a station and a slip [m/s]."""
    return slip_forces(path.body, path.tables, at, slip)


@jit
def station_of(path, time, interval):
    """Station at a time [s] in a sample interval."""
    return station(path.body, path.tables, path.start_angle, instant(path.motion, interval, time))


@jit_inline
def state_at(path, time, interval, slip):
    """The roller at a time [s] in a sample interval, slipping at `slip` [m/s]; one force evaluation."""
    at, forces = evaluate(path, time, interval, slip)
    return State(time, interval, slip, at, forces, powers(path.body, at, forces, slip))


@jit_inline
def step_from(path, state, length):
    """A step of `length` [s] from a state on."""
    t1, t2, t3 = state.time + NODES[0] * length, state.time + NODES[1] * length, state.time + length
    k1 = interval_of(path.motion, t1, state.interval)
    k2 = interval_of(path.motion, t2, k1)
    k3 = interval_of(path.motion, t3, k2)
    return Step(
        length,
        1.0 / (length * path.body.mobility),
        k3,
        (t1, t2, t3),
        station_of(path, t1, k1),
        station_of(path, t2, k2),
        station_of(path, t3, k3),
        WEIGHTS,
        False,
    )


@jit_inline
def shifted(forces, change):
    """The forces after a small change of slip [m/s], to first order.

    What the cage and rolling resistance change by is all given to the cage; the rest is left as it is.
    """
    inner = forces.inner_slope * change
    outer = forces.outer_slope * change
    return SlipForces(
        forces.inner + inner,
        forces.outer + outer,
        forces.cage + forces.slope * change - inner - outer,
        forces.slope,
        forces.inner_slope,
        forces.outer_slope,
        forces.cage_load + forces.cage_load_slope * change,
        forces.cage_load_slope,
        forces.resistance,
        forces.inner_rolling,
        forces.outer_rolling,
        forces.cage_rolling,
        forces.inner_lag,
        forces.outer_lag,
        forces.inner_skew,
        forces.outer_skew,
        forces.inner_rough,
        forces.outer_rough,
        forces.cage_rough,
    )


@jit
def residuals(scale, z1, z2, z3, f1, f2, f3):
    """R_i [N] from stage increments z_i = v_i − v0 − (u2_i − u2_0) [m/s] and forces [N]; `scale` is 1/(h r²/I_z')."""
    return (
        scale * (A11 * z1 + A12 * z2 + A13 * z3) + f1,
        scale * (A21 * z1 + A22 * z2 + A23 * z3) + f2,
        scale * (A31 * z1 + A32 * z2 + A33 * z3) + f3,
    )


@jit
def newton_update(scale, d1, d2, d3, residual):
    """Solve [scale A⁻¹ + diag(d)] Δ = −R. No pivoting: for d ≥ 0 all leading minors are positive."""
    m11 = scale * A11 + d1
    m12 = scale * A12
    m13 = scale * A13
    q2 = scale * A21 / m11
    q3 = scale * A31 / m11
    m22 = scale * A22 + d2 - q2 * m12
    m23 = scale * A23 - q2 * m13
    r2 = -residual[1] + q2 * residual[0]
    p3 = (scale * A32 - q3 * m12) / m22
    m33 = scale * A33 + d3 - q3 * m13 - p3 * m23
    r3 = -residual[2] + q3 * residual[0] - p3 * r2
    x3 = r3 / m33
    x2 = (r2 - m23 * x3) / m22
    return (-residual[0] - m12 * x2 - m13 * x3) / m11, x2, x3


@jit
def collocation(part, z1, z2, z3):
    """Increment of the collocation polynomial [m/s] at a part of the step, and its derivative by that part [m/s].

    Examples
    --------
    >>> increment, rate = collocation(0.5, NODES[0] ** 3, NODES[1] ** 3, 1.0)
    >>> round(increment, 12), round(rate, 12)
    (0.125, 0.75)
    """
    a, b = NODES[0], NODES[1]
    # Newton's divided differences through (0, 0), (a, z1), (b, z2), (1, z3).
    first = z1 / a
    second = ((z2 - z1) / (b - a) - first) / b
    third = ((z3 - z2) / (1.0 - b) - (z2 - z1) / (b - a)) / (1.0 - a) - second
    increment = part * (first + (part - a) * (second + (part - b) * third))
    rate = first + second * (2.0 * part - a) + third * ((part - a) * (part - b) + part * (2.0 * part - a - b))
    return increment, rate


@jit_inline
def between_stages(path, state, step, stages, interval, part):
    """Station, slip [m/s] and rate of its increment [m/s] at a part of a step, which lies in `interval` there."""
    increment, rate = collocation(part, stages.s1, stages.s2, stages.s3)
    there = station_of(path, state.time + part * step.length, interval)
    return there, state.slip + there.ring_speed - state.at.ring_speed + increment, rate


@jit_inline
def force_tolerance(tolerance, microslip):
    """Part of the sum of force magnitudes that may stay unbalanced, for the tolerance of the integration."""
    if not microslip:
        return FORCE_TOLERANCE
    return max(FORCE_TOLERANCE, min(MICROSLIP_FORCE_SHARE * tolerance, MICROSLIP_FORCE_TOLERANCE))


@jit_inline
def _new_bend(bend, size, change):
    """The bend after a correction has left a residual of `size` [N]; of what was known half is forgotten."""
    return max(size / (change * change), FORGET * bend if bend < math.inf else 0.0)


@jit
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
    scale, slip, at = step.scale, state.slip, state.at
    at1, at2, at3 = step.at1, step.at2, step.at3
    v1, v2, v3 = guess
    d1, d2, d3 = at1.ring_speed - at.ring_speed, at2.ring_speed - at.ring_speed, at3.ring_speed - at.ring_speed
    force_part = force_tolerance(path.limits.tolerance, path.body.microslip)
    round_off = 4e-15 * scale * (path.limits.speed_scale + abs(slip))
    converged, unbalanced, evaluations, change, foreseen = False, math.inf, 0, 0.0, math.inf
    f1, f2, f3 = state.forces, state.forces, state.forces
    s1, s2, s3 = v1 - slip - d1, v2 - slip - d2, v3 - slip - d3
    for iteration in range(ITERATIONS):
        f1, f2, f3 = forces_of(path, at1, v1), forces_of(path, at2, v2), forces_of(path, at3, v3)
        evaluations += 3
        s1, s2, s3 = v1 - slip - d1, v2 - slip - d2, v3 - slip - d3
        rest = residuals(scale, s1, s2, s3, net_force(f1), net_force(f2), net_force(f3))
        size = max(abs(rest[0]), abs(rest[1]), abs(rest[2]))
        if (
            abs(rest[0]) <= force_part * magnitude(f1) + round_off
            and abs(rest[1]) <= force_part * magnitude(f2) + round_off
            and abs(rest[2]) <= force_part * magnitude(f3) + round_off
        ):
            converged, unbalanced = True, size
            break
        if not math.isfinite(size) or (iteration > 2 and size > 0.9 * unbalanced):
            break
        # Newton's residuals shrink quadratically: the next one is predicted from the last two, or with a known bend from
        # the first correction, and where it is small enough the forces follow to first order, without an evaluation.
        if iteration > 0:
            foreseen = size * size / unbalanced
            if iteration == 1:
                bend = _new_bend(bend, size, change)
        u1, u2, u3 = newton_update(scale, f1.slope, f2.slope, f3.slope, rest)
        change = max(abs(u1), abs(u2), abs(u3))
        if iteration == 0:
            foreseen = BEND_SAFETY * bend * change * change if smooth else math.inf
        unbalanced = size
        v1, v2, v3 = v1 + u1, v2 + u2, v3 + u3
        least = min(magnitude(f1), magnitude(f2), magnitude(f3))
        is_close = iteration == 0 or size <= LAST_REST * least + round_off
        if is_close and foreseen <= force_part * least + round_off:
            f1, f2, f3 = shifted(f1, u1), shifted(f2, u2), shifted(f3, u3)
            s1, s2, s3 = v1 - slip - d1, v2 - slip - d2, v3 - slip - d3
            converged, unbalanced = True, foreseen
            break
    return Stages(converged, v1, v2, v3, s1, s2, s3, f1, f2, f3, unbalanced, evaluations, bend)


@jit_inline
def follows_loads(path, state, zone, length):
    """Whether a roller is at its balance and forgets its slip within a small part of a step of `length` [s]."""
    if zone != FIRM or not path.body.microslip:
        return False
    forces = state.forces
    held = path.body.mobility * forces.slope * length > QUASI_STATIC
    return held and abs(net_force(forces)) <= SETTLED_FORCE * magnitude(forces)


@jit_inline
def held_step_from(path, state, length):
    """A step of `length` [s] from a state on, whose stages are its start, its middle and its end."""
    middle, end = state.time + 0.5 * length, state.time + length
    k2 = interval_of(path.motion, middle, state.interval)
    k3 = interval_of(path.motion, end, k2)
    return Step(
        length,
        1.0 / (length * path.body.mobility),
        k3,
        (state.time, middle, end),
        state.at,
        station_of(path, middle, k2),
        station_of(path, end, k3),
        SIMPSON,
        True,
    )


@jit
def held_update(scale, d2, d3, rest_2, rest_3):
    """Solve the two linearised stage equations: changes of slip at the middle and at the end [m/s].

    R_2 = scale (v_3 − …) + F_2 and R_3 = scale (3 v_3 − 4 v_2 + …) + F_3, with F' = d [N s/m] and `scale` = 1/(h r²/I_z').

    Examples
    --------
    >>> held_update(1.0, 2.0, 3.0, 16.0, 8.0)
    (-5.5, -5.0)
    """
    last = 3.0 * scale + d3
    change_3 = (-rest_3 * d2 - 4.0 * scale * rest_2) / (last * d2 + 4.0 * scale * scale)
    return (-rest_2 - scale * change_3) / d2, change_3


@jit
def solve_held(path, state, step, exponent, bend):
    """Solve the stage equations of a held step.

    Parameters
    ----------
    path : Path
    state : State
    step : Step
        From `held_step_from`.
    exponent : float
        Power of the load that slip follows.
    bend : float
        As in `Stages`.

    Returns
    -------
    Stages
        Not converged where Newton's iteration would need a better guess than is available.
    """
    scale, slip, at = step.scale, state.slip, state.at
    d2, d3 = step.at2.ring_speed - at.ring_speed, step.at3.ring_speed - at.ring_speed
    force_part = force_tolerance(path.limits.tolerance, True)
    v2 = held_slip(True, slip, at, step.at2, exponent)
    f2 = forces_of(path, step.at2, v2)
    # The middle first, with the end as far ahead as the middle: its solution makes a good guess of the end.
    s2 = v2 - slip - d2
    ahead = v2 - (scale * 2.0 * s2 + net_force(f2)) / (2.0 * scale + f2.slope)
    v3 = held_slip(True, ahead, step.at2, step.at3, held_exponent(at, slip, step.at2, ahead, exponent))
    f3 = forces_of(path, step.at3, v3)
    evaluations, unbalanced, converged, change, foreseen = 2, math.inf, False, 0.0, math.inf
    s3 = v3 - slip - d3
    for iteration in range(HELD_ITERATIONS):
        rest_2 = scale * s3 + net_force(f2)
        rest_3 = scale * (3.0 * s3 - 4.0 * s2) + net_force(f3)
        size = max(abs(rest_2), abs(rest_3))
        allowed = force_part * min(magnitude(f2), magnitude(f3))
        if not math.isfinite(size) or f2.slope <= 0.0 or f3.slope <= 0.0:
            break
        if iteration > 0:
            if iteration == 1:
                bend = _new_bend(bend, size, change)
            if size > 0.9 * unbalanced and size > allowed:
                break
            foreseen = min(size, size * size / unbalanced)
        u2, u3 = held_update(scale, f2.slope, f3.slope, rest_2, rest_3)
        change = max(abs(u2), abs(u3))
        if iteration == 0:
            foreseen = BEND_SAFETY * bend * change * change
        unbalanced = size
        v2, v3 = v2 + u2, v3 + u3
        s2, s3 = v2 - slip - d2, v3 - slip - d3
        if foreseen <= allowed:
            f2, f3 = shifted(f2, u2), shifted(f3, u3)
            unbalanced, converged = foreseen, True
            break
        f2, f3 = forces_of(path, step.at2, v2), forces_of(path, step.at3, v3)
        evaluations += 2
    return Stages(converged, slip, v2, v3, 0.0, s2, s3, state.forces, f2, f3, unbalanced, evaluations, bend)


@jit_inline
def held_slip(microslip, slip, at, later, exponent):
    """Guess of the slip of a firmly held roller at a later station from its slip now.

    With microslip the middle slips so that the two sides of the lines of pure rolling balance: in proportion to speed,
    and to a power of the load that `held_exponent` measures.
    """
    if not microslip or at.elastic_load <= 0.0 or at.ring_speed == 0.0 or later.elastic_load <= 0.0:
        return slip
    if abs(later.ring_speed) > MOST_QUICKENING * abs(at.ring_speed):
        return slip
    return slip * (later.elastic_load / at.elastic_load) ** exponent * (later.ring_speed / at.ring_speed)


@jit
def held_exponent(at, slip, later, later_slip, exponent):
    """The power of load with which the slip of a held roller has just changed; `exponent` where it cannot be measured."""
    if at.elastic_load <= 0.0 or later.elastic_load <= 0.0:
        return exponent
    change = math.log(later.elastic_load / at.elastic_load)
    ratio = later_slip * at.ring_speed / (slip * later.ring_speed) if slip * later.ring_speed != 0.0 else 0.0
    if abs(change) < LEAST_CHANGE or ratio <= 0.0:
        return exponent
    return min(max(math.log(ratio) / change, -STEEPEST), STEEPEST)


@jit_inline
def first_memory():
    """Before the first step."""
    return Memory(LIMIT_EXPONENT, math.inf, 0.0, 0.0, 0.0, 0.0)


@jit_inline
def first_guess(path, state, step, zone, memory):
    """Slip at the stages [m/s] to start Newton's iteration from.

    Where slip is smooth, the polynomial of the step before is continued. Otherwise a roller that drifts under small forces
    continues with the acceleration of the forces at the start, and one stuck to the cage keeps its spin; any other starts
    from the slip before the step, which `held_slip` changes with the load if the roller follows its loads.
    """
    h, slip, forces, mobility = step.length, state.slip, state.forces, path.body.mobility
    at, at1, at2, at3 = state.at, step.at1, step.at2, step.at3
    microslip = path.body.microslip
    gripped = mobility * forces.slope * h
    if zone != FIRM and h <= MOST_AHEAD * memory.length and gripped < GRIPPED:
        ratio = h / memory.length
        ahead1, _ = collocation(1.0 + NODES[0] * ratio, memory.s1, memory.s2, memory.s3)
        ahead2, _ = collocation(1.0 + NODES[1] * ratio, memory.s1, memory.s2, memory.s3)
        ahead3, _ = collocation(1.0 + ratio, memory.s1, memory.s2, memory.s3)
        base = slip - at.ring_speed - memory.s3
        return base + at1.ring_speed + ahead1, base + at2.ring_speed + ahead2, base + at3.ring_speed + ahead3
    drift = 0.0
    drifts = gripped < 1.0 and zone != EDGE
    if drifts:
        drift = -mobility * net_force(forces) * h
    v1, v2, v3 = slip, slip, slip
    # What holds the roller may be the cage: its spin then stays as it is, at zero.
    if drifts or forces.slope > 2.0 * (forces.inner_slope + forces.outer_slope):
        v1 = slip + (at1.ring_speed - at.ring_speed) + drift * NODES[0]
        v2 = slip + (at2.ring_speed - at.ring_speed) + drift * NODES[1]
        v3 = slip + (at3.ring_speed - at.ring_speed) + drift
    if zone == FIRM or (microslip and gripped > GRIPPED and at3.elastic_load > 0.0):
        v1 = held_slip(microslip, v1, at, at1, memory.exponent)
        v2 = held_slip(microslip, v2, at, at2, memory.exponent)
        v3 = held_slip(microslip, v3, at, at3, memory.exponent)
    return v1, v2, v3


@jit_inline
def _steady_slip(law, tables, closed_form, load, speed):
    """Slip [m/s] up to which the force of a contact rises with slip."""
    if load <= 0.0:
        return math.inf
    if not closed_form:
        return rising_slip(law.traction, tables, load, speed)
    if law.heating == 0.0:
        return math.inf
    # The middle of the contact is its hottest point.
    return _ROOT_HEATING_AT_PEAK / law.heating * math.exp(-0.5 * law.pressure_exponent * load ** (1.0 / 3.0))


@jit
def surely_rising(body, tables, inner_load, outer_load, speed):
    """Slip [m/s] up to which forces rise with slip at both raceways, at loads [N] and ring speeds up to `speed` [m/s]."""
    return min(
        _steady_slip(body.inner, tables, body.closed_form, inner_load, speed),
        _steady_slip(body.outer, tables, body.closed_form, outer_load, speed),
    )


@jit_inline
def is_continuous(path, state, step, stages):
    """Whether the solved stages of a step are sure to be the root that is continuous with the slip before it.

    Below the slip at which some part of a contact passes its peak of traction, forces rise with slip and the stage equations
    have one root. Above it, a step is accepted only where slip changes so little, and traction falls so gently, that the
    root found is the continuous one.
    """
    # More than one root is possible only where traction falls with slip faster than the step allows.
    if min(stages.f1.slope, stages.f2.slope, stages.f3.slope) < -0.5 * step.scale:
        return False
    slip, limits = state.slip, path.limits
    change = max(abs(stages.v1 - slip), abs(stages.v2 - slip), abs(stages.v3 - slip))
    if change <= HOT_CHANGE * abs(slip) + SMALL_CHANGE * limits.speed_scale:
        return True
    largest = max(abs(slip), abs(stages.v1), abs(stages.v2), abs(stages.v3))
    if largest <= limits.cold_slip:
        return True
    at = state.at
    inner = max(at.inner_load, step.at1.inner_load, step.at2.inner_load, step.at3.inner_load)
    outer = max(at.outer_load, step.at1.outer_load, step.at2.outer_load, step.at3.outer_load)
    ring = max(abs(at.ring_speed), abs(step.at3.ring_speed))
    return largest <= surely_rising(path.body, path.tables, inner, outer, ring)
