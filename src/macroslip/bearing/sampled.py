"""Values of a bearing file as medians and ranges of samples that fit a maker's page."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from macroslip.arrays import BoolArray, FloatArray
from macroslip.errors import InputError

SAMPLES = 20_000
"""Bearings that are tried for one page."""
PERCENTILES = (10.0, 90.0)
"""Ends of the ranges that are given: four out of five samples lie between them."""

_LEAST_KEPT = 100
"""Samples that have to fit for their medians and ranges to mean something."""

E_ROUNDING = 0.005
"""Half of the last printed digit of e."""
_SCALES = {"mm": 1e3, "um": 1e6, "deg": 180.0 / math.pi, "1": 1.0}


_Bearing = TypeVar("_Bearing")


class Estimated(NamedTuple, Generic[_Bearing]):
    """A bearing from its maker's page."""

    bearing: _Bearing  #: The medians, with ranges in their provenance
    #: Every inner dimension [SI], n samples, by key of the bearing
    samples: Mapping[str, FloatArray]


class Accepted(NamedTuple):
    """Lowest and highest value of a proportion in bearings of this kind."""

    low: float
    high: float

    def drawn(self, rng: np.random.Generator) -> FloatArray:
        """Samples of the proportion, uniform within it, shape (`SAMPLES`,)."""
        return rng.uniform(self.low, self.high, SAMPLES)


def check_positive(page: Any) -> None:
    """Refuse a number of a maker's page that is not above 0; a missing one is None."""
    for field in fields(page):
        value = getattr(page, field.name)
        is_number = isinstance(value, int | float)
        if is_number and not (math.isfinite(value) and value > 0.0):
            raise InputError(f"{field.name} is {value!r}", allowed="a finite number above 0")


def check_bore(bore: float, outside: float) -> None:
    """Refuse a bore [m] that is not below the outside diameter [m]."""
    if not bore < outside:
        raise InputError(
            f"bore is {1e3 * bore:g} mm",
            allowed=f"below the outside diameter, {1e3 * outside:g} mm",
        )


def within(values: NDArray, accepted: Accepted, margin: float | NDArray = 0.0) -> BoolArray:
    """True where a proportion lies in what is accepted, widened by a margin on both sides."""
    lowest = accepted.low - margin
    highest = accepted.high + margin
    return (values >= lowest) & (values <= highest)


def fitting(
    drawn: Mapping[str, FloatArray],
    passed: Mapping[str, BoolArray],
    *,
    allowed: str,
    remedy: str,
) -> dict[str, FloatArray]:
    """Samples that pass every check of proportions.

    Parameters
    ----------
    drawn : mapping of str to ndarray, shape (n,)
        Values of all samples [SI], by key of the bearing.
    passed : mapping of str to ndarray of bool, shape (n,)
        Samples that pass, by the words for a check.
    allowed, remedy : str
        Sentences of the error.

    Returns
    -------
    dict of str to ndarray
        The values of the samples that passed all checks.

    Raises
    ------
    InputError
        If fewer than 100 did; it names the check that fewest passed.
    """
    kept = np.logical_and.reduce(list(passed.values()))
    if np.count_nonzero(kept) < _LEAST_KEPT:
        counts = {check: np.count_nonzero(passes) for check, passes in passed.items()}
        worst = min(counts, key=counts.__getitem__)
        raise InputError(
            f"no bearing of usual proportions fits these values: of {kept.size} tried, "
            f"{np.count_nonzero(kept)} did, and {counts[worst]} passed the check of the {worst}",
            allowed=allowed,
            remedy=remedy,
        )
    return {key: values[kept] for key, values in drawn.items()}


def entry(value: float, samples: NDArray, unit: str, digits: int, tag: str, note: str) -> dict:
    """An entry of a bearing file: the value as it is written, with the range of the samples.

    Parameters
    ----------
    value : float
        SI value.
    samples : ndarray
        Values [SI] of all bearings that fit.
    unit : {"mm", "deg", "um", "1"}
    digits : int
        Decimals that are written.
    tag, note : str
        Where the value comes from.
    """

    def written(number: float) -> float:
        rounded = round(float(number) * _SCALES[unit], digits)
        return int(rounded) if digits == 0 else rounded

    limits = np.percentile(samples, PERCENTILES)
    low, high = (written(limit) for limit in limits)
    middle = written(value)
    return {"value": middle, "unit": unit, "tag": tag, "note": note,
            "range": [min(low, middle), max(high, middle)]}  # fmt: skip


def stated(value: float, unit: str, tag: str, note: str) -> dict[str, Any]:
    """An entry of a bearing file for a value that is not sampled.

    Parameters
    ----------
    value : float
        In the unit.
    unit : str
    tag, note : str
        Where the value comes from.
    """
    return {"value": value, "unit": unit, "tag": tag, "note": note}


class Rollers(NamedTuple):
    """Number and size of the rollers as load ratings take them."""

    per_row: int
    diameter: float  #: Dw [m]
    length: float  #: L [m]
    contact_angle: float  #: alpha [rad]
    pitch: float  #: Dpw [m]

    @classmethod
    def of(cls, entries: Mapping[str, Any], angle: str) -> Rollers:
        """From the entries of a bearing file in mm and degrees; `angle` is the key of alpha."""
        return cls(
            per_row=entries["rollers_per_row"]["value"],
            diameter=1e-3 * entries["roller_diameter"]["value"],
            length=1e-3 * entries["roller_length"]["value"],
            contact_angle=math.radians(entries[angle]["value"]),
            pitch=2e-3 * entries["pitch_radius"]["value"],
        )


def short_number(number: float) -> float:
    """The number without the rounding errors of its conversion, whole where it is whole."""
    rounded = float(f"{number:.9g}")
    return int(rounded) if rounded.is_integer() else rounded
