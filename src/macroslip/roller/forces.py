"""Loads of a roller at its place on the orbit, and the forces of its slip, from tables or the paper's closed form.

Signs follow the roller frame: x tangential, against a positive orbit; a tangential force that drives the spin ω up is
positive in the spin equation. Δu = u2 − u1 at every interface (28)-(31).

Compiled functions get a roller as `body`, the record of its numbers (`macroslip.roller.model`), and `tables`, one flat array.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.contact.closed_form import patch_integral
from macroslip.contact.look_up import Traction, in_plane, log_load, log_speed, traction
from macroslip.ring.balance import radial_clearance

#: Entrainment speed below which film formulas are not followed further [m/s].
LOWEST_SPEED = 1e-6
#: Film of the volume flow over the smallest gap of a rigid contact (Martin).
FLOW = 1.2257
#: Part of the elastic load below which what films carry without play is left out: it would count for e^−30 of itself.
_FADED = 1.0 / 30.0
#: Bounds of ln q [ln N] and iterations of Newton's method for what films carry; it takes about four.
_LIGHTEST, _HEAVIEST, _ITERATIONS = math.log(1e-9), math.log(1e7), 60


#: Loads and speeds of a roller at one place and time, whatever its spin.
#:
#: ring_speed : speed of both raceway surfaces past the roller's centre, u2 = −Ω r~_out = −(Ω_in − Ω) r~_in [m/s]
#: interference : elastic approach δ of ring, roller and ring [m]; negative where there is play
#: elastic_load : load Q that the rings press on the roller [N]
#: inner_load, outer_load : normal loads with body forces, and those of films that share a roller's play [N]
#: tangential : F_g,x' + F_d,x', along +x' [N]
#: film_load : load of the films that share a roller's play [N], where the next search for it begins
STATION = np.dtype(
    [("ring_speed", "f8"), ("interference", "f8"), ("elastic_load", "f8"), ("inner_load", "f8"), ("outer_load", "f8"),
     ("tangential", "f8"), ("film_load", "f8")]
)  # fmt: skip
#: Tangential forces on a roller at a given slip.
#:
#: inner, outer, cage : F_i, F_o, F_c in the spin equation, that is moments over r, positive where they drive the spin ω up [N]
#: slope : d(F_i + F_o + F_c + resistance)/dv [N s/m]
#: inner_slope, outer_slope : dF_i/dv and dF_o/dv [N s/m]
#: cage_load, cage_load_slope : F_n,cage with its sign, positive where the cage pushes the roller along +φ [N], and its derivative by
#:     v [N s/m]
#: resistance : rolling resistance of all three contacts in the spin equation [N]; its derivative is in `slope`
#: rolling : power of rolling resistance by interface [W]
#: lag, skew : ∫τ h/r dA [N] and skew moment ∫τ ζ dA [N m] of the raceways
#: rough : power that asperities dissipate by interface [W]
FORCES = np.dtype(
    [
        *((name, "f8") for name in ("inner", "outer", "cage", "slope", "inner_slope", "outer_slope")),
        ("cage_load", "f8"), ("cage_load_slope", "f8"), ("resistance", "f8"),
        ("rolling", "f8", (3,)), ("lag", "f8", (2,)), ("skew", "f8", (2,)), ("rough", "f8", (3,)),
    ]
)  # fmt: skip


class Oil(NamedTuple):
    """Oil of a contact beside its traction: forces on the roller in the spin equation [N], and their derivatives."""

    #: Of the film outside the ellipse, and rolling resistance.
    sliding: float
    shear: float
    #: ∂/∂v at constant u2 and ∂/∂u2 at constant v [N s/m].
    sliding_by_slip: float
    shear_by_slip: float
    sliding_by_speed: float
    shear_by_speed: float
    #: ∂/∂Q [-].
    sliding_by_load: float
    shear_by_load: float
    power: float  #: Of rolling resistance [W]


class Cage(NamedTuple):
    """Contact with the cage: forces in the spin equation [N], derivatives by the roller's slip v [N s/m] and by load [-].

    `rolling` and `asperity_power` are powers [W].
    """

    friction: float
    resistance: float
    friction_by_slip: float
    resistance_by_slip: float
    friction_by_load: float
    resistance_by_load: float
    rolling: float
    asperity_power: float


@jit_inline
def interference(body, cosine, sine, now):
    """Approach δ = (dX cos φ + dY sin φ − c(φ)) cos α + s dZ sin α [m] of a roller at cos φ, sin φ."""
    radial = (
        now.displacement_x * cosine
        + now.displacement_y * sine
        - radial_clearance(body, cosine, sine)
    )
    return radial * body.cos_contact_angle + now.displacement_z * body.sin_contact_angle


@jit_inline
def _films_excess(body, tables, log_q, outward, play, log_u):
    """Ln of the films' height over the space they have, at a load q of the lighter one, and its derivative by ln q."""
    load = math.exp(log_q)
    inner_load = load - min(outward, 0.0)
    outer_load = load + max(outward, 0.0)
    inner, inner_slope, _ = in_plane(body.inner.oil, tables, math.log(inner_load), log_u)
    outer, outer_slope, _ = in_plane(body.outer.oil, tables, math.log(outer_load), log_u)
    one, other = math.exp(inner[2]), math.exp(outer[2])
    slope = (
        one * inner_slope[2] * load / inner_load + other * outer_slope[2] * load / outer_load
    ) / (one + other)
    approach = (load / body.stiffness) ** (2.0 / 3.0)
    space = play + approach
    return math.log((one + other) / (FLOW * space)), slope - (2.0 / 3.0) * approach / space


