"""Tangential forces of a roller on its imposed orbit, which change its spin (16).

The spin obeys I_z' dω/dt = r (F_i + F_o + F_c).
"""

from __future__ import annotations

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.contact.look_up import ContactLoad, contact_speeds, log_load, log_speed
from macroslip.elementary import cosine_and_sine, exponential
from macroslip.mechanics.cage import cage_forces, cage_load
from macroslip.mechanics.loads import orbit_loads
from macroslip.mechanics.power import cage_power, raceway_power, total_power
from macroslip.mechanics.raceway import NO_RACEWAY_FORCES, raceway_forces, raceway_state
from macroslip.mechanics.rib import NO_RIB_FORCES, rib_forces
from macroslip.mechanics.speeds import outer_ring_speed, surface_speed

#: Conditions of a roller at one position and time, whatever its spin: loads and speeds.
CONDITIONS = np.dtype(
    [
        # Speed of inner raceway (28) and outer raceway (29) past the roller's centre, which on an
        # imposed orbit are the same, u2 = −(Ω_in − Ω) r~_in = −Ω r~_out [m/s].
        ("ring_speed", "f8"),
        # Elastic approach δ of ring, roller and ring [m]; negative where there is play.
        ("approach", "f8"),
        ("elastic_load", "f8"),  # load Q that the rings press on the roller [N]
        ("inner_load", "f8"),  # normal load of the inner raceway, with body forces and films [N]
        ("outer_load", "f8"),  # normal load of the outer raceway, with body forces and films [N]
        ("tangential", "f8"),  # F_g,x' + F_d,x', along +x' [N]
        # Logarithm of the load at which films fill the space between the rings [ln N], where the
        # next search for the films' load begins.
        ("log_film_balance", "f8"),
        ("log_inner_load", "f8"),  # logarithm of the inner raceway's load [ln N]
        ("log_outer_load", "f8"),  # logarithm of the outer raceway's load [ln N]
        ("root_inner_load", "f8"),  # cube root of the inner raceway's load [N^(1/3)]
        ("root_outer_load", "f8"),  # cube root of the outer raceway's load [N^(1/3)]
    ]
)
#: Tangential forces on a roller at a given slip Δu, and their slopes by it. Those in the spin
#: equation (16) are moments over r, positive where they drive the spin ω up.
FORCES = np.dtype(
    [
        ("inner", "f8"),  # F_i in (16) [N]
        ("outer", "f8"),  # F_o in (16) [N]
        ("cage", "f8"),  # F_c in (16) [N]
        # Rolling resistance of all contacts and friction of a rib in the spin equation (16) [N].
        ("resistance", "f8"),
        ("slope", "f8"),  # d(F_i + F_o + F_c + resistance)/dΔu [N s/m]
        ("inner_slope", "f8"),  # dF_i/dΔu [N s/m]
        ("outer_slope", "f8"),  # dF_o/dΔu [N s/m]
        # F_n,cage (32) with its sign, positive where the cage pushes the roller along +φ [N].
        ("cage_load", "f8"),
        ("cage_load_slope", "f8"),  # dF_n,cage/dΔu [N s/m]
        ("lag", "f8", (2,)),  # ∫τ h/r dA of inner and outer raceway [N]
        ("skew", "f8", (2,)),  # skew moment ∫τ ζ dA of inner and outer raceway [N m]
        ("rolling", "f8", (3,)),  # power of rolling resistance by interface [W]
        ("rough", "f8", (3,)),  # power that asperities dissipate by interface [W]
        ("rib", "f8"),  # friction F_f of a tapered roller's rib [N]
        ("rib_by_slip", "f8"),  # dF_f/dΔu [N s/m]
        ("rib_correction", "f8"),  # correction of F_i (−) and F_o (+) by rib friction [N]
        ("rib_power", "f8"),  # power of the rib's friction [W]
        ("rib_rough", "f8"),  # part of that power that asperities dissipate [W]
    ]
)


