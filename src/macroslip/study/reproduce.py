"""The reproduction of the paper in one call: study, single rollers, experiments, figures and a summary."""

from __future__ import annotations

import importlib.util
import json
import math
import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import macroslip
from macroslip.bearing.frames import ROWS
from macroslip.errors import MacroslipError
from macroslip.loads import Drivetrain, HubLoads, main_bearing_load
from macroslip.study import verdicts
from macroslip.study.case import Case
from macroslip.study.paper_numbers import paper_numbers
from macroslip.study.paper_study import run_study
from macroslip.study.published import published_together
from macroslip.study.simulate import simulate
from macroslip.study.single_roller import (
    inflexion_angle,
    largest_peak,
    peak_turn,
    static_load,
    static_turn,
    typical_turn,
)
from macroslip.study.solver_experiments import nonlinear_tolerance, step_size
from macroslip.study.stability import compare_stability

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from macroslip.loads import BearingLoads

SUMMARY, STUDY = "summary.json", "study.nc"
#: The case of the single-roller figures, whose means are the static load.
SINGLE_ROLLER_CASE = "14B"
STATIC_LOADS = {"downward": False, "downward and thrust": True}
CONVENTIONS = (
    "The window opens when the rollers have completed one orbit and ends with the loads.",
    "Energy of a row: mean over its rollers of E_in + E_out + E_cage; bars show the smallest and the largest roller.",
    "P_max: largest power at any interface in an orbit; mean and (population) standard deviation over all (roller, "
    "orbit) samples of a row.",
    "Each row is normalised by its own value in the reference case (energy 12C, P_max 14A).",
    "Static loads: means over the samples of case 14B, (0, F_Y0, 0) and (0, F_Y0, F_Z0), at the mean speed.",
    "Angles of a turn count from the bottom along the orbit; the top is at 180 degrees.",
    "Figure 3a: the ninth turn of roller 0 of the downwind row.",
    "Figure 3b: the turn of roller 0 of each row whose energy is nearest the median over the row's rollers and orbits.",
    "Figure 3b_peak: the turn with the row's largest P_max.",
    "Verdicts: 'about' allows a factor of 2; a trend is a rank correlation with wind speed at p < 0.05.",
    "Verdicts: high variance is a median standard deviation of at least half the mean.",
    "Verdicts: at the top is within 15 degrees of it; a snap is a return to 99 % of pure rolling in 2 % of an orbit.",
)

_Progress = Callable[[str, int, int], None]


def reproduce(directory: Path, *, threads: int | None = None, progress: _Progress | None = None) -> dict[str, Any]:
    """Reproduce the paper's study and figures with converged solutions, and judge its statements.

    Parameters
    ----------
    directory : Path
        Folder for `summary.json`, `study.nc` and the figures (PNG and SVG). Files of an earlier run are overwritten,
        all at the end; others stay.
    threads : int, optional
        Threads over rollers; the number of usable processors by default.
    progress : callable, optional
        Called as progress(stage, done, total) with the stages "study", "single rollers", "experiments", "figures".

    Returns
    -------
    dict
        What `summary.json` holds: `headline`, `statements`, `failed_rollers`, `conventions`, `figures` with every
        plotted number and its units, and `seconds` by stage. NaN is None.

    Raises
    ------
    MacroslipError
        If matplotlib is not installed; nothing is computed then.
    InputError
        If `directory` is a file.
    """
    if importlib.util.find_spec("matplotlib") is None:
        raise MacroslipError("figures need matplotlib, which is not installed: pip install 'macroslip[figures]'")
    clock, seconds = time.perf_counter(), {}

    def report(stage: str, done: int, total: int) -> None:
        nonlocal clock
        if done == total:
            seconds[stage] = round(time.perf_counter() - clock, 2)
            clock = time.perf_counter()
        if progress:
            progress(stage, done, total)

    with published_together(Path(directory), SUMMARY) as folder:
        study = run_study(threads=threads, progress=lambda done, total: report("study", done, total))
        numbers = paper_numbers(study)
        varying = main_bearing_load(HubLoads.bundled(SINGLE_ROLLER_CASE), Drivetrain())
        result = simulate(Case(loads=varying), threads=threads)
        turns = _turns(varying, result, report)
        experiments = _experiments(varying, result, threads, report)
        figures = _figures(numbers, turns, experiments)
        _save(figures, folder, report)
        # In memory first: the HDF5 library may bring the whole process down when the disk is full.
        (folder / STUDY).write_bytes(study.to_netcdf(engine="h5netcdf"))
        statements = _statements(numbers, turns, experiments)
        failed = _failures(study, turns, experiments)
        summary = _plain(
            {
                "program": f"macroslip {macroslip.__version__}",
                "headline": _headline(statements, failed, study, experiments),
                "statements": [
                    {"paper": one.paper, "verdict": one.verdict, "found": one.found, "numbers": one.numbers}
                    for one in statements
                ],
                "failed_rollers": failed | {"study_by_case": _failed_by_case(study), "study_total": study.status.size},
                "conventions": CONVENTIONS,
                "seconds": seconds,
                "figures": _plotted(numbers, turns, experiments),
                "study": study.to_dict(data="list"),
            }
        )
        (folder / SUMMARY).write_text(_as_json(summary), encoding="utf-8")
    return summary


