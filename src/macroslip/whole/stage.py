"""One implicit stage of all rollers and cages, solved by Newton's method.

A stage is solved for y in y = y* + γh f(t, y). Newton's equations are divided by γh, so that
residuals are forces [N]. Unknowns are each roller's slips v_in and v_out and each cage's lead w
and, where it translates, its speeds p along X0 and q along Y0; offsets and displacements follow
from them.

The matrix has the shape of an arrow: two equations a roller, and a border of one or three a cage. A
roller meets only its cage, so its two unknowns are eliminated on their own, and a solution costs in
proportion to the number of rollers.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_inline
from macroslip.mechanics.cage import cage_guide
from macroslip.mechanics.orbit import slip_drive
from macroslip.mechanics.speeds import cage_speed, spin_surface_speed
from macroslip.whole import tuning
from macroslip.whole.model import Assembly
from macroslip.whole.pocket import pocket_force, stop_force
from macroslip.whole.tractions import (
    COUPLED_CONDITIONS,
    address,
    cage_from,
    evaluate_marked,
    is_out_of_reach,
    new_linearisations,
    raceway_from,
)

#: Sets of unknowns or their rates: at the step's start, y*, at both stages.
STATE, SLOPE, STAR, FIRST, LAST, FIRST_RATE, LAST_RATE = range(7)
#: State of a roller.
ROLLER = np.dtype(
    [
        # Unknowns or rates by set: slips v_in, v_out [m/s] and pocket offset x [m].
        ("y", "f8", (7, 3)),
        ("power", "f8", (3,)),  # frictional power at the step's start by interface [W]
    ]
)
#: State of a cage.
CAGE = np.dtype(
    [
        # Unknowns or rates by set: lead w [m/s], lag ∫w dt [m], translation speeds p, q [m/s] and
        # translations a, b [m].
        ("y", "f8", (7, 6)),
    ]
)
#: When the tractions of a roller are evaluated.
SCHEDULE = np.dtype(
    [
        ("interval", "f8"),  # time for which the tractions that were kept serve [s]
        ("ratio", "f8"),  # error / tolerance of the last predicted values [-]
        ("fresh", "?"),  # true if it is evaluated in every iteration
        ("settled", "?"),  # true if it needs no further evaluation in this stage
        ("marked", "?"),  # true if it is evaluated now
        ("due", "?"),  # true if it has new values to keep after the step
        ("unused", "i4"),  # fills the record to a multiple of 8 bytes
    ]
)
#: A roller's part of the matrix.
BLOCK = np.dtype(
    [
        ("inverse", "f8", (4,)),  # of its 2 × 2 block [m/(N s)]
        ("column", "f8", (2, 3)),  # derivatives of its residuals by w, p, q [N s/m]
        ("row", "f8", (2, 3)),  # derivatives of the cage's residuals by v_in, v_out [N s/m]
        ("push_by_speed", "f8"),  # derivative of N by x' [N s/m]
        ("by_sliding", "f8"),  # derivative of F_c by slip [N s/m]
        ("by_push", "f8"),  # derivative of F_c by N [-]
        ("residual", "f8", (2,)),  # residuals, or the right-hand side of a solution [N]
        # Least speed of approach to a spar from which an iteration has left it [m/s]; infinite where
        # none has.
        ("approach", "f8"),
    ]
)
#: A cage's part of the matrix.
BORDER = np.dtype(
    [
        ("matrix", "f8", (3, 3)),  # derivatives of its residuals by w, p, q [N s/m]
        ("residual", "f8", (3,)),  # residuals, or the right-hand side of a solution [N]
    ]
)


class Space(NamedTuple):
    """Arrays of one integration: its state and work space."""

    rollers: np.ndarray  #: shape (n,)
    cages: np.ndarray  #: shape (c,)
    conditions: np.ndarray  #: Shape (2, n). At both stages.
    linearisations: (
        np.ndarray
    )  #: Shape (2, n). Those of the step under way, and those kept from before it.
    numbers: np.ndarray  #: Shape (2, n, columns). The same memory.
    schedules: np.ndarray  #: shape (n,)
    blocks: np.ndarray  #: shape (n,)
    borders: np.ndarray  #: shape (c,)
    memory: np.ndarray  #: shape (1,)


def new_space(assembly: Assembly, memory: np.ndarray) -> Space:
    """Arrays of an integration for a bearing; `memory` is the integrator's record."""
    count = assembly.positions.size
    cages = int(assembly.bearing[0]["cages"])
    linearisations, numbers = new_linearisations(count)
    return Space(
        rollers=np.zeros(count, ROLLER),
        cages=np.zeros(cages, CAGE),
        conditions=np.zeros((2, count), COUPLED_CONDITIONS),
        linearisations=linearisations,
        numbers=numbers,
        schedules=np.zeros(count, SCHEDULE),
        blocks=np.zeros(count, BLOCK),
        borders=np.zeros(cages, BORDER),
        memory=memory,
    )


