"""Records of the integration of one roller on its imposed orbit, and how they are filled."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from macroslip.compiled import address_of, call_at, jit_inline
from macroslip.mechanics.spin import CONDITIONS, FORCES, powers, slip_forces, write_conditions
from macroslip.ring.orbit import Instant, Motion, instant
from macroslip.roller.model import BODY, Roller
from macroslip.roller.step import write_stage


class Path(NamedTuple):
    """A roller on its orbit: its numbers, tables, the ring's motion and integration settings."""

    body: Any  #: Record of a roller
    #: Addresses of `write_conditions` and `slip_forces`: most machine code would else be copies of
    #: them.
    conditions: int
    forces: int
    #: Address of the flat array of its tables: an array would be counted at every look-up
    tables: int
    flat: np.ndarray  #: The array itself
    motion: Any  #: `macroslip.ring.orbit.Motion` of the inner ring
    start_angle: float  #: Position φ at the first sample [rad]
    limits: Any  #: Record of `LIMITS`, or of `macroslip.imposed.euler.RULE`


#: Tolerance and bounds of the integration, the same for all rollers of a case.
LIMITS = np.dtype(
    [
        # Relative tolerance, of slip against the raceway speed and of energy per step [-].
        ("tolerance", "f8"),
        # Steps after which the integration gives up.
        ("max_steps", "i8"),
        # Largest raceway speed |u2| of the history [m/s].
        ("speed_scale", "f8"),
        # Twice the kinetic energy of a roller's spin at that speed, I_z' u2²/r² [J].
        ("energy_scale", "f8"),
        # Length of the longest step [s].
        ("longest_step", "f8"),
        # Slip below which traction rises with slip at every load of the history [m/s].
        ("cold_slip", "f8"),
        # Elastic approach from which on the roller is firmly held [m].
        ("firm", "f8"),
        # Start of the window [s].
        ("window", "f8"),
        # Change of a slip near zero that does not change its position in a table [m/s]; 0 without
        # tables of traction.
        ("grain", "f8"),
    ]
)

#: State of the roller.
STATE = np.dtype(
    [
        ("time", "f8"),  # [s]
        ("interval", "i8"),  # index of the sample interval that holds it
        ("slip", "f8"),  # Δu [m/s]
        ("at", CONDITIONS),  # loads and speeds
        ("forces", FORCES),  # tangential forces
        ("powers", "f8", (3,)),  # frictional powers of the interfaces [W]
    ]
)
#: A step that is tried, and its solution.
ATTEMPT = np.dtype(
    [
        ("length", "f8"),  # length of the step [s]
        ("scale", "f8"),  # 1/(h r²/I_z') [N s/m]
        ("end_interval", "i8"),  # index of the sample interval in which it ends
        # 1 where the step has two stages, at its middle and end, beside its start (a held step).
        ("held", "i8"),
        ("times", "f8", (3,)),  # of its stages [s]
        ("weights", "f8", (3,)),  # of its stages, as parts of the step [-]
        ("at", CONDITIONS, (3,)),  # loads and speeds at its stages
        ("slip", "f8", (3,)),  # Δu at its stages [m/s]
        # Increments of slip by forces, s = v − v0 − (u2 − u2_0) [m/s].
        ("increment", "f8", (3,)),
        ("forces", FORCES, (3,)),  # tangential forces at its stages
        # Residual that the last correction leaves at a stage, as foreseen [N]; and 1 where that is too
        # much, so that its forces are evaluated anew.
        ("left", "f8", (3,)),
        ("stale", "i8", (3,)),
        ("unbalanced", "f8"),  # largest force left unbalanced at a stage [N]
        ("powers", "f8", (3, 3)),  # by stage and interface [W]
        # Sums of the powers over the interfaces, at the start and at the stages [W].
        ("totals", "f8", (4,)),
        ("energy", "f8"),  # frictional energy of the step [J]
    ]
)
#: A sample between the stages of a step.
STEP_SAMPLE = np.dtype(
    [
        ("at", CONDITIONS),  # loads and speeds
        ("slip", "f8"),  # Δu [m/s]
        ("rate", "f8"),  # derivative of the increment of slip by the part of the step [m/s]
        ("forces", FORCES),  # tangential forces
        ("powers", "f8", (3,)),  # of the interfaces [W]
    ]
)
#: Numbers of the steps before, from which guesses for the next one are made.
BEFORE = np.dtype(
    [
        ("exponent", "f8"),  # power of the load that the slip of a held roller follows [-]
        # Residual left by Newton's correction over stiffness and squared correction [s/m]; infinite
        # while it is not known.
        ("bend", "f8"),
        # Length of the last step of three stages [s]; 0 where a held one has come since.
        ("length", "f8"),
        ("increment", "f8", (3,)),  # increments of slip of the last step [m/s]
    ]
)
#: A stretch of sample intervals of one class, and the step to try in it.
STRETCH = np.dtype(
    [
        ("step", "f8"),  # length of the step to try next [s]
        ("barrier", "f8"),  # time at which a step must end [s]
        ("zone", "i8"),  # class of the sample interval; −1 before the first
        # Index of the last of the sample intervals of this class that follow one another.
        ("run_end", "i8"),
        ("next_stop", "i8"),  # index of the first stop ahead
        ("sample_step", "f8"),  # length of the sample interval [s]
        ("failed", "i8"),  # 1 where the last attempt was rejected
    ]
)
#: Running totals of one integration.
SUMS = np.dtype(
    [
        ("begun", "i8"),  # 1 where the integration has begun
        ("steps", "i8"),  # accepted steps
        ("rejections", "i8"),  # rejected steps
        ("evaluations", "i8"),  # evaluations of the forces
        ("unbalanced", "f8"),  # largest force left unbalanced by an accepted step [N]
        ("spent", "f8"),  # energy [J]; in the window from there on
        ("top_power", "f8"),  # largest raceway power since the roller had no load [W]
    ]
)
#: Mutable state of one integration, from which the next call goes on.
WORK = np.dtype(
    [
        ("now", STATE),  # state of the roller
        ("attempt", ATTEMPT),  # step that is tried
        ("sample", STEP_SAMPLE),  # sample between the stages of a step
        ("before", BEFORE),  # numbers of the steps before
        ("stretch", STRETCH),  # stretch of sample intervals of one class
        ("sums", SUMS),  # running totals
    ]
)


