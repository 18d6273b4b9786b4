"""A traction law given as an ordinary function of arrays: tabulated once for each interface, and looked up after that.

The table is a cubic spline of ln(F/Δu) over ln Q, ln h and ln Δu. Outside it ln(F/Δu) goes on with the slopes that it has
at the edge, but for slips below the least, where force is in proportion to slip.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.ndimage import minimum_filter

from macroslip.compiled import depend_on, jit
from macroslip.contact.interface import Interface
from macroslip.contact.spline import Axis, axis_nodes, log_axis, nearest_cell, tensor_coefficients
from macroslip.contact.spline_cell import channels_in_cell
from macroslip.errors import InputError
from macroslip.traction.traction_law import patch_traction, register, register_type

#: Loads [N], films [m] and slips [m/s] of a table, and the distance of its nodes in their logarithms.
_LOADS, _FILMS, _SLIPS, _SPACING = (1e-3, 1e6), (1e-9, 1e-3), (1e-10, 1e2), 0.3
#: Relative error at random states beyond which a function is refused, and the states where contacts of a bearing are.
_LARGEST_ERROR = 1e-2
_USUAL = ((1.0, 2e5), (3e-8, 1e-5), (1e-7, 1.0))
_STATES, _CHANNELS = 3000, 4


class TabulatedTraction(NamedTuple):
    """Traction of one interface.

    Attributes
    ----------
    load, film, slip : Axis
        Of ln Q, ln h and ln Δu.
    coefficients : ndarray, shape (loads + 2, films + 2, slips + 2, 4)
        Of ln(F/Δu); one of four splines is used.
    rising : ndarray, shape (loads, films)
        Slip up to which force rises, at the nodes and all next to them [m/s].
    """

    load: Axis
    film: Axis
    slip: Axis
    coefficients: np.ndarray
    rising: np.ndarray


@jit
def tabulated_traction(law, load, film_thickness, slip):
    """F [N], ∂F/∂Δu [N s/m], ∂F/∂h [N/m] and ∂F/∂Q [-], from the table."""
    i, t, more = nearest_cell(law.load, math.log(load))
    k, s, thicker = nearest_cell(law.film, math.log(film_thickness))
    j, u, faster = nearest_cell(law.slip, math.log(max(abs(slip), 1e-300)))
    value, by_load, by_film, by_slip = channels_in_cell(law.coefficients, (i, k, j), (t, s, u))  # pyright: ignore[reportCallIssue]
    load_slope, film_slope = by_load[0] * law.load.per_spacing, by_film[0] * law.film.per_spacing
    # Below the least slip of the table force is in proportion to it.
    slip_slope = by_slip[0] * law.slip.per_spacing if faster >= 0.0 else 0.0
    ahead = more * load_slope + thicker * film_slope + faster * slip_slope
    conductance = math.exp(value[0] + ahead)
    force = conductance * slip
    return force, conductance * (1.0 + slip_slope), force * film_slope / film_thickness, force * load_slope / load


@jit
def _rising_slip(law, load, film_thickness):
    i, t, _ = nearest_cell(law.load, math.log(load))
    k, s, _ = nearest_cell(law.film, math.log(film_thickness))
    return law.rising[i + (1 if t > 0.5 else 0), k + (1 if s > 0.5 else 0)]


register_type(TabulatedTraction, traction=tabulated_traction, rising_slip=_rising_slip)


def register_function(name: str, traction: Callable, *, reference: str) -> None:
    """Make a traction law usable by name that is an ordinary function of NumPy arrays.

    Parameters
    ----------
    name : str
        Name in case files.
    traction : callable
        `traction(interface, load [N], film_thickness [m], slip [m/s]) -> F [N]`, with arrays of one shape and slip above
        zero; positive and smooth, in proportion to slip where that is small. Neither derivatives nor compilation are asked
        for.
    reference : str
        What to cite where the law was used.

    Raises
    ------
    InputError
        If the name is taken by a law of another module; and when a case asks for the law, if what the function returns
        is of another shape, not positive, or not smooth.

    Examples
    --------
    >>> from macroslip.traction import traction_law
    >>> register_function("couette", lambda interface, load, film, slip: 1e-4 * slip / film, reference="none")
    >>> traction_law.remove("couette")
    """

    def prepare(interface: Interface) -> TabulatedTraction:
        return tabulated(name, traction, interface)

    # A name belongs to the module that registers it.
    prepare.__module__ = traction.__module__
    depend_on(traction)
    register(
        name,
        TabulatedTraction,
        reference=reference,
        prepare=prepare,
        traction=tabulated_traction,
        rising_slip=_rising_slip,
    )


def tabulated(name: str, traction: Callable, interface: Interface) -> TabulatedTraction:
    """Tabulate a function for an interface; the parameters and errors are those of `register_function`."""
    axes = [log_axis(bounds, _SPACING) for bounds in (_LOADS, _FILMS, _SLIPS)]
    grid = np.meshgrid(*(np.exp(axis_nodes(one)) for one in axes), indexing="ij")
    force = _asked(name, traction, interface, grid)
    values = np.zeros((*force.shape, _CHANNELS))
    values[..., 0] = np.log(force / grid[2])
    falls = np.diff(force, axis=2) <= 0.0
    first = np.where(falls.any(axis=2), falls.argmax(axis=2), force.shape[2] - 1)
    slips = np.append(grid[2][0, 0, :-1], np.inf)
    # The node before the one from which on it falls is sure to lie where it rises.
    rising = minimum_filter(np.where(np.isinf(slips[first]), np.inf, slips[np.maximum(first - 1, 0)]), size=3)
    table = TabulatedTraction(axes[0], axes[1], axes[2], tensor_coefficients(values, 3), rising)
    _check_smoothness(name, traction, interface, table)
    return table


def _asked(name: str, traction: Callable, interface: Interface, states: list[np.ndarray]) -> np.ndarray:
    """Force [N] at states of load, film and slip."""
    found = np.asarray(traction(interface, *states), dtype=float)
    where = f"traction law {name}, {interface.name}"
    if found.shape != states[0].shape:
        raise InputError(
            f"for arrays of shape {states[0].shape} the function returns one of shape {found.shape}",
            where=where,
            allowed="a force for every load, film and slip",
            remedy="Let the function work on arrays element by element, as NumPy's functions do.",
        )
    wrong = ~(np.isfinite(found) & (found > 0.0))
    if wrong.any():
        load, film, slip = (float(one[wrong][0]) for one in states)
        raise InputError(
            f"at a load of {load:.4g} N, a film of {film:.4g} m and a slip of {slip:.4g} m/s the force is "
            f"{float(found[wrong][0]):.4g} N",
            where=where,
            allowed=f"a positive number from {_LOADS[0]:g} to {_LOADS[1]:g} N, {_FILMS[0]:g} to {_FILMS[1]:g} m and "
            f"{_SLIPS[0]:g} to {_SLIPS[1]:g} m/s",
            remedy="Mend the function, or let it go on smoothly beyond the range of its formula.",
        )
    return found


def _check_smoothness(name: str, traction: Callable, interface: Interface, table: TabulatedTraction) -> None:
    """Refuse a function that the table misses at random states."""
    random = np.random.default_rng(1)
    states = [np.exp(random.uniform(math.log(low), math.log(high), _STATES)) for low, high in _USUAL]
    expected = _asked(name, traction, interface, states)
    found = np.array([patch_traction(table, *map(float, state))[0] for state in zip(*states, strict=True)])
    off = np.abs(found / expected - 1.0)
    worst = int(np.argmax(off))
    if off[worst] > _LARGEST_ERROR:
        load, film, slip = (one[worst] for one in states)
        raise InputError(
            f"the table of the function misses it by {100.0 * off[worst]:.2g} % at {load:.4g} N, {film:.4g} m and "
            f"{slip:.4g} m/s",
            where=f"traction law {name}, {interface.name}",
            allowed=f"a function without jumps, that a spline follows within {100.0 * _LARGEST_ERROR:g} %",
            remedy="Smooth the function there, or write the law with its derivatives (docs/laws.md).",
        )
