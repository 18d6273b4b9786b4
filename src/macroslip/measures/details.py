"""Where on the contacts energy is dissipated, and the extremes of their states.

By stations along the roller and places of the raceways, with the part of asperities and the work of
pressure times slip; the largest flash temperature, power per area and slide-roll ratio and the
least film ratio in each orbit, and while rollers enter the load zone; and how long, and for how
many passes, films were thin at which slide-roll ratio.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_evaluation, jit_inline, jit_once, uncounted
from macroslip.constants import SECTORS
from macroslip.contact.chords import FIRST_SLICE, MOST_SLICES, SLICES, chord_stresses
from macroslip.contact.look_up import in_plane, log_speed
from macroslip.contact.strips import PreparedStrips
from macroslip.elementary import exponential, logarithm
from macroslip.measures.along import (
    STATIONS,
    book_along,
    book_times,
    clear_along,
    hottest_slice,
    uncounted_contact,
    write_ellipse,
    write_powers,
)
from macroslip.measures.along_line import STRIP, strips_along, write_line
from macroslip.measures.extremes import (
    EXTREMES,
    cage_contact,
    heat_entries,
    raise_extremes,
    raise_flash,
    sample_cage,
)
from macroslip.measures.maps import MAPS, PER_ANGLE, spread
from macroslip.measures.samples import (
    MEMORY,
    PEAK,
    PEAKS,
    SAMPLE,
    begin,
    choose,
    joined,
    samples_of_peaks,
)
from macroslip.measures.totals import RACEWAYS, Batch
from macroslip.mechanics.speeds import signed_entrainment
from macroslip.ring.orbit import instant, interval_of, last_before, uncounted_motion
from macroslip.roller.step import STEP

if TYPE_CHECKING:
    from macroslip.contact.laws import PreparedLaws
    from macroslip.measures.skew import SkewMeasures
    from macroslip.ring.orbit import Motion
    from macroslip.roller.model import Roller

#: Samples from one at which the quadrature is checked to the next; that costs hundreds of others.
_FINE = 4096
#: Record of how power lies along the roller at a peak, behind those of the raceways.
_AT_PEAK = 4


@dataclass(frozen=True)
class Wanted:
    """Measures that a result asks for."""

    #: Shape (orbits + 1,). Start of the window and ends of its complete orbits [s].
    edges: np.ndarray
    highest_speed: float  #: Largest raceway speed of the history [m/s]
    #: Times of the traces [s]; a step ends at each, or with a fixed step soon after
    trace_time: np.ndarray
    details: bool  #: Whether contacts are sampled by station
    spacing: float = 1.0  #: Changes between samples, over those of a roller on an imposed orbit


class Details(NamedTuple):
    """Details of one roller, over raceway (inner, outer) or interface (inner, outer, cage)."""

    edges: np.ndarray  #: As of `Totals` [s]
    extreme: np.ndarray  #: `EXTREMES` [K, W/m², 1, 1] over complete orbit and interface
    entries: np.ndarray  #: Entries into the load zone, by orbit
    #: As `extreme`, of raceways that enter: slide-roll ratio of the middle, transient temperature
    entry_extreme: np.ndarray
    memory: np.ndarray  #: Of `MEMORY`, shape (1,)
    maps: np.ndarray  #: Of `MAPS`, shape (1,); the fields that follow are views of it
    #: Energy by raceway, sector, station, sign of slip and film regime [J]
    surface_energy: np.ndarray
    #: Largest power per area [W/m²] over raceway, sector and station, mean over the contact's width
    surface_density: np.ndarray
    surface_asperities: np.ndarray  #: Energy of asperities [J], as `surface_density`
    #: ∫∫ p |v| dA dt [J], as `surface_density`: the energy under a coefficient of friction of 1
    surface_work: np.ndarray
    surface_passes: np.ndarray  #: Passes over each sector by raceway [-], parts of a pass included
    working_load: np.ndarray  #: By raceway: ∫∫ p |v| dA dt times load [J N], and itself [J]
    #: By raceway, class of Λ and of slip: time under the rings' load times the part of the length
    #: [s]; passes
    film_slip: np.ndarray

    @property
    def station_energy(self) -> np.ndarray:
        """Energy by raceway and station along the roller [J]."""
        return self.surface_energy.sum(axis=(1, 3, 4))


def new_details(edges: np.ndarray) -> Details:
    """Empty details for orbits with these edges [s]."""
    orbits = edges.size - 1
    maps = np.zeros(1, MAPS)
    surface = maps["surface"][0]
    details = Details(
        edges=edges,
        extreme=np.zeros((orbits, 3, len(EXTREMES))),
        entries=np.zeros(orbits),
        entry_extreme=np.zeros((orbits, 2, len(EXTREMES))),
        memory=np.zeros(1, MEMORY),
        maps=maps,
        surface_energy=surface["energy"].transpose(0, 1, 4, 3, 2),
        surface_density=surface["density"],
        surface_asperities=surface["asperities"],
        surface_work=surface["work"],
        surface_passes=surface["passes"],
        working_load=maps["working_load"][0],
        film_slip=maps["film_slip"][0],
    )
    for extremes in (details.extreme, details.entry_extreme):
        extremes[..., EXTREMES.index("film_ratio")] = np.inf
    details.memory["orbit"] = -1
    details.memory["time"] = np.nan
    details.memory["pressed"] = np.nan
    return details


@jit_inline
def _over(part, total):
    """Quotient of a part and a total; 0 where the total is 0."""
    return part / total if total > 0.0 else 0.0


@jit_once
def _look_up_films(body, tables, sample):
    """Write films and asperity shares of the loaded contacts of samples."""
    at = sample.at
    planes = (body.inner.film, body.outer.film, body.cage.film)
    loads = (at.inner_load, at.outer_load, abs(at.cage_load))
    speeds = (
        at.inner_speed - 0.5 * at.inner_slip,
        at.outer_speed - 0.5 * at.outer_slip,
        0.5 * at.cage_speed,
    )
    for i in range(3):
        if loads[i] > 0.0:
            value, _, _ = in_plane(planes[i], tables, logarithm(loads[i]), log_speed(speeds[i]))
            sample.film[i] = exponential(value[0])
            sample.share[i] = value[1]


@jit_evaluation
def _raceway_state(at, i):
    """Load [N], u2 and Δu [m/s] at the inner or the outer raceway."""
    if i == 0:
        return at.inner_load, at.inner_speed, at.inner_slip
    return at.outer_load, at.outer_speed, at.outer_slip


@jit_once
def _write_slices(samples, first, strips, contact, i, slices):
    """Write the slices of a raceway at samples from the first on, as far as there is room.

    Returns the number of the sample behind the last, and that of the slice behind the last. Behind
    it there is room for as many as stations.
    """
    behind = FIRST_SLICE
    n = first
    while n < samples.size and behind + 2 * STATIONS <= MOST_SLICES:
        sample = samples[n]
        sample.touched[i, 1] = 0
        state = _raceway_state(sample.at, i)
        if state[0] > 0.0:
            # Of the two only the one that the type of the strips asks for is compiled.
            if strips is None:
                write_ellipse(contact, state, sample, i, slices, behind)
            else:
                touching = uncounted(strips)[n, i]  # pyright: ignore[reportCallIssue]
                write_line(contact, touching, state, sample, i, slices, behind)
        behind += sample.touched[i, 1]
        n += 1
    return n, behind


@jit_once
def _raise_all(sample, i, contact, highest, extremes):
    """Raise the extremes of the orbit and of entries into the load zone by a raceway's state."""
    _, speed, slip = _raceway_state(sample.at, i)
    film_ratio = sample.film[i] / contact.roughness
    mean = abs(signed_entrainment(speed, slip))
    ratio = highest.speed / mean
    speeds = speed - slip, speed
    raise_extremes(extremes[0], sample.orbit, i, highest.density, ratio, film_ratio)
    raise_flash(extremes[0], sample.orbit, i, highest.heat, speeds, contact.effusivity)
    if sample.entry > 0:
        size = abs(slip)
        if sample.skewed:
            size = math.hypot(sample.lines[i, 1], sample.lines[i, 4])
        raise_extremes(extremes[1], sample.orbit, i, highest.density, size / mean, film_ratio)


