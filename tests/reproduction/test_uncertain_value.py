"""Places in the range of an uncertain value, and its units."""

import pytest

from macroslip.reproduction.uncertain_value import UNITS, in_file_units
from macroslip.reproduction.uncertain_values import VALUES


def test_places_are_the_inverse_of_values():
    for one in VALUES:
        for place in (0.1, 0.45, 0.9):
            value = one.at(place)
            number = one.choices.index(value) if one.choices else value
            width = 1.0 / len(one.choices) if one.choices else 1.0 / (one.high - one.low + 1.0) if one.whole else 1e-12
            assert abs(float(one.place(number)) - place) <= 0.5 * width + 1e-12, one.name


def test_ends_of_a_range_are_its_first_and_last_place():
    counts = [one for one in VALUES if one.whole]
    continuous = [one for one in VALUES if not one.choices and not one.whole]
    assert counts and len(continuous) >= 20
    for one in continuous:
        assert [one.at(0.0), one.at(1.0)] == pytest.approx([one.low, one.high], rel=1e-12), one.name
    for one in counts:
        assert (one.at(0.0), one.at(1.0 - 1e-9)) == (one.low, one.high)


def test_every_unit_of_a_range_has_one_of_a_study_file():
    assert {one.unit for one in VALUES if not one.choices} <= UNITS.keys()
    assert in_file_units(20.0, "°C") == 293.15 and in_file_units(180.0, "°") == pytest.approx(
        3.141592653589793, rel=1e-15
    )
