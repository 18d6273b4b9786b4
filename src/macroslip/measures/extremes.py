"""Largest flash temperature, power per area and slide-roll ratio, and least film ratio."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from macroslip.compiled import jit, jit_evaluation, jit_inline, jit_once
from macroslip.contact.flash import steady_flash, transient_flash
from macroslip.contact.look_up import log_speed
from macroslip.elementary import exponential, logarithm
from macroslip.mechanics.cage import cage_friction
from macroslip.mechanics.speeds import LOWEST_SPEED

if TYPE_CHECKING:
    from macroslip.measures.along import Contact

EXTREMES = ("flash_temperature", "power_density", "slide_roll_ratio", "film_ratio")


@jit_inline
def raise_extremes(extremes, orbit, interface, density, ratio, film_ratio):
    """Update the extremes of an orbit with those of a sample.

    Parameters
    ----------
    extremes : ndarray, shape (orbits, interfaces, 4)
        `EXTREMES` [K, W/m², 1, 1]; all but the temperature are raised, or lowered.
    orbit : int
        Number of the orbit; below 0 outside all complete ones, where nothing is done.
    interface : int
    density : float
        Largest power per area [W/m²].
    ratio : float
        Largest slide-roll ratio [-].
    film_ratio : float
        Λ [-].
    """
    if orbit >= 0:
        extremes[orbit, interface, 1] = max(extremes[orbit, interface, 1], density)
        extremes[orbit, interface, 2] = max(extremes[orbit, interface, 2], ratio)
        extremes[orbit, interface, 3] = min(extremes[orbit, interface, 3], film_ratio)


@jit_evaluation
def raise_flash(extremes, orbit, interface, heat, speeds, effusivity):
    """Raise the largest flash temperature of an orbit to that of a sample.

    Parameters
    ----------
    extremes : ndarray
        As of `raise_extremes`.
    orbit : int
        As of `raise_extremes`.
    interface : int
    heat : float
        Power per length times power per area where that is the highest [W²/m³].
    speeds : tuple of float
        Speeds of roller and counterpart [m/s].
    effusivity : float
        Of the steel [J/(m² K √s)].
    """
    if orbit >= 0:
        rise = steady_flash(heat, speeds[0], speeds[1], effusivity)
        # Of a steel whose effusivity is not known it is no number.
        if rise > extremes[orbit, interface, 0] or math.isnan(rise):
            extremes[orbit, interface, 0] = rise


class CageContact(NamedTuple):
    """Numbers of the cage's contact that its extremes ask for."""

    across: float  #: Semi-axis of the ellipse across rolling over the cube root of load [m/N^⅓]
    along: float  #: The same along rolling [m/N^⅓]
    roughness: float  #: Composite RMS roughness [m]
    effusivity: float  #: Thermal effusivity of its steel [J/(m² K √s)]


def cage_contact(contact: Contact) -> CageContact:
    """Numbers of the cage's contact, of all that `macroslip.measures.along.contacts_of` gives."""
    patch = contact.patch
    return CageContact(patch.across, patch.along, contact.roughness, contact.effusivity)


@jit_once
def sample_cage(body, tables, contact, sample, extreme):
    """Raise the extremes of the cage's contact, without the oil of its pocket.

    The force of that oil is far larger than the force of a light contact.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    tables : int
        Address of the flat array of tables.
    contact : CageContact
    sample : record of `macroslip.measures.samples.SAMPLE`
    extreme : ndarray
        As of `raise_extremes`.
    """
    surface = sample.at.cage_speed
    load = abs(sample.at.cage_load)
    if load > 0.0 and sample.orbit >= 0:
        root = exponential(logarithm(load) / 3.0)
        force = cage_friction(body, tables, load, surface, log_speed(surface)).force
        power = 0.75 * abs(surface * force) / (contact.across * root)
        half_width = contact.along * root
        ratio = abs(surface) / max(0.5 * abs(surface), LOWEST_SPEED)
        film_ratio = sample.film[2] / contact.roughness
        density = power / (2.0 * half_width)
        raise_extremes(extreme, sample.orbit, 2, density, ratio, film_ratio)
        speeds = surface, 0.0
        raise_flash(extreme, sample.orbit, 2, power * density, speeds, contact.effusivity)


@jit
def heat_entries(entering, count, is_last, effusivity, extreme):
    """Update the largest temperatures of load-zone entries [K] that have ended.

    Parameters
    ----------
    entering : ndarray, shape (11, n)
        Entry, orbit, time [s] and, by raceway where it is hottest, power per length [W/m],
        half-width [m], and speeds of roller and counterpart [m/s].
    count : int
        Number of columns that are filled.
    is_last : bool
        True if the last entry has ended too.
    effusivity : float
        Of the steel [J/(m² K √s)].
    extreme : ndarray
        As of `raise_extremes`; the temperature is raised.

    Returns
    -------
    int
        Number of the first column of the entry under way.
    """
    first = 0
    for last in range(1, count + 1):
        if last < count and entering[0, last] == entering[0, first]:
            continue
        if last == count and not is_last:
            break
        orbit = int(entering[1, first])
        if orbit >= 0:
            for i in range(2):
                band = entering[3 + 4 * i : 7 + 4 * i, first:last]
                rise = transient_flash(
                    entering[2, first:last],
                    band[0],
                    band[1],
                    band[2],
                    band[3],
                    effusivity,
                    effusivity,
                )
                extreme[orbit, i, 0] = max(extreme[orbit, i, 0], rise)
        first = last
    return first
