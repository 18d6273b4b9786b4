"""One implicit stage of all rollers and cages, solved by Newton's method.

A stage asks for y with y = y* + γh f(t, y). Newton's equations are divided by γh, so that residuals are forces [N]. Unknowns
are each roller's slips v_in and v_out and each cage's lead w and, where it translates, its speeds p along X0 and q along Y0;
offsets and displacements follow from them. The matrix is that of `macroslip.whole_bearing.arrow`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit_inline, jit_merged
from macroslip.whole_bearing.arrow import eliminate, solve
from macroslip.whole_bearing.guidance import guide_force
from macroslip.whole_bearing.pocket import pocket_force
from macroslip.whole_bearing.space import (
    CAGE_SLIDING,
    FRICTION,
    POCKET_SPEED,
    PULL_INNER,
    PULL_OUTER,
    PUSH,
    SPIN_INNER,
    SPIN_OUTER,
)
from macroslip.whole_bearing.traction import (
    INNER,
    OUTER,
    PULL,
    PULL_V,
    SPIN,
    SPIN_V,
    cage_from,
    evaluate_marked,
    out_of_reach,
    raceway_from,
)

#: Newton iterations before a step counts as unsolved.
_ITERATIONS = 12
#: Tolerances by which the slopes may be off at the last evaluation, for Newton's next update is far smaller.
_FORETOLD = 10.0
#: Speed over which the guide's friction turns its sign [m/s].
GUIDE_SPEED = 1e-3


class Stage(NamedTuple):
    """What a stage is solved for.

    Attributes
    ----------
    step : float
        γh [s].
    time : float
        [s].
    shaft_speed : float
        [rad/s].
    tolerance : float
        Largest force that may be left unbalanced [N].
    cage_reach : float
        Relative change of load or slip within which the slopes of a cage's contact serve.
    """

    step: float
    time: float
    shaft_speed: float
    tolerance: float
    cage_reach: float


class _Meeting(NamedTuple):
    """How a roller meets its pocket.

    Attributes
    ----------
    push, friction : float
        N and F_c [N].
    give : float
        Derivative of N by x', with the offset that follows from it in this stage [N s/m].
    by_sliding, by_push : float
        Derivatives of F_c by the slip against the cage [N s/m] and by N [-].
    arm : float
        Lever of N about the cage's own axis over the pitch radius [-].
    cage_turn : float
        Speed of the cage [rad/s].
    """

    push: float
    give: float
    by_sliding: float
    by_push: float
    friction: float
    arm: float
    cage_turn: float


@jit_merged
def _begin_cages(bearing, stage, cages, star, arrow):
    """Parts of the cages' equations that no roller enters."""
    inertia = bearing.cage_mass / stage.step
    for c in range(bearing.cages):
        border, rest = arrow.border[c], arrow.border_rest[c]
        for i in range(3):
            for k in range(3):
                border[i, k] = 0.0
            border[i, i] = inertia
        turning = cages[c, 0] + 0.5 * stage.shaft_speed * bearing.inner_radius
        drive = math.tanh(turning / GUIDE_SPEED)
        rest[0] = inertia * (cages[c, 0] - star[c, 0]) + bearing.guide_friction * drive
        border[0, 0] += bearing.guide_friction * (1.0 - drive * drive) / GUIDE_SPEED
        rest[1] = inertia * (cages[c, 2] - star[c, 2])
        rest[2] = inertia * (cages[c, 3] - star[c, 3]) + bearing.cage_weight
        if bearing.translates:
            push, n_x, n_y, by_place, by_speed = guide_force(
                bearing.radial_play, cages[c, 4], cages[c, 5], cages[c, 2], cages[c, 3]
            )
            rest[1] += push * n_x
            rest[2] += push * n_y
            radial = by_speed + stage.step * by_place
            distance = math.sqrt(cages[c, 4] ** 2 + cages[c, 5] ** 2)
            turning_push = stage.step * push / distance if push > 0.0 else 0.0
            border[1, 1] += radial * n_x * n_x + turning_push * n_y * n_y
            border[1, 2] += (radial - turning_push) * n_x * n_y
            border[2, 1] += (radial - turning_push) * n_x * n_y
            border[2, 2] += radial * n_y * n_y + turning_push * n_x * n_x


@jit_merged
def _foretell(stations, rollers, sheets, force):
    """Write the raceways' forces that follow from the sheets' slopes into `force`."""
    for j in range(force.shape[0]):
        sheet, f = sheets[j], force[j]
        f[SPIN_INNER], f[PULL_INNER] = raceway_from(
            sheet, INNER, stations.inner_load[j], stations.inner_speed[j], rollers[j, 0]
        )
        f[SPIN_OUTER], f[PULL_OUTER] = raceway_from(
            sheet, OUTER, stations.outer_load[j], stations.outer_speed[j], rollers[j, 1]
        )


