"""Parameter variations: grids, lists and seeded samples."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from typing import Annotated

import numpy as np

from macroslip.catalogue.forms import Choice, Quantity, Text, Whole
from macroslip.catalogue.input_section import MappingOf, input_section
from macroslip.catalogue.source import Place, Source
from macroslip.errors import InputError
from macroslip.study.settings import Setting

METHODS = ("latin-hypercube", "sobol")
SCALES = ("linear", "log")
#: Points of a sample beyond which only a mistaken count is left as an explanation.
_MOST_POINTS = 10_000_000


@input_section("range", "interval of a sampled parameter", positional=True)
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

    low: Annotated[float, Quantity("lower end; its unit goes into unit")]
    high: Annotated[float, Quantity("upper end; its unit goes into unit")]
    unit: Annotated[str, Text("unit of both ends", may_be_empty=True)] = ""
    scale: Annotated[str, Choice("scale on which values are equally likely", lambda: SCALES)] = "linear"

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


def _checked_range(key: str, interval: Range) -> Range:
    """Check both ends as values of the parameter."""
    for end in (interval.low, interval.high):
        Setting(key, end, interval.unit).check(Place(Source()))
    return interval


@input_section("sample", "seeded sample of a box of parameters")
class Sample:
    """Seeded sample of a box of parameters.

    Parameters
    ----------
    method : str
        `latin-hypercube` or `sobol` (scrambled), of `scipy.stats.qmc`.
    count : int
        Number of points; a power of 2 for `sobol`.
    seed : int
        The same one gives the same points.
    ranges : mapping of str to Range
        By key of the parameter.
    """

    method: Annotated[str, Choice("how to sample", lambda: METHODS)] = "latin-hypercube"
    count: Annotated[int, Whole("number of points; a power of 2 for sobol", 1, _MOST_POINTS)]
    seed: Annotated[int, Whole("seed: the same one gives the same points")]
    ranges: Annotated[
        dict[str, Range],
        MappingOf(
            "interval of each parameter",
            "a section such as {bearing.diametral_clearance: {low: 0, high: 0.4, unit: mm}}",
            Range,
            _checked_range,
        ),
    ]

    def __post_init__(self) -> None:
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
