"""`macroslip report`: a page on results."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from macroslip.cli.failure import ROLLERS_FAILED, tell
from macroslip.cli.needs import FIGURES, require
from macroslip.files import check_new_file, new_file

PAGE = "report.html"


def report(
    results: Annotated[Path, typer.Argument(help="A file that `macroslip run` wrote, or a folder of such files.")],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The page to write; report.html beside the results if not given."),
    ] = None,
    title: Annotated[str, typer.Option("--title", help="Heading of the page.")] = "Slip of the rollers",
    force: Annotated[bool, typer.Option("--force", help="Replace the page if it exists.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", help="Show failures only.")] = False,
) -> None:
    """Make one self-contained HTML page on results."""
    require(FIGURES)
    from macroslip.report.read import read_results
    from macroslip.report.results_page import results_page

    if output is None:
        output = (results if results.is_dir() else results.parent) / PAGE
    found = read_results(results)
    check_new_file(output, force=force, inputs=[results] if results.is_file() else results.glob("*.nc"))
    page = results_page(found, title=title)
    with new_file(output, force=force) as temporary:
        temporary.write_text(page, encoding="utf-8")
    if not quiet:
        typer.echo(f"written: {output}")
    failed = sum(int((one.status != 0).sum()) for one in found.values())
    if failed:
        tell(f"failed: {failed} of {sum(int(one.status.size) for one in found.values())} rollers; the page says which.")
        raise typer.Exit(ROLLERS_FAILED)
