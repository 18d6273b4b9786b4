"""What films carry where a roller has play.

A roller with play lies between two films. With q the load of the one that no body force presses on and Q = q + |B| that of
the other, B the body force, both films and the elastic approach of the contacts fill the play p:

    [h(q) + h(q + |B|)]/1.2257 − (q/K)^(2/3) = p,

h the film of the volume flow. As the play vanishes q rises to a load that the films carry without play, q0; a roller that
the rings press with the load Q_e has q = q0 exp(−Q_e/q0) of it left, so that loads are continuous.

The films are those of a roller whose surface is at rest: u = u2/2. A roller without load turns slowly; that of a roller
which grips has left its play, where q counts for little.
"""

from __future__ import annotations

import math

from numba.extending import overload

from macroslip.compiled import jit, jit_inline
from macroslip.roller.films import Films
from macroslip.roller.plane_table import plane_values
from macroslip.roller.play_table import tabled_load
from macroslip.rolling.film import light_film
from macroslip.rolling.martin import FLOW
from macroslip.rolling.resistance import LOWEST_SPEED

#: Part of the elastic load below which what films carry without play is left out: it would count for e^−30 of itself.
_FADED = 1.0 / 30.0
#: Bounds of ln q [ln N] and iterations; Newton's takes about four.
_LOWEST, _HIGHEST, _ITERATIONS = math.log(1e-9), math.log(1e7), 60


@jit_inline
def log_film(law, table, log_load, log_speed):
    """Ln of the film h of the volume flow [ln m] and its derivative by ln Q, from a contact's table or its law."""
    known = plane_values(table, log_load, log_speed)
    if known.known:
        return known.value[2], known.by_load[2]
    height, slope, _ = light_film(law, log_load, log_speed)
    return height, slope


@jit_inline
def _excess(films, log_load, body, play, log_speed):
    """Ln of the films' height over that of the space they have, at q = exp(`log_load`), and its derivative by ln q."""
    load = math.exp(log_load)
    inner_load = load - body if body < 0.0 else load
    outer_load = load + body if body > 0.0 else load
    inner, inner_slope = log_film(films.inner, films.inner_table, math.log(inner_load), log_speed)
    outer, outer_slope = log_film(films.outer, films.outer_table, math.log(outer_load), log_speed)
    inner, outer = math.exp(inner), math.exp(outer)
    height = inner + outer
    slope = (inner * inner_slope * load / inner_load + outer * outer_slope * load / outer_load) / height
    approach = (load / films.stiffness) ** (2.0 / 3.0)
    space = play + approach
    return math.log(height / (FLOW * space)), slope - (2.0 / 3.0) * approach / space


@jit
def carried(films, play, body, ring_speed):
    """Load q [N] of the film on the side that no body force presses on.

    Parameters
    ----------
    films : Films
    play : float
        p ≥ 0 [m].
    body : float
        Body force B along the contact normal [N], positive outward.
    ring_speed : float
        u2 [m/s].
    """
    known = tabled_load(films.play_table, play, body, ring_speed)
    return _solved(films, play, body, ring_speed) if math.isnan(known) else known


@jit
def _solved(films, play, body, ring_speed):
    log_speed = math.log(max(0.5 * abs(ring_speed), LOWEST_SPEED))
    low, high = _LOWEST, _HIGHEST
    place = 0.0
    for _ in range(_ITERATIONS):
        excess, slope = _excess(films, place, body, play, log_speed)
        if excess > 0.0:
            low = place
        else:
            high = place
        following = place - excess / slope if slope < 0.0 else low
        if not low < following < high:
            following = 0.5 * (low + high)
        if abs(following - place) < 1e-12 * (1.0 + abs(place)):
            place = following
            break
        place = following
    # In proportion to speed where it vanishes.
    return math.exp(place) * min(1.0, 0.5 * abs(ring_speed) / LOWEST_SPEED)


@jit
def _film_load(films, load, approach, body, ring_speed):
    if load <= 0.0:
        return carried(films, -approach, body, ring_speed)
    if load >= films.faded_load and abs(ring_speed) <= films.faded_speed:
        return 0.0
    most = tabled_load(films.play_table, 0.0, body, ring_speed)
    if math.isnan(most):
        log_speed = math.log(max(0.5 * abs(ring_speed), LOWEST_SPEED))
        excess, _ = _excess(films, math.log(_FADED * load), body, 0.0, log_speed)
        if excess <= 0.0:
            return 0.0
        most = _solved(films, 0.0, body, ring_speed)
    return most * math.exp(-load / most) if most > _FADED * load else 0.0


@jit
def faded(films, load, body, ring_speed):
    """Whether films carry nothing beside the elastic load [N] of a roller with a body force [N] at u2 [m/s]."""
    return (
        _excess(films, math.log(_FADED * load), body, 0.0, math.log(max(0.5 * abs(ring_speed), LOWEST_SPEED)))[0] <= 0.0
    )


def film_load(films, load, approach, body, ring_speed):
    """Load [N] of films on either raceway, beside elastic load and body force.

    Parameters
    ----------
    films : Films or NoFilms
    load : float
        Elastic load [N].
    approach : float
        Interference [m]; less the play where negative.
    body : float
        Body force along the contact normal [N], positive outward.
    ring_speed : float
        u2 [m/s].
    """
    return _film_load(films, load, approach, body, ring_speed) if isinstance(films, Films) else 0.0


@overload(film_load)
def _film_load_of(films, load, approach, body, ring_speed):
    if films.instance_class is Films:
        return lambda films, load, approach, body, ring_speed: _film_load(films, load, approach, body, ring_speed)
    return lambda films, load, approach, body, ring_speed: 0.0
