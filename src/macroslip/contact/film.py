"""Film thickness by Masjedi and Khonsari, by Moes, and by both for every load, with corrections.

A law is a function of an interface, of load Q [N] and of entrainment speed u_e [m/s], both arrays
above zero, and gives the film thickness h [m]. All take the elliptical contact as a line with w =
3Q/(4a): of all equivalent lengths only this keeps both the maximum pressure and the width along
rolling. That is right where the contact is elastic. In a rigid contact pressure spreads beyond the
Hertz ellipse, at most to the roller's length, and the film is thicker; for cage contacts and
unloaded rollers it is therefore an estimate from below.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.contact.interface import Interface
from macroslip.lubricant import Lubricant
from macroslip.lubricant.temperature import dowson_higginson

MASJEDI_KHONSARI_REFERENCE = (
    "Masjedi and Khonsari, J. Tribol. 134 (2012) 011503, doi:10.1115/1.4005514"
)
MOES_REFERENCE = (
    "Moes, Lubrication and Beyond, University of Twente (2000), as in Gelinck and Schipper, Tribol. Int. 33 (2000) 175, "
    "doi:10.1016/S0301-679X(00)00024-4"
)
BLEND_REFERENCE = f"{MASJEDI_KHONSARI_REFERENCE}; for light loads {MOES_REFERENCE}"
INLET_HEATING_REFERENCE = (
    "inlet shear heating in pure rolling as in Greenwood and Kauzlarich, J. Lubr. Technol. 95 (1973) 417, "
    "doi:10.1115/1.3451844"
)

#: Ranges of the dimensionless groups in which Masjedi and Khonsari's formula was fitted.
RANGES = {
    "load": (2e-5, 5e-4),
    "speed": (1e-12, 1e-10),
    "material": (2500.0, 7500.0),
    "roughness": (0.0, 5e-5),
    "hardness": (0.005, 0.03),
}
#: Loads M and lubricant parameters L up to which Moes' formula was compared with full numerical
#: solutions.
HIGHEST_COMPARED_LOAD = 20.0
HIGHEST_COMPARED_MATERIAL = 15.0

_LOG_HEAVY = math.log(RANGES["load"][0])
_DECADE = math.log(10.0)


class LineGroups(NamedTuple):
    """Dimensionless groups of an equivalent line contact.

    The load is W per Q^(2/3), the speed U per u_e.
    """

    load: float  #: W/Q^(2/3) [N^(−2/3)]
    speed: float  #: U/u_e [s/m]
    material: float  #: G [-]
    roughness: float  #: σ [-]
    hardness: float  #: V [-]


def line_groups(interface: Interface) -> LineGroups:
    """Groups of a contact, taken as a line."""
    radius = interface.rolling_radius
    modulus = interface.modulus
    oil = interface.lubricant
    return LineGroups(
        0.75 / interface.hertz.semi_axis_across / (modulus * radius),
        oil.viscosity / (modulus * radius),
        oil.pressure_viscosity * modulus,
        interface.roughness / radius,
        interface.hardness / modulus,
    )


def masjedi_khonsari_thickness(load, speed, material, roughness, hardness):
    """Dimensionless central film thickness H = h/R [-] of a rough line contact.

    H = 2.691 W^−0.135 U^0.705 G^0.556 (1 + 0.2 σ^1.222 V^0.223 W^−0.229 U^−0.748 G^−0.842)

    Parameters
    ----------
    load : array_like
        W = w/(E'R) with w the load per length, range 2e-5 to 5e-4.
    speed : array_like
        U = η0 u_e/(E'R), range 1e-12 to 1e-10.
    material : array_like
        G = α_p E', range 2500 to 7500.
    roughness : array_like
        σ = σ_rms/R, range 0 to 5e-5.
    hardness : array_like
        V = v/E', range 0.005 to 0.03.

    Notes
    -----
    Where roughness dominates, H hardly depends on speed and even falls with it, as U^−0.043.

    References
    ----------
    Masjedi and Khonsari, J. Tribol. 134 (2012) 011503, doi:10.1115/1.4005514.

    Examples
    --------
    >>> float(round(masjedi_khonsari_thickness(1e-4, 1e-11, 4846.0, 0.0, 0.03) * 1e5, 4))
    1.8365
    """
    log_load = np.log(load)
    log_speed = np.log(speed)
    smooth = 2.691 * np.power(material, 0.556)
    rough = (
        0.2 * np.power(roughness, 1.222) * np.power(hardness, 0.223) * np.power(material, -0.842)
    )
    return smooth * np.exp(-0.135 * log_load + 0.705 * log_speed) * (
        1.0 + rough * np.exp(-0.229 * log_load - 0.748 * log_speed)
    )  # fmt: skip


def masjedi_khonsari(interface: Interface, load, entrainment_speed):
    """Film thickness h [m] by `masjedi_khonsari_thickness` at loads [N] and speeds [m/s].

    It is given outside the range of the fit too.
    """
    groups = line_groups(interface)
    load_group = groups.load * np.cbrt(load) ** 2
    speed_group = groups.speed * np.asarray(entrainment_speed)
    return interface.rolling_radius * masjedi_khonsari_thickness(
        load_group, speed_group, *groups[2:]
    )


def loads_in_range(groups: LineGroups) -> tuple[float, float]:
    """Least and largest load Q of the range of W [N].

    Loads of many states are compared with these bounds: powers of each would take longer than all
    else that is computed of a state.
    """
    least, most = RANGES["load"]
    return (least / groups.load) ** 1.5, (most / groups.load) ** 1.5


def masjedi_khonsari_in_range(interface: Interface, load, entrainment_speed):
    """True where W and U are in `RANGES`.

    `masjedi_khonsari_notes` judges the groups that load and speed do not change.
    """
    groups = line_groups(interface)
    lightest, heaviest = loads_in_range(groups)
    slowest, fastest = RANGES["speed"]
    speed = np.asarray(entrainment_speed)
    load_is_in_range = (lightest <= load) & (load <= heaviest)
    speed_is_in_range = (slowest / groups.speed <= speed) & (speed <= fastest / groups.speed)
    return load_is_in_range & speed_is_in_range


def masjedi_khonsari_notes(interface: Interface) -> list[str]:
    """The groups that load and speed do not change, where they are outside `RANGES`."""
    group_values = line_groups(interface)._asdict()
    groups = [
        (name, group_values[name], *RANGES[name]) for name in ("material", "roughness", "hardness")
    ]
    return [
        f"the {name} group {value:.4g} is outside {low:g} to {high:g}"
        for name, value, low, high in groups
        if not low <= value <= high
    ]


def log_moes(log_rigid, log_load, log_material):
    """Ln of the dimensionless film N = (h/R) (2U)^−½ of a smooth line contact.

    It follows from ln H_RI, ln M and ln L.

    N = {(H_RI^(7/3) + H_EI^(7/3))^(3s/7) + (H_RP^(−7/2) + H_EP^(−7/2))^(−2s/7)}^(1/s),
    s = (7 + 8 exp(−2 H_EI/H_RI))/5,
    H_RI = 3/M, H_EI = 2.621 M^(−1/5), H_RP = 1.287 L^(2/3), H_EP = 1.311 M^(−1/8) L^(3/4)

    N [-] is the film where the pressure is highest, which is the film that the volume flow fills.
    In a rigid contact it is 1.226 times the smallest film, in an elastic one the film of the flat
    middle. In these terms 3/M and 1.287 L^(2/3) are exact limits of Reynolds' equation, to the
    digits given. M = W (2U)^(−½) > 0 and L = G (2U)^¼ ≥ 0, with W = w/(E'R), U = η0 u_e/(E'R) and G
    = α_p E'. The rigid, isoviscous limit H_RI may be that of another gap than a line contact's;
    logarithms may be of numbers beyond all that are stored.

    Smooth surfaces, flooded inlet, isothermal, Barus' law, incompressible. Within 5 % of full
    numerical solutions of that problem for M = 0.05 to 20 at L = 0 and 4, M = 0.05 to 2 at L = 8,
    and M = 0.05 to 1 at L = 15.

    Moes, Lubrication and Beyond, lecture notes, University of Twente (2000). The coefficients are
    those also given by Gelinck and Schipper, Tribol. Int. 33 (2000) 175,
    doi:10.1016/S0301-679X(00)00024-4.

    Examples
    --------
    >>> float(round(np.exp(log_moes(math.log(3.0), 0.0, math.log(10.0))), 4))
    6.9701
    """
    log_elastic = math.log(2.621) - 0.2 * log_load
    log_ratio = np.minimum(log_elastic - log_rigid, 700.0)
    order = 1.4 + 1.6 * np.exp(-2.0 * np.exp(log_ratio))
    isoviscous = joined(log_rigid, log_elastic, 7.0 / 3.0)
    piezoviscous = joined(
        math.log(1.287) + (2.0 / 3.0) * log_material,
        math.log(1.311) - 0.125 * log_load + 0.75 * log_material,
        -3.5,
    )
    return joined(isoviscous, piezoviscous, order)


def joined(first, second, order):
    """Ln(e^(n a) + e^(n b))/n of two logarithms a and b, for either sign of n.

    Examples
    --------
    >>> float(round(np.exp(joined(np.log(3.0), np.log(4.0), 2.0)), 12))
    5.0
    """
    return np.logaddexp(order * first, order * second) / order


def moes(interface: Interface, load, entrainment_speed):
    """Film thickness h [m] by `log_moes` at loads [N] and speeds [m/s], in range or not."""
    groups = line_groups(interface)
    return np.exp(
        _log_moes_film(groups, interface.rolling_radius, np.log(load), np.log(entrainment_speed))
    )


def _log_moes_film(groups: LineGroups, radius: float, log_load, log_speed):
    half = 0.5 * (math.log(2.0 * groups.speed) + log_speed)
    log_m = math.log(groups.load) + (2.0 / 3.0) * log_load - half
    log_film = log_moes(math.log(3.0) - log_m, log_m, math.log(groups.material) + 0.5 * half)
    return math.log(radius) + half + log_film


def moes_in_range(interface: Interface, load, entrainment_speed):
    """True where M and L are at most those at which the formula was compared.

    Lighter loads approach its exact limit. M goes with Q^(2/3) u^(−1/2) and L with u^(1/4), so that
    Q^4 and u are compared with what they are at these numbers.
    """
    groups = line_groups(interface)
    doubled = 2.0 * groups.speed * np.asarray(entrainment_speed)
    allowed = (HIGHEST_COMPARED_LOAD / groups.load) ** 2 * doubled
    square = np.square(load)
    is_light = square * square <= allowed * allowed * allowed
    return is_light & (doubled <= (HIGHEST_COMPARED_MATERIAL / groups.material) ** 4)


def masjedi_khonsari_moes(interface: Interface, load, entrainment_speed):
    """Film thickness h [m] for every load [N] and speed [m/s].

    Masjedi and Khonsari's film where it was fitted, and Moes' where the contact is lightly loaded.
    Both describe the same film. Where the first holds, Moes' film is thicker by 8 to 32 % (raceways
    of the base bearing, 0.1 to 1.3 m/s), because it leaves compressibility out; divided by the
    density ratio at the highest pressure it agrees within 4 %. So the film without roughness is,
    with S Masjedi and Khonsari's smooth film and N Moes' film over the density ratio,

        ln h_s = w ln S + (1 − w) ln N,

    where w rises from 0 to 1 over the decade of W below the lower end of the first one's range.
    Inside it w is 1.

    Roughness adds to the gap by Masjedi and Khonsari's formula, S times its roughness term, which
    goes with W^−0.364 U^−0.043. One decade below their ranges of W and U it is taken as constant:
    extrapolated, it would let the film of a stopping roller grow without bound. h is twice
    continuously differentiable and rises with speed.

    Examples
    --------
    >>> from macroslip import Bearing, Lubricant
    >>> from macroslip.contact.interface import interfaces
    >>> inner, outer, cage = interfaces(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"))
    >>> [float(round(1e6 * h, 2)) for h in masjedi_khonsari_moes(inner, np.array([30.0, 2e4]), 0.4)]
    [5.2, 1.32]
    """
    groups = line_groups(interface)
    radius = interface.rolling_radius
    log_load = np.log(load)
    log_speed = np.log(entrainment_speed)
    log_w = math.log(groups.load) + (2.0 / 3.0) * log_load
    log_u = math.log(groups.speed) + log_speed
    scale = math.log(radius * 2.691) + 0.556 * math.log(groups.material)
    heavy = scale - 0.135 * log_w + 0.705 * log_u
    density = dowson_higginson(interface.hertz.pressure * np.exp(log_load / 3.0))
    light = _log_moes_film(groups, radius, log_load, log_speed) - np.log(density)
    decades = np.clip((log_w - _LOG_HEAVY) / _DECADE + 1.0, 0.0, 1.0)
    weight = decades**3 * (10.0 - 15.0 * decades + 6.0 * decades * decades)
    smooth = np.exp(light + weight * (heavy - light))
    if groups.roughness <= 0.0:
        return smooth
    # Constant below a tenth of the least W and U of the range.
    level_w = np.logaddexp(2.0 * log_w, 2.0 * (_LOG_HEAVY - _DECADE))
    lowest_u = math.log(RANGES["speed"][0]) - _DECADE
    level_u = np.logaddexp(2.0 * log_u, 2.0 * lowest_u)
    rough = math.log(0.2) + 1.222 * math.log(groups.roughness) + 0.223 * math.log(groups.hardness)
    return smooth + np.exp(
        scale + rough - 0.842 * math.log(groups.material) - 0.182 * level_w - 0.0215 * level_u
    )  # fmt: skip


def masjedi_khonsari_moes_in_range(interface: Interface, load, entrainment_speed):
    """True where the formula that counts is in its range.

    That is the range of Masjedi and Khonsari's W and U, and below it that of Moes' M and L.
    """
    return np.where(
        load >= loads_in_range(line_groups(interface))[0],
        masjedi_khonsari_in_range(interface, load, entrainment_speed),
        moes_in_range(interface, load, entrainment_speed),
    )


def inlet_heating_factor(loading):
    """Film thickness over isothermal film thickness in pure rolling, φ_T = 1/(1 + 0.1 L^0.64) [-].

    It is above 0 and at most 1.

    Oil that the narrowing inlet turns back is sheared, warms up and thins. The thermal loading
    parameter is L = η0 β u_e²/k ≥ 0, with β the temperature coefficient of viscosity and k the
    conductivity of the oil.

    A fit for line contacts of oils, quoted from the literature from memory (tag R); slip, which
    heats the inlet more, is left out, as is the small effect of load. Flooded inlet: in a starved
    one less oil turns back.

    The effect: Greenwood and Kauzlarich, J. Lubr. Technol. 95 (1973) 417, doi:10.1115/1.3451844.

    Examples
    --------
    >>> float(round(inlet_heating_factor(1.0), 6))
    0.909091
    """
    return 1.0 / (1.0 + 0.1 * np.power(loading, 0.64))


def thermal_loading(oil: Lubricant) -> float:
    """Thermal loading parameter η0 β/k of an oil at 1 m/s [s²/m²].

    It goes with the square of speed.
    """
    return oil.viscosity * oil.temperature_viscosity / oil.thermal_conductivity
