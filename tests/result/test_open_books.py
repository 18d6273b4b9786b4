"""Books of a whole bearing that do not close are told of."""

import numpy as np
import pytest

from macroslip.result.cage_variables import open_books
from macroslip.whole.books import FLOWS, STOCKS, Books


def books(**flows):
    """Books with these flows at the end, and nothing held."""
    books = Books(None, np.array([0.0, 1.0, 2.0]))
    books.flows[:], books.stocks[:] = 0.0, 0.0
    for name, value in flows.items():
        books.flows[1:, FLOWS.index(name)] = value
    return books


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
            "the balance of energy has a residual of 0.7 % of what is dissipated",
        ),
        (
            {"shaft_work": 93.0, "raceway_loss": 100.0},
            "the balance of energy has a residual of 7 % of what is dissipated",
        ),
        ({"outer_impulse": 50.0, "inner_impulse": -50.2}, ""),
        ({"outer_impulse": 1e-12, "inner_impulse": -3e-12}, ""),  # rounding at standstill
        (
            {"outer_impulse": 50.0, "inner_impulse": -51.0},
            "the balance of angular momentum has a residual of 2 % of what passes",
        ),
    ],
)
def test_a_rest_above_half_a_percent_is_told(flows, words):
    warning = open_books(books(**flows))
    assert words in warning and bool(words) == bool(warning)
    assert not warning or "smaller integrator.tolerance" in warning


def test_what_the_bearing_holds_is_not_missing():
    books_of_run = books(shaft_work=10.0, raceway_loss=4.0)
    books_of_run.stocks[1:, STOCKS.index("kinetic_energy")] = 6.0
    assert open_books(books_of_run) == ""


def test_friction_that_drives_is_told():
    books_of_run = books(shaft_work=100.0, raceway_loss=100.0)
    books_of_run.driven = 0.05
    assert open_books(books_of_run) == ""
    books_of_run.driven = 0.4
    assert open_books(books_of_run).startswith(
        "friction adds 0.4 % of the dissipated energy, which is impossible; results"
    )


def test_books_that_ended_early_say_nothing():
    assert open_books(Books(None, np.array([0.0, 1.0]))) == ""  # the status of its rollers does
