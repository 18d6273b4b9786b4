"""Integration of the whole bearing by Alexander's method of two implicit stages.

It is of second order and L-stable.

Nodes γ and 1, γ = 1 − 1/√2, the last stage being the step's end. The error is the difference to a
third-order quadrature of the slopes at the step's start and both stages, divided by the stage's
matrix, which takes out what a gripped contact damps.

Tractions are extrapolated linearly between evaluations: at every evaluation the force predicted by
the slopes of the evaluation before is compared with the new one, and the time to the next
evaluation follows from the difference.

It computes steps and nothing else. They go into buffers; when these are full the kernel returns,
and goes on where it was when it is called again.

References
----------
Alexander, SIAM J. Numer. Anal. 14 (1977) 1006, doi:10.1137/0714068.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline, uncounted
from macroslip.contact.look_up import REST_SPEED, contact_speed
from macroslip.errors import InputError
from macroslip.imposed.status import (
    COMPLETED,
    NOT_FINITE,
    OUTSIDE_TABLES,
    STEP_TOO_SMALL,
    TOO_MANY_STEPS,
    UNDER_WAY,
)
from macroslip.mechanics.power import cage_power, rolling_power, total_power
from macroslip.mechanics.speeds import outer_ring_speed
from macroslip.ring.orbit import Motion, instant, interval_of, uncounted_motion
from macroslip.roller.step import STEP
from macroslip.whole import tuning
from macroslip.whole.books import STEP_FLOWS, add_flows
from macroslip.whole.cage import Cage
from macroslip.whole.model import Assembly, WholeBearing
from macroslip.whole.stage import (
    FIRST,
    FIRST_RATE,
    LAST,
    LAST_RATE,
    SLOPE,
    STAR,
    STATE,
    Space,
    Stage,
    new_space,
    solve,
    solve_stage,
)
from macroslip.whole.tractions import (
    cage_shear_from,
    copy_linearisation,
    evaluate_marked,
    extrapolated_power,
    locate,
    raceway_from,
    shear_from,
)

#: Node of the first stage.
GAMMA = 1.0 - math.sqrt(0.5)
#: Weights of the slopes at start, first and second stage in (third-order quadrature) − (the
#: method's).
_E1 = (0.5 - 1.0 / 3.0) / (GAMMA * (1.0 - GAMMA))
_E2 = 0.5 - GAMMA * _E1
_ERROR = (1.0 - _E1 - _E2, _E1 - (1.0 - GAMMA), _E2 - GAMMA)
#: γh of the stage that evaluates the start [s].
_INSTANT = 1e-12
#: Size of the buffer of steps [bytes].
_BUFFER = 16 * 2**20

#: Tolerance and bounds of the integration.
LIMITS = np.dtype(
    [
        ("allowed_speed", "f8"),  # error of speed that a step may make [m/s]
        ("power", "f8"),  # allowed relative error of power where slopes predict it [-]
        ("force", "f8"),  # largest force an iteration may leave unbalanced [N]
        # Rounding of speeds [m/s]; times mass over step it is the force below which no iteration
        # can get.
        ("rounding", "f8"),
        ("longest_step", "f8"),  # longest step [s]
        ("longest_interval", "f8"),  # longest time between evaluations of tractions [s]
        # Relative change of load or slip within which the slopes of a cage's contact serve [-].
        ("cage_reach", "f8"),
        # Change of a raceway's force by slip over its load within which its slopes serve [-].
        ("slip_reach", "f8"),
        ("slowest", "f8"),  # least speed of a raceway contact in its tables [m/s]
        ("max_steps", "i8"),  # most steps, with those rejected
        ("extrapolates", "i8"),  # 1 if tractions may follow from slopes between evaluations, or 0
    ]
)
#: State of the kernel between two calls.
MEMORY = np.dtype(
    [
        ("begun", "i8"),  # 1 if the start has been written, or 0
        ("time", "f8"),  # end of the last step [s]
        ("interval", "i8"),  # sample interval that holds this time
        ("shaft_speed", "f8"),  # Ω_in at this time [rad/s]
        ("step", "f8"),  # the next step [s]
        ("failed", "i8"),  # 1 if the last step was rejected, or 0
        ("next_stop", "i8"),  # index of the next stop
        ("spent", "f8"),  # frictional energy of the raceways so far [J]
        ("unbalanced", "f8"),  # largest force that an accepted step left unbalanced [N]
        ("steps", "i8"),  # accepted steps
        ("rejections", "i8"),  # rejected steps
        ("evaluations", "i8"),  # evaluations of a raceway contact
        ("iterations", "i8"),  # iterations of Newton's method
    ]
)
#: A step of the whole bearing; cages are two where there is one, the second being zero.
BEARING_STEP = np.dtype(
    [
        ("start", "f8"),  # [s]
        ("end", "f8"),  # [s]
        ("shaft_speed", "f8", (2,)),  # at the stages [rad/s]
        ("turn", "f8", (2, 2)),  # angle by which the cages' pockets have turned at the stages [rad]
        # At the end: lead w at the pitch radius [m/s], lag ∫w dt [m], speeds p, q [m/s] and
        # displacements a, b [m].
        ("cages", "f8", (2, 6)),
        # Of the rollers on the cages at the end, positive along the orbit [N m].
        ("torque", "f8", (2,)),
        ("flows", STEP_FLOWS),  # angular impulses [N m s] and energies [J]
    ]
)


class Clock(NamedTuple):
    """A time with its sample interval and shaft speed."""

    time: float  #: [s]
    interval: int  #: Sample interval that holds this time
    shaft_speed: float  #: Ω_in at this time [rad/s]


class Start(NamedTuple):
    """Initial state other than pure rolling on the bearing's axis."""

    offset: np.ndarray  #: Shape (n,). Places in the pockets [m].
    slip_inner: np.ndarray  #: Shape (n,). v_in [m/s].
    slip_outer: np.ndarray  #: Shape (n,). v_out [m/s].
    #: Shape (c,). w, speed of a cage at the pitch radius beyond that of pure rolling [m/s].
    cage_lead: np.ndarray


