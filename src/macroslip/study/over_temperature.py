"""Runs of a study at several oil temperatures, interpolated and averaged over time.

Runs that differ in the temperature of the oil alone are a series. Between its temperatures the
logarithm of what grows by factors (energies, powers, wear, e_a, lives) follows a monotone cubic
(PCHIP), since viscosity is nearly exponential; shares and counts are interpolated linearly:

* F. N. Fritsch and J. Butland, "A Method for Constructing Local Monotone Piecewise Cubic
  Interpolants", SIAM J. Sci. Stat. Comput. 5 (1984) 300-304, doi:10.1137/0905021.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import xarray as xr
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq

from macroslip.constants import MOST_BEYOND, ZERO_CELSIUS
from macroslip.errors import InputError
from macroslip.scada.bins import bin_centres
from macroslip.study.labels import (
    events_of_runs,
    labels_over,
    of_runs_and_rows,
    stored_study,
)
from macroslip.study.summary import OVER_TEMPERATURE, OverTemperature
from macroslip.study.temperature_shares import TemperatureShares
from macroslip.study.weights import LossOfHeat, Weighting, binned, stored_weighting

#: Attribute of a study whose cases are means over temperatures of the oil, and what it then lacks.
MIXED = "mixed_temperatures"
NOT_MIXED = (
    "The weights combine several oil temperatures, and single orbits and places of a surface are not "
    "interpolated between temperatures: exceedance, cycles of the load and maps are left out."
)
#: Label of the temperature of the oil at the inlets.
LABEL = "lubricant.at"
#: Fewest temperatures of a series.
FEWEST = 4
#: Share of the time that may lie further outside, as single rows of a sensor do.
_SHARE_OUTSIDE = 1e-3
#: Labels that are the same, or of no use, in all runs of a series.
_OF_A_RUN = ("case", "run", "key", "outcome", "reason", LABEL)


@dataclass(frozen=True)
class RunsOverTemperature:
    """Runs of a study grouped into series that differ in the oil temperature alone."""

    study: xr.Dataset
    temperatures: np.ndarray  #: Of every series, shape (temperatures,), ascending [K]
    runs: np.ndarray  #: Number of the run of each series and temperature

    @classmethod
    def of(cls, study: xr.Dataset) -> RunsOverTemperature:
        """Sort the runs of `open_study`'s dataset into series.

        Raises InputError if the study does not vary `lubricant.at` over `FEWEST` temperatures or
        more, or not all its runs over the same.
        """
        if LABEL not in study.coords:
            check_varied(0)
        label = study[LABEL]
        unit = label.attrs.get("units", "K")
        at = kelvin(label.values.astype(float), unit)
        names = [name for name in labels_over(study) if name not in _OF_A_RUN]
        number = np.zeros(at.size, dtype=int)
        if names:
            labels = study[names].reset_coords()[names].to_dataframe()
            designs = labels.groupby(names, sort=False, dropna=False)
            number = designs.ngroup().to_numpy()
        temperatures = np.unique(np.round(at, 6))
        ordered = []
        for k in range(number.max() + 1):
            series = np.flatnonzero(number == k)
            rising = np.argsort(at[series], kind="stable")
            ordered.append(series[rising])
        whole = all(
            runs.size == temperatures.size and np.allclose(at[runs], temperatures, atol=1e-5)
            for runs in ordered
        )
        check_varied(temperatures.size)
        if not whole:
            raise InputError(
                "not all runs of the study have the same temperatures of the oil",
                where=f"variations.{LABEL}",
                allowed=_ALLOWED,
                remedy=_REMEDY,
            )
        return cls(study, temperatures, np.array(ordered))

    @cached_property
    def first_runs(self) -> xr.Dataset:
        """The run of each series at its lowest temperature."""
        first = self.runs[:, 0]
        return self.study.isel(case=first)

    def values(self, name: str, at: np.ndarray) -> np.ndarray:
        """A variable over (case) or (case, row) of each series at temperatures.

        Parameters
        ----------
        name : str
            Variable of the study.
        at : ndarray, shape (n,)
            Temperatures [K]; outside the runs the value at the nearest one holds.

        Returns
        -------
        ndarray, shape (series, n) or (series, n, rows)
            NaN where a run of the series has no value.
        """
        variable = self.study[name].transpose("case", ...).values.astype(float)
        known = np.moveaxis(variable[self.runs], 1, 0)
        coldest = self.temperatures[0]
        warmest = self.temperatures[-1]
        held = np.clip(at, coldest, warmest)
        by_factors = _over_temperature(name).by_factors
        of_series = interpolated(self.temperatures, known, held, by_factors=by_factors)
        return np.moveaxis(of_series, 0, 1)

    def balance(self, loss: LossOfHeat, field: str, width: float) -> dict[float, float]:
        """Oil temperature [K] of each wind-speed bin at which friction power equals heat loss.

        The mean friction power of the runs of the bin P(T) is G (T − T_ambient) there.

        Parameters
        ----------
        loss : LossOfHeat
            G [W/K] and T_ambient [K].
        field : str
            Label of the wind speed.
        width : float
            Width of a bin.

        Returns
        -------
        dict
            By the middle of the bin.

        Raises
        ------
        InputError
            If a balance lies outside the temperatures of the runs.
        """
        is_wind = events_of_runs(self.first_runs) == ""
        centres = bin_centres(self.first_runs[field].values, width)
        temperatures = {}
        for centre in np.unique(centres[is_wind]).tolist():
            inside = is_wind & (centres == centre)
            of_series = self.study["friction_power"].values[self.runs[inside]]
            powers = of_series.mean(axis=0)
            temperatures[centre] = self._balance_of(powers, loss, f"{centre:g}")
        return temperatures

    def _balance_of(self, powers: np.ndarray, loss: LossOfHeat, centre: str) -> float:
        """Oil temperature [K] at which friction powers [W] of the runs equal the heat loss."""

        def excess(at: float) -> float:
            known = interpolated(self.temperatures, powers, np.array([at]), by_factors=True)
            lost = loss.conductance * (at - loss.ambient)
            return float(known[0]) - lost

        low = float(self.temperatures[0])
        high = float(self.temperatures[-1])
        if not np.isfinite(powers).all():
            raise InputError(
                f"a run of the bin at {centre} has no friction power",
                where="weights.temperature.balance",
                allowed="runs without failure",
            )
        if not excess(low) >= 0.0 >= excess(high):
            where = "below" if excess(low) < 0.0 else "above"
            raise InputError(
                f"the balance of the bin at {centre} lies {where} the temperatures of the runs, "
                f"{_celsius(low)} to {_celsius(high)} degC",
                where="weights.temperature.balance",
                allowed="runs that span the balance of each bin",
                remedy="Run the load cases at further temperatures, or check conductance and "
                "ambient.",
            )
        return float(brentq(excess, low, high, xtol=1e-9))

    def mean(self, shares: TemperatureShares, field: str, width: float) -> xr.Dataset:
        """Average each series over the time at each oil temperature; one case a series.

        Parameters
        ----------
        shares : TemperatureShares
            How long each bin of wind speed and each event is at each temperature.
        field : str
            Label of the wind speed.
        width : float
            Width of a bin.

        Returns
        -------
        xarray.Dataset
            As the study, without the label `lubricant.at` and without what is not of the summary.
        """
        share = self._shares(shares, field, width)
        at = shares.temperatures
        data = {}
        for name, variable in of_runs_and_rows(self.study).data_vars.items():
            if "case" not in variable.dims:
                continue
            values = self.values(str(name), at)
            dims = ("case", "row") if values.ndim == 3 else ("case",)
            means = _mean(str(name), values, share)
            data[name] = (dims, means, dict(variable.attrs))
        outcome = self.study["outcome"].values.astype(str)[self.runs]
        worst = []
        for outcomes in outcome:
            failures = outcomes[outcomes != "completed"]
            worst.append(failures[0] if failures.size else "completed")
        kept = of_runs_and_rows(self.first_runs.drop_vars([LABEL, *self.study.data_vars]))
        coordinates = {
            "outcome": ("case", np.array(worst, dtype=object), dict(self.study.outcome.attrs)),
            "case": ("case", np.arange(len(worst)), dict(self.study["case"].attrs)),
        }
        if "key" in kept.coords:
            empty = np.full(len(worst), "", dtype=object)
            coordinates["key"] = ("case", empty, dict(self.study["key"].attrs))
        content = stored_study(self.study)
        variations = content.get("variations") or {}
        variations.get("grid", {}).pop(LABEL, None)
        attributes = {"study": json.dumps(content), MIXED: 1}
        return kept.assign_coords(coordinates).assign(data).assign_attrs(attributes)

    def _shares(self, shares: TemperatureShares, field: str, width: float) -> np.ndarray:
        """Share of the time of each series at each temperature, shape (series, temperatures)."""
        first = self.first_runs
        centres = bin_centres(first[field].values, width)
        events = events_of_runs(first)
        rows = []
        for event, centre in zip(events, centres, strict=True):
            row = shares.of_event(event) if event else shares.of_wind(centre, width)
            rows.append(row)
        return np.array(rows)


_ALLOWED = (
    f"variations: {{grid: {{{LABEL}: {{values: [5, 20, 35, 50], unit: degC}}}}}}, {FEWEST} or more"
)
_REMEDY = "Run a study of these load cases at temperatures that span those of the turbine."


def check_varied(count: int) -> None:
    """Refuse runs at fewer than `FEWEST` temperatures of the oil."""
    if count < FEWEST:
        raise InputError(
            f"the runs of the study have {count or 'no'} temperatures of the oil of their own",
            where=f"variations.{LABEL}",
            allowed=_ALLOWED,
            remedy=_REMEDY,
        )


def kelvin(values: np.ndarray, unit: str) -> np.ndarray:
    """Temperatures in K or degC as temperatures in K.

    Examples
    --------
    >>> kelvin(np.array([35.0]), "degC").tolist()
    [308.15]
    """
    return values + ZERO_CELSIUS if unit == "degC" else values


def interpolated(
    temperatures: np.ndarray, known: np.ndarray, at: np.ndarray, *, by_factors: bool
) -> np.ndarray:
    """Interpolate values between temperatures: PCHIP of the logarithm, or linear.

    Parameters
    ----------
    temperatures : ndarray, shape (n,)
        Ascending [K].
    known : ndarray, shape (n, ...)
        Values at these.
    at : ndarray, shape (m,)
        Temperatures within them.
    by_factors : bool
        True for the logarithm; a series with a value that is not above 0 is linear all the same.

    Returns
    -------
    ndarray, shape (m, ...)
        NaN where a value of the series is.

    Examples
    --------
    >>> wear = np.array([1.0, 2.0, 4.0, 8.0])
    >>> interpolated(np.array([0.0, 5.0, 10.0, 15.0]), wear, np.array([7.5]), by_factors=True).round(3)
    array([2.828])
    """
    flat = known.reshape(known.shape[0], -1)
    result = np.full((at.size, flat.shape[1]), np.nan)
    complete = np.isfinite(flat).all(axis=0)
    is_positive = (flat > 0.0).all(axis=0)
    logarithmic = complete & is_positive & by_factors
    if logarithmic.any():
        logarithms = np.log(flat[:, logarithmic])
        cubic = PchipInterpolator(temperatures, logarithms, axis=0)
        result[:, logarithmic] = np.exp(cubic(at))
    for column in np.flatnonzero(complete & ~logarithmic):
        result[:, column] = np.interp(at, temperatures, flat[:, column])
    return result.reshape(at.size, *known.shape[1:])


def _mean(name: str, values: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Mean of values (series, temperatures, ...) by the share of time; extremes as such."""
    inner_axes = (1,) * (values.ndim - 2)
    weight = share.reshape(share.shape + inner_axes)
    kind = _over_temperature(name).mean
    if kind == "largest":
        used = np.where(weight > 0.0, values, -np.inf)
        return used.max(axis=1)
    if kind == "least":
        used = np.where(weight > 0.0, values, np.inf)
        return used.min(axis=1)
    if kind == "life":
        with np.errstate(divide="ignore"):
            return 1.0 / (weight / values).sum(axis=1)
    return (weight * values).sum(axis=1)


