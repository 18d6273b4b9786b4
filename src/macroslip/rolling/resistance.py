"""Rolling resistance of one contact of a roller, from no load to an elastohydrodynamic film.

Both surfaces are sheared by the pressure's gradient: F_R = ½ ∫ h ∂p/∂x dA on each, against its motion. The inclined
pressure pushes body i along its motion with 2 F_R R/R_i, 1/R = 1/R_1 + 1/R_2 with signs, so that all four add up to 0.
The surfaces lose 2 F_R u, u their mean speed, and the film dissipates it; sliding has no part in it.

An elastic contact is taken in slices along the roller: where F_R per length does not depend on load they give
2a F_R(w_c), where it goes with the root of load (π/2) a F_R(w_c), w_c = 3Q/(4a) the load of the middle slice. One slice of
w = (π²/16) w_c over 2a meets both, and lies within 1.5 % of the slices between them.

In terms of `elastic_line` the contact has N_R, N_E and N_F = (N_R^(−n) + N_E^(−n))^(−1/n). With the share of the rigid
limit g = N_R^(−n)/(N_R^(−n) + N_E^(−n)),

    F_R = F_F (F_G/F_R,line)^g f^(1−g) + (1 − g) F_B,

F_G the resistance of the rigid gap of finite length, with its fullness φ, and f = f_T f_S the factors of heating and
starvation of an elastic inlet. F_B is the resistance of the film beside Hertz' ellipse, a ≤ |z| ≤ l/2, where the gap is
h0 + (z² − a²)/(2R_y) and every slice Martin's:

    F_B = 2 · 4.601 φ η0 u √(2 R_x R_y) ln{[l/2 + √(l²/4 + 2R_y h0 − a²)]/[a + √(2R_y h0)]}.

A light contact gets F_G, a heavy one f N_E over its ellipse and F_B beside it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from numba.extending import overload

from macroslip.compiled import jit, jit_inline
from macroslip.film.moes import joined
from macroslip.rolling.elastic_line import RIGID, log_elastic
from macroslip.rolling.film import light_film
from macroslip.rolling.gap import film_at_load
from macroslip.rolling.goksem_hargreaves import inlet_heating_of_rolling
from macroslip.rolling.martin import FLOW
from macroslip.rolling.rolling_law import Rolling

#: Mean speed below which forces go in proportion to speed [m/s].
LOWEST_SPEED = 1e-6

_LOG_RIGID = math.log(RIGID)
_LOG_SLICE = math.log(math.pi**2 / 16.0)
_LOG_FLOW = math.log(FLOW)


class RollingForces(NamedTuple):
    """Forces of rolling resistance along the motion's axis, positive where the speeds are.

    Attributes
    ----------
    shear : float
        On either surface [N], −F_R where the speed is positive: a moment about the axis of each body.
    push_1, push_2 : float
        Sideways force of the pressure on roller and counterpart [N], through their axes.
    power : float
        2 F_R |u| [W], apart from sliding.
    by_load : float
        ∂shear/∂Q [-].
    by_speed : float
        ∂shear/∂u [N s/m], u the mean of the surface speeds.
    """

    shear: float
    push_1: float
    push_2: float
    power: float
    by_load: float
    by_speed: float


@jit_inline
def beside_ellipse(law, log_load, log_speed):
    """F_B [N] of a full share 1 − g, and its derivatives by ln Q and by ln u, from ln Q [ln N] and ln u [ln m/s]."""
    across = law.across * math.exp(log_load / 3.0)
    if across >= law.half_length:
        return 0.0, 0.0, 0.0
    log_height, height_by_load, height_by_speed = light_film(law, log_load, log_speed)
    rise = law.double_lateral * math.exp(log_height - _LOG_FLOW)
    near = math.sqrt(rise)
    far = math.sqrt(law.half_length * law.half_length + rise - across * across)
    length = math.log((law.half_length + far) / (across + near))
    by_log_height = 0.5 * rise / (far * (law.half_length + far)) - 0.5 * near / (across + near)
    by_log_across = -across * (across / (far * (law.half_length + far)) + 1.0 / (across + near))
    scale = law.beside * math.exp(log_speed)
    return (
        scale * length,
        scale * (by_log_height * height_by_load + by_log_across / 3.0),
        scale * (length + by_log_height * height_by_speed),
    )


@jit_inline
def resistance(law, log_load, log_speed):
    """F_R [N] and its derivatives by ln Q and by ln u, from ln Q [ln N] and ln u [ln m/s]."""
    log_m = law.log_load + _LOG_SLICE + (2.0 / 3.0) * log_load - 0.5 * log_speed
    elastic, by_m, by_l = log_elastic(law.elastic, log_m, law.log_material + 0.25 * log_speed)
    elastic_by_load = (2.0 / 3.0) * by_m
    elastic_by_speed = 0.25 * by_l - 0.5 * by_m
    rigid = _LOG_RIGID + 0.5 * log_m
    line, share = joined(rigid, elastic, -law.elastic.order)
    share_slope = -law.elastic.order * share * (1.0 - share)
    scale = law.log_scale + log_load / 3.0 + 0.75 * log_speed

    unit = math.log(law.viscosity * law.gap.fullness) + log_speed
    _, _, gap, gap_slope, _, _ = film_at_load(law.gap, log_load - unit)
    light = gap + unit - scale - rigid
    light_by_load = gap_slope - 2.0 / 3.0
    light_by_speed = 0.5 - gap_slope
    heavy = law.log_starvation
    heavy_by_speed = 0.0
    if law.loading > 0.0:
        factor = inlet_heating_of_rolling(law.loading * math.exp(2.0 * log_speed))
        heavy += math.log(factor)
        heavy_by_speed = -1.56 * (1.0 - factor)

    force = math.exp(scale + line + share * light + (1.0 - share) * heavy)
    by_load = 1.0 / 3.0 + share * (1.0 / 3.0 + light_by_load) + (1.0 - share) * elastic_by_load
    by_load += share_slope * (1.0 / 3.0 - elastic_by_load) * (light - heavy)
    by_speed = 0.75 + share * (-0.25 + light_by_speed) + (1.0 - share) * (elastic_by_speed + heavy_by_speed)
    by_speed += share_slope * (-0.25 - elastic_by_speed) * (light - heavy)
    beside, beside_by_load, beside_by_speed = beside_ellipse(law, log_load, log_speed)
    share_by_load = share_slope * (1.0 / 3.0 - elastic_by_load)
    share_by_speed = share_slope * (-0.25 - elastic_by_speed)
    return (
        force + (1.0 - share) * beside,
        force * by_load + (1.0 - share) * beside_by_load - share_by_load * beside,
        force * by_speed + (1.0 - share) * beside_by_speed - share_by_speed * beside,
    )


@jit
def _rolling_resistance(law, load, u1, u2):
    speed = 0.5 * (u1 + u2)
    if load <= 0.0 or speed == 0.0:
        return RollingForces(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    size = abs(speed)
    floored = max(size, LOWEST_SPEED)
    force, by_log_load, by_log_speed = resistance(law, math.log(load), math.log(floored))
    if size < LOWEST_SPEED:
        force *= size / LOWEST_SPEED
        by_log_load *= size / LOWEST_SPEED
        by_log_speed = force
    signed = math.copysign(force, speed)
    return RollingForces(
        -signed,
        2.0 * signed * law.share_1,
        2.0 * signed * law.share_2,
        2.0 * force * size,
        -math.copysign(by_log_load, speed) / load,
        -by_log_speed / size,
    )


def rolling_resistance(law, load, u1, u2):
    """Rolling resistance of a contact under load.

    Parameters
    ----------
    law : NoRolling or Rolling
    load : float
        Normal load Q [N]; a contact without load has no resistance here, see `light_contact.contact_at_gap`.
    u1, u2 : float
        Surface speeds of roller and counterpart past the contact [m/s].

    Returns
    -------
    RollingForces
    """
    return _rolling_resistance(law, load, u1, u2) if isinstance(law, Rolling) else _NONE


_NONE = RollingForces(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@overload(rolling_resistance)
def _overload(law, load, u1, u2):
    if law.instance_class is Rolling:
        return lambda law, load, u1, u2: _rolling_resistance(law, load, u1, u2)
    return lambda law, load, u1, u2: RollingForces(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
