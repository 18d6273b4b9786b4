"""Simulation of a case: every roller on its own, or the whole bearing at once."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from dataclasses import replace

import numpy as np
import xarray as xr

from macroslip.bearing.geometry import initial_angles, row_names
from macroslip.case.case import BALANCE, WHOLE_BEARING, Case
from macroslip.case.parts import BackwardEuler, Radau
from macroslip.contact.table import larger
from macroslip.imposed.run import Outcome, Problem, fixed_step, radau_limits, steps_of
from macroslip.imposed.status import OUTSIDE_TABLES
from macroslip.imposed.tuning import LONGEST_RIBBED_TURN, LONGEST_SKEWED_TURN, LONGEST_TURN
from macroslip.machine import usable_processors
from macroslip.measures.cage import CageMeasures
from macroslip.measures.roller import RollerMeasures, Row, Wanted
from macroslip.measures.skew import Skewing
from macroslip.result.dataset import Measured, to_dataset, whole_dataset
from macroslip.result.heat_balance import case_at_balance
from macroslip.result.prepared import Prepared, prepare
from macroslip.result.skew import skewing
from macroslip.roller.model import Roller, TableReport, with_tables
from macroslip.storage.kernels import keep_kernels
from macroslip.whole import sdirk
from macroslip.whole.model import WholeBearing, whole_bearing
from macroslip.whole.model import with_tables as assembled

#: Times that tables are made larger for a roller whose state leaves them.
_ENLARGED = 4


def simulate(
    case: Case, *, threads: int | None = None, progress: Callable[[int, int], None] | None = None
) -> xr.Dataset:
    """Compute the slip of the rollers of all rows.

    Parameters
    ----------
    case : Case
    threads : int, optional
        Threads over rollers; the number of usable processors by default. Results do not depend on
        it.
    progress : callable, optional
        Called as progress(done, total) whenever rollers are done, and twice a second meanwhile; the
        rollers of a whole
        bearing are done together. An exception in it ends the simulation.

    Returns
    -------
    xarray.Dataset
        See `macroslip.result.dataset`. A roller whose integration failed has a `status` other than
        0 and NaN results.

    Raises
    ------
    InputError
        If a roller's load truncates its contact ellipse, or a law does not exist.

    Examples
    --------
    >>> from macroslip import BearingLoads, Case, Laws, simulate
    >>> standstill = BearingLoads.constant([0.0, -300e3, 0.0], 0.0, 1.0)
    >>> float(simulate(Case(loads=standstill, laws=Laws.paper(), rollers=[0])).energy.sum())
    0.0
    """
    threads = threads or usable_processors()
    if case.temperature == BALANCE:
        case = case_at_balance(case, lambda known: simulate(known, threads=threads))
    ready = prepare(case)
    whole = case.dynamics == WHOLE_BEARING
    wanted = Wanted(
        ready.edges,
        ready.highest_speed,
        ready.trace_time,
        case.contact_details and ready.model.curved,
        # Beside the steps of a whole bearing samples cost little.
        spacing=0.05 if whole else 1.0,
    )  # fmt: skip
    stop = threading.Event()
    run = _whole_bearing if whole else _imposed_orbits
    try:
        return run(ready, wanted, threads, progress, stop)
    except BaseException:
        # An interrupt, say: rollers under way look at this after every buffer of steps.
        stop.set()
        raise
    finally:
        keep_kernels()


class _InterruptedError(Exception):
    """The simulation was ended; runs under way are thrown away."""


def _imposed_orbits(
    ready: Prepared, wanted: Wanted, threads: int, progress: Callable | None, stop: threading.Event
) -> xr.Dataset:
    case = ready.case
    names = row_names(case.bearing)
    angles = {row: initial_angles(row, case.bearing.rollers_per_row) for row in names}
    left = [(row, number) for row in names for number in case.roller_numbers]
    results: dict[tuple[str, int], Measured] = {}
    total = len(left)
    report = None
    own_motions = ready.balance.own_motions
    with ThreadPoolExecutor(threads) as pool:
        for enlargement in range(_ENLARGED + 1):
            rollers, made = with_tables(ready.models, ready.box)
            report = report or made
            skews = skewing(case, ready.model.laws, ready.box)
            problems = {row: _problem(ready, rollers[row], skews.get(row)) for row in names}
            rows = {
                row: Row(ready.models[row], rollers[row], ready.motion, wanted, skews.get(row))
                for row in names
            }

            futures = {}
            for row, number in left:
                problem = problems[row]
                if own_motions:
                    index = names.index(row) * case.bearing.rollers_per_row + number
                    problem = replace(problem, motion=own_motions[index])
                start_angle = float(angles[row][number])
                future = pool.submit(_roller, problem, rows[row], start_angle, stop)
                futures[future] = (row, number)
            try:
                for future in _finished(set(futures), progress, total - len(left), total):
                    results[futures[future]] = future.result()
            except BaseException:
                stop.set()
                pool.shutdown(cancel_futures=True)
                raise
            left = [
                job
                for job, measured in results.items()
                if measured.outcome.status == OUTSIDE_TABLES
            ]
            if not left or enlargement == _ENLARGED:
                break
            ready = replace(ready, box=larger(ready.box))
    return to_dataset(ready, wanted, results, report or TableReport(0.0, 0.0, 0))


def _finished(pending: set, progress: Callable | None, done: int, total: int):
    """Futures as they finish; listeners hear the progress twice a second."""
    while pending:
        # On Windows an interrupt is noticed only when a wait ends.
        finished, pending = wait(pending, timeout=0.5, return_when=FIRST_COMPLETED)
        for future in finished:
            done += 1
            yield future
        if progress:
            progress(done, total)


def _problem(ready: Prepared, roller: Roller, skewing: Skewing | None) -> Problem:
    integrator = ready.case.integrator
    motion = ready.motion
    if isinstance(integrator, Radau):
        longest = LONGEST_TURN
        if ready.model.rib is not None:
            longest = LONGEST_RIBBED_TURN
        if skewing is not None and skewing.guide.largest > 0.0:
            longest = LONGEST_SKEWED_TURN
        limits = radau_limits(
            roller,
            motion,
            tolerance=float(integrator.tolerance),
            max_steps=integrator.max_steps,
            heaviest=ready.heaviest,
            window=float(ready.edges[0]),
            longest_turn=longest,
        )
        times = np.concatenate([ready.edges, ready.trace_time, [ready.end]])
        stops = np.unique(times)
        return Problem(roller, motion, limits, stops)
    tolerance = None
    if isinstance(integrator, BackwardEuler):
        tolerance = float(integrator.tolerance)
    limits = fixed_step(roller, motion, step=integrator.step, end=ready.end, tolerance=tolerance)
    return Problem(roller, motion, limits)


def _roller(problem: Problem, row: Row, start_angle: float, stop: threading.Event) -> Measured:
    outcome = Outcome()
    measures = RollerMeasures(row, start_angle)
    for steps in steps_of(problem, start_angle, outcome):
        if stop.is_set():
            raise _InterruptedError
        measures.add(steps, 0)
    measures.finish()
    return Measured(measures, outcome)


def bearing_of(case: Case) -> WholeBearing:
    """All rollers and cages of a case at a known temperature."""
    return whole_bearing(
        case.bearing,
        case.oil,
        case.cage,
        tilt=case.drivetrain.tilt,
        gravity=case.gravity,
        drag=case.drag,
        laws=case.laws,
    )


def _whole_bearing(
    ready: Prepared, wanted: Wanted, threads: int, progress: Callable | None, stop: threading.Event
) -> xr.Dataset:
    bearing = bearing_of(ready.case)
    count = bearing.positions.size
    # All rollers are done together.
    together = progress and (lambda done, total: progress(done * count, total * count))
    with ThreadPoolExecutor(1) as pool:
        for _ in range(_ENLARGED + 1):
            # In a thread of its own, so that an interrupt arrives here.
            future = pool.submit(_run_whole, ready, wanted, bearing, stop)
            try:
                for _ in _finished({future}, together, 0, 1):
                    pass
            except BaseException:
                stop.set()
                raise
            computed = future.result()
            if computed[0].status != OUTSIDE_TABLES:
                break
            ready = replace(ready, box=larger(ready.box))
    return whole_dataset(ready, wanted, bearing, *computed)


def _run_whole(ready: Prepared, wanted: Wanted, bearing, stop: threading.Event):
    case = ready.case
    motion = ready.motion
    assembly, report = assembled(bearing, ready.box)
    count = case.bearing.rollers_per_row
    names = row_names(case.bearing)
    skews = skewing(case, ready.model.laws, ready.box)
    rows = {
        row: Row(
            bearing.models[row],
            Roller(assembly.bodies[k : k + 1], assembly.tables),
            motion,
            wanted,
            skews.get(row),
        )
        for k, row in enumerate(names)
    }
    chosen = [(row, number) for row in names for number in case.roller_numbers]
    indices = [names.index(row) * count + number for row, number in chosen]
    measures = [
        RollerMeasures(rows[row], float(bearing.positions["angle"][index]))
        for (row, _), index in zip(chosen, indices, strict=True)
    ]
    start = float(motion.time[0])
    times = ready.trace_time
    if case.traces is None:
        times = np.unique(np.concatenate([[start], ready.edges, [ready.end]]))
    cages = CageMeasures(bearing, wanted, times)
    stops = np.unique(np.concatenate([times, ready.edges, [ready.end]]))
    outcome = Outcome()
    for part in sdirk.steps_of(
        assembly, motion, sdirk.pure_rolling(bearing, case.cage), stops[stops > start],
        tolerance=float(case.integrator.tolerance), max_steps=case.integrator.max_steps,
    ):  # fmt: skip
        if stop.is_set():
            raise _InterruptedError
        cages.add(part)
        for index, measure in zip(indices, measures, strict=True):
            measure.add(part.steps, index)
        memory = part.memory
        outcome = Outcome(
            int(part.status),
            int(memory["steps"]),
            int(memory["rejections"]),
            int(memory["evaluations"]),
            float(memory["unbalanced"]),
            float(memory["time"]),
            0.0,
        )
    for measure in measures:
        measure.finish()
    return outcome, dict(zip(chosen, measures, strict=True)), cages, report