class Stage(NamedTuple):
    """Settings of an implicit stage."""

    step: float  #: γh [s]
    time: float  #: [s]
    shaft_speed: float  #: [rad/s]
    tolerance: float  #: Largest force that may be left unbalanced [N]
    #: Relative change of load or slip within which the slopes of a cage's contact serve [-]
    cage_reach: float
    #: Change of a raceway's force by slip over its load within which its slopes serve [-]
    slip_reach: float


class PocketContact(NamedTuple):
    """Forces between a roller and its pocket, with their slopes."""

    push: float  #: N [N]
    friction: float  #: F_c [N]
    #: ∂N/∂x', with the change of the offset that follows from x' in this stage [N s/m]
    push_by_speed: float
    by_sliding: float  #: Derivative of F_c by the slip against the cage [N s/m]
    by_push: float  #: Derivative of F_c by N [-]
    arm: float  #: Lever of N about the cage's own axis over the pitch radius [-]
    cage_turn: float  #: Speed of the cage [rad/s]


@jit_inline
def pocket_contact(bearing, contact, stage, at, own, star, cage, linear):
    """Push and friction between a roller and its pocket at the speeds of a stage.

    Parameters
    ----------
    bearing : record of `macroslip.whole.model.BEARING`
    contact : tuple
        A roller's body, record of `macroslip.roller.model.BODY`, the address of its tables, and
        the address of the evaluation of its contact with the cage.
    stage : Stage
    at : record of `macroslip.whole.tractions.COUPLED_CONDITIONS`
        The roller at the stage's time; `push`, `friction` and the speeds in its pocket are filled.
    own : ndarray, shape (3,)
        v_in, v_out [m/s] and x [m] of the roller; the offset x is filled, as its speed gives it.
    star : ndarray, shape (3,)
        The roller's y*.
    cage : ndarray, shape (6,)
        Unknowns of its cage, as in `CAGE`.
    linear : record of `macroslip.whole.tractions.LINEARISATIONS`
        Its cage contact is evaluated again where the slopes do not serve.

    Returns
    -------
    PocketContact
    """
    shaft_speed = stage.shaft_speed
    v_in = own[0]
    v_out = own[1]
    cage_turn = cage_speed(cage[0], shaft_speed, bearing.inner_radius) / bearing.pitch_radius
    off_axis = cage[4] * at.cosine + cage[5] * at.sine
    speed = (
        0.5 * (v_in - v_out)
        - cage[0]
        + cage[2] * at.sine
        - cage[3] * at.cosine
        + cage_turn * off_axis
    )
    speed += 0.5 * (at.ring - shaft_speed * bearing.inner_radius)
    own[2] = star[2] + stage.step * speed
    push, by_offset, by_speed = pocket_force(bearing.pocket, own[2], speed)
    sliding = bearing.lever * bearing.pitch_radius * cage_turn
    sliding -= spin_surface_speed(v_in, v_out, at.ring)
    friction, by_sliding, by_push = cage_from(contact, linear.cage, push, sliding, stage.cage_reach)
    at.friction = friction
    at.push = push
    at.sliding = sliding
    at.pocket_speed = speed
    push_by_speed = by_speed + stage.step * by_offset
    arm = 1.0 - off_axis / bearing.pitch_radius
    return PocketContact(push, friction, push_by_speed, by_sliding, by_push, arm, cage_turn)


