"""A study from its file to a folder of results.

Runs are handed out, and what comes back is recorded before it is counted.
"""

from __future__ import annotations

import contextlib
import itertools
import sqlite3
import time
import uuid
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from os import PathLike
from pathlib import Path
from typing import Any

import macroslip
from macroslip.case.case import WHOLE_BEARING
from macroslip.errors import InputError, MacroslipError, safe_text
from macroslip.machine import usable_processors
from macroslip.storage.files import LOG, make_folder
from macroslip.study import store
from macroslip.study.balance import study_at_balance
from macroslip.study.database import Database, Outcome, damaged_database, write_summary
from macroslip.study.progress import Progress, duration
from macroslip.study.result_files import CASES, case_path, claim_path
from macroslip.study.settings import RECORDS
from macroslip.study.store import BALANCE_RUNS
from macroslip.study.study_file import Run, Study, read_study
from macroslip.study.work import program
from macroslip.study.workers import (
    Done,
    Processes,
    ThisProcess,
    Workers,
    dask_workers,
    end_in_worker,
    look_for,
)

#: Failures that are kept to be listed at the end; the log and the summary have all.
_TOLD = 1000
#: Time between lines about progress in the log [s].
_LOG_EVERY = 60.0
#: Rollers of a run for each thread up to which as many runs as threads are computed at once: what
#: comes before and after the rollers uses one thread, and takes as long as some of them.
_FEW_ROLLERS = 4
_KEPT = "Nothing that was reported done is lost."


