"""Density over temperature."""

import pytest

from macroslip.lubricant.temperature import density_at


def test_it_falls_by_065_a_kelvin():
    assert density_at(860.0, 288.15, 288.15) == 860.0
    assert density_at(860.0, 288.15, 298.15) == pytest.approx(853.5, rel=1e-14)
    there = density_at(860.0, 288.15, 350.0)
    assert density_at(there, 350.0, 288.15) == pytest.approx(860.0, rel=1e-14)
