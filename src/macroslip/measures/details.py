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
from macroslip.contact.flash import flash_temperature
from macroslip.contact.look_up import in_plane, log_speed
from macroslip.contact.strips import PreparedStrips
from macroslip.elementary import exponential, logarithm
from macroslip.measures.along import STATIONS, power_along, uncounted_contact
from macroslip.measures.along_line import STRIP, line_power_along, strips_along
from macroslip.measures.extremes import EXTREMES, heat_entries, raise_extremes, sample_cage
from macroslip.measures.maps import MAPS, PER_ANGLE, spread
from macroslip.measures.samples import (
    MEMORY,
    PEAK,
    PEAKS,
    SAMPLE,
    begin,
    choose,
    samples_of_peaks,
)
from macroslip.measures.totals import RACEWAYS, Batch
from macroslip.ring.orbit import angle_at
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
    maps: np.ndarray  #: Of `MAPS`, shape (1,); its fields are those that follow
    station_energy: np.ndarray  #: Energy by raceway and station along the roller [J]
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


def new_details(edges: np.ndarray) -> Details:
    """Empty details for orbits with these edges [s]."""
    orbits = edges.size - 1
    maps = np.zeros(1, MAPS)
    sizes = ((orbits, 3, len(EXTREMES)), orbits, (orbits, 2, len(EXTREMES)))
    views = [maps[name][0] for name in Details._fields[Details._fields.index("maps") + 1 :]]
    details = Details._make([edges, *map(np.zeros, sizes), np.zeros(1, MEMORY), maps, *views])
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
def _clear(sample, i):
    """Write the speeds of a raceway's surfaces to what is hottest of a sample, and no power."""
    _, speed, slip = _raceway_state(sample.at, i)
    hot = sample.hot[i]
    hot[0] = 0.0
    hot[1] = 0.0
    hot[2] = speed - slip
    hot[3] = speed


@jit_once
def _raise_all(sample, i, contact, most, extremes):
    """Raise the extremes of the orbit and of entries into the load zone by a raceway's state.

    `most` is what `power_along` gives.
    """
    densest, fastest, mean = most
    film_ratio = sample.film[i] / contact.roughness
    raise_extremes(extremes[0], sample.orbit, i, densest, fastest / mean, film_ratio)
    if sample.entry > 0:
        slip = math.hypot(sample.lines[i, 1], sample.lines[i, 4])
        raise_extremes(extremes[1], sample.orbit, i, densest, slip / mean, film_ratio)


@jit_once
def _raise_density(maps, i, places, along):
    """Raise the largest power per area of the sectors that a raceway's contact has passed."""
    start, end = places
    for sector in range(math.floor(min(start, end)), math.floor(max(start, end)) + 1):
        of_sector = maps.surface_density[i, int(sector % SECTORS)]
        for k in range(STATIONS):
            of_sector[k] = max(of_sector[k], along.density[k])


@jit_once
def _distribute(maps, i, sample, places, before, after):
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
    spread(maps, i, places, sample.mean_time[i], spent, before, after)
    work = half_span * (before.work_total + (after.work_total if load > 0.0 else 0.0))
    maps.working_load[i, 0] += work * load
    maps.working_load[i, 1] += work
    if load > 0.0:
        maps.last[i] = 1 - maps.last[i]
    else:
        before.work[:] = 0.0
        before.work_total = 0.0


