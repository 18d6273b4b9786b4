"""Steps of a roller's slip: Radau IIA (order 5, L-stable), and two-stage collocation if held.

The stage equations are those of v(t) = v0 + [u2(t) − u2(t0)] − (r²/I_z') ∫ F dt: the ring's speed
u2 enters by its exact difference and only the forces are integrated numerically. Multiplied by the
inverse of the method's matrix and divided by h r²/I_z' they read, in newtons,

    R_i = Σ_j (A⁻¹)_ij (v_j − v0 − u2_j + u2_0)/(h r²/I_z') + F_i + F_o + F_c |_i = 0,

so a tolerance on the residual is a tolerance on force, however stiff the contact. Every stage has
its own derivative of the force, and Newton's matrix A⁻¹/(h r²/I_z') + diag(F') is exact.

A firmly held roller with microslip slips as the balance of the instant asks. There collocation at
the middle and the end of the step, with the energy by Simpson's rule, takes two force evaluations
in place of three, and is no worse, since slip forgets what it was within a small part of the step:
L-stable, and of order 2 where slip has a memory (its stability function is (1 + z/4)/(1 − 3z/4 +
z²/4)).

Hairer and Wanner, Solving Ordinary Differential Equations II, Springer (1996),
doi:10.1007/978-3-642-05221-7.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.contact.look_up import rising_slip
from macroslip.imposed import tuning
from macroslip.imposed.zones import EDGE, FIRM, FREE
from macroslip.mechanics.spin import (
    FORCES,
    STATION,
    magnitude,
    net_force,
    powers,
    slip_forces,
    station,
)
from macroslip.ring.orbit import instant, interval_of
from macroslip.roller.step import write_stage

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
A11, A12, A13, A21, A22, A23, A31, A32, A33 = (float(x) for x in np.linalg.inv(MATRIX).ravel())
#: Real eigenvalue of A⁻¹.
EIGENVALUE = float(min(np.linalg.eigvals(np.linalg.inv(MATRIX)), key=lambda z: abs(z.imag)).real)
#: √B at which Crook's shear stress peaks (B = 2.2767).
_ROOT_HEATING_AT_PEAK = 1.5088


class Path(NamedTuple):
    """The way of one roller and how it is to be integrated."""

    body: Any  #: Record of a roller
    #: Address of the flat array of its tables: an array would be counted at every look-up
    tables: int
    flat: np.ndarray  #: The array itself
    motion: Any
    start_angle: float  #: Position φ at the first sample [rad]
    limits: Any  #: Record of `LIMITS`, or of `macroslip.imposed.euler.RULE`


#: Tolerance and bounds of the integration, the same for all rollers of a case.
LIMITS = np.dtype(
    [
        # Relative tolerance, of slip against the raceway speed and of energy per step [-].
        ("tolerance", "f8"),
        # Steps after which the integration gives up.
        ("max_steps", "i8"),
        # Largest raceway speed |u2| of the history [m/s].
        ("speed_scale", "f8"),
        # Twice the kinetic energy of a roller's spin at that speed, I_z' u2²/r² [J].
        ("energy_scale", "f8"),
        # Length of the longest step [s].
        ("longest_step", "f8"),
        # Slip below which traction rises with slip at every load of the history [m/s].
        ("cold_slip", "f8"),
        # Interference from which on the roller is firmly held [m].
        ("firm", "f8"),
        # Start of the window [s].
        ("window", "f8"),
        # Change of a slip near zero that does not change its place in a table [m/s]; 0 without
        # tables of traction.
        ("grain", "f8"),
    ]
)

#: Mutable state of one integration: one record that its functions read and write, from which the
#: next call goes on.
WORK = np.dtype(
    [
        # --- The roller now
        # Time [s].
        ("time", "f8"),
        # Index of the sample interval that holds it.
        ("interval", "i8"),
        # Slip Δu [m/s].
        ("slip", "f8"),
        # Station.
        ("at", STATION),
        # Forces on the roller.
        ("forces", FORCES),
        # Powers of its interfaces [W].
        ("powers", "f8", (3,)),
        # --- The step that is tried
        # Length of the step [s].
        ("length", "f8"),
        # 1/(h r²/I_z') [N s/m].
        ("scale", "f8"),
        # Index of the sample interval in which it ends.
        ("end_interval", "i8"),
        # 1 where the step is held, that is of two stages at its middle and end beside its start.
        ("held", "i8"),
        # Times of its stages [s].
        ("times", "f8", (3,)),
        # Weights of its stages, as parts of the step [-].
        ("weights", "f8", (3,)),
        # Stations of its stages.
        ("stage_at", STATION, (3,)),
        # --- Its solution
        # 1 where the stage equations were solved.
        ("converged", "i8"),
        # Slip at the stages [m/s].
        ("v", "f8", (3,)),
        # Increments of slip by forces, s = v − v0 − (u2 − u2_0) [m/s].
        ("s", "f8", (3,)),
        # Forces at the stages.
        ("stage_forces", FORCES, (3,)),
        # Largest force left unbalanced at a stage [N].
        ("left", "f8"),
        # Powers by stage and interface [W].
        ("stage_powers", "f8", (3, 3)),
        # Sums of the powers over the interfaces, at the start and at the stages [W].
        ("totals", "f8", (4,)),
        # Energy of the step [J].
        ("energy", "f8"),
        # --- A sample at another place of the step
        # Station.
        ("there", STATION),
        # Forces.
        ("push", FORCES),
        # Powers of the interfaces [W].
        ("push_powers", "f8", (3,)),
        # Slip [m/s].
        ("there_slip", "f8"),
        # Derivative of the increment of slip by the part of the step [m/s].
        ("there_rate", "f8"),
        # --- Known from steps before
        # Power of the load that the slip of a held roller follows [-].
        ("exponent", "f8"),
        # Residual left by Newton's correction over the square of the correction [N s²/m²]; infinite
        # while it is not known.
        ("bend", "f8"),
        # Length of the last step of three stages [s]; 0 where a held one has come since.
        ("last_length", "f8"),
        # Increments of slip of the last step [m/s].
        ("last_s", "f8", (3,)),
        # --- The stretch
        # Length of the step to try next [s].
        ("step", "f8"),
        # Time at which a step must end [s].
        ("barrier", "f8"),
        # Class of the sample interval; −1 before the first.
        ("zone", "i8"),
        # Index of the last of the sample intervals of this class that follow one another.
        ("run_end", "i8"),
        # Index of the first stop ahead.
        ("next_stop", "i8"),
        # Length of the sample interval [s].
        ("sample_step", "f8"),
        # 1 where the last attempt was rejected.
        ("failed", "i8"),
        # Number that changes where loads have a kink.
        ("stretch", "i8"),
        # --- So far
        # 1 where the integration has begun.
        ("begun", "i8"),
        # Number of steps, rejections and force evaluations.
        ("count", "i8", (3,)),
        # Largest force left unbalanced by an accepted step [N].
        ("unbalanced", "f8"),
        # Energy spent [J]; in the window from there on.
        ("spent", "f8"),
        # Largest raceway power since the roller had no load [W].
        ("top_power", "f8"),
        # Spin ω of the Euler methods, relative to the orbiting frame [rad/s].
        ("spin", "f8"),
    ]
)


@jit_inline
def locate(path, time, interval, found):
    """Write the station of the roller at a time.

    Parameters
    ----------
    path : Path
    time : float
        [s]
    interval : int
        Index of the sample interval that holds the time.
    found : record of `macroslip.mechanics.spin.STATION`
        Is written.
    """
    station(path.body, path.tables, path.start_angle, instant(path.motion, interval, time), found)


@jit_inline
def evaluate(path, at, slip, found):
    """Write the forces on the roller at a station and a slip.

    Parameters
    ----------
    path : Path
    at : record of `macroslip.mechanics.spin.STATION`
    slip : float
        Δu at both raceways [m/s].
    found : record of `macroslip.mechanics.spin.FORCES`
        Is written.
    """
    slip_forces(path.body, path.tables, at, slip, found)


@jit_inline
def start_at(path, work):
    """Find station, forces and powers of the roller now."""
    locate(path, work.time, work.interval, work.at)
    evaluate(path, work.at, work.slip, work.forces)
    powers(path.body, work.at, work.forces, work.slip, work.powers[:])
    work.count[2] += 1


@jit_inline
def frame(work, row, stages, end):
    """Write the fields of a row that concern its whole step.

    Parameters
    ----------
    work : record of `WORK`
        State at the start of the step.
    row : record of `macroslip.roller.step.STEP`
        Is written.
    stages : int
        Number of stages of the row, 1 to 3.
    end : float
        End of the step [s].
    """
    row.start = work.time
    row.end = end
    row.stages = stages
    row.stretch = work.stretch
    row.sampled = 0
    for i in range(3):
        row.power_before[i] = work.powers[i]


@jit_inline
def write_point(path, work, row):
    """Write a row without weight of the roller now."""
    frame(work, row, 1, work.time)
    row.time[0] = work.time
    row.weight[0] = 0.0
    row.sampled = 1
    write_stage(row, 0, path.body, work.at, work.forces, work.slip, work.powers[:])


@jit_inline
def set_step(path, work, length, held):
    """Set up the stages of a step that begins now.

    Parameters
    ----------
    path : Path
    work : record of `WORK`
        State at the start of the step; length, scale, times, weights and stations are written.
    length : float
        Length of the step, > 0 [s].
    held : bool
        Whether the step is held, that is of two stages; it has three otherwise.
    """
    work.length = length
    work.scale = 1.0 / (length * path.body.mobility)
    work.held = 1 if held else 0
    interval = work.interval
    films = work.at.film_load
    for k in range(3):
        work.weights[k] = SIMPSON[k] if held else WEIGHTS[k]
        if held and k == 0:
            work.times[0] = work.time
            work.stage_at[0] = work.at
            continue
        part = 0.5 * k if held else NODES[k]
        # The last stage is the end, without rounding.
        work.times[k] = work.time + (length if k == 2 else part * length)
        interval = interval_of(path.motion, work.times[k], interval)
        # The search for the films' load begins with that of the stage before.
        work.stage_at[k].film_load = films
        locate(path, work.times[k], interval, work.stage_at[k])
        films = work.stage_at[k].film_load
    work.end_interval = interval


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
    return (
        scale * (A11 * z1 + A12 * z2 + A13 * z3) + f1,
        scale * (A21 * z1 + A22 * z2 + A23 * z3) + f2,
        scale * (A31 * z1 + A32 * z2 + A33 * z3) + f3,
    )


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
    second = ((z2 - z1) / (b - a) - first) / b
    third = ((z3 - z2) / (1.0 - b) - (z2 - z1) / (b - a)) / (1.0 - a) - second
    increment = part * (first + (part - a) * (second + (part - b) * third))
    rate = (
        first
        + second * (2.0 * part - a)
        + third * ((part - a) * (part - b) + part * (2.0 * part - a - b))
    )
    return increment, rate


@jit_inline
def look_between(path, work, part):
    """Find station, slip and the rate of its increment at a part of the step that was solved."""
    time = work.time + part * work.length
    work.there.film_load = work.stage_at[1].film_load
    locate(path, time, interval_of(path.motion, time, work.interval), work.there)
    increment, work.there_rate = collocation(part, work.s[0], work.s[1], work.s[2])
    work.there_slip = work.slip + work.there.ring_speed - work.at.ring_speed + increment


@jit_inline
def force_tolerance(tolerance, microslip):
    """Part of the sum of force magnitudes that may stay unbalanced.

    It goes with the tolerance of the integration.
    """
    if not microslip:
        return tuning.FORCE_TOLERANCE
    return max(
        tuning.FORCE_TOLERANCE,
        min(tuning.MICROSLIP_FORCE_SHARE * tolerance, tuning.MICROSLIP_FORCE_TOLERANCE),
    )


@jit_inline
def _new_bend(bend, size, change):
    """The bend after a correction has left a residual of `size` [N].

    Half of what was known is forgotten.
    """
    return max(size / (change * change), tuning.FORGET * bend if bend < math.inf else 0.0)


@jit_inline
def _evaluate_stages(path, work, first):
    """Find the forces at the stages from `first` on, and the increments of slip by forces."""
    for k in range(first, 3):
        evaluate(path, work.stage_at[k], work.v[k], work.stage_forces[k])
        work.s[k] = work.v[k] - work.slip - (work.stage_at[k].ring_speed - work.at.ring_speed)
        work.count[2] += 1


@jit_inline
def _correct(work, change, first, shifted):
    """Correct the slips from stage `first` on by `change` [m/s]; if `shifted`, the forces too."""
    for k in range(first, 3):
        work.v[k] += change[k]
        if shifted:
            shift(work.stage_forces[k], change[k])
            work.s[k] = work.v[k] - work.slip - (work.stage_at[k].ring_speed - work.at.ring_speed)


@jit_inline
def solve_stages(path, work):
    """Solve the stage equations of a step of three stages from the first guess in `work.v`."""
    scale = work.scale
    limits = path.limits
    force_part = force_tolerance(limits.tolerance, path.body.microslip)
    round_off = 4e-15 * scale * (limits.speed_scale + abs(work.slip))
    # Without microslip a roller that grips slips too little for its forces to bend in the same way
    # twice.
    smooth = path.body.microslip or work.zone == FREE
    work.converged = 0
    work.left = math.inf
    change = 0.0
    foreseen = math.inf
    one = work.stage_forces[0]
    two = work.stage_forces[1]
    three = work.stage_forces[2]
    for iteration in range(tuning.ITERATIONS):
        _evaluate_stages(path, work, 0)
        rest = residuals(
            scale, work.s[0], work.s[1], work.s[2], net_force(one), net_force(two), net_force(three)
        )
        size = max(abs(rest[0]), abs(rest[1]), abs(rest[2]))
        solved = True
        for k in range(3):
            forces = work.stage_forces[k]
            allowed = force_part * magnitude(forces) + limits.grain * abs(forces.slope) + round_off
            solved = solved and abs(rest[k]) <= allowed
        if solved:
            work.converged = 1
            work.left = size
            return
        if not math.isfinite(size) or (iteration > 2 and size > 0.9 * work.left):
            return
        # Newton's residuals shrink quadratically: the next one is predicted from the last two, or
        # with a known bend from the first correction, and where it is small enough the forces
        # follow to first order, without an evaluation.
        if iteration > 0:
            foreseen = size * size / work.left
            if iteration == 1:
                work.bend = _new_bend(work.bend, size, change)
        update = newton_update(scale, one.slope, two.slope, three.slope, rest)
        change = max(abs(update[0]), abs(update[1]), abs(update[2]))
        if iteration == 0:
            foreseen = tuning.BEND_SAFETY * work.bend * change * change if smooth else math.inf
        work.left = size
        least = min(magnitude(one), magnitude(two), magnitude(three))
        is_close = iteration == 0 or size <= tuning.LAST_REST * least + round_off
        last = is_close and foreseen <= force_part * least + round_off
        _correct(work, update, 0, last)
        if last:
            work.converged = 1
            work.left = foreseen
            return


@jit_inline
def follows_loads(path, work, length):
    """True if a roller is at its balance and forgets its slip within a small part of a step.

    The step has `length` [s].
    """
    if work.zone != FIRM or not path.body.microslip:
        return False
    held = path.body.mobility * work.forces.slope * length > tuning.QUASI_STATIC
    return held and abs(net_force(work.forces)) <= tuning.SETTLED_FORCE * magnitude(work.forces)


@jit_inline
def held_update(scale, d2, d3, rest_2, rest_3):
    """Newton correction of the two stage slips of a held step.

    It solves the linearised equations R_2 = scale (v_3 − …) + F_2 and R_3 = scale (3 v_3 − 4 v_2 +
    …) + F_3.

    Parameters
    ----------
    scale : float
        1/(h r²/I_z') [N s/m].
    d2, d3 : float
        Slopes of the net force by slip at the middle and at the end, > 0 [N s/m].
    rest_2, rest_3 : float
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
    change_3 = (-rest_3 * d2 - 4.0 * scale * rest_2) / (last * d2 + 4.0 * scale * scale)
    return (-rest_2 - scale * change_3) / d2, change_3


@jit_inline
def solve_held(path, work):
    """Solve the stage equations of a held step.

    It is not converged where Newton would need a better guess than is available.
    """
    scale = work.scale
    slip = work.slip
    at = work.at
    middle = work.stage_at[1]
    end = work.stage_at[2]
    second = work.stage_forces[1]
    third = work.stage_forces[2]
    work.stage_forces[0] = work.forces
    work.v[0] = slip
    work.s[0] = 0.0
    force_part = force_tolerance(path.limits.tolerance, path.body.microslip)
    work.v[1] = held_slip(path.body.microslip, slip, at, middle, work.exponent)
    evaluate(path, middle, work.v[1], second)
    # The middle first, with the end as far ahead as the middle: its solution makes a good guess of
    # the end.
    rest = scale * 2.0 * (work.v[1] - slip - (middle.ring_speed - at.ring_speed)) + net_force(
        second
    )
    ahead = work.v[1] - rest / (2.0 * scale + second.slope)
    work.v[2] = held_slip(
        path.body.microslip,
        ahead,
        middle,
        end,
        held_exponent(at, slip, middle, ahead, work.exponent),
    )
    evaluate(path, end, work.v[2], third)
    work.count[2] += 2
    for k in range(1, 3):
        work.s[k] = work.v[k] - slip - (work.stage_at[k].ring_speed - at.ring_speed)
    work.converged = 0
    work.left = math.inf
    change = 0.0
    foreseen = math.inf
    for iteration in range(tuning.HELD_ITERATIONS):
        rest_2 = scale * work.s[2] + net_force(second)
        rest_3 = scale * (3.0 * work.s[2] - 4.0 * work.s[1]) + net_force(third)
        size = max(abs(rest_2), abs(rest_3))
        allowed = force_part * min(magnitude(second), magnitude(third))
        if not math.isfinite(size) or second.slope <= 0.0 or third.slope <= 0.0:
            return
        if iteration > 0:
            if iteration == 1:
                work.bend = _new_bend(work.bend, size, change)
            if size > 0.9 * work.left and size > allowed:
                return
            foreseen = min(size, size * size / work.left)
        update = held_update(scale, second.slope, third.slope, rest_2, rest_3)
        change = max(abs(update[0]), abs(update[1]))
        if iteration == 0:
            foreseen = tuning.BEND_SAFETY * work.bend * change * change
        work.left = size
        last = foreseen <= allowed
        _correct(work, (0.0, update[0], update[1]), 1, last)
        if last:
            work.converged = 1
            work.left = foreseen
            return
        _evaluate_stages(path, work, 1)


@jit_inline
def held_slip(microslip, slip, at, later, exponent):
    """First guess of the slip of a firmly held roller at a later station.

    With microslip the middle slips so that the two sides of the lines of pure rolling balance: in
    proportion to speed, and to a power of the load that `held_exponent` measures.

    Parameters
    ----------
    microslip : bool
        Whether the contacts have microslip; the guess is the slip now without.
    slip : float
        Slip now [m/s].
    at, later : record of `macroslip.mechanics.spin.STATION`
        Stations now and later.
    exponent : float
        Power of the elastic load that slip follows [-].

    Returns
    -------
    float
        Slip at the later station [m/s]; that of now where load or speed give no ratio, or where
        speed grows by more than `MOST_QUICKENING`.
    """
    if not microslip or at.elastic_load <= 0.0 or at.ring_speed == 0.0 or later.elastic_load <= 0.0:
        return slip
    if abs(later.ring_speed) > tuning.MOST_QUICKENING * abs(at.ring_speed):
        return slip
    return (
        slip
        * (later.elastic_load / at.elastic_load) ** exponent
        * (later.ring_speed / at.ring_speed)
    )


@jit_inline
def held_exponent(at, slip, later, later_slip, exponent):
    """Power of the elastic load that the slip of a held roller has just followed.

    Parameters
    ----------
    at, later : record of `macroslip.mechanics.spin.STATION`
        Stations before and after the change.
    slip, later_slip : float
        Slips at these stations [m/s].
    exponent : float
        Power known from before [-].

    Returns
    -------
    float
        The power, between ±`STEEPEST` [-]; that of before where it cannot be measured.
    """
    if at.elastic_load <= 0.0 or later.elastic_load <= 0.0:
        return exponent
    change = math.log(later.elastic_load / at.elastic_load)
    ratio = (
        later_slip * at.ring_speed / (slip * later.ring_speed)
        if slip * later.ring_speed != 0.0
        else 0.0
    )
    if abs(change) < tuning.LEAST_CHANGE or ratio <= 0.0:
        return exponent
    return min(max(math.log(ratio) / change, -tuning.STEEPEST), tuning.STEEPEST)


@jit_inline
def guess(path, work):
    """Write the slip at the stages [m/s] to start Newton's iteration from.

    Where slip is smooth, the polynomial of the step before is continued. Otherwise a roller that
    drifts under small forces continues with the acceleration of the forces at the start, and one
    stuck to the cage keeps its spin; any other starts from the slip before the step, which
    `held_slip` changes with the load if the roller follows its loads.
    """
    h = work.length
    slip = work.slip
    forces = work.forces
    at = work.at
    microslip = path.body.microslip
    last = work.last_s
    gripped = path.body.mobility * forces.slope * h
    continues = (
        work.zone != FIRM and h <= tuning.MOST_AHEAD * work.last_length and gripped < tuning.GRIPPED
    )
    drifts = gripped < 1.0 and work.zone != EDGE
    # The cage may hold the roller: its spin then stays as it is, at zero.
    spins = drifts or forces.slope > 2.0 * (forces.inner_slope + forces.outer_slope)
    follows = work.zone == FIRM or (
        microslip and gripped > tuning.GRIPPED and work.stage_at[2].elastic_load > 0.0
    )
    drift = -path.body.mobility * net_force(forces) * h if drifts else 0.0
    for k in range(3):
        quickening = work.stage_at[k].ring_speed - at.ring_speed
        if continues:
            ahead, _ = collocation(1.0 + NODES[k] * h / work.last_length, last[0], last[1], last[2])
            work.v[k] = slip - last[2] + quickening + ahead
            continue
        work.v[k] = slip + quickening + drift * NODES[k] if spins else slip
        if follows:
            work.v[k] = held_slip(microslip, work.v[k], at, work.stage_at[k], work.exponent)


@jit_inline
def _steady_slip(law, tables, closed_form, load, speed):
    """Slip [m/s] up to which the force of a contact rises with slip."""
    if load <= 0.0:
        return math.inf
    if not closed_form:
        return rising_slip(law.traction, tables, load, speed)
    if law.heating == 0.0:
        return 2.0 * speed  # where the film ends
    # The middle of the contact is its hottest point.
    return (
        _ROOT_HEATING_AT_PEAK
        / law.heating
        * math.exp(-0.5 * law.pressure_exponent * load ** (1.0 / 3.0))
    )


@jit
def surely_rising(body, tables, inner_load, outer_load, speed):
    """Slip up to which the friction of both raceways rises with slip.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    tables : ndarray
        The flat array of tables.
    inner_load, outer_load : float
        Normal loads of the raceways [N].
    speed : float
        Largest ring speed, ≥ 0 [m/s].

    Returns
    -------
    float
        Slip, > 0 [m/s]; infinite without load.
    """
    return min(
        _steady_slip(body.inner, tables, body.closed_form, inner_load, speed),
        _steady_slip(body.outer, tables, body.closed_form, outer_load, speed),
    )


@jit
def is_continuous(path, work):
    """True if the stages of a step are sure to be the root continuous with the slip before it.

    Below the slip at which some part of a contact passes its peak of traction, forces rise with
    slip and the stage equations have one root. Above it, a step is accepted only where slip changes
    so little, and traction falls so gently, that the root found is the continuous one.
    """
    slip = work.slip
    limits = path.limits
    at = work.at
    change = 0.0
    largest = abs(slip)
    inner = at.inner_load
    outer = at.outer_load
    for k in range(3):
        # More than one root is possible only where traction falls with slip faster than the step
        # allows.
        if work.stage_forces[k].slope < -0.5 * work.scale:
            return False
        change = max(change, abs(work.v[k] - slip))
        largest = max(largest, abs(work.v[k]))
        inner = max(inner, work.stage_at[k].inner_load)
        outer = max(outer, work.stage_at[k].outer_load)
    if (
        change <= tuning.HOT_CHANGE * abs(slip) + tuning.SMALL_CHANGE * limits.speed_scale
        or largest <= limits.cold_slip
    ):
        return True
    ring = max(abs(at.ring_speed), abs(work.stage_at[2].ring_speed))
    return largest <= surely_rising(path.body, path.flat, inner, outer, ring)
