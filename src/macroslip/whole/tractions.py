"""Loads of the rollers at one time, and their tractions: each as its value, its slopes and the place they belong to.

A contact is evaluated where it has to be; in between its force follows from the slopes by slip, load and ring speed. A
gripped or a coasting roller then costs an evaluation now and then, while one that enters or leaves the load zone is
evaluated in every iteration.
"""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.contact.look_up import contact_load, log_speed
from macroslip.mechanics.cage import cage_forces
from macroslip.mechanics.loads import roller_loads
from macroslip.mechanics.raceway import NO_RACEWAY_FORCES, raceway_forces
from macroslip.mechanics.speeds import inner_ring_speed, outer_ring_speed
from macroslip.whole import tuning

#: Tractions of a raceway contact at the load [N], ring speed and slip [m/s] of their evaluation: forces that turn (`spin`) and
#: move the roller (`pull`) [N], with their slopes by slip, load and ring speed; the skew moment's power [W]; rolling resistance
#: (`shear`), which both forces hold, with its slopes; and the power of asperities [W].
SHEET = np.dtype(
    [
        (name, "f8")
        for name in (
            "slip", "load", "speed", "spin", "pull", "spin_by_slip", "pull_by_slip", "spin_by_load", "pull_by_load",
            "spin_by_speed", "pull_by_speed", "skew", "shear", "shear_by_slip", "shear_by_load", "shear_by_speed", "rough",
        )
    ]
)  # fmt: skip
#: The same of the cage's contact, at a load [N] and slip [m/s] of its own.
CAGE_SHEET = np.dtype(
    [
        (name, "f8")
        for name in (
            "slip", "load", "force", "by_slip", "by_load", "shear", "shear_by_slip", "shear_by_load", "rough",
        )
    ]
)  # fmt: skip
#: Of a roller: its three contacts, and when its raceways were evaluated [s].
SHEETS = np.dtype([("inner", SHEET), ("outer", SHEET), ("cage", CAGE_SHEET), ("when", "f8")])
#: A roller at one time.
#:
#: cosine, sine : of its pocket's angle
#: inner_load, outer_load, elastic_load : normal loads with body forces and films, and the rings' load alone [N]
#: tangential : G = F_g,x' + F_d,x' [N], against the orbit
#: inner_speed, outer_speed : speed u2 of the rings past its centre [m/s]
#: ring : speed Ω_in r~_in of the inner ring's surface [m/s]
#: film_load : what films carry beside the rings' load [N]
#: spin_inner … pull_outer : S_i, S_o, P_i, P_o [N]
#: friction, push : of its pocket, F_c and N [N]
#: sliding, pocket_speed : slip against the cage and x' [m/s]
MOMENT = np.dtype(
    [
        (name, "f8")
        for name in (
            "cosine", "sine", "inner_load", "outer_load", "elastic_load", "tangential", "inner_speed", "outer_speed", "ring",
            "film_load", "spin_inner", "spin_outer", "pull_inner", "pull_outer", "friction", "push", "sliding", "pocket_speed",
        )
    ]
)  # fmt: skip


