"""Distribution of frictional power along a roller at a raceway, by station."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_evaluation, jit_inline, jit_once, uncounted
from macroslip.contact.chords import chord_stresses, film_node
from macroslip.contact.patch import Patch, patch_of
from macroslip.contact.traction import ChordTable, chord_table
from macroslip.elementary import exponential, logarithm
from macroslip.mechanics.speeds import signed_entrainment

if TYPE_CHECKING:
    from macroslip.contact.laws import PreparedContact, PreparedLaws

#: Stations along the roller's length.
STATIONS = 24
#: Upper edges of classes of Λ and of the slide-roll ratio (ring less roller over their mean: above
#: 0 the ring is faster).
FILM_EDGES = (0.5, 1.0, 1.5, 2.0, 3.0, 5.0)
SLIP_EDGES = (-0.1, -0.03, -0.01, -0.003, -0.001, 0.0, 0.001, 0.003, 0.01, 0.03, 0.1)
#: Least share of asperities by which their energy is spread along the roller: quotients of less
#: overflow.
LEAST_SHARE = 1e-30
#: How power lies along the roller at a raceway, at a sample.
ALONG = np.dtype(
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
        # First station in contact, and the one behind the last.
        ("first", "i8"),
        ("behind", "i8"),
    ]
)


class Contact(NamedTuple):
    """A contact's numbers as compiled functions of samples take them."""

    patch: Patch  #: Geometry
    chords: ChordTable  #: Stresses of its oil
    chorded: bool  #: Whether these serve
    limit: float  #: Kellström's coefficient of friction [-]; 0 without
    saturation: float  #: Kellström's slide-roll ratio from which on it is reached [-]
    roughness: float  #: Composite RMS roughness [m]
    effusivity: float  #: Thermal effusivity of its steel [J/(m² K s^½)]


def contacts_of(laws: PreparedLaws) -> tuple[Contact, Contact, Contact]:
    """Inner, outer and cage contact of a roller."""

    def contact(law: PreparedContact) -> Contact:
        # Tables are made for one side; here the row's own tilt counts.
        patch = patch_of(law)._replace(spin_ratio=law.shape.spin_ratio)
        limit, saturation = law.friction or (0.0, 1.0)
        return Contact(
            patch,
            chord_table(law.fluid),
            law.fluid is not None,
            limit,
            saturation,
            law.interface.roughness,
            law.effusivity,
        )

    return contact(laws.inner), contact(laws.outer), contact(laws.cage)


@jit_inline
def uncounted_contact(contact):
    """A contact for a call during which the caller keeps it: references to its table are not counted."""
    chords = contact.chords
    table = ChordTable(
        chords.fluid,
        chords.shape,
        uncounted(chords.coefficients),  # pyright: ignore[reportCallIssue]
        uncounted(chords.log_viscosities),  # pyright: ignore[reportCallIssue]
        chords.per_root,
        chords.per_log_slip,
        chords.per_log_film,
        chords.lowest_film,
    )
    return Contact(
        contact.patch,
        table,
        contact.chorded,
        contact.limit,
        contact.saturation,
        contact.roughness,
        contact.effusivity,
    )


@jit_inline
def class_of(edges, value):
    """Index of the class that holds a value: the number of rising edges at or below it."""
    number = 0
    for edge in edges:
        # A sum in place of a search: the processor could not foresee where that ends.
        number += 1 if value >= edge else 0
    return number


@jit_inline
def _parabola(line, first, station):
    """Value at a station [m] of the parabola whose coefficients stand from `first` on."""
    return line[first] + station * (line[first + 2] * station + line[first + 1])


@jit_once
def _saturating_friction(contact, slip, entrainment):
    """Kellström's coefficient of friction at a slip and an entrainment speed [m/s]."""
    return contact.limit * min(slip / (contact.saturation * abs(entrainment)), 1.0)


@jit_inline
def passed_since(sample, passes, entrainment):
    """What a station passes since the sample before, as `book_times` takes it.

    Parameters
    ----------
    sample : record of `macroslip.measures.samples.SAMPLE`
    passes : float
        Passes of the roller since the sample before [-].
    entrainment : float
        Entrainment speed, with its sign [m/s].

    Returns
    -------
    tuple of float
        Time under load [s] and passes then [-], over the number of stations; 1/entrainment [s/m].
    """
    time = (sample.time - sample.since) * sample.under_load / STATIONS
    return time, passes * sample.under_load / STATIONS, 1.0 / entrainment


