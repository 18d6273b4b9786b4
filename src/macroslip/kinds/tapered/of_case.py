"""A case and its result with a tapered roller bearing: preload, ring balance, ribs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.bearing.tapered import TaperedBearing
from macroslip.contact.strips import load_at_pressure, strips_of
from macroslip.contact.traction import HIGHEST_PRESSURE
from macroslip.errors import InputError
from macroslip.kinds.tapered.checks import check_moment, check_preload
from macroslip.kinds.tapered.history import TaperedMount, warmed
from macroslip.kinds.tapered.ribs import rib_values
from macroslip.loads import HubLoads
from macroslip.ring.grip import grip_load
from macroslip.ring.tapered import ROW_SIGNS, tapered_ring
from macroslip.ring.tapered_motion import TaperedMotion, tapered_motion

if TYPE_CHECKING:
    from macroslip.kinds.read_case import ReadCase

#: Variables of the ribs' history whose largest value in the window a result has.
_RIB_EXTREMES = (
    "rib_pressure",
    "rib_pressure_speed",
    "rib_pass_energy",
    "rib_flash_temperature",
)


def warm_bearing(case: ReadCase) -> TaperedBearing:
    """The bearing of a case with the preload that its temperature difference leaves.

    Two single rows of its kind, at their distance, where the mount has them.
    """
    mount = _mount_of(case)
    mounted = case.bearing if mount is None else mount.mounted(case.bearing)
    return warmed(mounted, case.temperature_difference)


def _mount_of(case: ReadCase) -> TaperedMount | None:
    """How the shaft of a case is held; None where the force on the bearing is given."""
    if not isinstance(case.loads, HubLoads):
        return None
    return TaperedMount.of(case.drivetrain)


def tapered_ring_motion(case: ReadCase) -> TaperedMotion:
    """Balance of the ring of a case over its loads.

    Parameters
    ----------
    case : ReadCase
        Of a tapered roller bearing.

    Returns
    -------
    TaperedMotion

    Raises
    ------
    InputError
        If a roller's load is beyond all pressures of the tables, or the preload leaves its range.
    MacroslipError
        If a balance was not found.
    """
    mount = _mount_of(case)
    warm = warm_bearing(case)
    ring = tapered_ring(warm) if mount is None else mount.ring(warm)
    check_preload(warm, ring)
    moments = case.ring_moments
    check_moment(warm, ring, moments)
    ring_motion = tapered_motion(case.ring_loads, moments, ring)
    _refuse(case, ring_motion)
    return ring_motion


def _refuse(case: ReadCase, ring_motion: TaperedMotion) -> None:
    """InputError for a load of a roller that no bearing steel carries."""
    largest = float(ring_motion.balance.outer_load.max())
    inner, _ = strips_of(case.bearing)
    limit = load_at_pressure(inner, HIGHEST_PRESSURE)
    if largest <= limit:
        return
    largest_of_samples = ring_motion.balance.outer_load.max(axis=1)
    sample = int(largest_of_samples.argmax())
    raise InputError(
        f"a roller carries {largest / 1e3:.4g} kN, with a pressure above {HIGHEST_PRESSURE / 1e9:g} GPa",
        where=f"{case.loads.source}, t = {ring_motion.motion.time[sample]:g} s",
        allowed=f"roller loads up to {limit / 1e3:.4g} kN for {case.bearing.name}",
        remedy="Check units and signs of the loads, the preload with temperature_difference, and the "
        "bearing's size.",
    )


def rib_energies(ribs: np.ndarray) -> dict[str, Any]:
    """Energies and peaks of power at the ribs, by the name of the variable.

    Parameters
    ----------
    ribs : ndarray, shape (row, roller, orbits + 1, 3)
        As `rib` of `macroslip.measures.totals.Totals`.
    """
    return {
        "rib_energy": ribs[..., 0].sum(axis=2),
        "rib_asperity_energy": ribs[..., 1].sum(axis=2),
        "rib_orbit_energy": ribs[:, :, :-1, 0],
        "rib_peak_power": ribs[:, :, :-1, 2],
    }


def ring_values(
    case: ReadCase, ring_motion: TaperedMotion, window: tuple[float, float]
) -> dict[str, Any]:
    """Preload, extremes of the balance in the window, and of the ribs, by the name of the variable.

    Parameters
    ----------
    case : ReadCase
        Of a tapered roller bearing.
    ring_motion : TaperedMotion
        Of the case.
    window : tuple of float
        Start and end of the window [s].
    """
    time = ring_motion.motion.time
    start, end = window
    inside = (time >= start) & (time <= end)
    balance = ring_motion.balance
    speed = np.abs(ring_motion.motion.shaft_speed[inside])
    loads = _by_row(balance.outer_load[inside])
    mean = float(speed.mean())
    grip = np.nan
    if mean > 0.0:
        grip = grip_load(case.bearing, case.oil, mean)
    tilt = balance.displacement[inside, 3:]
    below_grip = (loads < grip).sum(axis=2)
    warm = warm_bearing(case)
    return {
        "grip_load": np.array(grip),
        "rollers_below_grip": below_grip.mean(axis=0),
        "least_roller_load": loads.min(axis=(0, 2)),
        "largest_tilt": np.array(np.hypot(*tilt.T).max()),
        "preload": np.array(warm.preload),
        "preload_change": np.array(warm.preload - case.bearing.preload),
        **_rib_window(case, _by_row(balance.rib_force[inside]), speed),
    }


def _by_row(values: np.ndarray) -> np.ndarray:
    """Numbers of all rollers as (time, row, roller)."""
    return values.reshape(len(values), len(ROW_SIGNS), -1)


def _rib_window(case: ReadCase, force: np.ndarray, speed: np.ndarray) -> dict[str, Any]:
    """Extremes and mean work at the ribs over the window, of rollers that roll."""
    ribs = rib_values(case.bearing, case.oil, force, speed, case.laws)
    # A shaft at rest has no film.
    turning = (speed > 0.0)[:, None]
    film_ratio = np.where(turning, ribs["rib_film_ratio"], np.inf)
    ratio = film_ratio.min(axis=0)
    worn = {}
    if case.laws.asperities != "none":
        work = np.where(turning[..., None], ribs["rib_asperity_work"], 0.0)
        worn["rib_asperity_work"] = work.mean(axis=0)
    return {
        "largest_rib_force": force.max(axis=(0, 2)),
        "min_rib_film_ratio": np.where(np.isfinite(ratio), ratio, np.nan),
        **{name: ribs[name].max(axis=0) for name in _RIB_EXTREMES},
        **worn,
    }
