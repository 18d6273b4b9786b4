"""Smearing and wear where the rollers' large ends slide on the rib of a tapered roller bearing.

The rib slides in pure rolling, all the time and at every loaded roller. No published threshold is
known to hold for it beyond the rig that it is from, so that values are given and nothing is judged:
pressure times sliding speed, what a place of the rib suffers in one pass, the flash temperature, and
the wear of both surfaces where asperities carry.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from macroslip.arrays import FloatArray
from macroslip.contact.flash import effusivity, flash_temperature

#: Thermal effusivity of bearing steel [J/(m² K √s)], of 46 W/(m K), 7850 kg/m³ and 460 J/(kg K).
STEEL_EFFUSIVITY = float(effusivity(46.0, 7850.0, 460.0))


def pass_energy(
    pressure: ArrayLike, half_along: ArrayLike, sliding: ArrayLike, speed: ArrayLike
) -> FloatArray:
    """Pressure times slip at a point of a surface in one pass of the contact [J/m²].

    It is p0 v_f 2a/u. Times a coefficient of friction it is the friction energy per area, times the
    asperities' share and a wear coefficient [m²/N] the depth that wears (Archard).

    Parameters
    ----------
    pressure : array_like
        Largest pressure p0 [Pa].
    half_along : array_like
        Semi-axis a of the ellipse along rolling [m].
    sliding : array_like
        Sliding speed v_f [m/s], ≥ 0.
    speed : array_like
        Speed u of the surface past the contact [m/s], > 0.

    Examples
    --------
    The rib of the main bearing at 12 r/min under 17.9 kN:

    >>> round(float(pass_energy(260e6, 5.25e-3, 0.0417, 0.2587)) / 1e4, 1)
    44.0
    """
    length = 2.0 * np.asarray(half_along)
    time = length / np.asarray(speed)
    return np.asarray(pressure) * np.asarray(sliding) * time


def rib_flash_temperature(
    pressure: ArrayLike,
    half_along: ArrayLike,
    friction: ArrayLike,
    sliding: ArrayLike,
    speeds: tuple[ArrayLike, ArrayLike],
) -> FloatArray:
    """Flash temperature in the middle of the rib contact, above the bodies' own temperature [K].

    It is that of a band of half-width a with the power µ v_f p0 a π/2 per length.

    Parameters
    ----------
    pressure : array_like
        Largest pressure p0 [Pa].
    half_along : array_like
        Semi-axis a of the ellipse along rolling [m].
    friction : array_like
        Coefficient of friction µ [-].
    sliding : array_like
        Sliding speed v_f [m/s], ≥ 0.
    speeds : tuple of array_like
        Speeds of rib and roller's end past the contact [m/s].

    Examples
    --------
    A rib on asperities (µ 0.1) and one on a full film (µ 0.0007):

    >>> speeds = (0.2587, 0.2170)
    >>> [round(float(rib_flash_temperature(260e6, 5.25e-3, friction, 0.0417, speeds)), 2)
    ...  for friction in (0.1, 0.0007)]
    [7.72, 0.05]
    """
    along = np.asarray(half_along)
    power = 0.5 * math.pi * np.asarray(friction) * np.asarray(pressure) * along
    heat = power * np.asarray(sliding)
    half_width = np.where(along > 0.0, along, 1.0)
    return flash_temperature(heat, half_width, *speeds, STEEL_EFFUSIVITY, STEEL_EFFUSIVITY)
