"""A study from its file to a folder of results, in this process, in several, or on a cluster."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from os import PathLike
from pathlib import Path

from macroslip.errors import InputError, MacroslipError
from macroslip.files import make_folder
from macroslip.result.simulate import usable_processors
from macroslip.study.cluster import check_installed, cluster, look_for, threads_of_worker
from macroslip.study.cycles import check_installed as check_fatpack
from macroslip.study.lock import locked
from macroslip.study.progress import Progress
from macroslip.study.session import Ended, Session
from macroslip.study.store import check_folder
from macroslip.study.study import Study
from macroslip.study.study_file import read_study
from macroslip.study.tables import write_summary
from macroslip.study.workers import ThisProcess, Workers


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

    Without `workers` and `scheduler` the runs are computed in this process, one after the other. What is computed and
    stored does not depend on these arguments.

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
    if study.cycles:
        check_fatpack()
    directory = Path(directory).absolute()
    check_folder(directory, resume=resume)
    if scheduler is not None:
        look_for(scheduler)
    make_folder(directory)
    with locked(directory):
        check_folder(directory, resume=resume)  # again, now that nobody else can begin here
        try:
            session = Session(study, directory, progress)
            with session.opened(), _workers(workers, scheduler, session.note) as pool:
                if threads is None and not isinstance(pool, ThisProcess):
                    threads = threads_of_worker(workers)
                session.go(pool, threads, strict)
                write_summary(directory, study)
            return session.ended
        except OSError as error:
            raise _cannot_store(error, directory) from error


@contextmanager
def _workers(workers: int | None, scheduler: str | None, note: Callable[[str], None]) -> Iterator[Workers]:
    if workers is None and scheduler is None:
        note(f"runs are computed in this process, which may use {usable_processors()} processors")
        yield ThisProcess()
        return
    with cluster(workers, scheduler, note) as pool:
        note(f"runs are computed by {scheduler or f'{workers} workers on this machine'}")
        yield pool


def _cannot_store(error: OSError, directory: Path) -> MacroslipError:
    return MacroslipError(
        f"{error.filename or directory}: nothing can be stored ({error.strerror or error}). "
        "Nothing that was reported done is lost. Make room, or get the right to write there, and go on with --resume."
    )
