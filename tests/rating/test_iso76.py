"""Static equivalent load and safety."""

import math

import numpy as np
import pytest

from macroslip.rating.iso import static_equivalent_load, static_safety


def test_equivalent_load():
    assert static_equivalent_load(300e3, 0.0, 2.2) == 300e3
    assert static_equivalent_load(0.0, 100e3, 2.2) == static_equivalent_load(0.0, -100e3, 2.2) == pytest.approx(220e3)
    np.testing.assert_allclose(static_equivalent_load([1.0, 2.0], [-3.0, 4.0], 2.0), [7.0, 10.0])


def test_safety():
    assert static_safety(16300e3, 4075e3) == pytest.approx(4.0)
    assert math.isinf(static_safety(16300e3, 0.0))
