"""Largest flash temperature, power per area and slide-roll ratio, and least film ratio."""

from __future__ import annotations

from macroslip.compiled import jit, jit_inline, jit_once
from macroslip.contact.flash import transient_flash
from macroslip.contact.look_up import log_speed
from macroslip.mechanics.cage import cage_friction
from macroslip.mechanics.speeds import LOWEST_SPEED

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


@jit_once
def sample_cage(body, tables, contact, sample, extreme):
    """Write power and extremes of the cage's contact, without the oil of its pocket.

    The force of that oil is far larger than the force of a light contact.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    tables : int
        Address of the flat array of tables.
    contact : macroslip.measures.along.Contact
    sample : record of `macroslip.measures.samples.SAMPLE`
        What is hottest is written.
    extreme : ndarray
        As of `raise_extremes`.
    """
    hot = sample.hot[2]
    surface = sample.at.cage_speed
    load = abs(sample.at.cage_load)
    hot[0] = 0.0
    hot[1] = 1.0
    hot[2] = surface
    hot[3] = 0.0
    if load > 0.0:
        root = load ** (1.0 / 3.0)
        force = cage_friction(body, tables, load, surface, log_speed(surface)).force
        hot[0] = 0.75 * abs(surface * force) / (contact.patch.across * root)
        hot[1] = contact.patch.along * root
        ratio = abs(surface) / max(0.5 * abs(surface), LOWEST_SPEED)
        raise_extremes(
            extreme,
            sample.orbit,
            2,
            hot[0] / (2.0 * hot[1]),
            ratio,
            sample.film[2] / contact.roughness,
        )


@jit
def heat_entries(rows, effusivity, extreme):
    """Update the largest temperatures of load-zone entries [K].

    Parameters
    ----------
    rows : ndarray, shape (11, samples)
        Entry, orbit, time [s] and, by raceway, what is hottest as `SAMPLE` has it.
    effusivity : float
        Of the steel [J/(m² K √s)].
    extreme : ndarray
        As of `raise_extremes`; the temperature is raised.
    """
    first = 0
    for last in range(1, rows.shape[1] + 1):
        if last < rows.shape[1] and rows[0, last] == rows[0, first]:
            continue
        orbit = int(rows[1, first])
        if orbit >= 0:
            for i in range(2):
                band = rows[3 + 4 * i : 7 + 4 * i, first:last]
                rise = transient_flash(
                    rows[2, first:last],
                    band[0],
                    band[1],
                    band[2],
                    band[3],
                    effusivity,
                    effusivity,
                )
                extreme[orbit, i, 0] = max(extreme[orbit, i, 0], rise)
        first = last
