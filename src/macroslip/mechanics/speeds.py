"""Speeds of the surfaces in a roller's contacts, in the frame that orbits with it (28)-(31).

The spin that makes the roller's surface speed (31) is the one relative to that frame,
ω_rel = ω_z' − Ω cos α. The cage's spar is at rest in it. The speeds of an orbit follow from the
slips, v_in = r~ Ω − r ω − Ω_in r~_in and v_out = −r~ Ω − r ω with ω = ω_z' in the inertial frame.
"""

from __future__ import annotations

import math

from macroslip.compiled import jit_inline

#: Entrainment speed below which film formulas are not followed further [m/s].
LOWEST_SPEED = 1e-6


@jit_inline
def inner_ring_speed(shaft_speed, orbital_speed, inner_radius):
    """Speed of the inner raceway past the roller's centre (28), u2 = −(Ω_in − Ω) r~_in [m/s].

    Parameters
    ----------
    shaft_speed, orbital_speed : float
        Ω_in and Ω [rad/s].
    inner_radius : float
        r~_in [m].

    Returns
    -------
    float
        u2 [m/s]; negative where the ring turns ahead of the orbit.

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

    Returns
    -------
    float
        u2 [m/s]; negative on a positive orbit.

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

    Returns
    -------
    float
        u1 [m/s]; negative with the shaft forward.

    Examples
    --------
    >>> surface_speed(-0.5, -0.25)
    -0.25
    """
    return ring_speed - slip


@jit_inline
def signed_entrainment(ring_speed, slip):
    """Entrainment speed of a contact with its sign, u2 − Δu/2 = (u1 + u2)/2 [m/s].

    Parameters
    ----------
    ring_speed, slip : float
        u2 and Δu [m/s].

    Returns
    -------
    float
        Speed [m/s], its size not below `LOWEST_SPEED`.

    Examples
    --------
    >>> signed_entrainment(-0.5, 0.25), signed_entrainment(0.0, 0.0)
    (-0.625, 1e-06)
    """
    mean = ring_speed - 0.5 * slip
    return math.copysign(max(abs(mean), LOWEST_SPEED), mean)


@jit_inline
def centre_speed(inner_slip, outer_slip, ring_surface):
    """Speed of a roller's centre along its orbit, r~ Ω = (v_in − v_out + Ω_in r~_in)/2 [m/s].

    Parameters
    ----------
    inner_slip, outer_slip : float or ndarray
        v_in and v_out [m/s].
    ring_surface : float or ndarray
        Ω_in r~_in [m/s].

    Returns
    -------
    float or ndarray
        r~ Ω [m/s], positive along +φ.

    Examples
    --------
    >>> centre_speed(0.25, -0.25, 1.0)
    0.75
    """
    return 0.5 * (inner_slip - outer_slip + ring_surface)


@jit_inline
def spin_surface_speed(inner_slip, outer_slip, ring_surface):
    """Speed of a roller's surface by its spin, r ω_z' = −(v_in + v_out + Ω_in r~_in)/2 [m/s].

    Parameters
    ----------
    inner_slip, outer_slip : float or ndarray
        v_in and v_out [m/s].
    ring_surface : float or ndarray
        Ω_in r~_in [m/s].

    Returns
    -------
    float or ndarray
        r ω_z' in the inertial frame [m/s]; negative with the shaft forward.

    Examples
    --------
    >>> spin_surface_speed(0.25, -0.25, 1.0)
    -0.5
    """
    return -0.5 * (inner_slip + outer_slip + ring_surface)


@jit_inline
def cage_speed(lead, shaft_speed, inner_radius):
    """Speed of a cage at the pitch radius, r~ Ω_c = w + Ω_in r~_in/2 [m/s].

    Parameters
    ----------
    lead : float or ndarray
        Lead w of the cage over pure rolling [m/s].
    shaft_speed : float or ndarray
        Ω_in [rad/s].
    inner_radius : float
        r~_in [m].

    Returns
    -------
    float or ndarray
        r~ Ω_c [m/s], positive along +φ.

    Examples
    --------
    >>> cage_speed(-0.1, 2.0, 0.4)
    0.30000000000000004
    """
    return lead + 0.5 * shaft_speed * inner_radius
