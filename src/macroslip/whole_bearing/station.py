"""What the rollers meet at one time: ring speed, pocket angles, loads and tangential body forces."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_called, jit_inline
from macroslip.ring.orbit import instant
from macroslip.roller.forces import interference
from macroslip.roller.play import film_load
from macroslip.whole_bearing.tuning import FILM_REACH


class Stations(NamedTuple):
    """Of all rollers at one time.

    Attributes
    ----------
    angle, cosine, sine : ndarray, shape (n,)
        The pocket's angle θ [rad], not wound back to one turn, with its cosine and sine.
    inner_load, outer_load, elastic_load : ndarray, shape (n,)
        Normal loads with body forces and the rings' load alone [N].
    tangential : ndarray, shape (n,)
        G = F_g,x' + F_d,x' [N], against the orbit.
    inner_speed, outer_speed : ndarray, shape (n,)
        Speed u2 of the rings past the roller's centre [m/s].
    film : ndarray, shape (n, 4)
        What films carry beside the rings' load [N], and the interference [m], body force [N] and ring speed [m/s] at which.
    """

    angle: np.ndarray
    cosine: np.ndarray
    sine: np.ndarray
    inner_load: np.ndarray
    outer_load: np.ndarray
    elastic_load: np.ndarray
    tangential: np.ndarray
    inner_speed: np.ndarray
    outer_speed: np.ndarray
    film: np.ndarray


def new_stations(count: int) -> Stations:
    """Empty arrays for `count` rollers."""
    names = [name for name in Stations._fields if name != "film"]
    return Stations(*(np.zeros(count) for _ in names), film=np.full((count, 4), np.nan))


@jit_inline
def _film_load(films, load, place, known):
    """What films carry beside the load of the rings [N], found anew where the roller's place has changed by `FILM_REACH`.

    The place is interference [m], body force [N] and ring speed [m/s]. Rounding of it is far smaller than what changes.
    """
    near = load <= 0.0
    for k in range(3):
        near = near and abs(place[k] - known[k + 1]) <= FILM_REACH * abs(known[k + 1])
    if not near:
        approach, body, ring_speed = place
        known[0] = film_load(films, load, approach, body, ring_speed)
        known[1], known[2], known[3] = place
    return known[0]


@jit_called
def locate(bearing, motion, interval, time, state, cages, stations):
    """Fill `stations` for a time and a (predicted) state.

    Parameters
    ----------
    bearing : WholeBearing
    motion : Motion
    interval : int
        Sample interval that holds `time` [s].
    state : ndarray, shape (n, 3)
        v_in, v_out [m/s] and pocket offset x [m].
    cages : ndarray, shape (c, 6)
        w [m/s], lag ∫w dt [m], translation speeds p, q [m/s] and translations a, b [m].
    stations : Stations

    Returns
    -------
    float
        Shaft speed [rad/s].

    Notes
    -----
    A pocket is at θ = θ_0 + nominal orbit + ∫w dt/r~, and its roller at φ = θ + (x − a sin θ + b cos θ)/r~. The
    difference is at most some milliradians, and enters the roller's load and weight to first order.
    """
    now = instant(motion, interval, time)
    speed = now.shaft_speed
    pitch = bearing.pitch_radius
    rollers = bearing.rollers
    ratio = bearing.bodies[0].orbit_ratio
    for c in range(bearing.cages):
        turn = ratio * now.shaft_angle + cages[c, 1] / pitch
        turn_cosine, turn_sine = math.cos(turn), math.sin(turn)
        a, b = cages[c, 4], cages[c, 5]
        for j in range(rollers.row.size):
            if rollers.cage[j] != c:
                continue
            model = bearing.bodies[rollers.row[j]]
            cosine = rollers.cosine[j] * turn_cosine - rollers.sine[j] * turn_sine
            sine = rollers.sine[j] * turn_cosine + rollers.cosine[j] * turn_sine
            stations.angle[j], stations.cosine[j], stations.sine[j] = rollers.angle[j] + turn, cosine, sine
            ahead = (state[j, 2] - a * sine + b * cosine) / pitch
            half = 1.0 - 0.5 * ahead * ahead
            x, y = cosine * half - sine * ahead, sine * half + cosine * ahead
            approach = interference(model, x, y, now)
            load = model.stiffness * approach * math.sqrt(approach) if approach > 0.0 else 0.0
            ring = speed * rollers.inner_radius[j]
            orbit = 0.5 * (state[j, 0] - state[j, 1] + ring) / pitch
            outward = (model.centrifugal * orbit * orbit - model.weight_in_plane * y) * model.cos_contact_angle
            outward += model.weight_along_axis * model.sin_contact_angle
            stations.elastic_load[j] = load
            outer_speed = -orbit * bearing.outer_radius
            pressed = load + _film_load(bearing.films, load, (approach, outward, outer_speed), stations.film[j])
            stations.inner_load[j] = pressed - min(outward, 0.0)
            stations.outer_load[j] = pressed + max(outward, 0.0)
            stations.tangential[j] = model.weight_in_plane * x + model.drag * orbit * abs(orbit)
            stations.inner_speed[j] = orbit * rollers.inner_radius[j] - ring
            stations.outer_speed[j] = outer_speed
    return speed
