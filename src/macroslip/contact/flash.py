"""Flash temperature: rise of surface temperature in a contact that heats the surfaces by friction.

One station of a contact is taken as a band, infinitely long across rolling and 2b wide along it, on
which heat is released with the distribution q(x) ∝ √(1 − x²/b²): friction stress in proportion to a
Hertz pressure, at a slip that does not vary along rolling. Either surface is a half-space that
moves through the band with its own speed.

For one surface with speed u, Jaeger's integral of moving line sources is

    ΔT(x) = 1/(π k) ∫ q(s) exp[u(x − s)/(2κ)] K0[u|x − s|/(2κ)] ds        over −b < s < b.

Where the Péclet number L = u b/(2κ) is large, heat goes into the depth only, and the integral
becomes

    ΔT(x) = 1/(√π ε √u) ∫ q(s)/√(x − s) ds        over −b < s < x,        ε = √(k ρ c).

With P' = ∫ q ds and x = ξ b this is P'/(ε √u √(2b)) times (2/π)^1.5 ∫ √(1 − σ²)/√(ξ − σ) dσ, which
is largest at ξ = 0.652, towards the outlet, and is there C = 1.11155.

Both surfaces have the same temperature at every point of the contact. As they move the same way,
both have a rise of this one form, so a constant share of the heat, in proportion to ε√u, makes them
equal everywhere, not only at the peak.
"""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit, jit_once

PEAK = 1.1115483780654022
"""C = (2/π)^1.5 max ∫ √(1 − σ²)/√(ξ − σ) dσ over −1 < σ < ξ: the textbooks' 1.11."""


def effusivity(thermal_conductivity, density, specific_heat):
    """Thermal effusivity of a material, ε = √(k ρ c) [J/(m² K √s)].

    From k [W/(m K)], ρ [kg/m³] and c [J/(kg K)], all positive.

    Carslaw and Jaeger, Conduction of Heat in Solids (1959), section 2.9, where k ρ c appears under
    the root.

    Examples
    --------
    Bearing steel:

    >>> float(round(effusivity(46.0, 7850.0, 460.0), 1))
    12888.2
    """
    return np.sqrt(thermal_conductivity * density * specific_heat)


def flash_temperature(power_per_length, half_width, speed_1, speed_2, effusivity_1, effusivity_2):
    """Largest rise of surface temperature in a band of friction [K].

    It is C P'/[(ε1 √|u1| + ε2 √|u2|) √(2b)].

    The rise is above the temperature with which the surfaces enter the contact, at 0.652 b behind
    its middle. It is zero without power, and infinite if both surfaces are at rest: an endless band
    on a half-space then never becomes steady.

    Parameters
    ----------
    power_per_length : array_like
        Friction power P' released per length across rolling at this station [W/m], ≥ 0: ∫ τ |Δu| dx
        along rolling.
    half_width : array_like
        Half-width b of the contact along rolling at this station [m], > 0: the width of an ellipse
        shrinks to its ends.
    speed_1, speed_2 : array_like
        Speeds of the surfaces relative to the contact [m/s], any sign; not their slip.
    effusivity_1, effusivity_2 : array_like
        Thermal effusivities ε = √(k ρ c) [J/(m² K √s)], > 0, see `effusivity`.

    Notes
    -----
    The limit of high Péclet number. It errs on the hot side: beside Jaeger's integral the rise is
    too large by 14 % at L = 0.5, 6.3 % at 1, 2.3 % at 2, 0.4 % at 5 and 0.1 % at 10 (measured in
    the tests). The middle of the base bearing's raceway contacts has L = 2.5 at 1 kN and 9 at 50
    kN, at rated speed. A surface at rest, as the cage's pocket, is taken to accept no heat: all of
    it goes into the other one, which is the most that one can get. Surfaces that move in opposite
    directions have their peaks at opposite sides; the formula then equates the peaks, as Blok does,
    and not the temperatures point by point.

    The source is that of friction in proportion to Hertz's pressure; one that is constant over the
    width gives 1.128 instead of C = 1.11155. Heat crosses the film without resistance, so the oil's
    own rise is not in it. Repeated passes heat the bodies as a whole; that bulk temperature is to
    be added.

    References
    ----------
    Blok, Proc. General Discussion on Lubrication, Inst. Mech. Engrs. 2 (1937) 222. Jaeger, Proc. R.
    Soc. New South Wales 76 (1942) 203. Tian and Kennedy, J. Tribol. 116 (1994) 167,
    doi:10.1115/1.2927035.

    Examples
    --------
    The middle of a raceway contact of the base bearing at 50 kN and rated speed, with 9 W over
    66 mm:

    >>> steel = effusivity(46.0, 7850.0, 460.0)
    >>> float(round(flash_temperature(136.0, 0.63e-3, 0.37, 0.37, steel, steel), 4))
    0.2716
    >>> float(flash_temperature(136.0, 0.63e-3, 0.0, 0.0, steel, steel))
    inf
    """
    power = np.asarray(power_per_length, dtype=float)
    uptake = effusivity_1 * np.sqrt(np.abs(speed_1)) + effusivity_2 * np.sqrt(np.abs(speed_2))
    with np.errstate(divide="ignore", invalid="ignore"):
        rise = PEAK * power / (uptake * np.sqrt(2.0 * np.asarray(half_width)))
    return np.where(power == 0.0, 0.0, rise)[()]


