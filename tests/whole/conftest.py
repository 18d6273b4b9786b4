"""Bearings, ring motions and simulations of the whole bearing."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pytest

from macroslip.contact.mechanisms import Laws
from macroslip.contact.table import larger, table_box
from macroslip.imposed.status import OUTSIDE_TABLES
from macroslip.ring.orbit import Motion, shaft_angle
from macroslip.roller.step import STEP
from macroslip.whole.books import FLOWS, Books
from macroslip.whole.model import Assembly, WholeBearing, whole_bearing, with_tables
from macroslip.whole.sdirk import BEARING_STEP, Part, pure_rolling, steps_of


class Simulated(NamedTuple):
    """Steps of an integration, one after another, and its books."""

    status: int
    bearing: WholeBearing
    assembly: Assembly
    steps: np.ndarray
    whole: np.ndarray
    offset: np.ndarray
    memory: np.void
    books: Books

    def energy(self, name: str = "power") -> np.ndarray:
        """Energy [J] by roller and interface (or raceway)."""
        return (self.steps["weight"][..., None] * self.steps[name]).sum(axis=(0, 2))

    def at_outputs(self) -> np.ndarray:
        """Rows that end at the books' times."""
        return np.isin(self.whole["end"], self.books.times)

    def at_end(self, name: str) -> np.ndarray:
        """A quantity of all rollers at the books' times."""
        rows = self.steps[self.at_outputs()]
        return np.where(rows["stages"] == 1, rows[name][..., 0], rows[name][..., 1])

    def flow(self, name: str) -> np.ndarray:
        """What has flowed at the books' times."""
        return self.books.flows[:, FLOWS.index(name)]

    def cage_speed(self, cage: int = 0) -> np.ndarray:
        """Speed of a cage [rad/s] at the books' times."""
        rows = self.whole[self.at_outputs()]
        shaft = np.where(
            rows["end"] == rows["start"], rows["shaft_speed"][:, 0], rows["shaft_speed"][:, 1]
        )
        return (
            rows["cages"][:, cage, 0] + 0.5 * shaft * self.bearing.inner_radius
        ) / self.bearing.pitch_radius


def box_for(prepared, motion, tolerance):
    """A box of tables for a motion of the ring."""
    model = next(iter(prepared.models.values()))
    radial = (
        np.hypot(motion.displacement[:, 0], motion.displacement[:, 1]).max()
        * model.cos_contact_angle
    )
    approach = radial + np.abs(motion.displacement[:, 2] * model.sin_contact_angle).max()
    speeds = motion.shaft_speed * prepared.orbit_ratio * prepared.outer_radius
    return table_box(speeds, max(model.stiffness * approach**1.5, 2e3), tolerance)


@pytest.fixture(scope="session")
def run(bearing, lubricant):
    """Simulate with a fixed or given ring motion."""

    def simulate(
        cage,
        displacement,
        speed,
        span,
        *,
        rollers=28,
        tolerance=2e-4,
        table_tolerance=None,
        start=None,
        change=None,
        outputs=11,
        extrapolates=True,
        laws=None,
        **choices,
    ):
        prepared = whole_bearing(
            bearing.replace(rollers_per_row=rollers),
            lubricant,
            cage,
            tilt=math.radians(5.0),
            laws=laws or Laws.paper(),
            **choices,
        )
        if change:
            prepared = change(prepared)
        time = np.linspace(0.0, span, 201)
        shaft = np.full(time.size, speed) if np.isscalar(speed) else np.interp(time, *speed)
        motion = Motion(
            time,
            shaft,
            shaft_angle(time, shaft),
            np.tile(np.asarray(displacement, float), (time.size, 1)),
        )
        begin = pure_rolling(prepared, cage)
        if start:
            begin = start(begin)
        times = np.linspace(0.0, span, outputs)
        box = box_for(prepared, motion, table_tolerance or tolerance)
        for _ in range(4):
            assembly, _ = with_tables(prepared, box)
            run = gather(
                prepared,
                assembly,
                motion,
                begin,
                times,
                tolerance=tolerance,
                extrapolates=extrapolates,
            )
            if run.status != OUTSIDE_TABLES:
                break
            box = larger(box)
        return run

    return simulate


def gather(prepared, assembly, motion, begin, times, **choices) -> Simulated:
    """Integrate, and put all parts together."""
    books, count = Books(prepared, times), prepared.positions.size
    steps, whole, offset = (
        [np.zeros((0, count), STEP)],
        [np.zeros(0, BEARING_STEP)],
        [np.zeros((0, count))],
    )
    part: Part | None = None
    for part in steps_of(assembly, motion, begin, times[times > motion.time[0]], **choices):
        books.add(part)
        steps.append(part.steps.copy())
        whole.append(part.bearing.copy())
        offset.append(part.offset.copy())
    assert part is not None
    return Simulated(
        part.status, prepared, assembly, np.concatenate(steps), np.concatenate(whole), np.concatenate(offset),
        part.memory, books,
    )  # fmt: skip


def losses_of_closed_books(result) -> dict[str, float]:
    """What raceways and friction at the cages lose in the window [J] by the books of a result, which have to be closed."""
    impulses = [
        result[name]
        for name in result
        if str(name).startswith("book_") and str(name).endswith("impulse")
    ]
    assert abs(result.momentum_residual).max() < 1e-6 * max(
        float(abs(impulse).max()) for impulse in impulses
    )
    edges = [result.attrs["window_start"], result.attrs["window_end"]]
    lost = {
        name: float(np.diff(result[f"book_{name}"].sel(book_time=edges).values)[0])
        for name in ("raceway_loss", "friction_loss")
    }
    assert abs(result.energy_residual).max() < 2e-4 * sum(lost.values())
    return lost
