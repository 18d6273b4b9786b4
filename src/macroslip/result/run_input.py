"""The input of a result, from its attributes."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property
from typing import Any

import xarray as xr

from macroslip.bearing import Bearing
from macroslip.bearing.geometry import AXIAL_SIGNS
from macroslip.contact.mechanisms import Laws
from macroslip.errors import InputError
from macroslip.lubricant import Lubricant
from macroslip.roller.model import RollerModel, roller_model


class RunInput:
    """The input of a result: its bearing, its rollers, and `settings`, its attribute `input`."""

    def __init__(self, settings: dict[str, Any], rows: list[str]):
        self.settings = settings
        self.bearing = Bearing.from_dict(settings["bearing"])
        self._rows = rows

    @cached_property
    def models(self) -> dict[str, RollerModel]:
        """The rollers by row."""
        with _complete():
            lubricant = Lubricant.from_dict(self.settings["lubricant"])
            if self.settings.get("temperature") is not None:
                lubricant = lubricant.at(self.settings["temperature"])
            if self.settings.get("oil_gap") is not None:
                lubricant = lubricant.supplied(self.settings["oil_gap"])
            laws = Laws(
                **{
                    name: choice
                    for name, choice in self.settings["laws"].items()
                    if name != "model"
                }
            )
            forces = {name: self.settings["forces"][name] for name in ("gravity", "drag")}
            tilt = self.settings["drivetrain"]["tilt"]
            return {
                row: roller_model(
                    self.bearing, lubricant, AXIAL_SIGNS[row], tilt=tilt, laws=laws, **forces
                )
                for row in self._rows
            }


def run_input(result: xr.Dataset) -> RunInput:
    """Bearing, rollers and settings a result was computed with, from its attribute `input`.

    Raises InputError if the dataset has no input.
    """
    with _complete():
        return RunInput(json.loads(result.attrs["input"]), result.row.values.tolist())


def stored_settings(result: xr.Dataset) -> dict[str, Any]:
    """The case of a result as its attribute `input` holds it; empty where there is none."""
    try:
        found = json.loads(result.attrs["input"])
    except (KeyError, TypeError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}


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
