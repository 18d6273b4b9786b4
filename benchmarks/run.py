"""The whole measurement: comparison, one evaluation, speed and growth; `bench.json` and the work-precision diagram."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

from benchmarks import own
from benchmarks.comparison import Entry, as_plain, compare
from benchmarks.evaluation import evaluation_times, quadrature_times
from benchmarks.histories import History, fixed_histories, long_histories
from benchmarks.mechanisms import mechanism_costs
from benchmarks.outcome import ASKED
from benchmarks.rivals import INSTALL
from benchmarks.scaling import linearity, real_time, two_threads
from benchmarks.verify import AGREEMENT, verify
from macroslip.case.parts import Radau
from macroslip.contact.mechanisms import Laws
from macroslip.errors import InputError
from macroslip.machine import machine
from paper.publish import published_together

SUMMARY = "bench.json"
#: What is asked of the production integrator against the limit set by its force evaluations.
TARGETS = {
    "quadrature_ratio": 5.0,
    "overhead_factor": 1.5,
    "force_evaluation_ns": 400.0,
    "real_time_factor": 30_000.0,
    "thread_speedup": 1.8,
    "physical_real_time_factor": 20_000.0,
    "physical_slowest": 7_000.0,
}


def run_bench(
    directory: Path, *, quick: bool = False, progress: Callable[[str, int, int], None] | None = None
) -> dict:
    """Measure everything and write `bench.json`, `work_precision.png` and `work_precision.svg`.

    Parameters
    ----------
    directory : Path
        Folder for the results; made if it does not exist.
    quick : bool
        One case instead of three in the comparison, for 20 s instead of 30 s, with fewer settings; and one instead of
        21 for all else.
    progress : callable, optional
        Called as progress(label, done, total).

    Returns
    -------
    dict
        What `bench.json` holds.

    Raises
    ------
    InputError
        If matplotlib is not installed, or `directory` is a file.

    Notes
    -----
    Times are CPU times of this process on one thread, the least of several, after everything is compiled; the wall
    times of the thread measurement are the exception.
    """
    try:
        import_module("matplotlib.figure")  # told now, not after minutes of measuring
    except ImportError:
        fault = "matplotlib, which draws the diagram, is not installed"
        raise InputError(fault, remedy=f"{INSTALL} brings it.") from None
    report = progress or (lambda label, done, total: None)
    tolerance = Radau().tolerance
    with published_together(directory, SUMMARY) as folder:
        report("growth of cost, threads", 0, 1)
        # First what is measured of the package alone, before libraries of the rivals are in the process.
        threads = two_threads(quick=quick)
        long = long_histories(quick=quick)
        growth = linearity(long, tolerance, quick=quick)
        speed = {
            model: real_time(
                timed_histories,
                tolerance,
                lambda done, total: report("speed over real time", done, total),
            )
            for model, timed_histories in (
                ("paper", long),
                ("physical", long_histories(quick=quick, laws=Laws.physical())),
            )
        }
        report("one force evaluation", 0, 1)
        # The first and the last two histories of the study, calm and rough; one case in the quick run.
        sample = long[:2] + long[-2:] if len(long) > 2 else long
        evaluation, quadrature = (
            evaluation_times(sample, tolerance),
            quadrature_times(sample, tolerance),
        )
        costs = mechanism_costs(
            tolerance,
            quick=quick,
            report=lambda done, total: report("cost of mechanisms", done, total),
        )
        report("reference", 0, 1)
        histories = fixed_histories(quick=quick)
        references = [own.reference(history) for history in histories]
        verified = verify(histories, references)
        results = compare(histories, references, quick=quick, report=report)
        summary: dict[str, Any] = {
            "machine": machine(),
            "quick": quick,
            "asked_accuracy": ASKED,
            "default_tolerance": tolerance,
            "reference": {
                "tolerance": own.REFERENCE_TOLERANCE,
                "agreement_asked": AGREEMENT,
                **verified,
            },
            "targets": TARGETS,
            "methods": as_plain(histories, results),
            "evaluation": evaluation,
            "quadrature": quadrature,
            "real_time": speed,
            "threads": threads,
            "linearity": growth,
            "mechanisms": costs,
        }
        _draw(
            folder,
            results,
            histories,
            {key: method["title"] for key, method in summary["methods"].items()},
        )
        (folder / SUMMARY).write_text(
            json.dumps(finite(summary), indent=1) + "\n", encoding="utf-8"
        )
    return summary


def _draw(
    folder: Path,
    results: dict[str, list[Entry] | None],
    histories: list[History],
    titles: dict[str, str],
) -> None:
    from benchmarks.work_precision import plot_work_precision
    from macroslip.report.style import new_figure, program_style, save

    with program_style():
        figure, axes = new_figure(10.5, 5.2, 1, 2)
        for panel, quantity in zip(axes, ("energy_error", "spin_error"), strict=True):
            plot_work_precision(panel, results, histories, quantity, titles)
        handles, labels = axes[0].get_legend_handles_labels()
        legend = {"loc": "outside lower center", "ncols": 3, "frameon": False, "fontsize": 9}
        figure.legend(handles, labels, **legend)
        save(figure, folder, "work_precision")


def finite(value: Any) -> Any:
    """The same plain data with None in place of NaN and infinity, which JSON does not know.

    Examples
    --------
    >>> finite({"a": [1.0, math.nan], "b": (math.inf, "c")})
    {'a': [1.0, None], 'b': [None, 'c']}
    """
    if isinstance(value, dict):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
