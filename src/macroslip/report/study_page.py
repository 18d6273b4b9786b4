"""The page on a study of many cases: lifetime energy, exceedance, worst cases, failures."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.errors import InputError
from macroslip.loads.source_file import without_folders
from macroslip.report.page import Opening, Table, number, render, sections, words
from macroslip.report.provenance import provenance_section
from macroslip.report.result_numbers import rating_summary
from macroslip.report.results_page import map_pictures
from macroslip.report.study_figures import (
    EXCEEDED,
    group_labels,
    groups,
    plot_by_result,
    plot_exceedance,
    plot_lifetime,
)
from macroslip.report.style import OPENING, Picture, picture
from macroslip.result.surface_maps import energy_density
from macroslip.study.exceedance import exceedance
from macroslip.study.export import as_table
from macroslip.study.lifetime import lifetime_energy, weighted_maps, worst
from macroslip.study.store import MANIFEST, Outcome
from macroslip.study.weights import Weibull, Weights

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from markupsafe import Markup
    from matplotlib.axes import Axes

#: Wind speeds of IEC 61400-1, class I: Rayleigh with a mean of 10 m/s, so that the scale is 10 m/s / Γ(3/2).
CLASS_ONE = Weibull(11.284, 2.0)
#: Variables of the summary whose largest values are shown, and how many of them.
_WORST, _WORST_COUNT = ("energy_mean", "orbit_energy_max", "peak_power_max"), 5
#: Lines of a table, and runs that a figure can name.
_MOST_LINES, _MOST_NAMES = 40, 16
#: Labels of a run that a reader does not need.
_LEFT_OUT = ("case", "run", "outcome", "reason", "key")
#: Variables of the summary in the opening, and the labels of their figures.
_EXTREMES = {
    "energy_mean": "energy of a mean roller [J]",
    "peak_power_max": "largest frictional power [W]",
    "lowest_spin_ratio": "lowest spin / pure rolling [–]",
}
_SEVERAL = {"loads": "load histories", "bearing": "bearings", "lubricant": "lubricants", "model": "models"}
_TEMPLATE = "study.html"


def is_study(path: Path) -> bool:
    """Whether a path is the folder of a study."""
    return (path / MANIFEST).is_file()


def study_page(study: xr.Dataset, *, title: str, weights: Weights | None = None, years: float = 20.0) -> str:
    """A page on a study.

    Parameters
    ----------
    study : xarray.Dataset
        From `open_study`.
    title : str
        Heading of the page.
    weights : Weibull or Given, optional
        How likely each wind speed is; `CLASS_ONE` by default.
    years : float
        The lifetime [years].

    Returns
    -------
    str
        HTML in one piece, every name and text in it escaped.
    """
    text, used = words(_TEMPLATE), weights or CLASS_ONE
    named = weights if weights is None or isinstance(weights, Weibull) else False
    life = curves = None
    bodies = {"runs": text.runs(_overview(study))}
    try:
        life = lifetime_energy(study, used, years=years)
        about, options = "Lifetime energy by wind speed", {"legend": "above"}
        shown = [picture(plot_lifetime, about, life, group, **options) for group in groups(life.bin_energy)]
        energies = _table(as_table(life, ["lifetime_energy"]), "Lifetime energy")
        bodies["lifetime"] = text.lifetime(years, named, 100.0 * float(life.covered), energies, shown)
    except InputError as problem:
        bodies["lifetime"] = text.no_lifetime(str(problem))
    try:
        curves = exceedance(study, used)
        bodies["exceedance"] = text.exceedance(named, _exceedances(curves, groups(curves.power_orbits), legend="above"))
    except InputError as problem:
        bodies["exceedance"] = text.no_exceedance(str(problem))
    bodies["surface"] = _surface(study, used, years)
    if rating := rating_summary(study):
        bodies["rating"] = text.rating(int(study.static_safety.notnull().sum()), study.sizes["case"], rating)
    bodies |= {"worst": text.worst(_worst(study)), "failures": text.failures(_failures(study))}
    found = sections(_TEMPLATE, bodies)
    if "status" in study:
        found.append(provenance_section({study.attrs["title"] or "study": study}))
    found += sections(_TEMPLATE, {"study": text.file(_without_folders(study.attrs["study"]))})
    return render(title, _subtitle(study, title), _opening(study, life, curves), found)


def _without_folders(study: str) -> str:
    """A study as JSON, absolute paths of its files without their folders: a page is passed on."""

    def bare(value: Any) -> Any:
        if isinstance(value, list):
            return [bare(one) for one in value]
        return without_folders(value) if isinstance(value, str) else value

    content = json.loads(study)
    for section, keys in ((content.get("loads", {}), ("files", "table")), (content, ("bearings", "lubricants"))):
        section |= {key: bare(section[key]) for key in keys if key in section}
    return json.dumps(content, ensure_ascii=False)


def _subtitle(study: xr.Dataset, title: str) -> str:
    """Title of the study, if the page has another, and its numbers of runs, loads and parameters."""
    values = {name: np.unique(study[name].values) for name in _SEVERAL}
    parts = [f"{one.size} {_SEVERAL[name]}" if one.size > 1 else f"{name} {one[0]}" for name, one in values.items()]
    own = f"{study.attrs['title']}: " if study.attrs["title"] not in ("", title) else ""
    return f"{own}{study.sizes['case']} runs, {', '.join(parts)}."


def _opening(study: xr.Dataset, life: xr.Dataset | None, curves: xr.Dataset | None) -> Opening:
    """How the runs ended, the lifetime, the largest values, in sentences and figures."""
    lives, extremes = groups(life.bin_energy) if life is not None else [], []
    pictures = []
    if life is not None and lives:
        pictures.append(picture(plot_lifetime, "Lifetime energy by wind speed", life, lives[0], **OPENING))
    pictures += _exceedances(curves, groups(curves.power_orbits)[:1], **OPENING) if curves is not None else []
    for name, label in _EXTREMES.items():
        values = -study[name] if name == "lowest_spin_ratio" else study[name]
        if not bool(values.notnull().any()):
            continue
        place = values.argmax(["case", "row"])
        case, row = int(place["case"]), study.row[place["row"]].item()
        extremes.append(
            {"quantity": name, "value": float(study[name].isel(place)), "row": row, "run": _run(study, case)}
        )
        if len(pictures) < 4:
            pictures.append(picture(_extremes, f"By run: {label}", study, name, label, **OPENING))
    about_life = _lifetime_numbers(life, lives) if life is not None and lives else None
    return Opening(words(_TEMPLATE).answer(_counts(study), about_life, extremes), pictures)


def _counts(study: xr.Dataset) -> dict[str, int]:
    """How many runs ended how."""
    counts = {one: int((study.outcome.values == str(one)).sum()) for one in Outcome}
    return {
        "runs": study.sizes["case"],
        "completed": counts[Outcome.COMPLETED],
        "failed": counts[Outcome.FAILED] + counts[Outcome.ROLLERS_FAILED],
        "missing": counts[Outcome.MISSING],
    }


def _lifetime_numbers(life: xr.Dataset, shown: list[int]) -> dict[str, Any]:
    """Lifetime energies [MJ] of each row: least and most of the groups; the group, or the wind speed, with most."""
    rows = []
    for name in life.row.values.tolist():
        one = life.sel(row=name) if len(shown) > 1 else life.sel(row=name).isel(group=shown)
        values = 1e-6 * one.lifetime_energy.values
        found: dict[str, Any] = {"name": name, "least": None, "most": None}
        if np.isfinite(values).any():
            most = int(np.nanargmax(values))
            parts = one.bin_energy.isel(group=most).values
            found |= {
                "least": float(np.nanmin(values)),
                "most": float(values[most]),
                "of": ", ".join(group_labels(life, most)),
                "speed": float(life.bin[int(np.nanargmax(parts))]),
            }
        rows.append(found)
    covered = 100.0 * float(life.covered)
    return {"years": life.attrs["years"], "groups": len(shown), "rows": rows, "covered": covered}


def _run(study: xr.Dataset, case: int) -> str:
    """Name of a run: its loads, and those labels that differ in the study."""
    one = study.isel(case=case)
    names = [name for name in _SEVERAL if name == "loads" or np.unique(study[name].values).size > 1]
    return ", ".join(str(one[name].item()).rpartition("/")[2] for name in names)


def _extremes(axes: Axes, study: xr.Dataset, name: str, label: str) -> Axes:
    """The runs with the most extreme values, in the order of the study."""
    values = study[name].transpose("case", "row").values
    extreme = (-study[name].min("row") if name == "lowest_spin_ratio" else study[name].max("row")).values
    shown = np.sort(np.argsort(-np.nan_to_num(extreme, nan=-np.inf), kind="stable")[:_MOST_NAMES])
    names = [_run(study, int(case)) for case in shown]
    if len(set(names)) < len(names):
        # Variations of parameters have no names that fit; their runs have numbers.
        names = [f"run {int(case)}" for case in shown]
    plot_by_result(axes, names, study.row.values.tolist(), values[shown], label)
    if shown.size < study.sizes["case"]:
        axes.set_title(f"the {shown.size} most extreme of {study.sizes['case']} runs", fontsize=10, loc="left")
    return axes


def _exceedances(curves: xr.Dataset, shown: list[int], **options: Any) -> list[Picture]:
    return [
        picture(plot_exceedance, f"Orbits a year of a roller over the {label}", curves, name, group, **options)
        for group in shown
        for name, label in EXCEEDED.items()
    ]


def _surface(study: xr.Dataset, weights: Weights, years: float) -> Markup | str:
    """Maps over a lifetime, weighted by wind speed, of the first group; nothing where the cases have none."""
    if "surface_energy" not in study:
        return ""
    text = words(_TEMPLATE)
    try:
        maps = weighted_maps(study, weights, years=years).isel(group=0)
    except InputError as problem:
        return text.no_maps(str(problem))
    labels = ", ".join(str(maps[name].item()) for name in ("bearing", "lubricant", "model") if name in maps.coords)
    of = f"in {years:g} years, of the simulated rollers, {labels}"
    return text.turned() + words("result.html").surface(
        *map_pictures(energy_density(maps), maps.surface_power_density), of
    )


def _overview(study: xr.Dataset) -> Table:
    rows = []
    for row in study.row.values.tolist():
        one = study.sel(row=row)
        values = (one.energy_mean.mean(), one.energy_max.max(), one.peak_power_max.max(), one.lowest_spin_ratio.min())
        rows.append((row, *(number(float(value)) for value in values)))
    headings = (
        "row",
        "mean energy of a roller in a run [J]",
        "highest energy of a roller in a run [J]",
        "highest peak power [W]",
        "lowest spin / pure rolling",
    )
    return Table(headings, rows, "Over all runs with a result")


def _worst(study: xr.Dataset) -> list[Table]:
    tables = []
    for name in _WORST:
        found = as_table(worst(study, name, count=_WORST_COUNT), [name])
        found = found.drop(columns=[one for one in _LEFT_OUT if one in found])
        tables.append(_table(found, f"By {name}: {study[name].attrs['long_name']}"))
    return tables


def _failures(study: xr.Dataset) -> Table | None:
    failed = study.isel(case=np.flatnonzero(study.outcome.values != str(Outcome.COMPLETED)))
    if not failed.sizes["case"]:
        return None
    labels = [name for name, one in failed.coords.items() if one.dims == ("case",)]
    frame = failed[labels].reset_coords().to_dataframe().reset_index()
    columns = [name for name in frame if name not in _LEFT_OUT]
    return _table(frame[[*columns, "outcome", "reason"]], "Runs without a result, or with rollers that failed")


def _table(frame: pd.DataFrame, caption: str) -> Table:
    def cell(value: Any) -> str:
        return number(float(value)) if isinstance(value, (float, np.floating)) else str(value)

    rows = [tuple(map(cell, line)) for line in frame.head(_MOST_LINES).itertuples(index=False)]
    more = f"; the first {_MOST_LINES} of {len(frame)}" if len(frame) > _MOST_LINES else ""
    return Table(tuple(map(str, frame.columns)), rows, f"{caption}{more}")
