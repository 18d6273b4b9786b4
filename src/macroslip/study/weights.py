"""Probability of each wind speed, and the runs of a study that represent it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from macroslip.errors import InputError
from macroslip.input.fields import Quantity, Text
from macroslip.input.section import input_section
from macroslip.input.units import NUMBER

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from numpy.typing import ArrayLike

    from macroslip.study.loads_list import Load

#: A year [s], of 365.25 days.
YEAR = 365.25 * 86400.0


@dataclass(frozen=True)
class Weibull:
    """Weibull distribution of the wind speed.

    Parameters
    ----------
    scale : float
        A [m/s], above 0.
    shape : float
        k [1], above 0; 2 is a Rayleigh distribution.

    Raises
    ------
    InputError
        For values that are not above 0.

    Notes
    -----
    F(v) = 1 − exp(−(v/A)^k), and a bin from a to b has the probability F(b) − F(a): IEC 61400-12-1 and every handbook
    of wind energy.

    Examples
    --------
    >>> round(Weibull(9.5, 2.0).probability(12.0, 1.0 * 2.0), 4)  # 11 to 13 m/s
    0.1079
    """

    scale: float
    shape: float

    def __post_init__(self) -> None:
        for name in ("scale", "shape"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise InputError(f"the {name} of the Weibull distribution is {value!r}", allowed="a number above 0")

    def probability(self, centre: float, width: float) -> float:
        """Probability of the bin of this centre and width [m/s]."""
        from scipy.stats import weibull_min

        low, high = weibull_min.sf([centre - 0.5 * width, centre + 0.5 * width], self.shape, scale=self.scale)
        return float(low - high)


@dataclass(frozen=True)
class Given:
    """Probability of each bin.

    Parameters
    ----------
    probabilities : mapping of float to float
        By the centre of the bin [unit of the field]; 0 or above, together at most 1.

    Raises
    ------
    InputError
    """

    probabilities: Mapping[float, float]

    def __post_init__(self) -> None:
        values = list(self.probabilities.values())
        if not values or not all(math.isfinite(value) and value >= 0.0 for value in values) or sum(values) > 1.0 + 1e-6:
            raise InputError(f"the probabilities are {values!r:.200}", allowed="numbers from 0, together at most 1")

    def probability(self, centre: float, width: float) -> float:
        """Probability of the bin of this centre.

        Raises
        ------
        InputError
            If none is given for it.
        """
        for given, probability in self.probabilities.items():
            if abs(given - centre) < 1e-6 * width:
                return probability
        known = ", ".join(f"{given:g}" for given in self.probabilities)
        raise InputError(
            f"no probability is given for the bin at {centre:g}",
            allowed=known,
            remedy="Add it, with 0 if it is to be left out, or choose another width.",
        )


Weights = Weibull | Given


@input_section("weights", "what each load history counts in the mean friction power, for temperature: balance")
class Weighting:
    """How much each load history counts, by the probability of its wind speed, which the histories of a bin share."""

    field: Annotated[str, Text("label of the loads to sort into bins")] = "wind_speed"
    width: Annotated[float, Quantity("width of a bin, in the unit of the field", NUMBER, 0.0, above=True)] = 2.0
    scale: Annotated[
        float, Quantity("scale of the Weibull distribution, in the unit of the field", NUMBER, 0.0, above=True)
    ]
    shape: Annotated[float, Quantity("shape of the Weibull distribution", NUMBER, 0.0, above=True)]

    def of(self, loads: Sequence[Load]) -> list[float]:
        """Weight of each load history [1], together 1.

        Raises
        ------
        InputError
            If loads have no such label, or it is no number.

        Examples
        --------
        >>> from macroslip.study.loads_list import Load
        >>> loads = [Load(name, {"wind_speed": speed}) for name, speed in (("a", 8.0), ("b", 8.0), ("c", 12.0))]
        >>> [round(one, 3) for one in Weighting(scale=9.5, shape=2.0).of(loads)]
        [0.308, 0.308, 0.384]
        """
        known = [load.fields.get(self.field) for load in loads]
        values = [value for value in known if isinstance(value, int | float)]
        wrong = [load.name for load, value in zip(loads, known, strict=True) if not isinstance(value, int | float)]
        if wrong:
            raise InputError(
                f"the loads {wrong[0]} have no number as '{self.field}'",
                where="weights.field",
                allowed=", ".join(loads[0].fields) or "a field in the names of the load files",
            )
        bins = bin_numbers(values, self.width).tolist()
        weibull = Weibull(self.scale, self.shape)
        shares = [weibull.probability(one * self.width, self.width) / bins.count(one) for one in bins]
        return [share / sum(shares) for share in shares]


def bin_numbers(values: ArrayLike, width: float) -> np.ndarray:
    """Number of the bin of each value; bin k reaches from (k − ½) to (k + ½) widths, its lower edge included.

    Examples
    --------
    >>> bin_numbers([10.9, 11.0, 12.9, 13.0], 2.0).tolist()
    [5.0, 6.0, 6.0, 7.0]
    """
    return np.floor(np.asarray(values, dtype=float) / width + 0.5)


@dataclass(frozen=True)
class Binning:
    """The runs of a study by group and bin."""

    #: Labels of each group: runs that differ in more than loads and seeds are not pooled.
    groups: pd.DataFrame
    #: Group and bin of each run, shape (runs,).
    group: np.ndarray
    bin: np.ndarray
    #: Shape (bins,), in the unit of the field, as the width.
    centres: np.ndarray
    width: float
    field: str

    def coordinates(self, study: xr.Dataset, *, bins: bool = True) -> dict[str, Any]:
        """Coordinates of a dataset over `group` and `bin`."""
        found: dict[Any, Any] = {
            name: (
                "group",
                column.to_numpy(dtype=object if column.dtype.kind not in "biuf" else None),
                dict(study[name].attrs),
            )
            for name, column in self.groups.items()
        }
        if bins:
            units = study[self.field].attrs["units"]
            about = {"units": units, "long_name": f"centre of the bin of {self.field}, {self.width:g} {units} wide"}
            found["bin"] = ("bin", self.centres, about)
        return found

    def means(self, values: Iterable[ArrayLike]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Mean of the values of each run in each cell, over runs without NaN; numbers of these and of the others.

        Values are taken one run after the other, so that a large study need not fit into memory.

        Returns
        -------
        ndarray, shape (groups, bins, ...)
            Means; NaN in a cell without runs.
        ndarray, ndarray, shape (groups, bins)
            Number of runs in the mean, and of runs left out.
        """
        shape = len(self.groups), self.centres.size
        used, left_out = np.zeros(shape), np.zeros(shape)
        total = np.zeros(shape)
        for cell, value in zip(zip(self.group, self.bin, strict=True), map(np.asarray, values), strict=True):
            if total.ndim == 2 and value.ndim:
                total = np.zeros((*shape, *value.shape))
            if np.isfinite(value).all():
                total[cell] += value
                used[cell] += 1
            else:
                left_out[cell] += 1
        with np.errstate(invalid="ignore"):
            return total / used.reshape(*shape, *[1] * (total.ndim - 2)), used, left_out

    def probabilities(self, weights: Weights) -> np.ndarray:
        """Probability of each bin, shape (bins,)."""
        return np.array([weights.probability(float(centre), self.width) for centre in self.centres])


