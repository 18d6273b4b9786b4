"""Shares of a year over wind speed and temperature of the bearing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from macroslip.constants import ZERO_CELSIUS
from macroslip.errors import InputError
from macroslip.scada.reader import Scada

#: Width of a bin of temperature [K]; bins are centred on its multiples in degC.
TEMPERATURE_WIDTH = 2.5
#: Digits of the shares that a study keeps.
_DIGITS = 15


@dataclass(frozen=True)
class JointShares:
    """Share of the rows with data in each bin of wind speed and temperature; together 1."""

    KEYS: ClassVar[set[str]] = {
        "source", "wind", "temperature", "turning", "idle", "mean_turning", "oil_offset", "hours",
    }  # fmt: skip

    source: str  #: Turbine and period
    wind: np.ndarray  #: Middles of the bins, shape (bins,) [m/s]
    temperature: np.ndarray  #: Of the sensor, middles of the bins, shape (n,) [K]
    turning: np.ndarray  #: Shares of rows in which the rotor turns, shape (bins, n)
    idle: np.ndarray  #: And of all other rows, shape (n,)
    mean_turning: float  #: Mean temperature of the rows in which the rotor turns [K]
    oil_offset: float  #: Temperature of the oil over that of the sensor [K]
    hours: float  #: Hours with data [h]

    @classmethod
    def of(cls, scada: Scada, centres: np.ndarray, width: float) -> JointShares:
        """Sort the rows of a record into bins.

        Parameters
        ----------
        scada : Scada
        centres : ndarray, shape (bins,)
            Middles of the bins of wind speed [m/s]; a row outside them counts in the nearest.
        width : float
            Their width [m/s]; the lower edge is in a bin.

        Raises
        ------
        InputError
            If the rotor turns in no row that is used.
        """
        used = scada.used_rows
        turning = scada.turning[scada.kept].to_numpy()
        if not turning.any():
            raise InputError("the rotor turns in no row that is used", where="rated.rotor_speed")
        centres = np.sort(np.asarray(centres, dtype=float))
        speeds = load_speeds(scada)[turning]
        row = nearest_bins(speeds, centres, width)
        sensor = used["bearing_temperature"].to_numpy()
        degrees = (sensor - ZERO_CELSIUS) / TEMPERATURE_WIDTH
        number = np.floor(degrees + 0.5).astype(int)
        first = number.min()
        shape = (centres.size, number.max() - first + 1)
        counts = np.zeros(shape)
        turning_bins = number[turning] - first
        np.add.at(counts, (row, turning_bins), 1.0)
        idle_bins = number[~turning] - first
        idle = np.bincount(idle_bins, minlength=shape[1]).astype(float)
        first_time = used.index[0]
        last_time = used.index[-1]
        span = f"{first_time:%Y-%m-%d} to {last_time:%Y-%m-%d}"
        bins = first + np.arange(shape[1])
        return cls(
            source=f"{scada.description.turbine or 'turbine'}, {span}",
            wind=centres,
            temperature=ZERO_CELSIUS + TEMPERATURE_WIDTH * bins,
            turning=counts / len(used),
            idle=idle / len(used),
            mean_turning=float(sensor[turning].mean()),
            oil_offset=scada.description.oil_offset,
            hours=scada.hours,
        )

    @property
    def oil_temperatures(self) -> np.ndarray:
        """Middles of the bins of temperature, of the oil in the contacts, shape (n,) [K]."""
        return self.temperature + self.oil_offset

    @property
    def mean_idle(self) -> float:
        """Mean temperature of the sensor while the rotor stands [K]; NaN if it never does."""
        total = self.idle.sum()
        if not total > 0.0:
            return np.nan
        return float(self.idle @ self.temperature / total)

    def wind_shares(self) -> dict[float, float]:
        """Share of the time in which the rotor turns at each wind speed, by the middle of the bin."""
        shares = self.turning.sum(axis=1)
        return dict(zip(self.wind.tolist(), shares.tolist(), strict=True))

    def content(self) -> dict[str, Any]:
        """Plain data for JSON, which `from_content` reads."""
        return {
            "source": self.source,
            "wind": self.wind.tolist(),
            "temperature": self.temperature.tolist(),
            "turning": [[round(share, _DIGITS) for share in row] for row in self.turning.tolist()],
            "idle": [round(share, _DIGITS) for share in self.idle.tolist()],
            "mean_turning": self.mean_turning,
            "oil_offset": self.oil_offset,
            "hours": self.hours,
        }

    @classmethod
    def from_content(cls, content: Mapping[str, Any]) -> JointShares:
        """The shares that `content` has written."""
        arrays = {
            name: np.array(content[name], dtype=float)
            for name in ("wind", "temperature", "turning", "idle")
        }
        return cls(**{**content, **arrays})


def load_speeds(scada: Scada) -> np.ndarray:
    """Wind speed of the rows that are used by which their load is known, shape (rows,) [m/s].

    With `load_by: power` it is w_r (P/P_r)^(1/3) below rated power, with w_r of the study's
    turbine: the wind that gives another rotor the same share of its rated power. At rated power it
    is the measured one, w_r at least.
    """
    used = scada.used_rows
    measured = used["wind_speed"].to_numpy()
    if scada.description.load_by == "wind":
        return measured
    rated = scada.description.rated
    share_of_rated = used["power"].to_numpy() / rated.power
    share = np.clip(share_of_rated, 0.0, None)
    below = rated.wind_speed * np.cbrt(share)
    above = np.maximum(measured, rated.wind_speed)
    return np.where(share < 1.0, below, above)


def bin_centres(values: ArrayLike, width: float) -> np.ndarray:
    """Middle of the bin of each value, a multiple k of the width.

    The bin reaches from (k − ½) to (k + ½) widths, its lower edge included.

    Examples
    --------
    >>> bin_centres([10.9, 11.0, 12.9, 13.0], 2.0).tolist()
    [10.0, 12.0, 12.0, 14.0]
    """
    widths = np.asarray(values, dtype=float) / width
    return np.floor(widths + 0.5) * width


def nearest_bins(values: np.ndarray, centres: np.ndarray, width: float) -> np.ndarray:
    """Number of the bin of each value; outside all bins the nearest one.

    Parameters
    ----------
    values : ndarray, shape (n,)
    centres : ndarray, shape (bins,)
        Middles of the bins, ascending multiples of their width.
    width : float

    Returns
    -------
    ndarray of int, shape (n,)

    Examples
    --------
    >>> nearest_bins(np.array([1.0, 5.0, 40.0]), np.array([4.0, 6.0, 24.0]), 2.0).tolist()
    [0, 1, 2]
    """
    middle = bin_centres(values, width)
    last = max(centres.size - 1, 1)
    above = np.clip(np.searchsorted(centres, middle), 1, last)
    if centres.size == 1:
        return np.zeros(values.size, dtype=int)
    over_lower = middle - centres[above - 1]
    under_upper = centres[above] - middle
    is_lower = over_lower <= under_upper
    return np.where(is_lower, above - 1, above)


def histogram(scada: Scada, width: float = 2.0) -> pd.DataFrame:
    """Shares of a record over wind speed and temperature of the bearing.

    Parameters
    ----------
    scada : Scada
    width : float
        Width of a bin of wind speed [m/s], above 0; bins are centred on its multiples.

    Returns
    -------
    pandas.DataFrame
        A line for each bin with a row of the record: `state`, turning or idle; `wind_speed [m/s]`
        and `bearing_temperature [degC]`, middles of the bins; `share` of the rows with data, which
        add up to 1; and `hours [h]` of the record.
    """
    used = scada.used_rows
    celsius = used["bearing_temperature"].to_numpy() - ZERO_CELSIUS
    table = pd.DataFrame(
        {
            "state": np.where(scada.turning[scada.kept], "turning", "idle"),
            "wind_speed [m/s]": bin_centres(load_speeds(scada), width),
            "bearing_temperature [degC]": bin_centres(celsius, TEMPERATURE_WIDTH),
        }
    )
    shares = table.value_counts(sort=False).sort_index().rename("share")
    counts = shares.reset_index()
    counts["share"] /= len(used)
    counts["hours [h]"] = counts["share"] * scada.hours
    return counts
