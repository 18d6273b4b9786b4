"""Details of the contacts: where on them energy is dissipated, and their extremes.

By stations along the roller and places of the raceways, with the part of asperities and the work of
pressure times slip; the largest flash temperature, power per area and slide-roll ratio and the
least film ratio in each orbit, and while rollers enter the load zone; and how long, and for how
many passes, films were thin at which slide-roll ratio.

A contact is evaluated station by station, which is called a sample (`look` in names), where its
power has changed, a value is a new highest one, or some way has been travelled: at every step it
would cost more than the forces. Between two samples the energies of the raceways are kept, and when
they were spent. A sample spreads them over the way since the one before, as if power had passed
linearly in time from how it lay along the roller at that one to how it lies now.

The outer raceway is at rest, and the angle of a place on it is φ, from +X0 towards +Y0. The inner
raceway turns with the shaft, and the angle of a place on it is counted from where +X0 was at the
first load sample: φ less the shaft's angle. A roller of a whole bearing is ahead of pure rolling,
or behind: φ is its own.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.constants import SECTORS
from macroslip.contact.flash import flash_temperature, transient_flash
from macroslip.contact.look_up import log_speed
from macroslip.contact.patch import (
    Patch,
    chord_stress_at,
    film_node,
    fine_power,
    patch_of,
    patch_power,
)
from macroslip.contact.traction import ChordTable, chord_table
from macroslip.measures.totals import END, RACEWAYS, Batch, loaded_contacts, orbit_at, write_end
from macroslip.mechanics.cage import cage_friction
from macroslip.mechanics.film_sharing import LOWEST_SPEED
from macroslip.ring.orbit import angle_at
from macroslip.roller.step import STEP

if TYPE_CHECKING:
    from macroslip.contact.laws import ContactLaws, RollerLaws
    from macroslip.measures.skew import SkewMeasures
    from macroslip.ring.orbit import Motion
    from macroslip.roller.model import Roller

#: Sectors of a raceway, 5° each, and stations along the roller's length.
STATIONS = 24
_PER_ANGLE = SECTORS / (2.0 * math.pi)
#: Meaning of `Details.surface_energy` by its last two positions, and of `Details.extreme` by its
#: last.
SLIP_SIGNS = ("negative", "positive")
FILM_REGIMES = ("below 1", "1 and above")
EXTREMES = ("flash_temperature", "power_density", "slide_roll_ratio", "film_ratio")
#: Upper edges of classes of Λ and of the slide-roll ratio (ring less roller over their mean: above
#: 0 the ring is faster).
FILM_EDGES = (0.5, 1.0, 1.5, 2.0, 3.0, 5.0)
SLIP_EDGES = (-0.1, -0.03, -0.01, -0.003, -0.001, 0.0, 0.001, 0.003, 0.01, 0.03, 0.1)
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
#: Least share of asperities by which their energy is spread along the roller: quotients of less
#: overflow.
_LEAST_SHARE = 1e-30
#: Samples from one evaluation of the quadrature's error to the next; it costs five hundred others.
_FINE = 4096

#: State from sample to sample of the contacts.
_MEMORY = np.dtype(
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
_LOOK = np.dtype(
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
#: How power lies along the roller at a raceway, at a sample.
_ALONG = np.dtype(
    [
        # Power by station, with the sign of slip [W].
        ("power", "f8", (STATIONS,)),
        # Power of asperities by station [W].
        ("rough", "f8", (STATIONS,)),
        # ∫ p |v| dA by station [W].
        ("work", "f8", (STATIONS,)),
        # Power per area by station [W/m²].
        ("density", "f8", (STATIONS,)),
        # Sum of |power| [W].
        ("total", "f8"),
        # Sum of the power of asperities [W].
        ("rough_total", "f8"),
        # Sum of ∫ p |v| dA [W].
        ("work_total", "f8"),
        # Film regime: 1 where Λ is 1 and above, 0 below.
        ("regime", "i8"),
    ]
)
_PLACES = (2, SECTORS, STATIONS)
#: Sums over the samples: the fields of `Details` of the same names. A record in place of arrays,
#: whose references would be counted at every sample.
_MAPS = np.dtype(
    [
        # Energy by raceway and station along the roller [J].
        ("station_energy", "f8", (2, STATIONS)),
        # Energy by raceway, sector, station, sign of slip and film regime [J].
        ("surface_energy", "f8", (*_PLACES, len(SLIP_SIGNS), len(FILM_REGIMES))),
        # Largest power per area by raceway, sector and station [W/m²].
        ("surface_density", "f8", _PLACES),
        # Energy of asperities by raceway, sector and station [J].
        ("surface_asperities", "f8", _PLACES),
        # ∫∫ p |v| dA dt by raceway, sector and station [J].
        ("surface_work", "f8", _PLACES),
        # Passes over each sector by raceway [-].
        ("surface_passes", "f8", (2, SECTORS)),
        # By raceway, ∫∫ p |v| dA dt times load [J N], and itself [J].
        ("working_load", "f8", (2, 2)),
        # By raceway, class of Λ and of the slide-roll ratio: time under load times the part of the
        # length [s]; passes [-].
        ("film_slip", "f8", (2, len(FILM_EDGES) + 1, len(SLIP_EDGES) + 1, 2)),
        # How power lies along the roller, two records a raceway.
        ("along", _ALONG, (4,)),
        # Which of the two, by raceway, is of the last sample with load.
        ("last", "i8", (2,)),
    ]
)


@dataclass(frozen=True)
class Wanted:
    """Measures that are wanted."""

    #: Shape (orbits + 1,). Start of the window and ends of its complete orbits [s].
    edges: np.ndarray
    highest_speed: float  #: Largest raceway speed of the history [m/s]
    #: Times of the traces [s]; a step ends at each, or with a fixed step soon after
    trace_time: np.ndarray
    details: bool  #: Whether contacts are evaluated station by station
    spacing: float = 1.0  #: Changes between samples, over those of a roller on an imposed orbit


class Details(NamedTuple):
    """Details of one roller, over raceway (inner, outer) or interface (inner, outer, cage)."""

    edges: np.ndarray  #: As of `Totals` [s]
    extreme: np.ndarray  #: `EXTREMES` [K, W/m², 1, 1] over complete orbit and interface
    #: By raceway, of some samples: energy by a finer quadrature, and what the one in use is off by
    #: [J]
    quadrature: np.ndarray
    entries: np.ndarray  #: Entries into the load zone, by orbit
    #: As `extreme`, of raceways that enter: slide-roll ratio of the middle, transient temperature
    entry_extreme: np.ndarray
    memory: np.ndarray  #: Of `_MEMORY`, shape (1,)
    maps: np.ndarray  #: Of `_MAPS`, shape (1,); its fields are those that follow
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
    maps = np.zeros(1, _MAPS)
    sizes = ((orbits, 3, len(EXTREMES)), (2, 2), orbits, (orbits, 2, len(EXTREMES)))
    views = [maps[name][0] for name in Details._fields[Details._fields.index("maps") + 1 :]]
    found = Details._make([edges, *map(np.zeros, sizes), np.zeros(1, _MEMORY), maps, *views])
    found.extreme[..., EXTREMES.index("film_ratio")] = found.entry_extreme[
        ..., EXTREMES.index("film_ratio")
    ] = np.inf
    found.memory["orbit"] = -1
    found.memory["time"] = np.nan
    found.memory["pressed"] = np.nan
    return found


class Contact(NamedTuple):
    """A contact as the functions below take it."""

    patch: Patch  #: Its geometry
    chords: ChordTable  #: Of its oil
    chorded: bool  #: Whether they serve
    limit: float  #: Kellström's coefficient of friction [-]; 0 without
    saturation: float  #: Kellström's slide-roll ratio from which on it is reached [-]
    roughness: float  #: σ_rms [m]
    effusivity: float  #: Of the steel [J/(m² K √s)]


def prepare(laws: RollerLaws) -> tuple[Contact, Contact, Contact]:
    """Inner, outer and cage contact of a roller."""

    def contact(one: ContactLaws) -> Contact:
        # Tables are made for one side; here the row's own tilt counts.
        patch = patch_of(one)._replace(spin_ratio=one.shape.spin_ratio)
        limit, saturation = one.friction or (0.0, 1.0)
        return Contact(
            patch,
            chord_table(one.fluid),
            one.fluid is not None,
            limit,
            saturation,
            one.interface.roughness,
            one.effusivity,
        )

    return contact(laws.inner), contact(laws.outer), contact(laws.cage)


@jit_inline
def _density(power, load):
    return power * load ** (-2.0 / 3.0) if load > 0.0 else 0.0


@jit_inline
def _compared(step, last):
    """The values that are compared with `highest`."""
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
        abs(slip) / max(abs(speed - 0.5 * slip), LOWEST_SPEED),
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
    """Keep the numbers that decide on the next sample."""
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
    """Notice that the rings begin to press the roller, and when it is gripped or let go again."""
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
def _choose(steps, j, edges, entries, memory, outer_radius, spacing, looks):
    """Begin the samples of a buffer; returns how many."""
    found = 0
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
            look = looks[found]
            look.orbit = orbit
            look.number = memory.count
            _begin(look, memory, step)
            _remember(step, last, orbit, memory)
            found += 1
    return found


@jit
def _begin(look, memory, step):
    """Begin a sample at the end of a step: what was kept since the one before, and the state."""
    look.since = memory.time
    look.time = step.end
    look.entry = memory.entry
    look.ahead[0] = memory.ahead
    look.ahead[1] = step.ahead
    for i in range(2):
        kept = memory.energy[i] * (step.end - memory.time)
        look.energy[i] = memory.energy[i]
        look.rough[i] = memory.rough[i]
        look.mean_time[i] = min(max(memory.moment[i] / kept, 0.0), 1.0) if kept > 0.0 else 0.5
    write_end(step, look.at)


@jit_inline
def _share(way, sector, mean_time):
    """Part of a way [sectors] in a sector, passed linearly faster or slower with the mean time."""
    start = min(way)
    end = max(way)
    if math.floor(start) == math.floor(end):
        return 1.0
    growth = min(max(3.0 * (2.0 * mean_time - 1.0), -1.0), 1.0)
    here = (max(start, float(sector)) - start) / (end - start)
    there = (min(end, sector + 1.0) - start) / (end - start)
    return (there - here) * (1.0 + (growth if way[0] <= way[1] else -growth) * (there + here - 1.0))


@jit
def _spread(maps, interface, way, mean_time, spent, before, after):
    """Give energies to the stations, and to the places of the raceway that were passed.

    They are spread as power lay at the sample before and as it lies now. Along the roller they are
    in proportion to the powers; along the way, from one sector to another, they are linear, with
    the mean time that they have. `spent` has energy [J] and energy of asperities [J] over their
    power, and the time of the work of pressure and slip [s], each before and now.
    """
    for k in range(STATIONS):
        maps.station_energy[interface, k] += spent[0] * abs(before.power[k]) + spent[1] * abs(
            after.power[k]
        )
    lowest = math.floor(min(way))
    for n in range(math.floor(max(way)) - lowest + 1):
        share = _share(way, lowest + n, mean_time)
        even = _share(way, lowest + n, 0.5)
        sector = int((lowest + n) % SECTORS)
        energy = maps.surface_energy[interface, sector]
        rough = maps.surface_asperities[interface, sector]
        work = maps.surface_work[interface, sector]
        maps.surface_passes[interface, sector] += even * abs(way[1] - way[0])
        for k in range(STATIONS):
            old = before.power[k]
            new = after.power[k]
            energy[k, 1 if old > 0.0 else 0, before.regime] += share * spent[0] * abs(old)
            energy[k, 1 if new > 0.0 else 0, after.regime] += share * spent[1] * abs(new)
            rough[k] += share * (spent[2] * before.rough[k] + spent[3] * after.rough[k])
            work[k] += even * (spent[4] * before.work[k] + spent[5] * after.work[k])


@jit_inline
def _raise(extremes, orbit, interface, density, ratio, film_ratio):
    if orbit >= 0:
        extremes[orbit, interface, 1] = max(extremes[orbit, interface, 1], density)
        extremes[orbit, interface, 2] = max(extremes[orbit, interface, 2], ratio)
        extremes[orbit, interface, 3] = min(extremes[orbit, interface, 3], film_ratio)


@jit
def _look_along(maps, interface, contact, state, look, passes, along):
    """Find how power lies along the roller at a loaded raceway, and the station that is hottest.

    `state` has load [N], u2 and slip [m/s]. Returns the largest power per area [W/m²], slip [m/s],
    and class of Λ.
    """
    patch = contact.patch
    film = look.film[interface]
    share = look.share[interface]
    power = look.at.power[interface]
    load, ring_speed, slip = state
    mean = ring_speed - 0.5 * slip
    film_class = 0
    while film_class < len(FILM_EDGES) and film >= FILM_EDGES[film_class] * contact.roughness:
        film_class += 1
    entrainment = math.copysign(max(abs(mean), LOWEST_SPEED), mean)
    pressed = look.at.elastic_load > 0.0
    root = load ** (1.0 / 3.0)
    across = patch.across * root
    half_along = patch.along * root
    pressure = patch.pressure * root
    line = look.lines[interface]
    middle = line[0]
    v0 = line[1]
    v1 = line[2]
    v2 = line[3]
    w0 = line[4]
    w1 = line[5]
    w2 = line[6]
    width = 2.0 * patch.half_length / STATIONS
    node = film_node(contact.chords, film)
    boundary = 0.75 * patch.boundary_friction * max(share, _LEAST_SHARE) * load / across
    hot = look.hot[interface]
    hottest = 0.0
    densest = 0.0
    fastest = 0.0
    along.total = 0.0
    along.rough_total = 0.0
    along.work_total = 0.0
    for k in range(STATIONS):
        left = k * width - patch.half_length
        # The part of the station under the ellipse, so that the lightest contact too lies in the
        # two middle ones.
        first = max(left, middle - across)
        last = min(left + width, middle + across)
        if last - first < 1e-6 * width:
            along.power[k] = along.rough[k] = along.work[k] = along.density[k] = 0.0
            continue
        station = 0.5 * (first + last)
        covered = (last - first) / width
        height = 1.0 - (station - middle) * (station - middle) / (across * across)
        local = v0 + station * (v2 * station + v1)
        chord = math.sqrt(height)
        speed = math.hypot(local, w0 + station * (w2 * station + w1))
        half_width = half_along * chord
        per_length = 0.75 * height / across * power
        asperities = boundary * height * min(speed / patch.full_slip, 1.0) * speed
        if contact.chorded:
            pull = (
                (1.0 - share)
                * 2.0
                * half_width
                * chord_stress_at(contact.chords, node, pressure * chord, speed)
            )
            per_length = pull * speed + asperities
        elif contact.limit > 0.0:
            full = contact.saturation * abs(entrainment)
            coefficient = (1.0 - share) * contact.limit * min(speed / full, 1.0)
            per_length = 0.75 * height / across * load * coefficient * speed + asperities
        # Of power only its share of all stations counts; of p |v| its size does.
        along.power[k] = math.copysign(per_length * covered, local)
        along.rough[k] = asperities * covered
        along.work[k] = 0.75 * height / across * load * speed * covered * width
        along.total += abs(along.power[k])
        along.rough_total += along.rough[k]
        along.work_total += along.work[k]
        if pressed:
            slip_class = 0
            ratio = math.copysign(speed, local) / entrainment
            while slip_class < len(SLIP_EDGES) and ratio >= SLIP_EDGES[slip_class]:
                slip_class += 1
            maps.film_slip[interface, film_class, slip_class, 0] += (
                (look.time - look.since) * covered / STATIONS
            )
            maps.film_slip[interface, film_class, slip_class, 1] += passes * covered / STATIONS
        density = along.density[k] = per_length / (2.0 * half_width)
        # Flash temperature goes with P'/√b: where its square is the largest, it is taken.
        if per_length * density > hottest:
            hottest = per_length * density
            hot[0] = per_length
            hot[1] = half_width
        densest = max(densest, density)
        fastest = max(fastest, speed)
    along.regime = 1 if film >= contact.roughness else 0
    return densest, fastest, abs(entrainment)


@jit
def _look(looks, contacts, roller, start_angle, maps, extreme, entry_extreme):
    """Spread the energies of samples and raise the extremes.

    What is hottest is written to the samples.
    """
    body, tables = roller
    for n in range(looks.size):
        look = looks[n]
        at = look.at
        span = look.time - look.since
        states = (
            (at.inner_load, at.inner_speed, at.inner_slip),
            (at.outer_load, at.outer_speed, at.outer_slip),
        )
        for i in range(2):
            ratio = body.orbit_ratio - (1.0 if i == 0 else 0.0)
            load = states[i][0]
            start = (start_angle + ratio * look.turned[0] + look.ahead[0]) * _PER_ANGLE
            end = (start_angle + ratio * look.turned[1] + look.ahead[1]) * _PER_ANGLE
            hot = look.hot[i]
            last = maps.last[i]
            hot[0] = 0.0
            hot[1] = 1.0
            hot[2] = states[i][1] - states[i][2]
            hot[3] = states[i][1]
            before = maps.along[2 * i + last]
            after = maps.along[2 * i + 1 - last]
            # As power lay, or lies, where it is known only once.
            late = 0.0
            late_rough = 0.0
            if load > 0.0:
                densest, fastest, mean = _look_along(
                    maps, i, contacts[i], states[i], look, abs(end - start) / SECTORS, after
                )
                film_ratio = look.film[i] / contacts[i].roughness
                _raise(extreme, look.orbit, i, densest, fastest / mean, film_ratio)
                if look.entry > 0:
                    slip = math.hypot(look.lines[i, 1], look.lines[i, 4])
                    _raise(entry_extreme, look.orbit, i, densest, slip / mean, film_ratio)
                for sector in range(math.floor(min(start, end)), math.floor(max(start, end)) + 1):
                    place = maps.surface_density[i, int(sector % SECTORS)]
                    for k in range(STATIONS):
                        place[k] = max(place[k], after.density[k])
                late = look.mean_time[i] if before.total > 0.0 else 1.0
                late_rough = look.mean_time[i] if before.rough_total > 0.0 else 1.0
            spent = (
                (1.0 - late) * look.energy[i] / before.total if before.total > 0.0 else 0.0,
                late * look.energy[i] / after.total if late > 0.0 and after.total > 0.0 else 0.0,
                (1.0 - late_rough) * look.rough[i] / before.rough_total
                if before.rough_total > 0.0
                else 0.0,
                late_rough * look.rough[i] / after.rough_total
                if late_rough > 0.0 and after.rough_total > 0.0
                else 0.0,
                0.5 * span,
                0.5 * span if load > 0.0 else 0.0,
            )
            _spread(maps, i, (start, end), look.mean_time[i], spent, before, after)
            work = 0.5 * span * (before.work_total + (after.work_total if load > 0.0 else 0.0))
            maps.working_load[i, 0] += work * load
            maps.working_load[i, 1] += work
            if load > 0.0:
                maps.last[i] = 1 - last
            else:
                before.work[:] = 0.0
                before.work_total = 0.0
        _look_at_cage(body, tables, contacts[2], look, extreme)


@jit_inline
def _look_at_cage(body, tables, contact, look, extreme):
    """Find power and extremes of the cage's contact, without the oil of its pocket.

    The force of that oil is far larger than the force of a light contact.
    """
    hot = look.hot[2]
    surface = look.at.cage_speed
    load = abs(look.at.cage_load)
    hot[0] = 0.0
    hot[1] = 1.0
    hot[2] = surface
    hot[3] = 0.0
    if load > 0.0:
        root = load ** (1.0 / 3.0)
        force = cage_friction(body, tables, load, surface, log_speed(surface)).force
        hot[0] = 0.75 * abs(surface * force) / (contact.patch.across * root)
        hot[1] = contact.patch.along * root
        ratio = abs(surface) / max(0.5 * abs(surface), LOWEST_SPEED)
        _raise(
            extreme, look.orbit, 2, hot[0] / (2.0 * hot[1]), ratio, look.film[2] / contact.roughness
        )


def _heat_entries(rows: np.ndarray, effusivity: float, extreme: np.ndarray) -> None:
    """Raise the temperatures of entries to the load zone [K].

    Rows have entry, orbit, time [s] and, by raceway, what is hottest as `_LOOK` has it.
    """
    columns = np.ascontiguousarray(rows.T)
    edges = np.flatnonzero(np.diff(columns[0], prepend=0.0, append=0.0))
    for first, last in itertools.pairwise(edges):
        orbit = int(columns[1, first])
        if orbit < 0:
            continue
        for i in range(2):
            band = (columns[3 + 4 * i + k, first:last] for k in range(4))
            rise = transient_flash(columns[2, first:last], *band, effusivity, effusivity)
            extreme[orbit, i, 0] = max(extreme[orbit, i, 0], rise)


class Looker:
    """Samples of the contacts of one roller, taken buffer after buffer.

    `contacts` are those of `prepare`, of the same laws; the roller is at φ = `start_angle` at the
    first sample [rad], and has `skew` if it skews.
    """

    def __init__(
        self,
        wanted: Wanted,
        roller: Roller,
        laws: RollerLaws,
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
        self._looks = Batch(_LOOK)
        #: Rows for `_heat_entries` of the entry under way.
        self._entering = np.zeros((0, 11))

    def add(self, steps: np.ndarray, j: int) -> None:
        """Take up the steps of roller `j` in a buffer."""
        self._last = steps[-1:, j].copy()
        looks = self._looks.room(len(steps), self._look)
        memory = self.details.memory[0]
        radius = float(self._roller.body[0]["outer_radius"])
        found = self.details
        self._looks.count += _choose(
            steps, j, found.edges, found.entries, memory, radius, self._spacing, looks
        )

    def finish(self) -> None:
        """Spread what has been kept since the last sample."""
        memory = self.details.memory[0]
        last = self._last[0]
        if memory["time"] < last["end"]:
            look = self._looks.room(1, self._look)[0]
            # Not one of those at which the quadrature is checked.
            look["orbit"] = memory["orbit"]
            look["number"] = 1
            _begin(look, memory, last)
            self._looks.count += 1
        self._looks.empty(self._look)
        self._heat(self._entering)

    def _look(self, looks: np.ndarray) -> None:
        """Sample the contacts."""
        for i, (law, load, entrainment) in enumerate(loaded_contacts(looks["at"], self._laws)):
            loaded = load > 0.0
            film = law.film_thickness(load[loaded], entrainment[loaded])
            looks["film"][loaded, i] = film
            looks["share"][loaded, i] = law.asperity_share(load[loaded], entrainment[loaded], film)
        lines = looks["lines"]
        lines[...] = 0.0
        for i, name in enumerate(RACEWAYS):
            patch = self._contacts[i].patch
            speed = looks["at"][f"{name}_speed"]
            slip = looks["at"][f"{name}_slip"]
            lines[:, i, 1] = slip
            lines[:, i, 2] = -speed * patch.spin_ratio
            if patch.microslip:
                fall = speed * patch.curvature_ratio - slip / patch.roller_radius
                lines[:, i, 3] = fall / (2.0 * patch.contour_radius)
        if self._skew:
            self._skew.turn(looks)
        looks["turned"] = angle_at(self._motion, np.stack([looks["since"], looks["time"]], axis=1))
        found = self.details
        steel = self._contacts[0].effusivity
        roller = self._roller.body[0], self._roller.tables.ctypes.data
        _look(
            looks,
            self._contacts,
            roller,
            self._start_angle,
            found.maps[0],
            found.extreme,
            found.entry_extreme,
        )
        inside = looks["orbit"] >= 0
        power, half, own, other = np.moveaxis(looks["hot"][inside], -1, 0)
        flash = flash_temperature(power, half, own, other, steel, steel)
        np.maximum.at(found.extreme[..., 0], looks["orbit"][inside], flash)
        entering = looks[looks["entry"] > 0]
        columns = [entering[name] for name in ("entry", "orbit", "time")]
        rows = np.concatenate(
            [self._entering, np.column_stack([*columns, entering["hot"][:, :2].reshape(-1, 8)])]
        )
        under_way = int(np.searchsorted(rows[:, 0], rows[-1, 0])) if rows.size else 0
        self._heat(rows[:under_way])
        self._entering = rows[under_way:]
        self._check_quadrature(looks)

    def _heat(self, rows: np.ndarray) -> None:
        """Find how hot the raceways became in entries that have ended."""
        _heat_entries(rows, self._contacts[0].effusivity, self.details.entry_extreme)

    def _check_quadrature(self, looks: np.ndarray) -> None:
        """Find power by the rule in use and by a much finer one, now and then."""
        for look in looks[looks["number"] % _FINE == 0]:
            for i, name in enumerate(RACEWAYS):
                law: ContactLaws = getattr(self._laws, name)
                load, ring_speed, slip = (
                    float(look["at"][f"{name}_{one}"]) for one in ("load", "speed", "slip")
                )
                if load <= 0.0 or not law.shape.microslip or law.fluid is None:
                    continue
                state = (load, float(look["film"][i]), ring_speed, slip)
                span = look["time"] - look["since"]
                used = patch_power(self._contacts[i].patch, self._contacts[i].chords, *state)
                fine = fine_power(self._contacts[i].patch, law.fluid, *state)
                self.details.quadrature[i] += span * fine, span * abs(used - fine)