@jit_inline
def _write_block(inertia, at, linear, pocket, block):
    """Write the inverse of a roller's 2 × 2 block, and the slopes of its pocket's forces."""
    block.push_by_speed = pocket.push_by_speed
    block.by_sliding = pocket.by_sliding
    block.by_push = pocket.by_push
    turning_in = 0.0
    pull_in = 0.0
    turning_out = 0.0
    pull_out = 0.0
    if at.inner_load > 0.0:
        turning_in = linear.inner.turning_by_slip
        pull_in = linear.inner.pull_by_slip
    if at.outer_load > 0.0:
        turning_out = linear.outer.turning_by_slip
        pull_out = linear.outer.pull_by_slip
    # Derivatives of 2 F_c and of N by v_in; those by v_out differ in the sign of the push's part.
    shared = pocket.by_sliding
    tilted = pocket.by_push * pocket.push_by_speed
    half_push = 0.5 * pocket.push_by_speed
    spin_in = 2.0 * turning_in
    spin_out = 2.0 * turning_out
    j11 = inertia + pull_in + spin_in + shared + tilted - half_push
    j12 = -pull_out + spin_out + shared - tilted + half_push
    j21 = -pull_in + spin_in + shared + tilted + half_push
    j22 = inertia + pull_out + spin_out + shared - tilted - half_push
    part = 1.0 / (j11 * j22 - j12 * j21)
    inverse = block.inverse
    inverse[0] = j22 * part
    inverse[1] = -j12 * part
    inverse[2] = -j21 * part
    inverse[3] = j11 * part


@jit_inline
def _add_to_border(bearing, stage, at, pocket, block, border):
    """Add a roller's forces and derivatives to its cage's equations, and the reverse."""
    matrix = border.matrix
    residual = border.residual
    row = block.row
    column = block.column
    lever = bearing.lever
    arm = pocket.arm
    push_by_speed = pocket.push_by_speed
    by_push = pocket.by_push
    by_w = -push_by_speed
    residual[0] += pocket.push * arm + pocket.friction * lever
    # Derivatives of the torque on the cage by v_in and v_out: of the push, and of friction by its
    # slip and by the push.
    half_push = 0.5 * push_by_speed
    half_sliding = 0.5 * pocket.by_sliding
    half_friction = 0.5 * by_push * push_by_speed
    row[0, 0] = half_push * arm + lever * (half_sliding + half_friction)
    row[1, 0] = -half_push * arm + lever * (half_sliding - half_friction)
    friction_by_w = pocket.by_sliding * lever + by_push * by_w
    column[0, 0] = 2.0 * friction_by_w - by_w
    column[1, 0] = 2.0 * friction_by_w + by_w
    matrix[0, 0] += arm * by_w + lever * friction_by_w
    if bearing.translates:
        cosine = at.cosine
        sine = at.sine
        residual[1] -= pocket.push * sine
        residual[2] += pocket.push * cosine
        turned = stage.step * pocket.cage_turn
        by_p = push_by_speed * (sine + turned * cosine)
        by_q = push_by_speed * (-cosine + turned * sine)
        row[0, 1] = -sine * half_push
        row[1, 1] = sine * half_push
        row[0, 2] = cosine * half_push
        row[1, 2] = -cosine * half_push
        inner_by_push = 2.0 * by_push - 1.0
        outer_by_push = 2.0 * by_push + 1.0
        column[0, 1] = inner_by_push * by_p
        column[1, 1] = outer_by_push * by_p
        column[0, 2] = inner_by_push * by_q
        column[1, 2] = outer_by_push * by_q
        by_turn = arm + lever * by_push
        matrix[0, 1] += by_turn * by_p
        matrix[0, 2] += by_turn * by_q
        for k, by in enumerate((by_w, by_p, by_q)):
            matrix[1, k] -= sine * by
            matrix[2, k] += cosine * by


