"""Parameter variations: grids, lists and seeded samples."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from macroslip.errors import InputError
from macroslip.study.settings import Setting


@dataclass(frozen=True)
class Range:
    """Interval of a sampled parameter.

    Parameters
    ----------
    low, high : float
        Ends [unit].
    unit : str
        Unit, or empty.
    scale : str
        `linear`: equally likely values; `log`: equally likely logarithms.
    """

    low: float
    high: float
    unit: str = ""
    scale: str = "linear"

    def __post_init__(self) -> None:
        if not self.low < self.high:
            raise InputError(f"low is {self.low:g} and high is {self.high:g}", allowed="low below high")
        if self.scale == "log" and self.low <= 0.0:
            raise InputError(f"low is {self.low:g} on a logarithmic scale", allowed="a number above 0")

    def at(self, position: float) -> float:
        """The value at a position from 0 to 1."""
        if self.scale == "log":
            return math.exp(math.log(self.low) + position * (math.log(self.high) - math.log(self.low)))
        return self.low + position * (self.high - self.low)


@dataclass(frozen=True)
class Sample:
    """Seeded sample of a box of parameters.

    Parameters
    ----------
    method : str
        `latin-hypercube` or `sobol` (scrambled), of `scipy.stats.qmc`.
    count : int
        Number of points; a power of 2 for `sobol`.
    seed : int
    ranges : mapping of str to Range
        By key of the parameter.
    """

    method: str
    count: int
    seed: int
    ranges: Mapping[str, Range]

    def __post_init__(self) -> None:
        if self.count < 1:
            raise InputError(f"count is {self.count}", allowed="a whole number above 0")
        if self.seed < 0:
            raise InputError(f"seed is {self.seed}", allowed="a whole number, 0 or above")
        if self.method == "sobol" and self.count & (self.count - 1):
            below = 1 << (self.count.bit_length() - 1)
            raise InputError(
                f"count is {self.count}",
                allowed="a power of 2, at which a Sobol sequence is balanced",
                remedy=f"Take {below} or {2 * below}, or latin-hypercube.",
            )

    def points(self) -> list[list[Setting]]:
        """The points, each as the settings of all parameters.

        Examples
        --------
        >>> sample = Sample("sobol", 4, 1, {"drivetrain.tilt": Range(0.0, 8.0, "deg")})
        >>> sorted(int(point[0].value // 2) for point in sample.points())  # one in each quarter
        [0, 1, 2, 3]
        """
        from scipy.stats import qmc

        kind = {"latin-hypercube": qmc.LatinHypercube, "sobol": qmc.Sobol}[self.method]
        positions = kind(len(self.ranges), rng=np.random.default_rng(self.seed)).random(self.count)
        return [
            [
                # Twelve digits are more than any parameter is known to, and hold on every machine.
                Setting(key, float(f"{interval.at(float(position)):.12g}"), interval.unit)
                for (key, interval), position in zip(self.ranges.items(), point, strict=True)
            ]
            for point in positions
        ]


def grid(values: Mapping[str, list[Setting]]) -> list[list[Setting]]:
    """Every combination of the settings of each key.

    Examples
    --------
    >>> tilts = [Setting("drivetrain.tilt", value, "deg") for value in (4.0, 5.0, 6.0)]
    >>> drags = [Setting("forces.drag", value) for value in (True, False)]
    >>> len(grid({"drivetrain.tilt": tilts, "forces.drag": drags})), len(grid({}))
    (6, 1)
    """
    return [list(combination) for combination in itertools.product(*values.values())]


def label(settings: list[Setting]) -> dict[str, Any]:
    """The values of settings by key, as labels of a run."""
    return {setting.key: setting.value for setting in settings}
