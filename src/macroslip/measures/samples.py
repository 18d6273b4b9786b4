"""Samples of the contacts of a roller: when they are taken, and their record.

A sample is an evaluation of a contact by station. It is taken where its power has changed or some
way has been travelled: at every step it would cost more than the forces. Between two samples the
energies of the raceways are kept, and when they were spent. The states in which power per area, the
cage's power and the slide-roll ratio are the highest of an orbit are kept too, and are samples of
their own when the orbit has ended.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from macroslip.compiled import jit, jit_inline, jit_once
from macroslip.measures.totals import END, orbit_at, write_end
from macroslip.mechanics.speeds import signed_entrainment

if TYPE_CHECKING:
    from collections.abc import Sequence

#: A roller that the rings begin to press enters the load zone until its middle slips by less than
#: this part of the speed, or for this way [rad].
_SETTLED = 0.01
_ENTRY = 0.35
#: A roller's contacts are sampled after a change of a raceway's power by this part of the largest in
#: this orbit or the one before, or of the largest since the roller began to enter the load zone;
#: after a rise of its power per area by this part above the highest sample in the orbit, once that
#: is half of what it was in the orbit before; and in any case after this way [rad], or after so many
#: times the step that ended in a sample: what changes fast takes short steps.
_CHANGE = 0.07
_CHANGE_ENTERING = 0.02
_RISE = 0.03
_TURN = 0.15
_STEPS = 8.0

#: What is the highest in an orbit at a peak: powers of the three interfaces, slide-roll ratio, and
#: power per area at both raceways while the rings press the roller: between films it is not their
#: power over the contact's area.
PEAKS = 6
#: The state in which one of them is the highest in its orbit.
PEAK = np.dtype(
    [
        # Power [W], cube of it over load^(2/3) [W³/N²], or ratio [-]; 0 before the first.
        ("value", "f8"),
        # Time [s].
        ("time", "f8"),
        # Angle of the roller ahead of pure rolling [rad].
        ("ahead", "f8"),
        ("at", END),
    ]
)
#: State from sample to sample of the contacts.
MEMORY = np.dtype(
    [
        # Number of samples.
        ("count", "i8"),
        # Orbit of the last sample.
        ("orbit", "i8"),
        # Time of the last sample [s]; NaN before the first.
        ("time", "f8"),
        # Length of the step that ended in it [s].
        ("length", "f8"),
        # Angle of the roller ahead of pure rolling at the last sample [rad].
        ("ahead", "f8"),
        # Power at the raceways at the last sample [W].
        ("power", "f8", (2,)),
        # Highest power at the raceways in the orbit before and in this one [W].
        ("highest", "f8", (2, 2)),
        # Highest cube of power over load^(2/3) under the rings' load in both, and at samples in this
        # one [W³/N²].
        ("densest", "f8", (3, 2)),
        # Energy since the last sample by raceway [J].
        ("energy", "f8", (2,)),
        # Moment of that energy about the time of the last sample [J s].
        ("moment", "f8", (2,)),
        # Part of asperities in that energy [J].
        ("rough", "f8", (2,)),
        # Time since the last sample in which the rings pressed the roller [s].
        ("under_load", "f8"),
        # Elastic load at the end of the last step [N]; NaN before the first.
        ("pressed", "f8"),
        # Speed u2 of the outer raceway there [m/s].
        ("speed", "f8"),
        # Number of the entry into the load zone under way; 0 for none.
        ("entry", "i8"),
        # Highest power at the raceways in it [W].
        ("entering", "f8", (2,)),
        # Number of entries so far.
        ("entries", "i8"),
        # When the entry under way began [s].
        ("since", "f8"),
    ]
)
#: A sample of the contacts.
SAMPLE = np.dtype(
    [
        # Orbit it lies in; −1 outside all complete ones.
        ("orbit", "i8"),
        # Number of the sample.
        ("number", "i8"),
        # Number of the entry into the load zone it belongs to; 0 for none.
        ("entry", "i8"),
        # Time of the sample before [s].
        ("since", "f8"),
        # Time [s].
        ("time", "f8"),
        # Angles of the roller ahead of pure rolling at both times [rad].
        ("ahead", "f8", (2,)),
        # Energy since the sample before by raceway [J].
        ("energy", "f8", (2,)),
        # Part of the time since then at which that energy was spent in the mean, by raceway [-].
        ("mean_time", "f8", (2,)),
        # Part of asperities in that energy [J].
        ("rough", "f8", (2,)),
        # Part of the time since the sample before in which the rings pressed the roller [-].
        ("under_load", "f8"),
        # State at the sample.
        ("at", END),
        # Film thickness by interface [m].
        ("film", "f8", (3,)),
        # Asperities' share of the load by interface [-].
        ("share", "f8", (3,)),
        # Angles of the shaft at both times [rad].
        ("turned", "f8", (2,)),
        # Column for `heat_entries`, of an entry.
        ("column", "i8"),
        # First station of the roller that each raceway touches, and number of them.
        ("touched", "i8", (2, 2)),
        # 1 where the roller is skewed; then by raceway the middle of the ellipse along the roller
        # [m] and the six numbers of `contact.skewed.SlipLines`.
        ("skewed", "i8"),
        ("lines", "f8", (2, 7)),
    ]
)


@jit_inline
def _density(power, load, elastic_load):
    """Cube of power over load^(2/3), which is compared as power over the area is, without a root."""
    if elastic_load <= 0.0:
        return 0.0
    return power * power * power / (load * load)


@jit_once
def _densities(step, last):
    """Cube of power over load^(2/3) at both raceways under the rings' load [W³/N²]."""
    power = step.power[last]
    elastic_load = step.elastic_load[last]
    return (
        _density(power[0], step.inner_load[last], elastic_load),
        _density(power[1], step.outer_load[last], elastic_load),
    )


