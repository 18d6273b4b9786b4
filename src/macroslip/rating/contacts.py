"""Loads of the raceways: largest load and pressure, and how thick the film is over the roughness."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.bearing import geometry
from macroslip.bearing.frames import ROWS
from macroslip.compiled import jit
from macroslip.film.correction import prepare_film
from macroslip.film.film_law import film_thickness
from macroslip.rating.history import RACEWAYS, History, variable
from macroslip.roller.model import interfaces

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from macroslip.bearing import Bearing
    from macroslip.lubricant import Lubricant

FILM_LAW = "masjedi-khonsari"


def contact_numbers(bearing: Bearing, lubricant: Lubricant, history: History) -> dict[str, tuple]:
    """Largest roller load and pressure of each row, and the film ratio where rollers carry load."""
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
        "largest_roller_load": variable(largest, "N", "largest roller load", "row"),
        "largest_pressure": variable(pressure, "Pa", "largest Hertz pressure", "row", "raceway"),
        "film_ratio": variable(middle, "1", "film ratio Lambda, median over loaded rollers", "row", "raceway"),
        "film_ratio_low": variable(low, "1", "film ratio Lambda, 5 % of loaded rollers below", "row", "raceway"),
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
