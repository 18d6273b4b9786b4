"""Record of a roller's step, as both solvers return it; all results follow from these."""

from __future__ import annotations

import numpy as np

from macroslip.compiled import jit_inline
from macroslip.mechanics.power import raceway_power

#: Most stages of a step.
STAGES = 3
_AT_STAGES = (STAGES,)
_BY_INTERFACE = (STAGES, 3)
_BY_RACEWAY = (STAGES, 2)

#: A step. Interfaces are in the order inner, outer, cage; arrays are over stages, of which the
#: first `stages` count and the last is the step's end. Signs as in `macroslip.mechanics`.
STEP = np.dtype(
    [
        ("start", "f8"),  # time [s]
        ("end", "f8"),  # time [s]
        ("stages", "i8"),  # number of stages
        # 1 where peaks of power between the stages stand in rows without weight before this one.
        ("sampled", "i8"),
        # Speed u2 of the raceways past a roller in pure rolling, at the end [m/s].
        ("pure_speed", "f8"),
        # Angle of the roller's centre ahead of its place in pure rolling, at the end [rad]; 0 on an
        # imposed orbit.
        ("ahead", "f8"),
        ("time", "f8", _AT_STAGES),  # of the stages [s]
        ("weight", "f8", _AT_STAGES),  # [s]; Σ weight · power is the energy of the step
        ("inner_slip", "f8", _AT_STAGES),  # Δu at the middle of the inner raceway's contact [m/s]
        ("outer_slip", "f8", _AT_STAGES),  # Δu at the middle of the outer raceway's contact [m/s]
        ("inner_speed", "f8", _AT_STAGES),  # u2 of the inner ring past the roller's centre [m/s]
        ("outer_speed", "f8", _AT_STAGES),  # u2 of the outer ring past the roller's centre [m/s]
        # Speed of the roller's surface past the cage, u1 relative to the spar [m/s].
        ("cage_speed", "f8", _AT_STAGES),
        # Normal load of the inner raceway, with body forces and films [N].
        ("inner_load", "f8", _AT_STAGES),
        # Normal load of the outer raceway, with body forces and films [N].
        ("outer_load", "f8", _AT_STAGES),
        ("elastic_load", "f8", _AT_STAGES),  # normal load of the rings alone [N]
        # F_n,cage with its sign [N], positive where the cage pushes the roller along the orbit.
        ("cage_load", "f8", _AT_STAGES),
        # F_i, F_o, F_c in the spin equation (16) without rolling resistance [N].
        ("force", "f8", _BY_INTERFACE),
        ("power", "f8", _BY_INTERFACE),  # frictional power (33) [W]
        ("rolling", "f8", _BY_INTERFACE),  # power of rolling resistance [W]
        ("rough", "f8", _BY_INTERFACE),  # part of the frictional power by asperities [W]
        ("lag_power", "f8", _BY_RACEWAY),  # part of the power by the contact's curvature [W]
        ("skew_power", "f8", _BY_RACEWAY),  # part of the power by the contact angle [W]
        ("power_before", "f8", (3,)),  # frictional power at the start [W]
        # Friction F_f of a tapered roller's rib [N]; 0 without one.
        ("rib_force", "f8", _AT_STAGES),
        ("rib_power", "f8", _AT_STAGES),  # power of the rib's friction [W]
        ("rib_rough", "f8", _AT_STAGES),  # part of that power by asperities [W]
    ]
)
#: Size of a buffer of steps [bytes].
BUFFER = 2**20


def new_steps() -> np.ndarray:
    """An empty buffer of steps of one roller, shape (steps, 1)."""
    return np.zeros((BUFFER // STEP.itemsize, 1), STEP)


@jit_inline
def write_stage(row, k, body, at, forces, slip, power):
    """Write one stage of a step on an imposed orbit, except its time.

    Parameters
    ----------
    row : record of `STEP`
        Written.
    k : int
        Number of the stage, 0 to `STAGES` − 1.
    body : record of `BODY`
        The roller.
    at : record
        Speed of the raceways [m/s] and normal loads [N] at this time.
    forces : record
        Tangential forces of the contacts, the cage's load, lags and rolling resistance [N], skew
        moments [N m] and powers of asperities and rolling resistance [W].
    slip : float
        Δu, the same at both raceways [m/s].
    power : ndarray, shape (3,)
        Frictional power of the contacts with inner raceway, outer raceway and cage [W].
    """
    row.pure_speed = at.ring_speed
    row.inner_slip[k] = slip
    row.outer_slip[k] = slip
    row.inner_speed[k] = at.ring_speed
    row.outer_speed[k] = at.ring_speed
    row.cage_speed[k] = at.ring_speed - slip
    row.inner_load[k] = at.inner_load
    row.outer_load[k] = at.outer_load
    row.elastic_load[k] = at.elastic_load
    row.cage_load[k] = forces.cage_load
    row.force[k, 0] = forces.inner - forces.rib_correction
    row.force[k, 1] = forces.outer + forces.rib_correction
    row.force[k, 2] = forces.cage
    for i in range(3):
        row.power[k, i] = power[i]
        row.rolling[k, i] = forces.rolling[i]
        row.rough[k, i] = forces.rough[i]
    row.rib_force[k] = forces.rib
    row.rib_power[k] = forces.rib_power
    row.rib_rough[k] = forces.rib_rough
    speed = at.ring_speed
    lag = forces.lag
    skew = forces.skew
    inner = raceway_power(body.inner, slip, speed, forces.inner, lag[0], skew[0])
    outer = raceway_power(body.outer, slip, speed, forces.outer, lag[1], skew[1])
    row.lag_power[k, 0] = inner.curvature
    row.lag_power[k, 1] = outer.curvature
    row.skew_power[k, 0] = inner.contact_spin
    row.skew_power[k, 1] = outer.contact_spin
