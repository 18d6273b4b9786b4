"""Step control: bounds known before a step, and error estimates of slip and energy after it.

Energy is a sum over three instants of a step. Where power is smooth, the embedded estimate is far
above the error of the sum. Where power has a kink inside the step, or falls to zero at its end with
an infinite slope, estimate and error are of the same size, and the estimate may be small by
accident.
"""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.imposed import tuning
from macroslip.imposed.radau import EIGENVALUE, NODES, WEIGHTS, sample_between
from macroslip.imposed.state import evaluate
from macroslip.imposed.zones import EDGE, FIRM, FREE
from macroslip.mechanics.spin import net_force, powers
from macroslip.ring.orbit import instant

_ROOT_6 = math.sqrt(6.0)


_MOMENTS = np.array([1.0 - 1.0 / EIGENVALUE, 0.5, 1.0 / 3.0])
_THIRD = np.linalg.solve(np.vander(NODES, 3, increasing=True).T, _MOMENTS)
#: Weights of (third-order rule with weight 1/EIGENVALUE at the start) − (Radau rule), at nodes 0,
#: c1, c2, 1.
EMBEDDED = (1.0 / EIGENVALUE, *(float(x) for x in _THIRD - np.array(WEIGHTS)))
#: Coefficients of x, x² and x³ of the cubics that are 1 at one of the nodes 0, c1, c2, 1 of a step
#: and 0 at the others.
_CUBICS = np.linalg.inv(np.vander([0.0, *NODES], 4, increasing=True))
_TERMS = tuple(tuple(row) for row in _CUBICS[1:].tolist())
#: Most iterations of the search for a zero of such a cubic, and the change of the part of a step
#: after which it ends.
_ITERATIONS = 50
_CONVERGED = 1e-12


@jit_inline
def _combined(weights, g0, g1, g2, g3):
    """Weighted sum of the values at the nodes of a step."""
    return weights[0] * g0 + weights[1] * g1 + weights[2] * g2 + weights[3] * g3


@jit_inline
def _cubic_terms(g0, g1, g2, g3):
    """Coefficients of x, x² and x³ of the cubic through the values at the nodes of a step."""
    linear = _combined(_TERMS[0], g0, g1, g2, g3)
    square = _combined(_TERMS[1], g0, g1, g2, g3)
    cube = _combined(_TERMS[2], g0, g1, g2, g3)
    return linear, square, cube


@jit_inline
def cubic(x, g0, g1, g2, g3):
    """Cubic interpolation through the values at the nodes of a Radau step.

    Parameters
    ----------
    x : float
        Part of the step, 0 at its start and 1 at its end [-].
    g0, g1, g2, g3 : float
        Values at 0, c1, c2 and 1, of any unit.

    Returns
    -------
    float
        Value at x, of the same unit.

    Examples
    --------
    >>> float(round(cubic(0.5, 1.0, 1.0 + NODES[0] ** 3, 1.0 + NODES[1] ** 3, 2.0), 12))
    1.125
    """
    first, second, third = _cubic_terms(g0, g1, g2, g3)
    return g0 + x * (first + x * (second + x * third))


@jit_inline
def crossing(g0, g1, g2, g3):
    """First sign change of the cubic through a step's nodes, as a part of the step.

    Parameters
    ----------
    g0, g1, g2, g3 : float
        Values at the start of the step and at its three stages, of any unit.

    Returns
    -------
    float
        Part of the step, in (0, 1) [-]; 1 if no sign changes inside the step. A change next to an
        end, by `AT_END`, is none.

    Examples
    --------
    >>> float(round(crossing(-0.5, NODES[0] - 0.5, NODES[1] - 0.5, 0.5), 12))
    0.5
    >>> crossing(1.0, 2.0, 3.0, 4.0)
    1.0
    """
    if g0 * g1 < 0.0:
        low = 0.0
        high = NODES[0]
        below = g0
        above = g1
    elif g1 * g2 < 0.0:
        low = NODES[0]
        high = NODES[1]
        below = g1
        above = g2
    elif g2 * g3 < 0.0:
        low = NODES[1]
        high = 1.0
        below = g2
        above = g3
    else:
        return 1.0
    first, second, third = _cubic_terms(g0, g1, g2, g3)
    part = low + (high - low) * below / (below - above)
    # Newton's method, held between parts with values of either sign.
    for _ in range(_ITERATIONS):
        value = g0 + part * (first + part * (second + part * third))
        slope = first + part * (2.0 * second + part * 3.0 * third)
        if value * below > 0.0:
            low = part
        else:
            high = part
        following = part - value / slope if slope != 0.0 else low
        change = abs(following - part)
        # A start at the zero may leave the bounds by rounding.
        if change >= _CONVERGED and not low < following < high:
            following = 0.5 * (low + high)
        part = following
        if change < _CONVERGED:
            break
    return part if tuning.AT_END < part < 1.0 - tuning.AT_END else 1.0


