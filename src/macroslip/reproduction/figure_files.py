"""The figures of the reproduction: those of the paper, and those on what is beyond it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from macroslip.reproduction.dissipation import dissipation, knows_mechanisms
from macroslip.reproduction.model_run import STATIC_LOADS, TORQUE_WINDOW, ModelRun, StageReport, bearing_torques
from macroslip.reproduction.summary import of_model

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def figures(runs: Mapping[str, ModelRun], experiments: Mapping[str, xr.Dataset]) -> dict[str, Callable[[], Figure]]:
    """How each figure is drawn, by file name.

    Parameters
    ----------
    runs : mapping
        What was computed, by model.
    experiments : mapping
        "A1", "nonlinear_tolerance", "step_size".
    """
    from macroslip.reproduction import bearing_sets, mechanism_figures, uncertainty_figures
    from macroslip.reproduction import paper_figures as draw
    from macroslip.reproduction.torque_figures import torque_figure

    found: dict[str, Callable[[], Figure]] = {
        "figure_A1": lambda: draw.stability_figure(experiments["A1"]),
        "nonlinear_tolerance": lambda: draw.nonlinear_tolerance_figure(experiments["nonlinear_tolerance"]),
        "step_size": lambda: draw.step_size_figure(experiments["step_size"]),
    }
    if len(runs) > 1:
        found["figures_4_5_models"] = lambda: mechanism_figures.models_figure(
            {name: run.numbers for name, run in runs.items()}
        )
    histories = bearing_torques(runs)
    found["friction_torque"] = lambda: torque_figure(histories, *TORQUE_WINDOW)
    for name, run in runs.items():
        static = {f"{title} load": run.turns["static"][f"{title}, downwind"] for title in STATIC_LOADS}
        of_run = {
            "figure_3a": lambda static=static: draw.turns_figure(static),
            "figure_3b": lambda run=run: draw.turns_figure(run.turns["typical"]),
            "figure_3b_peak": lambda run=run: draw.turns_figure(run.turns["peak"]),
            "figure_4a": lambda run=run: draw.energy_figure(run.numbers),
            "figure_4b": lambda run=run: draw.energy_ratio_figure(run.numbers),
            "figure_5a": lambda run=run: draw.peak_power_figure(run.numbers),
            "figure_5b": lambda run=run: draw.peak_power_ratio_figure(run.numbers),
            "energy_over_orbit": lambda run=run: bearing_sets.energy_over_orbit_figure(run.profile),
            "film_over_orbit": lambda run=run: bearing_sets.film_over_orbit_figure(run.profile),
            "load_zone": lambda run=run: bearing_sets.load_zone_figure(run.profile),
            "roller_spread": lambda run=run: bearing_sets.roller_spread_figure(run.profile),
            "outside_film_range": lambda run=run: bearing_sets.outside_film_range_figure(run.profile),
            "sensitivity": lambda run=run: bearing_sets.sensitivity_figure(run.sensitivity),
        }
        if knows_mechanisms(run.study):
            of_run["mechanisms"] = lambda run=run: mechanism_figures.mechanisms_figure(dissipation(run.study))
        if run.uncertainty is not None:
            of_run["uncertainty"] = lambda run=run: uncertainty_figures.uncertainty_figure(run.uncertainty)
        found |= {of_model(title, name): figure for title, figure in of_run.items()}
    return found


def save_figures(figures: Mapping[str, Callable[[], Figure]], folder: Path, report: StageReport) -> None:
    """Draw figures and write them into a folder, each as PNG and SVG."""
    from macroslip.report.style import save

    for done, (name, draw) in enumerate(figures.items(), start=1):
        save(draw(), folder, name)
        report("figures", done, len(figures))
