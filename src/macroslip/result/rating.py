"""Rating numbers of a case, from the same loads as its slip, and beside it in one dataset."""

from __future__ import annotations

from typing import TYPE_CHECKING

from macroslip.errors import InputError
from macroslip.loads import BearingLoads, main_bearing_load
from macroslip.rating import rate, roller_load_history
from macroslip.rating.rate import CONTAMINATION

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.case.case import Case


def rate_case(case: Case, *, contamination: float = CONTAMINATION) -> xr.Dataset:
    """Rate the main bearing of a case over all of its loads: safety, lives, pressures, film, minimum load, spectra.

    Parameters
    ----------
    case : Case
        Its laws do not matter: a rating depends only on loads, speed and viscosity. Nor does its window.
    contamination : float
        e_C of ISO 281 [-], above 0 and at most 1.

    Returns
    -------
    xarray.Dataset
        See `macroslip.rating.rate`.

    Raises
    ------
    InputError
        As `macroslip.rating.rate` and `macroslip.rating.roller_load_history`.

    Examples
    --------
    >>> from macroslip import BearingLoads, Case
    >>> rating = rate_case(Case(loads=BearingLoads.constant([0.0, -400e3, 60e3], 2.1, 1.0)))
    >>> round(float(rating.static_safety), 2)
    30.64
    """
    loads = case.loads if isinstance(case.loads, BearingLoads) else main_bearing_load(case.loads, case.drivetrain)
    history = roller_load_history(case.bearing, case.oil, loads)
    return rate(case.bearing, case.oil, *history, contamination=contamination)


def with_rating(result: xr.Dataset, case: Case) -> xr.Dataset:
    """The result of a case with the numbers of its rating as further variables.

    Parameters
    ----------
    result : xarray.Dataset
        From `simulate`.
    case : Case
        With `rating: false`, the result comes back as it is.

    Returns
    -------
    xarray.Dataset
        With the variables of `macroslip.rating.rate` and, as attributes, `rating_contamination` and `rating_film_law`. A
        bearing that lacks what a rating needs has the reason in the attribute `rating_problem` instead.
    """
    if not case.rating:
        return result
    try:
        rating = rate_case(case)
    except InputError as problem:
        return result.assign_attrs(rating_problem=str(problem))
    attributes = {"rating_contamination": rating.contamination, "rating_film_law": rating.film_law}
    # A class of load is another load in every case, so its middle is a variable and no coordinate.
    middle = rating.load_class.variable
    rating = rating.drop_vars("load_class").assign(load_class_middle=middle)
    return result.merge(rating.drop_attrs(deep=False)).assign_attrs(result.attrs | attributes)
