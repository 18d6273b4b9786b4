"""Tractions of a roller, each as its value, its slopes and the place they belong to.

A contact is evaluated where it has to be; in between its force follows from the slopes by slip, load and ring speed. A
gripped or a coasting roller then costs an evaluation now and then, while one that enters or leaves the load zone is
evaluated in every iteration.
"""

from __future__ import annotations

import numpy as np

from macroslip.compiled import jit_called, jit_inline
from macroslip.roller.contact import cage_contact, raceway_contact
from macroslip.whole_bearing.oil import cage_oil, has_oil, raceway_oil
from macroslip.whole_bearing.tuning import FLOATING, LIGHT, LOAD_REACH

#: Columns of a sheet: for inner and outer contact from these offsets on …
INNER, OUTER = 0, 17
#: … spin, pull, their slopes by slip, by load and by ring speed, power of the skew moment, slip, load and ring speed …
SPIN, PULL, SPIN_V, PULL_V, SPIN_Q, PULL_Q, SPIN_U, PULL_U, SKEW, SLIP, LOAD, SPEED = range(12)
#: … rolling resistance, which spin and pull hold too, with its slopes, and the power that asperities dissipate.
SHEAR, SHEAR_V, SHEAR_Q, SHEAR_U, ROUGH = range(12, 17)
#: Of the cage's contact: force, slopes by slip and by load, slip and load …
CAGE, CAGE_V, CAGE_Q, CAGE_SLIP, CAGE_LOAD = range(34, 39)
#: … rolling resistance in it, with its slopes, and the power that asperities dissipate.
CAGE_SHEAR, CAGE_SHEAR_V, CAGE_SHEAR_Q, CAGE_ROUGH = range(39, 43)
#: Time of the raceways' evaluation.
WHEN = 43
COLUMNS = 44


def new_sheets(count: int) -> np.ndarray:
    """Sheets of `count` rollers, none evaluated yet."""
    sheets = np.zeros((count, COLUMNS))
    sheets[:, WHEN] = -np.inf
    sheets[:, CAGE_LOAD] = -1.0
    return sheets


@jit_inline
def _write(sheet, at, contact, oil, ratio, place):
    load, speed, slip = place
    found = raceway_contact(contact, load, speed, slip)
    lag = found.pull - found.spin
    # Beside its shear the inclined pressure pushes by −2 R/R_1 of it.
    push = 1.0 - 2.0 / ratio
    sheet[at + SPIN] = found.spin + oil.sliding + oil.shear
    sheet[at + PULL] = found.pull + oil.sliding + push * oil.shear
    sheet[at + SPIN_V] = found.spin_by_slip + oil.sliding_by_slip + oil.shear_by_slip
    sheet[at + PULL_V] = found.pull_by_slip + oil.sliding_by_slip + push * oil.shear_by_slip
    sheet[at + SPIN_Q] = found.spin_by_load + oil.sliding_by_load + oil.shear_by_load
    sheet[at + PULL_Q] = found.pull_by_load + oil.sliding_by_load + push * oil.shear_by_load
    sheet[at + SPIN_U] = found.spin_by_speed + oil.sliding_by_speed + oil.shear_by_speed
    sheet[at + PULL_U] = found.pull_by_speed + oil.sliding_by_speed + push * oil.shear_by_speed
    sheet[at + SKEW] = found.power - found.spin * slip - speed * ratio * lag
    sheet[at + SLIP], sheet[at + LOAD], sheet[at + SPEED] = slip, load, speed
    sheet[at + SHEAR], sheet[at + SHEAR_V] = oil.shear, oil.shear_by_slip
    sheet[at + SHEAR_Q], sheet[at + SHEAR_U] = oil.shear_by_load, oil.shear_by_speed
    sheet[at + ROUGH] = found.asperity_power


