"""Force of skewed rollers on the inner ring, which acts beside its load in the balance."""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit
from macroslip.mechanics.loads import drag_force
from macroslip.ring.balance import RingGeometry, roller_loads
from macroslip.ring.orbit import Motion
from macroslip.roller.model import RollerModel
from macroslip.roller.skew_table import Guide, SkewTable, raceway_push, turned


@jit
def _forces(table, guides, ring, body, angle, speed, roller_load, forces):
    """Write the force of all skewed rollers on the inner ring at every sample [N].

    `body` is weight [N], drag coefficient [N s²] and u2/−Ω [m]; the downwind row is first.
    """
    weight, drag, radius = body
    for k in range(angle.size):
        orbit_speed = ring.orbit_ratio * speed[k]
        if orbit_speed == 0.0:
            continue
        loads = roller_load[k]
        turn = ring.orbit_ratio * angle[k]
        turn_cosine = math.cos(turn)
        turn_sine = math.sin(turn)
        for j in range(loads.size):
            if loads[j] == 0.0:
                continue
            guide = guides[0] if 2 * j < loads.size else guides[1]
            cosine = ring.cosine[j] * turn_cosine - ring.sine[j] * turn_sine
            sine = ring.sine[j] * turn_cosine + ring.cosine[j] * turn_sine
            push = weight * cosine + drag_force(drag, orbit_speed)
            push += raceway_push(table, loads[j], -orbit_speed * radius)
            axial = turned(table, guide, loads[j], -orbit_speed * radius, push).axial
            forces[k, 0] -= axial * ring.axial[j] * cosine
            forces[k, 1] -= axial * ring.axial[j] * sine
            forces[k, 2] += axial * ring.cos_contact_angle


def thrust(
    table: SkewTable,
    guides: tuple[Guide, Guide],
    ring: RingGeometry,
    model: RollerModel,
    motion: Motion,
) -> np.ndarray:
    """Force of all rollers on the inner ring by friction and turned normal forces.

    The rollers rest under the motion of the ring.

    Parameters
    ----------
    table : SkewTable
        Table of a skewed roller of the downwind row.
    guides : tuple of two Guide
        Of the downwind and the upwind row.
    ring : RingGeometry
        Angles of the rollers and the contact's geometry.
    model : RollerModel
        Of the downwind row.
    motion : Motion
        Of the inner ring over time, n samples.

    Returns
    -------
    ndarray, shape (n, 3)
        Along X0, Y0 and Z0 at the samples of the motion [N].

    Notes
    -----
    A spar presses as on a gripped roller: with weight, drag and what both raceways leave on it.
    """
    forces = np.zeros((motion.time.size, 3))
    body = (model.weight_in_plane, model.drag, model.outer_radius)
    _forces(
        table,
        guides,
        ring,
        body,
        motion.shaft_angle,
        motion.shaft_speed,
        roller_loads(ring, motion.shaft_angle, motion.displacement),
        forces,
    )
    return forces
