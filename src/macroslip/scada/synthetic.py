"""Synthetic years of ten-minute means, of a bearing whose heat is known.

A fit that is shown such a year has to find what it was made with.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import resources
from os import PathLike
from pathlib import Path

import numpy as np
import pandas as pd
from scipy.signal import lfilter
from scipy.stats import norm, weibull_min

from macroslip.arrays import BoolArray, FloatArray
from macroslip.constants import HOUR, RPM, ZERO_CELSIUS
from macroslip.scada.friction_table import FrictionTable, read_entries
from macroslip.scada.speed_exponents import speed_exponents

#: Friction torque of the base turbine's main bearing; `python -m tools.friction_tables` makes it.
BASE_TURBINE = Path(str(resources.files("macroslip.scada") / "base_turbine_friction.csv"))
_STEP = 600.0
_ROWS_A_DAY = 144
#: The turbine, of the kind of the base turbine with a rotor that turns more slowly: wind where it
#: starts and where power is rated [m/s], rated speed [rad/s], tip-speed constant [rad/m], least
#: speed of production [rad/s], rated power [W], and own use [W].
CUT_IN = 3.0
RATED_WIND = 11.2
RATED_SPEED = 17.1 * RPM
_SPEED_PER_WIND = 1.75 * RPM
_LEAST_SPEED = 6.5 * RPM
RATED_POWER = 1.5e6
_OWN_USE = -3e3
#: Weibull scale [m/s] and shape of the wind.
_WIND = (7.4, 2.0)
#: Share of the variance of the wind that weather brings, with its correlation time [rows], and that
#: of gusts.
_WEATHER = 0.9
_WEATHER_ROWS = 144.0
_GUST_ROWS = 1.5
#: Stops at standstill: how many a year, and their mean length [rows].
_STOPS = 60
_STOP_ROWS = 30.0
#: Delay of the air behind weather and power [rows].
_LAG_ROWS = 12.0
#: Gaps: their mean length [rows].
_GAP_ROWS = 6.0
#: Period in which friction wanders [days], and the part of it by which years of neighbouring seeds
#: differ.
_WANDER_DAYS = 240.0
_WANDER_PHASE = 0.618
#: Step of temperature over which friction is taken as linear, and how far the bearing may be beyond
#: the friction table [K].
_CELL = 1.0
_BEYOND = 20.0


@dataclass(frozen=True)
class SyntheticYear:
    """Settings of a synthetic year."""

    capacity: float = 3.0e6  #: C, heat capacity of what warms with the bearing [J/K]
    to_nacelle: float = 0.079  #: k_n, conductance to the nacelle over C [1/h]
    to_ambient: float = 0.021  #: k_o, conductance to the air outside over C [1/h]
    seal_torque: float = 60.0  #: M_s, a constant torque of friction [N m]
    supply: str = "skf"  #: Supply of oil of the friction table
    noise: float = 0.2  #: Standard deviation of a recorded temperature of the bearing [K]
    resolution: float = 0.1  #: Step in which temperatures are recorded [K]
    missing: float = 0.03  #: Share of rows that are left out
    more_friction: float = 1.0  #: Factor of the bearing's friction from a day on; seals keep theirs
    more_from: int = 200  #: Number of that day, 0 the first
    wander: float = 0.0  #: Share by which the friction slowly rises and falls; seals keep theirs
    fan: float = 0.0  #: Share by which the conductance to the nacelle grows with the wind [s/m]
    seed: int = 1
    start: str = "2024-01-01"
    days: int = 365


def base_turbine_friction() -> FrictionTable:
    """Friction of the base turbine's main bearing by four supplies of oil.

    Examples
    --------
    >>> base_turbine_friction().supplies
    ('skf', 'flooded', '0.7', '0.5')
    """
    entries = read_entries(BASE_TURBINE)
    supplies = entries["supply"].unique()
    exponents, _ = speed_exponents(supplies)
    return FrictionTable(entries, exponents, source="base turbine")


def synthetic_year(truth: SyntheticYear, friction: FrictionTable) -> pd.DataFrame:
    """Ten-minute means of a turbine with the heat balance of its main bearing.

        dT/dt = 3600 (P_f(T) + M_s n)/C − k_n (T − T_nacelle) − k_o (T − T_ambient)    [K/h]

    with k_n growing by `fan` with the wind, and wind, speed and the temperatures of the air constant over ten minutes, and the recorded
    temperature of the bearing the mean of the solution over them.

    Parameters
    ----------
    truth : SyntheticYear
    friction : FrictionTable
        Of the bearing.

    Returns
    -------
    DataFrame
        Over UTC time: wind_speed [m/s], rotor_speed [rad/s], power [W], and bearing_temperature,
        nacelle_temperature and ambient_temperature [K].
    """
    random = np.random.default_rng(truth.seed)
    rows = truth.days * _ROWS_A_DAY
    time = pd.date_range(truth.start, periods=rows, freq="10min", tz="UTC")
    wind, speed, power = _operation(random, rows)
    ambient, nacelle = _air(random, time, power)
    bearing = _bearing(truth, friction, wind, speed, nacelle, ambient)
    recorded = bearing + truth.noise * random.standard_normal(rows)

    def rounded(kelvin: FloatArray) -> FloatArray:
        if truth.resolution == 0.0:
            return kelvin
        degrees = kelvin - ZERO_CELSIUS
        steps = np.round(degrees / truth.resolution)
        return ZERO_CELSIUS + steps * truth.resolution

    record = pd.DataFrame(
        {
            "wind_speed": wind,
            "rotor_speed": speed,
            "power": power,
            "bearing_temperature": rounded(recorded),
            "nacelle_temperature": rounded(nacelle),
            "ambient_temperature": rounded(ambient),
        },
        index=time,
    )
    gaps = truth.missing * rows / _GAP_ROWS
    missing = _within_spells(random, rows, gaps, _GAP_ROWS)
    return record.loc[~missing]


def write_record(record: pd.DataFrame, path: str | PathLike[str]) -> None:
    """Write ten-minute means as a turbine's export would have them: CSV, compressed after its name.

    Wind to 0.1 m/s, speed to 0.1 rpm, power to 10 kW, temperatures of the bearing to 0.1 °C, of the
    air to 0.5 °C, as sensors of that kind have them; times are those of UTC.
    """
    celsius = record.filter(like="temperature") - ZERO_CELSIUS
    half_degrees = (2.0 * celsius).round()
    kilowatts = 10 * (record["power"] / 1e4).round()
    rotor_rpm = record["rotor_speed"] / RPM
    table = pd.DataFrame(
        {
            "time": _minutes(record.index),
            "wind_mps": [f"{value:.1f}" for value in record["wind_speed"]],
            "rotor_rpm": [f"{value:.1f}" for value in rotor_rpm],
            "power_kW": kilowatts.to_numpy(int),
            "bearing_degC": [f"{value:.1f}" for value in celsius["bearing_temperature"]],
            "nacelle_degC": half_degrees["nacelle_temperature"].to_numpy() / 2.0,
            "ambient_degC": half_degrees["ambient_temperature"].to_numpy() / 2.0,
        }
    )
    compression = None
    if str(path).endswith(".gz"):
        compression = {"method": "gzip", "mtime": 0}
    table.to_csv(path, index=False, lineterminator="\n", compression=compression)


def _minutes(times: pd.DatetimeIndex) -> list[str]:
    """Times of UTC as `2024-01-31 23:50`."""
    text = np.datetime_as_string(times.tz_convert(None).to_numpy(), unit="m")
    return [time.replace("T", " ") for time in text.tolist()]


def _correlated(random: np.random.Generator, rows: int, correlation: float) -> FloatArray:
    """Normal numbers of variance 1 whose correlation falls by e over so many rows."""
    kept = np.exp(-1.0 / correlation)
    scatter = np.sqrt(1.0 - kept**2)
    pushes = scatter * random.standard_normal(rows)
    pushes[0] = random.standard_normal()
    return np.asarray(lfilter([1.0], [1.0, -kept], pushes))


def _within_spells(
    random: np.random.Generator, rows: int, number: float, length: float
) -> BoolArray:
    """True for rows in one of `number` spells of a mean length."""
    inside = np.zeros(rows, dtype=bool)
    starts = random.integers(0, rows, round(number))
    lengths = random.geometric(1.0 / length, starts.size)
    for start, size in zip(starts, lengths, strict=True):
        inside[start : start + size] = True
    return inside


def _operation(random: np.random.Generator, rows: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Wind [m/s], speed of the rotor [rad/s] and power [W] of every row."""
    weather = _correlated(random, rows, _WEATHER_ROWS)
    gusts = _correlated(random, rows, _GUST_ROWS)
    slow = np.sqrt(_WEATHER) * weather
    fast = np.sqrt(1.0 - _WEATHER) * gusts
    both = slow + fast
    scale, shape = _WIND
    probability = norm.cdf(both)
    wind = weibull_min.ppf(probability, shape, scale=scale)
    speed = np.clip(_SPEED_PER_WIND * wind, _LEAST_SPEED, RATED_SPEED)
    scatter = 1.0 + 0.01 * random.standard_normal(rows)
    speed = np.minimum(speed * scatter, RATED_SPEED)
    share_of_wind = np.minimum(wind / RATED_WIND, 1.0)
    power = RATED_POWER * share_of_wind**3
    idle = wind < CUT_IN
    speed[idle] = 0.4 * RPM * wind[idle]
    power[idle] = _OWN_USE
    stops = _STOPS * rows / 52560.0
    stopped = _within_spells(random, rows, stops, _STOP_ROWS)
    speed[stopped] = 0.0
    power[stopped] = _OWN_USE
    return wind, speed, power


