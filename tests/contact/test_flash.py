"""Flash temperature against Jaeger's moving sources, and heat flow into two half-spaces by differences."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.linalg import solve_banded
from scipy.optimize import minimize_scalar
from scipy.special import k0e

from macroslip.compiled import jit
from macroslip.contact import flash
from macroslip.contact.flash import PEAK, effusivity, flash_temperature, transient_flash

CONDUCTIVITY, DENSITY, HEAT = 46.0, 7850.0, 460.0
STEEL = effusivity(CONDUCTIVITY, DENSITY, HEAT)
HALF_WIDTH = 0.4e-3
positive = st.floats(min_value=1e-3, max_value=1e3)


def speed_at(peclet):
    return 2 * CONDUCTIVITY * peclet / (HALF_WIDTH * DENSITY * HEAT)


def jaeger(position, peclet):
    """Rise at x = position·b under the semi-elliptical band, in P'/k, by quadrature of the full integral."""

    def source(distance):
        kernel = k0e(peclet * abs(distance)) * (
            1.0 if distance > 0 else math.exp(2 * peclet * distance)
        )
        return math.sqrt(max(0.0, 1 - (position - distance) ** 2)) * kernel

    # Distances from the source as squares: K0 is singular where the source is.
    accuracy = {"epsrel": 1e-10, "epsabs": 0.0, "limit": 400}
    behind = quad(lambda w: 2 * w * source(w * w), 0, math.sqrt(position + 1), **accuracy)[0]
    ahead = quad(lambda w: 2 * w * source(-w * w), 0, math.sqrt(1 - position), **accuracy)[0]
    return 2 / math.pi**2 * (behind + ahead)


def hottest(peclet):
    minimum = minimize_scalar(
        lambda position: -jaeger(position, peclet),
        bounds=(0, 0.95),
        method="bounded",
        options={"xatol": 1e-7},
    )
    return minimum.x, -minimum.fun


def overstated(peclet):
    """Relative error of `flash_temperature` for one surface, beside Jaeger's integral."""
    power = 100.0
    exact = power / CONDUCTIVITY * hottest(peclet)[1]
    return flash_temperature(power, HALF_WIDTH, speed_at(peclet), 0.0, STEEL, STEEL) / exact - 1


def test_constant_is_the_limit_of_high_peclet_number():
    position, rise = hottest(1e4)
    assert math.sqrt(4e4) * rise == pytest.approx(PEAK, rel=2e-9, abs=0.0)
    assert position == pytest.approx(0.652, abs=5e-4)


@pytest.mark.parametrize(
    ("peclet", "error"), [(0.5, 0.137), (1, 0.0625), (2, 0.0231), (5, 0.0041), (10, 0.0009)]
)
def test_measured_error_at_low_peclet_number(peclet, error):
    assert overstated(peclet) == pytest.approx(error, rel=0.02, abs=0.0)


def march(power, speed_1, speed_2):
    """Largest rise of two half-spaces that pass through the band together, their surfaces at one temperature.

    Heat conduction into the depth only, marched in the travelled distance with implicit differences: depth is
    scaled by the diffusion length of each body, so that both are one grid with the effusivities as weights.
    """
    steps, cells = 3000, 1500
    x = np.linspace(-1, 1, steps + 1)
    dx = x[1] - x[0]
    depth = 8 * np.linspace(0, 1, cells) ** 2  # in √(2 b κ/u), fine at the surface
    gap, width = np.diff(depth), np.gradient(depth)
    uptake = STEEL * (math.sqrt(speed_1) + math.sqrt(speed_2))
    width[0] = gap[0] / 2
    bands = np.zeros((3, cells))
    # ∂T/∂x = ½ ∂²T/∂z² with x in b.
    bands[0, 1:] = -0.5 * dx / gap / width[:-1]
    bands[2, :-1] = -0.5 * dx / gap / width[1:]
    bands[1] = 1.0
    bands[1, :-1] += 0.5 * dx / gap / width[:-1]
    bands[1, 1:] += 0.5 * dx / gap / width[1:]
    rise, peak = np.zeros(cells), 0.0
    flux = (
        2
        * power
        / (math.pi * HALF_WIDTH)
        * np.sqrt(np.maximum(0.0, 1 - ((x[1:] + x[:-1]) / 2) ** 2))
    )
    for heat in flux:
        rise[0] += 0.5 * dx / width[0] * heat * math.sqrt(2 * HALF_WIDTH) / uptake
        rise = solve_banded((1, 1), bands, rise)
        peak = max(peak, rise[0])
    return peak


