"""Spectra of a load history: how long each load lasts, and the damage-equivalent cycle."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from macroslip.arrays import FloatArray

LEVELS = 256
"""Levels between smallest and largest load at which reversals are counted."""


def sample_durations(time: FloatArray) -> FloatArray:
    """Time that every sample represents [s]: half of the intervals at either side.

    Examples
    --------
    >>> sample_durations(np.array([0.0, 1.0, 3.0])).tolist()
    [0.5, 1.5, 1.0]
    """
    step = np.diff(time)
    after = np.concatenate([step, [0.0]])
    before = np.concatenate([[0.0], step])
    return 0.5 * (after + before)


def load_duration(load: FloatArray, weight: FloatArray, edges: FloatArray) -> NDArray:
    """Shares [-] of time, or of revolutions, that n loads [N] spend in each of k classes.

    Their sum is 1.

    `weight` is the time, or the revolutions, that each sample represents, `edges` the k + 1 rising
    edges of the classes [N], which contain all loads. NaN if the weights are all zero.

    Examples
    --------
    >>> loads, edges = np.array([1.0, 3.0]), np.array([0.0, 2.0, 4.0])
    >>> load_duration(loads, np.array([1.0, 3.0]), edges).tolist()
    [0.25, 0.75]
    """
    durations, _ = np.histogram(load, edges, weights=weight)
    with np.errstate(invalid="ignore"):
        return durations / weight.sum()


def rainflow_ranges(load: FloatArray) -> FloatArray:
    """Ranges [N] of the cycles of a load history [N].

    It is taken as repeating, so that every cycle closes.

    Of two samples or more. Empty for a constant load. Ripples of less than 1/256 of the largest
    range do not count.

    ASTM E 1049-85, Standard Practices for Cycle Counting in Fatigue Analysis,
    doi:10.1520/E1049-85R17.

    Examples
    --------
    >>> rainflow_ranges(np.array([0.0, 1.0, 0.0, 1.0, 0.0])).tolist()
    [1.0, 1.0]
    """
    import fatpack

    if np.ptp(load) == 0.0:
        return np.zeros(0)
    try:
        ranges = fatpack.find_rainflow_ranges(load, k=LEVELS)
        return np.asarray(ranges, float)
    except (
        ValueError,
        IndexError,
    ):  # fewer reversals than it can count: repeated, the history is one cycle
        return np.array([np.ptp(load)])


def damage_equivalent_load(
    load: ArrayLike, duration: float, exponent: float, *, frequency: float = 1.0
) -> float:
    """Range of a sinusoidal load of one frequency that does the same damage.

    It is (sum S_i^m/(f T))^(1/m), twice the amplitude, with S_i the `rainflow_ranges` of the load.

    Parameters
    ----------
    load : array_like
        History of the load [N].
    duration : float
        Its duration T [s], > 0.
    exponent : float
        Slope m of the Wöhler line [-], >= 1.
    frequency : float
        f [Hz], > 0.

    Returns
    -------
    float
        Range [N]; 0 for a constant load.

    References
    ----------
    IEC 61400-13, annex on damage-equivalent loads.

    Examples
    --------
    >>> time = np.linspace(0.0, 100.0, 10001)
    >>> round(damage_equivalent_load(45e3 * np.sin(2 * np.pi * time), 100.0, 4.0) / 1e3, 1)
    90.0
    """
    ranges = rainflow_ranges(np.asarray(load, float))
    cycles = frequency * duration
    mean_power = np.sum(ranges**exponent) / cycles
    return float(mean_power ** (1.0 / exponent))