@jit_once
def _keep_peaks(step, last, densities, peaks):
    """Keep the state at the end of a step where a value is the highest in the orbit."""
    power = step.power[last]
    slip = step.outer_slip[last]
    values = (
        power[0],
        power[1],
        power[2],
        abs(slip / signed_entrainment(step.outer_speed[last], slip)),
        densities[0],
        densities[1],
    )
    for i in range(PEAKS):
        peak = peaks[i]
        if values[i] > peak.value:
            peak.value = values[i]
            peak.time = step.end
            peak.ahead = step.ahead
            write_end(step, peak.at)


@jit_once
def _raise(step, last, densities, orbit, memory):
    """Raise the highest values of the orbit, and begin anew where another one begins."""
    for i in range(2):
        if orbit != memory.orbit:
            memory.highest[0, i] = memory.highest[1, i]
            memory.highest[1, i] = 0.0
            memory.densest[0, i] = memory.densest[1, i]
            memory.densest[1, i] = 0.0
            memory.densest[2, i] = 0.0
        memory.highest[1, i] = max(memory.highest[1, i], step.power[last, i])
        memory.densest[1, i] = max(memory.densest[1, i], densities[i])
    memory.orbit = orbit


@jit_once
def _is_due(step, last, densities, memory, outer_radius, spacing):
    """True if a new sample is due, after enough way, time or change of power."""
    time = step.end - memory.time
    due = abs(step.outer_speed[last]) * time >= _TURN * spacing * outer_radius
    due = due or time > _STEPS * memory.length
    for i in range(2):
        change = abs(step.power[last, i] - memory.power[i])
        highest = max(memory.highest[0, i], memory.highest[1, i])
        due = due or change > _CHANGE * spacing * highest
        if memory.entry > 0:
            due = due or change > _CHANGE_ENTERING * spacing * memory.entering[i]
        if densities[i] > 0.5**3 * memory.densest[0, i]:
            due = due or densities[i] > (1.0 + _RISE * spacing) ** 3 * memory.densest[2, i]
    return due


@jit_once
def _remember(step, last, densities, memory):
    """Keep what decides when the next sample is due."""
    memory.count = memory.count + 1
    memory.time = step.end
    memory.length = step.end - step.start
    memory.ahead = step.ahead
    memory.under_load = 0.0
    for i in range(2):
        memory.power[i] = step.power[last, i]
        memory.densest[2, i] = max(memory.densest[2, i], densities[i])
        memory.energy[i] = 0.0
        memory.moment[i] = 0.0
        memory.rough[i] = 0.0


@jit_once
def _enter(step, last, memory, outer_radius):
    """Detect load-zone entry, grip and exit."""
    load = step.elastic_load[last]
    speed = step.outer_speed[last]
    if memory.pressed == 0.0 and load > 0.0:
        memory.entries = memory.entries + 1
        memory.since = step.start
        memory.entry = memory.entries
        memory.entering[:] = 0.0
    elif memory.entry > 0:
        slip = max(abs(step.inner_slip[last]), abs(step.outer_slip[last]))
        settled = (
            slip < _SETTLED * abs(speed)
            or abs(speed) * (step.end - memory.since) > _ENTRY * outer_radius
        )
        if settled or load <= 0.0:
            memory.entry = 0
    memory.pressed = load
    if memory.entry > 0:
        for i in range(2):
            memory.entering[i] = max(memory.entering[i], step.power[last, i])


