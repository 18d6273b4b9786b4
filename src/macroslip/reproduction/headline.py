"""The summary in lines: what failed, what the paper states and what was found, and what the numerical method does."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.wording import three_digits
from macroslip.reproduction.statement import UNKNOWN, Statement

if TYPE_CHECKING:
    import xarray as xr


def statement_lines(statements: Mapping[str, Mapping[str, Statement]]) -> list[str]:
    """Every statement of the paper in one line, with what each model gives.

    Parameters
    ----------
    statements : mapping
        Statements by model and subject.
    """
    several = len(statements) > 1
    found = []
    for subject, first in next(iter(statements.values())).items():
        parts = [
            f"{f'{model}: ' if several else 'Converged: '}{of_model[subject].found} ({of_model[subject].verdict})"
            for model, of_model in statements.items()
        ]
        found.append(f"Paper: {first.paper}. {'; '.join(parts)}.")
    return found


def tolerance_line(experiment: xr.Dataset) -> str:
    """Between which stopping tolerances backward Euler passes 100 times the static energy, in one line."""
    one = experiment.sel(row="downwind").sortby("stopping_tolerance")
    ratio, tolerance = one.ratio.values, one.stopping_tolerance.values
    if not np.isfinite(ratio).all():
        return f"Backward Euler against its stopping tolerance: {UNKNOWN}, an integration failed."
    times = [three_digits(value) for value in ratio]
    beyond = np.flatnonzero(ratio >= 100.0)
    if beyond.size and beyond[0] > 0:
        k = int(beyond[0])
        passes = (
            f"passes 100 times between a relative change of {tolerance[k - 1]:.0e} ({times[k - 1]} times) and "
            f"{tolerance[k]:.0e} ({times[k]} times)"
        )
    else:
        passes = f"is {times[-1]} times at a relative change of {tolerance[-1]:.0e}"
    return (
        f"Backward Euler at {1e3 * experiment.attrs['step_s']:g} ms, downwind roller: with an iteration on spin that "
        f"stops early, energy over the static one {passes}; it is {times[0]} at {tolerance[0]:.0e} and "
        f"{float(one.ratio_converged):.3g} converged."
    )


def step_line(experiment: xr.Dataset) -> str:
    """Mean peak power of the upwind row at the largest and the smallest fixed step, in one line."""
    peak = experiment.mean_peak_power.sel(row="upwind").sortby("step").values
    converged = float(experiment.mean_peak_power_converged.sel(row="upwind"))
    if not np.isfinite([*peak, converged]).all():
        return f"Backward Euler against its step: {UNKNOWN}, an integration failed."
    steps = np.sort(experiment.step.values)
    return (
        f"Backward Euler, mean peak power per orbit upwind: {peak[-1]:.2g} W at a fixed step of "
        f"{1e3 * steps[-1]:g} ms, {peak[0]:.2g} W at {1e3 * steps[0]:g} ms; converged {converged:.2g} W."
    )


def numerical_line(tolerances: xr.Dataset, steps: xr.Dataset) -> str:
    """`tolerance_line` and `step_line` in one line, and what they do not show."""
    return f"{tolerance_line(tolerances)} {step_line(steps)} What the paper's authors did is not known."


def failure_line(failed: dict[str, int], study_rollers: int) -> str:
    """How many integrations failed, of the study and beside it, in one line."""
    if not any(failed.values()):
        completed = f"All {study_rollers} rollers of the study and all integrations beside it completed"
        return f"{completed}, explicit Euler in A1 apart."
    parts = ", ".join(f"{count} in {place.replace('_', ' ')}" for place, count in failed.items() if count)
    return f"FAILED INTEGRATIONS: {parts} (the study has {study_rollers} rollers); every mean they enter is missing."
