"""Drag of the rollers in an oil bath by the SKF model."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from macroslip.errors import InputError
from macroslip.torque.operation import Operation

TYPE_FACTOR = 5.5
"""K_Z of double-row spherical roller bearings, tag V."""
ROLLER_FACTOR = 0.8
"""K_L of double-row spherical roller bearings, tag V."""
THICKEST = 500.0
"""Largest viscosity with which the drag is evaluated [mm²/s], tag R; a thicker oil counts as this one."""


@dataclass(frozen=True, slots=True)
class OilBath:
    """The oil in which the lowest rollers stand.

    Parameters
    ----------
    level : float [m]
        H: height of the oil above the lowest place of the outer raceway while the bearing is at rest, ≥ 0. The
        formula is for up to 1.2 times the mean diameter; a higher level counts as this one.
    drag_variable : float
        V_M [-], read from the catalogue's diagram for roller bearings over H/d_m, 0 to 0.01. The diagram has no
        formula. It belongs to the churning term, which is small in a slow bearing.

    Raises
    ------
    InputError
        A value outside its range.
    """

    level: float
    drag_variable: float

    def __post_init__(self) -> None:
        ranges = {"level": (math.inf, "not negative, in metres"), "drag_variable": (0.01, "0 to 0.01")}
        for name, (most, allowed) in ranges.items():
            value = getattr(self, name)
            if not (math.isfinite(value) and 0.0 <= value <= most):
                raise InputError(f"{name} is {value!r}", where="oil bath", allowed=allowed)


def oil_bath_drag(case: Operation, bath: OilBath) -> NDArray[np.float64]:
    """Drag torque of the rollers in an oil bath by the SKF model [N mm].

        M_drag = 4 V_M K_roll C_w B d_m⁴ n² + 1.093e-7 n² d_m³ (n d_m² f_t/ν)^(−1.379) R_s
        K_roll = K_L K_Z (d + D)/(D − d) 1e-12
        C_w = 2.789e-10 l³ − 2.786e-4 l² + 0.0195 l + 0.6439,    l = 5 K_L B/d_m
        t = 2 arccos[(0.6 d_m − H)/(0.6 d_m)],    f_t = sin(t/2) up to t = π, then 1
        R_s = 0.36 d_m² (t − sin t) f_A,    f_A = 0.05 K_Z (D + d)/(D − d)

    Parameters
    ----------
    case : Operation
        Sizes and speed in handbook units.
    bath : OilBath
        Level and V_M.

    Notes
    -----
    For a large oil sump, the shaft horizontal, the inner ring turning. The first term is churning, the second the
    entrance of the rollers into the oil.

    References
    ----------
    SKF, Rolling bearings, PUB BU/P1 17000 (2018), section "Drag losses". From memory, then confirmed in a public
    transcription (V), except for the cubic term of C_w, which is negligible, for t and f_t, and for the bounds (R).
    """
    d_m, spread = case.mean_diameter, (case.outside + case.bore) / (case.outside - case.bore)
    if bath.level == 0.0:
        return np.zeros_like(case.speed)
    angle = 2 * math.acos(max(-1.0, 1 - bath.level * 1e3 / (0.6 * d_m)))
    immersion = math.sin(angle / 2) if angle <= math.pi else 1.0
    span = 5 * ROLLER_FACTOR * case.width / d_m
    shape = 2.789e-10 * span**3 - 2.786e-4 * span**2 + 0.0195 * span + 0.6439
    roll = ROLLER_FACTOR * TYPE_FACTOR * spread * 1e-12
    churning = 4 * bath.drag_variable * roll * shape * case.width * d_m**4 * case.speed**2
    surface = 0.36 * d_m**2 * (angle - math.sin(angle)) * 0.05 * TYPE_FACTOR * spread
    # n² (n …)^(−1.379) written as one power of n, which vanishes at standstill.
    number = d_m**2 * immersion / min(case.viscosity, THICKEST)
    entrance = 1.093e-7 * d_m**3 * number**-1.379 * surface * case.speed**0.621
    return churning + entrance
