"""Torque of a tapered bearing: two formulas beside what was measured, and what the page quotes."""

from pathlib import Path

import pytest

from validation.tapered_torque import compare, torque

PAGE = (Path(__file__).parents[2] / "docs/measurements.md").read_text(encoding="utf-8")


def test_the_page_quotes_what_is_computed():
    for row in compare():
        assert f"{row.computed} | {row.ratio}" in PAGE


@pytest.mark.parametrize(
    ("law", "ratios"),
    [("Zhou and Hoeprich", (1522, 3231, 3892)), ("Goksem and Hargreaves", (2164, 4664, 5682))],
)
def test_torques_are_those_of_an_independent_program(law, ratios):
    speeds = [rpm * 3.141592653589793 / 30.0 for rpm in (500.0, 2000.0, 4000.0)]
    assert [1e3 * torque(speed, law) for speed in speeds] == pytest.approx(ratios, rel=0.05)