@jit
def write_conditions(body, tables, start_angle, now, at):
    """Write the loads of a roller on its imposed orbit, and the speed of the rings past it.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    tables : int
        Address of the flat array of tables.
    start_angle : float
        Orbital position φ at the first sample [rad].
    now : macroslip.ring.orbit.Instant
        The ring's motion.
    at : record of `CONDITIONS`
        Is written; its film balance is where the search for the new one begins.
    """
    orbital_speed = body.orbit_ratio * now.shaft_speed
    angle = start_angle + body.orbit_ratio * now.shaft_angle
    cosine, sine = cosine_and_sine(angle)
    loads = orbit_loads(body, tables, cosine, sine, now, orbital_speed, at.log_film_balance)
    at.ring_speed = outer_ring_speed(orbital_speed, body.outer_radius)
    at.approach = loads.approach
    at.elastic_load = loads.elastic_load
    at.log_film_balance = loads.log_film_balance
    at.inner_load = loads.inner_load
    at.outer_load = loads.outer_load
    at.tangential = loads.tangential
    at.log_inner_load = log_load(loads.inner_load)
    at.log_outer_load = log_load(loads.outer_load)
    at.root_inner_load = exponential(at.log_inner_load * (1.0 / 3.0))
    at.root_outer_load = exponential(at.log_outer_load * (1.0 / 3.0))


@jit
def slip_forces(body, tables, at, slip, forces):
    """Write the forces of raceways and cage at a slip that both raceways have in common.

    The roller's surface speed is u1 = u2 − Δu (31). The cage is at rest in the orbiting frame, Δu_c
    = −u1, and its load (32) balances everything tangential, F_i and F_o with what rolling resistance
    does: its shear and the push of the inclined pressure. What the rib of a tapered
    roller does to the orbit the raceways hold, by slips of their own that an imposed orbit does not
    have: F_i and F_o are here those of the common slip, without `rib_correction`.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    tables : int
        Address of the flat array of tables.
    at : record of `CONDITIONS`
    slip : float
        Δu [m/s].
    forces : record of `FORCES`
        Is written.
    """
    ring_speed = at.ring_speed
    surface = surface_speed(ring_speed, slip)
    speeds = contact_speeds(ring_speed, slip, body.closed_form)
    log_surface = log_speed(surface)
    inner = NO_RACEWAY_FORCES
    outer = NO_RACEWAY_FORCES
    inner_load = ContactLoad(at.inner_load, at.log_inner_load, at.root_inner_load)
    outer_load = ContactLoad(at.outer_load, at.log_outer_load, at.root_outer_load)
    inner_state = raceway_state(body.inner, tables, body.closed_form, inner_load, speeds)
    outer_state = raceway_state(body.outer, tables, body.closed_form, outer_load, speeds)
    if at.inner_load > 0.0:
        inner = raceway_forces(body, body.inner, tables, inner_state, speeds)
    if at.outer_load > 0.0:
        outer = raceway_forces(body, body.outer, tables, outer_state, speeds)
    push = cage_load(at.tangential, inner.pull, outer.pull)
    push_by_slip = inner.pull_by_slip - outer.pull_by_slip
    if body.ribbed:
        push += _add_rib(
            body.rib, tables, at, slip, inner.friction_by_slip, outer.friction_by_slip, forces
        )
    cage = cage_forces(body, tables, abs(push), surface, log_surface)
    cage_by_push = cage.friction_by_load + cage.resistance_by_load
    cage_by_push = cage_by_push if push >= 0.0 else -cage_by_push
    forces.inner = inner.friction
    forces.outer = outer.friction
    forces.cage = cage.friction
    forces.resistance = inner.shear + outer.shear + cage.resistance
    if body.ribbed:
        forces.resistance += body.rib.arm * forces.rib
    forces.inner_slope = inner.friction_by_slip
    forces.outer_slope = outer.friction_by_slip
    slope = inner.friction_by_slip + outer.friction_by_slip
    slope += inner.shear_by_slip + outer.shear_by_slip
    slope += cage.friction_by_slip + cage.resistance_by_slip
    if body.ribbed:
        slope += body.rib.arm * forces.rib_by_slip
    forces.slope = slope + cage_by_push * push_by_slip
    forces.cage_load = push
    forces.cage_load_slope = push_by_slip
    forces.lag[0] = inner.lag
    forces.lag[1] = outer.lag
    forces.skew[0] = inner.skew
    forces.skew[1] = outer.skew
    forces.rolling[0] = inner.rolling_power
    forces.rolling[1] = outer.rolling_power
    forces.rolling[2] = cage.rolling_power
    forces.rough[0] = inner.asperity_power
    forces.rough[1] = outer.asperity_power
    forces.rough[2] = cage.asperity_power


