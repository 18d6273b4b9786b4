"""Names of units: what several names mean is the same."""

import numpy as np
import pandas as pd
import pytest

from macroslip import BearingLoads, InputError
from macroslip.input.units import (
    POWER,
    RECORDED_TEMPERATURE,
    SPEED,
    TEMPERATURE_DIFFERENCE,
    TIME,
    parse_quantity,
)


def test_r_per_min_is_rpm():
    for number in (0.1, 17.1, 1800):
        assert SPEED.to_si(number, "r/min") == SPEED.to_si(number, "rpm")
    assert parse_quantity("17.1 r/min", SPEED) == (17.1, "r/min")


def test_tables_of_loads_may_have_r_per_min(tmp_path):
    table = pd.DataFrame(
        {
            "time_s": np.arange(20) * 0.1,
            "shaft_speed [rpm]": 20.0,
            "F_X0_kN": 1.0,
            "F_Y0_kN": -300.0,
        }
    )
    table["F_Z0_kN"] = 100.0
    table.to_csv(tmp_path / "rpm.csv", index=False)
    table.rename(columns={"shaft_speed [rpm]": "shaft_speed [r/min]"}).to_csv(
        tmp_path / "r_per_min.csv", index=False
    )
    first = BearingLoads.read(tmp_path / "rpm.csv")
    other = BearingLoads.read(tmp_path / "r_per_min.csv")
    assert (first.shaft_speed == other.shaft_speed).all()


def test_minutes_kilowatts_and_kelvins():
    assert TIME.to_si(10, "min") == 600.0
    assert POWER.to_si(2050, "kW") == 2.05e6
    assert TEMPERATURE_DIFFERENCE.to_si(-5, "K") == -5.0
    with pytest.raises(InputError, match="has the unit 'degC'"):
        parse_quantity("5 degC", TEMPERATURE_DIFFERENCE)


def test_fahrenheit_is_exact_at_two_points():
    assert RECORDED_TEMPERATURE.to_si(32, "degF") == 273.15
    assert RECORDED_TEMPERATURE.to_si(212, "degF") == 373.15
