"""Static balance of the inner ring on the discrete rollers of both rows.

The displacement d = (dX, dY, dZ) makes the elastic energy less the work of the load,

    Π(d) = Σ_j (2/5) K δ_j₊^2.5 − F·d,   δ_j = n_j·d − c(φ_j) cos α,   n_j = (cos φ_j cos α, sin φ_j
    cos α, s sin α),

smallest; with line contacts the energy of a roller is the work of `contact/line_approach.py` in place
of (2/5) K δ^2.5. The radial clearance is c = P_d/2 + c2 cos 2(φ − ψ) + c3 cos 3(φ − ψ), with the waves of
an outer ring out of round. Π is convex, so every minimum is global and the roller loads are unique;
d itself is not where too few rollers are loaded to hold the ring, and then the solution nearest to
the start is as good as any. Levenberg's damping of the Newton step deals with those singular cases
and vanishes in the others.

All samples of a load history are solved together, as arrays over them: first a few of them from the
middle of the play, then the others from displacements between these.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_inline
from macroslip.contact.line_approach import line_loads

#: Iterations granted to a warm start before a cold one, and to a cold one before the balance counts
#: as failed.
_WARM_ITERATIONS = 40
_COLD_ITERATIONS = 200
#: Distances of the samples of a series that are solved first, second and so on, each from between
#: those before; and samples that are solved together.
_DISTANCES = (64, 16, 4, 1)
_TOGETHER = 1024
#: Push [m] after which no roller will be touched any more (thrust on a bearing without contact
#: angle).
_LONGEST_PUSH = 1e3


class RingGeometry(NamedTuple):
    """Geometry and stiffness of a bearing, for the balance."""

    cosine: np.ndarray  #: Shape (n,). cos φ of every roller of both rows at shaft angle zero [-]
    sine: np.ndarray  #: Shape (n,). sin φ of these rollers [-]
    axial: np.ndarray  #: Shape (n,). s sin α of every roller [-]
    cos_contact_angle: float  #: cos α [-]
    radial_play: float  #: Half the diametral clearance [m]
    stiffness: float  #: K [N/m^1.5]
    orbit_ratio: float  #: Ω/Ω_in [-]
    second_x: float = 0.0  #: c2 cos 2ψ of the clearance's waves [m]
    second_y: float = 0.0  #: c2 sin 2ψ of the clearance's waves [m]
    third_x: float = 0.0  #: c3 cos 3ψ of the clearance's waves [m]
    third_y: float = 0.0  #: c3 sin 3ψ of the clearance's waves [m]
    line_stiffness: float = 0.0  #: C of line contacts [N/m^(10/9)]; 0 with elliptical ones
    profile_depth: float = 0.0  #: Depth of the profile of line contacts [m]


@jit_inline
def radial_clearance(ring, cosine, sine):
    """Radial clearance c(φ) of a bearing, with the waves of an outer ring out of round.

    Parameters
    ----------
    ring : RingGeometry, or record of `macroslip.roller.model.BODY`
    cosine, sine : float or ndarray
        cos φ and sin φ of the position [-].

    Returns
    -------
    float or ndarray
        c [m].

    Examples
    --------
    >>> oval = RingGeometry(np.ones(1), np.zeros(1), np.zeros(1), 1.0, 1e-4, 1e11, 0.45, 2e-5)
    >>> [float(round(1e6 * radial_clearance(oval, np.cos(phi), np.sin(phi)), 9)) for phi in (0.0, np.pi / 2)]
    [120.0, 80.0]
    """
    # Cosine and sine of 2φ and of 3φ.
    cosine_2 = cosine * cosine - sine * sine
    sine_2 = 2.0 * cosine * sine
    cosine_3 = cosine_2 * cosine - sine_2 * sine
    sine_3 = sine_2 * cosine + cosine_2 * sine
    second = ring.second_x * cosine_2 + ring.second_y * sine_2
    third = ring.third_x * cosine_3 + ring.third_y * sine_3
    return ring.radial_play + second + third


class _Contacts(NamedTuple):
    """Contacts of the rollers with the ring at n samples."""

    normals: np.ndarray  #: n_j [-], shape (n, 3, rollers)
    play: np.ndarray  #: c(φ_j) cos α [m], shape (n, rollers)
    ring: RingGeometry  #: The bearing

    def rows(self, index: np.ndarray) -> _Contacts:
        """The contacts at some of the samples.

        Parameters
        ----------
        index : ndarray of int
            Indices of the samples.

        Returns
        -------
        _Contacts
        """
        if index.size == len(self.play):
            return self
        normals = self.normals[index]
        play = self.play[index]
        return _Contacts(normals, play, self.ring)

    def approach(self, displacement: np.ndarray) -> np.ndarray:
        """Approach δ_j₊ of every roller.

        Parameters
        ----------
        displacement : ndarray, shape (n, 3)
            d [m].

        Returns
        -------
        ndarray, shape (n, rollers)
            Approaches [m], ≥ 0.
        """
        along = np.matmul(displacement[:, None], self.normals)[:, 0]
        return np.maximum(along - self.play, 0.0)

    def forces(self, approach: np.ndarray) -> _Forces:
        """Loads, slopes and elastic energy of the rollers at their approaches.

        Parameters
        ----------
        approach : ndarray, shape (n, rollers)
            Approaches [m], ≥ 0.

        Returns
        -------
        _Forces
        """
        if self.ring.line_stiffness > 0.0:
            load, slope, work = _line_loads(self.ring, approach)
            return _Forces(load, slope, work.sum(axis=1))
        secant = self.ring.stiffness * np.sqrt(approach)
        load = secant * approach
        slope = 1.5 * secant
        work = 0.4 * (load * approach).sum(axis=1)
        return _Forces(load, slope, work)


class _Forces(NamedTuple):
    """Forces of the rollers at n samples."""

    load: np.ndarray  #: Q [N], shape (n, rollers)
    slope: np.ndarray  #: dQ/dδ [N/m], shape (n, rollers)
    energy: np.ndarray  #: Elastic energy of all rollers [J], shape (n,)


def _line_loads(ring: RingGeometry, approach: np.ndarray) -> np.ndarray:
    """Loads, slopes and work of line contacts at approaches [m], shape (3, n, rollers)."""
    flat = np.ascontiguousarray(approach).ravel()
    loads = line_loads(ring.line_stiffness, ring.profile_depth, flat)
    return loads.reshape(3, *approach.shape)


class _Balance(NamedTuple):
    """Π at n samples with its derivatives by d."""

    energy: np.ndarray  #: Π [J], shape (n,)
    gradient: np.ndarray  #: Gradient, the unbalanced force [N], shape (n, 3)
    hessian: np.ndarray  #: Hessian [N/m], shape (n, 3, 3)

    def replace(self, index: np.ndarray, other: _Balance, chosen: np.ndarray) -> None:
        """Replace samples by chosen samples of another balance.

        Parameters
        ----------
        index : ndarray of int
            Indices of the samples that are replaced.
        other : _Balance
        chosen : ndarray of int or bool
            Samples of the other balance.
        """
        for own, new in zip(self, other, strict=True):
            own[index] = new[chosen]


def _contacts(ring: RingGeometry, shaft_angle: np.ndarray) -> _Contacts:
    """Contacts at shaft angles [rad], shape (n,); rollers move by `orbit_ratio` times the angle."""
    orbit_angle = ring.orbit_ratio * shaft_angle[:, None]
    turn_cosine = np.cos(orbit_angle)
    turn_sine = np.sin(orbit_angle)
    cosine = ring.cosine * turn_cosine - ring.sine * turn_sine
    sine = ring.sine * turn_cosine + ring.cosine * turn_sine
    axial = np.broadcast_to(ring.axial, cosine.shape)
    radial = ring.cos_contact_angle
    normals = np.stack([cosine * radial, sine * radial, axial], axis=1)
    play = radial_clearance(ring, cosine, sine) * radial
    return _Contacts(normals, play, ring)


def _evaluate(contacts: _Contacts, force: np.ndarray, displacement: np.ndarray) -> _Balance:
    """Π, its gradient and Hessian at displacements [m] under forces [N], both of shape (n, 3)."""
    approach = contacts.approach(displacement)
    forces = contacts.forces(approach)
    work_of_load = (force * displacement).sum(axis=1)
    energy = forces.energy - work_of_load
    carried = np.matmul(contacts.normals, forces.load[..., None])[..., 0]
    gradient = carried - force
    weighted = contacts.normals * forces.slope[:, None]
    hessian = np.matmul(weighted, contacts.normals.transpose(0, 2, 1))
    return _Balance(energy, gradient, hessian)


def _damped_newton_step(
    hessian: np.ndarray, gradient: np.ndarray, damping: np.ndarray
) -> np.ndarray:
    """Solve (H + damping·1) step = −gradient by Cholesky factors of H, shape (n, 3, 3)."""
    diagonal_x = hessian[:, 0, 0] + damping
    diagonal_y = hessian[:, 1, 1] + damping
    diagonal_z = hessian[:, 2, 2] + damping
    l11 = np.sqrt(diagonal_x)
    l21 = hessian[:, 0, 1] / l11
    l31 = hessian[:, 0, 2] / l11
    l22 = np.sqrt(diagonal_y - l21 * l21)
    l32 = (hessian[:, 1, 2] - l31 * l21) / l22
    l33 = np.sqrt(diagonal_z - l31 * l31 - l32 * l32)
    right_x, right_y, right_z = -gradient.T
    y1 = right_x / l11
    y2 = (right_y - l21 * y1) / l22
    y3 = (right_z - l31 * y1 - l32 * y2) / l33
    z = y3 / l33
    y = (y2 - l32 * z) / l22
    x = (y1 - l21 * y - l31 * z) / l11
    return np.stack([x, y, z], axis=1)


def _trace(matrices: np.ndarray) -> np.ndarray:
    return np.trace(matrices, axis1=1, axis2=2)


def _length(vectors: np.ndarray) -> np.ndarray:
    return np.sqrt((vectors * vectors).sum(axis=1))


def _tolerance(force: np.ndarray) -> np.ndarray:
    """Unbalanced force [N] at which a balance has converged, shape (n,)."""
    return 1e-10 * _length(force) + 1e-7


def _push_into_contact(
    ring: RingGeometry, contacts: _Contacts, force: np.ndarray, displacement: np.ndarray
) -> _Balance:
    """Push rings without a loaded roller along the load until rollers push back.

    `displacement` is changed in place.
    """
    magnitude = _length(force)
    # Only where the search begins: of line contacts the stiffness of ellipses like them serves.
    push = (magnitude / ring.stiffness) ** (2.0 / 3.0) + abs(ring.radial_play)
    is_pushed = magnitude > _tolerance(force)
    state = _evaluate(contacts, force, displacement)
    while True:
        is_free = is_pushed & (_trace(state.hessian) == 0.0) & (push < _LONGEST_PUSH)
        free = np.flatnonzero(is_free)
        if not free.size:
            return state
        free_force = force[free]
        per_force = push[free] / magnitude[free]
        displacement[free] += per_force[:, None] * free_force
        push[free] *= 2.0
        pushed = _evaluate(contacts.rows(free), free_force, displacement[free])
        state.replace(free, pushed, np.arange(free.size))


@np.errstate(invalid="ignore", divide="ignore", over="ignore")
def _descend(
    ring: RingGeometry,
    contacts: _Contacts,
    force: np.ndarray,
    displacement: np.ndarray,
    most_iterations: int,
) -> np.ndarray:
    """Minimise Π by damped Newton steps; returns the unbalanced forces [N].

    They start from `displacement`, which is changed in place.
    """
    tolerance = _tolerance(force)
    state = _push_into_contact(ring, contacts, force, displacement)
    relative = np.full(len(force), 1e-6)
    for _ in range(most_iterations):
        unbalanced = _length(state.gradient)
        active = np.flatnonzero(unbalanced > tolerance)
        if not active.size:
            break
        gradient = state.gradient[active]
        hessian = state.hessian[active]
        damping = relative[active] * _trace(hessian)
        step = _damped_newton_step(hessian, gradient, damping)
        trial = displacement[active] + step
        tried = _evaluate(contacts.rows(active), force[active], trial)
        left = _length(tried.gradient)
        energy_change = (gradient * step).sum(axis=1)
        expected = state.energy[active] + 1e-4 * energy_change
        in_contact = (_trace(tried.hessian) > 0.0) | (left <= tolerance[active])
        # Close to the solution the energy no longer resolves the progress that the unbalanced force
        # still shows.
        is_better = (tried.energy <= expected) | (left <= 0.5 * unbalanced[active])
        is_taken = in_contact & is_better
        taken = active[is_taken]
        displacement[taken] = trial[is_taken]
        state.replace(taken, tried, is_taken)
        relative[taken] = np.maximum(0.1 * relative[taken], 1e-14)
        refused = active[~is_taken]
        relative[refused] = np.maximum(10.0 * relative[refused], 1e-8)
    return _length(state.gradient)


def balance(
    ring: RingGeometry, shaft_angle: np.ndarray, force: np.ndarray, start: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Ring displacements that carry loads, found from given starts.

    Parameters
    ----------
    ring : RingGeometry
    shaft_angle : ndarray, shape (n,)
        Shaft angles [rad]; rollers have moved on by `orbit_ratio` times them.
    force : ndarray, shape (n, 3)
        Loads on the inner ring in the bearing frame [N].
    start : ndarray, shape (n, 3)
        Displacements from which the search starts [m].

    Returns
    -------
    displacement : ndarray, shape (n, 3)
        Displacements at which the rollers carry the load [m].
    unbalanced : ndarray, shape (n,)
        Unbalanced force |Σ Q n − F| [N], at most 1e-10 |F| + 1e-7 N where the solver
        converged.

    Examples
    --------
    >>> ring = RingGeometry(np.array([0.0]), np.array([-1.0]), np.zeros(1), 1.0, 1e-4, 1e11, 0.45)
    >>> found, unbalanced = balance(ring, np.zeros(1), np.array([[0.0, -1e5, 0.0]]), np.zeros((1, 3)))
    >>> float(round(1e6 * found[0, 1], 6))
    -200.0
    """
    contacts = _contacts(ring, shaft_angle)
    displacement = np.array(start, dtype=float)
    unbalanced = _descend(ring, contacts, force, displacement, _WARM_ITERATIONS)
    failed = np.flatnonzero(~(unbalanced <= _tolerance(force)))
    if failed.size:
        # A start at the far side of the play would have to slide round the whole bearing; from the
        # middle it is short.
        displacement[failed] = 0.0
        again = displacement[failed]
        unbalanced[failed] = _descend(
            ring, contacts.rows(failed), force[failed], again, _COLD_ITERATIONS
        )
        displacement[failed] = again
    return displacement, unbalanced


