"""Probabilities of wind speeds and events, and the runs of a study that stand for each."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import ArrayLike

from macroslip.constants import YEAR
from macroslip.errors import InputError
from macroslip.input.fields import IN_FILE, Context, Form, Positive, Quantity, Text
from macroslip.input.section import MappingOf, form_from, input_section
from macroslip.input.units import CONDUCTANCE, NUMBER, TEMPERATURE
from macroslip.scada.bins import JointShares, bin_centres
from macroslip.scada.reader import Scada
from macroslip.study.labels import (
    CHOICES,
    events_of_runs,
    is_parameter,
    labels_over,
    stored_study,
)
from macroslip.study.loads_list import Load
from macroslip.study.temperature_shares import ByWind, MeasuredYear, TemperatureShares
from macroslip.variables import described

_SCALE = Quantity(
    "scale of the Weibull distribution, in the unit of the field", NUMBER, 0.0, above=True
)
_SHAPE = Quantity("shape of the Weibull distribution", NUMBER, 0.0, above=True)


@input_section("weights.wind.weibull", "Weibull distribution of the wind speed", positional=True)
class Weibull:
    """Weibull distribution of the wind speed, of scale A > 0 [m/s] and shape k > 0 [1].

    K = 2 is a Rayleigh distribution.

    Raises InputError for values that are not above 0.

    F(v) = 1 − exp(−(v/A)^k), and a bin from a to b has the probability F(b) − F(a): IEC 61400-12-1
    and every handbook of wind energy.

    Examples
    --------
    >>> round(Weibull(9.5, 2.0).probability(12.0, 1.0 * 2.0), 4)  # 11 to 13 m/s
    0.1079
    """

    scale: Annotated[float, _SCALE]
    shape: Annotated[float, _SHAPE]

    def probability(self, centre: float, width: float) -> float:
        """Probability of the bin of this centre and width [m/s]."""
        from scipy.stats import weibull_min

        with np.errstate(over="ignore"):  # far beyond the scale, where the probability is 0
            low, high = weibull_min.sf(
                [centre - 0.5 * width, centre + 0.5 * width], self.shape, scale=self.scale
            )
        return float(low - high)


@dataclass(frozen=True)
class BinProbabilities:
    """Probability of each bin by its centre [unit of the field].

    0 or above, together at most 1, else InputError.
    """

    probabilities: Mapping[float, float]

    def __post_init__(self) -> None:
        values = list(self.probabilities.values())
        if (
            not values
            or not all(math.isfinite(value) and value >= 0.0 for value in values)
            or sum(values) > 1.0 + 1e-6
        ):
            raise InputError(
                f"the probabilities are {values!r:.200}",
                allowed="numbers from 0, together at most 1",
            )

    def probability(self, centre: float, width: float) -> float:
        """Probability of the bin of this centre; InputError if none is given."""
        for listed, probability in self.probabilities.items():
            if abs(listed - centre) < 1e-6 * width:
                return probability
        known = ", ".join(f"{listed:g}" for listed in self.probabilities)
        raise InputError(
            f"no probability is given for the bin at {centre:g}",
            allowed=known,
            remedy="Add it, with 0 if it is to be left out, or choose another width.",
        )


#: Wind speeds of the classes of IEC 61400-1: Rayleigh distributions with a mean of 0.2 times the
#: reference wind speed, 50, 42.5 and 37.5 m/s.
IEC_CLASSES = {
    f"IEC {name}": Weibull(scale=0.2 * speed / math.gamma(1.5), shape=2.0)
    for name, speed in (("I", 50.0), ("II", 42.5), ("III", 37.5))
}


@dataclass(frozen=True)
class Rate:
    """Rate of an event: times a year, or hours of a year.

    InputError for numbers below 0.
    """

    number: float
    in_hours: bool = (
        False  #: Whether it is hours, not the number of times that the whole record happens
    )

    def __post_init__(self) -> None:
        if not (math.isfinite(self.number) and self.number >= 0.0):
            raise InputError(f"the rate of an event is {self.number!r}", allowed="a number from 0")

    @classmethod
    def written(cls, text: Any) -> Rate:
        """A rate as a file has it: `300 per year`, `400 h per year`; InputError for anything else.

        Examples
        --------
        >>> Rate.written("300 per year"), Rate.written("0.5 h per year")
        (Rate(number=300.0, in_hours=False), Rate(number=0.5, in_hours=True))
        """
        match = re.fullmatch(r"\s*(\d+\.?\d*(?:[eE][+-]?\d+)?)\s*(h)?\s+per\s+year\s*", str(text))
        if not match:
            raise InputError(
                f"it is {text!r:.100}", allowed="such as '300 per year' or '400 h per year'"
            )
        return cls(float(match[1]), bool(match[2]))

    def share(self, length: float) -> float:
        """Share of all time, of an event whose record is so long [s]."""
        duration = 3600.0 if self.in_hours else length
        return self.number * duration / YEAR


@dataclass(frozen=True)
class Year:
    """A year of wind speeds and events. Events take their time first.

    The distribution of the wind speed holds for the rest.
    """

    wind: Weibull | BinProbabilities
    events: Mapping[str, Rate] = field(
        default_factory=dict
    )  #: By the label `event`; others count nothing


Weights = Weibull | BinProbabilities | Year


@dataclass(frozen=True)
class _WeibullOrClass(Form):
    """Scale and shape, or the name of a class of IEC 61400-1."""

    form = f"a section with the keys scale and shape, or {', '.join(IEC_CLASSES)}"

    def read(self, value: Any, context: Context) -> Weibull:
        """The distribution."""
        if isinstance(value, str) and value in IEC_CLASSES:
            return IEC_CLASSES[value]
        if not isinstance(value, Mapping):
            raise self.wrong(value)
        return form_from(Weibull).read(value, context)

    def json(self) -> dict[str, Any]:
        """A class, or an object."""
        return {"anyOf": [{"enum": list(IEC_CLASSES)}, form_from(Weibull).json()]}


@input_section("weights.wind", "how likely each wind speed is")
class Wind:
    """Distribution of the wind speed."""

    weibull: Annotated[Weibull, _WeibullOrClass("Weibull distribution of the wind speed")]


_RATES = MappingOf(
    "how often each event happens",
    "a section such as {start-8: 300 per year, idle-6: 400 h per year}",
    Annotated[str, Text("rate of the event")],
    lambda _, text: Rate.written(text),
)


@input_section("weights.temperature.balance", "how the bearing loses its heat, at each wind speed")
class LossOfHeat:
    """Heat loss G (T − T_ambient), which sets the oil temperature of each wind-speed bin."""

    conductance: Annotated[float, Positive("heat flow to the surroundings per kelvin", CONDUCTANCE)]
    ambient: Annotated[
        float, Quantity("temperature of the surroundings", TEMPERATURE, 253.15, 363.15)
    ]


@input_section("weights.temperature", "temperature of the oil at each wind speed")
class OilTemperature:
    """Temperature of the oil in each bin of wind speed; of events it is the mean over the year.

    It is given, or each design finds its own by the balance of its heat.
    """

    by_wind: Annotated[
        dict[float, float] | None, ByWind("temperature of the oil by the middle of each bin")
    ] = None
    balance: LossOfHeat | None = None

    def __post_init__(self) -> None:
        if (self.by_wind is None) == (self.balance is None):
            raise InputError(
                "temperatures of the oil are given twice"
                if self.balance
                else "the temperature of the oil is not given",
                allowed="by_wind: {4: 27 degC, 6: 29 degC} or balance: {conductance: 60 W/K, "
                "ambient: 20 degC}",
                remedy="Give one of both.",
            )


@input_section(
    "weights",
    "what each load history counts in a year: wind speeds, which the histories of a bin share, "
    "and events",
)
class Weighting:
    """Weighting of the load histories.

    Scale and shape beside `field` are read as those of `wind.weibull`. A measured year, `scada`,
    stands in place of wind speeds and temperatures.
    """

    field: Annotated[str, Text("label of the loads to sort into bins")] = "wind_speed"
    width: Annotated[
        float, Quantity("width of a bin, in the unit of the field", NUMBER, 0.0, above=True)
    ] = 2.0
    wind: Wind | None = None
    temperature: OilTemperature | None = None
    scada: Annotated[
        str | JointShares | None, MeasuredYear("description of the means of a turbine")
    ] = None
    events: Annotated[dict[str, Any] | None, _RATES] = None
    scale: Annotated[float | None, _SCALE] = None
    shape: Annotated[float | None, _SHAPE] = None

    def __post_init__(self) -> None:
        flat = self.scale is not None, self.shape is not None
        others = ("wind", "temperature", "scale", "shape")
        beside = [name for name in others if getattr(self, name) is not None]
        if self.scada is not None and beside:
            raise InputError(
                f"{' and '.join(beside)} and the measured year scada stand together",
                allowed="scada without wind, temperature, scale and shape",
                remedy="The means of a turbine tell how likely each wind speed is, and how warm.",
            )
        if self.scada is not None:
            return
        is_given_twice = self.wind is not None and any(flat)
        is_missing = self.wind is None and not all(flat)
        if is_given_twice or is_missing:
            raise InputError(
                "the wind speeds are given twice"
                if self.wind
                else "the distribution of the wind speeds is not given",
                allowed="wind: {weibull: {scale: 9.5, shape: 2}} or wind: {weibull: IEC II}",
                remedy="The keys scale and shape, both, may stand in its place.",
            )

    @property
    def year(self) -> Year:
        """Distribution of wind speeds and rates of events of a year."""
        return Year(self._wind, self.events or {})

    @property
    def _wind(self) -> Weibull | BinProbabilities:
        if isinstance(self.scada, JointShares):
            return BinProbabilities(self.scada.wind_shares())
        if self.wind:
            return self.wind.weibull
        scale = float(self.scale or 0.0)
        shape = float(self.shape or 0.0)
        return Weibull(scale=scale, shape=shape)

    @property
    def temperatures(self) -> TemperatureShares | None:
        """Shares of time at each temperature of the oil; None where only runs have these.

        So it is where each bin has the temperature of its balance.
        """
        if isinstance(self.scada, JointShares):
            return TemperatureShares.measured(self.scada)
        if self.temperature is None or self.temperature.by_wind is None:
            return None
        return self.at_each_wind(self.temperature.by_wind)

    def at_each_wind(self, by_wind: Mapping[float, float]) -> TemperatureShares:
        """Shares of one temperature [K] for each bin; events have the mean of these."""
        likely = [self._wind.probability(centre, self.width) for centre in by_wind]
        return TemperatureShares.from_wind(by_wind, likely)

    @property
    def balance(self) -> LossOfHeat | None:
        """Loss of heat from which the temperature of each bin follows; None where it is given."""
        if self.temperature is None:
            return None
        return self.temperature.balance

    def with_measured_year(self, loads: Sequence[Load], folder: Path) -> Weighting:
        """A copy with the means of the turbine read and sorted into the bins of the loads.

        Raises InputError if the means cannot be read; relative paths start at `folder`.
        """
        if not isinstance(self.scada, str):
            return self
        centres = self._bins(loads, {}).centres
        measured = Scada.read(folder / self.scada)
        winds = centres[np.isfinite(centres)]
        joint = JointShares.of(measured, winds, self.width)
        return replace(self, scada=joint)

    def of(self, loads: Sequence[Load]) -> list[float]:
        """Weight of each load history in the mean friction power [1], together 1.

        Events count by the hours that they take; those that are given by their number, seconds
        each, count nothing. Raises InputError if loads have no such label, it is no number, an
        event is unknown, or no wind speed has any probability.

        Examples
        --------
        >>> loads = [Load(name, {"wind_speed": speed}) for name, speed in (("a", 8.0), ("b", 8.0), ("c", 12.0))]
        >>> [round(weight, 3) for weight in Weighting(scale=9.5, shape=2.0).of(loads)]
        [0.308, 0.308, 0.384]
        """
        bins = self._bins(loads, {})
        runs_of_bins = np.bincount(bins.bin)
        share_of_run = bins.probabilities(self.year) / runs_of_bins
        shares = share_of_run[bins.bin]
        if shares.sum() <= 0.0:
            raise InputError(
                "no load history has any weight",
                where="weights",
                remedy="Give wind speeds or hours.",
            )
        return (shares / shares.sum()).tolist()

    def check(self, loads: Sequence[Load], lengths: Mapping[str, float]) -> None:
        """Check that the weights go with the load histories of a study.

        Raises InputError as `of`, or if the events take more time than there is.

        Parameters
        ----------
        loads : sequence of Load
            Load histories of the study.
        lengths : mapping
            Length of the record of each event [s]; those without one are taken for no time.
        """
        self.of(loads)
        self._bins(loads, lengths).probabilities(self.year)

    def _bins(self, loads: Sequence[Load], lengths: Mapping[str, float]) -> Bins:
        values = []
        for load in loads:
            value = load.fields.get(self.field)
            number = math.nan
            if isinstance(value, int | float):
                number = float(value)
            if not load.event and not math.isfinite(number):
                raise InputError(
                    f"the loads {load.name} have no number as '{self.field}'",
                    where="weights.field",
                    allowed=", ".join(loads[0].fields) or "a field in the names of the load files",
                )
            values.append(number)
        events = [load.event for load in loads]
        lengths_of_events = dict.fromkeys(events, 0.0) | dict(lengths)
        return Bins.of(values, events, self.width, lengths_of_events)


def stored_weighting(study: xr.Dataset) -> Weighting | None:
    """The weighting in the study file of `open_study`'s dataset; None where there is none."""
    content = stored_study(study).get("weights")
    if content is None:
        return None
    return form_from(Weighting).read(content, IN_FILE)


