"""The chord stress as a table: a tensor-product cubic spline of ln q over pressure, slip and film thickness.

A contact needs the stress on some forty chords for every force evaluation, and each of them two dozen solutions of the
heat balance; the same numbers recur all the time, for every roller of every case. So they are computed once for a
lubricant. The spline is twice continuously differentiable, and its derivatives are those of its own value.

Coordinates are the fourth root of p1, the logarithm of slip over `characteristic_slip`, and the logarithm of film
thickness. Below the first slip a film is Newtonian and cool, and stress is proportional to slip.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_inline, jit_part
from macroslip.contact.spline import tensor_coefficients
from macroslip.contact.spline_cell import along_line, in_cell, weights_and_slopes
from macroslip.contact.table_store import stored, table_key
from macroslip.traction.chord import Fluid, characteristic_slip, characteristic_stress, log_viscosity
from macroslip.traction.chord_build import chord_coefficients
from macroslip.traction.rheology import EYRING, LIMITING_SHEAR, NEWTONIAN

#: Largest pressure of the table [Pa]; higher ones are treated as this one.
HIGHEST_PRESSURE = 4e9
_LOWEST_PRESSURE = 10.0
_THINNEST, _THICKEST = 2e-8, 4e-4
_FASTEST = 5.0
# A thick film of the largest Eyring stress heats by 1e-3 at exp(-10) of its characteristic slip already.
_LOWEST_LOG_SLIP = -12.0

#: Pressures, and spacing of slips and of films in their logarithms. Eyring's stress has no corner at a limit: with a third of
#: the nodes, interpolated stress is off by a tenth of what that of limiting shear is.
_GRIDS = {NEWTONIAN: (80, 0.3, 0.35), LIMITING_SHEAR: (80, 0.3, 0.35), EYRING: (56, 0.45, 0.5)}


class ChordTable(NamedTuple):
    """Spline coefficients and grid; one a fluid, shared by all contacts and threads.

    Attributes
    ----------
    fluid : Fluid
    coefficients : ndarray, shape (pressures + 2, films + 2, slips + 2)
    log_viscosities : ndarray, shape (pressures + 2,)
        Of the spline of ln η.
    pressure_spacing : float
        In p1^¼ [Pa^¼].
    slip_spacing, film_spacing : float
        In the logarithms [-].
    lowest_film : float
        ln h of the first node.
    """

    fluid: Fluid
    coefficients: np.ndarray
    log_viscosities: np.ndarray
    pressure_spacing: float
    slip_spacing: float
    film_spacing: float
    lowest_film: float


@lru_cache(maxsize=16)
def chord_table(fluid: Fluid) -> ChordTable:
    """The table of a fluid, computed in some tenths of a second and kept, by this process and on disk.

    Notes
    -----
    With limiting shear and Roelands' viscosity the relative error of the interpolated stress is below 1e-3 (in 99 of 100
    places 1e-4) up to 2 GPa and 0.05 m/s in films of 0.1 to 2 µm, and from 1 kPa to 30 MPa in any film. Where a contact
    above 1 GPa skids at 0.4 m/s and limited stress gives way to heating it reaches 1 %, in less than one place in a hundred;
    with Barus' viscosity, 4 %. In films beyond 10 µm under more than 30 MPa or slips beyond 0.6 m/s it may be several per
    cent. With Eyring's law it is 5e-4 at most (3e-5) up to 0.05 m/s, and 2e-3 beyond, for viscosities of 0.05 to 1.5 Pa s.
    The limiting stress itself is never exceeded.
    """
    count, slip_spacing, film_spacing = _GRIDS[fluid.rheology]
    roots = np.linspace(0.0, HIGHEST_PRESSURE**0.25, count)
    films = np.arange(math.log(_THINNEST), math.log(_THICKEST) + film_spacing, film_spacing)
    slowest = min(_slip_scale(fluid, p, math.exp(films[0])) for p in np.maximum(roots**4, _LOWEST_PRESSURE)[1:])
    # A spline needs five nodes, even where stress is proportional to slip all through: Newtonian, without heating.
    highest = max(math.log(_FASTEST / slowest) + slip_spacing, _LOWEST_LOG_SLIP + 4.5 * slip_spacing)
    slips = np.arange(_LOWEST_LOG_SLIP, highest, slip_spacing)
    pressures = np.maximum(roots**4, _LOWEST_PRESSURE)
    viscosities = tensor_coefficients(np.array([log_viscosity(fluid, p)[0] for p in pressures]), 1)
    grid = pressures, slips, films
    (values,) = stored(table_key("chord", fluid, *grid), lambda: [chord_coefficients(fluid, *grid)])
    return ChordTable(fluid, values, viscosities, float(roots[1]), slip_spacing, film_spacing, float(films[0]))


def _slip_scale(fluid: Fluid, pressure: float, film_thickness: float) -> float:
    return characteristic_slip(fluid, log_viscosity(fluid, pressure)[0], pressure, film_thickness)


class FilmPlace(NamedTuple):
    """Where a film thickness lies in the table: it is the same for all chords of a contact."""

    film_thickness: float
    cell: int
    weights: tuple[float, float, float, float]
    slopes: tuple[float, float, float, float]


@jit_inline
def film_place(table, film_thickness):
    """The place of a film thickness h [m]; outside the table heating is that of its thinnest or thickest film."""
    z = (math.log(film_thickness) - table.lowest_film) / table.film_spacing
    z = min(max(z, 0.0), table.coefficients.shape[1] - 3.0)
    cell = min(int(z), table.coefficients.shape[1] - 4)
    return FilmPlace(film_thickness, cell, *weights_and_slopes(z - cell))  # pyright: ignore[reportCallIssue]


class ChordStress(NamedTuple):
    """Stress q [Pa] and its logarithmic derivatives by slip, by pressure p1 and by film thickness [-]."""

    stress: float
    by_slip: float
    by_pressure: float
    by_film: float


@jit_inline
def chord_place(table, film_thickness, pressure, slip):
    """Where a chord lies in the table.

    Parameters
    ----------
    table : ChordTable
    film_thickness : float
        h [m].
    pressure : float
        p1 [Pa], > 0.
    slip : float
        |Δu| > 0 [m/s].

    Returns
    -------
    x : float
        Place along pressure, in nodes.
    log_slip : float
        ln of slip over `characteristic_slip` of a film whose viscosity is 1 Pa s.
    """
    pressure = _within(pressure)
    # Reciprocals are taken once for all chords of a contact; divisions would be a tenth of the time.
    x = math.sqrt(math.sqrt(pressure)) * (1.0 / table.pressure_spacing)
    return x, math.log(slip / characteristic_slip(table.fluid, 0.0, pressure, film_thickness))


class ChordValue(NamedTuple):
    """ln of stress over its unit, and the logarithmic derivatives of stress by slip, pressure p1 and film thickness [-]."""

    log_stress: float
    by_slip: float
    by_pressure: float
    by_film: float


@jit_inline
def chord_value(table, place, x, log_slip, with_film):
    """Values of the table for a chord.

    Parameters
    ----------
    table : ChordTable
    place : FilmPlace
        Of the film thickness.
    x, log_slip : float
        From `chord_place`.
    with_film : bool
        Whether the derivative by film thickness is wanted with the heating in it; without, it is that of a cool film.

    Returns
    -------
    ChordValue
    """
    c = table.coefficients
    i = min(int(x), c.shape[0] - 4)
    log_eta, log_eta_by_x = along_line(table.log_viscosities, i, x - i)  # pyright: ignore[reportCallIssue]
    steepness = 0.25 * x * log_eta_by_x
    newtonian = table.fluid.rheology == NEWTONIAN
    log_slip += 0.5 * log_eta if newtonian else log_eta
    y = (log_slip - _LOWEST_LOG_SLIP) * (1.0 / table.slip_spacing)
    below = y < 0.0
    y = min(max(y, 0.0), c.shape[2] - 3.0)
    j = min(int(y), c.shape[2] - 4)
    cells = i, place.cell, j
    value, by_x, by_y = in_cell(c, cells, x - i, y - j, place.weights)
    by_film = 0.0
    if with_film:
        by_film = in_cell(c, cells, x - i, y - j, place.slopes)[0] / table.film_spacing
    slope = by_y * (1.0 / table.slip_spacing)
    if below:
        value += log_slip - _LOWEST_LOG_SLIP
        slope = 1.0
    by_pressure = 0.25 * by_x * x
    if newtonian:
        value += 0.5 * log_eta
        by_pressure += 0.5 * steepness * (1.0 + slope)
        by_film -= 1.0 if with_film else slope
    else:
        share = 1.0 if table.fluid.rheology == LIMITING_SHEAR else 0.0
        by_pressure += share + slope * (steepness - share)
        by_film -= slope
    return ChordValue(value, slope, by_pressure, by_film)


@jit_inline
def stress_of(table, film_thickness, pressure, value):
    """Stress along a chord with these values of the table.

    Parameters
    ----------
    table : ChordTable
    film_thickness, pressure : float
        As for `chord_place`.
    value : ChordValue

    Returns
    -------
    ChordStress
    """
    fluid, pressure = table.fluid, _within(pressure)
    if fluid.rheology == NEWTONIAN:
        unit = characteristic_slip(fluid, 0.0, pressure, film_thickness) / film_thickness
    else:
        unit = characteristic_stress(fluid, pressure)
    stress = unit * math.exp(value.log_stress)
    # A spline overshoots where limited stress turns into falling; the limit itself, γ p1 ∫cos²θ dθ, holds all the same.
    if fluid.rheology == LIMITING_SHEAR and stress > 0.25 * math.pi * unit:
        return ChordStress(0.25 * math.pi * unit, 0.0, 1.0, 0.0)
    return ChordStress(stress, value.by_slip, value.by_pressure, value.by_film)


@jit_inline
def interpolated_stress(table, place, pressure, slip, with_film):
    """Mean stress along a chord from the table.

    Parameters
    ----------
    table : ChordTable
    place : FilmPlace
        Of the film thickness.
    pressure : float
        p1 [Pa], > 0.
    slip : float
        |Δu| > 0 [m/s].
    with_film : bool
        As for `chord_value`.

    Returns
    -------
    ChordStress
    """
    x, log_slip = chord_place(table, place.film_thickness, pressure, slip)
    value = chord_value(table, place, x, log_slip, with_film)
    return stress_of(table, place.film_thickness, pressure, value)


@jit_part
def _within(pressure):
    return min(max(pressure, _LOWEST_PRESSURE), HIGHEST_PRESSURE)
