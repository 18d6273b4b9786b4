import numpy as np
import pandas as pd
import pytest
from scipy.interpolate import PchipInterpolator

from macroslip import InputError
from macroslip.scada.friction_table import COLUMNS, FrictionTable, read_entries
from macroslip.scada.speed_exponents import EXPONENTS, speed_exponents
from macroslip.scada.synthetic import base_turbine_friction

WINDS = (4.0, 8.0, 16.0)
OIL = (278.15, 293.15, 308.15, 323.15)


def entries() -> pd.DataFrame:
    random = np.random.default_rng(4)
    wind, oil = np.meshgrid(WINDS, OIL, indexing="ij")
    torque = 300.0 * np.exp(-0.03 * (oil - 290.0)) * (1.0 + 0.2 * random.random(oil.shape))
    columns = ["skf"] * oil.size, wind.ravel(), oil.ravel(), 0.1 * wind.ravel(), torque.ravel()
    return pd.DataFrame(dict(zip(COLUMNS, columns, strict=True)))


def table(changed: pd.DataFrame | None = None) -> FrictionTable:
    exponent = {"skf": pd.Series([0.3, 0.6], [280.0, 310.0])}
    return FrictionTable(entries() if changed is None else changed, exponent)


def test_the_entries_are_kept():
    lines = entries().sample(frac=1.0, random_state=1)
    torque = table(lines).torque(
        "skf", lines["wind_speed"], lines["shaft_speed"], lines["temperature"]
    )
    assert torque == pytest.approx(lines["torque"].to_numpy(), rel=1e-12)


def test_between_entries_it_is_pchip_over_temperature_and_linear_over_wind():
    known = entries().pivot_table("torque", "wind_speed", "temperature")
    at = {
        wind: np.exp(PchipInterpolator(OIL, np.log(known.loc[wind].to_numpy()))(300.0))
        for wind in (4.0, 8.0)
    }
    # Geometric means of torque and speed in the middle of two winds.
    middle = table().torque("skf", 6.0, np.sqrt(0.4 * 0.8), 300.0)
    assert middle == pytest.approx(np.sqrt(at[4.0] * at[8.0]), rel=1e-12)


def test_the_torque_goes_with_a_power_of_the_speed():
    own = table().torque("skf", 8.0, 0.8, 295.0)
    assert table().torque("skf", 8.0, 0.4, 295.0) == pytest.approx(own * 0.5**0.45, rel=1e-12)
    assert table().torque("skf", 8.0, 0.0, 295.0) == table().torque("skf", 8.0, 0.08, 295.0)
    assert table().power("skf", 8.0, 0.0, 295.0) == 0.0


def test_its_ends_are_held():
    assert table().torque("skf", 30.0, 1.6, 330.0) == table().torque("skf", 16.0, 1.6, 323.15)
    table().check_span([274.0, 327.0])
    with pytest.raises(InputError, match=r"-0\.1 to 30\.0 degC, the study at 5 to 50 degC"):
        table().check_span([273.05, 303.15])


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        (lambda lines: lines.drop(columns="torque"), "the columns torque are missing"),
        (lambda lines: lines.drop(index=5), "no torque for the supply skf at 8 m/s and 20 degC"),
        (lambda lines: lines.assign(torque=0.0), "not positive"),
        (lambda lines: lines[lines["temperature"] < 300.0], "2 temperatures"),
        (lambda lines: lines[lines["wind_speed"] == 4.0], "1 mean wind speed"),
        (lambda lines: lines.assign(supply="0.4"), "no exponent of speed"),
    ],
)
def test_a_table_with_holes_is_refused(changed, told):
    with pytest.raises(InputError, match=told):
        table(changed(entries()))


def test_a_written_table_is_read_again(tmp_path):
    table().write_csv(tmp_path / "friction.csv")
    again = read_entries(tmp_path / "friction.csv")
    pd.testing.assert_frame_equal(again, entries(), atol=0.005, rtol=0.0)


def test_friction_of_the_base_turbine_falls_with_temperature_and_starvation():
    friction = base_turbine_friction()
    assert friction.supplies == ("skf", "flooded", "0.7", "0.5")
    torque = {
        supply: friction.torque(supply, 10.0, 1.5, np.array([283.15, 308.15]))
        for supply in friction.supplies
    }
    assert all(cold > warm for cold, warm in torque.values())
    # Starvation cools.
    at_35 = {supply: warm for supply, (_, warm) in torque.items()}
    assert at_35["flooded"] > at_35["skf"] > at_35["0.7"] > at_35["0.5"]


def test_exponents_of_other_supplies_lie_between():
    exponents, notes = speed_exponents(["0.6", "0.85", "0.4"])
    low, middle, high = (np.array(EXPONENTS[name]) for name in ("0.5", "0.7", "flooded"))
    assert exponents["0.6"].to_numpy() == pytest.approx(0.5 * (low + middle))
    assert exponents["0.85"].to_numpy() == pytest.approx(0.5 * (middle + high))
    assert exponents["0.4"].to_numpy() == pytest.approx(low)
    assert notes == ("The supply 0.4 has the exponent of speed of the supply 0.5.",)
