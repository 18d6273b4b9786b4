"""Aggregation of the runs of a study over a lifetime."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import xarray as xr

from macroslip.errors import InputError
from macroslip.study.weights import (
    Binning,
    BinProbabilities,
    Weibull,
    Weights,
    binned,
    stored_weighting,
)


@dataclass(frozen=True)
class Aggregation:
    """Aggregation of the runs of a study over a lifetime.

    Raises InputError if the lifetime is not above 0.
    """

    weights: Weights | None = None  #: What a year consists of; None: all runs count alike
    years: float = 20.0  #: Lifetime, years of 365.25 days, above 0
    #: Label by which runs are sorted into bins, a number; None, without weights: one bin for all
    field: str | None = "wind_speed"
    width: float = 2.0  #: Width of a bin, in the unit of the field, above 0
    by: Sequence[str] = ()  #: Further labels that separate groups, as `turbulence`

    def __post_init__(self) -> None:
        if not (math.isfinite(self.years) and self.years > 0.0):
            fault = f"the lifetime is {self.years!r} years"
            raise InputError(fault, allowed="a number above 0")
        if self.weights is not None and self.field is None:
            fault = "the runs have weights, and no label sorts them into bins"
            raise InputError(fault, remedy="Give a label: field=, on the command line --field.")

    def bins(self, study: xr.Dataset) -> Binning:
        """Runs by group and bin, as `macroslip.study.weights.binned`; one bin without weights."""
        if self.weights is None:
            return binned(study, None, self.width, self.by)
        return binned(study, self.field, self.width, self.by)


def aggregation_in_use(
    study: xr.Dataset, wind: Weibull | BinProbabilities | None = None, years: float = 20.0
) -> Aggregation:
    """Weights, field and width of the study's file, with another `wind` in place of its own.

    Runs that nothing weighs need no label `wind_speed`; without it they are in one bin.
    """
    stored = stored_weighting(study)
    if stored is None:
        alike = wind is None and "wind_speed" not in study.coords
        return Aggregation(wind, years, None if alike else "wind_speed")
    weights = stored.year
    if wind:
        weights = replace(weights, wind=wind)
    return Aggregation(weights, years, stored.field, stored.width)
