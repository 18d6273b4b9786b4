"""Stress of the oil along the chords of a contact, looked up in its table by compiled functions.

A chord is the slice of the contact at one station of the roller's axis. The table is
`macroslip.contact.traction.ChordTable`. Chords of one contact or of several are looked up together,
in loops of which each does one part of the work for all: the processor does several chords of such
a loop at once, and together they take half as long as one chord after the other, or less.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_evaluation, jit_inline
from macroslip.contact.spline import spline_value
from macroslip.contact.traction import (
    HIGHEST_PRESSURE,
    LIMITING_SHEAR,
    LOWEST_LOG_SLIP,
    LOWEST_PRESSURE,
    NEWTONIAN,
)
from macroslip.elementary import exponential, logarithm

#: Slip below which a chord is not looked up [m/s]: its stress is proportional to slip and far below
#: round-off of the rest.
NO_SLIP = 1e-30
#: Most slices that are computed together: those of several contacts, so that loops are long.
MOST_SLICES = 136
#: Number of the first slice. Before it, and behind the last, there is room for those of all stations.
FIRST_SLICE = 24
_OF_SLICES = (MOST_SLICES,)
#: Slices of contacts, each field over all of them. Whoever computes them fills the fields in use.
SLICES = np.dtype(
    [
        # Station ζ along the roller's axis [m].
        ("station", "f8", _OF_SLICES),
        # Part of a station that the contact covers [-].
        ("covered", "f8", _OF_SLICES),
        # Area [m²].
        ("area", "f8", _OF_SLICES),
        # Largest pressure on the chord p1 [Pa].
        ("pressure", "f8", _OF_SLICES),
        # Load per length [N/m], and half-width of the contact along rolling [m].
        ("load", "f8", _OF_SLICES),
        ("half_width", "f8", _OF_SLICES),
        # Asperities' share of the load [-].
        ("share", "f8", _OF_SLICES),
        # Slip along rolling with its sign, and size of the slip [m/s].
        ("slip", "f8", _OF_SLICES),
        ("speed", "f8", _OF_SLICES),
        # Slide-roll ratio with the sign of the slip along rolling times that of rolling [-].
        ("ratio", "f8", _OF_SLICES),
        # The film's position in the oil's table, by `write_film`.
        ("log_film", "f8", _OF_SLICES),
        ("film_cell", "i8", _OF_SLICES),
        ("along_film", "f8", _OF_SLICES),
        # Unit of stress [Pa]: of the film, and then of the chord.
        ("unit", "f8", _OF_SLICES),
        # Looked up: mean shear stress q along the chord [Pa].
        ("stress", "f8", _OF_SLICES),
        # Frictional power per length [W/m] and per area [W/m²].
        ("power", "f8", _OF_SLICES),
        ("density", "f8", _OF_SLICES),
        # Of the part of the station that is covered, over the station's width: power with the sign
        # of slip, and power of asperities [W/m]; and ∫ p |v| dA of that part [W].
        ("spent", "f8", _OF_SLICES),
        ("rough", "f8", _OF_SLICES),
        ("work", "f8", _OF_SLICES),
        # Classes of the film ratio Λ and of the slide-roll ratio.
        ("film_class", "i8", _OF_SLICES),
        ("slip_class", "i8", _OF_SLICES),
        # From loop to loop of the look-up: cells and positions in the table along pressures and
        # slips.
        ("pressure_cell", "i8", _OF_SLICES),
        ("along_pressure", "f8", _OF_SLICES),
        ("slip_cell", "i8", _OF_SLICES),
        ("along_slip", "f8", _OF_SLICES),
        # Logarithm of the oil's viscosity, and then of the stress over its unit.
        ("logarithm", "f8", _OF_SLICES),
    ]
)


@jit_evaluation
def _node(count, coordinate):
    """Cell of a coordinate counted in nodes, kept within the spline, and the position in the cell."""
    inside = min(max(coordinate, 0.0), count - 3.0)
    # A coordinate that is no number has a cell too, and its position is none.
    cell = max(min(int(inside), count - 4), 0)
    return cell, inside - cell


@jit_evaluation
def _on_line(coefficients, cell, t):
    """Value of a spline of one coordinate."""
    u = 1.0 - t
    first = coefficients[cell]
    second = coefficients[cell + 1]
    third = coefficients[cell + 2]
    fourth = coefficients[cell + 3]
    before = (4.0 - 6.0 * t * t + 3.0 * t * t * t) * second
    after = (4.0 - 6.0 * u * u + 3.0 * u * u * u) * third
    middle = before + after
    return (u * u * u * first + middle + t * t * t * fourth) * (1.0 / 6.0)


class FilmNode(NamedTuple):
    """Position of a film thickness in the table of chords."""

    logarithm: float  #: ln h [ln m]
    cell: int  #: Cell of the table's axis of films
    position: float  #: Position in the cell, 0 to 1 [-]
    unit: float  #: Unit of stress without pressure [Pa]


class _Rheology(NamedTuple):
    """Numbers of an oil's rheology.

    The table holds ln of the stress over a unit, by slip over another. Both units are numbers of the
    rheology, so that no chord asks which it is.
    """

    per_pressure: float  #: What is added to the unit of stress per pressure [-]
    thickened: float  #: Power of the viscosity in the unit of slip [-]
    heated: float  #: Part of its logarithm that is added to that of the stress [-]
    limit: float  #: Largest stress over its unit [-]


@jit_inline
def _rheology(fluid):
    """Numbers of the rheology of a `macroslip.contact.traction.Fluid`."""
    if fluid.rheology == NEWTONIAN:
        return _Rheology(0.0, 0.5, 1.0, math.inf)
    if fluid.rheology == LIMITING_SHEAR:
        # A spline overshoots where limited stress turns into falling; the limit itself, γ p1 ∫cos²θ
        # dθ, holds all the same.
        return _Rheology(fluid.characteristic, 1.0, 0.0, 0.25 * math.pi)
    return _Rheology(0.0, 1.0, 0.0, math.inf)


@jit_inline
def film_node(chords, film):
    """Position of a film h [m] in the table of chords."""
    fluid = chords.fluid
    log_film = logarithm(film)
    cell, position = _node(chords.shape[1], (log_film - chords.lowest_film) * chords.per_log_film)
    unit = fluid.characteristic
    if fluid.rheology == NEWTONIAN:
        unit = 1.0 / (math.sqrt(max(fluid.heating, 1e-30)) * film)
    elif fluid.rheology == LIMITING_SHEAR:
        unit = 0.0
    return FilmNode(log_film, cell, position, unit)


@jit_inline
def write_film(node, slices, first, behind):
    """Write the film of the slices of a contact, a `FilmNode`, for `chord_stresses`.

    Parameters
    ----------
    node : FilmNode
    slices : record of `SLICES`
    first, behind : int
        Numbers of the first slice and of the one behind the last.
    """
    from_first = max(first, 0)
    for n in range(behind - first):
        k = from_first + n
        slices.log_film[k] = node.logarithm
        slices.film_cell[k] = node.cell
        slices.along_film[k] = node.position
        slices.unit[k] = node.unit


@jit_evaluation
def _along_pressure(chords, pressure):
    """Cell and position along the table's axis of pressures, of a largest pressure [Pa]."""
    kept = min(max(pressure, LOWEST_PRESSURE), HIGHEST_PRESSURE)
    return _node(chords.shape[0], math.sqrt(math.sqrt(kept)) * chords.per_root)


