"""The page of the reproduction: tables of numbers for the template `report.html`, which has all the words."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from macroslip.imposed.status import Status
from macroslip.input.record import TAGS
from macroslip.machine import machine
from macroslip.report.provenance import bibtex
from macroslip.torque import TorqueHistory
from paper import figures
from paper.uncertainty import DRIVER_LEVEL, drivers, robust, strongest
from paper.values import VALUES
from paper.verdicts import AGREES, DIFFERS, PARTLY, Statement, by_wind_speed, number

if TYPE_CHECKING:
    from paper.reproduce import ModelRun


def page(
    folder: Path,
    runs: Mapping[str, ModelRun],
    made: Mapping[str, xr.Dataset],
    judged: Mapping[str, Mapping[str, Statement]],
    torques: Mapping[str, TorqueHistory],
    summary: Mapping[str, Any],
) -> str:
    """The page, with the figures that are in `folder` as SVG, in one piece that needs no network."""
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.filters["number"] = number
    of_uncertainty = {
        name: run.uncertainty for name, run in runs.items() if run.uncertainty is not None
    }
    return environment.get_template("report.html").render(
        runs=runs,
        judged=judged,
        subjects=list(next(iter(judged.values()))),
        counts={name: _counts(statements) for name, statements in judged.items()},
        pictures={path.stem: _picture(path) for path in folder.glob("*.svg")},
        made=made,
        parts={name: _parts(run.parts) for name, run in runs.items() if run.parts is not None},
        uncertainty={name: _uncertainty(of_model) for name, of_model in of_uncertainty.items()},
        trends={
            name: list(
                zip(
                    robust(of_model),
                    of_model.trend_share.values,
                    of_model.trend_base.values,
                    strict=True,
                )
            )
            for name, of_model in of_uncertainty.items()
        },
        values=VALUES,
        tags={**TAGS, "C": "choice"},
        driver_level=DRIVER_LEVEL,
        torques={
            name: [float(find(history.torque)) for find in (np.nanmean, np.nanmin, np.nanmax)]
            for name, history in torques.items()
        },
        torque_window=figures.TORQUE_WINDOW,
        summary=summary,
        provenance=_provenance({name: run.study for name, run in runs.items()}),
    )


def _counts(statements: Mapping[str, Statement]) -> dict[str, int]:
    """How many statements have each verdict."""
    verdicts = [statement.verdict for statement in statements.values()]
    return {
        verdict: verdicts.count(verdict)
        for verdict in dict.fromkeys((AGREES, PARTLY, DIFFERS, *verdicts))
    }


def _picture(path: Path) -> dict[str, Any]:
    """A figure for the page: without what it does not show, outlines to a hundredth of a point, sizes in pixels."""
    svg = path.read_text(encoding="utf-8")
    width, height = (
        round(float(points) * 96.0 / 72.0)
        for points in re.findall(r'(?:width|height)="([\d.]+)pt"', svg)[:2]
    )
    svg = re.sub(r"<!--.*?-->|<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = re.sub(r' d="[^"]*"', lambda outline: re.sub(r"(\.\d\d)\d+", r"\1", outline[0]), svg)
    encoded = base64.b64encode(svg.encode()).decode("ascii")
    return {"source": f"data:image/svg+xml;base64,{encoded}", "width": width, "height": height}


def _parts(parts: xr.Dataset) -> dict[str, Any]:
    """Energy per orbit by wind speed, of every row and part, and what of it is at asperities [%]."""
    energy, asperities = (
        by_wind_speed(parts.part_energy),
        by_wind_speed(100.0 * parts.asperity_share),
    )
    return {
        "speeds": energy.wind_speed.values.tolist(),
        "rows": [
            (row, part, energy.sel(row=row, part=part).values)
            for row in parts.row.values.tolist()
            for part in parts.part.values.tolist()
        ]
        + [
            (row, "of it at asperities [%]", asperities.sel(row=row).values)
            for row in parts.row.values.tolist()
        ],
    }


def _uncertainty(summary: xr.Dataset) -> dict[str, Any]:
    rows = []
    for name in summary.quantity.values.tolist():
        of_quantity = summary.sel(quantity=name)
        rows.append(
            {
                "name": name
                if str(of_quantity.units.values) == "1"
                else f"{name} [{of_quantity.units.values}]",
                "values": [
                    float(value)
                    for value in (
                        of_quantity.base,
                        *of_quantity.range.sel(quantile=[0.5, 0.05, 0.95]).values,
                    )
                ],
                "drivers": [
                    f"{parameter} ({value:+.2f})" for parameter, value in drivers(summary, name)
                ],
                "indices": [
                    f"{parameter} {first:.2f} ({total:.2f})"
                    for parameter, first, total in strongest(summary, name)
                ],
                "explained": float(of_quantity.explained),
            }
        )
    return {"rows": rows, "cases": summary.case.values.tolist(), **summary.attrs}


def _provenance(studies: Mapping[str, xr.Dataset]) -> dict[str, Any]:
    """Program, machine, inputs, how integrations ended, and works cited."""
    inputs = {name: json.loads(study.attrs["input"]) for name, study in studies.items()}
    first = next(iter(inputs.values()))
    cited = dict.fromkeys(
        line
        for study_cited in studies.values()
        for line in study_cited.attrs["citations"].splitlines()
    )
    return {
        "source": ", ".join(
            sorted({study_used.attrs["source"] for study_used in studies.values()})
        ),
        "machine": {key: value for key, value in machine().items() if value is not None},
        "statuses": [
            (name, int((study.status == status).sum()), status.sentence)
            for name, study in studies.items()
            for status in Status
            if (study.status == status).any()
        ],
        "records": {
            part: {key: entry for key, entry in first[part].items() if isinstance(entry, dict)}
            for part in ("bearing", "lubricant")
        },
        "loads": first["loads"],
        "bibtex": bibtex(cited),
    }
