"""Values of the base case that are estimates, and the ranges they may have."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class UncertainValue:
    """A value that is known to lie in a range, evenly likely in it.

    Parameters
    ----------
    name : str
        As in tables.
    key : str
        Key under which the study file varies it.
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
    key: str
    unit: str
    low: float
    high: float
    tag: str
    reason: str


VALUES = (
    UncertainValue(
        name="diametral clearance",
        key="bearing.diametral_clearance",
        unit="mm",
        low=0.0,
        high=0.4,
        tag="E",
        reason="0.31 to 0.48 mm unmounted (catalogue); fit and warm inner ring take some or all of it",
    ),
    UncertainValue(
        name="osculation",
        key="bearing.osculation_outer",
        unit="1",
        low=0.97,
        high=0.99,
        tag="E",
        reason="usual for spherical roller bearings; at 0.99 the largest contacts just reach the roller's ends",
    ),
    UncertainValue(
        name="roller diameter",
        key="bearing.roller_diameter",
        unit="mm",
        low=67.0,
        high=73.0,
        tag="E",
        reason="back-calculated from the load ratings, which fix it within about 4 %; pitch radius and row "
        "offset follow the sphere of the outer raceway",
    ),
    UncertainValue(
        name="roller length",
        key="bearing.roller_length",
        unit="mm",
        low=101.0,
        high=111.0,
        tag="E",
        reason="as the diameter, within 5 %; two rows and the guide ring have to fit 272 mm",
    ),
    UncertainValue(
        name="composite roughness",
        key="bearing.composite_roughness",
        unit="µm",
        low=0.15,
        high=0.5,
        tag="E",
        reason="honed and run in, to ground",
    ),
    UncertainValue(
        name="hardness", key="bearing.hardness", unit="GPa", low=6.5, high=8.0, tag="E", reason="58 to 64 HRC"
    ),
    UncertainValue(
        name="cage modulus",
        key="bearing.cage_youngs_modulus",
        unit="GPa",
        low=110.0,
        high=210.0,
        tag="E",
        reason="grey iron to steel",
    ),
    UncertainValue(
        name="limiting shear",
        key="lubricant.limiting_shear",
        unit="1",
        low=0.035,
        high=0.05,
        tag="R",
        reason="reported for PAO",
    ),
    UncertainValue(
        name="boundary friction",
        key="lubricant.boundary_friction",
        unit="1",
        low=0.08,
        high=0.12,
        tag="E",
        reason="usual for steel with lubricant additives",
    ),
    UncertainValue(
        name="starvation",
        key="lubricant.starvation",
        unit="1",
        low=0.5,
        high=1.0,
        tag="R",
        reason="0.7 is reported for a bearing of this size; 1 is flooded",
    ),
    UncertainValue(
        name="inlet temperature",
        key="lubricant.at",
        unit="°C",
        low=20.0,
        high=50.0,
        tag="P",
        reason="the paper's 35 °C and 15 K either way, cold to warm; viscosity, its coefficients, density "
        "and Eyring stress follow",
    ),
    UncertainValue(
        name="hub to bearing",
        key="drivetrain.hub_to_bearing",
        unit="m",
        low=1.0,
        high=1.5,
        tag="E",
        reason="the turbine's model gives no bearing position; about 20 % either way",
    ),
    UncertainValue(
        name="bearing to gearbox",
        key="drivetrain.bearing_to_gearbox",
        unit="m",
        low=1.8,
        high=2.6,
        tag="E",
        reason="as before",
    ),
)
