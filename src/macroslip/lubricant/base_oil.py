"""Base oil families: values for an oil whose data sheet gives viscosities alone."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple


class BaseOil(NamedTuple):
    """Mean values of a family of base oils, each with a range in which four out of five oils are taken to lie.

    Parameters
    ----------
    title : str
        Its name in words.
    gold_factor, gold_exponent : float
        s and t of `macroslip.lubricant.temperature.gold` [1/GPa at 1 mm2/s, -].
    density_15 : float
        Density at 15 degC [kg/m3].
    density_scatter : float
        Half its range [kg/m3].
    limiting_shear : tuple[float, float, float]
        Limiting shear stress over pressure [-]: lowest, mean, highest.
    thermal_conductivity : float
        [W/(m K)].
    """

    title: str
    gold_factor: float
    gold_exponent: float
    density_15: float
    density_scatter: float
    limiting_shear: tuple[float, float, float]
    thermal_conductivity: float


# Limiting shear: PAO 100, paraffinic, naphthenic and polyglycol oils after Hoeglund in Arana, Larranaga and Ulacia (2019);
# 0.035 to 0.05 is reported for PAO of other makes. Esters and mixtures are estimates between them.
# Gold's s and t are in rolling-bearing papers of Fernandes, Martins and Seabra (2013) as well.
BASE_OILS: Mapping[str, BaseOil] = MappingProxyType(
    {
        "pao": BaseOil("polyalphaolefin", 7.382, 0.1335, 855.0, 15.0, (0.035, 0.042, 0.050), 0.14),
        "mineral": BaseOil("mineral, paraffinic", 9.904, 0.139, 895.0, 15.0, (0.044, 0.047, 0.050), 0.13),
        "naphthenic": BaseOil("mineral, naphthenic", 9.904, 0.139, 920.0, 15.0, (0.050, 0.053, 0.056), 0.13),
        "pao-mineral": BaseOil("polyalphaolefin and mineral", 8.643, 0.136, 875.0, 25.0, (0.035, 0.045, 0.050), 0.135),
        "pao-ester": BaseOil("polyalphaolefin and ester", 7.0, 0.135, 880.0, 30.0, (0.035, 0.042, 0.050), 0.14),
        "ester": BaseOil("ester", 6.605, 0.136, 930.0, 30.0, (0.030, 0.042, 0.050), 0.15),
        "polyglycol": BaseOil("polyglycol", 5.489, 0.1485, 1040.0, 40.0, (0.041, 0.044, 0.047), 0.15),
    }
)
"""Families by the name that `base_oil` has in a lubricant file."""
