"""Speed of a roller that rolls without slip, outer ring at rest.

The axis Z0 points downwind; a positive orbital speed is counter-clockwise about it, and the roller's spin about its own
axis (which also points downwind) is negative then. Both speeds follow from zero slip at both raceways in (28)-(31) of
Hart et al., "Dynamic modelling of slip in a wind turbine spherical roller main bearing". The spin is the one seen from
the frame that orbits with the roller; seen from the ground, orbital speed times cos(contact angle) comes on top.
"""

from __future__ import annotations


def orbital_speed(shaft_speed: float, inner_contact_radius: float, outer_contact_radius: float) -> float:
    """Orbital speed of a roller in pure rolling, Omega = Omega_in r~_in/(r~_in + r~_out).

    Parameters
    ----------
    shaft_speed : float
        Speed of the inner ring about Z0 [rad/s], any sign.
    inner_contact_radius : float
        Distance of the inner contact from the bearing axis [m], positive.
    outer_contact_radius : float
        Distance of the outer contact from the bearing axis [m], above the inner one.

    Returns
    -------
    float
        Speed of the roller's centre about Z0 [rad/s], with the sign of the shaft speed.

    Examples
    --------
    >>> round(orbital_speed(2.0, 0.3384, 0.4070), 6)
    0.907969
    """
    return shaft_speed * inner_contact_radius / (inner_contact_radius + outer_contact_radius)
