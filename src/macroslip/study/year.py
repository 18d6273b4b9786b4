"""Energy, damage and life of each design of a study over a year of wind speeds and events.

The year holds energy, entries, wear and mixed film.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from macroslip.constants import YEAR
from macroslip.loads.bundled import EVENTS
from macroslip.result.criteria import SUMMED, YEARLY
from macroslip.result.criteria.criterion import Yearly
from macroslip.study.aggregation import Aggregation
from macroslip.study.labels import CHOICES, labels_over
from macroslip.study.summary import CASE_VARIABLES, EXPONENTS, LIVES
from macroslip.study.weights import Binning, weighted
from macroslip.variables import ALWAYS, Variable, VariableTable


class DesignColumn(NamedTuple):
    """A number of a design in a year."""

    #: How rows and bins are drawn together, as in `macroslip.result.criteria.criterion.Yearly`
    drawn: str
    unit: str
    meaning: str


def _meaning_in_year(yearly: Yearly) -> str:
    """Meaning of a criterion's number of a wind speed or event, in words."""
    if yearly.drawn == "largest":
        return yearly.year_meaning
    return f"{yearly.year_meaning}: in a year"


_CELLS = ("group", "bin")
_BY_ROW = (*_CELLS, "row")
_GROUP = ("group",)
_KNOWN = "where the runs have it"
#: Number of a run behind every number that a year sums up, and behind those of which the largest
#: counts, by the name of the year's.
SUMS = {yearly.name: yearly.run_name for yearly in SUMMED}
LARGEST = {"peak": "peak_power_max"} | {
    yearly.name: yearly.run_name for yearly in YEARLY if yearly.drawn == "largest"
}
#: All variables of `year`.
YEAR_VARIABLES = VariableTable(
    "Year of each design, `macroslip.study.year.year`",
    (
        Variable("hours", ("bin",), "h", ALWAYS, "time in a year"),
        Variable("covered", (), "1", ALWAYS, "share of the year in the cases"),
        Variable("runs", _CELLS, "1", ALWAYS, "runs of the means"),
        Variable("left_out", _CELLS, "1", ALWAYS, "runs without a result for all rollers"),
        Variable("energy", _BY_ROW, "J", ALWAYS, "energy of a mean roller in a year"),
        Variable("per_hour", _BY_ROW, "J", ALWAYS, "energy of a mean roller in an hour of it"),
        Variable("total", ("group", "row"), "J", ALWAYS, "energy of a mean roller in a year"),
        Variable(
            "scatter",
            ("group", "row"),
            "1",
            ALWAYS,
            "standard error of it by the scatter of runs in a bin",
        ),
        Variable("peak", _BY_ROW, "W", ALWAYS, "largest frictional power of any run"),
        *(
            Variable(yearly.name, _BY_ROW, yearly.year_unit, _KNOWN, _meaning_in_year(yearly))
            for yearly in YEARLY
        ),
        *(
            Variable(name, _GROUP, "h", _KNOWN, f"{name.replace('_', ' ')}, by Palmgren and Miner")
            for name in LIVES
        ),
        *(
            CASE_VARIABLES[f"damage_equivalent_load_{exponent}"]._replace(dims=_GROUP, when=_KNOWN)
            for exponent in EXPONENTS
        ),
    ),
)
#: Columns of `designs`.
DESIGN_COLUMNS = {
    "energy": DesignColumn("sum", "J/year", "energy of a mean roller, both rows"),
    **{yearly.name: DesignColumn(yearly.drawn, yearly.unit, yearly.meaning) for yearly in YEARLY},
    "peak": DesignColumn("largest", "W", "largest power"),
}
#: Units of the numbers in the table of `designs`.
DESIGN_UNITS = {name: column.unit for name, column in DESIGN_COLUMNS.items()} | dict.fromkeys(
    LIVES, "h"
)


