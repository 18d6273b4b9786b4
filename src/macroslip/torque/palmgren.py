"""Palmgren's estimate: a part M0 of the viscous oil, without load, and a part M1 of the load, without speed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from macroslip.bearing import Bearing
from macroslip.lubricant import Lubricant
from macroslip.torque.operation import NEWTON_METRE, choose_series, need, operation

SERIES: dict[str, tuple[float, float, float]] = {
    "213": (3.5, 0.0005, 0.33),
    "222": (4.0, 0.0005, 0.33),
    "223": (4.5, 0.0008, 0.33),
    "230": (4.5, 0.00075, 0.5),
    "231": (5.5, 0.0012, 0.5),
    "232": (6.0, 0.0016, 0.5),
    "240": (6.5, 0.0012, 0.5),
    "241": (7.0, 0.0022, 0.5),
}
"""f0, and z and y in f1 = z (P0/C0)^y, of double-row spherical roller bearings by series, for grease or an oil bath.

Tag R, from memory: the tables of bearing manufacturers that follow DIN 732. They agree to a rounding with the f0 and f1
of ISO 15312, remembered apart from them, which are those at a load of 0.05 C0."""

SLOW = 2000.0
"""Product ν n [mm²/s · r/min] below which the viscous part is taken not to depend on speed. Tag R."""


@dataclass(frozen=True, slots=True, eq=False)
class PalmgrenTorque:
    """Friction torque [N m] by Palmgren, against the rotation; floats, or arrays of the shape of the input.

    Attributes
    ----------
    viscous : float | array
        M0, which the oil causes without load: shear and churning [N m].
    load : float | array
        M1, which the load causes at any speed: hysteresis of the steel and sliding within the contacts [N m].
    """

    viscous: float | NDArray[np.float64]
    load: float | NDArray[np.float64]

    @property
    def total(self) -> float | NDArray[np.float64]:
        """M0 + M1 [N m]."""
        return self.viscous + self.load


def palmgren_torque(
    bearing: Bearing,
    lubricant: Lubricant,
    radial_load: ArrayLike,
    axial_load: ArrayLike,
    shaft_speed: ArrayLike,
    *,
    series: str = "240",
) -> PalmgrenTorque:
    """Friction torque of a spherical roller bearing by Palmgren, with the constants of DIN 732 and ISO 15312.

    With ν in mm²/s, n in r/min, d_m in mm, loads in N and torques in N mm (converted inside):

        M0 = 1e-7 f0 (ν n)^(2/3) d_m³,    at ν n < 2000: M0 = 160e-7 f0 d_m³
        M1 = f1 P1 d_m,                   f1 = z (P0/C0)^y
        P1 = 1.6 F_a/e where F_a > e F_r, F_r [1 + 0.6 (F_a/(e F_r))³] elsewhere
        P0 = F_r + Y0 F_a

    Parameters
    ----------
    bearing : Bearing
        With bore and outside diameter, static load rating and the axial factors e and Y0.
    lubricant : Lubricant
        Oil, or base oil of the grease, at operating temperature.
    radial_load, axial_load : array_like [N]
        Load on the bearing; signs are dropped.
    shaft_speed : array_like [rad/s]
        Speed of the inner ring; its sign is dropped.
    series : str
        Dimension series: a key of `SERIES`.

    Returns
    -------
    PalmgrenTorque
        [N m], not negative.

    Raises
    ------
    InputError
        An unknown series, a number that is not finite, or a bearing without the catalogue data.

    Notes
    -----
    For bearings at normal loads whose lubricant has settled; fresh grease may double M0. Below ν n = 2000 the handbook
    gives a constant M0, and so does this function, down to standstill; there is a step of 0.8 % at that place. The
    load part depends on neither speed nor film: it is one of good lubrication. Handbooks do not state an error; the factors
    are rounded means over sizes.

    References
    ----------
    A. Palmgren, Ball and Roller Bearing Engineering, 3rd ed. (1959). T. A. Harris and M. N. Kotzalas, Essential
    Concepts of Bearing Technology, 5th ed. (2006), chapter 10. DIN 732 (2010), ISO 15312 (2003). All constants tag R.

    Examples
    --------
    >>> torque = palmgren_torque(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"), 344e3, 164e3, 2.143)
    >>> print(f"{torque.viscous:.1f} + {torque.load:.1f} = {torque.total:.1f} N m")
    137.4 + 160.4 = 297.8 N m
    """
    viscous_factor, scale, exponent = choose_series(series, SERIES)
    rating, factor_e, factor_y0 = need(bearing, "static_load_rating", "axial_factor_e", "axial_factor_y0")
    case = operation(bearing, lubricant, radial_load, axial_load, shaft_speed)
    flow = case.viscosity * case.speed
    viscous = viscous_factor * case.mean_diameter**3 * np.where(flow < SLOW, 160e-7, 1e-7 * np.cbrt(flow) ** 2)
    radial, thrust = case.radial_load, case.axial_load / factor_e
    # Where thrust > radial this quotient is not used; without load it is 0/0.
    share = np.divide(thrust, radial, out=np.zeros(np.broadcast(thrust, radial).shape), where=radial > 0)
    driving = np.where(thrust > radial, 1.6 * thrust, radial * (1 + 0.6 * np.minimum(share, 1.0) ** 3))
    static = radial + factor_y0 * case.axial_load
    load = scale * (static / rating) ** exponent * driving * case.mean_diameter
    viscous, load = np.broadcast_arrays(viscous * NEWTON_METRE, load * NEWTON_METRE)
    return PalmgrenTorque(viscous=viscous[()], load=load[()])
