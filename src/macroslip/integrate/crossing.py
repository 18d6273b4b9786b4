"""Where inside a step a force passes through zero, from its values at the step's nodes."""

from __future__ import annotations

from macroslip.compiled import jit
from macroslip.integrate.radau_step import NODES
from macroslip.integrate.tuning import AT_END


@jit
def cubic(x, g0, g1, g2, g3):
    """Value at x of the cubic through the values at 0, c1, c2 and 1."""
    a, b = NODES[0], NODES[1]
    return (
        g0 * (x - a) * (x - b) * (x - 1.0) / (-a * b)
        + g1 * x * (x - b) * (x - 1.0) / (a * (a - b) * (a - 1.0))
        + g2 * x * (x - a) * (x - 1.0) / (b * (b - a) * (b - 1.0))
        + g3 * x * (x - a) * (x - b) / ((1.0 - a) * (1.0 - b))
    )


@jit
def crossing(g0, g1, g2, g3):
    """First change of sign of the cubic through a step's nodes, as a part of the step; 1 if there is none inside.

    Parameters
    ----------
    g0, g1, g2, g3 : float
        Values at the start and at the three stages.

    Returns
    -------
    float
        Between `AT_END` and 1 − `AT_END`, or exactly 1.

    Examples
    --------
    >>> round(crossing(-0.5, NODES[0] - 0.5, NODES[1] - 0.5, 0.5), 12)
    0.5
    >>> crossing(1.0, 2.0, 3.0, 4.0)
    1.0
    """
    if g0 * g1 < 0.0:
        low, high, below = 0.0, NODES[0], g0
    elif g1 * g2 < 0.0:
        low, high, below = NODES[0], NODES[1], g1
    elif g2 * g3 < 0.0:
        low, high, below = NODES[1], 1.0, g2
    else:
        return 1.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        if cubic(middle, g0, g1, g2, g3) * below > 0.0:
            low = middle
        else:
            high = middle
    return high if AT_END < high < 1.0 - AT_END else 1.0