@jit_evaluation
def _along_slip(chords, rheology, pressure, slip, log_viscosity, film):
    """Cell and position along the table's axis of slips, of a pressure [Pa] and a slip [m/s].

    With them come what is added to the value there, a logarithm, and the unit of stress [Pa]. Of
    the film there are ln h and the unit of stress without pressure.
    """
    log_film, film_unit = film
    kept = min(max(pressure, LOWEST_PRESSURE), HIGHEST_PRESSURE)
    unit = film_unit + rheology.per_pressure * kept
    ahead = rheology.thickened * log_viscosity
    log_slip = logarithm(max(slip, NO_SLIP) / unit) - log_film + ahead - LOWEST_LOG_SLIP
    cell, position = _node(chords.shape[2], log_slip * chords.per_log_slip)
    # Below the first slip of the table stress is in proportion to slip.
    return cell, position, min(log_slip, 0.0) + rheology.heated * ahead, unit


@jit_evaluation
def _value(chords, cells, positions):
    """Value of the table, ln of the stress over its unit, by pressure, film and slip."""
    (_, films, slips) = chords.shape
    start = (cells[0] * films + cells[1]) * slips + cells[2]
    return spline_value(chords.coefficients, start, (films * slips, slips), positions)  # pyright: ignore[reportCallIssue]


