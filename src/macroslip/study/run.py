"""A study from its file to a folder of results: runs are handed out, and what comes back is recorded before it is counted."""

from __future__ import annotations

import contextlib
import sqlite3
import time
import uuid
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

import macroslip
from macroslip.bearing.geometry import ROWS
from macroslip.case.case import WHOLE_BEARING
from macroslip.errors import InputError, MacroslipError, safe_text
from macroslip.machine import usable_processors
from macroslip.result.heat_balance import next_temperature
from macroslip.storage.files import LOG, make_folder
from macroslip.study import store
from macroslip.study.reader import open_study
from macroslip.study.settings import RECORDS
from macroslip.study.store import BALANCE_RUNS, CASES, Database, Outcome
from macroslip.study.study_file import Run, Study, read_study
from macroslip.study.work import program
from macroslip.study.workers import (
    Processes,
    ThisProcess,
    Workers,
    dask_workers,
    end_in_worker,
    look_for,
)

#: Failures that are kept to be listed at the end; the log and the summary have all.
_TOLD = 1000
#: Time between lines about progress in the log [s], and time over which the rate is taken [s].
_LOG_EVERY, _SPAN = 60.0, 600.0
#: Rollers of a run for each thread up to which as many runs as threads are computed at once: what
#: comes before and after the rollers uses one thread, and takes as long as some of them.
_FEW_ROLLERS = 4
#: Digits of a temperature [K]: enough, and the same on every machine, so that a resumed study finds
#: its runs again.
_DIGITS = 3
_KEPT = "Nothing that was reported done is lost."


@dataclass
class Progress:
    """Counts of a study under way: runs in all, computed, unchanged because their results were there, and failed."""

    total: int
    computed: int = 0
    unchanged: int = 0
    failed: int = 0
    started: float = field(default_factory=time.monotonic)
    _marks: deque[tuple[float, int]] = field(default_factory=deque)

    def __post_init__(self) -> None:
        self._marks.append((self.started, 0))

    @property
    def done(self) -> int:
        """Runs that need nothing more."""
        return self.computed + self.unchanged + self.failed

    @property
    def seconds(self) -> float:
        """Time since the beginning [s], by a clock that only runs forward."""
        return time.monotonic() - self.started

    @property
    def rate(self) -> float:
        """Runs computed a second, over the last ten minutes.

        Those that were there already tell nothing of the rest.
        """
        now = time.monotonic()
        while len(self._marks) > 1 and now - self._marks[0][0] > _SPAN:
            self._marks.popleft()
        start, count = self._marks[0]
        return (self.computed + self.failed - count) / (now - start) if now > start else 0.0

    @property
    def time_left(self) -> float | None:
        """Time for the rest at that rate [s]; None before the first run is computed."""
        return (self.total - self.done) / self.rate if self.rate > 0.0 else None

    def mark(self) -> None:
        """Remember the present count, at most once a second."""
        now = time.monotonic()
        if now - self._marks[-1][0] >= 1.0:
            self._marks.append((now, self.computed + self.failed))

    @property
    def short(self) -> str:
        """Counts and pace, short enough to stand beside a bar."""
        return f"{self.done} of {self.total}, {self.failed} failed, {self._pace}"

    @property
    def line(self) -> str:
        """Everything in one line."""
        counts = f"{self.computed} computed, {self.unchanged} unchanged, {self.failed} failed"
        return f"{self.done} of {self.total} done ({counts}), {self._pace}"

    @property
    def _pace(self) -> str:
        left = "-" if self.time_left is None else duration(self.time_left)
        return f"{self.rate:.3g} a second, {left if self.done < self.total else 'nothing'} left"


def duration(seconds: float) -> str:
    """Write a time.

    Examples
    --------
    >>> duration(0.4), duration(75), duration(7260), duration(200_000)
    ('1 s', '1 min 15 s', '2 h 1 min', '2 d 7 h')
    """
    rest, parts = max(1, round(seconds)), []
    for name, size in (("d", 86400), ("h", 3600), ("min", 60), ("s", 1)):
        count, rest = divmod(rest, size)
        if count or parts:
            parts.append(f"{count} {name}")
    return " ".join(part for part in parts[:2] if not part.startswith("0 "))


@dataclass
class Ended:
    """How a study ended."""

    progress: Progress  #: Counts and time
    #: Labels, outcome and reason of runs that failed, or whose rollers did: the first thousand,
    #: sorted by loads.
    failures: list[tuple[dict[str, Any], str, str]] = field(default_factory=list)
    stopped: bool = False  #: Whether `strict` stopped it before its end


