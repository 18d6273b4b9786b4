"""Loads of the rollers at one time, and their tractions, extrapolated between evaluations.

A contact is evaluated where it has to be; in between its force follows linearly from the slopes by
slip, load and ring speed. A gripped or a coasting roller then costs an evaluation now and then,
while one that enters or leaves the load zone is evaluated in every iteration.
"""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import address_of, call_at, jit, jit_inline
from macroslip.contact.look_up import contact_load, contact_speeds, log_speed
from macroslip.mechanics.cage import cage_forces
from macroslip.mechanics.loads import orbit_loads
from macroslip.mechanics.power import RacewayPower, raceway_power, rolling_power
from macroslip.mechanics.raceway import NO_RACEWAY_FORCES, raceway_forces, raceway_state
from macroslip.mechanics.speeds import centre_speed, inner_ring_speed, outer_ring_speed
from macroslip.roller.model import BODY, CONTACT
from macroslip.whole import tuning

#: Tractions of a raceway contact and their slopes, at the state in which they were evaluated.
LINEARISATION = np.dtype(
    [
        ("slip", "f8"),  # Δu of the evaluation [m/s]
        ("load", "f8"),  # normal load Q of the evaluation [N]
        ("speed", "f8"),  # ring speed u2 of the evaluation [m/s]
        ("turning", "f8"),  # force that turns the roller, S_i or S_o [N]
        ("pull", "f8"),  # force that moves the roller's centre, P_i or P_o [N]
        ("turning_by_slip", "f8"),  # ∂S/∂Δu [N s/m]
        ("pull_by_slip", "f8"),  # ∂P/∂Δu [N s/m]
        ("turning_by_load", "f8"),  # ∂S/∂Q [-]
        ("pull_by_load", "f8"),  # ∂P/∂Q [-]
        ("turning_by_speed", "f8"),  # ∂S/∂u2 [N s/m]
        ("pull_by_speed", "f8"),  # ∂P/∂u2 [N s/m]
        ("skew", "f8"),  # skew moment ∫τ ζ dA [N m]
        ("shear", "f8"),  # rolling resistance, which both forces hold [N]
        ("shear_by_slip", "f8"),  # slope of rolling resistance by slip [N s/m]
        ("shear_by_load", "f8"),  # slope of rolling resistance by load [-]
        ("shear_by_speed", "f8"),  # slope of rolling resistance by u2 [N s/m]
        ("rough", "f8"),  # frictional power of asperities [W]
    ]
)
#: Friction of the cage's contact and its slopes, at the state in which it was evaluated.
CAGE_LINEARISATION = np.dtype(
    [
        ("slip", "f8"),  # against the cage, of the evaluation [m/s]
        ("load", "f8"),  # |N| of the evaluation [N]; below 0 before the first
        ("force", "f8"),  # friction F_c, rolling resistance included [N]
        ("by_slip", "f8"),  # slope of F_c [N s/m]
        ("by_load", "f8"),  # slope of F_c [-]
        ("shear", "f8"),  # rolling resistance [N]
        ("shear_by_slip", "f8"),  # slope of rolling resistance by slip [N s/m]
        ("shear_by_load", "f8"),  # slope of rolling resistance by load [-]
        ("rough", "f8"),  # frictional power of asperities [W]
    ]
)
#: Tractions of a roller in its three contacts.
LINEARISATIONS = np.dtype(
    [
        ("inner", LINEARISATION),  # inner raceway
        ("outer", LINEARISATION),  # outer raceway
        ("cage", CAGE_LINEARISATION),  # cage
        ("when", "f8"),  # time of the last evaluation of the raceways [s]
    ]
)
#: Conditions of a roller of the whole bearing at one time: loads, speeds and forces.
COUPLED_CONDITIONS = np.dtype(
    [
        ("cosine", "f8"),  # cos θ of its pocket's angle [-]
        ("sine", "f8"),  # sin θ of its pocket's angle [-]
        ("inner_load", "f8"),  # normal load of the inner raceway, with body forces and films [N]
        ("outer_load", "f8"),  # normal load of the outer raceway, with body forces and films [N]
        ("elastic_load", "f8"),  # load of the rings alone [N]
        ("tangential", "f8"),  # G = F_g,x' + F_d,x', against the orbit [N]
        ("inner_speed", "f8"),  # speed u2 of the inner raceway past its centre [m/s]
        ("outer_speed", "f8"),  # speed u2 of the outer raceway past its centre [m/s]
        ("ring", "f8"),  # speed Ω_in r~_in of the inner ring's surface [m/s]
        ("log_film_balance", "f8"),  # where the next search for the films' load begins [ln N]
        ("turning_inner", "f8"),  # S_i [N]
        ("turning_outer", "f8"),  # S_o [N]
        ("pull_inner", "f8"),  # P_i [N]
        ("pull_outer", "f8"),  # P_o [N]
        ("friction", "f8"),  # F_c of its pocket [N]
        ("push", "f8"),  # N of its pocket, along the orbit [N]
        ("sliding", "f8"),  # slip against the cage [m/s]
        ("pocket_speed", "f8"),  # x', speed ahead in its pocket [m/s]
    ]
)


