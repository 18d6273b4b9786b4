"""Values of a bearing file as medians and ranges of samples that fit a maker's page."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

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


class Accepted(NamedTuple):
    """Lowest and highest value of a proportion in bearings of this kind."""

    low: float
    high: float


def within(values: NDArray, accepted: Accepted, margin: float | NDArray = 0.0) -> BoolArray:
    """True where a proportion lies in what is accepted, widened by a margin on both sides."""
    return (values >= accepted.low - margin) & (values <= accepted.high + margin)


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

    low, high = (written(limit) for limit in np.percentile(samples, PERCENTILES))
    middle = written(value)
    return {"value": middle, "unit": unit, "tag": tag, "note": note,
            "range": [min(low, middle), max(high, middle)]}  # fmt: skip


def short_number(number: float) -> float:
    """The number without the rounding errors of its conversion, whole where it is whole."""
    rounded = float(f"{number:.9g}")
    return int(rounded) if rounded.is_integer() else rounded
