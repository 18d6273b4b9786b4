"""Pressure along tapered rollers, load at their edges, microslip and room of loose ones, by strips."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.bearing.tapered import TaperedGeometry
from macroslip.contact.line import line_pressure, strip_places
from macroslip.contact.line_rolling import LineContact
from macroslip.ring.tapered import TaperedBalance, TaperedRing, strip_loads

#: Part of a roller's length at each end whose load is a result.
EDGE = 0.1


class RacewayStrips(NamedTuple):
    """Pressures and microslip of the inner raceway's strips, by sample and row."""

    pressure: np.ndarray  #: Shape (time, row). Largest pressure [Pa]
    edge_pressure: np.ndarray  #: Shape (time, row). Largest one in the outer tenths [Pa]
    edge_share: np.ndarray  #: Shape (time, row). Load there over that of the hardest roller [-]
    along: np.ndarray  #: Shape (time, row, strip). Pressure along the hardest roller [Pa]
    microslip: np.ndarray  #: Shape (time, row). Mean of |v| on the hardest roller by load [m/s]


def edge_strips(length: float, strips: int) -> np.ndarray:
    """Parts of strips that lie in the outer tenths of a roller [-], shape (strips,).

    Examples
    --------
    >>> edge_strips(0.1, 5).round(9).tolist()
    [0.5, 0.0, 0.0, 0.0, 0.5]
    """
    width = 1.0 / strips
    from_middle = np.abs(strip_places(length, strips)) / length
    # Of the strip's outer edge from the roller's end.
    from_end = 0.5 - from_middle - 0.5 * width
    covered = (EDGE - from_end) / width
    return np.clip(covered, 0.0, 1.0)


def microslip(
    row: TaperedGeometry, shaft_speed: float, profile: np.ndarray, tilt: float, loads: np.ndarray
) -> float:
    """Mean slip along a roller's line of contact with the inner raceway, by load [m/s].

    Parameters
    ----------
    row : TaperedGeometry
    shaft_speed : float
        Speed of the inner ring Ω_in [rad/s].
    profile : ndarray, shape (k,)
        Drop of the profile P at strips of equal width [m].
    tilt : float
        Tilt γ of the ring's section relative to the roller [rad].
    loads : ndarray, shape (k,)
        Loads of the strips [N], one at least above 0.

    Returns
    -------
    float
        Mean of |v|, v(ζ) = −w_i P/2 − (|ω_rel| − Ω_rel cos α_i) γ ζ/2 + Δu (1 + ζ/A), with Δu for
        which as much load slides forwards as backwards.

    Notes
    -----
    The interface lies midway between the undeformed surfaces of a roller that is lower by P at ζ
    than its cone; the cones themselves share an apex and do not slide on each other.
    """
    stations = strip_places(row.roller_length, profile.size)
    spin = row.spin_ratio * shaft_speed
    ring = (1.0 - row.orbit_ratio) * shaft_speed
    turning = spin - ring * math.cos(row.inner_angle)
    uneven = -0.5 * row.inner_rolling_ratio * shaft_speed * profile
    uneven -= 0.5 * turning * tilt * stations
    taper = 1.0 + stations / row.apex_distance
    # Forwards and backwards carry alike where −Δu is the median of v/(1 + ζ/A) by load.
    order = np.argsort(uneven / taper)
    below = np.cumsum(loads[order])
    half = 0.5 * below[-1]
    middle = order[np.searchsorted(below, half)]
    balanced = uneven[middle] / taper[middle]
    slip = uneven - balanced * taper
    weighted = np.abs(slip) * loads
    return float(weighted.sum() / loads.sum())