def path_of(roller: Roller, motion: Motion, start_angle: float, limits: Any) -> Path:
    """Record of a roller on its orbit for the integrator.

    Parameters
    ----------
    roller : macroslip.roller.model.Roller
    motion : macroslip.ring.orbit.Motion
        Of the inner ring.
    start_angle : float
        Position φ at the first sample [rad].
    limits : record of `LIMITS`, or of `macroslip.imposed.euler.RULE`

    Returns
    -------
    Path
    """
    tables = roller.tables
    return Path(
        roller.body[0],
        address_of(write_conditions, BODY, int, float, Instant, CONDITIONS),
        address_of(slip_forces, BODY, int, CONDITIONS, float, FORCES),
        tables.ctypes.data,
        tables,
        motion,
        float(start_angle),
        limits,
    )


@jit_inline
def locate(path, time, interval, at):
    """Write loads and speeds of the roller at a time.

    Parameters
    ----------
    path : Path
    time : float
        [s]
    interval : int
        Index of the sample interval that holds the time.
    at : record of `macroslip.mechanics.spin.CONDITIONS`
        Is written; its film balance is where the search for the new one begins.
    """
    now = instant(path.motion, interval, time)
    call_at(path.conditions, (path.body, path.tables, path.start_angle, now, at))  # pyright: ignore[reportCallIssue]


@jit_inline
def evaluate(path, at, slip, forces):
    """Write the tangential forces on the roller at given loads, speeds and slip.

    Parameters
    ----------
    path : Path
    at : record of `macroslip.mechanics.spin.CONDITIONS`
    slip : float
        Δu at both raceways [m/s].
    forces : record of `macroslip.mechanics.spin.FORCES`
        Is written.
    """
    call_at(path.forces, (path.body, path.tables, at, slip, forces))  # pyright: ignore[reportCallIssue]


@jit_inline
def start_at(path, now, sums):
    """Write conditions, forces and powers of the roller at its time and slip; count the evaluation."""
    locate(path, now.time, now.interval, now.at)
    evaluate(path, now.at, now.slip, now.forces)
    powers(path.body, now.at, now.forces, now.slip, now.powers[:])
    sums.evaluations += 1


@jit_inline
def frame(now, row, stages, end):
    """Write the start, end and number of stages of a row of steps.

    Parameters
    ----------
    now : record of `STATE`
        State at the start of the step.
    row : record of `macroslip.roller.step.STEP`
        Is written.
    stages : int
        Number of stages of the row, 1 to 3.
    end : float
        End of the step [s].
    """
    row.start = now.time
    row.end = end
    row.stages = stages
    row.sampled = 0
    for i in range(3):
        row.power_before[i] = now.powers[i]


@jit_inline
def write_point(path, now, row):
    """Write the present state of the roller as a row of steps without weight.

    Parameters
    ----------
    path : macroslip.imposed.state.Path
    now : record of `STATE`
    row : record of `macroslip.roller.step.STEP`
        Is written.
    """
    frame(now, row, 1, now.time)
    row.time[0] = now.time
    row.weight[0] = 0.0
    row.sampled = 1
    write_stage(row, 0, path.body, now.at, now.forces, now.slip, now.powers[:])
