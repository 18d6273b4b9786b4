"""Friction torque of a bearing over wind speed, speed of the rotor, temperature and supply of oil.

Simulated cases give it at a few winds and temperatures; ten-minute means need it everywhere.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from os import PathLike

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import PchipInterpolator

from macroslip.arrays import FloatArray
from macroslip.bearing import Bearing
from macroslip.constants import MOST_BEYOND, ZERO_CELSIUS
from macroslip.errors import InputError
from macroslip.lubricant import Lubricant

#: Columns of a table, with unit and meaning.
COLUMNS: Mapping[str, tuple[str, str]] = {
    "supply": ("1", "supply of oil: skf, flooded, or film over flooded film"),
    "wind_speed": ("m/s", "mean wind speed"),
    "temperature": ("K", "temperature of the oil"),
    "shaft_speed": ("rad/s", "mean speed of the shaft"),
    "torque": ("N m", "friction torque of the whole bearing"),
}
#: Winds and temperatures that a supply needs at least: a curve through two is a straight line.
LEAST_WINDS = 2
LEAST_TEMPERATURES = 3
#: Share of the speed of a case down to which the torque goes with a power of the speed.
SLOWEST = 0.1
_REMEDY = (
    "Vary lubricant.at in the study over the temperatures of the bearing, with weights left out."
)


@dataclass(frozen=True, eq=False)
class FrictionTable:
    """Friction torque of a bearing at mean wind speeds, temperatures and supplies of oil.

    Between its entries

        M(w, n, T) = M_w(T) (n/n_w)^e(T)

    with ln M_w and ln n_w, the speed of the case, linear over the wind w, and ln M_w over the
    temperature T by PCHIP; beyond the winds and temperatures of the table its ends are held.

    Parameters
    ----------
    entries : DataFrame
        The columns of `COLUMNS`, a line a supply, wind and temperature. InputError if one is
        missing or not positive, or if there are fewer than two winds or three temperatures.
    speed_exponents : mapping of str to Series
        e [-] over the temperature [K] by supply, rising temperatures; its ends are held.
    loads : DataFrame, optional
        Mean load on the bearing, `radial_load` and `axial_load` [N], over `wind_speed` [m/s].
    bearing : Bearing, optional
    lubricant : Lubricant, optional
        For what handbooks say of the same bearing.

    Examples
    --------
    >>> winds, temperatures = np.meshgrid([6.0, 12.0], [278.15, 298.15, 318.15])
    >>> entries = pd.DataFrame({"supply": "skf", "wind_speed": winds.ravel(),
    ...     "temperature": temperatures.ravel(), "shaft_speed": winds.ravel() / 6.0,
    ...     "torque": np.exp(12.0 - 0.02 * temperatures.ravel())})
    >>> table = FrictionTable(entries, {"skf": pd.Series([0.5], [300.0])})
    >>> [round(float(one)) for one in table.torque("skf", 6.0, [1.0, 0.25], 298.15)]
    [419, 209]
    """

    entries: pd.DataFrame
    speed_exponents: Mapping[str, pd.Series]
    loads: pd.DataFrame | None = None
    bearing: Bearing | None = None
    lubricant: Lubricant | None = None
    source: str = "friction table"  #: Where it comes from, for messages
    notes: tuple[str, ...] = ()  #: What is doubtful or missing, a sentence each

    def __post_init__(self) -> None:
        missing = [name for name in COLUMNS if name not in self.entries]
        if missing:
            raise InputError(
                f"the columns {', '.join(missing)} are missing",
                where=self.source,
                allowed=", ".join(COLUMNS),
            )
        for supply in self.supplies:
            self._check(supply)

    def _check(self, supply: str) -> None:
        grid = self._grid(supply)
        if grid.isna().any(axis=None):
            wind, temperature = next(
                iter(grid.stack(future_stack=True).isna().loc[lambda s: s].index)
            )
            raise InputError(
                f"there is no torque for the supply {supply} at {wind:g} m/s and "
                f"{temperature - ZERO_CELSIUS:g} degC",
                where=self.source,
                allowed="every wind speed at every temperature",
                remedy="Complete the study with --resume, or leave the case out of it.",
            )
        if not (grid.to_numpy() > 0.0).all():
            raise InputError("a torque is not positive", where=self.source, allowed="above 0 N m")
        if grid.shape[0] < LEAST_WINDS:
            raise InputError(
                f"the study has {grid.shape[0]} mean wind speed",
                where=self.source,
                allowed=f"{LEAST_WINDS} and more, from weak to strong wind",
            )
        if grid.shape[1] < LEAST_TEMPERATURES:
            raise InputError(
                f"the study has {grid.shape[1]} temperatures of the oil",
                where=self.source,
                allowed=f"{LEAST_TEMPERATURES} and more",
                remedy=_REMEDY,
            )
        if supply not in self.speed_exponents:
            raise InputError(
                f"the supply {supply} has no exponent of speed",
                where=self.source,
                allowed=", ".join(self.speed_exponents),
            )

    @property
    def supplies(self) -> tuple[str, ...]:
        """Supplies of oil in the order of the table."""
        return tuple(dict.fromkeys(self.entries["supply"]))

    @cached_property
    def temperatures(self) -> FloatArray:
        """Temperatures of the table [K], rising."""
        return np.unique(self.entries["temperature"].to_numpy(float))

    def _grid(self, supply: str, value: str = "torque") -> pd.DataFrame:
        """A value over wind (rows) and temperature (columns)."""
        is_supply = self.entries["supply"] == supply
        entries = self.entries[is_supply]
        return entries.pivot_table(value, "wind_speed", "temperature", dropna=False)

    @cached_property
    def _curves(self) -> dict[str, tuple[NDArray, NDArray, PchipInterpolator]]:
        """Winds [m/s], ln of the cases' speeds, and ln of the torque over temperature, by supply."""
        curves = {}
        for supply in self.supplies:
            grid = self._grid(supply)
            shaft_speeds = self._grid(supply, "shaft_speed")
            speeds = shaft_speeds.mean(axis=1).to_numpy()
            temperatures = grid.columns.to_numpy(float)
            winds = grid.index.to_numpy(float)
            torque = PchipInterpolator(temperatures, np.log(grid.to_numpy()), axis=1)
            curves[supply] = (winds, np.log(speeds), torque)
        return curves

    def check_span(self, temperature: ArrayLike) -> None:
        """Refuse oil that is more than 5 K colder or warmer than the table.

        Parameters
        ----------
        temperature : array_like
            Temperatures of the oil [K].

        Raises
        ------
        InputError
        """
        coldest = float(np.min(temperature))
        warmest = float(np.max(temperature))
        low = float(self.temperatures[0])
        high = float(self.temperatures[-1])
        is_colder = coldest < low - MOST_BEYOND
        is_warmer = warmest > high + MOST_BEYOND
        if is_colder or is_warmer:
            raise InputError(
                f"the oil is at {coldest - ZERO_CELSIUS:.1f} to {warmest - ZERO_CELSIUS:.1f} degC, "
                f"the study at {low - ZERO_CELSIUS:g} to {high - ZERO_CELSIUS:g} degC",
                where=self.source,
                allowed=f"data up to {MOST_BEYOND:g} K beyond the temperatures of the study",
                remedy=_REMEDY,
            )

    def torque(
        self, supply: str, wind_speed: ArrayLike, shaft_speed: ArrayLike, temperature: ArrayLike
    ) -> FloatArray:
        """Friction torque of the whole bearing against its rotation [N m].

        Parameters
        ----------
        supply : str
            One of `supplies`.
        wind_speed, shaft_speed, temperature : array_like
            Mean wind speed [m/s], speed of the shaft [rad/s], not negative, and temperature of the
            oil [K]; shapes that broadcast.

        Returns
        -------
        ndarray
            Without a sign; below a tenth of the case's speed that of a tenth.
        """
        winds, log_speeds, log_torque = self._curves[supply]
        wind, speed, oil = np.broadcast_arrays(
            *(np.asarray(values, dtype=float) for values in (wind_speed, shaft_speed, temperature))
        )
        held = np.clip(oil, log_torque.x[0], log_torque.x[-1])
        position = np.interp(wind, winds, np.arange(winds.size))
        below = np.minimum(position.astype(int), max(winds.size - 2, 0))
        above = np.minimum(below + 1, winds.size - 1)
        part = position - below
        # Many rows have the same temperature, of which the curve of a wind has one value.
        known, inverse = np.unique(held, return_inverse=True)
        inverse = inverse.reshape(held.shape)
        at_winds = log_torque(known)
        lower = at_winds[below, inverse]
        upper = at_winds[above, inverse]
        log_case = (1.0 - part) * log_speeds[below] + part * log_speeds[above]
        exponents = self.speed_exponents[supply]
        exponent = np.interp(held, exponents.index.to_numpy(float), exponents.to_numpy(float))
        # Towards standstill no law of powers holds, and the exponent may be negative.
        ratio = np.maximum(speed / np.exp(log_case), SLOWEST)
        log_power = (1.0 - part) * lower + part * upper
        return np.exp(log_power) * ratio**exponent

    def power(
        self, supply: str, wind_speed: ArrayLike, shaft_speed: ArrayLike, temperature: ArrayLike
    ) -> FloatArray:
        """Friction power M n [W].

        Parameters
        ----------
        supply, wind_speed, shaft_speed, temperature
            As of `torque`.

        Returns
        -------
        ndarray
            M n [W], of the shape that the arguments have together.
        """
        torque = self.torque(supply, wind_speed, shaft_speed, temperature)
        return torque * np.asarray(shaft_speed, dtype=float)

    def write_csv(self, path: str | PathLike[str]) -> None:
        """Write the entries as a CSV table, the temperature in °C and torques to 0.01 N m."""
        celsius = self.entries["temperature"] - ZERO_CELSIUS
        shown = self.entries.assign(
            temperature=celsius.round(6),
            shaft_speed=self.entries["shaft_speed"].round(5),
            torque=self.entries["torque"].round(2),
        )
        headings = _headings()
        shown.to_csv(path, index=False, columns=list(headings), header=list(headings.values()))


def read_entries(path: str | PathLike[str]) -> pd.DataFrame:
    """Entries of a table that `FrictionTable.write_csv` has written."""
    entries = pd.read_csv(path, dtype={"supply": str})
    names = {heading: name for name, heading in _headings().items()}
    entries.columns = [names[heading] for heading in entries.columns]
    entries["temperature"] += ZERO_CELSIUS
    return entries


def _headings() -> dict[str, str]:
    """Headings of a CSV table by column: a table of temperatures is in degC."""
    units = {name: unit for name, (unit, _) in COLUMNS.items()}
    units["temperature"] = "degC"
    headings = {}
    for name, unit in units.items():
        headings[name] = name if unit == "1" else f"{name} [{unit}]"
    return headings
