"""From the hub to the main bearing: statics of a shaft on a three-point or a four-point mount."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

from macroslip.constants import GRAVITY
from macroslip.errors import InputError
from macroslip.input.fields import Choice, Positive, Quantity
from macroslip.input.section import input_section
from macroslip.input.units import ANGLE, LENGTH, MASS
from macroslip.loads.history import BearingLoads, HubLoads

MOUNTS = ("three-point", "four-point")
BEARINGS = ("front", "rear")
#: Default distance from the main bearing to the gearbox's support [m].
_TO_GEARBOX = 2.2
_BOTH = (
    "A case file for macroslip run may also have both. A study varies drivetrain.bearing: [front, "
    "rear]."
)
_UPWIND = ", downwind of the hub; rotors downwind of the tower are not modelled"
_FOUR_POINT_KEYS = ("front_to_rear", "locating", "bearing")


def _end_of_shaft(given: Mapping[str, Any]) -> float:
    """Farthest station of the shaft's mass: gearbox support, or 10 m behind the rear bearing."""
    if given.get("mount") == "four-point":
        return given["hub_to_bearing"] + (given.get("front_to_rear") or 0.0) + 10.0
    return given["hub_to_bearing"] + given["bearing_to_gearbox"]


@input_section("drivetrain", "supports and mass of the shaft")
class Drivetrain:
    """Supports and weight of the shaft.

    Lengths are measured along the shaft, positive downwind. Valid for a rotor upwind of the tower.
    On a three-point mount one main bearing and the gearbox carry the shaft. On a four-point mount
    two main bearings carry it, and the gearbox takes nothing but torque. Raises InputError for a
    value outside its range, for keys of a four-point mount that are missing there, or given on a
    three-point mount.

    Parameters
    ----------
    mount : str
        `three-point` or `four-point`.
    hub_to_bearing : float [m]
        Hub centre to main-bearing centre, on a four-point mount to the front one, 0 to 20 m. The
        default 1.26 m is an engineering estimate for the WindPACT 1.5 MW turbine, whose published
        model gives no bearing position.
    bearing_to_gearbox : float [m]
        Three-point mount: main-bearing centre to the plane of the gearbox's support, above 0 up to
        20 m. Default 2.2 m, an estimate as well.
    front_to_rear : float [m]
        Four-point mount: centre of the front to centre of the rear main bearing, above 0 up to
        20 m.
    locating : str
        Four-point mount: which bearing carries all thrust, `front` or `rear`; the other one floats
        along the shaft.
    bearing : str
        Four-point mount: which bearing is simulated, `front` or `rear`.
    tilt : float [rad]
        Shaft tilt, positive when the hub end is up, at most 0.3 rad (17°) either way. OpenFAST's
        ShftTilt has the opposite sign. Directs the weight of the shaft and of the rollers.
    shaft_mass : float [kg]
        Mass of the shaft with all that is fixed to it, except the rotor, whose weight is in the hub
        loads. 0 to 1e6 kg.
    shaft_mass_station : float [m]
        Distance of that mass behind the hub centre: on a three-point mount up to the gearbox's
        support, on a four-point mount up to 10 m behind the rear bearing.
    """

    mount: Annotated[str, Choice("what carries the shaft", lambda: MOUNTS)] = "three-point"
    hub_to_bearing: Annotated[
        float,
        Quantity("distance from hub centre to main bearing", LENGTH, 0.0, 20.0, note=_UPWIND),
    ] = 1.26
    bearing_to_gearbox: Annotated[
        float, Positive("distance from main bearing to gearbox support", LENGTH, 20.0)
    ] = _TO_GEARBOX
    front_to_rear: Annotated[
        float | None, Positive("distance from front to rear main bearing", LENGTH, 20.0)
    ] = None
    locating: Annotated[
        str | None, Choice("main bearing that carries thrust", lambda: BEARINGS)
    ] = None
    bearing: Annotated[
        str | None, Choice("main bearing that is simulated", lambda: BEARINGS, _BOTH)
    ] = None
    tilt: Annotated[
        float, Quantity("shaft tilt, positive with the hub end up", ANGLE, -0.3, 0.3)
    ] = math.radians(5.0)
    shaft_mass: Annotated[float, Quantity("mass of the shaft without rotor", MASS, 0.0, 1e6)] = 0.0
    shaft_mass_station: Annotated[
        float,
        Quantity(
            "distance of that mass behind the hub centre",
            LENGTH,
            0.0,
            _end_of_shaft,
            note=", from the hub to the end of the shaft",
        ),
    ] = 0.0

    def __post_init__(self) -> None:
        """InputError for keys that are missing or do not count."""
        given = [key for key in _FOUR_POINT_KEYS if getattr(self, key) is not None]
        missing = [key for key in _FOUR_POINT_KEYS if key not in given]
        if self.mount == "four-point" and missing:
            are = "is" if len(missing) == 1 else "are"
            raise InputError(
                f"the mount is four-point, and {' and '.join(missing)} {are} missing",
                allowed="front_to_rear: a length; locating and bearing: front or rear",
                remedy="Add what is missing.",
            )
        if self.mount == "three-point" and given:
            what = f"the mount is three-point, which has no {' and no '.join(given)}"
            raise InputError(what, remedy="Write mount: four-point, or remove what belongs to it.")
        if self.mount == "four-point" and self.bearing_to_gearbox != _TO_GEARBOX:
            what = "the mount is four-point, on which bearing_to_gearbox does not count"
            raise InputError(what, remedy="Remove it, or write mount: three-point.")