@jit_once
def _distribute(maps, i, sample, way, before, after):
    """Distribute the energies since the sample before over the maps of a raceway."""
    load = _raceway_state(sample.at, i)[0]
    # As power lay, or lies, where it is known only once.
    late = 0.0
    late_rough = 0.0
    if load > 0.0:
        late = sample.mean_time[i] if before.total > 0.0 else 1.0
        late_rough = sample.mean_time[i] if before.rough_total > 0.0 else 1.0
    half_span = 0.5 * (sample.time - sample.since)
    spent = (
        _over((1.0 - late) * sample.energy[i], before.total),
        _over(late * sample.energy[i], after.total),
        _over((1.0 - late_rough) * sample.rough[i], before.rough_total),
        _over(late_rough * sample.rough[i], after.rough_total),
        half_span,
        half_span if load > 0.0 else 0.0,
    )
    spread(maps, i, way, sample.mean_time[i], spent, before, after)
    # A peak stands beside the samples between which energies are distributed.
    if sample.number >= 0:
        work = half_span * (before.work_total + (after.work_total if load > 0.0 else 0.0))
        maps.working_load[i, 0] += work * load
        maps.working_load[i, 1] += work
        if load > 0.0:
            maps.last[i] = 1 - maps.last[i]
        else:
            before.work[:] = 0.0
            before.work_total = 0.0


