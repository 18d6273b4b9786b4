"""Axial travel and reversals of thrust against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from macroslip import Bearing, BearingLoads, Case, RollerLoads
from macroslip.bearing.load_ratings import static_load_rating_of
from macroslip.case.parts import Window
from macroslip.result.dataset import axial_values
from macroslip.result.prepared import prepare
from macroslip.ring.axial import reversal_rate, travel_rate
from macroslip.roller.model import ring_geometry

PERIOD = 20.0
TIME = np.linspace(0.0, 200.0, 4001)


def sine(amplitude, mean=0.0):
    return mean + amplitude * np.sin(2.0 * math.pi * TIME / PERIOD)


def test_a_sine_travels_four_amplitudes_a_period():
    rate = travel_rate(TIME, sine(3e-5), 0.0, 200.0)
    assert rate == pytest.approx(4.0 * 3e-5 * 3600.0 / PERIOD, rel=1e-12)
    # A part of a rise, whose ends lie between samples.
    start, end = 0.0137, 4.0021
    way = 3e-5 * (math.sin(math.pi / 10.0 * end) - math.sin(math.pi / 10.0 * start))
    assert travel_rate(TIME, sine(3e-5), start, end) == pytest.approx(
        way * 3600.0 / (end - start), rel=1e-4
    )


def test_a_sine_reverses_twice_a_period_unless_it_stays_within_the_band():
    assert reversal_rate(TIME, sine(2e4), 1e4, 0.0, 200.0) == 19 * 18.0
    assert reversal_rate(TIME, sine(0.99e4), 1e4, 0.0, 200.0) == 0.0
    assert reversal_rate(TIME, sine(2e4, mean=2.5e4), 1e4, 0.0, 200.0) == 0.0
    # It reaches beyond the band on one side only.
    assert reversal_rate(TIME, sine(2e4, mean=1.5e4), 1e4, 0.0, 200.0) == 0.0
    assert reversal_rate(TIME, sine(2e4), 1e4, 100.0, 100.0) == 0.0


def test_noise_within_the_band_does_not_count():
    noisy = sine(2e4) + 0.9e4 * np.where(np.arange(TIME.size) % 2, 1.0, -1.0)
    assert reversal_rate(TIME, noisy, 1e4, 0.0, 200.0) == 19 * 18.0


def loads(amplitude, mean=0.0):
    force = np.column_stack([np.zeros((TIME.size, 2)), sine(amplitude, mean)])
    return BearingLoads(time=TIME, force=force, shaft_speed=np.full(TIME.size, 1.0), source="sine")


def test_a_bearing_under_sinusoidal_thrust_alone():
    """F = Z K (dZ sin α − P_d/2 cos α)^1.5 sin α: the ring travels four times the largest dZ a period."""
    case = Case(loads=loads(2e5), window=Window(start=0.0), rollers=[0])
    ready = prepare(case)
    bearing = case.bearing
    ring = ring_geometry(bearing, ready.model)
    sine_of, cosine_of = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    approach = (2e5 / (bearing.rollers_per_row * ring.stiffness * sine_of)) ** (2.0 / 3.0)
    largest = (approach + ring.radial_play * cosine_of) / sine_of
    values = axial_values(ready)
    assert float(values["axial_travel"]) == pytest.approx(4.0 * largest * 3600.0 / PERIOD, rel=1e-6)
    assert float(values["thrust_reversals"]) == 19 * 18.0


def test_thrust_within_a_thousandth_of_the_static_rating_has_no_sign():
    rating = static_load_rating_of(Bearing.read("skf-240-600-bc"))
    for factor, expected in ((0.99e-3, 0.0), (1.01e-3, 19 * 18.0)):
        ready = prepare(Case(loads=loads(factor * rating), window=Window(start=0.0), rollers=[0]))
        assert float(axial_values(ready)["thrust_reversals"]) == expected


def test_given_roller_loads_and_one_row_have_no_ring_that_travels():
    places = np.radians(np.tile(np.arange(0.0, 360.0, 45.0), (2, 2, 1)))
    given = RollerLoads(
        np.array([0.0, 10.0]), np.full(2, 2.143), places, np.full(places.shape, 9e3), "even"
    )
    assert axial_values(prepare(Case(loads=given, rollers=[0]))) == {}
