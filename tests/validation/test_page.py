"""The page quotes what is computed."""

from pathlib import Path

import pytest

from validation import regime, thrust_friction, wear_lines

DOCS = Path(__file__).parents[2] / "docs"
PAGES = [DOCS / "measurements.md", DOCS / "notes" / "measurements.md"]
PAGE = " ".join(" ".join(page.read_text(encoding="utf-8") for page in PAGES).split())


def written(bounds, digits):
    return f"{bounds.low:.{digits}f} to {bounds.high:.{digits}f}"


@pytest.mark.slow
@pytest.mark.parametrize("name", thrust_friction.oils().index)
def test_friction_of_thrust_bearings(name):
    measured, computed, ratio = thrust_friction.torques(name, "eyring", thrust_friction.FAST)
    factor, mean = thrust_friction.needed_coefficient(name)
    inverse = type(factor)(1.0 / factor.high, 1.0 / factor.low)
    for bounds, digits in ((measured, 3), (computed, 3), (ratio, 2), (mean, 1), (inverse, 2)):
        assert written(bounds, digits) in PAGE


def test_coefficients_of_contacts():
    assert written(thrust_friction.boundary_friction(), 3) in PAGE
    assert written(thrust_friction.spin_friction("MINR"), 3) in PAGE


@pytest.mark.slow
def test_regime():
    for case in ("12B", "24B"):
        assert f"{100 * regime.mixed_share(case, 35.0, 0.7):.0f} %" in PAGE
    assert f"| {regime.change():.1f} |" in PAGE
    assert f"| {regime.half_load():.2f} |" in PAGE


def test_lines_of_pure_rolling():
    assert f"±{wear_lines.lines(0.0)[1]:.3f} of half the contact" in PAGE