@jit
def carried(body, tables, play, outward, ring_speed, guess=0.0):
    """Load q [N] that the lighter of a roller's two raceway films carries.

    A roller with the play p lies between two films. With Q = q + |B| the load of the other, B the body force,

        [h(q) + h(q + |B|)]/1.2257 − (q/K)^(2/3) = p,

    h the film of the volume flow of a roller whose surface is at rest, u = u2/2. A roller without load turns slowly; one
    that grips has left its play, where q counts for little. The play p ≥ 0 and the body force B along the contact
    normal, positive outward, are in m and N, u2 in m/s. The search begins at `guess` [N], such as the load a moment
    before, or where that is 0, at 1 N.
    """
    speed = 0.5 * abs(ring_speed)
    log_u = math.log(max(speed, LOWEST_SPEED))
    low, high, place = _LIGHTEST - 1.0, _HEAVIEST, math.log(guess) if guess > 0.0 else 0.0
    for _ in range(_ITERATIONS):
        excess, slope = _films_excess(body, tables, place, outward, play, log_u)
        if excess > 0.0:
            low = place
        else:
            high = place
        step = -excess / slope if slope < 0.0 else math.inf
        following = place + step
        # A start at the root may leave the bounds by rounding.
        if abs(step) >= 1e-6 and not low < following < high:
            # Films that the play is too wide for carry nothing, which the lightest load shows at once.
            following = _LIGHTEST if low < _LIGHTEST and excess <= 0.0 else 0.5 * (low + high)
        change = abs(following - place)
        place = following
        # Newton's next change would be of the order of this one squared.
        if change < 1e-6:
            break
    # In proportion to speed where it vanishes.
    return math.exp(place) * min(1.0, speed / LOWEST_SPEED)


@jit
def is_faded(body, tables, load, outward, ring_speed):
    """Whether films carry nothing beside the elastic load [N] of a roller with a body force [N] at u2 [m/s]."""
    log_u = math.log(max(0.5 * abs(ring_speed), LOWEST_SPEED))
    return _films_excess(body, tables, math.log(_FADED * load), outward, 0.0, log_u)[0] <= 0.0


@jit_inline
def film_load(body, tables, load, approach, outward, ring_speed, guess=0.0):
    """Load [N] of the films on either raceway beside the elastic load [N] and the body force [N].

    As the play vanishes q rises to a load q0 that films carry without play; a roller that the rings press with Q_e has
    q0 exp(−Q_e/q0) of it left, so that loads are continuous.
    """
    if not body.oily:
        return 0.0
    if load <= 0.0:
        return carried(body, tables, -approach, outward, ring_speed, guess)
    if load >= body.faded_load:
        return 0.0
    most = carried(body, tables, 0.0, outward, ring_speed, guess)
    return most * math.exp(-load / most) if most > _FADED * load else 0.0


