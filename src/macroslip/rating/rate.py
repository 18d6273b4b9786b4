"""All rating numbers of a bearing under one load history, as one dataset."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from macroslip.arrays import BoolArray, FloatArray
from macroslip.bearing import Bearing, geometry
from macroslip.bearing.geometry import row_names
from macroslip.constants import HOUR
from macroslip.contact.interface import highest_load, interfaces
from macroslip.contact.mechanisms import Laws
from macroslip.contact.registry import FILM_LAWS
from macroslip.contact.strips import strips_of
from macroslip.errors import InputError
from macroslip.loads import BearingLoads, RollerLoads
from macroslip.lubricant import Lubricant
from macroslip.rating import iso
from macroslip.rating.kinds import EquivalentLoads, LoadRatings, equivalent_loads, ratings_of
from macroslip.rating.lines import ellipse_load_for_film, line_interfaces, line_rating
from macroslip.rating.spectrum import damage_equivalent_load, load_duration, sample_durations
from macroslip.rating.tapered import StripRating
from macroslip.rating.variables import RATING
from macroslip.ring.motion import elastic_loads, ring_motion
from macroslip.roller.model import ring_geometry, roller_model

RACEWAYS = ("inner", "outer")
FILM_LAW = "masjedi-khonsari"
#: How the load of a roller lies along it, for the reference life: as Hertz has it, where rollers
#: touch along a line by strips with profile, and tilt of tapered ones, and evenly.
DISTRIBUTIONS = ("hertz", "uniform")
LOADS = ("radial", "axial", "equivalent")
LOAD_CLASSES = 40
CONTAMINATION = 0.5
"""e_C by default: between slight and typical contamination of a bearing with a pitch above 100 mm;
an estimate.
"""
WOHLER_EXPONENTS = (4.0, 10.0)


def roller_load_history(
    bearing: Bearing, lubricant: Lubricant, loads: BearingLoads | RollerLoads
) -> tuple[BearingLoads, FloatArray]:
    """Elastic load of every roller at every sample; it does not depend on the lubricant.

    Raises InputError if a roller load is so high that more than a tenth of it would lie beyond the
    roller's ends. Gives the same loads, with samples in between where the shaft turns too far
    between two of them, and Q [N] over row, roller and these samples, shape (rows, Z, n).

    Examples
    --------
    >>> thrust = BearingLoads.constant([0.0, 0.0, 100e3], 2.1, 1.0)
    >>> bearing, oil = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
    >>> _, load = roller_load_history(bearing, oil, thrust)
    >>> load.shape, round(load[0].sum(axis=0)[0] * np.sin(np.radians(11.2))), load[1].max().item()
    ((2, 28, 21), 100000, 0.0)
    """
    model = roller_model(bearing, lubricant, 1, tilt=0.0)
    ring = ring_geometry(bearing, model)
    limit = highest_load(bearing, lubricant, Laws.physical())
    motion, _ = ring_motion(loads, bearing, ring, limit)
    roller_load = elastic_loads(loads, ring, motion)
    known = loads
    if isinstance(loads, RollerLoads):
        known = loads.resultant(bearing.contact_angle, bearing.rollers_per_row)
    finer = known.resampled(motion.time, motion.shaft_speed)
    shape = (bearing.rows, bearing.rollers_per_row, -1)
    by_roller = np.moveaxis(roller_load, 0, -1).reshape(shape)
    return finer, by_roller


def rate(
    bearing: Bearing,
    lubricant: Lubricant,
    loads: BearingLoads,
    roller_load: FloatArray,
    *,
    contamination: float = CONTAMINATION,
    wohler_exponents: tuple[float, ...] = WOHLER_EXPONENTS,
    strips: StripRating | None = None,
) -> xr.Dataset:
    """Rate a bearing: static safety, rating lives, pressures, film, minimum load and load spectra.

    Variables have `units` and `long_name`. Lives are hours at the history's mean speed, as if it
    repeated for ever; they weigh loads by revolutions. NaN where the shaft does not turn or the
    standard defines no value.

    Parameters
    ----------
    bearing : Bearing
        With load ratings and axial factors; InputError without.
    lubricant : Lubricant
        At the inlet temperature.
    loads : BearingLoads
        Load on the inner ring and shaft speed, n samples.
    roller_load : ndarray, shape (rows, Z, n)
        Elastic load of every roller [N] over row, roller and the samples of `loads`, see
        `roller_load_history`.
    contamination : float
        e_C of ISO 281 [-], above 0 and at most 1.
    wohler_exponents : tuple of float
        Slopes m for which damage-equivalent loads are given [-].
    strips : StripRating, optional
        Damage and pressures by the strips of tapered rollers: they take the place of Hertz' ellipse
        in reference lives and largest pressures. Those of cylindrical rollers that touch along a
        line follow from their loads.

    Examples
    --------
    >>> bearing, oil = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
    >>> weight = BearingLoads.constant([0.0, -400e3, 0.0], 2.1, 1.0)
    >>> rating = rate(bearing, oil, *roller_load_history(bearing, oil, weight))
    >>> life = rating.basic_life
    >>> round(float(rating.static_safety), 2), f"{float(life):.3g} {life.units}"
    (40.75, '2.21e+07 h')
    """
    history = _history(bearing, lubricant, loads, roller_load, contamination)
    if strips is None and _touches_along_line(bearing):
        strips = line_rating(bearing, history.ratings.dynamic, history.roller_load)
    history = history._replace(strips=strips)
    parts = (_static(history), _iso281(history), _reference(history), _contacts(history),
             _spectra(history, wohler_exponents))  # fmt: skip
    values = {}
    for part in parts:
        values |= part
    edges = history.class_edges
    middles = 0.5 * (edges[1:] + edges[:-1])
    coordinates = {
        "row": list(row_names(bearing)),
        "raceway": list(RACEWAYS),
        "load_along_roller": list(DISTRIBUTIONS),
        "load": list(LOADS),
        "wohler_exponent": list(wohler_exponents),
        "load_class": RATING["load_class_middle"].of(middles),
    }
    about = {
        "bearing": bearing.name,
        "lubricant": lubricant.name,
        "inlet_temperature": lubricant.inlet_temperature,
        "contamination": contamination,
        "film_law": FILM_LAW,
    }
    return xr.Dataset(RATING.put(values), coordinates, about)


def _touches_along_line(bearing: Bearing) -> bool:
    """True of a cylindrical roller bearing whose rollers touch along a line."""
    return bearing.kind == "cylindrical" and bearing.touches_along_line


class _History(NamedTuple):
    """A bearing, its load ratings, and its loads over n samples."""

    bearing: Bearing
    lubricant: Lubricant
    loads: BearingLoads
    contamination: float  #: e_C [-]
    ratings: LoadRatings
    roller_load: FloatArray  #: Q [N] over (row, roller, sample)
    duration: FloatArray  #: Time that every sample represents [s]
    revolutions: FloatArray  #: Turns of the shaft that every sample represents [-]
    equivalent: EquivalentLoads
    strips: StripRating | None = None  #: Of rollers that touch along a line

    @property
    def load_series(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Loads [N] in the order of `LOADS`."""
        return self.loads.radial_load, self.loads.axial_load, self.equivalent.dynamic

    @property
    def class_edges(self) -> FloatArray:
        """Edges of the classes of load [N]."""
        low = min(load.min() for load in self.load_series)
        high = max(load.max() for load in self.load_series)
        highest = high if high > 0.0 else 1.0
        return np.linspace(min(low, 0.0), highest, LOAD_CLASSES + 1)

    @property
    def viscosity_ratio(self) -> float:
        """Kappa at the mean speed; NaN for a shaft at rest."""
        turned = 2.0 * math.pi * self.revolutions.sum()
        mean_speed = turned / self.duration.sum()
        if mean_speed == 0.0:
            return math.nan
        kinematic = self.lubricant.viscosity / self.lubricant.density
        pitch = 2.0 * self.bearing.pitch_radius
        return kinematic / iso.reference_viscosity(mean_speed, pitch)

    @property
    def hours_a_revolution(self) -> float:
        """Mean time of a turn of the shaft [h]; NaN for a shaft at rest."""
        turned = self.revolutions.sum()
        if not turned > 0.0:
            return math.nan
        return self.duration.sum() / turned / HOUR


