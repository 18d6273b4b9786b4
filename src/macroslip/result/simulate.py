"""From a case to its results: ring balance once, then every roller on its own, in threads that release the GIL."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.bearing.geometry import AXIAL_SIGNS, ROWS, initial_angles
from macroslip.case.case import BALANCE, WHOLE_BEARING, Case
from macroslip.case.parts import BackwardEuler, Radau
from macroslip.errors import InputError
from macroslip.film.film_law import film_range_notes
from macroslip.integrate.ahead import wait_for_integrator
from macroslip.integrate.entries import sealed
from macroslip.integrate.fixed_step import integrate_fixed_step
from macroslip.integrate.load_zone import empty_classes, firm_interference
from macroslip.integrate.path import FixedStep, Limits, Path, longest_step
from macroslip.integrate.radau import integrate_radau
from macroslip.integrate.record import RollerRecord, new_record
from macroslip.integrate.root import cold_slip
from macroslip.loads import BearingLoads, main_bearing_load
from macroslip.machine import usable_processors
from macroslip.result.dataset import to_dataset
from macroslip.result.evaluation import evaluated_models
from macroslip.result.own_laws import check_own_laws
from macroslip.result.simulate_whole import simulate_whole_bearing
from macroslip.result.thermal_balance import case_at_balance
from macroslip.ring.motion import ring_motion
from macroslip.ring.orbit import Motion, orbit_times
from macroslip.roller.model import (
    RollerModel,
    highest_load,
    interfaces,
    ring_geometry,
    roller_model,
    truncated_share,
    truncation_load,
)
from macroslip.whole_bearing.run import Times

if TYPE_CHECKING:
    import xarray as xr

#: Samples of the traces of a roller beyond which only a mistaken step is left as an explanation.
_MOST_SAMPLES = 10_000_000


def simulate(
    case: Case, *, threads: int | None = None, progress: Callable[[int, int], None] | None = None
) -> xr.Dataset:
    """Compute the slip of the rollers of both rows.

    Parameters
    ----------
    case : Case
    threads : int, optional
        Threads over rollers; the number of usable processors by default. Results do not depend on it.
    progress : callable, optional
        Called as progress(done, total) after each roller, and twice a second meanwhile. What it raises ends the simulation.

    Returns
    -------
    xarray.Dataset
        See `macroslip.result.dataset`. A roller whose integration failed has a `status` other than 0 and NaN results.

    Raises
    ------
    InputError
        If a roller's load truncates its contact ellipse, or a law does not exist.

    Examples
    --------
    >>> from macroslip import BearingLoads, Case, simulate
    >>> standstill = BearingLoads.constant([0.0, -300e3, 0.0], 0.0, 1.0)
    >>> float(simulate(Case(loads=standstill, rollers=[0])).energy.sum())
    0.0
    """
    threads = threads or usable_processors()
    if case.temperature == BALANCE:
        case = case_at_balance(case, lambda known: simulate(known, threads=threads))
    loads = case.loads if isinstance(case.loads, BearingLoads) else main_bearing_load(case.loads, case.drivetrain)
    oil = case.oil
    models = _rollers(case)
    model = models["downwind"]
    ring = ring_geometry(case.bearing, model)
    motion, largest = ring_motion(loads, case.bearing, ring, highest_load(case.bearing, oil, case.laws))
    check_own_laws(case.laws, case.bearing, oil, highest_speed(motion, model))
    end = float(motion.time[-1]) if case.window.end is None else float(case.window.end)
    edges = _orbit_edges(case, motion, model.orbit_ratio, end)
    trace_time = _trace_times(case, motion, end)
    if case.dynamics == WHOLE_BEARING:
        times = Times(edges, trace_time, end, case.contact_details)
        drag = _drag_power(case, model, motion, edges[0], end)
        evaluated = partial(evaluated_models, case, motion=motion, largest=largest, threads=threads)
        return simulate_whole_bearing(case, models, motion, times, evaluated, _notes(case, largest), drag, progress)
    models, evaluation = evaluated_models(case, models, motion, largest, threads)
    limits = radau_limits(case, motion, model, largest) or _fixed_step(case, motion, model)
    stops = np.unique(np.concatenate([edges, trace_time, [end]]))
    rollers = {row: sealed(one, detailed=case.contact_details) for row, one in models.items()}
    if isinstance(limits, Limits):
        wait_for_integrator()

    def run(row: str, angle: float) -> tuple[int, RollerRecord]:
        record = new_record(edges, trace_time, highest_speed(motion, model))
        path = Path(rollers[row], motion, angle, limits)
        if isinstance(limits, Limits):
            return integrate_radau(path, 0.0, stops, empty_classes(motion.time.size), record), record
        return integrate_fixed_step(path, 0.0, end, record), record

    angles = {row: initial_angles(row, case.bearing.rollers_per_row) for row in ROWS}
    jobs = [(row, number) for row in ROWS for number in case.roller_numbers]
    results = {}
    pool = ThreadPoolExecutor(threads)
    try:
        futures = {pool.submit(run, row, angles[row][number]): (row, number) for row, number in jobs}
        pending = set(futures)
        while pending:
            # On Windows an interrupt is noticed only when a wait ends.
            finished, pending = wait(pending, timeout=0.5, return_when=FIRST_COMPLETED)
            for future in finished:
                results[futures[future]] = future.result()
                if progress:
                    progress(len(results), len(jobs))
            if progress and not finished:
                progress(len(results), len(jobs))
    except BaseException:
        # An interrupt, say: the rollers under way look at this in every step.
        limits.interrupt[0] = 1
        raise
    finally:
        pool.shutdown(cancel_futures=True)
    drag = _drag_power(case, model, motion, edges[0], end)
    return to_dataset(case, model, edges, end, results, {**_notes(case, largest), **evaluation}, drag)


def _drag_power(case: Case, model: RollerModel, motion: Motion, start: float, end: float) -> float:
    """Mean power of the lubricant's drag (24) on the rollers of both rows [W]."""
    inside = (motion.time > start) & (motion.time < end)
    time = np.concatenate([[start], motion.time[inside], [end]])
    speed = np.abs(model.orbit_ratio * np.interp(time, motion.time, motion.shaft_speed))
    power = model.drag * speed**3 * case.bearing.pitch_radius
    return 2 * case.bearing.rollers_per_row * float(np.trapezoid(power, time)) / (end - start)


