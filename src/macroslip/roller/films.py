"""The oil around a roller: rolling resistance of its contacts and the shear of the films outside them.

These forces are added to the traction of the contacts. For `NoFilms` every function compiles to zeros.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from numba.extending import overload

from macroslip.compiled import jit, jit_inline
from macroslip.contact.logarithms import two_logarithms
from macroslip.roller.contact_force import is_known
from macroslip.roller.plane_table import PlaneTable, plane_values
from macroslip.roller.play_table import PlayTable
from macroslip.rolling.light_contact import light_contact, pocket_contact

_LN_2 = math.log(2.0)


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
    inner_table, outer_table, cage_table : PlaneTable
        Of the oil of the raceway contacts and in the pocket, from `macroslip.roller.tables`; empty unless they were
        made.
    play_table : PlayTable
        Of what films carry where a roller has play; likewise.
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
    cage_table: PlaneTable
    play_table: PlayTable
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
def _raceway_film(law, table, load, slip, ring_speed, logs):
    if load <= 0.0:
        return RacewayFilm(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    # The push is −2 R/r times the shear.
    part = 1.0 - 2.0 * law.share_1
    mean = ring_speed - 0.5 * slip
    known = plane_values(table, logs[0], logs[1])
    if known.known:
        conductance, resistance, per_speed = known.value[0], known.value[1], 1.0 / mean
        sliding = conductance * slip
        shear = -math.copysign(resistance, mean)
        sliding_slope = conductance - 0.5 * slip * known.by_speed[0] * per_speed
        shear_slope = 0.5 * known.by_speed[1] * abs(per_speed)
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


@jit_inline
def _cage_film(films, load, surface_speed, logs):
    if load > 0.0 and surface_speed != 0.0:
        mean = 0.5 * surface_speed
        known = plane_values(films.cage_table, logs[0], logs[1] - _LN_2)
        if known.known:
            conductance, resistance = known.value[0], known.value[1]
            sliding, shear = -conductance * surface_speed, -resistance * mean
            return CageFilm(
                sliding,
                shear,
                -2.0 * shear * mean,
                conductance + known.by_speed[0] + 0.5 * (resistance + known.by_speed[1]),
                -(surface_speed * known.by_load[0] + mean * known.by_load[1]) / load,
            )
    return _cage_film_by_laws(films, load, surface_speed)


@jit
def _cage_film_by_laws(films, load, surface_speed):
    found = pocket_contact(films.cage, load, surface_speed, 0.0, films.pocket_gap)
    rolling = found.rolling
    slope = found.sliding_slope - 0.5 * (found.sliding_by_speed + rolling.by_speed)
    return CageFilm(found.sliding, rolling.shear, rolling.power, slope, found.sliding_by_load + rolling.by_load)


_NO_RACEWAY = RacewayFilm(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
_NO_CAGE = CageFilm(0.0, 0.0, 0.0, 0.0, 0.0)


def raceway_film(films, raceway, load, slip, ring_speed, logs=None):
    """Oil of a raceway contact, 0 the inner and 1 the outer: a `RacewayFilm`.

    Parameters
    ----------
    films : Films or NoFilms
    raceway : int
    load : float
        Normal load Q [N].
    slip, ring_speed : float
        Δu and u2 [m/s].
    logs : tuple of 2 float, optional
        ln Q [ln N] and ln |u2 − Δu/2| [ln m/s], where they are known already.
    """
    if not isinstance(films, Films):
        return _NO_RACEWAY
    law, table = (films.outer, films.outer_table) if raceway else (films.inner, films.inner_table)
    logs = two_logarithms(load, ring_speed - 0.5 * slip) if logs is None else logs
    return _raceway_film(law, table, load, slip, ring_speed, logs)


def cage_film(films, load, surface_speed, logs=None):
    """Oil in the pocket of a roller whose surface moves at `surface_speed` [m/s], pressed by `load` [N]: a `CageFilm`.

    `logs` are ln Q [ln N] and that of the surface's speed [ln m/s], where they are known already. The sideways push of the
    pressure is radial there and left out.
    """
    if not isinstance(films, Films):
        return _NO_CAGE
    return _cage_film(films, load, surface_speed, two_logarithms(load, surface_speed) if logs is None else logs)


@overload(raceway_film)
def _raceway_film_of(films, raceway, load, slip, ring_speed, logs=None):
    def none(films, raceway, load, slip, ring_speed, logs=None):
        return RacewayFilm(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)

    def with_logs(films, raceway, load, slip, ring_speed, logs=None):
        law = films.outer if raceway else films.inner
        table = films.outer_table if raceway else films.inner_table
        return _raceway_film(law, table, load, slip, ring_speed, logs)

    def by_state(films, raceway, load, slip, ring_speed, logs=None):
        law = films.outer if raceway else films.inner
        table = films.outer_table if raceway else films.inner_table
        return _raceway_film(law, table, load, slip, ring_speed, two_logarithms(load, ring_speed - 0.5 * slip))

    if films.instance_class is not Films:
        return none
    return with_logs if is_known(logs) else by_state


@overload(cage_film)
def _cage_film_of(films, load, surface_speed, logs=None):
    def none(films, load, surface_speed, logs=None):
        return CageFilm(0.0, 0.0, 0.0, 0.0, 0.0)

    def with_logs(films, load, surface_speed, logs=None):
        return _cage_film(films, load, surface_speed, logs)

    def by_state(films, load, surface_speed, logs=None):
        return _cage_film(films, load, surface_speed, two_logarithms(load, surface_speed))

    if films.instance_class is not Films:
        return none
    return with_logs if is_known(logs) else by_state