def _over_temperature(name: str) -> OverTemperature:
    return OVER_TEMPERATURE.get(name, OverTemperature())


def weighted_study(study: xr.Dataset) -> xr.Dataset:
    """Average a study over the oil temperatures of its weights; unchanged where they have none.

    Raises InputError if the weights need temperatures that the runs do not span.
    """
    stored = stored_weighting(study)
    if stored is not None and stored.balance is not None:
        return _at_balance(study, stored, stored.balance)
    if stored is None or stored.temperatures is None:
        return study
    runs = RunsOverTemperature.of(study)
    check_span(stored.temperatures, runs.temperatures)
    return runs.mean(stored.temperatures, stored.field, stored.width)


def _at_balance(study: xr.Dataset, weighting: Weighting, loss: LossOfHeat) -> xr.Dataset:
    """Take each wind-speed bin of each design at the oil temperature of its own heat balance."""
    at_one_temperature = study.drop_vars(LABEL, errors="ignore")
    designs = binned(at_one_temperature, weighting.field, weighting.width)
    means = []
    for number in range(len(designs.groups)):
        runs_of_design = np.flatnonzero(designs.group == number)
        runs = RunsOverTemperature.of(study.isel(case=runs_of_design))
        by_wind = runs.balance(loss, weighting.field, weighting.width)
        shares = weighting.at_each_wind(by_wind)
        means.append(runs.mean(shares, weighting.field, weighting.width))
    together = xr.concat(means, "case", combine_attrs="override")
    number_of_case = np.arange(together.sizes["case"])
    attributes = dict(study["case"].attrs)
    return together.assign_coords(case=("case", number_of_case, attributes))


