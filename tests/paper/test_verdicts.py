"""The one rule of verdicts, and the numbers that they rest on."""

import math

import numpy as np
import pytest
import xarray as xr

from paper.verdicts import (
    AGREES,
    DIFFERS,
    NOT_COMPUTED,
    PARTLY,
    UNKNOWN,
    Row,
    Statement,
    cage_dominates,
    energy_between_rows,
    energy_over_wind_speed,
    euler_stability,
    peak_power_between_rows,
    peak_power_over_wind_speed,
    unloaded_roller,
    varying_over_static,
)

SPEEDS, ROWS = np.arange(12.0, 25.0, 2.0), ["downwind", "upwind"]
CASES = [f"{speed:g}B" for speed in SPEEDS]
COORDS = {"case": CASES, "wind_speed": ("case", SPEEDS), "row": ROWS}


def verdict(rows):
    return Statement("", rows).verdict


def by_row(values):
    return ("case", "row"), np.column_stack([values, values])


def test_a_verdict_counts_what_is_as_stated():
    good, bad, told = (
        Row("a", "", 1.0, "", "1", 1.0, 1.0),
        Row("b", "", 2.0, "", "1", 1.0, 1.0),
        Row("c", "", 5.0),
    )
    for rows, expected in (
        ((good, told), AGREES),
        ((good, bad), PARTLY),
        ((bad, told), DIFFERS),
        ((), NOT_COMPUTED),
    ):
        assert verdict(rows) == expected
    # A number that is missing leaves nothing to judge, whether anything is stated of it or not.
    assert verdict((good, Row("d", "", math.nan))) == UNKNOWN
    assert not Row("e", "", math.inf, "", "low", 0.0, 9.0).holds


def test_a_reason_is_given_where_something_differs():
    row = Row("a", "", 2.0, "", "1", 1.0, 1.0)
    assert Statement("", (row,), "so").because == "so"
    as_stated = (Row("a", "", 1.0, "", "1", 1.0, 1.0),)
    assert Statement("", as_stated, "so").because == ""
    assert Statement("", as_stated, "so", other_mechanism=True).because == "so"


def test_energy_is_highest_at_the_two_lowest_wind_speeds_or_not():
    orbits = xr.Dataset({"orbits": ("case", SPEEDS), "orbit_energy": by_row(np.ones(7))}, COORDS)
    for energy, expected in (
        (1.0 / SPEEDS, AGREES),
        (SPEEDS, DIFFERS),
        (1.0 + np.abs(SPEEDS - 14.0), DIFFERS),
    ):
        numbers = xr.Dataset({"both_rows_normalised": ("case", energy)}, COORDS)
        assert verdict(energy_over_wind_speed(numbers, orbits)) == expected
    numbers.both_rows_normalised[3] = np.nan
    assert verdict(energy_over_wind_speed(numbers, orbits)) == UNKNOWN
    values = {row.key: row.value for row in energy_over_wind_speed(numbers, orbits)}
    assert (values["orbits"], values["per_orbit_upwind"]) == (1.0, 0.0)


def test_energy_between_rows_is_about_ten():
    for ratio, expected in (
        (9.0, AGREES),
        (1.2, DIFFERS),
        (np.linspace(9.0, 30.0, 7), PARTLY),
        (np.nan, UNKNOWN),
    ):
        values = xr.Dataset(
            {"energy_ratio": ("case", np.ones(7) * ratio), "orbit_energy": by_row(np.ones(7))},
            COORDS,
        )
        assert verdict(energy_between_rows(values, 1.0)) == expected


def test_peak_power_verdicts_follow_the_numbers():
    def numbers(mean, std, ratio):
        values = {
            "peak_power_mean": by_row(mean),
            "peak_power_std": by_row(std),
            "peak_power_ratio": ("case", ratio),
        }
        return xr.Dataset(values, COORDS)

    level = np.array([1.0, 1.2, 0.9, 1.1, 1.0, 1.05, 0.95])
    agreeing = numbers(level, level, 50.0 / SPEEDS)
    rising = numbers(SPEEDS, SPEEDS, 5.0 * SPEEDS / 24.0)
    contrary = numbers(SPEEDS, 0.01 * SPEEDS, SPEEDS)
    for made, expected in ((agreeing, AGREES), (rising, PARTLY), (contrary, DIFFERS)):
        assert verdict(peak_power_over_wind_speed(made)) == expected
        assert verdict(peak_power_between_rows(made)) == expected
    agreeing.peak_power_ratio[0] = np.nan
    assert verdict(peak_power_between_rows(agreeing)) == UNKNOWN


def test_the_ratio_to_static_is_about_a_hundred():
    numbers = xr.Dataset({"orbit_energy": by_row(np.full(7, 2.0))}, COORDS)
    for static, expected in ((2.0, DIFFERS), (0.02, AGREES)):
        rows = varying_over_static(numbers, {"downward": {"downwind": static}})
        assert verdict(rows) == expected
        assert rows[0].value == pytest.approx(2.0 / static)


def test_dominance_follows_the_numbers():
    for cage, expected in ((3.0, AGREES), (0.5, DIFFERS), (np.nan, UNKNOWN)):
        energy = np.ones((7, 2, 3, 3)) * np.array([0.5, 0.5, cage])
        coords = COORDS | {"interface": ["inner", "outer", "cage"]}
        study = xr.Dataset({"energy": (("case", "row", "roller", "interface"), energy)}, coords)
        assert verdict(cage_dominates(study)) == expected


def test_an_unloaded_roller_is_judged_by_its_turn():
    def judged(inflexion, lowest, recovery):
        values = {
            "lowest_spin_ratio": lowest,
            "recovery_time_s": recovery,
            "start_s": 0.0,
            "end_s": 6.0,
        }
        return verdict(unloaded_roller(xr.Dataset(attrs=values), inflexion))

    assert judged(178.0, 0.6, 0.05) == AGREES
    # No inflexion and no return are findings, and nothing to hide behind.
    assert judged(math.nan, 0.6, math.nan) == PARTLY
    assert judged(90.0, 1.0, math.nan) == DIFFERS
    assert judged(178.0, math.nan, 0.05) == UNKNOWN


def test_euler_is_judged_by_its_deviation_or_by_being_stopped():
    def judged(explicit, backward, status=0):
        values = {"largest_deviation_explicit": explicit, "largest_deviation_backward": backward}
        return verdict(
            euler_stability(xr.Dataset(attrs=values | {"status_explicit": status, "step_s": 1e-3}))
        )

    assert judged(0.5, 0.01) == AGREES
    assert judged(math.nan, 0.01, status=2) == AGREES
    assert judged(0.01, 0.01) == PARTLY
    assert judged(0.01, 0.5) == DIFFERS
    assert judged(0.5, math.nan) == UNKNOWN
