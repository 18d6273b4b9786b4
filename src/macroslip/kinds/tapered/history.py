"""Roller loads, grip, rib and friction of a tapered roller main bearing over a load history.

The rollers are taken in pure rolling: raceway microslip of a tapered roller is negligible, and the
rib slides even then. Rollers whose load is below that of grip are counted; what they do between
their load zones is not computed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.contact.line import strip_places
from macroslip.contact.line_rolling import line_contacts, line_film, rolling_resistance
from macroslip.errors import InputError
from macroslip.kinds.tapered.checks import check_moment, check_preload
from macroslip.kinds.tapered.raceways import axial_float, raceway_strips
from macroslip.kinds.tapered.ribs import LEAST_LOAD, LEAST_SPEED, RIB_SURFACES, rib_values
from macroslip.loads import Drivetrain
from macroslip.loads.history import HubLoads
from macroslip.loads.moment_bearing import moment_bearing_load
from macroslip.lubricant import Lubricant
from macroslip.ring.grip import grip_load
from macroslip.ring.orbit import shaft_angle
from macroslip.ring.tapered import (
    TaperedBalance,
    TaperedRing,
    gearbox_support,
    tapered_balance,
    tapered_ring,
    two_bearings,
)
from macroslip.variables import ALWAYS, Variable, VariableTable, described

#: Names of the rows, by the thrust that they carry.
ROWS = ("downwind", "upwind")
#: Thermal expansion of bearing steel [1/K], engineering value.
STEEL_EXPANSION = 12e-6
#: Laws of a strip of a line contact.
LINE_LAWS = ("palmgren", "plane-strain")
#: Thickness of the rings behind the raceways over the roller's diameter, an estimate.
_RING_THICKNESS = 0.58
_BY_ROLLER = ("time", "row", "roller")
_BY_ROW = ("time", "row")
_OVER_TIME = ("time",)
#: All variables of `tapered_history`.
HISTORY = VariableTable(
    "Tapered roller bearing over a load history, `macroslip.kinds.tapered.history.tapered_history`",
    (
        Variable(
            "ring_displacement",
            ("time", "direction"),
            "m",
            ALWAYS,
            "displacement of the inner ring",
        ),
        Variable("ring_tilt", ("time", "axis"), "rad", ALWAYS, "tilt of the inner ring"),
        Variable("outer_load", _BY_ROLLER, "N", ALWAYS, "load of a roller on the outer raceway"),
        Variable("inner_load", _BY_ROLLER, "N", ALWAYS, "load of a roller on the inner raceway"),
        Variable("rib_force", _BY_ROLLER, "N", ALWAYS, "force of the rib on a roller"),
        Variable(
            "roller_angle", _BY_ROLLER, "rad", ALWAYS, "position of a roller round the bearing"
        ),
        Variable("least_load", _BY_ROW, "N", ALWAYS, "least load of a roller on the outer raceway"),
        Variable(
            "below_grip", _BY_ROW, "1", ALWAYS, "number of rollers whose load is below that of grip"
        ),
        Variable(
            "axial_float",
            _BY_ROW,
            "m",
            ALWAYS,
            "largest way of a loose roller from the rib to where it wedges",
        ),
        Variable(
            "contact_pressure", _BY_ROW, "Pa", ALWAYS, "largest pressure at the inner raceway"
        ),
        Variable(
            "pressure_along",
            ("time", "row", "strip"),
            "Pa",
            ALWAYS,
            "pressure along the hardest roller at the inner raceway",
        ),
        Variable(
            "edge_pressure",
            _BY_ROW,
            "Pa",
            ALWAYS,
            "largest pressure in the outer tenths of the rollers",
        ),
        Variable(
            "edge_share",
            _BY_ROW,
            "1",
            ALWAYS,
            "load of the hardest roller's outer tenths over its load",
        ),
        Variable(
            "raceway_microslip",
            _BY_ROW,
            "m/s",
            ALWAYS,
            "mean microslip along the hardest roller, inner raceway",
        ),
        Variable(
            "raceway_film_ratio",
            _BY_ROW,
            "1",
            ALWAYS,
            "least film over roughness at the inner raceway",
        ),
        Variable("rib_pressure", _BY_ROW, "Pa", ALWAYS, "largest pressure at the ribs"),
        Variable(
            "rib_pressure_speed",
            _BY_ROW,
            "W/m2",
            ALWAYS,
            "largest pressure times sliding speed at the ribs",
        ),
        Variable(
            "rib_pass_energy",
            _BY_ROW,
            "J/m2",
            ALWAYS,
            "pressure times slip of a place of the rib in a pass",
        ),
        Variable(
            "rib_flash_temperature", _BY_ROW, "K", ALWAYS, "largest flash temperature at the ribs"
        ),
        Variable(
            "rib_friction",
            _BY_ROW,
            "1",
            ALWAYS,
            "coefficient of friction at the ribs, mean by load",
        ),
        Variable(
            "rib_asperity_share",
            _BY_ROW,
            "1",
            ALWAYS,
            "largest share of the ribs' load on asperities",
        ),
        Variable(
            "rib_asperity_work",
            ("time", "row", "surface"),
            "W/m2",
            ALWAYS,
            "asperities' pressure times slip per time, for wear",
        ),
        Variable(
            "rib_ellipse_margin",
            _BY_ROW,
            "m",
            ALWAYS,
            "room of the rib's ellipse to the edge; cut below 0",
        ),
        Variable("rib_film_ratio", _BY_ROW, "1", ALWAYS, "least film over roughness at the ribs"),
        Variable(
            "rolling_power", _BY_ROW, "W", ALWAYS, "power of the raceways' rolling resistance"
        ),
        Variable("rib_power", _BY_ROW, "W", ALWAYS, "friction power of the ribs"),
        Variable("rolling_torque", _OVER_TIME, "N m", ALWAYS, "friction torque of the raceways"),
        Variable("rib_torque", _OVER_TIME, "N m", ALWAYS, "friction torque of the ribs"),
        Variable(
            "friction_torque", _OVER_TIME, "N m", ALWAYS, "friction torque of raceways and ribs"
        ),
        Variable("preload", (), "m", ALWAYS, "axial preload with the temperature difference"),
        Variable(
            "preload_change", (), "m", ALWAYS, "change of preload by the temperature difference"
        ),
        Variable("grip_load", (), "N", ALWAYS, "load from which on a raceway grips a roller"),
        Variable("rib_sliding_speed", (), "m/s", ALWAYS, "sliding speed at the ribs, in the mean"),
        Variable(
            "other_line_law",
            (),
            "1",
            ALWAYS,
            "largest roller load by the other line law over that by the chosen",
        ),
        Variable("failed", (), "1", ALWAYS, "samples whose ring balance was not found"),
    ),
)


@dataclass(frozen=True)
class TaperedMount:
    """Shaft supports: one or two tapered bearings, optional elastic gearbox support.

    One bearing carries alone, or a gearbox's elastic support behind it takes a part (three-point),
    or two bearings carry, all of their rows together on a rigid shaft.

    Parameters
    ----------
    hub_to_bearing : float [m]
        From the hub centre to the bearing's middle, downwind, not negative; with two bearings to
        the front one's.
    support_stiffness : float [N/m]
        Stiffness of the gearbox's support across the shaft; 0 where there is none.
    bearing_to_support : float [m]
        From the bearing's middle to that support.
    front_to_rear : float [m]
        Distance of two bearings' middles; 0 where there is one. The gearbox then takes torque only.
    rows_each : int
        Rows of each of two bearings: 1, the rollers' middles of one being its middle and the
        arrangement that of both together, or 2, each with the preload of the file.
    """

    hub_to_bearing: float
    support_stiffness: float = 0.0
    bearing_to_support: float = 0.0
    front_to_rear: float = 0.0
    rows_each: int = 2

    def __post_init__(self) -> None:
        """InputError for lengths and a stiffness that are negative, or that exclude each other."""
        for name in (
            "hub_to_bearing", "support_stiffness", "bearing_to_support", "front_to_rear",
        ):  # fmt: skip
            if not getattr(self, name) >= 0.0:
                raise InputError(
                    f"{name} is {getattr(self, name)}",
                    where="TaperedMount",
                    allowed="0 or more",
                    remedy="Lengths are measured from the hub towards the gearbox.",
                )
        if self.front_to_rear and self.support_stiffness:
            raise InputError(
                "two bearings and a support of the gearbox are given",
                where="TaperedMount",
                allowed="front_to_rear, or support_stiffness",
                remedy="Two bearings hold the shaft, and the gearbox takes torque only: remove "
                "support_stiffness.",
            )
        is_single = self.rows_each == 1
        if self.rows_each not in (1, 2) or (is_single and not self.front_to_rear):
            raise InputError(
                f"rows_each is {self.rows_each}, and front_to_rear {self.front_to_rear:g} m",
                where="TaperedMount",
                allowed="1 with two bearings, or 2",
                remedy="A single row carries thrust one way only: give the distance of two.",
            )

    @classmethod
    def of(cls, drivetrain: Drivetrain) -> TaperedMount:
        """How the drivetrain of a case holds its shaft.

        Weight and tilt of the shaft are not part of it: they are in the load on the bearing.

        Parameters
        ----------
        drivetrain : Drivetrain
            Of a mount that a tapered roller bearing can have.

        Returns
        -------
        TaperedMount
        """
        if drivetrain.mount == "two-bearings":
            rear = drivetrain.front_to_rear or 0.0
            return cls(drivetrain.hub_to_bearing, front_to_rear=rear, rows_each=1)
        return cls(
            drivetrain.hub_to_bearing,
            support_stiffness=drivetrain.gearbox_stiffness or 0.0,
            bearing_to_support=drivetrain.bearing_to_gearbox or 0.0,
        )

    @property
    def middle(self) -> float:
        """From the hub centre to the middle of all rows [m], about which moments are taken."""
        return self.hub_to_bearing + 0.5 * self.front_to_rear

    @property
    def row_names(self) -> tuple[str, ...]:
        """Names of the rows, by the thrust that they carry."""
        if self.front_to_rear and self.rows_each == 2:
            names = []
            for bearing in ("front", "rear"):
                names += [f"{bearing} {row}" for row in ROWS]
            return tuple(names)
        return ROWS

    def mounted(self, bearing: TaperedBearing) -> TaperedBearing:
        """Return the bearing, or two single rows of its kind at their distance as one bearing.

        Parameters
        ----------
        bearing : TaperedBearing

        Returns
        -------
        TaperedBearing

        Raises
        ------
        InputError
            If the rows overlap.
        """
        if self.rows_each == 1:
            return bearing.replace(row_offset=0.5 * self.front_to_rear)
        return bearing

    def ring(self, bearing: TaperedBearing, ring_thickness: float | None = None) -> TaperedRing:
        """Numbers of the balance of all rows on the shaft.

        Parameters
        ----------
        bearing : TaperedBearing
            As `mounted`, with its preload.
        ring_thickness : float, optional
            As in `tapered_ring`.

        Returns
        -------
        TaperedRing
        """
        support = gearbox_support(self.support_stiffness, self.bearing_to_support)
        ring = tapered_ring(bearing, support=support, ring_thickness=ring_thickness)
        if self.front_to_rear and self.rows_each == 2:
            return two_bearings(ring, self.front_to_rear)
        return ring


@dataclass(frozen=True)
class TaperedState:
    """Temperature, oil and law of a line contact of a tapered roller main bearing.

    Parameters
    ----------
    temperature_difference : float [K]
        Inner ring and rollers over outer ring, against the state for which the preload is given.
    rolling : {"zhou-hoeprich", "goksem-hargreaves"}
        Rolling resistance of the raceways.
    film_factor : float [-]
        Film at the raceways over the film with a full inlet, for grip and film ratio.
    slide_roll_ratio : float [-]
        Slip over the entrainment speed that counts as grip.
    line_law : {"palmgren", "plane-strain"}
        Law of a strip of a line contact. Plane strain is stiffer by 11 to 14 %.
    ring_thickness : float [m], optional
        Thickness of the rings behind the raceways in plane strain; without it 0.58 roller
        diameters, an estimate, which counts by its logarithm.
    """

    temperature_difference: float = 0.0
    rolling: str = "zhou-hoeprich"
    film_factor: float = 1.0
    slide_roll_ratio: float = 0.01
    line_law: str = "palmgren"
    ring_thickness: float | None = None

    def __post_init__(self) -> None:
        """InputError for a law of a line contact that does not exist."""
        if self.line_law not in LINE_LAWS:
            raise InputError(
                f"there is no law of a line contact {self.line_law!r}",
                where="TaperedState",
                allowed=" or ".join(LINE_LAWS),
                remedy="Choose one of them.",
            )

    def thickness_of(self, law: str, bearing: TaperedBearing) -> float | None:
        """Thickness of the rings by which strips give way under a law [m]; None by Palmgren's.

        Parameters
        ----------
        law : {"palmgren", "plane-strain"}
        bearing : TaperedBearing
        """
        if law == "palmgren":
            return None
        if self.ring_thickness is not None:
            return self.ring_thickness
        return _RING_THICKNESS * bearing.roller_diameter


def warmed(bearing: TaperedBearing, temperature_difference: float) -> TaperedBearing:
    """Return the bearing with the preload that a temperature difference leaves.

    Parameters
    ----------
    bearing : TaperedBearing
    temperature_difference : float
        Inner ring and rollers over outer ring [K].

    Returns
    -------
    TaperedBearing

    Raises
    ------
    InputError
        If the preload or the play leaves its range.

    Examples
    --------
    >>> bearing = TaperedBearing.read("tdo-main-bearing")
    >>> round(1e6 * (warmed(bearing, 10.0).preload - bearing.preload), 1)
    151.4
    """
    row = tapered_geometry(bearing)
    change = row.preload_per_kelvin(STEEL_EXPANSION, bearing.row_offset, bearing.arrangement)
    preload = bearing.preload + change * temperature_difference
    return bearing.replace(preload=preload)


def tapered_history(
    bearing: TaperedBearing,
    lubricant: Lubricant,
    hub_loads: HubLoads,
    mount: TaperedMount,
    state: TaperedState | None = None,
) -> xr.Dataset:
    """Roller loads, grip, rib and friction over a history of hub loads.

    Parameters
    ----------
    bearing : TaperedBearing
    lubricant : Lubricant
        At its temperature.
    hub_loads : HubLoads
    mount : TaperedMount
    state : TaperedState, optional
        Temperature difference, oil and law of a strip; none, flooded and Palmgren's without it.

    Returns
    -------
    xarray.Dataset
        Dimensions `time`, `row` (named by the thrust that it carries) and `roller`; every variable
        has units and a long name. Samples whose balance was not found are NaN, and `failed` counts
        them.

    Raises
    ------
    InputError
        If the preload that the temperature difference leaves is out of range or presses the rollers
        beyond the static load rating, the rows cannot carry the moment, or no load grips.
    """
    state = TaperedState() if state is None else state
    mounted = mount.mounted(bearing)
    warm = warmed(mounted, state.temperature_difference)
    thickness = state.thickness_of(state.line_law, warm)
    ring = mount.ring(warm, thickness)
    angle = shaft_angle(hub_loads.time, hub_loads.shaft_speed)
    force, moment = moment_bearing_load(hub_loads, mount.middle)
    check_preload(warm, ring)
    check_moment(warm, ring, moment)
    balance = tapered_balance(ring, angle, force, moment)
    is_converged = balance.is_converged(ring, force, moment)
    speed = np.abs(hub_loads.shaft_speed)
    solved = _Solved(warm, lubricant, ring, balance, angle, speed, state)
    values = {**_ring_values(solved), **_raceway_values(solved)}
    rib_force = solved.by_row(balance.rib_force)
    values |= rib_values(warm, lubricant, rib_force, solved.speed)
    values |= _torques(values, solved.speed)
    for name, numbers in values.items():
        if np.ndim(numbers):
            inner_axes = (1,) * (np.ndim(numbers) - 1)
            of_sample = is_converged.reshape((-1, *inner_axes))
            values[name] = np.where(of_sample, numbers, np.nan)
    values["preload"] = warm.preload
    values["preload_change"] = warm.preload - bearing.preload
    values["failed"] = int((~is_converged).sum())
    values["other_line_law"] = _other_line_law(solved, mount, force, moment)
    return xr.Dataset(
        HISTORY.put(values),
        _coordinates(warm, ring, hub_loads, mount),
        {"bearing": bearing.name, "lubricant": lubricant.name, "loads": hub_loads.source},
    )


def _coordinates(
    bearing: TaperedBearing, ring: TaperedRing, hub_loads: HubLoads, mount: TaperedMount
) -> dict[str, Any]:
    """Coordinates of a result."""
    stations = strip_places(bearing.roller_length, ring.profile.size)
    along = described("m", "place along the roller, towards its large end")
    return {
        "time": ("time", hub_loads.time, described("s", "time")),
        "row": ("row", list(mount.row_names), described("1", "row, by the thrust that it carries")),
        "direction": ("direction", ["X0", "Y0", "Z0"]),
        "axis": ("axis", ["X0", "Y0"]),
        "surface": ("surface", list(RIB_SURFACES)),
        "station": ("strip", stations, along),
    }


class _Solved(NamedTuple):
    """A balance over a load history, with bearing, oil, ring and speed."""

    bearing: TaperedBearing
    lubricant: Lubricant
    ring: TaperedRing
    balance: TaperedBalance
    angle: np.ndarray  #: Shape (time,). Angle of the shaft [rad]
    speed: np.ndarray  #: Shape (time,). Speed of the shaft [rad/s], not negative
    state: TaperedState

    def by_row(self, values: np.ndarray) -> np.ndarray:
        """Numbers of all rollers as (time, row, roller)."""
        return values.reshape(len(values), -1, self.bearing.rollers_per_row)


def _ring_values(solved: _Solved) -> dict[str, Any]:
    """Displacement of the ring and forces on the rollers, by the name of the variable."""
    balance = solved.balance
    ring = solved.ring
    angle = ring.angle + ring.orbit_ratio * solved.angle[:, None]
    outer = solved.by_row(balance.outer_load)
    row = tapered_geometry(solved.bearing)
    room = axial_float(row, ring, balance, solved.angle)
    return {
        "ring_displacement": balance.displacement[:, :3],
        "ring_tilt": balance.displacement[:, 3:],
        "outer_load": outer,
        "inner_load": solved.by_row(balance.inner_load),
        "rib_force": solved.by_row(balance.rib_force),
        "roller_angle": solved.by_row(np.remainder(angle, 2.0 * np.pi)),
        "least_load": outer.min(axis=2),
        "axial_float": solved.by_row(room).max(axis=2),
    }


def _raceway_values(solved: _Solved) -> dict[str, Any]:
    """Grip, pressure and rolling resistance of the raceways, by the name of the variable."""
    contacts = line_contacts(solved.bearing, solved.lubricant)
    inner_contact = contacts[0]
    state = solved.state
    grip = np.nan
    if solved.speed.any():
        grip = grip_load(
            solved.bearing,
            solved.lubricant,
            float(solved.speed.mean()),
            slide_roll_ratio=state.slide_roll_ratio,
            film_factor=state.film_factor,
            rolling=state.rolling,
        )
    row = tapered_geometry(solved.bearing)
    surface_speed = row.surface_speed(solved.speed)
    surface = np.maximum(surface_speed, LEAST_SPEED)[:, None]
    speed_of_rollers = surface[:, :, None]
    strips = raceway_strips(
        row,
        solved.ring,
        solved.balance,
        solved.angle,
        solved.speed,
        inner_contact,
        solved.bearing.rollers_per_row,
    )
    inner = solved.by_row(solved.balance.inner_load)
    outer = solved.by_row(solved.balance.outer_load)
    hardest = np.maximum(inner.max(axis=2), LEAST_LOAD)
    film = state.film_factor * line_film(inner_contact, hardest, surface)
    resistance = np.zeros_like(inner)
    for contact, load in zip(contacts, (inner, outer), strict=True):
        resistance += rolling_resistance(contact, load, speed_of_rollers, state.rolling)
    power = 2.0 * resistance * speed_of_rollers
    return {
        "grip_load": grip,
        "below_grip": (outer < grip).sum(axis=2).astype(float),
        "contact_pressure": strips.pressure,
        "pressure_along": strips.along,
        "edge_pressure": strips.edge_pressure,
        "edge_share": strips.edge_share,
        "raceway_microslip": strips.microslip,
        "raceway_film_ratio": film / inner_contact.roughness,
        "rolling_power": power.sum(axis=2),
    }


def _torques(values: dict[str, Any], speed: np.ndarray) -> dict[str, np.ndarray]:
    """Torque of raceways, ribs and both [N m]; NaN where the shaft is at rest."""
    turning = np.where(speed > 0.0, speed, np.nan)
    rolling = values["rolling_power"].sum(axis=1) / turning
    rib = values["rib_power"].sum(axis=1) / turning
    return {"rolling_torque": rolling, "rib_torque": rib, "friction_torque": rolling + rib}


def _other_line_law(
    solved: _Solved, mount: TaperedMount, force: np.ndarray, moment: np.ndarray
) -> float:
    """Largest roller load by the law of a strip that was not chosen over that by the chosen one."""
    largest = solved.balance.outer_load.max(axis=1)
    worst = int(largest.argmax())
    if not largest[worst] > 0.0:
        return math.nan
    other = next(law for law in LINE_LAWS if law != solved.state.line_law)
    thickness = solved.state.thickness_of(other, solved.bearing)
    ring = mount.ring(solved.bearing, thickness)
    here = slice(worst, worst + 1)
    balance = tapered_balance(ring, solved.angle[here], force[here], moment[here])
    other_largest = balance.outer_load.max()
    return float(other_largest / largest[worst])
