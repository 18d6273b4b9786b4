"""A double-row spherical roller bearing: all its data that the model uses."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, ClassVar

from pydantic import Field

from macroslip.bearing.assembly import misfits
from macroslip.catalogue import Record
from macroslip.catalogue.source import Source
from macroslip.catalogue.units import (
    ANGLE,
    CONDUCTIVITY,
    DENSITY,
    FORCE,
    LENGTH,
    MASS,
    NUMBER,
    PRESSURE,
    SPECIFIC_HEAT,
)
from macroslip.errors import InputError


class Bearing(Record):
    """Data of a double-row spherical roller bearing with identical, mirrored rows.

    Attributes are in SI units (m, N, rad, Pa, kg); `provenance` gives the source of each. Lengths and angles
    have no sign, except the clearance, which is negative for a preloaded bearing.

    Raises
    ------
    InputError
        If a value is missing, out of range, or inconsistent with the others.

    Examples
    --------
    >>> bearing = Bearing.read("skf-240-600-bc")
    >>> bearing.roller_diameter, bearing.provenance["roller_diameter"].tag
    (0.07, 'E')
    >>> bearing.replace(diametral_clearance=1e-4).provenance["diametral_clearance"]
    Provenance(value=0.0001, unit='m', tag='U', note='', range=None)
    """

    noun: ClassVar[str] = "bearing"

    name: str = Field(min_length=1, description="short name of the bearing, used in results")
    title: str = Field(default="", description="one line that describes the bearing")

    bore_diameter: Annotated[
        float | None, LENGTH, Field(gt=0, le=10, description="bore diameter of the inner ring")
    ] = None
    outside_diameter: Annotated[
        float | None, LENGTH, Field(gt=0, le=10, description="outside diameter of the outer ring")
    ] = None
    width: Annotated[float | None, LENGTH, Field(gt=0, le=5, description="width of the bearing")] = None
    dynamic_load_rating: Annotated[
        float | None, FORCE, Field(gt=0, le=1e9, description="basic dynamic radial load rating C")
    ] = None
    static_load_rating: Annotated[
        float | None, FORCE, Field(gt=0, le=1e9, description="basic static radial load rating C0")
    ] = None
    fatigue_load_limit: Annotated[
        float | None, FORCE, Field(gt=0, le=1e9, description="fatigue load limit C_u, in some catalogues P_u")
    ] = None
    axial_factor_e: Annotated[
        float | None, NUMBER, Field(gt=0, le=5, description="ratio e of axial to radial load between Y1 and Y2")
    ] = None
    axial_factor_y1: Annotated[
        float | None, NUMBER, Field(gt=0, le=100, description="axial load factor Y1, at or below e")
    ] = None
    axial_factor_y2: Annotated[
        float | None, NUMBER, Field(gt=0, le=100, description="axial load factor Y2, above e")
    ] = None
    axial_factor_y0: Annotated[float | None, NUMBER, Field(gt=0, le=100, description="static axial load factor Y0")] = (
        None
    )
    mass: Annotated[float | None, MASS, Field(gt=0, le=1e6, description="mass of the bearing")] = None

    rollers_per_row: Annotated[int, NUMBER, Field(ge=3, le=500, description="number of rollers in each row")]
    roller_diameter: Annotated[float, LENGTH, Field(gt=0, le=1, description="largest roller diameter")]
    roller_length: Annotated[float, LENGTH, Field(gt=0, le=2, description="roller length")]
    contact_angle: Annotated[
        float,
        ANGLE,
        Field(ge=0, lt=math.pi / 4, description="angle of the contact normals to the radial plane"),
    ]
    pitch_radius: Annotated[
        float, LENGTH, Field(gt=0, le=5, description="distance of the roller centres from the bearing axis")
    ]
    outer_raceway_radius: Annotated[float, LENGTH, Field(gt=0, le=10, description="radius of the outer raceway sphere")]
    row_offset: Annotated[
        float, LENGTH, Field(ge=0, le=5, description="axial distance of the roller centres from the mid-plane")
    ]
    osculation_inner: Annotated[
        float, NUMBER, Field(gt=0.9, lt=1, description="roller contour radius / contour radius of the inner raceway")
    ]
    osculation_outer: Annotated[
        float, NUMBER, Field(gt=0.9, lt=1, description="roller contour radius / radius of the outer raceway sphere")
    ]
    diametral_clearance: Annotated[
        float, LENGTH, Field(ge=-1e-3, le=5e-3, description="diametral operating clearance, negative for preload")
    ]

    youngs_modulus: Annotated[
        float, PRESSURE, Field(ge=1e9, le=1e12, description="Young's modulus of rollers and raceways")
    ]
    poisson_ratio: Annotated[float, NUMBER, Field(ge=0, lt=0.5, description="Poisson ratio of rollers and raceways")]
    density: Annotated[float, DENSITY, Field(ge=500, le=25000, description="density of the rollers")]
    cage_youngs_modulus: Annotated[float, PRESSURE, Field(ge=1e8, le=1e12, description="Young's modulus of the cage")]
    cage_poisson_ratio: Annotated[float, NUMBER, Field(ge=0, lt=0.5, description="Poisson ratio of the cage")]
    composite_roughness: Annotated[
        float, LENGTH, Field(gt=0, le=1e-4, description="composite RMS roughness of roller and raceway")
    ]
    hardness: Annotated[
        float, PRESSURE, Field(ge=1e8, le=1e11, description="Vickers hardness of the softer surface, as a pressure")
    ]

    thermal_conductivity: Annotated[
        float | None, CONDUCTIVITY, Field(gt=0, le=1000, description="thermal conductivity of rollers and raceways")
    ] = None
    specific_heat: Annotated[
        float | None, SPECIFIC_HEAT, Field(gt=0, le=10000, description="specific heat of rollers and raceways")
    ] = None

    def _inconsistencies(self, source: Source) -> Iterator[InputError]:
        return misfits(self, source)
