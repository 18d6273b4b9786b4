"""The reproduction as plain data: what `summary.json` holds."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.reproduction.dissipation import dissipation, knows_mechanisms
from macroslip.reproduction.model_run import PAPER

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.reproduction.model_run import ModelRun
    from macroslip.reproduction.statement import Statement

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
    "Energy over the orbit, films and load zone: traces of all rollers in case 14B, sampled every 0.05 s.",
    "Sensitivity: case 14B, one value at a time, window and orbits as in the study.",
    "Model physical: rollers 0, 4, ... 24 of each row in the sensitivity. Against all 28, over the 21 cases of the study, "
    "that moves a row's energy by at most 0.2 %, and its mean P_max by 1.4 % downwind and 8 % upwind.",
    "Model physical: the sensitivity's window ends at 200 s.",
    "Uncertainty: 128 scrambled Sobol samples over 23 estimated values, the law of shear among them, cases 12B and 24B, "
    "roller 0 of each row, window to 100 s. Ranges are quantiles 5 to 95 %; a driver has a rank correlation at p < 0.001. "
    "Sobol' indices are those of a sparse polynomial of second degree fitted to the logarithm of a result; a statement is "
    "robust if every sample shows it.",
    "Friction torque: dissipated power, rolling resistance and drag over shaft speed, all rollers in case 14B.",
    "Verdicts: 'about' allows a factor of 2; a trend is a rank correlation with wind speed at p < 0.05.",
    "Verdicts: high variance is a median standard deviation of at least half the mean.",
    "Verdicts: at the top is within 15 degrees of it; a snap is a return to 99 % of pure rolling in 2 % of an orbit.",
    "Verdicts: the cage dominates where it takes at least half of the energy in every case.",
)


def of_model(name: str, model: str) -> str:
    """Name of a figure or file of one model; those of the paper's have no ending.

    Examples
    --------
    >>> of_model("figure_4a", "paper"), of_model("figure_4a", "physical")
    ('figure_4a', 'figure_4a_physical')
    """
    return name if model == PAPER else f"{name}_{model}"


def told_statements(statements: Mapping[str, Mapping[str, Statement]]) -> list[dict[str, Any]]:
    """Statements by model as a list of what the paper states, each with what every model gives."""
    return [
        {
            "paper": first.paper,
            "models": {model: _as_dict(of_model[subject]) for model, of_model in statements.items()},
        }
        for subject, first in next(iter(statements.values())).items()
    ]


def _as_dict(one: Statement) -> dict[str, Any]:
    return {"verdict": one.verdict, "found": one.found, "because": one.because, "numbers": one.numbers}


def plotted(runs: Mapping[str, ModelRun], experiments: Mapping[str, xr.Dataset]) -> dict[str, Any]:
    """Every plotted number, by figure, as plain data with units; none of the load zone, the means of the torque."""
    found: dict[str, Any] = {}
    for model, run in runs.items():
        numbers = _numbers(run.numbers)
        traced = {"3a": "static", "3b": "typical", "3b_peak": "peak"}
        numbers = {
            name: {title: turn.to_dict(data="list") for title, turn in run.turns[group].items()}
            for name, group in traced.items()
            if group in run.turns
        } | numbers
        result = run.profile["result"]
        numbers["energy_over_orbit"] = run.profile["orbit"][["energy_over_orbit"]].to_dict(data="list")
        numbers["film_over_orbit"] = run.profile["orbit"][["film_thickness"]].to_dict(data="list")
        numbers["roller_spread"] = result[["energy"]].to_dict(data="list")
        numbers["outside_film_range"] = result[["outside_film_range"]].to_dict(data="list")
        numbers["sensitivity"] = run.sensitivity.to_dict(data="list")
        numbers["friction_torque"] = run.profile["torque"].mean("time", keep_attrs=True).to_dict(data="list")
        if knows_mechanisms(run.study):
            numbers["mechanisms"] = dissipation(run.study).to_dict(data="list")
        if run.uncertainty is not None:
            numbers["uncertainty"] = run.uncertainty.to_dict(data="list")
        found |= {of_model(name, model): value for name, value in numbers.items()}
    return found | {name: experiment.to_dict(data="list") for name, experiment in experiments.items()}


def _numbers(numbers: xr.Dataset) -> dict[str, Any]:
    def some(*names: str) -> dict[str, Any]:
        return numbers[list(names)].to_dict(data="list")

    energy = [f"energy{part}_normalised" for part in ("", "_min", "_max")]
    return {
        "4a": some(*energy, "both_rows_normalised", "energy", "energy_std", "energy_by_interface", "both_rows"),
        "4b": some("energy_ratio"),
        "5a": some("peak_power_mean_normalised", "peak_power_std_normalised", "peak_power_mean", "peak_power_std"),
        "5b": some("peak_power_ratio"),
    }


def failed_by_case(study: xr.Dataset) -> dict[str, int]:
    """Number of failed rollers of the cases that have any."""
    counts = (study.status != 0).sum(("row", "roller"))
    return {str(name): int(count) for name, count in zip(study.case.values, counts.values, strict=True) if count}


def plain(value: Any) -> Any:
    """Lists, dicts, text and numbers only; NaN and infinity, which JSON lacks, become None."""
    if isinstance(value, dict):
        return {str(key): plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [plain(one) for one in value]
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value


def as_json(summary: dict[str, Any]) -> str:
    """Indented, with every list of numbers on one line."""
    text = json.dumps(summary, indent=1, ensure_ascii=False, allow_nan=False)
    return re.sub(r"\[[\s\d.eE+\-,nul]+\]", lambda found: " ".join(found.group().split()), text) + "\n"
