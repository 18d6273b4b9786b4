"""Results or designs of a study side by side: how input and numbers differ, which is better."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from macroslip.constants import HOUR, YEAR
from macroslip.errors import InputError
from macroslip.input.units import with_unit
from macroslip.report.accessor import open_result
from macroslip.report.ranking import ENERGY, ranking_sentences
from macroslip.report.result_numbers import estimated_values
from macroslip.report.run_names import as_groups, study_about
from macroslip.result.damage import lines
from macroslip.result.plausibility import doubtful_result
from macroslip.result.run_input import leaves, stored_settings, window_length
from macroslip.study.aggregation import aggregation_in_use
from macroslip.study.labels import sampled_parameters
from macroslip.study.over_temperature import weighted_study
from macroslip.study.reader import is_study, open_study
from macroslip.study.weights import BinProbabilities, Weibull, binned
from macroslip.study.year import DESIGN_COLUMNS, LIVES, coverage, design_names, designs, year

#: Pieces of a history whose differences are taken as independent of each other, at most.
_PIECES = 10
#: Parts of an input in which two results may differ without being another design.
_NOT_DESIGN = {
    "loads.": "loads",
    "window.": "windows",
    "laws.": "models of the contacts",
    "dynamics": "dynamics",
}
#: Inputs that differ with every load or follow from others.
_NOT_SHOWN = ("loads.sha256", "oil_gap")
COLUMNS = ("quantity", "units", "design", "value", "difference [%]", "low [%]", "high [%]")


def compare(
    *results: xr.Dataset | str | Path, by: Sequence[str] | str | None = None
) -> pd.DataFrame:
    """Compare results, or the designs of a study.

    Parameters
    ----------
    *results : xarray.Dataset or path
        Two results of `simulate` or more, or their files; or one study, from `open_study` or its
        folder.
    by : str or sequence of str, optional
        Of a study: the labels that distinguish designs, `bearing`; every bearing, lubricant, model
        and parameter if not given. Runs that differ in other labels are pooled. Without weights in
        the study all its cases count alike.

    Returns
    -------
    pandas.DataFrame
        A line a quantity and design: `quantity`, `units`, `design`, `value`, `difference [%]` from
        the first design, and `low [%]` to `high [%]`, the 95 % range of the energy's difference by
        the scatter of the wind, which both designs have in common; NaN where there is none.
        `attrs`: `notes`, what restricts the comparison; `inputs`, what differs, by key and design;
        of results `criteria`, the criteria of damage by design, as `macroslip.result.damage.lines`;
        `ranking`, a sentence; `about`, the results by their titles, or the runs, model and oil of
        the study.

    Raises
    ------
    InputError
        For fewer than two results or designs, or a study beside a result.

    Notes
    -----
    The range is that of Student's t for the mean of the differences: of up to ten pieces of the
    history between two results, of the runs of a bin between two designs of a study. What the
    estimates among the inputs leave open is not in it.
    """
    opened = [_opened(result) for result in results]
    studies = [result for result in opened if "case" in result.dims]
    if len(studies) == 1 and len(opened) == 1:
        return compare_designs(opened[0], [by] if isinstance(by, str) else by)
    if studies:
        raise InputError(
            "a study is compared with something else",
            allowed="results of macroslip run, or one study",
            remedy="Put the designs into one study and compare it --by bearing, for example.",
        )
    if by:
        raise InputError("'by' is given for results that are no study", remedy="Leave it out.")
    if len(opened) < 2:
        raise InputError(
            "there is one result only",
            allowed="two or more",
            remedy="Name another to compare it with.",
        )
    names = [
        Path(result).stem if isinstance(result, (str, Path)) else f"result {number}"
        for number, result in enumerate(results, start=1)
    ]
    unique = [
        name if names.count(name) == 1 else f"{name} ({number})"
        for number, name in enumerate(names, start=1)
    ]
    return compare_results(dict(zip(unique, opened, strict=True)))


def _opened(result: xr.Dataset | str | Path) -> xr.Dataset:
    if isinstance(result, xr.Dataset):
        return result
    if is_study(Path(result)):
        return open_study(result)
    return open_result(result)


def compare_results(results: Mapping[str, xr.Dataset]) -> pd.DataFrame:
    """Compare results by name; as `compare`."""
    inputs = {
        name: {key: _written(leaf) for key, leaf in leaves(stored_settings(result))}
        for name, result in results.items()
    }
    differ = {}
    all_keys = itertools.chain(*inputs.values())
    for key in dict.fromkeys(all_keys):
        values = {name: of_result.get(key, "–") for name, of_result in inputs.items()}
        written = set(map(repr, values.values()))
        if len(written) > 1:
            differ[key] = values
    numbers = {name: _numbers(result) for name, result in results.items()}
    first, *others = results
    ranges = {}
    for name in others:
        pieces = _differences_of_pieces(results[first], results[name])
        if pieces is not None:
            variance_of_mean = pieces.var(ddof=1) / pieces.size
            base = numbers[first][ENERGY, "J/h"]
            ranges[name] = _half_range(variance_of_mean, pieces.size - 1, base)
    titles = [
        f"{name}: {result.attrs['title']}"
        for name, result in results.items()
        if "title" in result.attrs
    ]
    return _table(
        numbers,
        ranges,
        notes=_notes(results, differ),
        inputs={key: values for key, values in differ.items() if key not in _NOT_SHOWN},
        about="; ".join(titles),
        criteria={name: lines(result)[0] for name, result in results.items()},
    )


def _written(leaf: Any) -> Any:
    """A value of an input; of one with its source, number and unit."""
    if not isinstance(leaf, Mapping):
        return leaf
    unit = leaf.get("unit", "1")
    value = leaf["value"]
    return value if unit == "1" else with_unit(value, unit)


def _notes(results: Mapping[str, xr.Dataset], differ: Mapping[str, Any]) -> list[str]:
    """Sentences on limits of the comparison of results."""
    if not differ:
        return ["The results differ in nothing: they were computed from the same input."]
    apart = [
        name for start, name in _NOT_DESIGN.items() if any(key.startswith(start) for key in differ)
    ]
    notes = [
        f"The results have different {name}, so their numbers differ for that reason too."
        for name in apart
    ]
    windows = {
        (round(result.attrs["window_start"], 6), round(result.attrs["window_end"], 6))
        for result in results.values()
    }
    if len(windows) > 1 and "windows" not in apart:
        notes.append(
            "The windows differ, because orbits or loads do; energies are compared by the hour."
        )
    notes += _between_kinds(results)
    rollers = {tuple(result.roller.values.tolist()) for result in results.values()}
    if len(rollers) > 1:
        notes.append("The results have different rollers; the mean is over those that each has.")
    failed = []
    for name, result in results.items():
        if bool((result.status != 0).any()):
            failed.append(name)
    if failed:
        notes.append(
            f"Rollers failed in {', '.join(failed)}; every mean that they enter is missing."
        )
    notes += [
        f"Doubtful in {name}: {sentence}"
        for name, result in results.items()
        for sentence in doubtful_result(result)
    ]
    counts = map(estimated_values, results.values())
    estimates, values = max(counts)
    if estimates:
        notes.append(
            f"Up to {estimates} of {values} values of bearing and lubricant are engineering "
            "estimates; ranges leave them out."
        )
    return notes


def _numbers(result: xr.Dataset) -> dict[tuple[str, str], float]:
    """Headline numbers of a result by quantity and unit."""
    hours = window_length(result) / HOUR
    of_roller = result.energy.sum("interface", skipna=False)
    energy = of_roller.mean("roller", skipna=False) / hours
    peak_name = "window_peak_power" if "window_peak_power" in result else "peak_power"
    peak = result[peak_name]
    numbers = {(ENERGY, "J/h"): float(energy.sum(skipna=False))}
    for row in result.row.values.tolist():
        spins = result.min_spin_ratio.sel(row=row)
        spin = spins.min(skipna=False)
        numbers |= {
            (f"energy of a mean roller, {row}", "J/h"): float(energy.sel(row=row)),
            (f"largest power, {row}", "W"): float(peak.sel(row=row).max(skipna=False)),
            (f"lowest spin over pure rolling, {row}", "1"): float(spin),
        }
    for name in ("static_safety", "basic_life", "modified_life"):
        if name in result:
            words = name.replace("_", " ")
            units = result[name].attrs["units"]
            numbers[words, units] = float(result[name])
    return numbers


def _differences_of_pieces(first: xr.Dataset, other: xr.Dataset) -> np.ndarray | None:
    """Differences of power [J/h] in pieces of the same time; None for different orbits."""
    pair = (first, other)
    if not all(map(_has_pieces, pair)):
        return None
    checksums = {_checksum_of_loads(result) for result in pair}
    times, other_times = (
        np.append(result.orbit_start.values, result.orbit_end.values[-1]) for result in pair
    )
    if (
        len(checksums) > 1
        or times.shape != other_times.shape
        or not np.allclose(times, other_times, atol=1e-3, rtol=0.0)
    ):
        return None
    energies, other_energies = (
        result.orbit_energy.sum("interface", skipna=False)
        .mean("roller", skipna=False)
        .sum("row")
        .values
        for result in pair
    )
    orbits = energies.size
    pieces = np.array_split(np.arange(orbits), min(_PIECES, orbits))
    edges = [piece[0] for piece in pieces]
    differences = np.add.reduceat(other_energies - energies, edges)
    seconds = np.diff(times[[*edges, orbits]])
    return 3600.0 * differences / seconds


def _has_pieces(result: xr.Dataset) -> bool:
    """True if a result has enough complete orbits for pieces of its window."""
    return "orbit_energy" in result and result.sizes["orbit"] >= 4


def _checksum_of_loads(result: xr.Dataset) -> str | None:
    """SHA-256 of the loads of a result; None if they come from no file."""
    loads = stored_settings(result).get("loads", {})
    return loads.get("sha256")


def _half_range(variance: float, freedom: int, base: float) -> float:
    """Half of the 95 % range of a mean [% of the base]; NaN if not known or the base is 0."""
    from scipy.stats import t

    if not freedom or not base:
        return np.nan
    error = np.sqrt(variance)
    half = 100.0 * t.ppf(0.975, freedom) * error
    return float(half / abs(base))


def _table(
    numbers: Mapping[str, Mapping[tuple[str, str], float]],
    ranges: Mapping[str, float],
    **about: Any,
) -> pd.DataFrame:
    """The comparison: a line a quantity and design with its difference from the first.

    Parameters
    ----------
    numbers : mapping
        Numbers by quantity and unit, by design.
    ranges : mapping
        Half of the 95 % range of the energy's difference from the first [%], by design.
    **about
        Attributes of the table.
    """
    first, *others = numbers.values()
    rows = []
    for (quantity, units), base in first.items():
        if not all((quantity, units) in other for other in others):
            continue
        for design, values in numbers.items():
            value = values[quantity, units]
            is_other = values is not first and base != 0.0
            change = 100.0 * (value / base - 1.0) if is_other else np.nan
            half = ranges.get(design, np.nan) if quantity == ENERGY else np.nan
            low = change - half
            high = change + half
            rows.append((quantity, units, design, value, change, low, high))
    table = pd.DataFrame(rows, columns=list(COLUMNS))
    ranking = " ".join(ranking_sentences(table))
    table.attrs = {**about, "ranking": ranking}
    return table


def _between_kinds(results: Mapping[str, xr.Dataset]) -> list[str]:
    """Sentence on what energies leave out, where a tapered bearing stands beside another kind."""
    has_ribs = {
        "rib_energy" in result and bool(result.rib_energy.notnull().any())
        for result in results.values()
    }
    if len(has_ribs) < 2:
        return []
    return [
        "Energies are those of a mean roller's sliding at raceways and cage. What differs between the "
        "kinds of bearings is no part of them: ribs, rolling resistance and the number of rollers."
    ]


def compare_designs(
    study: xr.Dataset,
    by: Sequence[str] | None = None,
    wind: Weibull | BinProbabilities | None = None,
) -> pd.DataFrame:
    """Compare designs of a study over a year, `wind` in place of its file's; as `compare`."""
    study = weighted_study(study)
    aggregation = aggregation_in_use(study, wind)
    varied = _varied_labels(study)
    labels = _labels_of_designs(study, by, varied)
    parts = _parts(study, labels)
    years = {name: year(part, aggregation) for name, part in parts.items()}
    numbers = {name: _year_numbers(annual) for name, annual in years.items()}
    first, *others = parts
    total = numbers[first][ENERGY, "J/year"]
    bins = aggregation.bins(parts[first])
    share = bins.probabilities(aggregation.weights)
    loads = parts[first].loads.values.tolist()
    bin_of_loads = dict(zip(loads, bins.bin.tolist(), strict=False))
    ranges = {}
    for name in others:
        differences = _power_differences(parts[first], parts[name])
        variance, freedom = _pooled_variance(differences, bin_of_loads, share)
        ranges[name] = _half_range(variance * YEAR**2, freedom, total)
    return _table(
        numbers,
        ranges,
        notes=_design_notes(years, parts, [name for name in varied if name not in labels]),
        inputs={
            label: {name: str(part[label].values[0]) for name, part in parts.items()}
            for label in labels
        },
        about=study_about(study),
    )


