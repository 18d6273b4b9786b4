"""Stress of the oil along the chords of a contact, looked up in its table by compiled functions.

A chord is the slice of the contact at one station of the roller's axis. The table is
`macroslip.contact.traction.ChordTable`. Chords of one contact are looked up together, in loops of
which each does one part of the work for all: the processor does several chords of such a loop at
once, and together they take half as long as one chord after the other, or less.
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
#: Most slices that are computed together.
_MOST = 32
#: Slices of a contact, each field over all of them. Whoever computes them fills the fields in use.
SLICES = np.dtype(
    [
        # Station ζ along the roller's axis [m].
        ("station", "f8", (_MOST,)),
        # Part of a station that the contact covers [-].
        ("covered", "f8", (_MOST,)),
        # Length of the chord over that of the longest [-].
        ("length", "f8", (_MOST,)),
        # Area [m²].
        ("area", "f8", (_MOST,)),
        # Largest pressure on the chord p1 [Pa].
        ("pressure", "f8", (_MOST,)),
        # Load per length [N/m], and half-width of the contact along rolling [m].
        ("load", "f8", (_MOST,)),
        ("half_width", "f8", (_MOST,)),
        # Slip along rolling with its sign, and size of the slip [m/s].
        ("slip", "f8", (_MOST,)),
        ("speed", "f8", (_MOST,)),
        # Looked up: mean shear stress q along the chord [Pa].
        ("stress", "f8", (_MOST,)),
        # Frictional power per length, and the part of it by asperities [W/m].
        ("power", "f8", (_MOST,)),
        ("asperities", "f8", (_MOST,)),
        # From loop to loop of the look-up: cells and positions in the table along pressures and
        # slips.
        ("pressure_cell", "i8", (_MOST,)),
        ("along_pressure", "f8", (_MOST,)),
        ("slip_cell", "i8", (_MOST,)),
        ("along_slip", "f8", (_MOST,)),
        # Logarithm of the oil's viscosity, and then of the stress over its unit.
        ("logarithm", "f8", (_MOST,)),
        # Unit of stress [Pa].
        ("unit", "f8", (_MOST,)),
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
    """Position of a film thickness in the table of chords, and numbers of the film's rheology.

    The table holds ln of the stress over a unit, by slip over another. Both units are numbers of the
    rheology, so that no chord asks which it is.
    """

    logarithm: float  #: ln h [ln m]
    cell: int  #: Cell of the table's axis of films
    position: float  #: Position in the cell, 0 to 1 [-]
    unit: float  #: Unit of stress without pressure [Pa]
    per_pressure: float  #: What is added to it per pressure [-]
    thickened: float  #: Power of the viscosity in the unit of slip [-]
    heated: float  #: Part of its logarithm that is added to that of the stress [-]
    limit: float  #: Largest stress over its unit [-]


@jit_inline
def film_node(chords, film):
    """Position of a film h [m] in the table of chords.

    For `chord_stresses`, once for all chords of a contact.
    """
    fluid = chords.fluid
    log_film = logarithm(film)
    cell, position = _node(chords.shape[1], (log_film - chords.lowest_film) * chords.per_log_film)
    if fluid.rheology == NEWTONIAN:
        unit = 1.0 / (math.sqrt(max(fluid.heating, 1e-30)) * film)
        return FilmNode(log_film, cell, position, unit, 0.0, 0.5, 1.0, math.inf)
    if fluid.rheology == LIMITING_SHEAR:
        # A spline overshoots where limited stress turns into falling; the limit itself, γ p1 ∫cos²θ
        # dθ, holds all the same.
        limit = 0.25 * math.pi
        return FilmNode(log_film, cell, position, 0.0, fluid.characteristic, 1.0, 0.0, limit)
    return FilmNode(log_film, cell, position, fluid.characteristic, 0.0, 1.0, 0.0, math.inf)


@jit_evaluation
def _along_pressure(chords, pressure):
    """Cell and position along the table's axis of pressures, of a largest pressure [Pa]."""
    kept = min(max(pressure, LOWEST_PRESSURE), HIGHEST_PRESSURE)
    return _node(chords.shape[0], math.sqrt(math.sqrt(kept)) * chords.per_root)


@jit_evaluation
def _along_slip(chords, node, pressure, slip, log_viscosity):
    """Cell and position along the table's axis of slips, of a pressure [Pa] and a slip [m/s].

    With them come what is added to the value there, a logarithm, and the unit of stress [Pa].
    """
    kept = min(max(pressure, LOWEST_PRESSURE), HIGHEST_PRESSURE)
    unit = node.unit + node.per_pressure * kept
    ahead = node.thickened * log_viscosity
    log_slip = logarithm(max(slip, NO_SLIP) / unit) - node.logarithm + ahead - LOWEST_LOG_SLIP
    cell, position = _node(chords.shape[2], log_slip * chords.per_log_slip)
    # Below the first slip of the table stress is in proportion to slip.
    return cell, position, min(log_slip, 0.0) + node.heated * ahead, unit


@jit_evaluation
def _value(chords, node, cells, positions):
    """Value of the table, ln of the stress over its unit: cells and positions by pressure and slip."""
    (_, films, slips) = chords.shape
    start = (cells[0] * films + node.cell) * slips + cells[1]
    within = positions[0], node.position, positions[1]
    return spline_value(chords.coefficients, start, (films * slips, slips), within)  # pyright: ignore[reportCallIssue]


@jit_evaluation
def _stress(node, unit, value):
    """Stress [Pa] of a unit [Pa] and the logarithm of what it is taken times."""
    return min(unit * exponential(value), node.limit * unit)


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
    i, t = _along_pressure(chords, pressure)
    log_viscosity = _on_line(chords.log_viscosities, i, t)
    j, u, below, unit = _along_slip(chords, node, pressure, slip, log_viscosity)
    return _stress(node, unit, _value(chords, node, (i, j), (t, u)) + below)


@jit_inline
def chord_stresses(chords, node, slices, count):
    """Write the mean shear stress along chords under one film, as `chord_stress_at` gives it.

    Parameters
    ----------
    chords : ChordTable
        Table of the oil.
    node : FilmNode
        The film's position in the table, by `film_node`.
    slices : record of `SLICES`
        `pressure` and `speed` are taken, and `stress` is written.
    count : int
        Number of slices.
    """
    for k in range(count):
        cell, position = _along_pressure(chords, slices.pressure[k])
        slices.pressure_cell[k] = cell
        slices.along_pressure[k] = position
    for k in range(count):
        slices.logarithm[k] = _on_line(
            chords.log_viscosities, slices.pressure_cell[k], slices.along_pressure[k]
        )
    for k in range(count):
        cell, position, below, unit = _along_slip(
            chords, node, slices.pressure[k], slices.speed[k], slices.logarithm[k]
        )
        slices.slip_cell[k] = cell
        slices.along_slip[k] = position
        slices.logarithm[k] = below
        slices.unit[k] = unit
    for k in range(count):
        cells = slices.pressure_cell[k], slices.slip_cell[k]
        positions = slices.along_pressure[k], slices.along_slip[k]
        slices.logarithm[k] += _value(chords, node, cells, positions)
    for k in range(count):
        slices.stress[k] = _stress(node, slices.unit[k], slices.logarithm[k])
