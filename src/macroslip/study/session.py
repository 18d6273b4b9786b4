"""One session of a study: runs are handed out, and what comes back is recorded before it is counted."""

from __future__ import annotations

import bisect
import uuid
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import macroslip
from macroslip.errors import MacroslipError
from macroslip.files import make_folder
from macroslip.study.journal import Journal
from macroslip.study.key import program
from macroslip.study.log import Log
from macroslip.study.outcome import Outcome
from macroslip.study.progress import Progress, duration
from macroslip.study.settings import RECORDS
from macroslip.study.store import CASES, JOURNAL, LOG, remove_unfinished, write_manifest
from macroslip.study.study import Run, Study
from macroslip.study.tables import Latest, write_runs
from macroslip.study.workers import Workers

#: Failures that are kept to be listed at the end; the log and the summary have all.
_TOLD = 1000
#: Time between lines about progress in the log [s].
_LOG_EVERY = 60.0


@dataclass
class Ended:
    """How a study ended.

    Parameters
    ----------
    progress : Progress
        Counts and time.
    failures : list of (dict, str, str)
        Labels, outcome and reason of runs that failed, or whose rollers did: the first thousand, sorted by loads.
    stopped : bool
        Whether `strict` stopped it before its end.
    """

    progress: Progress
    failures: list[tuple[dict[str, Any], str, str]] = field(default_factory=list)
    stopped: bool = False


