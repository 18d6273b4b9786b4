"""Plausibility of the columns of a record against its description."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from macroslip.constants import ZERO_CELSIUS
from macroslip.errors import InputError
from macroslip.input.messages import together
from macroslip.scada.description import MeasuredColumn, Quantities, ScadaDescription

#: Medians of temperatures beyond which a column is in another unit [K].
_MEDIANS = {
    "bearing_temperature": (ZERO_CELSIUS - 10.0, ZERO_CELSIUS + 75.0),
    "nacelle_temperature": (ZERO_CELSIUS - 20.0, ZERO_CELSIUS + 50.0),
    "ambient_temperature": (ZERO_CELSIUS - 30.0, ZERO_CELSIUS + 38.0),
}
#: Share of equal rows from which on two columns are one sensor.
_SAME = 0.9
#: Smallest difference of values of a sensor from which on it is coarse [K].
COARSE = 0.45
#: Quantile of the wind speed below which values are no wind speeds but shares of something [m/s].
_NORMALISED = 1.5


def check_quantities(values: Quantities, described: ScadaDescription) -> None:
    """Refuse columns whose values are impossible for their quantity.

    Raises InputError, all problems together: for medians of temperatures that no bearing, nacelle
    or site has, for values that were scaled to a range of 1, for a rotor far from its rated speed,
    and for a bearing that is the same sensor as nacelle or ambient.

    Parameters
    ----------
    values : mapping
        Columns by quantity, shape (rows,), SI.
    described : ScadaDescription
        The names and units that they were given.
    """
    columns = described.columns.measured
    problems = [
        *_normalised(values, columns),
        *_wrong_medians(values, columns),
        *_wrong_speed(values, columns, described.rated.rotor_speed),
        *_same_sensors(values, columns),
    ]
    if problems:
        raise together(problems)


def _normalised(values: Quantities, columns: Mapping[str, MeasuredColumn]) -> list[InputError]:
    winds = values["wind_speed"]
    known = winds[np.isfinite(winds)]
    most = np.quantile(known, 0.99) if known.size else 0.0
    if most > _NORMALISED:
        return []
    fault = f"the wind speed '{columns['wind_speed'].column}' "
    fault += f"is {most:.3g} m/s at most" if known.size else "has no numbers"
    return [
        InputError(
            fault,
            where="columns.wind_speed",
            allowed="wind speeds",
            remedy="Values that were scaled to a range of 1 tell no loads and no temperatures.",
        )
    ]


def _wrong_medians(values: Quantities, columns: Mapping[str, MeasuredColumn]) -> list[InputError]:
    problems = []
    for name, (low, high) in _MEDIANS.items():
        known = np.empty(0)
        if name in values:
            known = values[name][np.isfinite(values[name])]
        if name in values and not known.size:
            problems.append(
                InputError(f"'{columns[name].column}' has no numbers", where=f"columns.{name}")
            )
        elif known.size and not low <= np.median(known) <= high:
            column = columns[name]
            problems.append(
                InputError(
                    f"'{column.column}' has the median {column.written(np.median(known))}",
                    where=f"columns.{name}",
                    allowed=f"a median from {column.written(low)} to {column.written(high)}",
                    remedy=f"Is it in {_other_unit(column, float(np.median(known)))}?",
                )
            )
    return problems


def _other_unit(column: MeasuredColumn, median: float) -> str:
    """The unit that a column is more likely in, by its median [K] as it was read."""
    number_and_unit = column.written(median).split()
    number = float(number_and_unit[0])
    if number > 200.0:
        return "K"
    return "degF" if column.unit == "degC" else "another unit, or scaled"


def _wrong_speed(
    values: Quantities, columns: Mapping[str, MeasuredColumn], rated: float
) -> list[InputError]:
    speeds = values["rotor_speed"]
    known = speeds[np.isfinite(speeds)]
    fastest = np.quantile(known, 0.99) if known.size else 0.0
    if 0.5 * rated <= fastest <= 1.3 * rated:
        return []
    column = columns["rotor_speed"]
    return [
        InputError(
            f"'{column.column}' has {column.written(fastest)} at most, but for 1 % of the rows",
            where="columns.rotor_speed",
            allowed=f"0.5 to 1.3 of the rated speed, {column.written(rated)}",
            remedy="Check the units of this column and of rated.rotor_speed; is it the generator?",
        )
    ]


def _same_sensors(values: Quantities, columns: Mapping[str, MeasuredColumn]) -> list[InputError]:
    bearing = values["bearing_temperature"]
    problems = []
    for name in ("nacelle_temperature", "ambient_temperature"):
        if name not in values:
            continue
        air = values[name]
        both = np.isfinite(bearing) & np.isfinite(air)
        difference = np.abs(bearing[both] - air[both])
        if both.any() and np.mean(difference < 1e-6) > _SAME:
            problems.append(
                InputError(
                    f"'{columns['bearing_temperature'].column}' and '{columns[name].column}' have "
                    "the same values",
                    where=f"columns.{name}",
                    allowed="a sensor at the bearing and another in the air",
                )
            )
    return problems


def doubts(values: Quantities, described: ScadaDescription) -> list[str]:
    """Sentences on properties of the columns that make results less certain."""
    column = described.columns.bearing_temperature
    resolution = sensor_resolution(values["bearing_temperature"])
    if resolution < COARSE:
        return []
    return [
        f"The bearing's sensor '{column.column}' has steps of {resolution:.2g} K: "
        "a torque of seals fitted to it is three times less sure."
    ]


def sensor_resolution(values: np.ndarray) -> float:
    """Smallest difference between values of a sensor, in the unit of the values.

    Examples
    --------
    >>> sensor_resolution(np.array([20.0, 21.0, 23.0, np.nan]))
    1.0
    """
    known = values[np.isfinite(values)]
    different = np.unique(np.round(known, 6))
    if different.size < 2:
        return np.inf
    return float(np.diff(different).min())
