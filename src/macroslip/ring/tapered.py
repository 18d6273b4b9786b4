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
are unique. Displacements are not where rollers are loose. A damped Newton step eliminates the three
unknowns of every roller and solves for the five of the ring; Levenberg's damping deals with loose
rollers and vanishes where all are loaded.

In the coordinates of its own row, mirrored where s = −1, every roller obeys one and the same law: it
is computed as a function of the ring's motion at the roller's middle, w = (radial, axial, tilt).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.bearing.tapered import TaperedBearing, TaperedGeometry, tapered_geometry
from macroslip.compiled import jit, jit_inline
from macroslip.contact.hertz import effective_modulus, elliptical_contact
from macroslip.contact.line import (
    PALMGREN_EXPONENT,
    logarithmic_profile,
    palmgren_coefficient,
    plane_strain_law,
    strip_places,
)

#: Signs s of the rows, in the order of results: the row that carries thrust along +Z0 first.
ROW_SIGNS = (1, -1)
#: Strips along a roller; 41 and 301 differ by 3e-4 in the loads.
STRIPS = 41
#: Iterations after which a balance counts as failed.
_MOST_ITERATIONS = 400
#: Approach [m] at which the stiffness of a contact is the unit of the damping.
_TYPICAL_APPROACH = 1e-5
#: Unbalanced force at which a balance has converged: part of the load, and least [N].
_RELATIVE_UNBALANCE = 1e-7
_LEAST_UNBALANCE = 1e-4


