"""Goksem and Hargreaves' rolling resistance of the inlet of an elastohydrodynamic line contact, and its heating."""

from __future__ import annotations

from macroslip.compiled import jit

#: What to cite.
REFERENCE = "Goksem and Hargreaves, J. Lubr. Technol. 100 (1978) 346 and 353, doi:10.1115/1.3453183"


@jit
def goksem_hargreaves(load, speed, material):
    """Rolling resistance of the inlet of a line contact, F_R α_p/(R l) = 4.318 (G U)^0.658 W^0.0126.

    Parameters
    ----------
    load : float
        W = w/(E' R), > 0.
    speed : float
        U = η0 u/(E' R), u the mean of the surface speeds, ≥ 0.
    material : float
        G = α_p E', > 0.

    Returns
    -------
    float
        F_R α_p/(R l) [-], F_R the force on each surface, against its motion.

    Notes
    -----
    It counts the inlet alone. In a full solution of the film the pressure ends at a constriction, where h is below and
    dp/dx against that of the inlet, so that h dp/dx resists there as well: 30 to 40 % more at M = 2 to 40, L = 13.
    Isothermal and flooded; piezoviscous and elastic, L = G (2U)^¼ above about 5 and M = W (2U)^(−½) above about 2.

    References
    ----------
    Goksem and Hargreaves, J. Lubr. Technol. 100 (1978) 346. Coefficients as later works quote them.

    Examples
    --------
    >>> round(goksem_hargreaves(8.36e-5, 2.916e-11, 4846.0), 7)
    0.0001193
    """
    return 4.318 * (material * speed) ** 0.658 * load**0.0126


@jit
def inlet_heating_of_rolling(loading):
    """Rolling resistance over that of an isothermal inlet, 1/(1 + 0.29 L_T^0.78).

    Parameters
    ----------
    loading : float
        Thermal loading parameter L_T = η0 β u²/k, ≥ 0.

    Returns
    -------
    float
        Factor on F_R [-], above 0, at most 1.

    References
    ----------
    Goksem and Hargreaves, J. Lubr. Technol. 100 (1978) 353. Coefficients as later works quote them.

    Examples
    --------
    >>> round(inlet_heating_of_rolling(0.038), 4)
    0.9779
    """
    return 1.0 / (1.0 + 0.29 * loading**0.78)