@jit_inline
def book_slices(along, slices, first, count, width, hot):
    """Write how power lies along the roller, of the slices of the stations that touch.

    Parameters
    ----------
    along : record of `ALONG`
        All but the film's regime is written.
    slices : record of `macroslip.contact.chords.SLICES`
        Their power, its part by asperities, load, slip and half-width are taken.
    first, count : int
        First station that touches, and number of them.
    width : float
        Width of a whole station [m].
    hot : ndarray
        Power per length [W/m] and half-width [m] of the hottest slice are written.

    Returns
    -------
    densest : float
        Largest power per area [W/m²].
    fastest : float
        Largest slip [m/s].
    """
    along.power[:] = 0.0
    along.rough[:] = 0.0
    along.work[:] = 0.0
    along.density[:] = 0.0
    # Of power only its share of all stations counts; of p |v| its size does.
    for k in range(count):
        covered = slices.covered[k]
        along.power[first + k] = math.copysign(slices.power[k] * covered, slices.slip[k])
        along.rough[first + k] = slices.asperities[k] * covered
        along.work[first + k] = slices.load[k] * slices.speed[k] * covered * width
        along.density[first + k] = slices.power[k] / (2.0 * slices.half_width[k])
    total = 0.0
    rough_total = 0.0
    work_total = 0.0
    densest = 0.0
    fastest = 0.0
    hottest = 0.0
    for k in range(count):
        total += abs(along.power[first + k])
        rough_total += along.rough[first + k]
        work_total += along.work[first + k]
        density = along.density[first + k]
        densest = max(densest, density)
        fastest = max(fastest, slices.speed[k])
        # Flash temperature goes with P'/√b: where its square is the largest, it is taken.
        if slices.power[k] * density > hottest:
            hottest = slices.power[k] * density
            hot[0] = slices.power[k]
            hot[1] = slices.half_width[k]
    along.total = total
    along.rough_total = rough_total
    along.work_total = work_total
    along.first = first
    along.behind = first + count
    return densest, fastest


@jit_evaluation
def book_times(times, slices, k, passed):
    """Add the time under load and the passes of a slice to the class of its slip.

    Parameters
    ----------
    times : ndarray, shape (classes of slip, 2)
        Times under load [s] and passes [-] of the film's class; the slice's are added.
    slices : record of `macroslip.contact.chords.SLICES`
    k : int
        Number of the slice.
    passed : tuple of float
        Of `passed_since`.
    """
    ratio = math.copysign(slices.speed[k], slices.slip[k]) * passed[2]
    spent = times[class_of(SLIP_EDGES, ratio)]
    spent[0] += passed[0] * slices.covered[k]
    spent[1] += passed[1] * slices.covered[k]


@jit_evaluation
def _slip(line, station):
    """Slip along rolling, with its sign, and size of the slip at a station [m], both [m/s]."""
    along_rolling = _parabola(line, 1, station)
    across_rolling = _parabola(line, 4, station)
    size = math.sqrt(along_rolling * along_rolling + across_rolling * across_rolling)
    return along_rolling, size


@jit_once
def _write_slices(patch, root, line, first, slices, count):
    """Write the slices of an ellipse at the stations that it touches.

    The part of a station that it covers counts, and its middle is where slip and pressure are
    taken: so the lightest contact too lies in the two middle stations.
    """
    width = 2.0 * patch.half_length / STATIONS
    across = patch.across * root
    # Divisions take as long as all else of a slice: what is the same in all is divided once.
    per_square = 1.0 / (across * across)
    per_width = 1.0 / width
    for k in range(count):
        left = (first + k) * width - patch.half_length
        begin = max(left, line[0] - across)
        end = min(left + width, line[0] + across)
        station = 0.5 * (begin + end)
        from_middle = station - line[0]
        slip, speed = _slip(line, station)
        length = math.sqrt(1.0 - from_middle * from_middle * per_square)
        slices.covered[k] = (end - begin) * per_width
        slices.length[k] = length
        slices.pressure[k] = patch.pressure * root * length
        slices.slip[k] = slip
        slices.speed[k] = speed


