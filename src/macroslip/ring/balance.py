"""Static balance of the inner ring on the discrete rollers of both rows.

The displacement d = (dX, dY, dZ) makes the elastic energy less the work of the load,

    Π(d) = Σ_j (2/5) K δ_j₊^2.5 − F·d,   δ_j = n_j·d − c(φ_j) cos α,   n_j = (cos φ_j cos α, sin φ_j cos α, s sin α),

smallest. The radial clearance is c = P_d/2 + c2 cos 2(φ − ψ) + c3 cos 3(φ − ψ), with the waves of an outer ring out
of round. Π is convex, so every minimum is global and the roller loads are unique; d itself is not where too few rollers
are loaded to hold the ring, and then the solution nearest to the start is as good as any. Levenberg's damping of the
Newton step deals with those singular cases and vanishes in the others.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline

#: Iterations granted to a warm start before a cold one, and to a cold one before the balance counts as failed.
_WARM_ITERATIONS, _COLD_ITERATIONS = 40, 200
#: Push [m] after which no roller will be touched any more (thrust on a bearing without contact angle).
_LONGEST_PUSH = 1e3


class RingGeometry(NamedTuple):
    """Geometry and stiffness of a bearing, for the balance."""

    #: Shape (n,). cos φ and sin φ of every roller of both rows at shaft angle zero.
    cosine: np.ndarray
    sine: np.ndarray
    axial: np.ndarray  #: Shape (n,). s sin α of every roller
    cos_contact_angle: float  #: cos α
    radial_play: float  #: Half the diametral clearance [m]
    stiffness: float  #: K [N/m^1.5]
    orbit_ratio: float  #: Ω/Ω_in [-]
    #: c2 cos 2ψ, c2 sin 2ψ, c3 cos 3ψ and c3 sin 3ψ of the clearance's waves [m].
    second_x: float = 0.0
    second_y: float = 0.0
    third_x: float = 0.0
    third_y: float = 0.0


@jit_inline
def radial_clearance(ring, cosine, sine):
    """Radial clearance [m] at the place cos φ, sin φ of a ring or of a roller's record.

    Examples
    --------
    >>> oval = RingGeometry(np.ones(1), np.zeros(1), np.zeros(1), 1.0, 1e-4, 1e11, 0.45, 2e-5)
    >>> [round(1e6 * radial_clearance(oval, math.cos(phi), math.sin(phi)), 9) for phi in (0.0, 0.5 * math.pi)]
    [120.0, 80.0]
    """
    twice_x, twice_y = cosine * cosine - sine * sine, 2.0 * cosine * sine
    second = ring.second_x * twice_x + ring.second_y * twice_y
    third = ring.third_x * (twice_x * cosine - twice_y * sine) + ring.third_y * (
        twice_y * cosine + twice_x * sine
    )
    return ring.radial_play + second + third


@jit_inline
def _energy_gradient_hessian(ring, turn_cosine, turn_sine, d, force, gradient, hessian):
    """Π; fills its gradient (unbalanced force) and Hessian."""
    energy = 0.0
    for i in range(3):
        energy -= force[i] * d[i]
        gradient[i] = -force[i]
        for k in range(3):
            hessian[i, k] = 0.0
    cosine_alpha = ring.cos_contact_angle
    for j in range(ring.cosine.size):
        cosine = ring.cosine[j] * turn_cosine - ring.sine[j] * turn_sine
        sine = ring.sine[j] * turn_cosine + ring.cosine[j] * turn_sine
        n_x, n_y, n_z = cosine * cosine_alpha, sine * cosine_alpha, ring.axial[j]
        play = radial_clearance(ring, cosine, sine) * cosine_alpha
        approach = n_x * d[0] + n_y * d[1] + n_z * d[2] - play
        if approach > 0.0:
            root = math.sqrt(approach)
            load = ring.stiffness * approach * root
            slope = 1.5 * ring.stiffness * root
            energy += 0.4 * load * approach
            gradient[0] += load * n_x
            gradient[1] += load * n_y
            gradient[2] += load * n_z
            hessian[0, 0] += slope * n_x * n_x
            hessian[0, 1] += slope * n_x * n_y
            hessian[0, 2] += slope * n_x * n_z
            hessian[1, 1] += slope * n_y * n_y
            hessian[1, 2] += slope * n_y * n_z
            hessian[2, 2] += slope * n_z * n_z
    return energy


@jit_inline
def _damped_newton_step(hessian, gradient, damping, step):
    """Solve (H + damping·1) step = −gradient by Cholesky factors of the symmetric 3 × 3 matrix."""
    l11 = math.sqrt(hessian[0, 0] + damping)
    l21 = hessian[0, 1] / l11
    l31 = hessian[0, 2] / l11
    l22 = math.sqrt(hessian[1, 1] + damping - l21 * l21)
    l32 = (hessian[1, 2] - l31 * l21) / l22
    l33 = math.sqrt(hessian[2, 2] + damping - l31 * l31 - l32 * l32)
    y1 = -gradient[0] / l11
    y2 = (-gradient[1] - l21 * y1) / l22
    y3 = (-gradient[2] - l31 * y1 - l32 * y2) / l33
    step[2] = y3 / l33
    step[1] = (y2 - l32 * step[2]) / l22
    step[0] = (y1 - l21 * step[1] - l31 * step[2]) / l11


@jit_inline
def _trace(matrix):
    return matrix[0, 0] + matrix[1, 1] + matrix[2, 2]


@jit_inline
def _length(vector):
    return math.sqrt(vector[0] ** 2 + vector[1] ** 2 + vector[2] ** 2)


@jit_inline
def _descend(ring, turn_cosine, turn_sine, force, displacement, tolerance, most_iterations):
    """Damped Newton steps downhill in Π from `displacement`; returns the unbalanced force [N] that is left."""
    gradient, hessian, step = np.empty(3), np.empty((3, 3)), np.empty(3)
    trial, trial_gradient, trial_hessian = np.empty(3), np.empty(3), np.empty((3, 3))
    magnitude = _length(force)
    # Without a loaded roller there is no stiffness: push the ring along the load until the rollers push back harder.
    push = (magnitude / ring.stiffness) ** (2.0 / 3.0) + abs(ring.radial_play)
    while True:
        energy = _energy_gradient_hessian(
            ring, turn_cosine, turn_sine, displacement, force, gradient, hessian
        )
        if not (magnitude > tolerance and _trace(hessian) == 0.0 and push < _LONGEST_PUSH):
            break
        for i in range(3):
            displacement[i] += push * force[i] / magnitude
        push *= 2.0
    relative = 1e-6
    for _ in range(most_iterations):
        unbalanced = _length(gradient)
        if unbalanced <= tolerance:
            break
        _damped_newton_step(hessian, gradient, relative * _trace(hessian), step)
        for i in range(3):
            trial[i] = displacement[i] + step[i]
        trial_energy = _energy_gradient_hessian(
            ring, turn_cosine, turn_sine, trial, force, trial_gradient, trial_hessian
        )
        slope = gradient[0] * step[0] + gradient[1] * step[1] + gradient[2] * step[2]
        trial_unbalanced = _length(trial_gradient)
        in_contact = _trace(trial_hessian) > 0.0 or trial_unbalanced <= tolerance
        # Close to the solution the energy no longer resolves the progress that the unbalanced force still shows.
        if in_contact and (
            trial_energy <= energy + 1e-4 * slope or trial_unbalanced <= 0.5 * unbalanced
        ):
            energy = trial_energy
            for i in range(3):
                displacement[i] = trial[i]
            gradient, trial_gradient = trial_gradient, gradient
            hessian, trial_hessian = trial_hessian, hessian
            relative = max(0.1 * relative, 1e-14)
        else:
            relative = max(10.0 * relative, 1e-8)
    return _length(gradient)


@jit
def balance(ring, shaft_angle, force, displacement):
    """Ring displacement that carries a load, found from the given start and written in its place.

    Gives the unbalanced force |Σ Q n − F| that is left [N], at most 1e-10 |F| + 1e-7 N where the solver converged.
    Rollers have moved on by orbit_ratio times the shaft angle [rad]; `force` is the load on the inner ring in the
    bearing frame [N], `displacement` the start, overwritten by the solution [m], both of shape (3,).
    """
    turn_cosine = math.cos(ring.orbit_ratio * shaft_angle)
    turn_sine = math.sin(ring.orbit_ratio * shaft_angle)
    magnitude = _length(force)
    tolerance = 1e-10 * magnitude + 1e-7
    unbalanced = math.inf
    for iterations in (_WARM_ITERATIONS, _COLD_ITERATIONS):
        if unbalanced <= tolerance:
            break
        # A start at the far side of the play would have to slide round the whole bearing; from the middle it is short.
        if iterations == _COLD_ITERATIONS:
            for i in range(3):
                displacement[i] = 0.0
        unbalanced = _descend(
            ring, turn_cosine, turn_sine, force, displacement, tolerance, iterations
        )
    return unbalanced


@jit
def balance_series(ring, shaft_angle, force, current, displacement, unbalanced):
    """`balance` over a series, each sample started from its predecessor.

    `current` [m], shape (3,), is the start of the first sample and then the displacement of the last; `displacement`,
    shape (n, 3), and `unbalanced`, shape (n,), are filled with the displacements [m] and the forces that are left [N].
    """
    for k in range(shaft_angle.size):
        unbalanced[k] = balance(ring, shaft_angle[k], force[k], current)
        for i in range(3):
            displacement[k, i] = current[i]


@jit
def roller_loads(ring, shaft_angle, displacement, loads):
    """Load of every roller [N] at a ring displacement [m], written into `loads`, shape (n,)."""
    turn_cosine = math.cos(ring.orbit_ratio * shaft_angle)
    turn_sine = math.sin(ring.orbit_ratio * shaft_angle)
    for j in range(ring.cosine.size):
        cosine = ring.cosine[j] * turn_cosine - ring.sine[j] * turn_sine
        sine = ring.sine[j] * turn_cosine + ring.cosine[j] * turn_sine
        radial = (
            cosine * displacement[0] + sine * displacement[1] - radial_clearance(ring, cosine, sine)
        )
        approach = radial * ring.cos_contact_angle + ring.axial[j] * displacement[2]
        loads[j] = ring.stiffness * approach**1.5 if approach > 0.0 else 0.0
