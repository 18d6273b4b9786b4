"""Common parts of film and traction laws that are ordinary functions of arrays: evaluation, splines, and checks."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from scipy.ndimage import map_coordinates

from macroslip.compiled import depend_on
from macroslip.contact.interface import Interface
from macroslip.contact.spline import Axis, axis_nodes, log_axis, tensor_coefficients
from macroslip.errors import InputError

#: Relative error of the splines beyond which a function is refused: a law with a kink has it in a few cells.
_LARGEST_ERROR = 1e-2
#: Splines of a table; one is used.
_CHANNELS = 4
#: Tables that are kept of one law, of up to 11 MB each: those of a few oils at three interfaces.
_KEPT = 9


class Coordinate(NamedTuple):
    """What a law depends on.

    Attributes
    ----------
    name : str
        With its article.
    short_name, unit : str
    least, most : float
        Of a table.
    """

    name: str
    short_name: str
    unit: str
    least: float
    most: float


class Kind(NamedTuple):
    """Laws of one kind.

    Attributes
    ----------
    name : str
        Such as `film law`.
    gives, symbol, unit : str
        What such a law gives: with its article, in a word, and its unit.
    coordinates : tuple of Coordinate
    spacing : float
        Distance of the nodes of a table in the coordinates' logarithms.
    """

    name: str
    gives: str
    symbol: str
    unit: str
    coordinates: tuple[Coordinate, ...]
    spacing: float

    def axes(self) -> tuple[Axis, ...]:
        """Of the coordinates' logarithms."""
        return tuple(log_axis((one.least, one.most), self.spacing) for one in self.coordinates)


class Function(NamedTuple):
    """A law of one interface as a function: `function(interface, *coordinates)`, with arrays of one shape."""

    kind: Kind
    name: str
    function: Callable
    interface: Interface

    @property
    def where(self) -> str:
        """Name of the law and interface, for messages."""
        return f"{self.kind.name} {self.name}, {self.interface.name}"

    def at(self, states: list[np.ndarray]) -> np.ndarray:
        """Values of the law at states, an array for each coordinate.

        Raises
        ------
        InputError
            If what the function returns is of another shape, or not positive.
        """
        found = np.asarray(self.function(self.interface, *states), dtype=float)
        coordinates = self.kind.coordinates
        if found.shape != states[0].shape:
            raise InputError(
                f"for arrays of shape {states[0].shape} the function returns one of shape {found.shape}",
                where=self.where,
                allowed=f"{self.kind.gives} for every {_listed([one.short_name for one in coordinates])}",
                remedy="Let the function work on arrays element by element, as NumPy's functions do.",
            )
        wrong = ~(np.isfinite(found) & (found > 0.0))
        if wrong.any():
            state = [
                f"{one.name} of {value[wrong][0]:.4g} {one.unit}"
                for one, value in zip(coordinates, states, strict=True)
            ]
            ranges = [f"{one.least:g} to {one.most:g} {one.unit}" for one in coordinates]
            raise InputError(
                f"at {_listed(state)} the {self.kind.symbol} is {found[wrong][0]:.4g} {self.kind.unit}",
                where=self.where,
                allowed=f"a positive number from {_listed(ranges)}",
                remedy="Mend the function, or let it go on smoothly beyond the range of its formula.",
            )
        return found

    def at_nodes(self) -> tuple[list[np.ndarray], np.ndarray]:
        """States of all nodes of a table, and the law's values there."""
        states = list(np.meshgrid(*(np.exp(axis_nodes(one)) for one in self.kind.axes()), indexing="ij"))
        return states, self.at(states)

    def check(self, coefficients: np.ndarray, states: list[np.ndarray], expected: np.ndarray) -> None:
        """Refuse a function that the splines do not follow.

        Parameters
        ----------
        coefficients : ndarray
            From `splines`.
        states : list of ndarray
        expected : ndarray
            Values there whose logarithm the first spline is.

        Raises
        ------
        InputError
            With the state of the largest error.
        """
        # A spline has one coefficient before its first node.
        places = [
            (np.log(one) - axis.first) * axis.per_spacing + 1.0
            for one, axis in zip(states, self.kind.axes(), strict=True)
        ]
        found = np.exp(map_coordinates(coefficients[..., 0], places, order=3, prefilter=False))
        off = np.abs(found / expected - 1.0)
        worst = np.unravel_index(np.argmax(off), off.shape)
        if off[worst] > _LARGEST_ERROR:
            state = [f"{one[worst]:.4g} {c.unit}" for one, c in zip(states, self.kind.coordinates, strict=True)]
            raise InputError(
                f"the table of the function misses it by {100.0 * off[worst]:.2g} % at {_listed(state)}",
                where=self.where,
                allowed=f"a function without jumps, that a spline follows within {100.0 * _LARGEST_ERROR:g} %",
                remedy="Smooth the function there, or write the law with its derivatives (docs/laws.md).",
            )


def splines(values: np.ndarray) -> np.ndarray:
    """Coefficients of the splines of a table, of which the first goes through the logarithms of `values`.

    Examples
    --------
    >>> splines(np.ones((5, 6))).shape
    (7, 8, 4)
    """
    channels = np.zeros((*values.shape, _CHANNELS))
    channels[..., 0] = np.log(values)
    return tensor_coefficients(channels, values.ndim)


def prepared_once(function: Callable, tabulate: Callable[[Interface], Any]) -> Callable[[Interface], Any]:
    """What prepares a law of the user's own for an interface, each only once: `tabulate`, whose tables are kept.

    Kernels depend on the function, and the name that the law gets belongs to the module of the function.
    """
    depend_on(function)
    prepare = functools.lru_cache(maxsize=_KEPT)(tabulate)
    prepare.__module__ = function.__module__
    return prepare


def _listed(words: list[str]) -> str:
    return f"{', '.join(words[:-1])} and {words[-1]}"