@dataclass(frozen=True)
class Bins:
    """Wind speeds in bins, each event in one of its own behind them."""

    #: Middles, shape (bins,), in the unit of the field, as the width; NaN for events, and for one
    #: bin of all runs.
    centres: np.ndarray
    width: float
    #: Name of the event, shape (bins,), empty for bins of wind speeds; and how long its record is
    #: [s].
    events: np.ndarray
    lengths: np.ndarray
    #: Bin of each value, shape (values,).
    bin: np.ndarray

    @classmethod
    def of(
        cls, values: ArrayLike, events: Sequence[str], width: float, lengths: Mapping[str, float]
    ) -> Bins:
        """Sort values into bins, those of events by the event.

        Parameters
        ----------
        values : array_like, shape (values,)
            Wind speeds, in the unit of the field; those of events do not count.
        events : sequence of str
            Name of the event of each value, empty for wind speeds.
        width : float
            Width of a bin, in the unit of the field.
        lengths : mapping
            Length of the record of each event [s].
        """
        named = np.asarray(events, dtype=object)
        calm = named == ""
        speeds = np.asarray(values, dtype=float)[calm]
        centres = bin_centres(speeds, width)
        centres, bin_of_value = np.unique(centres, return_inverse=True)
        names = list(dict.fromkeys(named[~calm].tolist()))
        bins = np.empty(named.size, dtype=int)
        bins[calm] = bin_of_value
        numbers = [names.index(event) for event in named[~calm]]
        bins[~calm] = centres.size + np.array(numbers, dtype=int)
        # An event without a result has no length: any weight above 0 makes what it enters NaN.
        lengths_of_bins = [0.0] * centres.size + [lengths[name] for name in names]
        return cls(
            centres=np.concatenate([centres, np.full(len(names), np.nan)]),
            width=width,
            events=np.array([""] * centres.size + names, dtype=object),
            lengths=np.nan_to_num(lengths_of_bins, nan=1.0),
            bin=bins,
        )

    def probabilities(self, weights: Weights) -> np.ndarray:
        """Share of all time of each bin, shape (bins,).

        Raises InputError if an event is unknown, events take more than all time, or no wind speed
        has any probability.
        """
        year = weights if isinstance(weights, Year) else Year(weights)
        known = [name for name in self.events if name]
        if unknown := [name for name in year.events if name not in known]:
            raise InputError(
                f"the weights name the event '{unknown[0]}', "
                "which no loads have as their label 'event'",
                where="weights.events",
                allowed=", ".join(known) or "none: no loads are events",
            )
        shares = np.zeros(len(self.events))
        for number, event in enumerate(self.events):
            rate = year.events.get(event)
            if rate:
                shares[number] = rate.share(self.lengths[number])
        if shares.sum() > 1.0:
            hours = shares.sum() * YEAR / 3600.0
            fault = f"the events take {hours:.6g} hours of a year"
            raise InputError(
                fault, where="weights.events", allowed=f"up to {YEAR / 3600.0:g} hours"
            )
        windy = self.events == ""
        wind_centres = self.centres[windy]
        wind = np.array([year.wind.probability(float(at), self.width) for at in wind_centres])
        # What the wind speeds share has to be a probability that sums in floating-point numbers can
        # still tell from 0.
        if wind.size and not wind.sum() > _LEAST:
            first, last = wind_centres[[0, -1]]
            raise InputError(
                f"the wind speeds from {first:g} to {last:g} have no probability at all",
                where="weights.wind",
                allowed="a distribution with some of its probability there",
                remedy="Check scale and shape, and that both have the unit of the label.",
            )
        left = 1.0 - shares.sum()
        shares[windy] = left * wind
        return shares


