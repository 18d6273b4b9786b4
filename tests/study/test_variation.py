"""Grids and seeded samples."""

import math

import numpy as np
import pytest

from macroslip import Bearing, InputError
from macroslip.study.study_file import study_of
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
    with pytest.raises(InputError, match="sample.count: it is 0"):
        Sample(method="sobol", count=0, seed=1, ranges=RANGES)
    with pytest.raises(InputError, match="sample.seed: it is -1"):
        Sample(method="sobol", count=8, seed=-1, ranges=RANGES)
    with pytest.raises(InputError, match="low below high"):
        Range(1.0, 1.0)
    with pytest.raises(InputError, match="logarithmic"):
        Range(0.0, 1.0, "", "log")


def test_a_range_may_be_that_of_the_file(tmp_path):
    content = {
        "case": {"bearing": "skf-240-630-bc", "rollers": [0]},
        "loads": {"bundled": ["14B"]},
        "variations": {"sample": {"count": 16, "seed": 3, "ranges": {
            "bearing.roller_length": "range", "drivetrain.tilt": {"low": 4, "high": 6, "unit": "deg"}}}},
    }  # fmt: skip
    study = study_of(content, tmp_path)
    low, high = Bearing.read("skf-240-630-bc").provenance["roller_length"].range
    lengths = sorted(run.labels["bearing.roller_length"] for run in study.runs())
    assert study.parameters["bearing.roller_length"] == "mm"
    assert low <= lengths[0] < lengths[-1] <= high
    # A Latin hypercube of 16 points has one in each sixteenth.
    sixteenths = [int((length - low) / (high - low) * 16) for length in lengths]
    assert sixteenths == list(range(16))


@pytest.mark.parametrize(
    ("key", "bearings", "message"),
    [
        ("bearing.width", ["skf-240-630-bc"], "skf-240-630-bc has no range for width"),
        ("bearing.rollers_per_row", ["skf-240-630-bc"], "rollers_per_row is a count.*variations.grid"),
        ("bearing.roller_length", ["skf-240-630-bc", "skf-240-600-bc"], "has 2 of them"),
        ("drivetrain.tilt", ["skf-240-630-bc"], "no value of a bearing or lubricant"),
        ("bearing.roller_lenght", ["skf-240-630-bc"], "Did you mean 'bearing.roller_length'"),
    ],
)
def test_a_range_that_no_file_has(tmp_path, key, bearings, message):
    content = {
        "loads": {"bundled": ["14B"]},
        "bearings": bearings,
        "variations": {"sample": {"count": 2, "seed": 3, "ranges": {key: "range"}}},
    }
    with pytest.raises(InputError, match=message):
        study_of(content, tmp_path)