def _history(
    bearing: Bearing,
    lubricant: Lubricant,
    loads: BearingLoads,
    roller_load: FloatArray,
    contamination: float,
) -> _History:
    ratings = ratings_of(bearing)
    roller_load = np.asarray(roller_load, float)
    expected = (bearing.rows, bearing.rollers_per_row, loads.time.size)
    if (
        roller_load.shape != expected
        or not np.all(roller_load >= 0.0)
        or not np.all(np.isfinite(roller_load))
    ):
        raise InputError(
            f"roller_load has the shape {roller_load.shape}, or loads that are negative or not "
            "finite",
            allowed=f"loads from 0 N in the shape {expected}: row, roller, sample",
            remedy="Take them from macroslip.rating.roller_load_history.",
        )
    if not 0.0 < contamination <= 1.0:
        raise InputError(
            f"the contamination factor is {contamination!r}",
            allowed="a number above 0 and at most 1",
            remedy="1 is extreme cleanliness, 0.5 slight to typical contamination, 0.1 severe "
            "contamination",
        )
    duration = sample_durations(loads.time)
    turned = duration * np.abs(loads.shaft_speed)
    return _History(
        bearing=bearing,
        lubricant=lubricant,
        loads=loads,
        contamination=contamination,
        ratings=ratings,
        roller_load=roller_load,
        duration=duration,
        revolutions=turned / (2.0 * math.pi),
        equivalent=equivalent_loads(bearing, loads.radial_load, loads.axial_load),
    )