def weighted(values: np.ndarray, probability: np.ndarray) -> np.ndarray:
    """Sum of values (groups, bins, ...) over bins by their probability; a bin of no weight may be NaN."""
    some = probability > 0.0
    return np.tensordot(probability[some], values[:, some], axes=(0, 1))


def binned(study: xr.Dataset, field: str, width: float, by: Sequence[str] = ()) -> Binning:
    """Sort the runs of a study into groups and bins.

    A bin is centred on a multiple of its width. A group has one bearing, lubricant, model and set of parameters; other
    labels, such as seeds, are pooled unless they are named in `by`.

    Parameters
    ----------
    study : xarray.Dataset
        From `open_study`.
    field : str
        Label to sort by, a number: `wind_speed`.
    width : float
        Of a bin [unit of the field], above 0.
    by : sequence of str
        Further labels that separate groups: `turbulence`.

    Raises
    ------
    InputError
        If there is no such label, or it is no number.
    """
    import pandas as pd

    labels = [name for name in study.coords if study[name].dims == ("case",) and name not in _NO_LABELS]
    for name in (field, *by):
        if name not in labels:
            raise InputError(f"the study has no label '{name}'", allowed=", ".join(map(str, labels)))
    if study[field].dtype.kind not in "if":
        remedy = "Read it as one: {" + field + ":g} in the pattern."
        raise InputError(f"the label '{field}' is not a number", remedy=remedy)
    if not (math.isfinite(width) and width > 0.0):
        raise InputError(f"the width of the bins is {width!r}", allowed="a number above 0")
    separate = list(dict.fromkeys([*_CHOICES, *(name for name in labels if "." in str(name)), *by]))
    labels_of_runs = pd.DataFrame({name: study[name].values for name in separate})
    centres, places = np.unique(bin_numbers(study[field].values, width), return_inverse=True)
    return Binning(
        groups=labels_of_runs.drop_duplicates(ignore_index=True),
        # A parameter that a run leaves as it is in the base case is NaN, and the same in all such runs.
        group=labels_of_runs.groupby(separate, sort=False, dropna=False).ngroup().to_numpy(),
        centres=centres * width,
        bin=places,
        width=width,
        field=field,
    )


_CHOICES = ("bearing", "lubricant", "model")
_NO_LABELS = ("case", "run", "loads", "outcome", "reason", "key")
