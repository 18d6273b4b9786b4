"""The comparison itself: every method on every history, its best setting, and the ratio of CPU times."""

from __future__ import annotations

import functools
import itertools
import math
import statistics
from collections.abc import Callable
from typing import Any, NamedTuple

from benchmarks import own
from benchmarks.histories import History
from benchmarks.outcome import ASKED, Measurement, Reference, Setting, cheapest
from benchmarks.quiet import silence
from benchmarks.rivals import (
    CVODE,
    CVODE_COMPILED,
    EULER,
    EULER_TOLERANCES,
    OWN,
    OWN_TITLE,
    RIVALS,
    own_settings,
)
from benchmarks.scan import in_words, measure, scan, timed_again

Report = Callable[[str, int, int], None]


class Entry(NamedTuple):
    """One method on one history: the outcome that counts, whether it is accurate enough, all outcomes, and the ratio.

    `extrapolated` says that the outcome was not run but follows from the order of convergence measured on the others.
    """

    best: Measurement
    reached: bool
    outcomes: list[Measurement]
    extrapolated: bool
    ratio: float


def compare(
    histories: list[History], references: list[Reference], *, quick: bool, report: Report
) -> dict[str, list[Entry] | None]:
    """Every method's entries, history by history, under its key; None if a rival is not installed.

    Parameters
    ----------
    histories : list of History
    references : list of Reference
        One for each history.
    quick : bool
        Fewer settings.
    report : callable
        Called as report(label, done, total).
    """
    report(OWN_TITLE, 0, len(histories))
    ours = [
        _own_entry(history, reference)
        for history, reference in zip(histories, references, strict=True)
    ]
    results: dict[str, list[Entry] | None] = {OWN: ours}
    for rival in RIVALS:
        solve = rival.load()
        results[rival.key] = None if solve is None else []
        if solve is None:
            continue
        report(rival.title, 0, len(histories))
        with silence():
            # Whatever a method compiles or imports, it does before its time counts.
            solve(histories[0], references[0], **next(iter(rival.settings(False, quick))))
        for number, (history, reference) in enumerate(zip(histories, references, strict=True)):
            settings = rival.settings(history.edges.size > 0, quick)
            if rival.key == CVODE and results[CVODE_COMPILED]:
                # The same library takes the same steps: what serves it best is known from its compiled callbacks.
                settings = itertools.chain(
                    _accurate_settings(results[CVODE_COMPILED][number]), settings
                )
            bound = functools.partial(solve, history, reference)
            budget = (0.5 if quick else 1.0) * rival.patience * (history.end - history.start)
            with silence():
                outcomes = scan(bound, settings, reference, budget=budget, prune=rival.prune)
                entry = (
                    _euler_entry(bound, outcomes, reference, budget)
                    if rival.key == EULER
                    else _entry(outcomes)
                )
            comparable = entry.reached and ours[number].reached
            ratio = entry.best.seconds / ours[number].best.seconds if comparable else math.nan
            results[rival.key].append(entry._replace(ratio=ratio))
            report(rival.title, number + 1, len(histories))
    return results


def _entry(outcomes: list[Measurement]) -> Entry:
    return Entry(outcomes[0], outcomes[0].error <= ASKED, outcomes, False, math.nan)


def _own_entry(history: History, reference: Reference) -> Entry:
    solve = functools.partial(own.solve, history)
    own.solve(history, **next(own_settings()))
    outcomes = [
        timed_again(solve, measure(solve, setting, reference)) for setting in own_settings()
    ]
    best, reached = cheapest(outcomes)
    return Entry(best, reached, outcomes, False, 1.0)


def _accurate_settings(entry: Entry) -> list[Setting]:
    """Settings that were accurate enough, cheap ones first."""
    good = sorted(
        (outcome for outcome in entry.outcomes if outcome.error <= ASKED),
        key=lambda outcome: outcome.seconds,
    )
    return [outcome.setting for outcome in good]


def _euler_entry(
    solve: Callable, outcomes: list[Measurement], reference: Reference, budget: float
) -> Entry:
    """Go on from the steps tried: an error of first order tells which step would have been just short enough."""
    best, reached = outcomes[0], outcomes[0].error <= ASKED
    factor = min(0.9 * ASKED / best.error, 3.0)
    setting = {"step": best.setting["step"] * factor, "tolerance": EULER_TOLERANCES[-1]}
    if reached or best.seconds / factor < budget:
        refined = scan(solve, [setting], reference, budget=budget, prune=False)
        best, reached = cheapest([best, *refined])
        return Entry(best, reached, [*outcomes, *refined], False, math.nan)
    guess = Measurement(
        setting, 0.9 * ASKED, 0.9 * ASKED, best.seconds / factor, best.evaluations / factor
    )
    return Entry(guess, True, outcomes, True, math.nan)


def spread(values: list[float]) -> dict[str, float]:
    """Median, least and largest of the finite values; NaN without any.

    Examples
    --------
    >>> spread([3.0, 1.0, math.nan, 10.0])
    {'median': 3.0, 'min': 1.0, 'max': 10.0}
    """
    finite = [value for value in values if math.isfinite(value)]
    if not finite:
        return {"median": math.nan, "min": math.nan, "max": math.nan}
    return {"median": statistics.median(finite), "min": min(finite), "max": max(finite)}


def as_plain(histories: list[History], results: dict[str, list[Entry] | None]) -> dict[str, Any]:
    """The results as plain data: per method its target and ratios, per history the setting, errors and times."""
    titles = {OWN: (OWN_TITLE, math.nan)} | {
        rival.key: (rival.title, rival.target) for rival in RIVALS
    }
    methods: dict[str, Any] = {}
    for key, entries in results.items():
        title, target = titles[key]
        methods[key] = {"title": title, "target": target, "installed": entries is not None}
        if entries is None:
            continue
        methods[key]["ratio"] = spread([entry.ratio for entry in entries])
        methods[key]["not_reached"] = [
            history.name
            for history, entry in zip(histories, entries, strict=True)
            if not entry.reached
        ]
        methods[key]["histories"] = {
            history.name: _entry_as_plain(entry)
            for history, entry in zip(histories, entries, strict=True)
        }
    return methods


def _entry_as_plain(entry: Entry) -> dict[str, Any]:
    best = entry.best._asdict() | {"setting": in_words(entry.best.setting)}
    # Columns, because there may be hundreds of runs.
    runs = {
        name: [getattr(outcome, name) for outcome in entry.outcomes]
        for name in Measurement._fields
        if name != "setting"
    }
    runs = {"setting": [in_words(outcome.setting) for outcome in entry.outcomes]} | runs
    return best | {
        "reached": entry.reached,
        "extrapolated": entry.extrapolated,
        "ratio": entry.ratio,
        "runs": runs,
    }