def check_span(shares: TemperatureShares, temperatures: np.ndarray) -> list[str]:
    """Check that the temperatures of runs [K] span those of the weights; note those beyond them.

    Temperatures of a measured year may lie up to `MOST_BEYOND` outside, where the nearest run holds, and
    one thousandth of the time anywhere; given temperatures may not.

    Raises InputError otherwise.
    """
    low = temperatures[0]
    high = temperatures[-1]
    lasting = shares.lasting
    margin = MOST_BEYOND if shares.is_measured else 1e-6
    is_colder = shares.temperatures < low - margin
    is_warmer = shares.temperatures > high + margin
    outside = is_colder | is_warmer
    most = _SHARE_OUTSIDE if shares.is_measured else 0.0
    if lasting[outside].sum() > most:
        used = shares.temperatures[lasting > 0.0]
        raise InputError(
            f"the oil is at {_celsius(used.min())} to {_celsius(used.max())} degC, and the runs "
            f"are at {_celsius(low)} to {_celsius(high)} degC",
            where="weights",
            allowed=f"runs that span it{f', or up to {MOST_BEYOND:g} K less' if shares.is_measured else ''}",
            remedy=_REMEDY,
        )
    is_held = (shares.temperatures < low) | (shares.temperatures > high)
    held = lasting[is_held].sum()
    if not held > 0.0:
        return []
    return [
        f"In {100.0 * held:.2g} % of the time the oil is outside the runs, which are at "
        f"{_celsius(low)} to {_celsius(high)} degC: there the nearest run holds."
    ]


def _celsius(temperature: float) -> str:
    return f"{temperature - ZERO_CELSIUS:.4g}"
