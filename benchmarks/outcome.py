"""What one run of one method on one history gives, how far it is off, and which setting a rival is judged by."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

#: The keyword arguments of a method's `solve` that say how it runs.
Setting = Mapping[str, Any]

#: Accuracy that is asked of everybody, in the total energy and in mid-coast spin.
ASKED = 1e-4
#: Slip in mid-coast below which there is nothing to compare, as a part of the raceway speed.
_LEAST_SLIP = 1e-3


class Solution(NamedTuple):
    """Energies [J] of the three interfaces, slip [m/s] at the marks, force evaluations used; NaN where it failed."""

    energy: np.ndarray
    slip: np.ndarray
    evaluations: float


class Reference(NamedTuple):
    """Converged total energy [J] and, at the marks, slip and speed of the rings [m/s]."""

    energy: float
    slip: np.ndarray
    ring_speed: np.ndarray


class Measurement(NamedTuple):
    """One run: its setting, its errors [-], its CPU time [s] and force evaluations."""

    setting: Setting
    energy_error: float
    spin_error: float
    seconds: float
    evaluations: float

    @property
    def error(self) -> float:
        """The larger of the two errors; infinite if the run failed."""
        worst = max(self.energy_error, self.spin_error)
        return worst if np.isfinite(worst) else float("inf")


def errors(solution: Solution, reference: Reference) -> tuple[float, float]:
    """Relative error of E_tot, and largest error of spin in mid-coast as a part of pure rolling; infinite if NaN.

    Only coasts whose slip exceeds a thousandth of the raceway speed count; without any, the error of spin is 0.
    """
    energy = abs(float(np.sum(solution.energy)) / reference.energy - 1.0)
    coasting = np.abs(reference.slip) > _LEAST_SLIP * np.abs(reference.ring_speed)
    off = np.abs(solution.slip - reference.slip)[coasting] / np.abs(reference.ring_speed)[coasting]
    spin = float(np.max(off)) if off.size else 0.0
    return tuple(float(e) if np.isfinite(e) else float("inf") for e in (energy, spin))


def cheapest(outcomes: list[Measurement], asked: float = ASKED) -> tuple[Measurement, bool]:
    """The outcome that reaches the accuracy for the least CPU time and True, or the most accurate one and False.

    Raises
    ------
    ValueError
        If there are no outcomes.

    Examples
    --------
    >>> runs = [Measurement({}, 1e-5, 1e-5, 3.0, 0), Measurement({}, 9e-5, 1e-6, 2.0, 0), Measurement({}, 1e-6, 2e-4, 1.0, 0)]
    >>> cheapest(runs)[0].seconds, cheapest(runs[2:])[1]
    (2.0, False)
    """
    if not outcomes:
        raise ValueError("nothing to choose from")
    good = [outcome for outcome in outcomes if outcome.error <= asked]
    if good:
        return min(good, key=lambda outcome: outcome.seconds), True
    return min(outcomes, key=lambda outcome: outcome.error), False
