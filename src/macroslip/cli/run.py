"""`macroslip run`: one case, from its file to a netCDF file."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from macroslip.cli.excel import Xlsx, check_workbook, write_workbook
from macroslip.cli.failure import MEMORY, ROLLERS_FAILED, to_stderr
from macroslip.cli.options import AsJson, Force, Quiet, Threads
from macroslip.cli.printing import number, print_json, print_table
from macroslip.cli.progress import command_progress
from macroslip.constants import ZERO_CELSIUS
from macroslip.errors import InputError
from macroslip.report.style import years
from macroslip.storage.files import check_new_file, new_file

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.case.case import Case

#: Time between the samples of a case's motion [s].
_TRACE_STEP = 0.05
#: Longest time of a case's motion [s].
_TRACE_LENGTH = 60.0
#: Names in the summary of the numbers of `macroslip.report.result_numbers.row_numbers`.
_OF_ROW = {
    "energy": "mean energy per roller [J]",
    "peak": "highest peak power [W]",
    "spin": "lowest spin / pure rolling [1]",
    "rollers": "rollers",
    "failed": "failed rollers",
}
#: Names in the JSON summary of a rating's numbers for the bearing as a whole.
_RATED = {
    "static_safety": "static safety [1]",
    "basic_life": "L10h [h]",
    "modified_life": "L10mh [h]",
    "viscosity_ratio": "kappa [1]",
    "share_below_minimum_load": "share of time below the minimum load [1]",
}


def run(
    case: Annotated[Path, typer.Argument(help="The case file; `macroslip init` writes one.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="The netCDF file to write.")],
    laws: Annotated[
        list[Path] | None,
        typer.Option(
            help="Python file that registers film or traction laws of your own; it is run. "
            "Repeatable."
        ),
    ] = None,
    xlsx: Xlsx = None,
    threads: Threads = None,
    force: Force = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Compute the slip of a case's rollers, as netCDF.

    Of both main bearings the files are OUTPUT-front.nc and OUTPUT-rear.nc, workbooks alike.
    """
    from macroslip.case.case_file import bearings_in, files_named_in

    inputs = [case, *(laws or ()), *files_named_in(case)]
    outputs = {name: _of_bearing(output, name) for name in bearings_in(case)}
    for name, path in outputs.items():
        check_new_file(path, force=force, inputs=inputs)
        check_workbook(xlsx and _of_bearing(xlsx, name), force=force, inputs=inputs)
    from macroslip.result.stored import to_netcdf

    for path in laws or ():
        from macroslip.plugins import load_laws

        load_laws(path)
    summaries = {}
    any_failed = False
    for name, path in outputs.items():
        dataset = _computed(case, name, threads, quiet)
        # In memory first: the HDF5 library may bring the whole process down when the disk is full.
        content = to_netcdf(dataset)
        with new_file(path, force=force) as temporary:
            temporary.write_bytes(content)
        summary = _numbers(dataset) | {"written": str(path)}
        summaries[name] = summary
        if xlsx is not None:
            from macroslip.report.sheets import result_sheets

            book = _of_bearing(xlsx, name)
            criteria = summary["damage"]["criteria"]
            sheets = result_sheets(dataset, summary["answer"], criteria)
            write_workbook(book, sheets, force=force)
            summary["workbook"] = str(book)
        if not (quiet or as_json):
            _summary(dataset, summary, name, path)
        any_failed = _print_doubts(dataset, quiet) or any_failed
    if as_json:
        print_json(summaries.get("", summaries))
    elif len(outputs) > 1 and not quiet:
        files = " ".join(map(str, outputs.values()))
        typer.echo(f"one page on both: macroslip report {files}")
    if any_failed:
        raise typer.Exit(ROLLERS_FAILED)


def _of_bearing(path: Path, bearing: str) -> Path:
    """Path of an output: with the bearing's name where a case has both main bearings."""
    if not bearing:
        return path
    return path.parent / f"{path.stem}-{bearing}{path.suffix}"


def _computed(case: Path, bearing: str, threads: int | None, quiet: bool) -> xr.Dataset:
    from macroslip.case.case_file import names_key, read_case
    from macroslip.result.plausibility import doubtful_loads
    from macroslip.result.rating import with_rating
    from macroslip.result.simulate import simulate

    checked = read_case(case, bearing=bearing)
    if not names_key(case, "traces"):
        checked = with_motion(checked)
    doubts = doubtful_loads(checked.loads, checked.bearing)
    with command_progress(quiet=quiet) as report, _named(case, checked.loads.source, doubts):
        progress = report and (lambda done, total: report("rollers", done, total))
        result = simulate(checked, threads=threads, progress=progress)
        return with_rating(result, checked)


def with_motion(case: Case) -> Case:
    """The case with traces of its first minute, from which its page shows the bearing in motion."""
    from macroslip.case.parts import Traces

    start = case.loads.start
    end = min(start + _TRACE_LENGTH, case.loads.end)
    traces = Traces(step=_TRACE_STEP, end=end)
    return replace(case, traces=traces)


@contextmanager
def _named(case: Path, loads: str, doubts: Sequence[str]) -> Iterator[None]:
    """Name the case file, the key of its loads, and doubts about them, in errors of computing."""
    try:
        yield
    except InputError as problem:
        inner = problem.where
        if inner.startswith(loads):
            inner = f"loads, {inner}"
        sentences = [f"Doubtful: {doubt}" for doubt in doubts]
        remedy = " ".join([problem.remedy, *sentences]).strip()
        where = f"{case}, {inner}" if inner else str(case)
        raise problem.but(where=where, remedy=remedy) from None
    except MemoryError:
        fault = "the computer has not enough memory for this case"
        raise InputError(fault, where=f"{case}, loads, rollers or traces", remedy=MEMORY) from None


