"""Pressure, film, friction, smearing and wear at the ribs of a tapered roller bearing."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import RectBivariateSpline

from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.contact.mechanisms import Laws
from macroslip.contact.rib import RibContact, RibState, rib_contact, rib_state
from macroslip.damage.rib import pass_energy, rib_flash_temperature
from macroslip.lubricant import Lubricant

#: Surfaces that wear at the ribs.
RIB_SURFACES = ("rib", "roller end")
#: Loads and speeds of the spline of the films' friction, and their least parts of the largest ones.
_KNOTS = (40, 10)
_LOAD_RANGE = 1e-3
_SPEED_RANGE = 1e-3
#: Least load of a film [N].
LEAST_LOAD = 1e-3
#: Least speed of a surface [m/s], in place of a shaft at rest.
LEAST_SPEED = 1e-9


class _Speeds(NamedTuple):
    """Speeds of a bearing's parts at the rib, shape (time, 1, 1)."""

    sliding: np.ndarray  #: v_f [m/s]
    rib: np.ndarray  #: Of the rib past the contact [m/s]
    roller: np.ndarray  #: Of the roller's end past the contact [m/s]
    past_rollers: np.ndarray  #: Revolutions of the inner ring past the rollers [1/s]
    spin: np.ndarray  #: Revolutions of a roller in the frame of the cage [1/s]


def _speeds(bearing: TaperedBearing, shaft_speed: np.ndarray) -> _Speeds:
    """Speeds at the rib in pure rolling."""
    row = tapered_geometry(bearing)
    speed = shaft_speed[:, None, None]
    past = (1.0 - row.orbit_ratio) * speed
    spin = row.spin_ratio * speed
    return _Speeds(
        sliding=row.rib_sliding_speed(speed),
        rib=np.maximum(past * row.rib_radius, LEAST_SPEED),
        roller=np.maximum(spin * row.rib_radius_on_roller, LEAST_SPEED),
        past_rollers=past / (2.0 * np.pi),
        spin=spin / (2.0 * np.pi),
    )


def rib_values(
    bearing: TaperedBearing,
    lubricant: Lubricant,
    rib_force: np.ndarray,
    shaft_speed: np.ndarray,
    laws: Laws | None = None,
) -> dict[str, Any]:
    """Friction, pressure and flash temperature of the ribs, by variable of `tapered_history`.

    Parameters
    ----------
    bearing : TaperedBearing
    lubricant : Lubricant
        At its temperature.
    rib_force : ndarray, shape (time, row, roller)
        F_f of every roller [N].
    shaft_speed : ndarray, shape (time,)
        Speed of the inner ring [rad/s], not negative.
    laws : Laws, optional
        Laws of the film's shear; `Laws.physical()` without them.

    Returns
    -------
    dict
        Values over (time, row); `rib_asperity_work` over (time, row, surface).
    """
    speeds = _speeds(bearing, shaft_speed)
    entrainment = 0.5 * (speeds.rib + speeds.roller)
    contact = rib_contact(bearing, lubricant)
    coefficient = _film_coefficient(contact, rib_force, entrainment, speeds.sliding, laws)
    rib = rib_state(contact, rib_force, entrainment, speeds.sliding, film_coefficient=coefficient)
    pressed = rib.pressure > 0.0
    total = rib_force.sum(axis=2)
    force = (rib.friction_coefficient * rib_force).sum(axis=2)
    friction = force / np.where(total > 0.0, total, 1.0)
    largest = rib.pressure.max(axis=2)
    return {
        "rib_pressure": largest,
        "rib_pressure_speed": largest * speeds.sliding[:, :, 0],
        "rib_film_ratio": np.where(pressed, rib.film_ratio, np.inf).min(axis=2),
        "rib_friction": friction,
        "rib_asperity_share": rib.asperity_share.max(axis=2),
        "rib_ellipse_margin": bearing.rib_contact_height - rib.half_across.max(axis=2),
        "rib_power": rib.power.sum(axis=2),
        "rib_sliding_speed": float(speeds.sliding.mean()),
        **_suffered(rib, speeds),
    }


def _film_coefficient(
    contact: RibContact,
    load: np.ndarray,
    entrainment: np.ndarray,
    sliding: np.ndarray,
    laws: Laws | None,
) -> np.ndarray:
    """Friction of the films over their loads [-], by a spline over load and speed.

    Both speeds go with that of the shaft. Loads below a thousandth of the largest, whose friction
    does not count, are taken as that.
    """
    largest = max(float(load.max()), LEAST_LOAD)
    loads = np.geomspace(_LOAD_RANGE * largest, largest, _KNOTS[0])
    fastest = int(sliding.argmax())
    highest_speed = max(sliding.max(), LEAST_SPEED)
    slowest = float(sliding.min() / highest_speed)
    # A shaft of one speed needs knots as well.
    lowest_part = max(0.999 * slowest, _SPEED_RANGE)
    parts = np.geomspace(lowest_part, 1.0, _KNOTS[1])
    fastest_entrainment = max(entrainment.flat[fastest], LEAST_SPEED)
    fastest_sliding = max(sliding.flat[fastest], LEAST_SPEED)
    state = rib_state(
        contact,
        loads[:, None],
        parts * fastest_entrainment,
        parts * fastest_sliding,
        laws,
    )
    boundary = contact.lubricant.boundary_friction * state.asperity_share
    fluid = state.friction_coefficient - boundary
    film = fluid / (1.0 - state.asperity_share)
    spline = RectBivariateSpline(np.log(loads), np.log(parts), film)
    part = np.clip(sliding / fastest_sliding, parts[0], 1.0)
    part_of_rollers = np.broadcast_to(part, load.shape)
    carried = np.clip(load, loads[0], loads[-1])
    return spline.ev(np.log(carried), np.log(part_of_rollers))


def _suffered(rib: RibState, speeds: _Speeds) -> dict[str, np.ndarray]:
    """Work of a pass, flash temperature and asperities' work of both surfaces."""
    along = rib.half_along
    on_rib = pass_energy(rib.pressure, along, speeds.sliding, speeds.rib)
    on_roller = pass_energy(rib.pressure, along, speeds.sliding, speeds.roller)
    flash = rib_flash_temperature(
        rib.pressure,
        along,
        rib.friction_coefficient,
        speeds.sliding,
        (speeds.rib, speeds.roller),
    )
    # A place of the rib meets all rollers of its row once a revolution past them, a place of a
    # roller's circle of contact meets the rib once a turn of the roller.
    asperities_on_rib = on_rib * rib.asperity_share
    asperities_on_roller = on_roller * rib.asperity_share
    rib_work = asperities_on_rib.sum(axis=2) * speeds.past_rollers[:, :, 0]
    roller_work = asperities_on_roller.max(axis=2) * speeds.spin[:, :, 0]
    return {
        "rib_pass_energy": on_rib.max(axis=2),
        "rib_flash_temperature": flash.max(axis=2),
        "rib_asperity_work": np.stack([rib_work, roller_work], axis=2),
    }
