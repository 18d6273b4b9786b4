"""Goksem and Hargreaves' formula against Grubin's inlet: a Hertz gap, lifted by the film, and Barus' law."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from macroslip.rolling.elastic_line import log_inlet
from macroslip.rolling.goksem_hargreaves import goksem_hargreaves, inlet_heating_of_rolling


def hertz_gap(t):
    """Gap 2R h/b² at x = −b (1 + t²) of a dry contact."""
    x = 1.0 + t * t
    root = t * np.sqrt(2.0 + t * t)
    return np.where(t < 1e-2, 4.0 * math.sqrt(2.0) / 3.0 * t**3, x * root - np.log(x + root))


def grubin(load, material):
    """N_F of the inlet ½ ∫ (h − h*) dp in Moes' groups; the reduced pressure reaches 1/α at the edge.

    The gap h* itself does no net work: pressure rises and falls by the same amount over it.
    """
    flow = 1.5 * math.pi**2 / load**2
    exponent = material * math.sqrt(load / (2.0 * math.pi))

    def reduced(film, start):
        return flow * quad(lambda t: hertz_gap(t) * 2.0 * t / (film + hertz_gap(t)) ** 3, start, math.inf, limit=500)[0]

    film = math.exp(brentq(lambda e: reduced(math.exp(e), 0.0) - 1.0 / exponent, -12.0, 3.0))
    t = np.geomspace(1e-4, 1e3, 60001)
    gap = hertz_gap(t)
    rise = flow * gap * 2.0 * t / (film + gap) ** 3
    # 1/α − q, summed from the edge outwards: no cancellation where the pressure grows without bound.
    left = np.concatenate([[0.0], np.cumsum(0.5 * (rise[1:] + rise[:-1]) * np.diff(t))]) + rise[0] * t[0] / 5.0
    force = 0.5 * np.trapezoid(gap * rise / (exponent * left), t)
    return force * math.sqrt(8.0 * load / math.pi) * load / math.pi


@pytest.mark.parametrize("load", [7.0, 11.0, 20.0, 32.0])
def test_inlet_is_grubins_within_six_percent(load):
    # M of the raceways of the base bearing from 10 to 100 kN, L = 13.4.
    speed, modulus_ratio = 2.9e-11, 4846.0
    material = modulus_ratio * (2.0 * speed) ** 0.25
    force = goksem_hargreaves(load * math.sqrt(2.0 * speed), speed, modulus_ratio) / modulus_ratio
    assert force * (2.0 * speed) ** -0.75 == pytest.approx(grubin(load, material), rel=0.06)


def test_in_moes_groups_the_formula_has_no_third_group():
    for speed in (1e-12, 1e-10):
        material, load = 14.0, 20.0
        modulus_ratio = material * (2.0 * speed) ** -0.25
        plain = goksem_hargreaves(load * math.sqrt(2.0 * speed), speed, modulus_ratio) / modulus_ratio
        heavy = math.exp(10.0 * -math.log(plain * (2.0 * speed) ** -0.75)) + 1.470**-10
        assert math.exp(log_inlet(math.log(load), math.log(material))[0]) == pytest.approx(heavy**-0.1, rel=0.006)


def test_heating_lowers_the_force_and_vanishes_at_rest():
    assert inlet_heating_of_rolling(0.0) == 1.0
    assert inlet_heating_of_rolling(10.0) < inlet_heating_of_rolling(1.0) == pytest.approx(1.0 / 1.29)