@jit
def _spread_samples(samples, strips, contacts, roller, start_angle, maps, extreme, entry_extreme):
    """Distribute the energies of samples over the maps, and update the extremes.

    What is hottest is written to the samples. Strips are those of line contacts, over sample,
    raceway and station; those of ellipses are None.
    """
    body, tables = roller
    samples = uncounted(samples)  # pyright: ignore[reportCallIssue]
    extremes = uncounted(extreme), uncounted(entry_extreme)  # pyright: ignore[reportCallIssue]
    inner, outer = uncounted_contact(contacts[0]), uncounted_contact(contacts[1])
    for n in range(samples.size):
        sample = samples[n]
        _look_up_films(body, tables, sample)
        for i in range(2):
            ratio = body.orbit_ratio - (1.0 if i == 0 else 0.0)
            places = (
                (start_angle + ratio * sample.turned[0] + sample.ahead[0]) * PER_ANGLE,
                (start_angle + ratio * sample.turned[1] + sample.ahead[1]) * PER_ANGLE,
            )
            last = maps.last[i]
            # A peak stands beside the samples between which energies are distributed.
            is_peak = sample.number < 0
            after = maps.along[_AT_PEAK if is_peak else 2 * i + 1 - last]
            _clear(sample, i)
            state = _raceway_state(sample.at, i)
            if state[0] > 0.0:
                contact = inner if i == 0 else outer
                passes = abs(places[1] - places[0]) / SECTORS
                # Of the two only the one that the type of the strips asks for is compiled.
                if strips is None:
                    most = power_along(maps, i, contact, state, sample, passes, after)
                else:
                    touching = uncounted(strips)[n, i]  # pyright: ignore[reportCallIssue]
                    most = line_power_along(
                        maps, i, contact, state, sample, passes, touching, after
                    )
                _raise_all(sample, i, contact, most, extremes)
                _raise_density(maps, i, places, after)
            if not is_peak:
                before = maps.along[2 * i + last]
                _distribute(maps, i, sample, places, before, after)
        sample_cage(body, tables, contacts[2], sample, extremes[0])


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
        self._laws = laws
        self._contacts = contacts
        self._motion = motion
        self._skew = skew
        self._last = np.zeros(1, STEP)
        self._samples = Batch(SAMPLE)
        self._peaks = np.zeros((wanted.edges.size - 1, PEAKS), PEAK)
        self._checked: list[np.ndarray] = []
        #: Rows for `heat_entries` of the entry under way.
        self._entering = np.zeros((0, 11))

    @property
    def checked(self) -> np.ndarray:
        """Samples at which the quadrature is to be checked (`macroslip.measures.quadrature`)."""
        return np.concatenate(self._checked)

    def add(self, steps: np.ndarray, j: int) -> None:
        """Process the steps of one roller in a buffer."""
        self._last = steps[-1:, j].copy()
        samples = self._samples.room(len(steps), self._sample)
        memory = self.details.memory[0]
        radius = float(self._roller.body[0]["outer_radius"])
        details = self.details
        orbits = details.edges, details.entries, self._peaks
        self._samples.count += choose(steps, j, orbits, memory, radius, self._spacing, samples)

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
        self._heat(self._entering)

    def _sample(self, samples: np.ndarray) -> None:
        """Sample the contacts."""
        lines = samples["lines"]
        lines[...] = 0.0
        for i, name in enumerate(RACEWAYS):
            patch = self._contacts[i].patch
            speed = samples["at"][f"{name}_speed"]
            slip = samples["at"][f"{name}_slip"]
            lines[:, i, 1] = slip
            lines[:, i, 2] = -speed * patch.spin_ratio
            if patch.microslip:
                fall = speed * patch.curvature_ratio - slip / patch.roller_radius
                lines[:, i, 3] = fall / (2.0 * patch.contour_radius)
        if self._skew:
            self._skew.turn(samples)
        samples["turned"] = angle_at(
            self._motion, np.stack([samples["since"], samples["time"]], axis=1)
        )
        details = self.details
        steel = self._contacts[0].effusivity
        roller = self._roller.body[0], self._roller.tables.ctypes.data
        _spread_samples(
            samples,
            self._strips(samples["at"]),
            self._contacts,
            roller,
            self._start_angle,
            details.maps[0],
            details.extreme,
            details.entry_extreme,
        )
        inside = samples["orbit"] >= 0
        power, half, own, other = np.moveaxis(samples["hot"][inside], -1, 0)
        flash = flash_temperature(power, half, own, other, steel, steel)
        np.maximum.at(details.extreme[..., 0], samples["orbit"][inside], flash)
        entering = samples[samples["entry"] > 0]
        columns = [entering[name] for name in ("entry", "orbit", "time")]
        rows = np.concatenate(
            [self._entering, np.column_stack([*columns, entering["hot"][:, :2].reshape(-1, 8)])]
        )
        under_way = int(np.searchsorted(rows[:, 0], rows[-1, 0])) if rows.size else 0
        self._heat(rows[:under_way])
        self._entering = rows[under_way:]
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

    def _heat(self, rows: np.ndarray) -> None:
        """Compute the largest temperatures of the raceways in finished load-zone entries."""
        columns = np.ascontiguousarray(rows.T)
        heat_entries(columns, self._contacts[0].effusivity, self.details.entry_extreme)
