"""Error of the quadrature over a contact, from a much finer one at some samples."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.contact.patch import fine_power, patch_power
from macroslip.contact.strips import PreparedStrips
from macroslip.measures.samples import joined
from macroslip.measures.totals import RACEWAYS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from macroslip.contact.laws import PreparedContact, PreparedLaws
    from macroslip.measures.along import Contact


def quadrature_energies(
    laws: PreparedLaws, contacts: tuple[Contact, Contact, Contact], samples: Sequence[np.ndarray]
) -> np.ndarray:
    """Energies of the films of a row's rollers by two quadratures.

    All rollers are done at once: of the samples of one there are a few, and an evaluation of few
    takes as long as one of a hundred.

    Parameters
    ----------
    laws : PreparedLaws
        Of the row.
    contacts : tuple of Contact
        `macroslip.measures.along.contacts_of` of the laws.
    samples : sequence of ndarray of `macroslip.measures.samples.SAMPLE`
        By roller, the samples at which the quadrature is checked, with their films.

    Returns
    -------
    ndarray, shape (rollers, raceways, 2)
        Energy of the samples by the finer quadrature [J], and by how much power by the one in use
        differs from it in size, over the same times [J]. Zero of contacts that are computed without
        a quadrature over an ellipse.
    """
    energies = np.zeros((len(samples), len(RACEWAYS), 2))
    roller = np.repeat(np.arange(len(samples)), [of_one.size for of_one in samples])
    every = joined(samples)
    span = every["time"] - every["since"]
    for i, name in enumerate(RACEWAYS):
        law: PreparedContact = getattr(laws, name)
        # The rule of strips is not that of an ellipse; tests compare it with a finer one.
        if isinstance(law, PreparedStrips) or not law.shape.microslip or law.fluid is None:
            continue
        at = every["at"]
        loaded = at[f"{name}_load"] > 0.0
        load, ring_speed, slip = (
            at[f"{name}_{field}"][loaded] for field in ("load", "speed", "slip")
        )
        state = load, every["film"][loaded, i], ring_speed, slip
        used = patch_power(contacts[i].patch, contacts[i].chords, *state)
        fine = fine_power(contacts[i].patch, law.fluid, *state)
        np.add.at(energies[:, i, 0], roller[loaded], span[loaded] * fine)
        np.add.at(energies[:, i, 1], roller[loaded], span[loaded] * np.abs(used - fine))
    return energies
