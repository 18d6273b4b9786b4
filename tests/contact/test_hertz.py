"""Hertz contact against Johnson's K and E, a printed table and scale laws."""

import math

import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip.bearing import Bearing, geometry
from macroslip.contact.hertz import effective_modulus, elliptical_contact, series_stiffness
from macroslip.contact.interface import interfaces, truncation_load
from macroslip.errors import InputError
from macroslip.lubricant import Lubricant

MODULUS = 230.77e9
curvatures = st.floats(min_value=1e-2, max_value=1e4)


def johnson(rolling, lateral, modulus):
    """(a across, b along, p0, δ) at 1 N from Johnson (4.24)-(4.26) with the complete integrals K(e) and E(e)."""
    with mpmath.workdps(40):
        low, high = sorted((mpmath.mpf(rolling), mpmath.mpf(lateral)))
        if high - low < 1e-12 * high:
            ratio = mpmath.mpf(1)
            first = mpmath.pi / 2
            long_axis = (3 / (2 * mpmath.mpf(modulus) * high)) ** (mpmath.mpf(1) / 3)
        else:

            def curvature_ratio(ratio):
                m = 1 - ratio**2
                k, e = mpmath.ellipk(m), mpmath.ellipe(m)
                return (e / ratio**2 - k) / (k - e) - high / low

            # Bisection on log(b/a): the root is unique.
            lower, upper = mpmath.log(low / high) - 1, mpmath.log(1 - mpmath.mpf(10) ** -15)
            for _ in range(90):
                middle = (lower + upper) / 2
                lower, upper = (
                    (middle, upper) if curvature_ratio(mpmath.exp(middle)) > 0 else (lower, middle)
                )
            ratio = mpmath.exp(lower)
            m = 1 - ratio**2
            first, second = mpmath.ellipk(m), mpmath.ellipe(m)
            # Curvature A = ρ/2 of the long direction: A = p0 b (K − E)/(E* e² a²) with p0 = 3/(2π a b), E* = E'/2.
            long_axis = (6 * (first - second) / (mpmath.pi * modulus * m * low)) ** (
                mpmath.mpf(1) / 3
            )
        short_axis = ratio * long_axis
        pressure = 3 / (2 * mpmath.pi * long_axis * short_axis)
        approach = 3 * first / (mpmath.pi * modulus * long_axis)
        across, along = (long_axis, short_axis) if lateral <= rolling else (short_axis, long_axis)
        return [float(x) for x in (across, along, pressure, approach)]


@pytest.mark.parametrize("ratio", [1.0, 1 - 1e-9, 0.9, 0.5, 0.1, 1e-2, 1.5e-3, 1e-4, 1e-6, 1e-9])
@pytest.mark.parametrize("lateral_is_flat", [True, False])
def test_agrees_with_johnsons_elliptic_integrals(ratio, lateral_is_flat):
    rolling, lateral = (31.0, 31.0 * ratio) if lateral_is_flat else (31.0 * ratio, 31.0)
    # Near the circle the reference itself cancels: K − E and E/ratio² − K lose digits that its 40 digits cover.
    expected = johnson(rolling, lateral, MODULUS)
    assert elliptical_contact(rolling, lateral, MODULUS) == pytest.approx(
        expected, rel=2e-13, abs=0.0
    )


# Harris, Rolling Bearing Analysis, dimensionless contact parameters: F(ρ), a*, b*, δ*.
HARRIS = [
    (0.0, 1.0, 1.0, 1.0), (0.1075, 1.0760, 0.9318, 0.9974), (0.3204, 1.2623, 0.8114, 0.9761),
    (0.5916, 1.6440, 0.6687, 0.9077), (0.6716, 1.8258, 0.6245, 0.8733), (0.83495, 2.494, 0.5186, 0.7602),
    (0.90999, 3.233, 0.4499, 0.6636), (0.95738, 4.395, 0.3830, 0.5551), (0.983797, 6.448, 0.3150, 0.4352),
    (0.995112, 10.222, 0.2497, 0.3176), (0.9981847, 14.839, 0.2072, 0.2427), (0.9998527, 37.38, 0.13050, 0.11995),
]  # fmt: skip


@pytest.mark.parametrize(("difference", "long_axis", "short_axis", "approach"), HARRIS)
def test_agrees_with_the_printed_table(difference, long_axis, short_axis, approach):
    total, load = 80.0, 1000.0
    contact = elliptical_contact(
        total * (1 + difference) / 2, total * (1 - difference) / 2, MODULUS
    )
    unit = (3.0 * load / (2.0 * total) * 2.0 / MODULUS) ** (1.0 / 3.0)
    assert contact.semi_axis_across * load ** (1 / 3) / unit == pytest.approx(
        long_axis, rel=2e-4, abs=0.0
    )
    assert contact.semi_axis_along * load ** (1 / 3) / unit == pytest.approx(
        short_axis, rel=2e-4, abs=0.0
    )
    assert contact.approach * load ** (2 / 3) / (unit**2 * total / 2) == pytest.approx(
        approach, rel=2e-4, abs=0.0
    )


