"""Compute the chord stress over a grid of pressures, films and slips, for its table."""

from __future__ import annotations

import math
from functools import cache
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_lawless
from macroslip.contact.spline import (
    Axis,
    axis,
    axis_middles,
    axis_nodes,
    cell_of,
    middle_values,
    read_only,
    tensor_coefficients,
)
from macroslip.contact.spline_cell import weights_and_slopes
from macroslip.traction.chord import (
    WEIGHTS,
    Fluid,
    along_chord,
    characteristic_slip,
    characteristic_stress,
    log_viscosity,
    stress_along,
)
from macroslip.traction.film_shear import heated_shear
from macroslip.traction.rheology import LIMITING_SHEAR, NEWTONIAN

#: Slip [m/s] from which on the table is continued in a straight line: in light contacts it reaches a million times further.
#: That is seven nodes and more beyond the slips that are looked up, and at each node a spline forgets three quarters of
#: what is done beyond.
_CONTINUED = 150.0
#: Bounds and spacing of both coordinates of the local stress, and its relative error beyond which it is solved for.
_BOUNDS, _SPACING, _LARGEST_ERROR = ((-14.0, 8.0), (-22.0, 8.0)), 0.1, 1e-6


class LocalStress(NamedTuple):
    """Stress of a limited, self-heated film at one place, over its limiting or Eyring stress τ_L.

    It depends on two numbers only, so that one table serves all oils.

    Attributes
    ----------
    viscous, heat : Axis
        Of ln(η_s Δu/(h τ_L)) and ln(β h Δu τ_L/(8k)).
    coefficients : ndarray, shape (viscous + 2, heat + 2)
        Of the spline of ln(τ/τ_L).
    good : ndarray of bool, shape of the cells
        Whether its error in the middle of the cell is within `_LARGEST_ERROR`.
    """

    viscous: Axis
    heat: Axis
    coefficients: np.ndarray
    good: np.ndarray


@jit
def _solved(rheology, viscous, heat):
    """Ln(τ/τ_L), each of the two coordinates an array."""
    values = np.empty((viscous.size, heat.size))
    for i in range(viscous.size):
        for j in range(heat.size):
            values[i, j] = math.log(heated_shear(rheology, math.exp(viscous[i]), 1.0, math.exp(heat[j]))[0])
    return values


@cache
def local_stress(rheology: int) -> LocalStress:
    """The table of a rheology other than the Newtonian one."""
    viscous, heat = (axis(*bounds, _SPACING) for bounds in _BOUNDS)
    coefficients = tensor_coefficients(_solved(rheology, axis_nodes(viscous), axis_nodes(heat)), 2)
    off = np.abs(middle_values(coefficients, 2) - _solved(rheology, axis_middles(viscous), axis_middles(heat)))
    return LocalStress(viscous, heat, coefficients, read_only(off <= _LARGEST_ERROR))


@jit
def looked_up(table, rheology, viscous, heat):
    """Ln(τ/τ_L) at ln(η_s Δu/(h τ_L)) and ln(β h Δu τ_L/(8k)), from the table where it is good.

    Examples
    --------
    >>> round(looked_up(local_stress(1), 1, math.log(2.0), 0.0), 5)
    -0.36944
    >>> round(math.log(heated_shear(1, 2.0, 1.0, 1.0)[0]), 5)
    -0.36944
    """
    i, t = cell_of(table.viscous, viscous)
    j, u = cell_of(table.heat, heat)
    if i < 0 or j < 0 or not table.good[i, j]:
        return math.log(heated_shear(rheology, math.exp(viscous), 1.0, math.exp(heat))[0])
    along, _ = weights_and_slopes(t)  # pyright: ignore[reportCallIssue]
    across, _ = weights_and_slopes(u)  # pyright: ignore[reportCallIssue]
    total = 0.0
    for k in range(4):
        row = table.coefficients[i + k]
        total += along[k] * (
            across[0] * row[j] + across[1] * row[j + 1] + across[2] * row[j + 2] + across[3] * row[j + 3]
        )
    return total


@jit
def _mean_stress(table, fluid, chord, film_thickness, slip):
    """`macroslip.traction.chord.stress_along` by the table; `chord` are viscosities and limits, and their logarithms."""
    viscosities, limits, log_viscosities, log_limits = chord
    if fluid.rheology == NEWTONIAN or fluid.heating == 0.0:
        return stress_along(fluid, viscosities, limits, film_thickness, slip)
    log_rate, log_heat = math.log(slip / film_thickness), math.log(fluid.heating * film_thickness * slip)
    total = 0.0
    for node in range(limits.size):
        viscous = log_viscosities[node] + log_rate - log_limits[node]
        local = looked_up(table, fluid.rheology, viscous, log_heat + log_limits[node])
        total += WEIGHTS[node] * limits[node] * math.exp(local)
    return total


@jit
def _reference(fluid, log_eta, pressure, film_thickness, scale):
    """Ln of the stress to which the table's values refer."""
    if fluid.rheology == NEWTONIAN:
        return log_eta + math.log(scale / film_thickness)
    return math.log(characteristic_stress(fluid, pressure))


@jit_lawless
def chord_values(table, fluid, pressures, slips, films):
    """Ln of the stress over its reference on the grid of a table, shape (pressures, films, slips).

    Parameters
    ----------
    table : LocalStress
    fluid : Fluid
    pressures : ndarray
        p1 [Pa].
    slips : ndarray
        Logarithms of slip over `characteristic_slip`.
    films : ndarray
        Logarithms of h [ln m].
    """
    values = np.empty((pressures.size, films.size, slips.size))
    for i in range(pressures.size):
        log_eta, _ = log_viscosity(fluid, pressures[i])
        viscosities, limits = along_chord(fluid, pressures[i])
        chord = viscosities, limits, np.log(viscosities), np.log(limits)
        for k in range(films.size):
            film = math.exp(films[k])
            scale = characteristic_slip(fluid, log_eta, pressures[i], film)
            reference = _reference(fluid, log_eta, pressures[i], film, scale)
            for j in range(slips.size):
                slip = scale * math.exp(slips[j])
                if slip > _CONTINUED and j > 1:
                    values[i, k, j] = 2.0 * values[i, k, j - 1] - values[i, k, j - 2]
                    continue
                values[i, k, j] = math.log(_mean_stress(table, fluid, chord, film, slip)) - reference
    return values


def chord_coefficients(fluid: Fluid, pressures: np.ndarray, slips: np.ndarray, films: np.ndarray) -> np.ndarray:
    """Coefficients of the spline of a fluid's chord stress; parameters are those of `chord_values`."""
    # A Newtonian film has no limit; its stress is solved for in closed form.
    table = local_stress(LIMITING_SHEAR if fluid.rheology == NEWTONIAN else fluid.rheology)
    return tensor_coefficients(chord_values(table, fluid, pressures, slips, films), 3)
