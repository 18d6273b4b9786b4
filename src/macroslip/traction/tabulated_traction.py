"""A traction law given as an ordinary function of arrays: tabulated once for each interface, and looked up after that.

The table is a cubic spline of ln(F/Δu) over ln Q, ln h and ln Δu. Outside it ln(F/Δu) is continued with its slopes
at the edge, but for slips below the least, where force is in proportion to slip.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.ndimage import minimum_filter

from macroslip.compiled import jit
from macroslip.contact.interface import Interface
from macroslip.contact.spline import Axis, nearest_cell
from macroslip.contact.spline_cell import channels_in_cell
from macroslip.contact.tabulated_function import Coordinate, Function, Kind, prepared_once, splines
from macroslip.traction.traction_law import register_name, register_type

_KIND = Kind(
    "traction law",
    "a force",
    "force",
    "N",
    (
        Coordinate("a load", "load", "N", 1e-3, 1e6),
        Coordinate("a film", "film", "m", 1e-9, 1e-3),
        Coordinate("a slip", "slip", "m/s", 1e-10, 1e2),
    ),
    spacing=0.3,
)
#: Loads [N], films [m] and slips [m/s] of contacts of a bearing, and how many random states among them are compared.
_USUAL, _STATES = ((1.0, 2e5), (3e-8, 1e-5), (1e-7, 1.0)), 3000


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
        zero; positive and smooth, in proportion to slip where that is small. Neither derivatives nor compilation are
        needed.
    reference : str
        What to cite where the law was used.

    Raises
    ------
    InputError
        If the name is taken by a law of another module; and when a case uses the law, if what the function returns
        is of another shape, not positive, or not smooth.

    Examples
    --------
    >>> from macroslip.traction import traction_law
    >>> register_function("couette", lambda interface, load, film, slip: 1e-4 * slip / film, reference="none")
    >>> traction_law.remove("couette")
    """
    prepare = prepared_once(traction, lambda interface: tabulated_law(name, traction, interface))
    register_name(name, reference=reference, prepare=prepare)


def tabulated_law(name: str, traction: Callable, interface: Interface) -> TabulatedTraction:
    """Tabulate a function for an interface; the parameters and errors are those of `register_function`."""
    law = Function(_KIND, name, traction, interface)
    (_, _, slip), force = law.at_nodes()
    coefficients = splines(force / slip)
    falls = np.diff(force, axis=2) <= 0.0
    first = np.where(falls.any(axis=2), falls.argmax(axis=2), force.shape[2] - 1)
    slips = np.append(slip[0, 0, :-1], np.inf)
    # The node before the one from which on it falls is sure to lie where it rises.
    rising = minimum_filter(np.where(np.isinf(slips[first]), np.inf, slips[np.maximum(first - 1, 0)]), size=3)
    random = np.random.default_rng(1)
    states = [np.exp(random.uniform(math.log(low), math.log(high), _STATES)) for low, high in _USUAL]
    law.check(coefficients, states, law.at(states) / states[2])
    by_load, by_film, by_slip = _KIND.axes()
    return TabulatedTraction(by_load, by_film, by_slip, coefficients, rising)
