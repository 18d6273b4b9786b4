"""Distribution of frictional power along a roller at a raceway, by station."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from macroslip.compiled import jit_inline, jit_once, uncounted
from macroslip.contact.chords import FIRST_SLICE, film_node, write_film
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
#: How power lies along the roller at a raceway, at a sample. Of power only its share of all stations
#: counts: it is that per length.
ALONG = np.dtype(
    [
        # Size of the power of stations at which slip is negative, and at which it is positive [W/m].
        ("negative", "f8", (STATIONS,)),
        ("positive", "f8", (STATIONS,)),
        # Power of asperities by station [W/m].
        ("rough", "f8", (STATIONS,)),
        # ∫ p |v| dA by station [W].
        ("work", "f8", (STATIONS,)),
        # Power per area by station [W/m²].
        ("density", "f8", (STATIONS,)),
        # Sum of |power| [W/m].
        ("total", "f8"),
        # Sum of the power of asperities [W/m].
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


class Highest(NamedTuple):
    """What is the highest of the slices of a contact."""

    density: float  #: Power per area [W/m²]
    speed: float  #: Slip [m/s]
    heat: float  #: Power per length times power per area [W²/m³]


@jit_once
def clear_along(along):
    """Write that no power lies along the roller."""
    along.negative[:] = 0.0
    along.positive[:] = 0.0
    along.rough[:] = 0.0
    along.work[:] = 0.0
    along.density[:] = 0.0
    along.total = 0.0
    along.rough_total = 0.0
    along.work_total = 0.0
    along.first = STATIONS // 2
    along.behind = STATIONS // 2


@jit_inline
def book_along(along, slices, start, touched):
    """Write how power lies along the roller, of the slices of the stations that touch.

    Parameters
    ----------
    along : record of `ALONG`
        All but the film's regime is written.
    slices : record of `macroslip.contact.chords.SLICES`
        With what `write_powers` gives.
    start : int
        Number of the contact's first slice, at least `FIRST_SLICE`.
    touched : ndarray, shape (2,)
        First station that touches, and number of them.

    Returns
    -------
    Highest
    """
    first = touched[0]
    behind = first + touched[1]
    # All stations are written, so that the processor does several at once; what is read beside the
    # contact's slices is not taken. That the index is not negative the compiler has to see.
    from_slice = max(start - first, 0)
    for k in range(STATIONS):
        touches = k >= first and k < behind
        spent = slices.spent[from_slice + k]
        rough = slices.rough[from_slice + k]
        work = slices.work[from_slice + k]
        density = slices.density[from_slice + k]
        along.negative[k] = max(-spent, 0.0) if touches else 0.0
        along.positive[k] = max(spent, 0.0) if touches else 0.0
        along.rough[k] = rough if touches else 0.0
        along.work[k] = work if touches else 0.0
        along.density[k] = density if touches else 0.0
    total = 0.0
    rough_total = 0.0
    work_total = 0.0
    densest = 0.0
    fastest = 0.0
    hottest = 0.0
    for k in range(start, start + touched[1]):
        total += abs(slices.spent[k])
        rough_total += slices.rough[k]
        work_total += slices.work[k]
        density = slices.density[k]
        densest = max(densest, density)
        fastest = max(fastest, slices.speed[k])
        hottest = max(hottest, slices.power[k] * density)
    along.total = total
    along.rough_total = rough_total
    along.work_total = work_total
    along.first = first
    along.behind = behind
    return Highest(densest, fastest, hottest)


@jit_once
def hottest_slice(slices, start, count):
    """Power per length [W/m] and half-width [m] of the hottest slice of a contact; 0 without power.

    Flash temperature goes with P'/√b: where its square is the largest, it is taken.
    """
    hottest = 0.0
    power = 0.0
    half_width = 0.0
    for k in range(start, start + count):
        heat = slices.power[k] * slices.density[k]
        if heat > hottest:
            hottest = heat
            power = slices.power[k]
            half_width = slices.half_width[k]
    return power, half_width


@jit_once
def book_times(times, slices, start, count, passed):
    """Add times under load and passes of the slices of a contact to the classes of film and slip.

    Parameters
    ----------
    times : ndarray, shape (classes of film, classes of slip, 2)
        Times under load [s] and passes [-]; those of the slices are added.
    slices : record of `macroslip.contact.chords.SLICES`
        With what `write_powers` gives.
    start, count : int
        Number of the contact's first slice, and how many there are.
    passed : tuple of float
        Time under load [s] and passes then [-] of a station, over the number of stations.
    """
    for k in range(start, start + count):
        spent = times[slices.film_class[k], slices.slip_class[k]]
        spent[0] += passed[0] * slices.covered[k]
        spent[1] += passed[1] * slices.covered[k]


@jit_inline
def write_powers(contact, slices, behind):
    """Write frictional power of slices, and the classes of their slip.

    The film has the share of the area that asperities leave, and its stress. Where neither the oil's
    table nor Kellström's coefficient gives a stress, `power` is there already: the contact's power is
    distributed as load is.

    Parameters
    ----------
    contact : Contact
    slices : record of `macroslip.contact.chords.SLICES`
        Of this contact; their state and the stress of the oil are taken.
    behind : int
        Number of the slice behind the last, of one sample or of several.
    """
    patch = contact.patch
    width = 2.0 * patch.half_length / STATIONS
    stressed = contact.chorded or contact.limit > 0.0
    # Divisions take as long as all else of a slice: what is the same in all is divided once.
    per_full_slip = 1.0 / patch.full_slip
    for n in range(behind - FIRST_SLICE):
        k = FIRST_SLICE + n
        speed = slices.speed[k]
        load = slices.load[k]
        share = slices.share[k]
        doubled_width = 2.0 * slices.half_width[k]
        carried = patch.boundary_friction * max(share, LEAST_SHARE) * load
        asperities = carried * min(speed * per_full_slip, 1.0) * speed
        power = slices.power[k]
        if stressed:
            power = asperities + (1.0 - share) * doubled_width * slices.stress[k] * speed
        slices.power[k] = power
        # Of power only its share of all stations counts; of p |v| its size does.
        covered = slices.covered[k]
        slices.spent[k] = math.copysign(power * covered, slices.slip[k])
        slices.rough[k] = asperities * covered
        slices.work[k] = load * speed * covered * width
        slices.density[k] = power / doubled_width
    for n in range(behind - FIRST_SLICE):
        k = FIRST_SLICE + n
        slices.slip_class[k] = class_of(SLIP_EDGES, slices.ratio[k])


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
def _slip_line(patch, sample, interface, ring_speed, slip):
    """Middle of an ellipse along the roller [m], and the slip along it, as `lines` of `SAMPLE`."""
    if sample.skewed:
        line = sample.lines[interface]
        return line[0], line[1], line[2], line[3], line[4], line[5], line[6]
    bend = 0.0
    if patch.microslip:
        fall = ring_speed * patch.curvature_ratio - slip / patch.roller_radius
        bend = fall / (2.0 * patch.contour_radius)
    return 0.0, slip, -ring_speed * patch.spin_ratio, bend, 0.0, 0.0, 0.0


@jit_inline
def write_ellipse(contact, state, sample, interface, slices, start):
    """Write the slices of an ellipse at the stations that it touches.

    Parameters
    ----------
    contact : Contact
    state : tuple of float
        Load [N], > 0, u2 and Δu [m/s].
    sample : record of `macroslip.measures.samples.SAMPLE`
        Which stations touch is written.
    interface : int
        0 for the inner raceway, 1 for the outer one.
    slices : record of `macroslip.contact.chords.SLICES`
    start : int
        Number of the first slice.
    """
    patch = contact.patch
    load, ring_speed, slip = state
    root = exponential(logarithm(load) / 3.0)
    line = _slip_line(patch, sample, interface, ring_speed, slip)
    first, count = _touched(patch, patch.across * root, line[0])
    _write_chords(patch, root, line, slices, (start, first, count))
    of_middle = 0.75 / (patch.across * root)
    load_of_middle = of_middle * load
    power_of_middle = of_middle * sample.at.power[interface]
    share = sample.share[interface]
    per_entrainment = 1.0 / signed_entrainment(ring_speed, slip)
    film_class = class_of(FILM_EDGES, sample.film[interface] / contact.roughness)
    from_start = max(start, 0)
    for n in range(count):
        k = from_start + n
        height = slices.load[k]
        slices.load[k] = load_of_middle * height
        slices.power[k] = power_of_middle * height
        slices.share[k] = share
        slices.ratio[k] = math.copysign(slices.speed[k], slices.slip[k]) * per_entrainment
        slices.film_class[k] = film_class
    if contact.chorded:
        write_film(film_node(contact.chords, sample.film[interface]), slices, start, start + count)
    elif contact.limit > 0.0:
        _write_friction(contact, slices, start, count)
    sample.touched[interface, 0] = first
    sample.touched[interface, 1] = count


@jit_once
def _write_chords(patch, root, line, slices, touched):
    """Write position, width, pressure and slip of the slices of an ellipse.

    The part of a station that it covers counts, and its middle is where slip and pressure are
    taken: so the lightest contact too lies in the two middle stations. The load is that per length
    over the middle's. `root` is the cube root of the contact's load [N^(1/3)], and `touched` are the
    number of the first slice, the station that it lies in, and the number of slices.
    """
    start, first, count = touched
    middle = line[0]
    width = 2.0 * patch.half_length / STATIONS
    across = patch.across * root
    # Divisions take as long as all else of a slice: what is the same in all is divided once.
    per_square = 1.0 / (across * across)
    per_width = 1.0 / width
    pressure = patch.pressure * root
    half_width = patch.along * root
    from_start = max(start, 0)
    for n in range(count):
        k = from_start + n
        left = (first + n) * width - patch.half_length
        begin = max(left, middle - across)
        end = min(left + width, middle + across)
        station = 0.5 * (begin + end)
        slip = _parabola(line, 1, station)
        slip_across = _parabola(line, 4, station)
        height = 1.0 - (station - middle) * (station - middle) * per_square
        length = math.sqrt(height)
        slices.covered[k] = (end - begin) * per_width
        slices.pressure[k] = pressure * length
        slices.load[k] = height
        slices.half_width[k] = half_width * length
        slices.slip[k] = slip
        slices.speed[k] = math.sqrt(slip * slip + slip_across * slip_across)


@jit_once
def _write_friction(contact, slices, start, count):
    """Write the stress of slices by Kellström's coefficient of friction."""
    per_saturation = 1.0 / contact.saturation
    for k in range(start, start + count):
        friction = contact.limit * min(abs(slices.ratio[k]) * per_saturation, 1.0)
        slices.stress[k] = friction * slices.load[k] / (2.0 * slices.half_width[k])
