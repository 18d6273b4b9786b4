"""Operation of a bearing in the units of the handbooks: the one place where SI becomes mm, N, r/min and mm²/s."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from macroslip.bearing import Bearing
from macroslip.errors import InputError
from macroslip.lubricant import Lubricant

NEWTON_METRE = 1e-3
"""One N mm, the handbooks' unit of torque, in N m."""


@dataclass(frozen=True, slots=True, eq=False)
class Operation:
    """Size, speed, viscosity and load of a bearing in handbook units.

    Attributes
    ----------
    bore, outside, width : float
        Boundary dimensions d, D, B [mm].
    speed : array
        Speed n of the inner ring [r/min], without sign.
    viscosity : float
        Kinematic viscosity ν of the oil, or of a grease's base oil, at operating temperature [mm²/s].
    radial_load, axial_load : array
        F_r and F_a [N], without sign.
    """

    bore: float
    outside: float
    width: float
    speed: NDArray[np.float64]
    viscosity: float
    radial_load: NDArray[np.float64]
    axial_load: NDArray[np.float64]

    @property
    def mean_diameter(self) -> float:
        """d_m = (d + D)/2 [mm]."""
        return (self.bore + self.outside) / 2


def operation(
    bearing: Bearing, lubricant: Lubricant, radial_load: ArrayLike, axial_load: ArrayLike, shaft_speed: ArrayLike
) -> Operation:
    """Convert SI data to the units of the handbooks.

    Parameters
    ----------
    bearing : Bearing
        With boundary dimensions.
    lubricant : Lubricant
        Its kinematic viscosity is `viscosity`/`density`, at `inlet_temperature`.
    radial_load, axial_load, shaft_speed : array_like
        [N], [N] and [rad/s], of any sign and of shapes that broadcast.

    Raises
    ------
    InputError
        A number is not finite, or the bearing has no boundary dimensions.
    """
    bore, outside, width = need(bearing, "bore_diameter", "outside_diameter", "width")
    given = {"radial_load": radial_load, "axial_load": axial_load, "shaft_speed": shaft_speed}
    for name, value in given.items():
        if not np.all(np.isfinite(np.asarray(value, dtype=float))):
            raise InputError(
                f"{name} holds a number that is not finite", where="friction torque", allowed="finite numbers"
            )
    radial, axial, speed = (np.abs(np.asarray(value, dtype=float)) for value in given.values())
    return Operation(
        bore=bore * 1e3,
        outside=outside * 1e3,
        width=width * 1e3,
        speed=speed * 30.0 / math.pi,
        viscosity=lubricant.viscosity / lubricant.density * 1e6,
        radial_load=radial,
        axial_load=axial,
    )


def need(bearing: Bearing, *keys: str) -> list[Any]:
    """Give catalogue data that a bearing file may leave out; InputError if this one does."""
    missing = [key for key in keys if getattr(bearing, key) is None]
    if missing:
        raise InputError(
            f"{bearing.name} has no {', no '.join(missing)}",
            where="friction torque",
            remedy="Add what is missing to the bearing's file: handbook estimates rest on catalogue data.",
        )
    return [getattr(bearing, key) for key in keys]


def choose_series(series: str, table: dict[str, tuple]) -> tuple:
    """Constants of a dimension series; InputError names the series there are."""
    if series not in table:
        raise InputError(
            f"there are no constants for series {series!r}",
            where="friction torque",
            allowed=", ".join(table),
            remedy="The series is the beginning of the bearing's designation: 240 for 240/600.",
        )
    return table[series]
