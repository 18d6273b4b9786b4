"""Static load rating, equivalent load and safety of radial roller bearings by ISO 76:2006."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray


def static_load_rating(
    rows: int, rollers_per_row: int, roller_diameter: float, roller_length: float, contact_angle: float, pitch: float
) -> float:
    """Basic static radial load rating, C0 = 44 (1 - Dw cos(alpha)/Dpw) i Z L Dw cos(alpha), C0 in N, lengths in mm.

    Parameters
    ----------
    rows : int
        Number of rows i [-].
    rollers_per_row : int
        Rollers in a row Z [-].
    roller_diameter, roller_length : float
        Dw and effective length L [m]; Dw of a barrel roller is taken at its middle.
    contact_angle : float
        alpha [rad], 0 to below pi/2.
    pitch : float
        Pitch diameter of the roller centres Dpw [m], above Dw cos(alpha).

    Returns
    -------
    float
        C0 [N]: the load at which the most loaded contact of a bearing loaded over half its circumference has a
        pressure of 4000 MPa by the standard's line contact.

    References
    ----------
    ISO 76:2006, Rolling bearings - Static load ratings, equation (15).

    Examples
    --------
    >>> round(static_load_rating(2, 28, 0.070, 0.106, math.radians(11.2), 2 * 0.3727) / 1e3)
    16283
    """
    projected = roller_diameter * math.cos(contact_angle)
    return 44e6 * (1.0 - projected / pitch) * rows * rollers_per_row * roller_length * projected


def static_equivalent_load(radial_load: ArrayLike, axial_load: ArrayLike, factor_y0: float) -> NDArray[np.float64]:
    """Static equivalent radial load of a double-row bearing, P0 = Fr + Y0 |Fa|.

    Parameters
    ----------
    radial_load : array_like
        Fr [N], not negative.
    axial_load : array_like
        Fa [N], either sign.
    factor_y0 : float
        Y0 [-] of the catalogue; 0.44 cot(alpha) in the standard.

    Returns
    -------
    ndarray
        P0 [N].

    References
    ----------
    ISO 76:2006, section 6.2, with X0 = 1 for double-row bearings.

    Examples
    --------
    >>> float(static_equivalent_load(300e3, -100e3, 2.2))
    520000.0
    """
    return np.asarray(radial_load, float) + factor_y0 * np.abs(axial_load)


def static_safety(static_load_rating: float, equivalent_load: ArrayLike) -> NDArray[np.float64]:
    """Static safety factor S0 = C0/P0 [-]; infinite without load.

    Examples
    --------
    >>> round(float(static_safety(16300e3, 520e3)), 2)
    31.35
    """
    with np.errstate(divide="ignore"):
        return static_load_rating / np.asarray(equivalent_load, float)
