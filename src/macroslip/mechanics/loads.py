"""Loads on a roller on its orbit, whatever its spin: load of the rings, body forces (18)-(26)."""

from __future__ import annotations

from typing import NamedTuple

from macroslip.compiled import jit_evaluation
from macroslip.mechanics.elastic import elastic_load
from macroslip.mechanics.film_sharing import film_load
from macroslip.mechanics.speeds import outer_ring_speed
from macroslip.ring.balance import radial_clearance


class OrbitLoads(NamedTuple):
    """Loads on a roller at one position and time."""

    #: Elastic approach δ of ring, roller and ring [m]; negative where there is play
    approach: float
    elastic_load: float  #: Load Q that the rings press on the roller [N]
    log_film_balance: float  #: Where the next search for the films' load begins [ln N]
    inner_load: float  #: Normal load of the inner raceway, with body forces and films [N]
    outer_load: float  #: Normal load of the outer raceway, with body forces and films [N]
    tangential: float  #: F_g,x' + F_d,x', along +x' [N]


@jit_evaluation
def elastic_approach(body, cosine, sine, now):
    """Elastic approach of a roller, δ = (dX cos φ + dY sin φ − c(φ)) cos α + s dZ sin α.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    cosine, sine : float
        Of the roller's orbital position φ [-].
    now : macroslip.ring.orbit.Instant
        The ring's motion.

    Returns
    -------
    float
        δ [m]; negative where there is play.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> from macroslip.ring.orbit import Instant
    >>> waves = dict.fromkeys(("second_x", "second_y", "third_x", "third_y"), 0.0)
    >>> body = SimpleNamespace(radial_play=1e-4, cos_contact_angle=0.98, sin_contact_angle=0.2, **waves)
    >>> round(elastic_approach(body, 0.0, -1.0, Instant(2.0, 0.0, 0.0, -2e-4, 1e-4)), 9)
    0.000118
    """
    radial = now.displacement_x * cosine + now.displacement_y * sine
    radial -= radial_clearance(body, cosine, sine)
    return radial * body.cos_contact_angle + now.displacement_z * body.sin_contact_angle


@jit_evaluation
def normal_body_force(body, sine, orbital_speed):
    """Weight (18)-(20) and centrifugal force (21)-(23) of a roller along the contact normal.

    Weight has the parts −m g cos(tilt) along Y0 and +m g sin(tilt) along Z0. Both forces are summed
    first; a sum that points outward loads the outer raceway, inward the inner one. A roller with play can lean on only one ring, so that the sum and not each force for
    itself is what a raceway feels.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    sine : float
        sin φ of the orbital position [-].
    orbital_speed : float
        Ω [rad/s].

    Returns
    -------
    float
        Sum of both forces [N], positive outward.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> body = SimpleNamespace(
    ...     centrifugal=1.2, weight_in_plane=30.0, weight_along_axis=0.0, cos_contact_angle=1.0, sin_contact_angle=0.0
    ... )
    >>> normal_body_force(body, -1.0, 1.0)
    31.2
    """
    radial = body.centrifugal * orbital_speed * orbital_speed - body.weight_in_plane * sine
    return radial * body.cos_contact_angle + body.weight_along_axis * body.sin_contact_angle


@jit_evaluation
def drag_force(coefficient, orbital_speed):
    """Drag of the lubricant on a roller (24)-(26), F_d,x' = ½ C_D ρ f A (Ω r~)² [N].

    Parameters
    ----------
    coefficient : float
        ½ C_D ρ f A r~² [N s²], `drag` of `macroslip.roller.model.RollerModel`.
    orbital_speed : float or ndarray
        Ω [rad/s].

    Returns
    -------
    float or ndarray
        F_d,x' along +x' [N], positive against a positive orbit.

    Examples
    --------
    >>> drag_force(2.0, -0.5)
    -0.5
    """
    return coefficient * orbital_speed * abs(orbital_speed)


def drag_power(coefficient, pitch_radius, orbital_speed):
    """Power that the drag (24)-(26) takes from a roller, F_d,x' r~ Ω [W].

    Parameters
    ----------
    coefficient : float
        ½ C_D ρ f A r~² [N s²].
    pitch_radius : float
        r~ [m].
    orbital_speed : float or ndarray
        Ω [rad/s].

    Returns
    -------
    float or ndarray
        Power [W], ≥ 0 in either direction of the orbit.

    Examples
    --------
    >>> drag_power(2.0, 0.4, -0.5)
    0.1
    """
    return drag_force(coefficient, orbital_speed) * pitch_radius * orbital_speed


@jit_evaluation
def tangential_body_force(body, cosine, orbital_speed):
    """Weight F_g,x' (18)-(20) and drag F_d,x' (24)-(26) of a roller along +x' [N].

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    cosine : float
        cos φ of the orbital position [-].
    orbital_speed : float
        Ω [rad/s].

    Returns
    -------
    float
        G = F_g,x' + F_d,x' [N], positive against a positive orbit.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> tangential_body_force(SimpleNamespace(weight_in_plane=30.0, drag=3.0), 1.0, -1.0)
    27.0
    """
    return body.weight_in_plane * cosine + drag_force(body.drag, orbital_speed)


@jit_evaluation
def orbit_loads(body, tables, cosine, sine, now, orbital_speed, log_balance):
    """Loads on a roller at the orbital position cos φ, sin φ.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    tables : int
        Address of the flat array of tables.
    cosine, sine : float
        Of the roller's orbital position φ [-].
    now : macroslip.ring.orbit.Instant
        The ring's motion.
    orbital_speed : float
        Ω [rad/s].
    log_balance : float
        Where the search for the films' load begins [ln N], such as the `log_film_balance` of a
        moment before.

    Returns
    -------
    OrbitLoads
    """
    approach = elastic_approach(body, cosine, sine, now)
    pressed = elastic_load(body, approach)
    outward = normal_body_force(body, sine, orbital_speed)
    ring_speed = outer_ring_speed(orbital_speed, body.outer_radius)
    films = film_load(body, tables, pressed, approach, outward, ring_speed, log_balance)
    return OrbitLoads(
        approach,
        pressed,
        films.log_balance,
        pressed + films.load - min(outward, 0.0),
        pressed + films.load + max(outward, 0.0),
        tangential_body_force(body, cosine, orbital_speed),
    )
