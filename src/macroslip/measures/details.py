"""Details of the contacts: where on them energy is dissipated, and their extremes.

By stations along the roller and places of the raceways; and the largest flash temperature, power per area and slide-roll ratio
and the least film ratio in each orbit.

A contact is evaluated station by station (a look) where its power has changed, a value is a new highest one, or some way has been
travelled: at every step it would cost more than the forces. Between two looks the energies of the raceways are kept, and when
they were spent. A look spreads them over the way since the one before, as if power had passed linearly in time from how it
lay along the roller at that one to how it lies now.

The outer raceway is at rest, and the angle of a place on it is φ, from +X0 towards +Y0. The inner raceway turns with
the shaft, and the angle of a place on it is counted from where +X0 was at the first sample: φ less the shaft's angle.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.contact.flash import flash_temperature
from macroslip.contact.look_up import log_load, log_speed
from macroslip.contact.patch import Chords, Patch, chord_stress_at, fine_power, patch_power
from macroslip.contact.table import chords_for, patch_of
from macroslip.measures.totals import orbit_at
from macroslip.ring.orbit import angle_at
from macroslip.roller.forces import LOWEST_SPEED, cage_traction
from macroslip.roller.step import STEP

if TYPE_CHECKING:
    from macroslip.contact.laws import ContactLaws, RollerLaws
    from macroslip.ring.orbit import Motion
    from macroslip.roller.model import Roller

#: Sectors of a raceway, 5° each, and stations along the roller's length.
SECTORS, STATIONS = 72, 24
#: Meaning of `Details.surface_energy` by its last two positions, and of `Details.extreme` by its last.
SLIP_SIGNS = ("negative", "positive")
FILM_REGIMES = ("below 1", "1 and above")
EXTREMES = ("flash_temperature", "power_density", "slide_roll_ratio", "film_ratio")
#: A roller's contacts are looked at after a change of a raceway's power by this part of the largest looked at in its orbit, a rise
#: of its power per area, of the cage's power or of the slide-roll ratio above the highest there by this factor, and in any case
#: after this way [rad]. On 14B and 24A over 600 s, against looks at every step: extremes at the raceways are low by 0.5 % on
#: average and 18 % at most, and up to 0.5 % of the energy lies at other stations.
_CHANGE, _RISE, _TURN = 0.1, 1.03, 0.35
#: Looks from one at the quadrature's error to the next, which takes as long as a thousand others.
_FINE = 1024

#: What is kept from look to look: number of looks, orbit of the last one, its time [s] (NaN before the first) and shaft angle
#: [rad], power at the raceways then [W]; the highest values in its orbit: powers of the interfaces [W], power over load^(2/3) at the
#: raceways, and slide-roll ratio; and energy since then [J] and its moment about that time [J s] by raceway.
_MEMORY = np.dtype(
    [
        ("count", "i8"), ("orbit", "i8"), ("time", "f8"), ("angle", "f8"), ("power", "f8", (2,)), ("highest", "f8", (6,)),
        ("energy", "f8", (2,)), ("moment", "f8", (2,)),
    ]
)  # fmt: skip
#: A look: number of its step in the buffer, its orbit, time since the one before [s], shaft angles before and after [rad], energy [J]
#: of the raceways and the share of the time since the look before at which it was spent in the mean.
_LOOK = np.dtype(
    [
        ("step", "i8"), ("orbit", "i8"), ("span", "f8"), ("before", "f8"), ("after", "f8"), ("energy", "f8", (2,)),
        ("mean_time", "f8", (2,)), ("number", "i8"),
    ]
)  # fmt: skip


class Details(NamedTuple):
    """Details of one roller.

    Attributes
    ----------
    edges : ndarray, shape (orbits + 1,)
        As of `Totals` [s].
    station_energy : ndarray, shape (2, stations)
        Energy at the raceways by station along the roller [J].
    extreme : ndarray, shape (orbits, 3, 4)
        Largest flash temperature [K], power per area [W/m²] and slide-roll ratio, and least Λ, in each complete orbit.
    quadrature : ndarray, shape (2, 2)
        Of states looked at: energy by a finer quadrature, and what the one in use is off by [J].
    surface_energy : ndarray, shape (2, sectors, stations, 2, 2)
        Energy at the places of the raceways, by sign of slip and film regime [J].
    surface_density : ndarray, shape (2, sectors, stations)
        Largest power per area at the places of the raceways, mean over the contact's width [W/m²].
    along : ndarray, shape (2, stations + 1)
        Power at each station at the last look at which the raceway had load, with the sign of slip [W], and which film
        regime it was in.
    memory : ndarray of `_MEMORY`, shape (1,)
    """

    edges: np.ndarray
    station_energy: np.ndarray
    extreme: np.ndarray
    quadrature: np.ndarray
    surface_energy: np.ndarray
    surface_density: np.ndarray
    along: np.ndarray
    memory: np.ndarray


def new_details(edges: np.ndarray) -> Details:
    """Nothing yet, for orbits with these edges [s]."""
    extreme = np.zeros((edges.size - 1, 3, len(EXTREMES)))
    extreme[..., EXTREMES.index("film_ratio")] = np.inf
    memory = np.zeros(1, _MEMORY)
    memory["orbit"], memory["time"] = -1, np.nan
    return Details(
        edges=edges,
        station_energy=np.zeros((2, STATIONS)),
        extreme=extreme,
        quadrature=np.zeros((2, 2)),
        surface_energy=np.zeros((2, SECTORS, STATIONS, len(SLIP_SIGNS), len(FILM_REGIMES))),
        surface_density=np.zeros((2, SECTORS, STATIONS)),
        along=np.zeros((2, STATIONS + 1)),
        memory=memory,
    )


class Contact(NamedTuple):
    """A contact, as the functions below take it: its geometry, its oil's chords, whether these serve, and effusivity of steel."""

    patch: Patch
    chords: Chords
    chorded: bool
    roughness: float
    effusivity: float


