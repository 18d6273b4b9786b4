"""All that a result holds of one roller, gathered from its steps buffer by buffer; the same for both engines."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.measures.details import Details, Looker, prepare
from macroslip.measures.totals import INTERFACES, Totals, book, film_times, new_totals
from macroslip.roller.forces import LOWEST_SPEED

if TYPE_CHECKING:
    from macroslip.contact.laws import RollerLaws
    from macroslip.ring.orbit import Motion
    from macroslip.roller.model import Roller, RollerModel

#: Fields of `STEP` that traces keep, and those that are kept by interface or raceway.
_KEPT = (
    "inner_slip", "outer_slip", "inner_speed", "outer_speed", "cage_speed", "inner_load", "outer_load", "elastic_load", "cage_load",
    "force", "power", "rolling", "skew_power",
)  # fmt: skip


@dataclass(frozen=True)
class Wanted:
    """Measures that are wanted.

    Attributes
    ----------
    edges : ndarray, shape (orbits + 1,)
        Start of the window and ends of its complete orbits [s].
    highest_speed : float
        Largest raceway speed of the history [m/s].
    trace_time : ndarray
        Times of the traces [s]; a step ends at each, or with a fixed step soon after.
    details : bool
        Whether contacts are looked at station by station.
    spacing : float
        Changes between looks, over those of a roller on an imposed orbit.
    """

    edges: np.ndarray
    highest_speed: float
    trace_time: np.ndarray
    details: bool
    spacing: float = 1.0


class Row:
    """Models, laws and contacts, as compiled code takes them, that the measures of a row's rollers share."""

    def __init__(self, model: RollerModel, roller: Roller, motion: Motion, wanted: Wanted):
        self.model, self.roller, self.motion, self.wanted = model, roller, motion, wanted
        self.contacts = prepare(model.laws) if wanted.details else None


class RollerMeasures:
    """Measures of one roller.

    Parameters
    ----------
    row : Row
    start_angle : float
        Position φ at the first sample [rad].
    """

    def __init__(self, row: Row, start_angle: float):
        wanted = row.wanted
        self.row = row
        self.totals: Totals = new_totals(wanted.edges, wanted.highest_speed)
        self.film_times = np.zeros((2, 3))
        self.looker = (
            Looker(wanted.edges, row.roller, row.model.laws, row.contacts, row.motion, start_angle, wanted.spacing)
            if wanted.details
            else None
        )
        self.end_slip = 0.0
        self._traced: list[np.ndarray] = []
        self._next_trace = 0

    @property
    def details(self) -> Details | None:
        """Details of the contacts, where they were wanted."""
        return self.looker.details if self.looker else None

    def add(self, steps: np.ndarray, j: int) -> None:
        """Take up the steps of roller `j` in a buffer of shape (n, rollers)."""
        book(steps, j, self.totals)
        mine = steps[:, j]
        self.film_times += film_times(mine, self.row.model.laws, self.row.wanted.edges[0])
        if self.looker:
            self.looker.add(steps, j)
        self._trace(mine)
        last = mine[-1]
        self.end_slip = 0.5 * float(last["inner_slip"][last["stages"] - 1] + last["outer_slip"][last["stages"] - 1])

    def finish(self) -> None:
        """Spread what has been kept since the last look."""
        if self.looker:
            self.looker.finish()

    def _trace(self, steps: np.ndarray) -> None:
        """Keep the states at the times of the traces: the first ones that are not before them."""
        times = self.row.wanted.trace_time
        if self._next_trace == times.size or not steps.size:
            return
        last = steps["stages"] - 1
        reached = np.where(
            (steps["weight"][:, 0] == 0.0) & (steps["start"] < steps["end"]), -np.inf,
            steps["time"][np.arange(steps.size), last],
        )  # fmt: skip
        # A step may end on a sample of the loads that is a rounding before the time.
        wanted = times[self._next_trace :] - 1e-14 * np.abs(times[self._next_trace :])
        places = np.searchsorted(np.maximum.accumulate(reached), wanted, side="left")
        places = places[places < steps.size]
        self._next_trace += places.size
        if places.size:
            chosen, at = steps[places], last[places]
            self._traced.append(
                np.concatenate(
                    [chosen[name][np.arange(places.size), at].reshape(places.size, -1) for name in _KEPT]
                    + [chosen["pure_speed"][:, None]],
                    axis=1,
                )
            )

    def traces(self) -> dict[str, np.ndarray]:
        """Traces by name, over time, and over interface or raceway; NaN from where an integration ended early."""
        width = len(_KEPT) - 4 + 3 * 3 + 2 + 1
        found = np.full((self.row.wanted.trace_time.size, width), np.nan)
        if self._traced:
            known = np.concatenate(self._traced)
            found[: len(known)] = known
        raw, place = {}, 0
        for name in _KEPT:
            size = 3 if name in ("force", "power", "rolling") else 2 if name == "skew_power" else 1
            raw[name] = found[:, place : place + size] if size > 1 else found[:, place]
            place += size
        return self._named(raw, found[:, -1])

    def _named(self, raw: dict[str, Any], pure: np.ndarray) -> dict[str, np.ndarray]:
        radius, laws = self.row.model.radius, self.row.model.laws
        return {
            "spin": (raw["outer_speed"] - raw["outer_slip"]) / radius,
            "spin_pure": pure / radius,
            "slip": 0.5 * (raw["inner_slip"] + raw["outer_slip"]),
            "raceway_slip": np.stack([raw["inner_slip"], raw["outer_slip"]], axis=-1),
            "roller_load": raw["elastic_load"],
            "cage_force": raw["cage_load"],
            "traction": raw["force"],
            "power": raw["power"],
            "rolling_power": raw["rolling"],
            "film_thickness": _films(raw, laws),
            "skew_moment": _skew_moments(raw, laws),
        }


def _films(raw: dict[str, Any], laws: RollerLaws) -> np.ndarray:
    """Film thickness by interface [m]; NaN without load."""
    found = np.full((raw["inner_load"].size, 3), np.nan)
    for i, name in enumerate(INTERFACES):
        load = np.abs(raw[f"{name}_load"])
        speed = 0.5 * raw["cage_speed"] if name == "cage" else raw[f"{name}_speed"] - 0.5 * raw[f"{name}_slip"]
        loaded = load > 0.0  # not where it is NaN
        if loaded.any():
            law = getattr(laws, name)
            found[loaded, i] = law.film_thickness(load[loaded], np.maximum(np.abs(speed[loaded]), LOWEST_SPEED))
    return found


def _skew_moments(raw: dict[str, Any], laws: RollerLaws) -> np.ndarray:
    """Skew moments of both raceways [N m], from their power, which is −u2 s times them; NaN at standstill.

    A traction that drives the spin up acts along +x at the inner raceway, along −x at the outer one.
    """
    found = np.zeros((raw["inner_load"].size, 2))
    for i, (name, sign) in enumerate((("inner", 1.0), ("outer", -1.0))):
        shape = getattr(laws, name).shape
        if shape.microslip and shape.spin_ratio != 0.0:
            with np.errstate(invalid="ignore", divide="ignore"):
                found[:, i] = -sign * raw["skew_power"][:, i] / (raw[f"{name}_speed"] * shape.spin_ratio)
        else:
            found[np.isnan(raw["inner_load"]), i] = np.nan
    return found
