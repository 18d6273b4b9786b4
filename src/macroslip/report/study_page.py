"""The page on a study of many cases: lifetime energy, exceedance, worst cases, failures."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.errors import InputError
from macroslip.loads.source_file import without_folders
from macroslip.report.page import Block, Paragraph, Pictures, Section, Table, Verbatim, render
from macroslip.report.pictures import picture
from macroslip.report.provenance import provenance_section
from macroslip.report.rating_section import rating_summary
from macroslip.report.study_figures import EXCEEDED, groups, plot_exceedance, plot_lifetime
from macroslip.report.study_opening import study_opening
from macroslip.report.surface_section import lifetime_blocks
from macroslip.study.exceedance import exceedance
from macroslip.study.export import as_table
from macroslip.study.lifetime import lifetime_energy, worst
from macroslip.study.outcome import Outcome
from macroslip.study.store import MANIFEST
from macroslip.study.weights import Weibull, Weights

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

#: Wind speeds of IEC 61400-1, class I: Rayleigh with a mean of 10 m/s, so that the scale is 10 m/s / Γ(3/2).
CLASS_ONE = Weibull(11.284, 2.0)
#: Variables of the summary whose largest values are shown, and how many of them.
_WORST, _WORST_COUNT = ("energy_mean", "orbit_energy_max", "peak_power_max"), 5
#: Lines of a table.
_MOST_LINES = 40
#: Labels of a run that a reader does not need.
_LEFT_OUT = ("case", "run", "outcome", "reason", "key")


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
    life, no_life = _or_reason(lambda: lifetime_energy(study, weights or CLASS_ONE, years=years))
    curves, no_curves = _or_reason(lambda: exceedance(study, weights or CLASS_ONE))
    lifetime = (
        _lifetime(life, weights, years) if life is not None else [Paragraph(f"There is no lifetime energy; {no_life}")]
    )
    exceeded = (
        _exceedance(curves, weights)
        if curves is not None
        else [Paragraph(f"There are no exceedance curves: {no_curves}")]
    )
    sections = [
        Section("runs", "All runs", tuple(_overview(study)), "mean and extreme energies, powers and spins, row by row"),
        Section(
            "lifetime", "Lifetime energy", tuple(lifetime), f"energy of a roller in {years:g} years, by wind speed"
        ),
        Section("exceedance", "Exceedance", tuple(exceeded), "how many orbits a year exceed an energy and a power"),
        *_further(study, weights, years),
        Section("worst", "Worst cases", tuple(_worst(study)), f"the {_WORST_COUNT} runs with the largest values"),
        Section("failures", "Failures", tuple(_failures(study)), "runs without a result, with the reason"),
    ]
    if "status" in study:
        sections.append(provenance_section({study.attrs["title"] or "study": study}))
    file = Verbatim(_without_folders(study.attrs["study"]), "The study as it was read, as JSON")
    sections.append(Section("study", "The study file", (file,), "the study as it was read"))
    return render(title, _subtitle(study, title), study_opening(study, life, curves), sections)


def _subtitle(study: xr.Dataset, title: str) -> str:
    """Title of the study, if the page has another, and how many runs of what it has."""
    parts = []
    for name, several in (
        ("loads", "load histories"),
        ("bearing", "bearings"),
        ("lubricant", "lubricants"),
        ("model", "models"),
    ):
        values = np.unique(study[name].values)
        parts.append(f"{values.size} {several}" if values.size > 1 else f"{name} {values[0]}")
    own = f"{study.attrs['title']}: " if study.attrs["title"] not in ("", title) else ""
    return f"{own}{study.sizes['case']} runs, {', '.join(parts)}."


def _or_reason(make: Callable[[], xr.Dataset]) -> tuple[xr.Dataset | None, str]:
    """What can be made of a study, or why it cannot."""
    try:
        return make(), ""
    except InputError as problem:
        return None, str(problem)


def _further(study: xr.Dataset, weights: Weights | None, years: float) -> list[Section]:
    """Maps of the raceways and the rating, where the runs have them."""
    parts = (
        (
            "surface",
            "Where the surface suffers",
            lifetime_blocks(study, weights or CLASS_ONE, years),
            "energy and power per area on the raceways over the lifetime",
        ),
        ("rating", "Numbers beside slip", rating_summary(study), "rating lives, static safety, pressure"),
    )
    return [Section(name, title, blocks, gist) for name, title, blocks, gist in parts if blocks]


def _overview(study: xr.Dataset) -> list[Block]:
    rows = []
    for row in study.row.values.tolist():
        one = study.sel(row=row)
        values = (one.energy_mean.mean(), one.energy_max.max(), one.peak_power_max.max(), one.lowest_spin_ratio.min())
        rows.append((row, *(_number(float(value)) for value in values)))
    headings = (
        "row",
        "mean energy of a roller in a run [J]",
        "highest energy of a roller in a run [J]",
        "highest peak power [W]",
        "lowest spin / pure rolling",
    )
    return [Table(headings, tuple(rows), "Over all runs with a result")]


def _lifetime(life: xr.Dataset, weights: Weights | None, years: float) -> list[Block]:
    shown = as_table(life, ["lifetime_energy"])
    words = (
        f"Energy dissipated by a roller in {years:g} years, mean over the rollers of the row. {_weighted(weights)} The "
        f"wind speeds of the study are {100.0 * float(life.covered):.0f} % of all time; the rest counts as no energy."
    )

    pictures = tuple(
        picture(
            lambda axes, group=group: plot_lifetime(axes, life, group), "Lifetime energy by wind speed", legend="above"
        )
        for group in groups(life.bin_energy)
    )
    blocks: list[Block] = [Paragraph(words), _frame(shown, "Lifetime energy")]
    return [*blocks, Pictures(pictures, "What each wind speed adds to it.")] if pictures else blocks


def _exceedance(curves: xr.Dataset, weights: Weights | None) -> list[Block]:
    pictures = tuple(
        picture(
            lambda axes, name=name, group=group: plot_exceedance(axes, curves, name, group),
            f"Orbits a year of a roller over the {label}",
            legend="above",
        )
        for group in groups(curves.power_orbits)
        for name, label in EXCEEDED.items()
    )
    caption = "How many orbits a year of one roller exceed an energy, all interfaces, and a power, at any interface."
    if not pictures:
        return [Paragraph("There are no exceedance curves: not every wind speed has a result.")]
    return [Paragraph(_weighted(weights)), Pictures(pictures, caption)]


def _worst(study: xr.Dataset) -> list[Block]:
    blocks: list[Block] = []
    for name in _WORST:
        found = as_table(worst(study, name, count=_WORST_COUNT), [name])
        about = study[name].attrs["long_name"]
        blocks.append(_frame(found.drop(columns=[one for one in _LEFT_OUT if one in found]), f"By {name}: {about}"))
    return blocks


def _failures(study: xr.Dataset) -> list[Block]:
    failed = study.isel(case=np.flatnonzero(study.outcome.values != str(Outcome.COMPLETED)))
    if not failed.sizes["case"]:
        return [Paragraph("No run failed, and none is missing.")]
    labels = [name for name, one in failed.coords.items() if one.dims == ("case",)]
    frame = failed[labels].reset_coords().to_dataframe().reset_index()
    columns = [name for name in frame if name not in ("case", "run", "key", "outcome", "reason")]
    failures = frame[[*columns, "outcome", "reason"]]
    blocks: list[Block] = []
    blocks.append(_frame(failures, "Runs without a result, or with rollers that failed"))
    return blocks


def _weighted(weights: Weights | None) -> str:
    if weights is None:
        return (
            "Wind speeds are weighted by IEC 61400-1, class I: a Rayleigh distribution with a mean of 10 m/s; give that "
            "of your site by --weibull."
        )
    if isinstance(weights, Weibull):
        return f"Wind speeds have a Weibull distribution with scale {weights.scale:g} m/s and shape {weights.shape:g}."
    return "Wind speeds have the probabilities given."


def _frame(frame: pd.DataFrame, caption: str) -> Table:
    rows = [tuple(map(_cell, line)) for line in frame.head(_MOST_LINES).itertuples(index=False)]
    more = f"; the first {_MOST_LINES} of {len(frame)}" if len(frame) > _MOST_LINES else ""
    return Table(tuple(map(str, frame.columns)), tuple(rows), f"{caption}{more}")


def _cell(value: Any) -> str:
    return _number(value) if isinstance(value, (float, np.floating)) else str(value)


def _number(value: float) -> str:
    return f"{value:.4g}" if np.isfinite(value) else "–"
