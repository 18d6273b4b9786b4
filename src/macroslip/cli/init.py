"""`macroslip init`: a case file to start from; it runs as it stands."""

from __future__ import annotations

from importlib import resources
from pathlib import Path
from typing import Annotated

import typer

from macroslip.files import check_new_file, new_file


def init(
    path: Annotated[Path, typer.Argument(help="The case file to write.")] = Path("case.yaml"),
    force: Annotated[bool, typer.Option("--force", help="Replace the file if it exists.")] = False,
) -> None:
    """Write a case file with every key explained."""
    text = (resources.files("macroslip.cli") / "case_template.yaml").read_text(encoding="utf-8")
    check_new_file(path, force=force)
    with new_file(path, force=force) as temporary:
        temporary.write_text(text, encoding="utf-8")
    typer.echo(f"written: {path}\nrun it:  macroslip run {path} -o {path.with_suffix('.nc')}")
