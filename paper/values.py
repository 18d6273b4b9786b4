"""The values of the base case that are estimates, with their ranges from `values.csv`, and a sample of all."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from macroslip import Bearing

SEED, POINTS = 20261122, 128  # seed and number of points of the sample


@dataclass(frozen=True, slots=True)
class UncertainValue:
    """A value of which only a range is known, evenly likely in it; or a choice, each as likely.

    `key` is the study's name for it; `unit` the unit of `low` and `high`; `tag` the provenance of the base value as in the
    catalogue, C for a choice; `kind` "even", "log" (the logarithm is evenly likely), "count" (a whole number) or "choice".

    Examples
    --------
    >>> round(UncertainValue("", "", "Pa s", 0.1, 10.0, kind="log").at(0.5), 12)
    1.0
    """

    name: str
    key: str
    unit: str
    low: float
    high: float
    tag: str = "E"
    kind: str = "even"
    choices: Sequence[str | float] = ()
    reason: str = ""

    def at(self, position: float) -> Any:
        """The value at a place from 0 to 1 in its range, in its unit; of a choice its name or number."""
        if self.kind == "choice":
            return self.choices[int(position * len(self.choices))]
        if self.kind == "count":
            return int(self.low) + int(position * (self.high - self.low + 1.0))
        if self.kind == "log":
            return self.low * (self.high / self.low) ** position
        return self.low + position * (self.high - self.low)

    @property
    def range_text(self) -> str:
        """The range in words."""
        return " or ".join(
            map(str, self.choices)
        ) or f"{self.low:g} to {self.high:g} {self.unit}".removesuffix(" 1")


def _read() -> tuple[UncertainValue, ...]:
    with (Path(__file__).parent / "values.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    numbers = [
        {
            "low": float(row["low"]),
            "high": float(row["high"]),
            "choices": [
                float(choice) if choice[0].isdigit() else choice
                for choice in row["choices"].split()
            ],
        }
        for row in rows
    ]
    return tuple(UncertainValue(**row | number) for row, number in zip(rows, numbers, strict=True))


VALUES = _read()


def sample_places() -> NDArray[np.float64]:
    """Places from 0 to 1 in the ranges of `VALUES`, shape (points, values): a scrambled Sobol sequence.

    Of counts and choices the middle of the places that give the same.
    """
    from scipy.stats import qmc

    places = qmc.Sobol(len(VALUES), rng=np.random.default_rng(SEED)).random(POINTS)
    for k, uncertain in enumerate(VALUES):
        if uncertain.kind in ("count", "choice"):
            count = uncertain.high - uncertain.low + 1.0
            places[:, k] = (np.floor(places[:, k] * count) + 0.5) / count
    return places


def sample_points() -> list[dict[str, Any]]:
    """Settings of every point of the sample, as a study has them; the first has none, and is the base case.

    Both osculations are the same, and pitch radius and row offset follow roller diameter and
    contact angle: (R − r) cos α and (R − r) sin α, R the outer raceway's radius.

    Examples
    --------
    >>> points = sample_points()
    >>> len(points), points[0], len(points[1]) == len(VALUES) + 4
    (129, {}, True)
    """
    sphere = Bearing.read("skf-240-600-bc").outer_raceway_radius
    points: list[dict[str, Any]] = [{}]
    for places in sample_places():
        drawn = {
            uncertain.key: uncertain.at(float(position))
            for uncertain, position in zip(VALUES, places, strict=True)
        }
        point = {
            uncertain.key: drawn[uncertain.key]
            if uncertain.unit == "1"
            else f"{drawn[uncertain.key]:.12g} {uncertain.unit}"
            for uncertain in VALUES
        }
        centre = sphere - 0.5e-3 * drawn["bearing.roller_diameter"]
        angle = math.radians(drawn["bearing.contact_angle"])
        points.append(
            point
            | {
                "bearing.osculation_inner": point["bearing.osculation_outer"],
                "bearing.pitch_radius": f"{centre * math.cos(angle):.12g} m",
                "bearing.row_offset": f"{centre * math.sin(angle):.12g} m",
                # Above 11.8 degrees the rollers leave the catalogue's width, which enters nothing else here.
                "bearing.width": "0.3 m",
            }
        )
    return points
