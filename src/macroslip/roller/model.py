"""Everything about a roller that does not change with time, as one tuple of numbers for the compiled kernels."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from macroslip.bearing import geometry
from macroslip.bearing.geometry import AXIAL_SIGNS, ROWS, initial_angles
from macroslip.constants import GRAVITY
from macroslip.contact.hertz import effective_modulus, elliptical_contact, series_stiffness
from macroslip.contact.interface import Interface
from macroslip.mechanisms import Laws
from macroslip.ring.balance import RingGeometry
from macroslip.roller.contacts import prepare_contact, prepare_films

#: Share of a roller's load that may lie beyond its ends.
HIGHEST_TRUNCATED_SHARE = 0.1

if TYPE_CHECKING:
    from macroslip.bearing import Bearing
    from macroslip.lubricant import Lubricant


class RollerModel(NamedTuple):
    """One roller on its imposed orbit.

    Attributes
    ----------
    radius : float
        r [m].
    mobility : float
        r²/I_z' [1/kg], acceleration of the contact's surface speed per tangential force.
    stiffness : float
        K of inner and outer contact in series [N/m^1.5].
    cos_contact_angle, sin_contact_angle : float
        Of the contact angle α [-]; the sine carries the row's axial sign s.
    radial_play : float
        Half the diametral clearance [m].
    orbit_ratio : float
        Ω/Ω_in = r~_in/(r~_in + r~_out) [-].
    outer_radius : float
        r~_out [m].
    weight_in_plane, weight_along_axis : float
        Roller weight's part in the bearing plane (along −Y0) and along +Z0 [N].
    centrifugal : float
        m r~ [kg m]; times Ω² gives the centrifugal force (18).
    drag : float
        ½ C_D ρ_eff 2 r l r~² [N s²]; times Ω² gives the drag (24).
    films : Films or NoFilms
        The oil around the roller: rolling resistance, and films where it has play.
    inner, outer, cage : PlainContact or CurvedContact
        Laws of the three interfaces.
    """

    radius: float
    mobility: float
    stiffness: float
    cos_contact_angle: float
    sin_contact_angle: float
    radial_play: float
    orbit_ratio: float
    outer_radius: float
    weight_in_plane: float
    weight_along_axis: float
    centrifugal: float
    drag: float
    films: Any
    inner: Any
    outer: Any
    cage: Any


def interfaces(bearing: Bearing, lubricant: Lubricant) -> tuple[Interface, Interface, Interface]:
    """The inner, outer and cage interface of a roller, with their Hertz coefficients (section "Forces" of the paper).

    Parameters
    ----------
    bearing : Bearing
    lubricant : Lubricant

    Returns
    -------
    tuple of three Interface
        In the order inner, outer, cage.
    """
    own = bearing.youngs_modulus, bearing.poisson_ratio
    steel = effective_modulus(*own, *own)
    cage = effective_modulus(*own, bearing.cage_youngs_modulus, bearing.cage_poisson_ratio)
    found = []
    for name, curvatures, modulus in (
        ("inner", geometry.inner_curvatures(bearing), steel),
        ("outer", geometry.outer_curvatures(bearing), steel),
        ("cage", geometry.cage_curvatures(bearing), cage),
    ):
        hertz = elliptical_contact(curvatures.rolling, curvatures.lateral, modulus)
        found.append(
            Interface(
                name, hertz, 1.0 / curvatures.rolling, modulus, bearing.composite_roughness, bearing.hardness, lubricant
            )
        )
    return tuple(found)


def truncation_load(bearing: Bearing, lubricant: Lubricant) -> float:
    """Roller load [N] at which a raceway contact ellipse reaches the ends of the roller.

    Above it the contact is truncated, and Hertz pressure, film and traction formulas no longer describe it.
    """
    inner, outer, _ = interfaces(bearing, lubricant)
    half = 0.5 * bearing.roller_length
    return min(contact.hertz.load_at_semi_axis_across(half) for contact in (inner, outer))


def truncated_share(load: float, truncation: float) -> float:
    """Share of a roller's load whose part of the Hertz ellipse lies beyond the roller's ends [-].

    Parameters
    ----------
    load : float
        Largest roller load [N].
    truncation : float
        From `truncation_load` [N].

    Examples
    --------
    >>> truncated_share(1e5, 2e5), round(truncated_share(4e5, 2e5), 4)
    (0.0, 0.0594)
    """
    if load <= truncation:
        return 0.0
    part = (truncation / load) ** (1.0 / 3.0)
    return 1.0 - 0.5 * part * (3.0 - part * part)


def highest_load(bearing: Bearing, lubricant: Lubricant, laws: Laws) -> float:
    """Roller load [N] that a case may not exceed.

    There the ellipse reaches the roller's ends; with microslip, which cuts it off there, a tenth of the load would lie
    beyond them.
    """
    truncation = truncation_load(bearing, lubricant)
    if not laws.microslip:
        return truncation
    # (3t − t³)/2 = 1 − share, with t the half length over the semi-axis.
    part = 2.0 * math.sin(math.asin(1.0 - HIGHEST_TRUNCATED_SHARE) / 3.0)
    return truncation / part**3


def ring_geometry(bearing: Bearing, model: RollerModel) -> RingGeometry:
    """What the ring balance needs of a bearing; `model` is a roller of the downwind row."""
    count = bearing.rollers_per_row
    angles = np.concatenate([initial_angles(row, count) for row in ROWS])
    signs = np.repeat([AXIAL_SIGNS[row] for row in ROWS], count)
    return RingGeometry(
        cosine=np.cos(angles),
        sine=np.sin(angles),
        axial=signs * model.sin_contact_angle,
        cos_contact_angle=model.cos_contact_angle,
        radial_play=model.radial_play,
        stiffness=model.stiffness,
        orbit_ratio=model.orbit_ratio,
    )


def roller_model(
    bearing: Bearing,
    lubricant: Lubricant,
    axial_sign: int,
    *,
    tilt: float,
    gravity: bool = True,
    drag: bool = True,
    laws: Laws = Laws.paper(),
) -> RollerModel:
    """Prepare a roller of one row.

    Parameters
    ----------
    bearing : Bearing
    lubricant : Lubricant
    axial_sign : int
        +1 for the downwind row, −1 for the upwind row.
    tilt : float
        Shaft tilt [rad]; the hub end is up, so that weight has a part along +Z0.
    gravity, drag : bool
        Whether weight and drag act on the roller.
    laws : Laws
        Mechanisms in the contacts.

    Returns
    -------
    RollerModel

    Raises
    ------
    InputError
        For unknown laws, values the lubricant lacks, or curvatures that do not make a Hertz contact.

    Notes
    -----
    The drag acts on the area 2 r l with the density of the lubricant times its fill factor (24).
    """
    radius = geometry.roller_radius(bearing)
    mass = geometry.roller_mass(bearing.density, radius, bearing.roller_length)
    found = interfaces(bearing, lubricant)
    inner_radius = geometry.inner_contact_radius(bearing)
    outer_radius = geometry.outer_contact_radius(bearing)
    weight = mass * GRAVITY if gravity else 0.0
    effective_density = lubricant.fill_factor * lubricant.density
    area = 2.0 * radius * bearing.roller_length
    contacts = [prepare_contact(laws, bearing, lubricant, one, axial_sign) for one in found]
    return RollerModel(
        radius=radius,
        mobility=radius**2 / geometry.spin_inertia(mass, radius),
        stiffness=series_stiffness(found[0].hertz, found[1].hertz),
        cos_contact_angle=math.cos(bearing.contact_angle),
        sin_contact_angle=axial_sign * math.sin(bearing.contact_angle),
        radial_play=0.5 * bearing.diametral_clearance,
        orbit_ratio=inner_radius / (inner_radius + outer_radius),
        outer_radius=outer_radius,
        weight_in_plane=weight * math.cos(tilt),
        weight_along_axis=weight * math.sin(tilt),
        centrifugal=mass * bearing.pitch_radius,
        drag=0.5 * lubricant.drag_coefficient * effective_density * area * bearing.pitch_radius**2 if drag else 0.0,
        films=prepare_films(laws, bearing, lubricant, found),
        inner=contacts[0],
        outer=contacts[1],
        cage=contacts[2],
    )