@jit_once
def steady_flash(heat, speed_1, speed_2, effusivity):
    """Largest rise of surface temperature in a band of friction, as `flash_temperature` gives it.

    For compiled code, of two bodies of one material: C √(P' P'/2b)/[ε (√|u1| + √|u2|)].

    Parameters
    ----------
    heat : float
        Friction power per length times that per area, P' P'/2b [W²/m³], ≥ 0.
    speed_1, speed_2 : float
        Speeds of the surfaces relative to the contact [m/s], of either sign.
    effusivity : float
        Thermal effusivity of the material [J/(m² K √s)], > 0.

    Returns
    -------
    float
        Rise of temperature [K], ≥ 0.

    Examples
    --------
    >>> steel = effusivity(46.0, 7850.0, 460.0)
    >>> round(float(steady_flash(136.0**2 / 1.26e-3, 0.37, 0.37, steel)), 4)
    0.2716
    """
    if heat == 0.0:
        return 0.0
    uptake = effusivity * (math.sqrt(abs(speed_1)) + math.sqrt(abs(speed_2)))
    return PEAK * math.sqrt(heat) / uptake


#: Positions x/b in the contact where a transient rise is computed: the steady one is largest at
#: 0.652; and the quadrature of the heat that came in on the way there.
_PLACES = np.array([-0.3, 0.0, 0.3, 0.5, 0.652, 0.8, 0.95])
_NODES, _WEIGHTS = (
    0.5 * (part + shift)
    for part, shift in zip(np.polynomial.legendre.leggauss(20), (1.0, 0.0), strict=True)
)


#: Bound of a transient rise over the steady one of the highest power per width: what quadrature may
#: add is far less.
_SURPLUS = 1.05


@jit_once
def _highest_rise(time, power_per_length, half_width, n, widest, speed):
    """Bound of the rise at a time, times the uptake of heat of both surfaces [W/m^1.5 s^½].

    It is the rise of a steady band with the highest P'/b and the largest b since a point that leaves
    the band now has entered it: where P' and b are linear, their quotient is highest at an end.
    """
    entered = time[n] - (half_width[n] + widest) / speed
    steepest = power_per_length[n] / half_width[n]
    width = half_width[n]
    k = n
    while k > 0 and time[k] > entered:
        k -= 1
        if power_per_length[k] > 0.0:
            steepest = max(steepest, power_per_length[k] / half_width[k])
        width = max(width, half_width[k])
    return _SURPLUS * PEAK * steepest * math.sqrt(0.5 * width)


