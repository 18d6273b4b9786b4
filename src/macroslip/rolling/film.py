"""Film of a contact between the rigid gap of finite length and Moes' elastic line."""

from __future__ import annotations

import math

from macroslip.compiled import jit_inline
from macroslip.film.moes import joined
from macroslip.rolling.gap import film_at_load
from macroslip.rolling.martin import FLOW

_LOG_FLOW = math.log(FLOW)


@jit_inline
def log_blended_film(log_rigid, log_load, log_material):
    """Ln N of Moes' blend where the rigid, isoviscous limit is that of the contact itself.

    N = {(H_RI^(7/3) + H_EI^(7/3))^(3s/7) + (H_RP^(−7/2) + H_EP^(−7/2))^(−2s/7)}^(1/s), s = (7 + 8 exp(−2 H_EI/H_RI))/5,
    H_EI = 2.621 M^(−1/5), H_RP = 1.287 L^(2/3), H_EP = 1.311 M^(−1/8) L^(3/4)

    Parameters
    ----------
    log_rigid : float
        ln H_RI; of a line contact H_RI = 3/M.
    log_load, log_material : float
        ln M and ln L of the equivalent line contact.

    Returns
    -------
    tuple of float
        ln N, and its derivatives by ln H_RI, ln M and ln L.

    References
    ----------
    Moes, Lubrication and Beyond, lecture notes, University of Twente (2000), as given by Gelinck and Schipper, Tribol.
    Int. 33 (2000) 175, doi:10.1016/S0301-679X(00)00024-4.

    Examples
    --------
    >>> round(math.exp(log_blended_film(math.log(3.0), 0.0, math.log(10.0))[0]), 4)
    6.9701
    """
    log_elastic = math.log(2.621) - 0.2 * log_load
    ratio = math.exp(log_elastic - log_rigid)
    fading = math.exp(-2.0 * ratio)
    order = 1.4 + 1.6 * fading
    order_by_ratio = -3.2 * fading * ratio if fading > 0.0 else 0.0
    isoviscous, rigid_share = joined(log_rigid, log_elastic, 7.0 / 3.0)
    piezoviscous, stiff_share = joined(
        math.log(1.287) + (2.0 / 3.0) * log_material, math.log(1.311) - 0.125 * log_load + 0.75 * log_material, -3.5
    )
    height, share = joined(isoviscous, piezoviscous, order)
    by_order = (share * isoviscous + (1.0 - share) * piezoviscous - height) / order
    by_ratio = by_order * order_by_ratio
    by_rigid = share * rigid_share - by_ratio
    by_load = -0.2 * (share * (1.0 - rigid_share) + by_ratio) - 0.125 * (1.0 - share) * (1.0 - stiff_share)
    by_material = (1.0 - share) * (0.75 - stiff_share / 12.0)
    return height, by_rigid, by_load, by_material


@jit_inline
def light_film(law, log_load, log_speed):
    """Ln h of the film of the volume flow [ln m] and its derivatives by ln Q and by ln u.

    Moes' blend of a contact `law` (`rolling_law.Rolling`), its rigid and isoviscous limit that of the gap of finite length with
    its fullness: 1.2257 h0. From ln Q [ln N] and ln u [ln m/s].
    """
    unit = math.log(law.viscosity * law.gap.fullness) + log_speed
    log_gap, gap_slope, _, _, _, _ = film_at_load(law.gap, log_load - unit)
    scale = law.log_film + 0.5 * log_speed
    height, by_rigid, by_m, by_l = log_blended_film(
        log_gap + _LOG_FLOW - scale,
        law.log_load + (2.0 / 3.0) * log_load - 0.5 * log_speed,
        law.log_material + 0.25 * log_speed,
    )
    by_log_load = by_rigid * gap_slope + (2.0 / 3.0) * by_m
    by_log_speed = 0.5 + by_rigid * (-gap_slope - 0.5) - 0.5 * by_m + 0.25 * by_l
    return height + scale, by_log_load, by_log_speed
