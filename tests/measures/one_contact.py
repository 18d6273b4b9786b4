"""How power lies along a roller at one contact, by the functions that samples of rollers call."""

from __future__ import annotations

import numpy as np

from macroslip.compiled import jit
from macroslip.contact.chords import FIRST_SLICE, SLICES, chord_stresses
from macroslip.measures.along import (
    ALONG,
    STATIONS,
    book_along,
    book_times,
    write_ellipse,
    write_powers,
)
from macroslip.measures.along_line import write_line
from macroslip.measures.maps import MAPS


@jit
def _written(contact, strips, state, sample, interface, slices):
    if strips is None:
        write_ellipse(contact, state, sample, interface, slices, FIRST_SLICE)
    else:
        write_line(contact, strips, state, sample, interface, slices, FIRST_SLICE)


@jit
def _booked(contact, touched, slices, along, times, passed):
    behind = FIRST_SLICE + touched[1]
    if contact.chorded:
        chord_stresses(contact.chords, slices, behind)
    write_powers(contact, slices, behind)
    book_along(along, slices, FIRST_SLICE, touched)
    book_times(times, slices, FIRST_SLICE, touched[1], passed)


def power_along(contact, interface, state, sample, passes, strips=None):
    """How power lies along the roller, of `ALONG`, and times and passes by classes of film and slip.

    Parameters
    ----------
    contact : macroslip.measures.along.Contact
    interface : int
        0 for the inner raceway, 1 for the outer one.
    state : tuple of float
        Load [N], u2 and Δu [m/s].
    sample : record of `macroslip.measures.samples.SAMPLE`
        Which stations touch is written.
    passes : float
        Passes of the roller since the sample before [-].
    strips : ndarray of `macroslip.measures.along_line.STRIP`, optional
        Of a line contact.
    """
    slices = np.zeros(1, SLICES)[0]
    along = np.zeros(1, ALONG)[0]
    times = np.zeros(1, MAPS)["film_slip"][0, interface]
    _written(contact, strips, state, sample, interface, slices)
    pressed = sample["under_load"] / STATIONS
    passed = (sample["time"] - sample["since"]) * pressed, passes * pressed
    _booked(contact, sample["touched"][interface], slices, along, times, passed)
    return along, times
