"""Contact of a tapered roller's spherical large end with the rib of the inner ring.

The contact slides in pure rolling, at the speed w_i h_f with which roller and inner ring turn about
their common line. It is a Hertzian point contact with a film of its own, whose oil supply nobody
measures and which decides its friction.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.contact.hertz import HertzContact, effective_modulus, elliptical_contact
from macroslip.contact.mechanisms import Laws
from macroslip.contact.traction import chord_stress, prepare_fluid
from macroslip.lubricant import Lubricant

#: Stations across the sliding direction in which the film's shear is integrated (Gauss, Legendre).
_STATIONS, _STATION_WEIGHTS = np.polynomial.legendre.leggauss(16)
#: Film thickness over composite roughness: asperities' share of the load exp(−1.90 Λ^0.99).
_SHARE_FACTOR = 1.90
_SHARE_EXPONENT = 0.99


class RibContact(NamedTuple):
    """Rib contact of a bearing under a lubricant, without its load and speed."""

    hertz: HertzContact  #: Ellipse, pressure and approach by the load
    rolling_radius: float  #: Relative radius of curvature in the plane of rolling R_x [m]
    lateral_radius: float  #: Relative radius of curvature across it R_y [m]
    modulus: float  #: Effective modulus E' [Pa]
    roughness: float  #: Composite RMS roughness [m]
    oil_supply: float  #: Film over the film with a full inlet [-]
    lubricant: Lubricant  #: Oil at its temperature


class RibState(NamedTuple):
    """State of a rib contact under loads and at a speed; arrays of the shape of the loads."""

    pressure: np.ndarray  #: Largest Hertzian pressure p0 [Pa]
    half_along: np.ndarray  #: Semi-axis of the ellipse along rolling [m]
    half_across: np.ndarray  #: Semi-axis across rolling [m]
    film_thickness: np.ndarray  #: Central film thickness h [m]
    film_ratio: np.ndarray  #: Λ = h over composite roughness [-]
    asperity_share: np.ndarray  #: Share of the load that asperities carry [-]
    friction_coefficient: np.ndarray  #: µ = friction over load [-]
    power: np.ndarray  #: Friction times sliding speed [W]


def chittenden_thickness(
    load, entrainment_speed, rolling_radius, lateral_radius, modulus, lubricant
):
    """Central film thickness of an elliptical contact with entrainment along a principal axis [m].

    Parameters
    ----------
    load : array_like
        F [N], > 0.
    entrainment_speed : array_like
        u, mean of both surfaces' speeds relative to the contact [m/s], > 0.
    rolling_radius, lateral_radius : float
        Relative radii of curvature R_x in the direction of entrainment and R_y across it [m].
    modulus : float
        E' = 2/[(1−ν1²)/E1 + (1−ν2²)/E2] [Pa].
    lubricant : Lubricant
        With its viscosity η0 [Pa s] and pressure-viscosity coefficient α [1/Pa].

    Returns
    -------
    ndarray
        h = R_x 4.31 U^0.68 G^0.49 W^−0.073 (1 − exp(−1.23 (R_y/R_x)^(2/3))) [m], U = η0 u/(E' R_x),
        G = α E', W = F/(E' R_x²).

    Notes
    -----
    A fit of full solutions for elastic contacts of oils that grow stiff under pressure. On a circle
    it agrees with Hamrock and Dowson's formula within 2 %.

    References
    ----------
    Chittenden, Dowson, Dunn and Taylor, Proc. R. Soc. A 397 (1985) 245, doi:10.1098/rspa.1985.0014.

    Examples
    --------
    >>> oil = Lubricant.read("vg460-mineral")
    >>> film = chittenden_thickness(17.9e3, 0.24, 0.6, 0.74, 230.8e9, oil)
    >>> bool(1e-6 < film < 5e-6)
    True
    """
    speed = lubricant.viscosity * entrainment_speed / (modulus * rolling_radius)
    material = lubricant.pressure_viscosity * modulus
    force = load / (modulus * rolling_radius**2)
    aspect = (lateral_radius / rolling_radius) ** (2.0 / 3.0)
    shape = 1.0 - math.exp(-1.23 * aspect)
    by_speed = 4.31 * np.power(speed, 0.68)
    groups = by_speed * material**0.49 * np.power(force, -0.073)
    return rolling_radius * groups * shape


def rib_contact(bearing: TaperedBearing, lubricant: Lubricant) -> RibContact:
    """Rib contact of a bearing with a lubricant at its temperature.

    Parameters
    ----------
    bearing : TaperedBearing
    lubricant : Lubricant

    Returns
    -------
    RibContact
    """
    row = tapered_geometry(bearing)
    modulus = effective_modulus(*(bearing.youngs_modulus, bearing.poisson_ratio) * 2)
    return RibContact(
        hertz=elliptical_contact(row.rib_rolling_curvature, row.rib_lateral_curvature, modulus),
        rolling_radius=1.0 / row.rib_rolling_curvature,
        lateral_radius=1.0 / row.rib_lateral_curvature,
        modulus=modulus,
        roughness=bearing.rib_roughness,
        oil_supply=bearing.rib_oil_supply,
        lubricant=lubricant,
    )


def film_friction(contact: RibContact, load, film_thickness, sliding_speed, laws: Laws):
    """Friction of the sheared film at the rib [N], slip being the same all over the ellipse.

    Parameters
    ----------
    contact : RibContact
    load : array_like
        F [N], > 0.
    film_thickness : array_like
        h [m], > 0.
    sliding_speed : array_like
        [m/s], ≥ 0.
    laws : Laws
        Their viscosity, rheology and heating count.

    Returns
    -------
    ndarray
        ∫ τ dA over Hertz' ellipse [N]. Chords along the sliding direction at ζ = a sin θ have the
        largest pressure p0 cos θ and the length 2 b cos θ.
    """
    fluid = prepare_fluid(laws, contact.lubricant)
    root = np.cbrt(load)[..., None]
    angle = 0.25 * np.pi * (_STATIONS + 1.0)
    weight = 0.25 * np.pi * _STATION_WEIGHTS * 2.0
    pressure = contact.hertz.pressure * root * np.cos(angle)
    across = contact.hertz.semi_axis_across * root
    chord = 2.0 * contact.hertz.semi_axis_along * root * np.cos(angle)
    stress = chord_stress(
        fluid,
        pressure,
        np.asarray(film_thickness)[..., None],
        np.asarray(sliding_speed)[..., None],
    )
    force = stress * chord * across * np.cos(angle)
    return (force * weight).sum(axis=-1)


def rib_asperity_share(film_ratio):
    """Share of the rib's load that asperities carry, exp(−1.90 Λ^0.99) [-].

    Λ ≥ 0 is the film thickness over the composite RMS roughness [-].

    Masjedi and Khonsari, Proc. IMechE J 228 (2014) 1001 (point contacts), at the roughness of
    ground ribs.

    Examples
    --------
    >>> float(round(rib_asperity_share(1.0), 4))
    0.1496
    """
    return np.exp(-_SHARE_FACTOR * np.power(film_ratio, _SHARE_EXPONENT))


def rib_state(
    contact: RibContact,
    load,
    entrainment_speed,
    sliding_speed,
    laws: Laws | None = None,
    *,
    film_coefficient=None,
) -> RibState:
    """Pressure, film, friction and power of a rib contact.

    Parameters
    ----------
    contact : RibContact
    load : array_like
        Rib force F_f [N], ≥ 0; where it is 0 nothing is dissipated.
    entrainment_speed, sliding_speed : array_like
        Mean speed of both surfaces relative to the contact, and sliding speed [m/s], > 0.
    laws : Laws, optional
        Laws of the film's shear; `Laws.physical()` without them.
    film_coefficient : array_like, optional
        Friction of the film over its load µ_film [-], where it is known, as of a table; else the
        integral of its shear over every ellipse.

    Returns
    -------
    RibState

    Notes
    -----
    µ = µ_b X + (1 − X) µ_film with the share of the asperities X = exp(−1.90 Λ^0.99), µ_b the
    lubricant's boundary friction. The film is `oil_supply` times the one with a full inlet.

    References
    ----------
    The share: Masjedi and Khonsari, Proc. IMechE J 228 (2014) 1001 (point contacts), at the
    roughness of ground ribs.
    """
    laws = Laws.physical() if laws is None else laws
    load = np.asarray(load, dtype=float)
    pressed = load > 0.0
    carried = np.where(pressed, load, 1.0)
    film = contact.oil_supply * chittenden_thickness(
        carried,
        entrainment_speed,
        contact.rolling_radius,
        contact.lateral_radius,
        contact.modulus,
        contact.lubricant,
    )
    ratio = film / contact.roughness
    share = rib_asperity_share(ratio)
    if film_coefficient is None:
        film_coefficient = film_friction(contact, carried, film, sliding_speed, laws) / carried
    friction = share * contact.lubricant.boundary_friction + (1.0 - share) * film_coefficient
    root = np.cbrt(carried)
    return RibState(
        pressure=np.where(pressed, contact.hertz.pressure * root, 0.0),
        half_along=np.where(pressed, contact.hertz.semi_axis_along * root, 0.0),
        half_across=np.where(pressed, contact.hertz.semi_axis_across * root, 0.0),
        film_thickness=film,
        film_ratio=ratio,
        asperity_share=np.where(pressed, share, 0.0),
        friction_coefficient=np.where(pressed, friction, 0.0),
        power=np.where(pressed, friction * load * sliding_speed, 0.0),
    )
