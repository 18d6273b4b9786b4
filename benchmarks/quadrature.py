"""The rival of the closed form: Crook's stress summed over the contact patch by 32 Gauss-Legendre nodes."""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit

_X, _W = np.polynomial.legendre.leggauss(32)
_NODES = 0.5 * (1.0 + _X)
_WEIGHTS = 0.5 * _W * _NODES
#: Heating number below which asinh is not worth its time: the first term of the series is exact to rounding.
_COLD = 1e-8


@jit
def patch_by_quadrature(pressure_exponent, root_heating):
    """The three numbers of `macroslip.traction.patch_integral.patch_integral` by 32 nodes in s = √(1 − ρ²).

    Parameters
    ----------
    pressure_exponent : float
        P = α_p p0.
    root_heating : float
        q0 = |Δu| √(β η0/(8k)), > 0.

    Returns
    -------
    tuple of float
        Φ = ∫₀¹ s e^{Ps} g(B0 e^{Ps}) ds, ∂Φ/∂ ln q0, ∂Φ/∂P [-].
    """
    value = 0.0
    slope_log_slip = 0.0
    slope_pressure = 0.0
    heating_0 = root_heating * root_heating
    cold = heating_0 * math.exp(pressure_exponent) < _COLD
    for k in range(_NODES.size):
        growth = math.exp(pressure_exponent * _NODES[k])
        heating = heating_0 * growth
        if cold:
            g = 1.0 - heating * 2.0 / 3.0
            steep = -heating * 2.0 / 3.0
        else:
            root = math.sqrt(heating)
            g = math.asinh(root) / (root * math.sqrt(1.0 + heating))
            steep = 0.5 * (1.0 - (1.0 + 2.0 * heating) * g) / (1.0 + heating)
        share = _WEIGHTS[k] * growth
        value += share * g
        slope_log_slip += share * 2.0 * steep
        slope_pressure += share * (g + steep) * _NODES[k]
    return value, slope_log_slip, slope_pressure
