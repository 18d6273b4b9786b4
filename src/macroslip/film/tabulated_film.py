"""A film law given as an ordinary function of arrays: tabulated once for each interface, and looked up after that.

The table is a cubic spline of ln h over ln Q and ln u_e. Outside it ln h is continued with its slope at the edge.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit
from macroslip.contact.interface import Interface
from macroslip.contact.spline import Axis, axis_middles, nearest_cell
from macroslip.contact.spline_cell import channels_in_square
from macroslip.contact.tabulated_function import Coordinate, Function, Kind, prepared_once, splines
from macroslip.film.film_law import register_name, register_type

_KIND = Kind(
    "film law",
    "a film thickness",
    "film",
    "m",
    (Coordinate("a load", "load", "N", 1e-3, 1e7), Coordinate("an entrainment speed", "speed", "m/s", 1e-6, 1e2)),
    spacing=0.12,
)
#: Loads [N] and speeds [m/s] of contacts of a bearing, where a function has to be smooth.
_USUAL = (1.0, 1e6), (1e-3, 10.0)


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
        smooth in both: neither derivatives nor compilation are needed.
    reference : str
        What to cite where the law was used.

    Raises
    ------
    InputError
        If the name is taken by a law of another module; and when a case uses the law, if what the function returns
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
    prepare = prepared_once(film_thickness, lambda interface: tabulated_film(name, film_thickness, interface))
    register_name(name, reference=reference, prepare=prepare)


def tabulated_film(name: str, film_thickness: Callable, interface: Interface) -> TabulatedFilm:
    """Tabulate a function for an interface; the parameters and errors are those of `register_function`."""
    law = Function(_KIND, name, film_thickness, interface)
    coefficients = splines(law.at_nodes()[1])
    # Splines are furthest from a function in the middle of their cells.
    middles = [np.exp(axis_middles(axis)) for axis in _KIND.axes()]
    usual = [one[(one > low) & (one < high)] for one, (low, high) in zip(middles, _USUAL, strict=True)]
    states = np.meshgrid(*usual, indexing="ij")
    law.check(coefficients, states, law.at(states))
    by_load, by_speed = _KIND.axes()
    return TabulatedFilm(by_load, by_speed, coefficients)
