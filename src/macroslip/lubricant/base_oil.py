"""Base oil families: values for an oil whose data sheet gives viscosities alone."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple


class BaseOil(NamedTuple):
    """Mean values of a family of base oils.

    Each with a range in which four out of five oils are taken to lie.
    """

    title: str  #: Its name in words
    #: s and t of `macroslip.lubricant.temperature.gold` [1/GPa at 1 mm2/s, -].
    gold_factor: float
    gold_exponent: float
    #: Pressure-viscosity coefficient over Gold's mean [-]: lowest, usual, highest
    over_gold: tuple[float, float, float]
    density_15: float  #: Density at 15 degC [kg/m3]
    density_scatter: float  #: Half its range [kg/m3]
    limiting_shear: tuple[
        float, float, float
    ]  #: Limiting shear stress over pressure [-]: lowest, mean, highest
    thermal_conductivity: float  #: [W/(m K)]


# Gold's mean scatters by 20 %, and by as much between a viscometer and a measured film. The
# friction of thrust bearings needs 0.70 to 1.07 of it in a mineral oil, 0.88 to 1.19 in PAO, 1.04
# to 1.33 in an ester and 1.06 to 1.41 in a polyglycol (docs/measurements.md); the usual value is
# the middle of what both allow. Limiting shear: PAO 100, paraffinic, naphthenic and polyglycol oils
# after Hoeglund in Arana, Larranaga and Ulacia (2019); 0.035 to 0.05 is reported for PAO of other
# makes. Esters and mixtures are estimates between them. Gold's s and t are in rolling-bearing
# papers of Fernandes, Martins and Seabra (2013) as well.
_SCATTER = (0.8, 1.0, 1.2)
BASE_OILS: Mapping[str, BaseOil] = MappingProxyType(
    {
        "pao": BaseOil(
            "polyalphaolefin", 7.382, 0.1335, _SCATTER, 855.0, 15.0, (0.035, 0.042, 0.050), 0.14
        ),
        "mineral": BaseOil(
            "mineral, paraffinic", 9.904, 0.139, _SCATTER, 895.0, 15.0, (0.044, 0.047, 0.050), 0.13
        ),
        "naphthenic": BaseOil(
            "mineral, naphthenic", 9.904, 0.139, _SCATTER, 920.0, 15.0, (0.050, 0.053, 0.056), 0.13
        ),
        "pao-mineral": BaseOil(
            "polyalphaolefin and mineral",
            8.643,
            0.136,
            _SCATTER,
            875.0,
            25.0,
            (0.035, 0.045, 0.050),
            0.135,
        ),
        "pao-ester": BaseOil(
            "polyalphaolefin and ester",
            7.0,
            0.135,
            _SCATTER,
            880.0,
            30.0,
            (0.035, 0.042, 0.050),
            0.14,
        ),
        "ester": BaseOil(
            "ester", 6.605, 0.136, (1.0, 1.1, 1.33), 930.0, 30.0, (0.030, 0.042, 0.050), 0.15
        ),
        "polyglycol": BaseOil(
            "polyglycol", 5.489, 0.1485, (1.0, 1.15, 1.4), 1040.0, 40.0, (0.041, 0.044, 0.047), 0.15
        ),
    }
)
"""Families by the name that `base_oil` has in a lubricant file."""
