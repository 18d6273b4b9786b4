"""Loads of the rollers of a case, and its rating numbers, from the same loads as its slip."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from macroslip.case.case import BALANCE, Case
from macroslip.errors import InputError
from macroslip.kinds import kind_of
from macroslip.rating import rate
from macroslip.rating.rate import CONTAMINATION

#: One of so many samples of the ring balance is used.
_EVERY = 5


def roller_load_series(case: Case, start: float, end: float) -> tuple[NDArray, NDArray]:
    """Elastic load of every roller at every fifth sample of the ring balance between two times [s].

    Returns m times [s] and loads [N] of shape (m, 2, rollers), by time, row and roller. Raises
    InputError as `macroslip.rating.roller_load_history`.
    """
    loads, roller_load, _ = kind_of(case.bearing).load_history(case)
    is_inside = (loads.time >= start) & (loads.time <= end)
    chosen = np.flatnonzero(is_inside)[::_EVERY]
    load_of_samples = np.moveaxis(roller_load[..., chosen], -1, 0)
    return loads.time[chosen], load_of_samples


def rate_case(case: Case, *, contamination: float = CONTAMINATION) -> xr.Dataset:
    """Rate the main bearing of a case over all of its loads.

    As `macroslip.rating.rate` with the contamination factor e_C [-]; the case's laws and window do
    not matter, since a rating depends only on loads, speed and viscosity.

    Examples
    --------
    >>> from macroslip import BearingLoads, Case
    >>> rating = rate_case(Case(loads=BearingLoads.constant([0.0, -400e3, 60e3], 2.1, 1.0)))
    >>> round(float(rating.static_safety), 2)
    30.64
    """
    loads, roller_loads, strips = kind_of(case.bearing).load_history(case)
    return rate(
        case.bearing, case.oil, loads, roller_loads, contamination=contamination, strips=strips
    )


def with_rating(result: xr.Dataset, case: Case) -> xr.Dataset:
    """The result with the variables of `macroslip.rating.rate`; as it is with `rating: false`.

    The attributes `rating_contamination` and `rating_film_law` are added. A bearing that lacks what
    a rating needs has the reason in the attribute `rating_problem` instead.
    """
    if not case.rating:
        return result
    if case.temperature == BALANCE:
        temperature = float(result.inlet_temperature)
        case = replace(case, temperature=temperature, heat=None)
    try:
        rating = rate_case(case)
    except InputError as problem:
        return result.assign_attrs(rating_problem=str(problem))
    attributes = {"rating_contamination": rating.contamination, "rating_film_law": rating.film_law}
    # A class of load is another load in every case, so its middle is a variable and no coordinate.
    middle = rating.load_class.variable
    rating = rating.drop_vars("load_class").assign(load_class_middle=middle)
    merged = result.merge(rating.drop_attrs(deep=False))
    return merged.assign_attrs(result.attrs | attributes)
