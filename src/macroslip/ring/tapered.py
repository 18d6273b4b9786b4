"""Static balance of the inner ring of a tapered roller bearing on all rollers of both rows.

Unknown are the displacement of the inner ring d = (dX, dY, dZ, θX, θY) and, in its own meridian
plane, that of every roller, v = (radial, axial, tilt). The contacts are strips of both raceways and
the point contact with the rib, and their approaches are linear in the displacements:

    inner raceway   δ = n_i·(u_ring − u_roller) − P     n_i = (cos α_i, s sin α_i)
    outer raceway   δ = n_o·u_roller − P                n_o = (cos α_o, s sin α_o)
    rib             δ = N·(u_roller − u_ring)           N = (sin(α − ε), −s cos(α − ε))

with the drop P of the profile, and the preload of a row added to the ring's axial displacement. So

    Π(d, all v) = Σ elastic energies + ½ d·K d − F·d − M·θ,

K the stiffness of a support beside the bearing, is convex: every minimum is global, and all forces
are unique. Displacements are not where rollers are loose. `ring/tapered_solver.py` finds it.

In the coordinates of its own row, mirrored where s = −1, every roller obeys one and the same law: it
is computed as a function of the ring's motion at the roller's middle, w = (radial, axial, tilt).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.bearing.geometry import ROWS, initial_angles
from macroslip.bearing.tapered import TaperedBearing, TaperedGeometry, tapered_geometry
from macroslip.contact.hertz import effective_modulus, elliptical_contact
from macroslip.contact.line import (
    PALMGREN_EXPONENT,
    logarithmic_profile,
    palmgren_coefficient,
    plane_strain_law,
    strip_places,
)
from macroslip.ring.tapered_solver import solve_series

#: Signs s of the rows, in the order of results: the row that carries thrust along +Z0 first.
ROW_SIGNS = (1, -1)
#: Strips along a roller; 41 and 301 differ by 3e-4 in the loads.
STRIPS = 41
#: Unbalanced force at which a balance has converged: part of the load, and least [N].
_RELATIVE_UNBALANCE = 1e-7
_LEAST_UNBALANCE = 1e-4
#: Unbalanced force up to which a balance may be used: relative to the load, and in addition [N].
_USABLE = (1e-5, 1.0)


class TaperedRing(NamedTuple):
    """Geometry and stiffness of a tapered roller bearing, as the balance takes them.

    `n` is the number of rollers of both rows, `k` the number of strips.
    """

    angle: np.ndarray  #: Shape (n,). Position φ of every roller at shaft angle zero [rad]
    sign: np.ndarray  #: Shape (n,). s of its row [-]
    axial_position: np.ndarray  #: Shape (n,). Z of its middle from the bearing's middle [m]
    preload: float  #: Axial interference of one row [m], half that of the bearing
    pitch_radius: float  #: R̃ [m]
    orbit_ratio: float  #: Ω/Ω_in [-]
    inner_radial: float  #: cos α_i [-]
    inner_axial: float  #: sin α_i [-]
    inner_arm: np.ndarray  #: Shape (k,). Approach of inner strips per tilt of the ring [m]
    outer_radial: float  #: cos α_o [-]
    outer_axial: float  #: sin α_o [-]
    outer_arm: np.ndarray  #: Shape (k,). Approach of outer strips per tilt of the roller [m]
    rib_normal: np.ndarray  #: Shape (3,). Approach at the rib per motion of the roller [-, -, m]
    profile: np.ndarray  #: Shape (k,). Drop of the profile P [m]
    strip_coefficient: float  #: Load of a strip per δ^n [N/m^n]
    strip_exponent: float  #: n [-]
    rib_stiffness: float  #: K_f in F_f = K_f δ^1.5 [N/m^1.5]
    support: np.ndarray  #: Shape (5, 5). Stiffness of a support beside the bearing


class TaperedBalance(NamedTuple):
    """Ring displacements and roller forces in equilibrium."""

    displacement: np.ndarray  #: Shape (n, 5). d [m, m, m, rad, rad]
    inner_load: np.ndarray  #: Shape (n, rollers). Q_i of the inner raceway [N]
    outer_load: np.ndarray  #: Shape (n, rollers). Q_o of the outer raceway [N]
    rib_force: np.ndarray  #: Shape (n, rollers). F_f of the rib [N]
    #: Shape (n, rollers, 3). v of every roller in its row's coordinates [m, m, rad]
    roller_motion: np.ndarray
    unbalanced: np.ndarray  #: Shape (n,). Force left unbalanced [N]
    iterations: np.ndarray  #: Shape (n,). Newton steps

    def is_converged(self, ring: TaperedRing, force: np.ndarray, moment: np.ndarray) -> np.ndarray:
        """Samples whose unbalanced force is within 1e-5 of the load plus 1 N, so that they count.

        Parameters
        ----------
        ring : TaperedRing
            That of the balance.
        force : ndarray, shape (n, 3)
            Forces on the inner ring [N].
        moment : ndarray, shape (n, 2)
            Moments on the inner ring [N m].

        Returns
        -------
        ndarray of bool, shape (n,)
            False where a number of the balance is NaN.
        """
        relative, least = _USABLE
        return self.unbalanced <= relative * _load_size(ring, force, moment) + least


def _load_size(ring: TaperedRing, force: np.ndarray, moment: np.ndarray) -> np.ndarray:
    """Size of forces, and of moments as forces at the pitch radius [N], shape (n,)."""
    forces = np.linalg.norm(force, axis=1)
    moments = np.linalg.norm(moment, axis=1)
    return forces + moments / ring.pitch_radius


def _arms(
    row: TaperedGeometry, places: np.ndarray, side: int, normal: tuple[float, float]
) -> np.ndarray:
    """Approach of strips per tilt about the roller's middle [m]; side −1 is the inner raceway."""
    sine = math.sin(row.axis_angle)
    cosine = math.cos(row.axis_angle)
    radius = row.radius_at(places)
    radial = places * sine + side * radius * cosine
    axial = -places * cosine + side * radius * sine
    return normal[0] * axial - normal[1] * radial