@jit_merged
def _raceway_forces(bearing, stage, moment, tractions):
    """Raceway forces at the present state, evaluated where slopes do not serve. Returns the evaluations."""
    stations, force, sheets = moment.stations, moment.force, tractions.sheets
    _foretell(stations, moment.values.rollers, sheets, force)
    for j in range(force.shape[0]):
        if not tractions.fresh[j] and out_of_reach(sheets[j], stations, j):
            tractions.fresh[j] = True
        tractions.marked[j] = tractions.fresh[j] and not tractions.settled[j]
    evaluations = evaluate_marked(bearing, stations, stage.time, moment.values.rollers, tractions.marked, sheets)
    for j in range(force.shape[0]):
        if tractions.marked[j]:
            sheet, f = sheets[j], force[j]
            off = abs(f[SPIN_INNER] - sheet[INNER + SPIN]) + abs(f[PULL_INNER] - sheet[INNER + PULL])
            off += abs(f[SPIN_OUTER] - sheet[OUTER + SPIN]) + abs(f[PULL_OUTER] - sheet[OUTER + PULL])
            # Where the slopes foretold the force well enough, they do so until the stage is solved.
            tractions.settled[j] = off <= _FORETOLD * stage.tolerance
            f[SPIN_INNER], f[PULL_INNER] = sheet[INNER + SPIN], sheet[INNER + PULL]
            f[SPIN_OUTER], f[PULL_OUTER] = sheet[OUTER + SPIN], sheet[OUTER + PULL]
    return evaluations


@jit_inline
def _meet(bearing, stage, moment, star, sheet, j):
    """Push and friction of the pocket of roller `j`; its offset follows from its speed."""
    v_in, v_out = moment.values.rollers[j, 0], moment.values.rollers[j, 1]
    cage = moment.values.cages[bearing.rollers.cage[j]]
    cosine, sine = moment.stations.cosine[j], moment.stations.sine[j]
    inner_radius, shaft_speed = bearing.rollers.inner_radius[j], stage.shaft_speed
    cage_turn = (cage[0] + 0.5 * shaft_speed * bearing.inner_radius) / bearing.pitch_radius
    off_axis = cage[4] * cosine + cage[5] * sine
    speed = 0.5 * (v_in - v_out) - cage[0] + cage[2] * sine - cage[3] * cosine + cage_turn * off_axis
    speed += 0.5 * shaft_speed * (inner_radius - bearing.inner_radius)
    offset = star.rollers[j, 2] + stage.step * speed
    moment.values.rollers[j, 2] = offset
    push, by_offset, by_speed = pocket_force(bearing.pocket, offset, speed)
    # r ω_z' = −(v_in + v_out + Ω_in r~_in)/2
    sliding = 0.5 * (v_in + v_out + shaft_speed * inner_radius) + bearing.lever * bearing.pitch_radius * cage_turn
    friction, by_sliding, by_push = cage_from(
        bearing.models.downwind.cage, bearing.films, sheet, push, sliding, stage.cage_reach
    )
    f = moment.force[j]
    f[FRICTION], f[PUSH], f[CAGE_SLIDING], f[POCKET_SPEED] = friction, push, sliding, speed
    give = by_speed + stage.step * by_offset
    return _Meeting(push, give, by_sliding, by_push, friction, 1.0 - off_axis / bearing.pitch_radius, cage_turn)


@jit_inline
def _write_block(inertia, stations, sheet, met, j, inverse):
    """Inverse of a roller's block."""
    spin_in_v = sheet[INNER + SPIN_V] if stations.inner_load[j] > 0.0 else 0.0
    pull_in_v = sheet[INNER + PULL_V] if stations.inner_load[j] > 0.0 else 0.0
    spin_out_v = sheet[OUTER + SPIN_V] if stations.outer_load[j] > 0.0 else 0.0
    pull_out_v = sheet[OUTER + PULL_V] if stations.outer_load[j] > 0.0 else 0.0
    # Derivatives of 2 F_c and of N by v_in; those by v_out differ in the sign of the push's part.
    shared, tilted = met.by_sliding, met.by_push * met.give
    j11 = inertia + pull_in_v + 2.0 * spin_in_v + shared + tilted - 0.5 * met.give
    j12 = -pull_out_v + 2.0 * spin_out_v + shared - tilted + 0.5 * met.give
    j21 = -pull_in_v + 2.0 * spin_in_v + shared + tilted + 0.5 * met.give
    j22 = inertia + pull_out_v + 2.0 * spin_out_v + shared - tilted - 0.5 * met.give
    determinant = j11 * j22 - j12 * j21
    inverse[0], inverse[1] = j22 / determinant, -j12 / determinant
    inverse[2], inverse[3] = -j21 / determinant, j11 / determinant


