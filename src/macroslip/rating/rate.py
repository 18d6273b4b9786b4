"""All rating numbers of a bearing under one load history, as one dataset."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from macroslip.bearing.frames import ROWS
from macroslip.errors import InputError
from macroslip.rating import iso76, iso281, iso16281
from macroslip.rating.contacts import FILM_LAW, contact_numbers
from macroslip.rating.history import RACEWAYS, History, load_history, variable
from macroslip.rating.minimum_load import minimum_load
from macroslip.rating.spectrum import damage_equivalent_load, load_duration
from macroslip.roller.model import interfaces

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    from macroslip.bearing import Bearing
    from macroslip.loads import BearingLoads
    from macroslip.lubricant import Lubricant

#: How the load of a roller lies along it, for the reference life.
DISTRIBUTIONS = ("hertz", "uniform")
LOADS = ("radial", "axial", "equivalent")
LOAD_CLASSES = 40
CONTAMINATION = 0.5
"""e_C by default: between slight and typical contamination of a bearing with a pitch above 100 mm; an estimate."""
WOHLER_EXPONENTS = (4.0, 10.0)


def rate(
    bearing: Bearing,
    lubricant: Lubricant,
    loads: BearingLoads,
    roller_load: NDArray[np.float64],
    *,
    contamination: float = CONTAMINATION,
    wohler_exponents: tuple[float, ...] = WOHLER_EXPONENTS,
) -> xr.Dataset:
    """Rate a bearing: static safety, rating lives, pressures, film, minimum load and load spectra.

    Parameters
    ----------
    bearing : Bearing
        With load ratings and axial factors.
    lubricant : Lubricant
        Its viscosity and density are those at the inlet temperature.
    loads : BearingLoads
        Load on the inner ring and shaft speed, n samples.
    roller_load : ndarray, shape (2, Z, n)
        Elastic load of every roller [N] over row, roller and the samples of `loads`, see `roller_load_history`.
    contamination : float
        e_C of ISO 281 [-], above 0 and at most 1.
    wohler_exponents : tuple of float
        Slopes m for which damage-equivalent loads are given [-].

    Returns
    -------
    xarray.Dataset
        Variables with `units` and `long_name`. Lives are hours at the history's mean speed, as if it repeated for ever;
        they weigh loads by revolutions. NaN where the shaft does not turn or the standard defines no value.

    Raises
    ------
    InputError
        If the bearing lacks a rating or a factor, or an argument has another shape or is out of range.

    Examples
    --------
    >>> from macroslip import Bearing, BearingLoads, Lubricant
    >>> from macroslip.rating import roller_load_history
    >>> bearing, oil = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
    >>> weight = BearingLoads.constant([0.0, -400e3, 0.0], 2.1, 1.0)
    >>> rating = rate(bearing, oil, *roller_load_history(bearing, oil, weight))
    >>> round(float(rating.static_safety), 2), f"{float(rating.basic_life):.3g} {rating.basic_life.units}"
    (40.75, '2.21e+07 h')
    """
    import xarray as xr

    history = load_history(bearing, loads, roller_load)
    if not 0.0 < contamination <= 1.0:
        raise InputError(
            f"the contamination factor is {contamination!r}",
            allowed="a number above 0 and at most 1",
            remedy="1 is extreme cleanliness, 0.5 slight to typical contamination, 0.1 severe contamination",
        )
    parts = (
        _static(bearing, history),
        _iso281(bearing, lubricant, history, contamination),
        _reference(bearing, lubricant, history, contamination),
        contact_numbers(bearing, lubricant, history),
        _spectra(history, wohler_exponents),
    )
    variables = {name: value for part in parts for name, value in part.items()}
    edges = _class_edges(history)
    coordinates = {
        "row": list(ROWS),
        "raceway": list(RACEWAYS),
        "load_along_roller": list(DISTRIBUTIONS),
        "load": list(LOADS),
        "wohler_exponent": list(wohler_exponents),
        "load_class": variable(0.5 * (edges[1:] + edges[:-1]), "N", "middle of the class of load", "load_class"),
    }
    return xr.Dataset(variables, coordinates, {"bearing": bearing.name, "lubricant": lubricant.name,
                                               "contamination": contamination, "film_law": FILM_LAW})  # fmt: skip


def _share(condition: NDArray[np.bool_], weight: NDArray[np.float64]) -> float:
    return float(weight[condition].sum() / weight.sum())


def _viscosity_ratio(bearing: Bearing, lubricant: Lubricant, history: History) -> float:
    """Kappa at the mean speed; NaN for a shaft at rest."""
    mean_speed = 2.0 * math.pi * history.revolutions.sum() / history.duration.sum()
    if mean_speed == 0.0:
        return math.nan
    kinematic = lubricant.viscosity / lubricant.density
    return kinematic / iso281.reference_viscosity(mean_speed, 2.0 * bearing.pitch_radius)


def _static(bearing: Bearing, history: History) -> dict[str, tuple]:
    equivalent = iso76.static_equivalent_load(history.radial, history.axial, history.published.y0)
    least = minimum_load(history.published.static)
    below = _share(history.equivalent < least, history.duration)
    safety = iso76.static_safety(history.published.static, equivalent.max())
    return {
        "static_equivalent_load": variable(float(equivalent.max()), "N", "largest static equivalent load P0"),
        "static_safety": variable(float(safety), "1", "static safety factor C0/P0, the least"),
        "minimum_load": variable(least, "N", "least load P that the maker requires, 0.01 C0"),
        "share_below_minimum_load": variable(below, "1", "share of time in which P is below the minimum load"),
    }


def _iso281(bearing: Bearing, lubricant: Lubricant, history: History, contamination: float) -> dict[str, tuple]:
    mean = iso281.mean_equivalent_load(history.equivalent, history.revolutions)
    limit = history.published.fatigue_limit
    kappa = _viscosity_ratio(bearing, lubricant, history)
    life = iso281.basic_life(history.published.dynamic, mean) * history.hours_a_revolution
    factor = float(iso281.life_modification(kappa, contamination, limit / mean if mean else math.inf))
    below = _share(history.equivalent < limit, history.duration)
    return {
        "equivalent_load": variable(mean, "N", "mean dynamic equivalent load P_m"),
        "fatigue_load_limit": variable(limit, "N", "fatigue load limit C_u"),
        "share_below_fatigue_load_limit": variable(below, "1", "share of time in which P is below C_u"),
        "viscosity_ratio": variable(kappa, "1", "viscosity ratio kappa at the mean speed"),
        "basic_life": variable(float(life), "h", "basic rating life L10h, ISO 281"),
        "life_modification": variable(factor, "1", "life modification factor a_ISO"),
        "modified_life": variable(float(life * factor), "h", "modified rating life, ISO 281"),
    }


def _ring_damages(bearing: Bearing, lubricant: Lubricant, history: History) -> NDArray[np.float64]:
    """Damage (Q_e/Q_c)^(9/2) over distribution, row, raceway and sample."""
    cosine = math.cos(bearing.contact_angle)
    gamma = bearing.roller_diameter * cosine / (2.0 * bearing.pitch_radius)
    ratings = iso16281.ring_ratings(
        history.published.dynamic, len(ROWS), bearing.rollers_per_row, bearing.contact_angle, gamma
    )
    semi_axes = [raceway.hertz.semi_axis_across for raceway in interfaces(bearing, lubricant)]
    found = np.empty((len(DISTRIBUTIONS), len(ROWS), len(RACEWAYS), history.loads.time.size))
    for row, load in enumerate(history.roller_load):
        for k, rating in enumerate(ratings):
            stationary = RACEWAYS[k] == "outer"
            found[:, row, k] = iso16281.damage_series(load, semi_axes[k], bearing.roller_length, rating, stationary)
    return found


def _reference(bearing: Bearing, lubricant: Lubricant, history: History, contamination: float) -> dict[str, tuple]:
    damages = _ring_damages(bearing, lubricant, history)

    def hours(life: NDArray[np.float64]) -> NDArray[np.float64]:
        # Palmgren and Miner: the shares of life used by each load add up.
        turned = history.revolutions.sum()
        used = (history.revolutions / life).sum(axis=-1)
        with np.errstate(divide="ignore", invalid="ignore"):
            return turned / used * history.hours_a_revolution

    together = iso16281.reference_life(damages, axis=(1, 2))
    load = history.published.dynamic * (1e6 / together) ** (1.0 / iso281.LIFE_EXPONENT)
    kappa = _viscosity_ratio(bearing, lubricant, history)
    with np.errstate(divide="ignore"):
        factor = iso281.life_modification(kappa, contamination, history.published.fatigue_limit / load)
    by_raceway = hours(iso16281.reference_life(damages, axis=()))
    name = "basic reference rating life, ISO/TS 16281"
    return {
        "reference_life": variable(hours(together), "h", name, "load_along_roller"),
        "raceway_reference_life": variable(
            by_raceway, "h", f"{name}, one raceway", "load_along_roller", "row", "raceway"
        ),
        "modified_reference_life": variable(
            hours(together * factor), "h", "modified reference rating life", "load_along_roller"
        ),
    }


def _class_edges(history: History) -> NDArray[np.float64]:
    reach = [history.radial, history.axial, history.equivalent]
    low, high = min(one.min() for one in reach), max(one.max() for one in reach)
    return np.linspace(min(low, 0.0), high if high > 0.0 else 1.0, LOAD_CLASSES + 1)


def _spectra(history: History, exponents: tuple[float, ...]) -> dict[str, tuple]:
    edges = _class_edges(history)
    by_name = dict(zip(LOADS, (history.radial, history.axial, history.equivalent), strict=True))
    times = [load_duration(load, history.duration, edges) for load in by_name.values()]
    turns = [load_duration(load, history.revolutions, edges) for load in by_name.values()]
    total = history.duration.sum()
    ranges = [[damage_equivalent_load(load, total, one) for one in exponents] for load in by_name.values()]
    return {
        "time_share": variable(times, "1", "share of time in the class of load", "load", "load_class"),
        "revolution_share": variable(turns, "1", "share of revolutions in the class", "load", "load_class"),
        "damage_equivalent_load": variable(
            ranges, "N", "range of the damage-equivalent load at 1 Hz", "load", "wohler_exponent"
        ),
    }
