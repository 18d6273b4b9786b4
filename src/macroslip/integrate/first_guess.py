"""Where Newton's iteration for the stages of a step starts."""

from __future__ import annotations

from macroslip.compiled import jit_part
from macroslip.integrate.held_contact import held_slip
from macroslip.integrate.load_zone import EDGE, FIRM
from macroslip.integrate.radau_step import NODES, collocation
from macroslip.integrate.sealed import has_microslip
from macroslip.integrate.tuning import GRIPPED, MOST_AHEAD
from macroslip.roller.forces import net_force


@jit_part
def first_guess(path, state, step, zone, memory):
    """Slip at the stages [m/s] to start Newton's iteration from.

    Where slip is smooth, the polynomial of the step before is continued. Otherwise a roller that drifts under small forces
    continues with the acceleration of the forces at the start, and one stuck to the cage keeps its spin; any other starts
    from the slip before the step, which `held_slip` changes with the load if the roller follows its loads.
    """
    model, h, slip, forces = path.model, step.length, state.slip, state.forces
    at, at1, at2, at3 = state.at, step.at1, step.at2, step.at3
    microslip = has_microslip(model)
    gripped = model.mobility * forces.slope * h
    if zone != FIRM and step.length <= MOST_AHEAD * memory.length and gripped < GRIPPED:
        ratio = step.length / memory.length
        ahead1, _ = collocation(1.0 + NODES[0] * ratio, memory.s1, memory.s2, memory.s3)
        ahead2, _ = collocation(1.0 + NODES[1] * ratio, memory.s1, memory.s2, memory.s3)
        ahead3, _ = collocation(1.0 + ratio, memory.s1, memory.s2, memory.s3)
        base = slip - at.ring_speed - memory.s3
        return base + at1.ring_speed + ahead1, base + at2.ring_speed + ahead2, base + at3.ring_speed + ahead3
    v1, v2, v3 = slip, slip, slip
    if gripped < 1.0 and zone != EDGE:
        drift = -model.mobility * net_force(forces)
        v1 = slip + (at1.ring_speed - at.ring_speed) + drift * NODES[0] * h
        v2 = slip + (at2.ring_speed - at.ring_speed) + drift * NODES[1] * h
        v3 = slip + (at3.ring_speed - at.ring_speed) + drift * h
    elif forces.slope > 2.0 * (forces.inner_slope + forces.outer_slope):
        # What holds the roller is the cage: its spin stays as it is, at zero.
        v1 = slip + (at1.ring_speed - at.ring_speed)
        v2 = slip + (at2.ring_speed - at.ring_speed)
        v3 = slip + (at3.ring_speed - at.ring_speed)
    if zone == FIRM or (microslip and gripped > GRIPPED and at3.elastic_load > 0.0):
        v1 = held_slip(microslip, v1, at, at1, memory.exponent)
        v2 = held_slip(microslip, v2, at, at2, memory.exponent)
        v3 = held_slip(microslip, v3, at, at3, memory.exponent)
    return v1, v2, v3
