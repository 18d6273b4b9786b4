"""What a loaded contact returns: tangential forces, frictional power and all derivatives, from load, ring speed and slip.

One call for each kind of contact, whatever its laws are.
"""

from __future__ import annotations

from typing import NamedTuple

from numba.extending import overload

from macroslip.compiled import jit
from macroslip.film.film_law import film_thickness
from macroslip.roller.cage_force import cage_force
from macroslip.roller.contact_force import (
    LOWEST_ENTRAINMENT_SPEED,
    CurvedContact,
    Detail,
    is_curved,
    raceway_force,
)
from macroslip.roller.friction_power import asperity_power, friction_power
from macroslip.roller.raceway_table import place_of, table_slopes
from macroslip.traction.traction_law import patch_traction

#: Part of a load or speed by which it is changed for a difference.
_PART = 1e-4


class RacewayContact(NamedTuple):
    """A raceway contact at one load, ring speed and slip. Forces act on the roller.

    Attributes
    ----------
    spin : float
        Moment about the roller's axis over r [N], positive where it drives the spin up.
    pull : float
        Tangential force ∫τ dA [N]; equal to `spin` where slip does not vary over the contact.
    spin_by_slip, pull_by_slip : float
        ∂/∂Δu at constant ring speed [N s/m].
    spin_by_load, pull_by_load : float
        ∂/∂Q [-].
    spin_by_speed, pull_by_speed : float
        ∂/∂u2 at constant slip [N s/m].
    power : float
        Frictional power ∫τ v dA [W].
    asperity_power : float
        Part of it that asperities dissipate [W].
    """

    spin: float
    pull: float
    spin_by_slip: float
    pull_by_slip: float
    spin_by_load: float
    pull_by_load: float
    spin_by_speed: float
    pull_by_speed: float
    power: float
    asperity_power: float


class CageContact(NamedTuple):
    """A cage contact, whose slip is the same all over.

    Force on the roller [N], its derivatives by slip [N s/m] and by load [-], frictional power and its part by asperities [W].
    """

    force: float
    by_slip: float
    by_load: float
    power: float
    asperity_power: float


@jit
def _forces(contact, load, ring_speed, slip):
    mean_speed = ring_speed - 0.5 * slip
    slope = -0.5 if mean_speed >= 0.0 else 0.5
    return raceway_force(contact, load, slip, ring_speed, abs(mean_speed), slope)


@jit
def _plain_contact(contact, load, ring_speed, slip):
    """A contact whose slip is the same all over: its laws give all derivatives."""
    if load <= 0.0:
        return RacewayContact(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    mean_speed = ring_speed - 0.5 * slip
    entrainment, direction = abs(mean_speed), 1.0 if mean_speed >= 0.0 else -1.0
    if entrainment < LOWEST_ENTRAINMENT_SPEED:
        entrainment, direction = LOWEST_ENTRAINMENT_SPEED, 0.0
    film, film_by_speed, film_by_load = film_thickness(contact.film, load, entrainment)
    force, by_slip, by_film, by_load = patch_traction(contact.traction, load, film, slip)
    by_speed = by_film * film_by_speed * direction
    by_slip -= 0.5 * by_speed
    by_load += by_film * film_by_load
    return RacewayContact(force, force, by_slip, by_slip, by_load, by_load, by_speed, by_speed, abs(force * slip), 0.0)


@jit
def _curved_contact(contact, load, ring_speed, slip):
    """A contact over which slip varies: without a table its derivatives by load and ring speed are differences."""
    if load <= 0.0:
        return RacewayContact(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    place = place_of(contact.table, load, ring_speed, slip)
    found = table_slopes(contact.table, place, load, ring_speed, slip)
    if found.known:
        (pull, lag, skew), rough = found.value, found.asperity_power
        spin = pull - lag
        return RacewayContact(
            spin,
            pull,
            found.by_slip[0] - found.by_slip[1],
            found.by_slip[0],
            found.by_load[0] - found.by_load[1],
            found.by_load[0],
            found.by_speed[0] - found.by_speed[1],
            found.by_speed[0],
            friction_power(contact, slip, ring_speed, spin, Detail(lag, skew, rough)),
            rough,
        )
    return _curved_by_laws(contact, load, ring_speed, slip)


@jit
def _curved_by_laws(contact, load, ring_speed, slip):
    here = _forces(contact, load, ring_speed, slip)
    power = friction_power(contact, slip, ring_speed, here.spin, here.detail)
    change = _PART * load
    more = _forces(contact, load + change, ring_speed, slip)
    faster = _PART * abs(ring_speed) + 1e-9
    ahead = _forces(contact, load, ring_speed + faster, slip)
    return RacewayContact(
        here.spin,
        here.pull,
        here.spin_slope,
        here.pull_slope,
        (more.spin - here.spin) / change,
        (more.pull - here.pull) / change,
        (ahead.spin - here.spin) / faster,
        (ahead.pull - here.pull) / faster,
        power,
        here.detail.asperity_power,
    )


def raceway_contact(contact, load, ring_speed, slip):
    """Traction and frictional power of a raceway contact, with derivatives.

    Parameters
    ----------
    contact : contact of a `RollerModel`
        Its `inner` or `outer`.
    load : float
        Normal load Q [N]; a contact without load has no traction.
    ring_speed : float
        Speed u2 of the ring's surface past the roller's centre [m/s], of either sign.
    slip : float
        Δu = u2 − u1 at the middle of the contact [m/s]; the roller's surface speed is u1 = u2 − Δu, and the
        entrainment speed |u2 − Δu/2|.

    Returns
    -------
    RacewayContact
        Odd in (u2, Δu) together; power is even.
    """
    compiled = _curved_contact if isinstance(contact, CurvedContact) else _plain_contact
    return compiled(contact, load, ring_speed, slip)


@overload(raceway_contact)
def _raceway_contact(contact, load, ring_speed, slip):
    compiled = _curved_contact if is_curved(contact) else _plain_contact
    return lambda contact, load, ring_speed, slip: compiled(contact, load, ring_speed, slip)


@jit
def cage_contact(contact, load, slip):
    """Traction and frictional power of the cage contact, with derivatives.

    Parameters
    ----------
    contact : contact of a `RollerModel`
        Its `cage`.
    load : float
        Normal load Q ≥ 0 [N].
    slip : float
        Speed of the cage's surface less that of the roller's [m/s]; the entrainment speed is half its magnitude.

    Returns
    -------
    CageContact
    """
    slope = 0.5 if slip >= 0.0 else -0.5
    force, by_slip, by_load, detail = cage_force(contact, load, slip, 0.5 * abs(slip), slope)
    return CageContact(force, by_slip, by_load, abs(force * slip), asperity_power(detail))