@jit_inline
def _lean(at):
    """Body force along the contact normal from the raceway loads, positive outward [N]."""
    return at.outer_load - at.inner_load


@jit
def first_cusp(now, zone, attempt):
    """Part of a step at which traction first has a cusp, as a light contact's load passes zero.

    It is 1 if there is none. At the cage it is predicted with the traction at the start, whose
    change is small against the roller's weight. A roller without elastic load has another where it
    leans over from one raceway to the other. Where the shaft turns back all friction has one.
    """
    at = now.at
    first = attempt.at[0]
    second = attempt.at[1]
    third = attempt.at[2]
    held = now.forces.cage_load - at.tangential
    part = crossing(
        at.tangential + held,
        first.tangential + held,
        second.tangential + held,
        third.tangential + held,
    )
    turn = crossing(at.ring_speed, first.ring_speed, second.ring_speed, third.ring_speed)
    part = min(part, turn)
    if zone == FREE:
        change_over = crossing(_lean(at), _lean(first), _lean(second), _lean(third))
        part = min(part, change_over)
    return part


@jit_inline
def embedded_slip_error(scale, slope, force_0, z1, z2, z3):
    """Embedded error estimate of the slip after a Radau step, filtered by the least slope.

    Parameters
    ----------
    scale : float
        1/(h r²/I_z') [N s/m].
    slope : float
        Least slope of the net force by slip in the step, ≥ 0 [N s/m].
    force_0 : float
        Net force at the start of the step [N].
    z1, z2, z3 : float
        Increments of slip by forces at the stages [m/s].

    Returns
    -------
    float
        Estimated error with its sign [m/s].

    References
    ----------
    Hairer and Wanner, Solving Ordinary Differential Equations II, Springer (1996), section IV.8.
    """
    first = (13.0 + 7.0 * _ROOT_6) * z1
    second = (13.0 - 7.0 * _ROOT_6) * z2
    combined = (first + second + z3) / 3.0
    return -(force_0 + scale * combined) / (scale * EIGENVALUE + slope)


@jit_inline
def allowed_slip(limits):
    """Error of slip that a step may have [m/s]."""
    return tuning.SLIP_SHARE * limits.tolerance * limits.speed_scale


@jit_inline
def slip_error(path, now, zone, attempt, sample, sums):
    """Error estimate of the slip of a step [m/s].

    The embedded estimate is one number and may vanish by accident, especially where grip ceases
    between two stages. There and with microslip the equation's defect is sampled between them, and
    elsewhere where the estimate is not far below what is allowed.

    Parameters
    ----------
    path : macroslip.imposed.state.Path
    now : record of `macroslip.imposed.state.STATE`
        State at the start of the step.
    zone : int
        Class of the sample interval: `FREE`, `EDGE` or `FIRM`.
    attempt : record of `macroslip.imposed.state.ATTEMPT`
        The step, solved.
    sample : record of `macroslip.imposed.state.STEP_SAMPLE`
        Room for the samples.
    sums : record of `macroslip.imposed.state.SUMS`
        Counts the evaluations.

    Returns
    -------
    float
        Error, ≥ 0 [m/s].
    """
    microslip = path.body.microslip
    firm = zone == FIRM
    forces = attempt.forces
    error = 0.0
    last = forces[2].slope
    if not (firm and microslip):
        # A held roller's slip is the balance of the instant, solved for at the end of the step.
        least = min(now.forces.slope, forces[0].slope, forces[1].slope, last)
        least = max(least, 0.0)
        error = abs(
            embedded_slip_error(
                attempt.scale,
                least,
                net_force(now.forces),
                attempt.increment[0],
                attempt.increment[1],
                attempt.increment[2],
            )
        )
    turn = attempt.length * path.body.mobility
    # With microslip grip ceases gradually.
    ceases = zone == EDGE and not microslip
    checks = 1
    if firm:
        checks = 0
    elif ceases:
        checks = 2
    unchecked = tuning.UNCHECKED * allowed_slip(path.limits)
    for check in range(checks):
        is_optional = not microslip and (check > 0 or not ceases)
        if is_optional and error < unchecked:
            break
        sample_between(path, now, attempt, tuning.DEFECT_NODES[check], sample)
        evaluate(path, sample.at, sample.slip, sample.forces)
        sums.evaluations += 1
        defect = sample.rate + turn * net_force(sample.forces)
        stiffening = 1.0 + turn * abs(sample.forces.slope)
        error = max(error, tuning.DEFECT_WEIGHT * abs(defect) / stiffening)
    if microslip:
        # Slip that the next step forgets need not be known so well.
        error /= 1.0 + tuning.FORGOTTEN * turn * max(last, 0.0)
    return error


