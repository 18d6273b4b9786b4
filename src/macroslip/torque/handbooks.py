"""Friction torque of spherical roller bearings by the handbooks.

Palmgren's formula and the SKF model.

Both are stated in mm, N, r/min and mm²/s, and give N mm; only `_Operation` converts from SI.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from macroslip.arrays import FloatArray
from macroslip.bearing import Bearing
from macroslip.contact.rolling import replenishment
from macroslip.errors import InputError
from macroslip.loads import BearingLoads
from macroslip.lubricant import Lubricant

PALMGREN_SERIES: dict[str, tuple[float, float, float]] = {
    "213": (3.5, 0.0005, 0.33),
    "222": (4.0, 0.0005, 0.33),
    "223": (4.5, 0.0008, 0.33),
    "230": (4.5, 0.00075, 0.5),
    "231": (5.5, 0.0012, 0.5),
    "232": (6.0, 0.0016, 0.5),
    "240": (6.5, 0.0012, 0.5),
    "241": (7.0, 0.0022, 0.5),
}
"""f0, and z and y in f1 = z (P0/C0)^y, of double-row spherical roller bearings by series, for
grease or an oil bath.

Tag R, from memory: the tables of bearing manufacturers that follow DIN 732. They agree to a
rounding with the f0 and f1 of ISO 15312, remembered apart from them, which are those at a load of
0.05 C0.
"""

SLOW = 2000.0
"""Product ν n [mm²/s · r/min] below which Palmgren's viscous part is taken not to depend on speed.
Tag R.
"""

SKF_SERIES: dict[
    str, tuple[tuple[float, float, float, float], tuple[float, float, float, float]]
] = {
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

Tag V: remembered, and found number by number the same in a public transcription of the catalogue's
table.
"""

BOUNDARY_FRICTION = 0.12
"""μ_bl of a turning bearing, tag V."""
STARTING_FRICTION = 0.15
"""μ_bl of a bearing that begins to turn, tag V."""
FILM_FRICTION = {"synthetic oil": 0.04, "mineral oil": 0.05, "transmission fluid": 0.1}
"""μ_EHL of a full film, tag V."""
STARVATION = {"grease": 6e-8, "low oil bath": 3e-8}
"""Replenishment constant K_rs, tag V; a bath that covers the lowest roller's axis does not starve.
"""
VISCOSITY_RANGE = (2.0, 500.0)
"""Kinematic viscosity for which the SKF model is stated [mm²/s], tag R; the drag takes a thicker
oil as the thickest.
"""
TYPE_FACTOR = 5.5
"""K_Z of double-row spherical roller bearings, tag V."""
ROLLER_FACTOR = 0.8
"""K_L of double-row spherical roller bearings, tag V."""
_NEWTON_METRE = 1e-3
_WHERE = "friction torque"


class _Operation(NamedTuple):
    """Dimensions, speed, viscosity and loads in the handbooks' units, all without sign."""

    bore: float  #: d [mm]
    outside: float  #: D [mm]
    width: float  #: B [mm]
    speed: FloatArray  #: n [r/min]
    viscosity: float  #: ν [mm²/s]
    radial_load: FloatArray  #: F_r [N]
    axial_load: FloatArray  #: F_a [N]

    @property
    def mean_diameter(self) -> float:
        """d_m = (d + D)/2 [mm]."""
        return (self.bore + self.outside) / 2


def _operation(
    bearing: Bearing,
    lubricant: Lubricant,
    radial_load: ArrayLike,
    axial_load: ArrayLike,
    shaft_speed: ArrayLike,
) -> _Operation:
    bore, outside, width = _need(bearing, "bore_diameter", "outside_diameter", "width")
    values = {"radial_load": radial_load, "axial_load": axial_load, "shaft_speed": shaft_speed}
    for name, value in values.items():
        number = np.asarray(value, dtype=float)
        if not np.all(np.isfinite(number)):
            fault = f"{name} holds a number that is not finite"
            raise InputError(fault, where=_WHERE, allowed="finite numbers")
    viscosity = lubricant.viscosity / lubricant.density * 1e6
    turning = np.abs(np.asarray(shaft_speed, dtype=float))
    return _Operation(
        bore=bore * 1e3,
        outside=outside * 1e3,
        width=width * 1e3,
        speed=turning * 30.0 / math.pi,
        viscosity=viscosity,
        radial_load=np.abs(np.asarray(radial_load, dtype=float)),
        axial_load=np.abs(np.asarray(axial_load, dtype=float)),
    )


