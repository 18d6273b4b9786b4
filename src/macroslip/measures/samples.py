"""Samples of the contacts of a roller: when they are taken, and their record.

A sample is an evaluation of a contact by station. It is taken where its power has changed, a
value is a new highest one, or some way has been travelled: at every step it would cost more than
the forces. Between two samples the energies of the raceways are kept, and when they were spent.
"""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.measures.totals import END, orbit_at, write_end
from macroslip.mechanics.speeds import signed_entrainment

#: A roller that the rings begin to press enters the load zone until its middle slips by less than
#: this part of the speed, or for this way [rad].
_SETTLED = 0.01
_ENTRY = 0.35
#: A roller's contacts are sampled after a change of a raceway's power by this part of the largest
#: sample in its orbit, a rise of its power per area, of the cage's power or of the slide-roll ratio
#: above the highest there by this part, and in any case after this way [rad]. On 14B and 24A over
#: 600 s, against samples at every step: extremes at the raceways are low by 0.5 % on average and
#: 18 % at most, and up to 0.5 % of the energy lies at other stations.
_CHANGE = 0.1
_RISE = 0.03
_TURN = 0.35

#: State from sample to sample of the contacts.
MEMORY = np.dtype(
    [
        # Number of samples.
        ("count", "i8"),
        # Orbit of the last sample.
        ("orbit", "i8"),
        # Time of the last sample [s]; NaN before the first.
        ("time", "f8"),
        # Angle of the roller ahead of pure rolling at the last sample [rad].
        ("ahead", "f8"),
        # Power at the raceways at the last sample [W].
        ("power", "f8", (2,)),
        # Highest values in the orbit: powers of the three interfaces [W], power over load^(2/3) at
        # both raceways [W/N^(2/3)], and slide-roll ratio [-].
        ("highest", "f8", (6,)),
        # Energy since the last sample by raceway [J].
        ("energy", "f8", (2,)),
        # Moment of that energy about the time of the last sample [J s].
        ("moment", "f8", (2,)),
        # Part of asperities in that energy [J].
        ("rough", "f8", (2,)),
        # Elastic load at the end of the last step [N]; NaN before the first.
        ("pressed", "f8"),
        # Number of the entry into the load zone under way; 0 for none.
        ("entry", "i8"),
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
        # Angles of the shaft at both times [rad].
        ("turned", "f8", (2,)),
        # Energy since the sample before by raceway [J].
        ("energy", "f8", (2,)),
        # Part of the time since then at which that energy was spent in the mean, by raceway [-].
        ("mean_time", "f8", (2,)),
        # Part of asperities in that energy [J].
        ("rough", "f8", (2,)),
        # State at the sample.
        ("at", END),
        # Film thickness by interface [m].
        ("film", "f8", (3,)),
        # Asperities' share of the load by interface [-].
        ("share", "f8", (3,)),
        # By raceway, the middle of the ellipse along the roller [m] and the six numbers of
        # `contact.skewed.SlipLines`, of which a straight roller has three.
        ("lines", "f8", (2, 7)),
        # By interface where it is hottest, found by `_look`: power per length [W/m], half-width
        # [m], and speeds of roller and counterpart [m/s].
        ("hot", "f8", (3, 4)),
    ]
)


@jit_inline
def _density(power, load):
    return power * load ** (-2.0 / 3.0) if load > 0.0 else 0.0


@jit_inline
def _compared(step, last):
    """Values of a step that decide whether a new sample is due."""
    power = step.power[last]
    speed = step.outer_speed[last]
    slip = step.outer_slip[last]
    inner = _density(power[0], step.inner_load[last])
    outer = _density(power[1], step.outer_load[last])
    return (
        power[0],
        power[1],
        power[2],
        inner,
        outer,
        abs(slip / signed_entrainment(speed, slip)),
    )