def test_two_surfaces_share_the_heat():
    exact = march(80.0, 0.3, 0.9)
    assert flash_temperature(80.0, HALF_WIDTH, 0.3, 0.9, STEEL, STEEL) == pytest.approx(
        exact, rel=2e-3, abs=0.0
    )


@given(
    power=positive,
    width=positive,
    speeds=st.tuples(positive, positive),
    materials=st.tuples(positive, positive),
)
def test_symmetry_and_scaling(power, width, speeds, materials):
    rise = flash_temperature(power, width, *speeds, *materials)
    assert flash_temperature(power, width, *speeds[::-1], *materials[::-1]) == pytest.approx(
        rise, rel=1e-14, abs=0.0
    )
    assert flash_temperature(power, width, -speeds[0], -speeds[1], *materials) == rise
    # Twice the width at the same intensity and Péclet number.
    assert flash_temperature(
        2 * power, 2 * width, speeds[0] / 2, speeds[1] / 2, *materials
    ) == pytest.approx(2 * rise, rel=1e-14, abs=0.0)
    # A second surface takes heat away, never adds any.
    assert rise <= flash_temperature(power, width, speeds[0], 0.0, *materials)


def test_limits():
    assert flash_temperature(0.0, HALF_WIDTH, 0.0, 0.0, STEEL, STEEL) == 0.0
    assert flash_temperature(1.0, HALF_WIDTH, 0.0, 0.0, STEEL, STEEL) == math.inf
    assert flash_temperature(1.0, HALF_WIDTH, 1e-300, 0.0, STEEL, STEEL) > 1e100


def test_a_transient_against_quadrature_in_the_moving_frame():
    """Power that rises linearly from nothing: Duhamel's integral by SciPy at the middle of the band."""
    steel, half, speed, end = 12888.2, 0.5e-3, 0.4, 1e-3
    time = np.linspace(0.0, end, 200)
    ones = np.ones_like(time)

    def rise(position):
        start = max(0.0, end - (position + half) / speed)

        def flux(then):
            inside = 1.0 - ((position - speed * (end - then)) / half) ** 2
            return 100.0 * then / end * 2.0 / (np.pi * half) * np.sqrt(max(0.0, inside))

        return (
            0.5
            * quad(flux, start, end, weight="alg", wvar=(0.0, -0.5))[0]
            / (np.sqrt(np.pi) * steel)
        )

    best = max(rise(position) for position in np.linspace(-0.5, 0.99, 60) * half)
    largest = transient_flash(
        time, 100.0 * time / end, half * ones, speed * ones, speed * ones, steel, steel
    )
    assert largest == pytest.approx(best, rel=0.01)


@jit
def highest_of_all(time, power, width, speeds, steel):
    """Largest rise of all times and positions."""
    hottest = 0.0
    widest = width.max()
    for n in range(1, time.size):
        uptake = steel * (math.sqrt(speeds[0, n]) + math.sqrt(speeds[1, n]))
        for relative in flash._PLACES:
            position = relative * width[n]
            came = flash._came_in(time, power, width, n, position, widest, speeds[1, n])
            hottest = max(hottest, 4.0 / math.pi**1.5 * came / uptake)
    return hottest


def test_the_highest_rise_is_among_those_that_are_computed():
    rng = np.random.default_rng(11)
    for _ in range(500):
        count = int(rng.integers(3, 30))
        time = np.cumsum(rng.uniform(1e-5, 5e-3, count))
        power = rng.uniform(0.0, 1.0, count) ** rng.uniform(0.2, 5.0)
        width = 1e-3 * np.sort(rng.uniform(0.01, 1.0, count))
        speeds = rng.uniform(0.1, 1.0, (2, count))
        rise = transient_flash(time, power, width, *speeds, STEEL, STEEL)
        assert rise == pytest.approx(highest_of_all(time, power, width, speeds, STEEL), rel=1e-12)
