"""Statics of a shaft on three-point or four-point mount: hub loads to main-bearing load."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np

from macroslip.arrays import FloatArray
from macroslip.constants import GRAVITY
from macroslip.errors import InputError
from macroslip.input.fields import Choice, Positive, Quantity, Text
from macroslip.input.section import input_section
from macroslip.input.stored import IF_GIVEN
from macroslip.input.units import ANGLE, LENGTH, MASS, NUMBER, STIFFNESS
from macroslip.loads.history import BearingLoads, HubLoads
from macroslip.loads.windio import windio_values

MOUNTS = ("three-point", "four-point", "alone", "two-bearings")
#: Mounts of main bearings that carry moments, on which statics do not give their loads.
MOMENT_MOUNTS = ("alone", "two-bearings")
BEARINGS = ("front", "rear")
FRONTS = ("self-aligning", "moment-carrying")
#: Default distance from the main bearing to the gearbox's support [m].
_TO_GEARBOX = 2.2
_BOTH = (
    "A case file for macroslip run may also have both. A study varies drivetrain.bearing: [front, "
    "rear]."
)
_UPWIND = ", downwind of the hub; rotors downwind of the tower are not modelled"
_FOUR_POINT_KEYS = ("front_to_rear", "locating", "bearing")
#: Keys of a four-point mount that may be left out there.
_FRONT_KEYS = ("front", "front_moment_share")


def _end_of_shaft(drivetrain: Mapping[str, Any]) -> float:
    """Farthest station of the shaft's mass: gearbox support, or 10 m behind the rear bearing."""
    if drivetrain.get("mount") in ("four-point", "two-bearings"):
        span = drivetrain.get("front_to_rear") or 0.0
        return drivetrain["hub_to_bearing"] + span + 10.0
    return drivetrain["hub_to_bearing"] + drivetrain["bearing_to_gearbox"]