def balance_series(
    ring: RingGeometry, shaft_angle: np.ndarray, force: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Ring balance over a load history, by `balance`.

    A few samples are solved from the middle of the play, the others from between these.

    Parameters
    ----------
    ring : RingGeometry
    shaft_angle : ndarray, shape (n,)
        Shaft angles [rad].
    force : ndarray, shape (n, 3)
        Loads on the inner ring in the bearing frame [N].

    Returns
    -------
    displacement : ndarray, shape (n, 3)
        Displacements at which the rollers carry the load [m].
    unbalanced : ndarray, shape (n,)
        Unbalanced force |Σ Q n − F| [N].

    Examples
    --------
    >>> ring = RingGeometry(np.array([0.0]), np.array([-1.0]), np.zeros(1), 1.0, 1e-4, 1e11, 0.45)
    >>> loads = np.array([[0.0, -1e5, 0.0], [0.0, -8e5, 0.0]])
    >>> displacement, _ = balance_series(ring, np.zeros(2), loads)
    >>> (1e6 * displacement[:, 1]).round(6).tolist()
    [-200.0, -500.0]
    """
    count = shaft_angle.size
    displacement = np.zeros((count, 3))
    unbalanced = np.full(count, np.inf)
    known = np.zeros(0, int)
    for distance in _DISTANCES:
        last = count - 1
        wanted = np.append(np.arange(0, last, distance), last)
        samples = np.setdiff1d(wanted, known, assume_unique=True)
        if known.size:
            for component in displacement.T:
                component[samples] = np.interp(samples, known, component[known])
        for first in range(0, samples.size, _TOGETHER):
            piece = samples[first : first + _TOGETHER]
            displacement[piece], unbalanced[piece] = balance(
                ring, shaft_angle[piece], force[piece], displacement[piece]
            )
        known = wanted
    return displacement, unbalanced


def tangent_stiffness(
    ring: RingGeometry, shaft_angle: np.ndarray, displacement: np.ndarray
) -> np.ndarray:
    """Change of the rollers' force on the ring with its displacement, the Hessian of Π.

    It is Σ_j dQ_j/dδ_j n_j n_jᵀ over the loaded rollers, with dQ/dδ = 1.5 K √δ of elliptical
    contacts; it is symmetric, and singular where the rollers do not hold the ring.

    Parameters
    ----------
    ring : RingGeometry
    shaft_angle : ndarray, shape (n,)
        Shaft angles [rad].
    displacement : ndarray, shape (n, 3)
        Displacements of the ring [m].

    Returns
    -------
    ndarray, shape (n, 3, 3)
        [N/m], in the bearing frame.

    Examples
    --------
    >>> ring = RingGeometry(np.array([0.0]), np.array([-1.0]), np.zeros(1), 1.0, 1e-4, 1e11, 0.45)
    >>> float(tangent_stiffness(ring, np.zeros(1), np.array([[0.0, -2e-4, 0.0]]))[0, 1, 1])
    1500000000.0
    """
    contacts = _contacts(ring, shaft_angle)
    # The Hessian of Π knows no load.
    no_force = np.zeros_like(displacement)
    return _evaluate(contacts, no_force, displacement).hessian


def roller_loads(
    ring: RingGeometry, shaft_angle: np.ndarray, displacement: np.ndarray
) -> np.ndarray:
    """Load of every roller at n positions of the ring.

    Parameters
    ----------
    ring : RingGeometry
    shaft_angle : ndarray, shape (n,)
        Shaft angles [rad].
    displacement : ndarray, shape (n, 3)
        Displacements of the ring [m].

    Returns
    -------
    ndarray, shape (n, rollers)
        Q [N], ≥ 0.

    Examples
    --------
    >>> ring = RingGeometry(np.array([0.0, 1.0]), np.array([-1.0, 0.0]), np.zeros(2), 1.0, 1e-4, 1e11, 0.45)
    >>> roller_loads(ring, np.zeros(1), np.array([[0.0, -2e-4, 0.0]])).round(6).tolist()
    [[100000.0, 0.0]]
    """
    loads = np.empty((shaft_angle.size, ring.cosine.size))
    for first in range(0, shaft_angle.size, _TOGETHER):
        piece = slice(first, first + _TOGETHER)
        contacts = _contacts(ring, shaft_angle[piece])
        approach = contacts.approach(displacement[piece])
        if ring.line_stiffness > 0.0:
            loads[piece] = _line_loads(ring, approach)[0]
        else:
            loads[piece] = ring.stiffness * approach * np.sqrt(approach)
    return loads