def _need(bearing: Bearing, *keys: str) -> list[Any]:
    missing = [key for key in keys if getattr(bearing, key) is None]
    if missing:
        remedy = (
            "Add what is missing to the bearing's file: handbook estimates rest on catalogue data."
        )
        raise InputError(
            f"{bearing.name} has no {', no '.join(missing)}", where=_WHERE, remedy=remedy
        )
    return [getattr(bearing, key) for key in keys]


def _constants(series: str, table: Mapping[str, tuple]) -> tuple:
    if series not in table:
        fault = f"there are no constants for series {series!r}"
        remedy = "The series is the beginning of the bearing's designation: 240 for 240/600."
        raise InputError(fault, where=_WHERE, allowed=", ".join(table), remedy=remedy)
    return table[series]


_Torque = float | FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class PalmgrenTorque:
    """Friction torque [N m] by Palmgren, against the rotation.

    Floats, or arrays of the shape of the input.
    """

    viscous: _Torque  #: M0, which the oil causes without load: shear and churning
    #: M1, which the load causes at any speed: hysteresis of the steel and sliding within the
    #: contacts
    load: _Torque

    @property
    def total(self) -> _Torque:
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
    """Friction torque of a spherical roller bearing by Palmgren.

    It has the constants of DIN 732 and ISO 15312.

    With ν in mm²/s, n in r/min, d_m in mm, loads in N and torques in N mm (converted inside):

        M0 = 1e-7 f0 (ν n)^(2/3) d_m³,    at ν n < 2000: M0 = 160e-7 f0 d_m³
        M1 = f1 P1 d_m,                   f1 = z (P0/C0)^y
        P1 = 1.6 F_a/e where F_a > e F_r, F_r [1 + 0.6 (F_a/(e F_r))³] elsewhere
        P0 = F_r + Y0 F_a

    Parameters
    ----------
    bearing : Bearing
        With bore and outside diameter, static load rating and the axial factors e and Y0;
        InputError without.
    lubricant : Lubricant
        Oil, or base oil of the grease, at operating temperature.
    radial_load, axial_load, shaft_speed : array_like
        Load on the bearing [N] and speed of the inner ring [rad/s], finite; signs are dropped.
    series : str
        Dimension series: a key of `PALMGREN_SERIES`.

    Notes
    -----
    For bearings at normal loads whose lubricant has settled; fresh grease may double M0. Below ν n
    = 2000 the handbook
    gives a constant M0, and so does this function, down to standstill; there is a step of 0.8 % at
    that place. The
    load part depends on neither speed nor film: it is one of good lubrication. Handbooks do not
    state an error; the factors
    are rounded means over sizes.

    References
    ----------
    A. Palmgren, Ball and Roller Bearing Engineering, 3rd ed. (1959). T. A. Harris and M. N.
    Kotzalas, Essential
    Concepts of Bearing Technology, 5th ed. (2006), chapter 10. DIN 732 (2010), ISO 15312 (2003).
    All constants tag R.

    Examples
    --------
    >>> bearing, oil = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
    >>> torque = palmgren_torque(bearing, oil, 344e3, 164e3, 2.143)
    >>> print(f"{torque.viscous:.1f} + {torque.load:.1f} = {torque.total:.1f} N m")
    137.4 + 160.4 = 297.8 N m
    """
    viscous_factor, scale, exponent = _constants(series, PALMGREN_SERIES)
    rating, factor_e, factor_y0 = _need(
        bearing, "static_load_rating", "axial_factor_e", "axial_factor_y0"
    )
    case = _operation(bearing, lubricant, radial_load, axial_load, shaft_speed)
    flow = case.viscosity * case.speed
    fast = 1e-7 * np.cbrt(flow) ** 2
    by_flow = np.where(flow < SLOW, 160e-7, fast)
    viscous = viscous_factor * case.mean_diameter**3 * by_flow
    radial = case.radial_load
    thrust = case.axial_load / factor_e
    # Where thrust > radial this quotient is not used; without load it is 0/0.
    share = np.zeros(np.broadcast(thrust, radial).shape)
    np.divide(thrust, radial, out=share, where=radial > 0)
    share = np.minimum(share, 1.0)
    mostly_radial = radial * (1 + 0.6 * share**3)
    driving = np.where(thrust > radial, 1.6 * thrust, mostly_radial)
    static = radial + factor_y0 * case.axial_load
    load_factor = scale * (static / rating) ** exponent
    load = load_factor * driving * case.mean_diameter
    viscous, load = np.broadcast_arrays(viscous * _NEWTON_METRE, load * _NEWTON_METRE)
    return PalmgrenTorque(viscous=viscous[()], load=load[()])


