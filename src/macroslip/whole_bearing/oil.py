"""The oil around the rollers: rolling resistance and light contacts, as forces and all their derivatives.

A raceway contact with its oil exerts, beside the traction inside its ellipse, the sliding of the film around it, the shear
F_R of the inlet on both surfaces, and the sideways push of the inclined pressure, 2 F_R R/R_1 on the roller. With
R/R_1 = r~_in/r~ and r~_out/r~ the forces on roller and ring have equal and opposite torques about the bearing's axis, and
what they dissipate is 2 F_R u beside the sliding. On the cage the push is radial; it is left out, as that of the friction.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from numba.extending import overload

from macroslip.compiled import jit, jit_inline
from macroslip.contact.logarithms import two_logarithms
from macroslip.roller.films import Films
from macroslip.roller.plane_table import plane_values
from macroslip.rolling.light_contact import light_contact, pocket_contact


class Oil(NamedTuple):
    """Forces of the oil of one contact on the roller [N], positive where they drive the spin up.

    Attributes
    ----------
    sliding, shear : float
        Of the film outside the ellipse, and rolling resistance.
    sliding_by_slip, shear_by_slip : float
        ∂/∂Δu at constant ring speed [N s/m].
    sliding_by_load, shear_by_load : float
        ∂/∂Q [-].
    sliding_by_speed, shear_by_speed : float
        ∂/∂u2 at constant slip [N s/m].
    """

    sliding: float
    shear: float
    sliding_by_slip: float
    shear_by_slip: float
    sliding_by_load: float
    shear_by_load: float
    sliding_by_speed: float
    shear_by_speed: float


@jit
def _from_light(found):
    """Derivatives by the speed of the ring and by slip, from those by the mean speed u = u2 − Δu/2."""
    rolling = found.rolling
    return Oil(
        found.sliding,
        rolling.shear,
        found.sliding_slope - 0.5 * found.sliding_by_speed,
        -0.5 * rolling.by_speed,
        found.sliding_by_load,
        rolling.by_load,
        found.sliding_by_speed,
        rolling.by_speed,
    )


@jit_inline
def _from_table(known, load, mean, slip):
    """Oil of a raceway contact at the mean speed u = u2 − Δu/2 from splines of conductance and resistance."""
    conductance, resistance = known.value[0], known.value[1]
    sliding, shear = conductance * slip, -math.copysign(resistance, mean)
    sliding_by_speed = slip * known.by_speed[0] / mean
    shear_by_speed = -known.by_speed[1] / abs(mean)
    return Oil(
        sliding,
        shear,
        conductance - 0.5 * sliding_by_speed,
        -0.5 * shear_by_speed,
        slip * known.by_load[0] / load,
        -math.copysign(known.by_load[1], mean) / load,
        sliding_by_speed,
        shear_by_speed,
    )


@jit
def _raceway_oil(films, outer, load, ring_speed, slip):
    if load <= 0.0:
        return Oil(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    law, table = (films.outer, films.outer_table) if outer else (films.inner, films.inner_table)
    mean = ring_speed - 0.5 * slip
    known = plane_values(table, *two_logarithms(load, mean))
    if known.known:
        return _from_table(known, load, mean, slip)
    return _from_light(light_contact(law, load, ring_speed - slip, ring_speed))


@jit_inline
def _pocket_from_table(known, load, slip):
    """Oil in a pocket, whose mean speed is −Δu/2, from splines of conductance and resistance per mean speed."""
    conductance, resistance = known.value[0], known.value[1]
    sliding, shear = conductance * slip, 0.5 * resistance * slip
    return Oil(
        sliding,
        shear,
        conductance + known.by_speed[0],
        0.5 * (resistance + known.by_speed[1]),
        slip * known.by_load[0] / load,
        0.5 * slip * known.by_load[1] / load,
        -2.0 * known.by_speed[0],
        -(resistance + known.by_speed[1]),
    )


@jit
def _cage_oil(films, load, slip):
    if load > 0.0 and slip != 0.0:
        known = plane_values(films.cage_table, *two_logarithms(load, 0.5 * slip))
        if known.known:
            return _pocket_from_table(known, load, slip)
    return _from_light(pocket_contact(films.cage, load, -slip, 0.0, films.pocket_gap))


_NONE = Oil(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def raceway_oil(films, outer, load, ring_speed, slip):
    """Oil of a raceway contact.

    Parameters
    ----------
    films : Films or NoFilms
    outer : bool
        Which raceway.
    load : float
        Normal load [N].
    ring_speed, slip : float
        u2 and Δu [m/s].

    Returns
    -------
    Oil
    """
    return _raceway_oil(films, outer, load, ring_speed, slip) if isinstance(films, Films) else _NONE


def cage_oil(films, load, slip):
    """Oil in the pocket of a roller that slides by Δu = `slip` [m/s] against a spar pressed by `load` [N]: an `Oil`."""
    return _cage_oil(films, load, slip) if isinstance(films, Films) else _NONE


def has_oil(films) -> bool:
    """Whether oil acts on rollers without load too; a constant where a kernel is compiled."""
    return isinstance(films, Films)


@overload(raceway_oil)
def _raceway_oil_of(films, outer, load, ring_speed, slip):
    if films.instance_class is Films:
        return lambda films, outer, load, ring_speed, slip: _raceway_oil(films, outer, load, ring_speed, slip)
    return lambda films, outer, load, ring_speed, slip: Oil(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@overload(cage_oil)
def _cage_oil_of(films, load, slip):
    if films.instance_class is Films:
        return lambda films, load, slip: _cage_oil(films, load, slip)
    return lambda films, load, slip: Oil(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@overload(has_oil)
def _has_oil_of(films):
    oily = films.instance_class is Films
    return lambda films: oily