@jit
def choose(steps, j, orbits, memories, outer_radius, spacing, samples):
    """Begin the samples that are due in a buffer of steps.

    Parameters
    ----------
    steps : ndarray of `macroslip.roller.step.STEP`, shape (n, rollers)
    j : int
        Number of the roller.
    orbits : tuple of ndarray
        Start of the window and ends of its complete orbits [s]; entries into the load zone by orbit,
        to which those of the buffer are added; and peaks by orbit, of `PEAK`, which are raised.
    memories : ndarray of `MEMORY`, shape (1,)
        State from sample to sample.
    outer_radius : float
        r~_out [m].
    spacing : float
        Changes between samples, over those of a roller on an imposed orbit [-].
    samples : ndarray of `SAMPLE`
        Room for one a step.

    Returns
    -------
    int
        Number of samples.
    """
    edges, entries, peaks = orbits
    memory = memories[0]
    count = 0
    for n in range(steps.shape[0]):
        step = steps[n, j]
        if step.start < edges[0] or step.weight[step.stages - 1] + step.weight[0] <= 0.0:
            continue
        if math.isnan(memory.time):
            memory.time = step.start
            memory.ahead = step.ahead
        middle = 0.5 * (step.start + step.end)
        last = step.stages - 1
        if step.elastic_load[last] > 0.0:
            memory.under_load += step.end - step.start
        for i in range(2):
            energy = 0.0
            for k in range(step.stages):
                energy += step.weight[k] * step.power[k, i]
                memory.rough[i] += step.weight[k] * step.rough[k, i]
            memory.energy[i] += energy
            memory.moment[i] += energy * (middle - memory.time)
        orbit = orbit_at(edges, middle, memory.orbit)
        known = memory.entries
        entering = memory.entry
        _enter(step, last, memory, outer_radius)
        # A roller that turns back passes the same sectors once more.
        changes = memory.entry != entering or step.outer_speed[last] * memory.speed < 0.0
        memory.speed = step.outer_speed[last]
        densities = _densities(step, last)
        if orbit >= 0:
            entries[orbit] += memory.entries - known
            _keep_peaks(step, last, densities, peaks[orbit])
        changes = changes or orbit != memory.orbit
        _raise(step, last, densities, orbit, memory)
        if changes or _is_due(step, last, densities, memory, outer_radius, spacing):
            sample = samples[count]
            sample.orbit = orbit
            sample.number = memory.count
            begin(sample, memory, step)
            # The step with which an entry ends belongs to it.
            if memory.entry == 0:
                sample.entry = entering
            _remember(step, last, densities, memory)
            count += 1
    return count


@jit
def begin(sample, memory, step):
    """Begin a sample at the end of a step: its state, and the energies since the one before."""
    sample.since = memory.time
    sample.time = step.end
    sample.entry = memory.entry
    sample.skewed = 0
    sample.ahead[0] = memory.ahead
    sample.ahead[1] = step.ahead
    span = step.end - memory.time
    sample.under_load = memory.under_load / span if span > 0.0 else 0.0
    for i in range(2):
        kept = memory.energy[i] * span
        sample.energy[i] = memory.energy[i]
        sample.rough[i] = memory.rough[i]
        sample.mean_time[i] = min(max(memory.moment[i] / kept, 0.0), 1.0) if kept > 0.0 else 0.5
    write_end(step, sample.at)


def joined(parts: Sequence[np.ndarray]) -> np.ndarray:
    """Samples of several arrays of `SAMPLE` in one.

    They are joined as bytes: NumPy would compare all fields of the records, array by array.
    """
    return np.concatenate([part.view(np.uint8) for part in parts]).view(SAMPLE)


def samples_of_peaks(peaks: np.ndarray) -> np.ndarray:
    """Samples without energies of the states in which a value was the highest of its orbit.

    Parameters
    ----------
    peaks : ndarray of `PEAK`, shape (orbits, PEAKS)

    Returns
    -------
    ndarray of `SAMPLE`
        With a negative number; one of peaks that coincide.
    """
    index = np.flatnonzero(peaks["value"] > 0.0)
    every = peaks.reshape(-1)
    _, first = np.unique(every["time"][index], return_index=True)
    index = index[first]
    # An index in brackets would copy the fields of records one by one.
    chosen = every.take(index)
    samples = np.zeros(index.size, SAMPLE)
    samples["orbit"] = index // PEAKS
    samples["number"] = -1
    samples["since"] = samples["time"] = chosen["time"]
    samples["ahead"] = chosen["ahead"][:, None]
    samples["at"] = chosen["at"]
    return samples
