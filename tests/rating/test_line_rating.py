"""Rating of cylindrical rollers that touch along a line, against ISO/TS 16281 by hand."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

from macroslip import Bearing, BearingLoads, Lubricant
from macroslip.contact.line_rolling import LineContact, line_film
from macroslip.contact.strips import strips_of
from macroslip.rating.iso import minimum_load_of_rollers
from macroslip.rating.kinds import ratings_of
from macroslip.rating.lines import loads_of_strips
from macroslip.rating.rate import rate, roller_load_history

CROWNED = Bearing.read(Path(__file__).parents[2] / "validation" / "data" / "cylindrical-160.yaml")
OIL = Lubricant.read("vg320-mineral").at(333.15)
SPEED = 1500.0 * math.pi / 30.0
FORCE = 60e3
LAMINAE = 30


def profiled(profile):
    return CROWNED.replace(roller_crown_radius=None, roller_profile=profile)


def drops(profile):
    """Profile of ISO/TS 16281 at the middles of 30 laminae of 50 mm [mm]."""
    places = 50.0 * ((np.arange(LAMINAE) + 0.5) / LAMINAE - 0.5)
    depth = 0.00035 * 32.0 if profile == "logarithmic" else 0.0
    return depth * np.log(1.0 / (1.0 - (2.0 * places / 50.0) ** 2))


def laminae_of(approach, profile):
    """Loads of laminae [N] at an approach of both rings [mm], by Palmgren's formula at each."""
    pressed = np.maximum(0.5 * approach - drops(profile), 0.0)
    return (pressed * 50.0**0.8 / 3.84e-5) ** (1.0 / 0.9) / LAMINAE


@pytest.mark.parametrize("profile", ["straight", "logarithmic"])
def test_lives_and_pressures_are_those_of_laminae_by_hand(profile):
    bearing = profiled(profile)
    loads = BearingLoads.constant([0.0, -FORCE, 0.0], SPEED, 0.2)
    rating = rate(bearing, OIL, *roller_load_history(bearing, OIL, loads))
    dynamic = ratings_of(bearing).dynamic
    assert dynamic == ratings_of(CROWNED).dynamic
    gamma = 32.0 / 225.0
    ratio = 1.038 * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)
    inner = dynamic / 18.0 / 0.378 * (1.0 + ratio**4.5) ** (2.0 / 9.0)
    outer = dynamic / 18.0 / 0.364 * (1.0 + ratio**-4.5) ** (2.0 / 9.0)
    lives = []
    heaviest = 0.0
    for turn in np.arange(20) / 20.0:
        below = np.cos(2.0 * np.pi * (np.arange(18) + turn) / 18.0)

        def strips_at(depth, below=below):
            return np.array([laminae_of(depth * direction - 0.05, profile) for direction in below])

        depth = brentq(
            lambda displacement, below=below: strips_at(displacement).sum(axis=1) @ below - FORCE,
            0.05,
            1.0,
        )
        strips = strips_at(depth)
        heaviest = max(heaviest, strips.max() * LAMINAE / 50e-3)
        damage = np.mean(
            np.mean((0.83 * LAMINAE * strips / inner) ** 4.0, axis=0) ** 1.125
        ) + np.mean(np.mean((0.83 * LAMINAE * strips / outer) ** 4.5, axis=0))
        lives.append(1e6 * damage ** (-8.0 / 9.0))
    hours = 1.0 / np.mean(1.0 / np.array(lives)) / (SPEED / (2.0 * np.pi) * 3600.0)
    life = float(rating.reference_life.sel(load_along_roller="hertz"))
    assert life == pytest.approx(hours, rel=1e-2)
    steel = 210e9 / (1.0 - 0.3**2)
    curvatures = np.array([1.0 / 16e-3 + 1.0 / 96.5e-3, 1.0 / 16e-3 - 1.0 / 128.5e-3])
    expected = np.sqrt(heaviest * curvatures * steel / (2.0 * np.pi))
    assert rating.largest_pressure.values[0] == pytest.approx(expected, rel=1e-2)
    assert float(rating.minimum_load) == minimum_load_of_rollers(dynamic)


def test_film_ratios_are_those_of_a_line_with_the_middles_load():
    bearing = profiled("straight")
    loads = BearingLoads.constant([0.0, -FORCE, 0.0], SPEED, 0.2)
    _, roller_load = history = roller_load_history(bearing, OIL, loads)
    rating = rate(bearing, OIL, *history)
    strips = strips_of(bearing)[0]
    line = LineContact(
        strips.curvature, 0.05, strips.modulus, bearing.composite_roughness, bearing.hardness, OIL
    )
    speed = SPEED * 96.5e-3 * 128.5e-3 / (96.5e-3 + 128.5e-3)
    film = line_film(line, roller_load[roller_load > 0.0], speed) / _heated(OIL, speed)
    ratio = film / bearing.composite_roughness
    assert float(rating.film_ratio[0, 0]) == pytest.approx(np.median(ratio), rel=5e-3)


def _heated(oil, speed):
    """Factor of the heated inlet, which a rating leaves out: 1/(1 + 0.1 L^0.64)."""
    from macroslip.contact.film import thermal_loading

    return 1.0 / (1.0 + 0.1 * (thermal_loading(oil) * speed**2) ** 0.64)


@pytest.mark.parametrize("profile", ["straight", "logarithmic"])
def test_strips_add_up_to_the_roller_and_converge(profile):
    strips = strips_of(profiled(profile))[0]
    load = np.array([[0.0, 40.0], [3e3, 9e4]])
    for count in (7, 30, 101):
        parts = loads_of_strips(strips, load, count)
        assert parts.shape == (2, 2, count)
        assert parts.sum(axis=-1) == pytest.approx(load, rel=1e-12)
        assert np.all(parts >= 0.0)
        assert parts == pytest.approx(parts[..., ::-1], rel=1e-12)
    # What counts for a life is the mean of q^(9/2), q the load per length, in its exponent 8/9.
    damage = [
        ((count * loads_of_strips(strips, load[1], count)) ** 4.5).mean(axis=-1)
        for count in (10, 30, 90, 2430)
    ]
    errors = [np.abs(coarse / damage[-1] - 1.0).max() for coarse in damage[:-1]]
    assert errors[1] < 0.02
    assert max(errors) < 1e-9 if profile == "straight" else errors[0] > errors[1] > errors[2]
