"""A study: load histories × bearings × lubricants × models × parameters, and its runs one by one."""

from __future__ import annotations

import hashlib
import itertools
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from macroslip.input.record import Record
from macroslip.study.loads_list import Load, LoadList
from macroslip.study.settings import Setting

if TYPE_CHECKING:
    from macroslip.case.parts import Heat
    from macroslip.study.weights import Weighting

#: Key of the temperature of the oil.
TEMPERATURE = "temperature"
_GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0


@dataclass(frozen=True)
class Run:
    """One run of a study.

    Parameters
    ----------
    load : Load
    bearing, lubricant, model : str
        Names within the study.
    settings : sequence of Setting
        Values of the parameters that vary.
    """

    load: Load
    bearing: str
    lubricant: str
    model: str
    settings: Sequence[Setting]

    @property
    def group(self) -> str:
        """What runs under different loads have in common: a hash of everything but loads and temperature."""
        labels = [self.bearing, self.lubricant, self.model]
        parameters = sorted((one.key, one.text) for one in self.settings if one.key != TEMPERATURE)
        return hashlib.sha256(json.dumps([labels, parameters]).encode()).hexdigest()[:32]

    @property
    def name(self) -> str:
        """Hash of what distinguishes this run from the others of its study: 32 hexadecimal digits."""
        labels = [self.load.name, self.bearing, self.lubricant, self.model]
        parameters = sorted((setting.key, setting.text) for setting in self.settings)
        return hashlib.sha256(json.dumps([labels, parameters]).encode()).hexdigest()[:32]

    @property
    def labels(self) -> dict[str, Any]:
        """Loads, fields, bearing, lubricant, model, and the parameters by key."""
        choices = {"loads": self.load.name, "bearing": self.bearing, "lubricant": self.lubricant, "model": self.model}
        return choices | dict(self.load.fields) | {setting.key: setting.value for setting in self.settings}


@dataclass(frozen=True)
class Study:
    """Content of a study file, checked.

    Parameters
    ----------
    title : str
    folder : Path
        Where relative paths of load files start.
    case : mapping
        Base case: keys of a case file, of `loads` only start and end.
    cut : mapping
        Keywords `start` and `end` [s] of the reader of loads.
    loads : LoadList
    bearings, lubricants : mapping of str to Record
        By the name the study has for them; empty: that of the base case.
    models : mapping of str to settings
    variations : sequence of settings
        Of every combination of parameters.
    parameters : mapping of str to str
        Units of the parameters that vary, by key.
    cycles : bool
        Whether to count the cycles of the bearing's load.
    keep : sequence of str, optional
        Variables of a result to store; None: all.
    content : mapping
        The study file as plain data, for the record.
    heat : Heat, optional
        How the bearing loses its heat, if the temperature is to balance; None: it is known.
    weights : Weighting, optional
        What each load history counts in the mean friction power of the balance; None: all alike.
    temperatures : mapping of str to float
        Temperature [K] of the oil by `Run.group`, once it is balanced.
    """

    title: str
    folder: Path
    case: Mapping[str, Any]
    cut: Mapping[str, float]
    loads: LoadList
    bearings: Mapping[str, Record]
    lubricants: Mapping[str, Record]
    models: Mapping[str, Sequence[Setting]]
    variations: Sequence[Sequence[Setting]]
    parameters: Mapping[str, str]
    cycles: bool = False
    keep: Sequence[str] | None = None
    content: Mapping[str, Any] = field(default_factory=dict)
    heat: Heat | None = None
    weights: Weighting | None = None
    temperatures: Mapping[str, float] = field(default_factory=dict)

    def __len__(self) -> int:
        """Number of runs."""
        choices = (self.loads.loads, self.bearings, self.lubricants, self.models, self.variations)
        return int(all(choices)) and len(choices[0]) * len(choices[1]) * len(choices[2]) * len(choices[3]) * len(
            choices[4]
        )

    def runs(self) -> Iterator[Run]:
        """Yield the runs in the order of the study file, those with the same loads together."""
        return self._runs(self.loads.loads)

    def mixed_runs(self) -> Iterator[Run]:
        """Yield the runs, those with the same loads together, so that any stretch of them is a sample of the whole.

        Load files come sorted by wind speed, and rough wind takes several times as long as calm wind: in their own
        order the rate so far would not hold for the rest.
        """
        # Multiples of the golden ratio are spread evenly over [0, 1), so that neighbours by them lie far apart.
        order = sorted(range(len(self.loads.loads)), key=lambda number: number * _GOLDEN % 1.0)
        return self._runs([self.loads.loads[number] for number in order])

    def _runs(self, loads: Sequence[Load]) -> Iterator[Run]:
        choices = (loads, self.bearings, self.lubricants, self.models, self.variations)
        for load, bearing, lubricant, model, settings in itertools.product(*choices):
            run = Run(load, bearing, lubricant, model, [*self.models[model], *settings])
            if self.temperatures:
                found = Setting(TEMPERATURE, self.temperatures[run.group], "K")
                run = replace(run, settings=[*run.settings, found])
            yield run

    @property
    def labels(self) -> dict[str, tuple[str, str]]:
        """Units and meaning of every label of a run, by name."""
        choices = {name: ("1", f"{name} of the case") for name in ("bearing", "lubricant", "model")}
        fields = {name: (units, "label of the loads") for name, units in self.loads.units.items()}
        parameters = {
            key: (units or "1", "value of the case; NaN: that of the base case")
            for key, units in self.parameters.items()
        }
        if self.temperatures:
            parameters[TEMPERATURE] = ("K", "temperature of the oil at the inlets, of the balance of heat")
        return {"loads": ("1", "loads of the case"), **choices, **fields, **parameters}
