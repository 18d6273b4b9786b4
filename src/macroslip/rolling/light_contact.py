"""A contact with little load or none: film, rolling resistance and sliding of one film, continuous into the elastic one.

Load, resistance and shear of a rigid contact follow from one gap h0. Where the surfaces begin to deform, the film is
Moes' with the rigid limit of this gap, the resistance that of `law`, and sliding is in two parts: inside Hertz' ellipse
it is the traction law's; outside it is η0 φ Δu S, S = ∫∫ dA/h less the ellipse's own part, S²/(S + π a b/h).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit
from macroslip.film.moes import joined
from macroslip.rolling.film import light_film
from macroslip.rolling.gap import film_at_gap, film_at_load
from macroslip.rolling.martin import FLOW
from macroslip.rolling.resistance import LOWEST_SPEED, RollingForces, rolling_resistance

_LOG_FLOW = math.log(FLOW)


class LightContact(NamedTuple):
    """Film and forces of a contact.

    Attributes
    ----------
    load : float
        Q [N].
    film : float
        Film of the volume flow [m]: 1.2257 h0 where rigid, the flat middle's where elastic.
    rolling : RollingForces
        Rolling resistance.
    sliding : float
        Force of the film outside Hertz' ellipse on the roller [N], positive along +Δu = u2 − u1; the counterpart's is
        the opposite.
    sliding_slope : float
        ∂sliding/∂Δu [N s/m] at given film.
    sliding_power : float
        What that film dissipates in sliding [W].
    sliding_by_load, sliding_by_speed : float
        ∂sliding/∂Q [-] and ∂sliding/∂u [N s/m] at given slip, u the mean of the surface speeds.
    """

    load: float
    film: float
    rolling: RollingForces
    sliding: float
    sliding_slope: float
    sliding_power: float
    sliding_by_load: float
    sliding_by_speed: float


@jit
def light_contact(law, load, u1, u2):
    """A contact under a normal load: the cage's, or a raceway's under little load.

    Parameters
    ----------
    law : Rolling
    load : float
        Q [N], > 0.
    u1, u2 : float
        Surface speeds of roller and counterpart past the contact [m/s].

    Returns
    -------
    LightContact
        The mean speed is floored at `LOWEST_SPEED` for the film.
    """
    mean = 0.5 * (u1 + u2)
    speed = max(abs(mean), LOWEST_SPEED)
    log_film, film_by_load, film_by_speed = light_film(law, math.log(load), math.log(speed))
    film = math.exp(log_film)
    _, _, _, _, log_shear, shear_by_gap = film_at_gap(law.gap, log_film - _LOG_FLOW)
    shear = law.gap.fullness * math.exp(log_shear)
    inside = law.area * load ** (2.0 / 3.0) / film
    slope = law.viscosity * shear * shear / (shear + inside)
    slip = u2 - u1
    # ln slope = 2 ln S − ln(S + I), with I the ellipse's own part.
    share = inside / (shear + inside)
    by_log_film = shear_by_gap * (1.0 + share) + share
    by_log_load = by_log_film * film_by_load - (2.0 / 3.0) * share
    by_log_speed = by_log_film * film_by_speed if abs(mean) > LOWEST_SPEED else 0.0
    force = slope * slip
    rolling = rolling_resistance(law, load, u1, u2)
    return LightContact(
        load,
        film,
        rolling,
        force,
        slope,
        force * slip,
        force * by_log_load / load,
        force * by_log_speed / (speed if mean >= 0.0 else -speed),
    )


@jit
def contact_at_gap(law, gap, u1, u2):
    """A contact whose smallest gap is given, as that of a roller with play: load, resistance and sliding.

    Parameters
    ----------
    law : Rolling
    gap : float
        h0 [m], > 0.
    u1, u2 : float
        Surface speeds of roller and counterpart past the contact [m/s].

    Returns
    -------
    LightContact
        Rigid and isoviscous; all forces are proportional to viscosity, speed and fullness. `rolling.by_load` is
        ∂shear/∂Q along the film at given speed.
    """
    speed = 0.5 * (u1 + u2)
    unit = law.viscosity * law.gap.fullness
    log_load, load_slope, log_rolling, rolling_slope, log_shear, shear_slope = film_at_gap(law.gap, math.log(gap))
    load = unit * abs(speed) * math.exp(log_load)
    resistance = unit * math.exp(log_rolling)
    force = resistance * speed
    slope = unit * math.exp(log_shear)
    slip = u2 - u1
    by_load = -math.copysign(math.exp(log_rolling - log_load), speed) * rolling_slope / load_slope
    rolling = RollingForces(
        -force,
        2.0 * force * law.share_1,
        2.0 * force * law.share_2,
        2.0 * resistance * speed * speed,
        by_load,
        -resistance,
    )
    sliding = slope * slip
    sliding_by_load = sliding * shear_slope / (load_slope * load) if load > 0.0 else 0.0
    return LightContact(load, FLOW * gap, rolling, sliding, slope, sliding * slip, sliding_by_load, 0.0)


@jit
def pocket_contact(law, load, u1, u2, widest):
    """A roller in the pocket of its cage: a rigid contact under a load, whose gap the pocket bounds.

    h0^−4 = h0(Q)^−4 + widest^−4: under no load the roller floats in the middle of its pocket.

    Parameters
    ----------
    law : Rolling
    load : float
        Q [N], ≥ 0.
    u1, u2 : float
        Surface speeds of roller and cage past the contact [m/s].
    widest : float
        Largest gap [m].

    Returns
    -------
    LightContact
        Rigid and isoviscous, the spar that carries the load alone.
    """
    mean = 0.5 * (u1 + u2)
    speed = max(abs(mean), LOWEST_SPEED)
    unit = law.viscosity * law.gap.fullness
    log_gap = log_widest = math.log(widest)
    # d ln h0/d ln(Q/u), with the bound.
    follows = 0.0
    if load > 0.0:
        free, slope, _, _, _, _ = film_at_load(law.gap, math.log(load / (unit * speed)))
        log_gap, share = joined(free, log_widest, -4.0)
        follows = share * slope
    _, _, log_rolling, rolling_by_gap, log_shear, shear_by_gap = film_at_gap(law.gap, log_gap)
    resistance, slope = unit * math.exp(log_rolling), unit * math.exp(log_shear)
    force, slip = resistance * mean, u2 - u1
    sliding = slope * slip
    per_load = follows / load if load > 0.0 else 0.0
    moving = -follows if abs(mean) > LOWEST_SPEED else 0.0
    rolling = RollingForces(
        -force,
        2.0 * force * law.share_1,
        2.0 * force * law.share_2,
        2.0 * force * mean,
        -force * rolling_by_gap * per_load,
        -resistance * (1.0 + rolling_by_gap * moving),
    )
    return LightContact(
        load,
        FLOW * math.exp(log_gap),
        rolling,
        sliding,
        slope,
        sliding * slip,
        sliding * shear_by_gap * per_load,
        sliding * shear_by_gap * moving / (speed if mean >= 0.0 else -speed),
    )