class TaperedRing(NamedTuple):
    """Geometry and stiffness of a tapered roller bearing, as the balance takes them.

    `n` is the number of rollers of both rows, `k` the number of strips.
    """

    angle: np.ndarray  #: Shape (n,). Position φ of every roller at shaft angle zero [rad]
    sign: np.ndarray  #: Shape (n,). s of its row [-]
    station: np.ndarray  #: Shape (n,). Z of its middle from the bearing's middle [m]
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
    """Where the ring carries its loads, and the forces of all rollers."""

    displacement: np.ndarray  #: Shape (n, 5). d [m, m, m, rad, rad]
    inner_load: np.ndarray  #: Shape (n, rollers). Q_i of the inner raceway [N]
    outer_load: np.ndarray  #: Shape (n, rollers). Q_o of the outer raceway [N]
    rib_force: np.ndarray  #: Shape (n, rollers). F_f of the rib [N]
    #: Shape (n, rollers, 3). v of every roller in its row's coordinates [m, m, rad]
    roller_motion: np.ndarray
    unbalanced: np.ndarray  #: Shape (n,). Force left unbalanced [N]
    iterations: np.ndarray  #: Shape (n,). Newton steps


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
    radial = row.rib_place * sine - row.rib_radius_on_roller * cosine
    axial = -row.rib_place * cosine - row.rib_radius_on_roller * sine
    return np.array([*normal, normal[0] * axial - normal[1] * radial])


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
    even = -np.pi / 2.0 + 2.0 * np.pi * np.arange(count) / count
    towards = -1.0 if bearing.arrangement == "O" else 1.0
    signs = np.repeat(np.array(ROW_SIGNS, dtype=float), count)
    return TaperedRing(
        angle=np.concatenate([even, even]),
        sign=signs,
        station=towards * signs * bearing.row_offset,
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
    """Stiffness of a gearbox's elastic support behind the bearing, shape (5, 5).

    Its energy is ½ k [(dX + L_g θY)² + (dY − L_g θX)²].

    Parameters
    ----------
    stiffness : float
        k [N/m] across the shaft, not negative.
    distance : float
        Distance L_g of the support from the bearing's middle along +Z0 [m].

    Examples
    --------
    >>> gearbox_support(1e8, 3.0)[0].tolist()
    [100000000.0, 0.0, 0.0, 0.0, 300000000.0]
    """
    horizontal = np.array([1.0, 0.0, 0.0, 0.0, distance])
    vertical = np.array([0.0, 1.0, 0.0, -distance, 0.0])
    return stiffness * (np.outer(horizontal, horizontal) + np.outer(vertical, vertical))


@jit_inline
def _motion_map(ring, roller, angle, motion):
    """Fill the map of d to the ring's motion w at a roller's middle, shape (3, 5)."""
    cosine = math.cos(angle)
    sine = math.sin(angle)
    sign = ring.sign[roller]
    motion[:] = 0.0
    # The ring's section in the roller's meridian plane turns by θY cos φ − θX sin φ.
    motion[2, 3] = -sine
    motion[2, 4] = cosine
    motion[0, 0] = cosine
    motion[0, 1] = sine
    motion[0, 3] = -ring.station[roller] * sine
    motion[0, 4] = ring.station[roller] * cosine
    motion[1, 2] = sign
    motion[1, 3] = ring.pitch_radius * sine * sign
    motion[1, 4] = -ring.pitch_radius * cosine * sign
    motion[2, 3] *= sign
    motion[2, 4] *= sign


@jit_inline
def _add_raceway(radial, axial, arms, ring, moved, force, stiffness):
    """Energy [J] and load [N] of a raceway under a relative motion; fills force and stiffness."""
    force[:] = 0.0
    stiffness[:] = 0.0
    energy = 0.0
    normal = radial * moved[0] + axial * moved[1]
    load_sum = 0.0
    moment = 0.0
    slope_sum = 0.0
    slope_moment = 0.0
    slope_square = 0.0
    for k in range(arms.size):
        approach = normal + arms[k] * moved[2] - ring.profile[k]
        if approach > 0.0:
            slope = ring.strip_coefficient * approach ** (ring.strip_exponent - 1.0)
            load = slope * approach
            slope *= ring.strip_exponent
            energy += load * approach
            load_sum += load
            moment += load * arms[k]
            slope_sum += slope
            slope_moment += slope * arms[k]
            slope_square += slope * arms[k] * arms[k]
    force[0] = radial * load_sum
    force[1] = axial * load_sum
    force[2] = moment
    stiffness[0, 0] = radial * radial * slope_sum
    stiffness[0, 1] = radial * axial * slope_sum
    stiffness[1, 1] = axial * axial * slope_sum
    stiffness[0, 2] = radial * slope_moment
    stiffness[1, 2] = axial * slope_moment
    stiffness[2, 2] = slope_square
    for a in range(3):
        for b in range(a):
            stiffness[a, b] = stiffness[b, a]
    return energy / (ring.strip_exponent + 1.0), load_sum


@jit_inline
def _rib(ring, moved, force, stiffness):
    """Energy [J] and force [N] of the rib contact.

    Its force is taken from, and its stiffness added to, those of the inner raceway. `moved` is the
    motion of the ring relative to the roller.
    """
    approach = 0.0
    for a in range(3):
        approach -= ring.rib_normal[a] * moved[a]
    if approach <= 0.0:
        return 0.0, 0.0
    root = ring.rib_stiffness * math.sqrt(approach)
    load = root * approach
    for a in range(3):
        force[a] -= load * ring.rib_normal[a]
        for b in range(3):
            stiffness[a, b] += 1.5 * root * ring.rib_normal[a] * ring.rib_normal[b]
    return 0.4 * load * approach, load


class _State(NamedTuple):
    """Forces and stiffnesses of all rollers in one trial, as a Newton step reads them."""

    ring_force: np.ndarray  #: Shape (rollers, 3). Of inner raceway and rib, against w
    roller_force: np.ndarray  #: Shape (rollers, 3). Out of balance on the roller, against v
    inner_stiffness: np.ndarray  #: Shape (rollers, 3, 3). Of inner raceway and rib
    outer_stiffness: np.ndarray  #: Shape (rollers, 3, 3). Of the outer raceway
    inner_load: np.ndarray  #: Shape (rollers,). Q_i [N]
    outer_load: np.ndarray  #: Shape (rollers,). Q_o [N]
    rib_force: np.ndarray  #: Shape (rollers,). F_f [N]


@jit_inline
def _new_state(rollers):
    """Empty arrays of a state."""
    return _State(
        np.zeros((rollers, 3)),
        np.zeros((rollers, 3)),
        np.zeros((rollers, 3, 3)),
        np.zeros((rollers, 3, 3)),
        np.zeros(rollers),
        np.zeros(rollers),
        np.zeros(rollers),
    )


@jit_inline
def _evaluate(ring, motions, load, d, v, state, gradient):
    """Fill the state at a displacement and the gradient by d; returns Π [J]."""
    energy = 0.0
    for a in range(5):
        held = 0.0
        for b in range(5):
            held += ring.support[a, b] * d[b]
        energy += d[a] * (0.5 * held - load[a])
        gradient[a] = held - load[a]
    w = np.zeros(3)
    for j in range(ring.sign.size):
        for a in range(3):
            w[a] = 0.0
            for b in range(5):
                w[a] += motions[j, a, b] * d[b]
        w[1] += ring.preload
        w -= v[j]
        inner = state.inner_stiffness[j]
        force = state.ring_force[j]
        inner_energy, state.inner_load[j] = _add_raceway(
            ring.inner_radial, ring.inner_axial, ring.inner_arm, ring, w, force, inner
        )
        rib_energy, state.rib_force[j] = _rib(ring, w, force, inner)
        outer_energy, state.outer_load[j] = _add_raceway(
            ring.outer_radial, ring.outer_axial, ring.outer_arm, ring, v[j],
            state.roller_force[j], state.outer_stiffness[j],
        )  # fmt: skip
        energy += inner_energy + rib_energy + outer_energy
        state.roller_force[j] -= force
        for b in range(5):
            for a in range(3):
                gradient[b] += motions[j, a, b] * force[a]
    return energy


@jit_inline
def _eliminate(inner, outer, force, damping, tilt_damping, passed, shifted):
    """Eliminate a roller's unknowns, by Cholesky factors of its damped stiffness.

    `passed` becomes (inner + outer)⁻¹ inner, the roller's motion per motion of the ring, and
    `shifted` (inner + outer)⁻¹ force.
    """
    l11 = math.sqrt(inner[0, 0] + outer[0, 0] + damping)
    l21 = (inner[1, 0] + outer[1, 0]) / l11
    l31 = (inner[2, 0] + outer[2, 0]) / l11
    l22 = math.sqrt(inner[1, 1] + outer[1, 1] + damping - l21 * l21)
    l32 = (inner[2, 1] + outer[2, 1] - l31 * l21) / l22
    square = inner[2, 2] + outer[2, 2] + tilt_damping - l31 * l31 - l32 * l32
    l33 = math.sqrt(max(square, 1e-3 * tilt_damping))
    for column in range(4):
        r1 = inner[0, column] if column < 3 else force[0]
        r2 = inner[1, column] if column < 3 else force[1]
        r3 = inner[2, column] if column < 3 else force[2]
        y1 = r1 / l11
        y2 = (r2 - l21 * y1) / l22
        y3 = (r3 - l31 * y1 - l32 * y2) / l33
        x3 = y3 / l33
        x2 = (y2 - l32 * x3) / l22
        x1 = (y1 - l21 * x2 - l31 * x3) / l11
        if column < 3:
            passed[0, column] = x1
            passed[1, column] = x2
            passed[2, column] = x3
        else:
            shifted[0] = x1
            shifted[1] = x2
            shifted[2] = x3


@jit_inline
def _add_roller(motion, inner, passed, shifted, matrix, right):
    """Add to the ring's stiffness and load what a roller leaves and passes on."""
    left = np.empty((3, 3))
    pushed = np.empty(3)
    for a in range(3):
        pushed[a] = inner[a, 0] * shifted[0] + inner[a, 1] * shifted[1] + inner[a, 2] * shifted[2]
        for b in range(3):
            left[a, b] = inner[a, b]
            for c in range(3):
                left[a, b] -= inner[a, c] * passed[c, b]
    for b in range(5):
        for a in range(3):
            right[b] -= motion[a, b] * pushed[a]
            weighted = 0.0
            for c in range(3):
                weighted += left[a, c] * motion[c, b]
            for e in range(5):
                matrix[e, b] += motion[a, e] * weighted


@jit_inline
def _step(ring, motions, state, gradient, damping, d_step, v_step):
    """Fill the damped Newton step of ring and rollers."""
    tilt_damping = damping * ring.inner_arm[0] * ring.inner_arm[0]
    matrix = ring.support.copy()
    right = -gradient
    for a in range(5):
        matrix[a, a] += damping if a < 3 else damping * ring.pitch_radius**2
    rollers = ring.sign.size
    passed = np.empty((rollers, 3, 3))
    shifted = np.empty((rollers, 3))
    for j in range(rollers):
        _eliminate(
            state.inner_stiffness[j], state.outer_stiffness[j], state.roller_force[j],
            damping, tilt_damping, passed[j], shifted[j],
        )  # fmt: skip
        _add_roller(motions[j], state.inner_stiffness[j], passed[j], shifted[j], matrix, right)
    d_step[:] = np.linalg.solve(matrix, right)
    for j in range(rollers):
        for a in range(3):
            v_step[j, a] = -shifted[j, a]
            for c in range(3):
                w_step = 0.0
                for b in range(5):
                    w_step += motions[j, c, b] * d_step[b]
                v_step[j, a] += passed[j, a, c] * w_step


@jit_inline
def _unbalance(ring, state, gradient):
    """Largest force left unbalanced on ring and rollers [N]."""
    largest = 0.0
    for a in range(5):
        force = abs(gradient[a]) if a < 3 else abs(gradient[a]) / ring.pitch_radius
        largest = max(largest, force)
    for j in range(ring.sign.size):
        largest = max(largest, abs(state.roller_force[j, 0]), abs(state.roller_force[j, 1]))
    return largest


@jit_inline
def _descend(ring, motions, load, tolerance, d, v, state):
    """Damped Newton steps downhill in Π from d and v, which are changed in place.

    Returns the force left unbalanced [N] and the number of steps.
    """
    gradient = np.zeros(5)
    energy = _evaluate(ring, motions, load, d, v, state, gradient)
    left = _unbalance(ring, state, gradient)
    width = ring.strip_coefficient * ring.profile.size
    unit = width * _TYPICAL_APPROACH ** (ring.strip_exponent - 1.0)
    relative = 1e-4
    d_step = np.zeros(5)
    v_step = np.zeros_like(v)
    trial_gradient = np.zeros(5)
    for iteration in range(_MOST_ITERATIONS):
        if left <= tolerance or relative > 1e9:
            return left, iteration
        _step(ring, motions, state, gradient, relative * unit, d_step, v_step)
        d += d_step
        v += v_step
        trial = _evaluate(ring, motions, load, d, v, state, trial_gradient)
        trial_left = _unbalance(ring, state, trial_gradient)
        # Close to the solution the energy no longer resolves the progress that the unbalanced force
        # still shows.
        if trial <= energy or trial_left <= 0.5 * left:
            energy = trial
            left = trial_left
            gradient[:] = trial_gradient
            relative = max(0.1 * relative, 1e-14)
        else:
            d -= d_step
            v -= v_step
            _evaluate(ring, motions, load, d, v, state, gradient)
            relative = max(10.0 * relative, 1e-9)
    return left, _MOST_ITERATIONS


@jit
def _solve_series(ring, shaft_angle, loads, tolerance, results):
    """Fill the balances of a load history, each from the one before."""
    rollers = ring.sign.size
    motions = np.empty((rollers, 3, 5))
    state = _new_state(rollers)
    d = np.zeros(5)
    v = np.zeros((rollers, 3))
    for n in range(shaft_angle.size):
        for j in range(rollers):
            _motion_map(ring, j, ring.angle[j] + ring.orbit_ratio * shaft_angle[n], motions[j])
        if n == 0:
            # Rollers begin in the middle between the rings.
            v[:, 1] = 0.5 * ring.preload
        left, iterations = _descend(ring, motions, loads[n], tolerance[n], d, v, state)
        if not left <= tolerance[n]:
            d[:] = 0.0
            v[:] = 0.0
            v[:, 1] = 0.5 * ring.preload
            left, again = _descend(ring, motions, loads[n], tolerance[n], d, v, state)
            iterations += again
        results.displacement[n] = d
        results.unbalanced[n] = left
        results.iterations[n] = iterations
        results.rib_force[n] = state.rib_force
        results.inner_load[n] = state.inner_load
        results.outer_load[n] = state.outer_load
        results.roller_motion[n] = v


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
        Where `unbalanced` exceeds 1e-9 of the load and 1e-5 N the balance was not found, and the
        sample's numbers must not be used.

    Examples
    --------
    Thrust alone loads all rollers of one row alike, with Q_o = F_a/(Z sin α_o):

    >>> pair = tapered_ring(TaperedBearing.read("32216-pair"))
    >>> thrust = np.array([[0.0, 0.0, 6000.0]])
    >>> found = tapered_balance(pair, np.zeros(1), thrust, np.zeros((1, 2)))
    >>> [round(float(q[0, 0]), 2) for q in (found.outer_load, found.inner_load, found.rib_force)]
    [1390.8, 1386.99, 101.91]
    >>> float(found.outer_load[0, 16:].max())
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
    size = np.linalg.norm(force, axis=1) + np.linalg.norm(moment, axis=1) / ring.pitch_radius
    tolerance = _RELATIVE_UNBALANCE * size + _LEAST_UNBALANCE
    _solve_series(ring, np.asarray(shaft_angle, dtype=float), loads, tolerance, results)
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
    angle = ring.angle + ring.orbit_ratio * shaft_angle[sample]
    dx, dy, dz, turn_x, turn_y = balance.displacement[sample]
    tilt = turn_y * np.cos(angle) - turn_x * np.sin(angle)
    moved = np.stack(
        [
            dx * np.cos(angle) + dy * np.sin(angle) + ring.station * tilt,
            ring.sign * (dz - ring.pitch_radius * tilt) + ring.preload,
            ring.sign * tilt,
        ],
        axis=1,
    )
    roller = balance.roller_motion[sample]
    inner = _approaches(ring.inner_radial, ring.inner_axial, ring.inner_arm, moved - roller)
    outer = _approaches(ring.outer_radial, ring.outer_axial, ring.outer_arm, roller)
    pressed = np.maximum(np.stack([inner, outer]) - ring.profile, 0.0)
    loads = ring.strip_coefficient * pressed**ring.strip_exponent
    return loads[0], loads[1]


def _approaches(radial: float, axial: float, arms: np.ndarray, moved: np.ndarray) -> np.ndarray:
    """Approach of strips without profile under relative motions [m], shape (rollers, k)."""
    return (radial * moved[:, 0] + axial * moved[:, 1])[:, None] + moved[:, 2:] * arms
