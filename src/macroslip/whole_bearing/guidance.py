"""Radial guidance of a cage by its rollers.

Pockets follow the rollers' contour, so a cage that leaves the bearing's axis by more than the radial play rests on
rollers all round, which the raceways hold. The model replaces them by one elastic, damped stop at the distance of the gap.
It is the same in every direction and has no friction of its own. Gripped rollers at either side, whose spars close at half
of that distance, carry the cage first. Without the stop only the few gripped rollers would hold the cage and, with it, the
weight of all other rollers. The stop's push on single rollers is small against their load and is neglected.
"""

from __future__ import annotations

import math

from macroslip.compiled import jit

#: Stiffness [N/m] and damping [N s/m] of the stop, estimates: it yields some micrometres to the cage's weight and does not
#: bounce.
STIFFNESS, DAMPING = 1e8, 1e5


@jit
def guide_force(play, a, b, p, q):
    """Push of the rollers on a cage that has left the axis by (a, b) [m] at the speed (p, q) [m/s].

    Parameters
    ----------
    play : float
        Distance [m] that is free.

    Returns
    -------
    push : float
        Towards the axis [N], never below zero.
    n_x, n_y : float
        Direction in which the cage has left it.
    by_place, by_speed : float
        Derivatives of the push by the distance [N/m] and by its rate [N s/m].

    Examples
    --------
    >>> push, n_x, n_y, _, _ = guide_force(1e-4, 0.0, -1.05e-4, 0.0, 0.0)
    >>> round(push), n_y
    (500, -1.0)
    """
    distance = math.sqrt(a * a + b * b)
    depth = distance - play
    if depth <= 0.0 or distance == 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    n_x, n_y = a / distance, b / distance
    push = STIFFNESS * depth + DAMPING * (p * n_x + q * n_y)
    if push <= 0.0:
        return 0.0, n_x, n_y, 0.0, 0.0
    return push, n_x, n_y, STIFFNESS, DAMPING


@jit
def guide_energy(play, a, b):
    """Elastic energy of the stop [J]."""
    depth = math.sqrt(a * a + b * b) - play
    return 0.5 * STIFFNESS * depth * depth if depth > 0.0 else 0.0
