"""Measure studies on this machine: overhead, threads, workers, memory, and what a scheduler can do.

    python benchmarks/many_cases.py [--quick] [--only speed] [-o many_cases.json]

It takes about fifteen minutes (`--quick`: three) and wants a quiet machine. It prints every number and writes it to a
JSON file. Ratios are the best of several rounds, taken in turn, beside what two processors were worth for plain hashing
in the same rounds.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from macroslip import open_study, run_study
from macroslip.cli.needs import SCHEDULER, require
from macroslip.machine import usable_processors
from macroslip.study.study_file import study_of
from macroslip.study.summary import NUMBERS

CASES = ["12A", "12C", "14B", "16A", "18B", "20C", "22A", "24A"]
ROUNDS = 3


def study(count: int, seconds: float | None = None, rollers: str | list[int] = "all"):
    """Ten-minute cases, or shorter ones, that all differ."""
    tilts = [round(4.0 + 0.001 * number, 3) for number in range(-(-count // len(CASES)))]
    case = {"rollers": rollers} | ({"loads": {"end": f"{seconds} s"}} if seconds else {})
    grid = {"drivetrain.tilt": {"values": tilts, "unit": "deg"}}
    return study_of({"case": case, "loads": {"bundled": CASES}, "variations": {"grid": grid}})


def steady(marks: list[tuple[float, int]], skip: int) -> float:
    """Runs a second from the `skip`-th to the last."""
    chosen = [mark for mark in marks if mark[1] >= skip]
    return (chosen[-1][1] - chosen[0][1]) / (chosen[-1][0] - chosen[0][0])


def timed_study(folder: Path, work, skip: int, **options) -> dict[str, float]:
    """One study in a new folder: runs a second once all workers are at work, wall time, overhead."""
    out = folder / "out"
    shutil.rmtree(out, ignore_errors=True)
    marks: list[tuple[float, int]] = []
    started = time.perf_counter()
    run_study(
        work,
        out,
        progress=lambda progress: marks.append((time.perf_counter(), progress.done)),
        **options,
    )
    wall = time.perf_counter() - started
    opened = open_study(out)
    assert (opened.outcome == "completed").all()
    size = sum(path.stat().st_size for path in out.glob("cases/*/*.nc"))
    return {
        "rate": steady(marks, skip),
        "wall_s": wall,
        "overhead": float(opened.other_seconds.sum() / opened.simulate_seconds.sum()),
        "other_ms": 1e3 * float(opened.other_seconds.median()),
        "simulate_s": float(opened.simulate_seconds.median()),
        "bytes_per_case": size / opened.sizes["case"],
        "database_bytes_per_case": (out / "study.sqlite").stat().st_size / opened.sizes["case"],
    }


def hashing(threads: int) -> float:
    """Wall time of work that has nothing to do with rollers."""
    started = time.perf_counter()
    with ThreadPoolExecutor(threads) as pool:
        list(
            pool.map(
                lambda _: hashlib.pbkdf2_hmac("sha256", b"macroslip", b"study", 400_000), range(8)
            )
        )
    return time.perf_counter() - started


def speed(folder: Path, quick: bool) -> dict[str, float]:
    """One and two threads, one and two workers, in turn."""
    work = study(16 if quick else 48)
    rounds: dict[str, list] = {"hashing": []}
    options = {
        "one thread": {"threads": 1},
        "two threads": {"threads": 2},
        "one worker": {"workers": 1, "threads": 1},
        "two workers": {"workers": 2, "threads": 1},
    }
    for _ in range(1 if quick else ROUNDS):
        rounds["hashing"].append(hashing(1) / hashing(2))
        for name, arguments in options.items():
            rounds.setdefault(name, []).append(timed_study(folder, work, 4, **arguments))
    best = {name: max(measured["rate"] for measured in rounds[name]) for name in options}
    overheads = [measured["overhead"] for measured in rounds["one thread"]]
    return {
        "two_threads_over_one": best["two threads"] / best["one thread"],
        "two_threads_over_one_best_round": max(
            b["rate"] / a["rate"]
            for a, b in zip(rounds["one thread"], rounds["two threads"], strict=False)
        ),
        "two_workers_over_one": best["two workers"] / best["one worker"],
        "two_workers_over_one_best_round": max(
            b["rate"] / a["rate"]
            for a, b in zip(rounds["one worker"], rounds["two workers"], strict=False)
        ),
        "one_worker_over_this_process": best["one worker"] / best["one thread"],
        "hashing_two_over_one": max(rounds["hashing"]),
        "overhead": min(overheads),
        "overhead_worst_round": max(overheads),
        "overhead_two_workers": min(measured["overhead"] for measured in rounds["two workers"]),
        **{
            key: rounds["one thread"][0][key]
            for key in ("other_ms", "simulate_s", "bytes_per_case", "database_bytes_per_case")
        },
        "wall_beyond_steady_two_workers_s": min(
            measured["wall_s"] - len(work) / measured["rate"] for measured in rounds["two workers"]
        ),
        "rounds": rounds,
    }


def peak_memory(code: str) -> dict:
    """The numbers that a process prints as JSON."""
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=True,
        cwd=Path(__file__).parent,
    )
    return json.loads(done.stdout.splitlines()[-1])


MEMORY = """
import json, os, sys, tempfile
sys.path.insert(0, ".")
from many_cases import high_water, study
from macroslip import run_study

