"""Forces at three stations at once against those at each."""

import dataclasses

import numba
import numpy as np
import pytest

from macroslip.compiled import jit
from macroslip.mechanisms import Laws
from macroslip.reference import by_reference
from macroslip.roller.forces import Station, magnitude, slip_forces
from macroslip.roller.model import roller_model
from macroslip.roller.stage_forces import AtStages, stage_forces, takes_lanes

BARUS = Laws.paper()


@jit
def at_once(model, given):
    return stage_forces(by_reference(model), given)


@jit
def one(model, at, slip):
    return slip_forces(by_reference(model), at, slip)


@pytest.fixture(scope="module")
def model(bearing, lubricant):
    return roller_model(bearing, lubricant, 1, tilt=0.1, laws=BARUS)


def station(random, *, free):
    """Loads from nothing to 60 kN, and speeds of either sign down to a standstill."""
    light = 0.0 if free else 10 ** random.uniform(-2.0, 4.8)
    speed = random.choice([-1.0, 1.0]) * random.choice([0.4, 1e-3, 1e-8]) * random.random()
    return Station(speed, 0.0, 0.0, light, 10 ** random.uniform(-1.0, 4.8), random.normal(0.0, 40.0))


@pytest.mark.parametrize("slipping", [True, False], ids=["skids", "gripped"])
@pytest.mark.parametrize("free", [(False, False, False), (True, False, True), (True, True, True)])
def test_forces_at_once_are_those_at_each_station(model, slipping, free):
    random = np.random.default_rng(7)
    for _ in range(200):
        stations = [station(random, free=one) for one in free]
        slips = random.normal(0.0, 0.3, 3) if slipping else 10 ** random.uniform(-13.0, -5.0, 3)
        found = at_once(model, AtStages(*stations, *slips))
        for there, slip, at_stage in zip(stations, slips, found, strict=True):
            expected = one(model, there, slip)
            # Forces of the raceways may all but cancel at the cage; at its peak a force's slope does, beside force over slip.
            size = magnitude(expected)
            secant = size / abs(slip)
            assert at_stage[:3] == pytest.approx(expected[:3], rel=1e-13, abs=1e-12 * size)
            assert at_stage[3:6] == pytest.approx(expected[3:6], rel=1e-12, abs=1e-13 * secant)
            assert at_stage.cage_load == pytest.approx(expected.cage_load, rel=1e-13, abs=1e-13 * size)
            assert at_stage.cage_load_slope == pytest.approx(expected.cage_load_slope, rel=1e-13, abs=1e-13 * secant)
            assert at_stage[8:] == expected[8:]


def test_laws_that_do_not_take_lanes_are_asked_one_by_one(bearing, lubricant, model):
    assert takes_lanes(numba.typeof(model))
    for laws in (Laws.physical(), dataclasses.replace(BARUS, film="moes")):
        assert not takes_lanes(numba.typeof(roller_model(bearing, lubricant, 1, tilt=0.1, laws=laws)))
