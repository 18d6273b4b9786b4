"""Measures of one roller in a result, summed over its steps buffer by buffer.

It is the same for both engines.
"""

from __future__ import annotations

import numpy as np

from macroslip.constants import SECTORS
from macroslip.contact.laws import PreparedLaws
from macroslip.measures.along import contacts_of
from macroslip.measures.details import ContactSampler, Details, Wanted
from macroslip.measures.samples import SAMPLE
from macroslip.measures.skew import Skewing, SkewMeasures
from macroslip.measures.totals import (
    CONTACTS,
    END,
    INTERFACES,
    Batch,
    Totals,
    book,
    contacts_at,
    law_times,
    loaded_contacts,
    new_totals,
)
from macroslip.ring.orbit import Motion, angle_at
from macroslip.roller.model import Roller, RollerModel


class Row:
    """Models, laws and contacts that the measures of a row's rollers share."""

    def __init__(
        self,
        model: RollerModel,
        roller: Roller,
        motion: Motion,
        wanted: Wanted,
        skewing: Skewing | None = None,
    ):
        self.model = model
        self.roller = roller
        self.motion = motion
        self.wanted = wanted
        self.skewing = skewing
        self.contacts = contacts_of(model.laws) if wanted.details else None


class RollerMeasures:
    """Measures of one roller, from buffers of its steps.

    The roller is at φ = `start_angle` at the first sample [rad].
    """

    def __init__(self, row: Row, start_angle: float):
        wanted = row.wanted
        self.row = row
        self.totals: Totals = new_totals(wanted.edges, wanted.highest_speed)
        self.law_times = np.zeros((3, 3))
        # These records are small, and with the room of others a third of the time for the ranges of
        # laws went into calls.
        self._contacts = Batch(CONTACTS, buffers=16)
        #: States at the ends of the steps of one buffer.
        self._ends = np.zeros(0, END)
        self.skew = SkewMeasures(row.skewing, row.roller, wanted.edges[0]) if row.skewing else None
        places = row.contacts, row.motion, start_angle, self.skew
        self.sampler = (
            ContactSampler(wanted, row.roller, row.model.laws, *places) if wanted.details else None
        )
        self._last: np.ndarray | np.void = np.zeros((), END)
        #: Largest power by sector of the orbit [W], where no orbit is complete.
        self.sector_power = None if wanted.edges.size > 1 else np.zeros((SECTORS, 3))
        self._start_angle = start_angle
        self._traced: list[np.ndarray] = []
        self._next_trace = 0

    @property
    def details(self) -> Details | None:
        """Details of the contacts, where they were wanted."""
        return self.sampler.details if self.sampler else None

    @property
    def checked(self) -> np.ndarray:
        """Samples of the contacts at which the quadrature is to be checked, of `SAMPLE`."""
        return self.sampler.checked if self.sampler else np.zeros(0, SAMPLE)

    def add(self, steps: np.ndarray, j: int) -> None:
        """Process the steps of one roller in a buffer of shape (n, rollers)."""
        mine = steps[:, j]
        if not mine.size:
            return
        if self.skew:
            self.skew.add(steps, j, self._places(mine))
        if mine.size > self._ends.size:
            self._ends = np.zeros(mine.size, END)
        states = self._ends[: mine.size]
        contacts = self._contacts.room(mine.size, self._add_law_times)
        book(steps, j, self.totals, states, contacts)
        self._contacts.count += mine.size
        if self.sampler:
            self.sampler.add(steps, j)
        if self.sector_power is not None:
            self._add_sectors(mine[mine["start"] >= self.row.wanted.edges[0]], self.sector_power)
        self._trace(mine, states)
        self._last = states[-1]

    @property
    def end_slip(self) -> float:
        """Slip at which the integration ended [m/s], the mean of both raceways."""
        return 0.5 * float(self._last["inner_slip"] + self._last["outer_slip"])

    def _add_law_times(self, contacts: np.ndarray) -> None:
        self.law_times += law_times(contacts, self.row.model.laws)

    def finish(self) -> None:
        """Process remaining records, and distribute the energies since the last sample."""
        self._last = self._last.copy()
        self._contacts.empty(self._add_law_times)
        if self.sampler:
            self.sampler.finish()

    def _add_sectors(self, steps: np.ndarray, largest: np.ndarray) -> None:
        """Update the largest powers in the orbit's sectors."""
        counted = np.arange(steps["time"].shape[1]) < steps["stages"][:, None]
        np.maximum.at(largest, self._places(steps)[counted], steps["power"][counted])

    def _places(self, steps: np.ndarray) -> np.ndarray:
        """Sectors of the orbit in which the stages of steps lie."""
        ratio = self.row.model.orbit_ratio
        angle = (
            self._start_angle
            + ratio * angle_at(self.row.motion, steps["time"])
            + steps["ahead"][:, None]
        )
        return np.floor(angle / (2.0 * np.pi) % 1.0 * SECTORS).astype(int) % SECTORS

    def _trace(self, steps: np.ndarray, states: np.ndarray) -> None:
        """Keep the states at the first step ends at or after the times of the traces."""
        times = self.row.wanted.trace_time
        if self._next_trace == times.size:
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
            self._traced.append(states[places])

    def traces(self) -> dict[str, np.ndarray]:
        """Traces by name, over time, and over interface or raceway.

        They are NaN from where an integration ended early.
        """
        states = np.full(self.row.wanted.trace_time.size, np.nan, END)
        model = self.row.model
        known = np.concatenate([np.zeros(0, END), *self._traced])
        states[: known.size] = known
        return {
            "spin": (states["outer_speed"] - states["outer_slip"]) / model.radius,
            "spin_pure": states["pure_speed"] / model.radius,
            "slip": 0.5 * (states["inner_slip"] + states["outer_slip"]),
            "raceway_slip": np.stack([states["inner_slip"], states["outer_slip"]], axis=-1),
            "roller_load": states["elastic_load"],
            "cage_force": states["cage_load"],
            "traction": states["force"],
            "power": states["power"],
            "rolling_power": states["rolling"],
            "film_thickness": _films(states, model.laws),
            "rib_friction": states["rib_force"],
            "rib_power": states["rib_power"],
            **(
                self.skew.traces(states)
                if self.skew
                else {"skew_moment": _skew_moments(states, model.laws)}
            ),
        }


