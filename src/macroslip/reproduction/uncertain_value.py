"""A value of the base case that is an estimate: its range, places in it, and its units."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from macroslip.input.units import with_unit


@dataclass(frozen=True, slots=True, kw_only=True)
class UncertainValue:
    """A value of which only a range is known, evenly likely in it; or a choice between laws, each as likely.

    Parameters
    ----------
    name : str
        As in tables.
    key : str
        Key under which the study file varies it.
    unit : str
        Of `low` and `high`.
    low, high : float
        Ends of the range; 0 and 1 of a choice.
    tag : str
        Provenance of the base value: E estimate, R literature from memory, P paper, D derived, as in the catalogue; C a
        choice.
    reason : str
        Where the range comes from.
    log : bool
        Whether the logarithm is evenly likely: ranges over more than a factor of five.
    whole : bool
        Whether it is a count.
    choices : tuple of str
        Meaning of 0 and 1.

    Examples
    --------
    >>> viscosity = UncertainValue(name="", key="", unit="Pa s", low=0.1, high=10.0, tag="E", reason="", log=True)
    >>> round(viscosity.at(0.5), 12), float(viscosity.place(1.0))
    (1.0, 0.5)
    """

    name: str
    key: str
    unit: str
    low: float
    high: float
    tag: str
    reason: str
    log: bool = False
    whole: bool = False
    choices: tuple[str, ...] = ()

    def at(self, place: float) -> Any:
        """The value at a place from 0 to 1 in its range, in its unit; of a choice its name."""
        if self.choices:
            return self.choices[int(place * len(self.choices))]
        if self.whole:
            return int(self.low) + int(place * (self.high - self.low + 1.0))
        if self.log:
            return self.low * (self.high / self.low) ** place
        return self.low + place * (self.high - self.low)

    def place(self, values: NDArray[np.float64] | float) -> NDArray[np.float64]:
        """Places from 0 to 1 of values; of counts and choices the middle of the places that give them."""
        given = np.asarray(values, dtype=float)
        if self.choices:
            return (given + 0.5) / len(self.choices)
        if self.whole:
            return (given - self.low + 0.5) / (self.high - self.low + 1.0)
        if self.log:
            return np.log(given / self.low) / math.log(self.high / self.low)
        return (given - self.low) / (self.high - self.low)

    @property
    def range_text(self) -> str:
        """The range in words."""
        if self.choices:
            return " or ".join(self.choices)
        return with_unit(f"{self.low:g} to {self.high:g}", self.unit)


#: Units of the ranges in those of a study file.
UNITS = {
    "mm": ("m", 1e-3), "µm": ("m", 1e-6), "GPa": ("Pa", 1e9), "MPa": ("Pa", 1e6), "1/GPa": ("1/Pa", 1e-9),
    "°": ("rad", math.pi / 180.0), "1": ("", 1.0), "m": ("m", 1.0), "kg": ("kg", 1.0), "Pa s": ("Pa s", 1.0),
    "1/K": ("1/K", 1.0), "°C": ("K", 1.0),
}  # fmt: skip


def in_file_units(value: float, unit: str) -> float:
    """A value in the unit that a study file has for it.

    Examples
    --------
    >>> in_file_units(35.0, "°C"), in_file_units(70.0, "mm")
    (308.15, 0.07)
    """
    return value + 273.15 if unit == "°C" else value * UNITS[unit][1]