@jit_evaluation
def _stress(rheology, unit, value):
    """Stress [Pa] of a unit [Pa] and the logarithm of what it is taken times."""
    return min(unit * exponential(value), rheology.limit * unit)


@jit_evaluation
def chord_stress_at(chords, node, pressure, slip):
    """Mean shear stress along one chord of the contact, from the oil's table.

    Parameters
    ----------
    chords : ChordTable
        Table of the oil.
    node : FilmNode
        The film's position in the table, by `film_node`.
    pressure : float
        Largest pressure on the chord p1 [Pa]; kept within 10 Pa and 4 GPa.
    slip : float
        |Δu| on the chord [m/s], ≥ 0.

    Returns
    -------
    float
        Stress q [Pa], ≥ 0.
    """
    rheology = _rheology(chords.fluid)
    i, t = _along_pressure(chords, pressure)
    log_viscosity = _on_line(chords.log_viscosities, i, t)
    film = node.logarithm, node.unit
    j, u, below, unit = _along_slip(chords, rheology, pressure, slip, log_viscosity, film)
    value = _value(chords, (i, node.cell, j), (t, node.position, u))
    return _stress(rheology, unit, value + below)


@jit_inline
def chord_stresses(chords, slices, behind):
    """Write the mean shear stress along chords, as `chord_stress_at` gives it.

    Parameters
    ----------
    chords : ChordTable
        Table of the oil.
    slices : record of `SLICES`
        `pressure`, `speed` and what `write_film` has written are taken, and `stress` is written.
    behind : int
        Number of the slice behind the last.
    """
    rheology = _rheology(chords.fluid)
    for n in range(behind - FIRST_SLICE):
        k = FIRST_SLICE + n
        cell, position = _along_pressure(chords, slices.pressure[k])
        slices.pressure_cell[k] = cell
        slices.along_pressure[k] = position
    for n in range(behind - FIRST_SLICE):
        k = FIRST_SLICE + n
        slices.logarithm[k] = _on_line(
            chords.log_viscosities, slices.pressure_cell[k], slices.along_pressure[k]
        )
    for n in range(behind - FIRST_SLICE):
        k = FIRST_SLICE + n
        film = slices.log_film[k], slices.unit[k]
        cell, position, below, unit = _along_slip(
            chords, rheology, slices.pressure[k], slices.speed[k], slices.logarithm[k], film
        )
        slices.slip_cell[k] = cell
        slices.along_slip[k] = position
        slices.logarithm[k] = below
        slices.unit[k] = unit
    for n in range(behind - FIRST_SLICE):
        k = FIRST_SLICE + n
        cells = slices.pressure_cell[k], slices.film_cell[k], slices.slip_cell[k]
        positions = slices.along_pressure[k], slices.along_film[k], slices.along_slip[k]
        slices.logarithm[k] += _value(chords, cells, positions)
    for n in range(behind - FIRST_SLICE):
        k = FIRST_SLICE + n
        slices.stress[k] = _stress(rheology, slices.unit[k], slices.logarithm[k])
