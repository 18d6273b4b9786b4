"""The report of any results: of `macroslip run`, or of a study over many cases, without a comparison."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from macroslip.errors import InputError
from macroslip.imposed.status import Status
from macroslip.report.bearing_figures import plot_case_energies
from macroslip.report.bearing_section import further_blocks, roller_sections, view_section
from macroslip.report.page import Block, Paragraph, Pictures, Points, Section, Table, render
from macroslip.report.pictures import picture
from macroslip.report.provenance import provenance_section
from macroslip.report.rating_section import rating_blocks
from macroslip.report.result_opening import result_opening, results_opening
from macroslip.report.surface_section import surface_blocks
from macroslip.report.whole_section import whole_blocks
from macroslip.result.orbit_profile import orbit_profile

if TYPE_CHECKING:
    import xarray as xr

#: Results shown roller by roller, and with the bearing in motion, on one page; the table holds all of them.
DETAILED, MOVING = 6, 3


def results_page(results: Mapping[str, xr.Dataset], *, title: str = "Slip of the rollers") -> str:
    """A page on results of `macroslip.simulate` and on studies.

    Parameters
    ----------
    results : mapping
        Datasets by name. A result has `energy` [J] over (row, roller, interface) and `status` over (row, roller); a
        study has them over `case` too. Variables beyond these, and traces, add to the page.
    title : str

    Returns
    -------
    str
        HTML in one piece, every name and text in it escaped.

    Raises
    ------
    InputError
        If there is no dataset, or one is neither a result nor a study.
    """
    if not results:
        raise InputError("there is no result to report on")
    for name, dataset in results.items():
        missing = [one for one in ("energy", "status") if one not in dataset]
        missing += [one for one in ("row", "roller", "interface") if one not in dataset.dims]
        if missing:
            raise InputError(
                f"the dataset has no {', no '.join(missing)}",
                where=name,
                allowed="what macroslip run, macroslip.simulate or a study gives",
            )
    studies = {name: one for name, one in results.items() if "case" in one.dims}
    single = {name: one for name, one in results.items() if name not in studies}
    shown = dict(list(single.items())[:DETAILED])
    profiles, notes = _profiles(shown)
    sections = [_overview(single, studies)]
    moving = dict(list(profiles.items())[:MOVING])
    if moving:
        sections.append(view_section(moving))
    for number, (name, result) in enumerate(shown.items()):
        first = [Paragraph(str(result.attrs.get("title", "")))]
        if name in notes:
            first.append(Paragraph(f"Energy over the orbit, films and the moving bearing need traces: {notes[name]}"))
        group = name if len(results) > 1 else ""
        sections += _of_result(result, profiles.get(name), number, group, first)
        if whole := whole_blocks(result, results):
            gist = "cage, pockets and balances where the rollers move in their pockets"
            suffix = f"-{number}" if number else ""
            sections.append(Section(f"whole{suffix}", "Orbit and spin together", whole, gist, group))
    for number, (name, study) in enumerate(studies.items()):
        sections.append(Section(f"study-{number}", name, _study_blocks(study)))
    sections.append(provenance_section(results))
    if len(results) == 1 and single:
        (result,) = single.values()
        return render(title, _subtitle(result), result_opening(result, next(iter(profiles.values()), None)), sections)
    count = f"{len(results)} dataset{'' if len(results) == 1 else 's'}"
    subtitle = f"{count}: {', '.join(list(results)[:8])}{' …' if len(results) > 8 else ''}."
    return render(title, subtitle, results_opening(single | _cases(studies)), sections)


def _subtitle(result: xr.Dataset) -> str:
    """What was computed: bearing, loads, model."""
    parts = [str(result.attrs.get("title", "")).rstrip(".")]
    parts += [f"model {result.attrs['model']}"] if "model" in result.attrs else []
    if "window_end" in result.attrs:
        parts.append(f"{float(result.attrs['window_start']):.4g} s to {float(result.attrs['window_end']):.4g} s")
    return f"{', '.join(filter(None, parts))}."


def _of_result(
    result: xr.Dataset, profile: Mapping[str, xr.Dataset] | None, number: int, group: str, first: list[Paragraph]
) -> list[Section]:
    """Sections on one result; the first of several has no number in their names."""
    suffix = f"-{number}" if number else ""
    result = result.drop_dims("time") if "time" in result.dims else result
    further = (
        ("surface", "Where the surface suffers", surface_blocks(result), "energy and power per area on the raceways"),
        ("rating", "Numbers beside slip", rating_blocks(result), "rating lives, static safety, pressure, load spectra"),
    )
    sections = roller_sections(result, profile, suffix=suffix, group=group, first=first)
    return sections + [
        Section(f"{name}{suffix}", title, blocks, gist, group) for name, title, blocks, gist in further if blocks
    ]


def _cases(studies: Mapping[str, xr.Dataset]) -> dict[str, xr.Dataset]:
    """The cases of studies, as results."""
    return {
        f"{name}, {case}" if len(studies) > 1 else str(case): study.sel(case=case)
        for name, study in studies.items()
        for case in study.case.values.tolist()
    }


def _profiles(results: Mapping[str, xr.Dataset]) -> tuple[dict[str, dict[str, xr.Dataset]], dict[str, str]]:
    """What the traces give, and the reason where they give nothing."""
    profiles, notes = {}, {}
    for name, result in results.items():
        try:
            profiles[name] = orbit_profile(result)
        except InputError as error:
            notes[name] = str(error)
    return profiles, notes


def _overview(single: Mapping[str, xr.Dataset], studies: Mapping[str, xr.Dataset]) -> Section:
    rows = [line for name, one in single.items() for line in _rows(name, one)]
    for name, study in studies.items():
        for case in study.case.values.tolist():
            rows += _rows(f"{name}, {case}", study.sel(case=case))
    headings = (
        "",
        "row",
        "mean energy of a roller [J]",
        "least [J]",
        "most [J]",
        "highest P_max [W]",
        "lowest spin / pure rolling",
        "failed rollers",
    )
    blocks: list[Block] = [Table(headings, tuple(rows))]
    lines = [line for name, one in single.items() for line in _failures(name, one)]
    if lines:
        blocks.append(Points(tuple(lines)))
    if len(single) > len(list(single)[:DETAILED]):
        blocks.append(Paragraph(f"The first {DETAILED} results are shown roller by roller."))
    return Section("numbers", "The numbers", tuple(blocks), "energy, power, spin and failures, row by row")


def _rows(name: str, result: xr.Dataset) -> list[tuple[str, ...]]:
    rows = []
    for row in result.row.values.tolist():
        one = result.sel(row=row)
        energy = one.energy.sum("interface", skipna=False)
        peak = one.peak_power if "peak_power" in one else one.get("peak_power_max")
        spin = one.get("min_spin_ratio")
        values = [energy.mean("roller", skipna=False), energy.min("roller"), energy.max("roller")]
        values += [peak.max() if peak is not None and peak.size else None, spin.min() if spin is not None else None]
        rows.append((name, row, *map(_number, values), f"{int((one.status != 0).sum())} of {one.sizes['roller']}"))
    return rows


def _number(value: xr.DataArray | None) -> str:
    return "–" if value is None or not bool(value.notnull()) else f"{float(value):.4g}"


def _failures(name: str, result: xr.Dataset) -> list[str]:
    lines = []
    for row in result.row.values.tolist():
        for roller in result.roller.values.tolist():
            one = result.sel(row=row, roller=roller)
            if int(one.status) != Status.COMPLETED and "end_time" in one:
                lines.append(
                    f"{name}: roller {roller} of the {row} row ended at t = {float(one.end_time):.6g} s: "
                    f"{Status(int(one.status)).sentence}."
                )
    return lines


def _study_blocks(study: xr.Dataset) -> tuple[Block, ...]:
    pictures = [
        picture(
            lambda axes: plot_case_energies(axes, study),
            "Energy of a roller by case and row",
            width=min(8.6, max(4.2, 0.28 * study.sizes["case"])),
            height=3.4,
            legend="above",
            wide=study.sizes["case"] > 15,
        )
    ]
    caption = "Energy by case: mean over the rollers of each row, bars from the least to the most."
    mean = study.mean("case", skipna=True, keep_attrs=True)
    return (
        Paragraph(str(study.attrs.get("title", ""))),
        Pictures(tuple(pictures), caption),
        *further_blocks(mean),
    )
