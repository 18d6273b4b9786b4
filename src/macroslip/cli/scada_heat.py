"""`macroslip scada heat`: heat of a main bearing from ten-minute means."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from macroslip.cli.needs import FIGURES, require
from macroslip.cli.options import AsJson, Quiet
from macroslip.cli.printing import print_json, print_notes, print_table
from macroslip.cli.progress import command_progress


def heat(
    description: Annotated[
        Path, typer.Argument(help="The YAML file that describes the ten-minute means.")
    ],
    study: Annotated[
        Path,
        typer.Option(help="Folder of a study of turbulent cases over lubricant.at and oil_supply."),
    ],
    output: Annotated[
        Path,
        typer.Option(
            "--output",
            "-o",
            help="Folder for fit.csv, index.csv and page.html; those of the same names are replaced.",
        ),
    ],
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Fit the heat balance of a main bearing, beside rivals, and write its index over time."""
    require(FIGURES)
    from macroslip.report.heat_page import heat_page, heat_sentences
    from macroslip.scada.description import ScadaDescription
    from macroslip.storage.files import write_durably
    from macroslip.study.export import write_tables
    from macroslip.study.heat import heat_fit

    described = ScadaDescription.read(description)
    with command_progress(quiet=quiet, work="fitting the heat"):
        fitted = heat_fit(description, study)
        text = heat_page(fitted, described, str(study))
    tables = {"fit": fitted.fit, "index": fitted.index}
    written = write_tables(tables, output, "csv")
    page = output / "page.html"
    write_durably(page, text.encode())
    written.append(page)
    sentences = heat_sentences(fitted, described)
    if as_json:
        known = fitted.fit.astype(object).where(fitted.fit.notna(), None)
        numbers = known.to_dict("records")
        print_json(
            {
                "fit": numbers, "answer": sentences, "marks": list(fitted.marks),
                "notes": list(fitted.notes), "written": [str(path) for path in written],
            }
        )  # fmt: skip
        return
    if quiet:
        return
    for sentence in sentences:
        typer.echo(sentence)
    for mark in fitted.marks:
        typer.echo(f"doubtful: {mark}")
    print_notes(fitted.notes)
    by_residual = sorted(fitted.fits, key=lambda fit: fit.residual)
    rows = [[fit.model.title, f"{fit.residual:.4f}"] for fit in by_residual]
    headings = ["model", "root mean square of the residual [K/h]"]
    print_table("What each model leaves of dT/dt", headings, rows, "lr")
    for path in written:
        typer.echo(f"written: {path}")