@given(curvatures, curvatures, st.floats(0.01, 100.0), st.floats(0.01, 100.0))
@settings(deadline=None, max_examples=50)
def test_scale_laws(rolling, lateral, size, hardness):
    # Lengths times s and moduli times c: a ~ (s/c)^(1/3), δ ~ s^(-1/3) c^(-2/3).
    here = elliptical_contact(rolling, lateral, MODULUS)
    there = elliptical_contact(rolling / size, lateral / size, MODULUS * hardness)
    stretch = (size / hardness) ** (1.0 / 3.0)
    expected = (
        here.semi_axis_across * stretch, here.semi_axis_along * stretch, here.pressure / stretch**2,
        here.approach * size ** (-1 / 3) * hardness ** (-2 / 3),
    )  # fmt: skip
    assert there == pytest.approx(expected, rel=1e-11, abs=0.0)


@given(curvatures, curvatures)
@settings(deadline=None, max_examples=50)
def test_swapped_directions_swap_the_semi_axes(rolling, lateral):
    here, there = (
        elliptical_contact(*pair, MODULUS) for pair in ((rolling, lateral), (lateral, rolling))
    )
    assert (here.semi_axis_across, here.semi_axis_along) == (
        there.semi_axis_along,
        there.semi_axis_across,
    )
    assert here[2:] == there[2:]
    # The flatter direction has the longer semi-axis.
    assert (here.semi_axis_across >= here.semi_axis_along) == (lateral <= rolling)


@pytest.mark.parametrize("bad", [0.0, -0.05, math.nan, math.inf])
@pytest.mark.parametrize("direction", ["rolling", "lateral"])
def test_conforming_surfaces_are_refused(bad, direction):
    pair = {"rolling_curvature": 31.0, "lateral_curvature": 31.0, f"{direction}_curvature": bad}
    with pytest.raises(
        InputError, match=f"{direction} direction is .* Allowed: positive .* osculation"
    ):
        elliptical_contact(**pair, modulus=MODULUS)


def test_effective_modulus_mixes_compliances():
    assert effective_modulus(210e9, 0.3, 210e9, 0.3) == pytest.approx(
        210e9 / 0.91, rel=1e-15, abs=0.0
    )
    # Against a rigid body, E' is twice the plane-strain modulus.
    assert effective_modulus(210e9, 0.3, 1e30, 0.0) == pytest.approx(
        2 * 210e9 / 0.91, rel=1e-15, abs=0.0
    )
    assert effective_modulus(110e9, 0.26, 210e9, 0.3) == effective_modulus(210e9, 0.3, 110e9, 0.26)


def test_series_stiffness_adds_the_approaches():
    inner, outer = elliptical_contact(31.5, 0.05, MODULUS), elliptical_contact(26.2, 0.04, MODULUS)
    load = 5e4
    approach = sum((load / contact.stiffness) ** (2 / 3) for contact in (inner, outer))
    assert series_stiffness(inner, outer) * approach**1.5 == pytest.approx(load, rel=1e-14, abs=0.0)


def test_base_bearing_stiffness_and_truncation():
    bearing, lubricant = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
    inner, outer, cage = interfaces(bearing, lubricant)
    # Curvatures by hand from the catalogue.
    r, pitch, alpha, contour = 0.035, 0.3727, math.radians(11.2), 0.98 * 0.4149
    modulus = 210e9 / 0.91
    lateral = 1 / contour - 1 / 0.4149
    by_hand = [
        johnson(1 / r + math.cos(alpha) / (pitch - r * math.cos(alpha)), lateral, modulus),
        johnson(1 / r - math.cos(alpha) / (pitch + r * math.cos(alpha)), lateral, modulus),
        johnson(1 / r - 0.98 / r, lateral, modulus),
    ]
    for contact, expected in zip((inner, outer, cage), by_hand, strict=True):
        assert contact.hertz == pytest.approx(expected, rel=1e-11, abs=0.0)
    stiffness = (by_hand[0][3] + by_hand[1][3]) ** -1.5
    assert series_stiffness(inner.hertz, outer.hertz) == pytest.approx(
        stiffness, rel=1e-11, abs=0.0
    )
    assert stiffness == pytest.approx(9.26e10, rel=5e-4, abs=0.0)
    # The load at which the longer of the two ellipses is as long as the roller.
    limit = min((0.053 / semi_axis) ** 3 for semi_axis, *_ in by_hand[:2])
    assert truncation_load(bearing, lubricant) == pytest.approx(limit, rel=1e-10, abs=0.0)
    assert inner.rolling_radius == pytest.approx(
        1 / geometry.inner_curvatures(bearing).rolling, rel=1e-15, abs=0.0
    )
    assert [contact.name for contact in (inner, outer, cage)] == ["inner", "outer", "cage"]
