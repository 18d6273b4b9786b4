"""A lubricant, and how it fills the bearing."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, Self

from pydantic import Field

from macroslip.catalogue import Provenance, Record
from macroslip.catalogue.source import Source
from macroslip.catalogue.units import (
    CONDUCTIVITY,
    DENSITY,
    INVERSE_PRESSURE,
    INVERSE_TEMPERATURE,
    NUMBER,
    PRESSURE,
    TEMPERATURE,
    VISCOSITY,
)
from macroslip.errors import InputError

INLET_TEMPERATURE_SPAN = 30.0
"""Largest change of inlet temperature [K] over which one exponential describes the viscosity."""


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

    limiting_shear: Annotated[
        float | None, NUMBER, Field(gt=0, le=0.5, description="limiting shear stress / pressure of the film")
    ] = None
    eyring_stress: Annotated[
        float | None, PRESSURE, Field(ge=1e4, le=1e9, description="Eyring stress, at which shear thinning sets in")
    ] = None
    boundary_friction: Annotated[
        float | None, NUMBER, Field(ge=0, le=1, description="friction coefficient where asperities carry the load")
    ] = None
    starvation: Annotated[
        float | None, NUMBER, Field(gt=0, le=1, description="film thickness / film thickness of a flooded contact")
    ] = None

    def at_inlet(self, temperature: float) -> Self:
        """Give the lubricant at another inlet temperature, by eta0 exp(-beta (T - T0)); nothing else changes.

        For sensitivity studies: one exponential follows a mineral or PAO oil only near the temperature it was fitted
        at. For VG 460 (46 mm2/s at 100 degC) it differs from the ASTM D341 chart by 4 % at a change of 10 K, 13 % at
        20 K and 24 to 28 % at 30 K. Pressure-viscosity coefficient and limiting shear fall with temperature too; give
        them by `replace` where that matters.

        Parameters
        ----------
        temperature : float
            Inlet temperature T [K], within 30 K of the lubricant's own.

        Returns
        -------
        Lubricant
            Its viscosity has the tag D, its inlet temperature the tag U.

        Raises
        ------
        InputError
            If the temperature is too far away, or no number within the range of inlet temperatures.

        Examples
        --------
        >>> warm = Lubricant.read("vg460-pao").at_inlet(318.15)
        >>> round(warm.viscosity, 4), warm.provenance["viscosity"].tag
        (0.3085, 'D')
        """
        # Checks that it is a number and a possible inlet temperature.
        moved = self.replace(inlet_temperature=temperature)
        change = moved.inlet_temperature - self.inlet_temperature
        if abs(change) > INLET_TEMPERATURE_SPAN:
            raise InputError(
                f"the inlet temperature {temperature:g} K is {abs(change):g} K from that of the lubricant's viscosity",
                where=f"lubricant {self.name}",
                allowed=f"{self.inlet_temperature - INLET_TEMPERATURE_SPAN:g} K to "
                f"{self.inlet_temperature + INLET_TEMPERATURE_SPAN:g} K",
                remedy="Use a lubricant file with the viscosity at that temperature.",
            )
        viscosity = self.viscosity * math.exp(-self.temperature_viscosity * change)
        note = (
            f"from {self.viscosity:g} Pa s at {self.inlet_temperature:g} K "
            f"by exp(-{self.temperature_viscosity:g}/K * {change:g} K)"
        )
        provenance = dict(moved.provenance) | {"viscosity": Provenance(viscosity, "Pa s", "D", note)}
        values = {key: getattr(moved, key) for key in type(self).model_fields} | {"viscosity": viscosity}
        record = type(self).__new__(type(self))
        record._fill(values, provenance, Source())
        return record