def raceway_strips(
    row: TaperedGeometry,
    ring: TaperedRing,
    balance: TaperedBalance,
    shaft_angle: np.ndarray,
    shaft_speed: np.ndarray,
    contact: LineContact,
    rollers: int,
) -> RacewayStrips:
    """Pressure, edges and microslip at the inner raceway over a load history.

    Parameters
    ----------
    row : TaperedGeometry
    ring : TaperedRing
    balance : TaperedBalance
        Of the ring.
    shaft_angle, shaft_speed : ndarray, shape (n,)
        Angles [rad] and speeds [rad/s] of the shaft.
    contact : LineContact
        Of the inner raceway.
    rollers : int
        Number of rollers in a row.

    Returns
    -------
    RacewayStrips
    """
    count = ring.profile.size
    rows = ring.sign.size // rollers
    width = contact.length / count
    at_edge = edge_strips(contact.length, count)
    over = (len(shaft_angle), rows)
    pressure = np.zeros(over)
    edge_pressure = np.zeros(over)
    edge_share = np.zeros(over)
    slip = np.zeros(over)
    along = np.zeros((*over, count))
    for sample in range(len(shaft_angle)):
        inner, _ = strip_loads(ring, balance, shaft_angle, sample)
        inner = inner.reshape(rows, rollers, count)
        largest = inner.max(axis=1)
        per_length = largest / width
        line_pressures = line_pressure(per_length, contact.curvature, contact.modulus)
        pressure[sample] = line_pressures.max(axis=1)
        edge_pressure[sample] = line_pressures[:, at_edge > 0.0].max(axis=1)
        for k in range(rows):
            hardest = int(inner[k].sum(axis=1).argmax())
            loads = inner[k, hardest]
            load = loads.sum()
            if load > 0.0:
                per_length = loads / width
                along[sample, k] = line_pressure(per_length, contact.curvature, contact.modulus)
                edge_share[sample, k] = (loads * at_edge).sum() / load
                tilt = _tilt(ring, balance, shaft_angle, sample, k * rollers + hardest)
                speed = abs(float(shaft_speed[sample]))
                slip[sample, k] = microslip(row, speed, ring.profile, tilt, loads)
    return RacewayStrips(pressure, edge_pressure, edge_share, along, slip)


def _tilt(
    ring: TaperedRing, balance: TaperedBalance, shaft_angle: np.ndarray, sample: int, roller: int
) -> float:
    """Approach of the inner raceway per ζ by the tilt of the ring relative to a roller [rad]."""
    angle = ring.angle[roller] + ring.orbit_ratio * shaft_angle[sample]
    turn_x, turn_y = balance.displacement[sample, 3:]
    in_meridian = turn_y * math.cos(angle) - turn_x * math.sin(angle)
    own = ring.sign[roller] * in_meridian
    relative = own - balance.roller_motion[sample, roller, 2]
    length = ring.inner_arm[-1] - ring.inner_arm[0]
    return float(relative * np.sign(length))


def axial_float(
    row: TaperedGeometry,
    ring: TaperedRing,
    balance: TaperedBalance,
    shaft_angle: np.ndarray,
) -> np.ndarray:
    """Way of a loose roller along its axis from the rib to where it wedges [m], shape (time, rollers).

    Parameters
    ----------
    row : TaperedGeometry
    ring : TaperedRing
    balance : TaperedBalance
        Of the ring.
    shaft_angle : ndarray, shape (n,)
        Shaft angles [rad].

    Returns
    -------
    ndarray
        g/(2 sin β), 0 where the roller is held. With the roller on rib and outer raceway g is its
        gap to the inner raceway; every step towards the apex takes 2 sin β of it.
    """
    angle = ring.angle + ring.orbit_ratio * shaft_angle[:, None]
    cosine = np.cos(angle)
    sine = np.sin(angle)
    dx, dy, dz, turn_x, turn_y = balance.displacement.T[..., None]
    tilt = turn_y * cosine - turn_x * sine
    radial = dx * cosine + dy * sine + ring.axial_position * tilt
    axial_at_row = dz - ring.pitch_radius * tilt
    axial = ring.sign * axial_at_row + ring.preload
    lean = row.axis_angle - row.rib_angle
    towards_rib = math.sin(lean) * radial - math.cos(lean) * axial
    # A roller that slides along the outer raceway by λ towards the apex touches the rib.
    along = -math.cos(row.half_cone_angle + row.rib_angle)
    shift = towards_rib / along
    cone_angle = 2.0 * row.half_cone_angle
    approach = ring.inner_radial * radial + ring.inner_axial * axial
    gap = -approach - shift * math.sin(cone_angle)
    return np.maximum(gap, 0.0) / (2.0 * math.sin(row.half_cone_angle))