def _turns(varying: BearingLoads, result: xr.Dataset, report: _Progress) -> dict[str, dict[str, xr.Dataset]]:
    """Traced turns by figure and column; the static ones of both rows under "static"."""
    jobs = [("static", f"{name}, {row}", static_turn, (varying, row), {"thrust": thrust})
            for name, thrust in STATIC_LOADS.items() for row in ROWS]
    jobs += [("typical", f"{row} row", typical_turn, (varying, result, row), {}) for row in ROWS]
    jobs += [("peak", f"{row} row", peak_turn, (varying, result, row), {}) for row in ROWS]
    found: dict[str, dict[str, xr.Dataset]] = {}
    for done, (group, title, trace, arguments, options) in enumerate(jobs, start=1):
        found.setdefault(group, {})[title] = trace(*arguments, **options)
        report("single rollers", done, len(jobs))
    return found


def _experiments(
    varying: BearingLoads, result: xr.Dataset, threads: int | None, report: _Progress
) -> dict[str, xr.Dataset]:
    _, orbit = largest_peak(result, "upwind")
    # Two orbits before the largest peak and one after it.
    start = max(float(result.orbit_start[orbit]) - 14.0, float(varying.time[0]))
    end = min(float(result.orbit_end[orbit]) + 7.0, float(varying.time[-1]))
    jobs = {
        "A1": lambda: compare_stability(static_load(varying, thrust=False, duration=4.0)),
        "nonlinear_tolerance": lambda: nonlinear_tolerance(varying, threads=threads),
        "step_size": lambda: step_size(varying, start=start, end=end, threads=threads),
    }
    found = {}
    for done, (name, job) in enumerate(jobs.items(), start=1):
        found[name] = job()
        report("experiments", done, len(jobs))
    return found


def _plotted(
    numbers: xr.Dataset, turns: dict[str, dict[str, xr.Dataset]], experiments: dict[str, xr.Dataset]
) -> dict[str, Any]:
    """Every plotted number, by figure, as plain data with units."""

    def some(*names: str) -> dict[str, Any]:
        return numbers[list(names)].to_dict(data="list")

    traced = {"3a": "static", "3b": "typical", "3b_peak": "peak"}
    energy = [f"energy{part}_normalised" for part in ("", "_min", "_max")]
    return {
        **{
            name: {title: turn.to_dict(data="list") for title, turn in turns[group].items()}
            for name, group in traced.items()
        },
        "4a": some(*energy, "both_rows_normalised", "energy", "energy_std", "energy_by_interface", "both_rows"),
        "4b": some("energy_ratio"),
        "5a": some("peak_power_mean_normalised", "peak_power_std_normalised", "peak_power_mean", "peak_power_std"),
        "5b": some("peak_power_ratio"),
        **{name: experiment.to_dict(data="list") for name, experiment in experiments.items()},
    }


