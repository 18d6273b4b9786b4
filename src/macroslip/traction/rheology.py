"""How a sheared film's stress falls behind the Newtonian one: limiting shear stress, or Eyring's thermal activation.

Each law is written γ̇ = τ*(τ)/η with an equivalent Newtonian stress τ*, and used in its inverse form τ = t(τ*). The
viscosity is then alone in the denominator, so that shear heating can be solved exactly together with it.
"""

from __future__ import annotations

import math

from macroslip.compiled import jit

NEWTONIAN, LIMITING_SHEAR, EYRING = 0, 1, 2
#: Numbers of the laws by the names that case files use.
RHEOLOGIES = {"newtonian": NEWTONIAN, "limiting-shear": LIMITING_SHEAR, "eyring": EYRING}


@jit
def limited_stress(rheology, viscous_stress, characteristic_stress):
    """Shear stress of the film and its elasticity.

    Parameters
    ----------
    rheology : int
        `NEWTONIAN`: τ = τ*. `LIMITING_SHEAR` (Bair and Winer): τ = τ_L [1 − exp(−τ*/τ_L)]. `EYRING`:
        τ = τ_E asinh(τ*/τ_E).
    viscous_stress : float
        Newtonian stress τ* = η γ̇ ≥ 0 [Pa].
    characteristic_stress : float
        τ_L or τ_E > 0 [Pa].

    Returns
    -------
    tuple of float
        τ [Pa] and d ln τ/d ln τ* [-], between 0 and 1.

    References
    ----------
    Bair and Winer, J. Lubr. Technol. 101 (1979) 258, doi:10.1115/1.3453342; Eyring's law for traction: Johnson and
    Tevaarwerk, Proc. R. Soc. A 356 (1977) 215, doi:10.1098/rspa.1977.0129.

    Examples
    --------
    >>> [round(x, 6) for x in limited_stress(LIMITING_SHEAR, 2.0e7, 4.0e7)]
    [15738773.611495, 0.770747]
    >>> [round(x, 6) for x in limited_stress(EYRING, 3.3e6, 3.3e6)]
    [2908532.837164, 0.802278]
    """
    if rheology == NEWTONIAN or viscous_stress == 0.0:
        return viscous_stress, 1.0
    ratio = viscous_stress / characteristic_stress
    if rheology == LIMITING_SHEAR:
        if ratio > 700.0:
            return characteristic_stress, 0.0
        part = -math.expm1(-ratio)
        return characteristic_stress * part, ratio * (1.0 - part) / part
    part = math.asinh(ratio)
    return characteristic_stress * part, ratio / (math.sqrt(1.0 + ratio * ratio) * part)
