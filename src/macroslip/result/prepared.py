"""A case made ready once: loads at the bearing, motion of the ring, rollers, and times."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from macroslip.bearing.geometry import AXIAL_SIGNS, row_names
from macroslip.case.case import WHOLE_BEARING, Case
from macroslip.case.oil_supply import supply_note
from macroslip.case.parts import Radau
from macroslip.constants import GRAVITY
from macroslip.contact.registry import check_own_laws, film_range_notes
from macroslip.contact.table import Box, table_box
from macroslip.errors import InputError
from macroslip.kinds import kind_of
from macroslip.kinds.kind import RingBalance
from macroslip.loads import RollerLoads
from macroslip.mechanics.loads import drag_power
from macroslip.result.plausibility import doubtful_loads
from macroslip.result.skew import thrust_on_ring
from macroslip.ring.orbit import Motion, merged_times, orbit_times
from macroslip.roller.model import RollerModel, TableReport, body_force, ring_geometry, roller_model

#: Samples of the traces of a roller beyond which only a mistaken step is left as an explanation.
_MOST_SAMPLES = 10_000_000
#: Times that the ring is balanced again with the forces of skewed rollers. Of the largest load,
#: 5e-5 is left then where spars
#: press, 1e-3 where nothing but the stop holds rollers (14B and 24A, 20 s).
_BALANCED = 3
#: Tolerance for which tables are made where the integrator has a fixed step.
_FIXED_STEP_TOLERANCE = 2e-5


@dataclass(frozen=True)
class Prepared:
    """A case made ready."""

    case: Case  #: At a known temperature
    models: dict[str, RollerModel]  #: By row
    balance: RingBalance  #: Of the inner ring over the loads
    heaviest: float  #: The same with weight and centrifugal force [N]
    highest_speed: float  #: Largest raceway speed |u2| of the history [m/s]
    edges: np.ndarray  #: Start of the window and ends of its complete orbits [s]
    end: float  #: End of the simulation [s]
    trace_time: np.ndarray  #: Times of traces [s]; none without traces
    box: Box  #: States that the tables of the contacts hold

    @property
    def motion(self) -> Motion:
        """Motion of the inner ring."""
        return self.balance.motion

    @property
    def model(self) -> RollerModel:
        """A roller of the first row."""
        return next(iter(self.models.values()))

    def drag_power(self) -> float:
        """Mean power of the lubricant's drag on all rollers in the window [W]."""
        motion = self.motion
        model = self.model
        start = self.edges[0]
        is_inside = (motion.time > start) & (motion.time < self.end)
        inside = motion.time[is_inside]
        time = np.concatenate([[start], inside, [self.end]])
        shaft_speed = np.interp(time, motion.time, motion.shaft_speed)
        bearing = self.case.bearing
        orbital_speed = model.orbit_ratio * shaft_speed
        power = drag_power(model.drag, bearing.pitch_radius, orbital_speed)
        rollers = bearing.rows * bearing.rollers_per_row
        energy = float(np.trapezoid(power, time))
        return rollers * energy / (self.end - start)

    def notes(self, tables: TableReport) -> dict[str, Any]:
        """Attributes on films out of range, contacts cut off at the roller's ends, and tables."""
        case = self.case
        laws = self.model.laws
        contacts = tuple(law.interface for law in (laws.inner, laws.outer, laws.cage))
        return {
            "film_range_notes": "\n".join(film_range_notes(case.laws.film, contacts)),
            "mean_elastic_load": self.balance.mean_load,
            "truncated_share": self.balance.truncated_share,
            "oil_supply_note": supply_note(case),
            "doubtful_loads": "\n".join(doubtful_loads(case.loads, case.bearing)),
            "contact_evaluation": "tables",
            "table_error_typical": tables.typical_error,
            "table_error_worst": tables.worst_error,
            "table_size": tables.size,
        }


