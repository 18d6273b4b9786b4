"""Skew of one roller, from its steps.

It adds to their power and makes its contacts slide; mean values are taken by position on the orbit.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.constants import SECTORS
from macroslip.contact.look_up import log_speed
from macroslip.contact.skewed import slip_lines
from macroslip.measures.totals import RACEWAYS
from macroslip.mechanics.cage import cage_forces
from macroslip.roller.model import Roller
from macroslip.roller.skew import Pair
from macroslip.roller.skew_table import Guide, SkewTable, turned

#: Numbers that `SkewMeasures.by_sector` sums up.
BY_SECTOR = ("skew_by_position", "axial_force_by_position", "skew_power_by_position")


class Skewing(NamedTuple):
    """Skew of the rollers of a row: table of forces, guidance by the cage, and raceways."""

    table: SkewTable  #: Forces and moments of a skewed roller
    guide: Guide  #: Guidance by the cage
    pair: Pair  #: Both raceway contacts


@jit_inline
def _power_of_ends(roller, stop, push, speed):
    """Frictional power that a skew stop adds at the cage, with its asperity part [W].

    Spars hold the roller with an end each, by the force `stop` [N]; one of them presses with `push`
    [N] beside. The roller's surface passes them at `speed` [m/s].
    """
    body, tables = roller
    power = 0.0
    rough = 0.0
    if stop > 0.0:
        for load, sign in ((stop + abs(push), 1.0), (stop, 1.0), (abs(push), -1.0)):
            at_spar = cage_forces(body, tables, load, speed, log_speed(speed))
            power -= sign * at_spar.friction * speed
            rough += sign * at_spar.asperity_power
    return power, rough


@jit
def _add(skewing, roller, steps, j, places, window, totals):
    """Add the power of skew to the steps of a buffer and to the totals.

    The first of `totals` holds what was added at the end of the last step [W].
    """
    (table, guide), (before, sums, by_sector) = skewing, totals
    for n in range(steps.shape[0]):
        step = steps[n, j]
        for i in range(3):
            step.power_before[i] += before[i]
        counted = step.start >= window and step.end > step.start
        for k in range(step.stages):
            load = step.elastic_load[k]
            weight = step.weight[k]
            inner = 0.0
            outer = 0.0
            ends = 0.0
            if load > 0.0:
                turned_roller = turned(table, guide, load, step.outer_speed[k], step.cage_load[k])
                inner = turned_roller.inner_power
                outer = turned_roller.outer_power
                ends, rough = _power_of_ends(
                    roller,
                    abs(turned_roller.stop_moment) / guide.arm,
                    step.cage_load[k],
                    step.cage_speed[k],
                )
                step.power[k, 0] += inner
                step.power[k, 1] += outer
                step.power[k, 2] += ends
                step.rough[k, 0] += turned_roller.inner_rough
                step.rough[k, 1] += turned_roller.outer_rough
                step.rough[k, 2] += rough
                if counted:
                    sums[0] += weight * inner
                    sums[1] += weight * outer
                    sums[2] = max(sums[2], turned_roller.unbalanced)
                    sums[3] += weight * ends
                    of_sector = by_sector[places[n, k]]
                    of_sector[0] += weight
                    of_sector[1] += weight * turned_roller.skew
                    of_sector[2] += weight * turned_roller.axial
                    of_sector[3] += weight * (inner + outer)
            # Rows between the stages of a step come before it and have its start.
            if k == step.stages - 1 and not (step.weight[0] == 0.0 and step.end > step.start):
                before[0] = inner
                before[1] = outer
                before[2] = ends


@jit
def _follow(table, guide, loads, speeds, pushes, states):
    """Write states of a skewed roller.

    They are ψ, θ, axial force, moments of both raceways, force of a spar at the stop, δ and the
    slip that is added.
    """
    for n in range(loads.size):
        if loads[n] > 0.0:
            at = turned(table, guide, loads[n], speeds[n], pushes[n])
            states[n, 0] = at.skew
            states[n, 1] = at.tilt
            states[n, 2] = at.axial
            states[n, 3] = at.inner_moment
            states[n, 4] = at.outer_moment
            states[n, 5] = abs(at.stop_moment) / guide.arm
            states[n, 6] = at.shift
            states[n, 7] = at.slip
        elif not math.isnan(loads[n]):
            states[n, 2:] = 0.0


class SkewMeasures:
    """Skew of one roller.

    Parameters
    ----------
    skewing : Skewing
    roller : Roller
        For friction at the cage.
    window : float
        Start of the window [s].

    Attributes
    ----------
    by_sector : ndarray, shape (sectors, 4)
        Time under the rings' load [s], and integrals over it of ψ [rad s], axial force [N s] and
        added power [J].
    """

    def __init__(self, skewing: Skewing, roller: Roller, window: float):
        self._skewing = skewing
        self._roller = roller
        self._window = window
        self._sums = np.zeros(4)
        self._before = np.zeros(3)
        self.by_sector = np.zeros((SECTORS, 1 + len(BY_SECTOR)))

    def add(self, steps: np.ndarray, j: int, places: np.ndarray) -> None:
        """Add the power of skew to the steps of one roller, in the buffer itself.

        The stages of the steps are at these places on the orbit.
        """
        roller = self._roller.body[0], self._roller.tables.ctypes.data
        totals = self._before, self._sums, self.by_sector
        _add(self._skewing[:2], roller, steps, j, places, self._window, totals)

    def turn(self, samples: np.ndarray) -> None:
        """Write the slip of the skewed roller into samples in which the rings press it."""
        at = samples["at"]
        states = self._states(at)
        pressed = at["elastic_load"] > 0.0
        samples["skewed"] = pressed
        skew, tilt, shift, more = states[pressed][:, [0, 1, 6, 7]].T
        for i, (name, raceway) in enumerate(zip(RACEWAYS, self._skewing.pair, strict=True)):
            speed = at[f"{name}_speed"][pressed]
            slip = at[f"{name}_slip"][pressed]
            middle = raceway.middle(tilt, shift)
            lines = slip_lines(raceway, speed, slip + more, skew, middle, tilt)
            samples["lines"][pressed, i] = np.stack([middle, *lines[:6]], axis=-1)

    @property
    def energy(self) -> np.ndarray:
        """Energy that skew adds at inner and outer raceway in the window [J], shape (2,)."""
        return self._sums[:2]

    @property
    def residual(self) -> float:
        """Largest unbalanced moment about the contact normal at equilibria in the window [N m]."""
        return float(self._sums[2])

    @property
    def stop_energy(self) -> float:
        """Energy of friction that stops add at the cage in the window [J]."""
        return float(self._sums[3])

    def traces(self, raw: np.ndarray) -> dict[str, np.ndarray]:
        """Traces by name, from states of `END`.

        Skew and tilt are NaN where the rings do not press the roller.
        """
        states = self._states(raw)
        names = ("skew_angle", "tilt", "axial_force")
        return dict(zip(names, states.T, strict=False)) | {
            "skew_moment": states[:, 3:5],
            "stop_force": states[:, 5],
        }

    def _states(self, raw: np.ndarray) -> np.ndarray:
        columns = (
            np.ascontiguousarray(raw[name]) for name in ("elastic_load", "outer_speed", "cage_load")
        )
        states = np.full((raw.size, 8), np.nan)
        _follow(self._skewing.table, self._skewing.guide, *columns, states)
        return states
