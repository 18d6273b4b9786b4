"""From axes that turn with the rotor to axes that do not."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def turn_to_fixed(
    along_ya: NDArray | float, along_za: NDArray | float, azimuth: NDArray | float
) -> tuple[NDArray, NDArray]:
    """Components along the non-rotating y and z from those in the rotating shaft axes, at the azimuth ψ [rad].

    y = y_a cos ψ − z_a sin ψ, z = y_a sin ψ + z_a cos ψ; ψ = 0 with blade 1 up, increasing with rotation about +x.

    Examples
    --------
    A quarter of a turn after blade 1 was up, the rotating z axis points to −y:

    >>> import math
    >>> y, z = turn_to_fixed(0.0, 1.0, math.pi / 2)
    >>> round(float(y), 12), round(float(z), 12)
    (-1.0, 0.0)
    """
    cos, sin = np.cos(azimuth), np.sin(azimuth)
    return along_ya * cos - along_za * sin, along_ya * sin + along_za * cos