def _varied_labels(study: xr.Dataset) -> list[str]:
    """Labels of designs that have several values in a study."""
    groups = binned(study, None).groups
    varied = []
    for name in groups:
        texts = groups[name].astype(str)
        if len(set(texts)) > 1:
            varied.append(str(name))
    return varied


def _labels_of_designs(
    study: xr.Dataset, by: Sequence[str] | None, varied: Sequence[str]
) -> list[str]:
    """Labels of designs: those asked for, otherwise all that vary and are not sampled."""
    if not by:
        sampled = sampled_parameters(study)
        return [name for name in varied if name not in sampled]
    for name in by:
        if name not in study.coords or study[name].dims != ("case",):
            raise InputError(
                f"the study has no label '{name}'",
                where="by",
                allowed=", ".join(varied) or "none varies",
            )
    return list(by)


def _parts(study: xr.Dataset, labels: Sequence[str]) -> dict[str, xr.Dataset]:
    """The runs of each design by its name; its other labels are pooled into one group."""
    design = np.array(design_names(as_groups(study, labels)))
    names = list(dict.fromkeys(design.tolist()))
    if len(names) < 2:
        varied = _varied_labels(study)
        raise InputError(
            f"the study has one {' and '.join(labels)} only"
            if labels
            else "the designs of the study differ in nothing",
            allowed=f"labels that vary: {', '.join(varied)}" if varied else "several designs",
        )
    one_value = np.full(design.size, "", dtype=object)
    pooled = {
        str(name): ("case", one_value) for name in binned(study, None).groups if name not in labels
    }
    study = study.assign_coords(pooled)
    parts = {}
    for name in names:
        cases = np.flatnonzero(design == name)
        parts[name] = study.isel(case=cases)
    return parts


