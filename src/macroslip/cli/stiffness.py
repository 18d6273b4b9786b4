"""`macroslip stiffness`: stiffness of a main bearing about operating points, as CSV or JSON."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from macroslip.cli.options import AsJson, Force, Quiet
from macroslip.cli.printing import number, print_json, print_table
from macroslip.cli.progress import command_progress
from macroslip.errors import InputError
from macroslip.storage.files import check_new_file, write_new

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.case.case import Case

_FORMATS = (".csv", ".json")


def stiffness(
    cases: Annotated[
        list[Path], typer.Argument(metavar="CASES...", help="Case files; several are put together.")
    ],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The table to write, .csv, or the matrices, .json."),
    ] = None,
    loads: Annotated[
        list[str] | None,
        typer.Option(
            help="Hub loads in place of the case's: a file, or the name of a bundled case. "
            "Repeatable."
        ),
    ] = None,
    force: Force = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Stiffness (5 x 5) of the main bearing about the mean and extreme loads of cases."""
    from macroslip.result.stiffness import ring_stiffness, stiffness_data, stiffness_table

    if output is not None:
        if output.suffix.lower() not in _FORMATS:
            raise InputError(
                f"the extension {output.suffix!r} is not known",
                where=str(output),
                allowed=" or ".join(_FORMATS),
            )
        check_new_file(output, force=force, inputs=cases)
    cases_under_loads = _cases(cases, loads or [])
    with command_progress(quiet=quiet, work="solving the balance of the ring"):
        rings = ring_stiffness(cases_under_loads)
    if output is not None:
        if output.suffix.lower() == ".csv":
            text = stiffness_table(rings).to_csv(index=False, lineterminator="\n")
        else:
            data = stiffness_data(rings)
            text = json.dumps(data, indent=2, ensure_ascii=False)
        write_new(output, text, force=force)
    if as_json:
        print_json(stiffness_data(rings))
    elif not quiet:
        _print(rings)
        if output is not None:
            typer.echo(f"written: {output}")


def _cases(paths: list[Path], names: list[str]) -> dict[str, Case]:
    """Cases by name: of every file, main bearing and load history."""
    from macroslip.case.case_file import bearings_in, load_source, read_case
    from macroslip.case.load_source import LoadSource
    from macroslip.loads import bundled_cases

    known = set(bundled_cases("year"))
    cases = {}
    for path in paths:
        for bearing in bearings_in(path):
            case = read_case(path, bearing=bearing)
            of_file = f"{path.stem} {bearing}".strip()
            if not names:
                cases[of_file] = case
            for name in names:
                if name in known:
                    source = LoadSource(bundled=name)
                else:
                    cut = load_source(path).cut
                    source = LoadSource(file=name, **cut)
                under_loads = replace(case, loads=source.series(Path()))
                cases[f"{of_file}, {Path(name).name}"] = under_loads
    return cases


def _print(rings: xr.Dataset) -> None:
    headings = ("F_X0", "F_Y0", "F_Z0", "k_XX", "k_YY", "k_ZZ", "k_XY", "k_XZ", "k_YZ")
    pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    rows = []
    for k in range(rings.sizes["point"]):
        point = rings.isel(point=k)
        kilonewtons = [float(value) / 1e3 for value in point.force.values]
        forces = [number(force) for force in kilonewtons]
        matrix = point.stiffness.values / 1e6
        entries = [number(float(matrix[pair])) for pair in pairs]
        held = "" if point.held else "not held"
        head = [point.case.item(), point.kind.item()]
        rows.append([*head, *forces, *entries, held])
    print_table(
        "loads [kN] and stiffness of displacements [MN/m]; tilts: 0, the bearing aligns itself",
        ["case", "about", *headings, ""],
        rows,
        "ll" + "r" * len(headings) + "l",
    )
