"""The imposed motion: shaft speed, shaft angle and ring displacement between load samples.

It gives the times too at which orbits are completed. Shaft speed and ring displacement are linear
between samples; the shaft angle is the exact integral of the speed. So a roller's path and load are
functions of time alone and do not depend on the integrator's steps. Rollers complete orbits
whatever the shaft does: the path they travel counts, forth and back.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_inline, uncounted
from macroslip.constants import TIME_ROUNDING


class Motion(NamedTuple):
    """Sampled motion of the inner ring, shared by all rollers."""

    time: np.ndarray  #: Shape (n,). Sample times [s], rising.
    shaft_speed: np.ndarray  #: Shape (n,). Ω_in [rad/s].
    shaft_angle: np.ndarray  #: Shape (n,). Angle turned since the first sample [rad].
    displacement: np.ndarray  #: Shape (n, 3). Ring displacement d = (dX, dY, dZ) [m].


def shaft_angle(time: np.ndarray, shaft_speed: np.ndarray) -> np.ndarray:
    """Angle turned by a shaft whose speed is linear between samples, the exact integral ∫Ω_in dt.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Rising times [s].
    shaft_speed : ndarray, shape (n,)
        Ω_in [rad/s].

    Returns
    -------
    ndarray, shape (n,)
        Angle [rad], zero at the first sample.

    Examples
    --------
    >>> shaft_angle(np.array([0.0, 1.0, 3.0]), np.array([0.0, 2.0, 2.0])).tolist()
    [0.0, 1.0, 5.0]
    """
    mean_speed = 0.5 * (shaft_speed[1:] + shaft_speed[:-1])
    turned = np.cumsum(mean_speed * np.diff(time))
    return np.concatenate([[0.0], turned])


class Instant(NamedTuple):
    """Motion of the inner ring at one time."""

    shaft_speed: float  #: Ω_in [rad/s]
    shaft_angle: float  #: Angle turned since the first sample [rad]
    displacement_x: float  #: dX [m]
    displacement_y: float  #: dY [m]
    displacement_z: float  #: dZ [m]


@jit_inline
def uncounted_motion(motion):
    """The motion with arrays whose references are not counted, for compiled functions.

    Parameters
    ----------
    motion : Motion

    Returns
    -------
    Motion
        With views of the same numbers.
    """
    time, speed, angle, displacement = motion
    return Motion(uncounted(time), uncounted(speed), uncounted(angle), uncounted(displacement))  # pyright: ignore[reportCallIssue]


@jit_inline
def last_before(times, time):
    """Index of the last of rising times that is not after a time.

    Parameters
    ----------
    times : ndarray, shape (n,)
        Rising times [s].
    time : float
        [s]

    Returns
    -------
    int
        Index; −1 if all times are later.

    Examples
    --------
    >>> last_before(np.array([0.0, 1.0, 2.0]), 1.5)
    1
    """
    low = 0
    high = times.size
    while low < high:
        middle = (low + high) // 2
        if times[middle] <= time:
            low = middle + 1
        else:
            high = middle
    return low - 1


@jit_inline
def interval_of(motion, time, start):
    """Index of the sample interval that holds a time.

    Parameters
    ----------
    motion : Motion
    time : float
        [s]
    start : int
        Index of the interval from which the search goes in either direction.

    Returns
    -------
    int
        Index; the first or last one for a time outside the history.

    Examples
    --------
    >>> motion = Motion(np.array([0.0, 1.0, 2.0]), np.ones(3), np.arange(3.0), np.zeros((3, 3)))
    >>> interval_of(motion, 1.5, 0)
    1
    """
    last = motion.time.size - 2
    k = start
    while k < last and time >= motion.time[k + 1]:
        k += 1
    while k > 0 and time < motion.time[k]:
        k -= 1
    return k


@jit_inline
def instant(motion, interval, time):
    """The ring's motion at a time, linear in speed and displacement between samples.

    Parameters
    ----------
    motion : Motion
    interval : int
        Index of the sample interval that holds the time.
    time : float
        [s]

    Returns
    -------
    Instant

    Examples
    --------
    >>> motion = Motion(np.array([0.0, 2.0]), np.array([1.0, 3.0]), np.array([0.0, 4.0]), np.zeros((2, 3)))
    >>> now = instant(motion, 0, 1.0)
    >>> float(now.shaft_speed), float(now.shaft_angle)
    (2.0, 1.5)
    """
    start = motion.time[interval]
    end = motion.time[interval + 1]
    since = time - start
    share = since / (end - start)
    speed = motion.shaft_speed[interval]
    rise = motion.shaft_speed[interval + 1] - speed
    near = motion.displacement[interval]
    far = motion.displacement[interval + 1]
    mean_speed = speed + 0.5 * rise * share
    angle = motion.shaft_angle[interval] + mean_speed * since
    x = near[0] + (far[0] - near[0]) * share
    y = near[1] + (far[1] - near[1]) * share
    z = near[2] + (far[2] - near[2]) * share
    return Instant(speed + rise * share, angle, x, y, z)


def merged_times(times: np.ndarray, anchors: np.ndarray) -> np.ndarray:
    """Times [s], of which those that differ from an anchor by rounding alone are the anchor.

    Times that are the same in exact arithmetic, such as the end of the last orbit and that of the
    loads, are then the same number, and no step of an integration lies between them.

    Parameters
    ----------
    times : ndarray
        Times [s], in any order.
    anchors : ndarray
        Rising times [s] that stay as they are, one at least.

    Returns
    -------
    ndarray
        As `times`, each within `TIME_ROUNDING` of the largest time replaced by the nearest anchor.

    Examples
    --------
    >>> merged_times(np.array([0.1 + 0.2, 0.5]), np.array([0.0, 0.3, 0.6])).tolist()
    [0.3, 0.5]
    """
    last = anchors.size - 1
    after = np.searchsorted(anchors, times)
    after = np.clip(after, 1, max(last, 1))
    below = anchors[after - 1]
    above = anchors[np.minimum(after, last)]
    below_is_nearer = times - below <= above - times
    nearest = np.where(below_is_nearer, below, above)
    largest = max(abs(anchors[0]), abs(anchors[-1]))
    is_anchor = np.abs(times - nearest) <= TIME_ROUNDING * largest
    return np.where(is_anchor, nearest, times)


def angle_at(motion: Motion, time: np.ndarray) -> np.ndarray:
    """Angle that the shaft has turned since the first sample, at times of the history.

    Parameters
    ----------
    motion : Motion
    time : ndarray
        Times [s].

    Returns
    -------
    ndarray
        Angles [rad], of the shape of the times.

    Examples
    --------
    >>> motion = Motion(np.array([0.0, 2.0]), np.array([1.0, 3.0]), np.array([0.0, 4.0]), np.zeros((2, 3)))
    >>> angle_at(motion, np.array([0.0, 1.0, 2.0])).tolist()
    [0.0, 1.5, 4.0]
    """
    before = np.searchsorted(motion.time, time, side="right") - 1
    k = np.clip(before, 0, motion.time.size - 2)
    since = time - motion.time[k]
    speed = motion.shaft_speed[k]
    rise = motion.shaft_speed[k + 1] - speed
    span = motion.time[k + 1] - motion.time[k]
    acceleration = rise / span
    mean_speed = speed + 0.5 * acceleration * since
    return motion.shaft_angle[k] + mean_speed * since


def travel(time: np.ndarray, shaft_speed: np.ndarray, orbit_ratio: float) -> np.ndarray:
    """Angle travelled by the rollers along their orbit, ∫|Ω| dt [rad].

    It is exact for a shaft speed that is linear between samples.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Rising times [s].
    shaft_speed : ndarray, shape (n,)
        Ω_in [rad/s].
    orbit_ratio : float
        Ω/Ω_in [-].

    Returns
    -------
    ndarray, shape (n,)
        Angle [rad], zero at the first time; it never falls.

    Examples
    --------
    >>> travel(np.array([0.0, 2.0]), np.array([1.0, -1.0]), 0.5).tolist()
    [0.0, 0.5]
    """
    near = shaft_speed[:-1] * orbit_ratio
    far = shaft_speed[1:] * orbit_ratio
    span = np.diff(time)
    straight = 0.5 * np.abs(near + far) * span
    squares = near**2 + far**2
    with np.errstate(invalid="ignore", divide="ignore"):
        turning = 0.5 * squares / np.abs(far - near) * span
    turns_back = near * far < 0.0
    ways = np.where(turns_back, turning, straight)
    return np.concatenate([[0.0], np.cumsum(ways)])


def orbit_times(time: np.ndarray, shaft_speed: np.ndarray, orbit_ratio: float) -> np.ndarray:
    """Times at which the rollers have completed 1, 2, 3, … orbits [s].

    Parameters
    ----------
    time : ndarray, shape (n,)
        Rising times [s].
    shaft_speed : ndarray, shape (n,)
        Ω_in [rad/s].
    orbit_ratio : float
        Ω/Ω_in [-].

    Returns
    -------
    ndarray, shape (orbits,)
        Times [s]; empty if no orbit is completed.

    Examples
    --------
    >>> orbit_times(np.array([0.0, 10.0]), np.full(2, 2.0 * math.pi), 0.25).tolist()
    [4.0, 8.0]
    """
    speed = shaft_speed * orbit_ratio
    turns = np.flatnonzero(speed[:-1] * speed[1:] < 0.0)
    before = speed[turns]
    fall = before - speed[turns + 1]
    until_zero = np.diff(time)[turns] * before / fall
    zeros = time[turns] + until_zero
    # Between these times the speed has one sign and goes straight.
    time = np.insert(time, turns + 1, zeros)
    speed = np.insert(np.abs(speed), turns + 1, 0.0)
    path = travel(time, speed, 1.0)
    # Rounding of the sum may take a little from the last orbit of a whole number; it is given back.
    rounding = 4e-16 * (time.size + 10)
    full_turn = 2.0 * math.pi
    whole_path = path[-1]
    count = math.floor(whole_path / full_turn * (1.0 + rounding))
    targets = full_turn * np.arange(1, count + 1)
    targets = np.minimum(targets, whole_path)
    k = np.searchsorted(path, targets, side="left") - 1
    since = targets - path[k]
    start = time[k]
    end = time[k + 1]
    start_speed = speed[k]
    acceleration = (speed[k + 1] - start_speed) / (end - start)
    square = start_speed**2 + 2.0 * acceleration * since
    speed_there = np.sqrt(np.maximum(square, 0.0))
    mean_speed = 0.5 * (start_speed + speed_there)
    return np.minimum(start + since / mean_speed, end)
