"""Moes' film thickness of a line contact, from a rigid, isoviscous contact to an elastic, piezoviscous one."""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit, jit_inline
from macroslip.contact.interface import Interface
from macroslip.film.film_law import register

#: Loads M and lubricant parameters L up to which the blend was compared with full numerical solutions.
HIGHEST_COMPARED_LOAD = 20.0
HIGHEST_COMPARED_MATERIAL = 15.0

_LOG_RIGID_ISOVISCOUS = math.log(3.0)
_LOG_ELASTIC_ISOVISCOUS = math.log(2.621)
_LOG_RIGID_PIEZOVISCOUS = math.log(1.287)
_LOG_ELASTIC_PIEZOVISCOUS = math.log(1.311)


@jit
def moes(load, material):
    """Dimensionless film thickness N = (h/R) (2U)^−½ of a smooth line contact.

    N = {(H_RI^(7/3) + H_EI^(7/3))^(3s/7) + (H_RP^(−7/2) + H_EP^(−7/2))^(−2s/7)}^(1/s), s = (7 + 8 exp(−2 H_EI/H_RI))/5,
    H_RI = 3/M, H_EI = 2.621 M^(−1/5), H_RP = 1.287 L^(2/3), H_EP = 1.311 M^(−1/8) L^(3/4)

    Parameters
    ----------
    load : float
        M = W (2U)^(−½), > 0, with W = w/(E'R) and U = η0 u_e/(E'R).
    material : float
        L = G (2U)^¼, ≥ 0, with G = α_p E'.

    Returns
    -------
    float
        N [-]: the film where the pressure is highest, which is the film that the volume flow fills. In a rigid contact
        it is 1.226 times the smallest film, in an elastic one the film of the flat middle. In these terms 3/M and
        1.287 L^(2/3) are exact limits of Reynolds' equation, to the digits given.

    Notes
    -----
    Smooth surfaces, flooded inlet, isothermal, Barus' law, incompressible. Within 5 % of full numerical solutions of
    that problem for M = 0.05 to 20 at L = 0 and 4, M = 0.05 to 2 at L = 8, and M = 0.05 to 1 at L = 15.

    References
    ----------
    Moes, Lubrication and Beyond, lecture notes, University of Twente (2000). The coefficients are those also given by
    Gelinck and Schipper, Tribol. Int. 33 (2000) 175, doi:10.1016/S0301-679X(00)00024-4.

    Examples
    --------
    >>> round(moes(1.0, 10.0), 4)
    6.9701
    >>> round(moes(1e-3, 0.0) * 1e-3, 3)
    3.0
    """
    rigid = 3.0 / load
    elastic = 2.621 * load**-0.2
    order = (7.0 + 8.0 * math.exp(-2.0 * elastic / rigid)) / 5.0
    total = (rigid ** (7.0 / 3.0) + elastic ** (7.0 / 3.0)) ** (3.0 * order / 7.0)
    if material > 0.0:
        stiff = 1.287 * material ** (2.0 / 3.0)
        heavy = 1.311 * load**-0.125 * material**0.75
        total += (stiff**-3.5 + heavy**-3.5) ** (-2.0 * order / 7.0)
    return total ** (1.0 / order)


@jit_inline
def joined(first, second, order):
    """ln(e^(n a) + e^(n b))/n of two logarithms a and b for either sign of n, and the share of the first in the sum."""
    difference = order * (first - second)
    if difference >= 0.0:
        ratio = math.exp(-difference)
        return first + math.log1p(ratio) / order, 1.0 / (1.0 + ratio)
    ratio = math.exp(difference)
    return second + math.log1p(ratio) / order, ratio / (1.0 + ratio)