@jit_once
def _book_raceway(maps, sample, i, contact, booked, way):
    """Book the slices of a raceway at a sample: maps, times, and extremes.

    `booked` are the slices, the number of the first, and the extremes.
    """
    slices, start, extremes = booked
    load, _, _ = _raceway_state(sample.at, i)
    last = maps.last[i]
    before = maps.along[2 * i + last]
    after = maps.along[_AT_PEAK if sample.number < 0 else 2 * i + 1 - last]
    if load > 0.0:
        highest = book_along(after, slices, start, sample.touched[i])
        after.regime = 1 if sample.film[i] >= contact.roughness else 0
        _raise_all(sample, i, contact, highest, extremes)
        if sample.under_load > 0.0:
            pressed = sample.under_load / STATIONS
            passes = abs(way[1] - way[0]) / SECTORS
            passed = (sample.time - sample.since) * pressed, passes * pressed
            book_times(maps.film_slip[i], slices, start, sample.touched[i, 1], passed)
    else:
        clear_along(after)
    _distribute(maps, i, sample, way, before, after)


@jit_once
def _keep_entry(entering, sample, i, slices, start):
    """Write where a raceway is hottest while a roller enters the load zone."""
    _, speed, slip = _raceway_state(sample.at, i)
    power, half_width = hottest_slice(slices, start, sample.touched[i, 1])
    first = 3 + 4 * i
    entering[first, sample.column] = power
    entering[first + 1, sample.column] = half_width
    entering[first + 2, sample.column] = speed - slip
    entering[first + 3, sample.column] = speed


