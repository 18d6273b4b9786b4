"""Distribution of frictional power along a roller at a raceway, by station."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.contact.line import PALMGREN_EXPONENT, half_width, line_pressure
from macroslip.contact.line_approach import line_approach
from macroslip.contact.patch import Patch, chord_stress_at, film_node, patch_of
from macroslip.contact.strips import PreparedStrips, Strips
from macroslip.contact.traction import ChordTable, chord_table
from macroslip.mechanics.film_sharing import LOWEST_SPEED

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
_LEAST_SHARE = 1e-30
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
    ]
)


_NO_LINE = Strips(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class Contact(NamedTuple):
    """A contact as compiled functions of samples take it."""

    patch: Patch  #: Geometry
    chords: ChordTable  #: Stresses of its oil
    chorded: bool  #: Whether these serve
    limit: float  #: Kellström's coefficient of friction [-]; 0 without
    saturation: float  #: Kellström's slide-roll ratio from which on it is reached [-]
    roughness: float  #: Composite RMS roughness [m]
    effusivity: float  #: Thermal effusivity of its steel [J/(m² K s^½)]
    lined: bool  #: Whether roller and raceway touch along a line
    line: Strips  #: That line contact; without meaning otherwise


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
            isinstance(law, PreparedStrips),
            law.strips if isinstance(law, PreparedStrips) else _NO_LINE,
        )

    return contact(laws.inner), contact(laws.outer), contact(laws.cage)


@jit_inline
def class_of(edges, value):
    """Class of a value between rising edges: the number of edges that it is not below."""
    number = 0
    while number < len(edges) and value >= edges[number]:
        number += 1
    return number


@jit_inline
def _parabola(line, first, station):
    """Value at a station [m] of the parabola whose coefficients stand from `first` on."""
    return line[first] + station * (line[first + 2] * station + line[first + 1])


@jit_inline
def _entrainment(ring_speed, slip):
    """Entrainment speed with its sign, not slower than films are followed [m/s]."""
    mean = ring_speed - 0.5 * slip
    return math.copysign(max(abs(mean), LOWEST_SPEED), mean)


@jit_inline
def _saturating_friction(contact, slip, entrainment):
    """Kellström's coefficient of friction at a slip and an entrainment speed [m/s]."""
    return contact.limit * min(slip / (contact.saturation * abs(entrainment)), 1.0)


@jit_inline
def _covered(k, width, half_length, middle, across):
    """Middle [m] of the part of a station under the ellipse, and that part [-].

    So the lightest contact too lies in the two middle stations.
    """
    left = k * width - half_length
    first = max(left, middle - across)
    last = min(left + width, middle + across)
    return 0.5 * (first + last), (last - first) / width


class _Line(NamedTuple):
    """A line contact under a load."""

    approach: float  #: Of roller and ring [m]
    across: float  #: Half of the length that touches [m]
    largest: float  #: Largest load per length [N/m]


class _Chord(NamedTuple):
    """A chord across a contact at a station."""

    height: float  #: Load per length over the largest [-]
    load: float  #: Load per length [N/m]
    half_width: float  #: [m]
    pressure: float  #: Largest [Pa]
    slip: float  #: In rolling [m/s]
    speed: float  #: Size of the slip in rolling and along the roller [m/s]


@jit_inline
def _line_under(line, load):
    """Approach, length and largest load per length of a line contact under a load Q > 0 [N]."""
    stiffness = line.coefficient * line.length
    each = 0.5 * line_approach(stiffness, line.depth, math.log(load)).approach
    across = 0.5 * line.length
    if line.depth > 0.0:
        across *= math.sqrt(-math.expm1(-each / line.depth))
    return _Line(each, across, line.coefficient * each**PALMGREN_EXPONENT)


@jit_inline
def _line_chord(line, under, state, station, microslip):
    """Chord of a line contact; state is that of `power_along`.

    Without microslip all of it has the slip of the middle.
    """
    relative = 2.0 * station / line.length
    drop = -line.depth * math.log1p(-min(relative * relative, 1.0 - 1e-15))
    load = line.coefficient * max(under.approach - drop, 1e-15) ** PALMGREN_EXPONENT
    slip = state[2]
    if microslip:
        slip *= 1.0 - 0.5 * drop / line.radius
        slip += 0.5 * state[1] * line.curvature * drop
    return _Chord(
        load / under.largest,
        load,
        half_width(load, line.curvature, line.modulus),
        line_pressure(load, line.curvature, line.modulus),
        slip,
        abs(slip),
    )


