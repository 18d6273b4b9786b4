"""Traction of a contact with uniform slip by the paper's closed form, with asperity friction."""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit_evaluation
from macroslip.contact.closed_form import patch_integral
from macroslip.elementary import exponential
from macroslip.mechanics.speeds import LOWEST_SPEED


class UniformTraction(NamedTuple):
    """Traction of a contact whose slip is the same all over."""

    force: float  #: F, with the sign of the slip [N]
    by_slip: float  #: ∂F/∂Δu at constant entrainment speed [N s/m]
    by_entrainment: float  #: ∂F/∂u_e at constant slip [N s/m]
    by_load: float  #: ∂F/∂Q [-]
    asperity_power: float  #: Part of the frictional power that asperities dissipate [W]


@jit_evaluation
def asperity_friction(law, share, load, slip):
    """Friction of asperities under a slip that is the same all over the contact, with its slopes.

    The friction coefficient of asperities rises to µ_b in proportion to slip.

    Parameters
    ----------
    law : record of `macroslip.roller.model.CONTACT`
    share : float
        Part of the load that asperities carry, 0 to 1 [-].
    load : float
        Normal load, ≥ 0 [N].
    slip : float
        Δu [m/s].

    Returns
    -------
    friction : float
        Friction with the sign of the slip [N].
    by_slip : float
        Its slope by slip [N s/m]; 0 at full slip.
    by_load : float
        Its slope by load at constant share [-].

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> law = SimpleNamespace(boundary_friction=0.1, full_slip=1e-4)
    >>> [round(float(value), 9) for value in asperity_friction(law, 0.2, 1e3, -2e-4)]
    [-20.0, 0.0, -0.02]
    """
    coefficient = law.boundary_friction * share
    if abs(slip) < law.full_slip:
        gradient = coefficient / law.full_slip
        return gradient * load * slip, gradient * load, gradient * slip
    return math.copysign(coefficient * load, slip), 0.0, math.copysign(coefficient, slip)


@jit_evaluation
def uniform_traction(law, film_plane, load, slip, entrainment_speed):
    """Traction of a heated Barus film (27) over the Hertz ellipse, F = 2π a b (η0 Δu/h) Φ.

    Parameters
    ----------
    law : record of `macroslip.roller.model.CONTACT`
    film_plane : tuple of three tuples of float
        Logarithm of the film [ln m] and share of asperities, with their derivatives by load and
        speed, as `in_plane` gives them; below `LOWEST_SPEED` those of this speed.
    load : ContactLoad
    slip : float
        Δu [m/s].
    entrainment_speed : float
        u_e ≥ 0 [m/s].

    Returns
    -------
    UniformTraction
    """
    film, film_by_load, film_by_speed = film_plane
    exponent = law.pressure_exponent * load.root
    patch, by_log_slip, by_exponent = patch_integral(exponent, law.heating * abs(slip))
    viscous = law.conductance * load.root * load.root * exponential(-film[0])
    force = viscous * patch * slip
    per_load = 1.0 / load.load
    by_load = (2.0 / 3.0 - film_by_load[0]) * force
    by_load += viscous * slip * by_exponent * exponent * (1.0 / 3.0)
    by_load *= per_load
    per_speed = 1.0 / entrainment_speed if entrainment_speed > LOWEST_SPEED else 0.0
    by_entrainment = -force * film_by_speed[0] * per_speed
    by_slip = viscous * (patch + by_log_slip)
    # Where asperities have nearly nothing, splines pass a little below zero.
    share = max(film[1], 0.0)
    if share == 0.0:
        return UniformTraction(force, by_slip, by_entrainment, by_load, 0.0)
    rough, rough_by_slip, rough_by_load = asperity_friction(law, share, load.load, slip)
    fluid = 1.0 - share
    # What a rise of the asperities' share adds: their friction at full share less the film's.
    exchanged = rough / share - force
    return UniformTraction(
        fluid * force + rough,
        fluid * by_slip + rough_by_slip,
        fluid * by_entrainment + exchanged * film_by_speed[1] * per_speed,
        fluid * by_load + rough_by_load + exchanged * film_by_load[1] * per_load,
        rough * slip,
    )
