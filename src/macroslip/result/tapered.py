"""Roller loads, grip, rib and friction of a tapered roller main bearing over a load history.

The rollers are taken in pure rolling: raceway microslip of a tapered roller is negligible, and the
rib slides even then. Rollers whose load is below that of grip are counted; what they do between
their load zones is not computed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from macroslip.bearing.tapered import TaperedBearing, TaperedGeometry, tapered_geometry
from macroslip.contact.line import line_pressure
from macroslip.contact.line_rolling import LineContact, line_contacts, rolling_resistance
from macroslip.contact.rib import rib_contact, rib_state
from macroslip.errors import InputError
from macroslip.loads.history import HubLoads
from macroslip.loads.moment_bearing import moment_bearing_load
from macroslip.lubricant import Lubricant
from macroslip.ring.grip import grip_load
from macroslip.ring.orbit import shaft_angle
from macroslip.ring.tapered import (
    ROW_SIGNS,
    TaperedBalance,
    TaperedRing,
    gearbox_support,
    strip_loads,
    tapered_balance,
    tapered_ring,
)

#: Names of the rows, by the thrust that they carry.
ROWS = ("downwind", "upwind")
#: Thermal expansion of bearing steel [1/K], engineering value.
STEEL_EXPANSION = 12e-6
#: Least speed of a surface [m/s], in place of a shaft at rest.
_LEAST_SPEED = 1e-9
_BY_ROLLER = ("time", "row", "roller")
_BY_ROW = ("time", "row")
#: Dimensions, unit and long name of every variable of `tapered_history`.
VARIABLES: dict[str, tuple[tuple[str, ...], str, str]] = {
    "ring_displacement": (("time", "direction"), "m", "displacement of the inner ring"),
    "ring_tilt": (("time", "axis"), "rad", "tilt of the inner ring"),
    "outer_load": (_BY_ROLLER, "N", "load of a roller on the outer raceway"),
    "inner_load": (_BY_ROLLER, "N", "load of a roller on the inner raceway"),
    "rib_force": (_BY_ROLLER, "N", "force of the rib on a roller"),
    "below_grip": (_BY_ROW, "1", "number of rollers whose load is below that of grip"),
    "contact_pressure": (_BY_ROW, "Pa", "largest pressure at the inner raceway"),
    "rib_pressure": (_BY_ROW, "Pa", "largest pressure at the ribs"),
    "rib_film_ratio": (_BY_ROW, "1", "least film over roughness at the ribs"),
    "rolling_power": (_BY_ROW, "W", "power of the raceways' rolling resistance"),
    "rib_power": (_BY_ROW, "W", "friction power of the ribs"),
    "friction_torque": (("time",), "N m", "friction torque of raceways and ribs"),
    "preload": ((), "m", "axial preload with the temperature difference"),
    "preload_change": ((), "m", "change of preload by the temperature difference"),
    "grip_load": ((), "N", "load from which on a raceway grips a roller"),
    "rib_sliding_speed": ((), "m/s", "sliding speed at the ribs, in the mean"),
    "failed": ((), "1", "samples whose ring balance was not found"),
}
#: Part of the load and least force [N] up to which a balance counts as found.
_FOUND = (1e-5, 1.0)


@dataclass(frozen=True)
class TaperedMount:
    """How the shaft with a tapered roller main bearing is held beside it.

    Parameters
    ----------
    hub_to_bearing : float [m]
        From the hub centre to the bearing's middle, downwind, not negative.
    support_stiffness : float [N/m]
        Stiffness of the gearbox's support across the shaft; 0 where the bearing carries alone.
    bearing_to_support : float [m]
        From the bearing's middle to that support.
    """

    hub_to_bearing: float
    support_stiffness: float = 0.0
    bearing_to_support: float = 0.0

    def __post_init__(self) -> None:
        """InputError for a length or a stiffness that is negative."""
        for name in ("hub_to_bearing", "support_stiffness", "bearing_to_support"):
            if not getattr(self, name) >= 0.0:
                raise InputError(
                    f"{name} is {getattr(self, name)}",
                    where="TaperedMount",
                    allowed="0 or more",
                    remedy="Lengths are measured from the hub towards the gearbox.",
                )


@dataclass(frozen=True)
class TaperedState:
    """Temperature and oil of a tapered roller main bearing.

    Parameters
    ----------
    temperature_difference : float [K]
        Inner ring and rollers over outer ring, against the state for which the preload is given.
    rolling : {"zhou-hoeprich", "goksem-hargreaves"}
        Rolling resistance of the raceways.
    film_factor : float [-]
        Film at the raceways over the film with a full inlet, for the load of grip.
    slide_roll_ratio : float [-]
        Slip over the entrainment speed that counts as grip.
    """

    temperature_difference: float = 0.0
    rolling: str = "zhou-hoeprich"
    film_factor: float = 1.0
    slide_roll_ratio: float = 0.01


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
    return bearing.replace(preload=bearing.preload + change * temperature_difference)


def _by_row(values: np.ndarray) -> np.ndarray:
    """Numbers of all rollers as (time, row, roller)."""
    return values.reshape(len(values), len(ROW_SIGNS), -1)


def _largest_pressure(
    ring: TaperedRing, balance: TaperedBalance, angle: np.ndarray, contact: LineContact
) -> np.ndarray:
    """Largest pressure at the inner raceway of each row [Pa], shape (time, row)."""
    strip = contact.length / ring.profile.size
    pressures = np.empty((len(angle), len(ROW_SIGNS)))
    for sample in range(len(angle)):
        inner, _ = strip_loads(ring, balance, angle, sample)
        largest = inner.max(axis=1).reshape(len(ROW_SIGNS), -1).max(axis=1)
        pressures[sample] = line_pressure(largest / strip, contact.curvature, contact.modulus)
    return pressures


def _rolling_power(
    row: TaperedGeometry,
    contacts: tuple[LineContact, LineContact],
    balance: TaperedBalance,
    speed: np.ndarray,
    law: str,
) -> np.ndarray:
    """Power of the raceways' rolling resistance of each row [W], shape (time, row)."""
    surface = np.maximum(row.surface_speed(speed), _LEAST_SPEED)[:, None, None]
    loads = balance.inner_load, balance.outer_load
    resistance = sum(
        rolling_resistance(contact, _by_row(load), surface, law)
        for contact, load in zip(contacts, loads, strict=True)
    )
    return (2.0 * resistance * surface).sum(axis=2)


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
        Temperature difference and oil; none and flooded without it.

    Returns
    -------
    xarray.Dataset
        Dimensions `time`, `row` (named by the thrust that it carries) and `roller`; every variable
        has units and a long name. Samples whose balance was not found are NaN, and `failed` counts
        them.

    Raises
    ------
    InputError
        If the preload that the temperature difference leaves is out of range, or no load grips.
    """
    state = TaperedState() if state is None else state
    warm = warmed(bearing, state.temperature_difference)
    ring = tapered_ring(
        warm, support=gearbox_support(mount.support_stiffness, mount.bearing_to_support)
    )
    angle = shaft_angle(hub_loads.time, hub_loads.shaft_speed)
    force, moment = moment_bearing_load(hub_loads, mount.hub_to_bearing)
    balance = tapered_balance(ring, angle, force, moment)
    size = np.linalg.norm(force, axis=1) + np.linalg.norm(moment, axis=1) / ring.pitch_radius
    is_found = balance.unbalanced <= _FOUND[0] * size + _FOUND[1]
    speed = np.abs(hub_loads.shaft_speed)
    values = {
        **_ring_values(balance),
        **_raceway_values(warm, lubricant, ring, balance, angle, speed, state),
        **_rib_values(warm, lubricant, balance, speed),
    }
    power = (values["rolling_power"] + values["rib_power"]).sum(axis=1)
    values["friction_torque"] = power / np.where(speed > 0.0, speed, np.nan)
    for name, numbers in values.items():
        if np.ndim(numbers):
            shape = (-1, *(1,) * (np.ndim(numbers) - 1))
            values[name] = np.where(is_found.reshape(shape), numbers, np.nan)
    values["preload"] = warm.preload
    values["preload_change"] = warm.preload - bearing.preload
    values["failed"] = int((~is_found).sum())
    return xr.Dataset(
        {
            name: (dims, values[name], {"units": units, "long_name": long_name})
            for name, (dims, units, long_name) in VARIABLES.items()
        },
        {
            "time": ("time", hub_loads.time, {"units": "s", "long_name": "time"}),
            "row": ("row", list(ROWS), {"long_name": "row, by the thrust that it carries"}),
            "direction": ("direction", ["X0", "Y0", "Z0"]),
            "axis": ("axis", ["X0", "Y0"]),
        },
        {"bearing": bearing.name, "lubricant": lubricant.name, "loads": hub_loads.source},
    )


def _ring_values(balance: TaperedBalance) -> dict[str, Any]:
    """Displacement of the ring and forces on the rollers, by the name of the variable."""
    return {
        "ring_displacement": balance.displacement[:, :3],
        "ring_tilt": balance.displacement[:, 3:],
        "outer_load": _by_row(balance.outer_load),
        "inner_load": _by_row(balance.inner_load),
        "rib_force": _by_row(balance.rib_force),
    }


def _raceway_values(
    bearing: TaperedBearing,
    lubricant: Lubricant,
    ring: TaperedRing,
    balance: TaperedBalance,
    angle: np.ndarray,
    speed: np.ndarray,
    state: TaperedState,
) -> dict[str, Any]:
    """Grip, pressure and rolling resistance of the raceways, by the name of the variable."""
    contacts = line_contacts(bearing, lubricant)
    grip = np.nan
    if speed.any():
        grip = grip_load(
            bearing,
            lubricant,
            float(speed.mean()),
            slide_roll_ratio=state.slide_roll_ratio,
            film_factor=state.film_factor,
            rolling=state.rolling,
        )
    row = tapered_geometry(bearing)
    return {
        "grip_load": grip,
        "below_grip": (_by_row(balance.outer_load) < grip).sum(axis=2).astype(float),
        "contact_pressure": _largest_pressure(ring, balance, angle, contacts[0]),
        "rolling_power": _rolling_power(row, contacts, balance, speed, state.rolling),
    }


def _rib_values(
    bearing: TaperedBearing, lubricant: Lubricant, balance: TaperedBalance, speed: np.ndarray
) -> dict[str, Any]:
    """Pressure, film and friction of the ribs, by the name of the variable."""
    row = tapered_geometry(bearing)
    entrainment = np.maximum(row.rib_entrainment_speed(speed), _LEAST_SPEED)
    rib = rib_state(
        rib_contact(bearing, lubricant),
        _by_row(balance.rib_force),
        entrainment[:, None, None],
        row.rib_sliding_speed(speed)[:, None, None],
    )
    is_pressed = rib.pressure > 0.0
    return {
        "rib_pressure": rib.pressure.max(axis=2),
        "rib_film_ratio": np.where(is_pressed, rib.film_ratio, np.inf).min(axis=2),
        "rib_power": rib.power.sum(axis=2),
        "rib_sliding_speed": float(row.rib_sliding_speed(float(speed.mean()))),
    }