@dataclass
class Ended:
    """Outcome of a study: counts, time, and why it stopped."""

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
        compute = partial(
            run_study,
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
                with session.workers(workers, scheduler, threads) as (pool, each):
                    session.go(pool, each, strict)
                units = {name: unit for name, (unit, _) in study.labels.items()}
                write_summary(directory, units)
        except (OSError, sqlite3.OperationalError) as error:
            where = getattr(error, "filename", None) or directory
            why = getattr(error, "strerror", None) or error
            remedy = f"{_KEPT} Make room, or get the right to write there, and go on with --resume."
            raise MacroslipError(f"{where}: nothing can be stored ({why}). {remedy}") from error
        except sqlite3.DatabaseError as error:
            raise damaged_database(directory, error) from None
        return session.ended


class Session:
    """A study under way, from its list of runs to the last result recorded."""

    def __init__(self, study: Study, directory: Path, progress: Callable[[Progress], None] | None):
        self.study = study
        self.directory = directory
        self.ended = Ended(Progress(len(study)))
        self._report = progress
        self._id = uuid.uuid4().hex
        self._runs = study.mixed_runs()
        #: Runs under way, by name
        self._open: dict[str, Run] = {}
        #: Tasks that are to be handed out again
        self._again: deque[dict[str, Any]] = deque()
        #: Tasks that wait for another run of the same key, by key
        self._waiting: dict[str, list[dict[str, Any]]] = {}
        #: When the counts were last written to the log, by `Progress.seconds` [s]
        self._logged = 0.0

    @property
    def _progress(self) -> Progress:
        return self.ended.progress

    def note(self, text: str) -> None:
        """Add a line with date and time (UTC) to the log.

        Further lines of the text are indented below it.
        """
        now = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
        first, *others = text.splitlines() or [""]
        lines = [f"{now} {safe_text(first)}"]
        lines += [f"    {safe_text(other)}" for other in others]
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
            version = f"macroslip {macroslip.__version__}, program {program()[:12]}"
            self.note(f"{version}, {len(study)} runs: {study.title}")
            for remark in study.loads.remarks:
                self.note(remark)
            if store.lacks_database(self.directory):
                self.note("the database is not there; all runs are computed again")
            make_folder(self.directory / CASES)
            if left := store.remove_unfinished(self.directory):
                self.note(f"{left} unfinished files of an earlier run removed")
            self._setup = store.write_manifest(self.directory, self._manifest())
            with contextlib.closing(Database(self.directory)) as self.database:
                names_and_labels = ((run.name, run.labels) for run in study.runs())
                damaged = self.database.begin(names_and_labels)
                if damaged:
                    fault = f"{damaged} rows of the database are damaged"
                    self.note(f"{fault}; their runs are computed again")
                self.note(f"{self.database.results()} results are there already")
                yield
            how = "stopped at the first failure" if self.ended.stopped else "ended"
            lasted = duration(self._progress.seconds)
            self.note(f"{how}: {self._progress.line}, in {lasted}")
        except BaseException as error:
            kind = type(error).__name__
            self.note(f"broken off after {self._progress.line}: {kind}: {error}")
            with contextlib.suppress(OSError):
                store.remove_unfinished(self.directory)
            raise

    def _manifest(self) -> dict[str, Any]:
        study = self.study
        setup = {
            "case": study.case,
            "source": study.loads.source,
            "cycles": study.cycles,
            "keep": study.keep,
        }
        for noun in RECORDS:
            records = getattr(study, f"{noun}s")
            setup[f"{noun}s"] = {name: record.as_dict() for name, record in records.items()}
        return {
            "title": study.title,
            "source": f"macroslip {macroslip.__version__}",
            "program": program(),
            "labels": study.labels,
            "setup": setup,
            "study": study.content,
        }

    @contextmanager
    def workers(
        self, workers: int | None, scheduler: str | None, threads: int | None
    ) -> Iterator[tuple[Workers, int | None]]:
        """Executor of the runs, and number of threads of one."""
        if scheduler is not None:
            self.note(f"runs are computed by {scheduler}")
            with dask_workers(scheduler, self.note) as pool:
                yield pool, threads or 1
        elif workers is not None:
            self.note(f"runs are computed by {workers} processes of this machine")
            with Processes(min(workers, len(self.study)), self.note) as pool:
                each = threads or max(1, usable_processors() // workers)
                yield pool, each
        else:
            threads = threads or usable_processors()
            base, _ = self.study.case_of()
            rollers = base.bearing.rows * len(base.roller_numbers)
            is_whole = base.dynamics == WHOLE_BEARING
            is_small = is_whole or rollers <= _FEW_ROLLERS * threads
            runs = 1
            if is_small:
                runs = min(threads, len(self.study))
            each = threads // runs
            self.note(f"runs are computed in this process, {runs} at once with {each} threads each")
            with ThisProcess(runs) as pool:
                yield pool, each

    def go(self, pool: Workers, threads: int | None, strict: bool) -> None:
        """Submit the runs and record their outcomes."""
        while True:
            tasks = self._tasks(pool.free_places(), threads)
            if tasks:
                pool.submit(tasks)
            done = pool.wait()
            if not done and not self._again:
                if not self._waiting:
                    return
                # Those they wait for have died with their workers.
                for key in list(self._waiting):
                    self._release(key)
            failures = self._record(self._sorted(done))
            if failures and strict:
                self.ended.stopped = True
                return

    def _tasks(self, count: int, threads: int | None) -> list[dict[str, Any]]:
        """At most so many tasks, first those that are to be handed out again."""
        repeated = min(count, len(self._again))
        tasks = [self._again.popleft() for _ in range(repeated)]
        missing = count - len(tasks)
        for run in itertools.islice(self._runs, missing):
            self._open[run.name] = run
            tasks.append(self._task(run, threads))
        return tasks

    def _task(self, run: Run, threads: int | None) -> dict[str, Any]:
        return {
            "directory": str(self.directory),
            "setup": self._setup,
            "session": self._id,
            "run": run.name,
            "load": self.study.path_of(run.load),
            "bearing": run.bearing,
            "lubricant": run.lubricant,
            "settings": [[setting.key, setting.value, setting.unit] for setting in run.settings],
            "threads": threads,
            "again": False,
            "all_rollers": run.is_event,
        }

    def _sorted(self, done: Done) -> list[tuple[Run, dict[str, Any]]]:
        """Runs that have ended; the others wait, or are handed out again."""
        entries = []
        for task, result in done:
            self._check(result)
            if result.get("waits"):
                self._waiting.setdefault(result["key"], []).append(task)
            elif result.get("found") and not self._is_recorded(result):
                self._again.append(task | {"again": True})
            else:
                run = self._open.pop(result["run"])
                entries.append((run, result))
        return entries

    def _release(self, key: str) -> None:
        """End the claim on a key, and hand out the runs that waited for it."""
        claim = claim_path(case_path(self.directory, key), self._id)
        claim.unlink(missing_ok=True)
        self._again.extend(self._waiting.pop(key, []))

    def _check(self, result: dict[str, Any]) -> None:
        """Stop at a failure that concerns the study and not one run."""
        if "stop" in result:
            raise MacroslipError(f"{result['stop']} {_KEPT} Mend it, and go on with --resume.")
        if result.get("program", program()) != program():
            fault = "a worker runs another version of macroslip"
            fault += ", or has not registered the same laws of your own."
            raise MacroslipError(f"{fault} {_KEPT} Mend it, and go on with --resume.")

    def _is_recorded(self, result: dict[str, Any]) -> bool:
        """True if a result that a worker found is the result in the database."""
        known = self.database.checksum(result["key"])
        if known == result["detail"]:
            return True
        run = self._open[result["run"]]
        name = self._name(run)
        state = "is damaged" if known else "was not recorded as done"
        self.note(f"{name}: a stored result {state}; computed again")
        return False

    def _record(self, entries: list[tuple[Run, dict[str, Any]]]) -> int:
        """Enter finished runs in the database, and only then in log and counts.

        Gives the number of failures.
        """
        changed = []
        lines: list[str] = []
        for run, result in entries:
            if "outcome" in result:
                lines += self._words(run, result)
            if "outcome" in result or self.database.key(run.name) != result["key"]:
                changed.append(result)
        if changed:
            self.database.record(changed)
        for line in lines:
            self.note(line)
        for _, result in entries:
            if "key" in result:
                self._release(result["key"])
        failures = 0
        for run, result in entries:
            failures += self._count(run, result)
        since_logged = self._progress.seconds - self._logged
        if since_logged >= _LOG_EVERY:
            self._logged = self._progress.seconds
            self.note(self._progress.line)
        if self._report:
            self._report(self._progress)
        return failures

    def _count(self, run: Run, result: dict[str, Any]) -> bool:
        """Count a run that has ended; true if it has failed."""
        outcome = result.get("outcome")
        if outcome is None:
            self._progress.unchanged += 1
        elif outcome == Outcome.COMPLETED:
            self._progress.computed += 1
        else:
            self._progress.failed += 1
            if len(self.ended.failures) < _TOLD:
                failure = (run.labels, str(outcome), result["reason"])
                self.ended.failures.append(failure)
                self.ended.failures.sort(key=lambda failure: failure[0]["loads"])
            return True
        return False

    def _words(self, run: Run, result: dict[str, Any]) -> Iterator[str]:
        """Lines of the log on the outcome of a run, before it is in the database."""
        name = self._name(run)
        outcome = result["outcome"]
        before = self.database.key(run.name)
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
            trace = result.get("traceback", "")
            yield f"{name}: {outcome}: {why}\n{trace}".rstrip()

    def _name(self, run: Run) -> str:
        return ", ".join(
            f"{name} {value}" for name, value in run.labels.items() if name not in run.load.fields
        )
