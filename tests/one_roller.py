"""One roller of the base bearing without a case around it: its tables, what it meets, its forces, and its way."""

from __future__ import annotations

import math

import numpy as np

from macroslip import Bearing, Laws, Lubricant
from macroslip.bearing.geometry import AXIAL_SIGNS, ROWS
from macroslip.compiled import address_of, call_at, jit
from macroslip.contact.table import table_box
from macroslip.imposed.euler import FIXED_WORK, integrate_fixed_step
from macroslip.imposed.run import radau_limits
from macroslip.imposed.solve import integrate
from macroslip.imposed.state import LIMITS, WORK, path_of
from macroslip.imposed.status import UNDER_WAY
from macroslip.imposed.zones import classify
from macroslip.mechanics.spin import CONDITIONS, FORCES, powers, slip_forces, write_conditions
from macroslip.ring.orbit import Instant, Motion, shaft_angle
from macroslip.roller.model import BODY, Roller, RollerModel, roller_model, with_tables
from macroslip.roller.step import STAGES, STEP

BEARING, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
RATED = 20.463 * 2.0 * math.pi / 60.0
#: u2 at rated speed [m/s].
RING_SPEED = -0.39594
TILT = math.radians(5.0)


def models(laws: Laws, oil: Lubricant = OIL, **choices) -> dict[str, RollerModel]:
    """Rollers of both rows."""
    return {
        row: roller_model(BEARING, oil, AXIAL_SIGNS[row], laws=laws, **{"tilt": TILT} | choices)
        for row in ROWS
    }


def rollers(
    made: dict[str, RollerModel],
    *,
    load: float = 1.2e5,
    speeds=(-0.4, 0.4),
    tolerance: float = 2e-4,
) -> dict[str, Roller]:
    """The same with tables for loads [N] and raceway speeds [m/s] up to the given ones."""
    return with_tables(made, table_box(np.asarray(speeds, float), load, tolerance))[0]


def station_of(roller: Roller, angle: float, now: Instant) -> np.void:
    """A place on the orbit [rad] and an instant."""
    conditions = np.zeros(1, CONDITIONS)
    write_conditions(roller.body[0], roller.tables.ctypes.data, angle, now, conditions[0])
    return conditions[0]


def a_station(
    load: float, extra_outer: float = 0.0, tangential: float = -25.0, ring_speed: float = RING_SPEED
):
    """Conditions made up [N], [m/s]."""
    conditions = np.zeros(1, CONDITIONS)
    conditions["ring_speed"] = ring_speed
    conditions["approach"] = 1e-5
    conditions["elastic_load"] = load
    conditions["inner_load"] = load
    conditions["outer_load"] = load + extra_outer
    conditions["tangential"] = tangential
    for name in ("inner", "outer"):
        pressed = max(conditions[f"{name}_load"][0], 1e-12)
        conditions[f"log_{name}_load"] = math.log(pressed)
        conditions[f"root_{name}_load"] = pressed ** (1.0 / 3.0)
    return conditions[0]


@jit
def _write_forces(address, body, tables, at, slip, forces):
    """Write the forces by the function at an address."""
    call_at(address, (body, tables, at, slip, forces))


def forces_of(roller: Roller, at: np.void, slip: float) -> np.void:
    """Forces under conditions and a slip [m/s], by the compiled function that integrations call.

    Called by its name it would be compiled once more, which takes seconds in every worker.
    """
    address = address_of(slip_forces, BODY, int, CONDITIONS, float, FORCES)
    forces = np.zeros(1, FORCES)
    _write_forces(address, roller.body[0], roller.tables.ctypes.data, at, float(slip), forces[0])
    return forces[0]


def powers_of(roller: Roller, at: np.void, forces: np.void, slip: float) -> np.ndarray:
    """Frictional powers of inner, outer and cage interface [W]."""
    power = np.zeros(3)
    powers(roller.body[0], at, forces, float(slip), power)
    return power


def net(forces: np.void) -> float:
    """F_i + F_o + F_c with rolling resistance [N]."""
    return float(forces["inner"] + forces["outer"] + forces["cage"] + forces["resistance"])


def motion_of(time, speed, displacement) -> Motion:
    """The ring's motion from samples; one displacement serves for all of them."""
    time = np.asarray(time, float)
    speed = np.broadcast_to(np.asarray(speed, float), time.shape).copy()
    return Motion(
        time,
        speed,
        shaft_angle(time, speed),
        np.broadcast_to(np.asarray(displacement, float), (time.size, 3)).copy(),
    )


def limits_of(
    roller: Roller,
    motion: Motion,
    tolerance: float,
    *,
    heaviest: float = 1e5,
    max_steps: int = 10**6,
):
    """Bounds of the Radau integrator; its window is the whole history."""
    return radau_limits(
        roller,
        motion,
        tolerance=tolerance,
        max_steps=max_steps,
        heaviest=heaviest,
        window=float(motion.time[0]),
    )


def walk(
    roller: Roller,
    motion: Motion,
    limits,
    stops,
    angle: float,
    *,
    slip: float = 0.0,
    rows: int = 1000,
):
    """All steps of the roller from a slip [m/s] on, in buffers of so many rows, and its status and record of work."""
    path = path_of(roller, motion, angle, limits[0])
    work = np.zeros(1, WORK if limits.dtype == LIMITS else FIXED_WORK)
    classes, buffers = np.zeros(motion.time.size - 1, np.int8), []
    work["now"]["slip"], buffer, status = slip, np.zeros(rows, STEP), UNDER_WAY
    if limits.dtype == LIMITS:
        classify(roller.body[0], motion, float(angle), limits["firm"][0], classes)
    while status == UNDER_WAY:
        if limits.dtype == LIMITS:
            status, count = integrate(path, np.asarray(stops, float), classes, work[0], buffer)
        else:
            status, count = integrate_fixed_step(path, work[0], buffer)
        buffers.append(buffer[:count].copy())
    steps = np.concatenate(buffers)
    # Beyond its stages a row holds what was there before.
    unused = np.arange(STAGES) >= steps["stages"][:, None]
    for name in STEP.names:
        if steps[name].ndim > 1 and name != "power_before":
            steps[name][unused] = 0.0
    return steps, int(status), work[0]


def energies(steps: np.ndarray) -> np.ndarray:
    """Energy of inner, outer and cage interface [J]."""
    return (steps["weight"][..., None] * steps["power"]).sum(axis=(0, 1))


def end_slips(steps: np.ndarray, times) -> np.ndarray:
    """Slips at the ends of the steps that end at these times [m/s]."""
    rows = steps[np.isin(steps["end"], times) & (steps["weight"][:, 0] > 0.0)]
    return rows["outer_slip"][np.arange(rows.size), rows["stages"] - 1]
