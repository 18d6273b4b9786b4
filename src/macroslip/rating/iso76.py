"""Static equivalent load and safety of radial roller bearings by ISO 76:2006."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


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