@jit
def missed_way(path, now, attempt):
    """Quadrature error of the distance by which the rings pass the roller in a step [m].

    The way is known exactly. Speed is linear between the samples of the loads, and friction follows
    it: kinks of both lie at the same instants.
    """
    before = instant(path.motion, now.interval, now.time)
    after = instant(path.motion, attempt.end_interval, attempt.times[2])
    turned = after.shaft_angle - before.shaft_angle
    way = -path.body.orbit_ratio * path.body.outer_radius * turned
    mean_speed = 0.0
    for k in range(3):
        mean_speed += WEIGHTS[k] * attempt.at[k].ring_speed
    return attempt.length * mean_speed - way


@jit_inline
def _kink_error(path, now, attempt):
    """Energy error of a step that spans samples, where speed has kinks [J]."""
    if attempt.end_interval == now.interval:
        return 0.0
    fastest = abs(now.at.ring_speed)
    for k in range(3):
        fastest = max(fastest, abs(attempt.at[k].ring_speed))
    missed = abs(missed_way(path, now, attempt))
    if fastest == 0.0:
        # At rest at all stages; the shaft may have turned in between.
        return math.inf if missed > 0.0 else 0.0
    totals = attempt.totals
    largest = max(totals[0], totals[1], totals[2], totals[3])
    return tuning.KINK_WEIGHT * missed / fastest * largest


@jit_inline
def energy_error(path, now, zone, attempt, sample, sums):
    """Error estimate of the energy of a step [J].

    Parameters
    ----------
    path : macroslip.imposed.state.Path
    now : record of `macroslip.imposed.state.STATE`
        State at the start of the step.
    zone : int
        Class of the sample interval: `FREE`, `EDGE` or `FIRM`.
    attempt : record of `macroslip.imposed.state.ATTEMPT`
        The step, solved.
    sample : record of `macroslip.imposed.state.STEP_SAMPLE`
        Room for a sample.
    sums : record of `macroslip.imposed.state.SUMS`
        Counts the evaluations.

    Returns
    -------
    float
        Error, ≥ 0 [J].
    """
    error = 0.0
    totals = attempt.totals
    for k in range(4):
        error += EMBEDDED[k] * totals[k]
    error = max(abs(attempt.length * error), _kink_error(path, now, attempt))
    first = abs(now.forces.cage_load)
    last = abs(attempt.forces[2].cage_load)
    if zone == EDGE or min(first, last) >= tuning.FALLEN * max(first, last):
        return error
    if zone == FIRM and path.body.microslip:
        return error  # the raceways' power, beside which the cage's is little, has no cusp there
    # The cage's load is all but gone at one end of the step: power is evaluated between the stages.
    sample_between(path, now, attempt, tuning.CUSP_LOOK, sample)
    # Between stages the polynomial of slip is far from balance; for the cage, balance is pure
    # rolling.
    slip = 0.0 if zone == FIRM else sample.slip
    evaluate(path, sample.at, slip, sample.forces)
    sums.evaluations += 1
    power = powers(path.body, sample.at, sample.forces, slip, sample.powers[:])
    expected = cubic(tuning.CUSP_LOOK, totals[0], totals[1], totals[2], totals[3])
    missed = abs(power - expected)
    return max(error, tuning.CUSP_WEIGHT * attempt.length * missed)


@jit_inline
def held_energy_error(energy, length, before, after):
    """Error estimate of the energy of a held step, from the trapezoidal and Simpson's rule.

    With E_S by Simpson's and E_T by the trapezoidal rule the estimate is

        4 (E_S − E_T)²/|E_S|.

    It is of the fourth order in the step, as the error of E_S is, and 80 times that error for a power
    that grows exponentially. Errors of a rising and of a falling power have one sign and add up,
    which the margin is for.

    Parameters
    ----------
    energy : float
        Energy of the step by Simpson's rule [J].
    length : float
        Length of the step [s].
    before, after : float
        Powers at the start and at the end of the step [W].

    Returns
    -------
    float
        Estimated error, ≥ 0 [J]; infinite where the energy is zero.
    """
    difference = 2.0 * energy - length * (before + after)
    return difference * difference / abs(energy) if energy != 0.0 else math.inf


@jit_inline
def step_factor(error):
    """Factor for the next step from error / tolerance of a third-order estimate."""
    return tuning.SAFETY / math.sqrt(math.sqrt(max(error, 1e-8)))
