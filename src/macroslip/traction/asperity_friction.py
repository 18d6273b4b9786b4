"""Boundary friction of the asperities that share the load with the film."""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit
from macroslip.traction.slip_field import slip_at

# Gauss-Legendre with four points, exact for the polynomials of degree 7 that occur between two corners.
_NODE_FAR = math.sqrt(3.0 / 7.0 + 2.0 / 7.0 * math.sqrt(6.0 / 5.0))
_NODE_NEAR = math.sqrt(3.0 / 7.0 - 2.0 / 7.0 * math.sqrt(6.0 / 5.0))
_WEIGHT_FAR = (18.0 - math.sqrt(30.0)) / 36.0
_WEIGHT_NEAR = (18.0 + math.sqrt(30.0)) / 36.0


class AsperityFriction(NamedTuple):
    """The law for one interface.

    Attributes
    ----------
    coefficient : float
        Boundary friction µ_b [-].
    full_slip : float
        Slip [m/s] from which on asperities slide; below it their friction is proportional to slip, as they first yield
        elastically during their passage.
    semi_axis_across : float
        Of the contact ellipse per Q^(1/3) [m/N^(1/3)].
    """

    coefficient: float
    full_slip: float
    semi_axis_across: float


class AsperityForce(NamedTuple):
    """Friction of the asperities over a contact; see `macroslip.traction.film_shear_law.Patch` for the meanings.

    Attributes
    ----------
    force, lag : float
        [N].
    skew : float
        [N m].
    force_slope, lag_slope : float
        [N s/m].
    power : float
        Frictional power ∫τ v dA of the asperities alone [W], never negative.
    """

    force: float
    lag: float
    skew: float
    force_slope: float
    lag_slope: float
    power: float


@jit
def _corner(field, contour_radius, level, larger):
    """Station at which slip passes `level`: the smaller or the larger of the two, infinite if there is none."""
    bend = 0.5 * field.curvature_rate / contour_radius
    spin = field.spin_rate
    rest = field.sliding - level
    root = spin * spin - 4.0 * bend * rest
    if root < 0.0:
        return math.inf
    far = 0.5 * (spin + math.copysign(math.sqrt(root), spin))
    first = far / bend if bend != 0.0 else math.inf
    second = rest / far if far != 0.0 else math.inf
    return max(first, second) if larger else min(first, second)


@jit
def asperity_friction(law, load, share, field, shape):
    """Friction of asperities that carry `share` of the load, in the contact's Hertz distribution.

    Parameters
    ----------
    law : AsperityFriction
    load : float
        Q > 0 [N].
    share : float
        Part of the load carried by asperities, 0 to 1.
    field : SlipField
    shape : ContactShape

    Returns
    -------
    AsperityForce

    Notes
    -----
    Stress is µ_b share p min(|v|/v_b, 1) sign(v). With Hertz pressure each chord carries 3Q/(4a) (1 − ζ²/a²) per length, so
    between the stations at which v passes −v_b and +v_b every integrand is a polynomial and the result exact.

    Examples
    --------
    >>> from macroslip.contact.shape import slipless
    >>> from macroslip.traction.slip_field import SlipField
    >>> law = AsperityFriction(0.1, 1e-4, 1e-3)
    >>> found = asperity_friction(law, 1000.0, 0.2, SlipField(0.01, 0.0, 0.0, 0.0), slipless(0.05))
    >>> round(found.force, 9), round(found.power, 9)
    (20.0, 0.2)
    """
    force, lag, skew, force_slope, lag_slope, power = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    if share <= 0.0:
        return AsperityForce(force, lag, skew, force_slope, lag_slope, power)
    across = law.semi_axis_across * load ** (1.0 / 3.0)
    half = min(across, shape.half_length)
    scale = 0.75 * law.coefficient * share * load / across
    radius = shape.contour_radius
    corners = (
        _corner(field, radius, law.full_slip, False),
        _corner(field, radius, law.full_slip, True),
        _corner(field, radius, -law.full_slip, False),
        _corner(field, radius, -law.full_slip, True),
    )
    before = -half
    while before < half:
        after = half
        for corner in corners:
            if before < corner < after:
                after = corner
        middle, reach = 0.5 * (before + after), 0.5 * (after - before)
        grips = abs(slip_at(field, radius, middle)) < law.full_slip
        for node in range(4):
            place = (_NODE_FAR if node % 3 == 0 else _NODE_NEAR) * (-1.0 if node < 2 else 1.0)
            station = middle + reach * place
            weight = scale * reach * (_WEIGHT_FAR if node % 3 == 0 else _WEIGHT_NEAR)
            weight *= 1.0 - station * station / (across * across)
            slip = slip_at(field, radius, station)
            drop = 0.5 * station * station / radius
            arm = drop / shape.roller_radius
            if grips:
                part = weight * slip / law.full_slip
                slope = weight * (1.0 + field.curvature_slope * drop) / law.full_slip
                force_slope += slope
                lag_slope += slope * arm
            else:
                part = math.copysign(weight, slip)
            force += part
            lag += part * arm
            skew += part * station
            power += part * slip
        before = after
    return AsperityForce(force, lag, skew, force_slope, lag_slope, power)
