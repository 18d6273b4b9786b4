"""Which solutions of a step are accepted where traction may fall with slip."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from macroslip.integrate.held_contact import rising_at
from macroslip.integrate.root import is_continuous
from macroslip.roller.contact_force import raceway_force
from macroslip.roller.model import roller_model

LOAD, RING = 4e4, -0.4


@pytest.fixture(scope="module")
def model(bearing, lubricant):
    return roller_model(bearing, lubricant, 1, tilt=0.0)


def judged(model, slip, stage_slips, slopes=(1.0, 1.0, 1.0), cold=0.0, load=LOAD):
    at = SimpleNamespace(inner_load=load, outer_load=load, ring_speed=RING)
    step = SimpleNamespace(at1=at, at2=at, at3=at, scale=100.0)
    forces = [SimpleNamespace(slope=slope) for slope in slopes]
    stages = SimpleNamespace(
        **dict(zip(("v1", "v2", "v3"), stage_slips, strict=True)), **dict(zip(("f1", "f2", "f3"), forces, strict=True))
    )
    path = SimpleNamespace(model=model, limits=SimpleNamespace(cold_slip=cold, speed_scale=0.4))
    state = SimpleNamespace(slip=slip, at=at)
    return is_continuous(path, state, step, stages)


@pytest.mark.parametrize("load", [1e3, 4e4, 1.5e5])
def test_traction_rises_up_to_the_bound_and_falls_well_beyond_it(model, load):
    bound = rising_at(model, load, load, abs(RING), 2 * abs(RING))
    assert 0.0 < bound < math.inf

    def pull(slip):
        return raceway_force(model.inner, load, slip, RING, abs(RING), 0.0).pull

    rising = [pull(slip) for slip in np.linspace(0.0, bound, 60)]
    assert (np.diff(rising) > 0.0).all()
    assert pull(100.0 * bound) < pull(10.0 * bound)


def test_the_bound_is_that_of_the_raceway_with_the_lower_one(model):
    both = rising_at(model, 1e3, 1.5e5, abs(RING), abs(RING))
    alone = [rising_at(model, load, load, abs(RING), abs(RING)) for load in (1e3, 1.5e5)]
    assert min(alone) <= both <= max(alone)


def test_below_the_bound_any_change_is_the_one_root(model):
    bound = rising_at(model, LOAD, LOAD, abs(RING), abs(RING) + 1.0)
    assert judged(model, 0.0, (0.3 * bound, 0.5 * bound, 0.8 * bound))
    assert judged(model, 1.0, (0.1, 0.2, 0.3), cold=2.0)


def test_above_it_only_a_small_change_is(model):
    assert judged(model, 0.30, (0.29, 0.28, 0.25))
    assert not judged(model, 0.30, (0.29, 0.28, 0.23))
    assert not judged(model, 0.0, (0.1, 0.2, 0.3))
    assert judged(model, 0.30, (0.30, 0.30, 0.30 - 1e-7))


def test_traction_that_falls_faster_than_the_step_allows_is_never_accepted(model):
    for which in range(3):
        slopes = [1.0, 1.0, 1.0]
        slopes[which] = -51.0
        assert not judged(model, 0.0, (0.0, 0.0, 0.0), slopes, cold=1.0)
        slopes[which] = -49.0
        assert judged(model, 0.0, (0.0, 0.0, 0.0), slopes, cold=1.0)