def _rib_normal(row: TaperedGeometry) -> np.ndarray:
    """Approach at the rib per radial and axial displacement and tilt of the roller, shape (3,)."""
    lean = row.axis_angle - row.rib_angle
    normal = math.sin(lean), -math.cos(lean)
    sine = math.sin(row.axis_angle)
    cosine = math.cos(row.axis_angle)
    radial = row.rib_station * sine - row.rib_radius_on_roller * cosine
    axial = -row.rib_station * cosine - row.rib_radius_on_roller * sine
    arm = normal[0] * axial - normal[1] * radial
    return np.array([*normal, arm])


def tapered_ring(
    bearing: TaperedBearing,
    *,
    strips: int = STRIPS,
    support: np.ndarray | None = None,
    ring_thickness: float | None = None,
) -> TaperedRing:
    """Numbers of a bearing for its balance.

    Parameters
    ----------
    bearing : TaperedBearing
    strips : int, optional
        Number of strips along a roller, at least 21.
    support : ndarray, shape (5, 5), optional
        Stiffness of a support beside the bearing against dX, dY, dZ, θX and θY [N/m, N, N m]; none
        without it.
    ring_thickness : float, optional
        Thickness of the rings behind the raceways [m]: strips then give way in plane strain.
        Without it they follow Palmgren's law, which is softer by 11 to 14 %.

    Returns
    -------
    TaperedRing
    """
    row = tapered_geometry(bearing)
    places = strip_places(bearing.roller_length, strips)
    inner = math.cos(row.inner_angle), math.sin(row.inner_angle)
    outer = math.cos(row.outer_angle), math.sin(row.outer_angle)
    modulus = effective_modulus(*(bearing.youngs_modulus, bearing.poisson_ratio) * 2)
    rib = elliptical_contact(row.rib_rolling_curvature, row.rib_lateral_curvature, modulus)
    if ring_thickness is None:
        coefficient = palmgren_coefficient(bearing.roller_length)
        exponent = PALMGREN_EXPONENT
    else:
        coefficient, exponent = plane_strain_law(
            bearing.roller_diameter / 2.0, ring_thickness, modulus
        )
    count = bearing.rollers_per_row
    towards = -1.0 if bearing.arrangement == "O" else 1.0
    signs = np.repeat(np.array(ROW_SIGNS, dtype=float), count)
    return TaperedRing(
        angle=np.concatenate([initial_angles(row, count) for row in ROWS]),
        sign=signs,
        axial_position=towards * signs * bearing.row_offset,
        preload=bearing.preload / 2.0,
        pitch_radius=bearing.pitch_radius,
        orbit_ratio=row.orbit_ratio,
        inner_radial=inner[0],
        inner_axial=inner[1],
        inner_arm=_arms(row, places, -1, inner),
        outer_radial=outer[0],
        outer_axial=outer[1],
        outer_arm=_arms(row, places, 1, outer),
        rib_normal=_rib_normal(row),
        profile=logarithmic_profile(places, bearing.roller_length, bearing.roller_diameter),
        strip_coefficient=coefficient * (bearing.roller_length / strips),
        strip_exponent=exponent,
        rib_stiffness=rib.stiffness,
        support=np.zeros((5, 5)) if support is None else np.asarray(support, dtype=float),
    )


