"""The input that a result was computed with: bearing, loads and rollers, made once for a result.

A result of `simulate` has the rollers that it was computed with; of one that was read from a file they
are made of its attribute `input`, once.
"""

from __future__ import annotations

import json
import threading
from collections import OrderedDict
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import cached_property
from typing import Any

import xarray as xr

from macroslip.bearing.geometry import AXIAL_SIGNS
from macroslip.bearing.kinds import AnyBearing, bearing_from_dict
from macroslip.contact.mechanisms import Laws
from macroslip.errors import InputError
from macroslip.lubricant import Lubricant
from macroslip.roller.model import RollerModel, roller_model

#: Number of inputs that are kept in memory: those of the results of a page or a comparison.
_MOST = 16
#: Inputs by their text and the rows of the result, the last one used at the end.
_KEPT: OrderedDict[tuple[str, tuple[str, ...]], RunInput] = OrderedDict()
_LOCK = threading.Lock()


class RunInput:
    """The input of a result.

    Parameters
    ----------
    settings : dict
        A case as `Case.as_dict` gives it, with the key `oil_gap` where inlets lack oil.
    rows : tuple of str
        Names of the rows of the result.
    bearing : Bearing or TaperedBearing, optional
        Where it is made already.
    models : dict, optional
        The rollers by row where they are made already.

    Attributes
    ----------
    bearing : Bearing or TaperedBearing

    Raises
    ------
    InputError
        Also from the properties, if the case is not complete.
    """

    def __init__(
        self,
        settings: dict[str, Any],
        rows: tuple[str, ...],
        bearing: AnyBearing | None = None,
        models: dict[str, RollerModel] | None = None,
    ):
        self._settings = settings
        self._rows = rows
        with _complete():
            self.bearing = bearing or bearing_from_dict(settings["bearing"])
        if models is not None:
            self.models = models

    @property
    def start(self) -> float:
        """Time at which the loads begin [s]."""
        with _complete():
            return float(self._settings["loads"]["start"])

    @property
    def is_event(self) -> bool:
        """True if the loads are an event, which stands for itself however short it is."""
        with _complete():
            return bool(self._settings["loads"].get("event"))

    @cached_property
    def models(self) -> dict[str, RollerModel]:
        """The rollers by row."""
        settings = self._settings
        with _complete():
            lubricant = Lubricant.from_dict(settings["lubricant"])
            if settings.get("temperature") is not None:
                lubricant = lubricant.at(settings["temperature"])
            if settings.get("oil_gap") is not None:
                lubricant = lubricant.supplied(settings["oil_gap"])
            choices = {name: value for name, value in settings["laws"].items() if name != "model"}
            options = {
                "tilt": settings["drivetrain"]["tilt"],
                "gravity": settings["forces"]["gravity"],
                "drag": settings["forces"]["drag"],
                "laws": Laws(**choices),
            }
            models = {}
            for row in self._rows:
                sign = AXIAL_SIGNS[row]
                models[row] = roller_model(self.bearing, lubricant, sign, **options)
            return models


def run_input(result: xr.Dataset) -> RunInput:
    """The input of a result of `simulate`, or of one that was read from a file.

    It goes with the attribute `input`: parts of a result, which have the same attribute, share it.

    Raises InputError if the dataset has no input.
    """
    with _complete():
        rows = tuple(result.row.values.tolist())
        text = result.attrs["input"]
        with _LOCK:
            known = _KEPT.get((text, rows)) or RunInput(json.loads(text), rows)
            _keep(text, rows, known)
        return known


def attribute_of_input(
    settings: dict[str, Any], bearing: AnyBearing, models: dict[str, RollerModel]
) -> str:
    """The attribute `input` of a result of `simulate`, whose rollers are kept for `run_input`.

    Parameters
    ----------
    settings : dict
        As for `RunInput`.
    bearing : Bearing or TaperedBearing
        Of the case.
    models : dict
        The rollers by row, as they were simulated.
    """
    text = json.dumps(settings, ensure_ascii=False)
    rows = tuple(models)
    with _LOCK:
        _keep(text, rows, RunInput(settings, rows, bearing, models))
    return text


def _keep(text: str, rows: tuple[str, ...], used: RunInput) -> None:
    """Keep an input as the one used last, and forget those used longest ago."""
    _KEPT[text, rows] = used
    _KEPT.move_to_end((text, rows))
    while len(_KEPT) > _MOST:
        _KEPT.popitem(last=False)


def stored_settings(result: xr.Dataset) -> dict[str, Any]:
    """The case of a result as its attribute `input` holds it; empty where there is none."""
    try:
        settings = json.loads(result.attrs["input"])
    except (KeyError, TypeError, ValueError):
        return {}
    return settings if isinstance(settings, dict) else {}


def window_length(result: xr.Dataset) -> float:
    """Length of the window [s]."""
    end = result.attrs["window_end"]
    start = result.attrs["window_start"]
    return float(end - start)


def leaves(settings: Any, key: str = "") -> Iterator[tuple[str, Any]]:
    """Values in nested sections by keys with dots; a value with its source is one of them.

    Examples
    --------
    >>> list(leaves({"loads": {"samples": 2}, "width": {"value": 0.2, "tag": "V"}}))
    [('loads.samples', 2), ('width', {'value': 0.2, 'tag': 'V'})]
    """
    if isinstance(settings, Mapping) and not {"value", "tag"} <= settings.keys():
        for name, section in settings.items():
            inner_key = f"{key}.{name}" if key else str(name)
            yield from leaves(section, inner_key)
    else:
        yield key, settings


@contextmanager
def _complete() -> Iterator[None]:
    try:
        yield
    except InputError:
        raise
    except (KeyError, TypeError, ValueError):
        fault = "the dataset does not say what it was computed with"
        allowed = "a result of macroslip run or macroslip.simulate"
        raise InputError(fault, where="attribute input", allowed=allowed) from None
