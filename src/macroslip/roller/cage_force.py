"""Traction of the cage contact, whose slip is the same all over."""

from __future__ import annotations

from numba.extending import overload

from macroslip.compiled import jit, jit_inline
from macroslip.contact.logarithms import two_logarithms
from macroslip.film.asperity_load import asperity_share
from macroslip.film.film_law import film_thickness
from macroslip.roller.contact_force import (
    LOWEST_ENTRAINMENT_SPEED,
    CurvedContact,
    Detail,
    contact_force,
    is_curved,
    is_known,
)
from macroslip.roller.plane_table import plane_values
from macroslip.traction.asperity_friction import asperity_friction
from macroslip.traction.slip_field import SlipField
from macroslip.traction.traction_law import patch_traction


@jit_inline
def _curved_cage(contact, load, slip, entrainment_speed, entrainment_slope, logs):
    if load <= 0.0:
        return 0.0, 0.0, 0.0, Detail(0.0, 0.0, 0.0)
    found = plane_values(contact.table, logs[0], logs[1])
    if found.known:
        conductance = found.value[0]
        return (
            conductance * slip,
            conductance + found.by_speed[0],
            found.by_load[0] * slip / load,
            Detail(0.0, 0.0, found.value[1] * conductance * slip * slip),
        )
    return _cage_by_laws(contact, load, slip, entrainment_speed, entrainment_slope)


@jit
def _cage_by_laws(contact, load, slip, entrainment_speed, entrainment_slope):
    if entrainment_speed < LOWEST_ENTRAINMENT_SPEED:
        entrainment_speed = LOWEST_ENTRAINMENT_SPEED
        entrainment_slope = 0.0
    film, film_by_speed, film_by_load = film_thickness(contact.film, load, entrainment_speed)
    force, slope, force_by_film, by_load = patch_traction(contact.traction, load, film, slip)
    slope += force_by_film * film_by_speed * entrainment_slope
    by_load += force_by_film * film_by_load
    share = asperity_share(contact.asperity_load, load, entrainment_speed, film)
    field = SlipField(slip, 0.0, 0.0, 0.0)
    rough = asperity_friction(contact.asperity_friction, load, share, field, contact.shape)
    fluid = 1.0 - share
    return (
        fluid * force + rough.force,
        fluid * slope + rough.force_slope,
        fluid * by_load + rough.force / load,
        Detail(0.0, 0.0, rough.power),
    )


def cage_force(contact, load, slip, entrainment_speed, entrainment_slope, logs=None):
    """Traction of the cage contact: F [N], dF/dΔu [N s/m], ∂F/∂Q [-] and a `Detail`, None for a plain contact.

    Parameters
    ----------
    contact : PlainContact or CurvedContact
    load : float
        Normal load Q [N].
    slip : float
        Δu [m/s].
    entrainment_speed : float
        u_e [m/s].
    entrainment_slope : float
        du_e/dΔu [-].
    logs : tuple of 2 float, optional
        ln Q [ln N] and ln |Δu| [ln m/s], where they are known already.
    """
    given = contact, load, slip, entrainment_speed, entrainment_slope
    if isinstance(contact, CurvedContact):
        return _curved_cage(*given, two_logarithms(load, slip) if logs is None else logs)
    return (*contact_force(*given), None)


@overload(cage_force)
def _cage_force(contact, load, slip, entrainment_speed, entrainment_slope, logs=None):
    def plain(contact, load, slip, entrainment_speed, entrainment_slope, logs=None):
        force, slope, by_load = contact_force(contact, load, slip, entrainment_speed, entrainment_slope)
        return force, slope, by_load, None

    def with_logs(contact, load, slip, entrainment_speed, entrainment_slope, logs=None):
        return _curved_cage(contact, load, slip, entrainment_speed, entrainment_slope, logs)

    def by_state(contact, load, slip, entrainment_speed, entrainment_slope, logs=None):
        return _curved_cage(contact, load, slip, entrainment_speed, entrainment_slope, two_logarithms(load, slip))

    if not is_curved(contact):
        return plain
    return with_logs if is_known(logs) else by_state
