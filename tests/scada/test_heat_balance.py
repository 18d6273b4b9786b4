"""The balance of heat against solutions of its differential equation."""

import numpy as np
import pandas as pd
import pytest
from scipy.integrate import solve_ivp

from macroslip.scada.heat_balance import Balance, fit_heat
from macroslip.scada.heat_models import HeatModel
from macroslip.scada.windows import unbroken_windows

CAPACITY = 3.0e6
LOSS = 0.1
DAYS = 40
ROWS = DAYS * 144


def solved(power: np.ndarray, air: np.ndarray) -> np.ndarray:
    """Temperature [K] in the middle of every ten minutes, of power and air that are steady in them."""
    temperature = np.empty(power.size)
    now = 290.0
    for row in range(power.size):
        solution = solve_ivp(
            lambda _, kelvin, row=row: (
                3600.0 * power[row] / CAPACITY - LOSS * (kelvin - air[row])
            ),
            (0.0, 1.0 / 6.0), [now], t_eval=[1.0 / 12.0, 1.0 / 6.0], rtol=1e-10, atol=1e-12,
        )  # fmt: skip
        temperature[row], now = solution.y[0]
    return temperature


def fitted(power: np.ndarray, air: np.ndarray):
    record = pd.DataFrame(
        {"bearing_temperature": solved(power, air), "nacelle_temperature": air},
        index=pd.date_range("2024-01-01", periods=ROWS, freq="10min", tz="UTC"),
    )
    rows = np.ones(ROWS, dtype=bool)
    windows = unbroken_windows(record.index, rows, ~rows, 600.0)
    balance = Balance.of(record, windows)
    model = HeatModel("known heat", "", {"capacity": power})
    return fit_heat(balance, model, np.ones(len(windows), dtype=bool))


@pytest.fixture(scope="module")
def air():
    hours = np.arange(ROWS) / 6.0
    return 285.0 + 6.0 * np.sin(hours / 24.0 * 2.0 * np.pi) + 4.0 * np.sin(hours / 130.0)


@pytest.mark.slow
def test_constant_power_by_days_gives_capacity_and_conductance(air):
    # Four days on, four days off: within all but a few windows the power is constant.
    power = np.where(np.arange(ROWS) // 576 % 2 == 0, 800.0, 0.0)
    fit = fitted(power, air)
    assert fit.values["capacity"] == pytest.approx(CAPACITY, rel=1e-3)
    assert fit.values["to_nacelle"] == pytest.approx(LOSS, rel=1e-3)
    assert fit.values["drift"] == pytest.approx(0.0, abs=1e-3)


@pytest.mark.slow
def test_power_in_steps_gives_them_to_two_per_cent(air):
    random = np.random.default_rng(2)
    power = random.choice([0.0, 300.0, 700.0, 1100.0], ROWS)
    fit = fitted(power, air)
    assert fit.values["capacity"] == pytest.approx(CAPACITY, rel=0.02)
    assert fit.values["to_nacelle"] == pytest.approx(LOSS, rel=0.02)


def test_errors_hold_for_noise_of_the_sensor():
    # The scatter of fits to many records is what one record's bootstrap tells.
    rows = 100 * 144
    hours = np.arange(rows) / 6.0
    random = np.random.default_rng(7)
    air = 285.0 + 6.0 * np.sin(hours / 24.0 * 2.0 * np.pi) + 5.0 * np.sin(hours / 200.0)
    power = np.repeat(random.choice([0.0, 400.0, 900.0], rows // 36), 36)
    clean = np.empty(rows)
    now = 290.0
    kept = np.exp(-LOSS / 6.0)
    for row in range(rows):
        level = air[row] + 3600.0 * power[row] / CAPACITY / LOSS
        clean[row] = level + (now - level) * (1.0 - kept) / (LOSS / 6.0)
        now = level + (now - level) * kept
    index = pd.date_range("2024-01-01", periods=rows, freq="10min", tz="UTC")
    used = np.ones(rows, dtype=bool)
    windows = unbroken_windows(index, used, ~used, 600.0)
    model = HeatModel("known heat", "", {"capacity": power})
    fits = []
    for _ in range(30):
        noisy = clean + 0.2 * random.standard_normal(rows)
        record = pd.DataFrame(
            {"bearing_temperature": noisy, "nacelle_temperature": air}, index=index
        )
        balance = Balance.of(record, windows)
        fits.append(fit_heat(balance, model, np.ones(len(windows), dtype=bool)))
    capacities = np.array([fit.values["capacity"] for fit in fits])
    told = np.mean([fit.errors["capacity"] for fit in fits])
    assert capacities.mean() == pytest.approx(CAPACITY, rel=0.01)
    assert told == pytest.approx(capacities.std(ddof=1), rel=0.4)
