"""The page on a study: designs ranked, a year, effects, lifetime, exceedance, failures."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from macroslip.constants import HOURS_A_YEAR
from macroslip.errors import InputError
from macroslip.loads.source_file import without_folders
from macroslip.printed import number
from macroslip.report.comparison import compare_designs
from macroslip.report.page import Opening, Table, render, sections, words
from macroslip.report.provenance import provenance_section
from macroslip.report.ranking import ranking_sentences
from macroslip.report.result_numbers import rating_summary
from macroslip.report.results_page import map_pictures
from macroslip.report.run_names import INTERNAL, case_names, run_names, situation, study_about
from macroslip.report.study_figures import (
    EXCEEDED,
    drawable,
    plot_by_result,
    plot_effects,
    plot_exceedance,
    plot_lifetime,
)
from macroslip.report.style import OPENING, Picture, picture, scaled
from macroslip.result.criteria import YEARLY
from macroslip.result.criteria.criterion import PageColumn
from macroslip.result.plausibility import JUDGED, doubtful_result
from macroslip.result.surface_maps import energy_density
from macroslip.study.aggregation import Aggregation, aggregation_in_use
from macroslip.study.database import Outcome
from macroslip.study.effects import effects
from macroslip.study.exceedance import exceedance
from macroslip.study.export import as_table
from macroslip.study.labels import labels_over, sampled_parameters
from macroslip.study.lifetime import lifetime_energy, weighted_maps, worst
from macroslip.study.over_temperature import weighted_study
from macroslip.study.reader import incomplete_runs
from macroslip.study.weights import (
    IEC_CLASSES,
    BinProbabilities,
    Weibull,
    Year,
    binned,
)
from macroslip.study.year import DESIGN_COLUMNS, coverage, design_names, designs, year

if TYPE_CHECKING:
    import pandas as pd
    from markupsafe import Markup
    from matplotlib.axes import Axes

#: Wind speeds of a study that does not say which: Rayleigh with a mean of 10 m/s.
CLASS_ONE = IEC_CLASSES["IEC I"]
#: Variables of the summary whose largest values are shown, and how many of them.
_WORST = ("energy_mean", "orbit_energy_max", "peak_power_max")
_WORST_COUNT = 5
#: Labels of runs that a table leaves out where all runs have the same.
_COMMON = ("bearing", "lubricant", "model", "turbulence")
#: Lines of a table, of the opening's, and runs that a figure can name.
_MOST_LINES = 40
_MOST_DESIGNS = 8
_MOST_NAMES = 16
#: Pictures of the opening.
_MOST_PICTURES = 4
#: Variables of the summary in the opening, and the labels of their figures.
_EXTREMES = {
    "energy_mean": "energy of a mean roller [J]",
    "peak_power_max": "largest frictional power [W]",
    "lowest_spin_ratio": "lowest spin / pure rolling [–]",
}
#: Columns of the table of designs by the names of `macroslip.study.year.designs`.
_DESIGN_COLUMNS = {
    "energy": PageColumn("energy, both rows [MJ/year]", 1e-6),
    **{yearly.name: yearly.in_designs for yearly in YEARLY},
    "peak": PageColumn("largest power [W]"),
    "basic_life": PageColumn("life L10 [years]", 1.0 / HOURS_A_YEAR),
    "modified_reference_life": PageColumn("modified reference life [years]", 1.0 / HOURS_A_YEAR),
}
#: Columns of criteria in the table of situations by the names of `macroslip.study.year.year`.
_YEAR_COLUMNS = {yearly.name: yearly.in_year for yearly in YEARLY}
#: Quantities of whose effects there is a figure.
_FIRST = ("energy", *(yearly.name for yearly in YEARLY if yearly.leads))
_TEMPLATE = "study.html"


def study_page(
    study: xr.Dataset,
    *,
    title: str,
    weights: Weibull | BinProbabilities | None = None,
) -> str:
    """A page on a study: HTML in one piece, every name and text in it escaped.

    Without any weights, designs are ranked over all cases alike, and lifetime and exceedance are
    those of `CLASS_ONE`.

    Parameters
    ----------
    study : xarray.Dataset
        From `macroslip.open_study`.
    title : str
        Heading of the page.
    weights : Weibull or BinProbabilities, optional
        How likely each wind speed is; that of the study file if not given.

    Returns
    -------
    str
        The page.
    """
    study = weighted_study(study)
    text = words(_TEMPLATE)
    weighted = _weighted(study, weights)
    table, unknown = designs(weighted.year)
    notes = [weighted.note, *unknown]
    names = design_names(weighted.year)
    order = table.index.tolist()
    ranking = _ranking(study, weights)
    driver, effects_body, effect_pictures = _effects(study, weighted)
    lifetime, lifetime_pictures = _lifetime(weighted, order)
    exceeding, exceedance_pictures = _exceedance(weighted, order)
    bodies = {
        "designs": text.designs(_designs(table, names, _MOST_LINES), notes),
        "year": text.year(weighted.note, _year(weighted.year, names))
        if weighted.aggregation.weights
        else "",
        "effects": effects_body,
        "lifetime": lifetime,
        "exceedance": exceeding,
        "surface": _surface(weighted),
        "rating": _rating(study),
        "worst": text.worst(_worst(study)),
        "failures": text.failures(_failures(study)),
    }
    parts = sections(_TEMPLATE, bodies)
    if "status" in study:
        parts.append(provenance_section({study.attrs["title"] or "study": study}))
    parts += sections(_TEMPLATE, {"study": text.file(_without_folders(study.attrs["study"]))})
    answer = text.answer(
        {outcome.name: int((study.outcome.values == str(outcome)).sum()) for outcome in Outcome},
        ranking,
        notes,
        _extremes(study),
        driver,
        doubtful_result(study[[name for name in JUDGED if name in study]].median("case")),
    )
    pictures = [*effect_pictures[:1], *lifetime_pictures, *exceedance_pictures]
    most = _MOST_PICTURES - len(pictures)
    pictures += _extreme_pictures(study, weighted.study, order, most)
    opening = Opening(answer, pictures, table=_designs(table, names, _MOST_DESIGNS))
    return render(title, _subtitle(study, title), opening, parts)


@dataclass(frozen=True, slots=True)
class _Weighted:
    """The runs of a study, how much each counts, and the year that follows."""

    study: xr.Dataset  #: Points of a sample are no designs: they are pooled
    aggregation: Aggregation  #: Without weights where there are none, or they cannot be used
    year: xr.Dataset  #: From `macroslip.study.year.year`
    note: str  #: What share of a year the cases cover, or why the weights cannot be used

    @property
    def weighted_aggregation(self) -> Aggregation:
        """The aggregation, with the weights `CLASS_ONE` where it has none."""
        return replace(self.aggregation, weights=self.aggregation.weights or CLASS_ONE)

    @property
    def wind(self) -> Weibull | bool | None:
        """Distribution of the wind speed; None for `CLASS_ONE`, False for a list."""
        weights = self.aggregation.weights
        wind = weights.wind if isinstance(weights, Year) else weights
        return wind if wind is None or isinstance(wind, Weibull) else False


def _weighted(study: xr.Dataset, weights: Weibull | BinProbabilities | None) -> _Weighted:
    pooled = study.drop_vars(sampled_parameters(study))
    aggregation = aggregation_in_use(study, weights)
    try:
        of_year = year(pooled, aggregation)
    except InputError as problem:
        note = f"The weights cannot be used: {problem}"
        aggregation = replace(aggregation, weights=None)
        return _Weighted(pooled, aggregation, year(pooled, aggregation), note)
    return _Weighted(pooled, aggregation, of_year, coverage(of_year))


def _lifetime(weighted: _Weighted, order: Sequence[int]) -> tuple[Markup, list[Picture]]:
    """The section on lifetime energy, and its picture; groups in their order."""
    text = words(_TEMPLATE)
    try:
        life = lifetime_energy(weighted.study, weighted.weighted_aggregation)
    except InputError as problem:
        return text.no_lifetime(str(problem)), []
    pictures = []
    if shown := drawable(life.bin_energy, order):
        about = "Lifetime energy by wind speed"
        pictures = [picture(plot_lifetime, about, life, shown, **OPENING)]
    energies = _table(as_table(life, ["lifetime_energy"]), "Lifetime energy")
    covered = 100.0 * float(life.covered)
    return text.lifetime(
        weighted.aggregation.years, weighted.wind, covered, energies, pictures
    ), pictures


def _exceedance(weighted: _Weighted, order: Sequence[int]) -> tuple[Markup, list[Picture]]:
    """Section and pictures of orbits a year above an energy and a power."""
    text = words(_TEMPLATE)
    try:
        curves = exceedance(weighted.study, weighted.weighted_aggregation)
    except InputError as problem:
        return text.no_exceedance(str(problem)), []
    shown = drawable(curves.power_orbits, order)
    pictures = [
        picture(
            plot_exceedance,
            f"Orbits a year of a roller over the {label}",
            curves,
            name,
            shown,
            **OPENING,
        )
        for name, label in EXCEEDED.items()
        if shown
    ]
    return text.exceedance(weighted.wind, pictures), pictures


def _rating(study: xr.Dataset) -> Markup | str:
    rating = rating_summary(study)
    if rating is None:
        return ""
    rated = int(study.static_safety.notnull().sum())
    return words(_TEMPLATE).rating(rated, study.sizes["case"], rating)


def _without_folders(study: str) -> str:
    """A study as JSON, absolute paths of its files without their folders: a page is passed on."""

    def bare(value: Any) -> Any:
        if isinstance(value, list):
            return [bare(item) for item in value]
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


def _ranking(study: xr.Dataset, wind: Weibull | BinProbabilities | None) -> list[str]:
    """Sentences on the designs; none where there is one only."""
    try:
        return ranking_sentences(compare_designs(study, None, wind))
    except InputError:
        return []


def _shown(name: str, value: float) -> str:
    value *= _DESIGN_COLUMNS[name].factor
    return "> 500" if name.endswith("life") and value > 500.0 else number(value, 3)


def _designs(table: pd.DataFrame, names: list[str], most: int) -> Table:
    """The first designs of `macroslip.study.year.designs`, which have the least energy."""
    columns = [name for name in _DESIGN_COLUMNS if name in table]
    shown = table.loc[:, columns].head(most)
    rows = []
    for rank, (group, values) in enumerate(shown.to_dict("index").items(), start=1):
        name = names[int(group)]
        cells = (_shown(column, float(value)) for column, value in values.items())
        rows.append((f"{rank} {name}" if name else "the study", *cells))
    more = f"; the first {most} of {len(table)}" if len(table) > most else ""
    about = (
        "Designs by energy, the least first; energy and entries of both rows, all else of the worse "
        "row"
    )
    headings = (_DESIGN_COLUMNS[name].heading for name in columns)
    return Table(("design", *headings), rows, f"{about}{more}")


def _effects(
    study: xr.Dataset, weighted: _Weighted
) -> tuple[Markup | str, Markup | str, list[Picture]]:
    """Sensitivities of a sample: a sentence on the strongest, their section and pictures."""
    text = words(_TEMPLATE)
    if not sampled_parameters(study):
        return "", "", []
    drivers = effects(study, weighted.aggregation)
    if not drivers.sizes["quantity"]:
        return "", text.no_effects(), []
    table = Table(
        ("", "5, 50 and 95 %", *map(str, drivers.parameter.values)),
        [_effect_line(drivers.sel(quantity=name)) for name in drivers.quantity.values],
        f"{int(drivers.points)} points",
    )
    pictures = [
        picture(
            plot_effects,
            f"Main effects on the {DESIGN_COLUMNS[name].meaning}",
            drivers,
            name,
            **OPENING,
        )
        for name in _FIRST
        if name in drivers.quantity
    ]
    return _driver(drivers), text.effects(table, pictures), pictures


def _effect_line(effect_of_quantity: xr.Dataset) -> tuple[str, ...]:
    """A quantity with its range and the effect of every parameter."""
    name = effect_of_quantity.quantity.item()
    other = PageColumn(f"{name.replace('_', ' ')} [{effect_of_quantity.units.item()}]")
    column = _DESIGN_COLUMNS.get(name, other)
    cells = []
    for parameter in effect_of_quantity.parameter.values:
        of_parameter = effect_of_quantity.sel(parameter=parameter)
        effect = 100.0 * of_parameter.main_effect.item()
        error = 100.0 * of_parameter.main_effect_error.item()
        rank = of_parameter.rank_correlation.item()
        known = np.isfinite(rank)
        cells.append(f"{effect:+.3g} ± {error:.2g} % (ρ {rank:.2f})" if known else "–")
    return (
        column.heading,
        " … ".join(number(column.factor * end, 3) for end in effect_of_quantity["range"].values),
        *cells,
    )


def _driver(drivers: xr.Dataset) -> Markup | str:
    """The parameter that moves the energy most, in a sentence; empty where none is known to."""
    if "energy" not in drivers.quantity:
        return ""
    energy = drivers.sel(quantity="energy").dropna("parameter", subset=["rank_correlation"])
    if not energy.sizes["parameter"]:
        return ""
    strongest = abs(energy.rank_correlation).argmax("parameter")
    first = energy.isel(parameter=int(strongest))
    return words(_TEMPLATE).driver(
        first.parameter.item(), 100.0 * first.main_effect.item(), first.rank_correlation.item()
    )


def _year(annual: xr.Dataset, names: list[str]) -> Table:
    """Hours, energies and sums of every design and situation of a year."""
    criteria = [name for name in _YEAR_COLUMNS if _is_known(annual, name)]
    rows = []
    for group, bin_number in np.ndindex(annual.sizes["group"], annual.sizes["bin"]):
        here = annual.isel(group=group, bin=bin_number)
        energy = here.energy.sum("row", skipna=False)
        share = 100.0 * energy / here.total.sum("row", skipna=False)
        values = [here.hours, *(1e-6 * here.energy), share, *here.per_hour, here.peak.max()]
        for name in criteria:
            is_sum = DESIGN_COLUMNS[name].drawn == "sum"
            over_rows = here[name].sum if is_sum else here[name].max
            values.append(_YEAR_COLUMNS[name].factor * over_rows(skipna=False))
        cells = (number(float(value)) for value in values)
        rows.append((names[group], situation(annual, bin_number), *cells))
    sides = annual.row.values.tolist()
    headings = (
        "design",
        "situation",
        "hours a year",
        *(f"energy {row} [MJ]" for row in sides),
        "share of it [%]",
        *(f"in an hour {row} [J]" for row in sides),
        "largest power [W]",
        *(_YEAR_COLUMNS[name].heading for name in criteria),
    )
    about = "A year: energies of a mean roller; entries of both rows, other damage of the worse row"
    return Table(headings, rows[:_MOST_LINES], about)


def _is_known(annual: xr.Dataset, name: str) -> bool:
    """True if a year has a number for any situation that has a part of it."""
    if name not in annual:
        return False
    counted = annual[name].where(annual.hours > 0.0)
    return bool(counted.notnull().any())


def _extremes(study: xr.Dataset) -> list[dict[str, Any]]:
    """The run and row with the most extreme value of each quantity of `_EXTREMES` that is known."""
    names = run_names(study)
    extremes = []
    for quantity in _EXTREMES:
        values = study[quantity]
        if bool(values.notnull().any()):
            sign = -1.0 if quantity == "lowest_spin_ratio" else 1.0
            indices = (sign * values).argmax(["case", "row"])
            extreme = values.isel(indices)
            run = names[int(indices["case"])]
            extremes.append(
                {
                    "quantity": quantity,
                    "value": float(extreme),
                    "row": extreme.row.item(),
                    "run": run,
                }
            )
    return extremes


def _extreme_pictures(
    study: xr.Dataset, pooled: xr.Dataset, order: Sequence[int], most: int
) -> list[Picture]:
    """Pictures of `_EXTREMES` by run, with the number of its design if there are several."""
    names = case_names(study)
    if len(order) > 1:
        groups = binned(pooled, None).group
        designs_of_runs = [f"design {order.index(int(group)) + 1}" for group in groups]
        is_one_case = len(set(names)) == 1
        names = [
            design if is_one_case else f"{name}, {design}"
            for name, design in zip(names, designs_of_runs, strict=True)
        ]
    known = [name for name in _EXTREMES if bool(study[name].notnull().any())]
    return [
        picture(_plot_extremes, f"By run: {_EXTREMES[name]}", study[name], names, **OPENING)
        for name in known[:most]
    ]


def _plot_extremes(axes: Axes, values: xr.DataArray, names: Sequence[str]) -> Axes:
    """A value of the most extreme runs, over the names of the runs."""
    extreme = -values.min("row") if values.name == "lowest_spin_ratio" else values.max("row")
    known = np.nan_to_num(extreme.values, nan=-np.inf)
    ordered = np.argsort(-known, kind="stable")
    shown = np.sort(ordered[:_MOST_NAMES])
    by_row = values.transpose("case", "row").values[shown]
    label = _EXTREMES[str(values.name)]
    plot_by_result(axes, [names[case] for case in shown], values.row.values.tolist(), by_row, label)
    if shown.size < values.sizes["case"]:
        title = f"the {shown.size} most extreme of {values.sizes['case']} runs"
        axes.set_title(title, fontsize=10, loc="left")
    return axes


def _surface(weighted: _Weighted) -> Markup | str:
    if "surface_energy" not in weighted.study:
        return ""
    text = words(_TEMPLATE)
    try:
        maps = weighted_maps(weighted.study, weighted.weighted_aggregation).isel(group=0)
    except InputError as problem:
        return text.no_maps(str(problem))
    labels = ", ".join(
        str(maps[name].item()) for name in ("bearing", "lubricant", "model") if name in maps.coords
    )
    of = f"in {weighted.aggregation.years:g} years, of the simulated rollers, {labels}"
    return text.turned() + words("result.html").surface(
        *map_pictures(energy_density(maps), maps.surface_power_density), of
    )


def _worst(study: xr.Dataset) -> list[Table]:
    tables = []
    for name in _WORST:
        table = as_table(worst(study, name, count=_WORST_COUNT), [name])
        alike = [label for label in _COMMON if label in study and _has_one_value(study[label])]
        left_out = [column for column in (*INTERNAL, *alike) if column in table]
        table = table.drop(columns=left_out)
        tables.append(_table(table, f"By {study[name].attrs['long_name']}"))
    return tables


def _has_one_value(label: xr.DataArray) -> bool:
    return len(set(label.values.ravel().tolist())) == 1


def _failures(study: xr.Dataset) -> Table | None:
    failed = incomplete_runs(study)
    if not failed.sizes["case"]:
        return None
    frame = failed[labels_over(failed)].reset_coords().to_dataframe().reset_index()
    columns = [name for name in frame if name not in INTERNAL]
    return _table(
        frame[[*columns, "outcome", "reason"]], "Runs without a result, or with rollers that failed"
    )


def _table(frame: pd.DataFrame, caption: str) -> Table:
    def cell(value: Any) -> str:
        if isinstance(value, (float, np.floating)):
            return number(float(value))
        return str(value)

    for name in [name for name in frame if str(name).endswith("[J]")]:
        factor, units = scaled(float(frame[name].max()), "J")
        frame = frame.assign(**{name: factor * frame[name]}).rename(
            columns={name: f"{name[:-3]}[{units}]"}
        )
    shown = frame.head(_MOST_LINES)
    rows = [tuple(map(cell, line)) for line in shown.itertuples(index=False)]
    more = f"; the first {_MOST_LINES} of {len(frame)}" if len(frame) > _MOST_LINES else ""
    headings = [str(name).replace("_", " ") for name in frame]
    return Table(headings, rows, f"{caption}{more}")
