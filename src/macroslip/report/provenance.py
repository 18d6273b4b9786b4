"""Where a page's numbers come from: program, machine, inputs, tolerances, how integrations ended, works cited."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from macroslip.imposed.status import Status
from macroslip.input.record import TAGS
from macroslip.input.units import with_unit
from macroslip.machine import machine
from macroslip.report.bibliography import bibtex
from macroslip.report.page import Paragraph, Section, Table, Verbatim

if TYPE_CHECKING:
    import xarray as xr


def provenance_section(
    datasets: Mapping[str, xr.Dataset], *, seconds: Mapping[str, float] | None = None, reused: tuple[str, ...] = ()
) -> Section:
    """The section on the origin of every number of a page.

    Parameters
    ----------
    datasets : mapping
        Results or studies by name, with the attributes that `macroslip.simulate` gives them.
    seconds : mapping, optional
        Wall time by stage [s].
    reused : tuple of str
        Parts that an earlier run had computed.
    """
    blocks: list[Any] = [_program(datasets, seconds, reused), _statuses(datasets)]
    for part in ("bearing", "lubricant", ""):
        blocks += _input_tables(datasets, part)
    loads = _loads(datasets)
    if loads.rows:
        blocks.append(loads)
    notes = sorted({line for one in datasets.values() for line in one.attrs.get("film_range_notes", "").splitlines()})
    if notes:
        blocks.append(Paragraph(f"Outside the film formula's range whatever the load: {'; '.join(notes)}."))
    cited = dict.fromkeys(line for one in datasets.values() for line in one.attrs.get("citations", "").splitlines())
    blocks.append(Verbatim(bibtex(cited), "Works this rests on, as BibTeX"))
    return Section(
        "provenance",
        "Where the numbers come from",
        tuple(blocks),
        "program, machine, every input with its source, how the integrations ended, works cited",
    )


def _program(datasets: Mapping[str, xr.Dataset], seconds: Mapping[str, float] | None, reused: tuple[str, ...]) -> Table:
    sources = sorted({one.attrs.get("source", "not given") for one in datasets.values()})
    rows = [("computed by", ", ".join(sources))]
    rows += [(f"this page: {key}", str(value)) for key, value in machine().items() if value is not None]
    if seconds:
        rows.append(("time taken", ", ".join(f"{stage} {value:.1f} s" for stage, value in seconds.items())))
    if reused:
        rows.append(("taken from an earlier run with the same inputs", ", ".join(reused)))
    return Table(("", ""), tuple(rows), "Program and machine")


def _statuses(datasets: Mapping[str, xr.Dataset]) -> Table:
    rows = []
    for name, dataset in datasets.items():
        for status in Status:
            count = int((dataset.status == status).sum())
            if count:
                rows.append((name, str(count), status.sentence))
    return Table(("", "integrations of rollers", "how they ended"), tuple(rows), "Status of the integrations")


def _input_tables(datasets: Mapping[str, xr.Dataset], part: str) -> list[Table]:
    """A table of each different bearing or lubricant, or of each different rest of the input, and whose it is."""
    found: dict[str, list[str]] = {}
    for name, dataset in datasets.items():
        given = _input(dataset)
        rest = {key: one for key, one in given.items() if key not in ("bearing", "lubricant", "loads")}
        value = given.get(part) if part else rest
        if isinstance(value, dict) and value:
            found.setdefault(json.dumps(value, ensure_ascii=False), []).append(name)
    tables = []
    for text, names in found.items():
        of = f" ({', '.join(names)})" if len(found) > 1 else ""
        value = json.loads(text)
        rows = tuple((key, _input_text(one)) for key, one in value.items())
        further = Table(("input", "value (SI units)"), rows, f"Further input{of}")
        tables.append(_record(value, f"{part}{of}") if part else further)
    return tables


def _input(dataset: xr.Dataset) -> dict[str, Any]:
    try:
        given = json.loads(dataset.attrs["input"])
    except (KeyError, TypeError, ValueError):
        return {}
    return given if isinstance(given, dict) else {}


def _record(entries: Mapping[str, Any], title: str) -> Table:
    rows = []
    for key, entry in entries.items():
        if isinstance(entry, dict):
            tag = str(entry.get("tag", ""))
            value = with_unit(entry.get("value"), str(entry.get("unit", "")))
            rows.append((key, value, TAGS.get(tag, tag), str(entry.get("note", ""))))
        else:
            rows.append((key, str(entry), "", ""))
    return Table(("quantity", "value", "from", "note"), tuple(rows), title[:1].upper() + title[1:])


def _loads(datasets: Mapping[str, xr.Dataset]) -> Table:
    rows = []
    for name, dataset in datasets.items():
        given = _input(dataset).get("loads", [])
        for one in given if isinstance(given, list) else [given]:
            values = [str(one.get(key, "")) for key in ("source", "samples", "start", "end", "sha256")]
            rows.append((name, *values[:4], values[4][:16]))
    return Table(("", "loads", "samples", "from [s]", "to [s]", "SHA-256 begins"), tuple(dict.fromkeys(rows)), "Loads")


def _input_text(value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{key} {_input_text(one)}" for key, one in value.items())
    return "none" if value is None else str(value)
