"""Asperities' friction against dense integration over the contact."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip.contact.shape import ContactShape, slipless
from macroslip.traction.asperity_friction import AsperityFriction, asperity_friction
from macroslip.traction.slip_field import SlipField, slip_at

RADIUS, CONTOUR = 0.035, 0.41
LAW = AsperityFriction(0.1, 1e-4, 9e-4)
SHAPE = ContactShape(True, CONTOUR, RADIUS, 0.053, 31.47, 0.574)


def speeds(largest):
    return st.floats(-largest, largest).map(lambda x: round(x, 9))


fields = st.builds(SlipField, speeds(0.05), speeds(30.0), speeds(0.6), st.just(-1.0 / RADIUS))
loads = st.floats(0.0, 5.5).map(lambda x: 10.0**x)
shares = st.floats(1e-6, 1.0)


def dense(law, load, share, field, shape, count=100001):
    """Force, lag, skew and power by a fine midpoint rule over the stations; Hertz pressure summed along the chords."""
    across = law.semi_axis_across * load ** (1 / 3)
    half = min(across, shape.half_length)
    z = (np.arange(count) + 0.5) / count * 2 * half - half
    slip = field.sliding + field.curvature_rate * z**2 / (2 * shape.contour_radius) - field.spin_rate * z
    per_length = 0.75 * load / across * (1 - (z / across) ** 2)
    part = law.coefficient * share * per_length * np.clip(slip / law.full_slip, -1.0, 1.0) * (2 * half / count)
    drop = z**2 / (2 * shape.contour_radius)
    return part.sum(), (part * drop).sum() / shape.roller_radius, (part * z).sum(), (part * slip).sum()


@given(fields, loads, shares)
@settings(deadline=None, max_examples=40)
def test_against_dense_integration(field, load, share):
    found = asperity_friction(LAW, load, share, field, SHAPE)
    force, lag, skew, power = dense(LAW, load, share, field, SHAPE)
    largest, across = 0.1 * share * load, LAW.semi_axis_across * load ** (1 / 3)
    assert found.force == pytest.approx(force, abs=1e-6 * largest)
    assert found.lag == pytest.approx(lag, abs=1e-6 * largest * across**2 / (2 * CONTOUR * RADIUS))
    assert found.skew == pytest.approx(skew, abs=1e-6 * largest * across)
    assert found.power == pytest.approx(power, rel=1e-5, abs=1e-12 * largest)


@given(fields, loads, shares)
@settings(deadline=None, max_examples=200)
def test_bounds(field, load, share):
    found = asperity_friction(LAW, load, share, field, SHAPE)
    half = min(LAW.semi_axis_across * load ** (1 / 3), SHAPE.half_length)
    largest = 0.1 * share * load * (1 + 1e-12)
    assert abs(found.force) <= largest
    assert abs(found.lag) <= largest * half**2 / (2 * CONTOUR * RADIUS)
    assert abs(found.skew) <= largest * half
    assert found.power >= 0.0
    # ∫τ v dA = Δu F + κ ∫τ h dA − s ∫τ ζ dA.
    parts = field.sliding * found.force, field.curvature_rate * RADIUS * found.lag, -field.spin_rate * found.skew
    assert found.power == pytest.approx(sum(parts), rel=1e-9, abs=1e-12 * sum(map(abs, parts)))


@given(fields, loads)
@settings(deadline=None, max_examples=200)
def test_slopes_are_differences(field, load):
    def at(change):
        moved = field._replace(
            sliding=field.sliding + change, curvature_rate=field.curvature_rate + field.curvature_slope * change
        )
        return asperity_friction(LAW, load, 0.3, moved, SHAPE)

    step, scale = 1e-8, 0.03 * load / 1e-4
    found, ahead, behind = at(0.0), at(step), at(-step)
    for name in ("force", "lag"):
        right = (getattr(ahead, name) - getattr(found, name)) / step
        left = (getattr(found, name) - getattr(behind, name)) / step
        # Where a corner enters or leaves the contact the slope has a root's kink or a jump; it lies between the sides.
        low, high = sorted((left, right))
        slope = getattr(found, f"{name}_slope")
        assert low - 2e-3 * scale - 1e-3 * abs(low) <= slope <= high + 2e-3 * scale + 1e-3 * abs(high)


def test_by_hand():
    # Sliding all over: µ_b times the load asperities carry; the whole load is in the ellipse.
    slides = asperity_friction(LAW, 1e4, 0.25, SlipField(-0.2, 0.0, 0.0, 0.0), SHAPE)
    assert slides.force == pytest.approx(-0.1 * 0.25 * 1e4, rel=1e-12)
    assert slides.power == pytest.approx(500 * 0.1, rel=1e-12)
    assert slides.force_slope == 0.0 and slides.skew == pytest.approx(0.0, abs=1e-9)
    # Half of the full slip, half of the force.
    creeps = asperity_friction(LAW, 1e4, 0.25, SlipField(5e-5, 0.0, 0.0, 0.0), SHAPE)
    assert creeps.force == pytest.approx(125.0, rel=1e-12)
    assert creeps.force_slope == pytest.approx(250 / 1e-4, rel=1e-12)
    # Spin alone turns: both halves pull against each other, ∫|ζ| p dA = 3a/8 · Q.
    turns = asperity_friction(LAW._replace(full_slip=1e-12), 1e4, 1.0, SlipField(0.0, 0.0, 0.4, 0.0), SHAPE)
    across = 9e-4 * 1e4 ** (1 / 3)
    assert turns.skew == pytest.approx(-0.1 * 1e4 * 0.375 * across, rel=1e-6)
    assert turns.power == pytest.approx(0.4 * 0.1 * 1e4 * 0.375 * across, rel=1e-6)
    assert turns.force == pytest.approx(0.0, abs=1e-6)


def test_no_share_no_friction_and_cut_ends():
    field = SlipField(0.1, -12.0, 0.2, -1 / RADIUS)
    assert asperity_friction(LAW, 1e4, 0.0, field, SHAPE) == (0.0,) * 6
    cut = asperity_friction(LAW, 1e6, 1.0, SlipField(0.1, 0.0, 0.0, 0.0), slipless(0.053))
    x = 0.053 / (9e-4 * 100.0)
    assert cut.force == pytest.approx(0.1 * 1e6 * 0.5 * (3 * x - x**3), rel=1e-12)


def test_slip_function_and_friction_share_one_convention():
    field = SlipField(0.004, -10.0, 0.2, -30.0)
    assert slip_at(field, CONTOUR, 0.02) == pytest.approx(0.004 - 10.0 * 0.02**2 / (2 * CONTOUR) - 0.004, rel=1e-12)
    assert math.isclose(slip_at(field, CONTOUR, 0.0), 0.004)
