"""Criterion of damage: value, reference, uncertainty, and its sum or extreme over a year."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import xarray as xr

from macroslip.variables import Variable

if TYPE_CHECKING:
    from macroslip.result.criteria.evaluation import Evaluation

#: Values of variables by name.
Values = dict[str, Any]
#: When a variable of a criterion is there: with an orbit in the window, or in an event.
WITH_ORBIT = "where an orbit is complete"
OF_YEAR = "where an orbit is complete, or in an event"


class Threshold(NamedTuple):
    """Threshold of a criterion that a user gives, with its source."""

    value: float  #: In the unit of the criterion
    source: str  #: Where it comes from


class PageColumn(NamedTuple):
    """A column of a table on a page."""

    heading: str  #: With the unit in which it is shown
    factor: float = 1.0  #: To that unit


def _in_brackets(unit: str) -> str:
    return "" if unit == "1" else f" [{unit}]"


@dataclass(frozen=True, kw_only=True)
class Yearly:
    """A number that a study keeps of either row of a run, and its value over a year."""

    run_name: str  #: Name in a study
    run_unit: str
    run_meaning: str
    #: The number over row, of the dataset of criteria and of the result; None where it is not
    #: known.
    of_run: Callable[[xr.Dataset, xr.Dataset], xr.DataArray | None]
    name: str  #: Name in a year
    #: `sum`: run numbers are rates that a year adds up, of both rows; `max`: the same, of the worse
    #: row; `largest`: the largest of any run and row counts.
    drawn: str
    year_unit: str  #: Of the number of a wind speed or event
    year_meaning: str
    unit: str  #: Of the number of a design
    meaning: str
    #: The sum of a design is given over the covered time and this; None: as it is.
    mean_over: float | None = None
    #: True if the number grows by factors over the temperature of the oil, so that its logarithm is
    #: interpolated.
    by_factors: bool = False
    #: True if it follows from the complete orbits of a run: hours without one are left out, and
    #: told.
    needs_orbit: bool = False
    #: Columns of it in the tables of designs and of a year's situations on the page of a study;
    #: by default with meaning and unit.
    design_column: PageColumn | None = None
    year_column: PageColumn | None = None
    #: True if pages begin with it: a figure of its effects in a sample, and its sentences and map
    #: in a year of a turbine.
    leads: bool = False

    @property
    def noun(self) -> str:
        """Its name in a sentence."""
        return self.name.replace("_", " ")

    @property
    def in_designs(self) -> PageColumn:
        """Column in the table of designs."""
        return self.design_column or PageColumn(f"{self.meaning}{_in_brackets(self.unit)}")

    @property
    def in_year(self) -> PageColumn:
        """Column in the table of the situations of a year."""
        return self.year_column or PageColumn(f"{self.noun}{_in_brackets(self.year_unit)}")


@dataclass(frozen=True, kw_only=True)
class Criterion:
    """A criterion of damage: its value, reference and uncertainty, and how it is shown."""

    order: int  #: Lines are in this order
    name: str
    mechanism: str  #: Kind of damage: smearing, friction energy, micropitting, wear
    quantity: str  #: Number that is compared
    unit: str
    #: Its variables in the answer.
    declares: tuple[Variable, ...]
    #: Their values, from which its own follows; none where the result lacks their input.
    variables: Callable[[Evaluation], Values]
    #: Coordinates of their dimensions, beyond row, surface, raceway and station.
    coordinates: Callable[[Evaluation], dict[str, Any]] | None = None
    #: The worst value of either row and any point, of the variables of all criteria [unit]; NaN
    #: where not known.
    value: Callable[[Mapping[str, np.ndarray]], float]
    #: Sentences on what is missing, of the evaluation and the variables of all criteria.
    missing: Callable[[Evaluation, Mapping[str, np.ndarray]], list[str]] | None = None
    reference: float  #: What the value is compared with [unit]; NaN where none could be traced
    #: Least and largest reference that its source leaves open; that itself if not given.
    reference_range: tuple[float, float] | None = None
    compared_with: str  #: Source of the reference
    factor: float  #: The value holds within this factor either way
    reason: str  #: What the factor comes from
    lowest: bool = False  #: True if a value below the reference is bad
    references: tuple[str, ...] = ()  #: Works to cite
    yearly: tuple[Yearly, ...] = ()
    #: False if the answer in words leaves it out, because value and reference are sums over times of
    #: quite another length; it stays in the table.
    in_answer: bool = True

    @property
    def title(self) -> str:
        """Mechanism and quantity, as a table has them."""
        return f"{self.mechanism}: {self.quantity}"

    @property
    def how_sure(self) -> str:
        """Factor and reason."""
        return f"factor {self.factor:g}: {self.reason}"


def largest(values: np.ndarray) -> float:
    """The largest number; NaN where there is none."""
    if not np.isfinite(values).any():
        return np.nan
    return float(np.nanmax(values))


def largest_of(name: str) -> Callable[[Mapping[str, np.ndarray]], float]:
    """The largest number of a variable; NaN where it is missing."""

    def value(variables: Mapping[str, np.ndarray]) -> float:
        if name not in variables:
            return np.nan
        return largest(variables[name])

    return value