@jit_inline
def _slips_without_cage(block, inner, outer):
    """Slips of a roller under right-hand sides [N] with its cage held [m/s]."""
    inverse = block.inverse
    v_in = inverse[0] * inner + inverse[1] * outer
    v_out = inverse[2] * inner + inverse[3] * outer
    return v_in, v_out


@jit_inline
def eliminate(positions, size, blocks, borders):
    """Eliminate the rollers from the cages' equations: block elimination by Schur complements.

    It is done once for all right-hand sides.

    Parameters
    ----------
    positions : ndarray of `macroslip.whole.model.POSITION`, shape (n,)
    size : int
        Unknowns of a cage: one, or three where it translates.
    blocks : ndarray of `BLOCK`, shape (n,)
    borders : ndarray of `BORDER`, shape (c,)
        Each `matrix` becomes the Schur complement of its cage.
    """
    for j in range(positions.size):
        matrix = borders[positions[j].cage].matrix
        block = blocks[j]
        column = block.column
        row = block.row
        for k in range(size):
            v_in, v_out = _slips_without_cage(block, column[0, k], column[1, k])
            for i in range(size):
                matrix[i, k] -= row[0, i] * v_in + row[1, i] * v_out


@jit_inline
def _solve_border(matrix, residual, size):
    """Solve the small border in place by Cramer's rule.

    Its diagonal is dominated by mass over step.
    """
    if size == 1:
        residual[0] /= matrix[0, 0]
        return
    m00 = matrix[0, 0]
    m01 = matrix[0, 1]
    m02 = matrix[0, 2]
    m10 = matrix[1, 0]
    m11 = matrix[1, 1]
    m12 = matrix[1, 2]
    m20 = matrix[2, 0]
    m21 = matrix[2, 1]
    m22 = matrix[2, 2]
    c00 = m11 * m22 - m12 * m21
    c01 = m12 * m20 - m10 * m22
    c02 = m10 * m21 - m11 * m20
    c10 = m02 * m21 - m01 * m22
    c11 = m00 * m22 - m02 * m20
    c12 = m01 * m20 - m00 * m21
    c20 = m01 * m12 - m02 * m11
    c21 = m02 * m10 - m00 * m12
    c22 = m00 * m11 - m01 * m10
    determinant = m00 * c00 + m01 * c01 + m02 * c02
    r0 = residual[0]
    r1 = residual[1]
    r2 = residual[2]
    residual[0] = (r0 * c00 + r1 * c10 + r2 * c20) / determinant
    residual[1] = (r0 * c01 + r1 * c11 + r2 * c21) / determinant
    residual[2] = (r0 * c02 + r1 * c12 + r2 * c22) / determinant


@jit_inline
def solve(positions, size, blocks, borders):
    """Solve the linear system that `eliminate` has prepared, in place.

    Parameters
    ----------
    positions : ndarray of `macroslip.whole.model.POSITION`, shape (n,)
    size : int
        Unknowns of a cage: one, or three where it translates.
    blocks : ndarray of `BLOCK`, shape (n,)
        `residual` of each: right-hand side [N], replaced by the solution v_in, v_out [m/s].
    borders : ndarray of `BORDER`, shape (c,)
        `residual` of each: right-hand side [N], replaced by the solution w, p, q [m/s].
    """
    for j in range(positions.size):
        block = blocks[j]
        residual = block.residual
        row = block.row
        v_in, v_out = _slips_without_cage(block, residual[0], residual[1])
        residual[0] = v_in
        residual[1] = v_out
        border_residual = borders[positions[j].cage].residual
        for i in range(size):
            border_residual[i] -= row[0, i] * v_in + row[1, i] * v_out
    for c in range(borders.size):
        _solve_border(borders[c].matrix, borders[c].residual, size)
    for j in range(positions.size):
        block = blocks[j]
        residual = block.residual
        column = block.column
        change = borders[positions[j].cage].residual
        inner = 0.0
        outer = 0.0
        for k in range(size):
            inner += column[0, k] * change[k]
            outer += column[1, k] * change[k]
        v_in, v_out = _slips_without_cage(block, inner, outer)
        residual[0] -= v_in
        residual[1] -= v_out


