"""The fixed set of histories on which rivals are compared: one roller each, on short stretches of the bundled cases."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from macroslip.bearing.geometry import ROWS, initial_angles
from macroslip.case.case import Case
from macroslip.compiled import jit
from macroslip.contact.mechanisms import Laws
from macroslip.imposed.run import radau_limits
from macroslip.imposed.zones import EDGE, approach_at, classify, edge_time
from macroslip.loads import HubLoads, bundled_cases
from macroslip.result.prepared import prepare
from macroslip.ring.orbit import Motion
from macroslip.roller.model import Roller, RollerModel, with_tables

#: Cases, first second and length of the stretches [s], for the full and for the quick run; every case gives both rows.
FULL = (("12A", "14B", "24A"), 100.0, 30.0)
QUICK = (("14B",), 100.0, 20.0)
#: Shortest coast that has a middle worth comparing, and longest stretch of a coast that one mark stands for [s].
_SHORTEST_COAST, _LONGEST_STRETCH = 0.1, 5.0


class History(NamedTuple):
    """One roller under one stretch of load, starting at pure rolling.

    Attributes
    ----------
    name : str
        Case, row and length.
    model : RollerModel
    roller : Roller
        The same, as compiled functions take it.
    motion : Motion
    start_angle : float
        Position φ at the first sample [rad].
    limits : ndarray of `macroslip.imposed.state.LIMITS`, shape (1,)
        Of the production integrator, at its default tolerance.
    edges : ndarray
        Times at which elastic load begins or ends [s], rising.
    marks : ndarray
        Middles of the coasts [s], at which spin is compared; a long coast has one every few seconds.
    """

    name: str
    model: RollerModel
    roller: Roller
    motion: Motion
    start_angle: float
    limits: np.ndarray
    edges: np.ndarray
    marks: np.ndarray

    @property
    def start(self) -> float:
        """First time [s]."""
        return float(self.motion.time[0])

    @property
    def end(self) -> float:
        """Last time [s]."""
        return float(self.motion.time[-1])


def fixed_histories(*, quick: bool) -> list[History]:
    """The histories of the comparison: six of 30 s, or two of 20 s in the quick run."""
    cases, start, length = QUICK if quick else FULL
    histories = []
    for number, name in enumerate(cases):
        histories += histories_of(name, start, start + length, [7 * number])
    return histories


def long_histories(*, quick: bool, laws: Laws = Laws.paper()) -> list[History]:
    """All 21 cases over their 600 s, one roller of each row; in the quick run the one case of the comparison."""
    names = bundled_cases()
    chosen = [(number, name) for number, name in enumerate(names) if not quick or name in QUICK[0]]
    return [
        history
        for number, name in chosen
        for history in histories_of(name, None, None, [7 * number % 28], laws)
    ]


def histories_of(
    name: str,
    start: float | None,
    end: float | None,
    rollers: Sequence[int],
    laws: Laws = Laws.paper(),
) -> list[History]:
    """Some rollers of each row under part of a bundled case.

    Parameters
    ----------
    name : str
        Of the bundled case.
    start, end : float or None
        First and last time [s]; None is the history's own.
    rollers : sequence of int
        Numbers in the row.
    laws : Laws
        Mechanisms in the contacts.

    Returns
    -------
    list of History
        Row by row, in the order of `macroslip.bearing.geometry.ROWS`.

    Raises
    ------
    InputError
        If there is no such case, or the times lie outside it.
    """
    case = Case(loads=HubLoads.bundled(name).window(start, end), laws=laws)
    ready = prepare(case)
    motion, (made, _) = ready.motion, with_tables(ready.models, ready.box)
    histories = []
    length = motion.time[-1] - motion.time[0]
    for row in ROWS:
        roller = made[row]
        limits = radau_limits(
            roller,
            motion,
            tolerance=case.integrator.tolerance,
            max_steps=case.integrator.max_steps,
            heaviest=ready.heaviest,
            window=float(motion.time[0]),
        )
        for number in rollers:
            angle = float(initial_angles(row, case.bearing.rollers_per_row)[number])
            edges = load_edges(roller, motion, angle)
            marks = _coast_middles(roller, motion, angle, edges)
            title = f"{name} {row}, roller {number}, {length:g} s"
            histories.append(
                History(title, ready.models[row], roller, motion, angle, limits, edges, marks)
            )
    return histories


@jit
def _approach(body, motion, start_angle, interval, time):
    return approach_at(body, motion, start_angle, interval, time)


def load_edges(roller: Roller, motion: Motion, start_angle: float) -> np.ndarray:
    """Times at which the rings begin or cease to press on a roller [s], rising.

    They follow from the loads alone, so that any integrator can be told of them beforehand.
    """
    body, classes = roller.body[0], np.empty(motion.time.size - 1, np.int8)
    classify(body, motion, start_angle, np.inf, classes)
    edges = []
    for k in np.flatnonzero(classes == EDGE):
        low, high = motion.time[k], motion.time[k + 1]
        ends = [_approach(body, motion, start_angle, k, time) for time in (low, high)]
        if ends[0] * ends[1] < 0.0:
            edges.append(edge_time(body, motion, start_angle, k, low, high))
    return np.array(edges)


def _coast_middles(
    roller: Roller, motion: Motion, start_angle: float, edges: np.ndarray
) -> np.ndarray:
    bounds = np.concatenate([[motion.time[0]], edges, [motion.time[-1]]])
    middles = []
    for low, high in itertools.pairwise(bounds):
        middle = 0.5 * (low + high)
        interval = int(np.searchsorted(motion.time, middle, side="right")) - 1
        free = _approach(roller.body[0], motion, start_angle, interval, middle) < 0.0
        if free and high - low > _SHORTEST_COAST:
            parts = int(np.ceil((high - low) / _LONGEST_STRETCH))
            middles += [low + (high - low) * (part + 0.5) / parts for part in range(parts)]
    return np.array(middles)