if __name__ == "__main__":
    import psutil

    peaks, workers = [], [0]

    def look(progress):
        peaks.append(high_water(os.getpid()))
        if len(peaks) % 20 == 0:
            workers.append(max([high_water(child.pid) for child in psutil.Process().children(recursive=True)],
            default=0))

    with tempfile.TemporaryDirectory() as folder:
        ended = run_study(study({count}, {seconds}, {rollers}), folder + "/out", progress=look, **{options})
    print(json.dumps({"runs": ended.progress.computed, "seconds": ended.progress.seconds,
                      "after_a_tenth": peaks[max(len(peaks) // 10 - 1, 0)], "at_the_end": peaks[-1],
                      "largest_worker": max(workers)}))
"""


def high_water(process: int) -> int:
    """Peak resident memory of a process [bytes], which unlike that of getrusage knows nothing of its parent."""
    try:
        lines = Path(f"/proc/{process}/status").read_text(encoding="utf-8").splitlines()
    except OSError:  # it has ended
        return 0
    return next((1024 * int(line.split()[1]) for line in lines if line.startswith("VmHWM")), 0)


def memory(quick: bool) -> dict[str, dict]:
    """Peak memory after a tenth of a study and at its end: 3,000 short cases, and ten-minute ones."""
    count, long = (400, 20) if quick else (3000, 60)

    def measured(runs: int, seconds: float | None, rollers: object, options: dict) -> dict:
        text = (
            MEMORY.replace("{count}", str(runs))
            .replace("{seconds}", repr(seconds))
            .replace("{rollers}", repr(rollers))
        )
        return peak_memory(text.replace("{options}", repr(options)))

    return {
        "short cases, this process": measured(count, 12.0, [0], {"threads": 2}),
        "short cases, two workers": measured(count, 12.0, [0], {"workers": 2, "threads": 1}),
        "ten-minute cases, this process": measured(long, None, "all", {"threads": 2}),
        "ten-minute cases, two workers": measured(long, None, "all", {"workers": 2, "threads": 1}),
    }


def nothing(tasks: list) -> list:
    """A task that does nothing but send back what a run sends back."""
    values = {name: [0.1, 0.2] for name in "abcdefghijklmn"} | {
        "simulate_seconds": 1.0,
        "other_seconds": 0.01,
    }
    return [dict(task, values=values, outcome="completed") for task in tasks]


def scheduler(quick: bool) -> dict[str, float]:
    """What passes through one scheduler on this machine, the client included, with two workers that do nothing."""
    from distributed import Client, LocalCluster

    from macroslip.study import workers

    count, task = (
        (500 if quick else 3000),
        {"run": "0" * 32, "load": "x" * 120, "settings": [["a.b", 1.0, "mm"]] * 3},
    )
    times = {}
    with (
        LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            host="127.0.0.1",
            dashboard_address="127.0.0.1:0",
            security=True,
        ) as local,
        Client(local) as client,
    ):
        for bundle in (1, 10):
            workers.work_several = nothing
            pool = workers.Dask(client, lambda text: None)
            pool._bundle = lambda bundle=bundle: bundle
            started, sent, done = time.perf_counter(), 0, 0
            while done < count * bundle:
                free = min(max(4 * 64 - len(pool._under_way), 0) * bundle, count * bundle - sent)
                pool.submit([task] * free)
                sent += free
                done += len(pool.wait())
            times[f"runs_per_second_bundles_of_{bundle}"] = done / (time.perf_counter() - started)
    return times


def coordinator(folder: Path, quick: bool) -> dict[str, float]:
    """What the study itself costs for each run: the database, the counts, the log, the summary; without workers."""
    from macroslip.study import run as module
    from macroslip.study.work import program

    count = 2000 if quick else 20000
    work = study(count, 12.0, [0])

    class Pretended:
        def __init__(self, count):
            self.tasks = []

        def __enter__(self):
            return self

        def __exit__(self, *error):
            pass

        def free_places(self):
            return 200 - len(self.tasks)

        def submit(self, tasks):
            self.tasks += tasks

        def wait(self):
            tasks, self.tasks = self.tasks, []
            return [(task, self.result(task["run"])) for task in tasks]

        def result(self, run):
            key = hashlib.sha256(run.encode()).hexdigest()
            return {
                "run": run, "key": key, "program": program(), "outcome": "completed", "reason": "", "detail": key,
                "layout": json.dumps({"sizes": {"row": 2}, "variables": "0" * 16}), "values": dict.fromkeys(NUMBERS, 0.1234567),
            }  # fmt: skip

    module.ThisProcess = Pretended
    out = folder / "pretended"
    started, wall = time.process_time(), time.perf_counter()
    run_study(work, out)
    seconds, wall = time.process_time() - started, time.perf_counter() - wall
    runs = len(work)
    rss = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    sizes = {path.name: path.stat().st_size / runs for path in out.iterdir() if path.is_file()}
    return {
        "processor_ms_per_run": 1e3 * seconds / runs,
        "wall_ms_per_run": 1e3 * wall / runs,
        "peak_bytes": rss,
        "bytes_per_run": sizes,
    }


def main() -> None:
    """Measure everything, print it and write it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("-o", "--output", type=Path, default=Path("many_cases.json"))
    parser.add_argument("--only", choices=("speed", "scheduler", "memory", "coordinator"))
    options = parser.parse_args()
    if options.only in (None, "scheduler"):
        require(SCHEDULER)
    measured: dict[str, object] = {"cores": usable_processors(), "load_before": os.getloadavg()[0]}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run_study(study(1, 5.0), folder / "compile")
        parts = {
            "speed": lambda: speed(folder, options.quick),
            "scheduler": lambda: scheduler(options.quick),
            "memory": lambda: memory(options.quick),
            "coordinator": lambda: coordinator(folder, options.quick),
        }
        for name, measure in parts.items():
            if options.only in (None, name):
                measured[name] = measure()
                print(name)
                for key, value in measured[name].items():
                    if key != "rounds":
                        print(
                            f"  {key}: {json.dumps(value) if isinstance(value, dict) else f'{value:.4g}'}",
                            flush=True,
                        )
                options.output.write_text(json.dumps(measured, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
