"""Forces on one roller: what its place on the orbit gives it, and what its slip adds.

Signs follow the roller frame: x tangential, against a positive orbit; a tangential force that drives the spin ω up is
positive in the spin equation. Δu = u2 − u1 at every interface (28)-(31).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit, jit_inline
from macroslip.film.law import film_thickness
from macroslip.traction.law import patch_traction

#: Entrainment speed below which the film formula is not followed further [m/s].
LOWEST_ENTRAINMENT_SPEED = 1e-6


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
        Normal loads with body forces [N].
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
        F_i, F_o, F_c [N], positive where they drive the spin ω up.
    slope : float
        d(F_i + F_o + F_c)/dv [N s/m].
    inner_slope, outer_slope : float
        dF_i/dv and dF_o/dv [N s/m].
    cage_load : float
        F_n,cage with its sign [N]: positive where the cage pushes the roller along +φ.
    """

    inner: float
    outer: float
    cage: float
    slope: float
    inner_slope: float
    outer_slope: float
    cage_load: float


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
    return Station(
        -orbital_speed * model.outer_radius,
        approach,
        load,
        load - outward if outward < 0.0 else load,
        load + outward if outward > 0.0 else load,
        model.weight_in_plane * cosine + model.drag * orbital_speed * abs(orbital_speed),
    )


@jit_inline
def contact_force(contact, load, slip, entrainment_speed, entrainment_slope):
    """Traction of one contact, and its derivatives by slip (with the film's change) and by load.

    Parameters
    ----------
    contact : Contact
    load : float
        Normal load [N]; a contact without load has no traction.
    slip : float
        Δu [m/s].
    entrainment_speed : float
        u_e [m/s], floored at `LOWEST_ENTRAINMENT_SPEED`.
    entrainment_slope : float
        du_e/dΔu [-].

    Returns
    -------
    tuple of float
        F [N], dF/dΔu [N s/m], ∂F/∂Q [-].
    """
    if load <= 0.0:
        return 0.0, 0.0, 0.0
    if entrainment_speed < LOWEST_ENTRAINMENT_SPEED:
        entrainment_speed = LOWEST_ENTRAINMENT_SPEED
        entrainment_slope = 0.0
    film, film_by_speed, film_by_load = film_thickness(contact.film, load, entrainment_speed)
    force, by_slip, by_film, by_load = patch_traction(contact.traction, load, film, slip)
    return force, by_slip + by_film * film_by_speed * entrainment_slope, by_load + by_film * film_by_load


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
    force balances everything tangential (32): F_n,cage = |F_g,x' + F_d,x' + F_i − F_o|.
    """
    surface_speed = at.ring_speed - slip
    mean_speed = at.ring_speed - 0.5 * slip
    mean_slope = -0.5 if mean_speed >= 0.0 else 0.5
    inner, inner_slope, _ = contact_force(model.inner, at.inner_load, slip, abs(mean_speed), mean_slope)
    outer, outer_slope, _ = contact_force(model.outer, at.outer_load, slip, abs(mean_speed), mean_slope)
    cage_load = at.tangential + inner - outer
    cage_slope = -0.5 if surface_speed >= 0.0 else 0.5
    cage, by_slip, by_load = contact_force(
        model.cage, abs(cage_load), -surface_speed, 0.5 * abs(surface_speed), cage_slope
    )
    if cage_load < 0.0:
        by_load = -by_load
    slope = inner_slope + outer_slope + by_slip + by_load * (inner_slope - outer_slope)
    return SlipForces(inner, outer, cage, slope, inner_slope, outer_slope, cage_load)


@jit_inline
def shifted(forces, change):
    """The forces after a small change of slip [m/s], to first order."""
    inner = forces.inner_slope * change
    outer = forces.outer_slope * change
    return SlipForces(
        forces.inner + inner,
        forces.outer + outer,
        forces.cage + forces.slope * change - inner - outer,
        forces.slope,
        forces.inner_slope,
        forces.outer_slope,
        forces.cage_load + inner - outer,
    )