def _design_notes(
    years: Mapping[str, xr.Dataset], parts: Mapping[str, xr.Dataset], pooled: Sequence[str]
) -> list[str]:
    """Sentences on limits of the comparison of designs; a design has several values of `pooled`."""
    any_year = next(iter(years.values()))
    notes = [coverage(any_year)]
    if pooled:
        notes.append(
            f"The designs also have several values of {', '.join(pooled)}, which are pooled."
        )
    loads = {
        frozenset(part.loads.values.tolist()) for part in parts.values() if "loads" in part.coords
    }
    if len(loads) > 1:
        notes.append(
            "The designs have different loads, so their numbers differ for that reason too."
        )
    notes += _between_kinds(parts)
    names_by_keys: dict[frozenset[str], list[str]] = {}
    for name, part in parts.items():
        if "key" in part.coords and all(part.key.values.astype(str)):
            keys = frozenset(part.key.values.tolist())
            names_by_keys.setdefault(keys, []).append(name)
    alike = [names for names in names_by_keys.values() if len(names) > 1]
    same = [" and ".join(names) for names in alike]
    if same:
        notes.append(
            f"{'; '.join(same)} differ in nothing but their names: "
            "they were computed from the same input."
        )
    unknown = []
    for annual in years.values():
        _, notes_of_design = designs(annual)
        unknown += notes_of_design
    return [*notes, *dict.fromkeys(unknown)]


