"""Largest power between the points at which an integrator happens to evaluate it."""

from __future__ import annotations

import numpy as np

from macroslip.compiled import jit
from macroslip.integrate.record import raise_peak


@jit
def new_peak(time, inner, outer, cage):
    """The last two samples of time and of the three powers, newest last; both are the start here."""
    samples = np.empty((2, 4))
    for row in range(2):
        samples[row, 0] = time
        samples[row, 1] = inner
        samples[row, 2] = outer
        samples[row, 3] = cage
    return samples


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


@jit
def follow_peak(record, orbit, samples, time, inner, outer, cage):
    """Take up the powers at a new time; raise the orbit's peaks to the samples and to the parabolas through them."""
    for interface in range(3):
        power = inner if interface == 0 else (outer if interface == 1 else cage)
        raise_peak(record, orbit, interface, power)
        before, middle = samples[0, interface + 1], samples[1, interface + 1]
        if middle > before and middle > power and samples[1, 0] > samples[0, 0] and time > samples[1, 0]:
            top = vertex(samples[0, 0], before, samples[1, 0], middle, time, power)
            # A kink has no parabola; what it may add is bounded.
            raise_peak(record, orbit, interface, min(top, 1.1 * middle))
        samples[0, interface + 1] = middle
        samples[1, interface + 1] = power
    samples[0, 0] = samples[1, 0]
    samples[1, 0] = time
