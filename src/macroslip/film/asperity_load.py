"""Share of a contact's load that asperities carry: two formulas, one from the groups of the contact, one from Λ."""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit, jit_inline
from macroslip.contact.interface import Interface
from macroslip.contact.law_registry import LawList

_kinds = LawList("asperity_load")
names, reference, prepare = _kinds.names, _kinds.reference, _kinds.prepare

#: Values of `AsperityLoad.kind`.
NONE, LOAD_RATIO, FILM_RATIO = 0, 1, 2


@jit
def load_ratio(load, speed, material, roughness, hardness):
    """Share of the load that asperities carry in a rough line contact, by Masjedi and Khonsari, not clamped.

    L_a = 0.005 W^−0.408 U^−0.088 G^0.103 ln(1 + 4470 σ^6.015 V^1.168 W^0.485 U^−3.741 G^−2.898) per cent

    Parameters
    ----------
    load, speed, material, roughness, hardness : float
        W, U, G, σ and V of `masjedi_khonsari`, with the same ranges; all > 0, but roughness ≥ 0.

    Returns
    -------
    float
        L_a/100 [-]; may exceed 1 far below the range of U. 0 where the surfaces are smooth.

    References
    ----------
    Masjedi and Khonsari, J. Tribol. 134 (2012) 011503, doi:10.1115/1.4005514.

    Examples
    --------
    >>> round(load_ratio(1e-4, 1e-11, 4846.0, 1e-5, 0.03), 6)
    0.054356
    """
    if roughness <= 0.0:
        return 0.0
    log_load, log_speed, log_material = math.log(load), math.log(speed), math.log(material)
    exponent = math.log(4470.0) + 6.015 * math.log(roughness) + 1.168 * math.log(hardness)
    exponent += 0.485 * log_load - 3.741 * log_speed - 2.898 * log_material
    per_cent = 0.005 * math.exp(-0.408 * log_load - 0.088 * log_speed + 0.103 * log_material)
    return 0.01 * per_cent * _softplus(exponent)


@jit
def film_ratio_share(film_ratio):
    """Share of the load that asperities carry by the ratio of film thickness to roughness, exp(−2.32 Λ^0.97).

    Parameters
    ----------
    film_ratio : float
        Λ = h/σ_rms, ≥ 0, with σ_rms the composite RMS roughness.

    Returns
    -------
    float
        Share [-], 1 at Λ = 0; 10 % at Λ = 0.99, 1 % at 2.03, 0.1 % at 3.08.

    Notes
    -----
    A fit to measured surfaces of rolling bearings (tag V).

    References
    ----------
    Wingertszahn et al., Lubricants 11 (2023) 369, doi:10.3390/lubricants11090369.

    Examples
    --------
    >>> round(film_ratio_share(1.0), 4)
    0.0983
    """
    return math.exp(-2.32 * film_ratio**0.97)


@jit_inline
def _softplus(exponent):
    """ln(1 + e^x), which neither overflows nor loses small values."""
    if exponent > 40.0:
        return exponent
    return math.log1p(math.exp(exponent))


class AsperityLoad(NamedTuple):
    """A formula for one interface; one type for all, so that a kernel serves every choice.

    Attributes
    ----------
    kind : int
        `NONE`, `LOAD_RATIO` or `FILM_RATIO`.
    roughness : float
        σ_rms [m].
    log_share : float
        ln of the factor before the logarithm of `load_ratio`, as a share, at 1 N and 1 m/s.
    log_group : float
        ln of the term inside that logarithm at 1 N and 1 m/s.
    """

    kind: int
    roughness: float
    log_share: float
    log_group: float


@jit_inline
def asperity_share(law, load, entrainment_speed, film_thickness):
    """Share of the load that asperities carry [-], 0 to 1.

    Parameters
    ----------
    law : AsperityLoad
    load : float
        Q > 0 [N].
    entrainment_speed : float
        u_e > 0 [m/s].
    film_thickness : float
        h > 0 [m], with all corrections; only the formula in Λ uses it, so only that one accounts for starvation.

    Notes
    -----
    The load ratio is used outside its range too: it is small where the film is thick, so a cage contact has none
    (1e-6), and it is clamped to 1 where it exceeds that, at 20 kN on the base bearing's raceways below a third of the
    lowest U of its range.
    """
    if law.kind == LOAD_RATIO:
        log_load = math.log(load) * (2.0 / 3.0)
        log_speed = math.log(entrainment_speed)
        group = _softplus(law.log_group + 0.485 * log_load - 3.741 * log_speed)
        return min(1.0, math.exp(law.log_share - 0.408 * log_load - 0.088 * log_speed) * group)
    if law.kind == FILM_RATIO and law.roughness > 0.0:
        return film_ratio_share(film_thickness / law.roughness)
    return 0.0


def _none(interface: Interface) -> AsperityLoad:
    return AsperityLoad(NONE, interface.roughness, 0.0, 0.0)


def _film_ratio(interface: Interface) -> AsperityLoad:
    return AsperityLoad(FILM_RATIO, interface.roughness, 0.0, 0.0)


def _load_ratio(interface: Interface) -> AsperityLoad:
    """Load ratio of an elliptical contact, through the equivalent line contact w = 3Q/(4a)."""
    if interface.roughness <= 0.0:
        return _none(interface)
    radius, modulus, lubricant = interface.rolling_radius, interface.modulus, interface.lubricant
    log_load = math.log(0.75 / interface.hertz.semi_axis_across / (modulus * radius))
    log_speed = math.log(lubricant.viscosity / (modulus * radius))
    log_material = math.log(lubricant.pressure_viscosity * modulus)
    group = math.log(4470.0) + 6.015 * math.log(interface.roughness / radius)
    group += 1.168 * math.log(interface.hardness / modulus)
    return AsperityLoad(
        kind=LOAD_RATIO,
        roughness=interface.roughness,
        log_share=math.log(5e-5) - 0.408 * log_load - 0.088 * log_speed + 0.103 * log_material,
        log_group=group + 0.485 * log_load - 3.741 * log_speed - 2.898 * log_material,
    )


_kinds.add("none", _none, "")
_kinds.add("masjedi-khonsari", _load_ratio, "Masjedi and Khonsari, J. Tribol. 134 (2012) 011503, doi:10.1115/1.4005514")
_kinds.add("film-ratio", _film_ratio, "Wingertszahn et al., Lubricants 11 (2023) 369, doi:10.3390/lubricants11090369")
