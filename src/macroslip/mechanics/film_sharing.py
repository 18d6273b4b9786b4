"""Loads that lubricant films carry where a roller has play between the rings."""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit, jit_inline
from macroslip.contact.line_approach import line_approach
from macroslip.contact.look_up import in_plane, log_load

#: Entrainment speed below which film formulas are not followed further [m/s].
LOWEST_SPEED = 1e-6
#: Film of the volume flow over the smallest gap of a rigid contact (Martin) [-].
FLOW = 1.2257
#: Film loads below this fraction of the elastic load are neglected [-]. They enter as e^−20, so that
#: loads jump there by 1e-10 of themselves, far below what any tolerance sees.
NEGLIGIBLE = 1.0 / 20.0
#: Lightest load of the search for q [N], and bounds of ln q [ln N].
_LIGHTEST_LOAD = 1e-9
_LIGHTEST = math.log(_LIGHTEST_LOAD)
_HEAVIEST = math.log(1e7)
#: Most iterations of Newton's method; it takes about two.
_ITERATIONS = 60
#: Change of ln q after which Newton's next one, of the order of its square, is below 1e-9.
_CONVERGED = 2e-5


@jit_inline
def _log_film_excess(body, tables, log_q, outward, play, log_u):
    """Ln of the films' height over their space at a load q of the lighter one, and d/d(ln q)."""
    root = math.exp(log_q * (1.0 / 3.0))
    load = root * root * root
    inner_load = load - min(outward, 0.0)
    outer_load = load + max(outward, 0.0)
    log_inner = log_q if outward >= 0.0 else math.log(inner_load)
    log_outer = log_q if outward <= 0.0 else math.log(outer_load)
    inner, inner_slope, _ = in_plane(body.inner.oil, tables, log_inner, log_u)
    outer, outer_slope, _ = in_plane(body.outer.oil, tables, log_outer, log_u)
    inner_film = math.exp(inner[2])
    outer_film = math.exp(outer[2])
    films = inner_film + outer_film
    growth = inner_film * inner_slope[2] * load / inner_load
    growth += outer_film * outer_slope[2] * load / outer_load
    approach = body.compliance * root * root
    exponent = 2.0 / 3.0
    if body.line_stiffness > 0.0:
        approach, exponent = line_approach(body.line_stiffness, body.profile_depth, log_q)
    space = play + approach
    slope = growth / films - exponent * approach / space
    return math.log(films / (FLOW * space)), slope


class FilmLoad(NamedTuple):
    """Load that the films on both raceways of a roller carry beside elastic load and body force."""

    load: float  #: q ≥ 0 [N]
    #: Load at which films and space are equal [N], where the search a moment later begins: q where
    #: there is play, and that of closed play where the rings press on the roller
    balance: float


@jit
def film_balance(body, tables, play, outward, ring_speed, guess):
    """Load q of the lighter of a roller's two raceway films that fill the space between rings [N].

    A roller with the play p lies between two films. With Q = q + |B| the load of the other, B the
    body force,

        [h(q) + h(q + |B|)]/1.2257 − (q/K)^(2/3) = p,

    h the film of the volume flow of a roller whose surface is at rest, u = u2/2, and in place of
    (q/K)^(2/3) the approach under q where contacts are lines. A roller without load turns slowly; one that grips has left its play, where q counts for little.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    tables : int
        Address of the flat array of tables.
    play : float
        p ≥ 0 [m].
    outward : float
        Body force B along the contact normal, positive outward [N].
    ring_speed : float
        u2 [m/s]; below twice `LOWEST_SPEED` films are those of this speed.
    guess : float
        Load at which the search begins [N], such as the load a moment before; 1 N where it is 0.

    Returns
    -------
    float
        q [N], to a relative error of 1e-9; 1e-9 N where the play is wider than the oil reaches.
    """
    if play >= body.film_reach:
        return math.exp(_LIGHTEST)
    log_u = math.log(max(0.5 * abs(ring_speed), LOWEST_SPEED))
    low = _LIGHTEST - 1.0
    high = _HEAVIEST
    log_q = math.log(guess) if guess > 0.0 else 0.0
    for _ in range(_ITERATIONS):
        excess, slope = _log_film_excess(body, tables, log_q, outward, play, log_u)
        if excess > 0.0:
            low = log_q
        else:
            high = log_q
        step = -excess / slope if slope < 0.0 else math.inf
        following = log_q + step
        # A start at the root may leave the bounds by rounding.
        if abs(step) >= _CONVERGED and not low < following < high:
            # Films that the play is too wide for carry nothing, which the lightest load shows at
            # once.
            wide = low < _LIGHTEST and excess <= 0.0
            following = _LIGHTEST if wide else 0.5 * (low + high)
        change = abs(following - log_q)
        log_q = following
        if change < _CONVERGED:
            break
    return math.exp(log_q)


@jit
def film_reach(body, tables, outward, ring_speed):
    """Play that films fill under the lightest load that the search for their load knows [m].

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    tables : int
        Address of the flat array of tables.
    outward : float
        Body force B along the contact normal, positive outward [N].
    ring_speed : float
        u2 [m/s].

    Returns
    -------
    float
        The play [m], above which films carry nothing; it is less at lower speeds.
    """
    log_u = math.log(max(0.5 * abs(ring_speed), LOWEST_SPEED))
    inner = in_plane(body.inner.oil, tables, log_load(_LIGHTEST_LOAD + max(-outward, 0.0)), log_u)
    outer = in_plane(body.outer.oil, tables, log_load(_LIGHTEST_LOAD + max(outward, 0.0)), log_u)
    return (math.exp(inner[0][2]) + math.exp(outer[0][2])) / FLOW


@jit
def film_load_is_negligible(body, tables, load, outward, ring_speed):
    """True if the film load is negligible against the elastic load of a roller.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    tables : int
        Address of the flat array of tables.
    load : float
        Elastic load [N].
    outward : float
        Body force along the contact normal, positive outward [N].
    ring_speed : float
        u2 [m/s].

    Returns
    -------
    bool
    """
    log_u = math.log(max(0.5 * abs(ring_speed), LOWEST_SPEED))
    log_q = math.log(NEGLIGIBLE * load)
    return _log_film_excess(body, tables, log_q, outward, 0.0, log_u)[0] <= 0.0


@jit_inline
def film_load(body, tables, load, approach, outward, ring_speed, guess=0.0):
    """Load of the films on either raceway beside the elastic load and the body force.

    As the play vanishes q rises to a load q0 that films carry without play; a roller that the rings
    press with Q_e has q0 exp(−Q_e/q0) of it left, so that loads are continuous.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    tables : int
        Address of the flat array of tables.
    load : float
        Elastic load Q_e [N].
    approach : float
        Elastic approach δ [m]; negative where there is play.
    outward : float
        Body force along the contact normal, positive outward [N].
    ring_speed : float
        u2 [m/s].
    guess : float
        Load at which the search begins [N], such as the `balance` a moment before; 1 N where it
        is 0.

    Returns
    -------
    FilmLoad
    """
    if not body.oily or load >= body.faded_load:
        return FilmLoad(0.0, guess)
    balance = film_balance(body, tables, max(-approach, 0.0), outward, ring_speed, guess)
    # Films vanish in proportion to speed below the lowest one that the formulas are used at.
    carried = balance * min(1.0, 0.5 * abs(ring_speed) / LOWEST_SPEED)
    if load <= 0.0:
        return FilmLoad(carried, balance)
    if carried <= NEGLIGIBLE * load:
        return FilmLoad(0.0, balance)
    return FilmLoad(carried * math.exp(-load / carried), balance)
