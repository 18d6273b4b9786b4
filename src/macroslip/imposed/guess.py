"""First guess of the slips at the stages of a Radau step."""

from __future__ import annotations

from macroslip.compiled import jit_inline
from macroslip.imposed import tuning
from macroslip.imposed.held_slip import held_slip
from macroslip.imposed.radau import NODES, collocation
from macroslip.imposed.zones import EDGE, FIRM
from macroslip.mechanics.spin import net_force


@jit_inline
def guess(path, now, zone, before, attempt):
    """Write a first guess of the slips at the stages [m/s], from which Newton's method starts.

    Where slip is smooth, the polynomial of the step before is continued. Otherwise a roller that
    drifts under small forces continues with the acceleration of the forces at the start, and one
    stuck to the cage keeps its spin; any other starts from the slip before the step, which
    `held_slip` changes with the load if the roller follows its loads.

    Parameters
    ----------
    path : macroslip.imposed.state.Path
    now : record of `macroslip.imposed.state.STATE`
        State at the start of the step.
    zone : int
        Class of the sample interval: `FREE`, `EDGE` or `FIRM`.
    before : record of `macroslip.imposed.state.BEFORE`
    attempt : record of `macroslip.imposed.state.ATTEMPT`
        Its slips are written.
    """
    h = attempt.length
    slip = now.slip
    forces = now.forces
    at = now.at
    last = before.increment
    gripped = path.body.mobility * forces.slope * h
    is_near = h <= tuning.MOST_AHEAD * before.length
    continues = zone != FIRM and is_near and gripped < tuning.GRIPPED
    drifts = gripped < 1.0 and zone != EDGE
    # The cage may hold the roller: its spin then stays as it is, at zero.
    spins = drifts or forces.slope > 2.0 * (forces.inner_slope + forces.outer_slope)
    follows = zone == FIRM or (gripped > tuning.GRIPPED and attempt.at[2].elastic_load > 0.0)
    drift = -path.body.mobility * net_force(forces) * h if drifts else 0.0
    for k in range(3):
        quickening = attempt.at[k].ring_speed - at.ring_speed
        if continues:
            part = 1.0 + NODES[k] * h / before.length
            ahead, _ = collocation(part, last[0], last[1], last[2])
            attempt.slip[k] = slip - last[2] + quickening + ahead
            continue
        attempt.slip[k] = slip + quickening + drift * NODES[k] if spins else slip
        if follows:
            attempt.slip[k] = held_slip(attempt.slip[k], at, attempt.at[k], before.exponent)
