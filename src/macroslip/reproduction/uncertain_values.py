"""Values of the base case that are estimates, and the ranges they may have."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, kw_only=True)
class UncertainValue:
    """A value that is known to lie in a range, evenly likely in it; or a choice between two laws, as likely each.

    Parameters
    ----------
    name : str
        As in tables.
    key : str
        Key under which the study file varies it.
    unit : str
        Of `low` and `high`.
    low, high : float
        Ends of the range; 0 and 1 of a choice.
    tag : str
        Provenance of the base value: E estimate, R literature from memory, P paper, D derived, as in the catalogue; C a
        choice.
    reason : str
        Where the range comes from.
    log : bool
        Whether the logarithm is evenly likely: ranges over more than a factor of five.
    whole : bool
        Whether it is a count.
    choices : tuple of str
        What 0 and 1 stand for.

    Examples
    --------
    >>> viscosity = UncertainValue(name="", key="", unit="Pa s", low=0.1, high=10.0, tag="E", reason="", log=True)
    >>> round(viscosity.at(0.5), 12), float(viscosity.place(1.0))
    (1.0, 0.5)
    """

    name: str
    key: str
    unit: str
    low: float
    high: float
    tag: str
    reason: str
    log: bool = False
    whole: bool = False
    choices: tuple[str, ...] = ()

    def at(self, place: float) -> Any:
        """The value at a place from 0 to 1 in its range, in its unit; of a choice its word."""
        if self.choices:
            return self.choices[int(place * len(self.choices))]
        if self.whole:
            return int(self.low) + int(place * (self.high - self.low + 1.0))
        if self.log:
            return self.low * (self.high / self.low) ** place
        return self.low + place * (self.high - self.low)

    def place(self, values: NDArray[np.float64] | float) -> NDArray[np.float64]:
        """Places from 0 to 1 of values; of counts and choices the middle of the places that give them."""
        given = np.asarray(values, dtype=float)
        if self.choices:
            return (given + 0.5) / len(self.choices)
        if self.whole:
            return (given - self.low + 0.5) / (self.high - self.low + 1.0)
        if self.log:
            return np.log(given / self.low) / math.log(self.high / self.low)
        return (given - self.low) / (self.high - self.low)

    @property
    def range_text(self) -> str:
        """The range in words."""
        if self.choices:
            return " or ".join(self.choices)
        return f"{self.low:g} to {self.high:g}" + ("" if self.unit == "1" else f" {self.unit}")


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
        name="Eyring stress",
        key="lubricant.eyring_stress",
        unit="MPa",
        low=3.3,
        high=8.7,
        tag="R",
        reason="both are reported for PAO near 1 GPa; used where the law is Eyring's",
    ),
    UncertainValue(
        name="law of shear",
        key="laws.rheology",
        unit="1",
        low=0.0,
        high=1.0,
        tag="C",
        reason="traction measured on mineral oils and PAO has Eyring's form; that of polyglycols has a limit",
        choices=("limiting-shear", "eyring"),
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
        name="viscosity at 35 °C",
        key="lubricant.viscosity",
        unit="Pa s",
        low=0.24,
        high=0.80,
        tag="D",
        reason="base oils of main-bearing greases: VG 220 to VG 680",
    ),
    UncertainValue(
        name="pressure-viscosity",
        key="lubricant.pressure_viscosity",
        unit="1/GPa",
        low=16.5,
        high=22.0,
        tag="P",
        reason="17 by Gold's law for a PAO, 21 in the paper; oils of a family scatter by more than that",
    ),
    UncertainValue(
        name="temperature-viscosity",
        key="lubricant.temperature_viscosity",
        unit="1/K",
        low=0.050,
        high=0.075,
        tag="P",
        reason="slope at 35 °C: PAO of viscosity index 170 to mineral oil of index 90",
    ),
    UncertainValue(
        name="fullness of gaps",
        key="lubricant.fullness",
        unit="1",
        low=0.03,
        high=1.0,
        tag="E",
        reason="how full the gaps of unloaded rollers are is not known; 1 is flooded",
        log=True,
    ),
    UncertainValue(
        name="inlet film",
        key="lubricant.inlet_film",
        unit="1",
        low=5.0,
        high=1000.0,
        tag="E",
        reason="how full inlets are is not known; 1000 is flooded",
        log=True,
    ),
    UncertainValue(
        name="contact angle",
        key="bearing.contact_angle",
        unit="°",
        low=10.0,
        high=13.0,
        tag="D",
        reason="from the axial factors, which are rounded; pitch radius and row offset follow the sphere, and above "
        "about 11.8° rollers of this length need more than the catalogue's width, which is left out of account",
    ),
    UncertainValue(
        name="rollers of a row",
        key="bearing.rollers_per_row",
        unit="1",
        low=26.0,
        high=30.0,
        tag="E",
        reason="back-calculated; 30 of the largest diameter just fit, with their cage",
        whole=True,
    ),
    UncertainValue(
        name="shaft mass",
        key="drivetrain.shaft_mass",
        unit="kg",
        low=0.0,
        high=6000.0,
        tag="E",
        reason="none in the paper, 3,026 kg by a scaling law for this rotor; at 1.73 m behind the hub",
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

#: Units of the ranges in those of a study file.
UNITS = {
    "mm": ("m", 1e-3), "µm": ("m", 1e-6), "GPa": ("Pa", 1e9), "MPa": ("Pa", 1e6), "1/GPa": ("1/Pa", 1e-9),
    "°": ("rad", math.pi / 180.0), "1": ("", 1.0), "m": ("m", 1.0), "kg": ("kg", 1.0), "Pa s": ("Pa s", 1.0),
    "1/K": ("1/K", 1.0), "°C": ("K", 1.0),
}  # fmt: skip


def in_file_units(value: float, unit: str) -> float:
    """A value in the unit that a study file has for it.

    Examples
    --------
    >>> in_file_units(35.0, "°C"), in_file_units(70.0, "mm")
    (308.15, 0.07)
    """
    return value + 273.15 if unit == "°C" else value * UNITS[unit][1]