def gearbox_support(stiffness: float, distance: float) -> np.ndarray:
    """Stiffness of a gearbox's elastic support behind the bearing.

    Its energy is ½ k [(dX + L_g θY)² + (dY − L_g θX)²].

    Parameters
    ----------
    stiffness : float
        k [N/m] across the shaft, not negative.
    distance : float
        Distance L_g of the support from the bearing's middle along +Z0 [m].

    Returns
    -------
    ndarray, shape (5, 5)
        Stiffness by d = (dX, dY, dZ, θX, θY) [N/m, N, N m].

    Examples
    --------
    >>> gearbox_support(1e8, 3.0)[0].tolist()
    [100000000.0, 0.0, 0.0, 0.0, 300000000.0]
    """
    horizontal = np.array([1.0, 0.0, 0.0, 0.0, distance])
    vertical = np.array([0.0, 1.0, 0.0, -distance, 0.0])
    return stiffness * (np.outer(horizontal, horizontal) + np.outer(vertical, vertical))


def two_bearings(ring: TaperedRing, distance: float) -> TaperedRing:
    """Rows of two alike bearings on one rigid shaft, the front one's first.

    Parameters
    ----------
    ring : TaperedRing
        Of one bearing.
    distance : float
        Of their middles [m]; the middle between them is the point about which moments are taken.

    Returns
    -------
    TaperedRing

    Examples
    --------
    >>> four_rows = two_bearings(tapered_ring(TaperedBearing.read("tdo-main-bearing")), 2.0)
    >>> [round(float(position), 3) for position in four_rows.axial_position[::34]]
    [-1.085, -0.915, 0.915, 1.085]
    """
    return ring._replace(
        angle=np.tile(ring.angle, 2),
        sign=np.tile(ring.sign, 2),
        axial_position=np.concatenate(
            [ring.axial_position - 0.5 * distance, ring.axial_position + 0.5 * distance]
        ),
    )


