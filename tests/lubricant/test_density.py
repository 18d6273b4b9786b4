"""Density under pressure."""

import pytest

from macroslip.lubricant.viscosity import dowson_higginson


def test_density_under_pressure():
    assert dowson_higginson(0.0) == 1.0
    assert dowson_higginson(1e30) == pytest.approx(1.0 + 0.6 / 1.7, rel=1e-15)
    assert (dowson_higginson(1e3) - 1.0) / 1e3 == pytest.approx(0.6e-9, rel=1e-5)
