"""Density over temperature and under pressure."""

import pytest

from macroslip.lubricant.density import density_at, dowson_higginson


def test_it_falls_by_065_a_kelvin():
    assert density_at(860.0, 288.15, 288.15) == 860.0
    assert density_at(860.0, 288.15, 298.15) == pytest.approx(853.5, rel=1e-14)
    there = density_at(860.0, 288.15, 350.0)
    assert density_at(there, 350.0, 288.15) == pytest.approx(860.0, rel=1e-14)


def test_density_under_pressure():
    assert dowson_higginson(0.0) == 1.0
    assert dowson_higginson(1e30) == pytest.approx(1.0 + 0.6 / 1.7, rel=1e-15)
    assert (dowson_higginson(1e3) - 1.0) / 1e3 == pytest.approx(0.6e-9, rel=1e-5)
