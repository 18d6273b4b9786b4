"""Provenance of a page's numbers: program, inputs, tolerances, statuses, works cited."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from importlib import resources
from typing import Any

import xarray as xr

import macroslip
from macroslip.imposed.status import Status
from macroslip.input.record import TAGS
from macroslip.input.units import with_unit
from macroslip.machine import machine
from macroslip.report.page import Section, Table, sections, words
from macroslip.result.run_input import stored_settings

_DOI = re.compile(r"doi:\s*(10\.\S+?)[.;,)]?(?=\s|$)")


def provenance_section(datasets: Mapping[str, xr.Dataset]) -> Section:
    """The section on the origin of every number of a page, of results or studies by name."""
    settings = {name: stored_settings(dataset) for name, dataset in datasets.items()}
    programs = {dataset.attrs.get("source", "not given") for dataset in datasets.values()}
    sources = sorted(programs)
    program = [("computed by", ", ".join(sources))]
    program += [
        (f"this page: {key}", str(value)) for key, value in machine().items() if value is not None
    ]
    ends = [
        (name, str(count), status.sentence)
        for name, dataset in datasets.items()
        for status in Status
        if (count := int((dataset.status == status).sum()))
    ]
    tables = [
        Table(("", ""), program, "Program and machine"),
        Table(
            ("", "integrations of rollers", "how they ended"), ends, "Status of the integrations"
        ),
    ]
    for part in ("bearing", "lubricant", ""):
        tables += _input_tables(settings, part)
    if (loads := _loads(settings)).rows:
        tables.append(loads)
    notes = sorted(set(_lines(datasets, "film_range_notes")))
    supply = sorted(set(_lines(datasets, "oil_supply_note")))
    body = words("provenance.html").provenance(
        tables, notes, supply, bibtex(dict.fromkeys(_lines(datasets, "citations")))
    )
    return sections("provenance.html", {"provenance": body})[0]


def _lines(datasets: Mapping[str, xr.Dataset], attribute: str) -> list[str]:
    return [
        line
        for dataset in datasets.values()
        for line in dataset.attrs.get(attribute, "").splitlines()
    ]


def _input_tables(settings_by_name: Mapping[str, Mapping[str, Any]], part: str) -> list[Table]:
    """A table of each different bearing, lubricant or rest of the input, and whose it is."""
    names_by_content: dict[str, list[str]] = {}
    for name, settings in settings_by_name.items():
        further = {
            key: entry
            for key, entry in settings.items()
            if key not in ("bearing", "lubricant", "loads")
        }
        value = settings.get(part) if part else further
        if isinstance(value, dict) and value:
            content = json.dumps(value, ensure_ascii=False)
            names_by_content.setdefault(content, []).append(name)
    tables = []
    for text, names in names_by_content.items():
        title = (part.capitalize() or "Further input") + (
            f" ({', '.join(names)})" if len(names_by_content) > 1 else ""
        )
        value = json.loads(text)
        if part:
            tables.append(
                Table(
                    ("quantity", "value", "from", "note"),
                    [_entry(*entry) for entry in value.items()],
                    title,
                )
            )
        else:
            tables.append(
                Table(
                    ("input", "value (SI units)"),
                    [(key, _text(entry)) for key, entry in value.items()],
                    title,
                )
            )
    return tables


def _entry(key: str, entry: Any) -> tuple[str, str, str, str]:
    if not isinstance(entry, dict):
        return key, str(entry), "", ""
    tag = str(entry.get("tag", ""))
    unit = str(entry.get("unit", ""))
    value = with_unit(entry.get("value"), unit)
    return key, value, TAGS.get(tag, tag), str(entry.get("note", ""))


def _loads(settings_by_name: Mapping[str, Mapping[str, Any]]) -> Table:
    rows = []
    for name, settings in settings_by_name.items():
        loads = settings.get("loads", [])
        for history in loads if isinstance(loads, list) else [loads]:
            *values, checksum = (
                str(history.get(key, "")) for key in ("source", "samples", "start", "end", "sha256")
            )
            rows.append((name, *values, checksum[:16]))
    return Table(
        ("", "loads", "samples", "from [s]", "to [s]", "SHA-256 begins"),
        list(dict.fromkeys(rows)),
        "Loads",
    )


def _text(value: Any) -> str:
    if isinstance(value, dict):
        entries = [f"{key} {_text(entry)}" for key, entry in value.items()]
        return ", ".join(entries)
    return "none" if value is None else with_unit(value, "1")


def bibtex(citations: Iterable[str]) -> str:
    """BibTeX entries of the program and of the works that a result's `citations` lists.

    A work that is not known by its DOI or title becomes an entry of type `misc` with the citation
    as its note, and its DOI if it has one.

    Examples
    --------
    >>> print(bibtex(["A. Author, A title, doi:10.1000/182"]).split("@")[2].strip())
    misc{author_a_title,
      note = {A. Author, A title, doi:10.1000/182},
      doi = {10.1000/182}
    }
    """
    works = (resources.files("macroslip.report") / "templates" / "works.bib").read_text(
        encoding="utf-8"
    )
    known = {
        re.findall(r"(?:doi|title) = {(.*)}", work)[-1]: work
        for work in works.strip().split("\n\n")
    }
    title = "macroslip: slip of the rollers of a wind turbine's main bearing"
    entries = [
        _bibtex_entry("software", "macroslip", {"title": title, "version": macroslip.__version__})
    ]
    keys = {""}
    for citation in filter(str.strip, citations):
        entry = next((work for mark, work in known.items() if mark in citation), None)
        if entry is None:
            doi = _DOI.search(citation)
            fields = {"note": citation.strip()}
            if doi:
                fields["doi"] = doi.group(1)
            words_of_key = re.findall(r"[A-Za-z]{2,}|a(?= )", citation.lower())[:3]
            key = "_".join(words_of_key) or "work"
            if key in keys:
                key = f"{key}_{len(keys)}"
            keys.add(key)
            entry = _bibtex_entry("misc", key, fields)
        entries.append(entry)
    return "\n\n".join(dict.fromkeys(entries))


def _bibtex_entry(kind: str, key: str, fields: dict[str, str]) -> str:
    lines = []
    for name, value in fields.items():
        # Braces of an unknown text would end the field.
        closed = value.count("{") == value.count("}")
        if not closed:
            value = re.sub("[{}]", "", value)
        lines.append(f"  {name} = {{{value}}}")
    content = ",\n".join(lines)
    return f"@{kind}{{{key},\n{content}\n}}"