def support_loads(hub_loads: HubLoads, drivetrain: Drivetrain) -> dict[str, NDArray[np.float64]]:
    """Load of the shaft on each of its two supports, from the loads at the hub.

    Free body: the shaft, cut at the hub and at both supports. With x downwind along the shaft from
    the hub centre, z up and y = z × x, and with h = `hub_to_bearing`, b the distance between the
    supports and a = h + b, on it act

    * at x = 0 the rotor: force (fx, fy, fz), moment (mx, my, mz);
    * at x = s the weight W = m·9.81 m/s² of the shaft, (W sin tilt, 0, −W cos tilt): with the hub
      end up, the shaft points downwind and down, so its weight has a part along +x;
    * at x = h and x = a the supports, each with a force and no moment, because the bearings are
      spherical. One of the two carries thrust: the main bearing of a three-point mount, the
      locating bearing of a four-point mount;
    * the gearbox with the torque −mx. On a three-point mount its torque arms are the support at
      x = a. On a four-point mount it is held against rotation only.

    The shaft is in equilibrium: its inertia forces are neglected. A force F at x has the moment
    (x − a) x̂ × F = (x − a) (0, −Fz, Fy) about the second support, whose own force has none there.
    The load of the shaft **on** the first support, in the bearing frame (X0, Y0, Z0) = (y, z, x),
    is therefore

        F_X0 = (a fy − mz)/b
        F_Y0 = (a fz + my − (a − s) W cos tilt)/b

    and what the forces across the shaft leave goes to the second one. Thrust is
    F_Z0 = fx + W sin tilt.

    The result is (n, 3) [N], n the samples of `hub_loads`, by the name of the support: `bearing`
    and `gearbox` on a three-point mount, `front` and `rear` on a four-point mount. Valid for a
    rotor upwind of the tower, and while the frequency content lies below the first bending mode of
    the shaft. Seats that give way or are out of line change nothing: two supports without moment
    are statically determinate.

    Examples
    --------
    A rotor of 263 kN on two main bearings, 1.5 m apart, the rear one locating:

    >>> rotor = HubLoads.constant([164.4e3, 0.0, -263.0e3], [0.0, 0.0, 0.0], 2.143, 1.0)
    >>> two = Drivetrain(mount="four-point", hub_to_bearing=1.2, front_to_rear=1.5,
    ...                  locating="rear", bearing="front")
    >>> for name, force in support_loads(rotor, two).items():
    ...     print(name, (force[0] / 1e3).round(1), "kN")
    front [   0.  -473.4    0. ] kN
    rear [  0.  210.4 164.4] kN
    """
    four_point = drivetrain.mount == "four-point"
    # Every four-point mount has its span, which Drivetrain checks.
    span: Any = drivetrain.front_to_rear if four_point else drivetrain.bearing_to_gearbox
    arm = drivetrain.hub_to_bearing + span
    weight = drivetrain.shaft_mass * GRAVITY
    fx, fy, fz = hub_loads.force.T
    _, my, mz = hub_loads.moment.T
    weight_moment = (arm - drivetrain.shaft_mass_station) * weight * math.cos(drivetrain.tilt)
    thrust = fx + weight * math.sin(drivetrain.tilt)
    x = (arm * fy - mz) / span
    y = (arm * fz + my - weight_moment) / span
    none = np.zeros_like(thrust)
    first_carries = not four_point or drivetrain.locating == "front"
    first = np.column_stack([x, y, thrust if first_carries else none])
    second = np.column_stack(
        [fy - x, fz - weight * math.cos(drivetrain.tilt) - y, none if first_carries else thrust]
    )
    return dict(
        zip(BEARINGS if four_point else ("bearing", "gearbox"), (first, second), strict=True)
    )


def main_bearing_load(hub_loads: HubLoads, drivetrain: Drivetrain) -> BearingLoads:
    """Load on the inner ring of the simulated main bearing, by `support_loads`.

    Time and speed are those of the hub loads. Raises InputError if the load is beyond 1e8 N, as a
    support distance close to zero makes it.

    Examples
    --------
    Mean loads of the WindPACT 1.5 MW turbine at 14 m/s:

    >>> loads = HubLoads.constant([164.4e3, -2.3e3, -263.0e3], [726e3, 154.4e3, 36.6e3], 2.143, 1.0)
    >>> print((main_bearing_load(loads, Drivetrain()).force[0] / 1e3).round(2), "kN")
    [ -20.25 -343.45  164.4 ] kN
    """
    name = drivetrain.bearing or "bearing"
    force = support_loads(hub_loads, drivetrain)[name]
    which = f"{name} main bearing" if drivetrain.bearing else "main bearing"
    return BearingLoads(
        hub_loads.time,
        hub_loads.shaft_speed,
        force,
        f"{which} under {hub_loads.source}",
        hub_loads.event,
    )
