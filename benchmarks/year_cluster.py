"""A year of four designs and sixteen samples on a Dask cluster of processes, whose workers are killed meanwhile.

    python -m benchmarks.year_cluster                       # 46 loads x 4 x 16, 10 s each, one roller a row
    python -m benchmarks.year_cluster --seconds 600 --rollers 0 7 14 21

A scheduler, two workers and `macroslip study` run as a user starts them. Every run must have its result with the right
checksum, once, and none may have failed. Times and memory are printed.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import psutil

from benchmarks.soak import WORKERS, cluster, looked_through, resident, workers_of
from macroslip import open_study
from macroslip.storage.files import DATABASE


def content(seconds: float, rollers: list[int], designs: int, samples: int) -> dict[str, Any]:
    """Clearances as designs; a sample of oil, contact and mount. Each point of the sample needs tables of its own."""
    ranges = {
        "lubricant.viscosity": {"low": 0.4, "high": 0.7, "unit": "Pa s"},
        "bearing.osculation_outer": {"low": 0.965, "high": 0.98, "unit": "1"},
        "drivetrain.tilt": {"low": 4, "high": 6, "unit": "deg"},
    }
    clearances = [round(0.1 + 0.05 * k, 2) for k in range(designs)]
    return {
        "case": {
            "rollers": rollers,
            "laws": {"model": "physical"},
            "loads": {"end": f"{seconds} s"},
        },
        "loads": {"bundled": ["year"]},
        "variations": {
            "grid": {"bearing.diametral_clearance": {"values": clearances, "unit": "mm"}},
            "sample": {"count": samples, "seed": 1, "ranges": ranges},
        },
        "keep": ["energy", "entries"],
    }


def main() -> None:
    """Run the study, kill a worker once a period, and print what it took and what is wrong."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=10.0, help="of each load history")
    parser.add_argument("--rollers", type=int, nargs="+", default=[0], help="of each row")
    parser.add_argument("--designs", type=int, default=4)
    parser.add_argument("--samples", type=int, default=16)
    parser.add_argument("--every", type=float, default=60.0, help="time between kills [s]")
    options = parser.parse_args()
    kills, most = 0, dict.fromkeys(("scheduler", "study", "worker"), 0)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        study = content(options.seconds, options.rollers, options.designs, options.samples)
        with cluster(folder, study) as running:
            begun = killed = time.monotonic()
            while running.study.poll() is None:
                time.sleep(1.0)
                workers = workers_of(running.nannies)
                sizes = {
                    "scheduler": resident(psutil.Process(running.scheduler.pid)),
                    "study": resident(psutil.Process(running.study.pid)),
                    "worker": max(map(resident, workers), default=0),
                }
                most = {who: max(most[who], size) for who, size in sizes.items()}
                if time.monotonic() - killed >= options.every and len(workers) == WORKERS:
                    workers[kills % WORKERS].kill()
                    killed, kills = time.monotonic(), kills + 1
            wall = time.monotonic() - begun
        log = (folder / "study.log").read_text(encoding="utf-8")
        if not (folder / "out" / DATABASE).exists():
            sys.exit(log)
        recorded, problems = looked_through(folder, folder / "out", 0, 0)
        opened = open_study(folder / "out")
        if recorded != opened.sizes["case"] or running.study.returncode:
            problems.append(
                f"{recorded} of {opened.sizes['case']} runs are recorded, exit code {running.study.returncode}"
            )
        parts = {key: float(opened[key].sum()) for key in ("simulate_seconds", "other_seconds")}
        disk = sum(path.stat().st_size for path in (folder / "out").rglob("*") if path.is_file())
    print(
        f"{recorded} runs in {wall:.0f} s, {kills} workers killed, {disk / recorded / 1e3:.0f} kB a run"
    )
    print(
        *(f"{key} {1e3 * value / recorded:.0f} ms a run" for key, value in parts.items()),
        sep=", ",
    )
    print(*(f"{who} {size / 1e6:.0f} MB" for who, size in most.items()), sep=", ")
    print(
        *(problems or ["every run has one record and its result"]),
        log[-2000:] if problems else "",
        sep="\n",
    )
    sys.exit(bool(problems))


if __name__ == "__main__":
    os.environ.setdefault("PYTHONUNBUFFERED", "1")
    main()
