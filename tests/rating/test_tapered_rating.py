"""Rating of tapered bearings: standards' formulas by hand, and ISO/TS 16281 in a limit of ISO 281."""

import math

import numpy as np
import pytest

from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.rating.tapered import (
    equivalent_load,
    strip_damage,
    tapered_ratings,
    tapered_reference_life,
)
from macroslip.ring.tapered import tapered_balance, tapered_ring

MAIN = TaperedBearing.read("tdo-main-bearing")


def test_ratings_by_the_standards_are_those_of_an_independent_program():
    """C0 15,928 kN of a published 16,000, and C 5,970 of 8,090: the standard's C is no check."""
    bare = MAIN.replace(dynamic_load_rating=None, static_load_rating=None, fatigue_load_limit=None)
    ratings = tapered_ratings(bare)
    assert ratings.static / 1e3 == pytest.approx(15928, rel=2e-3)
    assert ratings.dynamic / 1e3 == pytest.approx(5970, rel=1e-2)


def test_the_equivalent_load_is_continuous_at_e():
    """Both formulas of ISO 281 agree where axial over radial load is e, to the factors' rounding."""
    ratings = tapered_ratings(MAIN)
    below, above = equivalent_load(
        ratings, 1e6, 1e6 * ratings.axial_factor_e * np.array([1.0 - 1e-9, 1.0 + 1e-9])
    )
    assert below == pytest.approx(above, rel=0.01)


def test_strips_of_one_roller_by_hand():
    strips = np.array([[3e3, 5e3], [1e3, 0.0]])
    at_rest = np.mean([np.mean([s**4.5 for s in strip]) for strip in strips.T])
    turning = np.mean([np.mean([s**4 for s in strip]) ** 1.125 for strip in strips.T])
    scale = (2 * 0.83 / 1e5) ** 4.5
    assert strip_damage(strips, 1e5, True) == pytest.approx(at_rest * scale, rel=1e-12)
    assert strip_damage(strips, 1e5, False) == pytest.approx(turning * scale, rel=1e-12)


def life(bearing, force, moment, samples=40):
    ring = tapered_ring(bearing)
    angle = np.linspace(0.0, 2.0 * math.pi / bearing.rollers_per_row / ring.orbit_ratio, samples)
    shape = np.ones((samples, 1))
    balance = tapered_balance(ring, angle, shape * np.array(force), shape * np.array(moment))
    return tapered_reference_life(bearing, ring, balance, angle)


def test_half_the_zone_loaded_has_nearly_the_life_of_iso_281():
    """Pure radial load that loads half of each row is the case for which ISO 281's C holds.

    C has a factor 0.83 for pressure at edges, which ISO/TS 16281 takes out where strips show what
    is there: 0.83^-4 in life for an even load. The rest is the profile's, the rib's and that of
    10/9 in place of 1.1 in the law of a strip.
    """
    ratings = tapered_ratings(MAIN)
    radial = 1500e3
    computed = life(MAIN.replace(preload=0.0), (0.0, -radial, 0.0), (0.0, 0.0))
    expected = 1e6 * (ratings.dynamic / radial) ** (10.0 / 3.0)
    assert 0.75 < computed / expected * 0.83**4 < 1.3


def test_moments_and_preload_shorten_the_life():
    force = (50e3, -1300e3, 700e3)
    straight = life(MAIN, force, (0.0, 0.0))
    assert life(MAIN, force, (-700e3, 200e3)) < straight
    assert life(MAIN.replace(preload=0.4e-3), force, (0.0, 0.0)) < straight


def test_a_shaft_at_rest_has_no_life_in_revolutions():
    ring = tapered_ring(MAIN)
    balance = tapered_balance(ring, np.zeros(2), np.full((2, 3), 1e5), np.zeros((2, 2)))
    assert math.isnan(tapered_reference_life(MAIN, ring, balance, np.zeros(2)))


def test_factors_follow_from_the_nominal_contact_angle():
    ratings = tapered_ratings(MAIN)
    angle = tapered_geometry(MAIN).outer_angle
    assert ratings.axial_factor_e == pytest.approx(1.5 * math.tan(angle), rel=1e-12)
    assert ratings.axial_factor_y2 / ratings.axial_factor_y1 == pytest.approx(
        0.67 / 0.45, rel=1e-12
    )
