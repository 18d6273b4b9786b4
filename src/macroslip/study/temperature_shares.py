"""Shares of time at each temperature of the oil, at each wind speed and in events."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from macroslip.constants import ZERO_CELSIUS
from macroslip.errors import InputError
from macroslip.input.fields import Context, Form, Quantity
from macroslip.input.units import TEMPERATURE
from macroslip.scada.bins import JointShares

#: Beginnings of the names of events in which the turbine does not produce.
STANDING = ("idle", "parked")


@dataclass(frozen=True)
class TemperatureShares:
    """Share of the time at each temperature, of bins of wind speed and of events."""

    temperatures: np.ndarray  #: Shape (n,) [K]
    #: By the middle of a bin of wind speed: shares, shape (n,), together 1.
    by_wind: Mapping[float, np.ndarray]
    standing: np.ndarray  #: The same of events in which the rotor idles or is parked
    turning: np.ndarray  #: And of all other events
    lasting: np.ndarray  #: And of the whole time, production and standing
    is_measured: bool  #: Whether it comes from a sensor, whose extremes may lie beside the runs

    @classmethod
    def measured(cls, joint: JointShares) -> TemperatureShares:
        """The shares of a measured year.

        A bin of wind speed without a row has the temperatures of the nearest one that has some.
        Events have the temperatures of idle rows where the rotor stands, else the mean one of rows
        in which it turns.
        """
        mean = joint.mean_turning + joint.oil_offset
        temperatures = np.append(joint.oil_temperatures, mean)
        of_bins = joint.turning.sum(axis=1)
        known = np.flatnonzero(of_bins > 0.0)
        by_wind = {}
        for centre in joint.wind.tolist():
            distance = np.abs(joint.wind[known] - centre)
            nearest = known[np.argmin(distance)]
            shares = joint.turning[nearest] / of_bins[nearest]
            by_wind[centre] = np.append(shares, 0.0)
        at_mean = np.zeros(temperatures.size)
        at_mean[-1] = 1.0
        idle = joint.idle.sum()
        standing = at_mean
        if idle > 0.0:
            standing = np.append(joint.idle / idle, 0.0)
        of_temperatures = joint.turning.sum(axis=0) + joint.idle
        lasting = np.append(of_temperatures, 0.0)
        return cls(temperatures, by_wind, standing, at_mean, lasting, True)

    @classmethod
    def from_wind(
        cls, by_wind: Mapping[float, float], likely: Sequence[float]
    ) -> TemperatureShares:
        """One temperature [K] for each wind speed; events have the mean by how likely each is."""
        total = sum(likely)
        if not total > 0.0:
            raise InputError(
                "the wind speeds with a temperature have no probability at all",
                where="weights.temperature.by_wind",
            )
        weight = np.array(likely) / total
        of_bins = np.array(list(by_wind.values()))
        mean = float(weight @ of_bins)
        temperatures = np.append(of_bins, mean)
        unit = np.eye(temperatures.size)
        at_mean = unit[-1]
        rows = {centre: unit[number] for number, centre in enumerate(by_wind)}
        return cls(temperatures, rows, at_mean, at_mean, np.append(weight, 0.0), False)

    def at(self, production: float, standing: float) -> TemperatureShares:
        """A copy with one temperature of production and one of standing [K] at all winds."""
        unit = np.eye(2)
        return TemperatureShares(
            np.array([production, standing]),
            dict.fromkeys(self.by_wind, unit[0]),
            unit[1],
            unit[0],
            unit[0],
            True,
        )

    def warmer(self, by: float) -> TemperatureShares:
        """A copy with all temperatures raised by a difference [K]."""
        return replace(self, temperatures=self.temperatures + by)

    def of_wind(self, centre: float, width: float) -> np.ndarray:
        """Shares of a bin of wind speed, shape (n,); InputError if there are none."""
        for known, shares in self.by_wind.items():
            if abs(known - centre) < 1e-6 * width:
                return shares
        raise InputError(
            f"no temperature is given for the bin at {centre:g}",
            where="weights.temperature.by_wind",
            allowed=", ".join(f"{known:g}" for known in self.by_wind),
            remedy="Give one for each bin of wind speed of the study.",
        )

    def of_event(self, name: str) -> np.ndarray:
        """Shares of an event, shape (n,)."""
        return self.standing if name.startswith(STANDING) else self.turning


@dataclass(frozen=True)
class ByWind(Form):
    """Temperature of the oil by wind speed."""

    form = "a section such as {4: 27 degC, 6: 29 degC}, a wind speed for each bin"

    def read(self, value: Any, context: Context) -> dict[float, float]:
        """Read every temperature to SI."""
        if not isinstance(value, Mapping) or not value:
            raise self.wrong(value)
        speeds = [_number(speed) for speed in value]
        if not np.isfinite(speeds).all():
            raise self.wrong(list(value))
        coldest = ZERO_CELSIUS - 60.0
        warmest = ZERO_CELSIUS + 150.0
        quantity = Quantity(self.about, TEMPERATURE, coldest, warmest)
        oils = [float(quantity.read(at, context) or 0.0) for at in value.values()]
        return dict(zip(speeds, oils, strict=True))


def _number(key: object) -> float:
    """A key as a number, which is text in the JSON of a study's folder; NaN for anything else."""
    try:
        return float(str(key))
    except ValueError:
        return np.nan


@dataclass(frozen=True)
class MeasuredYear(Form):
    """A file that describes the means of a turbine, or the shares that a study keeps of them."""

    form = "a file, such as scada.yaml, that macroslip scada init writes"

    def read(self, value: Any, context: Context) -> str | JointShares:
        """A path, or the shares that were made of the means."""
        if isinstance(value, JointShares) or (isinstance(value, str) and value):
            return value
        if isinstance(value, Mapping) and value.keys() == JointShares.KEYS:
            return JointShares.from_content(value)
        raise self.wrong(value)

    def json(self) -> dict[str, Any]:
        """A path."""
        return {"type": "string"}