@jit
def station(body, tables, start_angle, now, found):
    """Write loads on a roller and speed of the rings past it.

    The roller is at φ = `start_angle` at the first sample [rad]; `now` is the ring's motion, `found` a record of
    `STATION`.

    Weight has the parts −m g cos(tilt) along Y0 and +m g sin(tilt) along Z0. Its part along the contact normal and that
    of the centrifugal force (18) are summed; a sum that points outward loads the outer raceway, inward the inner one. A
    roller with play can lean on only one ring, so the sum and not each force for itself is what a raceway feels.
    """
    orbital_speed = body.orbit_ratio * now.shaft_speed
    angle = start_angle + body.orbit_ratio * now.shaft_angle
    cosine, sine = math.cos(angle), math.sin(angle)
    approach = interference(body, cosine, sine, now)
    load = body.stiffness * approach * math.sqrt(approach) if approach > 0.0 else 0.0
    outward = (
        body.centrifugal * orbital_speed * orbital_speed - body.weight_in_plane * sine
    ) * body.cos_contact_angle
    outward += body.weight_along_axis * body.sin_contact_angle
    ring_speed = -orbital_speed * body.outer_radius
    found.film_load = film_load(body, tables, load, approach, outward, ring_speed, found.film_load)
    pressed = load + found.film_load
    found.ring_speed, found.interference, found.elastic_load = ring_speed, approach, load
    found.inner_load, found.outer_load = pressed - min(outward, 0.0), pressed + max(outward, 0.0)
    found.tangential = body.weight_in_plane * cosine + body.drag * orbital_speed * abs(
        orbital_speed
    )


@jit_inline
def _asperities(law, share, load, slip):
    """Friction of asperities with the same slip all over [N], and its derivatives by slip [N s/m] and by load [-]."""
    most = law.boundary_friction * share
    if abs(slip) < law.full_slip:
        return (
            most * load * slip / law.full_slip,
            most * load / law.full_slip,
            most * slip / law.full_slip,
        )
    return math.copysign(most * load, slip), 0.0, math.copysign(most, slip)


@jit_inline
def _closed_form(law, tables, load, ln_load, slip, entrainment_speed):
    """Traction by the paper's closed form where slip is the same all over.

    F [N], ∂F/∂v and ∂F/∂u_e [N s/m], ∂F/∂Q [-], and the power of asperities [W].
    """
    film, by_load, by_speed = in_plane(
        law.film, tables, ln_load, log_speed(max(entrainment_speed, LOWEST_SPEED))
    )
    share = max(film[1], 0.0)
    root = math.exp(ln_load * (1.0 / 3.0))
    exponent = law.pressure_exponent * root
    patch, by_log_slip, by_exponent = patch_integral(exponent, law.heating * abs(slip))
    viscous = law.conductance * root * root * math.exp(-film[0])
    force = viscous * patch * slip
    force_by_load = (
        2.0 / 3.0 - by_load[0]
    ) * force / load + viscous * slip * by_exponent * exponent / (3.0 * load)
    per_speed = 1.0 / entrainment_speed if entrainment_speed > LOWEST_SPEED else 0.0
    if share == 0.0:
        return (
            force,
            viscous * (patch + by_log_slip),
            -force * by_speed[0] * per_speed,
            force_by_load,
            0.0,
        )
    rough, rough_slope, rough_by_load = _asperities(law, share, load, slip)
    fluid, unlike = 1.0 - share, rough / share - force
    return (
        fluid * force + rough,
        fluid * viscous * (patch + by_log_slip) + rough_slope,
        (unlike * by_speed[1] - fluid * force * by_speed[0]) * per_speed,
        fluid * force_by_load + rough_by_load + unlike * by_load[1] / load,
        rough * slip,
    )