@dataclass(frozen=True, slots=True)
class OilBath:
    """Oil bath of the lowest rollers.

    InputError for a value outside its range.
    """

    #: H: height of the oil above the lowest place of the outer raceway while the bearing is at rest
    #: [m], ≥ 0. The formula is for up to 1.2 times the mean diameter; a higher level counts as this
    #: one.
    level: float
    #: V_M [-], read from the catalogue's diagram for roller bearings over H/d_m, 0 to 0.01. The
    #: diagram has no formula. It belongs to the churning term, which is small in a slow bearing.
    drag_variable: float

    def __post_init__(self) -> None:
        ranges = {
            "level": (math.inf, "not negative, in metres"),
            "drag_variable": (0.01, "0 to 0.01"),
        }
        for name, (most, allowed) in ranges.items():
            value = getattr(self, name)
            if not (math.isfinite(value) and 0.0 <= value <= most):
                raise InputError(f"{name} is {value!r}", where="oil bath", allowed=allowed)


@dataclass(frozen=True, slots=True, eq=False)
class SkfTorque:
    """Friction torque [N m] of an open bearing by the SKF model, against the rotation.

    Floats or arrays as input.
    """

    #: φ_ish φ_rs M_rr: resistance of the oil that the contacts squeeze at their inlets
    rolling: _Torque
    sliding: _Torque  #: M_sl: sliding within the contacts
    drag: _Torque  #: M_drag: the rollers' way through an oil bath
    out_of_range: tuple[str, ...]  #: Values outside the range for which the model is stated

    @property
    def total(self) -> _Torque:
        """Sum of the parts [N m]."""
        return self.rolling + self.sliding + self.drag


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
    """Friction torque of an open spherical roller bearing by the SKF model.

    M = φ_ish φ_rs M_rr + M_sl + M_drag.

    With ν in mm²/s, n in r/min, d, D and d_m in mm, loads in N and torques in N mm (converted
    inside):

        M_rr = G_rr (ν n)^0.6
        G_rr = min[R1 d_m^1.85 (F_r + R2 F_a)^0.54,  R3 d_m^2.3 (F_r + R4 F_a)^0.31]
        φ_ish = 1/[1 + 1.84e-9 (n d_m)^1.28 ν^0.64]
        φ_rs = exp{−K_rs ν n (d + D) √[K_Z/(2 (D − d))]}
        M_sl = G_sl [φ_bl μ_bl + (1 − φ_bl) μ_EHL],    φ_bl = exp[−2.6e-8 (ν n)^1.4 d_m]
        G_sl = min[S1 d_m^0.25 (F_r⁴ + S2 F_a⁴)^(1/3),  S3 d_m^0.94 (F_r³ + S4 F_a³)^(1/3)]

    and M_drag by `_oil_bath_drag`.

    Parameters
    ----------
    bearing : Bearing
        With bore, outside diameter and width; InputError without.
    lubricant, radial_load, axial_load, shaft_speed
        As of `palmgren_torque`. At zero speed it is the torque of starting, with μ_bl = 0.15.
    series : str
        Dimension series: a key of `SKF_SERIES`.
    oil : str
        A key of `FILM_FRICTION`.
    bath : OilBath, optional
        The oil bath; without one the bearing is lubricated by grease and has no drag.

    Notes
    -----
    Stated for steady operation at constant load of at least the recommended minimum, hours after
    greasing, normal
    clearance, and ν from 2 to 500 mm²/s; a thicker oil is computed all the same and noted in
    `out_of_range`. Whether a
    bath starves the contacts is decided by whether it reaches the axis of the lowest roller (tag
    E).

    References
    ----------
    SKF, Rolling bearings, PUB BU/P1 17000 (2018), section "The SKF model for calculating the
    frictional moment".
    Formulas and constants from memory, then confirmed in public excerpts of the catalogue and in
    transcriptions of it,
    except for numbers tagged R or E.

    Examples
    --------
    >>> bearing, oil = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
    >>> torque = skf_torque(bearing, oil, 344e3, 164e3, 2.143)
    >>> print(f"{torque.rolling:.1f} + {torque.sliding:.1f} = {torque.total:.1f} N m")
    270.3 + 82.9 = 353.1 N m
    >>> torque.out_of_range
    ('viscosity is 600 mm2/s; the model is stated for 2 to 500 mm2/s',)
    """
    rolling_constants, sliding_constants = _constants(series, SKF_SERIES)
    if oil not in FILM_FRICTION:
        raise InputError(
            f"there is no oil {oil!r}", where="friction torque", allowed=", ".join(FILM_FRICTION)
        )
    case = _operation(bearing, lubricant, radial_load, axial_load, shaft_speed)
    if bath is None:
        starvation = STARVATION["grease"]
        drag = np.zeros_like(case.speed)
    else:
        covered = bath.level >= bearing.roller_diameter / 2
        starvation = 0.0 if covered else STARVATION["low oil bath"]
        drag = _oil_bath_drag(case, bath)
    rolling = _skf_rolling(case, rolling_constants, starvation)
    sliding = _skf_sliding(case, sliding_constants, FILM_FRICTION[oil])
    rolling, sliding, drag = np.broadcast_arrays(
        rolling * _NEWTON_METRE, sliding * _NEWTON_METRE, drag * _NEWTON_METRE
    )
    low, high = VISCOSITY_RANGE
    notes = []
    if not low <= case.viscosity <= high:
        notes.append(
            f"viscosity is {case.viscosity:.4g} mm2/s; the model is stated for {low:g} to {high:g} mm2/s"
        )
    return SkfTorque(rolling[()], sliding[()], drag[()], tuple(notes))


