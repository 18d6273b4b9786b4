"""A lubricant, and how it fills the bearing."""

from __future__ import annotations

from typing import Annotated, ClassVar

from pydantic import Field

from macroslip.catalogue import Record
from macroslip.catalogue.units import (
    CONDUCTIVITY,
    DENSITY,
    INVERSE_PRESSURE,
    INVERSE_TEMPERATURE,
    NUMBER,
    TEMPERATURE,
    VISCOSITY,
)


class Lubricant(Record):
    """Data of a lubricant at the inlet of the contacts, and of its drag on the rollers.

    Attributes are in SI units (K, Pa s, 1/Pa, 1/K, W/(m K), kg/m3); `provenance` says for each where it comes from.

    Raises
    ------
    InputError
        If a value is missing or out of range.

    Examples
    --------
    >>> lubricant = Lubricant.read("vg460-pao")
    >>> lubricant.inlet_temperature, lubricant.viscosity, lubricant.pressure_viscosity
    (308.15, 0.54, 2.1e-08)
    """

    noun: ClassVar[str] = "lubricant"

    name: str = Field(min_length=1, description="short name of the lubricant, used in results")
    title: str = Field(default="", description="one line that says what lubricant it is")

    inlet_temperature: Annotated[
        float, TEMPERATURE, Field(ge=200, le=500, description="temperature at the inlet of the contacts")
    ]
    viscosity: Annotated[
        float, VISCOSITY, Field(gt=0, le=1000, description="dynamic viscosity at inlet temperature, ambient pressure")
    ]
    pressure_viscosity: Annotated[
        float, INVERSE_PRESSURE, Field(gt=0, le=1e-7, description="Barus pressure-viscosity coefficient")
    ]
    temperature_viscosity: Annotated[
        float,
        INVERSE_TEMPERATURE,
        Field(gt=0, le=1, description="temperature-viscosity coefficient beta in exp(-beta * temperature rise)"),
    ]
    thermal_conductivity: Annotated[float, CONDUCTIVITY, Field(gt=0, le=10, description="thermal conductivity")]
    density: Annotated[float, DENSITY, Field(ge=100, le=5000, description="density of the lubricant")]
    fill_factor: Annotated[
        float, NUMBER, Field(ge=0, le=1, description="share of the space between the rollers that is filled, for drag")
    ]
    drag_coefficient: Annotated[
        float, NUMBER, Field(ge=0, le=100, description="drag coefficient of a roller moving through the lubricant")
    ]
