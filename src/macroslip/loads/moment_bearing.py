"""Loads of a main bearing that carries moments, from the loads at the hub."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from macroslip.loads.history import HubLoads


def moment_bearing_load(
    hub_loads: HubLoads, hub_to_bearing: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Force and moment of the rotor on the inner ring of a bearing that carries moments.

    The hub centre is `hub_to_bearing` upwind of the bearing's middle. The weight of the shaft is
    left out: add it to the forces and moments where it counts.

    Parameters
    ----------
    hub_loads : HubLoads
    hub_to_bearing : float
        L_h [m], not negative.

    Returns
    -------
    force : ndarray, shape (n, 3)
        Along X0, Y0 and Z0 [N]: fy, fz and fx.
    moment : ndarray, shape (n, 2)
        About X0 and Y0 through the bearing's middle [N m]: my + L_h fz and mz − L_h fy.

    Examples
    --------
    >>> loads = HubLoads.constant([700e3, 50e3, -1300e3], [0.0, 0.0, 0.0], 1.26, 1.0)
    >>> force, moment = moment_bearing_load(loads, 2.0)
    >>> (force[0] / 1e3).tolist(), (moment[0] / 1e3).tolist()
    ([50.0, -1300.0, 700.0], [-2600.0, -100.0])
    """
    fx, fy, fz = hub_loads.force.T
    _, my, mz = hub_loads.moment.T
    force = np.column_stack([fy, fz, fx])
    moment = np.column_stack([my + hub_to_bearing * fz, mz - hub_to_bearing * fy])
    return force, moment
