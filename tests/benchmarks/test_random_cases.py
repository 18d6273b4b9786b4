"""Random legal cases at the default tolerance beside a tight one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchmarks.random_cases import (
    FORCES,
    HISTORIES,
    SPEEDS,
    SUDDEN,
    SUDDEN_FORCES,
    SUDDEN_SPEEDS,
    WIDE,
    _largest,
    compare,
    random_case,
    table,
)
from tests.fuzz.oracle import examples


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


def test_wide_cases_have_every_kind_of_speed_and_force():
    drawn = [random_case(number, wide=1.0) for number in range(250)]
    kinds = [kind.removeprefix(f"{WIDE}: ").split(", ") for kind, _ in drawn]
    assert {speed for speed, _ in kinds} == set(SPEEDS) and {force for _, force in kinds} == set(
        FORCES
    )
    steps = [float(case.loads.time[1] - case.loads.time[0]) for _, case in drawn]
    assert min(steps) < 2e-3 and max(steps) > 0.5


def test_sudden_cases_have_every_kind_of_speed_and_force():
    drawn = [random_case(number, sudden=1.0) for number in range(150)]
    kinds = [kind.removeprefix(f"{SUDDEN}: ").split(", ") for kind, _ in drawn]
    assert {speed for speed, _ in kinds} == set(SUDDEN_SPEEDS)
    assert {force for _, force in kinds} == set(SUDDEN_FORCES)
    # Inching and run-down shafts come to rest, and a sawtooth comes back within a sample.
    for (speed, _), (_, case) in zip(kinds, drawn, strict=True):
        turn = np.abs(case.loads.shaft_speed)
        if speed == "inching":
            assert turn.min() < 0.01 * turn.max(), case
        if speed == "run-down":
            assert np.diff(turn).max() <= 0.0, case


@pytest.mark.slow
@examples(5)
@given(number=st.integers(0, 2**20))
def test_any_case_of_sudden_speeds_agrees_with_itself_made_tight_or_says_that_it_failed(number):
    comparison = compare(number, tight=2e-5, physical=0.0, sudden=1.0)
    assert not comparison.verdict.startswith("off"), comparison


@pytest.mark.slow
@examples(5)
@given(number=st.integers(0, 2**20))
def test_any_legal_case_agrees_with_itself_made_tight_or_says_that_it_failed(number):
    comparison = compare(number, tight=2e-5, physical=0.0, wide=1.0)
    assert not comparison.verdict.startswith("off"), comparison


@pytest.mark.parametrize("number", [10372, 10791, 11134])
def test_the_end_of_a_step_may_be_its_peak(number):
    """A starting roller slips by next to nothing while the cage pushes it: no sample between the stages says so."""
    comparison = compare(number, tight=2e-5, physical=0.1, wide=0.5)
    assert comparison.verdict == "agrees" and comparison.peak_error < 1e-3, comparison


@pytest.mark.parametrize("number", [10001, 10018])
def test_a_grip_finer_than_a_table_can_tell_is_no_reason_for_tiny_steps(number):
    """Cold oil that does not heat up holds rollers at a slip of 1e-14 m/s and less, by which a table's places are rounded."""
    comparison = compare(number, tight=2e-5, physical=0.1, wide=0.5)
    assert comparison.verdict == "agrees" and comparison.energy_error < 2e-4, comparison


@pytest.mark.parametrize("number", [30669, 30968])
def test_power_has_its_peak_where_the_film_ends(number):
    """While rings turn round, entrainment of a sliding roller passes zero, between two steps."""
    comparison = compare(number, tight=2e-5, physical=0.1, wide=0.5)
    assert comparison.verdict == "agrees" and comparison.peak_error < 5e-3, comparison


def test_a_grip_at_the_middle_of_a_table_is_as_fine_as_its_laws():
    """Cold oil that does not heat up, at 1.7 GPa, moves by 1e-19 m/s a newton."""
    comparison = compare(30965, tight=5e-5, physical=0.1, wide=0.5)
    assert comparison.verdict == "agrees" and comparison.energy_error < 3e-4, comparison


@pytest.mark.deep
@examples(1)
@given(number=st.integers(0, 2**20), whole=st.sampled_from([0.0, 1.0]))
def test_any_legal_case_of_both_models_and_dynamics(number, whole):
    comparison = compare(number, tight=2e-5, physical=1.0 - whole, whole=whole, wide=1.0)
    # Of a whole bearing's rollers single touches are chaotic: rows are compared, to 5e-3.
    assert not comparison.verdict.startswith("off") or (whole and comparison.energy_error < 5e-3), (
        comparison
    )


@pytest.mark.deep
@pytest.mark.parametrize(("physical", "count"), [(0.0, 300), (1.0, 10)])
def test_a_slice(physical, count):
    outcomes = [compare(number, physical=physical) for number in range(count)]
    assert [outcome for outcome in outcomes if outcome.verdict != "agrees"] == []
    assert len(list(table(outcomes))) == 2 + len(HISTORIES)


@pytest.mark.deep
def test_cases_in_which_the_whole_bearing_moves_end_well():
    # Rows agree to 1e-3 in two of three; docs/meaning.md has the largest differences.
    outcomes = [compare(number, physical=0.0, whole=1.0) for number in range(9940, 9946)]
    assert all(
        outcome.verdict.startswith(("agrees", "off")) and outcome.energy_error < 5e-3
        for outcome in outcomes
    )
