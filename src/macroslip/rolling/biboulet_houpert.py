"""Biboulet and Houpert's rolling resistance of an isoviscous line contact, and their factor of a starved inlet."""

from __future__ import annotations

from macroslip.compiled import jit

#: What to cite.
REFERENCE = "Biboulet and Houpert, Proc. IMechE J 224 (2010) 763 and 777, doi:10.1243/13506501JET608"


@jit
def biboulet_houpert(load):
    """Rolling resistance of an isoviscous line contact, N_F = 1.42 √M/[1 + (0.966 √M)^10]^0.1.

    Parameters
    ----------
    load : float
        M = W (2U)^(−½), ≥ 0.

    Returns
    -------
    float
        N_F = F_R/(E' R l) (2U)^(−¾) [-], F_R the force on each surface.

    Notes
    -----
    The rigid limit is 3.4 % below Martin's. The elastic limit is 1.47; full solutions of the film give 1.90 at M = 5
    and 2.05 at M = 20, their inlets alone 1.65.

    References
    ----------
    Biboulet and Houpert, Proc. IMechE J 224 (2010) 763. Coefficients as later works quote them.

    Examples
    --------
    >>> round(biboulet_houpert(0.01), 4), round(biboulet_houpert(100.0), 4)
    (0.142, 1.47)
    """
    return 1.42 * load**0.5 / (1.0 + (0.966 * load**0.5) ** 10.0) ** 0.1


@jit
def starvation_factor(inlet):
    """Rolling resistance over that of a flooded inlet, (S² + 162.8 S)/(S² + 193.1 S + 1257).

    Parameters
    ----------
    inlet : float
        S, the film where the inlet begins to be full over the film of the contact, ≥ 1; infinite where flooded.

    Returns
    -------
    float
        Factor on F_R [-], below 1.

    References
    ----------
    Biboulet and Houpert, Proc. IMechE J 224 (2010) 777. Coefficients as later works quote them.

    Examples
    --------
    >>> round(starvation_factor(10.0), 4), starvation_factor(float("inf"))
    (0.5255, 1.0)
    """
    inverse = 1.0 / inlet
    return (1.0 + 162.8 * inverse) / (1.0 + (193.1 + 1257.0 * inverse) * inverse)
