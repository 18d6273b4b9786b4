"""A year at measured winds and oil temperatures, compared with years at one temperature."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike

import numpy as np
import pandas as pd
import xarray as xr

from macroslip.constants import HOURS_A_YEAR, YEAR, ZERO_CELSIUS
from macroslip.errors import InputError
from macroslip.result.criteria import OF_NUMBER, SUMMED
from macroslip.result.criteria.criterion import Yearly
from macroslip.scada.bins import JointShares, bin_centres
from macroslip.scada.reader import Scada
from macroslip.study.aggregation import Aggregation
from macroslip.study.labels import events_of_runs
from macroslip.study.over_temperature import RunsOverTemperature, check_span
from macroslip.study.reader import open_study
from macroslip.study.temperature_shares import TemperatureShares
from macroslip.study.weights import (
    Binning,
    BinProbabilities,
    Weibull,
    Weighting,
    Year,
    stored_weighting,
)
from macroslip.study.year import DESIGN_COLUMNS, design_names, designs, year

#: Temperature of the year that others are compared with [K]: 35 degC.
FIXED = ZERO_CELSIUS + 35.0
#: How far the oil may be from the sensor [K].
OFFSET = 5.0
#: Column of energies in `RealYear.bins`.
ENERGY_COLUMN = "energy [J]"
#: Least length of a record that stands for a year [h].
_SHORT = 30.0 * 24.0


@dataclass(frozen=True)
class RealYear:
    """A year of each design of a study under the winds and temperatures of a turbine."""

    #: A line for each design and quantity: `design`, `quantity`, `unit`, `real`, `at_mean` (one
    #: temperature, the mean one), `fixed` (35 degC), the ratios `real_over_fixed` and
    #: `real_over_at_mean`, `oil_cooler` and `oil_warmer` (the oil 5 K below and above what the
    #: sensor tells), `seeds [%]` (standard error by the scatter of runs that share a bin; NaN
    #: where none do) and `factor`, within which the criterion is known (NaN: not known).
    table: pd.DataFrame
    #: A line for each design, state, bin of wind speed and of temperature of the oil: `design`,
    #: `state`, `wind_speed [m/s]`, `oil_temperature [degC]`, `share` of the time, `hours [h]` a
    #: year, `energy [J]` of a mean roller, both rows, and the sums of criteria, such as `wear [m]`
    #: of the worse row, by name and unit.
    bins: pd.DataFrame
    notes: tuple[str, ...]
    #: Where the winds and temperatures come from.
    source: str
    #: Means of the oil in degC: production, standing.
    mean_production: float
    mean_standing: float

    def ratio(self, quantity: str, over: str = "fixed", design: int = 0) -> float:
        """Real value of a quantity over that at 35 degC, or `over` another column of the table."""
        of_quantity = self.table["quantity"] == quantity
        of = self.table[of_quantity].iloc[design]
        return float(of["real"] / of[over])


def real_year(
    scada: Scada | str | PathLike[str],
    study: xr.Dataset | str | PathLike[str],
    *,
    wind: Weibull | None = None,
    allow_short: bool = False,
) -> RealYear:
    """Compute a year of each design at the winds and oil temperatures that a turbine measured.

        year = 8766 h Σ_w,T p(w, T) rate(w, T) + Σ events at their temperature

    p(w, T) is the share of the rows with data in which the rotor turns in a bin of wind speed and
    temperature; rate(w, T) the mean over the runs of the bin, each between its temperatures as
    `macroslip.study.over_temperature` has it. Events of the study's weights take their time first,
    and production the rest. Idling and parked events have the temperatures of rows in which the
    rotor stands, other events the mean one of rows in which it turns. Standing wears nothing.

    Parameters
    ----------
    scada : Scada or path
        From `Scada.read`, or its YAML file.
    study : xarray.Dataset or path
        From `open_study`, or its folder: load cases over `lubricant.at`, four temperatures or more
        that span those of the bearing, up to 5 K less on either side.
    wind : Weibull, optional
        Distribution of the wind speed in place of the measured one; the temperatures at each wind
        speed stay.
    allow_short : bool
        Whether less than 30 days may stand for a year.

    Returns
    -------
    RealYear

    Raises
    ------
    InputError
        If the record is shorter than 30 days, or the study has too few temperatures or does not
        span those of the record.
    """
    if not isinstance(scada, Scada):
        scada = Scada.read(scada)
    if not isinstance(study, xr.Dataset):
        study = open_study(study)
    if not allow_short:
        _check_length(scada)
    weighting = _weighting(study)
    runs = RunsOverTemperature.of(study)
    joint = JointShares.of(scada, _centres(study, weighting), weighting.width)
    measured = TemperatureShares.measured(joint)
    notes = [*scada.notes, *check_span(measured, runs.temperatures)]
    winds = wind or BinProbabilities(joint.wind_shares())
    aggregation = Aggregation(
        Year(winds, weighting.events or {}), 1.0, weighting.field, weighting.width
    )
    mean = joint.mean_turning + joint.oil_offset
    standing = joint.mean_idle + joint.oil_offset
    standing = standing if np.isfinite(standing) else mean
    cases = {
        "real": measured,
        "at_mean": measured.at(mean, standing),
        "fixed": measured.at(FIXED, FIXED),
        "oil_cooler": measured.warmer(-OFFSET),
        "oil_warmer": measured.warmer(OFFSET),
    }
    collapsed = {
        name: runs.mean(shares, weighting.field, weighting.width) for name, shares in cases.items()
    }
    years = {name: year(means, aggregation) for name, means in collapsed.items()}
    notes += designs(years["real"])[1]
    bins = aggregation.bins(collapsed["real"])
    of_bins = bins.probabilities(aggregation.weights)[np.isfinite(bins.centres)]
    share_at_wind = []
    for speed in joint.wind.tolist():
        share_at_wind.append(measured.of_wind(speed, bins.width)[:-1])
    rates = _rates(runs, joint.oil_temperatures, bins, years["real"])
    names = design_names(years["real"])
    return RealYear(
        table=_table(years, _seeds(collapsed["real"], aggregation)),
        bins=_bins(rates, joint, of_bins[:, None] * np.array(share_at_wind), names),
        notes=tuple(notes),
        source=joint.source,
        mean_production=mean - ZERO_CELSIUS,
        mean_standing=standing - ZERO_CELSIUS,
    )


def _check_length(scada: Scada) -> None:
    """Refuse a record that is too short to stand for a year."""
    if scada.hours < _SHORT:
        raise InputError(
            f"the record has {scada.hours / 24.0:.3g} days with data",
            allowed="30 days or more",
            remedy="Less tells nothing of a year; --allow-short takes it all the same.",
        )


def _weighting(study: xr.Dataset) -> Weighting:
    """Field, width and events of the study's weights; those by default where it has none."""
    stored = stored_weighting(study)
    if stored is None:
        return Weighting(scale=1.0, shape=2.0)
    return stored