def tapered_balance(
    ring: TaperedRing, shaft_angle: np.ndarray, force: np.ndarray, moment: np.ndarray
) -> TaperedBalance:
    """Balance of the inner ring over a load history.

    Parameters
    ----------
    ring : TaperedRing
    shaft_angle : ndarray, shape (n,)
        Shaft angles [rad]; rollers have moved on by the orbit ratio times them.
    force : ndarray, shape (n, 3)
        Forces on the inner ring along X0, Y0 and Z0 [N].
    moment : ndarray, shape (n, 2)
        Moments on the inner ring about X0 and Y0 through the bearing's middle [N m].

    Returns
    -------
    TaperedBalance
        The search ends where `unbalanced` is below 1e-7 of the load plus 1e-4 N. Samples that are
        not `is_converged` must not be used.

    Examples
    --------
    Thrust alone loads all rollers of one row alike, with Q_o = F_a/(Z sin α_o):

    >>> pair = tapered_ring(TaperedBearing.read("32216-pair"))
    >>> thrust = np.array([[0.0, 0.0, 6000.0]])
    >>> balance = tapered_balance(pair, np.zeros(1), thrust, np.zeros((1, 2)))
    >>> [round(float(q[0, 0]), 2) for q in (balance.outer_load, balance.inner_load, balance.rib_force)]
    [1390.8, 1386.99, 101.91]
    >>> float(balance.outer_load[0, 16:].max())
    0.0
    """
    count = len(shaft_angle)
    rollers = ring.sign.size
    results = TaperedBalance(
        np.zeros((count, 5)),
        np.zeros((count, rollers)),
        np.zeros((count, rollers)),
        np.zeros((count, rollers)),
        np.zeros((count, rollers, 3)),
        np.zeros(count),
        np.zeros(count, dtype=np.int64),
    )
    loads = np.concatenate([force, moment], axis=1).astype(float)
    tolerance = _RELATIVE_UNBALANCE * _load_size(ring, force, moment) + _LEAST_UNBALANCE
    solve_series(ring, np.asarray(shaft_angle, dtype=float), loads, tolerance, results)
    return results


def strip_loads(
    ring: TaperedRing, balance: TaperedBalance, shaft_angle: np.ndarray, sample: int
) -> tuple[np.ndarray, np.ndarray]:
    """Loads of all strips at one sample of a balance.

    Parameters
    ----------
    ring : TaperedRing
        That of the balance.
    balance : TaperedBalance
    shaft_angle : ndarray, shape (n,)
        Shaft angles of the balance [rad].
    sample : int
        Number of the sample.

    Returns
    -------
    inner, outer : ndarray, shape (rollers, k)
        Loads of the strips of inner and outer raceway [N], from the small end on.
    """
    moved = ring_at_rollers(ring, balance.displacement[sample], shaft_angle[sample])
    roller = balance.roller_motion[sample]
    inner = _approaches(ring.inner_radial, ring.inner_axial, ring.inner_arm, moved - roller)
    outer = _approaches(ring.outer_radial, ring.outer_axial, ring.outer_arm, roller)
    pressed = np.maximum(np.stack([inner, outer]) - ring.profile, 0.0)
    loads = ring.strip_coefficient * pressed**ring.strip_exponent
    return loads[0], loads[1]


def ring_at_rollers(ring: TaperedRing, displacement: np.ndarray, shaft_angle) -> np.ndarray:
    """Motion w of the ring at every roller's middle, in the coordinates of its row.

    Parameters
    ----------
    ring : TaperedRing
    displacement : ndarray, shape (..., 5)
        d of a balance [m, m, m, rad, rad].
    shaft_angle : array_like, shape (...)
        Shaft angles [rad].

    Returns
    -------
    ndarray, shape (..., rollers, 3)
        Radial and axial motion with the preload [m], and tilt [rad].
    """
    angle = ring.angle + ring.orbit_ratio * np.asarray(shaft_angle)[..., None]
    dx, dy, dz, turn_x, turn_y = (
        component[..., None] for component in np.moveaxis(displacement, -1, 0)
    )
    tilt = turn_y * np.cos(angle) - turn_x * np.sin(angle)
    return np.stack(
        [
            dx * np.cos(angle) + dy * np.sin(angle) + ring.axial_position * tilt,
            ring.sign * (dz - ring.pitch_radius * tilt) + ring.preload,
            ring.sign * tilt,
        ],
        axis=-1,
    )


def _approaches(radial: float, axial: float, arms: np.ndarray, moved: np.ndarray) -> np.ndarray:
    """Approach of strips without profile under relative motions [m], shape (rollers, k)."""
    approach = radial * moved[:, 0] + axial * moved[:, 1]
    tilted = moved[:, 2:] * arms
    return approach[:, None] + tilted
