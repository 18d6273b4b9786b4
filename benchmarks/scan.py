"""How a method's setting is found on a history: many are tried, the cheapest that is accurate enough is timed again."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable, Iterable

from benchmarks.outcome import ASKED, Measurement, Reference, Setting, Solution, cheapest, errors

#: How often a run is timed again: until it has been timed so often, or for so long [s].
_REPEATS, _REPEAT_SECONDS = 20, 0.3
#: How many times the budget the search may take while nothing accurate is found.
_STUBBORN = 3.0


def timed(run: Callable[[], Solution]) -> tuple[Solution, float]:
    """What `run` returns and the CPU time of this process that it took [s], without garbage collection."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        start = time.process_time()
        solution = run()
        return solution, time.process_time() - start
    finally:
        if enabled:
            gc.enable()


def measure(
    solve: Callable[..., Solution], setting: Setting, reference: Reference, **limit: float
) -> Measurement:
    """Run `solve(**setting, **limit)` once and compare with the reference."""
    solution, seconds = timed(lambda: solve(**setting, **limit))
    return Measurement(setting, *errors(solution, reference), seconds, solution.evaluations)


def timed_again(solve: Callable[..., Solution], outcome: Measurement) -> Measurement:
    """The outcome with the shortest of several times."""
    seconds, spent = outcome.seconds, outcome.seconds
    for _ in range(_REPEATS - 1):
        if spent > _REPEAT_SECONDS:
            break
        _, again = timed(lambda: solve(**outcome.setting))
        seconds, spent = min(seconds, again), spent + again
    return outcome._replace(seconds=seconds)


def scan(
    solve: Callable[..., Solution],
    settings: Iterable[Setting],
    reference: Reference,
    *,
    budget: float,
    prune: bool,
) -> list[Measurement]:
    """Try settings on one history; the cheapest accurate one, or else the most accurate one, is timed again.

    Parameters
    ----------
    solve : callable
        `solve(**setting)`; the run that fails returns NaN.
    settings : iterable of mapping
        In the order in which they are tried, loose ones first.
    reference : Reference
    budget : float
        CPU time after which no further setting is tried [s]; three times as much as long as none was accurate.
    prune : bool
        Whether to leave out what is certainly dearer than a setting already found accurate: the same but for a tighter
        `atol`; and to stop runs that need more force evaluations than the cheapest accurate one, which `solve` must
        then take as `most_evaluations`.

    Returns
    -------
    list of Measurement
        The one that counts first.
    """
    tried: list[Measurement] = []
    hits: list[Setting] = []
    most, spent = float("inf"), 0.0
    for setting in settings:
        if spent > (budget if hits else _STUBBORN * budget):
            break
        if prune and any(_only_tighter(setting, hit) for hit in hits):
            continue
        limit = {"most_evaluations": most} if prune else {}
        outcome = measure(solve, setting, reference, **limit)
        spent += outcome.seconds
        tried.append(outcome)
        if outcome.error <= ASKED:
            hits.append(setting)
            most = min(most, outcome.evaluations)
    best, _ = cheapest(tried)
    return [timed_again(solve, best), *(outcome for outcome in tried if outcome is not best)]


def _only_tighter(setting: Setting, hit: Setting) -> bool:
    others = {key for key in setting if key != "atol"}
    return all(setting[key] == hit[key] for key in others) and setting["atol"] < hit["atol"]


def in_words(setting: Setting) -> str:
    """A setting as a reader wants it.

    Examples
    --------
    >>> in_words({"rtol": 1e-6, "atol": 1e-9, "longest_step": 0.05, "stops": True})
    'rtol 1e-06, atol 1e-09 m/s, steps up to 0.05 s, restart at load edges'
    """
    stops = {
        True: "restart at load edges",
        "restart": "restart at load edges",
        "stop": "stop at load edges",
    }
    parts = []
    for key, value in setting.items():
        if key == "stops":
            parts += [stops[value]] if value in stops else []
        elif key == "longest_step":
            parts += [f"steps up to {value:g} s"] if 0.0 < value < float("inf") else []
        elif key in ("atol", "step"):
            parts.append(f"{key} {value:.3g} {'m/s' if key == 'atol' else 's'}")
        elif key != "method":
            parts.append(f"{key} {value:.3g}")
    return ", ".join(parts)
