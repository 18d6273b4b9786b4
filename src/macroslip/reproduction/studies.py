"""The studies of the reproduction: their files beside this module, computed as any study is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from macroslip.case.case import Case
from macroslip.errors import MacroslipError
from macroslip.loads import HubLoads
from macroslip.study.build import template
from macroslip.study.outcome import Outcome
from macroslip.study.progress import Progress
from macroslip.study.run import run_study
from macroslip.study.study import Study
from macroslip.study.study_file import read_study

#: Folder of the study files, beside this module, and of their results.
FOLDER = "studies"


def reproduction_study(name: str) -> Study:
    """Study of the reproduction.

    Parameters
    ----------
    name : str
        `study`, `detail`, `sensitivity` or `uncertainty`, with an underscore and the name of a model.

    Examples
    --------
    >>> len(reproduction_study("study_paper"))
    21
    """
    return read_study(Path(__file__).parent / FOLDER / f"{name}.yaml")


def base_case(study: Study) -> Case:
    """The base case of a study, under its first load history."""
    records = {"bearing": next(iter(study.bearings.values())), "lubricant": next(iter(study.lubricants.values()))}
    case, cut = template(study.case, [], records)
    return replace(case, loads=HubLoads.bundled(study.loads.loads[0].name).window(cut.get("start"), cut.get("end")))


def computed(
    study: Study,
    directory: Path,
    *,
    may_fail: bool = False,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> bool:
    """Compute what is missing of a study.

    Parameters
    ----------
    study : Study
    directory : Path
        Folder of its results, new or of an earlier run.
    may_fail : bool
        Whether a run that is refused is a result like others.
    threads : int, optional
        Number of threads; that of usable processors by default.
    progress : callable, optional
        Called as progress(done, total) after each run.

    Returns
    -------
    bool
        Whether anything was computed.

    Raises
    ------
    MacroslipError
        If a run failed, unless it may.
    """

    def report(now: Progress) -> None:
        if progress:
            progress(now.done, now.total)

    ended = run_study(study, directory, threads=threads, resume=True, progress=report)
    lost = [(labels["loads"], reason) for labels, outcome, reason in ended.failures if outcome == Outcome.FAILED]
    if lost and not may_fail:
        raise MacroslipError(f"{len(lost)} cases of '{study.title}' failed, case {lost[0][0]} first: {lost[0][1]}")
    return ended.progress.computed > 0 or len(ended.failures) > len(lost)
