"""One step of Alexander's method: two implicit stages, second order, L-stable, and the step's error.

Nodes γ and 1, γ = 1 − 1/√2, the last stage being the step's end. The error is the difference to a third-order quadrature of
the slopes at the step's start and both stages, divided by the stage's matrix, which takes out what a gripped contact damps.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit, jit_called, jit_merged
from macroslip.ring.orbit import interval_of
from macroslip.whole_bearing.arrow import solve
from macroslip.whole_bearing.record import stage_powers
from macroslip.whole_bearing.space import POCKET_SPEED
from macroslip.whole_bearing.stage import Stage, solve_stage
from macroslip.whole_bearing.station import locate
from macroslip.whole_bearing.tuning import PLACE_TIME

#: Node of the first stage, Alexander, SIAM J. Numer. Anal. 14 (1977) 1006, doi:10.1137/0714068.
GAMMA = 1.0 - math.sqrt(0.5)
#: Weights of the slopes at start, first and second stage in (third-order quadrature) − (the method's).
_E1 = (0.5 - 1.0 / 3.0) / (GAMMA * (1.0 - GAMMA))
_E2 = 0.5 - GAMMA * _E1
_ERROR = (1.0 - _E1 - _E2, _E1 - (1.0 - GAMMA), _E2 - GAMMA)


class Clock(NamedTuple):
    """Time [s], the sample interval that holds it, and the shaft speed there [rad/s]."""

    time: float
    interval: int
    shaft_speed: float


@jit
def clock_at(motion, time, start):
    """The clock at `time` [s]; a sample's own time belongs to the interval that ends there, if `start` is before it."""
    k = interval_of(motion, time, start)
    if k > start and time <= motion.time[k]:
        k -= 1
    share = (time - motion.time[k]) / (motion.time[k + 1] - motion.time[k])
    return Clock(time, k, motion.shaft_speed[k] + (motion.shaft_speed[k + 1] - motion.shaft_speed[k]) * share)


@jit_merged
def _set_star(bearing, span, change, space):
    """y* from the state and the first stage's slope during `span` [s]; the shaft's change [rad/s] enters exactly."""
    star, state, rate = space.star, space.state, space.first_rate
    for j in range(state.rollers.shape[0]):
        for i in range(3):
            star.rollers[j, i] = state.rollers[j, i] + span * rate.rollers[j, i]
        star.rollers[j, 0] -= bearing.rollers.inner_radius[j] * change
    for c in range(bearing.cages):
        for i in range(6):
            star.cages[c, i] = state.cages[c, i] + span * rate.cages[c, i]
        star.cages[c, 0] -= 0.5 * bearing.inner_radius * change


@jit_merged
def _guess(step, star, rate, values):
    for j in range(values.rollers.shape[0]):
        for i in range(3):
            values.rollers[j, i] = star.rollers[j, i] + step * rate.rollers[j, i]
    for c in range(values.cages.shape[0]):
        for i in range(6):
            values.cages[c, i] = star.cages[c, i] + step * rate.cages[c, i]


@jit_merged
def _keep_rate(step, star, moment, rate):
    values = moment.values
    for j in range(values.rollers.shape[0]):
        rate.rollers[j, 0] = (values.rollers[j, 0] - star.rollers[j, 0]) / step
        rate.rollers[j, 1] = (values.rollers[j, 1] - star.rollers[j, 1]) / step
        rate.rollers[j, 2] = moment.force[j, POCKET_SPEED]
    for c in range(values.cages.shape[0]):
        for i in range(6):
            rate.cages[c, i] = (values.cages[c, i] - star.cages[c, i]) / step


@jit_called
def _solve_at(bearing, motion, stage, clock, moment, space):
    """Place the rollers, solve a stage, and keep its powers. Returns the largest residual [N]."""
    values = moment.values
    locate(bearing, motion, clock.interval, clock.time, values.rollers, values.cages, moment.stations)
    worst = solve_stage(bearing, stage, moment, space)
    stage_powers(bearing, moment, space.tractions.sheets)
    return worst


@jit_merged
def take_step(bearing, motion, limits, start, end, space):
    """Solve both stages from `space.state`, into `space.first` and `space.last`.

    Parameters
    ----------
    bearing : WholeBearing
    motion : Motion
    limits : BearingLimits
    start, end : Clock
    space : Space

    Returns
    -------
    worst : float
        Largest residual [N].
    solved : bool
    """
    h = end.time - start.time
    tractions = space.tractions
    for j in range(tractions.rest.size):
        tractions.fresh[j] = not limits.rests or tractions.rest[j] < h
        tractions.sheets[j] = tractions.known[j]
    step = GAMMA * h
    tolerance = limits.force + bearing.roller_mass / step * limits.rounding
    middle = clock_at(motion, start.time + step, start.interval)
    _set_star(bearing, 0.0, middle.shaft_speed - start.shaft_speed, space)
    _guess(step, space.star, space.slope, space.first.values)
    stage = Stage(step, middle.time, middle.shaft_speed, tolerance, limits.cage_reach)
    before = _solve_at(bearing, motion, stage, middle, space.first, space)
    if not before <= tolerance:
        return before, False
    _keep_rate(step, space.star, space.first, space.first_rate)
    _set_star(bearing, (1.0 - GAMMA) * h, end.shaft_speed - start.shaft_speed, space)
    _guess(step, space.star, space.first_rate, space.last.values)
    stage = Stage(step, end.time, end.shaft_speed, tolerance, limits.cage_reach)
    worst = _solve_at(bearing, motion, stage, end, space.last, space)
    if not worst <= tolerance:
        return worst, False
    _keep_rate(step, space.star, space.last, space.last_rate)
    return max(before, worst), True


@jit
def _weighed(slope, first, last):
    return _ERROR[0] * slope + _ERROR[1] * first + _ERROR[2] * last


@jit_merged
def step_error(bearing, limits, h, space):
    """Error of a solved step of `h` [s] over what is allowed."""
    arrow, slope, first, last = space.arrow, space.slope, space.first_rate, space.last_rate
    worst = 0.0
    for j in range(slope.rollers.shape[0]):
        for i in range(2):
            off = _weighed(slope.rollers[j, i], first.rollers[j, i], last.rollers[j, i])
            arrow.rest[j, i] = bearing.roller_mass / GAMMA * off
        off = _weighed(slope.rollers[j, 2], first.rollers[j, 2], last.rollers[j, 2])
        worst = max(worst, abs(h * off) / (limits.allowed_speed * PLACE_TIME))
    for c in range(bearing.cages):
        for i in range(3):
            k = 0 if i == 0 else i + 1
            off = _weighed(slope.cages[c, k], first.cages[c, k], last.cages[c, k])
            arrow.border_rest[c, i] = bearing.cage_mass / GAMMA * off
    size = 3 if bearing.translates else 1
    solve(bearing.rollers.cage, size, arrow)
    for j in range(slope.rollers.shape[0]):
        worst = max(worst, abs(arrow.rest[j, 0]) / limits.allowed_speed, abs(arrow.rest[j, 1]) / limits.allowed_speed)
    for c in range(bearing.cages):
        for i in range(size):
            worst = max(worst, abs(arrow.border_rest[c, i]) / limits.allowed_speed)
    return worst
