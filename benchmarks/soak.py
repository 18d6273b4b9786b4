"""A study on a Dask cluster whose workers are killed again and again: whether memory grows or anything is lost.

    python -m benchmarks.soak --minutes 60

A scheduler, two workers and `macroslip study` run as a user starts them, on the loopback interface. Once a period one
of the workers gets SIGKILL, in turn; its nanny starts another. In the end the study is interrupted. Then every recorded
run must have its result with the right checksum, no run may have failed, and
a sample of the cases computed again here must agree to the last bit.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from macroslip import open_study, run_study
from macroslip.loads import bundled_cases
from macroslip.storage.files import DATABASE
from macroslip.study.result_files import case_path, checksum
from macroslip.study.study_file import study_of

#: Time between looks at the memory [s].
_LOOK = 5.0
#: Longest time until something that was started answers, and until the study has ended once it is interrupted [s].
_ANSWER, _END = 120.0, 120.0
#: More runs than an hour is enough for.
_RUNS = 200_000
WORKERS = 2


class Sample(NamedTuple):
    """What was seen at one moment: time since the first result [s], resident memory [bytes], runs that are done."""

    time: float
    scheduler: int
    study: int
    worker: int
    runs: int
    kills: int


class Found(NamedTuple):
    """What a soak ended with."""

    samples: list[Sample]
    kills: int
    recorded: int
    problems: list[str]


def content(runs: int = _RUNS) -> dict[str, Any]:
    """A study of ten seconds of the bundled loads: the paper's laws for all rollers, those of `physical` for a few."""
    tilts = [
        round(2.0 + 1e-4 * number, 4) for number in range(-(-runs // (2 * len(bundled_cases()))))
    ]
    return {
        "case": {"loads": {"start": "100 s", "end": "110 s"}},
        "loads": {"bundled": ["all"]},
        "models": {"paper": {}, "physical": {"laws.model": "physical", "rollers": [0, 14]}},
        "variations": {"grid": {"drivetrain.tilt": {"values": tilts, "unit": "deg"}}},
    }


@contextmanager
def started(folder: Path, name: str, *command: str) -> Iterator[subprocess.Popen]:
    """A Python process with its output in a file, for the length of the block."""
    with (folder / f"{name}.log").open("w", encoding="utf-8") as log:
        process = subprocess.Popen(
            [sys.executable, *command],
            stdout=log,
            stderr=log,
            cwd=folder,
            preexec_fn=_hear_interrupts,
        )
    try:
        yield process
    finally:
        _end(process)


def _hear_interrupts() -> None:
    """Undo what a shell does to commands in the background, whose children would not hear Ctrl-C either."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def _end(process: subprocess.Popen) -> None:
    """End a process with all that it has started."""
    import psutil

    try:
        family = [
            psutil.Process(process.pid),
            *psutil.Process(process.pid).children(recursive=True),
        ]
    except psutil.NoSuchProcess:
        family = []
    for member in family:
        try:
            member.kill()
        except psutil.NoSuchProcess:
            continue
    process.wait()


class Cluster(NamedTuple):
    """Processes of a study that Dask workers of this machine compute."""

    scheduler: subprocess.Popen
    nannies: subprocess.Popen  #: Which start the workers, and start another for one that died
    study: subprocess.Popen


@contextmanager
def cluster(folder: Path, study: dict[str, Any]) -> Iterator[Cluster]:
    """Run a study on a scheduler and workers as a user starts them; results go to `out` there."""
    (folder / "study.yaml").write_text(json.dumps(study), encoding="utf-8")
    dask, common = "distributed.cli.dask_", ("--host", "127.0.0.1", "--no-dashboard")
    address_file = folder / "scheduler.json"
    options = ("--port", "0", "--scheduler-file", str(address_file), *common)
    with started(folder, "scheduler", "-m", f"{dask}scheduler", *options) as scheduler:
        address = json.loads(waited_for(address_file, "}"))["address"]
        workers = (address, "--nworkers", str(WORKERS), "--nthreads", "1", *common)
        program = ("-c", "from macroslip.cli import main; main()")
        command = ("study", "study.yaml", "-o", "out", "--scheduler", address)
        with (
            started(folder, "workers", "-m", f"{dask}worker", *workers) as nannies,
            started(folder, "study", *program, *command) as process,
        ):
            yield Cluster(scheduler, nannies, process)


def soak(folder: Path, seconds: float, every: float, check: int) -> Found:
    """Run the study for a time, kill its workers, and look at what is left.

    Parameters
    ----------
    folder : Path
        For the study and the logs.
    seconds : float
        From the first result on.
    every : float
        Time between kills [s].
    check : int
        Number of cases that are computed again.
    """
    out = folder / "out"
    with cluster(folder, content()) as running:
        samples, kills, problems = _watched(out, running, seconds, every)
        running.study.send_signal(signal.SIGINT)
        try:
            if running.study.wait(_END) != 130:
                code = running.study.returncode
                problems.append(f"the interrupted study ended with exit code {code}")
        except subprocess.TimeoutExpired:
            problems.append(f"the interrupted study had not ended after {_END:g} s")
    recorded, wrong = looked_through(folder, out, samples[-1].runs if samples else 0, check)
    return Found(samples, kills, recorded, problems + wrong)


def waited_for(path: Path, end: str) -> str:
    """Content of a file that another process writes, once it has its end."""
    until = time.monotonic() + _ANSWER
    while not path.exists() or not path.read_text(encoding="utf-8").rstrip().endswith(end):
        if time.monotonic() > until:
            raise TimeoutError(f"{path} is not there after {_ANSWER:g} s")
        time.sleep(0.1)
    return path.read_text(encoding="utf-8")


def _watched(
    out: Path, running: Cluster, seconds: float, every: float
) -> tuple[list[Sample], int, list[str]]:
    """Look at the memory from the first result on, and kill a worker once a period."""
    import psutil

    samples: list[Sample] = []
    kills = 0
    begun, killed = None, 0.0
    limit = time.monotonic() + seconds + _ANSWER
    while begun is None or time.monotonic() < begun + seconds:
        if any(process.poll() is not None for process in running):
            return (
                samples,
                kills,
                ["a process that should run to the end has ended; its log has the reason"],
            )
        if begun is None and time.monotonic() > limit:
            return samples, kills, ["no result came"]
        lines = len(_recorded(out))
        if begun is None and lines:
            begun = killed = time.monotonic()
        workers = workers_of(running.nannies)
        if begun is not None:
            largest = max((resident(worker) for worker in workers), default=0)
            memory = [
                resident(psutil.Process(process.pid))
                for process in (running.scheduler, running.study)
            ]
            samples.append(
                Sample(time.monotonic() - begun, memory[0], memory[1], largest, lines, kills)
            )
            if time.monotonic() - killed >= every and len(workers) == WORKERS:
                workers[kills % WORKERS].kill()
                killed, kills = time.monotonic(), kills + 1
        time.sleep(min(_LOOK, every / 4.0))
    return samples, kills, []


def _recorded(out: Path) -> list[tuple[str, str | None, str | None, str | None]]:
    """Run, key, outcome and checksum of every run that is recorded."""
    if not (out / DATABASE).exists():
        return []
    query = (
        "SELECT run, runs.key, coalesce(runs.outcome, results.outcome), detail FROM runs "
        "LEFT JOIN results ON results.key = runs.key WHERE runs.key NOT NULL OR runs.outcome NOT NULL"
    )
    try:
        with closing(sqlite3.connect(f"{(out / DATABASE).as_uri()}?mode=ro", uri=True)) as database:
            return database.execute(query).fetchall()
    except sqlite3.OperationalError:  # the tables are being made
        return []


def workers_of(nannies: subprocess.Popen) -> list[Any]:
    """The processes of the workers below their nannies."""
    import psutil

    workers = []
    for child in psutil.Process(nannies.pid).children(recursive=True):
        try:
            if "spawn_main" in " ".join(child.cmdline()) and child.status() != psutil.STATUS_ZOMBIE:
                workers.append(child)
        except psutil.NoSuchProcess:
            continue
    return sorted(workers, key=lambda child: child.pid)


def resident(process: Any) -> int:
    """Memory of a process [bytes]; 0 once it has ended."""
    import psutil

    try:
        return process.memory_info().rss
    except psutil.NoSuchProcess:
        return 0


def looked_through(folder: Path, out: Path, seen: int, check: int) -> tuple[int, list[str]]:
    """Number of recorded runs, and what is wrong with them; `seen` records were counted while the study ran."""
    problems = []
    records = _recorded(out)
    if len(records) < seen:
        problems.append(f"{seen} records were seen, {len(records)} are left")
    lost = [run for run, _, outcome, _ in records if outcome is None]
    if lost:
        problems.append(f"{len(lost)} runs have lost their result")
    failed = [run for run, _, outcome, _ in records if outcome not in (None, "completed")]
    if failed:
        problems.append(f"{len(failed)} runs failed")
    damaged = [
        run
        for run, key, _, detail in records
        if detail and checksum(case_path(out, key).read_bytes()) != detail
    ]
    if damaged:
        problems.append(f"{len(damaged)} results do not have their checksum")
    runs = {run for run, *_ in records}
    return len(records), problems + (_computed_again(folder, out, runs, check) if check else [])


def _computed_again(folder: Path, out: Path, done: set[str], check: int) -> list[str]:
    """Compute some of the load histories and parameters in this process, and compare every number."""
    study = open_study(out)
    chosen = random.Random(1).sample(sorted(done), min(check, len(done)))
    cases = study.isel(case=np.isin(study.run.values, chosen))
    problems = []
    for number in range(cases.sizes["case"]):
        stored = cases.isel(case=number)
        alone = content(1)
        alone["loads"] = {"bundled": [stored.loads.item()]}
        alone["models"] = {stored.model.item(): alone["models"][stored.model.item()]}
        alone["variations"]["grid"]["drivetrain.tilt"]["values"] = [
            float(stored["drivetrain.tilt"])
        ]
        with tempfile.TemporaryDirectory(dir=folder) as name:
            run_study(study_of(alone), Path(name) / "out", threads=1)
            computed = open_study(Path(name) / "out").isel(case=0).load()
        same = all(
            np.array_equal(
                stored[variable].sel(roller=computed.roller).values,
                computed[variable].values,
                equal_nan=True,
            )
            for variable in ("energy", "orbit_energy", "peak_power", "end_slip")
        )
        if not same or stored.key.item() != computed.key.item():
            problems.append(f"run {stored.run.item()} differs from what is computed here")
    return problems


def table(outcome: Found, parts: int = 12) -> Iterator[str]:
    """Lines of a table over the time, and what was found wrong."""
    yield f"{'min':>6}{'runs':>9}{'kills':>7}{'scheduler MB':>14}{'study MB':>10}{'largest worker MB':>19}"
    last = outcome.samples[-1].time
    marks = [
        outcome.samples[0],
        *(
            min(outcome.samples, key=lambda s: abs(s.time - last * k / parts))
            for k in range(1, parts + 1)
        ),
    ]
    for sample in marks:
        sizes = [f"{size / 1e6:.1f}" for size in (sample.scheduler, sample.study, sample.worker)]
        yield f"{sample.time / 60:>6.1f}{sample.runs:>9}{sample.kills:>7}{sizes[0]:>14}{sizes[1]:>10}{sizes[2]:>19}"
    yield f"{outcome.recorded} runs recorded, {outcome.kills} workers killed"
    yield from (
        outcome.problems
        or ["every record has its result, every run one record, those computed again agree"]
    )


def growth(samples: list[Sample], name: str) -> float:
    """Growth of the memory of one process from the first to the second half of the time, medians [bytes]."""
    sizes = [getattr(sample, name) for sample in samples]
    half = len(sizes) // 2
    return float(np.median(sizes[half:]) - np.median(sizes[:half]))


def main(arguments: list[str] | None = None) -> None:
    """Soak, print the table, and end with exit code 1 if anything is wrong."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--every", type=float, default=60.0, help="time between kills [s]")
    parser.add_argument(
        "--check", type=int, default=200, help="number of cases computed again in the end"
    )
    parser.add_argument("-o", "--output", type=Path, help="file for all samples, as JSON")
    options = parser.parse_args(arguments)
    with tempfile.TemporaryDirectory() as name:
        outcome = soak(Path(name), 60.0 * options.minutes, options.every, options.check)
        if options.output:
            text = json.dumps(
                {**outcome._asdict(), "samples": [sample._asdict() for sample in outcome.samples]}
            )
            options.output.write_text(text, encoding="utf-8")
        if outcome.problems:
            for log in sorted(Path(name).glob("*.log")):
                sys.stderr.write(f"{log.name}:\n{log.read_text(encoding='utf-8')[-2000:]}\n")
    print("\n".join(table(outcome)) if outcome.samples else "\n".join(outcome.problems))
    sys.exit(bool(outcome.problems))


if __name__ == "__main__":
    os.environ.setdefault("PYTHONUNBUFFERED", "1")
    main()