_NO_TRACTION = Traction(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@jit_inline
def raceway_traction(law, tables, closed_form, load, ln_load, ring_speed, slip):
    """Traction of a raceway contact with Q > 0 [N] at u2 and v [m/s]."""
    if not closed_form:
        if ring_speed == 0.0 and slip == 0.0:
            # At rest nothing pulls, while tables end at a ring that creeps.
            return _NO_TRACTION
        return traction(law.traction, tables, load, ln_load, ring_speed, slip)
    mean = ring_speed - 0.5 * slip
    force, by_slip, by_entrainment, by_load, rough = _closed_form(
        law, tables, load, ln_load, slip, abs(mean)
    )
    by_speed = math.copysign(1.0, mean) * by_entrainment
    return Traction(
        force, 0.0, 0.0, rough, by_slip - 0.5 * by_speed, 0.0, by_speed, 0.0, by_load, 0.0
    )


_NO_OIL = Oil(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@jit_inline
def raceway_oil(law, tables, load, ln_load, mean, ln_mean, slip):
    """Oil of a raceway contact with Q > 0 [N] at the mean speed u2 − v/2 and the slip v [m/s]."""
    value, by_load, by_speed = in_plane(law.oil, tables, ln_load, ln_mean)
    conductance, resistance = value[0], value[1]
    # Near rest, resistance goes with speed.
    slow = abs(mean) < LOWEST_SPEED
    per_mean = math.copysign(1.0 / LOWEST_SPEED, mean) if slow else 1.0 / mean
    shear = -resistance * mean / LOWEST_SPEED if slow else -math.copysign(resistance, mean)
    sliding_by_speed = slip * by_speed[0] * per_mean
    shear_by_speed = -(resistance if slow else by_speed[1]) * abs(per_mean)
    per_load = 1.0 / load
    return Oil(
        conductance * slip,
        shear,
        conductance - 0.5 * sliding_by_speed,
        -0.5 * shear_by_speed,
        sliding_by_speed,
        shear_by_speed,
        slip * by_load[0] * per_load,
        (shear / resistance * by_load[1] if resistance > 0.0 else 0.0) * per_load,
        -2.0 * shear * mean,
    )


@jit_inline
def cage_traction(body, tables, load, ln_load, surface_speed, ln_surface):
    """Traction of the cage's contact under a load > 0 [N], without the oil of the pocket.

    Gives the force in the spin equation [N], its derivatives by the roller's slip [N s/m] and by load [-], and the
    power of asperities [W].
    """
    law = body.cage
    # Slip at the cage is −u1, and v slows the roller's surface.
    if body.closed_form:
        entrainment = 0.5 * abs(surface_speed)
        force, slope, by_entrainment, by_load, rough = _closed_form(
            law, tables, load, ln_load, -surface_speed, entrainment
        )
        return force, slope - math.copysign(0.5, surface_speed) * by_entrainment, by_load, rough
    value, along_load, along_speed = in_plane(law.oil, tables, ln_load, ln_surface)
    return (
        -value[0] * surface_speed,
        value[0] + along_speed[0],
        -along_load[0] * surface_speed / load,
        # Where the share is zero its spline is not, by rounding.
        max(value[1], 0.0) * value[0] * surface_speed * surface_speed,
    )


@jit_inline
def cage_contact(body, tables, load, surface_speed, ln_surface):
    """Contact with the cage under |F_n,cage| [N], from the speed of the roller's surface u2 − v [m/s] and its logarithm."""
    law = body.cage
    if load <= 0.0 and not body.oily:
        return Cage(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    ln_load = log_load(load)
    friction, by_slip, by_load, rough = 0.0, 0.0, 0.0, 0.0
    if load > 0.0:
        friction, by_slip, by_load, rough = cage_traction(
            body, tables, load, ln_load, surface_speed, ln_surface
        )
    if not body.oily:
        return Cage(friction, 0.0, by_slip, 0.0, by_load, 0.0, 0.0, rough)
    value, along_load, along_speed = in_plane(law.oil, tables, ln_load, ln_surface)
    conductance, resistance = value[2], value[3]
    per_load = 1.0 / load if load > 0.0 else 0.0
    shear = -0.5 * resistance * surface_speed
    return Cage(
        friction - conductance * surface_speed,
        shear,
        by_slip + conductance + along_speed[2],
        0.5 * (resistance + along_speed[3]),
        by_load - surface_speed * along_load[2] * per_load,
        -0.5 * surface_speed * along_load[3] * per_load,
        -shear * surface_speed,
        rough,
    )


@jit
def slip_forces(body, tables, at, slip, found):
    """Write the forces of the raceways and the cage for the raceway slip v = Δu_in = Δu_out.

    The slip v is in m/s; `at` is a record of `STATION`, `found` one of `FORCES`.

    The roller's surface speed is u1 = u2 − v. The cage is at rest in the orbiting frame, Δu_c = −u1, and its normal
    force balances everything tangential (32): F_n,cage = |F_g,x' + F_d,x' + F_i − F_o|, F_i and F_o with what rolling
    resistance does: its shear and the push of the inclined pressure.
    """
    surface, mean = at.ring_speed - slip, at.ring_speed - 0.5 * slip
    ln_inner, ln_outer = log_load(at.inner_load), log_load(at.outer_load)
    inner, outer, inner_oil, outer_oil = _NO_TRACTION, _NO_TRACTION, _NO_OIL, _NO_OIL
    if at.inner_load > 0.0:
        inner = raceway_traction(
            body.inner, tables, body.closed_form, at.inner_load, ln_inner, at.ring_speed, slip
        )
    if at.outer_load > 0.0:
        outer = raceway_traction(
            body.outer, tables, body.closed_form, at.outer_load, ln_outer, at.ring_speed, slip
        )
    if body.oily:
        ln_mean = log_speed(mean)
        if at.inner_load > 0.0:
            inner_oil = raceway_oil(
                body.inner, tables, at.inner_load, ln_inner, mean, ln_mean, slip
            )
        if at.outer_load > 0.0:
            outer_oil = raceway_oil(
                body.outer, tables, at.outer_load, ln_outer, mean, ln_mean, slip
            )
    inner_pull = inner.pull + inner_oil.sliding + body.inner.push * inner_oil.shear
    outer_pull = outer.pull + outer_oil.sliding + body.outer.push * outer_oil.shear
    cage_load = at.tangential + inner_pull - outer_pull
    cage_load_slope = (
        inner.pull_by_slip + inner_oil.sliding_by_slip + body.inner.push * inner_oil.shear_by_slip
    )
    cage_load_slope -= (
        outer.pull_by_slip + outer_oil.sliding_by_slip + body.outer.push * outer_oil.shear_by_slip
    )
    cage = cage_contact(body, tables, abs(cage_load), surface, log_speed(surface))
    by_load = math.copysign(1.0, cage_load) * (cage.friction_by_load + cage.resistance_by_load)
    found.inner_slope = inner.pull_by_slip - inner.lag_by_slip + inner_oil.sliding_by_slip
    found.outer_slope = outer.pull_by_slip - outer.lag_by_slip + outer_oil.sliding_by_slip
    slope = (
        found.inner_slope + found.outer_slope + inner_oil.shear_by_slip + outer_oil.shear_by_slip
    )
    found.slope = (
        slope + cage.friction_by_slip + cage.resistance_by_slip + by_load * cage_load_slope
    )
    found.inner, found.outer = (
        inner.pull - inner.lag + inner_oil.sliding,
        outer.pull - outer.lag + outer_oil.sliding,
    )
    found.cage, found.cage_load, found.cage_load_slope = cage.friction, cage_load, cage_load_slope
    found.resistance = inner_oil.shear + outer_oil.shear + cage.resistance
    found.rolling[0], found.rolling[1], found.rolling[2] = (
        inner_oil.power,
        outer_oil.power,
        cage.rolling,
    )
    found.lag[0], found.lag[1], found.skew[0], found.skew[1] = (
        inner.lag,
        outer.lag,
        inner.skew,
        outer.skew,
    )
    found.rough[0], found.rough[1], found.rough[2] = (
        inner.asperity_power,
        outer.asperity_power,
        cage.asperity_power,
    )


@jit_inline
def net_force(forces):
    """F_i + F_o + F_c with rolling resistance [N], which turns the spin by I_z' dω/dt = r (F_i + F_o + F_c) (16)."""
    return forces.inner + forces.outer + forces.cage + forces.resistance


@jit_inline
def magnitude(forces):
    """|F_i| + |F_o| + |F_c| with rolling resistance [N], the scale of rounding in the net force."""
    return abs(forces.inner) + abs(forces.outer) + abs(forces.cage) + abs(forces.resistance)


@jit_inline
def raceway_power(law, microslip, slip, ring_speed, force, lag, skew):
    """Frictional power of a raceway contact (33) [W]: |F Δu|, with microslip ∫τ v dA = Δu F + u2 (curvature lag − spin skew)."""
    if not microslip:
        return abs(slip * force)
    return slip * force + ring_speed * (law.curvature * lag - law.spin * skew)


@jit
def powers(body, at, forces, slip, found):
    """Write the frictional power (33) at inner, outer and cage interface [W]; returns their sum."""
    ring = at.ring_speed
    found[0] = raceway_power(
        body.inner, body.microslip, slip, ring, forces.inner, forces.lag[0], forces.skew[0]
    )
    found[1] = raceway_power(
        body.outer, body.microslip, slip, ring, forces.outer, forces.lag[1], forces.skew[1]
    )
    found[2] = abs(forces.cage * (ring - slip))
    return found[0] + found[1] + found[2]