class Part(NamedTuple):
    """Successive steps, as views of buffers that the next part overwrites."""

    status: int  #: UNDER_WAY, but for the last part a `macroslip.imposed.status.Status`
    #: Shape (m, n). Two stages each. The first row of an integration is its start: it has no
    #: length, one stage and no weight.
    steps: np.ndarray
    bearing: np.ndarray  #: shape (m,)
    #: Shape (m, n). Rollers' ways ahead of the middle of their pockets at the end [m].
    offset: np.ndarray
    memory: np.void  #: Record of `MEMORY`. Time, counts and unbalanced force so far.


def pure_rolling(bearing: WholeBearing, cage: Cage) -> Start:
    """All rollers in pure rolling at their initial offsets, cages with them."""
    count = bearing.positions.size
    offset = cage.start_offsets(count)
    return Start(offset, np.zeros(count), np.zeros(count), np.zeros(bearing.cages))


def steps_of(
    assembly: Assembly,
    motion: Motion,
    start: Start,
    stops: np.ndarray,
    *,
    tolerance: float = 2e-4,
    max_steps: int = 100_000_000,
    extrapolates: bool = True,
) -> Iterator[Part]:
    """Integrate all rollers and cages over the motion of the inner ring.

    Parameters
    ----------
    assembly : Assembly
    motion : Motion
    start : Start
        State at the first sample.
    stops : ndarray
        Times at which a step must end [s], rising, after the first sample; the last is the end.
    tolerance : float
        Relative error of energies [-].
    max_steps : int
        Steps, with those rejected, after which it gives up.
    extrapolates : bool
        Whether tractions may follow from their slopes between evaluations; without, every iteration
        evaluates all.

    Yields
    ------
    Part
        Some hundred steps each.

    Raises
    ------
    InputError
        A start that is not finite.
    """
    for name, values in zip(start._fields, start, strict=True):
        if not np.isfinite(values).all():
            raise InputError("it is not finite", where=f"start, {name}", allowed="finite numbers")
    stops = np.ascontiguousarray(stops, dtype=float)
    memory = np.zeros(1, MEMORY)
    memory["time"] = motion.time[0]
    memory["shaft_speed"] = motion.shaft_speed[0]
    memory["step"] = tuning.FIRST_STEP
    space = new_space(assembly, memory)
    space.rollers["y"][:, STATE] = np.column_stack(
        [start.slip_inner, start.slip_outer, start.offset]
    )
    space.cages["y"][:, STATE, 0] = start.cage_lead
    limits = _limits(assembly, motion, float(stops[-1]), tolerance)
    limits["max_steps"] = max_steps
    limits["extrapolates"] = extrapolates
    count = assembly.positions.size
    rows = max(_BUFFER // (STEP.itemsize * count), 16)
    steps = np.zeros((rows, count), STEP)
    whole = np.zeros(rows, BEARING_STEP)
    offset = np.zeros((rows, count))
    status = UNDER_WAY
    while status == UNDER_WAY:
        # Every row gets the flows of one step, which are added to it.
        whole["flows"] = 0.0
        status, done = integrate(assembly, motion, stops, limits, space, steps, whole, offset)
        yield Part(status, steps[:done], whole[:done], offset[:done], memory[0])


def _limits(assembly: Assembly, motion: Motion, end: float, tolerance: float) -> np.ndarray:
    """Bounds for a relative tolerance and the largest raceway speed of the history."""
    bearing = assembly.bearing[0]
    body = assembly.bodies[0]
    fastest = np.abs(motion.shaft_speed).max()
    pure_speed = float(fastest * bearing["orbit_ratio"] * bearing["outer_radius"])
    scale = max(pure_speed, tuning.LEAST_SPEED)
    dry = bearing["pocket"]["film"] == 0.0
    if not body["microslip"]:
        tolerance *= tuning.GRIPPED_DRY if dry else tuning.GRIPPED
    limits = np.zeros(1, LIMITS)
    ringing = tuning.RINGING if dry else 1.0
    limits["allowed_speed"] = tuning.SPEED_SHARE * ringing * tolerance * scale
    limits["power"] = tuning.POWER_SHARE * tolerance
    limits["force"] = tuning.FORCE_SHARE * tolerance
    limits["rounding"] = 4.0 * float(np.finfo(float).eps) * scale
    duration = end - float(motion.time[0])
    limits["longest_step"] = min(tuning.LONGEST_STEP, 0.1 * duration)
    limits["longest_interval"] = tuning.LONGEST_INTERVAL
    # What slopes leave out goes with the square of their reach.
    finer = min(1.0, math.sqrt(tolerance / 2e-4))
    limits["cage_reach"] = tuning.CAGE_REACH * finer
    limits["slip_reach"] = tuning.SLIP_REACH * finer
    # Axes of tables are of w^(1/4).
    first_nodes = [float(body[name]["traction"]["speed"]["first"]) for name in ("inner", "outer")]
    limits["slowest"] = max(first_nodes) ** 4
    return limits


@jit_inline
def _interval_of(motion, time, start):
    """Sample interval of `time` [s].

    A sample's own time belongs to the interval that ends there, if `start` is before it.
    """
    k = interval_of(motion, time, start)
    return k - 1 if k > start and time <= motion.time[k] else k


@jit_inline
def _guess(y, k, step, span, lost):
    """Write y* of a stage and a first guess of its unknowns for a roller or cage.

    The first stage's slope acts during `span` [s]; `step` is γh [s]. The first unknown, a speed,
    loses `lost` [m/s] with the shaft's.
    """
    rate = SLOPE if k == 0 else FIRST_RATE
    star = y[STAR]
    guess = y[FIRST + k]
    for i in range(y.shape[1]):
        star[i] = y[STATE, i] + span * y[FIRST_RATE, i]
    star[0] -= lost
    for i in range(y.shape[1]):
        guess[i] = star[i] + step * y[rate, i]


@jit_inline
def _guess_gripped(y, k, linear, mobility):
    """Guess that the slips of gripped contacts of a roller stay what they are.

    `linear` is the record of its `LINEARISATIONS`, `mobility` γh over its mass [s/kg].
    """
    before = STATE if k == 0 else FIRST
    if linear.inner.turning_by_slip * mobility > tuning.GRIPPED_GUESS:
        y[FIRST + k, 0] = y[before, 0]
    if linear.outer.turning_by_slip * mobility > tuning.GRIPPED_GUESS:
        y[FIRST + k, 1] = y[before, 1]


@jit_inline
def _guess_all(assembly, k, step, span, change, space):
    """Write y* of a stage and a first guess of its unknowns for all rollers and cages.

    The shaft's speed has changed by `change` [rad/s] since the step's start; the other numbers are
    those of `_guess`.
    """
    bearing = assembly.bearing[0]
    rollers = space.rollers
    cages = space.cages
    linearisations = space.linearisations[0]
    for j in range(rollers.size):
        y = rollers[j].y
        _guess(y, k, step, span, assembly.positions[j].inner_radius * change)
        _guess_gripped(y, k, linearisations[j], step / bearing.roller_mass)
    for c in range(cages.size):
        _guess(cages[c].y, k, step, span, 0.5 * bearing.inner_radius * change)


@jit_inline
def _write_stage(assembly, k, time, weight, space, row):
    """Write the solved stage `k` of a step into the rollers' records.

    The stage is at `time` [s] and has the weight `weight` [s].
    """
    conditions = space.conditions[k]
    linearisations = space.linearisations[0]
    rollers = space.rollers
    for j in range(row.size):
        step = row[j]
        body = assembly.bodies[assembly.positions[j].row]
        at = conditions[j]
        linear = linearisations[j]
        own = rollers[j].y[FIRST + k]
        at_inner = (at.inner_load, at.inner_speed, own[0])
        at_outer = (at.outer_load, at.outer_speed, own[1])
        shear_in = shear_from(linear.inner, *at_inner)
        shear_out = shear_from(linear.outer, *at_outer)
        shear_cage = cage_shear_from(linear.cage, at.push, at.sliding)
        inner, rolling_in, rough_in = extrapolated_power(
            linear.inner, body.inner, at.turning_inner, at.pull_inner, shear_in, *at_inner
        )
        outer, rolling_out, rough_out = extrapolated_power(
            linear.outer, body.outer, at.turning_outer, at.pull_outer, shear_out, *at_outer
        )
        step.time[k] = time
        step.weight[k] = weight
        step.inner_load[k], step.inner_speed[k], step.inner_slip[k] = at_inner
        step.outer_load[k], step.outer_speed[k], step.outer_slip[k] = at_outer
        step.elastic_load[k] = at.elastic_load
        step.cage_load[k] = at.push
        step.cage_speed[k] = -at.sliding
        force = step.force[k]
        power = step.power[k]
        rolling = step.rolling[k]
        rough = step.rough[k]
        # Without rolling resistance, as on an imposed orbit.
        force[0] = at.turning_inner - shear_in
        force[1] = at.turning_outer - shear_out
        force[2] = at.friction - shear_cage
        power[0] = total_power(inner)
        power[1] = total_power(outer)
        power[2] = cage_power(force[2], at.sliding)
        rolling[0] = rolling_in
        rolling[1] = rolling_out
        rolling[2] = rolling_power(shear_cage, -0.5 * at.sliding)
        rough[0] = rough_in
        rough[1] = rough_out
        rough[2] = 0.0
        if linear.cage.load > 0.0:
            rough[2] = linear.cage.rough * abs(at.push) / linear.cage.load
        step.lag_power[k, 0] = inner.curvature
        step.lag_power[k, 1] = outer.curvature
        step.skew_power[k, 0] = inner.contact_spin
        step.skew_power[k, 1] = outer.contact_spin


@jit_inline
def _keep_rate(step, k, space):
    """Write the rates of the unknowns at a solved stage."""
    rollers = space.rollers
    cages = space.cages
    conditions = space.conditions[k]
    for j in range(rollers.size):
        y = rollers[j].y
        own = y[FIRST + k]
        star = y[STAR]
        rate = y[FIRST_RATE + k]
        for i in range(2):
            rate[i] = (own[i] - star[i]) / step
        rate[2] = conditions[j].pocket_speed
    for c in range(cages.size):
        y = cages[c].y
        own = y[FIRST + k]
        star = y[STAR]
        rate = y[FIRST_RATE + k]
        for i in range(6):
            rate[i] = (own[i] - star[i]) / step


@jit_inline
def _solve_stages(assembly, motion, limits, start, end, space, row, whole):
    """Solve the stages of a step and write them.

    A step without length has one stage, which evaluates the state.

    Returns the largest residual [N], and whether the stages are solved.
    """
    h = end.time - start.time
    tolerance = math.inf
    stages = 2
    step = GAMMA * h
    if h == 0.0:
        stages = 1
        step = _INSTANT
    else:
        tolerance = limits.force + assembly.bearing[0].roller_mass / step * limits.rounding
    for j in range(space.rollers.size):
        copy_linearisation(space.numbers, j, 1, 0)
    schedules = space.schedules
    evaluates_all = limits.extrapolates == 0 or h == 0.0
    for j in range(schedules.size):
        schedules[j].fresh = evaluates_all or schedules[j].interval < h
    worst = 0.0
    solved = True
    for k in range(stages):
        if solved:
            time = start.time + GAMMA * h if k == 0 else end.time
            interval = _interval_of(motion, time, start.interval)
            now = instant(motion, interval, time)
            span = k * (1.0 - GAMMA) * h
            change = now.shaft_speed - start.shaft_speed
            _guess_all(assembly, k, step, span, change, space)
            locate(
                assembly,
                now,
                FIRST + k,
                space.rollers,
                space.cages,
                space.conditions[k],
                whole.turn[k],
            )
            stage = Stage(
                step, time, now.shaft_speed, tolerance, limits.cage_reach, limits.slip_reach
            )
            residual = solve_stage(assembly, stage, k, space)
            solved = residual <= tolerance
            worst = max(worst, residual) if solved else residual
            if solved:
                _keep_rate(step, k, space)
                whole.shaft_speed[k] = now.shaft_speed
                part = 1.0 - GAMMA if k == 0 else GAMMA
                _write_stage(assembly, k, time, h * part, space, row)
    return worst, solved


@jit_inline
def _off(y, i):
    """Error estimate of an unknown's rate, from its rates at start and stages."""
    start = _ERROR[0] * y[SLOPE, i]
    first = _ERROR[1] * y[FIRST_RATE, i]
    last = _ERROR[2] * y[LAST_RATE, i]
    return start + first + last


@jit_inline
def _step_error(assembly, limits, h, space):
    """Error / tolerance of a solved step of `h` [s]."""
    bearing = assembly.bearing[0]
    allowed = limits.allowed_speed
    worst = 0.0
    rollers = space.rollers
    cages = space.cages
    blocks = space.blocks
    borders = space.borders
    for j in range(rollers.size):
        y = rollers[j].y
        residual = blocks[j].residual
        for i in range(2):
            residual[i] = bearing.roller_mass / GAMMA * _off(y, i)
        offset_error = abs(h * _off(y, 2))
        worst = max(worst, offset_error / (allowed * tuning.PLACE_TIME))
    for c in range(cages.size):
        y = cages[c].y
        residual = borders[c].residual
        for i in range(3):
            speed = 0 if i == 0 else i + 1
            residual[i] = bearing.cage_mass / GAMMA * _off(y, speed)
    size = 3 if bearing.translates else 1
    solve(assembly.positions, size, blocks, borders)
    for j in range(rollers.size):
        residual = blocks[j].residual
        worst = max(worst, abs(residual[0]) / allowed, abs(residual[1]) / allowed)
    for c in range(cages.size):
        for i in range(size):
            worst = max(worst, abs(borders[c].residual[i]) / allowed)
    return worst


@jit_inline
def _contact_off(known, linear, law, mass, limits, span, power_scale):
    """Error / tolerance of the extrapolated forces and powers of a raceway contact.

    They are extrapolated from `known` to the new evaluation `linear`, `span` [s] later; `law` is the
    raceway's record of `CONTACT`, `mass` a roller's [kg].
    """
    load = linear.load
    speed = linear.speed
    slip = linear.slip
    turning, pull = raceway_from(known, load, speed, slip)
    off = max(abs(turning - linear.turning), abs(pull - linear.pull))
    inertia = mass / max(span, 1e-9)
    stiffest = max(linear.turning_by_slip, linear.pull_by_slip, 0.0)
    drift = off / (inertia + stiffest)
    shear = shear_from(known, load, speed, slip)
    guess, rolling_guess, _ = extrapolated_power(
        known, law, turning, pull, shear, load, speed, slip
    )
    friction, rolling, _ = extrapolated_power(
        linear, law, linear.turning, linear.pull, linear.shear, load, speed, slip
    )
    wrong = rolling_guess - rolling
    power = abs(rolling)
    for k in range(3):
        wrong += guess[k] - friction[k]
        power += abs(friction[k])
    allowed_change = tuning.LOAD_CHANGE * max(load, known.load) + 1e-9
    change = abs(load - known.load) / allowed_change
    allowed_power = limits.power * (power + power_scale) + 1e-12
    worst = max(drift / limits.allowed_speed, abs(wrong) / allowed_power)
    return max(worst, change * change)


@jit_inline
def _refresh(assembly, limits, time, space, power_scale):
    """Evaluate the rollers that are due at the step's end, and schedule their next evaluation.

    `power_scale` is the mean frictional power of a raceway contact so far [W]. Returns whether the
    forces of all resting rollers were near those predicted; otherwise the step has to be repeated.
    """
    schedules = space.schedules
    conditions = space.conditions[1]
    linearisations = space.linearisations[0]
    known = space.linearisations[1]
    for j in range(schedules.size):
        schedule = schedules[j]
        is_old = time - known[j].when >= schedule.interval
        is_of_now = schedule.fresh and linearisations[j].when == time
        schedule.due = schedule.fresh or is_old
        schedule.marked = schedule.due and not is_of_now
    # The last stage as a sum, as stages are numbered elsewhere: for a constant all of it would be
    # compiled once more.
    space.memory[0].evaluations += evaluate_marked(
        assembly, time, conditions, space.rollers, FIRST + 1, schedules, linearisations
    )
    mass = assembly.bearing[0].roller_mass
    good = True
    for j in range(schedules.size):
        schedule = schedules[j]
        body = assembly.bodies[assembly.positions[j].row]
        new = linearisations[j]
        old = known[j]
        if schedule.due:
            span = time - old.when
            inner = _contact_off(old.inner, new.inner, body.inner, mass, limits, span, power_scale)
            outer = _contact_off(old.outer, new.outer, body.outer, mass, limits, span, power_scale)
            schedule.ratio = max(inner, outer)
            if not schedule.fresh and schedule.ratio > tuning.FAR_OFF and span > 0.0:
                schedule.interval = 0.0
                good = False
    # Intervals change only after a good step: a roller that has to be evaluated in its repetition
    # would be extrapolated again.
    for j in range(schedules.size):
        schedule = schedules[j]
        if good and schedule.due:
            factor = 0.0
            if schedule.ratio <= tuning.FAR_OFF:
                factor = tuning.INTERVAL_SAFETY / math.sqrt(max(schedule.ratio, 1e-4))
                factor = max(tuning.INTERVAL_PART, min(factor, tuning.INTERVAL_GROWTH))
            interval = (time - known[j].when) * factor
            schedule.interval = min(limits.longest_interval, interval)
    return good


@jit_inline
def _touch_ahead(pocket, rollers, h):
    """Part of `h` [s] after which the first free roller meets a spar; 1 if none does."""
    part = 1.0
    for j in range(rollers.size):
        y = rollers[j].y
        offset = y[STATE, 2]
        speed = y[SLOPE, 2]
        if abs(offset) < pocket.half_gap and speed != 0.0:
            way = pocket.half_gap - offset if speed > 0.0 else pocket.half_gap + offset
            part = min(part, way / (abs(speed) * h))
    return part


@jit_inline
def _impact_step(bearing, rollers):
    """First step [s] of the fastest dry impact that has just begun; infinite if none has.

    A mass m that runs at v into K δ^1.5 goes in by (5 m v²/4K)^0.4; the step is the time in which
    it travels a part of that.
    """
    pocket = bearing.pocket
    shortest = math.inf
    for j in range(rollers.size):
        y = rollers[j].y
        offset = y[STATE, 2]
        speed = y[SLOPE, 2]
        depth = abs(offset) - pocket.half_gap
        if depth > 0.0 and offset * speed > 0.0:
            deepest = (1.25 * bearing.roller_mass * speed * speed / pocket.stiffness) ** 0.4
            if depth < tuning.BEGUN * deepest:
                shortest = min(shortest, tuning.IMPACT_PART * deepest / abs(speed))
    return shortest


@jit_inline
def _cut(bearing, rollers, step, left):
    """Step shortened to end at the next stop, or half-way to it [s].

    With dry impacts to just after a touch, so that the impact begins in the step after, which is as
    short as it needs.
    """
    dry = bearing.pocket.film == 0.0
    if dry:
        step = min(step, _impact_step(bearing, rollers))
    h = step
    if step >= 0.95 * left:
        h = left
    elif step > 0.6 * left:
        h = 0.5 * left
    if dry:
        part = _touch_ahead(bearing.pocket, rollers, h)
        if part * h > 2e-5 and part < 0.98:
            h = 1.0005 * part * h
    return h


@jit_inline
def _leaves_tables(assembly, limits, space):
    """True if a roller ends the step in a state outside its tables."""
    body = assembly.bodies[0]
    conditions = space.conditions[1]
    rollers = space.rollers
    highest = body.highest_speed + 2.0 * REST_SPEED
    for j in range(conditions.size):
        at = conditions[j]
        own = rollers[j].y[LAST]
        if max(at.inner_load, at.outer_load, abs(at.push)) > body.highest_load:
            return True
        inner = contact_speed(at.inner_speed, own[0])
        outer = contact_speed(at.outer_speed, own[1])
        if max(inner, outer) > highest or min(inner, outer) < limits.slowest:
            return True
    return False


@jit_inline
def _write_end(assembly, start, end, space, row, whole, offset):
    """Write the fields of a step's records that concern its end, and its flows."""
    bearing = assembly.bearing[0]
    positions = assembly.positions
    begins = end.time == start.time
    last = 0 if begins else 1
    rollers = space.rollers
    cages = space.cages
    conditions = space.conditions[last]
    pure_speed = outer_ring_speed(bearing.orbit_ratio * end.shaft_speed, bearing.outer_radius)
    whole.start = start.time
    whole.end = end.time
    for k in range(last + 1):
        span = row[0].weight[k]
        add_flows(assembly, whole.shaft_speed[k], k, span, space, whole.flows)
    for c in range(bearing.cages):
        whole.torque[c] = 0.0
        cage = cages[c].y[FIRST + last]
        for i in range(6):
            whole.cages[c, i] = cage[i]
    for j in range(row.size):
        step = row[j]
        at = conditions[j]
        own = rollers[j]
        step.start = start.time
        step.end = end.time
        step.stages = last + 1
        step.pure_speed = pure_speed
        step.sampled = 1 if begins else 0
        for i in range(3):
            step.power_before[i] = step.power[0, i] if begins else own.power[i]
            own.power[i] = step.power[last, i]
        offset[j] = own.y[FIRST + last, 2]
        c = positions[j].cage
        cage = cages[c].y[FIRST + last]
        ahead = offset[j] + cage[1] - cage[4] * at.sine + cage[5] * at.cosine
        step.ahead = ahead / bearing.pitch_radius
        force = at.push + bearing.lever * at.friction
        whole.torque[c] -= bearing.pitch_radius * force


@jit_inline
def _take_over(y):
    """Make the values of the last stage of a roller or cage its new state."""
    for i in range(y.shape[1]):
        y[STATE, i] = y[LAST, i]
        y[SLOPE, i] = y[LAST_RATE, i]


@jit_inline
def _advance(end, space, row):
    """Make the end of an accepted step the new state, with its rates and evaluations."""
    memory = space.memory[0]
    rollers = space.rollers
    cages = space.cages
    schedules = space.schedules
    numbers = space.numbers
    memory.steps += 1
    for j in range(row.size):
        step = row[j]
        for k in range(2):
            power = step.power[k, 0] + step.power[k, 1]
            memory.spent += step.weight[k] * power
        if schedules[j].due:
            copy_linearisation(numbers, j, 0, 1)
        _take_over(rollers[j].y)
    for c in range(cages.size):
        _take_over(cages[c].y)
    memory.time = end.time
    memory.interval = end.interval
    memory.shaft_speed = end.shaft_speed


@jit_inline
def _uncounted_assembly(assembly):
    """The bearing with arrays whose references are not counted."""
    return Assembly(
        uncounted(assembly.bearing),  # pyright: ignore[reportCallIssue]
        uncounted(assembly.bodies),  # pyright: ignore[reportCallIssue]
        uncounted(assembly.tables),  # pyright: ignore[reportCallIssue]
        uncounted(assembly.positions),  # pyright: ignore[reportCallIssue]
        assembly.evaluate_raceway,
        assembly.evaluate_cage,
    )


@jit_inline
def _uncounted_space(space):
    """State and work space as arrays whose references are not counted."""
    return Space(
        uncounted(space.rollers),  # pyright: ignore[reportCallIssue]
        uncounted(space.cages),  # pyright: ignore[reportCallIssue]
        uncounted(space.conditions),  # pyright: ignore[reportCallIssue]
        uncounted(space.linearisations),  # pyright: ignore[reportCallIssue]
        uncounted(space.numbers),  # pyright: ignore[reportCallIssue]
        uncounted(space.schedules),  # pyright: ignore[reportCallIssue]
        uncounted(space.blocks),  # pyright: ignore[reportCallIssue]
        uncounted(space.borders),  # pyright: ignore[reportCallIssue]
        uncounted(space.memory),  # pyright: ignore[reportCallIssue]
    )


@jit
def integrate(assembly, motion, stops, bounds, space, steps, wholes, offsets):
    """Integrate all rollers and cages, until the history ends or the buffers are full.

    Parameters
    ----------
    assembly : Assembly
    motion : Motion
    stops : ndarray
        Times at which a step must end [s], rising, the last being the end of the integration.
    bounds : ndarray of `LIMITS`, shape (1,)
    space : Space
        With the state at the first sample; then as the last call left it.
    steps : ndarray of `STEP`, shape (m, n)
        Filled from the start.
    wholes : ndarray of `BEARING_STEP`, shape (m,)
        With flows of zero; filled from the start.
    offsets : ndarray, shape (m, n)
        Pocket offsets at the steps' ends [m], filled from the start.

    Returns
    -------
    status : int
        A `Status`; UNDER_WAY where the buffers are full.
    count : int
        Rows that were written.
    """
    assembly = _uncounted_assembly(assembly)
    motion = uncounted_motion(motion)
    space = _uncounted_space(space)
    stops = uncounted(stops)  # pyright: ignore[reportCallIssue]
    steps = uncounted(steps)  # pyright: ignore[reportCallIssue]
    wholes = uncounted(wholes)  # pyright: ignore[reportCallIssue]
    offsets = uncounted(offsets)  # pyright: ignore[reportCallIssue]
    limits = bounds[0]
    memory = space.memory[0]
    rows = 0
    status = UNDER_WAY
    while rows < wholes.size:
        while memory.next_stop < stops.size and stops[memory.next_stop] <= memory.time:
            memory.next_stop += 1
        if memory.next_stop == stops.size:
            status = COMPLETED
            break
        if memory.steps + memory.rejections >= limits.max_steps:
            status = TOO_MANY_STEPS
            break
        stop = stops[memory.next_stop]
        start = Clock(memory.time, memory.interval, memory.shaft_speed)
        left = stop - memory.time
        wanted = min(memory.step, limits.longest_step)
        h = _cut(assembly.bearing[0], space.rollers, wanted, left)
        if h < left and h <= 4e-16 * abs(start.time) + 1e-300:
            status = STEP_TOO_SMALL
            break
        time = stop if h == left else start.time + h
        interval = _interval_of(motion, time, start.interval)
        now = instant(motion, interval, time)
        end = Clock(time, interval, now.shaft_speed)
        if memory.begun == 0:
            end = start
        row = steps[rows]
        whole = wholes[rows]
        worst, solved = _solve_stages(assembly, motion, limits, start, end, space, row, whole)
        if memory.begun == 0:
            for j in range(row.size):
                copy_linearisation(space.numbers, j, 0, 1)
            _write_end(assembly, start, end, space, row, whole, offsets[rows])
            memory.begun = 1
            rows = rows + 1
            continue
        error = _step_error(assembly, limits, h, space) if solved else math.inf
        if np.isnan(error) or (not worst < math.inf and h < 1e-12):
            status = NOT_FINITE
            break
        factor = tuning.SAFETY / max(error, 1e-4) ** (1.0 / 3.0)
        if error > 1.0:
            memory.rejections += 1
            part = max(tuning.LEAST_PART, factor) if solved else tuning.UNSOLVED_PART
            memory.step = h * part
            memory.failed = 1
            continue
        mean_power = max(memory.spent, 0.0) / (end.time - motion.time[0])
        power_scale = mean_power / (2 * row.size)
        if not _refresh(assembly, limits, end.time, space, power_scale):
            memory.rejections += 1
            memory.step = h
            continue
        if _leaves_tables(assembly, limits, space):
            status = OUTSIDE_TABLES
            break
        memory.unbalanced = max(memory.unbalanced, worst)
        _write_end(assembly, start, end, space, row, whole, offsets[rows])
        _advance(end, space, row)
        memory.step = h * min(1.0 if memory.failed else tuning.GROWTH, factor)
        memory.failed = 0
        rows += 1
    return status, rows