def _numbers(dataset: xr.Dataset) -> dict[str, Any]:
    from macroslip.report.answer import answer
    from macroslip.report.result_numbers import row_numbers
    from macroslip.result.damage import lines
    from macroslip.result.plausibility import doubtful_result

    rows = {}
    for row in row_numbers(dataset):
        numbers_of_row = {}
        for key, words in _OF_ROW.items():
            numbers_of_row[words] = math.nan if row[key] is None else row[key]
        rows[row["name"]] = numbers_of_row
    window = {
        "start [s]": dataset.attrs["window_start"],
        "end [s]": dataset.attrs["window_end"],
        "complete orbits": dataset.sizes["orbit"],
    }
    numbers = {name: dataset.attrs[name] for name in ("title", "model", "oil")}
    numbers |= {"window": window, "rows": rows}
    if "inlet_temperature" in dataset:
        kelvin = float(dataset.inlet_temperature)
        numbers["inlet temperature [degC]"] = kelvin - ZERO_CELSIUS
    if "static_safety" in dataset:
        rating = {words: float(dataset[name]) for name, words in _RATED.items() if name in dataset}
        rating["largest pressure [Pa]"] = float(dataset.largest_pressure.max())
        numbers["rating"] = rating
    if "rating_problem" in dataset.attrs:
        numbers["not rated"] = dataset.attrs["rating_problem"]
    if "cage_slip" in dataset:
        slips = {}
        for slip in dataset.cage_slip:
            cage = str(slip.cage.item())
            slips[cage] = float(slip)
        numbers["cage slip [1]"] = slips
    if "books_warning" in dataset.attrs:
        numbers["warning"] = dataset.attrs["books_warning"]
    numbers["doubtful"] = doubtful_result(dataset)
    criteria, missing = lines(dataset)
    numbers["damage"] = {"criteria": criteria, "not kept": missing}
    return {"answer": answer(dataset, criteria)} | numbers


def _summary(dataset: xr.Dataset, summary: dict[str, Any], bearing: str, path: Path) -> None:
    from macroslip.cli.damage import print_criteria

    if bearing:
        typer.echo(f"{bearing} main bearing")
    for sentence in summary["answer"]:
        typer.echo(sentence)
    typer.echo()
    _print_rows(dataset, summary)
    title = "from slip to damage, the worst of any row and place"
    judged = summary["damage"]
    print_criteria(judged["criteria"], judged["not kept"], title=title)
    typer.echo(f"written: {path}")
    if "workbook" in summary:
        typer.echo(f"written: {summary['workbook']}")


def _print_rows(dataset: xr.Dataset, summary: dict[str, Any]) -> None:
    rows = []
    for name, row in summary["rows"].items():
        *values, rollers, failed = row.values()
        cells = map(number, values)
        rows.append([name, *cells, f"{failed} of {rollers}"])
    start, end, orbits = summary["window"].values()
    plural = "" if orbits == 1 else "s"
    window = f"from {start:.6g} s to {end:.6g} s, {orbits} complete orbit{plural}"
    columns = [words for key, words in _OF_ROW.items() if key != "rollers"]
    title = f"{summary['title']}, {window}"
    sides = "l" + "r" * len(columns)
    print_table(title, ["row", *columns], rows, sides)
    cages = summary.get("cage slip [1]", {})
    for cage, slip in cages.items():
        whose = "the cage" if len(cages) == 1 else f"the {cage} cage"
        behind = "behind" if slip <= 0.0 else "ahead of"
        percent = number(100.0 * abs(slip))
        typer.echo(f"mean slip of {whose}: {percent} % {behind} pure rolling")
    if "rating_problem" in dataset.attrs:
        typer.echo(f"not rated: {dataset.attrs['rating_problem']}")
    if "static_safety" in dataset:
        _print_rating(dataset)


def _print_rating(dataset: xr.Dataset) -> None:
    modified = dataset.modified_reference_life.sel(load_along_roller="hertz")
    loaded = ", ".join(
        f"{100.0 * share:.3g} % {row}" for row, share in dataset.loaded_share.to_series().items()
    )
    typer.echo(
        f"beside slip: static safety {number(float(dataset.static_safety))}, "
        f"L10h {years(float(dataset.basic_life))}, "
        f"modified reference life {years(float(modified))}, "
        f"largest pressure {number(float(dataset.largest_pressure.max()) / 1e9)} GPa, "
        f"kappa {number(float(dataset.viscosity_ratio))}, below the minimum load "
        f"{number(100.0 * float(dataset.share_below_minimum_load))} % of the time; "
        f"rollers carry load {loaded}"
    )


def _print_doubts(dataset: xr.Dataset, quiet: bool) -> bool:
    """Print doubts and failures of rollers; True if a roller failed."""
    from macroslip.report.result_numbers import failures
    from macroslip.result.plausibility import doubtful_result

    if not quiet:
        for sentence in doubtful_result(dataset):
            to_stderr(f"doubtful: {sentence}")
    if "books_warning" in dataset.attrs:
        to_stderr(f"warning: {dataset.attrs['books_warning']}")
    failed = failures("", dataset)
    for failure in failed:
        to_stderr(
            f"failed: roller {failure['roller']} of the {failure['row']} row at "
            f"t = {failure['time']:.6g} s with a slip of {failure['slip']:.4g} m/s: "
            f"{failure['how']}."
        )
    return bool(failed)