def year(study: xr.Dataset, aggregation: Aggregation) -> xr.Dataset:
    """Energies, criteria and lives of a year for each design of a study.

    Without weights all runs count alike, in one bin; the lifetime has no effect. Lives accumulate
    by the rule of Palmgren and Miner, 1/L = Σ p_b/L_b, and ranges of damage-equivalent loads, which
    are at 1 Hz, by S = (Σ p_b S_b^m)^(1/m), both with p_b as share of the time that the cases
    cover. Raises InputError if a label or a weight is wrong.

    Over (group, bin) there are `runs` in the means and `left_out`, those that failed or are
    missing; over bin `hours` of a year [h]. Over (group, bin, row): `energy` of a mean roller in a
    year [J], `per_hour` [J], `peak` and `entry_slip`, the largest power [W] and slide-roll ratio at
    an entry [1] of any run, and the sums of `SUMS`, as far as the results kept what they need;
    worst places of different bins are added, so `wear` and `pressure_slip` are upper bounds. Over
    (group, row): `total` [J] and its `scatter` [1], the standard error of the total from the
    scatter of runs that share a bin; NaN where no bin has two. Over group: the lives [h] and
    damage-equivalent loads [N]; NaN where a bin of some weight has none. `covered` [1].

    Examples
    --------
    Half a year with a life of 10 000 h and half with 30 000 h, both on the way to failure:

    >>> from macroslip.study.weights import BinProbabilities
    >>> summary = {"energy_mean": (("case", "row"), [[600.0], [1200.0]]),
    ...            "basic_life": ("case", [1e4, 3e4]), "window_length": ("case", [600.0, 600.0])}
    >>> labels = {name: ("case", ["-", "-"]) for name in ("bearing", "lubricant", "model")}
    >>> labels["wind_speed"] = ("case", [8.0, 12.0], {"units": "m/s"})
    >>> study = xr.Dataset(summary, labels | {"row": ["downwind"]})
    >>> of_year = year(study, Aggregation(BinProbabilities({8.0: 0.5, 12.0: 0.5})))
    >>> of_year.basic_life.item(), f"{of_year.total.item():.5g} J"
    (15000.0, '4.7336e+07 J')
    """
    bins = aggregation.bins(study)
    share = bins.probabilities(aggregation.weights)
    values = _energies(study, bins, share) | _criteria(study, bins, share)
    values |= _lives(study, bins, share / share.sum())
    values["hours"] = share * YEAR / 3600.0
    values["covered"] = share.sum()
    coordinates = bins.coordinates(study) | {"row": study.row}
    is_weighted = aggregation.weights is not None
    return xr.Dataset(YEAR_VARIABLES.put(values), coordinates, {"weighted": int(is_weighted)})


def _by_row(study: xr.Dataset, name: str) -> np.ndarray:
    return study[name].transpose("case", "row").values


