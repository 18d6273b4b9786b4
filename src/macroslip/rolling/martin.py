"""Martin's solution of the rigid, isoviscous, flooded line contact: load, rolling resistance and shear over one film.

In x = √(2 R h0) t the gap is h0 (1 + t²). The pressure that vanishes far upstream and ends with zero slope at t_e is

    dp/dt = 12 η0 u √(2 R h0)/h0² (t² − t_e²)/(1 + t²)³,   ∫ (t² − t_e²)/(1 + t²)³ dt from −∞ to t_e = 0.

References
----------
Martin, Engineering (London) 102 (1916) 119. The coefficients are computed from the equation above.
"""

from __future__ import annotations

import math

from scipy.optimize import brentq

#: Place of the film's end x_e over √(2 R h0).
EXIT = 0.475129920093054
#: Load per length times h0 over η0 u R: h0 = 4.895 η0 u R/w. Rigid where M = W (2U)^(−½) is below about 0.3.
LOAD = 4.894968493913377
#: Rolling force of one surface per length over η0 u √(R/h0).
ROLLING_AT_GAP = 4.601076874757563
#: Rolling force of one surface per length, ½ ∫ h dp/dx dx, over √(η0 u w).
ROLLING = ROLLING_AT_GAP / math.sqrt(LOAD)
#: ∫dx/h over √(2 R/h0), from far upstream to the film's end: π/2 + atan(`EXIT`).
SHEAR = 0.5 * math.pi + math.atan(EXIT)
#: Film of the volume flow, which is the film where the pressure is highest, over h0.
FLOW = 1.0 + EXIT**2


def starved_martin(inlet: float) -> tuple[float, float, float]:
    """Load, rolling force and shear of a starved line contact over those of a flooded one with the same h0.

    The film begins with no pressure at t_i < 0, where the gap is S times the film of the volume flow, h0 (1 + t_e²); the
    pressure ends with zero slope at t_e, which follows from t_i by the equation above with t_i for −∞.

    Parameters
    ----------
    inlet : float
        S, > 1; infinite where flooded.

    Returns
    -------
    tuple of float
        Factors on Q, F_R and ∫dx/h at a given h0 [-], at most 1.

    Notes
    -----
    Resistance suffers first: at S = 10 it halves, while shear keeps 85 % and load 82 %.

    Examples
    --------
    >>> [round(factor, 3) for factor in starved_martin(10.0)]
    [0.815, 0.499, 0.852]
    """
    if math.isinf(inlet):
        return 1.0, 1.0, 1.0

    def squared(t: float) -> float:  # ∫ dt/(1 + t²)²
        return 0.5 * (t / (1.0 + t * t) + math.atan(t))

    def cubed(t: float) -> float:  # ∫ dt/(1 + t²)³
        return 0.25 * t / (1.0 + t * t) ** 2 + 0.75 * squared(t)

    def flow(start: float, end: float) -> float:
        return squared(end) - squared(start) - (1.0 + end * end) * (cubed(end) - cubed(start))

    def exit_of(start: float) -> float:
        return float(brentq(lambda end: flow(start, end), 1e-9 * -start, min(-start, 1.0), xtol=1e-15))

    def inlet_rest(t: float) -> float:
        return 1.0 + t * t - inlet * (1.0 + exit_of(-t) ** 2)

    start = -float(brentq(inlet_rest, 1e-3, 2.0 * math.sqrt(inlet), xtol=1e-13))
    end = exit_of(start)
    # −∫ t dp and ∫ (1 + t²) dp, dp = 1/(1 + t²)² − (1 + t_e²)/(1 + t²)³.
    ends = [-0.5 / (1.0 + t * t) + 0.25 * (1.0 + end * end) / (1.0 + t * t) ** 2 for t in (start, end)]
    load = -24.0 * (ends[1] - ends[0])
    rise = math.atan(end) - math.atan(start)
    rolling = 6.0 * math.sqrt(2.0) * (rise - (1.0 + end * end) * (squared(end) - squared(start)))
    return load / LOAD, rolling / ROLLING_AT_GAP, rise / SHEAR
