"""`macroslip doctor`: packages, the folder of kernels and tables, commands that lack a package."""

from __future__ import annotations

import contextlib
import importlib.metadata
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import typer

from macroslip.cli.options import AsJson, Quiet
from macroslip.cli.printing import print_json, print_table
from macroslip.cli.progress import command_progress
from macroslip.errors import InputError

_OF_THE_MACHINE = ("python", "system", "processor", "cores")


def doctor(
    case: Annotated[
        Path | None, typer.Argument(help="A case file whose tables --warm makes beside.")
    ] = None,
    warm: Annotated[
        bool,
        typer.Option(
            "--warm",
            help="Compile everything, and make the tables of CASE, so that later runs need not.",
        ),
    ] = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Show versions, the folder of kernels and tables, and packages missing for a command."""
    if warm:
        _warm(case, quiet)
    elif case is not None:
        raise InputError(
            f"{case} is given, and nothing is to be made ahead",
            where="CASE",
            remedy="Add --warm to make its tables, or leave it out.",
        )
    import macroslip
    from macroslip.cli.needs import COMMANDS, missing_packages
    from macroslip.machine import machine
    from macroslip.storage.cache import cache_folder

    folder = cache_folder()
    sizes = sizes_of_files(folder) if folder else []
    lacking = {command: missing_packages(need) for command, need in COMMANDS.items()}
    megabytes = sum(sizes) / 1e6
    about_machine = machine()
    of_machine = {name: value for name, value in about_machine.items() if name in _OF_THE_MACHINE}
    caches = {
        "folder": str(folder) if folder else None,
        "files": len(sizes),
        "megabytes": megabytes,
    }
    commands = []
    for command, missing in lacking.items():
        remedy = ""
        if missing:
            remedy = f"pip install 'macroslip[{COMMANDS[command].extra}]'"
        commands.append({"command": command, "missing": missing, "remedy": remedy})
    report = {
        "version": macroslip.__version__,
        "machine": of_machine,
        "caches": caches,
        "packages": list(_packages()),
        "commands": commands,
    }
    if as_json:
        print_json(report)
        return
    rows = [[name, str(of_machine[name])] for name in _OF_THE_MACHINE]
    stored = "NO FOLDER CAN BE WRITTEN: every run compiles again"
    if folder:
        stored = f"{folder}, {megabytes:.3g} MB in {len(sizes)} files"
    rows.append(["caches", stored])
    print_table(f"macroslip {report['version']}", ["", ""], rows)
    typer.echo()
    rows = [
        [package["package"], package["installed"] or "-", package["wanted"]]
        for package in report["packages"]
    ]
    print_table("packages", ["package", "installed", "wanted"], rows)
    typer.echo()
    rows = []
    for command in commands:
        state = "ready"
        if command["missing"]:
            state = f"lacks {', '.join(command['missing'])}"
        rows.append([command["command"], state, command["remedy"]])
    print_table("commands that need more", ["command", "", ""], rows)


def sizes_of_files(folder: Path) -> list[int]:
    """Sizes of all files in a folder and below [bytes].

    Those that another process removes meanwhile, such as its own folder of kernels at its end, are
    left out.
    """
    sizes = []
    for place, _, names in os.walk(folder):
        for name in names:
            with contextlib.suppress(OSError):
                sizes.append(os.stat(os.path.join(place, name)).st_size)
    return sizes


def _warm(case: Path | None, quiet: bool) -> None:
    """Compile everything, and make the tables of a case."""
    from macroslip.case.case_file import bearings_in, read_case
    from macroslip.result.warm import compile_all, make_tables

    cases = []
    if case:
        cases = [read_case(case, bearing=name) for name in bearings_in(case)]
    with command_progress(quiet=quiet):
        compile_all()
        for case_read in cases:
            make_tables(case_read)


def _packages() -> Iterator[dict[str, Any]]:
    """Packages that the program requires in its metadata: installed version, and the bound."""
    from macroslip.machine import version_of

    try:
        wanted = importlib.metadata.requires("macroslip") or []
    except importlib.metadata.PackageNotFoundError:
        return
    for line in wanted:
        requirement, _, marker = line.partition(";")
        parts = re.fullmatch(r"([\w.-]+)(?:\[[\w,]*\])?\s*(.*?)\s*", requirement)
        extra = re.search(r"extra == ['\"](\w+)['\"]", marker)
        if (
            parts is None
            or parts[1] == "macroslip"
            or (extra and extra[1] not in ("figures", "excel", "cluster", "notebook"))
        ):
            continue
        name = parts[1]
        bound = parts[2]
        if extra:
            bound += f", for [{extra[1]}]"
        yield {"package": name, "installed": version_of(name), "wanted": bound}
