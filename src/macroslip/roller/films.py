"""The oil around a roller: rolling resistance of its contacts, and what films carry where a roller has play.

What is here stands beside the traction of the contacts. For `NoFilms` every function compiles to zeros.

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
from typing import Any, NamedTuple

from numba.extending import overload

from macroslip.compiled import jit, jit_inline
from macroslip.roller.plane_table import PlaneTable, plane_values
from macroslip.rolling.film import light_film
from macroslip.rolling.law import LOWEST_SPEED
from macroslip.rolling.light_contact import light_contact, pocket_contact
from macroslip.rolling.martin import FLOW

#: Part of the elastic load below which what films carry without play is left out: it would count for e^−30 of itself.
_FADED = 1.0 / 30.0
#: Bounds of ln q [ln N] and iterations; Newton's takes about four.
_LOWEST, _HIGHEST, _ITERATIONS = math.log(1e-9), math.log(1e7), 60
#: Load [N] below which one known before is no guess.
_FAINT = 1e-6


class NoFilms(NamedTuple):
    """A roller without rolling resistance."""


class Films(NamedTuple):
    """Films of a roller's contacts.

    Attributes
    ----------
    inner, outer, cage : Rolling
    stiffness : float
        K of both raceway contacts in series [N/m^1.5].
    pocket_gap : float
        Largest gap between roller and spar [m].
    inner_table, outer_table : PlaneTable
        Of the oil of the raceway contacts, from `macroslip.roller.tables`; know nothing unless they were made.
    faded_load, faded_speed : float
        Elastic load [N] from which on films carry nothing beside it, at ring speeds up to this one [m/s].
    """

    inner: Any
    outer: Any
    cage: Any
    stiffness: float
    pocket_gap: float
    inner_table: PlaneTable
    outer_table: PlaneTable
    faded_load: float
    faded_speed: float


class RacewayFilm(NamedTuple):
    """Forces of the oil of a raceway contact on the roller, beside its traction inside the ellipse.

    Attributes
    ----------
    sliding : float
        Of the film outside the ellipse [N], positive where it drives the spin up.
    shear : float
        Rolling resistance in the spin equation [N].
    pull : float
        All forces along the ring's motion: sliding, shear and push of the pressure [N].
    power : float
        Of rolling resistance [W].
    sliding_slope, shear_slope, pull_slope : float
        Derivatives by slip [N s/m].
    """

    sliding: float
    shear: float
    pull: float
    power: float
    sliding_slope: float
    shear_slope: float
    pull_slope: float


class CageFilm(NamedTuple):
    """Forces of the oil in the pocket on the roller, in the spin equation.

    Attributes
    ----------
    sliding, shear : float
        [N].
    power : float
        Of rolling resistance [W].
    slope : float
        Derivative of both by slip at constant load [N s/m].
    by_load : float
        Derivative of both by load [-].
    """

    sliding: float
    shear: float
    power: float
    slope: float
    by_load: float


@jit_inline
def log_film(law, table, log_load, log_speed):
    """Ln of the film h of the volume flow [ln m] and its derivative by ln Q, from a contact's table or its law."""
    known = plane_values(table, log_load, log_speed)
    if known.known:
        return known.value[2], known.by_load[2] * table.load.per_spacing
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
def carried(films, play, body, ring_speed, guess=1.0):
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
    guess : float
        Where to look for it first [N].
    """
    log_speed = math.log(max(0.5 * abs(ring_speed), LOWEST_SPEED))
    low, high = _LOWEST, _HIGHEST
    place = math.log(guess) if guess > _FAINT else 0.0
    for _ in range(_ITERATIONS):
        excess, slope = _excess(films, place, body, play, log_speed)
        if excess > 0.0:
            low = place
        else:
            high = place
        following = place - excess / slope if slope < 0.0 else low
        if not low < following < high:
            following = 0.5 * (low + high)
        # Newton's error is then the square of this.
        if abs(following - place) < 1e-7:
            place = following
            break
        place = following
    # In proportion to speed where it vanishes.
    return math.exp(place) * min(1.0, 0.5 * abs(ring_speed) / LOWEST_SPEED)


@jit
def _film_load(films, load, approach, body, ring_speed, guess):
    if load <= 0.0:
        return carried(films, -approach, body, ring_speed, guess)
    if load >= films.faded_load and abs(ring_speed) <= films.faded_speed:
        return 0.0
    log_speed = math.log(max(0.5 * abs(ring_speed), LOWEST_SPEED))
    excess, _ = _excess(films, math.log(_FADED * load), body, 0.0, log_speed)
    if excess <= 0.0:
        return 0.0
    most = carried(films, 0.0, body, ring_speed, guess)
    return most * math.exp(-load / most) if most > 0.0 else 0.0


@jit
def faded(films, load, body, ring_speed):
    """Whether films carry nothing beside the elastic load [N] of a roller with a body force [N] at u2 [m/s]."""
    return (
        _excess(films, math.log(_FADED * load), body, 0.0, math.log(max(0.5 * abs(ring_speed), LOWEST_SPEED)))[0] <= 0.0
    )


@jit_inline
def _raceway_film(law, table, load, slip, ring_speed):
    if load <= 0.0:
        return RacewayFilm(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    # The push is −2 R/r times the shear.
    part = 1.0 - 2.0 * law.share_1
    mean = ring_speed - 0.5 * slip
    known = plane_values(table, math.log(load), math.log(abs(mean)))
    if known.known:
        conductance, resistance = math.exp(known.value[0]), math.exp(known.value[1])
        per_speed = table.speed.per_spacing / mean
        sliding = conductance * slip
        shear = -math.copysign(resistance, mean)
        sliding_slope = conductance - 0.5 * sliding * known.by_speed[0] * per_speed
        shear_slope = 0.5 * resistance * known.by_speed[1] * abs(per_speed)
        return RacewayFilm(
            sliding,
            shear,
            sliding + part * shear,
            2.0 * resistance * abs(mean),
            sliding_slope,
            shear_slope,
            sliding_slope + part * shear_slope,
        )
    return _raceway_film_by_laws(law, part, load, slip, ring_speed)


@jit
def _raceway_film_by_laws(law, part, load, slip, ring_speed):
    found = light_contact(law, load, ring_speed - slip, ring_speed)
    rolling = found.rolling
    sliding_slope = found.sliding_slope - 0.5 * found.sliding_by_speed
    shear_slope = -0.5 * rolling.by_speed
    return RacewayFilm(
        found.sliding,
        rolling.shear,
        found.sliding + part * rolling.shear,
        rolling.power,
        sliding_slope,
        shear_slope,
        sliding_slope + part * shear_slope,
    )


@jit
def _cage_film(films, load, surface_speed):
    found = pocket_contact(films.cage, load, surface_speed, 0.0, films.pocket_gap)
    rolling = found.rolling
    slope = found.sliding_slope - 0.5 * (found.sliding_by_speed + rolling.by_speed)
    return CageFilm(found.sliding, rolling.shear, rolling.power, slope, found.sliding_by_load + rolling.by_load)


_NO_RACEWAY = RacewayFilm(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
_NO_CAGE = CageFilm(0.0, 0.0, 0.0, 0.0, 0.0)


def film_load(films, load, approach, body, ring_speed, guess=1.0):
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
    guess : float
        Load near which it is looked for [N]; what was found for much the same place before, say.
    """
    return _film_load(films, load, approach, body, ring_speed, guess) if isinstance(films, Films) else 0.0


