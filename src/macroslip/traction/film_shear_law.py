"""Traction of a film that is limited in stress and heats itself, integrated over the contact ellipse with microslip."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.traction.chord import characteristic_stress, chord_stress, log_viscosity
from macroslip.traction.chord_table import (
    ChordTable,
    ChordValue,
    chord_place,
    chord_value,
    film_place,
    interpolated_stress,
    stress_of,
)
from macroslip.traction.patch import Patch
from macroslip.traction.rheology import limited_stress
from macroslip.traction.slip_field import graded_rule, rolling_lines
from macroslip.traction.traction_law import register_type

_NODES, _WEIGHTS = graded_rule(10)
_FINE_NODES, _FINE_WEIGHTS = graded_rule(20)


def _chords(nodes: int) -> tuple[np.ndarray, np.ndarray]:
    """Sin φ and weights of ∫ cos²φ f(sin φ) dφ over −π/2 to π/2, by Gauss-Chebyshev quadrature of the second kind."""
    angle = np.pi * np.arange(1, nodes + 1) / (nodes + 1)
    return np.cos(angle), np.pi / (nodes + 1) * np.sin(angle) ** 2


_STATIONS, _STATION_WEIGHTS = _chords(10)
#: Slip below which a chord is not looked up: its stress is proportional to slip and far below round-off of the rest.
_NO_SLIP = 1e-30
#: Part of the half length below which a piece of the contact is left out.
_SHORTEST = 1e-12
#: √B at which Crook's shear stress peaks (B = 2.2767), and a slip no contact exceeds [m/s].
_ROOT_HEATING_AT_PEAK, _FASTEST = 1.5088, 10.0


class FilmShear(NamedTuple):
    """The law for one interface.

    Attributes
    ----------
    table : ChordTable
        Stress along chords.
    semi_axis_across, semi_axis_along : float
        Of the contact ellipse per Q^(1/3) [m/N^(1/3)].
    pressure : float
        p0 per Q^(1/3) [Pa/N^(1/3)].
    """

    table: ChordTable
    semi_axis_across: float
    semi_axis_along: float
    pressure: float


@jit
def uniform_traction(law, load, film_thickness, slip):
    """F [N], ∂F/∂Δu [N s/m], ∂F/∂h [N/m] and ∂F/∂Q [-] where slip is the same all over the patch.

    Parameters
    ----------
    law : FilmShear
    load : float
        Q > 0 [N].
    film_thickness : float
        h > 0 [m].
    slip : float
        Δu [m/s].
    """
    root_load = load ** (1.0 / 3.0)
    area = 2.0 * law.semi_axis_across * law.semi_axis_along * root_load * root_load
    pressure = law.pressure * root_load
    speed = max(abs(slip), _NO_SLIP)
    total, by_slip, by_film, by_pressure = 0.0, 0.0, 0.0, 0.0
    place = film_place(law.table, film_thickness)
    half = (_STATIONS.size + 1) // 2
    for k in range(half):
        # The ellipse is symmetrical; the middle chord of an odd number counts once.
        weight = _STATION_WEIGHTS[k] * (1.0 if 2 * k + 1 == _STATIONS.size else 2.0)
        height = math.sqrt(1.0 - _STATIONS[k] * _STATIONS[k])
        chord = interpolated_stress(law.table, place, pressure * height, speed, True)
        part = weight * chord.stress
        total += part
        by_slip += part * chord.by_slip
        by_film += part * chord.by_film
        by_pressure += part * chord.by_pressure
    signed = area * (slip / speed)
    force = signed * total
    return (
        force,
        area * by_slip / speed,
        signed * by_film / film_thickness,
        (2.0 * force + signed * by_pressure) / (3.0 * load),
    )


@jit
def microslip_traction(law, load, film_thickness, field, shape, fine):
    """Traction of a curved and tilted contact.

    Parameters
    ----------
    law : FilmShear
    load : float
        Q > 0 [N].
    film_thickness : float
        h > 0 [m], the same all over the patch.
    field : SlipField
        How slip varies over the stations.
    shape : ContactShape
        Contour radius R_d, roller radius and half length of the roller.
    fine : bool
        True: a finer rule along the stations, and chords by quadrature instead of the table, for error estimates.
        Then the slopes are zero.

    Returns
    -------
    Patch

    Notes
    -----
    The ellipse ends at the roller's ends; what Hertz's pressure would carry beyond is left out. The derivatives by film
    thickness leave out that heating changes with it.
    """
    root_load = load ** (1.0 / 3.0)
    across = law.semi_axis_across * root_load
    pressure = law.pressure * root_load
    end = min(1.0, shape.half_length / across)
    lines = rolling_lines(field, shape.contour_radius, across * end)
    edges = -end, lines.first / across, lines.second / across, end
    moves_of_edges = 0.0, lines.first_by_slip, lines.second_by_slip, 0.0
    place = film_place(law.table, film_thickness)
    nodes = _FINE_NODES if fine else _NODES
    weights = _FINE_WEIGHTS if fine else _WEIGHTS
    drop_scale = 0.5 / shape.contour_radius
    bend, per_radius = field.curvature_rate / shape.contour_radius, 1.0 / shape.roller_radius
    area = 2.0 * across * law.semi_axis_along * root_load
    # Places of all chords first, then all values, then the sums: the processor works on several chords at a time only
    # where one step after the other is short.
    chords = np.empty((10, 3 * nodes.size))
    xs, slips, cosines, weighted, moved, growths = chords[0], chords[1], chords[2], chords[3], chords[4], chords[5]
    looked_up = chords[6:]
    count = 0
    for segment in range(3):
        length = edges[segment + 1] - edges[segment]
        if length < _SHORTEST:
            continue
        widens = moves_of_edges[segment + 1] - moves_of_edges[segment]
        for k in range(nodes.size):
            x = edges[segment] + length * nodes[k]
            station = across * x
            slip = field.sliding + field.curvature_rate * drop_scale * station * station - field.spin_rate * station
            cosine = math.sqrt(1.0 - x * x)
            xs[count], slips[count], cosines[count] = x, slip, cosine
            speed = max(abs(slip), _NO_SLIP)
            weighted[count] = area * weights[k] * length * cosine * (slip / speed)
            moved[count] = moves_of_edges[segment] + widens * nodes[k]
            growths[count] = widens / (across * length)
            if not fine:
                place_of_chord = chord_place(law.table, film_thickness, pressure * cosine, speed)
                looked_up[0, count], looked_up[1, count] = place_of_chord
            count += 1
    if not fine:
        for n in range(count):
            value = chord_value(law.table, place, looked_up[0, n], looked_up[1, n], False)
            looked_up[0, n], looked_up[1, n], looked_up[2, n], looked_up[3, n] = value
    force, lag, skew = 0.0, 0.0, 0.0
    force_slope, lag_slope, force_by_film, lag_by_film = 0.0, 0.0, 0.0, 0.0
    for n in range(count):
        slip, cosine, moves = slips[n], cosines[n], moved[n]
        station = across * xs[n]
        drop = drop_scale * station * station
        arm = drop * per_radius
        if fine:
            speed = max(abs(slip), _NO_SLIP)
            part = weighted[n] * chord_stress(law.table.fluid, pressure * cosine, film_thickness, speed)
        else:
            value = ChordValue(looked_up[0, n], looked_up[1, n], looked_up[2, n], looked_up[3, n])
            chord = stress_of(law.table, film_thickness, pressure * cosine, value)
            part = weighted[n] * chord.stress
            # The node moves with the lines of pure rolling, and with it pressure, slip, chord and arm.
            slip_change = 1.0 + field.curvature_slope * drop + (bend * station - field.spin_rate) * moves
            change = chord.by_slip * slip_change / slip if slip != 0.0 else 0.0
            change += growths[n] - xs[n] / (across * cosine * cosine) * (1.0 + chord.by_pressure) * moves
            force_slope += part * change
            lag_slope += part * (arm * change + 2.0 * drop_scale * station * moves * per_radius)
            force_by_film += part * chord.by_film
            lag_by_film += part * arm * chord.by_film
        force += part
        lag += part * arm
        skew += part * station
    return Patch(force, lag, skew, force_slope, lag_slope, force_by_film / film_thickness, lag_by_film / film_thickness)


@jit
def rising_slip(law, load, film_thickness):
    """Local slip [m/s] up to which stress rises with slip at every point of the contact.

    Stress rises while β h τ Δu < 8k (`macroslip.traction.film_shear`), which holds at least as long as in a Newtonian
    film, and at least up to where the largest stress there can be reaches it.
    """
    fluid = law.table.fluid
    if fluid.heating == 0.0:
        return math.inf
    pressure = law.pressure * load ** (1.0 / 3.0)
    log_eta, _ = log_viscosity(fluid, pressure)
    newtonian = _ROOT_HEATING_AT_PEAK * math.exp(-0.5 * log_eta) / math.sqrt(fluid.heating)
    viscous = math.exp(log_eta) * _FASTEST / film_thickness
    largest, _ = limited_stress(fluid.rheology, viscous, characteristic_stress(fluid, pressure))
    return max(newtonian, 1.0 / (fluid.heating * film_thickness * largest))


@jit_inline
def chord_traction(law, load, film_thickness, cosine, slip):
    """Traction per length [N/m] on the chord whose length and largest pressure are `cosine` times the middle's."""
    root_load = load ** (1.0 / 3.0)
    place = film_place(law.table, film_thickness)
    stress = interpolated_stress(law.table, place, law.pressure * root_load * cosine, max(slip, _NO_SLIP), False).stress
    return 2.0 * law.semi_axis_along * root_load * cosine * stress


register_type(
    FilmShear,
    traction=uniform_traction,
    rising_slip=rising_slip,
    microslip=microslip_traction,
    chord=chord_traction,
)