def new_sheets(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Sheets of `count` rollers, none evaluated yet: those of the step under way and those kept, shape (2, n).

    The second array is the first one's numbers, shape (2, n, columns).
    """
    sheets = np.zeros((2, count), SHEETS)
    sheets["when"] = -np.inf
    sheets["cage"]["load"] = -1.0
    return sheets, sheets.view(float).reshape(2, count, -1)


@jit_inline
def address(assembly):
    """Address of the tables, of the type that it has on an imposed orbit: look-ups are then compiled once for both."""
    return np.int64(assembly.tables.ctypes.data)


@jit_inline
def locate(assembly, now, which, rollers, cages, moments, turn):
    """Place all rollers at a time and in the set `which` of unknowns; `turn` is filled with the cages' angles [rad].

    A pocket is at θ = θ_0 + nominal orbit + ∫w dt/r~, and its roller at φ = θ + (x − a sin θ + b cos θ)/r~. The
    difference is at most some milliradians, and enters the roller's load and weight to first order.
    """
    bearing = assembly.bearing[0]
    bodies = assembly.bodies
    places = assembly.places
    tables = address(assembly)
    pitch = bearing.pitch_radius
    for c in range(bearing.cages):
        cage = cages[c].y[which]
        turn[c] = bearing.orbit_ratio * now.shaft_angle + cage[1] / pitch
        turn_cosine, turn_sine = math.cos(turn[c]), math.sin(turn[c])
        a = cage[4]
        b = cage[5]
        for j in range(moments.size):
            place = places[j]
            at = moments[j]
            if place.cage != c:
                continue
            body = bodies[place.row]
            own = rollers[j].y[which]
            cosine = place.cosine * turn_cosine - place.sine * turn_sine
            sine = place.sine * turn_cosine + place.cosine * turn_sine
            at.cosine, at.sine = cosine, sine
            ahead = (own[2] - a * sine + b * cosine) / pitch
            half = 1.0 - 0.5 * ahead * ahead
            x, y = cosine * half - sine * ahead, sine * half + cosine * ahead
            ring = now.shaft_speed * place.inner_radius
            orbit = 0.5 * (own[0] - own[1] + ring) / pitch
            loads = roller_loads(body, tables, x, y, now, orbit, at.film_load)
            at.ring = ring
            at.film_load = loads.film_load
            at.elastic_load = loads.elastic_load
            at.inner_load = loads.inner_load
            at.outer_load = loads.outer_load
            at.tangential = loads.tangential
            at.inner_speed = inner_ring_speed(now.shaft_speed, orbit, place.inner_radius)
            at.outer_speed = outer_ring_speed(orbit, bearing.outer_radius)


@jit
def _evaluate(body, law, tables, load, speed, slip, sheet):
    """Evaluate a raceway contact at its load [N], ring speed and slip [m/s] into its sheet."""
    forces = NO_RACEWAY_FORCES
    if load > 0.0:
        log_mean = log_speed(speed - 0.5 * slip)
        forces = raceway_forces(body, law, tables, contact_load(load), speed, slip, log_mean)
    sheet.slip = slip
    sheet.load = load
    sheet.speed = speed
    sheet.spin = forces.friction + forces.shear
    sheet.pull = forces.pull
    sheet.shear = forces.shear
    sheet.spin_by_slip = forces.friction_by_slip + forces.shear_by_slip
    sheet.pull_by_slip = forces.pull_by_slip
    sheet.shear_by_slip = forces.shear_by_slip
    sheet.spin_by_load = forces.friction_by_load + forces.shear_by_load
    sheet.pull_by_load = forces.pull_by_load
    sheet.shear_by_load = forces.shear_by_load
    sheet.spin_by_speed = forces.friction_by_speed + forces.shear_by_speed
    sheet.pull_by_speed = forces.pull_by_speed
    sheet.shear_by_speed = forces.shear_by_speed
    sheet.skew = -speed * law.spin * forces.skew
    sheet.rough = forces.asperity_power


@jit
def evaluate_marked(assembly, time, moments, rollers, which, rests, sheets):
    """Evaluate both raceway contacts of the rollers marked in `rests`, in the set `which` of their unknowns at `time` [s].

    Returns the evaluations.
    """
    bodies = assembly.bodies
    places = assembly.places
    tables = address(assembly)
    evaluations = 0
    for j in range(rests.size):
        if rests[j].marked:
            body = bodies[places[j].row]
            at = moments[j]
            sheet = sheets[j]
            own = rollers[j].y[which]
            _evaluate(body, body.inner, tables, at.inner_load, at.inner_speed, own[0], sheet.inner)
            _evaluate(body, body.outer, tables, at.outer_load, at.outer_speed, own[1], sheet.outer)
            sheet.when = time
            evaluations += 2
    return evaluations


@jit_inline
def raceway_from(sheet, load, speed, slip):
    """Spin force and pull [N] from the sheet's slopes at another load [N], ring speed and slip [m/s]."""
    if load <= 0.0:
        return 0.0, 0.0
    dv = slip - sheet.slip
    dq = load - sheet.load
    du = speed - sheet.speed
    spin = sheet.spin + sheet.spin_by_slip * dv + sheet.spin_by_load * dq + sheet.spin_by_speed * du
    pull = sheet.pull + sheet.pull_by_slip * dv + sheet.pull_by_load * dq + sheet.pull_by_speed * du
    return spin, pull


@jit_inline
def shear_from(sheet, load, speed, slip):
    """Rolling resistance [N] in a raceway's spin force, from the sheet's slopes."""
    if load <= 0.0:
        return 0.0
    shear = sheet.shear + sheet.shear_by_slip * (slip - sheet.slip)
    return (
        shear
        + sheet.shear_by_load * (load - sheet.load)
        + sheet.shear_by_speed * (speed - sheet.speed)
    )


@jit_inline
def _reaches(sheet, load, speed, slip, slip_reach):
    """Whether a contact's slopes serve at another load [N], ring speed and slip [m/s]; at rest it has none."""
    if sheet.slip == 0.0 and sheet.speed == 0.0 and (slip != 0.0 or speed != 0.0):
        return False
    change = sheet.pull_by_slip * (slip - sheet.slip)
    return (
        abs(load - sheet.load) <= tuning.LOAD_REACH * sheet.load
        and abs(change) <= slip_reach * load
    )


@jit_inline
def is_out_of_reach(sheet, at, slips, slip_reach):
    """Whether a raceway's load or slip [m/s] has changed too much for the slopes."""
    return not (
        _reaches(sheet.inner, at.inner_load, at.inner_speed, slips[0], slip_reach)
        and _reaches(sheet.outer, at.outer_load, at.outer_speed, slips[1], slip_reach)
    )


@jit_inline
def raceway_powers(sheet, ratio, spin, pull, shear, load, speed, slip):
    """Powers [W] of a raceway contact with the forces of a stage [N] at its load [N], ring speed and slip [m/s].

    Returned are friction by what makes surfaces slide (slip of the middle, curvature, contact angle), rolling resistance, and
    the part of friction by asperities; that and the skew moment's part follow the load. `ratio` is r~ over the raceway's
    radius.
    """
    if load <= 0.0 or sheet.load <= 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    grown = (load - sheet.load) / sheet.load
    lag = pull - spin + 2.0 / ratio * shear
    return (
        (spin - shear) * slip,
        speed * ratio * lag,
        sheet.skew * (1.0 + 1.5 * grown),
        -shear * (2.0 * speed - slip),
        sheet.rough * (1.0 + grown),
    )


@jit_inline
def cage_from(body, tables, sheet, push, sliding, part):
    """Friction of the cage F_c [N], its slope by slip [N s/m] and its slope by the push N [-].

    Re-evaluated when load or slip have changed by more than `part` of them, between from the slopes. The contact is the
    same in both rows. A pocket full of oil brakes its roller without load too.
    """
    load = abs(push)
    if not body.oily and load <= tuning.LIGHT:
        return 0.0, 0.0, 0.0
    if not (
        abs(load - sheet.load) <= part * sheet.load + tuning.LIGHT
        and abs(sliding - sheet.slip) <= part * abs(sheet.slip)
    ):
        found = cage_forces(body, tables, load, -sliding, log_speed(sliding))
        sheet.force = found.friction + found.resistance
        sheet.by_slip = found.friction_by_slip + found.resistance_by_slip
        sheet.by_load = found.friction_by_load + found.resistance_by_load
        sheet.shear = found.resistance
        sheet.shear_by_slip = found.resistance_by_slip
        sheet.shear_by_load = found.resistance_by_load
        sheet.rough = found.asperity_power
        sheet.slip = sliding
        sheet.load = load
    force = (
        sheet.force + sheet.by_slip * (sliding - sheet.slip) + sheet.by_load * (load - sheet.load)
    )
    return force, sheet.by_slip, sheet.by_load if push > 0.0 else -sheet.by_load


@jit_inline
def cage_shear_from(sheet, push, sliding):
    """Rolling resistance [N] in the cage's friction, from the sheet's slopes."""
    return (
        sheet.shear
        + sheet.shear_by_slip * (sliding - sheet.slip)
        + sheet.shear_by_load * (abs(push) - sheet.load)
    )