def _share(condition: BoolArray, weight: FloatArray) -> float:
    with_condition = weight[condition].sum()
    return float(with_condition / weight.sum())


def _static(history: _History) -> dict[str, Any]:
    least = history.ratings.minimum
    largest = float(history.equivalent.static.max())
    below = _share(history.equivalent.dynamic < least, history.duration)
    safety = iso.static_safety(history.ratings.static, largest)
    return {
        "static_equivalent_load": largest,
        "static_safety": float(safety),
        "minimum_load": least,
        "share_below_minimum_load": below,
    }


def _iso281(history: _History) -> dict[str, Any]:
    mean = iso.mean_equivalent_load(history.equivalent.dynamic, history.revolutions)
    limit = history.ratings.fatigue_limit
    basic = iso.basic_life(history.ratings.dynamic, mean)
    life = basic * history.hours_a_revolution
    ratio = math.inf
    if mean:
        ratio = limit / mean
    kappa = history.viscosity_ratio
    factor = float(iso.life_modification(kappa, history.contamination, ratio))
    below = _share(history.equivalent.dynamic < limit, history.duration)
    return {
        "equivalent_load": mean,
        "fatigue_load_limit": limit,
        "share_below_fatigue_load_limit": below,
        "viscosity_ratio": kappa,
        "basic_life": float(life),
        "life_modification": factor,
        "modified_life": float(life * factor),
    }


