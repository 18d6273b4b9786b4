"""Heat over the wind and the speed beside measured heat, with the agreement that was found as bound."""

import pytest

from validation import heat


def test_measured_ratios_carry_both_errors():
    found = heat.measured_ratio((17.0, 12.0), (17.0, 8.0))
    assert 0.5 * (found.low + found.high) == pytest.approx(1.99 / 1.44)
    assert 0.5 * (found.high - found.low) == pytest.approx(
        1.99 / 1.44 * ((0.08 / 1.99) ** 2 + (0.04 / 1.44) ** 2) ** 0.5
    )
    assert heat.measured_level().low == pytest.approx(1.99 / 3600.0 * 2e6)


def test_every_case_but_events_counts_once():
    names = [name for names in heat.wind_cases().values() for name in names]
    assert (len(names), len(set(names)), list(heat.wind_cases())) == (34, 34, list(range(4, 25, 2)))


@pytest.mark.slow
def test_heat_grows_with_the_load_less_than_measured_and_more_than_by_the_handbooks():
    own, skf, palmgren = (heat.computed_ratio(12.0, 8.0, model) for model in heat.MODELS)
    assert (own, skf, palmgren) == pytest.approx((1.26, 1.19, 1.23), abs=0.01)
    assert skf < palmgren < own < heat.measured_ratio((17.0, 12.0), (17.0, 8.0)).low


@pytest.mark.slow
def test_heat_falls_more_with_the_speed_than_measured():
    own, skf, palmgren = (heat.speed_ratio(model) for model in heat.MODELS)
    assert (own, skf, palmgren) == pytest.approx((0.35, 0.40, 0.42), abs=0.01)
    assert max(own, skf, palmgren) < heat.measured_ratio((8.7, None), (17.0, 8.0)).low