def _centres(study: xr.Dataset, weighting: Weighting) -> np.ndarray:
    """Middles of the bins of wind speed of a study's production [m/s]."""
    is_wind = events_of_runs(study) == ""
    labels = study[weighting.field].values.astype(float)
    speeds = labels[is_wind]
    if not speeds.size:
        raise InputError("the study has no runs of production, only events", where="--study")
    return np.unique(bin_centres(speeds, weighting.width))


def _table(years: Mapping[str, xr.Dataset], seeds: Mapping[str, np.ndarray]) -> pd.DataFrame:
    """Numbers of the years side by side."""
    columns = {}
    for name, annual in years.items():
        columns[name], _ = designs(annual)
    names = design_names(years["real"])
    factors = {name: criterion.factor for name, criterion in OF_NUMBER.items()}
    lines = []
    for group in columns["real"].index:
        for quantity, column in DESIGN_COLUMNS.items():
            if quantity not in columns["real"]:
                continue
            line = {"design": names[group], "quantity": quantity, "unit": column.unit}
            for name, frame in columns.items():
                line[name] = float(frame.loc[group, quantity])
            scatter = np.nan
            if quantity in seeds:
                scatter = 100.0 * seeds[quantity][group]
            line["seeds [%]"] = scatter
            line["factor"] = factors.get(quantity, np.nan)
            lines.append(line)
    table = pd.DataFrame(lines)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratios = {f"real_over_{name}": table["real"] / table[name] for name in ("fixed", "at_mean")}
    order = ["design", "quantity", "unit", "real", "at_mean", "fixed", *ratios]
    order += ["oil_cooler", "oil_warmer", "seeds [%]", "factor"]
    return table.assign(**ratios).reindex(columns=order)