@jit_called
def evaluate_marked(bearing, stations, time, rollers, marked, sheets):
    """Evaluate both raceway contacts of the rollers that are marked into their sheets.

    Parameters
    ----------
    bearing : WholeBearing
    stations : Stations
    time : float
        [s].
    rollers : ndarray, shape (n, 3)
        Slips v_in, v_out [m/s], and offsets.
    marked : ndarray of bool, shape (n,)
    sheets : ndarray, shape (n, 44)

    Returns
    -------
    int
        Evaluations of a contact.
    """
    models, rows, films = bearing.models, bearing.rollers.row, bearing.films
    inner_ratio, outer_ratio = bearing.pitch_radius / bearing.inner_radius, bearing.pitch_radius / bearing.outer_radius
    evaluations = 0
    for j in range(rows.size):
        if not marked[j]:
            continue
        sheet, inner_slip, outer_slip = sheets[j], rollers[j, 0], rollers[j, 1]
        at_inner = (stations.inner_load[j], stations.inner_speed[j], inner_slip)
        at_outer = (stations.outer_load[j], stations.outer_speed[j], outer_slip)
        inner_oil = raceway_oil(films, False, at_inner[0], at_inner[1], inner_slip)
        outer_oil = raceway_oil(films, True, at_outer[0], at_outer[1], outer_slip)
        # A row's model is named, not indexed: to pick it by a variable would copy all its contacts.
        if rows[j] == 0:
            _write(sheet, INNER, models.downwind.inner, inner_oil, inner_ratio, at_inner)
            _write(sheet, OUTER, models.downwind.outer, outer_oil, outer_ratio, at_outer)
        else:
            _write(sheet, INNER, models.upwind.inner, inner_oil, inner_ratio, at_inner)
            _write(sheet, OUTER, models.upwind.outer, outer_oil, outer_ratio, at_outer)
        sheet[WHEN] = time
        evaluations += 2
    return evaluations


@jit_inline
def raceway_from(sheet, at, load, speed, slip):
    """Spin force and pull [N] from the sheet's slopes at another load [N], ring speed and slip [m/s]."""
    if load <= 0.0:
        return 0.0, 0.0
    dv, dq, du = slip - sheet[at + SLIP], load - sheet[at + LOAD], speed - sheet[at + SPEED]
    spin = sheet[at + SPIN] + sheet[at + SPIN_V] * dv + sheet[at + SPIN_Q] * dq + sheet[at + SPIN_U] * du
    pull = sheet[at + PULL] + sheet[at + PULL_V] * dv + sheet[at + PULL_Q] * dq + sheet[at + PULL_U] * du
    return spin, pull


@jit_inline
def out_of_reach(sheet, stations, j):
    """Whether a raceway load of roller `j` has changed too much for the slopes."""
    inner, outer = sheet[INNER + LOAD], sheet[OUTER + LOAD]
    return (
        abs(stations.inner_load[j] - inner) > LOAD_REACH * inner
        or abs(stations.outer_load[j] - outer) > LOAD_REACH * outer
    )


@jit_inline
def shear_from(sheet, at, load, speed, slip):
    """Rolling resistance [N] in a raceway's spin force, from the sheet's slopes."""
    if load <= 0.0:
        return 0.0
    shear = sheet[at + SHEAR] + sheet[at + SHEAR_V] * (slip - sheet[at + SLIP])
    return shear + sheet[at + SHEAR_Q] * (load - sheet[at + LOAD]) + sheet[at + SHEAR_U] * (speed - sheet[at + SPEED])


@jit_inline
def cage_from(contact, films, sheet, push, slip, part):
    """Friction of the cage F_c [N], its slope by slip [N s/m] and its slope by the push N [-].

    Re-evaluated when load or slip have changed by more than `part` of them, between from the slopes. The contact is the same in both rows. A pocket
    full of oil brakes its roller without load too.
    """
    load = abs(push)
    oily = has_oil(films)
    if not oily and load <= LIGHT:
        return 0.0, 0.0, 0.0
    known = sheet[CAGE_LOAD]
    reach = part * known + (FLOATING if oily else 0.0)
    if not (abs(load - known) <= reach and abs(slip - sheet[CAGE_SLIP]) <= part * abs(sheet[CAGE_SLIP])):
        found, oil = cage_contact(contact, load, slip), cage_oil(films, load, slip)
        sheet[CAGE] = found.force + oil.sliding + oil.shear
        sheet[CAGE_V] = found.by_slip + oil.sliding_by_slip + oil.shear_by_slip
        sheet[CAGE_Q] = found.by_load + oil.sliding_by_load + oil.shear_by_load
        sheet[CAGE_SHEAR], sheet[CAGE_SHEAR_V], sheet[CAGE_SHEAR_Q] = oil.shear, oil.shear_by_slip, oil.shear_by_load
        sheet[CAGE_ROUGH] = found.asperity_power
        sheet[CAGE_SLIP], sheet[CAGE_LOAD] = slip, load
        known = load
    force = sheet[CAGE] + sheet[CAGE_V] * (slip - sheet[CAGE_SLIP]) + sheet[CAGE_Q] * (load - known)
    return force, sheet[CAGE_V], sheet[CAGE_Q] if push > 0.0 else -sheet[CAGE_Q]


@jit_inline
def cage_shear_from(sheet, push, slip):
    """Rolling resistance [N] in the cage's friction, from the sheet's slopes."""
    shear = sheet[CAGE_SHEAR] + sheet[CAGE_SHEAR_V] * (slip - sheet[CAGE_SLIP])
    return shear + sheet[CAGE_SHEAR_Q] * (abs(push) - sheet[CAGE_LOAD])
