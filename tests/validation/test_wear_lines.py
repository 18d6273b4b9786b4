"""Lines of pure rolling of a contact in boundary lubrication."""

import numpy as np
import pytest

from validation import wear_lines


def test_lines_without_tilt_halve_the_load():
    first, second = wear_lines.lines(0.0)
    assert (first, second) == pytest.approx((-wear_lines.EXACT, wear_lines.EXACT), abs=1e-6)
    inside = np.linspace(first, second, 100_001)
    assert np.trapezoid(1.0 - inside**2, inside) == pytest.approx(0.5 * 4.0 / 3.0, rel=1e-6)


@pytest.mark.parametrize("degrees", [0.0, 1.0, 3.0])
def test_wear_is_nil_at_two_places_and_marked_at_both_sides_of_them(degrees):
    error = np.radians(degrees)
    first, second = wear_lines.lines(error)
    assert -1.0 < first < second < 1.0
    between, outside = wear_lines.wear(
        error, np.array([0.5 * (first + second), 0.5 * (first - 1.0)])
    )
    assert min(between, outside) > 100.0 * max(wear_lines.wear(error, np.array([first, second])))


def test_a_cone_far_off_has_one_line():
    assert wear_lines.lines(np.radians(6.0))[1] == pytest.approx(1.0)
