"""Slip of loaded contacts: where traction is sure to rise with slip, and how a held roller follows its loads."""

from __future__ import annotations

import math

from numba.extending import overload

from macroslip.compiled import jit, jit_part
from macroslip.film.film_law import film_thickness
from macroslip.integrate.tuning import LEAST_CHANGE, MOST_QUICKENING, STEEPEST
from macroslip.roller.contact_force import LOWEST_ENTRAINMENT_SPEED, CurvedContact, is_curved, raceway_force
from macroslip.traction.traction_law import rising_slip


@jit
def steady_slip(contact, load, entrainment_speed, variation):
    """Slip [m/s] up to which traction of a contact is sure to rise with slip, where microslip varies by `variation` [m/s].

    Film thickness is that at `entrainment_speed` [m/s], the highest in question: a thick film heats up first.
    """
    if load <= 0.0:
        return math.inf
    film, _, _ = film_thickness(contact.film, load, max(entrainment_speed, LOWEST_ENTRAINMENT_SPEED))
    return rising_slip(contact.traction, load, film) - variation


def slip_variation(contact, load, ring_speed):
    """Largest difference [m/s] between the slip at a station and that of the middle."""
    return _curved_variation(contact, load, ring_speed) if isinstance(contact, CurvedContact) else 0.0


@jit
def _curved_variation(contact, load, ring_speed):
    shape = contact.shape
    if not shape.microslip or load <= 0.0:
        return 0.0
    half = min(contact.semi_axis_across * load ** (1.0 / 3.0), shape.half_length)
    return abs(ring_speed) * half * (abs(shape.spin_ratio) + 0.5 * half * shape.curvature_ratio / shape.contour_radius)


@overload(slip_variation)
def _slip_variation(contact, load, ring_speed):
    if is_curved(contact):
        return lambda contact, load, ring_speed: _curved_variation(contact, load, ring_speed)
    return lambda contact, load, ring_speed: 0.0


def slips_everywhere(contact):
    """Whether most places of a gripped contact slip, by microslip."""
    return isinstance(contact, CurvedContact) and contact.shape.microslip


@jit
def rising_at(model, inner_load, outer_load, ring_speed, entrainment_speed):
    """Slip up to which traction rises at both raceways at the given loads [N] and speeds [m/s]."""
    inner = steady_slip(model.inner, inner_load, entrainment_speed, slip_variation(model.inner, inner_load, ring_speed))
    outer = steady_slip(model.outer, outer_load, entrainment_speed, slip_variation(model.outer, outer_load, ring_speed))
    return min(inner, outer)


@jit
def relaxation_rate(model, load, ring_speed):
    """Rate (r²/I_z') d(F_i + F_o)/dv [1/s] at the slip at which F_i + F_o = 0, under `load` [N].

    `ring_speed` ≥ 0 [m/s] is that of the raceways. Without microslip this slip is zero; with it, a Newton iteration held
    within the slips that occur in the contact finds it.
    """
    slip, low, high = 0.0, -math.inf, math.inf
    rate = 0.0
    for _ in range(20):
        inner = raceway_force(model.inner, load, slip, ring_speed, ring_speed, 0.0)
        outer = raceway_force(model.outer, load, slip, ring_speed, ring_speed, 0.0)
        rest, slope = inner.spin + outer.spin, inner.spin_slope + outer.spin_slope
        rate = model.mobility * slope
        if rest > 0.0:
            high = slip
        else:
            low = slip
        following = slip - rest / slope if slope > 0.0 else slip
        if not low <= following <= high:
            following = 0.5 * (low + high)
        if abs(following - slip) <= 1e-6 * abs(slip) or not math.isfinite(following):
            break
        slip = following
    return rate


@jit_part
def held_slip(microslip, slip, at, later, exponent):
    """Guess of the slip of a firmly held roller at a later station from its slip now.

    With microslip the middle slips so that the two sides of the lines of pure rolling balance: in proportion to speed,
    and to a power of the load that `held_exponent` measures.
    """
    if not microslip or at.elastic_load <= 0.0 or at.ring_speed == 0.0:
        return slip
    if abs(later.ring_speed) > MOST_QUICKENING * abs(at.ring_speed):
        return slip
    return slip * (later.elastic_load / at.elastic_load) ** exponent * (later.ring_speed / at.ring_speed)


@jit
def held_exponent(at, slip, later, later_slip, exponent):
    """The power of load with which the slip of a held roller has just changed; `exponent` where it cannot be measured."""
    if at.elastic_load <= 0.0 or later.elastic_load <= 0.0:
        return exponent
    change = math.log(later.elastic_load / at.elastic_load)
    ratio = later_slip * at.ring_speed / (slip * later.ring_speed) if slip * later.ring_speed != 0.0 else 0.0
    if abs(change) < LEAST_CHANGE or ratio <= 0.0:
        return exponent
    return min(max(math.log(ratio) / change, -STEEPEST), STEEPEST)