@jit_inline
def _add_to_border(bearing, stage, stations, met, j, arrow):
    """What a roller adds to its cage's equations, and how the cage enters its own."""
    c = bearing.rollers.cage[j]
    border, rest, row, column = arrow.border[c], arrow.border_rest[c], arrow.row[j], arrow.column[j]
    lever, by_w = bearing.lever, -met.give
    rest[0] += met.push * met.arm + met.friction * lever
    half_push, half_friction = 0.5 * met.give, 0.5 * met.by_push * met.give
    row[0, 0] = half_push * met.arm + lever * (0.5 * met.by_sliding + half_friction)
    row[1, 0] = -half_push * met.arm + lever * (0.5 * met.by_sliding - half_friction)
    friction_by_w = met.by_sliding * lever + met.by_push * by_w
    column[0, 0], column[1, 0] = 2.0 * friction_by_w - by_w, 2.0 * friction_by_w + by_w
    border[0, 0] += met.arm * by_w + lever * friction_by_w
    if bearing.translates:
        cosine, sine = stations.cosine[j], stations.sine[j]
        rest[1] -= met.push * sine
        rest[2] += met.push * cosine
        by_p = met.give * (sine + stage.step * met.cage_turn * cosine)
        by_q = met.give * (-cosine + stage.step * met.cage_turn * sine)
        row[0, 1], row[1, 1] = -sine * half_push, sine * half_push
        row[0, 2], row[1, 2] = cosine * half_push, -cosine * half_push
        column[0, 1], column[1, 1] = (2.0 * met.by_push - 1.0) * by_p, (2.0 * met.by_push + 1.0) * by_p
        column[0, 2], column[1, 2] = (2.0 * met.by_push - 1.0) * by_q, (2.0 * met.by_push + 1.0) * by_q
        by_turn = met.arm + lever * met.by_push
        border[0, 1] += by_turn * by_p
        border[0, 2] += by_turn * by_q
        for k in range(3):
            by = by_w if k == 0 else (by_p if k == 1 else by_q)
            border[1, k] -= sine * by
            border[2, k] += cosine * by


@jit_merged
def _assemble(bearing, stage, moment, star, tractions, arrow):
    """Residuals and derivatives at the present state. Returns the largest residual [N] and the evaluations."""
    values, stations = moment.values, moment.stations
    for c in range(bearing.cages):
        values.cages[c, 1] = star.cages[c, 1] + stage.step * values.cages[c, 0]
        values.cages[c, 4] = star.cages[c, 4] + stage.step * values.cages[c, 2]
        values.cages[c, 5] = star.cages[c, 5] + stage.step * values.cages[c, 3]
    _begin_cages(bearing, stage, values.cages, star.cages, arrow)
    evaluations = _raceway_forces(bearing, stage, moment, tractions)
    inertia, worst, finite = bearing.roller_mass / stage.step, 0.0, True
    for j in range(bearing.rollers.row.size):
        sheet, f = tractions.sheets[j], moment.force[j]
        met = _meet(bearing, stage, moment, star, sheet, j)
        turning = 2.0 * (f[SPIN_INNER] + f[SPIN_OUTER] + met.friction)
        driving = met.push - stations.tangential[j] - f[PULL_INNER] + f[PULL_OUTER]
        rest_in = inertia * (values.rollers[j, 0] - star.rollers[j, 0]) + turning - driving
        rest_out = inertia * (values.rollers[j, 1] - star.rollers[j, 1]) + turning + driving
        arrow.rest[j, 0], arrow.rest[j, 1] = rest_in, rest_out
        worst = max(worst, abs(rest_in), abs(rest_out))
        # A maximum may pass over what is not a number.
        finite = finite and abs(rest_in) + abs(rest_out) < math.inf
        _write_block(inertia, stations, sheet, met, j, arrow.inverse[j])
        _add_to_border(bearing, stage, stations, met, j, arrow)
    for c in range(bearing.cages):
        for i in range(3 if bearing.translates else 1):
            worst = max(worst, abs(arrow.border_rest[c, i]))
            finite = finite and abs(arrow.border_rest[c, i]) < math.inf
    return worst if finite else math.inf, evaluations


@jit_merged
def solve_stage(bearing, stage, moment, space):
    """Solve a stage from the guess in `moment.values`, which it replaces.

    Parameters
    ----------
    bearing : WholeBearing
    stage : Stage
    moment : Moment
        With its stations.
    space : Space
        With y* in `star`; its `arrow` is left prepared for further right-hand sides.

    Returns
    -------
    float
        Largest residual [N]; above the tolerance or not finite where the stage is not solved.
    """
    tractions, arrow, cage_of = space.tractions, space.arrow, bearing.rollers.cage
    size = 3 if bearing.translates else 1
    worst = math.inf
    tractions.settled[:] = False
    for _ in range(_ITERATIONS):
        worst, evaluations = _assemble(bearing, stage, moment, space.star, tractions, arrow)
        space.work[0] += evaluations
        space.work[1] += 1
        eliminate(cage_of, size, arrow)
        if worst <= stage.tolerance or not worst < math.inf:
            break
        solve(cage_of, size, arrow)
        rollers, cages = moment.values.rollers, moment.values.cages
        for j in range(cage_of.size):
            rollers[j, 0] -= arrow.rest[j, 0]
            rollers[j, 1] -= arrow.rest[j, 1]
        for c in range(bearing.cages):
            cages[c, 0] -= arrow.border_rest[c, 0]
            if bearing.translates:
                cages[c, 2] -= arrow.border_rest[c, 1]
                cages[c, 3] -= arrow.border_rest[c, 2]
    return worst