def prepare(laws: RollerLaws) -> tuple[Contact, Contact, Contact]:
    """Inner, outer and cage contact of a roller."""

    def contact(one: ContactLaws) -> Contact:
        # Stations are along z', whichever way the roller's axis is tilted.
        patch = patch_of(one)._replace(spin_ratio=one.shape.spin_ratio)
        return Contact(patch, chords_for(one), one.fluid is not None, one.interface.roughness, one.effusivity)

    return contact(laws.inner), contact(laws.outer), contact(laws.cage)


@jit_inline
def _density(power, load):
    return power * load ** (-2.0 / 3.0) if load > 0.0 else 0.0


@jit_inline
def _is_due(step, last, memory, outer_radius):
    """Whether enough way has passed since the last look, power has changed enough, or a value is a new highest one."""
    highest, power = memory.highest, step.power[last]
    speed, slip = step.outer_speed[last], step.outer_slip[last]
    due = abs(speed) * (step.end - memory.time) >= _TURN * outer_radius
    due = due or abs(power[0] - memory.power[0]) > _CHANGE * highest[0]
    due = due or abs(power[1] - memory.power[1]) > _CHANGE * highest[1]
    due = due or power[2] > _RISE * highest[2]
    due = due or _density(power[0], step.inner_load[last]) > _RISE * highest[3]
    due = due or _density(power[1], step.outer_load[last]) > _RISE * highest[4]
    return due or abs(slip) / max(abs(speed - 0.5 * slip), LOWEST_SPEED) > _RISE * highest[5]


@jit_inline
def _remember(step, last, orbit, angle, memory):
    """Keep what the next look is decided by."""
    speed, slip = step.outer_speed[last], step.outer_slip[last]
    highest = memory.highest
    if orbit != memory.orbit:
        highest[:] = 0.0
    for i in range(3):
        highest[i] = max(highest[i], step.power[last, i])
    highest[3] = max(highest[3], _density(step.power[last, 0], step.inner_load[last]))
    highest[4] = max(highest[4], _density(step.power[last, 1], step.outer_load[last]))
    highest[5] = max(highest[5], abs(slip) / max(abs(speed - 0.5 * slip), LOWEST_SPEED))
    memory.count, memory.orbit, memory.time, memory.angle = memory.count + 1, orbit, step.end, angle
    for i in range(2):
        memory.power[i], memory.energy[i], memory.moment[i] = step.power[last, i], 0.0, 0.0