def _rollers(case: Case) -> dict[str, RollerModel]:
    """Rollers of both rows."""
    return {
        row: roller_model(
            case.bearing,
            case.oil,
            AXIAL_SIGNS[row],
            tilt=case.drivetrain.tilt,
            gravity=case.gravity,
            drag=case.drag,
            laws=case.laws,
        )
        for row in ROWS
    }


def _notes(case: Case, largest: float) -> dict[str, Any]:
    """Attributes on films out of range and on contacts cut off at the roller's ends, for the largest roller load [N]."""
    return {
        "film_range_notes": "\n".join(film_range_notes(case.laws.film, interfaces(case.bearing, case.oil))),
        "truncated_share": truncated_share(largest, truncation_load(case.bearing, case.oil)),
    }


def radau_limits(case: Case, motion: Motion, model: RollerModel, largest: float) -> Limits | None:
    """Bounds of the Radau integrator that hold for all rollers of the case; None for the Euler methods."""
    if not isinstance(case.integrator, Radau):
        return None
    speed = highest_speed(motion, model)
    heaviest = largest + abs(model.weight_in_plane) + model.centrifugal * (speed / model.outer_radius) ** 2
    roller = sealed(model)
    cold = cold_slip(roller, heaviest, speed) if heaviest else np.inf
    return Limits(
        tolerance=float(case.integrator.tolerance),
        max_steps=case.integrator.max_steps,
        speed_scale=speed,
        energy_scale=speed**2 / model.mobility,
        longest_step=longest_step(motion, model.orbit_ratio),
        cold_slip=float(cold),
        firm=firm_interference(roller, speed),
        interrupt=np.zeros(1, dtype=np.int8),
    )


def _fixed_step(case: Case, motion: Motion, model: RollerModel) -> FixedStep:
    """Rule of the Euler methods."""
    implicit = isinstance(case.integrator, BackwardEuler)
    return FixedStep(
        step=float(case.integrator.step),
        implicit=implicit,
        tolerance=float(case.integrator.tolerance) if implicit else 0.0,
        largest_slip=_largest_slip(motion, model),
        interrupt=np.zeros(1, dtype=np.int8),
    )


def highest_speed(motion: Motion, model: RollerModel) -> float:
    """Largest raceway speed |u2| of the history [m/s]."""
    return float(np.max(np.abs(motion.shaft_speed))) * model.orbit_ratio * model.outer_radius


def _largest_slip(motion: Motion, model: RollerModel) -> float:
    """Bound of slip [m/s] for a roller that starts in pure rolling: the span of ring speeds and the cage's zero."""
    speeds = motion.shaft_speed * model.orbit_ratio * model.outer_radius
    return 1.01 * float(max(speeds.max(), 0.0) - min(speeds.min(), 0.0)) + 1e-9


def _orbit_edges(case: Case, motion: Motion, orbit_ratio: float, end: float) -> np.ndarray:
    """Start of the window and the ends of the complete orbits in it [s]."""
    times = orbit_times(motion.time, motion.shaft_speed, orbit_ratio)
    if case.window.start is None:
        start = times[0] if times.size and times[0] < end else motion.time[0]
        return np.concatenate([[start], times[(times > start) & (times <= end)]])
    start = float(case.window.start)
    # Orbits are counted from the start of the window, not from that of the history.
    late = motion.time > start
    time = np.concatenate([[start], motion.time[late]])
    speed = np.concatenate([[np.interp(start, motion.time, motion.shaft_speed)], motion.shaft_speed[late]])
    times = orbit_times(time, speed, orbit_ratio)
    return np.concatenate([[start], times[times <= end]])


def _trace_times(case: Case, motion: Motion, window_end: float) -> np.ndarray:
    """Times at which traces are kept [s], never past the end of the simulation."""
    if case.traces is None:
        return np.empty(0)
    start = motion.time[0] if case.traces.start is None else case.traces.start
    end = window_end if case.traces.end is None else min(case.traces.end, window_end)
    samples = (end - start) / case.traces.step * (1.0 + 1e-12)
    if samples > _MOST_SAMPLES:
        raise InputError(
            f"a step of {case.traces.step:g} s makes {samples:.3g} samples",
            where="traces",
            allowed=f"up to {_MOST_SAMPLES:,} samples for each roller",
            remedy="Take a longer step, or traces of a shorter time.",
        )
    count = int(np.floor(samples)) + 1
    return np.minimum(start + case.traces.step * np.arange(max(count, 0)), end)
