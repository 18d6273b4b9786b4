"""What one force evaluation costs by itself, at the states that rollers of the histories pass through."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from benchmarks import own
from benchmarks.histories import History
from benchmarks.quadrature import patch_by_quadrature
from benchmarks.scan import timed
from macroslip.compiled import jit
from macroslip.integrate.load_zone import classify, empty_classes
from macroslip.ring.orbit import instant, interval_of
from macroslip.roller.forces import Station, slip_forces, station
from macroslip.traction.patch_integral import patch_integral

#: States taken from each history, at equal intervals of time; how often they are gone through and timed.
_STATES, _ROUNDS, _REPEATS = 2000, 20, 5
#: Slip, as part of the raceway speed, up to which a loaded roller is gripped, and from which one without load coasts.
_GRIPPED, _COASTING = 1e-6, 1e-3


class States(NamedTuple):
    """Stations, shape (n, 6), and slips [m/s], shape (n,), met by one roller."""

    stations: np.ndarray
    slips: np.ndarray

    def only(self, chosen: np.ndarray) -> States:
        """The states where `chosen` is true."""
        return States(self.stations[chosen], self.slips[chosen])


@jit
def _write_stations(model, motion, start_angle, times, out):
    interval = 0
    for k in range(times.size):
        interval = interval_of(motion, times[k], interval)
        at = station(model, start_angle, instant(motion, interval, times[k]))
        for j in range(6):
            out[k, j] = at[j]


@jit
def _stations_again(model, motion, start_angle, times, rounds):
    total, interval = 0.0, 0
    for r in range(rounds):
        for k in range(times.size):
            interval = interval_of(motion, times[k], interval)
            at = station(model, start_angle + 1e-9 * r, instant(motion, interval, times[k]))
            total += at.ring_speed + at.inner_load + at.outer_load + at.tangential
    return total


@jit
def _forces_again(model, stations, slips, rounds):
    total = 0.0
    for r in range(rounds):
        # Another slip each round, so that no round can be spared.
        factor = 1.0 + 1e-9 * r
        for k in range(slips.size):
            at = Station(stations[k, 0], stations[k, 1], stations[k, 2], stations[k, 3], stations[k, 4], stations[k, 5])
            forces = slip_forces(model, at, slips[k] * factor)
            total += forces.inner + forces.outer + forces.cage + forces.slope + forces.cage_load
    return total


@jit
def _classify_again(model, motion, start_angle, firm, classes, rounds):
    for _ in range(rounds):
        classify(model, motion, start_angle, firm, classes)


@jit
def _closed_form_again(exponents, heatings, rounds):
    total = 0.0
    for r in range(rounds):
        for k in range(exponents.size):
            value, by_slip, by_pressure = patch_integral(exponents[k], heatings[k] * (1.0 + 1e-9 * r))
            total += value + by_slip + by_pressure
    return total


@jit
def _quadrature_again(exponents, heatings, rounds):
    total = 0.0
    for r in range(rounds):
        for k in range(exponents.size):
            value, by_slip, by_pressure = patch_by_quadrature(exponents[k], heatings[k] * (1.0 + 1e-9 * r))
            total += value + by_slip + by_pressure
    return total


def visited(history: History, tolerance: float) -> States:
    """States of the history at equal intervals of time."""
    times = np.linspace(history.start, history.end, _STATES + 1)[1:]
    _, record = own.integrate(history, tolerance, times)
    stations = np.empty((times.size, 6))
    _write_stations(history.model, history.motion, history.start_angle, times, stations)
    return States(stations, record.trace[:, 0].copy())


def _nanoseconds(function, *arguments, count: int) -> float:
    """Least time per call [ns]; NaN if there is nothing to call it on."""
    if count == 0:
        return float("nan")
    function(*arguments, 1)
    return 1e9 / (count * _ROUNDS) * min(timed(lambda: function(*arguments, _ROUNDS))[1] for _ in range(_REPEATS))


def evaluation_times(histories: list[History], tolerance: float) -> dict[str, float]:
    """Times of one evaluation alone and of the whole integration per evaluation, means over all histories.

    Parameters
    ----------
    histories : list of History
    tolerance : float
        Of the production integrator.

    Returns
    -------
    dict
        `force_evaluation_ns`, the same `_gripped_ns` and `_coasting_ns`, `station_ns`, `classification_ns` (of one
        sample interval): alone. `integration_ns`: CPU time of the integration per force evaluation. `overhead_factor`:
        integration over evaluations alone. `stations_share`, `classification_share`: parts of the integration's time
        that three stations a step, and the classes of intervals, explain. Means are weighed with the evaluations of
        each history.
    """
    alone, gripped, coasting, stations, classes, weights, steps, total = [], [], [], [], [], [], [], []
    for history in histories:
        states = visited(history, tolerance)
        speed = np.abs(states.stations[:, 0])
        pressed = states.stations[:, 2] > 0.0
        held = states.only(pressed & (np.abs(states.slips) < _GRIPPED * speed))
        free = states.only(~pressed & (np.abs(states.slips) > _COASTING * speed))
        for found, chosen in ((alone, states), (gripped, held), (coasting, free)):
            count = chosen.slips.size
            found.append(_nanoseconds(_forces_again, history.model, *chosen, count=count))
        times = np.linspace(history.start, history.end, _STATES)
        place = (history.model, history.motion, history.start_angle, times)
        stations.append(_nanoseconds(_stations_again, *place, count=times.size))
        room = empty_classes(history.motion.time.size)
        intervals = (history.model, history.motion, history.start_angle, history.limits.firm, room)
        classes.append(_nanoseconds(_classify_again, *intervals, count=room.size))
        runs = [timed(lambda: own.integrate(history, tolerance, np.empty(0))) for _ in range(_REPEATS)]  # noqa: B023
        total.append(min(seconds for _, seconds in runs))
        count = runs[0][0][1].count
        weights.append(float(count[2]))
        steps.append(float(count[0] + count[1]))
    spent = 1e9 * sum(total)
    samples = [history.motion.time.size - 1 for history in histories]
    return {
        "force_evaluation_ns": float(np.average(alone, weights=weights)),
        "force_evaluation_gripped_ns": _mean(gripped),
        "force_evaluation_coasting_ns": _mean(coasting),
        "station_ns": float(np.mean(stations)),
        "classification_ns": float(np.mean(classes)),
        "integration_ns": spent / sum(weights),
        "overhead_factor": spent / float(np.dot(alone, weights)),
        "stations_share": 3.0 * float(np.dot(stations, steps)) / spent,
        "classification_share": float(np.dot(classes, samples)) / spent,
    }


def _mean(values: list[float]) -> float:
    known = [value for value in values if not np.isnan(value)]
    return float(np.mean(known)) if known else float("nan")


def quadrature_times(histories: list[History], tolerance: float) -> dict[str, float]:
    """Closed form against 32 nodes, value and derivatives, at the contacts of all visited states that carry load.

    Returns
    -------
    dict
        `closed_form_ns`, `quadrature_ns`, `ratio`, `largest_difference` (relative, of the value), `contacts`.
    """
    exponents, heatings = [], []
    for history in histories:
        states = visited(history, tolerance)
        for k in range(states.slips.size):
            at, slip = Station(*states.stations[k]), states.slips[k]
            cage_load = abs(slip_forces(history.model, at, slip).cage_load)
            model = history.model
            met = (
                (model.inner, at.inner_load, slip),
                (model.outer, at.outer_load, slip),
                (model.cage, cage_load, at.ring_speed - slip),
            )
            for contact, load, sliding in met:
                if load > 0.0 and sliding != 0.0:
                    exponents.append(contact.traction.pressure_exponent * load ** (1.0 / 3.0))
                    heatings.append(contact.traction.heating * abs(sliding))
    points = np.array(exponents), np.array(heatings)
    closed = _nanoseconds(_closed_form_again, *points, count=points[0].size)
    summed = _nanoseconds(_quadrature_again, *points, count=points[0].size)
    worst = max(abs(patch_by_quadrature(p, q)[0] / patch_integral(p, q)[0] - 1.0) for p, q in zip(*points, strict=True))
    return {
        "closed_form_ns": closed,
        "quadrature_ns": summed,
        "ratio": summed / closed,
        "largest_difference": float(worst),
        "contacts": points[0].size,
    }