@jit_inline
def _begin_cage(bearing, stage, cage, star, border):
    """Write inertia, guide and weight of a cage into its equations, before its rollers."""
    inertia = bearing.cage_mass / stage.step
    matrix = border.matrix
    residual = border.residual
    for i in range(3):
        for k in range(3):
            matrix[i, k] = inertia if i == k else 0.0
    speed = cage_speed(cage[0], stage.shaft_speed, bearing.inner_radius)
    guide = cage_guide(bearing, speed, stage.shaft_speed)
    residual[0] = inertia * (cage[0] - star[0]) + guide.friction + guide.drag
    matrix[0, 0] += guide.by_speed
    p = cage[2]
    q = cage[3]
    residual[1] = inertia * (p - star[2])
    residual[2] = inertia * (q - star[3]) + bearing.cage_weight
    if bearing.translates:
        a = cage[4]
        b = cage[5]
        push, n_x, n_y, by_distance, by_speed = stop_force(bearing.radial_play, a, b, p, q)
        residual[1] += push * n_x
        residual[2] += push * n_y
        radial = by_speed + stage.step * by_distance
        turning_push = 0.0
        if push > 0.0:
            turning_push = stage.step * push / math.sqrt(a**2 + b**2)
        crossed = (radial - turning_push) * n_x * n_y
        matrix[1, 1] += radial * n_x * n_x + turning_push * n_y * n_y
        matrix[1, 2] += crossed
        matrix[2, 1] += crossed
        matrix[2, 2] += radial * n_y * n_y + turning_push * n_x * n_x


@jit_inline
def _raceway_forces(assembly, stage, k, conditions, rollers, schedules, linearisations):
    """Write raceway forces of a stage, evaluated or extrapolated; returns the evaluations."""
    for j in range(conditions.size):
        schedule = schedules[j]
        at = conditions[j]
        linear = linearisations[j]
        own = rollers[j].y[FIRST + k]
        at.turning_inner, at.pull_inner = raceway_from(
            linear.inner, at.inner_load, at.inner_speed, own[0]
        )
        at.turning_outer, at.pull_outer = raceway_from(
            linear.outer, at.outer_load, at.outer_speed, own[1]
        )
        if not schedule.fresh and is_out_of_reach(linear, at, own, stage.slip_reach):
            schedule.fresh = True
        schedule.marked = schedule.fresh and not schedule.settled
    evaluations = evaluate_marked(
        assembly, stage.time, conditions, rollers, FIRST + k, schedules, linearisations
    )
    for j in range(conditions.size):
        if schedules[j].marked:
            at = conditions[j]
            inner = linearisations[j].inner
            outer = linearisations[j].outer
            off = abs(at.turning_inner - inner.turning) + abs(at.pull_inner - inner.pull)
            off += abs(at.turning_outer - outer.turning) + abs(at.pull_outer - outer.pull)
            # Slopes that predicted the force well enough serve until the stage is solved.
            schedules[j].settled = off <= tuning.PREDICTED * stage.tolerance
            at.turning_inner = inner.turning
            at.pull_inner = inner.pull
            at.turning_outer = outer.turning
            at.pull_outer = outer.pull
    return evaluations


@jit_inline
def _place_cages(stage, k, cages):
    """Write lag and translations of the cages, which follow from their speeds."""
    for c in range(cages.size):
        own = cages[c].y[FIRST + k]
        star = cages[c].y[STAR]
        own[1] = star[1] + stage.step * own[0]
        own[4] = star[4] + stage.step * own[2]
        own[5] = star[5] + stage.step * own[3]


