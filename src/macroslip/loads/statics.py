"""From the hub to the main bearing: statics of a shaft on a three-point mount."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np

from macroslip.catalogue.forms import Quantity
from macroslip.catalogue.input_section import input_section
from macroslip.catalogue.units import ANGLE, LENGTH, MASS
from macroslip.constants import GRAVITY
from macroslip.loads.bearing_loads import BearingLoads
from macroslip.loads.hub_loads import HubLoads


@input_section("drivetrain", "supports and mass of the shaft")
class Drivetrain:
    """Where the shaft is supported and what it weighs.

    Lengths are measured along the shaft, positive downwind. Valid for an upwind rotor on a three-point mount.

    Parameters
    ----------
    hub_to_bearing : float [m]
        Hub centre to main-bearing centre, 0 to 20 m. The default 1.26 m is an engineering estimate for the WindPACT
        1.5 MW turbine, whose published model gives no bearing position.
    bearing_to_gearbox : float [m]
        Main-bearing centre to the plane of the gearbox's support, above 0 up to 20 m. Default 2.2 m, an estimate as
        well.
    tilt : float [rad]
        Shaft tilt, positive when the hub end is up, at most 0.3 rad (17°) either way. OpenFAST's ShftTilt has the
        opposite sign. Directs the weight of the shaft and of the rollers.
    shaft_mass : float [kg]
        Mass of the shaft with what is fixed to it, except the rotor, whose weight is in the hub loads. 0 to 1e6 kg.
    shaft_mass_station : float [m]
        Distance of that mass behind the hub centre, between the hub and the gearbox's support.

    Raises
    ------
    InputError
        A value outside its range.
    """

    hub_to_bearing: Annotated[float, Quantity("distance from hub centre to main bearing", LENGTH, 0.0, 20.0)] = 1.26
    bearing_to_gearbox: Annotated[
        float, Quantity("distance from main bearing to gearbox support", LENGTH, 0.0, 20.0, above=True)
    ] = 2.2
    tilt: Annotated[float, Quantity("shaft tilt, positive with the hub end up", ANGLE, -0.3, 0.3)] = math.radians(5.0)
    shaft_mass: Annotated[float, Quantity("mass of the shaft without rotor", MASS, 0.0, 1e6)] = 0.0
    shaft_mass_station: Annotated[
        float,
        Quantity(
            "distance of that mass behind the hub centre",
            LENGTH,
            0.0,
            lambda given: given["hub_to_bearing"] + given["bearing_to_gearbox"],
            note=", from the hub to the gearbox's support",
        ),
    ] = 0.0


def main_bearing_load(hub_loads: HubLoads, drivetrain: Drivetrain) -> BearingLoads:
    """Load on the inner ring of the main bearing, from the loads at the hub.

    Free body: the shaft, cut at the hub, at the main bearing and at the gearbox. With x downwind along the shaft from
    the hub centre, z up and y = z × x, and with h = `hub_to_bearing`, g = `bearing_to_gearbox`, a = h + g, on it act

    * at x = 0 the rotor: force (fx, fy, fz), moment (mx, my, mz);
    * at x = s the weight W = m·9.81 m/s² of the shaft, (W sin tilt, 0, −W cos tilt): with the hub end up, the shaft
      points downwind and down, so its weight has a part along +x;
    * at x = h the main bearing: a force (Rx, Ry, Rz), and no moment, because the bearing is spherical;
    * at x = a the gearbox on its torque arms: a force across the shaft (0, Gy, Gz) and the torque −mx.

    The shaft is in equilibrium: its inertia forces are neglected. The axial forces give Rx = −(fx + W sin tilt): all
    thrust goes to the main bearing. A force F at x has the moment (x − a) x̂ × F = (x − a) (0, −Fz, Fy) about the
    gearbox support, where the gearbox's own force has none, so that

        about y:   my + a fz − (a − s) W cos tilt + g Rz = 0,
        about z:   mz − a fy − g Ry = 0.

    The load **on** the inner ring is −R, in the bearing frame (X0, Y0, Z0) = (y, z, x):

        F_X0 = (a fy − mz)/g
        F_Y0 = (a fz + my − (a − s) W cos tilt)/g
        F_Z0 = fx + W sin tilt

    Parameters
    ----------
    hub_loads : HubLoads
        Loads of the rotor on the shaft, n samples.
    drivetrain : Drivetrain
        Support positions and shaft mass.

    Returns
    -------
    BearingLoads
        force (n, 3) [N], with the time and shaft speed of `hub_loads`.

    Raises
    ------
    InputError
        The load is beyond 1e8 N, as a support distance close to zero makes it.

    Notes
    -----
    Valid while the frequency content lies below the first bending mode of the shaft, and for a gearbox support that
    carries no bending moment and no thrust.

    Examples
    --------
    Mean loads of the WindPACT 1.5 MW turbine at 14 m/s:

    >>> loads = HubLoads.constant([164.4e3, -2.3e3, -263.0e3], [726e3, 154.4e3, 36.6e3], 2.143, 1.0)
    >>> print((main_bearing_load(loads, Drivetrain()).force[0] / 1e3).round(2), "kN")
    [ -20.25 -343.45  164.4 ] kN
    """
    span = drivetrain.bearing_to_gearbox
    arm = drivetrain.hub_to_bearing + span
    weight = drivetrain.shaft_mass * GRAVITY
    fx, fy, fz = hub_loads.force.T
    _, my, mz = hub_loads.moment.T
    weight_moment = (arm - drivetrain.shaft_mass_station) * weight * math.cos(drivetrain.tilt)
    force = np.column_stack(
        [(arm * fy - mz) / span, (arm * fz + my - weight_moment) / span, fx + weight * math.sin(drivetrain.tilt)]
    )
    return BearingLoads(hub_loads.time, hub_loads.shaft_speed, force, f"main bearing under {hub_loads.source}")