class Session:
    """A study under way."""

    _log: Log

    def __init__(self, study: Study, directory: Path, progress: Callable[[Progress], None] | None):
        self.study, self.directory, self._report = study, directory, progress
        self.ended = Ended(Progress(len(study)))
        self._id = uuid.uuid4().hex

    @contextmanager
    def opened(self) -> Iterator[None]:
        """With log and journal open for the length of the block; the log records how it ended."""
        self._log = Log(self.directory / LOG)
        try:
            self._begin()
            yield
            self.note(
                f"{'stopped at the first failure' if self.ended.stopped else 'ended'}: {self._progress.line}, "
                f"in {duration(self._progress.seconds)}"
            )
        except BaseException as error:
            self.note(f"broken off after {self._progress.line}: {type(error).__name__}: {error}")
            raise
        finally:
            if hasattr(self, "_journal"):
                self._journal.close()
            self._log.close()

    @property
    def _progress(self) -> Progress:
        return self.ended.progress

    def note(self, text: str) -> None:
        """Write a line to the log."""
        self._log.write(text)

    def _begin(self) -> None:
        study, directory = self.study, self.directory
        self.note(f"macroslip {macroslip.__version__}, program {program()[:12]}, {len(study)} runs: {study.title}")
        for remark in study.loads.remarks:
            self.note(remark)
        make_folder(directory / CASES)
        left = remove_unfinished(directory)
        if left:
            self.note(f"{left} unfinished files of an earlier run removed")
        self._setup = write_manifest(directory, _manifest(study))
        write_runs(directory, study)
        self._journal = Journal(directory / JOURNAL)
        self._latest = Latest(directory)
        if self._latest.damaged:
            self.note(f"{self._latest.damaged} lines of the journal are damaged; their runs are computed again")
        self.note(f"{len(self._latest.stored)} results are there already")

    def go(self, pool: Workers, threads: int | None, strict: bool) -> None:
        """Hand out the runs and record what comes back."""
        runs, again = self.study.mixed_runs(), deque()
        self._open: dict[str, Run] = {}
        self._logged = self._progress.started
        while True:
            tasks = [again.popleft() for _ in range(min(pool.free_places(), len(again)))]
            while len(tasks) < pool.free_places() and (run := next(runs, None)) is not None:
                self._open[run.name] = run
                tasks.append(self._task(run, threads))
            if tasks:
                pool.submit(tasks)
            done = pool.wait()
            if not done and not again:
                return
            entries = []
            for task, result in done:
                self._check(result)
                if result.get("found") and not self._sound(result):
                    again.append(task | {"again": True})
                else:
                    entries.append((self._open.pop(result["run"]), result))
            if self._record(entries) and strict:
                self.ended.stopped = True
                return

    def _task(self, run: Run, threads: int | None) -> dict[str, Any]:
        name = run.load.name
        return {
            "directory": str(self.directory),
            "setup": self._setup,
            "session": self._id,
            "run": run.name,
            "load": name if self.study.loads.source == "bundled" else str(self.study.folder / name),
            **{noun: getattr(run, noun) for noun in RECORDS},
            "settings": [[setting.key, setting.value, setting.unit] for setting in run.settings],
            "threads": threads,
            "again": False,
        }

    def _check(self, result: dict[str, Any]) -> None:
        """Handle what concerns the study and not the run."""
        if "stop" in result:
            raise MacroslipError(
                f"{result['stop']} Nothing that was reported done is lost. Mend it, and go on with --resume."
            )
        if result.get("program", program()) != program():
            raise MacroslipError(
                "a worker runs another version of macroslip, or has not registered the same laws of your own. "
                "Nothing that was reported done is lost. Mend it, and go on with --resume."
            )

    def _sound(self, result: dict[str, Any]) -> bool:
        """Whether the result that a worker found is the one in the journal."""
        known = self._latest.stored.get(bytes.fromhex(result["key"]))
        if known == bytes.fromhex(result["detail"]):
            return True
        what = "is damaged" if known else "was not recorded as done"
        self.note(f"{self._name(self._open[result['run']])}: a stored result {what}; computed again")
        return False

    def _record(self, entries: list[tuple[Run, dict[str, Any]]]) -> int:
        """Enter what was done in the journal, and only then in the counts; gives the number of failures."""
        lines, counted, failures = [], [], 0
        for run, result in entries:
            unchanged = "outcome" not in result
            if not unchanged:
                self._tell(run, result)
            result = {name: value for name, value in result.items() if name not in ("program", "traceback", "found")}
            if not unchanged or self._latest.keys.get(bytes.fromhex(run.name)) != bytes.fromhex(result["key"]):
                lines.append({"run": result["run"], "key": result["key"]} if unchanged else result)
            counted.append((run, result, unchanged))
        if lines:
            self._journal.append(lines)
        for run, result, unchanged in counted:
            outcome = result.get("outcome")
            if unchanged:
                self._progress.unchanged += 1
            elif outcome == Outcome.COMPLETED:
                self._progress.computed += 1
            else:
                self._progress.failed += 1
                failures += 1
                if len(self.ended.failures) < _TOLD:
                    failure = (run.labels, str(outcome), result["reason"])
                    bisect.insort(self.ended.failures, failure, key=lambda known: known[0]["loads"])
            self._latest.learn(result)
        self._tell_progress()
        return failures

    def _tell(self, run: Run, result: dict[str, Any]) -> None:
        """Write to the log what became of a run."""
        name, outcome = self._name(run), result["outcome"]
        before = self._latest.keys.get(bytes.fromhex(run.name))
        if before is not None and before.hex() != result.get("key"):
            self.note(f"{name}: its input or the program has changed since it was computed")
        elif "detail" in result and bytes.fromhex(result["key"]) in self._latest.stored:
            self.note(f"{name}: its stored result was damaged or gone")
        if outcome == Outcome.COMPLETED:
            values = result["values"]
            seconds = values["simulate_seconds"] + values["other_seconds"]
            self.note(f"{name}: {outcome} in {seconds:.2f} s, {result['key'][:12]}")
        else:
            self.note(
                f"{name}: {outcome}: {' '.join(result['reason'].split())}\n{result.get('traceback', '')}".rstrip()
            )

    def _name(self, run: Run) -> str:
        labels = run.labels
        return ", ".join(f"{name} {value}" for name, value in labels.items() if name not in run.load.fields)

    def _tell_progress(self) -> None:
        progress = self._progress
        progress.mark()
        if progress.started + progress.seconds - self._logged >= _LOG_EVERY:
            self._logged = progress.started + progress.seconds
            self.note(progress.line)
        if self._report:
            self._report(progress)


def _manifest(study: Study) -> dict[str, Any]:
    """Everything about a study that workers and readers need, as plain data."""
    return {
        "title": study.title,
        "source": f"macroslip {macroslip.__version__}",
        "program": program(),
        "labels": {name: list(about) for name, about in study.labels.items()},
        "setup": {
            "case": study.case,
            "source": study.loads.source,
            "bearings": {name: record.as_dict() for name, record in study.bearings.items()},
            "lubricants": {name: record.as_dict() for name, record in study.lubricants.items()},
            "cycles": study.cycles,
            "keep": study.keep,
        },
        "study": study.content,
    }
