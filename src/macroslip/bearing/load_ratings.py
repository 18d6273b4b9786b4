"""Load ratings that follow from a bearing's inside.

Static (ISO 76), dynamic and fatigue limit (ISO 281).

Lengths are metres here; the standards' formulas hold for millimetres and newtons. Both ratings take
the number of rows i, of rollers in a row Z, Dw and effective length L of a roller [m] (Dw of a
barrel roller at its middle), alpha [rad] and the pitch diameter of the roller centres Dpw [m],
above Dw cos(alpha).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from macroslip.errors import InputError

if TYPE_CHECKING:
    from macroslip.bearing.kinds import AnyBearing

RATING_FACTORS = {"spherical": 1.15, "cylindrical": 1.1, "tapered": 1.1}
"""b_m by the kind of a roller bearing, ISO 281:2007, table 6."""
_GEOMETRY_FACTORS = (
    52.1, 60.8, 66.5, 70.7, 74.1, 76.9, 79.2, 81.2, 82.8, 84.2, 85.4, 86.4, 87.1, 87.7, 88.2,
    88.5, 88.7, 88.8, 88.8, 88.7, 88.5, 88.2, 87.9, 87.5, 87.0, 86.4, 85.8, 85.2, 84.5, 83.8,
)  # fmt: skip
"""f_c at gamma = 0.01, 0.02, ... 0.30, ISO 281:2007, table 7."""


def static_load_rating(
    rows: int,
    rollers_per_row: int,
    roller_diameter: float,
    roller_length: float,
    contact_angle: float,
    pitch: float,
) -> float:
    """Basic static radial load rating, C0 = 44 (1 - Dw cos(alpha)/Dpw) i Z L Dw cos(alpha).

    The formula holds for C0 in N and lengths in mm. At C0 the most loaded contact of a bearing
    loaded over half its circumference has a pressure of 4000 MPa by the standard's line contact.

    Parameters
    ----------
    rows : int
        Number of rows i.
    rollers_per_row : int
        Number of rollers in a row Z.
    roller_diameter : float
        Dw [m], of a barrel roller at its middle.
    roller_length : float
        Effective length L of a roller [m].
    contact_angle : float
        alpha [rad].
    pitch : float
        Pitch diameter of the roller centres Dpw [m], above Dw cos(alpha).

    Returns
    -------
    float
        C0 [N].

    References
    ----------
    ISO 76:2006, Rolling bearings - Static load ratings, equation (15).

    Examples
    --------
    >>> round(static_load_rating(2, 28, 0.070, 0.106, math.radians(11.2), 2 * 0.3727) / 1e3)
    16283
    """
    projected = roller_diameter * math.cos(contact_angle)
    gamma = projected / pitch
    return 44e6 * (1.0 - gamma) * rows * rollers_per_row * roller_length * projected


def geometry_factor(gamma: float) -> float:
    """Factor f_c [-] of radial roller bearings by linear interpolation in the standard's table.

    gamma is Dw cos(alpha)/Dpw [-], 0.01 to 0.30; outside, InputError. ISO 281:2007, table 7. Its
    values are 172.56 gamma^(2/9) (1 - gamma)^(29/27)/(1 + gamma)^(1/4) {1 + [1.04 ((1 - gamma)/(1 +
    gamma))^(143/108)]^(9/2)}^(-2/9), which is Lundberg and Palmgren's theory, to 0.05.

    Examples
    --------
    >>> geometry_factor(0.10), round(geometry_factor(0.0921), 2)
    (84.2, 83.09)
    """
    table = np.arange(1, len(_GEOMETRY_FACTORS) + 1) / 100.0
    if not table[0] <= gamma <= table[-1]:
        fault = f"the ratio of roller to pitch diameter, Dw cos(alpha)/Dpw, is {gamma:.4g}"
        remedy = "Check roller diameter, pitch radius and contact angle."
        raise InputError(
            fault, where="dynamic load rating by ISO 281", allowed="0.01 to 0.30", remedy=remedy
        )
    return float(np.interp(gamma, table, _GEOMETRY_FACTORS))


def dynamic_load_rating(
    rows: int,
    rollers_per_row: int,
    roller_diameter: float,
    roller_length: float,
    contact_angle: float,
    pitch: float,
    kind: str = "spherical",
) -> float:
    """Basic dynamic radial load rating, C = b_m f_c (i L cos(alpha))^(7/9) Z^(3/4) Dw^(29/27).

    The formula holds for C in N and lengths in mm. Makers' catalogues have other values: for
    spherical roller bearings of one size they differ by up to 37 % among each other.

    Parameters
    ----------
    rows : int
        Number of rows i.
    rollers_per_row : int
        Number of rollers in a row Z.
    roller_diameter : float
        Dw [m], of a barrel roller at its middle.
    roller_length : float
        Effective length L of a roller [m].
    contact_angle : float
        alpha [rad].
    pitch : float
        Pitch diameter of the roller centres Dpw [m], above Dw cos(alpha).
    kind : {"spherical", "cylindrical", "tapered"}
        Kind of the roller bearing, with b_m = 1.15, 1.1 and 1.1.

    Returns
    -------
    float
        C [N].

    Raises
    ------
    InputError
        If Dw cos(alpha)/Dpw lies outside 0.01 to 0.30.

    References
    ----------
    ISO 281:2007, Rolling bearings - Dynamic load ratings and rating life, section 7.1.

    Examples
    --------
    >>> round(dynamic_load_rating(2, 28, 0.070, 0.106, math.radians(11.2), 2 * 0.3727) / 1e3)
    7084
    """
    cosine = math.cos(contact_angle)
    gamma = roller_diameter * cosine / pitch
    factor = geometry_factor(gamma)
    length = rows * roller_length * 1e3 * cosine
    diameter = roller_diameter * 1e3
    return (
        RATING_FACTORS[kind]
        * factor
        * length ** (7 / 9)
        * rollers_per_row**0.75
        * diameter ** (29 / 27)
    )


def fatigue_load_limit(static_load_rating: float, pitch: float) -> float:
    """Fatigue load limit of a roller bearing, C_u = C0/8.2 (100 mm/Dpw)^0.3.

    C0/8.2 up to a pitch of 100 mm.

    From C0 [N] and the pitch diameter Dpw [m]: ISO 281:2007, annex B.3.3 (simplified method),
    roller bearings.

    Examples
    --------
    >>> round(fatigue_load_limit(16300e3, 0.7454) / 1e3)
    1088
    """
    by_size = min(1.0, (0.1 / pitch) ** 0.3)
    return static_load_rating / 8.2 * by_size


def static_load_rating_of(bearing: AnyBearing) -> float:
    """C0 [N] of a bearing's inside, by `static_load_rating`."""
    return static_load_rating(*_inside(bearing))


def dynamic_load_rating_of(bearing: AnyBearing) -> float:
    """C [N] of a bearing's inside, by `dynamic_load_rating`."""
    return dynamic_load_rating(*_inside(bearing), kind=bearing.kind)


def _inside(bearing: AnyBearing) -> tuple[int, int, float, float, float, float]:
    """Rows, rollers in each, diameter and length of one [m], nominal angle [rad], pitch [m]."""
    return (
        bearing.rows,
        bearing.rollers_per_row,
        bearing.roller_diameter,
        bearing.roller_length,
        bearing.nominal_contact_angle,
        2.0 * bearing.pitch_radius,
    )
