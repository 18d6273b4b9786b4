"""Wear and energy of a year at the temperatures that main bearings had, over those at 35 °C.

macroslip study examples/year_temperatures.yaml -o temperatures     # an hour of one processor
python -m validation.real_years temperatures

The temperatures are shares of ten-minute rows by wind speed and temperature of the main bearing,
`validation/data/scada_temperatures.csv`, of four turbines of La Haute Borne and of the two bearings
of another turbine. Its head says where they come from.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from macroslip import open_study
from macroslip.constants import ZERO_CELSIUS
from macroslip.scada.bins import TEMPERATURE_WIDTH, JointShares
from macroslip.study.aggregation import Aggregation
from macroslip.study.over_temperature import RunsOverTemperature, interpolated
from macroslip.study.real_year import FIXED, OFFSET
from macroslip.study.temperature_shares import TemperatureShares
from macroslip.study.weights import BinProbabilities, Weighting, Year, stored_weighting
from macroslip.study.year import designs, year

SHARES = Path(__file__).parent / "data" / "scada_temperatures.csv"


def measured_shares(table: pd.DataFrame, turbine: str, winds: np.ndarray) -> JointShares:
    """Shares of a turbine of the table in bins of wind speed [m/s], the nearest one each."""
    rows = table[table["turbine"] == turbine]
    celsius = rows["bearing_degC"].to_numpy(dtype=float)
    lowest = float(celsius.min())
    number = np.round((celsius - lowest) / TEMPERATURE_WIDTH).astype(int)
    count = int(number.max()) + 1
    share = rows["share"].to_numpy() / rows["share"].sum()
    is_idle = (rows["state"] == "idle").to_numpy()
    idle = np.bincount(number[is_idle], share[is_idle], minlength=count)
    turning = np.zeros((winds.size, count))
    nearest = np.abs(rows["wind_mps"].to_numpy()[:, None] - winds).argmin(axis=1)
    np.add.at(turning, (nearest[~is_idle], number[~is_idle]), share[~is_idle])
    kelvin = ZERO_CELSIUS + lowest + TEMPERATURE_WIDTH * np.arange(count)
    mean = float(turning.sum(axis=0) @ kelvin / turning.sum())
    return JointShares(turbine, winds, kelvin, turning, idle, mean, 0.0, 0.0)


def ratios(study: xr.Dataset, table: pd.DataFrame) -> pd.DataFrame:
    """Energy and wear of a year at the temperatures of each turbine, over other temperatures.

    `site` is True with the turbine's own wind, False with that of the study's weights.
    """
    runs = RunsOverTemperature.of(study)
    weighting = stored_weighting(study)
    if weighting is None:
        raise SystemExit("the study has no weights")
    speeds = study["wind_speed"].values[study["event"].values.astype(str) == ""]
    lines = []
    for turbine in table["turbine"].unique():
        joint = measured_shares(table, turbine, np.unique(speeds))
        real = TemperatureShares.measured(joint)
        cases = {
            "real": real,
            "mean": real.at(joint.mean_turning, joint.mean_idle),
            "fixed": real.at(FIXED, FIXED),
            "cooler": real.warmer(-OFFSET),
            "warmer": real.warmer(OFFSET),
        }
        for site in (False, True):
            wind = BinProbabilities(joint.wind_shares()) if site else weighting.year.wind
            numbers = {
                name: _numbers(runs, shares, Year(wind, weighting.year.events), weighting)
                for name, shares in cases.items()
            }
            wear = {
                name: float(numbers_of_year["wear"]) for name, numbers_of_year in numbers.items()
            }
            energy = {
                name: float(numbers_of_year["energy"]) for name, numbers_of_year in numbers.items()
            }
            lines.append(
                {
                    "turbine": turbine,
                    "site": site,
                    "mean [degC]": joint.mean_turning - ZERO_CELSIUS,
                    "energy over 35 degC": energy["real"] / energy["fixed"],
                    "wear over 35 degC": wear["real"] / wear["fixed"],
                    "wear over the mean": wear["real"] / wear["mean"],
                    "5 K cooler": wear["cooler"] / wear["real"],
                    "5 K warmer": wear["warmer"] / wear["real"],
                }
            )
    return pd.DataFrame(lines)


def interpolation_errors(study: xr.Dataset) -> pd.DataFrame:
    """Largest errors of wear and energy at a temperature of the runs that is left out.

    The others are then twice as far apart as those of the study.
    """
    runs = RunsOverTemperature.of(study)
    produces = study["event"].values.astype(str)[runs.runs[:, 0]] == ""
    lines = []
    for number in range(1, runs.temperatures.size - 1):
        kept = np.arange(runs.temperatures.size) != number
        line = {"left out [degC]": runs.temperatures[number] - ZERO_CELSIUS}
        of_bearing = {
            "wear_rate": study["wear_rate"].max("row"),  # that of the worse row
            "energy_mean": study["energy_mean"].sum("row"),
        }
        for quantity, of_runs in of_bearing.items():
            values = of_runs.values[runs.runs[produces]]
            known = np.moveaxis(values, 1, 0)
            at = runs.temperatures[[number]]
            between = interpolated(runs.temperatures[kept], known[kept], at, by_factors=True)
            line[f"{quantity} [%]"] = 100.0 * np.abs(between[0] / known[number] - 1.0).max()
        lines.append(line)
    return pd.DataFrame(lines)


def _numbers(
    runs: RunsOverTemperature, shares: TemperatureShares, of_year: Year, weighting: Weighting
) -> pd.Series:
    """Numbers of the study's one design."""
    means = runs.mean(shares, weighting.field, weighting.width)
    aggregation = Aggregation(of_year, 1.0, weighting.field, weighting.width)
    return designs(year(means, aggregation))[0].iloc[0]


if __name__ == "__main__":
    opened = open_study(sys.argv[1])
    print(ratios(opened, pd.read_csv(SHARES, comment="#")).round(2).to_string(index=False))
    print(interpolation_errors(opened).round(1).to_string(index=False))