@jit_once
def _came_in(time, power_per_length, half_width, n, position, widest, speed):
    """Heat that has come into a point of surface 2 at a time, as it acts there [W/m^1.5 s^½].

    It is ∫ q(s)/√(t − s) ds √u/2, from where the band was not yet there, at `position` [m] behind
    the middle of the band.
    """
    came = 0.0
    k = n
    span = math.sqrt((position + widest) / speed)
    for q in range(_NODES.size):
        # The square root in the integral is the variable.
        since = (span * _NODES[q]) ** 2
        then = time[n] - since
        if then < time[0]:
            break
        while k > 1 and time[k - 1] > then:
            k -= 1
        share = (then - time[k - 1]) / (time[k] - time[k - 1])
        width = half_width[k - 1] + share * (half_width[k] - half_width[k - 1])
        inside = 1.0 - ((position - speed * since) / width) ** 2
        if inside > 0.0:
            power = power_per_length[k - 1] + share * (
                power_per_length[k] - power_per_length[k - 1]
            )
            came += _WEIGHTS[q] * power / width * math.sqrt(inside)
    return came * span * math.sqrt(speed)


@jit
def transient_flash(
    time, power_per_length, half_width, speed_1, speed_2, effusivity_1, effusivity_2
):
    """Largest rise of surface temperature [K] under a changing band of friction, from cold.

    Heat goes into the depth only, ΔT = 1/(√π ε) ∫ q(s)/√(t − s) ds along the way of a point of
    surface 2 through the band, with the share of the heat that it would take from a steady one. The
    rise is below that of the largest power in a steady band, and reaches it where power lasts
    longer than the passage.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Rising times [s]. The band is not there before the first, and the rise after the last is not
        looked for; all else is linear between them.
    power_per_length : ndarray, shape (n,)
        Friction power P' per length across rolling [W/m], ≥ 0.
    half_width : ndarray, shape (n,)
        Half-width b of the contact along rolling [m], > 0.
    speed_1, speed_2 : ndarray, shape (n,)
        Speeds of the surfaces relative to the contact [m/s], of either sign.
    effusivity_1, effusivity_2 : float
        Thermal effusivities of the surfaces [J/(m² K √s)], > 0, see `effusivity`.

    Returns
    -------
    float
        Largest rise of temperature [K], ≥ 0.

    References
    ----------
    Carslaw and Jaeger, Conduction of Heat in Solids (1959), section 2.9.

    Examples
    --------
    136 W/m for 10 ms, against 0.2716 K in the steady state:

    >>> steel = effusivity(46.0, 7850.0, 460.0)
    >>> time, one = np.linspace(0.0, 0.01, 50), np.ones(50)
    >>> float(round(transient_flash(time, 136.0 * one, 0.63e-3 * one, 0.37 * one, 0.37 * one, steel, steel), 3))
    0.272
    """
    hottest = 0.0
    widest = 0.0
    likely = 0
    for n in range(time.size):
        widest = max(widest, half_width[n])
        if power_per_length[n] > power_per_length[likely]:
            likely = n
    # The rise at the highest power comes first: most of the others cannot be above it.
    for m in range(-1, time.size):
        n = likely if m < 0 else m
        speed = abs(speed_2[n])
        if n == 0 or power_per_length[n] <= 0.0 or speed == 0.0:
            continue
        uptake = effusivity_1 * math.sqrt(abs(speed_1[n])) + effusivity_2 * math.sqrt(speed)
        if _highest_rise(time, power_per_length, half_width, n, widest, speed) <= hottest * uptake:
            continue
        for position in _PLACES:
            came = _came_in(
                time, power_per_length, half_width, n, position * half_width[n], widest, speed
            )
            hottest = max(hottest, 4.0 / math.pi**1.5 * came / uptake)
    return hottest
