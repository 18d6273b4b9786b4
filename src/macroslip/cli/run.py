"""`macroslip run`: one case, from its file to a netCDF file."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from macroslip.cli.failure import MEMORY, ROLLERS_FAILED, to_stderr
from macroslip.cli.printing import number, print_json, print_table
from macroslip.cli.progress import command_progress
from macroslip.constants import ZERO_CELSIUS
from macroslip.errors import InputError
from macroslip.files import check_new_file, new_file
from macroslip.report.style import years

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.case.case import Case

#: Time between the samples of a case's motion, and the longest time of it [s].
_STEP, _MINUTE = 0.05, 60.0
#: Names in the summary of what `macroslip.report.result_numbers.row_numbers` has for a row.
_OF_ROW = {
    "energy": "mean energy per roller [J]", "peak": "highest peak power [W]", "spin": "lowest spin / pure rolling [1]",
    "rollers": "rollers", "failed": "failed rollers",
}  # fmt: skip
#: Names in the JSON summary of what a rating has for the bearing as a whole.
_RATED = {
    "static_safety": "static safety [1]", "basic_life": "L10h [h]", "modified_life": "L10mh [h]",
    "viscosity_ratio": "kappa [1]", "share_below_minimum_load": "share of time below the minimum load [1]",
}  # fmt: skip


def run(
    case: Annotated[Path, typer.Argument(help="The case file; `macroslip init` writes one.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="The netCDF file to write.")],
    laws: Annotated[
        list[Path] | None,
        typer.Option(
            help="Python file that registers film or traction laws of your own; it is run. Repeatable."
        ),
    ] = None,
    threads: Annotated[
        int | None, typer.Option(min=1, help="Threads; all processors if not given.")
    ] = None,
    force: Annotated[
        bool, typer.Option("--force", help="Replace the output file if it exists.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print the summary as JSON.")] = False,
    quiet: Annotated[
        bool, typer.Option("--quiet", help="Show failures only, each error on one line.")
    ] = False,
) -> None:
    """Compute the slip of a case's rollers, as netCDF; of both main bearings as OUTPUT-front.nc and OUTPUT-rear.nc."""
    from macroslip.case.case_file import bearings_in, files_named_in

    inputs = [case, *(laws or ()), *files_named_in(case)]
    outputs = {
        name: output.parent / f"{output.stem}-{name}{output.suffix}" if name else output
        for name in bearings_in(case)
    }
    for path in outputs.values():
        check_new_file(path, force=force, inputs=inputs)
    from macroslip.result.stored import to_netcdf

    for path in laws or ():
        from macroslip.plugins import load_laws

        load_laws(path)
    told, failed = {}, False
    for name, path in outputs.items():
        dataset = _computed(case, name, threads, quiet)
        # In memory first: the HDF5 library may bring the whole process down when the disk is full.
        content = to_netcdf(dataset)
        with new_file(path, force=force) as temporary:
            temporary.write_bytes(content)
        told[name] = _numbers(dataset) | {"written": str(path)}
        if not (quiet or as_json):
            _summary(dataset, told[name], name, path)
        failed = _tell_doubts(dataset, quiet) or failed
    if as_json:
        print_json(told.get("", told))
    elif len(outputs) > 1 and not quiet:
        typer.echo(f"one page on both: macroslip report {' '.join(map(str, outputs.values()))}")
    if failed:
        raise typer.Exit(ROLLERS_FAILED)


def _computed(case: Path, bearing: str, threads: int | None, quiet: bool) -> xr.Dataset:
    from macroslip.case.case_file import names_key, read_case
    from macroslip.result.plausibility import doubtful_loads
    from macroslip.result.rating import with_rating
    from macroslip.result.simulate import simulate

    checked = read_case(case, bearing=bearing)
    if not names_key(case, "traces"):
        checked = with_motion(checked)
    for sentence in [] if quiet else doubtful_loads(checked.loads, checked.bearing):
        to_stderr(f"doubtful: {sentence}")
    with command_progress(quiet=quiet) as report, _named(case, checked.loads.source):
        progress = report and (lambda done, total: report("rollers", done, total))
        return with_rating(simulate(checked, threads=threads, progress=progress), checked)


def with_motion(case: Case) -> Case:
    """The case with traces of its first minute, from which its page shows the bearing in motion."""
    from macroslip.case.parts import Traces

    first, last = float(case.loads.time[0]), float(case.loads.time[-1])
    return replace(case, traces=Traces(step=_STEP, end=min(first + _MINUTE, last)))


@contextmanager
def _named(case: Path, loads: str) -> Iterator[None]:
    """Name the case file, and the key of its loads, in errors of the computation."""
    try:
        yield
    except InputError as problem:
        place = f"loads, {problem.where}" if problem.where.startswith(loads) else problem.where
        where = f"{case}, {place}" if place else str(case)
        raise InputError(
            problem.what, where=where, allowed=problem.allowed, remedy=problem.remedy
        ) from None
    except MemoryError:
        what = "the computer has not enough memory for this case"
        raise InputError(what, where=f"{case}, loads, rollers or traces", remedy=MEMORY) from None