@jit_inline
def _assemble(assembly, stage, k, size, space):
    """Write residuals and derivatives of a stage; returns the largest residual [N]."""
    rollers = space.rollers
    cages = space.cages
    conditions = space.conditions[k]
    linearisations = space.linearisations[0]
    positions = assembly.positions
    blocks = space.blocks
    borders = space.borders
    bearing = assembly.bearing[0]
    contact = (assembly.bodies[0], address(assembly), assembly.evaluate_cage)
    present = FIRST + k
    _place_cages(stage, k, cages)
    for c in range(cages.size):
        _begin_cage(bearing, stage, cages[c].y[present], cages[c].y[STAR], borders[c])
    memory = space.memory[0]
    memory.evaluations += _raceway_forces(
        assembly, stage, k, conditions, rollers, space.schedules, linearisations
    )
    memory.iterations += 1
    inertia = bearing.roller_mass / stage.step
    worst = 0.0
    finite = True
    for j in range(conditions.size):
        c = positions[j].cage
        at = conditions[j]
        linear = linearisations[j]
        block = blocks[j]
        own = rollers[j].y[present]
        star = rollers[j].y[STAR]
        cage = cages[c].y[present]
        pocket = pocket_contact(bearing, contact, stage, at, own, star, cage, linear)
        friction = at.turning_inner + at.turning_outer + pocket.friction
        drive = slip_drive(friction, at.pull_inner, at.pull_outer, pocket.push, at.tangential)
        residual_in = inertia * (own[0] - star[0]) + drive.turning - drive.driving
        residual_out = inertia * (own[1] - star[1]) + drive.turning + drive.driving
        block.residual[0] = residual_in
        block.residual[1] = residual_out
        worst = max(worst, abs(residual_in), abs(residual_out))
        # `max` may ignore a NaN.
        finite = finite and abs(residual_in) + abs(residual_out) < math.inf
        _write_block(inertia, at, linear, pocket, block)
        _add_to_border(bearing, stage, at, pocket, block, borders[c])
    for c in range(cages.size):
        for i in range(size):
            unbalanced = abs(borders[c].residual[i])
            worst = max(worst, unbalanced)
            finite = finite and unbalanced < math.inf
    return worst if finite else math.inf


@jit_inline
def _pocket_speed_change(bearing, stage, at, cage, change, border):
    """Change of a roller's speed in its pocket [m/s] by a solution for it and for its cage.

    `cage` are the unknowns of its cage; a solution, `change` and `border`, is subtracted from the
    unknowns.
    """
    speed = -0.5 * (change[0] - change[1]) + border[0]
    if bearing.translates:
        of_cage = cage_speed(cage[0], stage.shaft_speed, bearing.inner_radius)
        turn = stage.step * of_cage / bearing.pitch_radius
        speed -= (at.sine + turn * at.cosine) * border[1]
        speed -= (turn * at.sine - at.cosine) * border[2]
    return speed


@jit_inline
def excess_approach(at, block, change):
    """Part of the change of a roller's speed in its pocket that takes it too fast to a spar [m/s].

    Only a film that is squeezed pushes, and the cage's friction rises from zero like a root of the
    push. Newton's method goes to and fro about a solution next to zero: what is too fast is left
    far, and from there it comes back as fast. The least speed of approach that was left bounds the
    solution.

    Parameters
    ----------
    at : record of `macroslip.whole.tractions.COUPLED_CONDITIONS`
        The roller, with push and speed in its pocket.
    block : record of `BLOCK`
        Its `approach` is renewed.
    change : float
        Change of that speed by Newton's method [m/s].

    Returns
    -------
    float
        The part, with the sign of the change [m/s]; 0 where the roller approaches no spar, or has
        left none.
    """
    speed = at.pocket_speed
    following = speed + change
    if speed * following > 0.0:
        return 0.0
    if at.push * speed < 0.0:
        block.approach = min(block.approach, abs(speed))
        return 0.0
    fastest = tuning.APPROACH_PART * block.approach
    return following - math.copysign(min(abs(following), fastest), following)


