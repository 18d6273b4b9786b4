"""The integration of one roller on its imposed orbit, as a series of buffers of steps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from macroslip.contact.look_up import REST_SPEED
from macroslip.imposed.euler import RULE, integrate_fixed_step
from macroslip.imposed.radau import LIMITS, WORK, Path, surely_rising
from macroslip.imposed.solve import integrate
from macroslip.imposed.status import COMPLETED, UNDER_WAY
from macroslip.imposed.tuning import LONGEST_TURN
from macroslip.imposed.zones import classify, firm_interference
from macroslip.ring.orbit import Motion
from macroslip.roller.model import Roller
from macroslip.roller.step import new_steps


@dataclass
class Outcome:
    """How an integration went.

    Attributes
    ----------
    status : int
        A `Status`.
    steps, rejections, evaluations : int
    unbalanced : float
        Largest force left unbalanced by an accepted implicit step [N].
    time, slip : float
        At which it ended [s], [m/s].
    """

    status: int = UNDER_WAY
    steps: int = 0
    rejections: int = 0
    evaluations: int = 0
    unbalanced: float = 0.0
    time: float = 0.0
    slip: float = 0.0


@dataclass(frozen=True)
class Problem:
    """Numbers common to all rollers of a row.

    Attributes
    ----------
    roller : Roller
    motion : Motion
        Of the inner ring.
    limits : ndarray of `LIMITS` or `RULE`, shape (1,)
        From `radau_limits` or `fixed_step`.
    stops : ndarray
        Times at which a step must end [s], rising, the last being the end; not used at a fixed step.
    """

    roller: Roller
    motion: Motion
    limits: np.ndarray
    stops: np.ndarray = field(default_factory=lambda: np.zeros(0))


def highest_speed(motion: Motion, body: Any) -> float:
    """Largest raceway speed |u2| of the history [m/s]."""
    return float(np.max(np.abs(motion.shaft_speed)) * body["orbit_ratio"] * body["outer_radius"])


def longest_step(motion: Motion, orbit_ratio: float) -> float:
    """Longest step [s]: a fraction of an orbit at the highest speed, or a tenth of the history if the shaft hardly turns."""
    span = float(motion.time[-1] - motion.time[0])
    fastest = abs(orbit_ratio) * float(np.max(np.abs(motion.shaft_speed)))
    return min(0.1 * span, LONGEST_TURN / fastest) if fastest > 0.0 else 0.1 * span


def radau_limits(
    roller: Roller, motion: Motion, *, tolerance: float, max_steps: int, heaviest: float, window: float
) -> np.ndarray:
    """Bounds of the Radau integrator that hold for all rollers of a case.

    Parameters
    ----------
    roller : Roller
        Of either row.
    motion : Motion
    tolerance : float
        Relative tolerance of slip and energy.
    max_steps : int
    heaviest : float
        Largest load of a roller with weight and centrifugal force [N].
    window : float
        Start of the window [s].
    """
    body, tables = roller.body[0], roller.tables
    # A shaft at rest has no speed of its own by which an error of slip could be judged.
    speed = max(highest_speed(motion, body), REST_SPEED)
    found = np.zeros(1, LIMITS)
    found[0] = (
        tolerance,
        max_steps,
        speed,
        speed**2 / body["mobility"],
        longest_step(motion, float(body["orbit_ratio"])),
        surely_rising(body, tables, heaviest, heaviest, speed) if heaviest > 0.0 else np.inf,
        firm_interference(body, tables.ctypes.data, speed),
        window,
    )
    return found


def fixed_step(
    roller: Roller, motion: Motion, *, step: float, end: float, tolerance: float | None = None
) -> np.ndarray:
    """Rule of the Euler methods with this step [s] up to `end` [s]: backward Euler if it has a tolerance."""
    body = roller.body[0]
    speeds = motion.shaft_speed * body["orbit_ratio"] * body["outer_radius"]
    largest = 1.01 * float(max(speeds.max(), 0.0) - min(speeds.min(), 0.0)) + 1e-9
    found = np.zeros(1, RULE)
    found[0] = (step, tolerance is not None, tolerance or 0.0, largest, end)
    return found


def steps_of(problem: Problem, start_angle: float, outcome: Outcome) -> Iterator[np.ndarray]:
    """Integrate one roller from pure rolling on.

    Parameters
    ----------
    problem : Problem
    start_angle : float
        Position φ at the first sample [rad].
    outcome : Outcome
        Filled when the last buffer has been given.

    Yields
    ------
    ndarray of `STEP`, shape (n, 1)
        Steps that follow one another, in a buffer that the next ones overwrite.
    """
    motion, limits, body = problem.motion, problem.limits[0], problem.roller.body[0]
    tables = problem.roller.tables
    path = Path(body, tables.ctypes.data, tables, motion, float(start_angle), limits)
    work, steps = np.zeros(1, WORK), new_steps()
    classes = np.empty(motion.time.size - 1, dtype=np.int8)
    radau = problem.limits.dtype == LIMITS
    if radau:
        classify(body, motion, start_angle, limits["firm"], classes)
    status = UNDER_WAY
    while status == UNDER_WAY:
        if radau:
            status, count = integrate(path, problem.stops, classes, work[0], steps[:, 0])
        else:
            status, count = integrate_fixed_step(path, work[0], steps[:, 0])
        if count:
            yield steps[:count]
    last = work[0]
    outcome.status = status
    outcome.steps, outcome.rejections, outcome.evaluations = (int(one) for one in last["count"])
    outcome.unbalanced, outcome.time, outcome.slip = float(last["unbalanced"]), float(last["time"]), float(last["slip"])
    if status == COMPLETED and not radau:
        outcome.rejections = 0
