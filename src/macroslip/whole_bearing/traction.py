"""Tractions of a roller, each as its value, its slopes and the place they belong to.

A contact is evaluated where it has to be; in between its force follows from the slopes by slip, load and ring speed. A
gripped or a coasting roller then costs an evaluation now and then, while one that enters or leaves the load zone is
evaluated in every iteration.
"""

from __future__ import annotations

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.roller.contact import cage_contact, raceway_contact

#: Columns of a sheet: for inner and outer contact from these offsets on …
INNER, OUTER = 0, 12
#: … spin, pull, their slopes by slip, by load and by ring speed, power, slip, load and ring speed.
SPIN, PULL, SPIN_V, PULL_V, SPIN_Q, PULL_Q, SPIN_U, PULL_U, POWER, SLIP, LOAD, SPEED = range(12)
#: Of the cage's contact: force, slopes by slip and by load, slip and load.
CAGE, CAGE_V, CAGE_Q, CAGE_SLIP, CAGE_LOAD = range(24, 29)
#: Time of the raceways' evaluation.
WHEN = 29
COLUMNS = 30
#: Relative change of a raceway's load beyond which slopes no longer serve.
_LOAD_REACH = 0.25
#: Relative change of the cage's load and of its slip beyond which they no longer serve, and the force that never matters.
_CAGE_REACH, _LIGHT = 0.05, 1e-7


def new_sheets(count: int) -> np.ndarray:
    """Sheets of `count` rollers, none evaluated yet."""
    sheets = np.zeros((count, COLUMNS))
    sheets[:, WHEN] = -np.inf
    return sheets


@jit_inline
def _write(sheet, at, contact, load, speed, slip):
    found = raceway_contact(contact, load, speed, slip)
    sheet[at + SPIN], sheet[at + PULL] = found.spin, found.pull
    sheet[at + SPIN_V], sheet[at + PULL_V] = found.spin_by_slip, found.pull_by_slip
    sheet[at + SPIN_Q], sheet[at + PULL_Q] = found.spin_by_load, found.pull_by_load
    sheet[at + SPIN_U], sheet[at + PULL_U] = found.spin_by_speed, found.pull_by_speed
    sheet[at + POWER] = found.power
    sheet[at + SLIP], sheet[at + LOAD], sheet[at + SPEED] = slip, load, speed


@jit
def evaluate_marked(models, rows, stations, time, rollers, marked, sheets):
    """Evaluate both raceway contacts of the rollers that are marked into their sheets.

    Parameters
    ----------
    models : tuple of two RollerModel
        Of the rows.
    rows : ndarray of int, shape (n,)
        Row of each roller.
    stations : Stations
    time : float
        [s].
    rollers : ndarray, shape (n, 3)
        Slips v_in, v_out [m/s], and offsets.
    marked : ndarray of bool, shape (n,)
    sheets : ndarray, shape (n, 30)

    Returns
    -------
    int
        Evaluations of a contact.
    """
    evaluations = 0
    for j in range(rows.size):
        if not marked[j]:
            continue
        sheet, inner_slip, outer_slip = sheets[j], rollers[j, 0], rollers[j, 1]
        inner, outer = stations.inner_load[j], stations.outer_load[j]
        inner_speed, outer_speed = stations.inner_speed[j], stations.outer_speed[j]
        # A row's model is named, not indexed: to pick it by a variable would copy all its contacts.
        if rows[j] == 0:
            _write(sheet, INNER, models[0].inner, inner, inner_speed, inner_slip)
            _write(sheet, OUTER, models[0].outer, outer, outer_speed, outer_slip)
        else:
            _write(sheet, INNER, models[1].inner, inner, inner_speed, inner_slip)
            _write(sheet, OUTER, models[1].outer, outer, outer_speed, outer_slip)
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
        abs(stations.inner_load[j] - inner) > _LOAD_REACH * inner
        or abs(stations.outer_load[j] - outer) > _LOAD_REACH * outer
    )


@jit_inline
def cage_from(contact, sheet, push, slip):
    """Friction of the cage F_c [N], its slope by slip [N s/m] and its slope by the push N [-].

    Re-evaluated when load or slip have changed, between from the slopes. The contact is the same in both rows.
    """
    load = abs(push)
    if load <= _LIGHT:
        return 0.0, 0.0, 0.0
    known = sheet[CAGE_LOAD]
    if not (
        abs(load - known) <= _CAGE_REACH * known and abs(slip - sheet[CAGE_SLIP]) <= _CAGE_REACH * abs(sheet[CAGE_SLIP])
    ):
        found = cage_contact(contact, load, slip)
        sheet[CAGE], sheet[CAGE_V], sheet[CAGE_Q] = found.force, found.by_slip, found.by_load
        sheet[CAGE_SLIP], sheet[CAGE_LOAD] = slip, load
        known = load
    force = sheet[CAGE] + sheet[CAGE_V] * (slip - sheet[CAGE_SLIP]) + sheet[CAGE_Q] * (load - known)
    return force, sheet[CAGE_V], sheet[CAGE_Q] if push > 0.0 else -sheet[CAGE_Q]