def _numbers(dataset: xr.Dataset) -> dict[str, Any]:
    from macroslip.report.result_numbers import row_numbers
    from macroslip.result.plausibility import doubtful_result

    rows = {
        one["name"]: {
            words: math.nan if one[key] is None else one[key] for key, words in _OF_ROW.items()
        }
        for one in row_numbers(dataset)
    }
    window = {
        "start [s]": dataset.attrs["window_start"],
        "end [s]": dataset.attrs["window_end"],
        "complete orbits": dataset.sizes["orbit"],
    }
    found = {name: dataset.attrs[name] for name in ("title", "model", "oil")} | {
        "window": window,
        "rows": rows,
    }
    if "inlet_temperature" in dataset:
        found["inlet temperature [degC]"] = float(dataset.inlet_temperature) - ZERO_CELSIUS
    if "static_safety" in dataset:
        found["rating"] = {
            words: float(dataset[name]) for name, words in _RATED.items() if name in dataset
        }
        found["rating"]["largest pressure [Pa]"] = float(dataset.largest_pressure.max())
    if "rating_problem" in dataset.attrs:
        found["not rated"] = dataset.attrs["rating_problem"]
    if "cage_slip" in dataset:
        found["cage slip [1]"] = {str(one.cage.item()): float(one) for one in dataset.cage_slip}
    if "books_warning" in dataset.attrs:
        found["warning"] = dataset.attrs["books_warning"]
    found["doubtful"] = doubtful_result(dataset)
    from macroslip.report.answer import answer
    from macroslip.result.damage import lines

    criteria, missing = lines(dataset)
    return {
        "answer": answer(dataset, criteria),
        **found,
        "damage": {"criteria": criteria, "not kept": missing},
    }


def _summary(dataset: xr.Dataset, found: dict[str, Any], bearing: str, path: Path) -> None:
    from macroslip.cli.damage import print_criteria

    if bearing:
        typer.echo(f"{bearing} main bearing")
    for sentence in found["answer"]:
        typer.echo(sentence)
    typer.echo()
    _print_rows(dataset, found)
    title = "from slip to damage, the worst of any row and place"
    print_criteria(found["damage"]["criteria"], found["damage"]["not kept"], title=title)
    typer.echo(f"written: {path}")


def _print_rows(dataset: xr.Dataset, found: dict[str, Any]) -> None:
    rows = []
    for name, row in found["rows"].items():
        *values, rollers, failed = row.values()
        rows.append([name, *map(number, values), f"{failed} of {rollers}"])
    start, end, orbits = found["window"].values()
    window = (
        f"from {start:.6g} s to {end:.6g} s, {orbits} complete orbit{'' if orbits == 1 else 's'}"
    )
    numbers = [name for name in next(iter(found["rows"].values())) if name != "rollers"]
    print_table(
        f"{found['title']}, {window}",
        [("row", False), *((heading, True) for heading in numbers)],
        rows,
    )
    for cage, slip in found.get("cage slip [1]", {}).items():
        whose = "the cage" if len(found["cage slip [1]"]) == 1 else f"the {cage} cage"
        behind = "behind" if slip <= 0.0 else "ahead of"
        typer.echo(f"mean slip of {whose}: {number(100.0 * abs(slip))} % {behind} pure rolling")
    if "rating_problem" in dataset.attrs:
        typer.echo(f"not rated: {dataset.attrs['rating_problem']}")
    if "static_safety" not in dataset:
        return
    safety, kappa = (number(float(dataset[name])) for name in ("static_safety", "viscosity_ratio"))
    life = years(float(dataset.basic_life))
    modified = years(float(dataset.modified_reference_life.sel(load_along_roller="hertz")))
    below = number(100.0 * float(dataset.share_below_minimum_load))
    loaded = ", ".join(
        f"{100.0 * share:.3g} % {row}" for row, share in dataset.loaded_share.to_series().items()
    )
    typer.echo(
        f"beside slip: static safety {safety}, L10h {life}, modified reference life {modified}, largest pressure "
        f"{number(float(dataset.largest_pressure.max()) / 1e9)} GPa, kappa {kappa}, below the minimum load {below} % of the "
        f"time; rollers carry load {loaded}"
    )


def _tell_doubts(dataset: xr.Dataset, quiet: bool) -> bool:
    """Print what is doubtful, and of every roller that failed when and how; returns whether there is one."""
    from macroslip.report.result_numbers import failures
    from macroslip.result.plausibility import doubtful_result

    told = dataset.attrs["doubtful_loads"].splitlines()  # before it began
    for sentence in [] if quiet else doubtful_result(dataset):
        if sentence not in told:
            to_stderr(f"doubtful: {sentence}")
    if "books_warning" in dataset.attrs:
        to_stderr(f"warning: {dataset.attrs['books_warning']}")
    failed = failures("", dataset)
    for one in failed:
        to_stderr(
            f"failed: roller {one['roller']} of the {one['row']} row at t = {one['time']:.6g} s with a slip of "
            f"{one['slip']:.4g} m/s: {one['how']}."
        )
    return bool(failed)
