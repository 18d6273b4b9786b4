"""The imposed motion: shaft speed, shaft angle and ring displacement between load samples.

Shaft speed and ring displacement are linear between samples; the shaft angle is the exact integral of the speed. So a
roller's path and load are functions of time alone and do not depend on the integrator's steps.
"""

from __future__ import annotations

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