def _reference(history: _History) -> dict[str, Any]:
    bearing = history.bearing
    cosine = math.cos(bearing.contact_angle)
    gamma = bearing.roller_diameter * cosine / (2.0 * bearing.pitch_radius)
    ratings = iso.ring_ratings(
        history.ratings.dynamic,
        bearing.rows,
        bearing.rollers_per_row,
        bearing.contact_angle,
        gamma,
    )
    semi_axes = [
        raceway.hertz.semi_axis_across for raceway in interfaces(bearing, history.lubricant)
    ]
    # (Q_e/Q_c)^(9/2) over distribution, row, raceway and sample.
    samples = history.loads.time.size
    damages = np.empty((len(DISTRIBUTIONS), bearing.rows, len(RACEWAYS), samples))
    for row, strided in enumerate(history.roller_load):
        # Of one layout in memory, for which the function is compiled once.
        load = np.ascontiguousarray(strided)
        for k, rating in enumerate(ratings):
            stationary = RACEWAYS[k] == "outer"
            damages[:, row, k] = iso.damage_series(
                load, semi_axes[k], bearing.roller_length, rating, stationary
            )
    if history.strips is not None:
        damages[DISTRIBUTIONS.index("hertz")] = history.strips.damage

    def hours(life: FloatArray) -> FloatArray:
        # Palmgren and Miner: the shares of life used by each load add up.
        turned = history.revolutions.sum()
        used = (history.revolutions / life).sum(axis=-1)
        with np.errstate(divide="ignore", invalid="ignore"):
            return turned / used * history.hours_a_revolution

    together = iso.reference_life(damages, axis=(1, 2))
    load = history.ratings.dynamic * (1e6 / together) ** (1.0 / iso.LIFE_EXPONENT)
    with np.errstate(divide="ignore"):
        factor = iso.life_modification(
            history.viscosity_ratio, history.contamination, history.ratings.fatigue_limit / load
        )
    by_raceway = hours(iso.reference_life(damages, axis=()))
    modified = hours(together * factor)
    return {
        "reference_life": hours(together),
        "raceway_reference_life": by_raceway,
        "modified_reference_life": modified,
    }


def _contacts(history: _History) -> dict[str, Any]:
    """Largest roller load and pressure of each row, and the film ratio where rollers carry load."""
    bearing = history.bearing
    raceways = interfaces(bearing, history.lubricant)[: len(RACEWAYS)]
    of_ellipse: list[Callable] = [np.asarray] * len(RACEWAYS)
    if _touches_along_line(bearing):
        raceways = line_interfaces(bearing, history.lubricant)
        of_ellipse = [
            partial(ellipse_load_for_film, *pair)
            for pair in zip(raceways, strips_of(bearing), strict=True)
        ]
    load = history.roller_load
    largest = load.max(axis=(1, 2))
    pressure = np.array(
        [
            [raceway.hertz.pressure * np.cbrt(roller_load) for raceway in raceways]
            for roller_load in largest
        ]
    )
    if history.strips is not None:
        pressure = history.strips.pressure
    inner = geometry.inner_contact_radius(bearing)
    outer = geometry.outer_contact_radius(bearing)
    raceway_speed = np.abs(history.loads.shaft_speed) * inner
    entrainment = raceway_speed * outer / (inner + outer)
    low, middle = np.full((2, bearing.rows, len(RACEWAYS)), np.nan)
    weights = np.broadcast_to(history.duration, load.shape[1:])
    film = FILM_LAWS.named(FILM_LAW)
    for row, k in np.ndindex(low.shape):
        carried = (load[row] > 0.0) & (entrainment > 0.0)
        if carried.any():
            speed = np.broadcast_to(entrainment, carried.shape)[carried]
            pressed = of_ellipse[k](load[row][carried])
            ratio = film(raceways[k], pressed, speed) / bearing.composite_roughness
            quantiles = np.quantile(
                ratio, (0.05, 0.5), weights=weights[carried], method="inverted_cdf"
            )
            low[row, k], middle[row, k] = quantiles
    loaded = (load > 0.0).mean(axis=1) @ history.duration / history.duration.sum()
    return {
        "loaded_share": loaded,
        "largest_roller_load": largest,
        "largest_pressure": pressure,
        "film_ratio": middle,
        "film_ratio_low": low,
    }


def _spectra(history: _History, exponents: tuple[float, ...]) -> dict[str, Any]:
    edges = history.class_edges
    loads = history.load_series
    times = [load_duration(load, history.duration, edges) for load in loads]
    turns = [load_duration(load, history.revolutions, edges) for load in loads]
    total = history.duration.sum()
    ranges = []
    for load in loads:
        ranges.append([damage_equivalent_load(load, total, exponent) for exponent in exponents])
    return {
        "time_share": times,
        "revolution_share": turns,
        "damage_equivalent_load": ranges,
    }
