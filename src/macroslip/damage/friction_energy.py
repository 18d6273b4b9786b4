"""Friction energy as pressure times slip, by which tests for white etching cracks are judged.

What counts is p |v|, without a coefficient of friction: e_a = ∫ p |v| dt of a pass over the time
between passes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from macroslip.arrays import FloatArray
from macroslip.damage.wear import slice_loads

REFERENCE = "FE8 test with washers 81212, 60 kN, 750 rpm, 20 h; slip from its geometry"


def pass_work(load_per_length, slip, speed):
    """∫ p |v| dt over one pass [J/m²], w |v|/u, with slip the same all along the chord that passes.

    Of the chord's load per length w [N/m], slip v, any sign, and the speed u > 0 with which the
    contact passes over the surface [m/s].

    Examples
    --------
    >>> round(float(pass_work(9.0e5, -5.0e-3, 0.396)))
    11364
    """
    return np.asarray(load_per_length) * np.abs(slip) / speed


def friction_power(work, passes_per_second):
    """e_a [W/m²]: `pass_work` [J/m²] times the passes a second.

    Examples
    --------
    >>> float(round(1e-6 * friction_power(1.15e4, 5.21), 4))
    0.0599
    """
    return np.asarray(work) * passes_per_second


@dataclass(frozen=True)
class ThrustTest:
    """A test with a cylindrical roller thrust bearing; by default FE8 with washers 81212.

    Its slip is imposed by geometry: the shaft's washer turns at Ω and the cage at Ω/2, so that a
    roller slips on either washer by v
    = (Ω/2) ζ, ζ from its middle.
    Number and size of the rollers are engineering estimates; the result hardly depends on them.
    """

    force: float = 60e3  #: Thrust [N]
    speed: float = 750.0 * math.pi / 30.0  #: Ω [rad/s]
    duration: float = 20.0 * 3600.0  #: Running time at which cracks are found [s]
    pitch_radius: float = 38.75e-3  #: [m]
    roller_length: float = 11e-3  #: [m]
    roller_diameter: float = 11e-3  #: [m]
    rollers: int = 15

    def power(self, profile: str = "uniform", slices: int = 200) -> tuple[FloatArray, FloatArray]:
        """Stations along the roller [m], outwards, and e_a of a washer there [W/m²].

        The load is even along the roller (`uniform`), or that of ISO/TS 16281's `logarithmic`
        profile, 0.00035 D ln 1/(1 − (2ζ/L)²), with its slices of 35 948 N/mm per mm^(10/9) made
        linear at the mean load.

        Examples
        --------
        At the middle of the washer's track F Ω/(8 π R) whatever the roller, and up to 5.6 W/mm² at
        its inner end:

        >>> test = ThrustTest()
        >>> offset, power = test.power()
        >>> float(round(1e-6 * power.max(), 2)), round(1e-6 * test.force * test.speed / (8 * math.pi * test.pitch_radius), 2)
        (5.61, 4.84)
        """
        width = self.roller_length / slices
        middles = (np.arange(slices) + 0.5) * width
        offset = np.asarray(middles - 0.5 * self.roller_length, dtype=np.float64)
        mean = self.force / (self.rollers * self.roller_length)
        load = np.full(slices, mean)
        if profile == "logarithmic":
            from_middle = 2.0 * offset / self.roller_length
            depth = 0.00035 * self.roller_diameter
            gap = depth * -np.log1p(-(from_middle**2))
            approach = 1e-3 * (1e-3 * mean / 35948.0) ** 0.9
            force = self.force / self.rollers
            stiffness = 10.0 / 9.0 * mean / approach
            load = slice_loads(gap, force, stiffness, width)
        radius = self.pitch_radius + offset
        passing = 0.5 * self.speed * radius
        slip = 0.5 * self.speed * offset
        work = pass_work(load, slip, passing)
        passes_a_second = self.rollers * 0.5 * self.speed / (2.0 * math.pi)
        return offset, friction_power(work, passes_a_second)

    def range(self) -> tuple[float, float]:
        """Largest e_a on the washers [W/m²], with the logarithmic profile and with even load.

        Examples
        --------
        >>> [float(round(1e-6 * one, 1)) for one in ThrustTest().range()]
        [3.9, 5.6]
        """
        _, profiled = self.power("logarithmic")
        _, even = self.power()
        return float(profiled.max()), float(even.max())
