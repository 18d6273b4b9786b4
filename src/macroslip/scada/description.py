"""Description of the ten-minute means of a turbine: files, columns, units, time, rated values."""

from __future__ import annotations

import datetime
from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Annotated, Any, NamedTuple
from zoneinfo import ZoneInfo

import numpy as np
import pandas as pd

from macroslip.errors import InputError
from macroslip.input.fields import Choice, Context, Form, Positive, Quantity, Text, Texts
from macroslip.input.files import Location, parse, read_text
from macroslip.input.section import form_from, input_section
from macroslip.input.units import (
    MASS,
    NUMBER,
    POWER,
    RECORDED_TEMPERATURE,
    SPEED,
    TEMPERATURE_DIFFERENCE,
    TIME,
    WIND_SPEED,
    Dimension,
)

#: Columns of a record by the names of its quantities, each of shape (rows,), in SI units.
Quantities = Mapping[str, np.ndarray]
_REMEDY = "Write one with: macroslip scada init FILE"
#: Word for a record without a column of time.
CONSECUTIVE = "consecutive"


@dataclass(frozen=True)
class MeasuredColumn:
    """A column of a record, its unit, and what its values are divided by."""

    column: str
    unit: str
    dimension: Dimension
    ratio: float = 1.0  #: Speed of the generator over that of the rotor

    def si(self, values: np.ndarray) -> np.ndarray:
        """Values of the column in SI.

        Examples
        --------
        >>> MeasuredColumn("Ot_avg", "degF", RECORDED_TEMPERATURE).si(np.array([50.0])).round(9)
        array([283.15])
        """
        unit = self.dimension.units[self.unit]
        scale = float(unit.scale) / self.ratio
        return (values + float(unit.offset)) * scale

    def written(self, si_value: float) -> str:
        """A value [SI] in the unit of the column.

        Examples
        --------
        >>> MeasuredColumn("Ot_avg", "degC", RECORDED_TEMPERATURE).written(583.15)
        '310 degC'
        """
        unit = self.dimension.units[self.unit]
        scaled = si_value * self.ratio / float(unit.scale)
        value = scaled - float(unit.offset)
        return f"{value:.4g} {self.unit}"


