"""`macroslip report`: a page on results."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from macroslip.cli.compare import compare
from macroslip.cli.failure import ROLLERS_FAILED, to_stderr
from macroslip.cli.needs import FIGURES, require
from macroslip.cli.options import Force, Quiet, Weibull, wind_of
from macroslip.cli.progress import command_progress
from macroslip.errors import InputError, on_one_line
from macroslip.storage.files import check_new_file, write_new

PAGE = "report.html"
_TITLE = "Slip of the rollers"


def report(
    paths: Annotated[
        list[Path],
        typer.Argument(
            metavar="RESULTS...",
            help="A file that `macroslip run` wrote, a folder of such files, or the folder of a "
            "study; several files are compared.",
        ),
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", help="The page to write; report.html beside the results if not given."
        ),
    ] = None,
    title: Annotated[
        str | None,
        typer.Option("--title", help="Heading of the page; the title of a study if not given."),
    ] = None,
    weibull: Weibull = None,
    force: Force = False,
    quiet: Quiet = False,
) -> None:
    """Make one self-contained HTML page on results."""
    require(FIGURES)
    from macroslip.study.reader import incomplete_runs, is_study, open_study

    results = paths[0]
    of_study = len(paths) == 1 and is_study(results)
    if weibull and not of_study:
        raise InputError("--weibull is given for results that are no study", remedy="Leave it out.")
    if len(paths) > 1:
        return compare(paths, output=output, title=title or "", force=force, quiet=quiet)
    from macroslip.report.study_page import study_page
    from macroslip.study.result_files import CASES
    from macroslip.study.store import parts

    folder = results if results.is_dir() else results.parent
    output = output or folder / PAGE
    if results.exists():
        # Files that the page is made from, as far as the output could be one of them.
        inputs = [results]
        if results.is_dir():
            inputs = results.glob("*.nc")
        if of_study:
            of_cases = (results / CASES).resolve()
            is_stored = of_cases in output.resolve().parents
            inputs = parts(results)
            if is_stored:
                inputs.append(output)
        check_new_file(output, force=force, inputs=inputs)
    with command_progress(quiet=quiet, work="making the page"):
        if of_study:
            study = open_study(results)
            number = incomplete_runs(study).sizes["case"]
            failed = ""
            if number:
                failed = f"{number} of {study.sizes['case']} runs failed or are missing"
            heading = title or study.attrs["title"] or _TITLE
            page = study_page(study, title=heading, weights=wind_of(weibull))
        else:
            page, failed = _of_results(results, title)
    write_new(output, page, force=force)
    if not quiet:
        typer.echo(f"written: {output}")
    if failed:
        to_stderr(f"failed: {failed}; the page lists them.")
        raise typer.Exit(ROLLERS_FAILED)


def _of_results(results: Path, title: str | None) -> tuple[str, str]:
    """The page on results, and the number of failures in words."""
    from macroslip.report.accessor import read_results
    from macroslip.report.result_numbers import rollers_failed
    from macroslip.report.results_page import results_page

    datasets = read_results(results)
    try:
        page = results_page(datasets, title=title or _TITLE)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        # A file may have been changed in too many ways to check each.
        why = on_one_line(error)[:200]
        fault = f"no page can be made of this ({type(error).__name__}: {why})"
        allowed = "what macroslip run wrote, or a selection of it"
        remedy = "Run the case again; if nothing has changed the file since it was written, please report this."
        raise InputError(fault, where=str(results), allowed=allowed, remedy=remedy) from error
    failed, rollers = rollers_failed(datasets.values())
    return page, f"{failed} of {rollers} rollers" if failed else ""
