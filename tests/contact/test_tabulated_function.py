"""What laws given as functions of arrays share: each is tabulated once for an interface, and its splines are looked at."""

import numpy as np
import pytest

from macroslip import InputError
from macroslip.contact.tabulated_function import Coordinate, Function, Kind, prepared_once, splines
from macroslip.roller.model import interfaces

KIND = Kind(
    "test law", "a sum", "sum", "J", (Coordinate("a part", "part", "kg", 1.0, 1e2), Coordinate("a rest", "rest", "s", 1.0, 1e3)), 0.1
)  # fmt: skip


@pytest.fixture(scope="module")
def inner(bearing, lubricant):
    return interfaces(bearing, lubricant)[0]


def test_it_is_tabulated_once_for_each_interface(bearing, lubricant):
    asked = []
    prepare = prepared_once(lambda interface: None, asked.append)
    for _ in range(3):
        for interface in interfaces(bearing, lubricant):
            prepare(interface)
    assert [interface.name for interface in asked] == ["inner", "outer", "cage"]
    assert prepare.__module__ == __name__


def test_splines_are_compared_with_the_function_where_it_is_asked(inner):
    law = Function(KIND, "mine", lambda interface, part, rest: part + rest, inner)
    coefficients = splines(law.at_nodes()[1])
    states = [np.array([1.0, 7.7, 99.0]), np.array([999.0, 1.0, 31.0])]
    law.check(coefficients, states, sum(states))
    wrong = sum(states) * np.array([1.0, 1.02, 1.0])
    with pytest.raises(InputError, match=r"test law mine, inner: .* by 2 % at 7.7 kg and 1 s\."):
        law.check(coefficients, states, wrong)
