"""Damage rates per second of a whole bearing, by surface, from one result."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr

from macroslip.bearing import geometry
from macroslip.measures.along import STATIONS
from macroslip.result.criteria.criterion import Criterion, Threshold
from macroslip.result.run_input import RunInput, window_length

#: Surfaces whose damage is computed.
SURFACES = ("inner", "outer", "roller")


class Evaluation:
    """Rates of damage of a result.

    Parameters
    ----------
    result : xarray.Dataset
        With details of the contacts.
    run_input : RunInput
        Input of the result.
    thresholds : mapping
        Thresholds of one's own by the name of the criterion.
    wear_coefficients : sequence of float
        k [m²/N], rising.
    wear_is_asked_for : bool
        True if coefficients of wear were given.

    Attributes
    ----------
    seconds : float
        Length of the window [s].
    all_rollers : float
        Rollers of a row over those that were simulated [-].
    boundary_friction : float
        µ_b [-]; 0 without asperities.
    """

    def __init__(
        self,
        result: xr.Dataset,
        run_input: RunInput,
        *,
        thresholds: Mapping[str, Threshold],
        wear_coefficients: Sequence[float],
        wear_is_asked_for: bool,
    ):
        self.result = result
        self.run_input = run_input
        self.thresholds = thresholds
        self.wear_coefficients = wear_coefficients
        self.wear_is_asked_for = wear_is_asked_for
        self.bearing = run_input.bearing
        self.seconds = window_length(result)
        self.all_rollers = self.bearing.rollers_per_row / result.sizes["roller"]
        first = next(iter(run_input.models.values()))
        self.boundary_friction = first.laws.inner.boundary_friction
        area = result.cell_area.transpose("row", "raceway", "station")
        self._cell_area = area.values

    @property
    def tells_of_year(self) -> bool:
        """True if the window can be extrapolated to a year: it has an orbit, or is an event."""
        return self.result.sizes["orbit"] > 0 or self.run_input.is_event

    def reference(self, criterion: Criterion) -> float:
        """The value with which a criterion is compared [unit]: a user's threshold, or its reference."""
        own = self.thresholds.get(criterion.name)
        return criterion.reference if own is None else own.value

    def reference_range(self, criterion: Criterion) -> tuple[float, float]:
        """Least and largest reference of a criterion [unit]; a user's threshold is exact."""
        own = self.thresholds.get(criterion.name)
        if own is not None or criterion.reference_range is None:
            reference = self.reference(criterion)
            return reference, reference
        return criterion.reference_range

    def powers(self, name: str) -> np.ndarray:
        """Power of a map [W], of all rollers of a row, over row, raceway, angle and station."""
        energy = self.result[name]
        kinds = [kind for kind in ("slip_sign", "film_regime") if kind in energy.dims]
        of_places = energy.sum(kinds, skipna=False)
        by_place = of_places.transpose("row", "raceway", "angle", "station")
        return by_place.values * (self.all_rollers / self.seconds)

    def profile(self, name: str) -> np.ndarray:
        """Power per area [W/m²] of a map over row, surface and station.

        The inner ring turns, so that of its sectors the mean counts. Of the outer ring it is the
        sector with the largest value per pass, times the mean number of passes of all sectors: a
        few rollers, or orbits that are no whole number, pass some sectors more often than others.
        """
        density = self.powers(name) / self._cell_area[:, :, None]
        inner = density[:, 0]
        outer = density[:, 1] * self._evenness()[..., None]
        profile = np.empty((density.shape[0], len(SURFACES), STATIONS))
        profile[:, 0] = inner.mean(axis=1)
        for row, sectors in enumerate(outer):
            largest = np.nan_to_num(sectors).max(axis=-1)
            worst = int(np.argmax(largest))
            profile[row, 1] = sectors[worst]
        profile[:, 2] = self.roller_share(name).sum(axis=1)
        return profile

    def _evenness(self) -> np.ndarray:
        """Mean passes of the outer sectors over those of each, over row and angle; 0 without."""
        outer_passes = self.result.surface_passes.sel(raceway="outer")
        passes = outer_passes.transpose("row", "angle").values
        mean = passes.mean(axis=1, keepdims=True)
        return np.divide(mean, passes, out=np.zeros_like(passes), where=passes > 0.0)

    def roller_share(self, name: str) -> np.ndarray:
        """Power per area of a roller [W/m²] of a map over row, raceway and station."""
        circumference = 2.0 * math.pi * geometry.roller_radius(self.bearing)
        area = circumference * self.bearing.roller_length / STATIONS
        area_of_row = self.bearing.rollers_per_row * area
        return self.powers(name).sum(axis=2) / area_of_row

    def pass_rates(self) -> np.ndarray:
        """Passes a second over a point of rings and roller [1/s]; NaN without an orbit."""
        orbits = self.result.sizes["orbit"]
        rate = math.nan
        if orbits:
            rate = orbits / self.orbit_time()
        outer_radius = geometry.outer_contact_radius(self.bearing)
        outer = self.bearing.rollers_per_row
        inner_radius = geometry.inner_contact_radius(self.bearing)
        inner = outer * outer_radius / inner_radius
        roller = 2.0 * outer_radius / geometry.roller_radius(self.bearing)
        return rate * np.array([inner, outer, roller])

    def orbit_time(self) -> float:
        """Length of all complete orbits [s]."""
        lengths = self.result.orbit_end - self.result.orbit_start
        return float(lengths.sum())
