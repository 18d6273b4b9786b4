"""The answer of a result in whole sentences: load, slip, films, and the worst criterion."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from macroslip.damage.micropitting import share_below
from macroslip.kinds import KINDS
from macroslip.measures.along import FILM_EDGES
from macroslip.printed import number
from macroslip.report.result_numbers import known
from macroslip.result.orbit import in_window
from macroslip.result.run_input import stored_settings

#: A row is said to skid if its rollers without load hardly ever come above this part of rolling
#: speed.
_SKIDS = 0.9
#: Rollers whose speed differs by less than this part from rolling are said to turn at rolling
#: speed.
_ROLLS = 0.01
#: A row that is loaded for less than this part of the time is described by its rollers without
#: load.
_HARDLY_LOADED = 0.01
#: Films above this film ratio Λ are full.
_FULL_FILM = 3.0
#: Part of the highest speed of the shaft below which the ratio to rolling speed tells nothing.
_SLOW = 0.1
#: Traces that reach this part of the window's end stand for all of it.
_TRACED = 0.98


@dataclass(frozen=True, slots=True)
class RowSlip:
    """Speeds of the rollers of a row over pure rolling; None where a result has none."""

    row: str
    loaded: float | None  #: Share of time in which a roller carries load [1]
    lowest: float | None  #: Lowest spin over pure rolling [1], without load as far as traces tell
    under_load: float | None  #: Mean spin over pure rolling under load [1], from traces
    #: 5 and 95 % quantile of spin over pure rolling without load [1], from traces.
    without_load: tuple[float, float] | None
    traced: float | None = None  #: Length of the traces [s] where they end before the window


def answer(result: xr.Dataset, criteria: Sequence[Mapping[str, Any]] = ()) -> list[str]:
    """Three to five sentences on a result, each made from its numbers.

    Parameters
    ----------
    result : xarray.Dataset
        From `macroslip.simulate`.
    criteria : sequence of mappings, optional
        Criteria of damage as `macroslip.result.damage.lines` gives them.

    Returns
    -------
    list of str
        Failed rollers first if there are any; then each row, the films, and the criteria.
    """
    sentences = []
    failed = int((result.status != 0).sum())
    if failed:
        sentences.append(
            f"{failed} of {result.status.size} rollers FAILED; every mean they enter is missing."
        )
    sentences += [row_sentence(row_slip(result, row)) for row in result.row.values.tolist()]
    bearing = stored_settings(result).get("bearing", {})
    of_kind = [words for kind in KINDS.values() for words in kind.sentences(result, bearing)]
    films = " ".join([*of_kind, *_films(result)])
    return [*sentences, *filter(None, [films]), *_nearest(criteria)]


def row_slip(result: xr.Dataset, row: str) -> RowSlip:
    """Load and slip of a row, from the rating and the traces as far as the result has them."""
    of_row = result.sel(row=row)
    loaded = known(of_row.get("loaded_share"))
    lowest = None
    if "min_spin_ratio" in of_row:
        lowest = known(of_row.min_spin_ratio.min())
    if "spin" not in of_row or not in_window(of_row).sizes["time"]:
        return RowSlip(row, loaded, lowest, None, None)
    traces = in_window(of_row)
    load = traces.roller_load
    if loaded is None:
        loaded = known((load > 0.0).mean())
    rolling = abs(traces.spin_pure)
    # Where the shaft hardly turns, a roller at rest is no sign of slip.
    slowest = _SLOW * rolling.max()
    turns = (rolling > 0.0) & (rolling >= slowest)
    ratio = traces.spin / traces.spin_pure.where(turns)
    pressed = ratio.where(load > 0.0)
    idle = ratio.where(load <= 0.0)
    without_load = None
    if bool(idle.notnull().any()):
        low, high = idle.quantile((0.05, 0.95)).values
        without_load = (float(low), float(high))
        if pressed.min() < idle.min():
            lowest = float(idle.min())
    start = traces.time[0]
    end = traces.time[-1]
    traced = None
    if end < _TRACED * result.attrs["window_end"]:
        traced = float(end - start)
    return RowSlip(row, loaded, lowest, known(pressed.mean()), without_load, traced)


def row_sentence(slip: RowSlip) -> str:
    """A row's load and slip in a sentence.

    Examples
    --------
    >>> row_sentence(RowSlip("downwind", 0.96, 0.2, 0.99, None))
    'Downwind row: loaded 96 % of the time; its rollers turn 1 % below rolling speed in the mean.'
    >>> row_sentence(RowSlip("upwind", 0.0007, 0.1, 0.78, (0.12, 0.28)))
    'Upwind row: loaded 0.07 % of the time; its rollers turn at 12 to 28 % of rolling speed: it skids.'
    """
    name = "The rollers"
    if slip.row != "single":
        name = f"{slip.row.capitalize()} row"
    parts = [part for part in (_load(slip.loaded), _turning(slip)) if part]
    traced = ""
    if slip.traced is not None:
        traced = f" (speeds in the {slip.traced:.0f} s that are traced)"
    return f"{name}: {'; '.join(parts)}{traced}."


def _load(share: float | None) -> str:
    if share is None:
        return ""
    if share == 0.0:
        return "never loaded"
    if share > 0.9995:
        return "loaded all the time"
    percent = number(100.0 * share, 2)
    if share > 0.99:
        percent = f"{100.0 * share:.1f}"
    return f"loaded {percent} % of the time"


def _turning(slip: RowSlip) -> str:
    """Sentence on the rollers' speed, under load and without."""
    hardly_loaded = slip.under_load is None or (slip.loaded or 0.0) < _HARDLY_LOADED
    if hardly_loaded and slip.without_load is not None:
        low, high = (number(100.0 * ratio, 2) for ratio in slip.without_load)
        skids = ": it skids" if slip.without_load[1] < _SKIDS else ""
        speeds = low
        if high != low:
            speeds = f"{low} to {high}"
        return f"its rollers turn at {speeds} % of rolling speed{skids}"
    if slip.under_load is None:
        return _slowest(slip.lowest)
    below = 100.0 * (1.0 - slip.under_load)
    digits = 1 if abs(below) < 1.0 else 2
    direction = "below" if below >= 0.0 else "above"
    off = f"{number(abs(below), digits)} % {direction}"
    speed = f"{off} rolling speed in the mean"
    if abs(below) < 100.0 * _ROLLS:
        speed = f"at rolling speed ({off} it in the mean)"
    if slip.without_load is None:
        return f"its rollers turn {speed}"
    lowest = slip.lowest
    if lowest is None:
        lowest = slip.without_load[0]
    return f"loaded rollers turn {speed}, between load zones they {_slowing(lowest)}"


