"""Forces on one roller: those of its place on the orbit, and those of its slip.

Signs follow the roller frame: x tangential, against a positive orbit; a tangential force that drives the spin ω up is
positive in the spin equation. Δu = u2 − u1 at every interface (28)-(31).
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from macroslip.compiled import jit, jit_inline, jit_part
from macroslip.roller.cage_force import cage_force
from macroslip.roller.contact_force import raceway_force
from macroslip.roller.films import cage_film, raceway_film
from macroslip.roller.places import places_of, with_cage_load
from macroslip.roller.play import film_load

#: Raceways by number.
INNER, OUTER = 0, 1


class Station(NamedTuple):
    """What a roller meets at one place and time, whatever its spin.

    Attributes
    ----------
    ring_speed : float
        Speed of both raceway surfaces past the roller's centre, u2 = −Ω r~_out = −(Ω_in − Ω) r~_in [m/s].
    interference : float
        Elastic approach δ of ring, roller and ring [m]; negative where there is play.
    elastic_load : float
        Load Q that the rings press on the roller [N].
    inner_load, outer_load : float
        Normal loads with body forces [N], and those of films that share a roller's play.
    tangential : float
        F_g,x' + F_d,x' [N], along +x'.
    """

    ring_speed: float
    interference: float
    elastic_load: float
    inner_load: float
    outer_load: float
    tangential: float


class SlipForces(NamedTuple):
    """Tangential forces on a roller at a given slip.

    Attributes
    ----------
    inner, outer, cage : float
        F_i, F_o, F_c [N] in the spin equation, that is moments over r, positive where they drive the spin ω up.
    slope : float
        d(F_i + F_o + F_c + resistance)/dv [N s/m].
    inner_slope, outer_slope : float
        dF_i/dv and dF_o/dv [N s/m].
    cage_load : float
        F_n,cage with its sign [N]: positive where the cage pushes the roller along +φ.
    cage_load_slope : float
        dF_n,cage/dv [N s/m].
    resistance : float
        Rolling resistance of all three contacts in the spin equation [N]; its derivative is in `slope`.
    rolling_power : tuple of float
        Power of rolling resistance at inner, outer and cage interface [W].
    inner_detail, outer_detail, cage_detail : Detail or None
        What curved contacts add; None for plain ones.
    """

    inner: float
    outer: float
    cage: float
    slope: float
    inner_slope: float
    outer_slope: float
    cage_load: float
    cage_load_slope: float
    resistance: float
    rolling_power: tuple
    inner_detail: Any
    outer_detail: Any
    cage_detail: Any


@jit_inline
def interference(model, cosine, sine, now):
    """Approach δ = (dX cos φ + dY sin φ − P_d/2) cos α + s dZ sin α [m] of a roller at cos φ, sin φ."""
    radial = now.displacement_x * cosine + now.displacement_y * sine - model.radial_play
    return radial * model.cos_contact_angle + now.displacement_z * model.sin_contact_angle


@jit
def station(model, start_angle, now):
    """Loads on a roller and speed of the rings past it.

    Parameters
    ----------
    model : RollerModel
    start_angle : float
        Roller position φ at the first sample [rad].
    now : Instant
        The ring's motion.

    Returns
    -------
    Station

    Notes
    -----
    Weight has the parts −m g cos(tilt) along Y0 and +m g sin(tilt) along Z0. Its part along the contact normal and that
    of the centrifugal force (18) are summed; a sum that points outward loads the outer raceway, inward the inner one. A
    roller with play can lean on only one ring, so the sum and not each force for itself is what a raceway feels.
    """
    orbital_speed = model.orbit_ratio * now.shaft_speed
    angle = start_angle + model.orbit_ratio * now.shaft_angle
    cosine = math.cos(angle)
    sine = math.sin(angle)
    approach = interference(model, cosine, sine, now)
    load = model.stiffness * approach * math.sqrt(approach) if approach > 0.0 else 0.0
    squared = orbital_speed * orbital_speed
    outward = (model.centrifugal * squared - model.weight_in_plane * sine) * model.cos_contact_angle
    outward += model.weight_along_axis * model.sin_contact_angle
    ring_speed = -orbital_speed * model.outer_radius
    pressed = load + film_load(model.films, load, approach, outward, ring_speed)
    return Station(
        ring_speed,
        approach,
        load,
        pressed - outward if outward < 0.0 else pressed,
        pressed + outward if outward > 0.0 else pressed,
        model.weight_in_plane * cosine + model.drag * orbital_speed * abs(orbital_speed),
    )


@jit
def slip_forces(model, at, slip):
    """Traction at both raceways and at the cage for the raceway slip v = Δu_in = Δu_out.

    Parameters
    ----------
    model : RollerModel
    at : Station
    slip : float
        v [m/s].

    Returns
    -------
    SlipForces

    Notes
    -----
    The roller's surface speed is u1 = u2 − v. The cage is at rest in the orbiting frame, Δu_c = −u1, and its normal
    force balances everything tangential (32): F_n,cage = |F_g,x' + F_d,x' + F_i − F_o|, F_i and F_o with what rolling
    resistance does: its shear and the push of the inclined pressure.
    """
    surface_speed = at.ring_speed - slip
    mean_speed = at.ring_speed - 0.5 * slip
    mean_slope = -math.copysign(0.5, mean_speed)
    places = places_of(model, at, slip)
    inner = raceway_force(model.inner, at.inner_load, slip, at.ring_speed, abs(mean_speed), mean_slope, places.inner)
    outer = raceway_force(model.outer, at.outer_load, slip, at.ring_speed, abs(mean_speed), mean_slope, places.outer)
    inner_film = raceway_film(model.films, INNER, at.inner_load, slip, at.ring_speed, places.inner_film)
    outer_film = raceway_film(model.films, OUTER, at.outer_load, slip, at.ring_speed, places.outer_film)
    cage_load = at.tangential + inner.pull - outer.pull + (inner_film.pull - outer_film.pull)
    cage_load_slope = inner.pull_slope - outer.pull_slope + (inner_film.pull_slope - outer_film.pull_slope)
    cage_logs = with_cage_load(places, abs(cage_load))
    cage_slope = -math.copysign(0.5, surface_speed)
    cage, by_slip, by_load, cage_detail = cage_force(
        model.cage, abs(cage_load), -surface_speed, 0.5 * abs(surface_speed), cage_slope, cage_logs
    )
    cage_oil = cage_film(model.films, abs(cage_load), surface_speed, cage_logs)
    by_load = math.copysign(1.0, cage_load) * (by_load + cage_oil.by_load)
    inner_slope = inner.spin_slope + inner_film.sliding_slope
    outer_slope = outer.spin_slope + outer_film.sliding_slope
    slope = inner_slope + outer_slope + by_slip + by_load * cage_load_slope
    slope += inner_film.shear_slope + outer_film.shear_slope + cage_oil.slope
    return SlipForces(
        inner.spin + inner_film.sliding,
        outer.spin + outer_film.sliding,
        cage + cage_oil.sliding,
        slope,
        inner_slope,
        outer_slope,
        cage_load,
        cage_load_slope,
        inner_film.shear + outer_film.shear + cage_oil.shear,
        (inner_film.power, outer_film.power, cage_oil.power),
        inner.detail,
        outer.detail,
        cage_detail,
    )


@jit_part
def net_force(forces):
    """F_i + F_o + F_c with rolling resistance [N], which turns the spin by I_z' dω/dt = r (F_i + F_o + F_c) (16)."""
    return forces.inner + forces.outer + forces.cage + forces.resistance


@jit_part
def magnitude(forces):
    """|F_i| + |F_o| + |F_c| with rolling resistance [N], the scale of rounding in the net force."""
    return abs(forces.inner) + abs(forces.outer) + abs(forces.cage) + abs(forces.resistance)


@jit_inline
def shifted(forces, change):
    """The forces after a small change of slip [m/s], to first order.

    What the cage and rolling resistance change by is all given to the cage; the details are left as they are.
    """
    inner = forces.inner_slope * change
    outer = forces.outer_slope * change
    return SlipForces(
        forces.inner + inner,
        forces.outer + outer,
        forces.cage + forces.slope * change - inner - outer,
        forces.slope,
        forces.inner_slope,
        forces.outer_slope,
        forces.cage_load + forces.cage_load_slope * change,
        forces.cage_load_slope,
        forces.resistance,
        forces.rolling_power,
        forces.inner_detail,
        forces.outer_detail,
        forces.cage_detail,
    )
