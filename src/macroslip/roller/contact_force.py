"""Traction of a raceway contact: film, traction and, in a curved contact, microslip and asperities together.

Two kinds of contact exist. A `PlainContact` has the same slip all over, as in the paper's model; its kernels contain
nothing else. A `CurvedContact` has a slip field over the stations along the roller's axis, and asperities that
share the load. Which kind a roller has follows from the types in its model when the kernel is compiled. A curved contact
may have a table of what its laws give, which is looked up first.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from numba import types
from numba.extending import overload

from macroslip.compiled import jit, jit_inline
from macroslip.contact.lanes import chosen, every, is_lanes
from macroslip.contact.shape import ContactShape
from macroslip.film.asperity_load import AsperityLoad, asperity_share
from macroslip.film.film_law import film_thickness
from macroslip.roller.raceway_table import place_of, table_force
from macroslip.traction.asperity_friction import AsperityFriction, asperity_friction
from macroslip.traction.slip_field import SlipField
from macroslip.traction.traction_law import patch_traction, patch_traction_microslip

#: Entrainment speed below which the film formula is not followed further [m/s].
LOWEST_ENTRAINMENT_SPEED = 1e-6


class PlainContact(NamedTuple):
    """Film and traction law of one interface, each prepared for it."""

    film: Any
    traction: Any


class CurvedContact(NamedTuple):
    """Laws of one interface whose slip may vary along the roller, and whose asperities may touch.

    Attributes
    ----------
    film, traction : NamedTuple
        Laws, each prepared for the interface.
    asperity_load : AsperityLoad
        Share of the load that asperities carry.
    asperity_friction : AsperityFriction
        What they do with it.
    shape : ContactShape
        How slip varies.
    semi_axis_across, semi_axis_along : float
        Of the contact ellipse per Q^(1/3) [m/N^(1/3)].
    effusivity_1, effusivity_2 : float
        Thermal effusivity of roller and counterpart [J/(m² K √s)]; NaN where unknown.
    roughness : float
        Composite RMS roughness [m].
    table : RacewayTable or PlaneTable
        Of a raceway's contact or of the cage's, from `macroslip.roller.tables`; empty unless one was made.
    """

    film: Any
    traction: Any
    asperity_load: AsperityLoad
    asperity_friction: AsperityFriction
    shape: ContactShape
    semi_axis_across: float
    semi_axis_along: float
    effusivity_1: float
    effusivity_2: float
    roughness: float
    table: Any


class Detail(NamedTuple):
    """What a curved contact adds to its force.

    Attributes
    ----------
    lag : float
        ∫τ h/r dA [N]: by so much the moment about the roller's axis, over r, falls short of the force.
    skew : float
        Skew moment ∫τ ζ dA [N m].
    asperity_power : float
        Part of the frictional power that asperities dissipate [W].
    """

    lag: float
    skew: float
    asperity_power: float


class ContactForce(NamedTuple):
    """Traction of a raceway contact on the roller.

    Attributes
    ----------
    spin : float
        Moment about the roller's axis over r [N], positive where it drives the spin up.
    pull : float
        Tangential force ∫τ dA [N]; equal to `spin` where slip does not vary.
    spin_slope, pull_slope : float
        Their derivatives by slip, with the film's change [N s/m].
    detail : Detail or None
        None for a plain contact.
    """

    spin: float
    pull: float
    spin_slope: float
    pull_slope: float
    detail: Any


def contact_force(contact, load, slip, entrainment_speed, entrainment_slope):
    """Traction of one contact with the same slip everywhere, and its derivatives by slip and by load.

    Parameters
    ----------
    contact : PlainContact or CurvedContact
    load : float
        Normal load [N]; a contact without load has no traction.
    slip : float
        Δu [m/s].
    entrainment_speed : float
        u_e [m/s], floored at `LOWEST_ENTRAINMENT_SPEED`.
    entrainment_slope : float
        du_e/dΔu [-].

    Returns
    -------
    tuple of float
        F [N], dF/dΔu with the film's change [N s/m], ∂F/∂Q [-].
    """
    return _force_at_one(contact, load, slip, entrainment_speed, entrainment_slope)


@overload(contact_force)
def _contact_force(contact, load, slip, entrainment_speed, entrainment_slope):
    def at_one(contact, load, slip, entrainment_speed, entrainment_slope):
        return _force_at_one(contact, load, slip, entrainment_speed, entrainment_slope)

    def in_lanes(contact, load, slip, entrainment_speed, entrainment_slope):
        return _force_in_lanes(contact, load, slip, entrainment_speed, entrainment_slope)

    return in_lanes if is_lanes(load) else at_one


@jit_inline
def _force_at_one(contact, load, slip, entrainment_speed, entrainment_slope):
    if load <= 0.0:
        return 0.0, 0.0, 0.0
    if entrainment_speed < LOWEST_ENTRAINMENT_SPEED:
        entrainment_speed = LOWEST_ENTRAINMENT_SPEED
        entrainment_slope = 0.0
    return _loaded_force(contact, load, slip, entrainment_speed, entrainment_slope)


@jit_inline
def _force_in_lanes(contact, load, slip, entrainment_speed, entrainment_slope):
    free, slow = load <= 0.0, entrainment_speed < LOWEST_ENTRAINMENT_SPEED
    if every(free):
        none = 0.0 * slip
        return none, none, none
    force, slope, by_load = _loaded_force(
        contact,
        chosen(free, 1.0, load),
        slip,
        chosen(slow, LOWEST_ENTRAINMENT_SPEED, entrainment_speed),
        chosen(slow, 0.0, entrainment_slope),
    )
    return chosen(free, 0.0, force), chosen(free, 0.0, slope), chosen(free, 0.0, by_load)


@jit_inline
def _loaded_force(contact, load, slip, entrainment_speed, entrainment_slope):
    film, film_by_speed, film_by_load = film_thickness(contact.film, load, entrainment_speed)
    force, by_slip, by_film, by_load = patch_traction(contact.traction, load, film, slip)
    return force, by_slip + by_film * film_by_speed * entrainment_slope, by_load + by_film * film_by_load


@jit_inline
def _plain_raceway(contact, load, slip, ring_speed, entrainment_speed, entrainment_slope):
    force, slope, _ = contact_force(contact, load, slip, entrainment_speed, entrainment_slope)
    return ContactForce(force, force, slope, slope, None)


@jit_inline
def slip_field(shape, slip, ring_speed):
    """Slip over the stations of a raceway contact whose ring moves past the roller's centre at `ring_speed` [m/s]."""
    if not shape.microslip:
        return SlipField(slip, 0.0, 0.0, 0.0)
    slowing = 1.0 / shape.roller_radius
    return SlipField(slip, ring_speed * shape.curvature_ratio - slip * slowing, ring_speed * shape.spin_ratio, -slowing)


