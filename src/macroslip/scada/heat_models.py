"""Models of the heat of a main bearing: computed friction, friction by handbooks, or speed alone.

Every model gives the heat of each row of a record up to constants that a fit finds.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd
from scipy.interpolate import RegularGridInterpolator

from macroslip.arrays import FloatArray
from macroslip.scada.friction_table import FrictionTable
from macroslip.torque.handbooks import palmgren_torque, skf_torque

#: The model with computed friction and a torque of seals, and the same with less.
FRICTION = "friction and seals"
FRICTION_ALONE = "friction"
MEAN_TEMPERATURE = "friction at the mean temperature"
#: Rivals: handbooks' formulas, and powers of the speed.
SKF = "SKF torque"
PALMGREN = "Palmgren torque"
SPEED = "speed"
SPEED_POWER = "speed^1.6"
#: Regression of the rise of temperature, which has no balance of heat.
RISE = "regression of the rise"
#: Exponent of the speed in `SPEED_POWER`: of a torque by the SKF model, (ν n)^0.6, times speed.
EXPONENT = 1.6
#: Steps in which handbooks' formulas are tabulated: temperature [K], and numbers of speeds.
_KELVIN = 1.0
_SPEEDS = 25


@dataclass(frozen=True, eq=False)
class HeatModel:
    """A model of the heat of a bearing: one or two sources, each times a constant of the fit."""

    name: str
    supply: str  #: Supply of oil, empty where there is none
    #: Source by the name of its constant: `capacity`, of a heat [W]; `seal_torque`, of the speed
    #: [rad/s]; `heat_at_rated`, of a share of the heat at rated speed [-]
    sources: Mapping[str, FloatArray]

    @property
    def title(self) -> str:
        """Name, with the supply of oil where it has one."""
        return f"{self.name}, {self.supply}" if self.supply else self.name

    @property
    def has_capacity(self) -> bool:
        """True if its heat is known in W, so that a fit finds the heat capacity."""
        return "capacity" in self.sources


def heat_models(
    record: pd.DataFrame, friction: FrictionTable, rated_speed: float, oil_offset: float
) -> list[HeatModel]:
    """All models for the rows of a record: computed friction by supply, then the rivals.

    Parameters
    ----------
    record : DataFrame
        `wind_speed` [m/s], `rotor_speed` [rad/s] and `bearing_temperature` [K], n rows.
    friction : FrictionTable
    rated_speed : float
        Of the turbine [rad/s].
    oil_offset : float
        Temperature of the oil in the contacts above the sensor's [K].

    Returns
    -------
    list of HeatModel
        Handbooks' are missing where the table has no loads, bearing and lubricant.
    """
    wind = record["wind_speed"].to_numpy(float)
    speed = np.abs(record["rotor_speed"].to_numpy(float))
    oil = record["bearing_temperature"].to_numpy(float) + oil_offset
    mean_oil = float(oil.mean())
    models = []
    for supply in friction.supplies:
        power = friction.power(supply, wind, speed, oil)
        steady = friction.power(supply, wind, speed, mean_oil)
        models.append(HeatModel(FRICTION, supply, {"capacity": power, "seal_torque": speed}))
        models.append(HeatModel(FRICTION_ALONE, supply, {"capacity": power}))
        models.append(HeatModel(MEAN_TEMPERATURE, supply, {"capacity": steady}))
    for name, torque in _handbooks(friction, wind, speed, oil).items():
        models.append(HeatModel(name, "", {"capacity": torque * speed}))
    share = speed / rated_speed
    models.append(HeatModel(SPEED, "", {"heat_at_rated": share}))
    models.append(HeatModel(SPEED_POWER, "", {"heat_at_rated": share**EXPONENT}))
    return models


def _handbooks(
    friction: FrictionTable,
    wind: FloatArray,
    speed: FloatArray,
    oil: FloatArray,
) -> dict[str, FloatArray]:
    """Torque [N m] of every row by the SKF model and by Palmgren, at the mean loads of its wind."""
    loads = friction.loads
    if loads is None or friction.bearing is None or friction.lubricant is None:
        return {}
    winds = loads["wind_speed"].to_numpy(float)
    radial = loads["radial_load"].to_numpy(float)[:, None]
    axial = loads["axial_load"].to_numpy(float)[:, None]
    # Speeds lie closer towards standstill, where the torques bend.
    fastest = max(float(speed.max()), 1e-6)
    shares = np.linspace(0.0, 1.0, _SPEEDS) ** 2
    speeds = fastest * shares
    speeds[0] = 1e-3 * speeds[1]
    coldest = np.floor(oil.min())
    warmest = np.ceil(oil.max())
    kelvin = np.arange(coldest, warmest + _KELVIN, _KELVIN)
    formulas = {SKF: skf_torque, PALMGREN: palmgren_torque}
    shape = (kelvin.size, winds.size, _SPEEDS)
    tables = {name: np.empty(shape) for name in formulas}
    for number, temperature in enumerate(kelvin):
        lubricant = friction.lubricant.at(float(temperature))
        for name, formula in formulas.items():
            torque = formula(friction.bearing, lubricant, radial, axial, speeds[None])
            tables[name][number] = torque.total
    held = np.clip(wind, winds[0], winds[-1])
    turning = np.maximum(speed, speeds[0])
    points = np.stack([oil, held, turning], axis=1)
    torques = {}
    for name, table in tables.items():
        interpolator = RegularGridInterpolator((kelvin, winds, speeds), table)
        torques[name] = interpolator(points)
    return torques
