"""`macroslip reproduce`: the paper's study, figures and numbers."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from macroslip.cli.failure import ROLLERS_FAILED, to_stderr
from macroslip.cli.progress import command_progress

HEADLINES = 10
"""Lines of the summary that are printed."""


def reproduce(
    output: Annotated[
        Path,
        typer.Option("--output", "-o", help="The folder to write to; what it holds of an earlier run is replaced."),
    ],
    threads: Annotated[int | None, typer.Option(min=1, help="Threads; all processors if not given.")] = None,
    quiet: Annotated[bool, typer.Option("--quiet", help="Show nothing but errors.")] = False,
) -> None:
    """Reproduce the paper: its figures, numbers and a report."""
    from macroslip.reproduction.reproduce import REPORT, stages
    from macroslip.reproduction.reproduce import reproduce as study

    with command_progress(quiet=quiet, stages=stages()) as report:
        summary = study(output, threads=threads, progress=report)
    if not quiet:
        for line in summary["headline"][:HEADLINES]:
            typer.echo(line)
        if summary["reused"]:
            typer.echo(f"used again from the last run, whose inputs are the same: {', '.join(summary['reused'])}")
        typer.echo(f"written: {output}; the report: {output / REPORT}")
    if any(summary["failed_rollers"][part] for part in ("study", "single_rollers", "detailed_case", "sensitivity")):
        to_stderr(f"failed: some rollers did not reach the end; {output}/summary.json has their number for each case.")
        raise typer.Exit(ROLLERS_FAILED)
