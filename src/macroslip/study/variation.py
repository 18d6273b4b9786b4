"""Parameter variations: grids, lists and seeded samples."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np

from macroslip.errors import InputError
from macroslip.input.fields import Choice, Quantity, Text, Whole
from macroslip.input.files import Place, Source
from macroslip.input.messages import unknown_key
from macroslip.input.record import Record, dimensions
from macroslip.input.section import MappingOf, OrWord, input_section
from macroslip.study.settings import RECORDS, Setting

METHODS = ("latin-hypercube", "sobol")
SCALES = ("linear", "log")
#: Points of a sample beyond which the count must be a mistake.
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


def _checked_range(key: str, interval: Range | None) -> Range | None:
    """Check both ends as values of the parameter; those of a file are checked with it."""
    if interval is None:
        if key.partition(".")[0] not in RECORDS:
            raise InputError(
                f"the range of {key} is to come from a file, but it is no value of a bearing or lubricant",
                allowed="keys such as bearing.roller_length",
                remedy="Give low, high and unit.",
            )
        noun, _, name = key.partition(".")
        known = dimensions(RECORDS[noun])
        if name not in known:
            raise unknown_key(key, (f"{noun}.{one}" for one in known))
        return None
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
        By key of the parameter; None, in a file `range`: the range that the bearing's or lubricant's file gives the value.
    """

    method: Annotated[str, Choice("how to sample", lambda: METHODS)] = "latin-hypercube"
    count: Annotated[int, Whole("number of points; a power of 2 for sobol", 1, _MOST_POINTS)]
    seed: Annotated[int, Whole("seed: the same one gives the same points")]
    ranges: Annotated[
        dict[str, Range | None],
        MappingOf(
            "interval of each parameter",
            "a section such as {bearing.diametral_clearance: {low: 0, high: 0.4, unit: mm}, bearing.roller_length: range}",
            Annotated[Range | None, OrWord("range")],
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

    def with_ranges_of(self, records: Mapping[str, Record]) -> Sample:
        """The sample with the ranges that the files of bearing and lubricant give, in place of the word.

        Raises
        ------
        InputError
            If a value has no range there, or is a count.

        Examples
        --------
        >>> from macroslip import Bearing
        >>> sample = Sample(count=2, seed=1, ranges={"bearing.roller_length": None})
        >>> found = sample.with_ranges_of({"bearing": Bearing.read("skf-240-630-bc")}).ranges["bearing.roller_length"]
        >>> found.low, found.high, found.unit
        (96.3, 111.7, 'mm')
        """
        found = dict(self.ranges)
        for key, interval in self.ranges.items():
            if interval is None:
                noun, _, name = key.partition(".")
                entry = records[noun].provenance.get(name)
                if entry is None or entry.range is None:
                    raise InputError(
                        f"{records[noun].name} has no range for {name}",
                        where=f"variations.sample.ranges.{key}",
                        remedy="Give low, high and unit, or a range in the file.",
                    )
                if isinstance(getattr(records[noun], name), int):
                    raise InputError(
                        f"{name} is a count, which an interval cannot sample",
                        where=f"variations.sample.ranges.{key}",
                        remedy=f"List its values in variations.grid: {{{key}: {{values: [...]}}}}.",
                    )
                unit = "" if entry.unit == "1" else entry.unit
                found[key] = Range(low=entry.range[0], high=entry.range[1], unit=unit)
        return Sample(method=self.method, count=self.count, seed=self.seed, ranges=found)

    def points(self) -> list[list[Setting]]:
        """The points, each as the settings of all parameters.

        Examples
        --------
        >>> sample = Sample(method="sobol", count=4, seed=1, ranges={"drivetrain.tilt": Range(0.0, 8.0, "deg")})
        >>> sorted(int(point[0].value // 2) for point in sample.points())  # one in each quarter
        [0, 1, 2, 3]
        """
        from scipy.stats import qmc

        kind = {"latin-hypercube": qmc.LatinHypercube, "sobol": qmc.Sobol}[self.method]
        intervals: dict[str, Any] = dict(self.ranges)  # `with_ranges_of` has filled in those that were left open
        positions = kind(len(self.ranges), rng=np.random.default_rng(self.seed)).random(self.count)
        return [
            [
                # Twelve digits are more than the accuracy of any parameter, and the same on every machine.
                Setting(key, float(f"{interval.at(float(position)):.12g}"), interval.unit)
                for (key, interval), position in zip(intervals.items(), point, strict=True)
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
