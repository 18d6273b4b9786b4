"""Values of the base case that are estimates, the ranges they may have, and how a case takes others."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass

from macroslip.bearing import Bearing
from macroslip.case.case import Case


@dataclass(frozen=True, slots=True, kw_only=True)
class UncertainValue:
    """A value that is known to lie in a range, evenly likely in it.

    Parameters
    ----------
    name : str
        As it stands in tables.
    unit : str
        Of `low` and `high`.
    low, high : float
        Ends of the range.
    tag : str
        Provenance of the base value: E estimate, R literature from memory, P paper, as in the catalogue.
    reason : str
        Where the range comes from.
    """

    name: str
    unit: str
    low: float
    high: float
    tag: str
    reason: str


CLEARANCE, OSCULATION, DIAMETER, LENGTH = "diametral clearance", "osculation", "roller diameter", "roller length"
ROUGHNESS, HARDNESS, CAGE = "composite roughness", "hardness", "cage modulus"
LIMITING, BOUNDARY, STARVATION, TEMPERATURE = "limiting shear", "boundary friction", "starvation", "inlet temperature"
HUB, GEARBOX = "hub to bearing", "bearing to gearbox"

VALUES = (
    UncertainValue(
        name=CLEARANCE,
        unit="mm",
        low=0.0,
        high=0.4,
        tag="E",
        reason="0.31 to 0.48 mm unmounted (catalogue); fit and warm inner ring take some or all of it",
    ),
    UncertainValue(
        name=OSCULATION,
        unit="1",
        low=0.97,
        high=0.99,
        tag="E",
        reason="usual for spherical roller bearings; at 0.99 the largest contacts just reach the roller's ends",
    ),
    UncertainValue(
        name=DIAMETER,
        unit="mm",
        low=67.0,
        high=73.0,
        tag="E",
        reason="back-calculated from the load ratings, which fix it within about 4 %; pitch radius and row "
        "offset follow the sphere of the outer raceway",
    ),
    UncertainValue(
        name=LENGTH,
        unit="mm",
        low=101.0,
        high=111.0,
        tag="E",
        reason="as the diameter, within 5 %; two rows and the guide ring have to fit 272 mm",
    ),
    UncertainValue(name=ROUGHNESS, unit="µm", low=0.15, high=0.5, tag="E", reason="honed and run in, to ground"),
    UncertainValue(name=HARDNESS, unit="GPa", low=6.5, high=8.0, tag="E", reason="58 to 64 HRC"),
    UncertainValue(name=CAGE, unit="GPa", low=110.0, high=210.0, tag="E", reason="grey iron to steel"),
    UncertainValue(name=LIMITING, unit="1", low=0.035, high=0.05, tag="R", reason="reported for PAO"),
    UncertainValue(
        name=BOUNDARY, unit="1", low=0.08, high=0.12, tag="E", reason="usual for steel with lubricant additives"
    ),
    UncertainValue(
        name=STARVATION,
        unit="1",
        low=0.5,
        high=1.0,
        tag="R",
        reason="0.7 is reported for a bearing of this size; 1 is flooded",
    ),
    UncertainValue(
        name=TEMPERATURE,
        unit="°C",
        low=20.0,
        high=50.0,
        tag="P",
        reason="the paper's 35 °C and 15 K either way, cold to warm; viscosity, its coefficients, density and Eyring stress follow",
    ),
    UncertainValue(
        name=HUB,
        unit="m",
        low=1.0,
        high=1.5,
        tag="E",
        reason="the turbine's model gives no bearing position; about 20 % either way",
    ),
    UncertainValue(name=GEARBOX, unit="m", low=1.8, high=2.6, tag="E", reason="as before"),
)


def with_values(case: Case, values: Mapping[str, float]) -> Case:
    """The case with other values.

    Parameters
    ----------
    case : Case
    values : mapping
        Value by name of `VALUES`, in the unit given there; all of them.

    Raises
    ------
    InputError
        For values that do not make a bearing, lubricant or drivetrain.

    Notes
    -----
    Osculation is that of both raceways, and the cage pocket conforms with it. With the roller's diameter the pitch
    radius (R − r) cos α and the row offset (R − r) sin α change, R being the radius of the outer raceway's sphere; α
    and the number of rollers stay.

    Examples
    --------
    >>> from macroslip import HubLoads
    >>> middle = {one.name: 0.5 * (one.low + one.high) for one in VALUES}
    >>> other = with_values(Case(loads=HubLoads.bundled("14B")), middle)
    >>> other.lubricant.limiting_shear, round(other.bearing.pitch_radius, 4)
    (0.0425, 0.3727)
    """
    bearing, oil = case.bearing, case.lubricant
    diameter = 1e-3 * values[DIAMETER]
    centre = bearing.outer_raceway_radius - 0.5 * diameter
    bearing = _rounded(
        bearing,
        diametral_clearance=1e-3 * values[CLEARANCE],
        osculation_inner=values[OSCULATION],
        osculation_outer=values[OSCULATION],
        roller_diameter=diameter,
        pitch_radius=centre * math.cos(bearing.contact_angle),
        row_offset=centre * math.sin(bearing.contact_angle),
        roller_length=1e-3 * values[LENGTH],
        composite_roughness=1e-6 * values[ROUGHNESS],
        hardness=1e9 * values[HARDNESS],
        cage_youngs_modulus=1e9 * values[CAGE],
    )
    oil = oil.at(values[TEMPERATURE] + 273.15).replace(
        limiting_shear=values[LIMITING], boundary_friction=values[BOUNDARY], starvation=values[STARVATION]
    )
    drivetrain = dataclasses.replace(case.drivetrain, hub_to_bearing=values[HUB], bearing_to_gearbox=values[GEARBOX])
    return dataclasses.replace(case, bearing=bearing, lubricant=oil, drivetrain=drivetrain)


def _rounded(bearing: Bearing, **values: float) -> Bearing:
    """The bearing with these values, free of the round-off of unit conversions."""
    return bearing.replace(**{name: float(f"{value:.12g}") for name, value in values.items()})