def _slowest(lowest: float | None) -> str:
    """Sentence on the slowest roller, where there are no traces."""
    if lowest is None:
        return (
            "the shaft stands still or hardly turns, "
            "so that there is no rolling speed to compare with"
        )
    percent = number(100.0 * abs(lowest), 2)
    if lowest < 0.0:
        return f"its slowest roller turns backwards, at up to {percent} % of rolling speed"
    return f"its slowest roller falls to {percent} % of rolling speed"


def _slowing(lowest: float) -> str:
    """Sentence on rollers without load."""
    percent = number(100.0 * abs(lowest), 2)
    if lowest < 0.0:
        return f"even turn backwards, at up to {percent} % of it"
    how = "keep" if lowest > 1.0 - _ROLLS else "slow down to"
    return f"{how} {percent} % of it"


def _films(result: xr.Dataset) -> list[str]:
    """Sentence on full films of loaded contacts; none where that is not known."""
    if "film_slip_time" not in result:
        return []
    time = result.film_slip_time.transpose("row", "raceway", "film_class", "slip_class")
    mixed = xr.DataArray(
        share_below(time.values, FILM_EDGES, _FULL_FILM),
        time.isel(film_class=0, slip_class=0).coords,
    )
    if not bool(mixed.notnull().any()):
        return []
    worst = mixed.where(mixed == mixed.max(), drop=True).isel(row=0, raceway=0)
    least = None
    if result.sizes["orbit"]:
        ratios = result.min_film_ratio.sel(interface=result.raceway.values)
        least = known(ratios.min())
    if worst == 0.0:
        orbits = ""
        if least is not None:
            orbits = f", {number(least, 2)} at least in complete orbits"
        return [f"Loaded contacts run on a full film (Λ above {_FULL_FILM:g}{orbits})."]
    thinnest = ""
    if least is not None:
        thinnest = f", and at least {number(least, 2)} in complete orbits"
    where = f"the {worst.raceway.item()} raceway"
    if result.sizes["row"] > 1:
        where = f"{where} of the {worst.row.item()} row"
    return [
        f"At {where} films are mixed (Λ below {_FULL_FILM:g}) for {number(100.0 * worst, 2)} % "
        f"of the loaded time{thinnest}."
    ]


def _nearest(criteria: Sequence[Mapping[str, Any]]) -> list[str]:
    """Sentence on the criterion with the largest ratio to its reference, and on others beyond theirs."""
    shown = []
    for line in criteria:
        if line["in answer"] and np.isfinite(line["ratio"]):
            shown.append(line)
    judged = sorted(shown, key=lambda line: -line["ratio"])
    if not judged:
        return []
    first = judged[0]
    beyond = [line for line in judged[1:] if line["ratio"] > 1.0]
    sentence = (
        f"{'Furthest beyond' if first['ratio'] > 1.0 else 'Nearest to'} its reference is "
        f"{_name(first)}: {_times(first)} ({first['compared with']}), "
        f"known to a factor of {first['factor']:g}"
    )
    if first["ratio"] > first["factor"]:
        sentence += ", so beyond it in any case"
    elif first["ratio"] > 1.0 / first["factor"]:
        sentence += ", so not distinguishable from it"
    if beyond:
        sentence += "; also beyond: "
    others = [f"{_name(line)} ({_times(line)})" for line in beyond]
    return [f"{sentence}{'; '.join(others)}."]


def _name(line: Mapping[str, Any]) -> str:
    """Name of a criterion inside a sentence: its mechanism, then its quantity."""
    return f"{line['mechanism']}, {line['quantity']}"


def _times(line: Mapping[str, Any]) -> str:
    """A criterion's ratio to its reference in words; of a time, which is bad if short, inverse.

    Examples
    --------
    >>> _times({"ratio": 21.7, "value": 1.085, "reference": 0.05})
    '22 times the reference'
    >>> _times({"ratio": 0.03125, "value": 640.0, "reference": 20.0})
    'the reference is 0.031 of it'
    """
    ratio = line["ratio"]
    word = "times" if ratio > 1.0 else "of"
    times = f"{number(ratio, 2)} {word}"
    if line["ratio"] < 1e-3:
        times = "less than a thousandth of"
    value_over_reference = line["value"] / line["reference"]
    is_direct = math.isclose(ratio, value_over_reference)
    return f"{times} the reference" if is_direct else f"the reference is {times} it"
