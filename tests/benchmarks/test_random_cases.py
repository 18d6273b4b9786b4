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
@pytest.mark.parametrize(("physical", "count"), [(0.0, 300), (1.0, 10)])
def test_a_slice(physical, count):
    outcomes = [compare(number, physical=physical) for number in range(count)]
    assert [one for one in outcomes if one.verdict != "agrees"] == []
    assert len(list(table(outcomes))) == 2 + len(HISTORIES)


@pytest.mark.deep
def test_cases_in_which_the_whole_bearing_moves_end_well():
    # Rows agree to 1e-3 in two of three; docs/integrator.md has the largest differences.
    outcomes = [compare(number, physical=0.0, whole=1.0) for number in range(9940, 9946)]
    assert all(one.verdict.startswith(("agrees", "off")) and one.energy_error < 5e-3 for one in outcomes)
