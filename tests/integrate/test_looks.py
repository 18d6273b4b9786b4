"""When contacts are looked at: after a change of power, a new highest value, or a way."""

from __future__ import annotations

import math

import pytest

from macroslip.compiled import jit
from macroslip.integrate.looks import Highest, Looks, _is_due

BEFORE = Highest(10.0, 8.0, 3.0, 2.0, 1.5, 0.01)


@jit
def is_due(now, looks):
    return _is_due(now, looks)


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({}, False),
        ({"inner": 10.2}, False),
        ({"inner": 8.9}, True),
        ({"outer": 9.0}, True),
        ({"cage": 3.05}, False),
        ({"cage": 3.1}, True),
        ({"cage": 0.0}, False),
        ({"inner_density": 2.1}, True),
        ({"outer_density": 1.0}, False),
        ({"outer_density": 1.6}, True),
        ({"ratio": 0.011}, True),
    ],
)
def test_what_makes_a_look_due(changes, expected):
    looks = Looks(5, 3, 12.0, 1.0, 10.0, 8.0, BEFORE)
    assert is_due(BEFORE._replace(**changes), looks) is expected


def test_the_first_state_of_an_orbit_has_no_highest():
    looks = Looks(0, -1, math.nan, 0.0, 0.0, 0.0, Highest(0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert is_due(BEFORE, looks)
