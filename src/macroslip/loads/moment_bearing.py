"""Loads of a main bearing that carries moments, from the loads at the hub."""

from __future__ import annotations

import numpy as np

from macroslip.arrays import FloatArray
from macroslip.constants import GRAVITY
from macroslip.loads.history import BearingLoads, HubLoads
from macroslip.loads.statics import Drivetrain


def moment_bearing_load(
    hub_loads: HubLoads, hub_to_bearing: float
) -> tuple[FloatArray, FloatArray]:
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
    moment_y = my + hub_to_bearing * fz
    moment_z = mz - hub_to_bearing * fy
    moment = np.column_stack([moment_y, moment_z])
    return force, moment


def shaft_load(hub_loads: HubLoads, drivetrain: Drivetrain) -> tuple[BearingLoads, FloatArray]:
    """Force and moment of rotor and shaft on the middle of a main bearing that carries moments.

    Of two single-row bearings that is the middle between them.

    What a gearbox beside the bearing takes of them follows from the balance of the ring.

    Parameters
    ----------
    hub_loads : HubLoads
    drivetrain : Drivetrain
        Its distance from hub to bearing, tilt, and mass of the shaft.

    Returns
    -------
    loads : BearingLoads
        The force, with time and speed of the hub loads.
    moment : ndarray, shape (n, 2)
        About X0 and Y0 through the bearing's middle [N m].

    Examples
    --------
    A shaft of 10 t, 1 m behind the bearing, holds the rotor's weight in balance:

    >>> loads = HubLoads.constant([0.0, 0.0, -98.1e3], [0.0, 0.0, 0.0], 1.26, 1.0)
    >>> shaft = Drivetrain(mount="alone", hub_to_bearing=1.0, tilt=0.0, shaft_mass=1e4,
    ...                    shaft_mass_station=2.0)
    >>> force, moment = shaft_load(loads, shaft)
    >>> (force.force[0] / 1e3).round(1).tolist(), np.abs(moment[0]).round(6).tolist()
    ([0.0, -196.2, 0.0], [0.0, 0.0])
    """
    middle = drivetrain.hub_to_bearing
    if drivetrain.mount == "two-bearings":
        middle += 0.5 * (drivetrain.front_to_rear or 0.0)
    force, moment = moment_bearing_load(hub_loads, middle)
    weight = drivetrain.shaft_mass * GRAVITY
    across = weight * np.cos(drivetrain.tilt)
    along = weight * np.sin(drivetrain.tilt)
    force += np.array([0.0, -across, along])
    lever = drivetrain.shaft_mass_station - middle
    moment[:, 0] += lever * across
    source = f"main bearing under {hub_loads.source}"
    loads = BearingLoads(hub_loads.time, hub_loads.shaft_speed, force, source, hub_loads.event)
    return loads, moment