def _year_numbers(annual: xr.Dataset) -> dict[tuple[str, str], float]:
    """Numbers of a year of one design by quantity and unit."""
    table, _ = designs(annual)
    numbers = {(ENERGY, "J/year"): np.nan}
    for name, (_, units, about) in DESIGN_COLUMNS.items():
        if name in table:
            numbers[about, units] = float(table[name].iloc[0])
    for row in annual.row.values.tolist():
        energy = annual.total.isel(group=0).sel(row=row)
        numbers[f"energy of a mean roller, {row}", "J/year"] = float(energy)
    for name in LIVES:
        if name in annual:
            words = name.replace("_", " ")
            numbers[words, "h"] = float(annual[name][0])
    return numbers


def _power_differences(first: xr.Dataset, other: xr.Dataset) -> pd.Series:
    """Differences of power [W] of both rows by loads, as far as both parts have them."""
    power, other_power = (
        (part.energy_mean / part.window_length)
        .sum("row", skipna=False)
        .to_series()
        .groupby(part.loads.values)
        .mean()
        for part in (first, other)
    )
    return (other_power - power).dropna()


def _pooled_variance(
    differences: pd.Series, bin_of_loads: Mapping[str, int], share: np.ndarray
) -> tuple[float, int]:
    """Variance of the mean difference over a year by scatter in bins; degrees of freedom."""
    bins = [bin_of_loads[str(name)] for name in differences.index]
    pieces = differences.groupby(bins)
    size = pieces.size()
    several = size > 1
    weight = share[size.index.to_numpy(dtype=int)]
    variance_of_mean = pieces.var() / size
    variance = (weight**2 * variance_of_mean)[several].sum()
    freedom = (size - 1)[several].sum()
    return float(variance), int(freedom)
