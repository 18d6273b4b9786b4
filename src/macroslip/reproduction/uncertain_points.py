"""The points of the sample over estimated values, as its study file has them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from macroslip.bearing import Bearing
from macroslip.reproduction.uncertain_value import UNITS, UncertainValue, in_file_units
from macroslip.reproduction.uncertain_values import VALUES

#: Seed and number of points of the sample.
SEED, POINTS = 20261122, 128


def sample_points() -> list[dict[str, Any]]:
    """Settings of every point of the sample, as a study file has them; the first has none, and is the base case.

    A scrambled Sobol sequence (`scipy.stats.qmc`) over all `VALUES`. Both osculations are the same, and pitch radius and
    row offset follow roller diameter and contact angle: (R − r) cos α and (R − r) sin α, R the outer raceway's radius.

    Examples
    --------
    >>> points = sample_points()
    >>> len(points), points[0], len(points[1]) == len(VALUES) + 4
    (129, {}, True)
    """
    from scipy.stats import qmc

    sphere = Bearing.read("skf-240-600-bc").outer_raceway_radius
    points: list[dict[str, Any]] = [{}]
    for places in qmc.Sobol(len(VALUES), rng=np.random.default_rng(SEED)).random(POINTS):
        drawn = {one.key: one.at(float(place)) for one, place in zip(VALUES, places, strict=True)}
        text = {one.key: _written(drawn[one.key], one) for one in VALUES}
        text["bearing.osculation_inner"] = text["bearing.osculation_outer"]
        centre = sphere - 0.5e-3 * drawn["bearing.roller_diameter"]
        angle = math.radians(drawn["bearing.contact_angle"])
        text["bearing.pitch_radius"] = f"{centre * math.cos(angle):.12g} m"
        text["bearing.row_offset"] = f"{centre * math.sin(angle):.12g} m"
        # Above 11.8 degrees the rollers leave the catalogue's width, which enters nothing else here.
        text["bearing.width"] = "0.3 m"
        points.append(text)
    return points


def _written(value: Any, one: UncertainValue) -> Any:
    """A value as a case file has it: twelve digits, with its unit."""
    if isinstance(value, str | int):
        return value
    digits, unit = f"{in_file_units(value, one.unit):.12g}", UNITS[one.unit][0]
    return f"{digits} {unit}" if unit else float(digits)
