"""Density of a lubricant under pressure."""

from __future__ import annotations


def dowson_higginson(pressure):
    """Density under pressure over density at ambient pressure, 1 + 0.6 p/(1 + 1.7 p) with p in GPa.

    Fitted to mineral oils up to 0.4 GPa and widely used beyond; it tends to 1.353.

    Parameters
    ----------
    pressure : array_like
        Pressure p above ambient [Pa], not negative.

    Returns
    -------
    ndarray
        Density ratio [-], 1 to 1.353.

    References
    ----------
    Dowson and Higginson, Elasto-hydrodynamic Lubrication, Pergamon (1966).

    Examples
    --------
    >>> round(dowson_higginson(1e9), 4)
    1.2222
    """
    return 1.0 + 0.6e-9 * pressure / (1.0 + 1.7e-9 * pressure)
