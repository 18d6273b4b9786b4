"""The integration of one roller on its imposed orbit, as a series of buffers of steps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from macroslip.contact.look_up import REST_SPEED
from macroslip.imposed import tuning
from macroslip.imposed.euler import FIXED_WORK, RULE, integrate_fixed_step
from macroslip.imposed.root import surely_rising
from macroslip.imposed.solve import integrate
from macroslip.imposed.state import LIMITS, WORK, path_of
from macroslip.imposed.status import UNDER_WAY
from macroslip.imposed.zones import classify, firm_approach
from macroslip.ring.orbit import Motion
from macroslip.roller.model import Roller
from macroslip.roller.step import new_steps


@dataclass
class Outcome:
    """Outcome of an integration: its status, its effort and where it ended."""

    status: int = UNDER_WAY  #: A `Status`
    steps: int = 0  #: Accepted steps
    rejections: int = 0  #: Rejected steps
    evaluations: int = 0  #: Evaluations of the forces
    unbalanced: float = 0.0  #: Largest unbalanced force of an accepted implicit step [N]
    time: float = 0.0  #: Time at which it ended [s]
    slip: float = 0.0  #: Slip at which it ended [m/s]


@dataclass(frozen=True)
class Problem:
    """Input of an integration that all rollers of a row share."""

    roller: Roller  #: With its tables
    motion: Motion  #: Of the inner ring
    limits: np.ndarray  #: Shape (1,). From `radau_limits` or `fixed_step`.
    #: Times at which a step must end [s], rising, the last being the end; not used at a fixed step.
    stops: np.ndarray = field(default_factory=lambda: np.zeros(0))


def radau_limits(
    roller: Roller,
    motion: Motion,
    *,
    tolerance: float,
    max_steps: int,
    heaviest: float,
    window: float,
    longest_turn: float = tuning.LONGEST_TURN,
) -> np.ndarray:
    """Tolerance and bounds of the Radau integrator for all rollers of a case.

    Parameters
    ----------
    roller : Roller
        A roller of either row.
    motion : Motion
        Of the inner ring.
    tolerance : float
        Relative tolerance of slip and energy, > 0 [-].
    max_steps : int
        Steps after which the integration gives up.
    heaviest : float
        Largest load of a roller with weight and centrifugal force [N].
    window : float
        Start of the window [s].
    longest_turn : float, optional
        Largest part of an orbit turned in one step [rad].

    Returns
    -------
    ndarray of `LIMITS`, shape (1,)
    """
    body = roller.body[0]
    tables = roller.tables
    fastest = body["orbit_ratio"] * np.abs(motion.shaft_speed).max()
    # A shaft at rest has no speed of its own by which an error of slip could be judged.
    speed = max(float(fastest * body["outer_radius"]), REST_SPEED)
    duration = float(motion.time[-1] - motion.time[0])
    longest = 0.1 * duration
    if fastest > 0.0:
        longest = min(longest, longest_turn / fastest)
    # By the closed form a ring that turns slower has its films end at less slip, which is evaluated
    # in every step.
    ring = 0.0 if body["closed_form"] else speed
    cold = surely_rising(body, tables, heaviest, heaviest, ring) if heaviest > 0.0 else np.inf
    firm = firm_approach(body, tables.ctypes.data, speed)
    energy = speed**2 / body["mobility"]
    grain = 0.0
    if not body["closed_form"]:
        # A film without heating may hold a roller at a slip of 1e-13 of the rings' speed.
        contacts = (body[name]["traction"] for name in ("inner", "outer"))
        widest = max(contact["scale"] / contact["ratio"]["per_spacing"] for contact in contacts)
        grain = tuning.PLACE_ROUNDING * widest * speed
    return np.array(
        [(tolerance, max_steps, speed, energy, longest, cold, firm, window, grain)], LIMITS
    )


def fixed_step(
    roller: Roller, motion: Motion, *, step: float, end: float, tolerance: float | None = None
) -> np.ndarray:
    """Settings of the Euler methods with a fixed step.

    Parameters
    ----------
    roller : Roller
    motion : Motion
        Of the inner ring.
    step : float
        Length of a step, > 0 [s].
    end : float
        End of the integration [s].
    tolerance : float, optional
        Relative change of spin at which the iteration of backward Euler stops [-]; explicit Euler
        without it.

    Returns
    -------
    ndarray of `RULE`, shape (1,)
    """
    body = roller.body[0]
    speeds = motion.shaft_speed * body["orbit_ratio"] * body["outer_radius"]
    fastest = max(speeds.max(), 0.0)
    slowest = min(speeds.min(), 0.0)
    largest = 1.01 * float(fastest - slowest) + 1e-9
    return np.array([(step, tolerance is not None, tolerance or 0.0, largest, end)], RULE)


def steps_of(problem: Problem, start_angle: float, outcome: Outcome) -> Iterator[np.ndarray]:
    """Integrate one roller from pure rolling on.

    Yields steps that follow one another, arrays of `STEP` of shape (n, 1), in a buffer that the
    next ones overwrite. The first sample has the roller at φ = `start_angle` [rad]; `outcome` is
    filled when the last buffer has been given.
    """
    motion = problem.motion
    limits = problem.limits[0]
    body = problem.roller.body[0]
    path = path_of(problem.roller, motion, start_angle, limits)
    steps = new_steps()
    classes = np.empty(motion.time.size - 1, dtype=np.int8)
    radau = problem.limits.dtype == LIMITS
    work = np.zeros(1, WORK if radau else FIXED_WORK)
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
    sums = work[0]["sums"]
    outcome.status = status
    outcome.steps = int(sums["steps"])
    outcome.rejections = int(sums["rejections"])
    outcome.evaluations = int(sums["evaluations"])
    outcome.unbalanced = float(sums["unbalanced"])
    outcome.time = float(work[0]["now"]["time"])
    outcome.slip = float(work[0]["now"]["slip"])