@jit_once
def _touched(patch, across, middle):
    """First station that the ellipse touches, and number of them.

    A station of which it covers less than a millionth counts as not touched.
    """
    per_width = STATIONS / (2.0 * patch.half_length)
    begin = (middle - across + patch.half_length) * per_width
    end = (middle + across + patch.half_length) * per_width
    first = min(max(math.floor(begin + 1e-6), 0), STATIONS)
    return first, max(min(math.ceil(end - 1e-6), STATIONS) - first, 0)


@jit_once
def _write_power(contact, root, state, sample, interface, slices, count):
    """Write load and frictional power per length of the slices of an ellipse, and its asperities' part.

    The film has the share of the area that asperities leave. The oil's table, looked up before, or
    Kellström's coefficient gives its stress; without either the contact's power is distributed as
    load is. `root` is the cube root of the load [N^(1/3)].
    """
    patch = contact.patch
    load, ring_speed, slip = state
    share = sample.share[interface]
    entrainment = signed_entrainment(ring_speed, slip)
    middle_load = 0.75 * load / (patch.across * root)
    middle_power = 0.75 * sample.at.power[interface] / (patch.across * root)
    boundary = patch.boundary_friction * max(share, LEAST_SHARE) * middle_load
    per_full_slip = 1.0 / patch.full_slip
    for k in range(count):
        speed = slices.speed[k]
        height = slices.length[k] * slices.length[k]
        half_width = patch.along * root * slices.length[k]
        asperities = boundary * height * min(speed * per_full_slip, 1.0) * speed
        of_length = middle_load * height
        if contact.chorded:
            power = asperities + (1.0 - share) * 2.0 * half_width * slices.stress[k] * speed
        elif contact.limit > 0.0:
            sliding = _saturating_friction(contact, speed, entrainment) * speed
            power = asperities + (1.0 - share) * of_length * sliding
        else:
            power = middle_power * height
        slices.load[k] = of_length
        slices.half_width[k] = half_width
        slices.power[k] = power
        slices.asperities[k] = asperities


@jit
def power_along(maps, interface, contact, state, sample, passes, along):
    """Write the distribution of power along the roller at a loaded elliptical contact.

    Parameters
    ----------
    maps : record of `macroslip.measures.maps.MAPS`
        Times under load by film and slip are added, and slices are written.
    interface : int
        0 for the inner raceway, 1 for the outer one.
    contact : Contact
    state : tuple of float
        Load [N], u2 and Δu [m/s].
    sample : record of `macroslip.measures.samples.SAMPLE`
        What is hottest is written.
    passes : float
        Passes of the roller since the sample before [-].
    along : record of `ALONG`
        Is written.

    Returns
    -------
    densest : float
        Largest power per area [W/m²].
    fastest : float
        Largest slip [m/s].
    entrainment : float
        Entrainment speed, > 0 [m/s].
    """
    patch = contact.patch
    slices = maps.slices
    film_ratio = sample.film[interface] / contact.roughness
    entrainment = signed_entrainment(state[1], state[2])
    root = exponential(logarithm(state[0]) / 3.0)
    line = sample.lines[interface]
    first, count = _touched(patch, patch.across * root, line[0])
    _write_slices(patch, root, line, first, slices, count)
    if contact.chorded:
        node = film_node(contact.chords, sample.film[interface])
        chord_stresses(contact.chords, node, slices, count)
    _write_power(contact, root, state, sample, interface, slices, count)
    width = 2.0 * patch.half_length / STATIONS
    hot = sample.hot[interface]
    densest, fastest = book_slices(along, slices, first, count, width, hot)
    passed = passed_since(sample, passes, entrainment)
    if passed[0] > 0.0:
        times = maps.film_slip[interface, class_of(FILM_EDGES, film_ratio)]
        for k in range(count):
            book_times(times, slices, k, passed)
    along.regime = 1 if film_ratio >= 1.0 else 0
    return densest, fastest, abs(entrainment)
