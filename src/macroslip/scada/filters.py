"""Filters of ten-minute means: the first that a row does not pass drops it.

missing, range, stuck, contradiction, status; and jumps, which drop nothing but part the record.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from macroslip.constants import ZERO_CELSIUS
from macroslip.scada.description import Quantities, ScadaDescription
from macroslip.scada.plausibility import COARSE, sensor_resolution

#: Filters in their order.
FILTERS = ("missing", "range", "stuck", "contradiction", "status")
#: Share of the rated speed above which the rotor turns.
TURNING = 0.3
#: Highest share of the rated speed, and highest wind speed [m/s].
_FASTEST = 1.2
_STRONGEST = 40.0
#: Plausible temperatures [K].
_TEMPERATURES = {
    "bearing_temperature": (ZERO_CELSIUS - 20.0, ZERO_CELSIUS + 100.0),
    "nacelle_temperature": (ZERO_CELSIUS - 30.0, ZERO_CELSIUS + 70.0),
    "ambient_temperature": (ZERO_CELSIUS - 40.0, ZERO_CELSIUS + 50.0),
}
#: Equal values in a row from which on a sensor is stuck; a bearing's sensor with steps of half a
#: kelvin and more rests as long as others do.
_STUCK_BEARING = 18
_STUCK_OTHER = 144
#: Share of the rated value from which on a controller holds speed or power, which may then rest.
_HELD = 0.98
#: Share of rated power above which the rotor has to turn.
_POWER = 0.05
#: Changes within ten minutes above which the record is parted [K].
_JUMPS = {"bearing_temperature": 1.2, "ambient_temperature": 3.0}
_TEN_MINUTES = 600.0
#: What temperatures in tenths of a degree may differ by from their values in kelvin [K].
_ROUNDING = 1e-6


def filtered(
    values: Quantities, state: np.ndarray | None, time: np.ndarray, described: ScadaDescription
) -> np.ndarray:
    """Number of the first filter that drops each row.

    Parameters
    ----------
    values : mapping
        Columns of `ScadaDescription.columns.measured` by name, shape (rows,), SI.
    state : ndarray of str, shape (rows,), optional
        State of the turbine.
    time : ndarray, shape (rows,)
        Time of each row [s], ascending.
    described : ScadaDescription

    Returns
    -------
    ndarray of int, shape (rows,)
        Index in `FILTERS`, or -1 where no filter drops the row.
    """
    rated = described.rated
    turning = values["rotor_speed"] > TURNING * rated.rotor_speed
    produces = values["power"] > _POWER * rated.power
    is_missing = [~np.isfinite(column) for column in values.values()]
    dropped = {
        "missing": np.any(is_missing, axis=0),
        "range": _out_of_range(values, rated.rotor_speed),
        "stuck": _stuck(values, turning, time, described),
        "contradiction": produces & ~turning,
        "status": np.zeros(time.size, dtype=bool),
    }
    if state is not None and described.columns.status is not None:
        dropped["status"] = ~np.isin(state, described.columns.status.sound)
    first = np.full(time.size, -1)
    for number in reversed(range(len(FILTERS))):
        first[dropped[FILTERS[number]]] = number
    return first


def _out_of_range(values: Quantities, rated_speed: float) -> np.ndarray:
    limits = {
        **_TEMPERATURES,
        "rotor_speed": (0.0, _FASTEST * rated_speed),
        "wind_speed": (0.0, _STRONGEST),
    }
    ranged = [
        (values[name] < low) | (values[name] > high)
        for name, (low, high) in limits.items()
        if name in values
    ]
    return np.any(ranged, axis=0)


def _stuck(
    values: Quantities, turning: np.ndarray, time: np.ndarray, described: ScadaDescription
) -> np.ndarray:
    """Rows whose sensor repeats itself.

    A rotor that stands may keep its temperature, and a controller holds rated speed and power for
    days of storm: equal values are normal there.
    """
    longest = 1.5 * described.time.step
    is_late = np.diff(time) > longest
    gap = np.concatenate([[True], is_late])
    rated = {"rotor_speed": described.rated.rotor_speed, "power": described.rated.power}
    stuck = np.zeros(time.size, dtype=bool)
    for name, column in values.items():
        counted = np.ones(time.size, dtype=bool)
        if name == "bearing_temperature":
            counted = turning
        elif name in rated:
            below_rated = column < _HELD * rated[name]
            counted = turning & below_rated
        is_fine = name == "bearing_temperature" and sensor_resolution(column) < COARSE
        most = _STUCK_BEARING if is_fine else _STUCK_OTHER
        lengths = run_lengths(column, counted, gap)
        stuck |= lengths >= most
    return stuck


def run_lengths(values: np.ndarray, counted: np.ndarray, breaks: np.ndarray) -> np.ndarray:
    """Number of equal values in a row around each value.

    Parameters
    ----------
    values : ndarray, shape (n,)
    counted : ndarray of bool, shape (n,)
        Values that count; the others end a run and have the length 0.
    breaks : ndarray of bool, shape (n,)
        True where a run cannot go on from the value before.

    Returns
    -------
    ndarray of int, shape (n,)

    Examples
    --------
    >>> values = np.array([1.0, 1.0, 2.0, 2.0, 2.0, np.nan])
    >>> run_lengths(values, np.ones(6, dtype=bool), np.zeros(6, dtype=bool)).tolist()
    [2, 2, 3, 3, 3, 0]
    """
    counted = counted & np.isfinite(values)
    begins = np.ones(values.size, dtype=bool)
    changes = values[1:] != values[:-1]
    is_left_out = ~counted[1:] | ~counted[:-1]
    begins[1:] = changes | breaks[1:] | is_left_out
    number = np.cumsum(begins) - 1
    lengths = np.bincount(number)
    return np.where(counted, lengths[number], 0)


def jumps(values: Quantities, time: np.ndarray, step: float) -> np.ndarray:
    """True where bearing or ambient change from the row before by more than the air can.

    Shape (rows,). The limits of ten minutes hold for shorter steps too, since sensors are coarse,
    and grow with longer ones.
    """
    after_gap = np.diff(time) > 1.5 * step
    is_jump = np.zeros(time.size, dtype=bool)
    for name, limit in _JUMPS.items():
        if name in values:
            steps = max(step / _TEN_MINUTES, 1.0)
            change = np.abs(np.diff(values[name]))
            is_large = change > limit * steps + _ROUNDING
            is_jump[1:] |= is_large & ~after_gap
    return is_jump


def dropped_by_filter(first: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    """Yield each filter's name with the rows that it drops."""
    for number, name in enumerate(FILTERS):
        yield name, first == number