@jit_inline
def _update(assembly, stage, k, size, space):
    """Subtract a solution from the unknowns of stage `k`.

    Returns whether all of it was subtracted: an approach to a spar may be cut short.
    """
    bearing = assembly.bearing[0]
    positions = assembly.positions
    rollers = space.rollers
    cages = space.cages
    conditions = space.conditions[k]
    blocks = space.blocks
    borders = space.borders
    whole = True
    for j in range(rollers.size):
        own = rollers[j].y[FIRST + k]
        block = blocks[j]
        change = block.residual
        if bearing.pocket.film > 0.0:
            c = positions[j].cage
            at = conditions[j]
            cage = cages[c].y[FIRST + k]
            speed = _pocket_speed_change(bearing, stage, at, cage, change, borders[c].residual)
            excess = excess_approach(at, block, speed)
            if excess != 0.0:
                whole = False
                change[0] += excess
                change[1] -= excess
        own[0] -= change[0]
        own[1] -= change[1]
    for c in range(cages.size):
        cage = cages[c].y[FIRST + k]
        change = borders[c].residual
        cage[0] -= change[0]
        if size == 3:
            cage[2] -= change[1]
            cage[3] -= change[2]
    return whole


@jit_inline
def _follow(assembly, stage, k, space):
    """Update forces and positions of the rollers of stage `k` to first order in their speeds."""
    bearing = assembly.bearing[0]
    positions = assembly.positions
    rollers = space.rollers
    cages = space.cages
    conditions = space.conditions[k]
    linearisations = space.linearisations[0]
    blocks = space.blocks
    borders = space.borders
    for j in range(blocks.size):
        c = positions[j].cage
        at = conditions[j]
        linear = linearisations[j]
        block = blocks[j]
        cage = cages[c].y[FIRST + k]
        border = borders[c].residual
        speed = _pocket_speed_change(bearing, stage, at, cage, block.residual, border)
        v_in = -block.residual[0]
        v_out = -block.residual[1]
        if at.inner_load > 0.0:
            at.turning_inner += linear.inner.turning_by_slip * v_in
            at.pull_inner += linear.inner.pull_by_slip * v_in
        if at.outer_load > 0.0:
            at.turning_outer += linear.outer.turning_by_slip * v_out
            at.pull_outer += linear.outer.pull_by_slip * v_out
        sliding = 0.5 * (v_in + v_out) - bearing.lever * border[0]
        push = block.push_by_speed * speed
        at.push += push
        at.friction += block.by_sliding * sliding + block.by_push * push
        at.sliding += sliding
        at.pocket_speed += speed
        rollers[j].y[FIRST + k, 2] += stage.step * speed


@jit_inline
def solve_stage(assembly, stage, k, space):
    """Solve an implicit stage by Newton's method.

    The matrix is left prepared for further right-hand sides.

    Parameters
    ----------
    assembly : macroslip.whole.model.Assembly
    stage : Stage
    k : int
        Number of the stage, 0 or 1.
    space : Space
        With the rollers located, y* and a guess of the stage's unknowns, which the solution
        replaces.

    Returns
    -------
    float
        The largest residual, or the part that the last update is predicted to leave of it [N].
        Above the tolerance or not finite where the stage is not solved.
    """
    positions = assembly.positions
    blocks = space.blocks
    borders = space.borders
    schedules = space.schedules
    size = 3 if assembly.bearing[0].translates else 1
    worst = math.inf
    before = math.inf
    for j in range(blocks.size):
        schedules[j].settled = False
        blocks[j].approach = math.inf
    for _ in range(tuning.ITERATIONS):
        worst = _assemble(assembly, stage, k, size, space)
        eliminate(positions, size, blocks, borders)
        if worst <= stage.tolerance or not worst < math.inf:
            break
        solve(positions, size, blocks, borders)
        whole = _update(assembly, stage, k, size, space)
        predicted = worst * max((worst / before) ** 2, tuning.PREDICTED_RESIDUAL)
        if whole and predicted <= stage.tolerance:
            _place_cages(stage, k, space.cages)
            _follow(assembly, stage, k, space)
            return predicted
        before = worst
    return worst
