"""A film for every load: Masjedi and Khonsari's where it was fitted, Moes' where the contact is lightly loaded.

Both describe the same film. Where Masjedi and Khonsari's formula holds, Moes' film is thicker by 8 to 32 % (raceways of
the base bearing, 0.1 to 1.3 m/s), because it leaves compressibility out: divided by the density ratio at the highest
pressure it agrees within 4 %. So the film without roughness is, with S Masjedi and Khonsari's smooth film and
N Moes' film over the density ratio,

    ln h_s = w ln S + (1 − w) ln N,

where w rises from 0 to 1 over the decade of W below the lower end of Masjedi and Khonsari's range. Inside it w is 1.

Roughness adds to the gap by Masjedi and Khonsari's formula, S times its roughness term, which goes with
W^−0.364 U^−0.043. One decade below their ranges of W and U it is taken as constant: extrapolated, it would let the
film of a stopping roller grow without bound.

The equivalent line contact w = 3Q/(4a) is right where the contact is elastic. In a rigid contact pressure spreads
beyond the Hertz ellipse, at most to the roller's length, and the film is thicker than this; for cage contacts and
unloaded rollers the film is therefore an estimate from below, where the inlet is flooded and the pocket is wide enough.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit, jit_inline
from macroslip.contact.interface import Interface
from macroslip.film import masjedi_khonsari, moes
from macroslip.film.film_law import register
from macroslip.film.masjedi_khonsari import RANGES
from macroslip.lubricant.viscosity import dowson_higginson

_LOWEST_LOAD = RANGES["load"][0]
_LOG_HEAVY = math.log(_LOWEST_LOAD)
_DECADE = math.log(10.0)
_LOG_LIGHT = _LOG_HEAVY - _DECADE
_LEVEL_LOAD_SQUARED = (0.1 * _LOWEST_LOAD) ** 2
_LEVEL_SPEED_SQUARED = (0.1 * RANGES["speed"][0]) ** 2


class MasjediKhonsariMoes(NamedTuple):
    """The law for one interface.

    Attributes
    ----------
    heavy : MasjediKhonsari
        Of smooth surfaces, but for the roughness term.
    light : Moes
        Moes' film.
    log_load_group : float
        ln W at 1 N; W goes with Q^(2/3).
    log_gap : float
        ln of the gap that roughness adds at W = U = 1 [ln m]; −∞ for smooth surfaces.
    pressure : float
        Highest pressure per Q^(1/3) [Pa/N^(1/3)].
    """

    heavy: masjedi_khonsari.MasjediKhonsari
    light: moes.Moes
    log_load_group: float
    log_gap: float
    pressure: float


def prepare(interface: Interface) -> MasjediKhonsariMoes:
    """The law for an elliptical contact, through the equivalent line contact w = 3Q/(4a)."""
    heavy = masjedi_khonsari.prepare(interface)
    log_gap = (
        heavy.log_smooth + heavy.log_rough + 0.364 * math.log(heavy.load_group) + 0.043 * math.log(heavy.speed_group)
    )
    return MasjediKhonsariMoes(
        heavy, moes.prepare(interface), math.log(heavy.load_group), log_gap, interface.hertz.pressure
    )


@jit_inline
def thickness(law, load, entrainment_speed):
    """H [m], ∂h/∂u_e [s] and ∂h/∂Q [m/N] at load Q [N] and u_e [m/s], both > 0.

    Twice continuously differentiable, and rising with speed, for any load and speed.
    """
    log_load = math.log(load)
    log_speed = math.log(entrainment_speed)
    log_group = law.log_load_group + log_load * (2.0 / 3.0)
    log_height = law.heavy.log_smooth - 0.09 * log_load + 0.705 * log_speed
    by_log_speed, by_log_load = 0.705, -0.09
    if log_group < _LOG_HEAVY:
        light, light_by_speed, light_by_load = moes.log_thickness(law.light, log_load, log_speed)
        pressure = law.pressure * math.exp(log_load / 3.0)
        density = dowson_higginson(pressure)
        light -= math.log(density)
        light_by_load -= 0.2e-9 * pressure / ((1.0 + 1.7e-9 * pressure) ** 2 * density)
        if log_group > _LOG_LIGHT:
            place = (log_group - _LOG_LIGHT) / _DECADE
            weight = place**3 * (10.0 - 15.0 * place + 6.0 * place * place)
            slope = 20.0 / _DECADE * (place * (1.0 - place)) ** 2
        else:
            weight = slope = 0.0
        excess = log_height - light
        by_log_speed = light_by_speed + weight * (by_log_speed - light_by_speed)
        by_log_load = light_by_load + weight * (by_log_load - light_by_load) + slope * excess
        log_height = light + weight * excess
    smooth = math.exp(log_height)
    load_squared = math.exp(2.0 * log_group)
    speed_squared = (law.heavy.speed_group * entrainment_speed) ** 2
    level_load = load_squared + _LEVEL_LOAD_SQUARED
    level_speed = speed_squared + _LEVEL_SPEED_SQUARED
    gap = math.exp(law.log_gap - 0.182 * math.log(level_load) - 0.0215 * math.log(level_speed))
    by_speed = smooth * by_log_speed - 0.043 * gap * speed_squared / level_speed
    by_load = smooth * by_log_load - (0.728 / 3.0) * gap * load_squared / level_load
    return smooth + gap, by_speed / entrainment_speed, by_load / load


@jit
def in_range(law, load, entrainment_speed):
    """Whether the formula that counts there is in its range: Masjedi and Khonsari's W and U, or Moes' M and L below."""
    if law.log_load_group + math.log(load) * (2.0 / 3.0) >= _LOG_HEAVY:
        return masjedi_khonsari.in_range(law.heavy, load, entrainment_speed)
    return moes.in_range(law.light, load, entrainment_speed)


register(
    "masjedi-khonsari-moes",
    MasjediKhonsariMoes,
    reference="Masjedi and Khonsari, J. Tribol. 134 (2012) 011503, doi:10.1115/1.4005514; for light loads Moes, "
    "Lubrication and Beyond, University of Twente (2000), as in Gelinck and Schipper, Tribol. Int. 33 (2000) 175, "
    "doi:10.1016/S0301-679X(00)00024-4",
    prepare=prepare,
    thickness=thickness,
    in_range=in_range,
    range_notes=masjedi_khonsari.range_notes,
)
