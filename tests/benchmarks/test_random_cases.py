"""Random legal cases at the default tolerance beside a tight one."""

import numpy as np
import pytest

from benchmarks.random_cases import HISTORIES, _largest, compare, random_case, table


def test_a_number_gives_the_same_case_whenever_it_is_asked_for():
    (kind, case), (again, same) = random_case(5), random_case(5)
    assert kind == again and case.as_dict() == same.as_dict()
    assert {random_case(number)[0] for number in range(60)} == set(HISTORIES)


def test_an_error_is_relative_to_the_value_it_belongs_to():
    error, of = _largest(np.array([0.1, 0.1]), np.array([10.0, 1.0]), 1e-6)
    assert (error, of) == (pytest.approx(0.1), 1.0)
    assert _largest(np.array([1e-9]), np.array([1e-12]), 1e-6)[0] == pytest.approx(1e-3)


def test_a_difference_is_seen():
    # The same tolerance twice agrees exactly; a loose one does not agree with itself made tight.
    same = compare(2, tight=2e-4, physical=0.0)
    assert same.verdict == "agrees" and same.energy_error == 0.0
    assert 0.0 < compare(2, physical=0.0).energy_error < 1e-3


@pytest.mark.deep
def test_a_slice():
    outcomes = [compare(number, physical=0.0) for number in range(60)]
    assert not [one for one in outcomes if one.verdict.startswith(("failed", "no reference"))]
    off = [one for one in outcomes if one.verdict.startswith("off")]
    # What is off has the shaft or the thrust going through zero, and is little.
    assert len(off) <= 2 and all(one.history in ("stop and go", "shaft reversal", "thrust reversal") for one in off)
    assert len(list(table(outcomes))) == 2 + len(HISTORIES) + len(off)
