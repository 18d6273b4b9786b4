"""Sentences on a result of a tapered roller bearing, for pages and commands."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from macroslip.printed import number

#: Where the row lies that carries thrust along +Z0, by arrangement.
_SIDES = {"O": "upwind", "X": "downwind"}
#: Films above this film ratio Λ are full.
_FULL_FILM = 3.0
#: Reference life over L10h below which a sentence says so.
_SHORTER = 0.5


def tapered_sentences(result: xr.Dataset, bearing: Mapping[str, Any]) -> list[str]:
    """Sentences on rows, preload, grip and ribs of a tapered roller bearing; none of another one.

    Parameters
    ----------
    result : xarray.Dataset
        From `macroslip.simulate`.
    bearing : mapping
        Entries of its bearing's file; empty if they are not known.
    """
    if "rib_energy" not in result:
        return []
    return [_rows(bearing), _preload(result), _ribs(result)]


def _rows(bearing: Mapping[str, Any]) -> str:
    """Where the rows lie that are named by the thrust that they carry."""
    arrangement = bearing.get("arrangement", "")
    side = _SIDES.get(arrangement)
    lies = f": in {arrangement} arrangement the downwind row lies {side} of the mid-plane"
    return f"Rows are named by the thrust that they carry{lies if side else ''}."


def _preload(result: xr.Dataset) -> str:
    """Preload, and how many rollers are below grip."""
    preload = float(result.preload)
    word = "preload" if preload >= 0.0 else "play"
    change = float(result.preload_change)
    by = f" ({1e3 * change:+.3g} mm by the temperature difference)" if change else ""
    size = number(1e3 * abs(preload), 3)
    grip = float(result.grip_load)
    if not np.isfinite(grip):
        return f"The {word} is {size} mm{by}."
    below = " and ".join(
        f"{number(float(count), 2)} {row}"
        for row, count in result.rollers_below_grip.to_series().items()
    )
    return (
        f"With {size} mm of {word}{by}, {below} of {result.attrs['rollers_per_row']} rollers are in "
        f"the mean below {number(1e-3 * grip, 3)} kN, from where on a raceway grips."
    )


def _ribs(result: xr.Dataset) -> str:
    """Energy at the ribs beside that of the other contacts, and their film."""
    ribs = float(result.rib_energy.mean())
    others = float(result.energy.sum("interface").mean())
    least = float(result.min_rib_film_ratio.min())
    film = ""
    if np.isfinite(least):
        state = "full" if least > _FULL_FILM else "mixed"
        film = f"; their film is {state}, at least {number(least, 2)} times the roughness"
    return (
        f"Ribs take {number(ribs, 3)} J of a roller in the mean, raceways and cage "
        f"{number(others, 3)} J by sliding{film}."
    )


def preload_and_moments(result: xr.Dataset) -> list[str]:
    """Sentence on a bearing that preload or moments load far beyond its equivalent load.

    Parameters
    ----------
    result : xarray.Dataset
        From `macroslip.simulate`, with its rating.
    """
    if "rib_energy" not in result or "basic_life" not in result:
        return []
    basic = float(result.basic_life)
    reference = float(result.reference_life.sel(load_along_roller="hertz"))
    if not np.isfinite(basic) or reference > _SHORTER * basic:
        return []
    return [
        "static safety and L10h know neither the preload of a tapered roller bearing nor moments: the "
        f"reference life, by the loads of all rollers, is {reference / basic:.3g} of L10h."
    ]
