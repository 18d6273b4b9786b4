"""A study from its file to a folder of results, in this process, in several, or on a cluster."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager, closing, nullcontext
from os import PathLike
from pathlib import Path

from macroslip.bearing.geometry import ROWS
from macroslip.case.case import WHOLE_BEARING
from macroslip.errors import InputError, MacroslipError
from macroslip.files import make_folder
from macroslip.machine import usable_processors
from macroslip.study.balance import study_at_balance
from macroslip.study.build import template
from macroslip.study.cluster import check_installed, cluster, look_for, threads_of_worker
from macroslip.study.lock import locked
from macroslip.study.progress import Progress
from macroslip.study.session import Ended, Session
from macroslip.study.settings import RECORDS
from macroslip.study.store import BALANCE_RUNS, check_folder
from macroslip.study.study import Study
from macroslip.study.study_file import read_study
from macroslip.study.tables import write_summary
from macroslip.study.workers import ThisProcess, ThreadsHere, Workers


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

    Without `workers` and `scheduler` the runs are computed in this process: one after the other, or several at once
    where a run has few rollers or is of the whole bearing. What is computed and stored does not depend on these arguments.

    Parameters
    ----------
    study : Study or path
        From `read_study` or `study_of`, or the path of a study file.
    directory : path
        Folder for the results: new, empty, or that of an earlier run of a study with `resume`.
    workers : int, optional
        Worker processes to start on this machine.
    scheduler : str, optional
        Address of a Dask scheduler that runs; its workers have to see `directory` and the load files under the same
        paths, and need the same version of macroslip.
    threads : int, optional
        Threads over the rollers of a case. By default all usable processors, shared between `workers`; 1 with
        `scheduler`.
    resume : bool
        Go on where an earlier run ended. Runs whose input has changed are computed again, others never.
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
        If the study, the folder or the address is wrong, or another process is at work in the folder.
    MacroslipError
        If results cannot be stored (a full disk), the scheduler is gone, or a worker has another version. What was
        reported done stays done.
    """
    if workers is not None and scheduler is not None:
        raise InputError(
            "workers and scheduler are given together", remedy="Give one of them: start workers, or use others."
        )
    if workers is not None or scheduler is not None:
        check_installed()
    if not isinstance(study, Study):
        study = read_study(study)
    directory = Path(directory).absolute()
    check_folder(directory, resume=resume)
    if scheduler is not None:
        look_for(scheduler)
    make_folder(directory)
    if study.heat is not None:

        def compute(trial: Study, folder: Path) -> None:
            run_study(
                trial, folder, workers=workers, scheduler=scheduler, threads=threads, resume=True, progress=progress
            )

        study = study_at_balance(study, directory / BALANCE_RUNS, compute)
    with locked(directory):
        check_folder(directory, resume=resume)  # again, now that nobody else can begin here
        try:
            session = Session(study, directory, progress)
            if workers is not None or scheduler is not None:
                threads = threads_of_worker(workers) if threads is None else threads
                pool = cluster(workers, scheduler, session.note)
                note = f"runs are computed by {scheduler or f'{workers} workers on this machine'}"
            else:
                runs, threads = _shared_out(study, threads or usable_processors())
                pool = _here(runs)
                note = f"runs are computed in this process, {runs} at once with {threads} threads each"
            with session.opened(), pool as found:
                session.note(note)
                session.go(found, threads, strict)
                write_summary(directory, study)
            return session.ended
        except OSError as error:
            raise _cannot_store(error, directory) from error


#: Rollers of a run for each thread up to which as many runs as threads are computed at once: what comes before and after
#: the rollers uses one thread, and takes as long as some of them.
_FEW_ROLLERS = 4


def _shared_out(study: Study, threads: int) -> tuple[int, int]:
    """How many runs to compute at once in this process, and the threads of each: the rollers of a whole bearing use one."""
    records = {noun: next(iter(getattr(study, f"{noun}s").values())) for noun in RECORDS}
    base, _ = template(study.case, [], records, folder=study.folder)
    rollers = len(ROWS) * len(base.roller_numbers)
    if base.dynamics == WHOLE_BEARING or rollers <= _FEW_ROLLERS * threads:
        runs = min(threads, len(study))
        return runs, threads // runs
    return 1, threads


def _here(runs: int) -> AbstractContextManager[Workers]:
    return nullcontext(ThisProcess()) if runs == 1 else closing(ThreadsHere(runs))


def _cannot_store(error: OSError, directory: Path) -> MacroslipError:
    return MacroslipError(
        f"{error.filename or directory}: nothing can be stored ({error.strerror or error}). "
        "Nothing that was reported done is lost. Make room, or get the right to write there, and go on with --resume."
    )
