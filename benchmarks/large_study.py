"""A study of many cases without computing them: how long it takes to open and to aggregate, and how much memory.

    python -m benchmarks.large_study --cases 100000

The folder is written by the same functions as that of a real study; the numbers in it are drawn at random, and one stored
result stands for all. Opening and aggregating then run in processes of their own, whose time and memory are printed.
"""

from __future__ import annotations

import argparse
import hashlib
import itertools
import json
import math
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

from macroslip.bearing.geometry import ROWS
from macroslip.storage.files import write_durably
from macroslip.study.aggregation import Aggregation
from macroslip.study.database import Outcome, write_summary
from macroslip.study.result_files import case_path, checksum, layout, to_bytes
from macroslip.study.run import Session
from macroslip.study.study_file import Study, study_of
from macroslip.study.summary import NUMBERS

_BATCH = 5000
_LOADS = ["12A", "14A", "16A", "18A", "20A", "22A", "24A"]


def study(count: int) -> Study:
    """A study of at least `count` runs."""
    tilts = [round(2.0 + 1e-5 * number, 5) for number in range(-(-count // len(_LOADS)))]
    grid = {"drivetrain.tilt": {"values": tilts, "unit": "deg"}}
    return study_of(
        {"case": {"rollers": [0]}, "loads": {"bundled": _LOADS}, "variations": {"grid": grid}}
    )


def example() -> Any:
    """A result of the shape that `simulate` gives, filled with ones."""
    import xarray as xr

    about = {"units": "1", "long_name": "an example"}
    dims = {"energy": ("row", "roller", "interface"), "status": ("row", "roller")}
    sizes = {"row": 2, "roller": 1, "interface": 3}
    values = {
        name: (some, np.ones([sizes[dim] for dim in some]), about) for name, some in dims.items()
    }
    coordinates = {
        "row": list(ROWS),
        "roller": ("roller", [0], about),
        "orbit": ("orbit", np.arange(2), about),
    }
    return xr.Dataset(values, coordinates | {"interface": ["inner", "outer", "cage"]})


def _numbers(random: np.random.Generator) -> dict[str, float]:
    """Numbers of a run drawn at random; NaN for the row that a bearing of two rows has not."""
    drawn = dict(zip(NUMBERS, random.random(len(NUMBERS)).tolist(), strict=True))
    without = {name: math.nan for name in NUMBERS if name.endswith("_single")}
    return drawn | without | {"window_length": 600.0}


def write_study(directory: Path, work: Study) -> None:
    """Write the folder of a study that has ended, with numbers drawn at random."""
    random = np.random.default_rng(1)
    directory.mkdir(parents=True)
    result = example()
    content = to_bytes(result)
    detail, shape = checksum(content), layout(result)
    session = Session(work, directory, None)
    with session.opened():
        runs = work.runs()
        while batch := list(itertools.islice(runs, _BATCH)):
            session.database.record(
                {
                    "run": run.name, "key": hashlib.sha256(run.name.encode()).hexdigest(), "outcome": Outcome.COMPLETED,
                    "reason": "", "detail": detail, "layout": shape,
                    "values": _numbers(random),
                }
                for run in batch
            )  # fmt: skip
            key = hashlib.sha256(batch[-1].name.encode()).hexdigest()
    write_durably(
        case_path(directory, key), content
    )  # the reader opens the last one of each layout
    write_summary(directory, {name: units for name, (units, _) in work.labels.items()})


def open_it(directory: Path) -> None:
    """Open a study and look at its summary."""
    from macroslip import open_study

    opened = open_study(directory)
    assert bool((opened.outcome == "completed").all()) and float(opened.energy_mean.mean()) > 0.0


def aggregate_it(directory: Path) -> None:
    """Open a study and make all tables of its lifetime."""
    from macroslip.study.export import tables, write_tables
    from macroslip.study.reader import open_study
    from macroslip.study.weights import Weibull

    frames = tables(
        open_study(directory),
        Aggregation(Weibull(9.5, 2.0), years=20.0, field="wind_speed", width=2.0, by=()),
    )
    write_tables(frames, directory.parent / "tables", "parquet")


STEPS = {"open": open_it, "aggregate": aggregate_it}


def main(arguments: list[str] | None = None) -> None:
    """Write a study, then open and aggregate it in processes of their own."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cases", type=int, default=100_000)
    parser.add_argument("--step", choices=STEPS, help=argparse.SUPPRESS)
    parser.add_argument("--directory", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    if options.step:
        start, used = time.perf_counter(), time.process_time()
        STEPS[options.step](options.directory)
        print(
            json.dumps(
                {
                    "seconds": round(time.perf_counter() - start, 1),
                    "processor seconds": round(time.process_time() - used, 1),
                    "MB": round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024),
                }
            )
        )
        return
    with tempfile.TemporaryDirectory() as folder:
        directory = Path(folder) / "out"
        work, start = study(options.cases), time.perf_counter()
        write_study(directory, work)
        size = sum(path.stat().st_size for path in directory.rglob("*") if path.is_file())
        print(
            f"{len(work)} cases written in {time.perf_counter() - start:.1f} s, {size / 1e6:.0f} MB"
        )
        for step in STEPS:
            command = [
                sys.executable,
                "-m",
                "benchmarks.large_study",
                "--step",
                step,
                "--directory",
                str(directory),
            ]
            print(
                f"{step}: {subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.strip()}",
                flush=True,
            )


if __name__ == "__main__":
    main()
