"""Heat of a main bearing from ten-minute means: fits of its balance, their doubts, and its index."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pandas as pd

from macroslip.arrays import BoolArray, FloatArray
from macroslip.constants import ZERO_CELSIUS
from macroslip.errors import InputError
from macroslip.scada.filters import TURNING
from macroslip.scada.friction_table import FrictionTable
from macroslip.scada.heat_balance import AIR, PARAMETERS, Balance, HeatFit, fit_heat
from macroslip.scada.heat_index import PERIODS, cusum, index_over
from macroslip.scada.heat_models import FRICTION, RISE, SKF, SPEED, heat_models
from macroslip.scada.windows import unbroken_windows

if TYPE_CHECKING:
    from macroslip.scada.reader import Scada

#: Windows that a fit needs, and how many of them at standstill.
LEAST_WINDOWS = 200
LEAST_IDLE = 30
#: Least span of the bearing's temperature in the reference [K], without 5 % at either end.
LEAST_SPAN = 8.0
#: Share of the mean heat above which a heat that does not go with the model is marked, and
#: difference between the halves of the reference from which on they are.
MOST_DRIFT = 1.0 / 3.0
MOST_CHANGE = 0.10
#: Means of a window, and their units.
WINDOW_UNITS = {"wind_speed": "m/s", "rotor_speed": "rad/s", "bearing_temperature": "K"}
#: Columns of the tables of a fit and of an index.
FIT_COLUMNS = ("model", "supply", "parameter", "value", "error", "unit", "residual", "mark")
INDEX_COLUMNS = (
    "model", "supply", "period", "start", "windows", "r", "error", "r_sibling", "cusum",
    "cusum_sibling",
)  # fmt: skip


class Indexed(NamedTuple):
    """A model with its measured and expected heat in each window in which the rotor turns."""

    model: str
    supply: str
    start: pd.DatetimeIndex
    measured: FloatArray
    expected: FloatArray


@dataclass(frozen=True, eq=False)
class BearingHeat:
    """Heat of a main bearing: every model fitted to the reference, and its index over time."""

    #: Fits of all models in the order of `heat_models`
    fits: tuple[HeatFit, ...]
    #: Fit of computed friction with seals by the supply that leaves the least residual; the index
    #: and what is said of the bearing follow from it
    chosen: HeatFit
    #: A line a model and constant: `model`, `supply`, `parameter`, `value`, standard `error`,
    #: `unit`, `residual` [K/h], and `mark`, what is doubtful
    fit: pd.DataFrame
    #: A line a model and period: `model`, `supply`, `period`, `start` (UTC), `windows`, index `r`
    #: and its `error`, `r_sibling`, index over that of the sibling, `cusum` and `cusum_sibling` of
    #: days [-]
    index: pd.DataFrame
    #: A line a window: `start` (UTC), means `wind_speed` [m/s], `rotor_speed` [rad/s],
    #: `bearing_temperature` [K], `rate` dT/dt [K/h], number of the `block` of three days, and
    #: whether it is of the `reference`, and the rotor is `turning`
    windows: pd.DataFrame
    marks: tuple[str, ...]  #: What is doubtful, a sentence each
    notes: tuple[str, ...]  #: What a reader has to know, a sentence each

    def index_by(self, period: str) -> pd.DataFrame:
        """The index by `day`, `week` or `month`, of every model."""
        is_period = self.index["period"] == period
        return self.index.loc[is_period]


def bearing_heat(
    scada: Scada, friction: FrictionTable, sibling: Scada | None = None
) -> BearingHeat:
    """Fit the heat balance of a main bearing to its ten-minute means, and follow its heat in time.

    Parameters
    ----------
    scada : Scada
    friction : FrictionTable
        Of its bearing, or of one that stands for it.
    sibling : Scada, optional
        Another bearing or turbine that shares weather and wind; its index divides the bearing's.

    Returns
    -------
    BearingHeat

    Raises
    ------
    InputError
        If there is no temperature of the air, there are too few windows, or the temperatures span
        too little or lie outside the friction table.
    """
    record = _record(scada)
    analysed = _analysed(scada, record, friction)
    fits = analysed.fits
    chosen = _chosen(fits, analysed)
    indexed = list(_indexed(analysed, chosen))
    index = _index_table(indexed)
    if sibling is not None:
        other = _analysed(sibling, _record(sibling), friction)
        same = fit_of(other.fits, FRICTION, chosen.model.supply)
        index_of_sibling = _index_table(list(_indexed(other, same)))
        index = _over_sibling(index, index_of_sibling)
    table = _fit_table(fits, analysed)
    marks = (*_marks(chosen, analysed), *_change_of_halves(chosen, analysed))
    notes = (*scada.notes, *friction.notes, *_notes(scada))
    index = index.reindex(columns=list(INDEX_COLUMNS))
    windows = _window_table(analysed)
    return BearingHeat(fits, chosen, table, index, windows, marks, notes)


class _Analysed(NamedTuple):
    """Windows of a record and the fits of all models to them."""

    record: pd.DataFrame
    balance: Balance
    reference: BoolArray
    turning: BoolArray
    fits: tuple[HeatFit, ...]


def _record(scada: Scada) -> pd.DataFrame:
    """Rows of the record in the order of time, with a column `used`."""
    record = scada.data.sort_index(kind="stable")
    is_used = np.asarray(record["filter"] == "", dtype=bool)
    record = record.assign(used=is_used)
    if not any(name in record and bool(record[name].notna().any()) for name in AIR):
        raise InputError(
            "there is no temperature of the air around the bearing",
            where="columns",
            allowed="nacelle_temperature, ambient_temperature, or both",
            remedy="Name the column of one of them: what the bearing loses goes with its excess "
            "over the air.",
        )
    return record


def _analysed(scada: Scada, record: pd.DataFrame, friction: FrictionTable) -> _Analysed:
    """Windows of the record and all fits; InputError if they cannot support a fit."""
    described = scada.description
    time = pd.DatetimeIndex(record.index)
    windows = unbroken_windows(time, record["used"], record["jump"], scada.step)
    rated = described.rated.rotor_speed
    speed = np.abs(record["rotor_speed"].to_numpy(float))
    start = time[windows.first]
    reference = _in_reference(start, described.reference)
    slowest = TURNING * rated
    turning = windows.mean(speed) > slowest
    idle = (speed <= slowest)[windows.rows].all(axis=1)
    kelvin = windows.mean(record["bearing_temperature"].to_numpy(float))
    _check_windows(reference, idle, kelvin)
    used = record["used"].to_numpy()
    friction.check_span(kelvin + described.oil_offset)
    # Rows that are not used enter no window; numbers keep formulas from NaN.
    replaced = {}
    for name in ("wind_speed", "rotor_speed", "bearing_temperature"):
        median = record.loc[used, name].median()
        replaced[name] = record[name].where(used, median)
    known = record.assign(**replaced)
    balance = Balance.of(record, windows)
    models = heat_models(known, friction, rated, described.oil_offset)
    fits = tuple(fit_heat(balance, model, reference) for model in models)
    return _Analysed(record, balance, reference, turning, fits)


def _in_reference(start: pd.DatetimeIndex, period: tuple | None) -> BoolArray:
    """True for windows that begin in the reference; for all where there is none."""
    if period is None:
        return np.ones(len(start), dtype=bool)
    first, end = period
    return np.asarray((start >= first) & (start < end))


def _check_windows(reference: BoolArray, idle: BoolArray, kelvin: FloatArray) -> None:
    """Refuse a reference from which the balance cannot be fitted."""
    count = int(reference.sum())
    standing = int((reference & idle).sum())
    where = "reference"
    if count < LEAST_WINDOWS:
        raise InputError(
            f"the reference has {count} windows of two hours without break",
            where=where,
            allowed=f"{LEAST_WINDOWS} and more",
            remedy="Choose a longer reference, or look with macroslip scada inspect at what drops "
            "rows.",
        )
    if standing < LEAST_IDLE:
        raise InputError(
            f"the reference has {standing} windows at standstill or idling, by which the loss of "
            "heat is distinguished from the friction",
            where=where,
            allowed=f"{LEAST_IDLE} and more",
            remedy="Choose a longer reference.",
        )
    in_reference = kelvin[reference]
    low, high = np.percentile(in_reference, [5.0, 95.0])
    if high - low < LEAST_SPAN:
        raise InputError(
            f"the bearing is at {low - ZERO_CELSIUS:.1f} to {high - ZERO_CELSIUS:.1f} degC in nine "
            "tenths of the reference, so that the effect of temperature cannot be fitted",
            where=where,
            allowed=f"a span of {LEAST_SPAN:g} K and more",
            remedy="Choose a reference with warm and cold months.",
        )


def fit_of(fits: Sequence[HeatFit], model: str, supply: str) -> HeatFit:
    """The fit of a model with a supply of oil."""
    return next(fit for fit in fits if (fit.model.name, fit.model.supply) == (model, supply))


def _chosen(fits: Sequence[HeatFit], analysed: _Analysed) -> HeatFit:
    """Of computed friction with seals the least residual, those without a mark first."""
    own = [fit for fit in fits if fit.model.name == FRICTION]
    return min(own, key=lambda fit: (bool(_marks(fit, analysed)), fit.residual))


def _marks(fit: HeatFit, analysed: _Analysed) -> tuple[str, ...]:
    """Doubts about a fit, a sentence each."""
    of = fit.model.title
    marks = []
    if fit.model.has_capacity and not fit.values["capacity"] > 0.0:
        marks.append(f"{of}: the heat falls where the computed friction rises.")
    if fit.values.get("seal_torque", 0.0) < 0.0:
        marks.append(
            f"{of}: the torque of the seals is {fit.values['seal_torque']:.0f} ± "
            f"{fit.errors['seal_torque']:.0f} N m, below 0; the computed friction is too high or "
            "grows too little with load, as with a wrong supply."
        )
    for name in AIR.values():
        conductance = fit.values.get(name, 0.0)
        if conductance < 0.0:
            words = name.replace("_", " ")
            marks.append(f"{of}: the conductance {words} is {conductance:.3g} per hour, below 0.")
    inside = analysed.reference & analysed.turning
    mean_heat = float(fit.heat[inside].mean())
    drift = fit.values["drift"]
    heat_of_model = abs(mean_heat - drift)
    if abs(drift) > MOST_DRIFT * heat_of_model:
        marks.append(
            f"{of}: a heat of {fit.values['drift']:.2g} K/h depends neither on friction nor "
            f"on temperature, against {mean_heat:.2g} K/h in the mean while turning."
        )
    return tuple(marks)


def _change_of_halves(fit: HeatFit, analysed: _Analysed) -> tuple[str, ...]:
    """A sentence if the heat of the reference changes by more than a tenth from half to half."""
    start = analysed.balance.start
    inside = start[analysed.reference]
    first_window = inside[0]
    middle = first_window + (inside[-1] - first_window) / 2
    chosen = analysed.reference & analysed.turning
    first = chosen & np.asarray(start < middle)
    second = chosen & np.asarray(start >= middle)
    if not (first.any() and second.any()):
        return ()
    index_before = fit.left[first].sum() / fit.heat[first].sum()
    index_after = fit.left[second].sum() / fit.heat[second].sum()
    change = index_after / index_before - 1.0
    if abs(change) <= MOST_CHANGE:
        return ()
    return (
        f"The second half of the reference has {100.0 * change:+.0f} % of heat beside the first: "
        "the bearing, its lubrication or its cooling changed, so that no constants hold for both.",
    )


def _notes(scada: Scada) -> Iterator[str]:
    """Notes on the reference."""
    if scada.description.reference is None:
        yield (
            "No reference is given, so the whole record is its own: an index of 1 is its mean, and "
            "says nothing about whether the bearing was sound."
        )


def _fit_table(fits: Sequence[HeatFit], analysed: _Analysed) -> pd.DataFrame:
    """A line a model and constant."""
    lines = [
        (
            fit.model.name, fit.model.supply, name, fit.values[name], fit.errors[name],
            PARAMETERS[name][0], fit.residual, " ".join(_marks(fit, analysed)),
        )
        for fit in fits
        for name in fit.values
    ]  # fmt: skip
    table = pd.DataFrame(lines, columns=list(FIT_COLUMNS))
    table.attrs["units"] = {"residual": "K/h"}
    return table


def _indexed(analysed: _Analysed, chosen: HeatFit) -> Iterator[Indexed]:
    """The chosen fit, its rivals, and the regression of the rise."""
    turning = analysed.turning
    start = analysed.balance.start[turning]
    rivals = [fit for fit in analysed.fits if fit.model.name in (SKF, SPEED)]
    for fit in (chosen, *rivals):
        left = fit.left[turning]
        heat = fit.heat[turning]
        yield Indexed(fit.model.name, fit.model.supply, start, left, heat)
    rise, expected = _regressed_rise(analysed)
    yield Indexed(RISE, "", start, rise[turning], expected[turning])


def _means_of_windows(analysed: _Analysed, names: Iterable[str]) -> dict[str, FloatArray]:
    """Mean of each quantity of the record in each window."""
    means = {}
    for name in names:
        values = analysed.record[name].to_numpy(float)
        means[name] = analysed.balance.windows.mean(values)
    return means


def _window_table(analysed: _Analysed) -> pd.DataFrame:
    """A line a window with its means."""
    balance = analysed.balance
    means = _means_of_windows(analysed, WINDOW_UNITS)
    table = pd.DataFrame({"start": balance.start, **means, "rate": balance.rate})
    for name, units in {**WINDOW_UNITS, "rate": "K/h"}.items():
        table[name].attrs["units"] = units
    return table.assign(
        block=balance.blocks, reference=analysed.reference, turning=analysed.turning
    )


def _regressed_rise(analysed: _Analysed) -> tuple[FloatArray, FloatArray]:
    """Rise of the bearing above the air [K], and that of a regression on the reference.

    On speed, wind, its square, power and the air's temperature: what an operator would fit without
    any physics.
    """
    balance = analysed.balance
    air = next(name for name in reversed(list(AIR)) if AIR[name] in balance.excess)
    rise = balance.excess[AIR[air]]
    means = _means_of_windows(analysed, ("rotor_speed", "wind_speed", "power", air))
    means["wind_square"] = means["wind_speed"] ** 2
    constant = np.ones(rise.size)
    design = np.stack([constant, *means.values()], axis=1)
    scale = np.maximum(np.abs(design).max(axis=0), 1e-300)
    design = design / scale
    chosen = analysed.reference & analysed.turning
    solved, *_ = np.linalg.lstsq(design[chosen], rise[chosen], rcond=None)
    return rise, design @ solved


def _index_table(indexed: Sequence[Indexed]) -> pd.DataFrame:
    """Index of every model and period, with the cumulative sum of days."""
    tables = []
    for model, supply, start, measured, expected in indexed:
        for period in PERIODS:
            table = index_over(start, measured, expected, period)
            sums = np.nan
            if period == "day":
                sums = cusum(table["r"].to_numpy())
            tables.append(table.assign(model=model, supply=supply, period=period, cusum=sums))
    return pd.concat(tables, ignore_index=True)


def _over_sibling(index: pd.DataFrame, other: pd.DataFrame) -> pd.DataFrame:
    """The index with that over the sibling's, for periods that both have."""
    keys = ["model", "period", "start"]
    of_sibling = other[[*keys, "r"]]
    merged = index.merge(of_sibling, on=keys, how="left", suffixes=("", "_of_sibling"))
    merged["r_sibling"] = merged["r"] / merged["r_of_sibling"]
    merged["cusum_sibling"] = np.nan
    is_day = merged["period"] == "day"
    for _, days in merged[is_day].groupby("model"):
        sums = cusum(days["r_sibling"].to_numpy())
        merged.loc[days.index, "cusum_sibling"] = sums
    return merged.drop(columns="r_of_sibling")