def _in_a_year(rates: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Sums over a year of rates (group, bin, row); a bin of no weight needs no run."""
    weight = share[:, None]
    with np.errstate(invalid="ignore"):
        return np.where(weight > 0.0, YEAR * weight * rates, 0.0)


def _energies(study: xr.Dataset, bins: Binning, share: np.ndarray) -> dict[str, Any]:
    """Energies of a mean roller with their scatter, and numbers of runs."""
    lengths = study.window_length.values
    power = _by_row(study, "energy_mean") / lengths[:, None]
    _, runs, left_out = bins.means(power)
    mean, runs_of_rows, spread = bins.spreads(power)
    energy = _in_a_year(mean, share)
    total = energy.sum(axis=1)
    several = runs_of_rows > 1
    weight = share[:, None]
    with np.errstate(invalid="ignore", divide="ignore"):
        variance = spread / (runs_of_rows - 1.0)
        of_bins = np.where(several, (YEAR * weight) ** 2 * variance, 0.0)
        scatter = np.sqrt(of_bins.sum(axis=1)) / total
    counts = several & (weight > 0.0)
    has_scatter = np.any(counts, axis=1)[:, 0]
    scatter[~has_scatter] = np.nan
    return {
        "runs": runs,
        "left_out": left_out,
        "energy": energy,
        "per_hour": 3600.0 * mean,
        "total": total,
        "scatter": scatter,
    }


def _criteria(study: xr.Dataset, bins: Binning, share: np.ndarray) -> dict[str, Any]:
    """Sums of criteria over a year, and the largest values of any run."""
    values: dict[str, Any] = {}
    for name, of_run in LARGEST.items():
        if of_run in study:
            shape = (len(bins.groups), share.size, study.sizes["row"])
            largest = np.full(shape, np.nan)
            np.fmax.at(largest, (bins.group, bins.bin), _by_row(study, of_run))
            values[name] = largest
    for name, of_run in SUMS.items():
        if of_run in study:
            rates, _, _ = bins.means(_by_row(study, of_run))
            values[name] = _in_a_year(rates, share)
    return values


def _lives(study: xr.Dataset, bins: Binning, share: np.ndarray) -> dict[str, Any]:
    """Lives by Palmgren and Miner and damage-equivalent loads, by shares of the time covered."""
    values: dict[str, Any] = {}
    for name in LIVES:
        if name in study:
            with np.errstate(divide="ignore"):
                damage_rates, _, _ = bins.means(1.0 / study[name].values)
                values[name] = 1.0 / weighted(damage_rates, share)
    for exponent in EXPONENTS:
        name = f"damage_equivalent_load_{exponent}"
        if name in study:
            powers, _, _ = bins.means(study[name].values ** exponent)
            values[name] = weighted(powers, share) ** (1.0 / exponent)
    return values


def _sum_of_year(annual: xr.Dataset, name: str, drawn: str) -> tuple[np.ndarray, list[str]]:
    """A number of each design over all bins, and a sentence on hours that it leaves out."""
    yearly = next((yearly for yearly in YEARLY if yearly.name == name), None)
    values = annual[name]
    notes = []
    if yearly is not None and yearly.needs_orbit:
        is_unknown = values.isnull().all("row").all("group")
        unknown = is_unknown & (annual.hours > 0.0)
        if bool(unknown.any()):
            hours = float(annual.hours.where(unknown).sum())
            notes.append(
                f"{yearly.noun.capitalize()} leave out {hours:.3g} h a year in which no orbit is "
                "complete."
            )
            values = values.where(~unknown, 0.0)
    by_row = values.sum("bin", skipna=False)
    over_rows = by_row.sum if drawn == "sum" else by_row.max
    sums = over_rows("row", skipna=False).values
    if yearly is not None and yearly.mean_over is not None:
        seconds = float(annual.covered) * YEAR
        sums = sums / (seconds * yearly.mean_over)
    return sums, notes


def designs(annual: xr.Dataset) -> tuple[pd.DataFrame, list[str]]:
    """The designs of `year` side by side, the least energy first, and sentences on missing numbers.

    The table has a line a group, with its number as index: its labels, the columns of
    `DESIGN_COLUMNS` and the lives [h]. Energy and entries are of both rows, the others of the worse
    one. NaN where something is not known; a criterion that no run has is left out.
    """
    labels = {name: annual[name].values for name in labels_over(annual, "group")}
    table = pd.DataFrame(labels, index=range(annual.sizes["group"]))
    notes = []
    missing = []
    for name, (drawn, _, about) in DESIGN_COLUMNS.items():
        known = None
        if name in annual:
            known = annual[name].where(annual.hours > 0.0)
        if known is None or not bool(known.notnull().any()):
            missing.append(about)
        elif drawn == "largest":
            largest = known.reduce(np.fmax.reduce, ("bin", "row"))
            table[name] = largest.values
        else:
            table[name], left_out = _sum_of_year(annual, name, drawn)
            notes += left_out
    for name in LIVES:
        if name in annual and bool(annual[name].notnull().any()):
            table[name] = annual[name].values
    if missing:
        notes.append(
            "Not known, because the results lack the variables for it or the model does not compute it: "
            f"{', '.join(missing)}."
        )
    if left_out := int(annual.left_out.sum()):
        notes.append(f"{left_out} runs without a result are left out.")
    if "energy" in table:
        table = table.sort_values("energy", kind="stable")
    return table, notes


def design_names(dataset: xr.Dataset | xr.DataArray, digits: int = 12) -> list[str]:
    """Names of groups by the labels in which they differ.

    All labels but choices are named with the last part of their key and their unit.

    Examples
    --------
    >>> tilts = ("group", [4.0, 5.0], {"units": "deg"})
    >>> design_names(xr.Dataset(coords={"bearing": ("group", ["A", "A"]), "drivetrain.tilt": tilts}))
    ['tilt 4 deg', 'tilt 5 deg']
    """
    parts = []
    for name, label in dataset.coords.items():
        units = label.attrs.get("units", "1")
        unit = "" if units in ("", "1") else f" {units}"
        values = label.values.ravel().tolist()
        texts = []
        for value in values:
            is_number = isinstance(value, float)
            texts.append(f"{value:.{digits}g}" if is_number else str(value))
        if name in ("bearing", "lubricant"):
            texts = file_names(texts)
        if label.dims == ("group",) and len(set(texts)) > 1:
            # A parameter that only other models set has no value; a model that alone sets it to
            # one value says it by its name.
            if "nan" in texts and _follows_model(dataset, texts):
                continue
            head = ""
            if name not in CHOICES:
                _, _, last_key = str(name).rpartition(".")
                head = f"{last_key.replace('_', ' ')} "
            labels = ["" if text in ("", "nan") else f"{head}{text}{unit}" for text in texts]
            parts.append(labels)
    if not parts:
        return [""] * dataset.sizes["group"]
    return [", ".join(filter(None, name)) for name in zip(*parts, strict=True)]


def _follows_model(dataset: xr.Dataset | xr.DataArray, texts: list[str]) -> bool:
    """True if every model of the groups has one text only."""
    if "model" not in dataset.coords:
        return False
    models = dataset.coords["model"].values.ravel().tolist()
    if len(models) != len(texts):
        return False
    pairs = set(zip(models, texts, strict=True))
    return len(pairs) == len(set(models))


def file_names(paths: list[str]) -> list[str]:
    """Names of bearing or lubricant files without folder and ending, where these differ.

    Examples
    --------
    >>> file_names(["../own.yaml", "skf-240-600-bc"]), file_names(["a/own.yaml", "b/own.yaml"])
    (['own', 'skf-240-600-bc'], ['a/own.yaml', 'b/own.yaml'])
    """
    short = []
    for path in paths:
        _, _, name = path.replace("\\", "/").rpartition("/")
        short.append(name.removesuffix(".yaml"))
    return short if len(set(short)) == len(set(paths)) else paths


def coverage(annual: xr.Dataset) -> str:
    """Sentence on the share of a year that the cases of `year` cover.

    Examples
    --------
    >>> coverage(xr.Dataset({"hours": ("bin", [4000.0, 66.0, 0.0])}, {"event": ("bin", ["", "start-8", "idle-6"])}))
    'The cases cover 46 % of a year: 4000 h of wind speeds and 66 h of events, whose supervisor is assumed; idle-6 counts nothing.'
    """
    hours = annual.hours.values
    if not annual.attrs.get("weighted", 1):
        return (
            "The study has no weights: all its cases count alike, as if a year consisted of them."
        )
    seconds = hours.sum() * 3600.0
    percent = 100.0 * seconds / YEAR
    covered = f"The cases cover {percent:.0f} % of a year"
    if "event" not in annual.coords:
        return f"{covered}, {hours.sum():.0f} h of wind speeds."
    event = annual.event.values.astype(str)
    is_event = event != ""
    idle = event[is_event & (hours == 0.0)].tolist()
    nothing = ""
    if idle:
        verb = "counts" if len(idle) == 1 else "count"
        nothing = f"; {', '.join(idle)} {verb} nothing"
    assumed = ""
    if set(event) & set(EVENTS):
        assumed = ", whose supervisor is assumed"
    hours_of_wind = hours[~is_event].sum()
    hours_of_events = hours[is_event].sum()
    windy = f"{hours_of_wind:.0f} h of wind speeds"
    return f"{covered}: {windy} and {hours_of_events:.3g} h of events{assumed}{nothing}."
