"""Shear stress at one point of a film that is limited in stress and heated by its own shear: the exact solution.

Across a thin film the stress τ is constant, and a law γ̇ = τ*(τ)/η dissipates τ τ*/η. With η = η_s exp(−β ΔT) and walls
at inlet temperature the heat balance k T'' = −τ τ*/η is Crook's problem with τ τ* in place of τ², and has his solution:
the profile is ΔT = (2/β) ln[cosh c/cosh(2c y/h)], with c from

    τ Δu β h/(8k) = c tanh c,        τ* = (η_s Δu/h) 2c/sinh 2c,        τ = t(τ*).

The first means that all power leaves by conduction, the second that the shear rates add up to the slip. The left of the
first rises with c and what the others put into it falls, so there is exactly one solution for every slip. In a
Newtonian film τ = τ*, and sinh² c = B is Crook's heating number. Stress rises with slip as long as c tanh c < 1,
whatever the law t: that is as long as τ Δu < 8k/(β h).
"""

from __future__ import annotations

import math

from macroslip.compiled import jit
from macroslip.traction.rheology import NEWTONIAN, limited_stress

_SMALL = 1e-9


@jit
def heated_shear(rheology, viscous_stress, characteristic_stress, heat):
    """Shear stress of a self-heated film.

    Parameters
    ----------
    rheology : int
        See `macroslip.traction.rheology.limited_stress`.
    viscous_stress : float
        η_s |Δu|/h [Pa], with the viscosity at wall temperature.
    characteristic_stress : float
        Limiting or Eyring stress [Pa], taken at wall temperature.
    heat : float
        β h |Δu|/(8k) [1/Pa]; 0 without heating.

    Returns
    -------
    tuple of float
        τ [Pa]; g = d ln τ/d ln η_s [-]; and f ≥ 0 [-], with which d ln τ/d ln Δu = g (1 − f), d ln τ/d ln h =
        −g (1 + f), and d ln τ/d ln(characteristic stress) = 1 − g (1 + f).

    Notes
    -----
    Valid as long as conduction across the film is the only way for heat to leave. The mid-film temperature rise is
    (2/β) ln cosh c.

    References
    ----------
    Derivation in the module's docstring; Crook (1961), doi:10.1098/rsta.1961.0014, for the Newtonian case.

    Examples
    --------
    >>> stress, by_viscosity, _ = heated_shear(1, 1e8, 5e7, 2e-8)
    >>> round(stress / 5e7, 6), round(by_viscosity, 6)
    (0.691124, 0.397545)
    """
    if viscous_stress == 0.0:
        return 0.0, 1.0, 0.0
    stress, elasticity = limited_stress(rheology, viscous_stress, characteristic_stress)
    power = heat * stress
    if rheology == NEWTONIAN:
        c = math.asinh(math.sqrt(power))
        if c < 1e-4:
            return stress * (1.0 - power * (2.0 / 3.0)), 1.0 - power * (2.0 / 3.0), power * (2.0 / 3.0)
        stress = viscous_stress * _thinning(c)
    elif power < _SMALL:
        feedback = power * (2.0 / 3.0)
        return stress * (1.0 - elasticity * feedback), elasticity * (1.0 - elasticity * feedback), feedback
    else:
        c = _heating_parameter(rheology, viscous_stress, characteristic_stress, heat, power)
        stress, elasticity = limited_stress(rheology, viscous_stress * _thinning(c), characteristic_stress)
    feedback = _feedback(c)
    return stress, elasticity / (1.0 + elasticity * feedback), feedback


@jit
def _thinning(c):
    """2c/sinh 2c [-], by which heating lowers the mean viscosity of the film."""
    if c < 1e-3:
        return 1.0 - c * c * (2.0 / 3.0)
    # Beyond, the stress is nothing, but its logarithm has to exist.
    decay = math.exp(-2.0 * min(c, 340.0))
    return 4.0 * c * decay / (1.0 - decay * decay)


@jit
def _feedback(c):
    """[d ln(sinh 2c/2c)/d ln c]/[d ln(c tanh c)/d ln c] [-]: 0 without heating, 1 where stress peaks over slip."""
    if c < 0.02:
        return c * c * (2.0 / 3.0) * (1.0 - c * c * (7.0 / 15.0))
    decay = math.exp(-4.0 * c)
    return (2.0 * c * (1.0 + decay) / (1.0 - decay) - 1.0) / (1.0 + _thinning(c))


@jit
def _heating_parameter(rheology, viscous_stress, characteristic_stress, heat, power):
    """Root c of c tanh c = heat · t(viscous_stress 2c/sinh 2c), by Newton's method kept inside a bracket."""
    # Neither more than without thinning by heat, nor more than in a Newtonian film.
    low, high = 0.0, min(math.sqrt(power * (1.0 + power)), math.asinh(math.sqrt(heat * viscous_stress)))
    c = high
    for _ in range(60):
        decay = math.exp(-2.0 * c)
        tangent = (1.0 - decay) / (1.0 + decay)
        spread = 2.0 * c * (1.0 + decay * decay) / (1.0 - decay * decay) - 1.0
        stress, elasticity = limited_stress(rheology, viscous_stress * _thinning(c), characteristic_stress)
        rest = c * tangent - heat * stress
        if rest > 0.0:
            high = c
        else:
            low = c
        slope = tangent + c * (1.0 - tangent * tangent) + heat * stress * elasticity * spread / c
        following = c - rest / slope
        if not low <= following <= high:
            following = 0.5 * (low + high)
        change = abs(following - c)
        c = following
        # Newton's next change would be of the order of this one squared.
        if change <= 1e-6 * c:
            break
    return c
