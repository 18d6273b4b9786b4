"""Estimate of a study's time and disk space, from a few of its runs."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace
from statistics import fmean

from macroslip.case.case import Case
from macroslip.case.parts import Traces, Window
from macroslip.errors import InputError
from macroslip.study.result_files import to_bytes
from macroslip.study.settings import read_loads
from macroslip.study.study_file import Study
from macroslip.study.summary import COMPONENTS, RANGE_EDGES

#: Runs that are tried for an estimate.
_TRIED = 3
#: Time of each that is simulated [s]; half of it as well, for the slope.
_STRETCH = 60.0
#: A run in database and tables [bytes].
_RECORD_BYTES = 2500
#: Counts of cycles in a result [bytes].
_CYCLES_BYTES = 8 * (len(COMPONENTS) + 1) * RANGE_EDGES.size


@dataclass(frozen=True)
class StudyEstimate:
    """Time and disk of a study; without any run that could be begun the numbers are NaN."""

    runs: int
    looked_at: int  #: Runs that were begun
    simulated_seconds: float  #: Length of a load history, mean of those [s]
    seconds: float  #: Computing time of all runs on one processor [s]
    bytes: float  #: Size on the disk
    problems: tuple[str, ...]  #: Why others could not be begun, and doubts about loads


@dataclass(frozen=True)
class _RunEstimate:
    length: float  #: Length of the loads [s]
    seconds: float
    bytes: float


def estimate_study(study: Study) -> StudyEstimate:
    """Begin a few runs, spread over the study, and scale time and size to all of them.

    Each is simulated for 30 and for 60 s of its loads, with one thread; what grows is scaled to its
    whole length. Loads of other lengths, and parameters that change the work, are not accounted
    for. The first use of the kernels is left out.
    """
    from macroslip.result.plausibility import doubtful_loads

    estimates: list[_RunEstimate] = []
    problems: list[str] = []
    last = len(study) - 1
    chosen = {round(part * last / (_TRIED - 1)) for part in range(_TRIED)}
    for number, run in enumerate(study.runs()):
        if number not in chosen:
            continue
        try:
            case, cut = study.case_of(run)
            loads = read_loads(study.loads.source, study.path_of(run.load), cut)
            case = replace(case, loads=loads)
            doubts = doubtful_loads(loads, case.bearing)
            problems += [f"{loads.source}: doubtful: {doubt}" for doubt in doubts]
            if not estimates:
                _measured(case, 1.0)  # compiles
            estimates.append(_estimate_run(case))
        except InputError as problem:
            problems.append(str(problem))
    runs = len(study)
    others = _RECORD_BYTES
    if study.cycles:
        others += _CYCLES_BYTES
    bytes_of_result = _mean([run.bytes for run in estimates])
    return StudyEstimate(
        runs=runs,
        looked_at=len(estimates),
        simulated_seconds=_mean([run.length for run in estimates]),
        seconds=runs * _mean([run.seconds for run in estimates]),
        bytes=runs * (bytes_of_result + others),
        problems=tuple(problems),
    )


def _mean(values: list[float]) -> float:
    return fmean(values) if values else math.nan


def _estimate_run(case: Case) -> _RunEstimate:
    """Time and size of a whole run, from the first parts of it."""
    loads = case.loads
    end = loads.end
    if case.window.end is not None:
        end = min(case.window.end, end)
    length = end - loads.start
    stretch = min(_STRETCH, length)
    half_seconds, half_bytes = _measured(case, 0.5 * stretch)
    seconds, size = _measured(case, stretch)
    further = (length - stretch) / (0.5 * stretch)
    further_seconds = further * max(seconds - half_seconds, 0.0)
    further_bytes = further * max(size - half_bytes, 0)
    return _RunEstimate(length, seconds + further_seconds, size + further_bytes)


def _measured(case: Case, length: float) -> tuple[float, int]:
    """Time [s] and size [bytes] of the first part of a case."""
    from macroslip.result.rating import with_rating
    from macroslip.result.simulate import simulate

    loads = case.loads
    second_sample = float(loads.time[1])
    end = max(loads.start + length, second_sample)
    end = min(end, loads.end)
    traces = None
    if case.traces:
        traces = Traces(step=case.traces.step)
    part = replace(case, loads=loads.window(None, end), window=Window(), traces=traces)
    started = time.perf_counter()
    result = with_rating(simulate(part, threads=1), part)
    seconds = time.perf_counter() - started
    return seconds, len(to_bytes(result))
