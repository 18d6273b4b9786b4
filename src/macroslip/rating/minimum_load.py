"""The least load that makers require so that rollers do not skid."""

from __future__ import annotations

MINIMUM_SHARE = 0.01
"""Least equivalent load over static load rating of spherical roller bearings."""


def minimum_load(static_load_rating: float) -> float:
    """Least dynamic equivalent load of a spherical roller bearing, P_min = 0.01 C0.

    Parameters
    ----------
    static_load_rating : float
        C0 [N].

    Returns
    -------
    float
        P_min [N]. A rule of thumb: it depends on neither speed nor lubricant.

    References
    ----------
    SKF, Rolling bearings, catalogue 17000 EN (2018), chapter on spherical roller bearings, "Minimum load".

    Examples
    --------
    >>> minimum_load(16300e3)
    163000.0
    """
    return MINIMUM_SHARE * static_load_rating
