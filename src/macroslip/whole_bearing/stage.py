"""One implicit stage of all rollers and cages, solved by Newton's method.

A stage is solved for y in y = y* + γh f(t, y). Newton's equations are divided by γh, so that residuals are forces [N]. Unknowns
are each roller's slips v_in and v_out and each cage's lead w and, where it translates, its speeds p along X0 and q along Y0;
offsets and displacements follow from them. The matrix is that of `macroslip.whole_bearing.arrow`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit_inline, jit_merged
from macroslip.whole_bearing.arrow import eliminate, solve
from macroslip.whole_bearing.guidance import guide_force
from macroslip.whole_bearing.meeting import add_to_border, follow_roller, meet, write_block
from macroslip.whole_bearing.space import PULL_INNER, PULL_OUTER, SPIN_INNER, SPIN_OUTER
from macroslip.whole_bearing.traction import INNER, OUTER, PULL, SPIN, evaluate_marked, out_of_reach, raceway_from
from macroslip.whole_bearing.tuning import ITERATIONS, PREDICTED, PREDICTED_REST

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
def _predict(stations, rollers, sheets, force):
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
    _predict(stations, moment.values.rollers, sheets, force)
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
            # Slopes that predicted the force well enough serve until the stage is solved.
            tractions.settled[j] = off <= PREDICTED * stage.tolerance
            f[SPIN_INNER], f[PULL_INNER] = sheet[INNER + SPIN], sheet[INNER + PULL]
            f[SPIN_OUTER], f[PULL_OUTER] = sheet[OUTER + SPIN], sheet[OUTER + PULL]
    return evaluations


@jit_inline
def _place_cages(stage, cages, star):
    """Lag and translations of the cages, which follow from their speeds."""
    for c in range(cages.shape[0]):
        cages[c, 1] = star[c, 1] + stage.step * cages[c, 0]
        cages[c, 4] = star[c, 4] + stage.step * cages[c, 2]
        cages[c, 5] = star[c, 5] + stage.step * cages[c, 3]


@jit_merged
def _assemble(bearing, stage, moment, star, tractions, arrow):
    """Residuals and derivatives at the present state. Returns the largest residual [N] and the evaluations."""
    values, stations = moment.values, moment.stations
    _place_cages(stage, values.cages, star.cages)
    _begin_cages(bearing, stage, values.cages, star.cages, arrow)
    evaluations = _raceway_forces(bearing, stage, moment, tractions)
    inertia, worst, finite = bearing.roller_mass / stage.step, 0.0, True
    for j in range(bearing.rollers.row.size):
        sheet, f = tractions.sheets[j], moment.force[j]
        met = meet(bearing, stage, moment, star, sheet, j)
        turning = 2.0 * (f[SPIN_INNER] + f[SPIN_OUTER] + met.friction)
        driving = met.push - stations.tangential[j] - f[PULL_INNER] + f[PULL_OUTER]
        rest_in = inertia * (values.rollers[j, 0] - star.rollers[j, 0]) + turning - driving
        rest_out = inertia * (values.rollers[j, 1] - star.rollers[j, 1]) + turning + driving
        arrow.rest[j, 0], arrow.rest[j, 1] = rest_in, rest_out
        worst = max(worst, abs(rest_in), abs(rest_out))
        # `max` may ignore a NaN.
        finite = finite and abs(rest_in) + abs(rest_out) < math.inf
        write_block(inertia, stations, sheet, met, j, arrow)
        add_to_border(bearing, stage, stations, met, j, arrow)
    for c in range(bearing.cages):
        for i in range(3 if bearing.translates else 1):
            worst = max(worst, abs(arrow.border_rest[c, i]))
            finite = finite and abs(arrow.border_rest[c, i]) < math.inf
    return worst if finite else math.inf, evaluations


@jit_inline
def _update(values, arrow, size):
    """Subtract a solution from the unknowns."""
    rollers, cages = values.rollers, values.cages
    for j in range(rollers.shape[0]):
        rollers[j, 0] -= arrow.rest[j, 0]
        rollers[j, 1] -= arrow.rest[j, 1]
    for c in range(cages.shape[0]):
        cages[c, 0] -= arrow.border_rest[c, 0]
        if size == 3:
            cages[c, 2] -= arrow.border_rest[c, 1]
            cages[c, 3] -= arrow.border_rest[c, 2]


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
        Largest residual [N], or what the last update is predicted to leave of it; above the tolerance or not finite where
        the stage is not solved.
    """
    tractions, arrow, cage_of = space.tractions, space.arrow, bearing.rollers.cage
    size = 3 if bearing.translates else 1
    worst, before = math.inf, math.inf
    tractions.settled[:] = False
    for _ in range(ITERATIONS):
        worst, evaluations = _assemble(bearing, stage, moment, space.star, tractions, arrow)
        space.work[0] += evaluations
        space.work[1] += 1
        eliminate(cage_of, size, arrow)
        if worst <= stage.tolerance or not worst < math.inf:
            break
        solve(cage_of, size, arrow)
        _update(moment.values, arrow, size)
        predicted = worst * max((worst / before) ** 2, PREDICTED_REST)
        if predicted <= stage.tolerance:
            _place_cages(stage, moment.values.cages, space.star.cages)
            for j in range(cage_of.size):
                follow_roller(bearing, stage, moment, tractions.sheets[j], j, arrow)
            return predicted
        before = worst
    return worst