def raceway_film(films, raceway, load, slip, ring_speed):
    """Oil of a raceway contact, 0 the inner and 1 the outer: a `RacewayFilm`.

    Parameters
    ----------
    films : Films or NoFilms
    raceway : int
    load : float
        Normal load [N].
    slip, ring_speed : float
        Δu and u2 [m/s].
    """
    if not isinstance(films, Films):
        return _NO_RACEWAY
    law, table = (films.outer, films.outer_table) if raceway else (films.inner, films.inner_table)
    return _raceway_film(law, table, load, slip, ring_speed)


def cage_film(films, load, surface_speed):
    """Oil in the pocket of a roller whose surface moves at `surface_speed` [m/s], pressed by `load` [N]: a `CageFilm`.

    The sideways push of the pressure is radial there and left out.
    """
    return _cage_film(films, load, surface_speed) if isinstance(films, Films) else _NO_CAGE


@overload(film_load)
def _film_load_of(films, load, approach, body, ring_speed, guess=1.0):
    if films.instance_class is Films:
        return lambda films, load, approach, body, ring_speed, guess=1.0: _film_load(
            films, load, approach, body, ring_speed, guess
        )
    return lambda films, load, approach, body, ring_speed, guess=1.0: 0.0


@overload(raceway_film)
def _raceway_film_of(films, raceway, load, slip, ring_speed):
    if films.instance_class is Films:
        return lambda films, raceway, load, slip, ring_speed: _raceway_film(
            films.outer if raceway else films.inner,
            films.outer_table if raceway else films.inner_table,
            load,
            slip,
            ring_speed,
        )
    return lambda films, raceway, load, slip, ring_speed: RacewayFilm(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@overload(cage_film)
def _cage_film_of(films, load, surface_speed):
    if films.instance_class is Films:
        return lambda films, load, surface_speed: _cage_film(films, load, surface_speed)
    return lambda films, load, surface_speed: CageFilm(0.0, 0.0, 0.0, 0.0, 0.0)
