"""`macroslip doctor`: what is installed, where kernels are kept, and which commands lack a package."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from collections.abc import Iterator


def doctor(
    as_json: Annotated[bool, typer.Option("--json", help="Print it as JSON.")] = False,
) -> None:
    """Show versions, the folder of compiled kernels, processors, and what is missing for which command."""
    from macroslip.cli.printing import print_json, print_table

    found = examine()
    if as_json:
        print_json(found)
        return
    machine, cache = found["machine"], found["kernels"]
    rows = [[name, str(machine[name])] for name in ("python", "system", "processor", "cores")]
    nowhere = "NO FOLDER CAN BE WRITTEN: every run compiles again"
    stored = f"{cache['folder']}, {cache['megabytes']:.3g} MB in {cache['files']} files"
    rows.append(["kernels", stored if cache["folder"] else nowhere])
    print_table(f"macroslip {found['version']}", [("", False), ("", False)], rows)
    typer.echo()
    print_table(
        "packages",
        [("package", False), ("installed", False), ("wanted", False)],
        [[one["package"], one["installed"] or "-", one["wanted"]] for one in found["packages"]],
    )
    typer.echo()
    rows = [
        [one["command"], "ready" if not one["missing"] else f"lacks {', '.join(one['missing'])}", one["remedy"]]
        for one in found["commands"]
    ]
    print_table("commands that need more", [("command", False), ("", False), ("", False)], rows)


def examine() -> dict[str, Any]:
    """What `macroslip doctor` shows, as data."""
    import macroslip
    from macroslip.machine import machine

    return {
        "version": macroslip.__version__,
        "machine": {name: value for name, value in machine().items() if name in _OF_THE_MACHINE},
        "kernels": _kernels(),
        "packages": list(_packages()),
        "commands": _commands(),
    }


_OF_THE_MACHINE = ("python", "system", "processor", "cores")


def _kernels() -> dict[str, Any]:
    """Where the kernels of these sources are kept; without a folder every process compiles for itself."""
    from macroslip.kernel_cache import kernel_folder

    folder = kernel_folder()
    files = [path for path in folder.rglob("*") if path.is_file()] if folder else []
    return {
        "folder": str(folder) if folder else None,
        "files": len(files),
        "megabytes": sum(path.stat().st_size for path in files) / 1e6,
    }


def _packages() -> Iterator[dict[str, str | None]]:
    """Packages that the program requires in its metadata: installed version, and the bound."""
    import importlib.metadata

    try:
        wanted = importlib.metadata.requires("macroslip") or []
    except importlib.metadata.PackageNotFoundError:
        return
    for line in wanted:
        requirement, _, marker = line.partition(";")
        parts = re.fullmatch(r"([\w.-]+)(?:\[[\w,]*\])?\s*(.*?)\s*", requirement)
        if parts is None:
            continue
        name, bound = parts.groups()
        extra = re.search(r"extra == ['\"](\w+)['\"]", marker)
        if name == "macroslip" or (extra and extra[1] not in ("figures", "cluster", "notebook")):
            continue
        try:
            installed = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            installed = None
        yield {"package": name, "installed": installed, "wanted": bound + (f", for [{extra[1]}]" if extra else "")}


def _commands() -> list[dict[str, Any]]:
    from macroslip.cli.needs import COMMANDS, missing_packages

    found = []
    for command, needs in COMMANDS.items():
        lacking = [name for need in needs for name in missing_packages(need)]
        extras = ",".join(need.extra for need in needs if missing_packages(need))
        found.append(
            {"command": command, "missing": lacking, "remedy": f"pip install 'macroslip[{extras}]'" if lacking else ""}
        )
    return found
