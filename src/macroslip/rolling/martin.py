"""Martin's solution of the rigid, isoviscous, flooded line contact: load, rolling resistance and shear over one film.

In x = √(2 R h0) t the gap is h0 (1 + t²). The pressure that vanishes far upstream and ends with zero slope at t_e is

    dp/dt = 12 η0 u √(2 R h0)/h0² (t² − t_e²)/(1 + t²)³,   ∫ (t² − t_e²)/(1 + t²)³ dt from −∞ to t_e = 0.
"""

from __future__ import annotations

import math

from macroslip.compiled import jit

#: Place of the film's end x_e over √(2 R h0).
EXIT = 0.475129920093054
#: Load per length times h0 over η0 u R.
LOAD = 4.894968493913377
#: Rolling force of one surface per length over η0 u √(R/h0).
ROLLING_AT_GAP = 4.601076874757563
#: Rolling force of one surface per length over √(η0 u w).
ROLLING = ROLLING_AT_GAP / math.sqrt(LOAD)
#: ∫dx/h over √(2 R/h0), from far upstream to the film's end: π/2 + atan(`EXIT`).
SHEAR = 0.5 * math.pi + math.atan(EXIT)
#: Film of the volume flow, which is the film where the pressure is highest, over h0.
FLOW = 1.0 + EXIT**2


@jit
def martin_film(load, viscosity, speed, radius):
    """Smallest film of a rigid, isoviscous line contact, h0 = 4.895 η0 u R/w.

    Parameters
    ----------
    load : float
        Load per length w [N/m], > 0.
    viscosity : float
        η0 [Pa s].
    speed : float
        Mean of the surface speeds u [m/s], ≥ 0.
    radius : float
        Relative radius of curvature R [m].

    Returns
    -------
    float
        h0 [m].

    Notes
    -----
    Flooded inlet; rigid where M = W (2U)^(−½) is below about 0.3.

    References
    ----------
    Martin, Engineering (London) 102 (1916) 119. The coefficient is computed from the equation above.

    Examples
    --------
    >>> round(martin_film(1000.0, 0.54, 0.4, 0.032) * 1e6, 3)
    33.834
    """
    return LOAD * viscosity * speed * radius / load


@jit
def martin_rolling_force(load, viscosity, speed):
    """Rolling resistance of each surface of a rigid, isoviscous line contact per length, F_R/l = 2.0796 √(η0 u w).

    Parameters
    ----------
    load : float
        Load per length w [N/m], ≥ 0.
    viscosity : float
        η0 [Pa s].
    speed : float
        Mean of the surface speeds u [m/s], ≥ 0.

    Returns
    -------
    float
        ½ ∫ h dp/dx dx [N/m] on each surface, against its motion.

    References
    ----------
    Martin, Engineering (London) 102 (1916) 119. The coefficient is computed from the equation above.

    Examples
    --------
    >>> round(martin_rolling_force(1000.0, 0.54, 0.4), 3)
    30.564
    """
    return ROLLING * math.sqrt(viscosity * speed * load)
