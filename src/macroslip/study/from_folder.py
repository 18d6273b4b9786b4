"""A study file made from a folder with output of OpenFAST, as WEIS and other programs leave it."""

from __future__ import annotations

import csv
import io
import json
import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from macroslip.errors import InputError, safe_text
from macroslip.loads.openfast import loads_from_channels, mean_wind_speed, read_channels
from macroslip.loads.source_file import DAMAGED
from macroslip.storage.files import reading

_OUTPUT = (".outb", ".out")
#: Wind speed in a name: 11.4mps, 12ms, U8, ws_10, wind_speed=6.5; p may stand for the point.
_WIND = re.compile(
    r"(?<![a-z\d.])(?:(?P<before>\d+(?:[.p]\d+)?)_?m(?:ps|s|_s)"
    r"|(?:wind_?speed|wind|wsp|ws|vhub|u|v)[_=-]?(?P<after>\d+(?:[.p]\d+)?))(?![a-z\d])",
    re.IGNORECASE,
)
_SEED = re.compile(r"(?<![a-z])(?:seed|s)[_=-]?(\d+)(?![a-z\d])", re.IGNORECASE)
#: Largest relative difference between the wind speed of a name and the file's mean; the gust of a
#: short record stays below it.
_SAME_WIND = 0.3
_TEXT = """\
# Made from the folder {folder}. `macroslip study {study} --dry-run` shows what it takes.
title: {title}
case:
  loads: {{start: {start:g} s}}   # the file's own time axis; cut the start of the simulation off
  # drivetrain: {{hub_to_bearing: 1.9 m, bearing_to_gearbox: 2.6 m}}   # distances of your turbine
loads:
  table: {table}   # files with their labels, which may be changed
"""


class FolderStudy(NamedTuple):
    """A study file that is made from a folder."""

    texts: Mapping[Path, str]  #: Texts of the study file and of its table of loads.
    labels: Sequence[Mapping[str, float]]  #: Of each load file.
    remarks: Sequence[str]  #: Files that are left out, and wind speeds that differ from the name.


def study_of_folder(folder: Path, study: Path) -> FolderStudy:
    """Make a study of all output of OpenFAST in a folder and those below it.

    The wind speed [m/s] of a file is the one in its path or, where there is none or the file has
    another mean, the mean of its channel; the seed is the one in its path, if all have one. Files
    without hub loads, as other modules of OpenFAST write them, are left out.

    Parameters
    ----------
    folder : Path
        Where the files are. Of ``run.outb`` and ``run.out`` side by side the binary one is taken.
    study : Path
        The study file to write; its table of loads is beside it.

    Raises
    ------
    InputError
        If the folder has no file with hub loads, or the wind speed of one is not known.
    """
    if not folder.is_dir():
        raise InputError("there is no such folder", where=str(folder), remedy="Check the path.")
    paths = sorted(
        path for path in folder.rglob("*") if path.suffix.lower() in _OUTPUT and path.is_file()
    )
    binary = {path.with_suffix("") for path in paths if path.suffix.lower() == ".outb"}
    rows: list[dict[str, str | float]] = []
    remarks: list[str] = []
    starts = []
    for path in paths:
        if path.suffix.lower() == ".out" and path.with_suffix("") in binary:
            continue
        name = path.relative_to(folder).as_posix()
        try:
            name.encode()
            # Numbers that are not finite are reported when the study reads the file.
            with reading(path, DAMAGED), np.errstate(all="ignore"):
                channels = read_channels(path)
                loads = loads_from_channels(channels, speed_needed=True)
                mean = mean_wind_speed(channels)
        except (InputError, OSError, UnicodeEncodeError) as problem:
            reason = str(problem)
            if isinstance(problem, InputError):
                reason = problem.fault
            remarks.append(f"{safe_text(name)} is left out: {safe_text(reason)}")
            continue
        starts.append(float(loads["time"][0]))
        path_from_study = os.path.relpath(path.resolve(), study.resolve().parent)
        row: dict[str, str | float] = {"file": Path(path_from_study).as_posix()}
        wind = _number(_WIND, name)
        if wind is not None and mean is not None and abs(wind - mean) > _SAME_WIND * mean:
            remarks.append(
                f"{safe_text(name)}: its name says {wind:g} m/s, and the file has a mean of "
                f"{mean:.3g} m/s, which is taken"
            )
            wind = None
        if wind is None:
            if mean is None:
                raise InputError(
                    f"the wind speed of {safe_text(name)} is not known",
                    where=str(folder),
                    allowed="a name with it, such as 11.4mps or U8, or a channel Wind1VelX",
                    remedy="Rename the files, or list them in a table with a column wind_speed.",
                )
            wind = round(mean, 2)
        row["wind_speed"] = wind
        seed = _number(_SEED, name)
        if seed is not None:
            row["seed"] = int(seed)
        rows.append(row)
    if not rows:
        raise InputError(
            f"no file with hub loads is in the folder ({len(paths)} files {' and '.join(_OUTPUT)})",
            where=str(folder),
            allowed="output of OpenFAST with the channels of ElastoDyn for loads at the hub",
            remedy=f"{remarks[0]}." if remarks else "Check the path.",
        )
    names = ["file", "wind_speed"]
    if all("seed" in row for row in rows):
        names.append("seed")
    table = study.with_name(f"{study.stem}-loads.csv")
    text = _TEXT.format(
        folder=safe_text(folder.resolve().name),
        study=safe_text(study.name),
        title=json.dumps(f"Loads of {folder.resolve().name}"),
        start=max(starts),
        table=json.dumps(table.name),
    )
    labels = []
    for row in rows:
        labels.append({name: float(row[name]) for name in names[1:]})
    return FolderStudy({study: text, table: _csv(names, rows)}, labels, remarks)


def _number(pattern: re.Pattern[str], name: str) -> float | None:
    """The last number that a pattern finds in a path, None without one."""
    texts = []
    for match in pattern.finditer(name):
        texts += [text for text in match.groups() if text]
    if not texts:
        return None
    number = texts[-1].lower().replace("p", ".")
    return float(number)


def _csv(names: Sequence[str], rows: Sequence[Mapping[str, str | float]]) -> str:
    """Rows as a CSV table with some columns."""
    text = io.StringIO()
    writer = csv.DictWriter(text, names, extrasaction="ignore", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()
