"""A lubricant from the two viscosities of a data sheet and the family of its base oil."""

from __future__ import annotations

from typing import Any

from macroslip.errors import InputError
from macroslip.input.messages import shown
from macroslip.lubricant.base_oil import BASE_OILS
from macroslip.lubricant.inlet import T15, T40, T100, viscosities
from macroslip.lubricant.lubricant import Lubricant
from macroslip.lubricant.temperature import (
    density_at,
    eyring_stress,
    gold,
    mean_pressure_viscosity,
    pressure_viscosity_at,
    roelands_index,
    walther_line_through,
)

INLET = 308.15
"""Inlet temperature [K] of an estimated lubricant: 35 degC, as in the base case."""

_CONTACT_PRESSURE = 1e9


def estimate_lubricant(
    kinematic_viscosity_40: float, kinematic_viscosity_100: float, base_oil: str, name: str
) -> Lubricant:
    """Estimate a lubricant at 35 degC from kinematic viscosities and base oil.

    The viscosity follows Walther's line; the pressure-viscosity coefficient is the mean of the oil
    family by Gold et al., for esters and polyglycols raised within its scatter by the friction of
    thrust bearings, and the Eyring stress 2 gamma/alpha at 1 GPa. Values that the family leaves
    open have the tag E and a range.

    Parameters
    ----------
    kinematic_viscosity_40 : float
        Kinematic viscosity at 40 degC [m2/s], 1e-6 to 0.1.
    kinematic_viscosity_100 : float
        Kinematic viscosity at 100 degC [m2/s], 1e-6 to 0.1, below that at 40 degC.
    base_oil : str
        A family of `macroslip.lubricant.base_oil.BASE_OILS`, for a grease that of its base oil.
    name : str
        Short name of the lubricant.

    Returns
    -------
    Lubricant
        The lubricant with the provenance of its values.

    Raises
    ------
    InputError
        If there is no such family, a viscosity is out of range, or it does not fall with
        temperature.

    Examples
    --------
    >>> oil = estimate_lubricant(320e-6, 35e-6, "pao", name="mine")
    >>> round(oil.viscosity, 3), oil.provenance["reference_pressure_viscosity"].range
    (0.349, (12.8, 19.1))
    """
    if base_oil not in BASE_OILS:
        raise InputError(
            f"there is no base oil {shown(base_oil)}",
            allowed=", ".join(f"{key} ({family.title})" for key, family in BASE_OILS.items()),
            remedy="Choose the one closest to the data sheet.",
        )
    for kelvin, viscosity in ((T40, kinematic_viscosity_40), (T100, kinematic_viscosity_100)):
        if not 1e-6 <= viscosity <= 0.1:
            raise InputError(
                f"the kinematic viscosity at {kelvin - 273.15:g} degC is {viscosity * 1e6:g} mm2/s",
                allowed="1 to 100000 mm2/s",
                remedy="Check value and unit; lubricating oils have 2 to 5000 mm2/s.",
            )
    family = BASE_OILS[base_oil]
    line = walther_line_through(T40, kinematic_viscosity_40, T100, kinematic_viscosity_100)
    low, usual, high = family.over_gold
    alpha = usual * gold(kinematic_viscosity_40, family.gold_factor, family.gold_exponent)
    times = (
        "; oils of a family scatter by 20 %"
        if usual == 1.0
        else f", times {usual:g} by the friction of thrust bearings"
    )
    entries = {
        "name": name,
        "title": f"estimated from two viscosities, base oil {family.title}",
        "base_oil": base_oil,
        "inlet_temperature": _entry(INLET - 273.15, "degC", "inlet of the base case"),
        "kinematic_viscosity_40": _entry(kinematic_viscosity_40 * 1e6, "mm2/s", "", tag="U"),
        "kinematic_viscosity_100": _entry(kinematic_viscosity_100 * 1e6, "mm2/s", "", tag="U"),
        "reference_pressure_viscosity": _entry(
            alpha * 1e9,
            "1/GPa",
            f"Gold et al. (2001), {family.gold_factor:g} nu^{family.gold_exponent:g}{times}",
            spread=(low / usual, high / usual),
        ),
        "reference_temperature": _entry(40, "degC", "of the viscosity in Gold's law"),
        "thermal_conductivity": _entry(
            family.thermal_conductivity, "W/(m K)", "usual for the family"
        ),
        "density_15": _entry(family.density_15, "kg/m3", "usual for the family")
        | {
            "range": [
                family.density_15 - family.density_scatter,
                family.density_15 + family.density_scatter,
            ]
        },
        "fill_factor": _entry(0.7, "1", "as in the base case"),
        "drag_coefficient": _entry(1, "1", "as in the base case"),
        "boundary_friction": _entry(
            0.06, "1", "thrust bearings with five gear oils: 0.034 to 0.09, docs/measurements.md"
        )
        | {"range": [0.034, 0.1]},
    }
    low, mean, high = family.limiting_shear
    entries["limiting_shear"] = _entry(
        mean, "1", "usual for the family, see docs/lubricants.md"
    ) | {"range": [low, high]}
    density_40 = density_at(family.density_15, T15, T40)
    viscosity_40, _ = viscosities(line, T40, density_40)
    index = roelands_index(viscosity_40, alpha)
    density = density_at(family.density_15, T15, INLET)
    viscosity, _ = viscosities(line, INLET, density)
    at_inlet = pressure_viscosity_at(index, viscosity)
    at_pressure = mean_pressure_viscosity(viscosity, at_inlet, _CONTACT_PRESSURE)
    stress = eyring_stress(mean, at_pressure)
    entries["eyring_stress"] = _entry(stress * 1e-6, "MPa", "2 gamma/alpha at 1 GPa; half of it is reported too; docs/measurements.md",
                                      spread=(0.5, 1.3))  # fmt: skip
    return Lubricant.from_dict(entries)


def _entry(
    value: float, unit: str, note: str, *, tag: str = "E", spread: tuple[float, float] | None = None
) -> dict[str, Any]:
    """An entry of a lubricant file, to three digits where it is estimated with a spread."""
    entry: dict[str, Any] = {
        "value": float(f"{value:.12g}"),
        "unit": unit,
        "tag": tag,
        "note": note,
    }
    if spread:
        entry["value"] = float(f"{value:.3g}")
        entry["range"] = [float(f"{share * value:.3g}") for share in spread]
    return entry
