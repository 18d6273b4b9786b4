"""Largest power between the points at which an integrator happens to evaluate it."""

from __future__ import annotations

from macroslip.compiled import jit
from macroslip.integrate.record import raise_peak


@jit
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


@jit
def follow_peak(record, orbit, samples, time, inner, outer, cage):
    """Take up the powers at a new time; raise the orbit's peaks to the samples and to the parabolas through them."""
    # Where spacing changes much between samples a fast transient has just ended, and a parabola would extrapolate it.
    before, after = samples[1, 0] - samples[0, 0], time - samples[1, 0]
    even = before > 0.0 and after > 0.0 and before < 4.0 * after and after < 4.0 * before
    for interface in range(3):
        power = inner if interface == 0 else (outer if interface == 1 else cage)
        raise_peak(record, orbit, interface, power)
        first, middle = samples[0, interface + 1], samples[1, interface + 1]
        if even and middle > first and middle > power:
            top = vertex(samples[0, 0], first, samples[1, 0], middle, time, power)
            # A kink has no parabola; what it may add is bounded.
            raise_peak(record, orbit, interface, min(top, 1.1 * middle))
        samples[0, interface + 1] = middle
        samples[1, interface + 1] = power
    samples[0, 0] = samples[1, 0]
    samples[1, 0] = time
