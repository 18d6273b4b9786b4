"""What one force evaluation costs by itself, at the states that rollers of the histories pass through."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

import numpy as np

from benchmarks import own
from benchmarks.histories import History
from benchmarks.quadrature import patch_by_quadrature
from benchmarks.scan import timed
from macroslip.compiled import jit
from macroslip.contact.closed_form import patch_integral
from macroslip.mechanics.spin import CONDITIONS, FORCES, slip_forces, write_conditions
from macroslip.ring.orbit import instant, interval_of

#: States taken from each history, at equal intervals of time; how often they are gone through and timed.
_STATES, _ROUNDS, _REPEATS = 2000, 20, 5
#: Slip, as part of the raceway speed, up to which a loaded roller is gripped, and from which one without load coasts.
_GRIPPED, _COASTING = 1e-6, 1e-3


class States(NamedTuple):
    """Conditions, an array of `CONDITIONS`, and slips [m/s], met by one roller."""

    stations: np.ndarray
    slips: np.ndarray

    def only(self, chosen: np.ndarray) -> States:
        """The states where `chosen` is true."""
        return States(self.stations[chosen], self.slips[chosen])


@jit
def _stations_again(body, tables, motion, start_angle, times, stations, rounds):
    interval = 0
    for r in range(rounds):
        for k in range(times.size):
            interval = interval_of(motion, times[k], interval)
            write_conditions(
                body,
                tables,
                start_angle + 1e-9 * r,
                instant(motion, interval, times[k]),
                stations[k],
            )


@jit
def _forces_again(body, tables, stations, slips, forces, rounds):
    for r in range(rounds):
        # Another slip each round, so that no round can be spared.
        factor = 1.0 + 1e-9 * r
        for k in range(slips.size):
            slip_forces(body, tables, stations[k], slips[k] * factor, forces[k])


@jit
def _closed_form_again(exponents, heatings, rounds):
    total = 0.0
    for r in range(rounds):
        for k in range(exponents.size):
            value, by_slip, by_pressure = patch_integral(
                exponents[k], heatings[k] * (1.0 + 1e-9 * r)
            )
            total += value + by_slip + by_pressure
    return total


@jit
def _quadrature_again(exponents, heatings, rounds):
    total = 0.0
    for r in range(rounds):
        for k in range(exponents.size):
            value, by_slip, by_pressure = patch_by_quadrature(
                exponents[k], heatings[k] * (1.0 + 1e-9 * r)
            )
            total += value + by_slip + by_pressure
    return total


def _arguments(history: History) -> tuple:
    """The roller as compiled functions take it."""
    return history.roller.body[0], history.roller.tables


def visited(history: History, tolerance: float) -> States:
    """States of the history at equal intervals of time."""
    times = np.linspace(history.start, history.end, _STATES + 1)[1:]
    _, measures = own.integrate(history, tolerance, times)
    stations = np.zeros(times.size, CONDITIONS)
    _stations_again(*_arguments(history), history.motion, history.start_angle, times, stations, 1)
    return States(stations, measures.traces()["slip"])


def _nanoseconds(function, *arguments, count: int) -> float:
    """Least time per call [ns]; NaN if there is nothing to call it on."""
    if count == 0:
        return float("nan")
    function(*arguments, 1)
    return (
        1e9
        / (count * _ROUNDS)
        * min(timed(lambda: function(*arguments, _ROUNDS))[1] for _ in range(_REPEATS))
    )


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
        `force_evaluation_ns`, the same `_gripped_ns` and `_coasting_ns`, and `station_ns`: alone. `integration_ns`: CPU time of
        the integration with its measures per force evaluation. `overhead_factor`: integration over evaluations alone.
        Means are weighed with the evaluations of each history.
    """
    alone, gripped, coasting, stations, weights, total = [], [], [], [], [], []
    for history in histories:
        states = visited(history, tolerance)
        speed = np.abs(states.stations["ring_speed"])
        pressed = states.stations["elastic_load"] > 0.0
        held = states.only(pressed & (np.abs(states.slips) < _GRIPPED * speed))
        free = states.only(~pressed & (np.abs(states.slips) > _COASTING * speed))
        roller, room = _arguments(history), np.zeros(_STATES, FORCES)
        for nanoseconds, chosen in ((alone, states), (gripped, held), (coasting, free)):
            nanoseconds.append(
                _nanoseconds(_forces_again, *roller, *chosen, room, count=chosen.slips.size)
            )
        times = np.linspace(history.start, history.end, _STATES)
        arguments = (*roller, history.motion, history.start_angle, times, states.stations.copy())
        stations.append(_nanoseconds(_stations_again, *arguments, count=times.size))
        runs = [
            timed(partial(own.integrate, history, tolerance, np.empty(0))) for _ in range(_REPEATS)
        ]
        total.append(min(seconds for _, seconds in runs))
        weights.append(float(runs[0][0][0].evaluations))
    spent = 1e9 * sum(total)
    return {
        "force_evaluation_ns": float(np.average(alone, weights=weights)),
        "force_evaluation_gripped_ns": _mean(gripped),
        "force_evaluation_coasting_ns": _mean(coasting),
        "station_ns": float(np.mean(stations)),
        "integration_ns": spent / sum(weights),
        "overhead_factor": spent / float(np.dot(alone, weights)),
    }


def _mean(values: list[float]) -> float:
    known = [value for value in values if not np.isnan(value)]
    return float(np.mean(known)) if known else float("nan")


def quadrature_times(histories: list[History], tolerance: float) -> dict[str, float]:
    """Closed form against 32 nodes, value and derivatives, at the contacts of all visited states that carry load.

    Parameters
    ----------
    histories : list of History
        Of the paper's model.
    tolerance : float

    Returns
    -------
    dict
        `closed_form_ns`, `quadrature_ns`, `ratio`, `largest_difference` (relative, of the value), `contacts`.
    """
    exponents, heatings = [], []
    for history in histories:
        states, forces = visited(history, tolerance), np.zeros(_STATES, FORCES)
        _forces_again(*_arguments(history), *states, forces, 1)
        stations, slips = states
        for name, load, sliding in (
            ("inner", stations["inner_load"], slips),
            ("outer", stations["outer_load"], slips),
            ("cage", np.abs(forces["cage_load"]), stations["ring_speed"] - slips),
        ):
            contact, met = history.roller.body[0][name], (load > 0.0) & (sliding != 0.0)
            exponents.append(contact["pressure_exponent"] * np.cbrt(load[met]))
            heatings.append(contact["heating"] * np.abs(sliding[met]))
    points = np.concatenate(exponents), np.concatenate(heatings)
    closed = _nanoseconds(_closed_form_again, *points, count=points[0].size)
    summed = _nanoseconds(_quadrature_again, *points, count=points[0].size)
    worst = max(
        abs(patch_by_quadrature(p, q)[0] / patch_integral(p, q)[0] - 1.0)
        for p, q in zip(*points, strict=True)
    )
    return {
        "closed_form_ns": closed,
        "quadrature_ns": summed,
        "ratio": summed / closed,
        "largest_difference": float(worst),
        "contacts": points[0].size,
    }
