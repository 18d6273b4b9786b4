"""`macroslip init`: a case file to start from, or another example; each runs as written."""

from __future__ import annotations

from enum import StrEnum
from importlib import resources
from pathlib import Path
from typing import Annotated

import typer

from macroslip.cli.options import Force
from macroslip.errors import InputError, legible
from macroslip.storage.files import check_new_file, write_new


class Example(StrEnum):
    """Files that `macroslip init` can write."""

    CASE = "case"
    STUDY = "study"
    BEARING = "bearing"
    LUBRICANT = "lubricant"
    LAWS = "laws"
    SCADA = "scada"


#: The files of each example: the first takes the name that the user gives, the others are written
#: beside it.
_FILES = {
    Example.CASE: ("macroslip.cli/case_template.yaml",),
    Example.STUDY: ("examples/study.yaml",),
    Example.BEARING: ("macroslip.bearing/catalogue/skf-240-600-bc.yaml",),
    Example.LUBRICANT: ("macroslip.lubricant/catalogue/vg460-pao.yaml",),
    Example.LAWS: ("examples/own_laws.yaml", "examples/own_film.py", "examples/own_law.py"),
    Example.SCADA: ("examples/scada.yaml", "examples/scada.csv.gz", "examples/scada_study.yaml"),
}
_NEXT = {
    Example.CASE: "run it:     macroslip run {path} -o {stem}.nc",
    Example.STUDY: "look at it: macroslip study {path} --dry-run\nrun it:     macroslip study {path} -o out",
    Example.BEARING: "look at it: macroslip bearing show {path}\nuse it:     bearing: {path}, in a case file beside it",
    Example.LUBRICANT: "look at it: macroslip lubricant show {path}\nuse it:     lubricant: {path}, in a case file beside it",
    Example.LAWS: "run it:     macroslip run {path} --laws {folder}own_film.py --laws {folder}own_law.py -o {stem}.nc",
    Example.SCADA: "look at it: macroslip scada inspect {path}\n"
    "load cases: macroslip study {folder}scada_study.yaml -o {folder}scada-study\n"
    "a year:     macroslip scada year {path} --study {folder}scada-study -o {folder}scada-year\n"
    "its heat:   macroslip scada heat {path} --study {folder}scada-study -o {folder}scada-heat",
}


def init(
    path: Annotated[
        Path | None,
        typer.Argument(
            help="The file to write; case.yaml, or the name of the example, if not given."
        ),
    ] = None,
    example: Annotated[
        Example | None,
        typer.Option(
            help="What to write, a case if not given; `laws` and `scada` also write "
            "files beside it."
        ),
    ] = None,
    turbine: Annotated[
        str | None,
        typer.Option(
            help="Write a case of a named turbine with its bearing, mount, loads and oil; "
            "`macroslip turbine list` has the names. Not with --example."
        ),
    ] = None,
    force: Force = False,
) -> None:
    """Write a case file with every key explained, the case of a turbine, or another example."""
    if turbine is not None and example is not None:
        raise InputError(
            f"--turbine {legible(turbine, 60)} and --example {example} ask for two different files",
            allowed="one of them",
            remedy="--turbine writes a case of that turbine; leave --example out for it.",
        )
    example = example or Example.CASE
    name = "own_laws.yaml" if example is Example.LAWS else f"{example}.yaml"
    path = path or Path(name)
    contents = _contents_of(example, path) if turbine is None else {path: _case_of(turbine)}
    for target in contents:
        check_new_file(target, force=force)
    for target, content in contents.items():
        write_new(target, content, force=force)
        typer.echo(f"written:    {target}")
    folder = "" if path.parent == Path() else f"{path.parent}/"
    following = _NEXT[example].format(path=path, stem=path.with_suffix(""), folder=folder)
    typer.echo(following)


def _contents_of(example: Example, path: Path) -> dict[Path, bytes]:
    """Content of every file of an example, by the path that it gets."""
    first, *others = _FILES[example]
    return {path: _content(first)} | {
        path.with_name(name.rpartition("/")[2]): _content(name) for name in others
    }


def _case_of(turbine: str) -> bytes:
    from macroslip.turbine import Turbine

    return Turbine.read(turbine).case_text().encode()


def _content(name: str) -> bytes:
    package, _, inside = name.partition("/")
    if package != "examples":
        return resources.files(package).joinpath(inside).read_bytes()
    # A wheel has the examples beside this module; a clone has them at its root, where people look
    # for them.
    here = Path(__file__)
    folder = here.with_name("examples")
    if not folder.is_dir():
        folder = here.parents[3] / "examples"
    return (folder / inside).read_bytes()
