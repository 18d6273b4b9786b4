"""Oil temperature of a study at which the heat that a bearing loses equals its mean friction."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from macroslip.errors import MacroslipError
from macroslip.result.heat_balance import next_temperature
from macroslip.study.reader import open_study
from macroslip.study.study_file import Study

#: Digits of a temperature [K]: enough, and the same on every machine, so that a resumed study finds
#: its runs again.
_DIGITS = 3


def study_at_balance(
    study: Study, directory: Path, compute: Callable[[Study, Path], None]
) -> Study:
    """The study with each group of runs at its temperature of thermal balance.

    There the mean friction power equals conductance (T − ambient).

    Ten minutes of wind do not change the temperature of a bearing whose time constant is hours; the
    mean power Σ w_k P_k of all load histories does, with w_k from `Study.weights`, together 1. All
    are simulated at the surroundings' temperature, 30 K above, and then at the balance found so
    far, three to five times.

    The runs on the way are computed by compute(study, directory) in a folder of their own. Raises
    InputError if there is no balance, and MacroslipError if a run fails, so that the mean is not
    known.
    """
    loads = study.loads.loads
    count = len(loads)
    shares = [1.0 / count] * count
    if study.weights:
        shares = study.weights.of(loads)
    names = [load.name for load in loads]
    weights = dict(zip(names, shares, strict=True))
    cases = {
        run.group: study.case_of(run)[0]
        for run in {run.group: run for run in study.runs()}.values()
    }
    known: dict[str, dict[float, float]] = {group: {} for group in cases}
    while True:
        next_temperatures = {group: next_temperature(known[group], cases[group]) for group in cases}
        if all(settled for _, settled in next_temperatures.values()):
            temperatures = {
                group: round(at, _DIGITS) for group, (at, _) in next_temperatures.items()
            }
            return replace(study, heat=None, weights=None, temperatures=temperatures)
        # A group that has settled keeps the nearest temperature that is there already.
        chosen = {
            group: min(known[group], key=lambda computed, at=at: abs(computed - at))
            if settled
            else at
            for group, (at, settled) in next_temperatures.items()
        }
        trial_temperatures = {group: round(at, _DIGITS) for group, at in chosen.items()}
        trial = replace(
            study,
            case={**study.case, "rating": False, "traces": "none"},
            keep=[],
            cycles=False,
            heat=None,
            weights=None,
            temperatures=trial_temperatures,
        )
        compute(trial, directory)
        powers = _mean_powers(trial, directory, weights)
        for group, power in powers.items():
            temperature = chosen[group]
            known[group][temperature] = power


def _mean_powers(study: Study, directory: Path, weights: dict[str, float]) -> dict[str, float]:
    powers: dict[str, float] = {}
    powers_of_runs = open_study(directory).friction_power.values.tolist()
    for run, power in zip(study.runs(), powers_of_runs, strict=True):
        if not np.isfinite(power):
            raise MacroslipError(
                f"the friction power of the bearing under the loads {run.load.name} is not known, "
                "because the run failed: give the base case a temperature in place of balance"
            )
        weight = weights[run.load.name]
        powers[run.group] = powers.get(run.group, 0.0) + weight * power
    return powers
