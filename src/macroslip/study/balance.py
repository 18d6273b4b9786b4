"""One temperature of the oil for all load histories of a study, at which their mean friction is the heat that is lost.

Ten minutes of wind do not change the temperature of a bearing whose time constant is hours; the mean power of all of them
does. Runs that differ in more than their loads have a temperature each: bearing, lubricant, model, parameters.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from macroslip.case.parts import Heat
from macroslip.errors import InputError, MacroslipError
from macroslip.input.units import is_finite_number
from macroslip.result.thermal_balance import next_temperature
from macroslip.study.build import template
from macroslip.study.reader import open_study
from macroslip.study.settings import RECORDS
from macroslip.study.study import Run, Study

#: Digits of a temperature [K]: enough, and the same on every machine, so that a resumed study finds its runs again.
_DIGITS = 3


def study_at_balance(study: Study, directory: Path, compute: Callable[[Study, Path], None]) -> Study:
    """The study at the temperature at which mean friction power = conductance (T − ambient), of each group of runs.

    Parameters
    ----------
    study : Study
        With its `heat`.
    directory : Path
        Folder for the runs by which the temperature is found; those that are there are used again.
    compute : callable
        compute(study, directory): computes what is missing of a study.

    Returns
    -------
    Study
        With its `temperatures`, within 0.2 K.

    Raises
    ------
    InputError
        If there is no balance.
    MacroslipError
        If a run fails, so that the mean is not known.

    Notes
    -----
    The mean is Σ w_k P_k over the load histories, w_k from `Study.weights`, together 1. All are simulated at the surroundings'
    temperature, 30 K above, and then at the balance of what is known, three to five times.
    """
    shares = (
        study.weights.of(study.loads.loads)
        if study.weights
        else [1.0 / len(study.loads.loads)] * len(study.loads.loads)
    )
    weights = dict(zip((load.name for load in study.loads.loads), shares, strict=True))
    examples = {run.group: run for run in study.runs()}
    heats = {group: _heat(study, run) for group, run in examples.items()}
    known: dict[str, dict[float, float]] = {group: {} for group in examples}
    while True:
        found = {group: next_temperature(known[group], heats[group]) for group in examples}
        if all(settled for _, settled in found.values()):
            return replace(study, heat=None, weights=None, temperatures=_rounded({g: t for g, (t, _) in found.items()}))
        # A group that has settled keeps the nearest temperature that is there already.
        chosen = {
            group: min(known[group], key=lambda place, at=at: abs(place - at)) if settled else at
            for group, (at, settled) in found.items()
        }
        trial = replace(
            study,
            case={**study.case, "rating": False, "traces": "none"},
            keep=[],
            cycles=False,
            heat=None,
            weights=None,
            temperatures=_rounded(chosen),
        )
        compute(trial, directory)
        for group, power in _mean_powers(trial, directory, weights).items():
            known[group][chosen[group]] = power


def _heat(study: Study, run: Run) -> Heat:
    """How the bearing of a run loses its heat: conductance and surroundings may vary."""
    records = {noun: getattr(study, f"{noun}s")[getattr(run, noun)] for noun in RECORDS}
    case, _ = template(study.case, list(run.settings), records, folder=study.folder)
    if case.heat is None:
        raise InputError(
            "the temperature is to balance, and the heat that the bearing loses is not given", where="heat"
        )
    return case.heat


def _rounded(temperatures: dict[str, float]) -> dict[str, float]:
    return {group: round(temperature, _DIGITS) for group, temperature in temperatures.items()}


def _mean_powers(study: Study, directory: Path, weights: dict[str, float]) -> dict[str, float]:
    """Mean friction power [W] of each group of runs."""
    powers = open_study(directory).friction_power.values
    found: dict[str, float] = {}
    for run, power in zip(study.runs(), np.asarray(powers).tolist(), strict=True):
        if not is_finite_number(power):
            raise MacroslipError(
                f"the friction power of the bearing under the loads {run.load.name} is not known, because the run "
                "failed: give the base case a temperature in place of balance"
            )
        found[run.group] = found.get(run.group, 0.0) + weights[run.load.name] * power
    return found
