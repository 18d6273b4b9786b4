"""What an accepted step leaves in the record: energies, peaks of power, ranges and details."""

from __future__ import annotations

from typing import NamedTuple

from macroslip.compiled import jit_part
from macroslip.integrate.detail import book_stage, book_step
from macroslip.integrate.peak import follow_peak, follow_step
from macroslip.integrate.radau_step import WEIGHTS
from macroslip.integrate.record import add_energy, note_state, powers, raise_peak
from macroslip.integrate.stages import between_stages
from macroslip.integrate.step_control import SLIP_SHARE
from macroslip.roller.forces import magnitude, net_force, slip_forces

#: Parts into which a step is divided to find a peak of power in it, and how many slip tolerances a slip between stages
#: must be for the power there to be meaningful.
_PEAK_PARTS, _RESOLVED = 10, 3.0
#: Part of the sum of force magnitudes that is unbalanced where a roller with microslip is not at its balance.
_ASTRAY = 0.1
#: Part of its slip that a roller keeps, at most, over a step in which it snaps back.
_SNAP = 0.7


class StepPowers(NamedTuple):
    """Frictional power at the three stages [W] and energy of the step [J], by interface."""

    inner: tuple
    outer: tuple
    cage: tuple
    inner_energy: float
    outer_energy: float
    cage_energy: float


@jit_part
def step_powers(model, h, at1, at2, at3, stages):
    """Power at the solved stages of a step of length h [s], and the energy they add up to."""
    i1, o1, c1 = powers(model, at1, stages.f1, stages.v1)
    i2, o2, c2 = powers(model, at2, stages.f2, stages.v2)
    i3, o3, c3 = powers(model, at3, stages.f3, stages.v3)
    return StepPowers(
        (i1, i2, i3),
        (o1, o2, o3),
        (c1, c2, c3),
        h * (WEIGHTS[0] * i1 + WEIGHTS[1] * i2 + WEIGHTS[2] * i3),
        h * (WEIGHTS[0] * o1 + WEIGHTS[1] * o2 + WEIGHTS[2] * o3),
        h * (WEIGHTS[0] * c1 + WEIGHTS[1] * c2 + WEIGHTS[2] * c3),
    )


@jit_part
def book_energy(record, orbit, new_orbit, before, found):
    """Book a step's energies; the power `before` it [W] may be the peak of an orbit that has just begun."""
    add_energy(record, orbit, found.inner_energy, found.outer_energy, found.cage_energy)
    if new_orbit:
        raise_peak(record, orbit, 0, before[0])
        raise_peak(record, orbit, 1, before[1])
        raise_peak(record, orbit, 2, before[2])


@jit_part
def book_peaks(
    record,
    model,
    motion,
    start_angle,
    interval,
    limits,
    time,
    h,
    slip,
    at,
    forces,
    stages,
    times,
    before,
    found,
    orbit,
    peaks,
    top_power,
    edge,
    jumps,
):
    """Follow the powers over a step, between the stages too where the roller may just be snapping back.

    Parameters
    ----------
    interval : int
        Sample interval of the step.
    times : tuple of float
        Of the stages [s].
    before : tuple of float
        Powers at the start [W].
    top_power : float
        Largest raceway power of the orbit so far [W].
    edge : bool
        Whether the step lies at an edge of the load zone; snaps happen nowhere else.
    jumps : bool
        Whether the roller is without microslip.
    """
    sliding = max(_sliding(stages.f1, stages.v1), _sliding(stages.f2, stages.v2), _sliding(stages.f3, stages.v3))
    resolved = _RESOLVED * SLIP_SHARE * limits.tolerance * limits.speed_scale
    # A gripped roller with microslip slips less where load decreases, without a snap.
    astray = jumps or at.elastic_load <= 0.0 or abs(net_force(forces)) > _ASTRAY * magnitude(forces)
    snapping = astray and abs(slip) > resolved and abs(stages.v3) < _SNAP * abs(slip)
    if not (edge and (snapping or sliding > 0.5 * top_power)):
        follow_step(record, orbit, peaks, before, times, found.inner, found.outer, found.cage)
        return 0
    for k in range(1, _PEAK_PARTS + 1):
        part = k / _PEAK_PARTS
        there, between, _ = between_stages(model, motion, start_angle, interval, time, h, part, slip, at, stages)
        if abs(between) > resolved:
            inner, outer, cage = powers(model, there, slip_forces(model, there, between), between)
            follow_peak(record, orbit, peaks, time + part * h, inner, outer, cage)
    return _PEAK_PARTS


@jit_part
def book_details(record, model, h, orbit, steps, at1, at2, at3, stages, found):
    """Book ranges of the film law at the end of the step, and what curved contacts add."""
    note_state(record, model, at3, stages.f3, stages.v3, h)
    book_stage(record, model, at1, stages.f1, stages.v1, h * WEIGHTS[0])
    book_stage(record, model, at2, stages.f2, stages.v2, h * WEIGHTS[1])
    book_stage(record, model, at3, stages.f3, stages.v3, h * WEIGHTS[2])
    book_step(record, model, at3, stages.f3, stages.v3, h, orbit, found.inner_energy, found.outer_energy, steps)


@jit_part
def _sliding(forces, slip):
    """Larger power of sliding of the middle at the raceways [W]: all of it without microslip."""
    return max(abs(forces.inner), abs(forces.outer)) * abs(slip)
