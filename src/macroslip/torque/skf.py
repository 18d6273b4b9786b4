"""The SKF model for the frictional moment: rolling, sliding, seals and drag, each by its own mechanism."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from macroslip.bearing import Bearing
from macroslip.errors import InputError
from macroslip.lubricant import Lubricant
from macroslip.torque.operation import NEWTON_METRE, Operation, choose_series, operation
from macroslip.torque.skf_drag import TYPE_FACTOR, OilBath, oil_bath_drag

SERIES: dict[str, tuple[tuple[float, float, float, float], tuple[float, float, float, float]]] = {
    "213 E": ((1.6e-6, 5.84, 2.81e-6, 5.8), (3.62e-3, 508, 8.8e-3, 117)),
    "222 E": ((1.6e-6, 5.84, 2.81e-6, 5.8), (3.62e-3, 508, 8.8e-3, 117)),
    "222": ((2.0e-6, 5.54, 2.92e-6, 5.5), (5.10e-3, 414, 9.7e-3, 100)),
    "223": ((1.7e-6, 4.1, 3.13e-6, 4.05), (6.92e-3, 124, 1.7e-2, 41)),
    "223 E": ((1.6e-6, 4.1, 3.14e-6, 4.05), (6.23e-3, 124, 1.7e-2, 41)),
    "230": ((2.4e-6, 6.44, 3.76e-6, 6.4), (4.13e-3, 755, 1.1e-2, 160)),
    "231": ((2.4e-6, 4.7, 4.04e-6, 4.72), (6.70e-3, 231, 1.7e-2, 65)),
    "232": ((2.3e-6, 4.1, 4.00e-6, 4.05), (8.66e-3, 126, 2.1e-2, 41)),
    "238": ((3.1e-6, 12.1, 3.82e-6, 12), (1.74e-3, 9495, 5.9e-3, 1057)),
    "239": ((2.7e-6, 8.53, 3.87e-6, 8.47), (2.77e-3, 2330, 8.5e-3, 371)),
    "240": ((2.9e-6, 4.87, 4.78e-6, 4.84), (6.95e-3, 240, 2.1e-2, 68)),
    "241": ((2.6e-6, 3.8, 4.79e-6, 3.7), (1.00e-2, 86.7, 2.9e-2, 31)),
    "248": ((3.8e-6, 9.4, 5.09e-6, 9.3), (2.80e-3, 3415, 1.2e-2, 486)),
    "249": ((3.0e-6, 6.67, 5.09e-6, 6.62), (3.90e-3, 887, 1.7e-2, 180)),
}
"""R1 to R4 of rolling and S1 to S4 of sliding friction of spherical roller bearings by series.

Tag V: remembered, and found number by number the same in a public transcription of the catalogue's table."""

BOUNDARY_FRICTION = 0.12
"""μ_bl of a turning bearing, tag V."""
STARTING_FRICTION = 0.15
"""μ_bl of a bearing that begins to turn, tag V."""
FILM_FRICTION = {"synthetic oil": 0.04, "mineral oil": 0.05, "transmission fluid": 0.1}
"""μ_EHL of a full film, tag V."""
STARVATION = {"grease": 6e-8, "low oil bath": 3e-8}
"""Replenishment constant K_rs, tag V; a bath that covers the lowest roller's axis does not starve."""
VISCOSITY_RANGE = (2.0, 500.0)
"""Kinematic viscosity for which the model is stated [mm²/s], tag R."""


@dataclass(frozen=True, slots=True, eq=False)
class SkfTorque:
    """Friction torque [N m] by the SKF model, against the rotation; floats, or arrays of the shape of the input.

    Attributes
    ----------
    rolling : float | array
        φ_ish φ_rs M_rr: resistance of the oil that the contacts squeeze at their inlets [N m].
    sliding : float | array
        M_sl: sliding within the contacts [N m].
    drag : float | array
        M_drag: the rollers' way through an oil bath [N m].
    seal : float | array
        M_seal: seals of the bearing itself [N m]; zero, for open bearings have none.
    out_of_range : tuple of str
        What lies outside the range for which the model is stated; empty if nothing does.
    """

    rolling: float | NDArray[np.float64]
    sliding: float | NDArray[np.float64]
    drag: float | NDArray[np.float64]
    seal: float | NDArray[np.float64]
    out_of_range: tuple[str, ...]

    @property
    def total(self) -> float | NDArray[np.float64]:
        """Sum of the parts [N m]."""
        return self.rolling + self.sliding + self.drag + self.seal