@jit
def _choose(steps, j, angles, edges, memory, outer_radius, looks):
    """Write the looks of a buffer; returns how many. `angles` are the shaft's at the ends of the steps, and at the first start."""
    found = 0
    for n in range(steps.shape[0]):
        step = steps[n, j]
        if step.start < edges[0] or step.weight[step.stages - 1] + step.weight[0] <= 0.0:
            continue
        if math.isnan(memory.time):
            memory.time, memory.angle = step.start, angles[n]
        middle = 0.5 * (step.start + step.end)
        for i in range(2):
            energy = 0.0
            for k in range(step.stages):
                energy += step.weight[k] * step.power[k, i]
            memory.energy[i] += energy
            memory.moment[i] += energy * (middle - memory.time)
        orbit, last = orbit_at(edges, middle, memory.orbit), step.stages - 1
        if orbit != memory.orbit or _is_due(step, last, memory, outer_radius):
            look, span = looks[found], step.end - memory.time
            look.step, look.orbit, look.span, look.number = n, orbit, span, memory.count
            look.before, look.after = memory.angle, angles[n + 1]
            for i in range(2):
                kept = memory.energy[i] * span
                look.energy[i] = memory.energy[i]
                look.mean_time[i] = min(max(memory.moment[i] / kept, 0.0), 1.0) if kept > 0.0 else 0.5
            _remember(step, last, orbit, angles[n + 1], memory)
            found += 1
    return found


@jit
def _spread(details, interface, way, energy, mean_time):
    """Give energy [J] to the stations, and to the places of the raceway that were passed.

    Along the roller it is in proportion to the powers of `along`; along the way, from one sector to another, it is linear,
    with the `mean_time` that it has.
    """
    powers, total = details.along[interface], 0.0
    for k in range(STATIONS):
        total += abs(powers[k])
    if total <= 0.0 or energy == 0.0:
        return
    per_power = energy / total
    for k in range(STATIONS):
        details.station_energy[interface, k] += per_power * abs(powers[k])
    growth = min(max(3.0 * (2.0 * mean_time - 1.0), -1.0), 1.0)
    start, end = min(way), max(way)
    direction, lowest = (1.0 if way[0] <= way[1] else -1.0), math.floor(start)
    count, regime = math.floor(end) - lowest + 1, int(powers[STATIONS])
    for n in range(count):
        sector, share = lowest + n, per_power
        if count > 1:
            here = (max(start, float(sector)) - start) / (end - start)
            there = (min(end, sector + 1.0) - start) / (end - start)
            share *= (there - here) * (1.0 + direction * growth * (there + here - 1.0))
        energies = details.surface_energy[interface, int(sector % SECTORS)]
        for k in range(STATIONS):
            energies[k, 1 if powers[k] > 0.0 else 0, regime] += share * abs(powers[k])


@jit_inline
def _raise(details, orbit, interface, density, ratio, film_ratio):
    if orbit >= 0:
        extreme = details.extreme[orbit, interface]
        extreme[1], extreme[2], extreme[3] = (
            max(extreme[1], density),
            max(extreme[2], ratio),
            min(extreme[3], film_ratio),
        )


@jit
def _look_along(details, interface, contact, way, orbit, load, film, share, ring_speed, slip, power):
    """Find how power lies along the roller at a loaded raceway, and raise the extremes.

    Returns
    -------
    tuple of 2 float
        Power per length [W/m] and half-width [m] of the station with the highest flash temperature.
    """
    patch, powers = contact.patch, details.along[interface]
    root = load ** (1.0 / 3.0)
    across, along, pressure = patch.across * root, patch.along * root, patch.pressure * root
    bend, spin = 0.0, 0.0
    if patch.microslip:
        bend = (ring_speed * patch.curvature_ratio - slip / patch.roller_radius) / (2.0 * patch.contour_radius)
        spin = ring_speed * patch.spin_ratio
    width = 2.0 * patch.half_length / STATIONS
    boundary = 0.75 * patch.boundary_friction * share * load / across
    hottest, flash_power, flash_width, densest, fastest = 0.0, 0.0, along, 0.0, 0.0
    start, end = min(way), max(way)
    for k in range(STATIONS):
        left = k * width - patch.half_length
        # What the ellipse covers of the station, so that the lightest contact too lies in the two middle ones.
        first, last = max(left, -across), min(left + width, across)
        if last - first < 1e-6 * width:
            powers[k] = 0.0
            continue
        station, covered = 0.5 * (first + last), (last - first) / width
        height = 1.0 - station * station / (across * across)
        local, chord = slip + station * (bend * station - spin), math.sqrt(height)
        speed, half_width = abs(local), along * chord
        per_length = 0.75 * height / across * power
        if contact.chorded:
            pull = (1.0 - share) * 2.0 * half_width * chord_stress_at(contact.chords, film, pressure * chord, speed)
            per_length = (pull + boundary * height * min(speed / patch.full_slip, 1.0)) * speed
        powers[k] = math.copysign(per_length * covered, local)
        density = per_length / (2.0 * half_width)
        # Flash temperature goes with P'/√b: where its square is the largest, it is taken.
        if per_length * density > hottest:
            hottest, flash_power, flash_width = per_length * density, per_length, half_width
        densest, fastest = max(densest, density), max(fastest, speed)
        for sector in range(math.floor(start), math.floor(end) + 1):
            place = details.surface_density[interface, int(sector % SECTORS)]
            place[k] = max(place[k], density)
    powers[STATIONS] = 1.0 if film >= contact.roughness else 0.0
    entrainment = max(abs(ring_speed - 0.5 * slip), LOWEST_SPEED)
    _raise(details, orbit, interface, densest, fastest / entrainment, film / contact.roughness)
    return flash_power, flash_width


