"""Mass and moments of inertia of a roller, taken as a cylinder.

Equation (13) of Hart et al., "Dynamic modelling of slip in a wind turbine spherical roller main bearing". The barrel
shape and end recesses are neglected, so mass and inertia are slightly too large.
"""

from __future__ import annotations

import math


def roller_mass(density: float, roller_radius: float, roller_length: float) -> float:
    """Mass of a roller, m = rho pi r^2 l.

    Parameters
    ----------
    density : float
        Density [kg/m3], positive.
    roller_radius : float
        Roller radius [m], positive.
    roller_length : float
        Roller length [m], positive.

    Returns
    -------
    float
        Mass [kg].

    Examples
    --------
    >>> round(roller_mass(7850, 0.035, 0.106), 6)
    3.202296
    """
    return density * math.pi * roller_radius**2 * roller_length


def spin_inertia(mass: float, roller_radius: float) -> float:
    """Moment of inertia about the roller's own axis, I_z' = m r^2/2, (13).

    Parameters
    ----------
    mass : float
        Mass of the roller [kg], positive.
    roller_radius : float
        Roller radius [m], positive.

    Returns
    -------
    float
        Moment of inertia [kg m2].

    Examples
    --------
    >>> round(spin_inertia(3.2, 0.035), 9)
    0.00196
    """
    return mass * roller_radius**2 / 2
