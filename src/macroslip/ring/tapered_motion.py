"""Motion of the inner ring of a tapered roller bearing, and of every roller's own load, over time.

The balance of the ring gives the load of every roller at the samples of a history. The solver of
slip knows one law, Q = K δ^1.5 along a roller's normal: it gets for every roller a motion of the ring
along Z0 that presses this one roller with its load, or leaves it its play. Between samples that
approach is linear in time.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.errors import MacroslipError
from macroslip.loads.history import BearingLoads
from macroslip.ring.motion import finely_sampled
from macroslip.ring.orbit import Motion, shaft_angle
from macroslip.ring.tapered import TaperedBalance, TaperedRing, ring_at_rollers, tapered_balance


class TaperedMotion(NamedTuple):
    """Motion of the ring and loads of all rollers of both rows at its samples."""

    motion: Motion  #: Of the inner ring's middle, without its tilt
    balance: TaperedBalance  #: Displacements and forces at the samples
    #: Shape (n, rollers). Play of rollers without load along their contact normal, ≥ 0 [m]
    play: np.ndarray
    ring: TaperedRing  #: Geometry and stiffness of the bearing


def tapered_motion(loads: BearingLoads, moment: np.ndarray, ring: TaperedRing) -> TaperedMotion:
    """Balance of the ring at samples that are close enough for the rollers' way between them.

    Parameters
    ----------
    loads : BearingLoads
        Force on the inner ring and its speed, n samples.
    moment : ndarray, shape (n, 2)
        Moments on the inner ring about X0 and Y0 [N m].
    ring : TaperedRing

    Returns
    -------
    TaperedMotion

    Raises
    ------
    MacroslipError
        If a balance was not found.
    """
    time, speed = finely_sampled(loads, ring.orbit_ratio, ring.sign.size // 2)
    angle = shaft_angle(time, speed)
    force, moment = (
        np.column_stack([np.interp(time, loads.time, component) for component in values.T])
        for values in (loads.force, moment)
    )
    balance = tapered_balance(ring, angle, force, moment)
    failed = np.flatnonzero(~balance.is_converged(ring, force, moment))
    if failed.size:
        worst = int(failed[0])
        raise MacroslipError(
            f"{loads.source}, t = {time[worst]:g} s: the ring balance did not converge, "
            f"{balance.unbalanced[worst]:g} N of the load {force[worst]} N are unbalanced. This is a "
            "defect of the solver; please report it with the bearing and this load."
        )
    normal = ring_at_rollers(ring, balance.displacement, angle)
    gap = ring.inner_radial * normal[..., 0] + ring.inner_axial * normal[..., 1]
    play = np.where(balance.outer_load > 0.0, 0.0, np.maximum(-gap, 0.0))
    middle = Motion(time, speed, angle, np.ascontiguousarray(balance.displacement[:, :3]))
    return TaperedMotion(middle, balance, play, ring)


def tapered_own_motions(
    tapered: TaperedMotion, stiffness: float, axis_angle: float
) -> list[Motion]:
    """Motions of the ring along Z0 that give every roller of both rows its own load or play.

    Parameters
    ----------
    tapered : TaperedMotion
    stiffness : float
        K of Q = K δ^1.5 [N/m^1.5], as the solver of slip has it.
    axis_angle : float
        Angle α of the rollers' axes [rad].

    Returns
    -------
    list of Motion
        By row and number of the roller.
    """
    approach = (tapered.balance.outer_load / stiffness) ** (2.0 / 3.0) - tapered.play
    along = approach / (tapered.ring.sign * math.sin(axis_angle))
    motions = []
    for displacement in along.T:
        none = np.zeros(displacement.size)
        motions.append(
            tapered.motion._replace(displacement=np.column_stack([none, none, displacement]))
        )
    return motions
