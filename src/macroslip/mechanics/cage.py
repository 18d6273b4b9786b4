"""The contact of a roller with the cage: its load (32), its friction, and what guides the cage."""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit_evaluation, jit_inline
from macroslip.contact.look_up import contact_load, in_plane, log_load
from macroslip.mechanics.power import rolling_power
from macroslip.mechanics.traction import uniform_traction


class CageFriction(NamedTuple):
    """Friction of the cage's contact without the oil of its pocket."""

    force: float  #: Friction in the spin equation (16) [N]
    by_slip: float  #: Slope by the roller's slip Δu [N s/m]
    by_load: float  #: Slope by load [-]
    asperity_power: float  #: Part of the frictional power that asperities dissipate [W]


class CageForces(NamedTuple):
    """Forces of the cage's contact in the spin equation (16), with their slopes."""

    friction: float  #: F_c [N]
    resistance: float  #: Rolling resistance [N]
    friction_by_slip: float  #: ∂F_c/∂Δu [N s/m]
    resistance_by_slip: float  #: Slope of rolling resistance by Δu [N s/m]
    friction_by_load: float  #: ∂F_c/∂F_n,cage [-]
    resistance_by_load: float  #: Slope of rolling resistance by F_n,cage [-]
    rolling_power: float  #: Power of rolling resistance [W]
    asperity_power: float  #: Part of the frictional power that asperities dissipate [W]


NO_CAGE_FORCES = CageForces(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@jit_evaluation
def cage_load(tangential, inner_pull, outer_pull):
    """Normal load of the cage on an imposed orbit (32), F_n,cage = F_g,x' + F_d,x' + F_i − F_o.

    Parameters
    ----------
    tangential : float
        F_g,x' + F_d,x', against a positive orbit [N].
    inner_pull, outer_pull : float
        Pulls of the raceways on the roller's centre [N], which are F_i and F_o without rolling
        resistance and microslip.

    Returns
    -------
    float
        F_n,cage [N], positive where the cage pushes the roller along the orbit.

    Examples
    --------
    >>> cage_load(30.0, 5.0, 2.0)
    33.0
    """
    return tangential + inner_pull - outer_pull


@jit_evaluation
def _closed_form_friction(law, tables, load, surface_speed, log_surface):
    """Friction of the contact by the paper's closed form."""
    # Slip at the cage is −u1, and the raceways' slip slows the roller's surface.
    entrainment = 0.5 * abs(surface_speed)
    log_entrainment = log_surface - math.log(2.0)
    film = in_plane(law.film, tables, load.logarithm, log_entrainment)
    uniform = uniform_traction(law, film, load, -surface_speed, entrainment)
    by_slip = uniform.by_slip - math.copysign(0.5, surface_speed) * uniform.by_entrainment
    return CageFriction(uniform.force, by_slip, uniform.by_load, uniform.asperity_power)


@jit_evaluation
def _tabulated_friction(value, by_load, by_speed, load, surface_speed):
    """Friction of the contact from its plane's values and slopes."""
    conductance = value[0]
    return CageFriction(
        -conductance * surface_speed,
        conductance + by_speed[0],
        -by_load[0] * surface_speed / load,
        # Where the share of asperities is zero its spline is not, by rounding.
        max(value[1], 0.0) * conductance * surface_speed * surface_speed,
    )


@jit_evaluation
def cage_friction(body, tables, load, surface_speed, log_surface):
    """Friction of the cage's contact under a load > 0, without the oil of the pocket.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    tables : int
        Address of the flat array of tables.
    load : float
        |F_n,cage| > 0 [N].
    surface_speed, log_surface : float
        Speed u1 = u2 − Δu of the roller's surface [m/s], and the logarithm of its magnitude.

    Returns
    -------
    CageFriction
    """
    law = body.cage
    if body.closed_form:
        return _closed_form_friction(law, tables, contact_load(load), surface_speed, log_surface)
    value, by_load, by_speed = in_plane(law.oil, tables, log_load(load), log_surface)
    return _tabulated_friction(value, by_load, by_speed, load, surface_speed)


@jit_evaluation
def cage_forces(body, tables, load, surface_speed, log_surface):
    """Friction and rolling resistance of the cage's contact, whose slip is Δu_c = −u1.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    tables : int
        Address of the flat array of tables.
    load : float
        |F_n,cage| [N]; a pocket full of oil brakes its roller without load too.
    surface_speed, log_surface : float
        Speed u1 = u2 − Δu of the roller's surface [m/s], and the logarithm of its magnitude.

    Returns
    -------
    CageForces
    """
    if not body.oily:
        if load <= 0.0:
            return NO_CAGE_FORCES
        dry = cage_friction(body, tables, load, surface_speed, log_surface)
        return CageForces(
            dry.force, 0.0, dry.by_slip, 0.0, dry.by_load, 0.0, 0.0, dry.asperity_power
        )
    law = body.cage
    value, by_load, by_speed = in_plane(law.oil, tables, log_load(load), log_surface)
    friction = CageFriction(0.0, 0.0, 0.0, 0.0)
    per_load = 0.0
    if load > 0.0:
        per_load = 1.0 / load
        if body.closed_form:
            friction = _closed_form_friction(
                law, tables, contact_load(load), surface_speed, log_surface
            )
        else:
            friction = _tabulated_friction(value, by_load, by_speed, load, surface_speed)
    pocket = value[2]
    resistance = value[3]
    shear = -0.5 * resistance * surface_speed
    return CageForces(
        friction.force - pocket * surface_speed,
        shear,
        friction.by_slip + pocket + by_speed[2],
        0.5 * (resistance + by_speed[3]),
        friction.by_load - surface_speed * by_load[2] * per_load,
        -0.5 * surface_speed * by_load[3] * per_load,
        rolling_power(shear, 0.5 * surface_speed),
        friction.asperity_power,
    )


#: Speed over which the friction of the cage's guide turns its sign [m/s].
GUIDE_SPEED = 1e-3


class CageGuide(NamedTuple):
    """Forces on a cage by what guides it, at the pitch radius; positive against its motion."""

    friction: float  #: Friction of the guide [N]
    drag: float  #: Shear of the oil film at a ring's land [N]
    land_speed: float  #: Speed of that land at the pitch radius [m/s]
    by_speed: float  #: Slope of both by the cage's speed [N s/m]


@jit_inline
def cage_guide(bearing, speed, shaft_speed):
    """Friction of a cage's guide, T_guide/r~, and drag of the ring's land that guides it.

    Dry friction has one size at all speeds but near standstill, where it goes with
    tanh(r~ Ω_c/`GUIDE_SPEED`); the drag is Petroff's, in proportion to the speed past the land.

    Parameters
    ----------
    bearing : record of `macroslip.whole.model.BEARING`
    speed : float
        r~ Ω_c of the cage [m/s].
    shaft_speed : float
        Ω_in [rad/s].

    Returns
    -------
    CageGuide

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> bearing = SimpleNamespace(guide_friction=5.0, land_drag=10.0, land_turns=0.0, pitch_radius=0.4)
    >>> cage_guide(bearing, 0.3, 2.0)
    CageGuide(friction=5.0, drag=3.0, land_speed=0.0, by_speed=10.0)
    """
    turned = math.tanh(speed / GUIDE_SPEED)
    land_speed = bearing.land_turns * shaft_speed * bearing.pitch_radius
    friction_slope = bearing.guide_friction * (1.0 - turned * turned) / GUIDE_SPEED
    return CageGuide(
        bearing.guide_friction * turned,
        bearing.land_drag * (speed - land_speed),
        land_speed,
        friction_slope + bearing.land_drag,
    )
