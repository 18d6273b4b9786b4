"""Fields that bearings of every kind have, declared once: type, meaning, unit and range."""

from typing import Annotated

from macroslip.input.fields import Positive, Quantity, Text
from macroslip.input.units import (
    CONDUCTIVITY,
    DENSITY,
    FORCE,
    LENGTH,
    MASS,
    NUMBER,
    PRESSURE,
    SPECIFIC_HEAT,
)

Name = Annotated[str, Text("short name of the bearing, used in results", line=True)]
Title = Annotated[str, Text("one line that describes the bearing", may_be_empty=True, line=True)]
BoreDiameter = Annotated[float | None, Positive("bore diameter of the inner ring", LENGTH, 10)]
OutsideDiameter = Annotated[
    float | None, Positive("outside diameter of the outer ring", LENGTH, 10)
]
FatigueLoadLimit = Annotated[
    float | None, Positive("fatigue load limit C_u, in some catalogues P_u", FORCE, 1e9)
]
Mass = Annotated[float | None, Positive("mass of the bearing", MASS, 1e6)]
RollersPerRow = Annotated[
    int, Quantity("number of rollers in each row", NUMBER, 3, 500, whole=True)
]
RollerDensity = Annotated[float, Quantity("density of the rollers", DENSITY, 500, 25000)]
CompositeRoughness = Annotated[
    float, Positive("composite RMS roughness of roller and raceway", LENGTH, 1e-4)
]
Hardness = Annotated[
    float,
    Quantity("Vickers hardness of the softer surface, as a pressure", PRESSURE, 1e8, 1e11),
]
CageYoungsModulus = Annotated[float, Quantity("Young's modulus of the cage", PRESSURE, 1e8, 1e12)]
CagePoissonRatio = Annotated[
    float, Quantity("Poisson ratio of the cage", NUMBER, 0, 0.5, below=True)
]
ThermalConductivity = Annotated[
    float | None, Positive("thermal conductivity of rollers and raceways", CONDUCTIVITY, 1000)
]
SpecificHeat = Annotated[
    float | None, Positive("specific heat of rollers and raceways", SPECIFIC_HEAT, 10000)
]
