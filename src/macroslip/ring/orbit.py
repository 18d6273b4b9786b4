"""The imposed motion: shaft speed, shaft angle and ring displacement between load samples, and when orbits are completed.

Shaft speed and ring displacement are linear between samples; the shaft angle is the exact integral of the speed. So a
roller's path and load are functions of time alone and do not depend on the integrator's steps. Rollers complete orbits
whatever the shaft does: the path they travel counts, forth and back.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit


class Motion(NamedTuple):
    """Sampled motion of the inner ring, shared by all rollers.

    Attributes
    ----------
    time : ndarray, shape (n,)
        Sample times [s], rising.
    shaft_speed : ndarray, shape (n,)
        Ω_in [rad/s].
    shaft_angle : ndarray, shape (n,)
        Angle turned since the first sample [rad].
    displacement : ndarray, shape (n, 3)
        Ring displacement d = (dX, dY, dZ) [m].
    """

    time: np.ndarray
    shaft_speed: np.ndarray
    shaft_angle: np.ndarray
    displacement: np.ndarray


def shaft_angle(time: np.ndarray, shaft_speed: np.ndarray) -> np.ndarray:
    """Exact integral of a piecewise linear shaft speed, zero at the first sample.

    Parameters
    ----------
    time : ndarray, shape (n,)
        [s].
    shaft_speed : ndarray, shape (n,)
        [rad/s].

    Returns
    -------
    ndarray, shape (n,)
        [rad].

    Examples
    --------
    >>> shaft_angle(np.array([0.0, 1.0, 3.0]), np.array([0.0, 2.0, 2.0])).tolist()
    [0.0, 1.0, 5.0]
    """
    steps = 0.5 * (shaft_speed[1:] + shaft_speed[:-1]) * np.diff(time)
    return np.concatenate([[0.0], np.cumsum(steps)])


class Instant(NamedTuple):
    """Shaft speed [rad/s], shaft angle [rad] and ring displacement [m] at one time."""

    shaft_speed: float
    shaft_angle: float
    displacement_x: float
    displacement_y: float
    displacement_z: float


@jit
def interval_of(motion, time, start):
    """Index of the sample interval that holds `time` [s], searched from interval `start` in either direction."""
    last = motion.time.size - 2
    k = start
    while k < last and time >= motion.time[k + 1]:
        k += 1
    while k > 0 and time < motion.time[k]:
        k -= 1
    return k


@jit
def instant(motion, interval, time):
    """The ring's motion at `time` [s] inside sample interval `interval`.

    Examples
    --------
    >>> motion = Motion(np.array([0.0, 2.0]), np.array([1.0, 3.0]), np.array([0.0, 4.0]), np.zeros((2, 3)))
    >>> now = instant(motion, 0, 1.0)
    >>> now.shaft_speed, now.shaft_angle
    (2.0, 1.5)
    """
    since = time - motion.time[interval]
    span = motion.time[interval + 1] - motion.time[interval]
    share = since / span
    speed = motion.shaft_speed[interval]
    rise = motion.shaft_speed[interval + 1] - speed
    near, far = motion.displacement[interval], motion.displacement[interval + 1]
    return Instant(
        speed + rise * share,
        motion.shaft_angle[interval] + (speed + 0.5 * rise * share) * since,
        near[0] + (far[0] - near[0]) * share,
        near[1] + (far[1] - near[1]) * share,
        near[2] + (far[2] - near[2]) * share,
    )


def angle_at(motion: Motion, time: np.ndarray) -> np.ndarray:
    """Angle that the shaft has turned since the first sample [rad], at times [s] of the history.

    Examples
    --------
    >>> motion = Motion(np.array([0.0, 2.0]), np.array([1.0, 3.0]), np.array([0.0, 4.0]), np.zeros((2, 3)))
    >>> angle_at(motion, np.array([0.0, 1.0, 2.0])).tolist()
    [0.0, 1.5, 4.0]
    """
    k = np.clip(np.searchsorted(motion.time, time, side="right") - 1, 0, motion.time.size - 2)
    since = time - motion.time[k]
    rise = (motion.shaft_speed[k + 1] - motion.shaft_speed[k]) / (motion.time[k + 1] - motion.time[k])
    return motion.shaft_angle[k] + (motion.shaft_speed[k] + 0.5 * rise * since) * since


def travel(time: np.ndarray, shaft_speed: np.ndarray, orbit_ratio: float) -> np.ndarray:
    """Angle travelled by the rollers along their orbit, ∫|Ω| dt, exact for piecewise linear shaft speed [rad].

    Parameters
    ----------
    time : ndarray, shape (n,)
        [s].
    shaft_speed : ndarray, shape (n,)
        Ω_in [rad/s].
    orbit_ratio : float
        Ω/Ω_in.

    Returns
    -------
    ndarray, shape (n,)
        Zero at the first sample, never falling.

    Examples
    --------
    >>> travel(np.array([0.0, 2.0]), np.array([1.0, -1.0]), 0.5).tolist()
    [0.0, 0.5]
    """
    near, far = shaft_speed[:-1] * orbit_ratio, shaft_speed[1:] * orbit_ratio
    span = np.diff(time)
    straight = 0.5 * np.abs(near + far) * span
    with np.errstate(invalid="ignore", divide="ignore"):
        turning = 0.5 * (near**2 + far**2) / np.abs(far - near) * span
    return np.concatenate([[0.0], np.cumsum(np.where(near * far < 0.0, turning, straight))])


def orbit_times(time: np.ndarray, shaft_speed: np.ndarray, orbit_ratio: float) -> np.ndarray:
    """Times at which the rollers have completed 1, 2, 3, … orbits [s].

    Parameters as for `travel`.

    Returns
    -------
    ndarray
        Rising; empty if not one orbit is completed.

    Examples
    --------
    >>> orbit_times(np.array([0.0, 10.0]), np.full(2, 2.0 * math.pi), 0.25).tolist()
    [4.0, 8.0]
    """
    path = travel(time, shaft_speed, orbit_ratio)
    found = []
    # Rounding of the sum may take a little from the last orbit of a whole number; it is given back.
    rounding = 4e-16 * (time.size + 10)
    for orbit in range(1, math.floor(path[-1] / (2.0 * math.pi) * (1.0 + rounding)) + 1):
        target = min(2.0 * math.pi * orbit, path[-1])
        k = min(int(np.searchsorted(path, target, side="left")), time.size - 1) - 1
        found.append(_time_in_interval(time, shaft_speed * orbit_ratio, path, k, target))
    return np.array(found)


def _time_in_interval(time: np.ndarray, speed: np.ndarray, path: np.ndarray, k: int, target: float) -> float:
    """Time at which the path reaches `target` inside interval k, by bisection on the exact integral."""
    start, end = float(time[k]), float(time[k + 1])
    first = float(speed[k])
    rate = (float(speed[k + 1]) - first) / (end - start)
    wanted = target - float(path[k])
    low, high = start, end
    while True:
        middle = 0.5 * (low + high)
        if not low < middle < high:
            return high
        last = first + rate * (middle - start)
        if first * last < 0.0:
            here = 0.5 * (first * first + last * last) / abs(rate)
        else:
            here = 0.5 * abs(first + last) * (middle - start)
        if here < wanted:
            low = middle
        else:
            high = middle
