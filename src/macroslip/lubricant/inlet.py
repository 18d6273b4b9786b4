"""Values of the oil at the inlet of the contacts, derived from those of a lubricant file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from macroslip.input.record import Provenance
from macroslip.lubricant.temperature import (
    THERMAL_EXPANSION,
    WaltherLine,
    density_at,
    pressure_viscosity_at,
    roelands_index,
    walther_coefficient,
    walther_line_through,
    walther_line_with_slope,
    walther_viscosity,
)

T15 = 288.15
T40 = 313.15
T100 = 373.15
"""Temperatures [K] at which makers give density and viscosities."""


class Inlet(NamedTuple):
    """Values of a lubricant that depend on the temperature at the inlet of the contacts."""

    temperature: float  #: [K]
    density: float  #: [kg/m3]
    viscosity: float  #: eta0 [Pa s]
    temperature_viscosity: float  #: beta = -d ln eta0/dT [1/K]
    pressure_viscosity: float  #: alpha_p [1/Pa]


def viscosities(line: WaltherLine, temperature: float, density: float) -> tuple[float, float]:
    """Dynamic viscosity and its relative fall with temperature.

    Both follow from Walther's line and the density.

    eta0 = nu rho [Pa s] and beta = -d ln eta0/dT = -d ln nu/dT + 0.65 kg/(m3 K)/rho [1/K], at T [K]
    with the density rho there [kg/m3].

    Examples
    --------
    >>> eta, beta = viscosities(walther_line_through(T40, 460e-6, T100, 46e-6), 308.15, 900.0)
    >>> round(eta, 3), round(beta, 4)
    (0.542, 0.0562)
    """
    return walther_viscosity(line, temperature) * density, (
        walther_coefficient(line, temperature) + THERMAL_EXPANSION / density
    )


def moved_inlet(inlet: Inlet, temperature: float) -> Inlet:
    """The values at another temperature [K].

    Walther's line through viscosity and slope, linear density, constant Z.

    Raises InputError if the viscosity does not fall with temperature, or is too low for a law.

    Examples
    --------
    >>> warm = moved_inlet(Inlet(308.15, 900.0, 0.54, 0.056, 2.1e-8), 323.15)
    >>> coefficient = round(warm.pressure_viscosity * 1e9, 2)
    >>> round(warm.viscosity, 4), round(warm.temperature_viscosity, 4), coefficient
    (0.2496, 0.0472, 19.21)
    """
    kinematic = inlet.viscosity / inlet.density
    fall = inlet.temperature_viscosity - THERMAL_EXPANSION / inlet.density
    density = density_at(inlet.density, inlet.temperature, temperature)
    line = walther_line_with_slope(inlet.temperature, kinematic, fall)
    viscosity, temperature_viscosity = viscosities(line, temperature, density)
    index = roelands_index(inlet.viscosity, inlet.pressure_viscosity)
    return Inlet(
        temperature,
        density,
        viscosity,
        temperature_viscosity,
        pressure_viscosity_at(index, viscosity),
    )


def derive(values: Mapping[str, float], origins: Mapping[str, Provenance]) -> dict[str, Provenance]:
    """Values at the inlet that follow from the figures of a data sheet, in SI.

    These are density, viscosity, temperature_viscosity and pressure_viscosity, as far as `values`
    [SI] lacks them and they follow from others, whose ranges in `origins` are handed on in
    proportion.
    """
    derived: dict[str, Provenance] = {}

    def follows(key: str, value: float, unit: str, note: str, source: str) -> None:
        """Enter a derived value.

        Parameters
        ----------
        key : str
            Name of the value.
        value : float
            The value [`unit`].
        unit : str
            Its SI unit.
        note : str
            How it was derived.
        source : str
            Key of the figure whose range is handed on in proportion; "" for none.
        """
        derived[key] = Provenance(value, unit, "D", note, scaled_range(origins.get(source), value))

    temperature = values.get("inlet_temperature")
    if temperature is None:
        return derived
    density = values.get("density")
    if density is None and "density_15" in values:
        density = density_at(values["density_15"], T15, temperature)
        follows("density", density, "kg/m3", "from density_15, less 0.65 kg/(m3 K)", "density_15")
    viscosity = values.get("viscosity")
    line = None
    if (
        density is not None
        and {"kinematic_viscosity_40", "kinematic_viscosity_100"} <= values.keys()
    ):
        line = walther_line_through(
            T40, values["kinematic_viscosity_40"], T100, values["kinematic_viscosity_100"]
        )
        eta, beta = viscosities(line, temperature, density)
        if viscosity is None:
            viscosity = eta
            note = "Walther line through the viscosities at 40 and 100 degC, times density"
            follows("viscosity", eta, "Pa s", note, "kinematic_viscosity_40")
        if "temperature_viscosity" not in values:
            follows(
                "temperature_viscosity",
                beta,
                "1/K",
                "slope of the Walther line at the inlet temperature",
                "",
            )
    if viscosity is None or "pressure_viscosity" in values:
        return derived
    index = values.get("roelands_index")
    if index is not None:
        alpha = pressure_viscosity_at(index, viscosity)
        follows("pressure_viscosity", alpha, "1/Pa", "from Roelands' index", "roelands_index")
    elif (
        line is not None
        and density is not None
        and {"reference_pressure_viscosity", "reference_temperature"} <= values.keys()
    ):
        reference = values["reference_temperature"]
        density_there = density_at(density, temperature, reference)
        eta, _ = viscosities(line, reference, density_there)
        index = roelands_index(eta, values["reference_pressure_viscosity"])
        note = "from that at the reference temperature, with Roelands' index constant"
        alpha = pressure_viscosity_at(index, viscosity)
        follows("pressure_viscosity", alpha, "1/Pa", note, "reference_pressure_viscosity")
    return derived


def scaled_range(origin: Provenance | None, value: float) -> tuple[float, float] | None:
    """The range of another value, in proportion.

    Examples
    --------
    >>> scaled_range(Provenance(20.0, "1/GPa", "E", "", (16.0, 25.0)), 1.0)
    (0.8, 1.25)
    """
    if origin is None or origin.range is None or not origin.value:
        return None
    low, high = (limit / origin.value * value for limit in origin.range)
    return (min(low, value), max(high, value))
