"""Thirty-two nodes are a fair rival: they give the closed form's numbers wherever contacts are."""

import numpy as np
import pytest

from benchmarks.quadrature import patch_by_quadrature
from macroslip.contact.closed_form import patch_integral


@pytest.mark.parametrize("exponent", [0.05, 1.0, 5.0, 12.0, 25.0])
@pytest.mark.parametrize("heating", [1e-12, 1e-6, 1e-3, 0.1])
def test_quadrature_agrees_with_the_closed_form(exponent, heating):
    computed, expected = patch_by_quadrature(exponent, heating), patch_integral(exponent, heating)
    np.testing.assert_allclose(computed, expected, rtol=1e-7, atol=1e-7 * expected[0])


def test_quadrature_fails_where_heating_is_too_steep_for_it():
    """At P = 60 the pole of the integrand comes within π/60 of the nodes; the closed form does not care."""
    computed, expected = patch_by_quadrature(60.0, 1e-2)[0], patch_integral(60.0, 1e-2)[0]
    assert 1e-9 < abs(computed / expected - 1.0) < 1e-2
