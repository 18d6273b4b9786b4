"""Forces of a raceway contact: traction, the film beside the ellipse, and rolling resistance."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from macroslip.compiled import jit_evaluation
from macroslip.contact.look_up import (
    NO_CELL,
    NO_PLANE,
    ContactLoad,
    Traction,
    TractionCell,
    in_plane,
    traction,
    traction_cell,
)
from macroslip.mechanics.power import rolling_power
from macroslip.mechanics.speeds import LOWEST_SPEED
from macroslip.mechanics.traction import uniform_traction


class RacewayForces(NamedTuple):
    """Forces of a raceway contact on the roller, with slopes by slip Δu, ring speed u2 and load Q.

    S is the shear of rolling resistance, P the pull.
    """

    #: F in the spin equation (16), a moment about the roller's axis over r, without S [N]
    friction: float
    pull: float  #: Force P on the roller's centre, along the friction [N]
    shear: float  #: Rolling resistance S in the spin equation (16) [N]
    friction_by_slip: float  #: ∂F/∂Δu [N s/m]
    pull_by_slip: float  #: ∂P/∂Δu [N s/m]
    shear_by_slip: float  #: ∂S/∂Δu [N s/m]
    friction_by_speed: float  #: ∂F/∂u2 [N s/m]
    pull_by_speed: float  #: ∂P/∂u2 [N s/m]
    shear_by_speed: float  #: ∂S/∂u2 [N s/m]
    friction_by_load: float  #: ∂F/∂Q [-]
    pull_by_load: float  #: ∂P/∂Q [-]
    shear_by_load: float  #: ∂S/∂Q [-]
    lag: float  #: ∫τ h/r dA, by which the moment over r falls short of the traction [N]
    skew: float  #: ∫τ ζ dA, moment about the contact normal [N m]
    asperity_power: float  #: Part of the frictional power that asperities dissipate [W]
    rolling_power: float  #: Power of rolling resistance [W]


NO_RACEWAY_FORCES = RacewayForces(
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
)
_NO_TRACTION = Traction(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class RacewayOil(NamedTuple):
    """Forces of the oil beside the traction, with slopes by slip Δu, ring speed u2 and load Q."""

    sliding: float  #: Shear F_s of the film outside the ellipse [N]
    shear: float  #: Rolling resistance S [N]
    sliding_by_slip: float  #: ∂F_s/∂Δu [N s/m]
    shear_by_slip: float  #: ∂S/∂Δu [N s/m]
    sliding_by_speed: float  #: ∂F_s/∂u2 [N s/m]
    shear_by_speed: float  #: ∂S/∂u2 [N s/m]
    sliding_by_load: float  #: ∂F_s/∂Q [-]
    shear_by_load: float  #: ∂S/∂Q [-]
    power: float  #: Power of rolling resistance [W]


_NO_OIL = RacewayOil(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class RacewayState(NamedTuple):
    """Load of a raceway contact, and its position in the tables."""

    load: ContactLoad  #: Normal load
    cell: TractionCell  #: Cell in the table of traction
    #: Film and share of asperities by `in_plane`, where the closed form of traction serves
    film: tuple[Any, Any, Any]


@jit_evaluation
def raceway_state(law, tables, closed_form, load, speeds):
    """Position of a raceway contact in its tables.

    It is looked up for both raceways before the forces of either, so that the processor works on
    both at once.

    Parameters
    ----------
    law : record of `macroslip.roller.model.CONTACT`
    tables : int
        Address of the flat array of tables.
    closed_form : int
        1 where slip is the same all over and the closed form of traction serves.
    load : macroslip.contact.look_up.ContactLoad
        Q ≥ 0.
    speeds : macroslip.contact.look_up.ContactSpeeds

    Returns
    -------
    RacewayState
    """
    if closed_form:
        film = in_plane(law.film, tables, load.logarithm, speeds.log_mean)
        return RacewayState(load, NO_CELL, film)
    return RacewayState(load, traction_cell(law.traction, load, speeds), NO_PLANE)


@jit_evaluation
def raceway_traction(law, tables, closed_form, state, speeds):
    """Traction of a raceway contact, from its table or by the closed form.

    Parameters
    ----------
    law : record of `macroslip.roller.model.CONTACT`
    tables : int
        Address of the flat array of tables.
    closed_form : int
        1 where slip is the same all over and the closed form serves.
    state : RacewayState
        Of a load > 0.
    speeds : macroslip.contact.look_up.ContactSpeeds

    Returns
    -------
    macroslip.contact.look_up.Traction
    """
    if closed_form:
        mean = speeds.mean
        uniform = uniform_traction(law, state.film, state.load, speeds.slip, abs(mean))
        by_speed = math.copysign(1.0, mean) * uniform.by_entrainment
        return Traction(
            uniform.force,
            0.0,
            0.0,
            uniform.asperity_power,
            uniform.by_slip - 0.5 * by_speed,
            0.0,
            by_speed,
            0.0,
            uniform.by_load,
            0.0,
        )
    if speeds.ring == 0.0 and speeds.slip == 0.0:
        # At rest nothing pulls, while tables end at a ring that creeps.
        return _NO_TRACTION
    return traction(law.traction, tables, state.load, speeds, state.cell)


class SpinTraction(NamedTuple):
    """Traction of a raceway contact in the spin equation (16), a moment about the axis over r."""

    force: float  #: F = ∫τ (1 − h/r) dA, with the sign of the slip [N]
    by_slip: float  #: ∂F/∂Δu [N s/m]
    by_speed: float  #: ∂F/∂u2 [N s/m]
    by_load: float  #: ∂F/∂Q [-]


@jit_evaluation
def spin_traction(film):
    """Traction of a raceway contact in the spin equation (16), F_i or F_o, with its slopes.

    Parameters
    ----------
    film : macroslip.contact.look_up.Traction
        Pull ∫τ dA and lag ∫τ h/r dA of the contact [N].

    Returns
    -------
    SpinTraction

    Examples
    --------
    >>> film = Traction(5.0, 1.0, 0.0, 0.0, 8.0, 2.0, 0.0, 0.0, 0.5, 0.25)
    >>> spin_traction(film)
    SpinTraction(force=4.0, by_slip=6.0, by_speed=0.0, by_load=0.25)
    """
    return SpinTraction(
        film.pull - film.lag,
        film.pull_by_slip - film.lag_by_slip,
        film.pull_by_speed - film.lag_by_speed,
        film.pull_by_load - film.lag_by_load,
    )


@jit_evaluation
def raceway_oil(law, tables, load, speeds):
    """Shear of the film outside the contact ellipse and rolling resistance of a raceway contact.

    Parameters
    ----------
    law : record of `macroslip.roller.model.CONTACT`
    tables : int
        Address of the flat array of tables.
    load : macroslip.contact.look_up.ContactLoad
    speeds : macroslip.contact.look_up.ContactSpeeds

    Returns
    -------
    RacewayOil
    """
    value, by_load, by_speed = in_plane(law.oil, tables, load.logarithm, speeds.log_mean)
    conductance = value[0]
    resistance = value[1]
    slip = speeds.slip
    mean = speeds.mean
    if abs(mean) < LOWEST_SPEED:
        # Near rest, resistance goes with speed.
        per_mean = math.copysign(1.0 / LOWEST_SPEED, mean)
        sign = mean / LOWEST_SPEED
        shear_by_speed = -resistance * abs(per_mean)
    else:
        per_mean = 1.0 / mean
        sign = math.copysign(1.0, mean)
        shear_by_speed = -by_speed[1] * abs(per_mean)
    shear = -resistance * sign
    sliding_by_speed = slip * by_speed[0] * per_mean
    per_load = 1.0 / load.load
    return RacewayOil(
        conductance * slip,
        shear,
        conductance - 0.5 * sliding_by_speed,
        -0.5 * shear_by_speed,
        sliding_by_speed,
        shear_by_speed,
        slip * by_load[0] * per_load,
        -sign * by_load[1] * per_load,
        rolling_power(shear, mean),
    )


@jit_evaluation
def raceway_forces(body, law, tables, state, speeds):
    """Forces of a loaded raceway contact on the roller.

    Beside its shear the inclined pressure of rolling resistance pushes the roller's centre
    (`push`).

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    law : record of `macroslip.roller.model.CONTACT`
        Of the raceway: `body.inner` or `body.outer`.
    tables : int
        Address of the flat array of tables.
    state : RacewayState
        Of a load > 0.
    speeds : macroslip.contact.look_up.ContactSpeeds
        u2 and Δu in the middle of the contact, by the speeds of the surfaces (28)-(31).

    Returns
    -------
    RacewayForces
    """
    film = raceway_traction(law, tables, body.closed_form, state, speeds)
    oil = _NO_OIL
    if body.oily:
        oil = raceway_oil(law, tables, state.load, speeds)
    turning = spin_traction(film)
    push = law.push
    return RacewayForces(
        turning.force + oil.sliding,
        film.pull + oil.sliding + push * oil.shear,
        oil.shear,
        turning.by_slip + oil.sliding_by_slip,
        film.pull_by_slip + oil.sliding_by_slip + push * oil.shear_by_slip,
        oil.shear_by_slip,
        turning.by_speed + oil.sliding_by_speed,
        film.pull_by_speed + oil.sliding_by_speed + push * oil.shear_by_speed,
        oil.shear_by_speed,
        turning.by_load + oil.sliding_by_load,
        film.pull_by_load + oil.sliding_by_load + push * oil.shear_by_load,
        oil.shear_by_load,
        film.lag,
        film.skew,
        film.asperity_power,
        oil.power,
    )