def _films(at: np.ndarray, laws: PreparedLaws) -> np.ndarray:
    """Film thickness by interface [m]; NaN without load."""
    thickness = np.full((at.size, len(INTERFACES)), np.nan)
    contacts = np.zeros(at.size, CONTACTS)
    contacts_at(at, contacts)
    for i, (law, load, speed) in enumerate(loaded_contacts(contacts, laws)):
        loaded = load > 0.0  # not where it is NaN
        if loaded.any():
            thickness[loaded, i] = law.film_thickness(load[loaded], speed[loaded])
    return thickness


def _skew_moments(at: np.ndarray, laws: PreparedLaws) -> np.ndarray:
    """Skew moments of both raceways [N m]; NaN at standstill.

    They follow from their power, which is −u2 s times them. A traction that drives the spin up acts
    along +x at the inner raceway, along −x at the outer one.
    """
    moments = np.zeros((at.size, 2))
    for i, (name, sign) in enumerate((("inner", 1.0), ("outer", -1.0))):
        shape = getattr(laws, name).shape
        if shape.microslip and shape.spin_ratio != 0.0:
            with np.errstate(invalid="ignore", divide="ignore"):
                moments[:, i] = (
                    -sign * at["skew_power"][:, i] / (at[f"{name}_speed"] * shape.spin_ratio)
                )
        else:
            moments[np.isnan(at["inner_load"]), i] = np.nan
    return moments
