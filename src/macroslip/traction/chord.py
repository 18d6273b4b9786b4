"""Mean shear stress along one chord of the contact ellipse in the direction of rolling.

On the chord at station ζ the Hertz pressure is p1 cos θ with x = b1 sin θ, and slip and film are the same all along it. Its
traction per length is 2 b1 q with q = ∫₀^{π/2} τ(p1 cos θ) cos θ dθ.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit
from macroslip.traction.film_shear import heated_shear
from macroslip.traction.rheology import EYRING, LIMITING_SHEAR, NEWTONIAN


class Fluid(NamedTuple):
    """Properties of a lubricant that set the shear stress of its film.

    Attributes
    ----------
    rheology : int
        See `macroslip.traction.rheology`.
    viscosity : float
        η0 at inlet temperature and ambient pressure [Pa s].
    exponent, index, reference_pressure : float
        ln η = ln η0 + exponent·[(1 + p/reference_pressure)^index − 1]; an index of 1 is Barus' law.
    characteristic : float
        γ = τ_L/p [-] for limiting shear, τ_E [Pa] for Eyring; 1 for a Newtonian film.
    heating : float
        β/(8k) [m/W]; 0 without shear heating.
    """

    rheology: int
    viscosity: float
    exponent: float
    index: float
    reference_pressure: float
    characteristic: float
    heating: float


def chord_rule(nodes: int) -> tuple[np.ndarray, np.ndarray]:
    """Cos θ and weights of ∫₀^{π/2} f(cos θ) cos θ dθ by Gauss and Legendre."""
    t, weights = np.polynomial.legendre.leggauss(nodes)
    cosine = np.cos(0.25 * np.pi * (t + 1.0))
    return cosine, 0.25 * np.pi * weights * cosine


#: cos θ and weights of the rule along a chord.
_COSINES, WEIGHTS = chord_rule(18)


@jit
def log_viscosity(fluid, pressure):
    """Ln η [ln(Pa s)] at a pressure [Pa] and d ln η/d ln p [-].

    Examples
    --------
    >>> fluid = Fluid(0, 0.54, 2.1, 1.0, 1e8, 1.0, 0.0)     # Barus, 21 1/GPa
    >>> [round(x, 6) for x in log_viscosity(fluid, 1e9)]
    [20.383814, 21.0]
    """
    compressed = 1.0 + pressure / fluid.reference_pressure
    power = compressed if fluid.index == 1.0 else compressed**fluid.index
    slope = fluid.exponent * fluid.index * power * (1.0 - 1.0 / compressed)
    return math.log(fluid.viscosity) + fluid.exponent * (power - 1.0), slope


@jit
def characteristic_stress(fluid, pressure):
    """Limiting or Eyring stress [Pa] at a pressure [Pa]; not used by a Newtonian film."""
    return fluid.characteristic * pressure if fluid.rheology == LIMITING_SHEAR else fluid.characteristic


@jit
def characteristic_slip(fluid, log_eta, pressure, film_thickness):
    """Slip [m/s] at which limited stress, or in a Newtonian film shear heating, begins to have an effect."""
    if fluid.rheology == NEWTONIAN:
        return math.exp(-0.5 * log_eta) / math.sqrt(max(fluid.heating, 1e-30))
    return film_thickness * characteristic_stress(fluid, pressure) * math.exp(-log_eta)


@jit
def chord_stress(fluid, pressure, film_thickness, slip):
    """Mean stress q along a chord by quadrature.

    Parameters
    ----------
    fluid : Fluid
    pressure : float
        Largest pressure on the chord p1 [Pa], > 0.
    film_thickness : float
        h [m].
    slip : float
        |Δu| [m/s].

    Returns
    -------
    float
        q [Pa].

    Notes
    -----
    Relative error of the 18 nodes below 1e-4 up to 2 GPa and 1e-3 up to 4 GPa with Roelands' viscosity; with Barus' and
    a limiting stress, 5e-4 up to 1 GPa and 1e-2 up to 2 GPa.

    Examples
    --------
    >>> full = Fluid(LIMITING_SHEAR, 0.54, 2.1, 1.0, 1e8, 0.04, 0.0)
    >>> round(chord_stress(full, 1e9, 5e-7, 1.0) / (0.04 * 1e9 * math.pi / 4), 4)
    0.9999
    """
    viscosities, limits = along_chord(fluid, pressure)
    return stress_along(fluid, viscosities, limits, film_thickness, slip)


@jit
def along_chord(fluid, pressure):
    """Viscosity [Pa s] and limiting or Eyring stress [Pa] at the nodes of a chord whose largest pressure is given [Pa]."""
    viscosities, limits = np.empty(_COSINES.size), np.empty(_COSINES.size)
    for node in range(_COSINES.size):
        local = pressure * _COSINES[node]
        viscosities[node] = math.exp(log_viscosity(fluid, local)[0])
        limits[node] = characteristic_stress(fluid, local)
    return viscosities, limits


@jit
def stress_along(fluid, viscosities, limits, film_thickness, slip):
    """Mean stress q [Pa] of a chord whose nodes have these viscosities [Pa s] and limiting or Eyring stresses [Pa]."""
    total = 0.0
    rate, heat = slip / film_thickness, fluid.heating * film_thickness * slip
    for node in range(_COSINES.size):
        stress, _, _ = heated_shear(fluid.rheology, viscosities[node] * rate, limits[node], heat)
        total += WEIGHTS[node] * stress
    return total


__all__ = ["EYRING", "Fluid", "chord_stress", "log_viscosity"]
