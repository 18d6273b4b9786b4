"""What an accepted step leaves in the record: energies, peaks of power, ranges and details."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_part
from macroslip.integrate.peak import follow_peak, follow_step
from macroslip.integrate.record import add_energy, add_rolling, orbit_at, raise_peak
from macroslip.integrate.sealed import (
    book_mechanisms_of,
    forces_of,
    has_microslip,
    note_state_of,
    powers_of,
    write_trace_of,
)
from macroslip.integrate.stages import between_stages
from macroslip.integrate.tuning import PEAK_PARTS, RESOLVED, SLIP_SHARE, SNAP


class StepPowers(NamedTuple):
    """Frictional power at the three stages [W] and energy of the step [J], by interface."""

    inner: tuple
    outer: tuple
    cage: tuple
    inner_energy: float
    outer_energy: float
    cage_energy: float


class Peaks(NamedTuple):
    """What is kept from step to step to find peaks of power.

    Attributes
    ----------
    samples : ndarray, shape (2, 4)
        See `macroslip.integrate.peak.start_peak`.
    orbit : int
        Orbit of the last step.
    top_power : float
        Largest raceway power of that orbit so far [W].
    """

    samples: np.ndarray
    orbit: int
    top_power: float


@jit_part
def step_powers(model, step, stages):
    """Power at the solved stages of a step, and the energy they add up to."""
    h, weights = step.length, step.weights
    i1, o1, c1 = powers_of(model, step.at1, stages.f1, stages.v1)
    i2, o2, c2 = powers_of(model, step.at2, stages.f2, stages.v2)
    i3, o3, c3 = powers_of(model, step.at3, stages.f3, stages.v3)
    return StepPowers(
        (i1, i2, i3),
        (o1, o2, o3),
        (c1, c2, c3),
        h * (weights[0] * i1 + weights[1] * i2 + weights[2] * i3),
        h * (weights[0] * o1 + weights[1] * o2 + weights[2] * o3),
        h * (weights[0] * c1 + weights[1] * c2 + weights[2] * c3),
    )


@jit_part
def book(record, path, state, step, stages, found, peaks, edge):
    """Book an accepted step in the window.

    Parameters
    ----------
    state : State
        Before the step.
    found : StepPowers
    peaks : Peaks
        As the last step left them.
    edge : bool
        Whether the step lies at an edge of the load zone; rollers snap back nowhere else.

    Returns
    -------
    Peaks
    """
    orbit = orbit_at(record, 0.5 * (state.time + step.times[2]), peaks.orbit)
    before, top_power = state.powers, peaks.top_power
    add_energy(record, orbit, found.inner_energy, found.outer_energy, found.cage_energy)
    if orbit != peaks.orbit:
        # The power before the step may be the peak of an orbit that has just begun.
        raise_peak(record, orbit, 0, before[0])
        raise_peak(record, orbit, 1, before[1])
        raise_peak(record, orbit, 2, before[2])
        top_power = 0.0
    peaks = Peaks(peaks.samples, orbit, top_power)
    _book_peaks(record, path, state, step, stages, found, peaks, edge)
    _book_details(record, path.model, step, stages)
    return Peaks(peaks.samples, orbit, max(top_power, max(found.inner), max(found.outer)))


@jit_part
def _book_peaks(record, path, state, step, stages, found, peaks, edge):
    """Follow the powers over a step, between the stages too where the roller may just be snapping back."""
    # With microslip slip takes many steps from one level to the other, and a peak lies on their stages.
    if has_microslip(path.model) or not (edge and _may_peak_inside(path, state, stages, peaks)):
        follow_step(record, peaks.orbit, peaks.samples, state.powers, step.times, found.inner, found.outer, found.cage)
        return
    resolved = RESOLVED * SLIP_SHARE * path.limits.tolerance * path.limits.speed_scale
    for k in range(1, PEAK_PARTS + 1):
        part = k / PEAK_PARTS
        there, between, _ = between_stages(path, state, step, stages, state.interval, part)
        if abs(between) > resolved:
            inner, outer, cage = powers_of(path.model, there, forces_of(path.model, there, between), between)
            follow_peak(record, peaks.orbit, peaks.samples, state.time + part * step.length, inner, outer, cage)
    record.count[2] += PEAK_PARTS


@jit_part
def _may_peak_inside(path, state, stages, peaks):
    """Whether the roller snaps back in the step, or slides with a power near the orbit's largest."""
    sliding = max(_sliding(stages.f1, stages.v1), _sliding(stages.f2, stages.v2), _sliding(stages.f3, stages.v3))
    if sliding > 0.5 * peaks.top_power:
        return True
    resolved = RESOLVED * SLIP_SHARE * path.limits.tolerance * path.limits.speed_scale
    return abs(state.slip) > resolved and abs(stages.v3) < SNAP * abs(state.slip)


@jit_part
def _book_details(record, model, step, stages):
    """Book ranges of the film law at the end of the step, and energies by mechanism."""
    h, weights, at3 = step.length, step.weights, step.at3
    note_state_of(record, model, at3, stages.f3, stages.v3, h)
    add_rolling(record, stages.f1.rolling_power, h * weights[0])
    add_rolling(record, stages.f2.rolling_power, h * weights[1])
    add_rolling(record, stages.f3.rolling_power, h * weights[2])
    book_mechanisms_of(record, model, step.at1, stages.f1, stages.v1, h * weights[0])
    book_mechanisms_of(record, model, step.at2, stages.f2, stages.v2, h * weights[1])
    book_mechanisms_of(record, model, at3, stages.f3, stages.v3, h * weights[2])


@jit_part
def _sliding(forces, slip):
    """Larger power of sliding of the middle at the raceways [W]: all of it without microslip."""
    return max(abs(forces.inner), abs(forces.outer)) * abs(slip)


@jit_part
def write_traces(record, model, first, time, at, forces, slip):
    """Write the state at all trace times from index `first` on that are not after `time` [s]; the index after them."""
    index = first
    while index < record.trace_time.size and record.trace_time[index] <= time:
        write_trace_of(record, model, index, at, forces, slip)
        index += 1
    return index
