"""Speed against real time, and how cost grows with duration, rollers, cases and threads."""

from __future__ import annotations

import hashlib
import statistics
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np

from benchmarks import own
from benchmarks.histories import History, histories_of
from benchmarks.outcome import errors
from benchmarks.scan import timed
from macroslip.case.case import Case
from macroslip.loads import HubLoads
from macroslip.machine import usable_processors
from macroslip.result.simulate import simulate

_REPEATS = 3
_CASE = "14B"
#: Rounds of hashing in one piece of work: some ten milliseconds.
_HASHES = 100_000


def cpu_seconds(histories: list[History], tolerance: float, *, details: bool = False) -> float:
    """Least CPU time of integrating and measuring some histories one after the other [s]."""

    def run() -> None:
        for history in histories:
            own.integrate(history, tolerance, np.empty(0), details=details)

    return min(timed(run)[1] for _ in range(_REPEATS))


def real_time(
    histories: list[History], tolerance: float, report: Callable[[int, int], None]
) -> dict[str, Any]:
    """Simulated over CPU time for one roller on one core, and the errors at that tolerance.

    Returns
    -------
    dict
        `factor` (all time over all time), `slowest`, `median` and `fastest` history; `slowest_detailed`, where contacts are
        looked at station by station, NaN where nothing varies over them; `cpu_seconds` of all; `largest_energy_error`,
        `largest_spin_error`; `histories`, each with its factors and errors.
    """
    by_history, simulated, spent = {}, 0.0, 0.0
    for number, history in enumerate(histories):
        report(number, len(histories))
        seconds = cpu_seconds([history], tolerance)
        curved = history.model.curved
        detailed = cpu_seconds([history], tolerance, details=True) if curved else float("nan")
        energy, spin = errors(own.solve(history, tolerance), own.reference(history))
        by_history[history.name] = {
            "factor": (history.end - history.start) / seconds,
            "factor_detailed": (history.end - history.start) / detailed,
            "energy_error": energy,
            "spin_error": spin,
            "cpu_seconds": seconds,
        }
        simulated, spent = simulated + history.end - history.start, spent + seconds
    factors = [numbers["factor"] for numbers in by_history.values()]
    return {
        "factor": simulated / spent,
        "slowest": min(factors),
        "median": statistics.median(factors),
        "slowest_detailed": min(numbers["factor_detailed"] for numbers in by_history.values()),
        "fastest": max(factors),
        "cpu_seconds": spent,
        "largest_energy_error": max(numbers["energy_error"] for numbers in by_history.values()),
        "largest_spin_error": max(numbers["spin_error"] for numbers in by_history.values()),
        "histories": by_history,
    }


def two_threads(*, quick: bool) -> dict[str, float] | None:
    """Wall time of one case with all its rollers on one thread over that on two; None with a single processor.

    Returns
    -------
    dict
        `simulate`: of the whole call, with its serial preparation; `rollers`: of the integration of the rollers alone;
        `hashing`: of work that has nothing to do with rollers and shows what two processors were worth at that moment;
        and the wall times behind them [s]. Each is the least of several, taken in turn.
    """
    if usable_processors() < 2:
        return None
    end = 200.0 if quick else None
    case = Case(loads=HubLoads.bundled(_CASE).window(None, end))
    rollers = histories_of(_CASE, None, end, case.roller_numbers)

    def alone(threads: int) -> None:
        with ThreadPoolExecutor(threads) as pool:
            list(
                pool.map(
                    lambda history: own.integrate(history, case.integrator.tolerance, np.empty(0)),
                    rollers,
                )
            )

    def hashing(threads: int) -> None:
        with ThreadPoolExecutor(threads) as pool:
            list(
                pool.map(
                    lambda _: hashlib.pbkdf2_hmac("sha256", b"macroslip", b"bench", _HASHES),
                    range(8),
                )
            )

    runs = {
        "simulate": lambda threads: simulate(case, threads=threads),
        "rollers": alone,
        "hashing": hashing,
    }
    walls = {name: {1: [], 2: []} for name in runs}
    simulate(case, threads=2)
    for _ in range(_REPEATS):
        for threads in (1, 2):
            for name, run in runs.items():
                start = time.perf_counter()
                run(threads)
                walls[name][threads].append(time.perf_counter() - start)
    least = {
        name: {threads: min(times) for threads, times in by.items()} for name, by in walls.items()
    }
    return {
        **{name: by[1] / by[2] for name, by in least.items()},
        **{
            f"{name}_{threads}_thread_s": by[threads]
            for name, by in least.items()
            for threads in (1, 2)
        },
    }


def linearity(histories: list[History], tolerance: float, *, quick: bool) -> dict[str, Any]:
    """CPU time against duration, number of rollers and number of cases, with the exponents of fitted power laws.

    Parameters
    ----------
    histories : list of History
        Of many cases, one roller of each row of a case after the other.
    tolerance : float
    quick : bool
        Shorter stretches.

    Returns
    -------
    dict
        Per kind `size`, `cpu_seconds` and `exponent`; 1 is linear growth, NaN with less than three sizes.
    """
    durations = [50.0, 100.0, 200.0] if quick else [70.0, 140.0, 280.0, 560.0]
    by_duration = [
        cpu_seconds(histories_of(_CASE, None, duration, [0]), tolerance) for duration in durations
    ]
    rollers = histories_of(_CASE, None, durations[0], range(28))
    numbers = [7, 14, 28, 56]
    by_roller = [cpu_seconds(rollers[:: len(rollers) // number], tolerance) for number in numbers]
    # Cases differ; in no order of wind speed, a part of them costs like the whole.
    pairs = [histories[k : k + 2] for k in range(0, len(histories), 2)]
    shuffled = [
        history for k in np.random.default_rng(1).permutation(len(pairs)) for history in pairs[k]
    ]
    counts = sorted({max(1, len(pairs) * part // 4) for part in (1, 2, 3, 4)})
    by_case = [cpu_seconds(shuffled[: 2 * count], tolerance) for count in counts]
    return {
        "duration": _growth(durations, by_duration),
        "rollers": _growth([float(number) for number in numbers], by_roller),
        "cases": _growth([float(count) for count in counts], by_case),
    }


def _growth(sizes: list[float], seconds: list[float]) -> dict[str, Any]:
    exponent = (
        float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0]) if len(sizes) > 2 else float("nan")
    )
    return {"size": sizes, "cpu_seconds": seconds, "exponent": exponent}