@jit_inline
def log_moes(log_load, log_material):
    """Ln N of `moes` and its derivatives by ln M and by ln L, from ln M and ln L; for any finite arguments.

    Examples
    --------
    >>> log_film, by_load, by_material = log_moes(math.log(1e-6), math.log(1e-6))
    >>> round(math.exp(log_film) * 1e-6, 9), round(by_load, 6), round(by_material, 6)
    (3.0, -1.0, 0.0)
    """
    log_rigid = _LOG_RIGID_ISOVISCOUS - log_load
    log_elastic = _LOG_ELASTIC_ISOVISCOUS - 0.2 * log_load
    ratio = math.exp(log_elastic - log_rigid)
    fading = math.exp(-2.0 * ratio)
    order = 1.4 + 1.6 * fading
    order_by_load = -2.56 * fading * ratio if fading > 0.0 else 0.0
    isoviscous, rigid_share = joined(log_rigid, log_elastic, 7.0 / 3.0)
    negative, stiff_share = joined(
        -_LOG_RIGID_PIEZOVISCOUS - (2.0 / 3.0) * log_material,
        -_LOG_ELASTIC_PIEZOVISCOUS + 0.125 * log_load - 0.75 * log_material,
        3.5,
    )
    piezoviscous = -negative
    log_film, share = joined(isoviscous, piezoviscous, order)
    by_order = (share * isoviscous + (1.0 - share) * piezoviscous - log_film) / order
    by_load = (
        share * (-0.2 - 0.8 * rigid_share) - (1.0 - share) * 0.125 * (1.0 - stiff_share) + by_order * order_by_load
    )
    by_material = (1.0 - share) * (0.75 - stiff_share / 12.0)
    return log_film, by_load, by_material


class Moes(NamedTuple):
    """The formula for one interface.

    Attributes
    ----------
    log_scale : float
        ln of R (2U)^½ at 1 m/s [ln m].
    log_load : float
        ln M at 1 N and 1 m/s; M goes with Q^(2/3) u_e^(−½).
    log_material : float
        ln L at 1 m/s; L goes with u_e^¼.
    """

    log_scale: float
    log_load: float
    log_material: float


def prepare(interface: Interface) -> Moes:
    """The formula for an elliptical contact, through the equivalent line contact w = 3Q/(4a)."""
    radius, modulus, lubricant = interface.rolling_radius, interface.modulus, interface.lubricant
    doubled_speed = 2.0 * lubricant.viscosity / (modulus * radius)
    load_group = 0.75 / interface.hertz.semi_axis_across / (modulus * radius)
    return Moes(
        log_scale=math.log(radius) + 0.5 * math.log(doubled_speed),
        log_load=math.log(load_group) - 0.5 * math.log(doubled_speed),
        log_material=math.log(lubricant.pressure_viscosity * modulus) + 0.25 * math.log(doubled_speed),
    )


@jit_inline
def log_thickness(law, log_load, log_speed):
    """Ln h and its derivatives by ln u_e and by ln Q, from ln Q [ln N] and ln u_e [ln m/s]."""
    log_film, by_load, by_material = log_moes(
        law.log_load + (2.0 / 3.0) * log_load - 0.5 * log_speed, law.log_material + 0.25 * log_speed
    )
    return law.log_scale + 0.5 * log_speed + log_film, 0.5 - 0.5 * by_load + 0.25 * by_material, by_load * (2.0 / 3.0)


@jit_inline
def thickness(law, load, entrainment_speed):
    """H [m], ∂h/∂u_e [s] and ∂h/∂Q [m/N] at load Q [N] and u_e [m/s], both > 0, whether in range or not."""
    log_height, by_speed, by_load = log_thickness(law, math.log(load), math.log(entrainment_speed))
    height = math.exp(log_height)
    return height, height / entrainment_speed * by_speed, height / load * by_load


@jit
def in_range(law, load, entrainment_speed):
    """Whether M and L are at most those at which the formula was compared; lighter loads approach its exact limit."""
    log_speed = math.log(entrainment_speed)
    m = math.exp(law.log_load + (2.0 / 3.0) * math.log(load) - 0.5 * log_speed)
    return m <= HIGHEST_COMPARED_LOAD and math.exp(law.log_material + 0.25 * log_speed) <= HIGHEST_COMPARED_MATERIAL


register(
    "moes",
    Moes,
    reference="Moes, Lubrication and Beyond, University of Twente (2000), as in Gelinck and Schipper, Tribol. Int. 33 "
    "(2000) 175, doi:10.1016/S0301-679X(00)00024-4",
    prepare=prepare,
    thickness=thickness,
    in_range=in_range,
)