def _air(
    random: np.random.Generator, time: pd.DatetimeIndex, power: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Temperatures outside and in the nacelle [K]."""
    hours = np.arange(time.size) * _STEP / HOUR
    since_coldest_day = hours / 24.0 - 20.0
    since_coldest_hour = hours - 3.0
    angle_of_year = 2.0 * np.pi * since_coldest_day / 365.0
    angle_of_day = 2.0 * np.pi * since_coldest_hour / 24.0
    of_year = -7.5 * np.cos(angle_of_year)
    of_day = -3.0 * np.cos(angle_of_day)
    weather = 2.5 * _smoothed(_correlated(random, time.size, 3.0 * _ROWS_A_DAY))
    ambient = ZERO_CELSIUS + 11.0 + of_year + of_day + weather
    rise_by_power = 5.0 * np.maximum(power, 0.0) / RATED_POWER
    rise = _smoothed(7.0 + rise_by_power)
    scatter = _smoothed(_correlated(random, time.size, 36.0))
    return ambient, ambient + rise + 0.6 * scatter


def _smoothed(values: FloatArray) -> FloatArray:
    """The values with a delay of two hours (first order)."""
    kept = np.exp(-1.0 / _LAG_ROWS)
    start = [kept * values[0]]
    smoothed, _ = lfilter([1.0 - kept], [1.0, -kept], values, zi=start)
    return smoothed


def _bearing(
    truth: SyntheticYear,
    friction: FrictionTable,
    wind: FloatArray,
    speed: FloatArray,
    nacelle: FloatArray,
    ambient: FloatArray,
) -> FloatArray:
    """Temperature of the bearing [K], its mean over every row.

    Within a row the friction is linear in the temperature, so that a row has the closed solution
    T = T_end + (T_0 − T_end) exp(−b t).
    """
    step = _STEP / HOUR
    per_heat = HOUR / truth.capacity
    factor = _friction_factor(truth, wind.size)
    low = friction.temperatures[0]
    high = friction.temperatures[-1]
    grid = np.arange(low - _BEYOND, high + _BEYOND, _CELL)
    # Beyond the table its ends are held.
    known, inverse = np.unique(np.clip(grid, low, high), return_inverse=True)
    powers = [friction.power(truth.supply, wind, speed, kelvin) for kelvin in known]
    seals = truth.seal_torque * speed
    powers_of_oils = np.stack(powers, axis=1)[:, inverse]
    heats = per_heat * (factor[:, None] * powers_of_oils + seals[:, None])
    slopes = np.diff(heats, axis=1) / _CELL
    to_nacelle = truth.to_nacelle * (1.0 + truth.fan * wind)
    loss = to_nacelle + truth.to_ambient
    drive = to_nacelle * nacelle + truth.to_ambient * ambient
    means = np.empty(wind.size)
    now = float(nacelle[0])
    for row in range(wind.size):
        cell = int((now - grid[0]) / _CELL)
        slope = slopes[row, cell]
        decay = loss[row] - slope
        level = (heats[row, cell] - slope * grid[cell] + drive[row]) / decay
        kept = np.exp(-decay * step)
        means[row] = level + (now - level) * (1.0 - kept) / (decay * step)
        now = level + (now - level) * kept
    return means


def _friction_factor(truth: SyntheticYear, rows: int) -> FloatArray:
    """Friction of every row over that of the table [-]."""
    days = np.arange(rows) / _ROWS_A_DAY
    turns = days / _WANDER_DAYS + _WANDER_PHASE * truth.seed
    factor = 1.0 + truth.wander * np.sin(2.0 * np.pi * turns)
    first_row = truth.more_from * _ROWS_A_DAY
    factor[first_row:] *= truth.more_friction
    return factor
