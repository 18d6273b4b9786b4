"""The paper's two Euler methods over a whole history, at a fixed step."""

from __future__ import annotations

import math

from macroslip.compiled import jit_lawless
from macroslip.integrate.backward_euler import backward_euler_step
from macroslip.integrate.booking import write_traces
from macroslip.integrate.detail import Passage, collect
from macroslip.integrate.explicit_euler import explicit_euler_step
from macroslip.integrate.record import add_energy, add_rolling, orbit_at, raise_peak
from macroslip.integrate.sealed import (
    book_mechanisms_of,
    book_passage_of,
    forces_of,
    note_state_of,
    powers_of,
    station_of,
)
from macroslip.integrate.status import COMPLETED, IMPOSSIBLE_SLIP, INTERRUPTED, NO_ROOT, NOT_FINITE
from macroslip.integrate.surface import Way
from macroslip.integrate.tuning import FINE_LOOKS
from macroslip.reference import by_reference
from macroslip.ring.orbit import instant, interval_of


@jit_lawless
def integrate_fixed_step(path, slip, end, record):
    """Integrate the spin of one roller with explicit or backward Euler.

    Parameters
    ----------
    path : Path
        With a `FixedStep` for limits.
    slip : float
        Slip at the first sample [m/s].
    end : float
        End of the integration [s]; the last step is shortened to meet it.
    record : RollerRecord
        Filled. Energies are rectangles with the power of the state a step is evaluated at, traces are the first
        state at or after each trace time.

    Returns
    -------
    int
        A `Status`, or `INTERRUPTED`.

    Notes
    -----
    The slip is formed as u2 − r ω and so carries the round-off of the surface speeds; that is part of these methods.
    """
    path, record = by_reference(path), by_reference(record)
    model, motion, rule = path.model, path.motion, path.limits
    start = motion.time[0]
    time, interval, next_trace = start, 0, 0
    record.count[2] += 1
    status, orbit = COMPLETED, -1
    at = station_of(model, path.start_angle, instant(motion, 0, time))
    spin = (at.ring_speed - slip) / model.radius
    forces = forces_of(model, at, slip)
    while True:
        next_trace = write_traces(record, model, next_trace, time, at, forces, slip)
        if time >= end:
            break
        if rule.interrupt[0] != 0:
            status = INTERRUPTED
            break
        after = min(start + (record.count[0] + 1) * rule.step, end)
        span = after - time
        interval = interval_of(motion, after, interval)
        turned = instant(motion, interval_of(motion, time, interval), time).shaft_angle
        reached = station_of(model, path.start_angle, instant(motion, interval, after))
        inner, outer, cage = powers_of(model, at, forces, slip)
        if rule.implicit:
            spin, used, unbalanced = backward_euler_step(model, reached, spin, span, rule.tolerance)
            record.count[2] += used
            record.worst[0] = max(record.worst[0], unbalanced)
        else:
            spin = explicit_euler_step(model, at, spin, span)
            record.count[2] += 1
        slip_before, before = slip, forces
        slip = reached.ring_speed - model.radius * spin
        if not math.isfinite(slip):
            status = NO_ROOT if rule.implicit else NOT_FINITE
            break
        if abs(slip) > rule.largest_slip:
            time, status = after, IMPOSSIBLE_SLIP
            break
        forces = forces_of(model, reached, slip)
        record.count[2] += 1
        if rule.implicit:
            inner, outer, cage = powers_of(model, reached, forces, slip)
        if time >= record.edges[0]:
            orbit = orbit_at(record, 0.5 * (time + after), orbit)
            add_energy(record, orbit, span * inner, span * outer, span * cage)
            raise_peak(record, orbit, 0, inner)
            raise_peak(record, orbit, 1, outer)
            raise_peak(record, orbit, 2, cage)
            note_state_of(record, model, reached, forces, slip, span)
            # Rectangles: the state at which a step is evaluated counts for the whole step.
            if rule.implicit:
                add_rolling(record, forces.rolling_power, span)
                book_mechanisms_of(record, model, reached, forces, slip, span)
            else:
                add_rolling(record, before.rolling_power, span)
                book_mechanisms_of(record, model, at, before, slip_before, span)
            collect(record, 0, span * inner, 0.5 * span)
            collect(record, 1, span * outer, 0.5 * span)
            way = Way(path.start_angle, model.orbit_ratio, turned, instant(motion, interval, after).shaft_angle)
            fine = record.count[0] % FINE_LOOKS == 0
            book_passage_of(record, model, reached, forces, slip, Passage(orbit, way, span, fine))
        time, at = after, reached
        record.count[0] += 1
    record.end[0], record.end[1] = time, slip
    return status