@jit_inline
def _ellipse_chord(patch, line, load, across, root, station):
    """Chord of an ellipse of semi-axis `across`; `line` has the parabolas of the sample's slip."""
    height = 1.0 - (station - line[0]) * (station - line[0]) / (across * across)
    local = _parabola(line, 1, station)
    chord = math.sqrt(height)
    return _Chord(
        height,
        0.75 * height / across * load,
        patch.along * root * chord,
        patch.pressure * root * chord,
        local,
        math.hypot(local, _parabola(line, 4, station)),
    )


@jit
def power_along(maps, interface, contact, state, sample, passes, along):
    """Distribution of power along the roller at a loaded raceway, and its hottest station.

    Along a line contact film and share of asperities are those of its middle.

    Parameters
    ----------
    maps : record of `macroslip.measures.maps.MAPS`
        Times under load by film and slip are added.
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
    film = sample.film[interface]
    share = sample.share[interface]
    load = state[0]
    entrainment = _entrainment(state[1], state[2])
    times = maps.film_slip[interface, class_of(FILM_EDGES, film / contact.roughness)]
    span = (sample.time - sample.since) / STATIONS
    root = load ** (1.0 / 3.0)
    across = patch.across * root
    under = _Line(0.0, across, 0.0)
    if contact.lined:
        under = _line_under(contact.line, load)
        across = under.across
    line = sample.lines[interface]
    width = 2.0 * patch.half_length / STATIONS
    node = film_node(contact.chords, film)
    boundary = 0.75 * patch.boundary_friction * max(share, _LEAST_SHARE) * load / across
    if contact.lined:
        boundary = patch.boundary_friction * max(share, _LEAST_SHARE) * under.largest
    hot = sample.hot[interface]
    hottest = 0.0
    densest = 0.0
    fastest = 0.0
    along.total = 0.0
    along.rough_total = 0.0
    along.work_total = 0.0
    for k in range(STATIONS):
        station, covered = _covered(k, width, patch.half_length, line[0], across)
        if covered < 1e-6:
            along.power[k] = 0.0
            along.rough[k] = 0.0
            along.work[k] = 0.0
            along.density[k] = 0.0
            continue
        if contact.lined:
            chord = _line_chord(contact.line, under, state, station, patch.microslip)
        else:
            chord = _ellipse_chord(patch, line, load, across, root, station)
        height = chord.height
        speed = chord.speed
        asperities = boundary * height * min(speed / patch.full_slip, 1.0) * speed
        per_length = 0.75 * height / across * sample.at.power[interface]
        if contact.chorded:
            stress = chord_stress_at(contact.chords, node, chord.pressure, speed)
            per_length = (1.0 - share) * 2.0 * chord.half_width * stress * speed + asperities
        elif contact.limit > 0.0:
            per_length = (1.0 - share) * 0.75 * height / across * load * speed
            per_length *= _saturating_friction(contact, speed, entrainment)
            per_length += asperities
        # Of power only its share of all stations counts; of p |v| its size does.
        along.power[k] = math.copysign(per_length * covered, chord.slip)
        along.rough[k] = asperities * covered
        along.work[k] = chord.load * speed * covered * width
        along.total += abs(along.power[k])
        along.rough_total += along.rough[k]
        along.work_total += along.work[k]
        if sample.at.elastic_load > 0.0:
            spent = times[class_of(SLIP_EDGES, math.copysign(speed, chord.slip) / entrainment)]
            spent[0] += span * covered
            spent[1] += passes * covered / STATIONS
        density = per_length / (2.0 * chord.half_width)
        along.density[k] = density
        # Flash temperature goes with P'/√b: where its square is the largest, it is taken.
        if per_length * density > hottest:
            hottest = per_length * density
            hot[0] = per_length
            hot[1] = chord.half_width
        densest = max(densest, density)
        fastest = max(fastest, speed)
    along.regime = 1 if film >= contact.roughness else 0
    return densest, fastest, abs(entrainment)