def _skf_rolling(case: _Operation, constants: tuple, starvation: float) -> FloatArray:
    """φ_ish φ_rs M_rr [N mm]; G_rr is the smaller of the catalogue's G_rr.e and G_rr.l."""
    r1, r2, r3, r4 = constants
    d_m = case.mean_diameter
    radial = case.radial_load
    axial = case.axial_load
    flow = case.viscosity * case.speed
    elliptic_load = radial + r2 * axial
    linear_load = radial + r4 * axial
    elliptic = r1 * d_m**1.85 * elliptic_load**0.54
    linear = r3 * d_m**2.3 * linear_load**0.31
    least = np.minimum(elliptic, linear)
    sheared = 1.84e-9 * (case.speed * d_m) ** 1.28 * case.viscosity**0.64
    heating = 1 / (1 + sheared)
    filled = replenishment(
        case.viscosity * 1e-6, case.speed * math.pi / 30.0, case.bore * 1e-3, case.outside * 1e-3,
        constant=starvation, type_factor=TYPE_FACTOR,
    )  # fmt: skip
    return heating * filled * least * flow**0.6


def _skf_sliding(case: _Operation, constants: tuple, film: float) -> FloatArray:
    """M_sl [N mm]; G_sl is the smaller of the catalogue's G_sl.e and G_sl.l."""
    s1, s2, s3, s4 = constants
    d_m = case.mean_diameter
    radial = case.radial_load
    axial = case.axial_load
    flow = case.speed * case.viscosity
    elliptic_load = radial**4 + s2 * axial**4
    linear_load = radial**3 + s4 * axial**3
    elliptic = s1 * d_m**0.25 * np.cbrt(elliptic_load)
    linear = s3 * d_m**0.94 * np.cbrt(linear_load)
    least = np.minimum(elliptic, linear)
    boundary = np.exp(-2.6e-8 * flow**1.4 * d_m)
    touching = np.where(case.speed > 0, BOUNDARY_FRICTION, STARTING_FRICTION)
    friction = boundary * touching + (1 - boundary) * film
    return least * friction


