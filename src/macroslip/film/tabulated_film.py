"""A film law given as an ordinary function of arrays: tabulated once for each interface, and looked up after that.

The table is a cubic spline of ln h over ln Q and ln u_e. Outside it ln h goes on with the slope that it has at the edge.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from macroslip.compiled import depend_on, jit
from macroslip.contact.interface import Interface
from macroslip.contact.spline import Axis, axis_middles, axis_nodes, log_axis, nearest_cell, tensor_coefficients
from macroslip.contact.spline_cell import channels_in_square
from macroslip.errors import InputError
from macroslip.film.film_law import film_thickness as film_thickness_of
from macroslip.film.film_law import register, register_type

#: Loads [N] and entrainment speeds [m/s] of a table, and the distance of its nodes in their logarithms.
_LOADS, _SPEEDS, _SPACING = (1e-3, 1e7), (1e-6, 1e2), 0.12
#: Relative error in the middle of a cell beyond which a function is refused, where contacts of a bearing are: a law with
#: a kink has it in a few cells.
_LARGEST_ERROR = 1e-2
_USUAL_LOADS, _USUAL_SPEEDS = (1.0, 1e6), (1e-3, 10.0)
_CHANNELS = 4


class TabulatedFilm(NamedTuple):
    """Film of one interface.

    Attributes
    ----------
    load, speed : Axis
        Of ln Q and ln u_e.
    coefficients : ndarray, shape (loads + 2, speeds + 2, 4)
        Of ln h; one of four splines is used.
    """

    load: Axis
    speed: Axis
    coefficients: np.ndarray


@jit
def tabulated_thickness(law, load, entrainment_speed):
    """Film thickness h [m] and its derivatives by entrainment speed [s] and by load [m/N], from the table."""
    i, t, above = nearest_cell(law.load, math.log(load))
    j, u, faster = nearest_cell(law.speed, math.log(entrainment_speed))
    value, by_load, by_speed = channels_in_square(law.coefficients, (i, j), (t, u))  # pyright: ignore[reportCallIssue]
    load_slope, speed_slope = by_load[0] * law.load.per_spacing, by_speed[0] * law.speed.per_spacing
    film = math.exp(value[0] + above * load_slope + faster * speed_slope)
    return film, film * speed_slope / entrainment_speed, film * load_slope / load


@jit
def _anywhere(law, load, entrainment_speed):
    return True


register_type(TabulatedFilm, thickness=tabulated_thickness, in_range=_anywhere)


def register_function(name: str, film_thickness: Callable, *, reference: str) -> None:
    """Make a film law usable by name that is an ordinary function of NumPy arrays.

    Parameters
    ----------
    name : str
        Name in case files.
    film_thickness : callable
        `film_thickness(interface, load [N], entrainment_speed [m/s]) -> h [m]`, with arrays of one shape; positive, and
        smooth in both: neither derivatives nor compilation are asked for.
    reference : str
        What to cite where the law was used.

    Raises
    ------
    InputError
        If the name is taken by a law of another module; and when a case asks for the law, if what the function returns
        is of another shape, not positive, or not smooth.

    Notes
    -----
    In-range counts do not exist for such a law: `outside_film_range` is 0.

    Examples
    --------
    >>> from macroslip.film import film_law
    >>> register_function("square-root", lambda interface, load, speed: 1e-6 * np.sqrt(speed), reference="none")
    >>> film_law.remove("square-root")
    """

    def prepare(interface: Interface) -> TabulatedFilm:
        return tabulated_film(name, film_thickness, interface)

    # A name belongs to the module that registers it.
    prepare.__module__ = film_thickness.__module__
    depend_on(film_thickness)
    register(
        name, TabulatedFilm, reference=reference, prepare=prepare, thickness=tabulated_thickness, in_range=_anywhere
    )


def tabulated_film(name: str, film_thickness: Callable, interface: Interface) -> TabulatedFilm:
    """Tabulate a function for an interface; the parameters and errors are those of `register_function`."""
    load = log_axis(_LOADS, _SPACING)
    speed = log_axis(_SPEEDS, _SPACING)
    values = np.zeros((load.cells + 1, speed.cells + 1, _CHANNELS))
    values[..., 0] = np.log(
        _asked(name, film_thickness, interface, np.exp(axis_nodes(load)), np.exp(axis_nodes(speed)))
    )
    table = TabulatedFilm(load, speed, tensor_coefficients(values, 2))
    _check_smoothness(name, film_thickness, interface, table)
    return table


def _asked(
    name: str, film_thickness: Callable, interface: Interface, loads: np.ndarray, speeds: np.ndarray
) -> np.ndarray:
    """Film thickness [m] at all loads and speeds, of shape (loads, speeds)."""
    grid = np.meshgrid(loads, speeds, indexing="ij")
    found = np.asarray(film_thickness(interface, *grid), dtype=float)
    where = f"film law {name}, {interface.name}"
    if found.shape != grid[0].shape:
        raise InputError(
            f"for arrays of shape {grid[0].shape} the function returns one of shape {found.shape}",
            where=where,
            allowed="a film thickness for every load and speed",
            remedy="Let the function work on arrays element by element, as NumPy's functions do.",
        )
    wrong = ~(np.isfinite(found) & (found > 0.0))
    if wrong.any():
        one = tuple(np.argwhere(wrong)[0])
        raise InputError(
            f"at a load of {grid[0][one]:.4g} N and an entrainment speed of {grid[1][one]:.4g} m/s the film is "
            f"{found[one]:.4g} m",
            where=where,
            allowed=f"a positive number from {_LOADS[0]:g} to {_LOADS[1]:g} N and {_SPEEDS[0]:g} to {_SPEEDS[1]:g} m/s",
            remedy="Mend the function, or let it go on smoothly beyond the range of its formula.",
        )
    return found


def _check_smoothness(name: str, film_thickness: Callable, interface: Interface, table: TabulatedFilm) -> None:
    """Refuse a function that the table misses in the middle of a cell."""
    loads, speeds = np.exp(axis_middles(table.load)), np.exp(axis_middles(table.speed))
    loads = loads[(loads > _USUAL_LOADS[0]) & (loads < _USUAL_LOADS[1])]
    speeds = speeds[(speeds > _USUAL_SPEEDS[0]) & (speeds < _USUAL_SPEEDS[1])]
    expected = _asked(name, film_thickness, interface, loads, speeds)
    found = np.array([[film_thickness_of(table, load, speed)[0] for speed in speeds] for load in loads])
    off = np.abs(found / expected - 1.0)
    worst = np.unravel_index(np.argmax(off), off.shape)
    if off[worst] > _LARGEST_ERROR:
        raise InputError(
            f"the table of the function misses it by {100.0 * off[worst]:.2g} % at {loads[worst[0]]:.4g} N and "
            f"{speeds[worst[1]]:.4g} m/s",
            where=f"film law {name}, {interface.name}",
            allowed=f"a function without jumps, that a spline follows within {100.0 * _LARGEST_ERROR:g} %",
            remedy="Smooth the function there, or write the law with its derivatives (docs/laws.md).",
        )
