"""Limiting shear and Eyring's law against their published, explicit forms in high precision."""

import math

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip.traction.rheology import EYRING, LIMITING_SHEAR, NEWTONIAN, RHEOLOGIES, limited_stress

bounded = pytest.mark.parametrize("rheology", [LIMITING_SHEAR, EYRING])
decades = st.floats(-12.0, 12.0).map(lambda x: 10.0**x)


def shear_rate_times_viscosity(rheology, stress, characteristic):
    """The laws as printed: equivalent Newtonian stress τ* of a stress τ."""
    if rheology == LIMITING_SHEAR:
        return -characteristic * mpmath.log1p(-mpmath.mpf(stress) / characteristic)
    return characteristic * mpmath.sinh(mpmath.mpf(stress) / characteristic)


@bounded
@pytest.mark.parametrize("ratio", [1e-12, 1e-6, 1e-2, 0.3, 1.0, 5.0, 20.0])
def test_is_the_inverse_of_the_published_law(rheology, ratio):
    characteristic = 3.3e6
    stress, _ = limited_stress(rheology, ratio * characteristic, characteristic)
    with mpmath.workdps(40):
        back = shear_rate_times_viscosity(rheology, stress, characteristic)
    # Close to the limit a rounded stress says little of the rate behind it.
    rounding = 4e-16 * math.exp(ratio) / ratio if rheology == LIMITING_SHEAR else 4e-16 * (1.0 + ratio)
    assert float(back) == pytest.approx(ratio * characteristic, rel=4e-16 + rounding, abs=0.0)


@bounded
@pytest.mark.parametrize("ratio", [1e-12, 1e-6, 1e-2, 0.3, 1.0, 5.0, 20.0, 600.0])
def test_elasticity_is_the_logarithmic_derivative(rheology, ratio):
    def log_stress(log_viscous):
        if rheology == LIMITING_SHEAR:
            return mpmath.log(-mpmath.expm1(-mpmath.exp(log_viscous)))
        return mpmath.log(mpmath.asinh(mpmath.exp(log_viscous)))

    with mpmath.workdps(60):
        exact = float(mpmath.diff(log_stress, mpmath.log(ratio)))
    assert limited_stress(rheology, 2e7 * ratio, 2e7)[1] == pytest.approx(exact, rel=1e-12, abs=1e-14)


@given(rheology=st.sampled_from(sorted(RHEOLOGIES.values())), ratio=decades, characteristic=decades)
def test_bounds(rheology, ratio, characteristic):
    viscous = ratio * characteristic
    stress, elasticity = limited_stress(rheology, viscous, characteristic)
    assert 0.0 < stress <= viscous * (1.0 + 1e-15)
    assert 0.0 <= elasticity <= 1.0 + 1e-15
    if rheology == LIMITING_SHEAR:
        assert stress <= characteristic
    more, less_elastic = limited_stress(rheology, 1.01 * viscous, characteristic)
    assert more >= stress * (1.0 - 1e-15)
    assert less_elastic <= elasticity + 1e-12


@bounded
def test_slow_shear_is_newtonian_and_fast_shear_limited(rheology):
    assert limited_stress(rheology, 1e-3, 1e7) == pytest.approx((1e-3, 1.0), rel=1e-9)
    stress, elasticity = limited_stress(rheology, 1e12, 1e3)
    fast = 1e3 if rheology == LIMITING_SHEAR else 1e3 * math.log(2e9)
    assert stress == pytest.approx(fast, rel=1e-12)
    assert elasticity == pytest.approx(0.0 if rheology == LIMITING_SHEAR else 1.0 / math.log(2e9), abs=1e-12)


def test_newtonian_film_is_not_limited():
    assert limited_stress(NEWTONIAN, 1e12, 1.0) == (1e12, 1.0)
    assert limited_stress(LIMITING_SHEAR, 0.0, 1e6) == (0.0, 1.0)
