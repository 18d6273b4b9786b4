"""Rating numbers of a case, from the same loads as its slip."""

from __future__ import annotations

from typing import TYPE_CHECKING

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
        Its laws do not matter: a rating knows only loads, speed and viscosity. Nor does its window.
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
