"""Rolling resistance of a contact from no load to an elastohydrodynamic film, and light contacts.

Both surfaces are sheared by the pressure's gradient: F_R = ½ ∫ h ∂p/∂x dA on each, against its
motion. The inclined pressure pushes body i along its motion with 2 F_R R/R_i, 1/R = 1/R_1 + 1/R_2
with signs, so that all four add up to 0. The surfaces lose 2 F_R u, u their mean speed, and the
film dissipates it; sliding has no part in it.

An elastic contact is taken in slices along the roller: where F_R per length does not depend on load
they give 2a F_R(w_c), where it goes with the root of load (π/2) a F_R(w_c), w_c = 3Q/(4a) the load
of the middle slice. One slice of w = (π²/16) w_c over 2a meets both, and lies within 1.5 % of the
slices between them.

In Moes' groups M = W (2U)^(−½) and L = G (2U)^¼ the contact has N_F = F_R/(E' R l) (2U)^(−¾). It
joins Martin's rigid, isoviscous limit N_R = 1.4705 √M and an elastic limit N_E with order n, N_F =
(N_R^(−n) + N_E^(−n))^(−1/n). With the share of the rigid limit g = N_R^(−n)/(N_R^(−n) + N_E^(−n)),

    F_R = F_F (F_G/F_R,line)^g f^(1−g) + (1 − g) F_B,

F_G the resistance of the rigid gap of finite length, and f = f_T f_S the factors of heating and
starvation of an elastic inlet. F_B is the resistance of the film beside Hertz' ellipse, a ≤ |z| ≤
l/2, where the gap is h0 + (z² − a²)/(2R_y) and every slice Martin's:

    F_B = 2 · 4.601 η0 u √(2 R_x R_y) ln{[l/2 + √(l²/4 + 2R_y h0 − a²)]/[a + √(2R_y h0)]}.

A light contact gets F_G, a heavy one f N_E over its ellipse and F_B beside it.
`macroslip.contact.gap` has the rigid gap.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.special import expit

from macroslip.contact.film import joined, log_moes, thermal_loading
from macroslip.contact.gap import (
    FLOW,
    ROLLING,
    ROLLING_AT_GAP,
    Gap,
    GapShape,
    film_at_gap,
    film_at_load,
    prepare_gap,
)
from macroslip.contact.interface import Interface
from macroslip.contact.starvation import inlet_at_gap, rigid_rolling_factor
from macroslip.errors import InputError

GOKSEM_HARGREAVES_REFERENCE = (
    "Goksem and Hargreaves, J. Lubr. Technol. 100 (1978) 346 and 353, doi:10.1115/1.3453183"
)
BIBOULET_HOUPERT_REFERENCE = (
    "Biboulet and Houpert, Proc. IMechE J 224 (2010) 763 and 777, doi:10.1243/13506501JET608"
)
#: Choices of `rolling:`, and works to cite for each.
REFERENCES = {
    "none": "",
    "inlet": f"{GOKSEM_HARGREAVES_REFERENCE}; {BIBOULET_HOUPERT_REFERENCE}",
    "whole-film": "full solutions of the line contact, benchmarks/line_contact.py",
}

#: N_R/√M.
RIGID = ROLLING / math.sqrt(2.0)
_LOG_FLOW = math.log(FLOW)
_LOG_RIGID = math.log(RIGID)
#: ln of the load per length of the slice that stands for an ellipse, over that of its middle.
LOG_SLICE = math.log(math.pi**2 / 16.0)

#: Order with which the rigid limit joins each elastic one.
ORDERS = {"inlet": 10.0, "whole-film": 3.64}


def starvation_factor(inlet):
    """Rolling resistance over that of a flooded inlet, (S² + 162.8 S)/(S² + 193.1 S + 1257) [-].

    It is below 1.

    S is the film where the inlet begins to be full over the film of the contact, ≥ 1; infinite
    where flooded.

    Biboulet and Houpert, Proc. IMechE J 224 (2010) 777. Coefficients as later works quote them.

    Examples
    --------
    >>> round(starvation_factor(10.0), 4), starvation_factor(float("inf"))
    (0.5255, 1.0)
    """
    inverse = 1.0 / inlet
    return (1.0 + 162.8 * inverse) / (1.0 + (193.1 + 1257.0 * inverse) * inverse)


def replenishment(kinematic_viscosity, speed, bore, outside, *, constant=6e-8, type_factor=5.5):
    """Rolling resistance with kinematic replenishment over the flooded one, in the SKF model.

    φ_rs = exp{−K_rs ν n (d + D) √[K_Z/(2 (D − d))]}, with ν in mm²/s, n in r/min, d and D in mm. A
    thick oil and a fast bearing leave less time and way for what a roller pushes aside to flow
    back. φ_rs [-] is above 0 and at most 1, and stated for steady running, ν from 2 to 500 mm²/s.

    Parameters
    ----------
    kinematic_viscosity : array_like
        ν of the oil, or of the grease's base oil, at operating temperature [m²/s], ≥ 0.
    speed : array_like
        Speed of the turning ring [rad/s]; its sign is dropped.
    bore, outside : float
        d and D > d of the bearing [m].
    constant : float
        K_rs: 6e-8 for grease and oil-air, 3e-8 for a low oil bath, 0 where oil covers the lowest
        roller's axis.
    type_factor : float
        K_Z; 5.5 for double-row spherical, 5.1 for cylindrical roller bearings with a cage.

    References
    ----------
    SKF, Rolling bearings, PUB BU/P1 17000 (2018), section "The SKF model for calculating the
    frictional moment".

    Examples
    --------
    >>> round(float(replenishment(600e-6, 2.143, 0.6, 0.87)), 3)
    0.896
    """
    flow = 1e6 * kinematic_viscosity * np.abs(speed) * 30.0 / math.pi
    return np.exp(
        -constant
        * flow
        * (bore + outside)
        * 1e3
        * math.sqrt(type_factor / (2e3 * (outside - bore)))
    )


def inlet_heating_of_rolling(loading):
    """Rolling resistance over that of an isothermal inlet, 1/(1 + 0.29 L_T^0.78) [-].

    It is above 0 and at most 1.

    L_T = η0 β u²/k ≥ 0 is the thermal loading parameter.

    Goksem and Hargreaves, J. Lubr. Technol. 100 (1978) 353. Coefficients as later works quote them.

    Examples
    --------
    >>> float(round(inlet_heating_of_rolling(0.038), 4))
    0.9779
    """
    return 1.0 / (1.0 + 0.29 * np.power(loading, 0.78))


def log_elastic(name: str, log_load, log_material):
    """Ln of the elastic limit N_E of a line contact, from ln M and ln L.

    Parameters
    ----------
    name : str
        `inlet`: the lower of Biboulet and Houpert's 1.470 and Goksem and Hargreaves' 2.737
        L^(−0.342) M^0.0126, joined with order 10, the order with which Biboulet and Houpert join
        their limits. In Moes' groups Goksem and Hargreaves' F_R α_p/(R l) = 4.318 (G U)^0.658
        W^0.0126 is left with (2U)^(−0.0002), which is dropped.
        `whole-film`, inlet and exit, a fit:
        N_E = 2.026 exp(−0.00481 L) (1 + 1.97 M)^(−0.0692 L/(L + 4.71)).
    log_load, log_material : array_like

    Notes
    -----
    Of the whole film N_F is within 3 % of the solutions of `benchmarks/line_contact.py` for M = 0.1
    to 60, L = 0 to 18, with Barus' law. With Roelands' law and a compressible oil (0.54 Pa s, 21
    GPa⁻¹, L = 13.4) solutions lie within 5 % of it for M = 1 to 32.

    Examples
    --------
    >>> [round(math.exp(log_elastic(name, math.log(10.0), math.log(13.4))), 3) for name in ("inlet", "whole-film")]
    [1.149, 1.627]
    """
    if name == "inlet":
        coefficient = math.log(4.318 * 2.0**-0.658)
        heavy = coefficient - 0.342 * log_material + 0.0126 * log_load
        return joined(heavy, math.log(1.42 / 0.966), -ORDERS[name])
    load = np.exp(log_load)
    material = np.exp(log_material)
    power = 0.0692 * material / (material + 4.71)
    return math.log(2.026) - 0.00481 * material - power * np.log1p(1.97 * load)


def line_rolling(name: str, load, material):
    """Rolling resistance N_F = F_R/(E' R l) (2U)^(−¾) [-] of a line contact, rigid to elastic.

    The contact is flooded and isothermal, isoviscous or piezoviscous.

    `name` is `inlet` or `whole-film`, see `log_elastic`; M and L are > 0.

    Examples
    --------
    >>> [float(round(line_rolling(name, 11.0, 13.4), 3)) for name in ("whole-film", "inlet")]
    [1.611, 1.151]
    >>> float(round(line_rolling("inlet", 1e-4, 13.4) * 100.0, 4))
    1.4705
    """
    log_m = np.log(load)
    rigid = _LOG_RIGID + 0.5 * log_m
    elastic = log_elastic(name, log_m, np.log(material))
    return np.exp(joined(rigid, elastic, -ORDERS[name]))


class Plug(NamedTuple):
    """Plug of grease that stands between the surfaces."""

    per_length: float = 0.0  #: Yield stress times length [N/m]
    double_radius: float = 0.0  #: 2 R_x [m]
    longest: float = 0.0  #: Longest way on one side of the gap [m]


class RollingNumbers(NamedTuple):
    """Rolling resistance of one contact."""

    name: str  #: `inlet` or `whole-film`: what counts of an elastic film
    gap: Gap  #: The rigid gap
    viscosity: float  #: η0 [Pa s]
    log_load: float  #: ln M of the middle slice at 1 N and 1 m/s; M goes with Q^(2/3) u^(−½)
    log_material: float  #: ln L at 1 m/s; L goes with u^¼
    log_film: float  #: ln of R (2U)^½ at 1 m/s [ln m]
    log_scale: float  #: ln of 2a E' R (2U)^¾ at 1 N and 1 m/s [ln N]; it goes with Q^(1/3) u^¾
    loading: float  #: Thermal loading parameter η0 β u²/k at 1 m/s [s²/m²]; 0 leaves heating out
    beside: float  #: 2 · 4.601 η0 √(2 R_x R_y) [N s/m]
    double_lateral: float  #: 2 R_y [m]
    half_length: float  #: l/2 [m]
    across: float  #: a per Q^(1/3) [m/N^(1/3)]
    area: float  #: π a b per Q^(2/3) [m²/N^(2/3)]
    share_1: float  #: R/R_1 of the roller; that of its counterpart makes 1 of it
    #: Gap where inlets begin to be full [m], which starves every contact by its own film; infinite
    #: where flooded.
    oil_gap: float = math.inf
    plug: Plug = Plug()  #: Plug of grease; none by default


def prepare_rolling(
    name: str,
    interface: Interface,
    shape: GapShape,
    roller_radius: float,
    *,
    oil_gap: float = math.inf,
    widest_inlet: float = math.inf,
    heating: bool = True,
) -> RollingNumbers | None:
    """Rolling resistance of a contact; None for `none`.

    Raises InputError if there is no such law.

    Parameters
    ----------
    name : str
        `none`, `inlet` (as published: the inlet alone) or `whole-film` (inlet and exit).
    shape : GapShape
        Geometry of the gap.
    roller_radius : float
        [m].
    oil_gap : float
        Gap where the inlet begins to be full [m]; over the film it is S. The elastic contact takes
        Biboulet and Houpert's factor, the rigid one `starved_martin`. Infinite where flooded.
    widest_inlet : float
        Largest S of the rigid contact; see `prepare_gap`.
    heating : bool
        Whether the elastic inlet is heated by its shear.
    """
    if name not in REFERENCES:
        fault = f"there is no rolling law '{name}'"
        raise InputError(
            fault, where="laws.rolling", allowed=", ".join(REFERENCES), remedy="Choose one of these"
        )
    if name == "none":
        return None
    radius = interface.rolling_radius
    modulus = interface.modulus
    oil = interface.lubricant
    across = interface.hertz.semi_axis_across
    doubled = 2.0 * oil.viscosity / (modulus * radius)
    per_root = oil.viscosity * math.sqrt(2.0 * shape.rolling_radius * shape.lateral_radius)
    return RollingNumbers(
        name=name,
        gap=prepare_gap(shape, oil_gap, widest_inlet),
        viscosity=oil.viscosity,
        log_load=math.log(0.75 / across / (modulus * radius)) - 0.5 * math.log(doubled),
        log_material=math.log(oil.pressure_viscosity * modulus) + 0.25 * math.log(doubled),
        log_film=math.log(radius) + 0.5 * math.log(doubled),
        log_scale=math.log(2.0 * across * modulus * radius) + 0.75 * math.log(doubled),
        loading=thermal_loading(interface.lubricant) if heating else 0.0,
        beside=2.0 * ROLLING_AT_GAP * per_root,
        double_lateral=2.0 * shape.lateral_radius,
        half_length=0.5 * shape.length,
        across=across,
        area=math.pi * across * interface.hertz.semi_axis_along,
        share_1=radius / roller_radius,
        oil_gap=oil_gap,
        plug=Plug(
            shape.length * (oil.grease_yield_stress or 0.0),
            2.0 * shape.rolling_radius,
            roller_radius,
        ),
    )


def at_oil_gap(numbers: RollingNumbers, oil_gap: float) -> RollingNumbers:
    """A copy with inlets that are full from another gap on [m]."""
    shape = GapShape(
        0.5 * numbers.plug.double_radius, 0.5 * numbers.double_lateral, 2.0 * numbers.half_length
    )
    return numbers._replace(oil_gap=oil_gap, gap=prepare_gap(shape, oil_gap))


def _log_group(numbers: RollingNumbers, log_load, log_speed):
    return log_load - log_speed - math.log(numbers.viscosity)


def _log_film(numbers: RollingNumbers, log_gap, log_load, log_speed):
    """Ln of the film of the volume flow, by Moes' blend.

    Its rigid, isoviscous limit is the gap of finite length.
    """
    scale = numbers.log_film + 0.5 * log_speed
    log_m = numbers.log_load + (2.0 / 3.0) * log_load - 0.5 * log_speed
    return scale + log_moes(
        log_gap + _LOG_FLOW - scale, log_m, numbers.log_material + 0.25 * log_speed
    )


def _beside(numbers: RollingNumbers, log_load, log_speed, log_h0):
    half = numbers.half_length
    across = np.minimum(numbers.across * np.exp(log_load / 3.0), half)
    rise = numbers.double_lateral * np.exp(log_h0)
    far = np.sqrt(half * half + rise - across * across)
    near = across + np.sqrt(rise)
    length = np.log((half + far) / near)
    resistance = numbers.beside * np.exp(log_speed) * length
    return np.where(across < half, resistance, 0.0)


def light_contact(numbers: RollingNumbers, load, mean_speed):
    """Film, rolling resistance and sliding of a contact under load, rigid or elastic.

    Parameters
    ----------
    load : array_like
        Q [N], > 0.
    mean_speed : array_like
        Size of the mean surface speed u [m/s], > 0.

    Returns
    -------
    conductance : ndarray
        Sliding force of the film outside Hertz' ellipse over slip [N s/m]: η0 S with S = ∫∫ dA/h
        less the ellipse's own part, S²/(S + π a b/h). Inside the ellipse it is the traction law's.
    resistance : ndarray
        F_R [N]. The shear on the roller is −F_R sign(u), the push of the pressure −2 R/r times
        that, the power 2 F_R u.
    flow_film : ndarray
        Film of the volume flow [m].

    Examples
    --------
    >>> from macroslip import Bearing, Lubricant
    >>> from macroslip.bearing import geometry
    >>> from macroslip.contact.interface import interfaces
    >>> bearing = Bearing.read("skf-240-600-bc")
    >>> inner, outer, cage = interfaces(bearing, Lubricant.read("vg460-pao"))
    >>> curved = geometry.inner_curvatures(bearing)
    >>> shape = GapShape(1.0 / curved.rolling, 1.0 / curved.lateral, bearing.roller_length)
    >>> numbers = prepare_rolling("whole-film", inner, shape, geometry.roller_radius(bearing))
    >>> [float(f"{x:.4g}") for x in light_contact(numbers, 100.0, 0.4)]
    [4.755, 2.846, 2.502e-05]
    """
    log_load, log_speed = np.broadcast_arrays(np.log(load), np.log(mean_speed))
    log_gap, log_rolling, _ = film_at_load(numbers.gap, _log_group(numbers, log_load, log_speed))
    log_film = _log_film(numbers, log_gap, log_load, log_speed)
    # No film is thicker than the oil that there is.
    log_flow = (
        joined(log_film, math.log(numbers.oil_gap), -8.0)
        if math.isfinite(numbers.oil_gap)
        else log_film
    )
    _, _, log_shear = film_at_gap(numbers.gap, log_flow - _LOG_FLOW)
    shear = np.exp(log_shear)
    film = np.exp(log_flow)
    inside = numbers.area * np.exp((2.0 / 3.0) * log_load) / film
    conductance = numbers.viscosity * shear * shear / (shear + inside)
    return (
        conductance,
        _resistance(numbers, log_load, log_speed, log_rolling, log_film - _LOG_FLOW),
        film,
    )


def _resistance(numbers: RollingNumbers, log_load, log_speed, log_rolling, log_h0):
    order = ORDERS[numbers.name]
    log_m = numbers.log_load + LOG_SLICE + (2.0 / 3.0) * log_load - 0.5 * log_speed
    elastic = log_elastic(numbers.name, log_m, numbers.log_material + 0.25 * log_speed)
    rigid = _LOG_RIGID + 0.5 * log_m
    line = joined(rigid, elastic, -order)
    # Shares of the rigid and of the elastic limit; neither is one less the other, which would
    # cancel.
    rigid_share = expit(order * (elastic - rigid))
    elastic_share = expit(order * (rigid - elastic))
    scale = numbers.log_scale + log_load / 3.0 + 0.75 * log_speed
    unit = math.log(numbers.viscosity) + log_speed
    light = log_rolling + unit - scale - rigid
    heavy = 0.0
    beside = _beside(numbers, log_load, log_speed, log_h0)
    if math.isfinite(numbers.oil_gap):
        inlet = inlet_at_gap(numbers.oil_gap, np.exp(log_h0 + _LOG_FLOW))
        heavy = np.log(starvation_factor(inlet))
        beside = beside * rigid_rolling_factor(inlet)
    if numbers.loading > 0.0:
        loading = numbers.loading * np.exp(2.0 * log_speed)
        heavy = heavy + np.log(inlet_heating_of_rolling(loading))
    force = np.exp(scale + line + rigid_share * light + elastic_share * heavy)
    plug = plug_force(numbers, np.exp(log_h0))
    return force + elastic_share * beside + rigid_share * plug


def plug_force(numbers: RollingNumbers, gap):
    """Force [N] of a grease's yield stress on each surface, on one side of the smallest gap h0 [m].

    τ_y l √(2 R_x (h_e − h0)): the walls slide past grease that stands, as far as the gap is full, h
    ≤ h_e, and at most a roller's radius away.
    """
    reach = np.maximum(numbers.oil_gap - gap, 0.0)
    return numbers.plug.per_length * np.minimum(
        np.sqrt(numbers.plug.double_radius * reach), numbers.plug.longest
    )


def contact_at_gap(numbers: RollingNumbers, gap):
    """Load and friction of a rigid, isoviscous contact whose smallest gap h0 [m] > 0 is given.

    So is that of a roller with play.

    Load, conductance and resistance are per speed [N s/m]: Q over the size of the mean surface
    speed, sliding force over slip, and F_R over the mean speed.
    """
    log_load, log_rolling, log_shear = film_at_gap(numbers.gap, np.log(gap))
    return tuple(
        numbers.viscosity * np.exp(logarithm) for logarithm in (log_load, log_shear, log_rolling)
    )


def rigid_pocket_contact(numbers: RollingNumbers, load, mean_speed, widest):
    """Rigid, isoviscous contact of a roller in its cage pocket, which bounds the gap.

    h0^−4 = h0(Q)^−4 + widest^−4: under no load the roller floats in the middle of its pocket.

    Parameters
    ----------
    numbers : RollingNumbers
        Constants of the contact with the spar.
    load : array_like
        Q [N], ≥ 0, which the spar alone carries.
    mean_speed : array_like
        Size of the mean surface speed [m/s], > 0.
    widest : float
        Largest gap [m], > 0.

    Returns
    -------
    conductance : ndarray
        Sliding force over slip [N s/m].
    resistance : ndarray
        F_R over the mean speed [N s/m].
    """
    with np.errstate(divide="ignore"):
        log_group = _log_group(numbers, np.log(load), np.log(mean_speed))
    carries = np.isfinite(log_group)
    free, _, _ = film_at_load(numbers.gap, np.where(carries, log_group, 0.0))
    log_widest = math.log(widest)
    log_gap = np.where(carries, joined(free, log_widest, -4.0), log_widest)
    _, conductance, resistance = contact_at_gap(numbers, np.exp(log_gap))
    if numbers.plug.per_length:
        # The roller slides past the grease of both sides with its surface speed, twice the mean.
        conductance = conductance + plug_force(numbers, np.exp(log_gap)) / mean_speed
    return conductance, resistance