@jit_inline
def _is_due(step, last, memory, outer_radius, spacing):
    """True if a new sample is due.

    It is after enough way, enough change of power, or at a new highest value.
    """
    highest = memory.highest
    values = _compared(step, last)
    change = _CHANGE * spacing
    rise = 1.0 + _RISE * spacing
    due = abs(step.outer_speed[last]) * (step.end - memory.time) >= _TURN * spacing * outer_radius
    for i in range(2):
        due = due or abs(values[i] - memory.power[i]) > change * highest[i]
    for i in range(2, 6):
        due = due or values[i] > rise * highest[i]
    return due


@jit_inline
def _remember(step, last, orbit, memory):
    """Keep the values that decide when the next sample is due."""
    values = _compared(step, last)
    highest = memory.highest
    if orbit != memory.orbit:
        highest[:] = 0.0
    for i in range(6):
        highest[i] = max(highest[i], values[i])
    memory.count = memory.count + 1
    memory.orbit = orbit
    memory.time = step.end
    memory.ahead = step.ahead
    for i in range(2):
        memory.power[i] = values[i]
        memory.energy[i] = 0.0
        memory.moment[i] = 0.0
        memory.rough[i] = 0.0


@jit_inline
def _enter(step, last, memory, outer_radius):
    """Detect load-zone entry, grip and exit."""
    load = step.elastic_load[last]
    speed = step.outer_speed[last]
    if memory.pressed == 0.0 and load > 0.0:
        memory.entries = memory.entries + 1
        memory.since = step.start
        memory.entry = memory.entries
    elif memory.entry > 0:
        slip = max(abs(step.inner_slip[last]), abs(step.outer_slip[last]))
        settled = (
            slip < _SETTLED * abs(speed)
            or abs(speed) * (step.end - memory.since) > _ENTRY * outer_radius
        )
        if settled or load <= 0.0:
            memory.entry = 0
    memory.pressed = load


@jit
def choose(steps, j, edges, entries, memory, outer_radius, spacing, samples):
    """Begin the samples that are due in a buffer of steps.

    Parameters
    ----------
    steps : ndarray of `macroslip.roller.step.STEP`, shape (n, rollers)
    j : int
        Number of the roller.
    edges : ndarray
        Start of the window and ends of its complete orbits [s].
    entries : ndarray
        Entries into the load zone by orbit; those of the buffer are added.
    memory : record of `MEMORY`
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
    count = 0
    for n in range(steps.shape[0]):
        step = steps[n, j]
        if step.start < edges[0] or step.weight[step.stages - 1] + step.weight[0] <= 0.0:
            continue
        if math.isnan(memory.time):
            memory.time = step.start
            memory.ahead = step.ahead
        middle = 0.5 * (step.start + step.end)
        for i in range(2):
            energy = 0.0
            for k in range(step.stages):
                energy += step.weight[k] * step.power[k, i]
                memory.rough[i] += step.weight[k] * step.rough[k, i]
            memory.energy[i] += energy
            memory.moment[i] += energy * (middle - memory.time)
        orbit = orbit_at(edges, middle, memory.orbit)
        last = step.stages - 1
        known = memory.entries
        _enter(step, last, memory, outer_radius)
        if orbit >= 0:
            entries[orbit] += memory.entries - known
        # While a roller enters, at every step.
        if (
            memory.entry > 0
            or orbit != memory.orbit
            or _is_due(step, last, memory, outer_radius, spacing)
        ):
            sample = samples[count]
            sample.orbit = orbit
            sample.number = memory.count
            begin(sample, memory, step)
            _remember(step, last, orbit, memory)
            count += 1
    return count


@jit
def begin(sample, memory, step):
    """Begin a sample at the end of a step: its state, and the energies since the one before."""
    sample.since = memory.time
    sample.time = step.end
    sample.entry = memory.entry
    sample.ahead[0] = memory.ahead
    sample.ahead[1] = step.ahead
    for i in range(2):
        kept = memory.energy[i] * (step.end - memory.time)
        sample.energy[i] = memory.energy[i]
        sample.rough[i] = memory.rough[i]
        sample.mean_time[i] = min(max(memory.moment[i] / kept, 0.0), 1.0) if kept > 0.0 else 0.5
    write_end(step, sample.at)