def _seeds(study: xr.Dataset, aggregation: Aggregation) -> dict[str, np.ndarray]:
    """Relative standard error of a year by the scatter of runs that share a bin, by group."""
    bins = aggregation.bins(study)
    probabilities = bins.probabilities(aggregation.weights)
    share = probabilities[None, :, None]
    powers = {"energy": study.energy_mean / study.window_length}
    for yearly in SUMMED:
        if yearly.run_name in study:
            powers[yearly.name] = study[yearly.run_name]
    errors: dict[str, np.ndarray] = {}
    for name, rate in powers.items():
        values = rate.transpose("case", "row").values
        mean, runs, spread = bins.spreads(values)
        several = runs > 1
        with np.errstate(invalid="ignore", divide="ignore"):
            of_bins = share**2 * spread / (runs - 1.0)
            variance = np.where(several, of_bins, 0.0)
            total = np.nansum(share * mean, axis=1)
            relative = np.sqrt(variance.sum(axis=1)) / total
        worse = total.argmax(axis=1)
        groups = np.arange(worse.size)
        chosen = relative[groups, worse]
        is_known = several.any(axis=(1, 2))
        errors[name] = np.where(is_known, chosen, np.nan)
    return errors


def _bins(
    rates: Mapping[str, np.ndarray], joint: JointShares, share: np.ndarray, names: list[str]
) -> pd.DataFrame:
    """Parts of production's energy and damage over wind speed and temperature.

    Parameters
    ----------
    rates : mapping
        Rate of energy [W] and of each criterion, by the column of its sum, of each design, shape
        (designs, winds, temperatures).
    joint : JointShares
    share : ndarray, shape (winds, temperatures)
        Share of the time of production.
    names : list of str
        Names of the designs.
    """
    celsius = joint.oil_temperatures - ZERO_CELSIUS
    winds, at = np.meshgrid(joint.wind, celsius, indexing="ij")
    parts = []
    for group, name in enumerate(names):
        produced = {
            "design": name,
            "state": "turning",
            "wind_speed [m/s]": winds.ravel(),
            "oil_temperature [degC]": at.ravel(),
            "share": share.ravel(),
            "hours [h]": HOURS_A_YEAR * share.ravel(),
        }
        for column, rate in rates.items():
            part = YEAR * share * rate[group]
            produced[column] = part.ravel()
        stood = {
            "design": name,
            "state": "idle",
            "oil_temperature [degC]": at[0],
            "share": joint.idle,
            "hours [h]": HOURS_A_YEAR * joint.idle,
        }
        parts += [pd.DataFrame(produced), pd.DataFrame(stood)]
    table = pd.concat(parts, ignore_index=True)
    return table.query("share > 0").reset_index(drop=True)


def _rates(
    runs: RunsOverTemperature, at: np.ndarray, bins: Binning, real: xr.Dataset
) -> dict[str, np.ndarray]:
    """Power [W] of a mean roller, both rows, and rates of criteria in production.

    By the column of their sums, shape (designs, winds, temperatures). Rates are of both rows, or of
    the row that is worse in the year, as the criterion is drawn together.
    """
    windy = np.isfinite(bins.centres)
    first_runs = runs.runs[:, 0]
    lengths = runs.study["window_length"].values[first_runs]
    power_of_runs = runs.values("energy_mean", at) / lengths[:, None, None]
    power, _, _ = bins.means(power_of_runs)
    rates = {ENERGY_COLUMN: power.sum(axis=-1)[:, windy]}
    for yearly in SUMMED:
        if yearly.run_name not in runs.study:
            rates[sum_column(yearly)] = np.full(rates[ENERGY_COLUMN].shape, np.nan)
            continue
        of_bins, _, _ = bins.means(runs.values(yearly.run_name, at))
        by_row = of_bins[:, windy]
        if yearly.drawn == "sum":
            rates[sum_column(yearly)] = by_row.sum(axis=-1)
            continue
        of_year = real[yearly.name].sum("bin").transpose("group", "row")
        worse = of_year.values.argmax(axis=1)
        chosen = [by_row[k, ..., row] for k, row in enumerate(worse)]
        rates[sum_column(yearly)] = np.stack(chosen)
    return rates


def sum_column(yearly: Yearly) -> str:
    """Heading of a criterion's sum in `RealYear.bins`: name and unit."""
    return f"{yearly.name} [{yearly.year_unit}]"
