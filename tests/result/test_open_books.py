"""Books of a whole bearing that do not close are told of."""

import numpy as np
import pytest

from macroslip.result.cage_variables import open_books
from macroslip.whole.books import FLOWS, STOCKS, Books


def books(**flows):
    """Books with these flows at the end, and nothing held."""
    found = Books(None, np.array([0.0, 1.0, 2.0]))
    found.flows[:], found.stocks[:] = 0.0, 0.0
    for name, value in flows.items():
        found.flows[1:, FLOWS.index(name)] = value
    return found


@pytest.mark.parametrize(
    ("flows", "words"),
    [
        (
            {"shaft_work": 100.4, "raceway_loss": 60.0, "friction_loss": 30.0, "pocket_work": 10.0},
            "",
        ),
        (
            {"shaft_work": 99.6, "raceway_loss": 60.0, "friction_loss": 30.0, "pocket_work": 10.0},
            "",
        ),
        (
            {"shaft_work": 100.7, "raceway_loss": 60.0, "friction_loss": 40.0},
            "energy to 0.7 % of what is dissipated",
        ),
        ({"shaft_work": 93.0, "raceway_loss": 100.0}, "energy to 7 % of what is dissipated"),
        ({"outer_impulse": 50.0, "inner_impulse": -50.2}, ""),
        ({"outer_impulse": 1e-12, "inner_impulse": -3e-12}, ""),  # rounding at standstill
        ({"outer_impulse": 50.0, "inner_impulse": -51.0}, "angular momentum to 2 % of what passes"),
    ],
)
def test_a_rest_above_half_a_percent_is_told(flows, words):
    found = open_books(books(**flows))
    assert words in found and bool(words) == bool(found)
    assert not found or "smaller integrator.tolerance" in found


def test_what_the_bearing_holds_is_not_missing():
    found = books(shaft_work=10.0, raceway_loss=4.0)
    found.stocks[1:, STOCKS.index("kinetic_energy")] = 6.0
    assert open_books(found) == ""


def test_friction_that_drives_is_told():
    found = books(shaft_work=100.0, raceway_loss=100.0)
    found.driven = 0.05
    assert open_books(found) == ""
    found.driven = 0.4
    assert open_books(found).startswith(
        "friction gave back 0.4 % of what is dissipated, which it cannot; results"
    )


def test_books_that_ended_early_say_nothing():
    assert open_books(Books(None, np.array([0.0, 1.0]))) == ""  # the status of its rollers does