@dataclass(frozen=True)
class Binning(Bins):
    """The runs of a study by group and bin."""

    #: Labels of each group: runs that differ in more than loads and seeds are not pooled.
    groups: pd.DataFrame
    #: Group of each run, shape (runs,).
    group: np.ndarray
    field: str | None

    def probabilities(self, weights: Weights | None) -> np.ndarray:
        """Share of all time of each bin; without weights one bin has all runs and all time."""
        return np.ones(1) if weights is None else super().probabilities(weights)

    def coordinates(self, study: xr.Dataset, *, bins: bool = True) -> dict[str, Any]:
        """Coordinates of a dataset over `group` and `bin`."""
        coordinates: dict[str, Any] = {}
        for name, column in self.groups.items():
            kind = None if column.dtype.kind in "biuf" else object
            coordinates[str(name)] = (
                "group",
                column.to_numpy(dtype=kind),
                dict(study[str(name)].attrs),
            )
        if bins and self.field is None:
            coordinates["bin"] = ("bin", self.centres, described("1", "all cases alike"))
        elif bins:
            units = study[self.field].attrs["units"]
            about = f"centre of the bin of {self.field}, {self.width:g} {units} wide"
            coordinates["bin"] = ("bin", self.centres, described(units, about))
        if bins and any(self.events):
            coordinates["event"] = (
                "bin",
                self.events,
                described("1", "event in place of a wind speed"),
            )
        return coordinates

    def means(self, values: Iterable[ArrayLike]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Mean of the values of each run in each cell, over runs without NaN.

        Numbers of these and of the others.

        Values are taken one run after the other, so that a large study need not fit into memory.
        Means have the shape (groups, bins, ...), NaN in a cell without runs, and both numbers
        (groups, bins).
        """
        shape = len(self.groups), self.centres.size
        used = np.zeros(shape)
        left_out = np.zeros(shape)
        total = np.zeros(shape)
        cells = zip(self.group, self.bin, strict=True)
        for cell, value in zip(cells, map(np.asarray, values), strict=True):
            if total.ndim == 2 and value.ndim:
                total = np.zeros((*shape, *value.shape))
            if np.isfinite(value).all():
                total[cell] += value
                used[cell] += 1
            else:
                left_out[cell] += 1
        with np.errstate(invalid="ignore"):
            inner = [1] * (total.ndim - 2)
            counts = used.reshape(*shape, *inner)
            means = total / counts
            return means, used, left_out

    def spreads(self, values: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Mean ⟨x⟩ of the values of each row of rollers in each cell, runs, and ⟨x²⟩ − ⟨x⟩².

        Values have the shape (runs, rows), means and spreads (groups, bins, rows), and the numbers
        of runs (groups, bins, 1). The variance of a mean of n runs is the spread over n − 1.
        """
        mean, runs, _ = self.means(values)
        square, _, _ = self.means(values**2)
        variance = np.maximum(square - mean**2, 0.0)
        return mean, runs[:, :, None], variance


def weighted(values: np.ndarray, probability: np.ndarray) -> np.ndarray:
    """Sum of values (groups, bins, ...) over bins by their probability.

    A bin of no weight may be NaN.
    """
    some = probability > 0.0
    used = probability[some]
    return np.tensordot(used, values[:, some], axes=(0, 1))


def binned(
    study: xr.Dataset, field: str | None, width: float = 2.0, by: Sequence[str] = ()
) -> Binning:
    """Sort the runs of a study into groups and bins.

    A bin is centred on a multiple of its width; runs whose label `event` is not empty have one of
    their own. A group has one bearing, lubricant, model and set of parameters; other labels, such
    as seeds, are pooled.

    Parameters
    ----------
    study : xarray.Dataset
        From `macroslip.study.reader.open_study`.
    field : str, optional
        Label to sort by, a number; None: one bin holds all runs.
    width : float
        Width of a bin, in the unit of the field, above 0.
    by : sequence of str
        Further labels that separate groups, as `turbulence`.

    Raises
    ------
    InputError
        If there is no such label, or the field is no number.
    """
    labels = [name for name in labels_over(study) if name not in _NO_LABELS]
    asked = [(extra, "by") for extra in by]
    if field:
        asked = [(field, "field"), *asked]
    for name, option in asked:
        if name not in labels:
            raise InputError(
                f"the study has no label '{name}'",
                allowed=", ".join(labels),
                remedy=f"Name one of these labels: --{option}, in Python {option}=.",
            )
    if field and study[field].dtype.kind not in "if":
        remedy = "Read it as one: {" + field + ":g} in the pattern."
        raise InputError(f"the label '{field}' is not a number", remedy=remedy)
    if not (math.isfinite(width) and width > 0.0):
        raise InputError(f"the width of the bins is {width!r}", allowed="a number above 0")
    parameters = [name for name in labels if is_parameter(study, name)]
    separate = list(dict.fromkeys([*CHOICES, *parameters, *by]))
    labels_of_runs = pd.DataFrame({name: study[name].values for name in separate})
    count = study.sizes["case"]
    events = [""] * count
    if field:
        events = events_of_runs(study).tolist()
    lengths = {}
    if any(events):
        lengths = study["window_length"].to_series().groupby(events).mean()
    if field is None:
        bins = Bins(
            np.array([np.nan]),
            width,
            np.array([""], dtype=object),
            np.zeros(1),
            np.zeros(count, dtype=int),
        )
    else:
        bins = Bins.of(study[field].values, events, width, lengths)
    groups = labels_of_runs.drop_duplicates(ignore_index=True)
    # A parameter that a run leaves as it is in the base case is NaN, and the same in all such runs.
    by_design = labels_of_runs.groupby(separate, sort=False, dropna=False)
    group = by_design.ngroup().to_numpy()
    return Binning(**vars(bins), groups=groups, group=group, field=field)


_NO_LABELS = ("case", "run", "loads", "outcome", "reason", "key")
#: Probability of all wind speeds of a study below which it counts as none: 1e-9 of a year is 30 ms.
_LEAST = 1e-9
