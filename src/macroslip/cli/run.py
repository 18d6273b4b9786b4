"""`macroslip run`: one case, from its file to a netCDF file."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from macroslip.cli.failure import MEMORY, ROLLERS_FAILED, to_stderr
from macroslip.cli.progress import command_progress
from macroslip.errors import InputError
from macroslip.files import check_new_file, new_file

if TYPE_CHECKING:
    import xarray as xr


def run(
    case: Annotated[Path, typer.Argument(help="The case file; `macroslip init` writes one.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="The netCDF file to write.")],
    laws: Annotated[
        list[Path] | None,
        typer.Option(help="Python file that registers film or traction laws of your own; it is run. Repeatable."),
    ] = None,
    threads: Annotated[int | None, typer.Option(min=1, help="Threads; all processors if not given.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the output file if it exists.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print the summary as JSON.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", help="Show failures only, each error on one line.")] = False,
) -> None:
    """Compute the slip of a case's rollers, as netCDF."""
    from macroslip.case.case_file import files_named_in, read_case

    check_new_file(output, force=force, inputs=[case, *(laws or ()), *files_named_in(case)])
    for path in laws or ():
        from macroslip.plugins import load_laws

        load_laws(path)
    checked = read_case(case)
    from macroslip.result.rating import with_rating
    from macroslip.result.simulate import simulate
    from macroslip.result.stored import to_netcdf

    with command_progress(quiet=quiet) as report, _named(case, checked.loads.source):
        progress = report and (lambda done, total: report("rollers", done, total))
        dataset = with_rating(simulate(checked, threads=threads, progress=progress), checked)
    # In memory first: the HDF5 library may bring the whole process down when the disk is full.
    content = to_netcdf(dataset)
    with new_file(output, force=force) as temporary:
        temporary.write_bytes(content)
    if as_json:
        from macroslip.cli.printing import print_json

        print_json(_numbers(dataset) | {"written": str(output)})
    elif not quiet:
        _summary(dataset)
        typer.echo(f"written: {output}")
    if _tell_failures(dataset):
        raise typer.Exit(ROLLERS_FAILED)


@contextmanager
def _named(case: Path, loads: str) -> Iterator[None]:
    """Name the case file, and the key of its loads, in errors of the computation."""
    try:
        yield
    except InputError as problem:
        place = f"loads, {problem.where}" if problem.where.startswith(loads) else problem.where
        where = f"{case}, {place}" if place else str(case)
        raise InputError(problem.what, where=where, allowed=problem.allowed, remedy=problem.remedy) from None
    except MemoryError:
        what = "the computer has not enough memory for this case"
        raise InputError(what, where=f"{case}, loads, rollers or traces", remedy=MEMORY) from None


def _numbers(dataset: xr.Dataset) -> dict[str, Any]:
    """The main results, by row."""
    rows = {}
    for name in dataset.row.values:
        row = dataset.sel(row=name)
        # Rollers that failed have no results; a window without a complete orbit has no peaks: the means are then NaN.
        energy = row.energy.sum("interface", skipna=False)
        rows[str(name)] = {
            "mean energy per roller [J]": float(energy.mean()),
            "highest peak power [W]": float(row.peak_power.max()) if row.peak_power.size else float("nan"),
            "lowest spin / pure rolling [1]": float(row.min_spin_ratio.min()),
            "rollers": row.sizes["roller"],
            "failed rollers": int((row.status != 0).sum()),
        }
    window = {
        "start [s]": dataset.attrs["window_start"],
        "end [s]": dataset.attrs["window_end"],
        "complete orbits": dataset.sizes["orbit"],
    }
    return {"title": dataset.attrs["title"], "window": window, "rows": rows}


def _summary(dataset: xr.Dataset) -> None:
    """Print the main results row by row, and the numbers beside slip in a line."""
    from macroslip.cli.printing import number, print_table

    found = _numbers(dataset)
    rows = []
    for name, row in found["rows"].items():
        *values, rollers, failed = row.values()
        rows.append([name, *map(number, values), f"{failed} of {rollers}"])
    start, end, orbits = found["window"].values()
    window = f"from {start:.6g} s to {end:.6g} s, {orbits} complete orbit{'' if orbits == 1 else 's'}"
    numbers = [name for name in next(iter(found["rows"].values())) if name != "rollers"]
    print_table(f"{found['title']}, {window}", [("row", False), *((heading, True) for heading in numbers)], rows)
    if "rating_problem" in dataset.attrs:
        typer.echo(f"not rated: {dataset.attrs['rating_problem']}")
    if "static_safety" not in dataset:
        return
    safety, life, kappa = (number(float(dataset[name])) for name in ("static_safety", "basic_life", "viscosity_ratio"))
    modified = number(float(dataset.modified_reference_life.sel(load_along_roller="hertz")))
    typer.echo(
        f"beside slip: static safety {safety}, L10h {life} h, modified reference life {modified} h, largest pressure "
        f"{number(float(dataset.largest_pressure.max()) / 1e9)} GPa, kappa {kappa}, "
        f"below the minimum load {number(100.0 * float(dataset.share_below_minimum_load))} % of the time"
    )


def _tell_failures(dataset: xr.Dataset) -> bool:
    """Print of every roller that failed when and how; returns whether there is one."""
    from macroslip.report.result_numbers import failures

    failed = failures("", dataset)
    for one in failed:
        to_stderr(
            f"failed: roller {one['roller']} of the {one['row']} row at t = {one['time']:.6g} s with a slip of "
            f"{one['slip']:.4g} m/s: {one['how']}."
        )
    return bool(failed)