@jit
def _look(steps, j, looks, states, contacts, start_angle, orbit_ratio, details):
    """Spread the energies of a buffer's looks and raise the extremes.

    `states` are load [N], film [m] and asperities' share of the three contacts at each look, and the power of the cage's [W], shape
    (looks, 3, 4). Returned are power per length [W/m] and half-width [m] where contacts are hottest, and the speeds of roller and
    counterpart [m/s], shape (looks, 3, 4).
    """
    hottest = np.zeros((looks.size, 3, 4))
    hottest[:, :, 1] = 1.0
    per_angle = SECTORS / (2.0 * math.pi)
    for n in range(looks.size):
        look = looks[n]
        step = steps[look.step, j]
        last = step.stages - 1
        for i in range(2):
            contact = contacts[i]
            ratio = orbit_ratio - 1.0 if i == 0 else orbit_ratio
            way = ((start_angle + ratio * look.before) * per_angle, (start_angle + ratio * look.after) * per_angle)
            load, film, share = states[n, i, 0], states[n, i, 1], states[n, i, 2]
            ring = step.inner_speed[last] if i == 0 else step.outer_speed[last]
            slip = step.inner_slip[last] if i == 0 else step.outer_slip[last]
            after, known = look.mean_time[i], details.along[i]
            total = 0.0
            for k in range(STATIONS):
                total += abs(known[k])
            if load <= 0.0 or total <= 0.0:
                # As power lay, or lies, where it is known only once.
                after = 0.0 if load <= 0.0 else 1.0
            _spread(details, i, way, (1.0 - after) * look.energy[i], look.mean_time[i])
            if load > 0.0:
                hottest[n, i, 0], hottest[n, i, 1] = _look_along(
                    details, i, contact, way, look.orbit, load, film, share, ring, slip, step.power[last, i]
                )
                hottest[n, i, 2], hottest[n, i, 3] = ring - slip, ring
                _spread(details, i, way, after * look.energy[i], look.mean_time[i])
        load = states[n, 2, 0]
        if load > 0.0:
            contact, surface = contacts[2], step.cage_speed[last]
            root = load ** (1.0 / 3.0)
            per_length = 0.75 * states[n, 2, 3] / (contact.patch.across * root)
            half_width, entrainment = contact.patch.along * root, max(0.5 * abs(surface), LOWEST_SPEED)
            hottest[n, 2, 0], hottest[n, 2, 1], hottest[n, 2, 2] = per_length, half_width, surface
            density, film = per_length / (2.0 * half_width), states[n, 2, 1]
            _raise(details, look.orbit, 2, density, abs(surface) / entrainment, film / contact.roughness)
    return hottest


@jit
def _cage_powers(body, tables, loads, speeds, found):
    """Power of the cage's contact [W] without the oil of its pocket, whose force is far larger than that of a light contact."""
    for n in range(loads.size):
        if loads[n] > 0.0:
            found[n] = abs(
                speeds[n]
                * cage_traction(body, tables, loads[n], log_load(loads[n]), speeds[n], log_speed(speeds[n]))[0]
            )