def _figures(
    numbers: xr.Dataset, turns: dict[str, dict[str, xr.Dataset]], experiments: dict[str, xr.Dataset]
) -> dict[str, Callable[[], Figure]]:
    """How each figure is drawn, by file name."""
    from macroslip.report import paper_figures as draw

    static = {f"{name} load": turns["static"][f"{name}, downwind"] for name in STATIC_LOADS}
    return {
        "figure_3a": lambda: draw.turns_figure(static),
        "figure_3b": lambda: draw.turns_figure(turns["typical"]),
        "figure_3b_peak": lambda: draw.turns_figure(turns["peak"]),
        "figure_4a": lambda: draw.energy_figure(numbers),
        "figure_4b": lambda: draw.energy_ratio_figure(numbers),
        "figure_5a": lambda: draw.peak_power_figure(numbers),
        "figure_5b": lambda: draw.peak_power_ratio_figure(numbers),
        "figure_A1": lambda: draw.stability_figure(experiments["A1"]),
        "nonlinear_tolerance": lambda: draw.nonlinear_tolerance_figure(experiments["nonlinear_tolerance"]),
        "step_size": lambda: draw.step_size_figure(experiments["step_size"]),
    }


def _save(figures: dict[str, Callable[[], Figure]], folder: Path, report: _Progress) -> None:
    from macroslip.report.style import save

    for done, (name, draw) in enumerate(figures.items(), start=1):
        save(draw(), folder, name)
        report("figures", done, len(figures))


def _statements(
    numbers: xr.Dataset, turns: dict[str, dict[str, xr.Dataset]], experiments: dict[str, xr.Dataset]
) -> list[verdicts.Statement]:
    static = turns["static"]
    downward = static["downward, downwind"]
    energies = {name: {row: static[f"{name}, {row}"].attrs["energy_J"] for row in ROWS} for name in STATIC_LOADS}
    return [
        verdicts.energy_over_wind_speed(numbers),
        verdicts.energy_between_rows(numbers),
        verdicts.peak_power_over_wind_speed(numbers),
        verdicts.peak_power_between_rows(numbers),
        verdicts.unloaded_roller(downward, inflexion_angle(downward)),
        verdicts.varying_over_static(numbers, SINGLE_ROLLER_CASE, energies),
        verdicts.euler_stability(experiments["A1"]),
    ]


def _headline(
    statements: list[verdicts.Statement], failed: dict[str, int], study: xr.Dataset, experiments: dict[str, xr.Dataset]
) -> list[str]:
    return [
        verdicts.failure_line(failed, study.status.size),
        *(statement.line() for statement in statements),
        verdicts.tolerance_line(experiments["nonlinear_tolerance"]),
        verdicts.step_line(experiments["step_size"]),
    ]


def _failures(
    study: xr.Dataset, turns: dict[str, dict[str, xr.Dataset]], experiments: dict[str, xr.Dataset]
) -> dict[str, int]:
    """Failed integrations by place. Explicit Euler may fail in A1: that is what it is there to show."""
    traced = [turn.attrs["status"] for group in turns.values() for turn in group.values()]
    stability = experiments["A1"].attrs
    beside = [int(stability[f"status_{name}"] != 0) for name in ("backward", "converged")]
    for name in ("nonlinear_tolerance", "step_size"):
        beside += [int(experiments[name][one].sum()) for one in experiments[name].data_vars if one.startswith("failed")]
    return {
        "study": int((study.status != 0).sum()),
        "single_rollers": sum(status != 0 for status in traced),
        "experiments": sum(beside),
    }


def _failed_by_case(study: xr.Dataset) -> dict[str, int]:
    counts = (study.status != 0).sum(("row", "roller"))
    return {str(name): int(count) for name, count in zip(study.case.values, counts.values, strict=True) if count}


def _plain(value: Any) -> Any:
    """Lists, dicts, text and numbers only; NaN and infinity, which JSON lacks, become None."""
    if isinstance(value, dict):
        return {str(key): _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [_plain(one) for one in value]
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _as_json(summary: dict[str, Any]) -> str:
    """Indented, with every list of numbers on one line."""
    text = json.dumps(summary, indent=1, ensure_ascii=False, allow_nan=False)
    return re.sub(r"\[[\s\d.eE+\-,nul]+\]", lambda found: " ".join(found.group().split()), text) + "\n"
