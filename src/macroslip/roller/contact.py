"""What a loaded contact returns: tangential forces, frictional power and all derivatives, from load, ring speed and slip.

One call for each kind of contact, whatever its laws are.
"""

from __future__ import annotations

from typing import NamedTuple

from macroslip.compiled import jit
from macroslip.roller.contact_force import cage_force, friction_power, raceway_force

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


class CageContact(NamedTuple):
    """A cage contact, which slides alike all over.

    Force on the roller [N], its derivatives by slip [N s/m] and by load [-], and frictional power [W].
    """

    force: float
    by_slip: float
    by_load: float
    power: float


@jit
def _forces(contact, load, ring_speed, slip):
    mean_speed = ring_speed - 0.5 * slip
    slope = -0.5 if mean_speed >= 0.0 else 0.5
    return raceway_force(contact, load, slip, ring_speed, abs(mean_speed), slope)


@jit
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
    here = _forces(contact, load, ring_speed, slip)
    power = friction_power(contact, slip, ring_speed, here.spin, here.detail)
    if load <= 0.0:
        return RacewayContact(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    change = _PART * load
    more, less = _forces(contact, load + change, ring_speed, slip), _forces(contact, load - change, ring_speed, slip)
    faster = _PART * abs(ring_speed) + 1e-9
    ahead = _forces(contact, load, ring_speed + faster, slip)
    behind = _forces(contact, load, ring_speed - faster, slip)
    return RacewayContact(
        here.spin,
        here.pull,
        here.spin_slope,
        here.pull_slope,
        0.5 * (more.spin - less.spin) / change,
        0.5 * (more.pull - less.pull) / change,
        0.5 * (ahead.spin - behind.spin) / faster,
        0.5 * (ahead.pull - behind.pull) / faster,
        power,
    )


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
    force, by_slip, by_load, _ = cage_force(contact, load, slip, 0.5 * abs(slip), slope)
    return CageContact(force, by_slip, by_load, abs(force * slip))