def _oil_bath_drag(case: _Operation, bath: OilBath) -> FloatArray:
    """Drag torque of the rollers in an oil bath by the SKF model [N mm].

        M_drag = 4 V_M K_roll C_w B d_m⁴ n² + 1.093e-7 n² d_m³ (n d_m² f_t/ν)^(−1.379) R_s
        K_roll = K_L K_Z (d + D)/(D − d) 1e-12
        C_w = 2.789e-10 l³ − 2.786e-4 l² + 0.0195 l + 0.6439,    l = 5 K_L B/d_m
        t = 2 arccos[(0.6 d_m − H)/(0.6 d_m)],    f_t = sin(t/2) up to t = π, then 1
        R_s = 0.36 d_m² (t − sin t) f_A,    f_A = 0.05 K_Z (D + d)/(D − d)

    For a large oil sump, the shaft horizontal, the inner ring turning. The first term is churning,
    the second the entrance of the rollers into the oil.

    SKF, Rolling bearings, PUB BU/P1 17000 (2018), section "Drag losses". From memory, then
    confirmed in a public transcription (V), except for the cubic term of C_w, which is negligible,
    for t and f_t, and for the bounds (R).
    """
    d_m = case.mean_diameter
    spread = (case.outside + case.bore) / (case.outside - case.bore)
    if bath.level == 0.0:
        return np.zeros_like(case.speed)
    level = bath.level * 1e3
    cosine = 1 - level / (0.6 * d_m)
    angle = 2 * math.acos(max(-1.0, cosine))
    immersion = 1.0
    if angle <= math.pi:
        immersion = math.sin(angle / 2)
    span = 5 * ROLLER_FACTOR * case.width / d_m
    shape = 2.789e-10 * span**3 - 2.786e-4 * span**2 + 0.0195 * span + 0.6439
    roll = ROLLER_FACTOR * TYPE_FACTOR * spread * 1e-12
    churning = 4 * bath.drag_variable * roll * shape * case.width * d_m**4 * case.speed**2
    segment = angle - math.sin(angle)
    surface = 0.36 * d_m**2 * segment * 0.05 * TYPE_FACTOR * spread
    # n² (n …)^(−1.379) written as one power of n, which vanishes at standstill.
    viscosity = min(case.viscosity, VISCOSITY_RANGE[1])
    number = d_m**2 * immersion / viscosity
    entrance = 1.093e-7 * d_m**3 * number**-1.379 * surface * case.speed**0.621
    return churning + entrance


class TorqueHistory(NamedTuple):
    """A friction torque over time."""

    time: FloatArray  #: [s]
    torque: FloatArray  #: Torque against the rotation [N m]


def torque_histories(
    computed: Mapping[str, xr.Dataset], loads: BearingLoads, bearing: Bearing, lubricant: Lubricant
) -> dict[str, TorqueHistory]:
    """Friction torque over time by computed models and by the handbooks' formulas.

    The formulas hold for steady running; over time they are a chain of steady states.

    Parameters
    ----------
    computed : mapping of str to Dataset
        Results of `computed_torque`, by the name of their model; the handbooks are evaluated over
        the times that all have in common.
    loads : BearingLoads
        Forces [N] and shaft speed [rad/s] over time.
    bearing : Bearing
        Its dimensions.
    lubricant : Lubricant
        Its viscosity and density.

    Returns
    -------
    dict of str to TorqueHistory
        The models, "SKF, sliding", "SKF, all" and "Palmgren, all" [N m].

    Examples
    --------
    >>> loads = BearingLoads.constant([0.0, -344e3, 164e3], 2.143, 1.0)
    >>> bearing, oil = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
    >>> histories = torque_histories({}, loads, bearing, oil)
    >>> [f"{name}: {history.torque[0]:.0f} N m" for name, history in histories.items()]
    ['SKF, sliding: 83 N m', 'SKF, all: 353 N m', 'Palmgren, all: 298 N m']
    """
    simulated = {
        f"model {name}": TorqueHistory(history.time.values, history.torque.values)
        for name, history in computed.items()
    }
    times = [history.time.values for history in computed.values()]
    starts = [time[0] for time in times]
    ends = [time[-1] for time in times]
    start = max(starts, default=loads.start)
    end = min(ends, default=loads.end)
    common = (loads.time >= start) & (loads.time <= end)
    operation = (
        bearing,
        lubricant,
        loads.radial_load[common],
        loads.axial_load[common],
        loads.shaft_speed[common],
    )
    skf = skf_torque(*operation)
    by_handbook = {
        "SKF, sliding": skf.sliding,
        "SKF, all": skf.total,
        "Palmgren, all": palmgren_torque(*operation).total,
    }
    time = loads.time[common]
    estimated = {name: TorqueHistory(time, torque) for name, torque in by_handbook.items()}
    return simulated | estimated
