"""Results or designs of a study side by side: what differs in their input and in their headline numbers, and which is better."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from macroslip.constants import ZERO_CELSIUS
from macroslip.errors import InputError
from macroslip.input.units import with_unit
from macroslip.report.accessor import open_result
from macroslip.report.result_numbers import estimated_values
from macroslip.report.style import scaled
from macroslip.result.plausibility import doubtful_result
from macroslip.result.run_input import stored_settings
from macroslip.study.effects import sampled_parameters
from macroslip.study.reader import is_study, open_study
from macroslip.study.weights import YEAR, Given, Weibull, binned, weights_in_use
from macroslip.study.year import CRITERIA, LIVES, coverage, design_names, designs, file_names, year

#: Pieces of a history whose differences are taken as independent of each other, at most.
_PIECES = 10
#: Parts of an input in which two results may differ without being another design.
_NOT_DESIGN = {
    "loads.": "loads",
    "window.": "windows",
    "laws.": "models of the contacts",
    "dynamics": "dynamics",
}
#: Designs that a sentence names beside the best.
_MOST_RANKED = 4
#: Labels of a run, and words for several of each.
SEVERAL = {
    "loads": "load histories",
    "bearing": "bearings",
    "lubricant": "lubricants",
    "model": "models",
}
ENERGY = CRITERIA["energy"][2]
COLUMNS = ("quantity", "units", "design", "value", "difference [%]", "low [%]", "high [%]")


def compare(
    *results: xr.Dataset | str | Path, by: Sequence[str] | str | None = None
) -> pd.DataFrame:
    """Compare results, or the designs of a study.

    Parameters
    ----------
    *results : xarray.Dataset or path
        Two results of `simulate` or more, or their files; or one study, from `open_study` or its folder.
    by : str or sequence of str, optional
        Of a study: the labels that distinguish designs, `bearing`; every bearing, lubricant, model and parameter if not
        given. Runs that differ in other labels are pooled. Without weights in the study all its cases count alike.

    Returns
    -------
    pandas.DataFrame
        A line a quantity and design: `quantity`, `units`, `design`, `value`, `difference [%]` from the first design, and
        `low [%]` to `high [%]`, the 95 % range of the energy's difference by the scatter of the wind, which both designs
        have in common; NaN where there is none. `attrs`: `notes`, what restricts the comparison; `inputs`, what differs, by
        key and design; `ranking`, a sentence; `about`, the results by their titles, or the runs, model and oil of the study.

    Raises
    ------
    InputError
        For fewer than two results or designs, or a study beside a result.

    Notes
    -----
    The range is that of Student's t for the mean of the differences: of up to ten pieces of the history between two results,
    of the runs of a bin between two designs of a study. What the estimates among the inputs leave open is not in it.
    """
    names = [
        Path(one).stem if isinstance(one, (str, Path)) else f"result {k + 1}"
        for k, one in enumerate(results)
    ]
    opened = [
        one
        if isinstance(one, xr.Dataset)
        else open_study(one)
        if is_study(Path(one))
        else open_result(one)
        for one in results
    ]
    studies = [one for one in opened if "case" in one.dims]
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
    unique = [
        name if names.count(name) == 1 else f"{name} ({k + 1})" for k, name in enumerate(names)
    ]
    return compare_results(dict(zip(unique, opened, strict=True)))


def compare_results(results: Mapping[str, xr.Dataset]) -> pd.DataFrame:
    """Compare results by name; as `compare`."""
    inputs = {name: dict(_leaves(stored_settings(one))) for name, one in results.items()}
    keys = dict.fromkeys(itertools.chain(*inputs.values()))
    differ = {
        key: {name: one.get(key, "–") for name, one in inputs.items()}
        for key in keys
        if len({repr(one.get(key)) for one in inputs.values()}) > 1
    }
    values = {name: _numbers(one) for name, one in results.items()}
    first = next(iter(results))
    ranges = {}
    for name, one in results.items():
        pieces = _pieces(results[first], one) if name != first else None
        if pieces is not None:
            variance = pieces.var(ddof=1) / pieces.size
            ranges[name] = _half_range(variance, pieces.size - 1, values[first][ENERGY, "J/h"])
    frame = _frame(values, ranges)
    shown = {key: one for key, one in differ.items() if key not in ("loads.sha256", "oil_gap")}
    about = "; ".join(
        f"{name}: {one.attrs['title']}" for name, one in results.items() if "title" in one.attrs
    )
    frame.attrs = {
        "notes": _notes(results, differ),
        "inputs": shown,
        "ranking": _ranking(frame),
        "about": about,
    }
    return frame


def _leaves(value: Any, key: str = "") -> Iterator[tuple[str, Any]]:
    """Values of nested sections by their keys with dots; of a sourced value, its number with its unit."""
    if isinstance(value, Mapping):
        if "value" in value and "tag" in value:
            unit = value.get("unit", "1")
            yield key, value["value"] if unit == "1" else with_unit(value["value"], unit)
            return
        for name, inner in value.items():
            yield from _leaves(inner, f"{key}.{name}" if key else str(name))
    else:
        yield key, value


def _notes(results: Mapping[str, xr.Dataset], differ: Mapping[str, Any]) -> list[str]:
    if not differ:
        return ["The results differ in nothing: they were computed from the same input."]
    apart = [
        what for start, what in _NOT_DESIGN.items() if any(key.startswith(start) for key in differ)
    ]
    found = [
        f"The results have different {one}, so their numbers differ for that reason too."
        for one in apart
    ]
    windows = {
        (round(one.attrs["window_start"], 6), round(one.attrs["window_end"], 6))
        for one in results.values()
    }
    if len(windows) > 1 and "windows" not in apart:
        found.append(
            "The windows differ, because orbits or loads do; energies are compared by the hour."
        )
    if len({tuple(one.roller.values.tolist()) for one in results.values()}) > 1:
        found.append("The results have different rollers; the mean is over those that each has.")
    if failed := [name for name, one in results.items() if bool((one.status != 0).any())]:
        found.append(
            f"Rollers failed in {', '.join(failed)}; every mean that they enter is missing."
        )
    estimates = [estimated_values(one) for one in results.values()]
    found += [
        f"Doubtful in {name}: {line}"
        for name, one in results.items()
        for line in doubtful_result(one)
    ]
    if any(some for some, _ in estimates):
        most, of = max(estimates)
        found.append(
            f"Up to {most} of {of} values of bearing and lubricant are engineering estimates; ranges leave them out."
        )
    return found


def _numbers(result: xr.Dataset) -> dict[tuple[str, str], float]:
    hours = (result.attrs["window_end"] - result.attrs["window_start"]) / 3600.0
    energy = result.energy.sum("interface", skipna=False).mean("roller", skipna=False) / hours
    found = {(ENERGY, "J/h"): float(energy.sum(skipna=False))}
    for row in result.row.values.tolist():
        one = result.sel(row=row)
        found[f"energy of a mean roller, {row}", "J/h"] = float(energy.sel(row=row))
        peak = one.window_peak_power if "window_peak_power" in one else one.peak_power
        found[f"largest power, {row}", "W"] = float(peak.max(skipna=False))
        found[f"lowest spin over pure rolling, {row}", "1"] = float(
            one.min_spin_ratio.min(skipna=False)
        )
    for name in ("static_safety", "basic_life", "modified_life"):
        if name in result:
            found[name.replace("_", " "), result[name].attrs["units"]] = float(result[name])
    return found


def _pieces(first: xr.Dataset, other: xr.Dataset) -> np.ndarray | None:
    """Differences of power [J/h] in pieces of the same time and loads; None where orbits are not the same."""
    if any("orbit_energy" not in one or one.sizes["orbit"] < 4 for one in (first, other)):
        return None
    loads = [stored_settings(one).get("loads", {}).get("sha256") for one in (first, other)]
    times = [
        np.concatenate([one.orbit_start.values, one.orbit_end.values[-1:]])
        for one in (first, other)
    ]
    if (
        loads[0] != loads[1]
        or times[0].shape != times[1].shape
        or not np.allclose(*times, atol=1e-3, rtol=0.0)
    ):
        return None
    energies = [
        one.orbit_energy.sum("interface", skipna=False)
        .mean("roller", skipna=False)
        .sum("row")
        .values
        for one in (first, other)
    ]
    parts = np.array_split(np.arange(times[0].size - 1), min(_PIECES, times[0].size - 1))
    return np.array(
        [
            3600.0 * (energies[1] - energies[0])[k].sum() / (times[0][k[-1] + 1] - times[0][k[0]])
            for k in parts
        ]
    )


def _half_range(variance: float, freedom: int, of: float) -> float:
    """Half of the 95 % range of a mean, in per cent of a value; NaN where nothing is known of its scatter."""
    from scipy.stats import t

    return (
        float(100.0 * t.ppf(0.975, freedom) * np.sqrt(variance) / abs(of))
        if freedom and of
        else np.nan
    )


def compare_designs(
    study: xr.Dataset, by: Sequence[str] | None = None, wind: Weibull | Given | None = None
) -> pd.DataFrame:
    """Compare the designs of a study over a year, `wind` in place of that of its file; as `compare`."""
    weights, field, width = weights_in_use(study, wind)
    groups = binned(study, None).groups
    varied = [str(name) for name in groups if len(set(groups[name].astype(str))) > 1]
    sampled = sampled_parameters(study)
    by = list(by) if by else [name for name in varied if name not in sampled]
    if wrong := [name for name in by if name not in study.coords or study[name].dims != ("case",)]:
        raise InputError(
            f"the study has no label '{wrong[0]}'",
            where="by",
            allowed=", ".join(varied) or "none varies",
        )
    labels = {name: ("group", study[name].values, study[name].attrs) for name in by}
    design = np.array(design_names(xr.Dataset(coords=labels)) if by else [""])
    names = list(dict.fromkeys(design.tolist()))
    if len(names) < 2:
        raise InputError(
            f"the study has one {' and '.join(by)} only"
            if by
            else "the designs of the study differ in nothing",
            allowed=f"labels that vary: {', '.join(varied)}"
            if varied
            else "a study of several designs",
        )
    # Other labels of a design are pooled: they become one group.
    pooled = {
        str(name): ("case", np.full(design.size, "", dtype=object))
        for name in groups
        if name not in by
    }
    parts = {
        name: study.assign_coords(pooled).isel(case=np.flatnonzero(design == name))
        for name in names
    }
    years = {name: year(part, weights, field=field, width=width) for name, part in parts.items()}
    notes = [coverage(years[names[0]])]
    if also := [one for one in pooled if one in varied]:
        notes.append(
            f"The designs also have several values of {', '.join(also)}, which are pooled."
        )
    loads = {
        name: set(part.loads.values.tolist())
        for name, part in parts.items()
        if "loads" in part.coords
    }
    if len(set(map(frozenset, loads.values()))) > 1:
        notes.append(
            "The designs have different loads, so their numbers differ for that reason too."
        )
    if same := _alike(parts):
        notes.append(
            f"{same} differ in nothing but their names: they were computed from the same input."
        )
    values = {name: _year_numbers(one) for name, one in years.items()}
    notes += dict.fromkeys(itertools.chain(*(designs(one)[1] for one in years.values())))
    total = values[names[0]][ENERGY, "J/year"]
    ranges = {}
    for name in names[1:]:
        rates = _paired(parts[names[0]], parts[name])
        bins = binned(parts[names[0]], field if weights is not None else None, width)
        place = dict(zip(parts[names[0]].loads.values.tolist(), bins.bin.tolist(), strict=False))
        ranges[name] = _pooled_range(rates, place, bins.probabilities(weights), total)
    frame = _frame(values, ranges)
    inputs = {one: {name: str(parts[name][one].values[0]) for name in names} for one in by}
    frame.attrs = {
        "notes": notes,
        "inputs": inputs,
        "ranking": _ranking(frame),
        "about": study_about(study),
    }
    return frame


def study_about(study: xr.Dataset) -> str:
    """How many runs of which loads, bearings, lubricants and models a study has, and how warm their oil is."""
    values = {name: np.unique(study[name].values) for name in SEVERAL if name in study.coords}
    told = {name: file_names([str(one[0])])[0] for name, one in values.items()}
    if not any(str(name).startswith("laws.") for name in study.coords):
        told |= {name: study.attrs[name] for name in ("model",) if name in study.attrs}
    parts = [
        f"{one.size} {SEVERAL[name]}" if one.size > 1 else f"{name} {told[name]}"
        for name, one in values.items()
    ]
    if "inlet_temperature" in study:
        # Of one run of each lubricant and temperature; every run would open every result.
        labels = [
            study[name].values.astype(str)
            for name in ("lubricant", "temperature")
            if name in study.coords
        ]
        warm = (
            study.inlet_temperature[np.sort(np.unique(labels, axis=1, return_index=True)[1])]
            - ZERO_CELSIUS
        )
        if bool(warm.notnull().any()):
            parts.append(
                f"oil at {' to '.join(dict.fromkeys(f'{float(one):.3g}' for one in (warm.min(), warm.max())))} °C"
            )
    return f"{study.sizes['case']} runs, {', '.join(parts)}"


def _alike(parts: Mapping[str, xr.Dataset]) -> str:
    found: dict[frozenset[str], list[str]] = {}
    for name, part in parts.items():
        if "key" in part.coords and all(part.key.values.astype(str)):
            found.setdefault(frozenset(part.key.values.tolist()), []).append(name)
    return "; ".join(" and ".join(names) for names in found.values() if len(names) > 1)


def _year_numbers(one: xr.Dataset) -> dict[tuple[str, str], float]:
    line = designs(one)[0].iloc[0]
    found = {
        (about, units): float(line[name])
        for name, (_, units, about) in CRITERIA.items()
        if name in line
    }
    found = {(ENERGY, "J/year"): np.nan} | found
    for row in one.row.values.tolist():
        found[f"energy of a mean roller, {row}", "J/year"] = float(
            one.total.isel(group=0).sel(row=row)
        )
    return found | {
        (name.replace("_", " "), "h"): float(one[name][0]) for name in LIVES if name in one
    }


def _paired(first: xr.Dataset, other: xr.Dataset) -> pd.Series:
    """Differences of power [W] of both rows under the same loads, by loads; without those that only one of them has."""
    powers = [
        (one.energy_mean / one.window_length)
        .sum("row", skipna=False)
        .to_series()
        .groupby(one.loads.values)
        .mean()
        for one in (first, other)
    ]
    return (powers[1] - powers[0]).dropna()


def _pooled_range(
    differences: pd.Series, place: Mapping[str, int], share: np.ndarray, total: float
) -> float:
    """Half of the 95 % range of the difference of two years [%], by the scatter of differences in each bin."""
    variance, freedom = 0.0, 0
    for number, values in differences.groupby([place[str(name)] for name in differences.index]):
        if values.size > 1:
            variance += share[int(number)] ** 2 * float(values.var()) / values.size  # pyright: ignore[reportArgumentType]
            freedom += values.size - 1
    return _half_range(variance * YEAR**2, freedom, total)


def _frame(
    values: Mapping[str, Mapping[tuple[str, str], float]], ranges: Mapping[str, float]
) -> pd.DataFrame:
    first = next(iter(values))
    shared = [key for key in values[first] if all(key in one for one in values.values())]
    rows = []
    for quantity, units in shared:
        base = values[first][quantity, units]
        for name, one in values.items():
            value = one[quantity, units]
            change = 100.0 * (value / base - 1.0) if name != first and base else np.nan
            half = ranges.get(name, np.nan) if quantity == ENERGY else np.nan
            rows.append((quantity, units, name, value, change, change - half, change + half))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _ranking(frame: pd.DataFrame) -> str:
    lines = [dict(zip(frame.columns, line, strict=True)) for line in frame.itertuples(index=False)]
    lines = [one for one in lines if one["quantity"] == ENERGY]
    unknown = [one["design"] for one in lines if not np.isfinite(one["value"])]
    known = [one for one in lines if one["design"] not in unknown]
    if len(known) < 2:
        return f"The designs cannot be ranked: the energy of {', '.join(unknown)} is not known."
    best, *others = sorted(known, key=lambda one: one["value"])
    if others[-1]["value"] == best["value"]:
        return "All dissipate the same energy."
    factor, units = scaled(best["value"], best["units"])
    told = [f"{best['design']} dissipates least, {factor * best['value']:.4g} {units} ({ENERGY})"]
    shown = others if len(others) <= _MOST_RANKED else [*others[: _MOST_RANKED - 1], others[-1]]
    told += [
        f"{one['design']} {100.0 * (one['value'] / best['value'] - 1.0):.3g} % more"
        for one in shown
    ]
    if len(shown) < len(others):
        told.append(f"{len(others) - len(shown)} others between them")
    found = [f"{'; '.join(told)}."] + (
        [f"The energy of {', '.join(unknown)} is not known."] if unknown else []
    )
    first = lines[0]["design"]
    unsure, close = [], []
    for one in [one for one in [best, *shown] if one["design"] != first]:
        name, low, high = one["design"], one["low [%]"], one["high [%]"]
        change = f"{one['difference [%]']:.3g} %"
        if not np.isfinite(low):
            unsure.append(name)
        elif low <= 0.0 <= high:
            close.append(
                f"{name}, {change}, is smaller than its scatter of {0.5 * (high - low):.2g} %"
            )
        else:
            found.append(
                f"From {first} to {name} it changes by {change} ({low:.3g} to {high:.3g} %)."
            )
    if close:
        found.append(
            f"The difference between {first} and {'; and '.join(close)}: they are not told apart."
        )
    if unsure:
        found.append(
            f"How sure the difference between {first} and {', '.join(unsure)} is cannot be told from these results."
        )
    return " ".join(found)
