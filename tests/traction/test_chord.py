"""Mean stress along a chord of the contact by quadrature, against adaptive integration of the local law."""

import math

import mpmath
import numpy as np
import pytest
from scipy.integrate import quad

from macroslip.lubricant import Lubricant
from macroslip.mechanisms import Laws
from macroslip.roller.contacts import fluid
from macroslip.traction import shear_stress
from macroslip.traction.chord import Fluid, characteristic_slip, characteristic_stress, chord_stress, log_viscosity
from macroslip.traction.film_shear import heated_shear
from macroslip.traction.rheology import EYRING, LIMITING_SHEAR, NEWTONIAN

OIL = Lubricant.read("vg460-pao")
FULL = Laws.physical()
LIMITED = FULL.but(rheology="limiting-shear")
CHOICES = {
    "physical": FULL,
    "limiting shear": LIMITED,
    "cool": LIMITED.but(heating=False),
    "newtonian": FULL.but(rheology="newtonian"),
    "barus": FULL.but(rheology="newtonian", viscosity="barus"),
    "barus, limiting shear": LIMITED.but(viscosity="barus"),
}
choices = pytest.mark.parametrize("laws", CHOICES.values(), ids=CHOICES)


def local_stress(oil, pressure, film, slip):
    viscosity = math.exp(log_viscosity(oil, pressure)[0])
    limit = characteristic_stress(oil, pressure)
    return heated_shear(oil.rheology, viscosity * slip / film, limit, oil.heating * film * slip)[0]


def adaptive(oil, pressure, film, slip):
    """∫ τ(p cos θ) cos θ dθ over a quarter turn, the pressure's decades apart."""
    places = [
        math.acos(min(1.0, p / pressure)) for p in (1e-4 * pressure, 1e-2 * pressure, 0.1 * pressure, 0.5 * pressure)
    ]
    found, error = quad(
        lambda t: local_stress(oil, pressure * math.cos(t), film, slip) * math.cos(t),
        0.0,
        0.5 * math.pi,
        points=places,
        limit=500,
        epsabs=0.0,
        epsrel=1e-9,
    )
    assert error < 1e-7 * found
    return found


@choices
def test_against_adaptive_integration(laws):
    oil = fluid(laws, OIL)
    rng = np.random.default_rng(7)
    for highest, promised in ((1e9, 6e-4), (2e9, 1e-2 if laws.viscosity == "barus" else 1e-4)):
        for _ in range(25):
            pressure = 10.0 ** rng.uniform(4.0, math.log10(highest))
            film, slip = 10.0 ** rng.uniform(-7.0, -5.0), 10.0 ** rng.uniform(-10.0, -0.3)
            assert chord_stress(oil, pressure, film, slip) == pytest.approx(
                adaptive(oil, pressure, film, slip), rel=promised
            ), (pressure, film, slip)


def test_fully_limited_chord_by_hand():
    """Where shear is at its limit all along, q = γ p1 ∫cos²θ dθ = γ p1 π/4."""
    oil = fluid(CHOICES["cool"], OIL)
    assert chord_stress(oil, 2e9, 3e-7, 2.0) == pytest.approx(0.042 * 2e9 * math.pi / 4, rel=2e-3)
    assert chord_stress(oil, 2e9, 3e-7, 2.0) < 0.042 * 2e9 * math.pi / 4


def test_light_chord_is_isoviscous():
    """Far below the pressures that thicken oil, q = η0 Δu/h ∫cos θ dθ = η0 Δu/h."""
    for laws in CHOICES.values():
        oil = fluid(laws, OIL)
        assert chord_stress(oil, 1e3, 1e-3, 1e-7) == pytest.approx(
            0.54 * 1e-7 / 1e-3, rel=4e-3 if oil.rheology == 1 else 1e-4
        )


@pytest.mark.parametrize("film", [2e-7, 1e-6])
@pytest.mark.parametrize("slip", [1e-12, 1e-6, 1e-3, 0.3])
def test_newtonian_barus_chord_is_crooks(film, slip):
    oil = fluid(CHOICES["barus"], OIL)
    with np.errstate(all="raise"):
        exact, _ = quad(
            lambda t: math.cos(t) * shear_stress(0.54 * math.exp(21.0 * 0.9 * math.cos(t)), 0.056, 0.125, film, slip),
            0.0,
            0.5 * math.pi,
            epsabs=0.0,
            epsrel=1e-11,
            limit=300,
        )
    assert chord_stress(oil, 0.9e9, film, slip) == pytest.approx(exact, rel=2e-5)


def test_cool_newtonian_chord_in_closed_form():
    """Without heating, ∫exp(P cos θ) cos θ dθ = π/2 (I1(P) + L_{-1}(P)), with the modified Struve function L."""
    oil = Fluid(NEWTONIAN, 0.54, 2.1, 1.0, 1e8, 1.0, 0.0)
    for exponent in (0.01, 1.0, 8.0, 21.0):
        exact = float(mpmath.pi / 2 * (mpmath.besseli(1, exponent) + mpmath.struvel(-1, exponent)))
        found = chord_stress(oil, exponent / 21.0 * 1e9, 1e-6, 1e-3) / (0.54 * 1e-3 / 1e-6)
        assert found == pytest.approx(exact, rel=1e-9 if exponent < 10 else 1e-4)


@choices
@pytest.mark.parametrize("pressure", [1e3, 1e7, 5e8, 2e9])
def test_viscosity_and_its_steepness(laws, pressure):
    oil = fluid(laws, OIL)
    value, slope = log_viscosity(oil, pressure)
    if laws.viscosity == "barus":
        exact = math.log(0.54) + 21e-9 * pressure
    else:
        index = 21e-9 * 1.96e8 / (math.log(0.54) + 9.67)
        exact = math.log(0.54) + (math.log(0.54) + 9.67) * ((1 + pressure / 1.96e8) ** index - 1)
    assert value == pytest.approx(exact, rel=1e-12)
    step = 1e-5
    ahead, behind = (log_viscosity(oil, pressure * math.exp(s))[0] for s in (step, -step))
    assert slope == pytest.approx((ahead - behind) / (2 * step), rel=1e-5, abs=1e-10)


def test_characteristic_slip_is_where_the_law_turns():
    eta = math.log(1e3)
    limited = Fluid(LIMITING_SHEAR, 0.54, 2.1, 1.0, 1e8, 0.04, 0.05)
    assert characteristic_slip(limited, eta, 1e9, 1e-6) * 1e3 / 1e-6 == pytest.approx(0.04 * 1e9, rel=1e-12)
    eyring = limited._replace(rheology=EYRING, characteristic=3e6)
    assert characteristic_slip(eyring, eta, 1e9, 1e-6) * 1e3 / 1e-6 == pytest.approx(3e6, rel=1e-12)
    newtonian = limited._replace(rheology=NEWTONIAN, characteristic=1.0)
    # Crook's heating number, β η v²/(8k), is one there.
    assert 0.05 * 1e3 * characteristic_slip(newtonian, eta, 1e9, 1e-6) ** 2 == pytest.approx(1.0, rel=1e-12)
