"""Heat over speed and wind at the measured temperatures, with the agreement that was found as bound."""

import numpy as np
import pytest

from validation import heat
from validation.heat import Heat, State


def test_measured_ratios_carry_both_errors():
    ratio = heat.measured_ratio((17.0, 12.0), (17.0, 8.0))
    assert 0.5 * (ratio.low + ratio.high) == pytest.approx(1.99 / 1.44)
    assert 0.5 * (ratio.high - ratio.low) == pytest.approx(
        1.99 / 1.44 * ((0.08 / 1.99) ** 2 + (0.04 / 1.44) ** 2) ** 0.5
    )
    assert heat.measured_level().low == pytest.approx(1.99 / 3600.0 * 2e6)


def test_every_point_has_its_own_speed_temperature_and_wind():
    states = heat.wt23_states("front")
    assert [round(17.7 * state.speed, 1) for state in states] == [10.4, 11.4, 12.8, 14.6, 16.0]
    assert [state.celsius for state in states] == [35.4, 37.7, 39.0, 40.5, 42.5]
    assert [state.wind for state in states] == [3.5, 4.4, 5.2, 6.1, 7.0]
    assert [state.celsius for state in heat.wt23_states("rear")][::4] == [38.1, 45.2]


def test_temperatures_at_la_haute_borne_are_a_mean_of_rows_and_one_in_equal_surroundings():
    # In equal surroundings the bearing is warmer by its heat over its rate of cooling.
    slow = heat.lhb_temperatures(8.7, None)
    assert slow.low == pytest.approx(30.1 - (1.44 - 0.72) / 0.1)
    assert 27.0 < slow.high < 28.5
    windy = heat.lhb_temperatures(17.0, 12.0)
    assert windy == pytest.approx((29.1, 30.1 + (1.99 - 1.44) / 0.1))
    assert heat.lhb_temperatures(17.0, 8.0) == pytest.approx((30.1, 30.1))


@pytest.fixture
def known(monkeypatch):
    """Heat that is speed times wind, and independent of the rest."""
    monkeypatch.setattr(
        heat,
        "power_of_case",
        lambda wind, speed, celsius, supply: Heat(speed * wind, speed * wind, 2.0 * speed * wind),
    )


def test_heat_is_linear_in_the_wind_between_two_cases_and_held_beyond_the_first(known):
    assert heat.power(State(7.0, 0.5, 30.0)) == Heat(3.5, 3.5, 7.0)
    assert heat.power(State(3.5, 1.0, 30.0)) == heat.power(State(4.0, 1.0, 30.0))
    assert heat.power(State(24.0, 1.0, 30.0)).own == 24.0


def test_factors_of_speed_temperature_and_load_make_the_ratio(known):
    parts = heat.wt23_parts("front")
    assert np.prod(parts) == pytest.approx(heat.wt23_slowest("front").own)
    assert parts == pytest.approx((10.4 / 16.0, 1.0, 4.0 / 7.0))
    assert heat.wt23_slowest("front", equal_loads=True).own == pytest.approx(10.4 / 16.0)


def test_the_record_is_stretched_to_the_speed_of_the_point(monkeypatch):
    seen = []

    def torque(case, loads):
        seen.append((case, loads))
        return type("Torque", (), {"total": 100.0, "skf": 80.0, "palmgren": 60.0})()

    monkeypatch.setattr(heat, "torque", torque)
    heat.power_of_case.cache_clear()
    heat_of_case = heat.power_of_case(8, 0.5, 30.0, "flooded")
    heat.power_of_case.cache_clear()
    case, loads = seen[0]
    assert loads.shaft_speed.mean() == pytest.approx(0.5 * heat.SPEED)
    # As many turns as before, in a longer time.
    turns = np.trapezoid(loads.shaft_speed, loads.time)
    whole = heat.HubLoads.bundled("8B")
    assert turns == pytest.approx(np.trapezoid(whole.shaft_speed, whole.time), rel=1e-6)
    assert loads.time[-1] > 1.4 * whole.time[-1]
    assert case.oil.inlet_temperature == pytest.approx(303.15) and case.oil_supply == "flooded"
    assert heat_of_case == pytest.approx(
        [0.5 * heat.SPEED * power for power in (100.0, 80.0, 60.0)]
    )


@pytest.mark.slow
def test_measured_heat_over_the_speed_lies_between_own_loads_and_equal_loads():
    measured = heat.measured_wt23("front").iloc[0]
    own = heat.wt23_slowest("front")
    equal = heat.wt23_slowest("front", equal_loads=True)
    assert own == pytest.approx((0.484, 0.516, 0.505), abs=0.005)
    assert equal == pytest.approx((0.639, 0.639, 0.639), abs=0.005)
    assert own.own < measured.ratio_to_16rpm < equal.own


@pytest.mark.slow
def test_heat_grows_with_the_wind_less_than_measured():
    ratios = heat.lhb_ratio((17.0, 12.0))
    assert ratios["own"] == pytest.approx((0.991, 1.226), abs=0.005)
    assert ratios["own"].high < heat.measured_ratio((17.0, 12.0), (17.0, 8.0)).low