class Looker:
    """Looks at the contacts of one roller, buffer after buffer.

    Parameters
    ----------
    edges : ndarray
        Of the orbits [s].
    roller : Roller
    laws : RollerLaws
    contacts : tuple of three Contact
        From `prepare`, of these laws.
    motion : Motion
    start_angle : float
        Position φ at the first sample [rad].
    """

    def __init__(
        self, edges: np.ndarray, roller: Roller, laws: RollerLaws, contacts: Any, motion: Motion, start_angle: float
    ):
        self.details = new_details(edges)
        self._roller, self._laws, self._contacts, self._motion = roller, laws, contacts, motion
        self._start_angle = start_angle
        self._last = np.zeros((1, 1), STEP)

    def add(self, steps: np.ndarray, j: int) -> None:
        """Take up the steps of roller `j` in a buffer."""
        self._last[0, 0] = steps[-1, j]
        body, times = self._roller.body[0], np.append(steps[0, j]["start"], steps[:, j]["end"])
        angles = angle_at(self._motion, times)
        looks = np.zeros(len(steps), _LOOK)
        memory = self.details.memory[0]
        count = _choose(steps, j, angles, self.details.edges, memory, float(body["outer_radius"]), looks)
        if count:
            self._look(steps, j, looks[:count])

    def finish(self) -> None:
        """Spread what has been kept since the last look."""
        memory, end = self.details.memory[0], float(self._last["end"][0, 0])
        if memory["time"] < end:
            look = np.zeros(1, _LOOK)
            angle = angle_at(self._motion, np.array([end]))[0]
            moment = memory["moment"] / np.maximum(memory["energy"] * (end - memory["time"]), 1e-300)
            look[0] = (
                0, memory["orbit"], end - memory["time"], memory["angle"], angle, memory["energy"],
                np.clip(moment, 0.0, 1.0), 1,
            )  # fmt: skip
            self._look(self._last, 0, look)

    def _look(self, steps: np.ndarray, j: int, looks: np.ndarray) -> None:
        states, ratio = self._states(steps[looks["step"], j]), float(self._roller.body[0]["orbit_ratio"])
        hottest = _look(steps, j, looks, states, self._contacts, self._start_angle, ratio, self.details)
        steel, inside = self._contacts[0].effusivity, looks["orbit"] >= 0
        power, half_width, speed, other = np.moveaxis(hottest[inside], -1, 0)
        flash = flash_temperature(power, half_width, speed, other, steel, steel)
        np.maximum.at(self.details.extreme[..., 0], looks["orbit"][inside], flash)
        self._check_quadrature(steps[looks["step"], j], looks, states)

    def _states(self, steps: np.ndarray) -> np.ndarray:
        """Load, film, share of asperities, and power of the cage at the ends of steps."""
        at = np.arange(steps.size), steps["stages"] - 1
        found = np.zeros((steps.size, 3, 4))
        for i, (law, load, speed) in enumerate(
            (
                (self._laws.inner, steps["inner_load"][at], steps["inner_speed"][at] - 0.5 * steps["inner_slip"][at]),
                (self._laws.outer, steps["outer_load"][at], steps["outer_speed"][at] - 0.5 * steps["outer_slip"][at]),
                (self._laws.cage, np.abs(steps["cage_load"][at]), 0.5 * steps["cage_speed"][at]),
            )
        ):
            loaded = load > 0.0
            entrainment = np.maximum(np.abs(speed[loaded]), LOWEST_SPEED)
            film = law.film_thickness(load[loaded], entrainment)
            found[:, i, 0] = load
            found[loaded, i, 1] = film
            found[loaded, i, 2] = law.asperity_share(load[loaded], entrainment, film)
        power = np.zeros(steps.size)
        body, tables = self._roller.body[0], self._roller.tables
        _cage_powers(body, tables, found[:, 2, 0].copy(), np.ascontiguousarray(steps["cage_speed"][at]), power)
        found[:, 2, 3] = power
        return found

    def _check_quadrature(self, steps: np.ndarray, looks: np.ndarray, states: np.ndarray) -> None:
        """Find power by the rule in use and by a much finer one, now and then."""
        for n in np.flatnonzero(looks["number"] % _FINE == 0):
            step = steps[n]
            last = step["stages"] - 1
            for i, name in enumerate(("inner", "outer")):
                law: ContactLaws = getattr(self._laws, name)
                load, film = states[n, i, :2]
                if load <= 0.0 or not law.shape.microslip or law.fluid is None:
                    continue
                ring, slip = float(step[f"{name}_speed"][last]), float(step[f"{name}_slip"][last])
                used = patch_power(self._contacts[i].patch, self._contacts[i].chords, load, film, ring, slip)
                fine = fine_power(self._contacts[i].patch, law.fluid, load, film, ring, slip)
                self.details.quadrature[i] += looks["span"][n] * fine, looks["span"][n] * abs(used - fine)