@jit
def _spread_raceway(samples, strips, i, contact, way, maps, room, booked):
    """Distribute the energies of a raceway at samples over its maps, and update its extremes.

    Parameters
    ----------
    samples : ndarray of `macroslip.measures.samples.SAMPLE`
        Begun by `_begin_samples`; stations that touch are written.
    strips : ndarray of `macroslip.measures.along_line.STRIP` or None
        Those of line contacts, over sample, raceway and station; those of ellipses are None.
    i : int
        0 for the inner raceway, 1 for the outer one.
    contact : macroslip.measures.along.Contact
    way : tuple of float
        Where the roller is at the first sample of the loads [rad], and the ratio of its way on the
        raceway to the shaft's [-].
    maps : ndarray of `macroslip.measures.maps.MAPS`, shape (1,)
        Arrays of one record come from Python, which hands a record on by describing all its fields.
    room : ndarray of `macroslip.contact.chords.SLICES`, shape (1,)
        Room for slices.
    booked : tuple of ndarray
        Extremes of orbits, those of entries into the load zone, and columns for `heat_entries`.
    """
    samples = uncounted(samples)  # pyright: ignore[reportCallIssue]
    extremes = uncounted(booked[0]), uncounted(booked[1])  # pyright: ignore[reportCallIssue]
    entering = uncounted(booked[2])  # pyright: ignore[reportCallIssue]
    contact = uncounted_contact(contact)
    of_raceway = uncounted(maps)[0]  # pyright: ignore[reportCallIssue]
    slices = uncounted(room)[0]  # pyright: ignore[reportCallIssue]
    n = 0
    while n < samples.size:
        first = n
        n, behind = _write_slices(samples, first, strips, contact, i, slices)
        if contact.chorded:
            chord_stresses(contact.chords, slices, behind)
        write_powers(contact, slices, behind)
        start = FIRST_SLICE
        for m in range(first, n):
            sample = samples[m]
            passed = (
                (way[0] + way[1] * sample.turned[0] + sample.ahead[0]) * PER_ANGLE,
                (way[0] + way[1] * sample.turned[1] + sample.ahead[1]) * PER_ANGLE,
            )
            _book_raceway(of_raceway, sample, i, contact, (slices, start, extremes), passed)
            if sample.entry > 0:
                _keep_entry(entering, sample, i, slices, start)
            start += sample.touched[i, 1]


@jit
def _begin_samples(samples, roller, cage, motion, extreme, entering, columns):
    """Write films of samples and angles of the shaft, and begin columns of entries.

    The extremes of the cage's contact are updated.

    Parameters
    ----------
    samples : ndarray of `macroslip.measures.samples.SAMPLE`
        Films, shares of asperities, and angles of the shaft are written.
    roller : tuple
        Record of the roller, in an array, and address of the flat array of its tables.
    cage : macroslip.measures.extremes.CageContact
    motion : macroslip.ring.orbit.Motion
    extreme : ndarray
        Of orbits.
    entering : ndarray, shape (11, n)
        Columns for `heat_entries`.
    columns : int
        How many of them there are already.

    Returns
    -------
    int
        Number of columns.
    """
    bodies, tables = roller
    body = uncounted(bodies)[0]  # pyright: ignore[reportCallIssue]
    samples = uncounted(samples)  # pyright: ignore[reportCallIssue]
    extreme = uncounted(extreme)  # pyright: ignore[reportCallIssue]
    motion = uncounted_motion(motion)
    interval = last_before(motion.time, samples[0].since) if samples.size > 0 else 0
    for n in range(samples.size):
        sample = samples[n]
        _look_up_films(body, tables, sample)
        sample_cage(body, tables, cage, sample, extreme)
        interval = interval_of(motion, sample.since, interval)
        sample.turned[0] = instant(motion, interval, sample.since).shaft_angle
        interval = interval_of(motion, sample.time, interval)
        sample.turned[1] = instant(motion, interval, sample.time).shaft_angle
        if sample.entry > 0:
            entering[0, columns] = sample.entry
            entering[1, columns] = sample.orbit
            entering[2, columns] = sample.time
            sample.column = columns
            columns += 1
    return columns


