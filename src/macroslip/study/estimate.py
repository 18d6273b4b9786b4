"""Time and disk of a study, from a few runs that are begun here."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from macroslip.case.parts import Traces, Window
from macroslip.errors import InputError
from macroslip.study.build import read_loads, template
from macroslip.study.cycles import COMPONENTS, RANGE_EDGES
from macroslip.study.store import to_bytes
from macroslip.study.study import Run, Study

if TYPE_CHECKING:
    from macroslip.case.case import Case

#: Runs that are tried, and the time of each that is simulated [s]; half of it as well, for the slope.
_LOOKED_AT = 3
_STRETCH = 60.0
#: A line of the journal and of the tables [bytes].
_RECORD_BYTES = 2500
#: Counts of both components in a result, and their classes [bytes].
_CYCLES_BYTES = 8 * (len(COMPONENTS) + 1) * RANGE_EDGES.size


@dataclass(frozen=True)
class StudyEstimate:
    """Time and disk of a study.

    Parameters
    ----------
    runs : int
    looked_at : int
        Runs that it is based on; 0: none could be begun, and the rest is NaN.
    simulated_seconds : float
        Length of one load history, mean of those [s].
    seconds : float
        Computing time of all runs on one processor [s].
    bytes : float
        On the disk [bytes].
    problems : tuple of str
        Why others of those could not be begun.
    """

    runs: int
    looked_at: int
    simulated_seconds: float
    seconds: float
    bytes: float
    problems: tuple[str, ...]


def estimate_study(study: Study) -> StudyEstimate:
    """Begin a few runs, spread over the study, and scale time and size to all of them.

    Each is simulated for 30 and for 60 s of its loads, with one thread; what grows is scaled to its whole length. Loads
    of other lengths, and parameters that change the work, are not accounted for. The first use of the kernels is left out.

    Parameters
    ----------
    study : Study

    Returns
    -------
    StudyEstimate
    """
    lengths, seconds, sizes, problems = [], [], [], []
    chosen = sorted({round(part * (len(study) - 1) / max(_LOOKED_AT - 1, 1)) for part in range(_LOOKED_AT)})
    for number, run in enumerate(study.runs()):
        if number > chosen[-1]:
            break
        if number not in chosen:
            continue
        try:
            case = _case(study, run)
            if not lengths:
                _measured(case, 1.0)  # compiles
            first, last = float(case.loads.time[0]), float(case.loads.time[-1])
            length = last - first if case.window.end is None else case.window.end - first
            stretch = min(_STRETCH, length)
            (short_time, short_size), (time_taken, size) = _measured(case, 0.5 * stretch), _measured(case, stretch)
        except InputError as problem:
            problems.append(str(problem))
            continue
        more = (length - stretch) / (0.5 * stretch)
        lengths.append(length)
        seconds.append(time_taken + more * max(time_taken - short_time, 0.0))
        sizes.append(size + more * max(size - short_size, 0))

    def mean(values: list[float]) -> float:
        return sum(values) / len(values) if values else float("nan")

    runs, others = len(study), _RECORD_BYTES + (_CYCLES_BYTES if study.cycles else 0)
    return StudyEstimate(
        runs, len(lengths), mean(lengths), runs * mean(seconds), runs * (mean(sizes) + others), tuple(problems)
    )


def _case(study: Study, run: Run) -> Case:
    records = {"bearing": study.bearings[run.bearing], "lubricant": study.lubricants[run.lubricant]}
    case, cut = template(study.case, list(run.settings), records, keep=study.keep, folder=study.folder)
    bundled = study.loads.source == "bundled"
    path = run.load.name if bundled else str(study.folder / run.load.name)
    return replace(case, loads=read_loads(study.loads.source, path, cut))


def _measured(case: Case, length: float) -> tuple[float, int]:
    """Time [s] and size [bytes] of the first part of a case."""
    from macroslip.result.rating import with_rating
    from macroslip.result.simulate import simulate

    first, last = float(case.loads.time[0]), float(case.loads.time[-1])
    # At least two samples.
    end = min(max(first + length, float(case.loads.time[1])), last)
    traces = Traces(step=case.traces.step) if case.traces else None
    part = replace(case, loads=case.loads.window(None, end), window=Window(), traces=traces)
    started = time.perf_counter()
    result = with_rating(simulate(part, threads=1), part)
    return time.perf_counter() - started, len(to_bytes(result))
