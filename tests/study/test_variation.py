"""Grids and seeded samples."""

import math

import numpy as np
import pytest

from macroslip import InputError
from macroslip.study.variation import Range, Sample

RANGES = {"drivetrain.tilt": Range(2.0, 6.0, "deg"), "integrator.tolerance": Range(1e-6, 1e-2, "", "log")}


@pytest.mark.parametrize(("method", "count"), [("latin-hypercube", 12), ("sobol", 16)])
def test_every_parameter_is_spread_evenly(method, count):
    points = Sample(method=method, count=count, seed=7, ranges=RANGES).points()
    for place, position in ((0, lambda x: (x - 2.0) / 4.0), (1, lambda x: (math.log10(x) + 6.0) / 4.0)):
        positions = np.array([position(point[place].value) for point in points])
        # One point in each of as many equal parts.
        assert sorted(np.floor(positions * count).astype(int)) == list(range(count))


def test_the_seed_decides():
    first, same, other = (
        Sample(method="latin-hypercube", count=5, seed=seed, ranges=RANGES).points() for seed in (1, 1, 2)
    )
    assert first == same and first != other


def test_wrong_samples_are_refused():
    with pytest.raises(InputError, match="Take 8 or 16"):
        Sample(method="sobol", count=12, seed=1, ranges=RANGES)
    with pytest.raises(InputError, match="count is 0"):
        Sample(method="sobol", count=0, seed=1, ranges=RANGES)
    with pytest.raises(InputError, match="seed is -1"):
        Sample(method="sobol", count=8, seed=-1, ranges=RANGES)
    with pytest.raises(InputError, match="low below high"):
        Range(1.0, 1.0)
    with pytest.raises(InputError, match="logarithmic"):
        Range(0.0, 1.0, "", "log")
