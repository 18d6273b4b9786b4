"""The input of a result, from its attributes."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, NamedTuple

from macroslip.bearing import Bearing
from macroslip.bearing.geometry import AXIAL_SIGNS
from macroslip.errors import InputError
from macroslip.lubricant import Lubricant
from macroslip.mechanisms import Laws
from macroslip.roller.model import RollerModel, roller_model

if TYPE_CHECKING:
    import xarray as xr


class RunInput(NamedTuple):
    """The input of a result, from its attributes."""

    bearing: Bearing
    models: dict[str, RollerModel]
    settings: dict[str, Any]


def run_input(result: xr.Dataset) -> RunInput:
    """Bearing, rollers and settings a result was computed with, from its attribute `input`.

    Parameters
    ----------
    result : xarray.Dataset
        From `macroslip.simulate`, or read from its netCDF file.

    Raises
    ------
    InputError
        If the dataset has no input.
    """
    try:
        settings = json.loads(result.attrs["input"])
        bearing = Bearing.from_dict(settings["bearing"])
        lubricant = Lubricant.from_dict(settings["lubricant"])
        if settings.get("temperature") is not None:
            lubricant = lubricant.at(settings["temperature"])
        forces = settings["forces"]
        laws = Laws(**{name: choice for name, choice in settings["laws"].items() if name != "model"})
        models = {
            row: roller_model(
                bearing,
                lubricant,
                AXIAL_SIGNS[row],
                tilt=settings["drivetrain"]["tilt"],
                gravity=forces["gravity"],
                drag=forces["drag"],
                laws=laws,
            )
            for row in result.row.values.tolist()
        }
    except (KeyError, TypeError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(
            "the dataset does not say what it was computed with",
            where="attribute input",
            allowed="a result of macroslip run or macroslip.simulate",
        ) from None
    return RunInput(bearing, models, settings)