@input_section("drivetrain", "supports and mass of the shaft")
class Drivetrain:
    """Supports and weight of the shaft.

    Lengths are measured along the shaft, positive downwind. Valid for a rotor upwind of the tower.
    On a three-point mount one main bearing and the gearbox carry the shaft. On a four-point mount
    two main bearings carry it, and the gearbox takes nothing but torque. A main bearing that carries
    moments may carry it alone, and two single-row tapered roller bearings together. Raises
    InputError for a value outside its range, for keys of a mount that are missing there, or given
    on another one.

    Parameters
    ----------
    mount : str
        `three-point`, `four-point`, `alone` or `two-bearings`.
    hub_to_bearing : float [m]
        Hub centre to main-bearing centre, with two main bearings to the front one, 0 to 20 m. The
        default 1.26 m is an engineering estimate for the WindPACT 1.5 MW turbine, whose published
        model gives no bearing position.
    bearing_to_gearbox : float [m]
        Three-point mount: main-bearing centre to the plane of the gearbox's support, above 0 up to
        20 m. Default 2.2 m, an estimate as well.
    gearbox_stiffness : float [N/m]
        Three-point mount of a main bearing that carries moments, which makes the shaft statically
        indeterminate: stiffness of the gearbox's support across the shaft, above 0 up to 1e11 N/m.
        Beside another bearing no load depends on it.
    front_to_rear : float [m]
        Four-point mount: centre of the front to centre of the rear main bearing, above 0 up to
        20 m. Two bearings: that of the middles of both rows' rollers.
    locating : str
        Four-point mount: which bearing carries all thrust, `front` or `rear`; the other one floats
        along the shaft.
    bearing : str
        Four-point mount: which bearing is simulated, `front` or `rear`.
    front : str
        Four-point mount: what the front bearing is, `self-aligning`, which carries no moment, or
        `moment-carrying`: a pair of tapered roller bearings or the like, which holds the shaft
        against tilting too. Of such a mount the rear bearing is simulated. `self-aligning` if not
        given.
    front_moment_share : float [-]
        Moment-carrying front: share of the moment about its centre that it takes as a moment, 0 to
        below 1, see `support_loads`. 0 if not given, the largest load of the rear bearing.
    tilt : float [rad]
        Shaft tilt, positive when the hub end is up, at most 0.3 rad (17°) either way. OpenFAST's
        ShftTilt has the opposite sign. Directs the weight of the shaft and of the rollers.
    shaft_mass : float [kg]
        Mass of the shaft with all that is fixed to it, except the rotor, whose weight is in the hub
        loads. 0 to 1e6 kg.
    shaft_mass_station : float [m]
        Distance of that mass behind the hub centre: on a three-point mount up to the gearbox's
        support, on a four-point mount up to 10 m behind the rear bearing.
    windio : str
        The turbine file of windIO that values are from, if there is one; `from_windio` reads it.
    """

    mount: Annotated[str, Choice("what carries the shaft", lambda: MOUNTS)] = "three-point"
    hub_to_bearing: Annotated[
        float,
        Quantity("distance from hub centre to main bearing", LENGTH, 0.0, 20.0, note=_UPWIND),
    ] = 1.26
    bearing_to_gearbox: Annotated[
        float, Positive("distance from main bearing to gearbox support", LENGTH, 20.0)
    ] = _TO_GEARBOX
    gearbox_stiffness: Annotated[
        float | None,
        Positive(
            "stiffness of the gearbox's support, beside a main bearing that carries moments",
            STIFFNESS,
            1e11,
        ),
        IF_GIVEN,
    ] = None
    front_to_rear: Annotated[
        float | None, Positive("distance from front to rear main bearing", LENGTH, 20.0)
    ] = None
    locating: Annotated[
        str | None, Choice("main bearing that carries thrust", lambda: BEARINGS)
    ] = None
    bearing: Annotated[
        str | None, Choice("main bearing that is simulated", lambda: BEARINGS, _BOTH)
    ] = None
    front: Annotated[str | None, Choice("kind of front main bearing", lambda: FRONTS)] = None
    front_moment_share: Annotated[
        float | None,
        Quantity(
            "share of the moment that the front main bearing takes", NUMBER, 0.0, 1.0, below=True
        ),
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
    windio: Annotated[
        str | None,
        Text("turbine file of windIO 2: tilt and distances, as far as they are not given here"),
        IF_GIVEN,
    ] = None

    @classmethod
    def from_windio(cls, path: str | os.PathLike[str], **own: Any) -> Drivetrain:
        """Shaft of a turbine file of windIO, version 2; `macroslip.loads.windio` has its keys.

        Parameters
        ----------
        path : path
            The turbine file.
        **own
            Values in SI units that come before the file's, and those that it does not have: which
            `bearing` is simulated, for example.

        Returns
        -------
        Drivetrain
            Hub centre to front bearing is half of the hub's diameter and the file's distance from
            the hub's flange.

        Raises
        ------
        InputError
            If the file cannot be read, or lacks a value that `own` does not have.
        """
        return cls(**{**own, **windio_values(path, own)})

    def __post_init__(self) -> None:
        """InputError for keys that are missing or do not count."""
        required = [key for key in _FOUR_POINT_KEYS if getattr(self, key) is not None]
        excluded = required + [key for key in _FRONT_KEYS if getattr(self, key) is not None]
        missing = [key for key in _FOUR_POINT_KEYS if key not in required]
        if self.mount == "two-bearings":
            if self.front_to_rear is None:
                raise InputError(
                    "the mount is two-bearings, and front_to_rear is missing",
                    allowed="the distance of the middles of both rows' rollers, a length",
                    remedy="Add it.",
                )
            excluded.remove("front_to_rear")
        if self.mount == "four-point" and missing:
            are = "is" if len(missing) == 1 else "are"
            raise InputError(
                f"the mount is four-point, and {' and '.join(missing)} {are} missing",
                allowed="front_to_rear: a length; locating and bearing: front or rear",
                remedy="Add what is missing.",
            )
        if self.mount != "four-point" and excluded:
            fault = f"the mount is {self.mount}, which has no {' and no '.join(excluded)}"
            raise InputError(fault, remedy="Write mount: four-point, or remove what belongs to it.")
        if self.mount != "three-point" and self.bearing_to_gearbox != _TO_GEARBOX:
            fault = f"the mount is {self.mount}, on which bearing_to_gearbox does not count"
            raise InputError(fault, remedy="Remove it, or write mount: three-point.")
        if self.mount != "three-point" and self.gearbox_stiffness is not None:
            fault = f"the mount is {self.mount}, on which gearbox_stiffness does not count"
            raise InputError(fault, remedy="Remove it, or write mount: three-point.")
        self._check_front()

    def _check_front(self) -> None:
        """InputError for a front main bearing that cannot be as it is described."""
        if self.front == "moment-carrying" and self.bearing == "front":
            raise InputError(
                "the front main bearing is moment-carrying, and it is to be simulated",
                allowed="bearing: rear",
                remedy="Pairs of tapered roller bearings are not modelled; their load is: see "
                "support_loads and front_moment.",
            )
        if self.front_moment_share is not None and self.front != "moment-carrying":
            raise InputError(
                "front_moment_share is given, and the front main bearing is self-aligning",
                remedy="Write front: moment-carrying, or remove it.",
            )


def support_loads(hub_loads: HubLoads, drivetrain: Drivetrain) -> dict[str, FloatArray]:
    """Load of the shaft on each of its two supports, from the loads at the hub.

    Free body: the shaft, cut at the hub and at both supports. With x downwind along the shaft from
    the hub centre, z up and y = z × x, and with h = `hub_to_bearing`, b the distance between the
    supports and a = h + b, on it act

    * at x = 0 the rotor: force (fx, fy, fz), moment (mx, my, mz);
    * at x = s the weight W = m·9.81 m/s² of the shaft, (W sin tilt, 0, −W cos tilt): with the hub
      end up, the shaft points downwind and down, so its weight has a part along +x;
    * at x = h and x = a the supports, each with a force and no moment, because the bearings are
      spherical; a moment-carrying front see below. One of the two carries thrust: the main bearing
      of a three-point mount, the locating bearing of a four-point mount;
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

    **Moment-carrying front.** A front that resists tilting makes the shaft statically
    indeterminate once. About its centre the loads of rotor and shaft have the moment

        M_y = my + h fz + (s − h) W cos tilt
        M_z = mz − h fy

    and a shaft that tilts there by θ, stiff itself, on seats in line and a front stiff across the
    shaft, presses the rear bearing, of radial stiffness k, with k b θ and twists the front, of
    tilting stiffness K, with K θ. So M = (k b² + K) θ, and

        load of the rear bearing = (1 − λ) times that without K,    λ = K/(K + k b²)
        moment on the front      = λ M

    `front_moment_share` is λ. The front gets what the rear bearing is spared; the sum of forces and
    of moments is that of the loads for every λ. λ = 0 is the determinate limit of a rear bearing
    that stands far behind, b² ≫ K/k.

    The result is (n, 3) [N], n the samples of `hub_loads`, by the name of the support: `bearing`
    and `gearbox` on a three-point mount, `front` and `rear` on a four-point mount. Valid for a
    rotor upwind of the tower, and while the frequency content lies below the first bending mode of
    the shaft. Seats that give way or are out of line change nothing while λ = 0: two supports
    without moment are statically determinate. With a moment-carrying front, seats that are out of
    line by δ press the rear bearing with K δ/b² times (1 − λ) more or less, and a front that gives
    way across the shaft moves a part of its own load, K/(b² k_front), to the rear.

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
    if drivetrain.mount in MOMENT_MOUNTS:
        raise InputError(
            f"the mount is {drivetrain.mount}, on which main bearings carry the rotor's moments",
            where="drivetrain.mount",
            allowed="three-point or four-point for bearings that carry no moment",
            remedy="Choose a mount with two supports, or a tapered roller bearing.",
        )
    first, second = _without_moments(hub_loads, drivetrain)
    # Across the shaft only: a moment-carrying front leaves the thrust where it is.
    share = drivetrain.front_moment_share or 0.0
    spared = share * second * [1.0, 1.0, 0.0]
    names = BEARINGS if drivetrain.mount == "four-point" else ("bearing", "gearbox")
    loads = (first + spared, second - spared)
    return dict(zip(names, loads, strict=True))


def front_moment(hub_loads: HubLoads, drivetrain: Drivetrain) -> FloatArray:
    """Moment of the shaft on a moment-carrying front main bearing about its centre.

    λ M of `support_loads`, in the bearing frame: M_X0 = λ M_y and M_Y0 = λ M_z.

    Parameters
    ----------
    hub_loads : HubLoads
        n samples.
    drivetrain : Drivetrain
        A four-point mount; the moment on a self-aligning front is zero.

    Returns
    -------
    (n, 3) array [N m]
        M_X0, M_Y0, M_Z0; the last one is zero, because a bearing turns freely about the shaft.

    Examples
    --------
    A tenth of the moment of a rotor of 263 kN, 1.2 m ahead of the front main bearing:

    >>> rotor = HubLoads.constant([164.4e3, 0.0, -263.0e3], [0.0, 0.0, 0.0], 2.143, 1.0)
    >>> pair = Drivetrain(mount="four-point", hub_to_bearing=1.2, front_to_rear=1.5,
    ...                   locating="front", bearing="rear", front="moment-carrying",
    ...                   front_moment_share=0.1)
    >>> print((front_moment(rotor, pair)[0] / 1e3).round(2), "kN m")
    [-31.56   0.     0.  ] kN m
    """
    # Without it the rear bearing alone holds the moment: M_y = −b F_Y0, M_z = b F_X0 there.
    _, rear = _without_moments(hub_loads, drivetrain)
    span = drivetrain.front_to_rear or 0.0
    arm = span * (drivetrain.front_moment_share or 0.0)
    none = np.zeros(len(rear))
    return arm * np.column_stack([-rear[:, 1], rear[:, 0], none])


def _without_moments(hub_loads: HubLoads, drivetrain: Drivetrain) -> tuple[FloatArray, FloatArray]:
    """Loads (n, 3) [N] of the shaft on its first and second support if neither takes a moment."""
    four_point = drivetrain.mount == "four-point"
    # Every four-point mount has its span, which Drivetrain checks.
    span: Any = drivetrain.front_to_rear if four_point else drivetrain.bearing_to_gearbox
    arm = drivetrain.hub_to_bearing + span
    weight = drivetrain.shaft_mass * GRAVITY
    fx, fy, fz = hub_loads.force.T
    _, my, mz = hub_loads.moment.T
    weight_across = weight * math.cos(drivetrain.tilt)
    weight_arm = arm - drivetrain.shaft_mass_station
    weight_moment = weight_arm * weight_across
    thrust = fx + weight * math.sin(drivetrain.tilt)
    x = (arm * fy - mz) / span
    y = (arm * fz + my - weight_moment) / span
    none = np.zeros_like(thrust)
    first_thrust = none
    second_thrust = thrust
    if not four_point or drivetrain.locating == "front":
        first_thrust = thrust
        second_thrust = none
    first = np.column_stack([x, y, first_thrust])
    second_x = fy - x
    second_y = fz - weight_across - y
    second = np.column_stack([second_x, second_y, second_thrust])
    return first, second


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
