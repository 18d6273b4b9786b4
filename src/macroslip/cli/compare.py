"""`macroslip compare`: results side by side, or the designs of a study."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from macroslip.cli.excel import Xlsx, check_workbook, write_workbook
from macroslip.cli.needs import FIGURES, require
from macroslip.cli.options import AsJson, By, Force, Quiet
from macroslip.cli.progress import command_progress
from macroslip.storage.files import check_new_file, write_new

PAGE = "comparison.html"


def compare(
    results: Annotated[
        list[Path],
        typer.Argument(
            help="Two files that `macroslip run` wrote, or more; or the folder of one study."
        ),
    ],
    by: By = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", help="The page; comparison.html beside the first, if not given."
        ),
    ] = None,
    title: Annotated[str, typer.Option("--title", help="Heading of the page.")] = "",
    xlsx: Xlsx = None,
    force: Force = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Compare results, or the designs of a study: differences, numbers and ranking."""
    require(FIGURES)
    from macroslip.cli.printing import print_json, print_notes, print_table
    from macroslip.report.accessor import open_result
    from macroslip.report.comparison import compare as compared
    from macroslip.report.comparison_page import comparison_page, comparison_tables
    from macroslip.study.reader import is_study

    first = results[0]
    folder = first if first.is_dir() else first.parent
    output = output or folder / PAGE
    inputs = [path for path in results if path.is_file()]
    check_new_file(output, force=force, inputs=inputs)
    check_workbook(xlsx, force=force, inputs=inputs)
    with command_progress(quiet=quiet, work="comparing"):
        comparison = compared(*results, by=by)
        curves = {}
        if not is_study(first):
            designs = comparison["design"].unique()
            curves = dict(zip(designs, map(open_result, results), strict=True))
        page = comparison_page(comparison, curves, title=title)
    write_new(output, page, force=force)
    if xlsx is not None:
        from macroslip.report.sheets import comparison_sheets
        from macroslip.study.reader import open_study

        datasets = curves or {"study": open_study(first)}
        sheets = comparison_sheets(comparison, datasets)
        write_workbook(xlsx, sheets, force=force)
    if as_json:
        known = comparison.astype(object).where(comparison.notna(), None)
        numbers = known.to_dict("records")
        print_json({"numbers": numbers, **comparison.attrs, "written": str(output)})
        return
    if quiet:
        return
    typer.echo(f"{comparison.attrs['about']}.")
    print_notes(comparison.attrs["notes"])
    for table in comparison_tables(comparison):
        if table.rows:
            numeric = len(table.headings) - 1
            columns = "l" + "r" * numeric
            print_table(table.caption, table.headings, table.rows, columns)
            typer.echo()
    typer.echo(comparison.attrs["ranking"])
    typer.echo(f"written: {output}")
    if xlsx is not None:
        typer.echo(f"written: {xlsx}")
