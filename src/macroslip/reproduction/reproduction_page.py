"""The report of the reproduction: the paper's statements and figures beside converged results, and what lies beyond."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from macroslip.input.units import with_unit
from macroslip.report.bearing_section import roller_sections, view_section
from macroslip.report.page import Block, Paragraph, Pictures, Points, Section, Statements, Table, render
from macroslip.report.pictures import picture
from macroslip.report.provenance import provenance_section
from macroslip.reproduction import paper_comparison
from macroslip.reproduction.opening import reproduction_opening
from macroslip.reproduction.physical_section import physical_sections
from macroslip.reproduction.sensitivity_figures import plot_tornado
from macroslip.reproduction.statement import Statement

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.reproduction.model_run import ModelRun

TITLE = "Slip in a main bearing: what the paper found, and what a converged solution finds"
_PAPER = "Hart et al., Dynamic modelling of slip in a wind turbine spherical roller main bearing"


def reproduction_page(
    runs: Mapping[str, ModelRun],
    experiments: Mapping[str, xr.Dataset],
    judged: Mapping[str, Mapping[str, Statement]],
    summary: Mapping[str, Any],
) -> str:
    """The page `report.html` of the reproduction.

    Parameters
    ----------
    runs : mapping
        What was computed, by model.
    experiments : mapping
        "A1", "nonlinear_tolerance", "step_size".
    judged : mapping
        The paper's statements by model and subject.
    summary : mapping
        As `summary.json`: `failed_rollers`, `seconds`, `reused`, `conventions`.

    Returns
    -------
    str
        HTML in one piece.
    """
    sections = [
        _statements(judged),
        *paper_comparison.sections(runs, experiments),
        *physical_sections(runs),
        view_section({_titled("case 14B", name, runs): run.profile for name, run in runs.items()}),
        *(section for name, run in runs.items() for section in _beyond(name, run, runs)),
        _sensitivity(runs),
        Section(
            "conventions",
            "How the numbers were taken",
            (Points(tuple(summary["conventions"])),),
            "windows, means, normalisation, when a number counts as met",
        ),
        provenance_section(
            {name: run.study for name, run in runs.items()}, seconds=summary["seconds"], reused=tuple(summary["reused"])
        ),
    ]
    subtitle = (
        f"{_PAPER}, beside the same equations solved to convergence: 21 load cases of ten minutes, 28 rollers in each "
        f"of two rows. {'' if len(runs) > 1 else 'Model: ' + next(iter(runs)) + '.'}"
    )
    return render(TITLE, subtitle, reproduction_opening(runs, experiments, judged, summary), sections)


def _titled(title: str, model: str, runs: Mapping[str, ModelRun]) -> str:
    return f"{title}, model {model}" if len(runs) > 1 else title


def _statements(judged: Mapping[str, Mapping[str, Statement]]) -> Section:
    rows = tuple(
        (
            first.paper,
            tuple((one.verdict, one.found, one.because) for one in (model[subject] for model in judged.values())),
        )
        for subject, first in next(iter(judged.values())).items()
    )
    gist = "each with verdict, number and, where it differs, what explains it"
    return Section("statements", "The paper's statements, one by one", (Statements(tuple(judged), rows),), gist)


def _beyond(name: str, run: ModelRun, runs: Mapping[str, ModelRun]) -> list[Section]:
    suffix = "" if name == next(iter(runs)) else f"-{name}"
    group = _titled("All rollers in case 14B", name, runs)
    words = "Case 14B: all 28 rollers of each row, ten minutes at a mean wind speed of 14 m/s."
    sections = roller_sections(
        run.profile["result"], run.profile, suffix=suffix, group=group, first=(Paragraph(words),)
    )
    films = sections[-1]
    return [*sections[:-1], dataclasses.replace(films, blocks=(*films.blocks, _film_range_table(run.study)))]


def _film_range_table(study: xr.Dataset) -> Table:
    share = 100.0 * study.outside_film_range
    rows = []
    for row in study.row.values.tolist():
        for interface in study.interface.values.tolist():
            one = share.sel(row=row, interface=interface).mean("roller")
            rows.append((row, interface, f"{float(one.min()):.3g}", f"{float(one.max()):.3g}"))
    headings = ("row", "interface", "least of the cases [%]", "most of the cases [%]")
    return Table(headings, tuple(rows), "Share of loaded time outside the film formula's range, all 21 cases")


def _sensitivity(runs: Mapping[str, ModelRun]) -> Section:
    blocks: list[Block] = [
        Paragraph(
            "Case 14B with one value changed at a time, everything else as it is, from a run of its own for every bar. "
            "The value that was set is written at its bar; low values are hatched."
        )
    ]
    for name, run in runs.items():
        table = run.sensitivity
        words = {"energy": "energy in the window", "peak_power": "mean of the largest power per orbit"}
        pictures = tuple(
            picture(
                lambda axes, quantity=quantity, row=row, table=table: plot_tornado(axes, table, quantity, row),
                f"Tornado chart: {words[quantity]} of the {row} row",
                width=4.4,
                height=2.7,
            )
            for quantity in words
            for row in table.row.values.tolist()
        )
        blocks.append(Pictures(pictures, f"Energy above, largest power per orbit below{_titled('', name, runs)}."))
        blocks.append(_sensitivity_table(table))
        names = table.variation.values.tolist()
        notes = [f"{one}: {note}" for one, note in zip(names, table.note.values.tolist(), strict=True) if note]
        texts = zip(names, table.refused.values.tolist(), strict=True)
        refused = [f"{one}: {text} The next one towards the base case was taken" for one, text in texts if text]
        blocks.append(Points(tuple(f"{note[0].upper()}{note[1:]}." for note in (*notes, *refused))))
    gist = "one value changed at a time: oil temperature, clearance, osculation, lever arm, film thickness"
    return Section("sensitivity", "What the result depends on", tuple(blocks), gist)


def _sensitivity_table(table: xr.Dataset) -> Table:
    rows, sides = [], table.row.values.tolist()
    for k, name in enumerate(table.variation.values.tolist()):
        one = table.isel(variation=k)
        unit = str(one.unit.values)
        for level in ("low", "base", "high"):
            at = one.sel(level=level)
            if level != "base" and float(at.value) == float(one.value.sel(level="base")):
                continue
            cells = [f"{float(at[what].sel(row=row)):.4g}" for what in ("energy", "peak_power") for row in sides]
            rows.append((name, with_unit(f"{float(at.value):g}", unit), *cells))
    of = [f"{what}, {row} [{unit}]" for what, unit in (("energy", "J"), ("mean P_max", "W")) for row in sides]
    return Table(("value", "set to", *of), tuple(rows))
