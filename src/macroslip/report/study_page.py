"""The page on a study of many cases: lifetime energy, exceedance, worst cases, failures."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.errors import InputError
from macroslip.report.page import Block, Paragraph, Pictures, Section, Table, Verbatim, render
from macroslip.report.pictures import picture
from macroslip.report.provenance import provenance_section
from macroslip.report.style import ROW, finish
from macroslip.study.exceedance import exceedance
from macroslip.study.export import table
from macroslip.study.lifetime import lifetime_energy, worst
from macroslip.study.outcome import Outcome
from macroslip.study.store import MANIFEST
from macroslip.study.weights import Weibull, Weights

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.axes import Axes

#: Wind speeds of IEC 61400-1, class I: Rayleigh with a mean of 10 m/s, so that the scale is 10 m/s / Γ(3/2).
CLASS_ONE = Weibull(11.284, 2.0)
#: Variables of the summary whose largest values are shown, and how many of them.
_WORST, _WORST_COUNT = ("energy_mean", "orbit_energy_max", "peak_power_max"), 5
#: Lines of a table, and groups of a picture.
_MOST_LINES, _MOST_GROUPS = 40, 4
#: Labels of a run that a reader does not need.
_LEFT_OUT = ("case", "run", "outcome", "reason", "key")
_NO_WEIGHTS = "wind speeds cannot be weighted:"


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
    sections = [
        Section("answer", "The answer", tuple(_overview(study))),
        Section("lifetime", "Lifetime energy", tuple(_lifetime(study, weights, years))),
        Section("exceedance", "Exceedance", tuple(_exceedance(study, weights))),
        Section("worst", "Worst cases", tuple(_worst(study))),
        Section("failures", "Failures", tuple(_failures(study))),
    ]
    if "status" in study:
        sections.append(provenance_section({study.attrs["title"] or "study": study}))
    sections.append(
        Section("study", "The study file", (Verbatim(study.attrs["study"], "The study as it was read, as JSON"),))
    )
    return render(title, str(study.attrs["title"]), sections)


def _overview(study: xr.Dataset) -> list[Block]:
    counts = {one: int((study.outcome.values == str(one)).sum()) for one in Outcome}
    failed = counts[Outcome.FAILED] + counts[Outcome.ROLLERS_FAILED]
    runs = study.sizes["case"]
    text = f"All {runs} runs completed." if counts[Outcome.COMPLETED] == runs else (
        f"{counts[Outcome.COMPLETED]} of {runs} runs completed, {failed} FAILED, {counts[Outcome.MISSING]} are missing."
    )  # fmt: skip
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
    return [Paragraph(text, strong=True), Table(headings, tuple(rows), "Over all runs with a result")]


def _lifetime(study: xr.Dataset, weights: Weights | None, years: float) -> list[Block]:
    try:
        life = lifetime_energy(study, weights or CLASS_ONE, years=years)
    except InputError as problem:
        return [Paragraph(f"There is no lifetime energy; {_NO_WEIGHTS} {problem}")]
    shown = table(life, ["lifetime_energy"])
    words = (
        f"Energy dissipated by a roller in {years:g} years, mean over the rollers of the row. {_weighted(weights)} The "
        f"wind speeds of the study are {100.0 * float(life.covered):.0f} % of all time; the rest counts as no energy."
    )

    def draw(axes: Axes, group: int) -> Axes:
        for row in life.row.values.tolist():
            one = life.bin_energy.isel(group=group).sel(row=row)
            axes.plot(one.bin.values, one.values, label=row, **{key: ROW[row][key] for key in ("color", "marker")})
        axes.set_ylim(bottom=0.0)
        return finish(axes, "wind speed [m/s]", "energy in the lifetime [J]", _group_title(life, group))

    pictures = tuple(
        picture(lambda axes, group=group: draw(axes, group), "Lifetime energy by wind speed", legend="above")
        for group in _groups(life.bin_energy)
    )
    blocks: list[Block] = [Paragraph(words), _frame(shown, "Lifetime energy")]
    return [*blocks, Pictures(pictures, "What each wind speed adds to it.")] if pictures else blocks


def _exceedance(study: xr.Dataset, weights: Weights | None) -> list[Block]:
    try:
        curves = exceedance(study, weights or CLASS_ONE)
    except InputError as problem:
        return [Paragraph(f"There are no exceedance curves: {problem}")]

    def draw(axes: Axes, name: str, group: int, label: str) -> Axes:
        for row in curves.row.values.tolist():
            one = curves[name].isel(group=group).sel(row=row)
            some = one.values > 0.0
            axes.plot(one.threshold.values[some], one.values[some], label=row, color=ROW[row]["color"])
        axes.set_xscale("log")
        axes.set_yscale("log")
        return finish(axes, label, "orbits a year above it", _group_title(curves, group))

    quantities = (("energy_orbits", "energy of an orbit [J]"), ("power_orbits", "peak power of an orbit [W]"))
    pictures = tuple(
        picture(
            lambda axes, name=name, group=group, label=label: draw(axes, name, group, label),
            f"Orbits a year of a roller over the {label}",
            legend="above",
        )
        for group in _groups(curves.power_orbits)
        for name, label in quantities
    )
    caption = "How many orbits a year of one roller exceed an energy, all interfaces, and a power, at any interface."
    if not pictures:
        return [Paragraph("There are no exceedance curves: not every wind speed has a result.")]
    return [Paragraph(_weighted(weights)), Pictures(pictures, caption)]


def _worst(study: xr.Dataset) -> list[Block]:
    blocks: list[Block] = []
    for name in _WORST:
        found = table(worst(study, name, count=_WORST_COUNT), [name])
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
    return [_frame(frame[[*columns, "outcome", "reason"]], "Runs without a result, or with rollers that failed")]


def _weighted(weights: Weights | None) -> str:
    if weights is None:
        return (
            "Wind speeds are weighted by IEC 61400-1, class I: a Rayleigh distribution with a mean of 10 m/s; give that "
            "of your site by --weibull."
        )
    if isinstance(weights, Weibull):
        return f"Wind speeds have a Weibull distribution with scale {weights.scale:g} m/s and shape {weights.shape:g}."
    return "Wind speeds have the probabilities given."


def _groups(values: xr.DataArray) -> list[int]:
    """The first groups that have something to draw."""
    positive = (values > 0.0).any([name for name in values.dims if name != "group"])
    return np.flatnonzero(positive.values)[:_MOST_GROUPS].tolist()


def _group_title(dataset: xr.Dataset, group: int) -> str:
    """What tells a group from the others; empty if there is one."""
    if dataset.sizes["group"] < 2:
        return ""
    labels = [one for one in dataset.coords.values() if one.dims == ("group",) and np.unique(one.values).size > 1]
    return ", ".join(str(one.values[group]) for one in labels)


def _frame(frame: pd.DataFrame, caption: str) -> Table:
    rows = [tuple(map(_cell, line)) for line in frame.head(_MOST_LINES).itertuples(index=False)]
    more = f"; the first {_MOST_LINES} of {len(frame)}" if len(frame) > _MOST_LINES else ""
    return Table(tuple(map(str, frame.columns)), tuple(rows), f"{caption}{more}")


def _cell(value: Any) -> str:
    return _number(value) if isinstance(value, (float, np.floating)) else str(value)


def _number(value: float) -> str:
    return f"{value:.4g}" if np.isfinite(value) else "–"
