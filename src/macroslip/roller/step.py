"""A step of a roller, as every solver returns it: all that a result holds is computed from these."""

from __future__ import annotations

import numpy as np

from macroslip.compiled import jit_inline

#: Most stages of a step.
STAGES = 3
_AT_STAGES = (STAGES,)
_BY_INTERFACE = (STAGES, 3)
_BY_RACEWAY = (STAGES, 2)

#: A step. Interfaces are in the order inner, outer, cage; arrays are over stages, of which the first `stages` count and the last
#: is the step's end. Signs as in `macroslip.mechanics`.
#:
#: start, end : times [s]
#: stages : number of stages
#: stretch : number of the stretch of smooth loads it lies in; no parabola reaches from one to the next
#: sampled : 1 where peaks of power between the stages stand in rows without weight before this one
#: pure_speed : speed u2 of the raceways past a roller in pure rolling, at the end [m/s]
#: ahead : angle of the roller's centre ahead of its place in pure rolling, at the end [rad]; 0 on an imposed orbit
#: time, weight : of the stages [s]; Σ weight · power is the energy of the step
#: inner_slip, outer_slip : Δu at the middle of the raceway contacts [m/s]
#: inner_speed, outer_speed : u2 of the rings past the roller's centre [m/s]
#: cage_speed : speed of the roller's surface past the cage, u1 relative to the spar [m/s]
#: inner_load, outer_load, elastic_load : normal loads with body forces and films, and the rings' alone [N]
#: cage_load : F_n,cage with its sign [N], positive where the cage pushes the roller along the orbit
#: force : F_i, F_o, F_c in the spin equation without rolling resistance [N]
#: power : frictional power (33) [W]
#: rolling : power of rolling resistance [W]
#: rough : part of the frictional power that asperities dissipate [W]
#: lag_power, skew_power : parts of the raceways' power by the contact's curvature and by the contact angle [W]
#: power_before : frictional power at the start [W]
STEP = np.dtype(
    [
        ("start", "f8"), ("end", "f8"), ("stages", "i8"), ("stretch", "i8"), ("sampled", "i8"),
        ("pure_speed", "f8"), ("ahead", "f8"),
        ("time", "f8", _AT_STAGES), ("weight", "f8", _AT_STAGES),
        ("inner_slip", "f8", _AT_STAGES), ("outer_slip", "f8", _AT_STAGES),
        ("inner_speed", "f8", _AT_STAGES), ("outer_speed", "f8", _AT_STAGES), ("cage_speed", "f8", _AT_STAGES),
        ("inner_load", "f8", _AT_STAGES), ("outer_load", "f8", _AT_STAGES), ("elastic_load", "f8", _AT_STAGES),
        ("cage_load", "f8", _AT_STAGES),
        ("force", "f8", _BY_INTERFACE), ("power", "f8", _BY_INTERFACE), ("rolling", "f8", _BY_INTERFACE),
        ("rough", "f8", _BY_INTERFACE), ("lag_power", "f8", _BY_RACEWAY), ("skew_power", "f8", _BY_RACEWAY),
        ("power_before", "f8", (3,)),
    ]
)  # fmt: skip
#: Size of a buffer of steps [bytes].
BUFFER = 2**20


def new_steps() -> np.ndarray:
    """An empty buffer of steps of one roller, shape (steps, 1)."""
    return np.zeros((BUFFER // STEP.itemsize, 1), STEP)


@jit_inline
def write_stage(row, k, body, at, forces, slip, power):
    """Write stage `k` of a step on an imposed orbit but for its time: station, forces, slip [m/s] and powers [W]."""
    row.pure_speed = at.ring_speed
    row.inner_slip[k] = row.outer_slip[k] = slip
    row.inner_speed[k] = row.outer_speed[k] = at.ring_speed
    row.cage_speed[k] = at.ring_speed - slip
    row.inner_load[k] = at.inner_load
    row.outer_load[k] = at.outer_load
    row.elastic_load[k] = at.elastic_load
    row.cage_load[k] = forces.cage_load
    row.force[k, 0] = forces.inner
    row.force[k, 1] = forces.outer
    row.force[k, 2] = forces.cage
    for i in range(3):
        row.power[k, i] = power[i]
        row.rolling[k, i] = forces.rolling[i]
        row.rough[k, i] = forces.rough[i]
    row.lag_power[k, 0] = at.ring_speed * body.inner.curvature * forces.lag[0]
    row.lag_power[k, 1] = at.ring_speed * body.outer.curvature * forces.lag[1]
    row.skew_power[k, 0] = -at.ring_speed * body.inner.spin * forces.skew[0]
    row.skew_power[k, 1] = -at.ring_speed * body.outer.spin * forces.skew[1]
