"""`macroslip study`: thousands of cases from one file, which can be stopped and resumed."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from macroslip.cli import INTERRUPTED, ignore_interrupts
from macroslip.cli.failure import CASES_FAILED, to_stderr
from macroslip.cli.needs import SCHEDULER, require
from macroslip.cli.options import AsJson, Force, Quiet, Threads
from macroslip.cli.printing import counted, plain_console, print_json, print_table
from macroslip.cli.progress import command_progress, study_progress
from macroslip.errors import InputError, safe_text
from macroslip.storage.files import check_new_file, write_new

if TYPE_CHECKING:
    from macroslip.study.run import Ended
    from macroslip.study.study_file import Study

#: Failures that are listed; the log and the summary have all.
_LISTED = 30


def study(
    study: Annotated[
        Path,
        typer.Argument(
            help="The study file; `macroslip init --example study` writes one with every key explained."
        ),
    ],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="The folder for the results.")
    ] = None,
    workers: Annotated[
        int | None, typer.Option(min=1, help="Start so many worker processes here.")
    ] = None,
    scheduler: Annotated[
        str | None, typer.Option(help="Use the workers of this Dask scheduler.")
    ] = None,
    threads: Threads = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on where an earlier run ended.")
    ] = False,
    dry_run: Annotated[
        bool,
        typer.Option(
            "--dry-run",
            help="Check what the study needs, show runs, time and disk; compute nothing.",
        ),
    ] = False,
    strict: Annotated[bool, typer.Option("--strict", help="Stop at the first failure.")] = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
    from_folder: Annotated[
        Path | None,
        typer.Option(
            help="Write the study file for all OpenFAST output in this folder; compute nothing."
        ),
    ] = None,
    force: Force = False,
) -> None:
    """Compute all cases of a study; a failed one does not stop it."""
    if from_folder is not None:
        _write_study(study, from_folder, force=force)
        return
    from macroslip.study.study_file import read_study

    checked = read_study(study)
    require(*([SCHEDULER] if scheduler else []))
    if output is None and not dry_run:
        raise InputError(
            "there is no folder for the results",
            where="--output",
            remedy="Name one, new or empty, with -o.",
        )
    for remark in checked.loads.remarks:
        to_stderr(f"note: {remark}")
    if dry_run or output is None:
        _dry_run(checked, workers, threads, as_json=as_json, quiet=quiet)
        return
    from macroslip.study.run import run_study
    from macroslip.study.store import lacks_database

    if resume and lacks_database(output):
        to_stderr(f"note: {output} has no database any more; all runs are computed again.")
    try:
        with study_progress(quiet=quiet) as report:
            chosen = {"workers": workers, "scheduler": scheduler, "threads": threads}
            ended = run_study(
                checked, output, **chosen, resume=resume, strict=strict, progress=report
            )
    except KeyboardInterrupt:
        ignore_interrupts()
        to_stderr(
            f"interrupted; what is computed is kept in {output}. Go on with the same command and --resume."
        )
        raise typer.Exit(INTERRUPTED) from None
    if as_json or not quiet:
        _summary(ended, output, as_json)
    if ended.failures:
        _failures(ended, output)
        raise typer.Exit(CASES_FAILED)


def _write_study(study: Path, folder: Path, *, force: bool) -> None:
    """Write a study file, and its table of loads, for the load files in a folder."""
    from macroslip.study.from_folder import study_of_folder

    check_new_file(study, force=force)
    made = study_of_folder(folder, study)
    for path in made.texts:
        check_new_file(path, force=force)
    for path, text in made.texts.items():
        write_new(path, text, force=force)
    for remark in made.remarks[:_LISTED]:
        to_stderr(f"note: {remark}")
    if len(made.remarks) > _LISTED:
        further = len(made.remarks) - _LISTED
        to_stderr(f"note: {further} more files are left out or relabelled")
    winds = [labels["wind_speed"] for labels in made.labels]
    lowest = f"{min(winds):g}"
    highest = f"{max(winds):g}"
    ends = dict.fromkeys((lowest, highest))
    typer.echo(f"{counted(len(winds), 'load file')}, {' to '.join(ends)} m/s")
    typer.echo(f"written: {' and '.join(map(str, made.texts))}")


def _dry_run(
    checked: Study, workers: int | None, threads: int | None, *, as_json: bool, quiet: bool
) -> None:
    from rich.filesize import decimal

    from macroslip.machine import usable_processors
    from macroslip.study.estimate import estimate_study
    from macroslip.study.progress import duration

    with command_progress(quiet=quiet):
        estimate = estimate_study(checked)
    parts = [
        (len(checked.loads.loads), "load histories"), (len(checked.bearings), "bearings"),
        (len(checked.lubricants), "lubricants"), (len(checked.models), "models"),
        (len(checked.variations), "combinations of parameters"),
    ]  # fmt: skip
    asked = (workers or 1) * (threads or usable_processors())
    processors = min(usable_processors(), asked)
    if as_json:
        known = bool(estimate.looked_at)
        print_json(
            {name: count for count, name in parts}
            | {
                "runs": estimate.runs, "looked at": estimate.looked_at, "processors": processors,
                "seconds on one processor": estimate.seconds if known else None,
                "bytes": estimate.bytes if known else None, "problems": list(estimate.problems),
            }
        )  # fmt: skip
        return
    rows = [[name, str(count)] for count, name in parts]
    rows.append(["runs", str(estimate.runs)])
    if estimate.looked_at:
        rows += [
            ["length of a load history, mean", f"{estimate.simulated_seconds:.6g} s"],
            ["time on one processor", duration(estimate.seconds)],
            [f"time here, on {processors} processors", duration(estimate.seconds / processors)],
            ["disk", decimal(round(estimate.bytes))],
        ]
    print_table(safe_text(checked.title) or "study", ["", ""], rows, "lr")
    typer.echo(
        f"Time and disk are estimated from {counted(estimate.looked_at, 'run')} of the study, "
        "begun here and now."
        if estimate.looked_at
        else "Time and disk cannot be estimated."
    )
    for problem in estimate.problems:
        to_stderr(f"note: {safe_text(problem)}")


def _summary(ended: Ended, output: Path, as_json: bool) -> None:
    from macroslip.study.progress import duration

    counts = ended.progress
    left = counts.total - counts.done
    if as_json:
        print_json(
            {
                "runs": counts.total, "computed": counts.computed, "unchanged": counts.unchanged,
                "failed": counts.failed, "left": left, "seconds": counts.seconds, "folder": str(output),
                "failures": [dict(zip(("labels", "outcome", "reason"), failure, strict=True)) for failure in ended.failures],
            }
        )  # fmt: skip
        return
    typer.echo(
        f"{counts.total} runs: {counts.computed} computed, {counts.unchanged} unchanged, {counts.failed} failed"
        + (f", {left} left" if left else "")
        + f", in {duration(counts.seconds)}"
    )
    typer.echo(f"written: {output}")


def _failures(ended: Ended, output: Path) -> None:
    from rich.table import Table

    shown = Table(box=None, padding=(0, 2, 0, 0))
    for heading in ("loads", "bearing, lubricant, model, parameters", "outcome", "reason"):
        shown.add_column(heading, overflow="fold")
    for labels, outcome, reason in ended.failures[:_LISTED]:
        others = [str(labels[name]) for name in ("bearing", "lubricant", "model")]
        for name, value in labels.items():
            if "." in name and name != "loads":
                others.append(f"{name} {value}")
        one_line = " ".join(reason.split())
        cells = (labels["loads"], ", ".join(others), outcome, one_line)
        shown.add_row(*map(safe_text, cells))
    plain_console(stderr=True).print(shown)
    total = ended.progress.failed
    if total > _LISTED:
        to_stderr(
            f"... and {total - _LISTED} more, in {output}/summary.parquet and {output}/log.txt."
        )
    counts = Counter(outcome for _, outcome, _ in ended.failures)
    kinds = ", ".join(f"{outcome}: {count}" for outcome, count in counts.items())
    following = "Runs that failed are tried again by --resume."
    if ended.stopped:
        following = "Stopped there, as --strict says; go on with --resume."
    to_stderr(f"failed: {total} of {ended.progress.total} runs ({kinds}). {following}")
