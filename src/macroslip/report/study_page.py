"""The page on a study of many cases: its designs ranked, a year, effects, lifetime energy, exceedance, worst cases, failures."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from macroslip.constants import HOURS_A_YEAR
from macroslip.errors import InputError
from macroslip.loads.source_file import without_folders
from macroslip.report.comparison import SEVERAL, compare_designs, study_about
from macroslip.report.page import Opening, Table, number, render, sections, words
from macroslip.report.provenance import provenance_section
from macroslip.report.result_numbers import rating_summary
from macroslip.report.results_page import map_pictures
from macroslip.report.study_figures import (
    EXCEEDED,
    drawable,
    plot_by_result,
    plot_effects,
    plot_exceedance,
    plot_lifetime,
)
from macroslip.report.style import OPENING, Picture, picture, scaled
from macroslip.result.plausibility import JUDGED, doubtful_result
from macroslip.result.surface_maps import energy_density
from macroslip.study.effects import effects, sampled_parameters
from macroslip.study.exceedance import exceedance
from macroslip.study.export import as_table
from macroslip.study.lifetime import lifetime_energy, weighted_maps, worst
from macroslip.study.store import Outcome
from macroslip.study.weights import (
    IEC_CLASSES,
    Given,
    Weibull,
    Weights,
    Year,
    binned,
    is_parameter,
    weights_in_use,
)
from macroslip.study.year import CRITERIA, coverage, design_names, designs, year

if TYPE_CHECKING:
    import pandas as pd
    from markupsafe import Markup
    from matplotlib.axes import Axes

#: Wind speeds of a study that does not say which: Rayleigh with a mean of 10 m/s.
CLASS_ONE = IEC_CLASSES["IEC I"]
#: Variables of the summary whose largest values are shown, and how many of them.
_WORST, _WORST_COUNT = ("energy_mean", "orbit_energy_max", "peak_power_max"), 5
#: Lines of a table, of the opening's, and runs that a figure can name.
_MOST_LINES, _MOST_DESIGNS, _MOST_NAMES = 40, 8, 16
#: Labels of a run that a reader does not need.
_LEFT_OUT = ("case", "run", "outcome", "reason", "key")
#: Variables of the summary in the opening, and the labels of their figures.
_EXTREMES = {
    "energy_mean": "energy of a mean roller [J]",
    "peak_power_max": "largest frictional power [W]",
    "lowest_spin_ratio": "lowest spin / pure rolling [–]",
}
#: Columns of the table of designs: factor to the unit that is shown, and heading.
_SHOWN = {
    "energy": (1e-6, "energy, both rows [MJ/year]"),
    "wear": (1e6, "wear at k = 1e-17 m²/N [µm/year]"),
    "entries": (1.0, "entries under slip [1/year]"),
    "mixed_time": (100.0, "time with Λ < 1 [%]"),
    "pressure_slip": (1.0, "friction energy / FE8 test"),
    "entry_slip": (1.0, "smearing: largest slip at entry"),
    "peak": (1.0, "largest power [W]"),
    "basic_life": (1.0 / HOURS_A_YEAR, "life L10 [years]"),
    "modified_reference_life": (1.0 / HOURS_A_YEAR, "modified reference life [years]"),
}
_TEMPLATE = "study.html"


def study_page(
    study: xr.Dataset, *, title: str, weights: Weibull | Given | None = None, years: float = 20.0
) -> str:
    """A page on a study: HTML in one piece, every name and text in it escaped.

    `weights` says how likely each wind speed is, the study file by default. Without any, designs are ranked over all
    cases alike, and lifetime and exceedance are those of `CLASS_ONE`. `years` is the lifetime.
    """
    text = words(_TEMPLATE)
    chosen, field, width = weights_in_use(study, weights)
    used, bins = chosen or CLASS_ONE, {"field": field, "width": width}
    wind = chosen.wind if isinstance(chosen, Year) else chosen
    named = wind if wind is None or isinstance(wind, Weibull) else False
    # Points of a sample are no designs: they are pooled here, and told apart by their effects.
    base = study.drop_vars(sampled_parameters(study))
    unused = ""
    try:
        whole = year(base, chosen, **bins)
    except InputError as problem:
        chosen, whole, unused = None, year(base, None), f"The weights cannot be used: {problem}"
    table, told = designs(whole)
    told = [unused or coverage(whole), *told]
    order = table.index.tolist()
    names = design_names(whole)
    pictures: list[Picture] = []
    ranking = _ranking(study, weights)
    bodies = {"designs": text.designs(_designs(table, names, _MOST_LINES), ranking, told)}
    if chosen is not None:
        bodies["year"] = text.year(coverage(whole), _year(whole, names))
    bodies["effects"], driver, drawn = _effects(study, chosen, bins)
    try:
        life = lifetime_energy(base, used, years=years, **bins)
        shown = drawable(life.bin_energy, order)
        energies = _table(as_table(life, ["lifetime_energy"]), "Lifetime energy")
        pictures = (
            [picture(plot_lifetime, "Lifetime energy by wind speed", life, shown, **OPENING)]
            if shown
            else []
        )
        bodies["lifetime"] = text.lifetime(
            years, named, 100.0 * float(life.covered), energies, pictures
        )
    except InputError as problem:
        bodies["lifetime"] = text.no_lifetime(str(problem))
    try:
        curves = exceedance(base, used, **bins)
        shown = drawable(curves.power_orbits, order)
        exceeding = [
            picture(
                plot_exceedance,
                f"Orbits a year of a roller over the {label}",
                curves,
                name,
                shown,
                **OPENING,
            )
            for name, label in (EXCEEDED.items() if shown else ())
        ]
        bodies["exceedance"] = text.exceedance(named, exceeding)
        pictures = [*pictures, *exceeding]
    except InputError as problem:
        bodies["exceedance"] = text.no_exceedance(str(problem))
    bodies["surface"] = _surface(base, used, years, bins)
    if rating := rating_summary(study):
        bodies["rating"] = text.rating(
            int(study.static_safety.notnull().sum()), study.sizes["case"], rating
        )
    bodies |= {"worst": text.worst(_worst(study)), "failures": text.failures(_failures(study))}
    found = sections(_TEMPLATE, bodies)
    if "status" in study:
        found.append(provenance_section({study.attrs["title"] or "study": study}))
    found += sections(_TEMPLATE, {"study": text.file(_without_folders(study.attrs["study"]))})
    extremes = _extremes(study)
    pictures = [*drawn[:1], *pictures]
    for name, label in _EXTREMES.items():
        if len(pictures) < 4 and name in extremes:
            pictures.append(
                picture(_plot_extremes, f"By run: {label}", base, order, name, label, **OPENING)
            )
    counts = {one.name: int((study.outcome.values == str(one)).sum()) for one in Outcome}
    judged = study[[name for name in JUDGED if name in study]].median("case")
    answer = text.answer(
        counts, ranking, told, list(extremes.values()), driver, doubtful_result(judged)
    )
    opening = Opening(answer, pictures, table=_designs(table, names, _MOST_DESIGNS))
    return render(title, _subtitle(study, title), opening, found)


def _without_folders(study: str) -> str:
    """A study as JSON, absolute paths of its files without their folders: a page is passed on."""

    def bare(value: Any) -> Any:
        if isinstance(value, list):
            return [bare(one) for one in value]
        return without_folders(value) if isinstance(value, str) else value

    content = json.loads(study)
    for section, keys in (
        (content.get("loads", {}), ("files", "table")),
        (content, ("bearings", "lubricants")),
    ):
        section |= {key: bare(section[key]) for key in keys if key in section}
    return json.dumps(content, ensure_ascii=False)


def _subtitle(study: xr.Dataset, title: str) -> str:
    own = f"{study.attrs['title']}: " if study.attrs["title"] not in ("", title) else ""
    return f"{own}{study_about(study)}."


def _ranking(study: xr.Dataset, wind: Weibull | Given | None) -> str:
    try:
        return compare_designs(study, None, wind).attrs["ranking"]
    except InputError:
        return ""


def _shown(name: str, value: float) -> str:
    value *= _SHOWN[name][0]
    return "> 500" if name.endswith("life") and value > 500.0 else number(value, 3)


def _designs(table: pd.DataFrame, names: list[str], most: int) -> Table:
    columns = [name for name in _SHOWN if name in table]
    rows = [
        (
            f"{k} {names[int(group)]}" if names[int(group)] else "the study",
            *(_shown(name, float(line[name])) for name in columns),
        )
        for k, (group, line) in enumerate(table.head(most).to_dict("index").items(), start=1)
    ]
    more = f"; the first {most} of {len(table)}" if len(table) > most else ""
    about = "Designs by energy, the least first; wear, mixed film, friction energy, slip and power of the worse row"
    return Table(("design", *(_SHOWN[name][1] for name in columns)), rows, f"{about}{more}")


def _effects(
    study: xr.Dataset, weights: Weights | None, bins: dict[str, Any]
) -> tuple[Markup | str, Markup | str, list[Picture]]:
    """The section on the sample, the parameter that moves the energy most in a sentence, and pictures; empty without one."""
    if not sampled_parameters(study):
        return "", "", []
    found = effects(study, weights, **bins)
    if not found.sizes["quantity"]:
        return words(_TEMPLATE).no_effects(), "", []
    rows = []
    for name in found.quantity.values.tolist():
        one = found.sel(quantity=name)
        scale, heading = _SHOWN.get(name, (1.0, f"{name.replace('_', ' ')} [{one.units.item()}]"))
        cells = [
            f"{100.0 * float(each.main_effect):+.3g} ± {100.0 * float(each.main_effect_error):.2g} % (ρ {float(each.rank_correlation):.2f})"
            if np.isfinite(each.rank_correlation)
            else "–"
            for each in (one.sel(parameter=key) for key in found.parameter.values)
        ]
        rows.append(
            (heading, " … ".join(number(scale * value, 3) for value in one["range"].values), *cells)
        )
    table = Table(
        ("", "5, 50 and 95 %", *map(str, found.parameter.values)),
        rows,
        f"{int(found.points)} points",
    )
    shown = [
        picture(
            plot_effects,
            f"Main effects on the {CRITERIA[name][2]}",
            found,
            name,
            **{**OPENING, "legend": ""},
        )
        for name in ("energy", "wear")
        if name in found.quantity
    ]
    driver = ""
    if "energy" in found.quantity and bool(
        found.rank_correlation.sel(quantity="energy").notnull().any()
    ):
        energy = found.sel(quantity="energy")
        first = energy.isel(parameter=int(np.nanargmax(np.abs(energy.rank_correlation.values))))
        numbers = 100.0 * float(first.main_effect), float(first.rank_correlation)
        driver = words(_TEMPLATE).driver(first.parameter.item(), *numbers)
    return words(_TEMPLATE).effects(table, shown), driver, shown


def situation(found: xr.Dataset, place: int) -> str:
    """Name of a bin: its wind speed, or its event."""
    event = str(found.event.values[place]) if "event" in found.coords else ""
    return event or f"{float(found.bin[place]):g} {found.bin.attrs['units']}"


def _year(found: xr.Dataset, names: list[str]) -> Table:
    rows = []
    more = {
        "entries": ("entries under slip", 1.0),
        "wear": ("wear [µm]", 1e6),
        "mixed_time": ("Λ < 1 [h]", 1.0 / 3600.0),
    }
    for group in range(found.sizes["group"]):
        for place in range(found.sizes["bin"]):
            here = found.isel(group=group, bin=place)
            share = (
                100.0 * here.energy.sum("row", skipna=False) / here.total.sum("row", skipna=False)
            )
            cells = [here.hours, *(1e-6 * here.energy), share, *here.per_hour, here.peak.max()]
            if "entries" in here:
                cells.append(here.entries.sum(skipna=False))
            cells += [
                more[name][1] * here[name].max(skipna=False)
                for name in ("wear", "mixed_time")
                if name in here
            ]
            rows.append(
                (names[group], situation(found, place), *(number(float(value)) for value in cells))
            )
    sides = found.row.values.tolist()
    headings = ("design", "situation", "hours a year", *(f"energy {row} [MJ]" for row in sides), "share of it [%]",
                *(f"in an hour {row} [J]" for row in sides), "largest power [W]",
                *(heading for name, (heading, _) in more.items() if name in found))  # fmt: skip
    return Table(
        headings,
        rows[:_MOST_LINES],
        "A year: energies of a mean roller; wear and Λ < 1 of the worse row",
    )


def case_names(study: xr.Dataset) -> list[str]:
    """Name of the case of every run: the fields of its loads, `14 m/s, seed 2`, or its loads where these do not tell cases apart."""
    labels = [
        str(name)
        for name in study.coords
        if study[name].dims == ("case",) and not is_parameter(study, str(name))
    ]
    fields = [name for name in labels if name not in (*_LEFT_OUT, *SEVERAL, "temperature")]
    loads = study.loads.values.astype(str)
    if fields and any("." in one for one in loads):  # names of files
        part = xr.Dataset(
            coords={name: ("group", study[name].values, study[name].attrs) for name in fields}
        )
        told = [one.replace("wind speed ", "") for one in design_names(part)]
        if len(set(told)) == len(set(loads)):
            return told
    return [one.rpartition("/")[2] for one in loads]


def run_names(study: xr.Dataset) -> list[str]:
    """Name of every run: its case, and its design where there are several."""
    labels = [
        name
        for name in study.coords
        if name in (*SEVERAL, "temperature") or is_parameter(study, str(name))
    ]
    coords = {
        name: ("group", study[name].values, study[name].attrs) for name in labels if name != "loads"
    }
    designed = design_names(xr.Dataset(coords=coords), 3)
    return [", ".join(filter(None, one)) for one in zip(case_names(study), designed, strict=True)]


def _extremes(study: xr.Dataset) -> dict[str, dict[str, Any]]:
    names, found = run_names(study), {}
    for name in _EXTREMES:
        values = -study[name] if name == "lowest_spin_ratio" else study[name]
        if bool(values.notnull().any()):
            place = values.argmax(["case", "row"])
            row, run = study.row[place["row"]].item(), names[int(place["case"])]
            found[name] = {
                "quantity": name,
                "value": float(study[name].isel(place)),
                "row": row,
                "run": run,
            }
    return found


def _plot_extremes(axes: Axes, study: xr.Dataset, order: list[int], name: str, label: str) -> Axes:
    values = study[name].transpose("case", "row").values
    extreme = (
        -study[name].min("row") if name == "lowest_spin_ratio" else study[name].max("row")
    ).values
    shown = np.sort(np.argsort(-np.nan_to_num(extreme, nan=-np.inf), kind="stable")[:_MOST_NAMES])
    names = case_names(study)
    if len(order) > 1:
        group = binned(study, None).group
        names = [f"{one} #{order.index(int(k)) + 1}" for one, k in zip(names, group, strict=True)]
    plot_by_result(
        axes, [names[case] for case in shown], study.row.values.tolist(), values[shown], label
    )
    if shown.size < study.sizes["case"]:
        axes.set_title(
            f"the {shown.size} most extreme of {study.sizes['case']} runs", fontsize=10, loc="left"
        )
    return axes


def _surface(
    study: xr.Dataset, weights: Weights, years: float, bins: dict[str, Any]
) -> Markup | str:
    if "surface_energy" not in study:
        return ""
    text = words(_TEMPLATE)
    try:
        maps = weighted_maps(study, weights, years=years, **bins).isel(group=0)
    except InputError as problem:
        return text.no_maps(str(problem))
    labels = ", ".join(
        str(maps[name].item()) for name in ("bearing", "lubricant", "model") if name in maps.coords
    )
    of = f"in {years:g} years, of the simulated rollers, {labels}"
    return text.turned() + words("result.html").surface(
        *map_pictures(energy_density(maps), maps.surface_power_density), of
    )


def _worst(study: xr.Dataset) -> list[Table]:
    tables = []
    for name in _WORST:
        found = as_table(worst(study, name, count=_WORST_COUNT), [name])
        found = found.drop(columns=[one for one in _LEFT_OUT if one in found])
        tables.append(_table(found, f"By {study[name].attrs['long_name']}"))
    return tables


def _failures(study: xr.Dataset) -> Table | None:
    failed = study.isel(case=np.flatnonzero(study.outcome.values != str(Outcome.COMPLETED)))
    if not failed.sizes["case"]:
        return None
    labels = [name for name, one in failed.coords.items() if one.dims == ("case",)]
    frame = failed[labels].reset_coords().to_dataframe().reset_index()
    columns = [name for name in frame if name not in _LEFT_OUT]
    return _table(
        frame[[*columns, "outcome", "reason"]], "Runs without a result, or with rollers that failed"
    )


def _table(frame: pd.DataFrame, caption: str) -> Table:
    def cell(value: Any) -> str:
        return number(float(value)) if isinstance(value, (float, np.floating)) else str(value)

    for name in [name for name in frame if str(name).endswith("[J]")]:
        factor, units = scaled(float(frame[name].max()), "J")
        frame = frame.assign(**{name: factor * frame[name]}).rename(
            columns={name: f"{name[:-3]}[{units}]"}
        )
    rows = [tuple(map(cell, line)) for line in frame.head(_MOST_LINES).itertuples(index=False)]
    more = f"; the first {_MOST_LINES} of {len(frame)}" if len(frame) > _MOST_LINES else ""
    return Table([str(name).replace("_", " ") for name in frame], rows, f"{caption}{more}")
