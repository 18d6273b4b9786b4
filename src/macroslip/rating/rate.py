"""All rating numbers of a bearing under one load history, as one dataset."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from macroslip.bearing import geometry
from macroslip.bearing.frames import ROWS
from macroslip.bearing.load_ratings import fatigue_load_limit
from macroslip.compiled import jit
from macroslip.contact.hertz import effective_modulus, elliptical_contact
from macroslip.errors import InputError
from macroslip.film.correction import prepare_film
from macroslip.film.film_law import film_thickness
from macroslip.rating import iso76, iso281, iso16281
from macroslip.rating.minimum_load import minimum_load
from macroslip.rating.spectrum import damage_equivalent_load, load_duration, sample_durations
from macroslip.roller.model import interfaces

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    from macroslip.bearing import Bearing
    from macroslip.loads import BearingLoads
    from macroslip.lubricant import Lubricant

RACEWAYS = ("inner", "outer")
#: How the load of a roller lies along it, for the reference life.
DISTRIBUTIONS = ("hertz", "uniform")
LOADS = ("radial", "axial", "equivalent")
LOAD_CLASSES = 40
CONTAMINATION = 0.5
"""e_C by default: between slight and typical contamination of a bearing with a pitch above 100 mm; an estimate."""
WOHLER_EXPONENTS = (4.0, 10.0)
FILM_LAW = "masjedi-khonsari"

_CHUNK = 1000
_HOUR = 3600.0


class _History(NamedTuple):
    """What every part of the rating reads."""

    loads: BearingLoads
    roller_load: NDArray[np.float64]
    duration: NDArray[np.float64]
    revolutions: NDArray[np.float64]
    radial: NDArray[np.float64]
    axial: NDArray[np.float64]
    equivalent: NDArray[np.float64]

    @property
    def hours_a_revolution(self) -> float:
        turned = self.revolutions.sum()
        return self.duration.sum() / turned / _HOUR if turned > 0.0 else math.nan


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

    needed = ("dynamic_load_rating", "static_load_rating", "axial_factor_e", "axial_factor_y1", "axial_factor_y2",
              "axial_factor_y0")  # fmt: skip
    bearing.require(*needed, purpose="the rating")
    history = _history(bearing, loads, roller_load)
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
        _contacts(bearing, lubricant, history),
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
        "load_class": _variable(0.5 * (edges[1:] + edges[:-1]), "N", "middle of the class of load", "load_class"),
    }
    return xr.Dataset(variables, coordinates, {"bearing": bearing.name, "lubricant": lubricant.name,
                                               "contamination": contamination, "film_law": FILM_LAW})  # fmt: skip


def _variable(values: object, units: str, long_name: str, *dims: str) -> tuple:
    return dims, values, {"units": units, "long_name": long_name}


def _history(bearing: Bearing, loads: BearingLoads, roller_load: NDArray[np.float64]) -> _History:
    roller_load = np.asarray(roller_load, float)
    expected = (len(ROWS), bearing.rollers_per_row, loads.time.size)
    if roller_load.shape != expected or not np.all(roller_load >= 0.0) or not np.all(np.isfinite(roller_load)):
        raise InputError(
            f"roller_load has the shape {roller_load.shape}, or loads that are negative or not finite",
            allowed=f"loads from 0 N in the shape {expected}: row, roller, sample",
            remedy="Take them from macroslip.rating.roller_load_history.",
        )
    duration = sample_durations(loads.time)
    radial, axial = np.hypot(loads.force[:, 0], loads.force[:, 1]), loads.force[:, 2]
    factors = bearing.axial_factor_e, bearing.axial_factor_y1, bearing.axial_factor_y2
    return _History(
        loads,
        roller_load,
        duration,
        duration * np.abs(loads.shaft_speed) / (2.0 * math.pi),
        radial,
        axial,
        iso281.dynamic_equivalent_load(radial, axial, *factors),
    )


def _share(condition: NDArray[np.bool_], weight: NDArray[np.float64]) -> float:
    return float(weight[condition].sum() / weight.sum())


def _fatigue_load_limit(bearing: Bearing) -> float:
    if bearing.fatigue_load_limit is not None:
        return bearing.fatigue_load_limit
    return fatigue_load_limit(bearing.static_load_rating, 2.0 * bearing.pitch_radius)


def _viscosity_ratio(bearing: Bearing, lubricant: Lubricant, history: _History) -> float:
    """kappa at the mean speed; NaN where the shaft stands."""
    mean_speed = 2.0 * math.pi * history.revolutions.sum() / history.duration.sum()
    if mean_speed == 0.0:
        return math.nan
    kinematic = lubricant.viscosity / lubricant.density
    return kinematic / iso281.reference_viscosity(mean_speed, 2.0 * bearing.pitch_radius)


def _static(bearing: Bearing, history: _History) -> dict[str, tuple]:
    equivalent = iso76.static_equivalent_load(history.radial, history.axial, bearing.axial_factor_y0)
    least = minimum_load(bearing.static_load_rating)
    below = _share(history.equivalent < least, history.duration)
    safety = iso76.static_safety(bearing.static_load_rating, equivalent.max())
    return {
        "static_equivalent_load": _variable(float(equivalent.max()), "N", "largest static equivalent load P0"),
        "static_safety": _variable(float(safety), "1", "static safety factor C0/P0, the least"),
        "minimum_load": _variable(least, "N", "least load P that the maker asks for, 0.01 C0"),
        "share_below_minimum_load": _variable(below, "1", "share of time in which P is below the minimum load"),
    }


def _iso281(bearing: Bearing, lubricant: Lubricant, history: _History, contamination: float) -> dict[str, tuple]:
    mean = iso281.mean_equivalent_load(history.equivalent, history.revolutions)
    limit = _fatigue_load_limit(bearing)
    kappa = _viscosity_ratio(bearing, lubricant, history)
    life = iso281.basic_life(bearing.dynamic_load_rating, mean) * history.hours_a_revolution
    factor = float(iso281.life_modification(kappa, contamination, limit / mean if mean else math.inf))
    below = _share(history.equivalent < limit, history.duration)
    return {
        "equivalent_load": _variable(mean, "N", "mean dynamic equivalent load P_m"),
        "fatigue_load_limit": _variable(limit, "N", "fatigue load limit C_u"),
        "share_below_fatigue_load_limit": _variable(below, "1", "share of time in which P is below C_u"),
        "viscosity_ratio": _variable(kappa, "1", "viscosity ratio kappa at the mean speed"),
        "basic_life": _variable(float(life), "h", "basic rating life L10h, ISO 281"),
        "life_modification": _variable(factor, "1", "life modification factor a_ISO"),
        "modified_life": _variable(float(life * factor), "h", "modified rating life, ISO 281"),
    }


def _ring_damages(bearing: Bearing, history: _History) -> NDArray[np.float64]:
    """Damage (Q_e/Q_c)^(9/2) over distribution, row, raceway and sample."""
    cosine = math.cos(bearing.contact_angle)
    gamma = bearing.roller_diameter * cosine / (2.0 * bearing.pitch_radius)
    ratings = iso16281.ring_ratings(
        bearing.dynamic_load_rating, len(ROWS), bearing.rollers_per_row, bearing.contact_angle, gamma
    )
    per_load = _raceway_semi_axes(bearing)
    found = np.empty((len(DISTRIBUTIONS), len(ROWS), len(RACEWAYS), history.loads.time.size))
    for start in range(0, history.loads.time.size, _CHUNK):
        now = slice(start, start + _CHUNK)
        load = np.moveaxis(history.roller_load[:, :, now], -1, 1)
        for k, rating in enumerate(ratings):
            laminae = iso16281.lamina_loads(load, per_load[k] * np.cbrt(load), bearing.roller_length)
            stationary = RACEWAYS[k] == "outer"
            explicit = rating / iso16281.REDUCTION
            found[0, :, k, now] = iso16281.ring_damage(laminae, explicit, stationary=stationary)
            found[1, :, k, now] = iso16281.ring_damage(load[..., None], rating, stationary=stationary)
    return found


def _raceway_semi_axes(bearing: Bearing) -> tuple[float, float]:
    """Semi-axes along the roller per Q^(1/3) [m/N^(1/3)] at inner and outer raceway."""
    own = bearing.youngs_modulus, bearing.poisson_ratio
    curvatures = geometry.inner_curvatures(bearing), geometry.outer_curvatures(bearing)
    modulus = effective_modulus(*own, *own)
    inner, outer = (elliptical_contact(one.rolling, one.lateral, modulus).semi_axis_across for one in curvatures)
    return inner, outer


def _reference(bearing: Bearing, lubricant: Lubricant, history: _History, contamination: float) -> dict[str, tuple]:
    damages = _ring_damages(bearing, history)

    def hours(life: NDArray[np.float64]) -> NDArray[np.float64]:
        # Palmgren and Miner: the shares of life used by each load add up.
        turned = history.revolutions.sum()
        used = (history.revolutions / life).sum(axis=-1)
        with np.errstate(divide="ignore", invalid="ignore"):
            return turned / used * history.hours_a_revolution

    together = iso16281.reference_life(damages, axis=(1, 2))
    load = bearing.dynamic_load_rating * (1e6 / together) ** (1.0 / iso281.LIFE_EXPONENT)
    kappa = _viscosity_ratio(bearing, lubricant, history)
    with np.errstate(divide="ignore"):
        factor = iso281.life_modification(kappa, contamination, _fatigue_load_limit(bearing) / load)
    by_raceway = hours(iso16281.reference_life(damages, axis=()))
    name = "basic reference rating life, ISO/TS 16281"
    return {
        "reference_life": _variable(hours(together), "h", name, "load_along_roller"),
        "raceway_reference_life": _variable(
            by_raceway, "h", f"{name}, one raceway", "load_along_roller", "row", "raceway"
        ),
        "modified_reference_life": _variable(
            hours(together * factor), "h", "modified reference rating life", "load_along_roller"
        ),
    }


def _contacts(bearing: Bearing, lubricant: Lubricant, history: _History) -> dict[str, tuple]:
    raceways = interfaces(bearing, lubricant)[: len(RACEWAYS)]
    load = history.roller_load
    largest = load.max(axis=(1, 2))
    pressure = np.array([[raceway.hertz.pressure * np.cbrt(one) for raceway in raceways] for one in largest])
    inner, outer = geometry.inner_contact_radius(bearing), geometry.outer_contact_radius(bearing)
    entrainment = np.abs(history.loads.shaft_speed) * inner * outer / (inner + outer)
    low, middle = np.full((2, len(ROWS), len(RACEWAYS)), np.nan)
    weights = np.broadcast_to(history.duration, load.shape[1:])
    for k, raceway in enumerate(raceways):
        law = prepare_film(FILM_LAW, raceway)
        for row in range(len(ROWS)):
            carried = (load[row] > 0.0) & (entrainment > 0.0)
            if carried.any():
                speed = np.broadcast_to(entrainment, carried.shape)[carried]
                ratio = _films(law, load[row][carried], speed) / bearing.composite_roughness
                quantiles = _quantiles(ratio, weights[carried], (0.05, 0.5))
                low[row, k], middle[row, k] = quantiles
    return {
        "largest_roller_load": _variable(largest, "N", "largest roller load", "row"),
        "largest_pressure": _variable(pressure, "Pa", "largest Hertz pressure", "row", "raceway"),
        "film_ratio": _variable(middle, "1", "film ratio Lambda, median over loaded rollers", "row", "raceway"),
        "film_ratio_low": _variable(low, "1", "film ratio Lambda, 5 % of loaded rollers below", "row", "raceway"),
    }


@jit
def _films(law, load, speed):
    """Film thickness [m] at every pair of load [N] and entrainment speed [m/s]."""
    found = np.empty(load.size)
    for k in range(load.size):
        found[k] = film_thickness(law, load[k], speed[k])[0]
    return found


def _quantiles(values: NDArray, weights: NDArray, shares: tuple[float, ...]) -> NDArray[np.float64]:
    order = np.argsort(values)
    reached = np.cumsum(weights[order])
    return values[order][np.searchsorted(reached, np.array(shares) * reached[-1]).clip(max=values.size - 1)]


def _class_edges(history: _History) -> NDArray[np.float64]:
    reach = [history.radial, history.axial, history.equivalent]
    low, high = min(one.min() for one in reach), max(one.max() for one in reach)
    return np.linspace(min(low, 0.0), high if high > 0.0 else 1.0, LOAD_CLASSES + 1)


def _spectra(history: _History, exponents: tuple[float, ...]) -> dict[str, tuple]:
    edges = _class_edges(history)
    by_name = dict(zip(LOADS, (history.radial, history.axial, history.equivalent), strict=True))
    times = [load_duration(load, history.duration, edges) for load in by_name.values()]
    turns = [load_duration(load, history.revolutions, edges) for load in by_name.values()]
    total = history.duration.sum()
    ranges = [[damage_equivalent_load(load, total, one) for one in exponents] for load in by_name.values()]
    return {
        "time_share": _variable(times, "1", "share of time in the class of load", "load", "load_class"),
        "revolution_share": _variable(turns, "1", "share of revolutions in the class", "load", "load_class"),
        "damage_equivalent_load": _variable(
            ranges, "N", "range of the damage-equivalent load at 1 Hz", "load", "wohler_exponent"
        ),
    }
