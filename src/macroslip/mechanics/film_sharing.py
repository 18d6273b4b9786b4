"""Loads that lubricant films carry where a roller has play between the rings."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.contact.gap import FLOW
from macroslip.contact.line_approach import line_approach
from macroslip.contact.look_up import along_load, in_plane, log_load
from macroslip.elementary import exponential, logarithm
from macroslip.mechanics.speeds import LOWEST_SPEED

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


#: Number of body forces for which the largest play that films bridge is tabulated, and a margin on
#: that play for the splines of the films.
REACH_NODES = 32
_REACH_MARGIN = 1.001


class _Films(NamedTuple):
    """Films and elastic approach of a roller under a load q of the lighter raceway."""

    height: float  #: Of both films together [m]
    growth: float  #: d(ln height)/d(ln q) [-]
    approach: float  #: Elastic approach δ [m]
    exponent: float  #: d(ln δ)/d(ln q) [-]


@jit_inline
def _films_under(body, tables, log_q, outward, log_u):
    """Films and elastic approach under a load q of the lighter raceway, given by ln q."""
    root = exponential(log_q * (1.0 / 3.0))
    lighter = root * root * root
    heavier = lighter + abs(outward)
    log_heavier = logarithm(heavier)
    # d(ln Q)/d(ln q) of the heavier load Q; 1 of the lighter one.
    share = lighter / heavier
    outside = outward > 0.0
    log_inner = log_q if outside else log_heavier
    log_outer = log_heavier if outside else log_q
    inner, inner_slope = along_load(body.inner.oil, tables, log_inner, log_u)
    outer, outer_slope = along_load(body.outer.oil, tables, log_outer, log_u)
    inner_film = exponential(inner[2])
    outer_film = exponential(outer[2])
    height = inner_film + outer_film
    growth = inner_film * inner_slope[2] * (1.0 if outside else share)
    growth += outer_film * outer_slope[2] * (share if outside else 1.0)
    approach = body.compliance * root * root
    exponent = 2.0 / 3.0
    if body.line_stiffness > 0.0:
        approach, exponent = line_approach(body.line_stiffness, body.profile_depth, log_q)
    return _Films(height, growth / height, approach, exponent)


@jit_inline
def _log_excess(films, play):
    """Ln of the films' height over the space that a play [m] leaves them, and its slope by ln q."""
    space = play + films.approach
    slope = films.growth - films.exponent * films.approach / space
    return logarithm(films.height / (FLOW * space)), slope


@jit_inline
def _reach(body, outward):
    """Play above which film load is zero, tabulated at the next smaller body force [m]."""
    part = abs(outward) * body.per_body_force
    # A force that is no number must not lead beyond the nodes.
    part = part if part < 1.0 else 1.0
    node = int(math.sqrt(part) * (REACH_NODES - 1))
    return body.film_reach[1 if outward < 0.0 else 0, node]


@jit_inline
def log_film_balance(body, tables, play, outward, ring_speed, log_q):
    """Load at which the two films of a roller fill the space between the rings, as its logarithm.

    It is the load of the raceway that the body force does not press on. A roller with the play p lies between two films. With Q = q + |B| the load of the other, B the
    body force,

        [h(q) + h(q + |B|)]/1.2257 − (q/K)^(2/3) = p,

    h the film of the volume flow of a roller whose surface is at rest, u = u2/2, and in place of
    (q/K)^(2/3) the approach under q where contacts are lines. A roller without load turns slowly;
    one that grips has left its play, where q counts for little.

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
    log_q : float
        Where the search begins [ln N], such as the balance of a moment before.

    Returns
    -------
    float
        ln q, q in N, to an error of 1e-9; that of 1e-9 N where films do not bridge the play.
    """
    if play >= _reach(body, outward):
        return _LIGHTEST
    log_u = logarithm(max(0.5 * abs(ring_speed), LOWEST_SPEED))
    low = _LIGHTEST - 1.0
    high = _HEAVIEST
    for _ in range(_ITERATIONS):
        films = _films_under(body, tables, log_q, outward, log_u)
        excess, slope = _log_excess(films, play)
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
    return log_q


def reach_forces(largest: float) -> np.ndarray:
    """Body forces at which the play that films bridge is tabulated.

    Parameters
    ----------
    largest : float
        Largest body force along the contact normal [N].

    Returns
    -------
    ndarray, shape (REACH_NODES,)
        Forces from 0 to the largest [N], denser where they are small.

    Examples
    --------
    >>> reach_forces(961.0)[:3]
    array([0., 1., 4.])
    """
    return largest * (np.arange(REACH_NODES) / (REACH_NODES - 1)) ** 2


@jit
def film_reach(body, tables, outward, ring_speed):
    """Largest play bridged by the films at the search's lower load bound [m].

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
        Play [m], above which film load is zero; it is smaller at lower speeds.
    """
    log_u = logarithm(max(0.5 * abs(ring_speed), LOWEST_SPEED))
    inner_load = _LIGHTEST_LOAD + max(-outward, 0.0)
    inner = in_plane(body.inner.oil, tables, log_load(inner_load), log_u)
    outer = in_plane(body.outer.oil, tables, log_load(_LIGHTEST_LOAD + max(outward, 0.0)), log_u)
    return _REACH_MARGIN * (exponential(inner[0][2]) + exponential(outer[0][2])) / FLOW


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
    log_u = logarithm(max(0.5 * abs(ring_speed), LOWEST_SPEED))
    log_q = logarithm(NEGLIGIBLE * load)
    films = _films_under(body, tables, log_q, outward, log_u)
    return _log_excess(films, 0.0)[0] <= 0.0


class FilmLoad(NamedTuple):
    """Load that the films on both raceways of a roller carry beside elastic load and body force."""

    load: float  #: q ≥ 0 [N]
    #: Logarithm of the load at which films fill the space between the rings [ln N], where the next
    #: search begins: ln q where there is play, that of closed play where the rings press
    log_balance: float


@jit_inline
def film_load(body, tables, load, approach, outward, ring_speed, log_balance=0.0):
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
    log_balance : float
        Where the search for the load begins [ln N], such as the `log_balance` of a moment before.

    Returns
    -------
    FilmLoad
    """
    if not body.oily or load >= body.faded_load:
        return FilmLoad(0.0, log_balance)
    play = max(-approach, 0.0)
    log_q = log_film_balance(body, tables, play, outward, ring_speed, log_balance)
    # Films vanish in proportion to speed below the lowest one that the formulas are used at.
    carried = exponential(log_q) * min(1.0, 0.5 * abs(ring_speed) / LOWEST_SPEED)
    if load <= 0.0:
        return FilmLoad(carried, log_q)
    if carried <= NEGLIGIBLE * load:
        return FilmLoad(0.0, log_q)
    return FilmLoad(carried * exponential(-load / carried), log_q)