def skf_torque(
    bearing: Bearing,
    lubricant: Lubricant,
    radial_load: ArrayLike,
    axial_load: ArrayLike,
    shaft_speed: ArrayLike,
    *,
    series: str = "240",
    oil: str = "synthetic oil",
    bath: OilBath | None = None,
) -> SkfTorque:
    """Friction torque of an open spherical roller bearing by the SKF model, M = φ_ish φ_rs M_rr + M_sl + M_drag.

    With ν in mm²/s, n in r/min, d, D and d_m in mm, loads in N and torques in N mm (converted inside):

        M_rr = G_rr (ν n)^0.6
        G_rr = min[R1 d_m^1.85 (F_r + R2 F_a)^0.54,  R3 d_m^2.3 (F_r + R4 F_a)^0.31]
        φ_ish = 1/[1 + 1.84e-9 (n d_m)^1.28 ν^0.64]
        φ_rs = exp{−K_rs ν n (d + D) √[K_Z/(2 (D − d))]}
        M_sl = G_sl [φ_bl μ_bl + (1 − φ_bl) μ_EHL],    φ_bl = exp[−2.6e-8 (ν n)^1.4 d_m]
        G_sl = min[S1 d_m^0.25 (F_r⁴ + S2 F_a⁴)^(1/3),  S3 d_m^0.94 (F_r³ + S4 F_a³)^(1/3)]

    and M_drag by `skf_drag.oil_bath_drag`.

    Parameters
    ----------
    bearing : Bearing
        With bore, outside diameter and width.
    lubricant : Lubricant
        Oil, or base oil of the grease, at operating temperature.
    radial_load, axial_load : array_like [N]
        Load on the bearing; signs are dropped.
    shaft_speed : array_like [rad/s]
        Speed of the inner ring; its sign is dropped. At zero speed the torque is that of starting, with μ_bl = 0.15.
    series : str
        Dimension series: a key of `SERIES`.
    oil : str
        A key of `FILM_FRICTION`.
    bath : OilBath, optional
        The oil bath; without one the bearing is lubricated by grease and has no drag.

    Returns
    -------
    SkfTorque
        [N m], not negative.

    Raises
    ------
    InputError
        An unknown series or oil, a number that is not finite, or a bearing without boundary dimensions.

    Notes
    -----
    Stated for steady operation at constant load of at least the recommended minimum, hours after greasing, normal
    clearance, and ν from 2 to 500 mm²/s; a thicker oil is computed all the same and noted in `out_of_range`. Whether a
    bath starves the contacts is decided by whether it reaches the axis of the lowest roller (tag E).

    References
    ----------
    SKF, Rolling bearings, PUB BU/P1 17000 (2018), section "The SKF model for calculating the frictional moment".
    Formulas and constants from memory, then confirmed in public excerpts of the catalogue and in transcriptions of it,
    except for what is tagged R or E.

    Examples
    --------
    >>> torque = skf_torque(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"), 344e3, 164e3, 2.143)
    >>> print(f"{torque.rolling:.1f} + {torque.sliding:.1f} = {torque.total:.1f} N m")
    270.3 + 82.9 = 353.1 N m
    >>> torque.out_of_range
    ('viscosity is 600 mm2/s; the model is stated for 2 to 500 mm2/s',)
    """
    rolling_constants, sliding_constants = choose_series(series, SERIES)
    if oil not in FILM_FRICTION:
        raise InputError(f"there is no oil {oil!r}", where="friction torque", allowed=", ".join(FILM_FRICTION))
    case = operation(bearing, lubricant, radial_load, axial_load, shaft_speed)
    if bath is None:
        starvation, drag = STARVATION["grease"], np.zeros_like(case.speed)
    else:
        covered = bath.level >= bearing.roller_diameter / 2
        starvation, drag = 0.0 if covered else STARVATION["low oil bath"], oil_bath_drag(case, bath)
    rolling = (
        _inlet_shear_heating(case)
        * _replenishment(case, starvation)
        * _rolling_variable(case, *rolling_constants)
        * (case.viscosity * case.speed) ** 0.6
    )
    sliding = _sliding_variable(case, *sliding_constants) * _sliding_friction(case, FILM_FRICTION[oil])
    parts = np.broadcast_arrays(rolling * NEWTON_METRE, sliding * NEWTON_METRE, drag * NEWTON_METRE, 0.0)
    return SkfTorque(*(part[()] for part in parts), out_of_range=_out_of_range(case))


def _rolling_variable(case: Operation, r1: float, r2: float, r3: float, r4: float) -> NDArray[np.float64]:
    """G_rr: the smaller one of the catalogue's G_rr.e and G_rr.l."""
    d_m, radial, axial = case.mean_diameter, case.radial_load, case.axial_load
    return np.minimum(r1 * d_m**1.85 * (radial + r2 * axial) ** 0.54, r3 * d_m**2.3 * (radial + r4 * axial) ** 0.31)


def _sliding_variable(case: Operation, s1: float, s2: float, s3: float, s4: float) -> NDArray[np.float64]:
    """G_sl: the smaller one of the catalogue's G_sl.e and G_sl.l."""
    d_m, radial, axial = case.mean_diameter, case.radial_load, case.axial_load
    return np.minimum(
        s1 * d_m**0.25 * np.cbrt(radial**4 + s2 * axial**4), s3 * d_m**0.94 * np.cbrt(radial**3 + s4 * axial**3)
    )


def _inlet_shear_heating(case: Operation) -> NDArray[np.float64]:
    return 1 / (1 + 1.84e-9 * (case.speed * case.mean_diameter) ** 1.28 * case.viscosity**0.64)


def _replenishment(case: Operation, starvation: float) -> NDArray[np.float64]:
    shape = (case.bore + case.outside) * np.sqrt(TYPE_FACTOR / (2 * (case.outside - case.bore)))
    return np.exp(-starvation * case.viscosity * case.speed * shape)


def _sliding_friction(case: Operation, film: float) -> NDArray[np.float64]:
    boundary = np.exp(-2.6e-8 * (case.speed * case.viscosity) ** 1.4 * case.mean_diameter)
    touching = np.where(case.speed > 0, BOUNDARY_FRICTION, STARTING_FRICTION)
    return boundary * touching + (1 - boundary) * film


def _out_of_range(case: Operation) -> tuple[str, ...]:
    low, high = VISCOSITY_RANGE
    if low <= case.viscosity <= high:
        return ()
    return (f"viscosity is {case.viscosity:.4g} mm2/s; the model is stated for {low:g} to {high:g} mm2/s",)
