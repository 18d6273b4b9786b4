"""The values of the base case that are estimates: the range each may have, where that comes from, and a sample of all."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from macroslip import Bearing

#: Seed and number of points of the sample.
SEED, POINTS = 20261122, 128


@dataclass(frozen=True, slots=True)
class UncertainValue:
    """A value of which only a range is known, evenly likely in it; or a choice between laws, each as likely.

    `key` is the study's name for it; `unit` the unit of `low` and `high`; `tag` the provenance of the base value as in the
    catalogue, C for a choice; `kind` "even", "log" (the logarithm is evenly likely), "count" (a whole number) or "choice".

    Examples
    --------
    >>> round(UncertainValue("", "", "Pa s", 0.1, 10.0, "E", "", "log").at(0.5), 12)
    1.0
    """

    name: str
    key: str
    unit: str
    low: float
    high: float
    tag: str
    reason: str
    kind: str = "even"
    choices: tuple[str, ...] = ()

    def at(self, place: float) -> Any:
        """The value at a place from 0 to 1 in its range, in its unit; of a choice its name."""
        if self.kind == "choice":
            return self.choices[int(place * len(self.choices))]
        if self.kind == "count":
            return int(self.low) + int(place * (self.high - self.low + 1.0))
        if self.kind == "log":
            return self.low * (self.high / self.low) ** place
        return self.low + place * (self.high - self.low)

    @property
    def range_text(self) -> str:
        """The range in words."""
        return " or ".join(self.choices) or f"{self.low:g} to {self.high:g} {self.unit}".removesuffix(" 1")


# fmt: off
VALUES = tuple(UncertainValue(*one) for one in (
    ("diametral clearance", "bearing.diametral_clearance", "mm", 0.0, 0.4, "E",
     "0.31 to 0.48 mm unmounted (catalogue); fit and warm inner ring take some or all of it"),
    ("osculation", "bearing.osculation_outer", "1", 0.97, 0.99, "E",
     "usual for spherical roller bearings; at 0.99 the largest contacts just reach the roller's ends"),
    ("roller diameter", "bearing.roller_diameter", "mm", 67.0, 73.0, "E",
     "back-calculated from the load ratings, which fix it within about 4 %; pitch radius and row offset follow the sphere "
     "of the outer raceway"),
    ("roller length", "bearing.roller_length", "mm", 101.0, 111.0, "E",
     "as the diameter, within 5 %; two rows and the guide ring have to fit 272 mm"),
    ("composite roughness", "bearing.composite_roughness", "um", 0.15, 0.5, "E", "honed and run in, to ground"),
    ("hardness", "bearing.hardness", "GPa", 6.5, 8.0, "E", "58 to 64 HRC"),
    ("cage modulus", "bearing.cage_youngs_modulus", "GPa", 110.0, 210.0, "E", "grey iron to steel"),
    ("limiting shear", "lubricant.limiting_shear", "1", 0.035, 0.05, "R", "reported for PAO"),
    ("Eyring stress", "lubricant.eyring_stress", "MPa", 3.3, 8.7, "R",
     "both are reported for PAO near 1 GPa; used where the law is Eyring's"),
    ("law of shear", "laws.rheology", "1", 0.0, 1.0, "C",
     "traction measured on mineral oils and PAO has Eyring's form; polyglycols have a limiting stress",
     "choice", ("limiting-shear", "eyring")),
    ("boundary friction", "lubricant.boundary_friction", "1", 0.08, 0.12, "E", "usual for steel with lubricant additives"),
    ("starvation", "lubricant.starvation", "1", 0.5, 1.0, "R",
     "0.7 is reported for a bearing of this size; 1 is flooded"),
    ("inlet temperature", "lubricant.at", "degC", 20.0, 50.0, "P",
     "the paper's 35 °C and 15 K either way, cold to warm; viscosity, its coefficients, density and Eyring stress follow"),
    ("viscosity at 35 °C", "lubricant.viscosity", "Pa s", 0.24, 0.80, "D",
     "base oils of main-bearing greases: VG 220 to VG 680"),
    ("pressure-viscosity", "lubricant.pressure_viscosity", "1/GPa", 16.5, 22.0, "P",
     "17 by Gold's law for a PAO, 21 in the paper; oils of a family scatter by more than that"),
    ("temperature-viscosity", "lubricant.temperature_viscosity", "1/K", 0.050, 0.075, "P",
     "slope at 35 °C: PAO of viscosity index 170 to mineral oil of index 90"),
    ("fullness of gaps", "lubricant.fullness", "1", 0.03, 1.0, "E",
     "how full the gaps of unloaded rollers are is not known; 1 is flooded", "log"),
    ("inlet film", "lubricant.inlet_film", "1", 5.0, 1000.0, "E",
     "how full inlets are is not known; 1000 is flooded", "log"),
    ("contact angle", "bearing.contact_angle", "deg", 10.0, 13.0, "D",
     "from the axial factors, which are rounded; pitch radius and row offset follow the sphere, and above about 11.8° "
     "rollers of this length need more than the catalogue's width, which is left out of account"),
    ("rollers of a row", "bearing.rollers_per_row", "1", 26.0, 30.0, "E",
     "back-calculated; 30 of the largest diameter just fit, with their cage", "count"),
    ("shaft mass", "drivetrain.shaft_mass", "kg", 0.0, 6000.0, "E",
     "none in the paper, 3,026 kg by a scaling law for this rotor; at 1.73 m behind the hub"),
    ("hub to bearing", "drivetrain.hub_to_bearing", "m", 1.0, 1.5, "E",
     "the turbine's model gives no bearing position; about 20 % either way"),
    ("bearing to gearbox", "drivetrain.bearing_to_gearbox", "m", 1.8, 2.6, "E", "as before"),
))
# fmt: on


def sample_places() -> NDArray[np.float64]:
    """Places from 0 to 1 in the ranges of `VALUES`, shape (points, values): a scrambled Sobol sequence.

    Of counts and choices the middle of the places that give the same.
    """
    from scipy.stats import qmc

    places = qmc.Sobol(len(VALUES), rng=np.random.default_rng(SEED)).random(POINTS)
    for k, one in enumerate(VALUES):
        if one.kind in ("count", "choice"):
            count = one.high - one.low + 1.0
            places[:, k] = (np.floor(places[:, k] * count) + 0.5) / count
    return places


def sample_points() -> list[dict[str, Any]]:
    """Settings of every point of the sample, as a study has them; the first has none, and is the base case.

    Both osculations are the same, and pitch radius and
    row offset follow roller diameter and contact angle: (R − r) cos α and (R − r) sin α, R the outer raceway's radius.

    Examples
    --------
    >>> points = sample_points()
    >>> len(points), points[0], len(points[1]) == len(VALUES) + 4
    (129, {}, True)
    """
    sphere = Bearing.read("skf-240-600-bc").outer_raceway_radius
    points: list[dict[str, Any]] = [{}]
    for places in sample_places():
        drawn = {one.key: one.at(float(place)) for one, place in zip(VALUES, places, strict=True)}
        point = {one.key: drawn[one.key] if one.unit == "1" else f"{drawn[one.key]:.12g} {one.unit}" for one in VALUES}
        centre = sphere - 0.5e-3 * drawn["bearing.roller_diameter"]
        angle = math.radians(drawn["bearing.contact_angle"])
        points.append(
            point
            | {
                "bearing.osculation_inner": point["bearing.osculation_outer"],
                "bearing.pitch_radius": f"{centre * math.cos(angle):.12g} m",
                "bearing.row_offset": f"{centre * math.sin(angle):.12g} m",
                # Above 11.8 degrees the rollers leave the catalogue's width, which enters nothing else here.
                "bearing.width": "0.3 m",
            }
        )
    return points