def new_linearisations(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Linearised tractions of a number of rollers, none evaluated yet.

    They are those of the step under way and those kept.

    The second array is the first one's numbers, shape (2, n, columns).
    """
    linearisations = np.zeros((2, count), LINEARISATIONS)
    linearisations["when"] = -np.inf
    linearisations["cage"]["load"] = -1.0
    return linearisations, linearisations.view(float).reshape(2, count, -1)


@jit_inline
def copy_linearisation(numbers, roller, source, target):
    """Copy the evaluated tractions of a roller from one set to the other.

    Number by number: where arrays are assigned, the compiler adds messages about their shapes,
    which take it as long as a fifth of the integration does.

    Parameters
    ----------
    numbers : ndarray, shape (2, n, columns)
        As `new_linearisations` gives them.
    roller : int
    source, target : int
        0 for the evaluations in use, 1 for those of accepted steps.
    """
    for column in range(numbers.shape[2]):
        numbers[target, roller, column] = numbers[source, roller, column]


@jit_inline
def address(assembly):
    """Address of the tables as the integer type that imposed orbits use.

    Look-ups are then compiled once for both.
    """
    return np.int64(assembly.tables.ctypes.data)


@jit_inline
def locate(assembly, now, which, rollers, cages, conditions, turn):
    """Write positions, loads and ring speeds of all rollers at a time.

    A pocket is at θ = θ_0 + nominal orbit + ∫w dt/r~, and its roller at
    φ = θ + (x − a sin θ + b cos θ)/r~. The difference is at most some milliradians, and enters the
    roller's load and weight to first order.

    Parameters
    ----------
    assembly : macroslip.whole.model.Assembly
    now : macroslip.ring.orbit.Instant
        Motion of the inner ring at that time.
    which : int
        Set of unknowns that counts: `STATE` to `LAST` of `macroslip.whole.stage`.
    rollers : ndarray of `macroslip.whole.stage.ROLLER`, shape (n,)
        Slips [m/s] and pocket offsets [m].
    cages : ndarray of `macroslip.whole.stage.CAGE`, shape (c,)
        Lags and displacements [m].
    conditions : ndarray of `COUPLED_CONDITIONS`, shape (n,)
        Filled with angles, loads [N] and speeds [m/s]; the search for the films' load begins with
        the `log_film_balance` there.
    turn : ndarray, shape (2,)
        Filled with the angles by which the cages' pockets have turned [rad].
    """
    bearing = assembly.bearing[0]
    bodies = assembly.bodies
    positions = assembly.positions
    tables = address(assembly)
    pitch = bearing.pitch_radius
    for c in range(bearing.cages):
        cage = cages[c].y[which]
        turn[c] = bearing.orbit_ratio * now.shaft_angle + cage[1] / pitch
        turn_cosine = math.cos(turn[c])
        turn_sine = math.sin(turn[c])
        a = cage[4]
        b = cage[5]
        for j in range(conditions.size):
            position = positions[j]
            at = conditions[j]
            if position.cage != c:
                continue
            body = bodies[position.row]
            own = rollers[j].y[which]
            cosine = position.cosine * turn_cosine - position.sine * turn_sine
            sine = position.sine * turn_cosine + position.cosine * turn_sine
            at.cosine = cosine
            at.sine = sine
            ahead = (own[2] - a * sine + b * cosine) / pitch
            half = 1.0 - 0.5 * ahead * ahead
            x = cosine * half - sine * ahead
            y = sine * half + cosine * ahead
            ring = now.shaft_speed * position.inner_radius
            orbit = centre_speed(own[0], own[1], ring) / pitch
            loads = orbit_loads(body, tables, x, y, now, orbit, at.log_film_balance)
            at.ring = ring
            at.log_film_balance = loads.log_film_balance
            at.elastic_load = loads.elastic_load
            at.inner_load = loads.inner_load
            at.outer_load = loads.outer_load
            at.tangential = loads.tangential
            at.inner_speed = inner_ring_speed(now.shaft_speed, orbit, position.inner_radius)
            at.outer_speed = outer_ring_speed(orbit, bearing.outer_radius)


@jit
def _evaluate_raceway(body, law, tables, load, speed, slip, linear):
    """Evaluate a raceway contact at its load [N], ring speed and slip [m/s] into its record."""
    forces = NO_RACEWAY_FORCES
    if load > 0.0:
        speeds = contact_speeds(speed, slip, body.closed_form)
        state = raceway_state(law, tables, body.closed_form, contact_load(load), speeds)
        forces = raceway_forces(body, law, tables, state, speeds)
    linear.slip = slip
    linear.load = load
    linear.speed = speed
    linear.turning = forces.friction + forces.shear
    linear.pull = forces.pull
    linear.shear = forces.shear
    linear.turning_by_slip = forces.friction_by_slip + forces.shear_by_slip
    linear.pull_by_slip = forces.pull_by_slip
    linear.shear_by_slip = forces.shear_by_slip
    linear.turning_by_load = forces.friction_by_load + forces.shear_by_load
    linear.pull_by_load = forces.pull_by_load
    linear.shear_by_load = forces.shear_by_load
    linear.turning_by_speed = forces.friction_by_speed + forces.shear_by_speed
    linear.pull_by_speed = forces.pull_by_speed
    linear.shear_by_speed = forces.shear_by_speed
    linear.skew = forces.skew
    linear.rough = forces.asperity_power


@jit
def _evaluate_cage(body, tables, load, sliding, linear):
    """Evaluate the cage's contact at its load [N] and slip against the cage [m/s]."""
    contact = cage_forces(body, tables, load, -sliding, log_speed(sliding))
    linear.force = contact.friction + contact.resistance
    linear.by_slip = contact.friction_by_slip + contact.resistance_by_slip
    linear.by_load = contact.friction_by_load + contact.resistance_by_load
    linear.shear = contact.resistance
    linear.shear_by_slip = contact.resistance_by_slip
    linear.shear_by_load = contact.resistance_by_load
    linear.rough = contact.asperity_power
    linear.slip = sliding
    linear.load = load


def addresses_of_evaluations() -> tuple[int, int]:
    """Addresses of the functions that evaluate a raceway's and a cage's contact."""
    raceway = address_of(_evaluate_raceway, BODY, CONTACT, int, float, float, float, LINEARISATION)
    return raceway, address_of(_evaluate_cage, BODY, int, float, float, CAGE_LINEARISATION)


@jit
def evaluate_marked(assembly, time, conditions, rollers, which, schedules, linearisations):
    """Evaluate the tractions of both raceway contacts of marked rollers.

    Parameters
    ----------
    assembly : macroslip.whole.model.Assembly
    time : float
        Time of the evaluation [s].
    conditions : ndarray of `COUPLED_CONDITIONS`, shape (n,)
        Loads [N] and ring speeds [m/s] at that time.
    rollers : ndarray of `macroslip.whole.stage.ROLLER`, shape (n,)
        Slips [m/s].
    which : int
        Set of unknowns that counts: `STATE` to `LAST` of `macroslip.whole.stage`.
    schedules : ndarray of `macroslip.whole.stage.SCHEDULE`, shape (n,)
        Rollers with `marked` are evaluated.
    linearisations : ndarray of `LINEARISATIONS`, shape (n,)
        Filled where a roller is evaluated.

    Returns
    -------
    int
        Evaluations of a raceway contact, two a marked roller.
    """
    bodies = assembly.bodies
    positions = assembly.positions
    tables = address(assembly)
    evaluations = 0
    for j in range(schedules.size):
        if schedules[j].marked:
            body = bodies[positions[j].row]
            at = conditions[j]
            linear = linearisations[j]
            own = rollers[j].y[which]
            call_at(  # pyright: ignore[reportCallIssue]
                assembly.evaluate_raceway,
                (body, body.inner, tables, at.inner_load, at.inner_speed, own[0], linear.inner),
            )
            call_at(  # pyright: ignore[reportCallIssue]
                assembly.evaluate_raceway,
                (body, body.outer, tables, at.outer_load, at.outer_speed, own[1], linear.outer),
            )
            linear.when = time
            evaluations += 2
    return evaluations


@jit_inline
def raceway_from(linear, load, speed, slip):
    """Tractions of a raceway contact, extrapolated linearly between evaluations.

    Parameters
    ----------
    linear : record of `LINEARISATION`
        Tractions and slopes at the last evaluation.
    load : float
        Normal load Q [N]; a contact with none or less transmits nothing.
    speed : float
        Ring speed u2 [m/s].
    slip : float
        Δu [m/s].

    Returns
    -------
    turning, pull : float
        Forces S and P that turn and move the roller [N].
    """
    if load <= 0.0:
        return 0.0, 0.0
    dv = slip - linear.slip
    dq = load - linear.load
    du = speed - linear.speed
    turning = (
        linear.turning
        + linear.turning_by_slip * dv
        + linear.turning_by_load * dq
        + linear.turning_by_speed * du
    )
    pull = (
        linear.pull
        + linear.pull_by_slip * dv
        + linear.pull_by_load * dq
        + linear.pull_by_speed * du
    )
    return turning, pull


@jit_inline
def shear_from(linear, load, speed, slip):
    """Rolling resistance of a raceway contact, extrapolated linearly between evaluations.

    Parameters
    ----------
    linear : record of `LINEARISATION`
        Tractions and slopes at the last evaluation.
    load : float
        Normal load Q [N]; a contact with none or less has no resistance.
    speed : float
        Ring speed u2 [m/s].
    slip : float
        Δu [m/s].

    Returns
    -------
    float
        Rolling resistance in S [N].
    """
    if load <= 0.0:
        return 0.0
    shear = linear.shear + linear.shear_by_slip * (slip - linear.slip)
    return (
        shear
        + linear.shear_by_load * (load - linear.load)
        + linear.shear_by_speed * (speed - linear.speed)
    )


@jit_inline
def _reaches(linear, load, speed, slip, slip_reach):
    """True if tractions may be extrapolated to another load [N], ring speed and slip [m/s].

    A contact at rest has no slopes.
    """
    if linear.slip == 0.0 and linear.speed == 0.0 and (slip != 0.0 or speed != 0.0):
        return False
    change = linear.pull_by_slip * (slip - linear.slip)
    return (
        abs(load - linear.load) <= tuning.LOAD_REACH * linear.load
        and abs(change) <= slip_reach * load
    )


@jit_inline
def is_out_of_reach(linear, at, slips, slip_reach):
    """True if load or slip has changed too much for tractions to be extrapolated.

    Parameters
    ----------
    linear : record of `LINEARISATIONS`
        Tractions and slopes at the last evaluation.
    at : record of `COUPLED_CONDITIONS`
        Loads [N] and ring speeds [m/s] now.
    slips : ndarray
        v_in and v_out now [m/s], as its first two numbers.
    slip_reach : float
        Largest change of a force by slip over its load [-].

    Returns
    -------
    bool
    """
    return not (
        _reaches(linear.inner, at.inner_load, at.inner_speed, slips[0], slip_reach)
        and _reaches(linear.outer, at.outer_load, at.outer_speed, slips[1], slip_reach)
    )


@jit_inline
def extrapolated_power(linear, law, turning, pull, shear, load, speed, slip):
    """Frictional power of a raceway contact, extrapolated between evaluations.

    The skew moment grows with load to the power 3/2, the power of asperities in proportion to it.

    Parameters
    ----------
    linear : record of `LINEARISATION`
        Tractions at the last evaluation.
    law : record of `macroslip.roller.model.CONTACT`
        Of the raceway.
    turning, pull, shear : float
        S, P and rolling resistance of the stage [N].
    load : float
        Normal load Q [N]; all powers of a contact without load are zero.
    speed, slip : float
        Ring speed u2 and Δu [m/s].

    Returns
    -------
    friction : macroslip.mechanics.power.RacewayPower
        By what makes the surfaces slide [W].
    rolling : float
        Power of rolling resistance [W].
    asperities : float
        Part of the frictional power that asperities dissipate [W].
    """
    if load <= 0.0 or linear.load <= 0.0:
        return RacewayPower(0.0, 0.0, 0.0), 0.0, 0.0
    growth = (load - linear.load) / linear.load
    lag = pull - turning + (1.0 - law.push) * shear
    skew = linear.skew * (1.0 + 1.5 * growth)
    return (
        raceway_power(law, slip, speed, turning - shear, lag, skew),
        rolling_power(shear, speed - 0.5 * slip),
        linear.rough * (1.0 + growth),
    )


@jit_inline
def cage_from(contact, linear, push, sliding, part):
    """Friction of the cage on a roller, extrapolated linearly or evaluated anew.

    The contact is the same in both rows. A pocket full of oil brakes its roller without load too.

    Parameters
    ----------
    contact : tuple
        Record of a roller, `macroslip.roller.model.BODY`, the address of the flat array of its
        tables, and the address `evaluate_cage` of `macroslip.whole.model.Assembly`.
    linear : record of `CAGE_LINEARISATION`
        The last evaluation, replaced by one at the present state where load or slip is out of
        reach.
    push : float
        N of the pocket on the roller, positive along the orbit [N].
    sliding : float
        Slip against the cage [m/s].
    part : float
        Relative change of load or slip beyond which the contact is evaluated again [-].

    Returns
    -------
    force : float
        F_c [N].
    by_sliding : float
        Its slope by the slip [N s/m].
    by_push : float
        Its slope by N [-].
    """
    body, tables, evaluate = contact
    load = abs(push)
    if not body.oily and load <= tuning.LIGHT:
        return 0.0, 0.0, 0.0
    if not (
        abs(load - linear.load) <= part * linear.load + tuning.LIGHT
        and abs(sliding - linear.slip) <= part * abs(linear.slip)
    ):
        call_at(evaluate, (body, tables, load, sliding, linear))  # pyright: ignore[reportCallIssue]
    force = (
        linear.force
        + linear.by_slip * (sliding - linear.slip)
        + linear.by_load * (load - linear.load)
    )
    return force, linear.by_slip, linear.by_load if push > 0.0 else -linear.by_load


@jit_inline
def cage_shear_from(linear, push, sliding):
    """Rolling resistance of the cage's contact, extrapolated linearly [N]."""
    return (
        linear.shear
        + linear.shear_by_slip * (sliding - linear.slip)
        + linear.shear_by_load * (abs(push) - linear.load)
    )