@jit_inline
def _add_rib(law, tables, at, slip, near, far, forces):
    """Write the friction of the rib; returns the reduction of cage load by rib friction [N].

    The raceways pass e F_f on, at a common slip in the ratio of their slopes a and b, `near` and
    `far` [N s/m]. On an orbit of its own a gripped roller shares it evenly: no cage holds what is
    left, e F_f (a − b)/(a + b). It is a function of its own, which rollers without a rib never
    enter: copied into `slip_forces` its table look-up would slow them too.
    """
    rib = NO_RIB_FORCES
    if at.elastic_load > 0.0:
        rib = rib_forces(law, tables, at.elastic_load, at.ring_speed, slip)
    spared = 0.0
    if near > 0.0 and far > 0.0:
        spared = law.arm * rib.friction * (near - far) / (near + far)
    forces.rib = rib.friction
    forces.rib_by_slip = rib.by_slip
    forces.rib_correction = 0.5 * (law.pull * rib.friction - spared)
    forces.rib_power = rib.power
    forces.rib_rough = rib.asperity_power
    return spared


@jit_inline
def net_force(forces):
    """Force by which the spin changes (16), F_i + F_o + F_c with rolling resistance.

    Parameters
    ----------
    forces : record of `FORCES`

    Returns
    -------
    float
        I_z'/r dω/dt [N], positive where the spin ω grows.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> net_force(SimpleNamespace(inner=1.0, outer=-3.0, cage=0.5, resistance=-0.25))
    -1.75
    """
    return forces.inner + forces.outer + forces.cage + forces.resistance


@jit_inline
def magnitude(forces):
    """Sum of the magnitudes |F_i| + |F_o| + |F_c| and of rolling resistance.

    It is the scale of rounding in the net force.

    Parameters
    ----------
    forces : record of `FORCES`

    Returns
    -------
    float
        Sum [N].

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> magnitude(SimpleNamespace(inner=1.0, outer=-3.0, cage=0.5, resistance=-0.25))
    4.75
    """
    return abs(forces.inner) + abs(forces.outer) + abs(forces.cage) + abs(forces.resistance)


@jit
def powers(body, at, forces, slip, power):
    """Write the frictional power (33) at inner, outer and cage interface [W]; return the sum.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    at : record of `CONDITIONS`
    forces : record of `FORCES`
        Forces under these conditions and this slip.
    slip : float
        Δu at both raceways [m/s].
    power : ndarray, shape (3,)
        Is written: power at inner, outer and cage interface [W].

    Returns
    -------
    float
        Sum of the three [W].
    """
    ring_speed = at.ring_speed
    inner = raceway_power(body.inner, slip, ring_speed, forces.inner, forces.lag[0], forces.skew[0])
    outer = raceway_power(body.outer, slip, ring_speed, forces.outer, forces.lag[1], forces.skew[1])
    power[0] = total_power(inner)
    power[1] = total_power(outer)
    # A force that follows a last correction to first order may have passed zero.
    power[2] = abs(cage_power(forces.cage, -surface_speed(ring_speed, slip)))
    return power[0] + power[1] + power[2]
