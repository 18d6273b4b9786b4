"""Martin's constants against quadrature of Reynolds' equation."""

import math

import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from macroslip.rolling import martin


def integral(function, end):
    return quad(function, -math.inf, end, epsabs=1e-13, epsrel=1e-13)[0]


def test_constants_solve_reynolds_equation():
    def slope(t, end):
        return (t * t - end * end) / (1.0 + t * t) ** 3

    end = brentq(lambda e: integral(lambda t: slope(t, e), e), 0.2, 0.9, xtol=1e-14)
    assert end == pytest.approx(martin.EXIT, abs=1e-10)
    # w h0/(η u R) = 24 ∫ p̂ dt with p̂' = slope, by parts; F_R √h0/(η u √R) = 6 √2 ∫ (1 + t²) slope dt.
    assert -24.0 * integral(lambda t: t * slope(t, end), end) == pytest.approx(martin.LOAD, rel=1e-9)
    rolling = 6.0 * math.sqrt(2.0) * integral(lambda t: (1.0 + t * t) * slope(t, end), end)
    assert rolling == pytest.approx(martin.ROLLING_AT_GAP, rel=1e-9)
    assert integral(lambda t: 1.0 / (1.0 + t * t), end) == pytest.approx(martin.SHEAR, rel=1e-12)
    # F_R of the load: h0 = 4.895 η u R/w put into the force at the gap.
    viscosity, speed, radius, per_length = 0.3, 0.7, 0.02, 800.0
    film = martin.LOAD * viscosity * speed * radius / per_length
    assert martin.ROLLING * math.sqrt(viscosity * speed * per_length) == pytest.approx(
        martin.ROLLING_AT_GAP * viscosity * speed * math.sqrt(radius / film), rel=1e-12
    )
    assert pytest.approx((4.895, 2.0796, 2.0144), abs=5e-5) == (martin.LOAD, martin.ROLLING, martin.SHEAR)


def test_free_line_contact_slips_by_1_6_of_the_mean_speed():
    # No moment on the roller: −F_R + η Δu ∫dx/h = 0.
    slip = martin.ROLLING_AT_GAP / (martin.SHEAR * math.sqrt(2.0))
    assert slip == pytest.approx(1.615, abs=5e-4)


@pytest.mark.parametrize("inlet", [1.2, 2.0, 10.0, 300.0])
def test_starved_line_by_quadrature(inlet):
    def slope(t, end):
        return (t * t - end * end) / (1.0 + t * t) ** 3

    def exit_of(start):
        return brentq(lambda e: quad(slope, start, e, args=(e,), epsabs=1e-14)[0], 1e-6, 0.9)

    start = -brentq(lambda s: 1.0 + s * s - inlet * (1.0 + exit_of(-s) ** 2), 0.1, 1e3)
    end = exit_of(start)
    load = -24.0 * quad(lambda t: t * slope(t, end), start, end, epsabs=1e-13)[0] / martin.LOAD
    rolling = 6.0 * math.sqrt(2.0) * quad(lambda t: (1.0 + t * t) * slope(t, end), start, end, epsabs=1e-13)[0]
    shear = quad(lambda t: 1.0 / (1.0 + t * t), start, end)[0] / martin.SHEAR
    expected = load, rolling / martin.ROLLING_AT_GAP, shear
    assert martin.starved_martin(inlet) == pytest.approx(expected, rel=1e-6)


def test_starvation_ends_in_the_flooded_contact():
    assert martin.starved_martin(math.inf) == (1.0, 1.0, 1.0)
    assert martin.starved_martin(1e7) == pytest.approx((1.0, 1.0, 1.0), abs=1e-3)
