"""Speeds of the surfaces in a roller's contacts, in the frame that orbits with it (28)-(31).

The spin in (31) is the one relative to that frame, ω_rel = ω_z' − Ω cos α. The cage's spar is at
rest in it.
"""

from __future__ import annotations

from macroslip.compiled import jit_inline


@jit_inline
def inner_ring_speed(shaft_speed, orbital_speed, inner_radius):
    """Speed of the inner raceway past the roller's centre (28), u2 = −(Ω_in − Ω) r~_in [m/s].

    Parameters
    ----------
    shaft_speed, orbital_speed : float
        Ω_in and Ω [rad/s].
    inner_radius : float
        r~_in [m].

    Examples
    --------
    >>> inner_ring_speed(2.0, 0.75, 0.4)
    -0.5
    """
    return (orbital_speed - shaft_speed) * inner_radius


@jit_inline
def outer_ring_speed(orbital_speed, outer_radius):
    """Speed of the fixed outer raceway past the roller's centre (29), u2 = −Ω r~_out [m/s].

    Parameters
    ----------
    orbital_speed : float
        Ω [rad/s].
    outer_radius : float
        r~_out [m].

    Examples
    --------
    >>> outer_ring_speed(0.75, 0.4)
    -0.30000000000000004
    """
    return -orbital_speed * outer_radius


@jit_inline
def surface_speed(ring_speed, slip):
    """Speed of the roller's surface (31) past the cage's spar at rest (30) [m/s].

    It is u1 = ω_rel r = u2 − Δu. The slip at the cage is Δu_c = −u1.

    Parameters
    ----------
    ring_speed, slip : float
        u2 and Δu at a raceway [m/s].

    Examples
    --------
    >>> surface_speed(-0.5, -0.25)
    -0.25
    """
    return ring_speed - slip