def prepare(case: Case) -> Prepared:
    """Make a case ready.

    Raises InputError if a roller's load truncates its contact ellipse, or a law does not exist or
    breaks what laws have to fulfil.
    """
    loads = case.ring_loads
    options = {
        "tilt": case.drivetrain.tilt,
        "gravity": case.gravity,
        "drag": case.drag,
        "laws": case.laws,
    }
    models = {
        row: roller_model(case.bearing, case.oil, AXIAL_SIGNS[row], **options)
        for row in row_names(case.bearing)
    }
    model = next(iter(models.values()))
    kind = kind_of(case.bearing)
    balance = kind.balance(case, model)
    motion = balance.motion
    ring_speeds = motion.shaft_speed * model.orbit_ratio * model.outer_radius
    fastest = float(np.abs(ring_speeds).max())
    check_own_laws(case.laws, case.bearing, case.oil, fastest)
    body = body_force(model, float(np.abs(motion.shaft_speed).max()))
    # Free rollers drop through their pockets, even where the rings creep.
    falling = (
        math.sqrt(2.0 * GRAVITY * case.cage.gap)
        if case.dynamics == WHOLE_BEARING and case.gravity
        else 0.0
    )
    tolerance = (
        case.integrator.tolerance if isinstance(case.integrator, Radau) else _FIXED_STEP_TOLERANCE
    )
    for _ in range(0 if case.laws.skew == "none" or isinstance(loads, RollerLoads) else _BALANCED):
        box = table_box(ring_speeds, balance.largest + body, float(tolerance), falling)
        ring = ring_geometry(case.bearing, model)
        thrust = thrust_on_ring(case, model, ring, balance.motion, box)
        balance = kind.balance(case, model, thrust)
    heaviest = balance.largest + body
    end = float(motion.time[-1])
    if case.window.end is not None:
        asked = np.array([min(case.window.end, end)])
        end = float(merged_times(asked, motion.time)[0])
    edges = _orbit_edges(case, motion, model.orbit_ratio, end)
    return Prepared(
        case=case,
        models=models,
        balance=balance,
        heaviest=heaviest,
        highest_speed=fastest,
        edges=edges,
        end=end,
        trace_time=_trace_times(case, motion, edges, end),
        box=table_box(ring_speeds, heaviest, float(tolerance), falling),
    )


def _orbit_edges(case: Case, motion: Motion, orbit_ratio: float, end: float) -> np.ndarray:
    """Start of the window and ends of the orbits completed in it [s]."""
    time = motion.time
    speed = motion.shaft_speed
    # A time that is known exactly stays as it is, and the end of an orbit there takes it over.
    known = np.union1d(time, [end])
    if case.window.start is not None:
        # Orbits are counted from the start of the window, not of the history.
        (start,) = merged_times(np.array([case.window.start]), known).tolist()
        late = time > start
        first_speed = np.interp(start, time, speed)
        speed = np.concatenate([[first_speed], speed[late]])
        time = np.concatenate([[start], time[late]])
    completed = merged_times(orbit_times(time, speed, orbit_ratio), known)
    completed = completed[completed <= end]
    # The first orbit belongs to the rollers' start; of an event, what happens in it belongs to the
    # event.
    opens_late = case.window.start is None and not case.loads.event
    start = time[0]
    if opens_late and completed.size and completed[0] < end:
        start = completed[0]
    later = completed[completed > start]
    return np.concatenate([[start], later])


def _trace_times(case: Case, motion: Motion, edges: np.ndarray, window_end: float) -> np.ndarray:
    """Times at which traces are kept [s], never past the end of the simulation."""
    if case.traces is None:
        return np.empty(0)
    traces = case.traces
    start = motion.time[0] if traces.start is None else traces.start
    end = window_end
    if traces.end is not None:
        end = min(traces.end, window_end)
    samples = (end - start) / traces.step * (1.0 + 1e-12)
    if samples > _MOST_SAMPLES:
        fault = f"a step of {traces.step:g} s makes {samples:.3g} samples"
        allowed = f"up to {_MOST_SAMPLES:,} samples for each roller"
        remedy = "Take a longer step, or traces of a shorter time."
        raise InputError(fault, where="traces", allowed=allowed, remedy=remedy)
    count = int(np.floor(samples)) + 1
    times = start + traces.step * np.arange(max(count, 0))
    known_times = np.concatenate([motion.time, edges, [window_end]])
    known = np.unique(known_times)
    return np.minimum(merged_times(times, known), end)
