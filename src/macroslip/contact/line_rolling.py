"""Rolling resistance, film thickness and traction of a raceway's line contact, per roller.

The forces are those of one contact of a roller of effective length L under the load Q, taken as
even along the roller: tilt and profile change them by the power of the load per length with which
they go, which is small.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.bearing.tapered import TaperedBearing, TaperedGeometry, tapered_geometry
from macroslip.contact.film import (
    inlet_heating_factor,
    masjedi_khonsari_thickness,
    thermal_loading,
)
from macroslip.contact.hertz import effective_modulus
from macroslip.contact.line import half_width, line_pressure
from macroslip.contact.mechanisms import Laws
from macroslip.contact.rolling import inlet_heating_of_rolling
from macroslip.contact.traction import chord_stress, prepare_fluid
from macroslip.errors import InputError
from macroslip.lubricant import Lubricant

#: Coefficient and exponents of F_R α/(R L) = c (G U)^a W^b by the name of the law.
ROLLING_LAWS = {
    "zhou-hoeprich": (29.2, 0.648, 0.246),
    "goksem-hargreaves": (4.318, 0.658, 0.0126),
}


class LineContact(NamedTuple):
    """Line contact of a roller with one raceway under a lubricant."""

    curvature: float  #: Sum of both bodies' curvatures in the plane of rolling [1/m]
    length: float  #: Effective length L [m]
    modulus: float  #: Effective modulus E' [Pa]
    roughness: float  #: Composite RMS roughness [m]
    hardness: float  #: Hardness of the softer surface [Pa]
    lubricant: Lubricant  #: Oil at its temperature


def line_contacts(bearing: TaperedBearing, lubricant: Lubricant) -> tuple[LineContact, LineContact]:
    """Line contacts of a tapered roller with inner and outer raceway, at the roller's middle.

    Their curvature sums are 1/r + cos α_i/R_i and 1/r − cos α_o/R_o.

    Parameters
    ----------
    bearing : TaperedBearing
    lubricant : Lubricant

    Returns
    -------
    inner, outer : LineContact
    """
    modulus = effective_modulus(*(bearing.youngs_modulus, bearing.poisson_ratio) * 2)
    inner, outer = raceway_curvatures(tapered_geometry(bearing))
    common = (
        bearing.roller_length,
        modulus,
        bearing.composite_roughness,
        bearing.hardness,
        lubricant,
    )
    return LineContact(inner, *common), LineContact(outer, *common)


def raceway_curvatures(row: TaperedGeometry) -> tuple[float, float]:
    """Curvature sums of a roller's middle with inner and outer raceway in the plane of rolling [1/m].

    Examples
    --------
    >>> row = tapered_geometry(TaperedBearing.read("tdo-main-bearing"))
    >>> [round(one, 2) for one in raceway_curvatures(row)]
    [34.78, 30.16]
    """
    inner = 1.0 / row.roller_radius + math.cos(row.inner_angle) / row.inner_radius
    outer = 1.0 / row.roller_radius - math.cos(row.outer_angle) / row.outer_radius
    return inner, outer


def rolling_resistance(contact: LineContact, load, speed, law: str = "zhou-hoeprich"):
    """Rolling resistance F_R of a flooded elastic line contact with a warm inlet [N].

    Parameters
    ----------
    contact : LineContact
    load : array_like
        Q [N], ≥ 0; 0 gives 0.
    speed : array_like
        Entrainment speed u [m/s], > 0.
    law : {"zhou-hoeprich", "goksem-hargreaves"}, optional
        Formula; the first was made for tapered roller bearings.

    Returns
    -------
    ndarray
        F_R = c (R L/α) (G U)^a W^b φ [N], φ the factor of inlet shear heating.

    Raises
    ------
    InputError
        For a law that does not exist.

    References
    ----------
    Zhou and Hoeprich, J. Tribol. 113 (1991) 590, doi:10.1115/1.2920663; Goksem and Hargreaves,
    J. Lubr. Technol. 100 (1978) 346, doi:10.1115/1.3453183.

    Examples
    --------
    >>> bearing = TaperedBearing.read("tdo-main-bearing")
    >>> inner, _ = line_contacts(bearing, Lubricant.read("vg460-pao").at(308.15))
    >>> 5.0 < float(rolling_resistance(inner, 50e3, 0.24)) < 25.0
    True
    """
    if law not in ROLLING_LAWS:
        raise InputError(
            f"there is no law of rolling resistance {law!r}",
            allowed=" or ".join(ROLLING_LAWS),
            remedy="Choose one of them.",
        )
    factor, speed_exponent, load_exponent = ROLLING_LAWS[law]
    oil = contact.lubricant
    radius = 1.0 / contact.curvature
    groups = oil.pressure_viscosity * oil.viscosity * np.asarray(speed) / radius
    per_length = np.asarray(load) / contact.length / (contact.modulus * radius)
    loading = thermal_loading(contact.lubricant) * np.square(speed)
    scale = factor * radius * contact.length / oil.pressure_viscosity
    isothermal = scale * np.power(groups, speed_exponent) * np.power(per_length, load_exponent)
    return isothermal * inlet_heating_of_rolling(loading)


def line_film(contact: LineContact, load, speed):
    """Central film thickness of a flooded line contact with a warm inlet [m], by Masjedi, Khonsari.

    Parameters
    ----------
    contact : LineContact
    load : array_like
        Q [N], > 0.
    speed : array_like
        Entrainment speed u [m/s], > 0.

    Returns
    -------
    ndarray
        h [m].

    References
    ----------
    Masjedi and Khonsari, J. Tribol. 134 (2012) 011503, doi:10.1115/1.4005514.

    Examples
    --------
    >>> bearing = TaperedBearing.read("tdo-main-bearing")
    >>> inner, _ = line_contacts(bearing, Lubricant.read("vg460-pao").at(308.15))
    >>> 0.5e-6 < float(line_film(inner, 50e3, 0.24)) < 2e-6
    True
    """
    oil = contact.lubricant
    radius = 1.0 / contact.curvature
    unit = contact.modulus * radius
    height = masjedi_khonsari_thickness(
        np.asarray(load) / contact.length / unit,
        oil.viscosity * np.asarray(speed) / unit,
        oil.pressure_viscosity * contact.modulus,
        contact.roughness / radius,
        contact.hardness / contact.modulus,
    )
    loading = thermal_loading(contact.lubricant) * np.square(speed)
    return radius * height * inlet_heating_factor(loading)


def line_traction(contact: LineContact, load, film_thickness, slip, laws: Laws | None = None):
    """Traction of the film of a line contact that slips alike all over [N].

    Parameters
    ----------
    contact : LineContact
    load : array_like
        Q [N], > 0.
    film_thickness : array_like
        h [m], > 0.
    slip : array_like
        |Δu| [m/s], ≥ 0.
    laws : Laws, optional
        Their viscosity, rheology and heating count; `Laws.physical()` without them.

    Returns
    -------
    ndarray
        ∫ τ dA = L 2b ∫ τ cos θ dθ [N], ≥ 0, over Hertz' width 2b.

    Examples
    --------
    >>> bearing = TaperedBearing.read("tdo-main-bearing")
    >>> inner, _ = line_contacts(bearing, Lubricant.read("vg460-pao").at(308.15))
    >>> float(line_traction(inner, 50e3, 1e-6, 0.0))
    0.0
    """
    fluid = prepare_fluid(Laws.physical() if laws is None else laws, contact.lubricant)
    per_length = np.asarray(load) / contact.length
    width = half_width(per_length, contact.curvature, contact.modulus)
    pressure = line_pressure(per_length, contact.curvature, contact.modulus)
    return 2.0 * width * contact.length * chord_stress(fluid, pressure, film_thickness, slip)