@jit_inline
def _curved_raceway(contact, load, slip, ring_speed, entrainment_speed, entrainment_slope, place):
    if load <= 0.0:
        return ContactForce(0.0, 0.0, 0.0, 0.0, Detail(0.0, 0.0, 0.0))
    found = table_force(contact.table, place, load, ring_speed, slip)
    if found.known:
        return ContactForce(
            found.pull - found.lag,
            found.pull,
            found.pull_slope - found.lag_slope,
            found.pull_slope,
            Detail(found.lag, found.skew, found.asperity_power),
        )
    return _raceway_by_laws(contact, load, slip, ring_speed, entrainment_speed, entrainment_slope)


@jit
def _raceway_by_laws(contact, load, slip, ring_speed, entrainment_speed, entrainment_slope):
    if entrainment_speed < LOWEST_ENTRAINMENT_SPEED:
        entrainment_speed = LOWEST_ENTRAINMENT_SPEED
        entrainment_slope = 0.0
    film, film_by_speed, _ = film_thickness(contact.film, load, entrainment_speed)
    field = slip_field(contact.shape, slip, ring_speed)
    patch = patch_traction_microslip(contact.traction, load, film, field, contact.shape, False)
    share = asperity_share(contact.asperity_load, load, entrainment_speed, film)
    rough = asperity_friction(contact.asperity_friction, load, share, field, contact.shape)
    fluid = 1.0 - share
    thinning = film_by_speed * entrainment_slope
    pull = fluid * patch.force + rough.force
    lag = fluid * patch.lag + rough.lag
    pull_slope = fluid * (patch.force_slope + patch.force_by_film * thinning) + rough.force_slope
    lag_slope = fluid * (patch.lag_slope + patch.lag_by_film * thinning) + rough.lag_slope
    detail = Detail(lag, fluid * patch.skew + rough.skew, rough.power)
    return ContactForce(pull - lag, pull, pull_slope - lag_slope, pull_slope, detail)


def raceway_force(contact, load, slip, ring_speed, entrainment_speed, entrainment_slope, place=None):
    """Traction of a raceway contact.

    Parameters
    ----------
    contact : PlainContact or CurvedContact
    load : float
        Normal load [N]; a contact without load has no traction.
    slip : float
        Δu at the middle of the contact [m/s].
    ring_speed : float
        Speed u2 of the ring past the roller's centre [m/s].
    entrainment_speed : float
        u_e [m/s], floored at `LOWEST_ENTRAINMENT_SPEED`; that of the middle serves the whole contact. A table was made
        for |u2 − Δu/2|.
    entrainment_slope : float
        du_e/dΔu [-].
    place : RacewayPlace, optional
        In the contact's table, where it is known already.

    Returns
    -------
    ContactForce
        With asperities, film and asperities in proportion to the load each carries: the film acts on its share of the
        area at the full Hertz pressure.
    """
    given = contact, load, slip, ring_speed, entrainment_speed, entrainment_slope
    if not isinstance(contact, CurvedContact):
        return _plain_raceway(*given)
    return _curved_raceway(*given, place_of(contact.table, load, ring_speed, slip) if place is None else place)


def is_known(argument) -> bool:
    """Whether an optional argument is given, from its numba type; for use where a kernel is compiled."""
    return argument is not None and not isinstance(argument, types.NoneType | types.Omitted)


def is_curved(contact) -> bool:
    """Whether a contact is curved, from its numba type; for use where a kernel is compiled."""
    return getattr(contact, "instance_class", None) is CurvedContact


@overload(raceway_force)
def _raceway_force(contact, load, slip, ring_speed, entrainment_speed, entrainment_slope, place=None):
    def plain(contact, load, slip, ring_speed, entrainment_speed, entrainment_slope, place=None):
        return _plain_raceway(contact, load, slip, ring_speed, entrainment_speed, entrainment_slope)

    def at_place(contact, load, slip, ring_speed, entrainment_speed, entrainment_slope, place=None):
        return _curved_raceway(contact, load, slip, ring_speed, entrainment_speed, entrainment_slope, place)

    def by_state(contact, load, slip, ring_speed, entrainment_speed, entrainment_slope, place=None):
        found = place_of(contact.table, load, ring_speed, slip)
        return _curved_raceway(contact, load, slip, ring_speed, entrainment_speed, entrainment_slope, found)

    if not is_curved(contact):
        return plain
    return at_place if is_known(place) else by_state
