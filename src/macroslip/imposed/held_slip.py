"""Slip of a held roller under changing loads, as a power of the inner raceway's load.

It is a first guess for Newton's method, and no result depends on it.
"""

from __future__ import annotations

from macroslip.compiled import jit_inline
from macroslip.elementary import exponential, logarithm
from macroslip.imposed import tuning


@jit_inline
def held_slip(slip, at, later, exponent):
    """First guess of the slip of a firmly held roller under later conditions.

    With microslip the middle slips so that the two sides of the lines of pure rolling balance, and
    without so that traction holds against the cage's friction: in proportion to speed, and to a power
    of the load that `held_exponent` measures.

    Parameters
    ----------
    slip : float
        Slip now [m/s].
    at, later : record of `macroslip.mechanics.spin.CONDITIONS`
        Conditions now and later.
    exponent : float
        Power of the inner raceway's load that slip follows [-].

    Returns
    -------
    float
        Slip under the later conditions [m/s]; that of now where load or speed give no ratio, or where
        speed grows by more than `MOST_QUICKENING`.
    """
    if at.elastic_load <= 0.0 or at.ring_speed == 0.0 or later.elastic_load <= 0.0:
        return slip
    if abs(later.ring_speed) > tuning.MOST_QUICKENING * abs(at.ring_speed):
        return slip
    return (
        slip
        * exponential(exponent * (later.log_inner_load - at.log_inner_load))
        * (later.ring_speed / at.ring_speed)
    )


@jit_inline
def held_exponent(at, slip, later, later_slip, exponent):
    """Power of the inner raceway's load in proportion to which the slip of a held roller has changed.

    Parameters
    ----------
    at, later : record of `macroslip.mechanics.spin.CONDITIONS`
        Conditions before and after the change.
    slip, later_slip : float
        Slips under these conditions [m/s].
    exponent : float
        Power known from before [-].

    Returns
    -------
    float
        The power, between ±`STEEPEST` [-]; that of before where it cannot be measured.
    """
    if at.elastic_load <= 0.0 or later.elastic_load <= 0.0:
        return exponent
    change = later.log_inner_load - at.log_inner_load
    ratio = (
        later_slip * at.ring_speed / (slip * later.ring_speed)
        if slip * later.ring_speed != 0.0
        else 0.0
    )
    if abs(change) < tuning.LEAST_CHANGE or ratio <= 0.0:
        return exponent
    exponent = logarithm(ratio) / change
    return min(max(exponent, -tuning.STEEPEST), tuning.STEEPEST)