def run_study(
    study: Study | str | PathLike[str],
    directory: str | PathLike[str],
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    threads: int | None = None,
    resume: bool = False,
    strict: bool = False,
    progress: Callable[[Progress], None] | None = None,
) -> Ended:
    """Compute all runs of a study whose results are not there yet.

    Without `workers` and `scheduler` the runs are computed in this process: one after the other, or
    several at once where a run has few rollers or is of the whole bearing. Results do not depend on
    these arguments.

    Parameters
    ----------
    study : Study or path
        From `read_study` or `study_of`, or the path of a study file.
    directory : path
        Folder for the results: new, empty, or with `resume` the folder of an earlier run of a
        study.
    workers : int, optional
        Worker processes to start on this machine. Each imports the script that calls this function,
        so that the call belongs below `if __name__ == "__main__":`.
    scheduler : str, optional
        Address of a Dask scheduler that runs; its workers have to see `directory` and the load
        files under the same paths, and need the same version of macroslip.
    threads : int, optional
        Threads over the rollers of a case. By default all usable processors, shared between
        `workers`; 1 with `scheduler`.
    resume : bool
        Go on where an earlier run ended. Runs whose input has changed are computed again, others
        never.
    strict : bool
        Stop at the first run that fails, or whose rollers do.
    progress : callable, optional
        Called with the `Progress` after every change.

    Returns
    -------
    Ended
        A run that fails does not raise; it is among `failures`.

    Raises
    ------
    InputError
        If the study, the folder or the address is wrong, or another process is at work in the
        folder.
    MacroslipError
        If results cannot be stored (a full disk), the scheduler is gone, or a worker has another
        version. What was reported done stays done.
    """
    if workers is not None and scheduler is not None:
        remedy = "Give one of them: start workers, or use others."
        raise InputError("workers and scheduler are given together", remedy=remedy)
    if workers is not None:
        end_in_worker()
    if not isinstance(study, Study):
        study = read_study(study)
    directory = Path(directory).absolute()
    store.check_folder(directory, resume=resume)
    if scheduler is not None:
        look_for(scheduler)
    make_folder(directory)
    if study.heat is not None:

        def compute(trial: Study, folder: Path) -> None:
            run_study(
                trial,
                folder,
                workers=workers,
                scheduler=scheduler,
                threads=threads,
                resume=True,
                progress=progress,
            )

        study = study_at_balance(study, directory / BALANCE_RUNS, compute)
    with store.locked(directory):
        store.check_folder(directory, resume=resume)  # again, now that nobody else can begin here
        session = Session(study, directory, progress)
        try:
            with session.opened():
                with session.workers(workers, scheduler, threads) as (found, each):
                    session.go(found, each, strict)
                store.write_summary(
                    directory, {name: units for name, (units, _) in study.labels.items()}
                )
        except (OSError, sqlite3.OperationalError) as error:
            where, why = (
                getattr(error, "filename", None) or directory,
                getattr(error, "strerror", None) or error,
            )
            remedy = f"{_KEPT} Make room, or get the right to write there, and go on with --resume."
            raise MacroslipError(f"{where}: nothing can be stored ({why}). {remedy}") from error
        except sqlite3.DatabaseError as error:
            raise store.damaged_database(directory, error) from None
        return session.ended


