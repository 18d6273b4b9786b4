"""A roller by the addresses of its laws, against the same roller with the laws in sight."""

from __future__ import annotations

import gc

import numba
import numpy as np
import pytest

from macroslip.compiled import jit
from macroslip.integrate.entries import sealed
from macroslip.integrate.held_contact import relaxation_rate, rising_at
from macroslip.integrate.measures import powers
from macroslip.integrate.sealed import (
    forces_of,
    powers_of,
    relaxation_of,
    rising_of,
    stage_forces_of,
    station_of,
)
from macroslip.mechanisms import Laws
from macroslip.ring.orbit import Instant
from macroslip.roller.forces import slip_forces, station
from macroslip.roller.model import roller_model
from macroslip.roller.stage_forces import AtStages

PLACES = [(0.4, 5e-5, 1e-5), (1.6, -2e-5, 2e-4), (4.0, 1e-4, -3e-4), (4.7, 8e-5, 0.3)]


@jit
def _at(model, angle, now, slip):
    at = station_of(model, angle, now)
    forces = forces_of(model, at, slip)
    return at, forces, powers_of(model, at, forces, slip)


@jit
def _stages(model, given):
    return stage_forces_of(model, given)


@jit
def _rates(model, load, speed):
    return rising_of(model, load, 2.0 * load, speed, 0.7 * speed), relaxation_of(model, load, speed)


@pytest.fixture(scope="module", params=[Laws.paper(), Laws.physical()], ids=["paper", "physical"])
def model(request, bearing, lubricant):
    return roller_model(bearing, lubricant, 1, tilt=0.1, laws=request.param)


def test_a_sealed_roller_has_the_forces_and_powers_of_its_laws(model):
    roller = sealed(model)
    for angle, approach, slip in PLACES:
        now = Instant(2.1, 0.3, 0.0, approach, 1e-4)
        at, forces, power = _at(roller, angle, now, slip)
        there = station(model, angle, now)
        expected = slip_forces(model, there, slip)
        assert at == there
        assert forces[:10] == expected[:10]
        for found, detail in zip(forces[10:], expected[10:], strict=True):
            assert found.asperity_power == (0.0 if detail is None else detail.asperity_power)
            assert np.isnan(found.skew) if detail is None else found == detail
        assert power == powers(model, there, expected, slip)


def test_a_sealed_roller_has_the_forces_at_three_stages(model):
    stations = [station(model, angle, Instant(2.1, 0.3, 0.0, approach, 1e-4)) for angle, approach, _ in PLACES[:3]]
    given = AtStages(*stations, *(slip for _, _, slip in PLACES[:3]))
    for found, there, (_, _, slip) in zip(_stages(sealed(model), given), stations, PLACES, strict=False):
        expected = slip_forces(model, there, slip)
        assert found[:7] == pytest.approx(expected[:7], rel=1e-12)
        assert found.rolling_power == expected.rolling_power


def test_a_sealed_roller_has_the_rates_of_its_laws(model):
    roller = sealed(model)
    for load, speed in ((3e2, 0.1), (2e4, 0.4)):
        expected = rising_at(model, load, 2.0 * load, speed, 0.7 * speed), relaxation_rate(model, load, speed)
        assert _rates(roller, load, speed) == expected


def test_sealed_rollers_are_of_one_type_whatever_the_laws(bearing, lubricant):
    kinds = {
        numba.typeof(sealed(roller_model(bearing, lubricant, -1, tilt=0.0, laws=laws)))
        for laws in (Laws.paper(), Laws.physical())
    }
    assert len(kinds) == 1


def test_a_sealed_roller_keeps_the_arrays_of_its_laws(bearing, lubricant):
    def made():
        return roller_model(bearing, lubricant, 1, tilt=0.1, laws=Laws.physical())

    now = Instant(2.1, 0.3, 0.0, 1e-4, 1e-4)
    expected = _at(sealed(made()), 0.4, now, 1e-5)
    roller = sealed(made())
    gc.collect()
    # What the arrays left would be taken by these.
    spoil = [np.full(size, 1e300) for size in (64, 1000, 9216, 100_000) for _ in range(50)]
    assert _at(roller, 0.4, now, 1e-5) == expected
    assert spoil
