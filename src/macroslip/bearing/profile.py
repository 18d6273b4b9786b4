"""Profile of a roller that touches straight raceways along a line."""

from __future__ import annotations

#: Profiles that a cylindrical roller may have in place of a crown.
STRAIGHT = "straight"
LOGARITHMIC = "logarithmic"
PROFILES = (STRAIGHT, LOGARITHMIC)
#: Depth of the logarithmic profile over the roller's diameter [-], per contact.
PROFILE_DEPTH = 0.00035
#: Length over diameter up to which the standard has that profile [-].
LONGEST_LOGARITHMIC = 2.5


def profile_depth(roller_diameter: float) -> float:
    """Depth d of the logarithmic profile d ln 1/(1 − (2ζ/L)²), per contact [m].

    Arguments are the roller's diameter Dw [m]; its length is at most 2.5 Dw.

    ISO/TS 16281:2008, section 5.4.

    Examples
    --------
    >>> round(1e6 * profile_depth(0.062), 2)
    21.7
    """
    return PROFILE_DEPTH * roller_diameter


def profile_crown(roller_length: float, roller_diameter: float) -> float:
    """Radius of the crown that the profile has at the roller's middle, L²/(8 d) [m].

    Examples
    --------
    >>> round(profile_crown(0.107, 0.062), 1)
    66.0
    """
    return roller_length**2 / (8.0 * profile_depth(roller_diameter))
