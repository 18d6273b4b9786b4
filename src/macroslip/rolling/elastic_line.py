"""Rolling resistance of an elastic line contact in Moes' groups: the inlet alone, as published, or the whole film.

N_F = F_R/(E' R l) (2U)^(−¾) depends on M = W (2U)^(−½) and L = G (2U)^¼ alone where viscosity follows Barus and the
oil does not compress. Its rigid, isoviscous limit is Martin's, N_R = 1.4705 √M; a law here gives the elastic limit N_E,
and the order n with which both join,

    N_F = (N_R^(−n) + N_E^(−n))^(−1/n).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from numba.extending import overload

from macroslip.compiled import jit, jit_inline
from macroslip.rolling.martin import ROLLING

#: N_R/√M.
RIGID = ROLLING / math.sqrt(2.0)

_LOG_ELASTIC = math.log(1.42 / 0.966)
_LOG_HEAVY = math.log(4.318 * 2.0**-0.658)
_ORDER_INLET = 10.0
_ORDER_WHOLE = 3.64


class InletFilm(NamedTuple):
    """The inlet alone: Biboulet and Houpert's elastic limit and Goksem and Hargreaves' piezoviscous one.

    Attributes
    ----------
    order : float
        Order with which the limits join.
    """

    order: float = _ORDER_INLET


class WholeFilm(NamedTuple):
    """The whole film, inlet and exit: a fit of full solutions.

    Attributes
    ----------
    order : float
        Order with which the limits join.
    """

    order: float = _ORDER_WHOLE


@jit_inline
def log_inlet(log_load, log_material):
    """Ln N_E of the inlet and its derivatives by ln M and ln L.

    The lower of Biboulet and Houpert's 1.470 and Goksem and Hargreaves' 2.737 L^(−0.342) M^0.0126, joined with order
    10, the order with which Biboulet and Houpert join their limits. In Moes' groups Goksem and Hargreaves' formula is
    left with (2U)^(−0.0002), which is dropped.

    Examples
    --------
    >>> log_force, by_load, by_material = log_inlet(math.log(10.0), math.log(13.4))
    >>> round(math.exp(log_force), 3), round(by_load, 4), round(by_material, 3)
    (1.149, 0.0115, -0.313)
    """
    heavy = _LOG_HEAVY - 0.342 * log_material + 0.0126 * log_load
    difference = _ORDER_INLET * (heavy - _LOG_ELASTIC)
    if difference > 0.0:
        ratio = math.exp(-difference)
        share = ratio / (1.0 + ratio)
        log_force = _LOG_ELASTIC - math.log1p(ratio) / _ORDER_INLET
    else:
        ratio = math.exp(difference)
        share = 1.0 / (1.0 + ratio)
        log_force = heavy - math.log1p(ratio) / _ORDER_INLET
    return log_force, 0.0126 * share, -0.342 * share


@jit_inline
def log_whole_film(log_load, log_material):
    """Ln N_E of the whole film and its derivatives by ln M and ln L.

    N_E = 2.026 exp(−0.00481 L) (1 + 1.97 M)^(−0.0692 L/(L + 4.71)), a fit.

    Notes
    -----
    N_F is within 3 % of the solutions of `benchmarks/line_contact.py` for M = 0.1 to 60, L = 0 to 18, with Barus' law.
    With Roelands' law and a compressible oil (0.54 Pa s, 21 GPa⁻¹, L = 13.4) solutions lie within 5 % of it for M = 1
    to 32.

    Examples
    --------
    >>> log_force, by_load, by_material = log_whole_film(math.log(10.0), math.log(13.4))
    >>> round(math.exp(log_force), 3), round(by_load, 4), round(by_material, 4)
    (1.627, -0.0487, -0.1048)
    """
    load = math.exp(log_load)
    material = math.exp(log_material)
    spread = 1.0 + 1.97 * load
    power = 0.0692 * material / (material + 4.71)
    log_spread = math.log(spread)
    log_force = math.log(2.026) - 0.00481 * material - power * log_spread
    by_load = -power * 1.97 * load / spread
    by_material = -0.00481 * material - power * 4.71 / (material + 4.71) * log_spread
    return log_force, by_load, by_material


def log_elastic(law, log_load, log_material):
    """Ln N_E of a law and its derivatives by ln M and ln L."""
    return _FUNCTIONS[type(law)](log_load, log_material)


_FUNCTIONS = {InletFilm: log_inlet, WholeFilm: log_whole_film}


@overload(log_elastic)
def _log_elastic(law, log_load, log_material):
    compiled = _FUNCTIONS[law.instance_class]
    return lambda law, log_load, log_material: compiled(log_load, log_material)


@jit
def line_rolling(law, load, material):
    """N_F of a line contact, flooded and isothermal, from rigid and isoviscous to elastic and piezoviscous.

    Parameters
    ----------
    law : InletFilm or WholeFilm
    load, material : float
        M and L, > 0.

    Returns
    -------
    float
        N_F = F_R/(E' R l) (2U)^(−¾) [-].

    Examples
    --------
    >>> round(line_rolling(WholeFilm(), 11.0, 13.4), 3), round(line_rolling(InletFilm(), 11.0, 13.4), 3)
    (1.611, 1.151)
    >>> round(line_rolling(InletFilm(), 1e-4, 13.4) * 100.0, 4)
    1.4705
    """
    log_force, _, _ = log_elastic(law, math.log(load), math.log(material))
    rigid = RIGID * math.sqrt(load)
    elastic = math.exp(log_force)
    return (rigid**-law.order + elastic**-law.order) ** (-1.0 / law.order)
