"""The option `--xlsx`: tables of a command as a workbook of Excel."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from macroslip.cli.needs import EXCEL, require
from macroslip.errors import InputError
from macroslip.storage.files import check_new_file, write_new
from macroslip.storage.workbook import EXTENSION, workbook

if TYPE_CHECKING:
    import pandas as pd

Xlsx = Annotated[
    Path | None,
    typer.Option(
        "--xlsx",
        help="A workbook of Excel to write as well: a sheet a table, the input on the last.",
    ),
]


def check_workbook(path: Path | None, *, force: bool, inputs: Iterable[Path] = ()) -> None:
    """Refuse a workbook that cannot be written, before anything is computed for it."""
    if path is None:
        return
    require(EXCEL)
    if path.suffix.lower() != EXTENSION:
        raise InputError(
            f"the extension {path.suffix!r} is none of a workbook",
            where=str(path),
            allowed=EXTENSION,
            remedy=f"Name the file {path.stem}{EXTENSION}.",
        )
    check_new_file(path, force=force, inputs=inputs)


def write_workbook(path: Path, sheets: Mapping[str, pd.DataFrame], *, force: bool) -> None:
    """Write tables as the sheets of a workbook, whole or not at all."""
    write_new(path, workbook(sheets), force=force)