@dataclass(frozen=True)
class ColumnForm(Form):
    """Name and unit of a column, such as {column: P_avg, unit: kW}."""

    dimension: Dimension = NUMBER
    has_ratio: bool = False

    @property
    def form(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Accepted values, in words."""
        unit = f"unit, {self.dimension.choices}"
        return f"a section with the keys column, {unit}{', ratio' if self.has_ratio else ''}"

    def read(self, value: Any, context: Context) -> MeasuredColumn:
        """Read name, unit and, of a generator's speed, ratio."""
        if isinstance(value, MeasuredColumn):
            return value
        keys = ("column", "unit", "ratio") if self.has_ratio else ("column", "unit")
        if not isinstance(value, Mapping) or set(value) != set(keys):
            raise self.wrong(value)
        column = Text("name of the column").read(value["column"], context)
        units = tuple(self.dimension.units)
        unit = Choice("unit of the column", lambda: units).read(value["unit"], context)
        ratio = value.get("ratio", 1.0)
        ratio = Positive("speed of the generator over that of the rotor", NUMBER).read(
            ratio, context
        )
        return MeasuredColumn(column, unit, self.dimension, float(ratio or 1.0))


@dataclass(frozen=True)
class Label(Form):
    """A value of a column as text; a whole number is welcome."""

    form = "text or a whole number"

    def read(self, value: Any, context: Context) -> str:
        """The value as text."""
        if isinstance(value, bool) or not isinstance(value, str | int) or value == "":
            raise self.wrong(value)
        return str(value)


@dataclass(frozen=True)
class Labels(Form):
    """A list of values of a column, as text."""

    form = "a list of texts or whole numbers"

    def read(self, value: Any, context: Context) -> tuple[str, ...]:
        """Every value as text."""
        values = [value]
        if isinstance(value, list | tuple):
            values = list(value)
        if not values:
            raise self.wrong(value)
        label = Label(self.about)
        return tuple(label.read(item, context) for item in values)


class Period(NamedTuple):
    """Days from the first to the last, both included, as times in UTC."""

    first: pd.Timestamp
    end: pd.Timestamp  #: Midnight after the last day


@dataclass(frozen=True)
class PeriodForm(Form):
    """Two days, the first and the last of a period."""

    form = "a list of two days, such as [2015-01-01, 2015-12-31]"

    def read(self, value: Any, context: Context) -> Period:
        """Read both days; the last one is not before the first."""
        if isinstance(value, Period):
            return value
        if not isinstance(value, list | tuple) or len(value) != 2:
            raise self.wrong(value)
        days = []
        for day in value:
            if not isinstance(day, str | datetime.date):
                raise self.wrong(value)
            try:
                timestamp = pd.Timestamp(str(day)).tz_localize("UTC")
            except (ValueError, TypeError):
                raise self.wrong(value) from None
            days.append(timestamp.normalize())
        if days[1] < days[0]:
            raise self.wrong(value, "Write the earlier day first.")
        first, last = days
        return Period(first, last + pd.Timedelta(days=1))


@dataclass(frozen=True)
class Range(Form):
    """Two quantities of one dimension, the smaller one first."""

    dimension: Dimension = NUMBER
    form = "a list of two quantities, the smaller one first"

    def read(self, value: Any, context: Context) -> tuple[float, float]:
        """Read both to SI."""
        if not isinstance(value, list | tuple) or len(value) != 2:
            raise self.wrong(value)
        form = Positive(self.about, self.dimension)
        low, high = (form.read(item, context) for item in value)
        if low is None or high is None or not low <= high:
            raise self.wrong(value)
        return low, high


@dataclass(frozen=True)
class Zone(Form):
    """Name of a time zone."""

    form = "a time zone such as Europe/Paris, UTC or Etc/GMT-1"

    def read(self, value: Any, context: Context) -> str:
        """Check that the zone exists."""
        try:
            ZoneInfo(value)
        except (KeyError, ValueError, TypeError, OSError, AttributeError):
            raise self.wrong(value) from None
        return value


@input_section("rows", "which rows of the files are those of the turbine")
class Rows:
    """Rows of one turbine in files of several."""

    column: Annotated[str, Text("name of the column that names the turbine")]
    equals: Annotated[str, Label("its value in the rows of the turbine")]


@input_section("time", "when the rows were measured")
class Clock:
    """Column of time, and how it is written."""

    column: Annotated[str | None, Text("name of the column of time")] = None
    zone: Annotated[
        str | None, Zone("zone of the clock, for times without an offset of their own")
    ] = None
    stamp: Annotated[
        str, Choice("end of the mean that its time stands for", lambda: ("start", "end"))
    ] = "start"
    step: Annotated[float, Positive("time over which a row is the mean", TIME, 86400.0)] = 600.0
    format: Annotated[
        str | None,
        Text("form of the time if it is not that of ISO 8601, such as '%d.%m.%Y %H:%M'"),
    ] = None
    assume: Annotated[
        str | None,
        Choice("for files without time: rows follow one another", lambda: (CONSECUTIVE,)),
    ] = None

    def __post_init__(self) -> None:
        if (self.column is None) == (self.assume is None):
            raise InputError(
                "the record needs a column of time"
                if self.column is None
                else "a column of time and an assumption about time stand together",
                allowed=f"column: NAME, or assume: {CONSECUTIVE} for rows without time",
            )


@input_section("status", "state of the turbine by its own controller")
class Status:
    """Column of the turbine's state, and the states that are used."""

    column: Annotated[str, Text("name of the column of the state")]
    sound: Annotated[tuple[str, ...], Labels("states of rows that are used")]


_SPEEDS = ("rotor_speed", "generator_speed")


@input_section("columns", "where each quantity stands, and in which unit", one_of=_SPEEDS)
class Columns:
    """Columns of the record. Rows that lack any of those named here are not used."""

    wind_speed: Annotated[MeasuredColumn, ColumnForm("wind speed", WIND_SPEED)]
    rotor_speed: Annotated[MeasuredColumn | None, ColumnForm("speed of the rotor", SPEED)] = None
    generator_speed: Annotated[
        MeasuredColumn | None, ColumnForm("speed of the generator", SPEED, has_ratio=True)
    ] = None
    power: Annotated[MeasuredColumn, ColumnForm("electrical power", POWER)]
    bearing_temperature: Annotated[
        MeasuredColumn, ColumnForm("temperature of the main bearing", RECORDED_TEMPERATURE)
    ]
    nacelle_temperature: Annotated[
        MeasuredColumn | None,
        ColumnForm("temperature of the air in the nacelle", RECORDED_TEMPERATURE),
    ] = None
    ambient_temperature: Annotated[
        MeasuredColumn | None, ColumnForm("temperature of the air outside", RECORDED_TEMPERATURE)
    ] = None
    status: Status | None = None

    @property
    def measured(self) -> dict[str, MeasuredColumn]:
        """Columns with numbers by the quantity, a generator's speed as `rotor_speed`."""
        speed = self.rotor_speed or self.generator_speed
        columns = {
            "wind_speed": self.wind_speed,
            "rotor_speed": speed,
            "power": self.power,
            "bearing_temperature": self.bearing_temperature,
            "nacelle_temperature": self.nacelle_temperature,
            "ambient_temperature": self.ambient_temperature,
        }
        return {name: column for name, column in columns.items() if column is not None}


@input_section("rated", "the turbine at rated power")
class Rated:
    """Speed of the rotor and power at rated power, and the wind speed where it begins."""

    rotor_speed: Annotated[float, Positive("rated speed of the rotor", SPEED, 10.0)]
    power: Annotated[float, Positive("rated power", POWER)]
    wind_speed: Annotated[
        float,
        Positive("rated wind speed of the study's turbine, for load_by: power", WIND_SPEED, 30.0),
    ] = 11.2


@input_section("capacity", "what warms with the bearing")
class HeatCapacity:
    """Mass that warms with the bearing, and the range it is known to lie in."""

    mass: Annotated[float, Positive("mass that warms with the bearing", MASS)]
    range: Annotated[tuple[float, float] | None, Range("range of that mass", MASS)] = None


@input_section("scada", "ten-minute means of a turbine")
class ScadaDescription:
    """The keys of a file that describes the ten-minute means of a turbine. All values are in SI."""

    turbine: Annotated[str, Label("name of the turbine")] = ""
    files: Annotated[
        list[str], Texts("files: csv, csv.gz, parquet or xlsx, wildcards * and ? allowed")
    ]
    sheet: Annotated[str | None, Text("name of the sheet, for xlsx; the first if left out")] = None
    rows: Rows | None = None
    time: Clock
    columns: Columns
    rated: Rated
    load_by: Annotated[
        str,
        Choice(
            "what tells the load of a row: the wind speed, or the power for another rotor",
            lambda: ("wind", "power"),
        ),
    ] = "wind"
    oil_offset: Annotated[
        float,
        Quantity(
            "temperature of the oil in the contacts over that of the sensor",
            TEMPERATURE_DIFFERENCE,
            -30.0,
            30.0,
        ),
    ] = 0.0
    capacity: HeatCapacity | None = None
    reference: Annotated[
        Period | None, PeriodForm("period in which the bearing is taken for sound")
    ] = None
    sibling: Annotated[
        str | None, Text("description of another bearing or turbine, beside which it is put")
    ] = None

    @classmethod
    def read(cls, path: str | PathLike[str]) -> ScadaDescription:
        """Read a YAML file that describes the means of a turbine.

        Parameters
        ----------
        path : path
            YAML file; `macroslip scada init FILE` writes one.

        Raises
        ------
        InputError
            If the file cannot be read, or anything in it is wrong: all problems together, each
            with file, line and key.
        """
        path = Path(path)
        text = read_text(path, "the description cannot be read", where=str(path), remedy=_REMEDY)
        data, source = parse(text, str(path), _REMEDY)
        return form_from(cls).read(data, Context(Location(source), in_file=True))
