"""The paper's two Euler methods over a whole history, at a fixed step."""

from __future__ import annotations

import math

from macroslip.compiled import jit
from macroslip.integrate.backward_euler import backward_euler_step
from macroslip.integrate.detail import book_stage, book_step
from macroslip.integrate.explicit_euler import explicit_euler_step
from macroslip.integrate.record import add_energy, note_state, orbit_at, powers, raise_peak, write_trace
from macroslip.integrate.status import COMPLETED, IMPOSSIBLE_SLIP, NO_ROOT, NOT_FINITE
from macroslip.ring.orbit import instant, interval_of
from macroslip.roller.forces import slip_forces, station


@jit
def integrate_fixed_step(model, motion, start_angle, slip, end, step, implicit, tolerance, largest_slip, record):
    """Integrate the spin of one roller with explicit or backward Euler.

    Parameters
    ----------
    model : RollerModel
    motion : Motion
    start_angle : float
        Position φ at the first sample [rad].
    slip : float
        Slip at the first sample [m/s].
    end : float
        End of the integration [s]; the last step is shortened to meet it.
    step : float
        Fixed step [s].
    implicit : bool
        Backward Euler if true, explicit Euler if not.
    tolerance : float
        Of the nonlinear iteration of backward Euler, relative change of spin.
    largest_slip : float
        Slip [m/s] beyond which the integration stops as unstable. Friction pulls a roller's surface towards the speed
        of the rings and of the cage only, so its true slip never leaves the range these speeds span.
    record : Record
        Filled. Energies are rectangles with the power of the state a step is evaluated at, traces are the first
        state at or after each trace time.

    Returns
    -------
    int
        A `Status`.

    Notes
    -----
    The slip is formed as u2 − r ω and so carries the round-off of the surface speeds; that is part of these methods.
    """
    start = motion.time[0]
    time, interval, steps, evaluations, next_trace = start, 0, 0, 1, 0
    status, orbit = COMPLETED, -1
    at = station(model, start_angle, instant(motion, 0, time))
    spin = (at.ring_speed - slip) / model.radius
    forces = slip_forces(model, at, slip)
    while True:
        while next_trace < record.trace_time.size and record.trace_time[next_trace] <= time:
            write_trace(record, model, next_trace, at, forces, slip)
            next_trace += 1
        if time >= end:
            break
        after = min(start + (steps + 1) * step, end)
        span = after - time
        interval = interval_of(motion, after, interval)
        reached = station(model, start_angle, instant(motion, interval, after))
        inner, outer, cage = powers(model, at, forces, slip)
        if implicit:
            spin, used, unbalanced = backward_euler_step(model, reached, spin, span, tolerance)
            evaluations += used
            record.worst[0] = max(record.worst[0], unbalanced)
        else:
            spin = explicit_euler_step(model, at, spin, span)
            evaluations += 1
        slip_before, before = slip, forces
        slip = reached.ring_speed - model.radius * spin
        if not math.isfinite(slip):
            status = NO_ROOT if implicit else NOT_FINITE
            break
        if abs(slip) > largest_slip:
            time, status = after, IMPOSSIBLE_SLIP
            break
        forces = slip_forces(model, reached, slip)
        evaluations += 1
        if implicit:
            inner, outer, cage = powers(model, reached, forces, slip)
        if time >= record.edges[0]:
            orbit = orbit_at(record, 0.5 * (time + after), orbit)
            add_energy(record, orbit, span * inner, span * outer, span * cage)
            raise_peak(record, orbit, 0, inner)
            raise_peak(record, orbit, 1, outer)
            raise_peak(record, orbit, 2, cage)
            note_state(record, model, reached, forces, slip, span)
            # Rectangles: the state a step is evaluated at stands for the whole step.
            if implicit:
                book_stage(record, model, reached, forces, slip, span)
            else:
                book_stage(record, model, at, before, slip_before, span)
            book_step(record, model, reached, forces, slip, span, orbit, span * inner, span * outer, steps)
        time, at = after, reached
        steps += 1
    record.count[0], record.count[1], record.count[2] = steps, 0, evaluations
    record.end[0], record.end[1] = time, slip
    return status