class Session:
    """A study under way, from its list of runs to the last result recorded."""

    def __init__(self, study: Study, directory: Path, progress: Callable[[Progress], None] | None):
        self.study, self.directory, self._report = study, directory, progress
        self.ended = Ended(Progress(len(study)))
        self._id = uuid.uuid4().hex
        self._open: dict[str, Run] = {}
        self._waiting: dict[str, list[dict[str, Any]]] = {}
        self._logged = self._progress.started

    @property
    def _progress(self) -> Progress:
        return self.ended.progress

    def note(self, text: str) -> None:
        """Add a line with date and time (UTC) to the log.

        Further lines of the text are indented below it.
        """
        now = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
        first, *others = text.splitlines() or [""]
        lines = [f"{now} {safe_text(first)}", *(f"    {safe_text(other)}" for other in others)]
        # A full disk is reported where results are stored.
        with (
            contextlib.suppress(OSError),
            (self.directory / LOG).open("a", encoding="utf-8") as log,
        ):
            log.write("\n".join(lines) + "\n")

    @contextmanager
    def opened(self) -> Iterator[None]:
        """With the database open for the length of the block; the log records how it ended."""
        study = self.study
        try:
            self.note(
                f"macroslip {macroslip.__version__}, program {program()[:12]}, {len(study)} runs: {study.title}"
            )
            for remark in study.loads.remarks:
                self.note(remark)
            if store.lacks_database(self.directory):
                self.note("the database is not there; all runs are computed again")
            make_folder(self.directory / CASES)
            if left := store.remove_unfinished(self.directory):
                self.note(f"{left} unfinished files of an earlier run removed")
            self._setup = store.write_manifest(self.directory, self._manifest())
            with contextlib.closing(Database(self.directory)) as self.database:
                damaged = self.database.begin((run.name, run.labels) for run in self.study.runs())
                if damaged:
                    self.note(
                        f"{damaged} rows of the database are damaged; their runs are computed again"
                    )
                self.note(f"{self.database.results()} results are there already")
                yield
            how = "stopped at the first failure" if self.ended.stopped else "ended"
            self.note(f"{how}: {self._progress.line}, in {duration(self._progress.seconds)}")
        except BaseException as error:
            self.note(f"broken off after {self._progress.line}: {type(error).__name__}: {error}")
            with contextlib.suppress(OSError):
                store.remove_unfinished(self.directory)
            raise

    def _manifest(self) -> dict[str, Any]:
        study = self.study
        records = {f"{noun}s": getattr(study, f"{noun}s") for noun in RECORDS}
        return {
            "title": study.title,
            "source": f"macroslip {macroslip.__version__}",
            "program": program(),
            "labels": study.labels,
            "setup": {
                "case": study.case, "source": study.loads.source, "cycles": study.cycles, "keep": study.keep,
                **{name: {key: one.as_dict() for key, one in some.items()} for name, some in records.items()},
            },
            "study": study.content,
        }  # fmt: skip

    @contextmanager
    def workers(
        self, workers: int | None, scheduler: str | None, threads: int | None
    ) -> Iterator[tuple[Workers, int | None]]:
        """Who computes, and with how many threads a run."""
        if scheduler is not None:
            self.note(f"runs are computed by {scheduler}")
            with dask_workers(scheduler, self.note) as found:
                yield found, threads or 1
        elif workers is not None:
            self.note(f"runs are computed by {workers} processes of this machine")
            with Processes(min(workers, max(len(self.study), 1)), self.note) as found:
                yield found, threads or max(1, usable_processors() // workers)
        else:
            threads = threads or usable_processors()
            base, _ = self.study.case_of()
            few = (
                base.dynamics == WHOLE_BEARING
                or len(ROWS) * len(base.roller_numbers) <= _FEW_ROLLERS * threads
            )
            runs = min(threads, len(self.study)) if few else 1
            self.note(
                f"runs are computed in this process, {runs} at once with {threads // runs} threads each"
            )
            with ThisProcess(runs) as found:
                yield found, threads // runs

    def go(self, pool: Workers, threads: int | None, strict: bool) -> None:
        """Hand out the runs and record what comes back."""
        runs, again = self.study.mixed_runs(), deque()
        while True:
            tasks = [again.popleft() for _ in range(min(pool.free_places(), len(again)))]
            while len(tasks) < pool.free_places() and (run := next(runs, None)) is not None:
                self._open[run.name] = run
                tasks.append(self._task(run, threads))
            if tasks:
                pool.submit(tasks)
            done = pool.wait()
            if not done and not again:
                if not self._waiting:
                    return
                # Those they wait for have died with their workers.
                for key in list(self._waiting):
                    again.extend(self._released(key))
            entries = []
            for task, result in done:
                self._check(result)
                if result.get("waits"):
                    self._waiting.setdefault(result["key"], []).append(task)
                elif result.get("found") and not self._sound(result):
                    again.append(task | {"again": True})
                else:
                    entries.append((self._open.pop(result["run"]), result))
            failures = self._record(entries)
            for _, result in entries:
                if "key" in result:
                    again.extend(self._released(result["key"]))
            if failures and strict:
                self.ended.stopped = True
                return

    def _released(self, key: str) -> list[dict[str, Any]]:
        """End the claim on a key, whose result is recorded; gives the runs that waited for it."""
        store.claim_path(store.case_path(self.directory, key), self._id).unlink(missing_ok=True)
        return self._waiting.pop(key, [])

    def _task(self, run: Run, threads: int | None) -> dict[str, Any]:
        return {
            "directory": str(self.directory), "setup": self._setup, "session": self._id, "run": run.name,
            "load": self.study.place(run.load), "bearing": run.bearing, "lubricant": run.lubricant,
            "settings": [[setting.key, setting.value, setting.unit] for setting in run.settings],
            "threads": threads, "again": False, "all_rollers": run.is_event,
        }  # fmt: skip

    def _check(self, result: dict[str, Any]) -> None:
        """Stop at what concerns the study and not the run."""
        if "stop" in result:
            raise MacroslipError(f"{result['stop']} {_KEPT} Mend it, and go on with --resume.")
        if result.get("program", program()) != program():
            what = "a worker runs another version of macroslip, or has not registered the same laws of your own."
            raise MacroslipError(f"{what} {_KEPT} Mend it, and go on with --resume.")

    def _sound(self, result: dict[str, Any]) -> bool:
        """Whether a result that a worker found is the result in the database."""
        known = self.database.checksum(result["key"])
        if known == result["detail"]:
            return True
        what = "is damaged" if known else "was not recorded as done"
        self.note(
            f"{self._name(self._open[result['run']])}: a stored result {what}; computed again"
        )
        return False

    def _record(self, entries: list[tuple[Run, dict[str, Any]]]) -> int:
        """Enter finished runs in the database, and only then in log and counts.

        Gives the number of failures.
        """
        changed, told = [], []
        for run, result in entries:
            if "outcome" in result:
                told.extend(self._words(run, result))
            if "outcome" in result or self.database.key(run.name) != result["key"]:
                changed.append(result)
        if changed:
            self.database.record(changed)
        for line in told:
            self.note(line)
        failures = 0
        for run, result in entries:
            outcome = result.get("outcome")
            self._progress.unchanged += outcome is None
            self._progress.computed += outcome == Outcome.COMPLETED
            if outcome in (Outcome.FAILED, Outcome.ROLLERS_FAILED):
                failures += 1
                self._progress.failed += 1
                if len(self.ended.failures) < _TOLD:
                    self.ended.failures.append((run.labels, str(outcome), result["reason"]))
                    self.ended.failures.sort(key=lambda known: known[0]["loads"])
        self._progress.mark()
        if self._progress.started + self._progress.seconds - self._logged >= _LOG_EVERY:
            self._logged = self._progress.started + self._progress.seconds
            self.note(self._progress.line)
        if self._report:
            self._report(self._progress)
        return failures

    def _words(self, run: Run, result: dict[str, Any]) -> Iterator[str]:
        """Lines of the log on what became of a run, before it is in the database."""
        name, outcome, before = self._name(run), result["outcome"], self.database.key(run.name)
        if before is not None and before != result.get("key"):
            yield f"{name}: its input or the program has changed since it was computed"
        elif "detail" in result and self.database.checksum(result["key"]):
            yield f"{name}: its stored result was damaged or gone"
        if outcome == Outcome.COMPLETED:
            values = result["values"]
            seconds = values["simulate_seconds"] + values["other_seconds"]
            yield f"{name}: {outcome} in {seconds:.2f} s, {result['key'][:12]}"
        else:
            why = " ".join(result["reason"].split())
            yield f"{name}: {outcome}: {why}\n{result.get('traceback', '')}".rstrip()

    def _name(self, run: Run) -> str:
        return ", ".join(
            f"{name} {value}" for name, value in run.labels.items() if name not in run.load.fields
        )


def study_at_balance(
    study: Study, directory: Path, compute: Callable[[Study, Path], None]
) -> Study:
    """The study at the temperature at which mean friction power = conductance (T − ambient), of each group of runs.

    Ten minutes of wind do not change the temperature of a bearing whose time constant is hours; the
    mean power Σ w_k P_k of all load histories does, with w_k from `Study.weights`, together 1. All
    are simulated at the surroundings' temperature, 30 K above, and then at the balance found so
    far, three to five times.

    The runs on the way are computed by compute(study, directory) in a folder of their own. Raises
    InputError if there is no balance, and MacroslipError if a run fails, so that the mean is not
    known.
    """
    loads = study.loads.loads
    shares = study.weights.of(loads) if study.weights else [1.0 / len(loads)] * len(loads)
    weights = dict(zip((load.name for load in loads), shares, strict=True))
    cases = {
        run.group: study.case_of(run)[0]
        for run in {run.group: run for run in study.runs()}.values()
    }
    known: dict[str, dict[float, float]] = {group: {} for group in cases}
    while True:
        found = {group: next_temperature(known[group], cases[group]) for group in cases}
        if all(settled for _, settled in found.values()):
            temperatures = {group: round(at, _DIGITS) for group, (at, _) in found.items()}
            return replace(study, heat=None, weights=None, temperatures=temperatures)
        # A group that has settled keeps the nearest temperature that is there already.
        chosen = {
            group: min(known[group], key=lambda place, at=at: abs(place - at)) if settled else at
            for group, (at, settled) in found.items()
        }
        trial = replace(
            study,
            case={**study.case, "rating": False, "traces": "none"},
            keep=[],
            cycles=False,
            heat=None,
            weights=None,
            temperatures={group: round(at, _DIGITS) for group, at in chosen.items()},
        )
        compute(trial, directory)
        for group, power in _mean_powers(trial, directory, weights).items():
            known[group][chosen[group]] = power


def _mean_powers(study: Study, directory: Path, weights: dict[str, float]) -> dict[str, float]:
    found: dict[str, float] = {}
    for run, power in zip(
        study.runs(), open_study(directory).friction_power.values.tolist(), strict=True
    ):
        if not np.isfinite(power):
            raise MacroslipError(
                f"the friction power of the bearing under the loads {run.load.name} is not known, because the run "
                "failed: give the base case a temperature in place of balance"
            )
        found[run.group] = found.get(run.group, 0.0) + weights[run.load.name] * power
    return found
