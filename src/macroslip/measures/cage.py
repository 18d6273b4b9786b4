"""Pocket forces and cage motion in the window, from the steps of the whole bearing."""

from __future__ import annotations

import numpy as np

from macroslip.constants import SECTORS
from macroslip.measures.roller import Wanted
from macroslip.mechanics.speeds import cage_speed
from macroslip.whole.books import Books
from macroslip.whole.model import WholeBearing
from macroslip.whole.sdirk import Part

#: Sides of a pocket: the spars ahead and behind.
SIDES = ("front", "rear")


class CageMeasures:
    """Pocket forces and cage motion in the window, and their traces."""

    def __init__(self, bearing: WholeBearing, wanted: Wanted, times: np.ndarray):
        count = bearing.positions.size
        cages = bearing.cages
        self._bearing = bearing
        self._window = wanted.edges[0]
        self._times = times
        #: By side of the pocket, shape (n, 2): ∫|N| dt [N s], largest |N| [N] and time with a push
        #: [s] in the window.
        self.impulse, self.largest, self.time = (np.zeros((count, 2)) for _ in range(3))
        #: Largest |N| in the window by sector of the orbit [N], shape (n, sectors).
        self.largest_by_sector = np.zeros((count, SECTORS))
        #: ∫ dt, ∫ s dt and ∫ s² dt of the cage's relative slip s = Ω_c/Ω_pure − 1 in the window,
        #: shape (c, 3).
        self.slip = np.zeros((cages, 3))
        #: Of momentum and energy, at the times of traces, or of the window's start and the ends of
        #: its orbits.
        self.books = Books(bearing, times)
        #: Speed of the cage [rad/s], its lag [m], its displacement along X0 and Y0 [m], and the
        #: rollers' torque on it [N m], shape (m, c, 5).
        self.traces = np.full((times.size, cages, 5), np.nan)
        #: Traces of the rollers, shape (m, n): way ahead of the middle of the pocket [m], and orbit
        #: speed less that of pure rolling [rad/s].
        self.offset, self.deviation = (np.full((times.size, count), np.nan) for _ in range(2))

    def add(self, part: Part) -> None:
        """Process a part of the integration."""
        self.books.add(part)
        in_window = part.bearing["start"] >= self._window
        has_length = part.bearing["end"] > part.bearing["start"]
        counted = in_window & has_length
        if counted.any():
            self._add_pushes(part, counted)
            self._add_slip(part, counted)
        self._trace(part)

    def _add_pushes(self, part: Part, counted: np.ndarray) -> None:
        """Add to impulses, times and largest pushes."""
        positions = self._bearing.positions
        rollers = np.arange(positions.size)
        at_start = positions["angle"] / (2.0 * np.pi) % 1.0
        for k in range(2):
            # Columns alone are copied: records of steps have much that is not asked for here.
            push = part.steps["cage_load"][counted, :, k]
            # All rollers have the same steps.
            weight = part.steps["weight"][counted, 0, k]
            for side, size in enumerate((np.maximum(-push, 0.0), np.maximum(push, 0.0))):
                self.impulse[:, side] += weight @ size
                self.time[:, side] += weight @ (size > 0.0)
                self.largest[:, side] = np.maximum(self.largest[:, side], size.max(axis=0))
            turns = part.bearing["turn"][counted, k] / (2.0 * np.pi) % 1.0
            sector = ((turns[:, positions["cage"]] + at_start) * SECTORS).astype(int) % SECTORS
            # With one index for both axes NumPy takes half of the time.
            largest = self.largest_by_sector.reshape(-1)
            np.maximum.at(largest, (rollers * SECTORS + sector).ravel(), np.abs(push).ravel())

    def _add_slip(self, part: Part, counted: np.ndarray) -> None:
        whole = part.bearing[counted]
        speed = whole["shaft_speed"][:, 1]
        span = whole["end"] - whole["start"]
        turns = speed != 0.0
        nominal = self._bearing.orbit_ratio * speed[turns] * self._bearing.pitch_radius
        for c in range(self._bearing.cages):
            slip = whole["cages"][turns, c, 0] / nominal
            moving = span[turns]
            self.slip[c, 0] += np.ones_like(slip) @ moving
            self.slip[c, 1] += slip @ moving
            self.slip[c, 2] += (slip * slip) @ moving

    def _trace(self, part: Part) -> None:
        _, rows, samples = np.intersect1d(part.bearing["end"], self._times, return_indices=True)
        if not rows.size:
            return
        bearing = self._bearing
        whole = part.bearing[rows]
        steps = part.steps[rows]
        last = np.maximum(steps["stages"][:, 0] - 1, 0)
        every = np.arange(rows.size)
        speed = whole["shaft_speed"][every, last]
        cages = whole["cages"][:, : bearing.cages]
        turning = cage_speed(cages[..., 0], speed[:, None], bearing.inner_radius)
        self.traces[samples, :, 0] = turning / bearing.pitch_radius
        self.traces[samples, :, 1] = cages[..., 1]
        self.traces[samples, :, 2] = cages[..., 4]
        self.traces[samples, :, 3] = cages[..., 5]
        self.traces[samples, :, 4] = whole["torque"][:, : bearing.cages]
        self.offset[samples] = part.offset[rows]
        inner = steps["inner_slip"][every, :, last]
        outer = steps["outer_slip"][every, :, last]
        inner_radius = bearing.positions["inner_radius"]
        ring = speed[:, None] * (inner_radius - 0.5 * bearing.inner_radius)
        ring -= 0.5 * speed[:, None] * inner_radius
        self.deviation[samples] = (0.5 * (inner - outer) + ring) / bearing.pitch_radius
