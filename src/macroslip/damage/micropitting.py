"""Micropitting: time and passes with thin films, and the sign of slip in them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from macroslip.arrays import FloatArray

REFERENCES = (
    "Rycerz and Kadiric, Tribol. Lett. 67 (2019) 63, doi:10.1007/s11249-019-1174-7: more with the "
    "slide-roll ratio at equal film "
    "ratio, and on the surface that is slower",
)


def share_below(amounts: ArrayLike, edges: Sequence[float], film_ratio: float) -> FloatArray:
    """Share [-] of time or passes in films thinner than a film ratio; NaN where there is none.

    Of amounts over (..., class of Λ, class of slip); the film ratio is one of the upper edges of
    the classes of Λ.

    Examples
    --------
    >>> share_below([[1.0, 2.0], [3.0, 4.0]], [1.0], 1.0).item()
    0.3
    """
    amounts = np.asarray(amounts, float)
    total = amounts.sum(axis=(-2, -1))
    classes = list(edges).index(film_ratio) + 1
    below = amounts[..., :classes, :].sum(axis=(-2, -1))
    with np.errstate(invalid="ignore", divide="ignore"):
        return below / total


def slower_share(amounts: ArrayLike, edges: Sequence[float]) -> FloatArray:
    """Share [-] of time, or of passes, with the ring the slower surface; the rest is the roller's.

    Of amounts over (..., class of the slide-roll ratio, ring less roller), whose upper edges but
    the last hold 0.

    Examples
    --------
    >>> slower_share([1.0, 1.0, 6.0], [-0.1, 0.0]).item()
    0.25
    """
    amounts = np.asarray(amounts, float)
    classes = list(edges).index(0.0) + 1
    slower = amounts[..., :classes].sum(-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        return slower / amounts.sum(-1)
