"""Largest power between the points at which an integrator happens to evaluate it."""

from __future__ import annotations

from macroslip.compiled import jit, jit_part
from macroslip.integrate.record import raise_peak
from macroslip.integrate.tuning import HIGHEST_RISE, MOST_UNEVEN


@jit_part
def start_peak(samples, time, inner, outer, cage):
    """Begin a stretch of smooth powers; `samples`, shape (2, 4), holds the last two times and powers, newest last."""
    for row in range(2):
        samples[row, 0] = time
        samples[row, 1] = inner
        samples[row, 2] = outer
        samples[row, 3] = cage


@jit
def vertex(ta, pa, tb, pb, tc, pc):
    """Largest value of the parabola through three samples with ta < tb < tc and pb the largest.

    Examples
    --------
    >>> vertex(0.0, 0.0, 1.0, 3.0, 2.0, 2.0)
    3.125
    """
    left = (pb - pa) / (tb - ta)
    right = (pc - pb) / (tc - tb)
    curvature = (right - left) / (tc - ta)
    if curvature >= 0.0:
        return pb
    slope = (left * (tc - tb) + right * (tb - ta)) / (tc - ta)
    return pb - 0.25 * slope * slope / curvature


@jit_part
def follow_step(record, orbit, samples, before, times, inner, outer, cage):
    """Take up the powers at the stages of a step, as three calls of `follow_peak` would.

    Most steps cannot raise a peak: all they hold, and a tenth more for a parabola, is below the orbit's. For those only
    the samples move on.

    Parameters
    ----------
    before : tuple of float
        Powers of inner, outer and cage at the start of the step [W].
    times, inner, outer, cage : tuple of float
        Times [s] and powers [W] at the three stages.
    """
    if orbit >= 0:
        peak = record.peak_power[orbit]
        rises = HIGHEST_RISE * max(before[0], inner[0], inner[1], inner[2]) > peak[0]
        rises |= HIGHEST_RISE * max(before[1], outer[0], outer[1], outer[2]) > peak[1]
        rises |= HIGHEST_RISE * max(before[2], cage[0], cage[1], cage[2]) > peak[2]
        if rises:
            for stage in range(3):
                follow_peak(record, orbit, samples, times[stage], inner[stage], outer[stage], cage[stage])
            return
    for row in range(2):
        samples[row, 0] = times[row + 1]
        samples[row, 1] = inner[row + 1]
        samples[row, 2] = outer[row + 1]
        samples[row, 3] = cage[row + 1]


@jit_part
def follow_peak(record, orbit, samples, time, inner, outer, cage):
    """Take up the powers at a new time; raise the orbit's peaks to the samples and to the parabolas through them."""
    # Where spacing changes much between samples a fast transient has just ended, and a parabola would extrapolate it.
    before, after = samples[1, 0] - samples[0, 0], time - samples[1, 0]
    even = before > 0.0 and after > 0.0 and before < MOST_UNEVEN * after and after < MOST_UNEVEN * before
    for interface in range(3):
        power = inner if interface == 0 else (outer if interface == 1 else cage)
        raise_peak(record, orbit, interface, power)
        first, middle = samples[0, interface + 1], samples[1, interface + 1]
        if even and middle > first and middle > power:
            top = vertex(samples[0, 0], first, samples[1, 0], middle, time, power)
            raise_peak(record, orbit, interface, min(top, HIGHEST_RISE * middle))
        samples[0, interface + 1] = middle
        samples[1, interface + 1] = power
    samples[0, 0] = samples[1, 0]
    samples[1, 0] = time