class ContactSampler:
    """Takes samples of the contacts of one roller from buffers of its steps.

    `contacts` are those of `macroslip.measures.along.contacts_of`, of the same laws; the roller is at φ = `start_angle` at the
    first sample [rad], and has `skew` if it skews.
    """

    def __init__(
        self,
        wanted: Wanted,
        roller: Roller,
        laws: PreparedLaws,
        contacts: Any,
        motion: Motion,
        start_angle: float,
        skew: SkewMeasures | None = None,
    ):
        self.details = new_details(wanted.edges)
        self._spacing = wanted.spacing
        self._start_angle = start_angle
        self._roller = roller
        body = roller.body[0]
        self._outer_radius = float(body["outer_radius"])
        self._orbit_ratio = float(body["orbit_ratio"])
        self._laws = laws
        self._contacts = contacts
        self._cage = cage_contact(contacts[2])
        self._motion = motion
        self._skew = skew
        self._last = np.zeros(1, STEP)
        # More samples would not stay in the processor's cache from one loop to the next.
        self._samples = Batch(SAMPLE, buffers=2)
        self._peaks = np.zeros((wanted.edges.size - 1, PEAKS), PEAK)
        self._checked: list[np.ndarray] = []
        #: Columns for `heat_entries` of the entry under way.
        self._entering = np.zeros((11, 0))

    @property
    def checked(self) -> np.ndarray:
        """Samples at which the quadrature is to be checked (`macroslip.measures.quadrature`)."""
        return joined(self._checked)

    def add(self, steps: np.ndarray, j: int) -> None:
        """Process the steps of one roller in a buffer."""
        self._last = steps[-1:, j].copy()
        samples = self._samples.room(len(steps), self._sample)
        details = self.details
        orbits = details.edges, details.entries, self._peaks
        self._samples.count += choose(
            steps, j, orbits, details.memory, self._outer_radius, self._spacing, samples
        )

    def finish(self) -> None:
        """Distribute the energies since the last sample."""
        memory = self.details.memory[0]
        last = self._last[0]
        if memory["time"] < last["end"]:
            sample = self._samples.room(1, self._sample)[0]
            # Not one of those at which the quadrature is checked.
            sample["orbit"] = memory["orbit"]
            sample["number"] = 1
            begin(sample, memory, last)
            self._samples.count += 1
        self._samples.empty(self._sample)
        self._sample(samples_of_peaks(self._peaks))
        self._heat(self._entering, self._entering.shape[1], is_last=True)

    def _sample(self, samples: np.ndarray) -> None:
        """Sample the contacts."""
        if self._skew:
            self._skew.turn(samples)
        details = self.details
        under_way = self._entering.shape[1]
        entering = np.empty((self._entering.shape[0], under_way + samples.size))
        entering[:, :under_way] = self._entering
        roller = self._roller.body, self._roller.tables.ctypes.data
        count = _begin_samples(
            samples, roller, self._cage, self._motion, details.extreme, entering, under_way
        )
        strips = self._strips(samples["at"])
        room = np.empty(1, SLICES)
        booked = details.extreme, details.entry_extreme, entering
        # The inner raceway turns with the shaft.
        for i, ratio in enumerate((self._orbit_ratio - 1.0, self._orbit_ratio)):
            way = self._start_angle, ratio
            _spread_raceway(samples, strips, i, self._contacts[i], way, details.maps, room, booked)
        self._heat(entering, count, is_last=False)
        self._checked.append(samples[samples["number"] % _FINE == 0])

    def _strips(self, at: np.ndarray) -> np.ndarray | None:
        """Strips of line contacts, of `STRIP` and shape (samples, 2, STATIONS); of ellipses none."""
        laws = self._laws.inner, self._laws.outer
        if not isinstance(laws[0], PreparedStrips):
            return None
        strips = np.zeros((at.size, len(RACEWAYS), STATIONS), STRIP)
        for i, (name, law) in enumerate(zip(RACEWAYS, laws, strict=True)):
            loaded = at[f"{name}_load"] > 0.0
            state = (at[f"{name}_{field}"][loaded] for field in ("load", "speed", "slip"))
            strips[loaded, i] = strips_along(law, *state)
        return strips

    def _heat(self, entering: np.ndarray, count: int, *, is_last: bool) -> None:
        """Compute the largest temperatures of the raceways in load-zone entries that have ended."""
        steel = self._contacts[0].effusivity
        first = heat_entries(entering, count, is_last, steel, self.details.entry_extreme)
        self._entering = entering[:, first:count].copy()
