"""Solver of the ring balance of tapered roller bearings: damped Newton steps in a convex energy.

A step eliminates the three unknowns of every roller and solves for the five of the ring. Before the
next one every roller moves into balance by itself, with a damping of its own: a loose roller, which
nothing holds, would else hold up the ring and all other rollers. What is solved is in
`ring/tapered.py`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline

#: Iterations after which a balance counts as failed.
_MOST_ITERATIONS = 400
#: Approach [m] at which the stiffness of a contact is the unit of the damping.
_TYPICAL_APPROACH = 1e-5
#: Least damping of a roller [N/m].
_LEAST_DAMPING = 1e-3
#: Unbalance up to which rollers are settled over that of all before a step, and over the load before
#: the first one; damping of the ring over the stiffness of a contact up to which that is enough.
_SLACK = 0.05
_FIRST_SLACK = 1e-3
_EASY = 1e-8
#: Parts of the load through which a balance is sought that was not found at once.
_FALLING_LOADS = (1e4, 1e3, 1e2, 1e1, 1.0)


@jit_inline
def _motion_map(ring, roller, angle, motion):
    """Fill the map of d to the ring's motion w at a roller's middle, shape (3, 5)."""
    cosine = math.cos(angle)
    sine = math.sin(angle)
    sign = ring.sign[roller]
    axial_position = ring.axial_position[roller]
    motion[:] = 0.0
    motion[0, 0] = cosine
    motion[0, 1] = sine
    motion[0, 3] = -axial_position * sine
    motion[0, 4] = axial_position * cosine
    motion[1, 2] = sign
    motion[1, 3] = ring.pitch_radius * sine * sign
    motion[1, 4] = -ring.pitch_radius * cosine * sign
    # The ring's section in the roller's meridian plane turns by θY cos φ − θX sin φ.
    motion[2, 3] = -sine * sign
    motion[2, 4] = cosine * sign


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
        arm = arms[k]
        approach = normal + arm * moved[2] - ring.profile[k]
        if approach > 0.0:
            secant = ring.strip_coefficient * approach ** (ring.strip_exponent - 1.0)
            load = secant * approach
            slope = secant * ring.strip_exponent
            energy += load * approach
            load_sum += load
            moment += load * arm
            slope_sum += slope
            slope_moment += slope * arm
            slope_square += slope * arm * arm
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
    normal = ring.rib_normal
    approach = 0.0
    for a in range(3):
        approach -= normal[a] * moved[a]
    if approach <= 0.0:
        return 0.0, 0.0
    secant = ring.rib_stiffness * math.sqrt(approach)
    slope = 1.5 * secant
    load = secant * approach
    for a in range(3):
        force[a] -= load * normal[a]
        for b in range(3):
            stiffness[a, b] += slope * normal[a] * normal[b]
    return 0.4 * load * approach, load


class _State(NamedTuple):
    """Motions, forces and stiffnesses of all rollers in one trial, as a Newton step reads them."""

    ring_motion: np.ndarray  #: Shape (rollers, 3). w at the roller's middle
    roller_motion: np.ndarray  #: Shape (rollers, 3). v
    between: np.ndarray  #: Shape (rollers, 3). w - v
    ring_force: np.ndarray  #: Shape (rollers, 3). Of inner raceway and rib, against w
    roller_force: np.ndarray  #: Shape (rollers, 3). Out of balance on the roller, against v
    inner_stiffness: np.ndarray  #: Shape (rollers, 3, 3). Of inner raceway and rib
    outer_stiffness: np.ndarray  #: Shape (rollers, 3, 3). Of the outer raceway
    passed: np.ndarray  #: Shape (rollers, 3, 3). Motion of the roller per motion of the ring
    shifted: np.ndarray  #: Shape (rollers, 3). Motion that brings the roller into balance
    damping: np.ndarray  #: Shape (rollers,). Levenberg's damping of each roller [N/m]
    inner_load: np.ndarray  #: Shape (rollers,). Q_i [N]
    outer_load: np.ndarray  #: Shape (rollers,). Q_o [N]
    rib_force: np.ndarray  #: Shape (rollers,). F_f [N]


@jit_inline
def _new_state(rollers):
    """Empty arrays of a state."""
    return _State(
        np.zeros((rollers, 3)),
        np.zeros((rollers, 3)),
        np.zeros((rollers, 3)),
        np.zeros((rollers, 3)),
        np.zeros((rollers, 3)),
        np.zeros((rollers, 3, 3)),
        np.zeros((rollers, 3, 3)),
        np.zeros((rollers, 3, 3)),
        np.zeros((rollers, 3)),
        np.zeros(rollers),
        np.zeros(rollers),
        np.zeros(rollers),
        np.zeros(rollers),
    )


@jit_inline
def _press(ring, j, state):
    """Fill forces and stiffnesses of a roller at its motion and the ring's; returns its energy [J]."""
    between = state.between[j]
    ring_motion = state.ring_motion[j]
    roller_motion = state.roller_motion[j]
    for a in range(3):
        between[a] = ring_motion[a] - roller_motion[a]
    force = state.ring_force[j]
    roller_force = state.roller_force[j]
    inner = state.inner_stiffness[j]
    inner_energy, state.inner_load[j] = _add_raceway(
        ring.inner_radial, ring.inner_axial, ring.inner_arm, ring, between, force, inner
    )
    rib_energy, state.rib_force[j] = _rib(ring, between, force, inner)
    outer_energy, state.outer_load[j] = _add_raceway(
        ring.outer_radial, ring.outer_axial, ring.outer_arm, ring, roller_motion,
        roller_force, state.outer_stiffness[j],
    )  # fmt: skip
    for a in range(3):
        roller_force[a] -= force[a]
    return inner_energy + rib_energy + outer_energy


@jit_inline
def _roller_unbalance(ring, j, state):
    """Largest force left unbalanced on a roller [N], a moment counting as a force at its end."""
    force = state.roller_force[j]
    end_force = abs(force[2]) / abs(ring.inner_arm[0])
    return max(abs(force[0]), abs(force[1]), end_force)


@jit_inline
def _settle(ring, j, tolerance, state):
    """Move a roller into balance at the ring's motion; returns its energy [J].

    Damped Newton steps of its own: a loose roller, which has nothing to hold it, would else hold up
    the ring and all other rollers.
    """
    energy = _press(ring, j, state)
    left = _roller_unbalance(ring, j, state)
    motion = state.roller_motion[j]
    shift = state.shifted[j]
    trials = 0
    while left > tolerance and trials < _MOST_ITERATIONS:
        trials += 1
        _eliminate(ring, j, state)
        for a in range(3):
            motion[a] -= shift[a]
        trial = _press(ring, j, state)
        trial_left = _roller_unbalance(ring, j, state)
        # Close to the solution the energy no longer resolves the progress that the unbalanced force
        # still shows.
        if trial <= energy or trial_left <= 0.5 * left:
            energy = trial
            left = trial_left
            state.damping[j] = max(0.1 * state.damping[j], _LEAST_DAMPING)
        else:
            for a in range(3):
                motion[a] += shift[a]
            energy = _press(ring, j, state)
            state.damping[j] *= 10.0
    return energy


@jit_inline
def _evaluate(ring, motions, load, d, tolerance, state, gradient):
    """Settle all rollers at a displacement and fill the gradient by d; returns Π [J]."""
    energy = 0.0
    for a in range(5):
        held = 0.0
        for b in range(5):
            held += ring.support[a, b] * d[b]
        energy += d[a] * (0.5 * held - load[a])
        gradient[a] = held - load[a]
    for j in range(ring.sign.size):
        motion = motions[j]
        _move_ring(ring, motion, d, state.ring_motion[j])
        energy += _settle(ring, j, tolerance, state)
        force = state.ring_force[j]
        for b in range(5):
            for a in range(3):
                gradient[b] += motion[a, b] * force[a]
    return energy


@jit_inline
def _move_ring(ring, motion, d, w):
    """Fill the ring's motion w at a roller's middle."""
    for a in range(3):
        w[a] = 0.0
        for b in range(5):
            w[a] += motion[a, b] * d[b]
    w[1] += ring.preload


@jit_inline
def _eliminate(ring, j, state):
    """Eliminate a roller's unknowns, by Cholesky factors of its damped stiffness.

    `passed` becomes (inner + outer)⁻¹ inner, the roller's motion per motion of the ring, and
    `shifted` (inner + outer)⁻¹ force.
    """
    inner = state.inner_stiffness[j]
    outer = state.outer_stiffness[j]
    passed = state.passed[j]
    shifted = state.shifted[j]
    force = state.roller_force[j]
    damping = state.damping[j]
    tilt_damping = damping * ring.inner_arm[0] * ring.inner_arm[0]
    l11 = math.sqrt(inner[0, 0] + outer[0, 0] + damping)
    l21 = (inner[1, 0] + outer[1, 0]) / l11
    l31 = (inner[2, 0] + outer[2, 0]) / l11
    square = inner[1, 1] + outer[1, 1] + damping - l21 * l21
    l22 = math.sqrt(max(square, 1e-3 * damping))
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
def _add_roller(motion, j, state, matrix, right):
    """Add a roller's condensed stiffness and load to those of the ring."""
    inner = state.inner_stiffness[j]
    passed = state.passed[j]
    shifted = state.shifted[j]
    for a in range(3):
        pushed = 0.0
        for c in range(3):
            pushed += inner[a, c] * shifted[c]
        for e in range(5):
            right[e] -= motion[a, e] * pushed
        for b in range(3):
            left = inner[a, b]
            for c in range(3):
                left -= inner[a, c] * passed[c, b]
            for e in range(5):
                for g in range(5):
                    matrix[e, g] += motion[a, e] * left * motion[b, g]


@jit_inline
def _step(ring, motions, state, gradient, damping, d, d_step):
    """Take the Newton step of ring and rollers, the ring's damped; fills the ring's part."""
    matrix = ring.support.copy()
    right = -gradient
    tilt_damping = damping * ring.pitch_radius**2
    for a in range(5):
        matrix[a, a] += damping if a < 3 else tilt_damping
    rollers = ring.sign.size
    for j in range(rollers):
        _eliminate(ring, j, state)
        _add_roller(motions[j], j, state, matrix, right)
    d_step[:] = np.linalg.solve(matrix, right)
    d += d_step
    for j in range(rollers):
        motion = motions[j]
        passed = state.passed[j]
        for a in range(3):
            step = -state.shifted[j, a]
            for c in range(3):
                for b in range(5):
                    step += passed[a, c] * motion[c, b] * d_step[b]
            state.roller_motion[j, a] += step


@jit_inline
def _turn_on(ring, motions, d, state):
    """Let rollers that have moved on take part in the ring's motion at their new positions."""
    w = np.empty(3)
    for j in range(ring.sign.size):
        _move_ring(ring, motions[j], d, w)
        passed = state.passed[j]
        ring_motion = state.ring_motion[j]
        roller_motion = state.roller_motion[j]
        for a in range(3):
            for c in range(3):
                roller_motion[a] += passed[a, c] * (w[c] - ring_motion[c])


@jit_inline
def _largest_force(ring, components):
    """Largest of forces and moments on the ring [N], a moment counting as forces at its rollers."""
    largest = 0.0
    for a in range(5):
        size = abs(components[a])
        if a >= 3:
            size /= ring.pitch_radius
        largest = max(largest, size)
    return largest


@jit_inline
def _unbalance(ring, state, gradient):
    """Largest force left unbalanced on ring and rollers [N]."""
    largest = _largest_force(ring, gradient)
    for j in range(ring.sign.size):
        largest = max(largest, _roller_unbalance(ring, j, state))
    return largest


@jit_inline
def _descend(ring, motions, load, tolerance, d, state):
    """Damped Newton steps downhill in Π from d and the rollers' motions, changed in place.

    Returns the force left unbalanced [N] and the number of steps.
    """
    gradient = np.zeros(5)
    slack = max(0.5 * tolerance, _FIRST_SLACK * _largest_force(ring, load))
    energy = _evaluate(ring, motions, load, d, slack, state, gradient)
    left = _unbalance(ring, state, gradient)
    relative = 1e-9
    unit = _unit_stiffness(ring)
    d_step = np.zeros(5)
    trial_gradient = np.zeros(5)
    kept = np.empty_like(state.roller_motion)
    for iteration in range(_MOST_ITERATIONS):
        if left <= tolerance or relative > 1e9:
            return left, iteration
        kept[:] = state.roller_motion
        _step(ring, motions, state, gradient, relative * unit, d, d_step)
        if relative <= _EASY:
            slack = max(_SLACK * left, 0.5 * tolerance)
        trial = _evaluate(ring, motions, load, d, slack, state, trial_gradient)
        trial_left = _unbalance(ring, state, trial_gradient)
        if trial <= energy or trial_left <= 0.5 * left:
            energy = trial
            left = trial_left
            gradient[:] = trial_gradient
            relative = max(0.1 * relative, 1e-14)
        else:
            # Energies of rollers that are out of balance are too high, which may have decided.
            slack = 0.5 * tolerance
            d -= d_step
            state.roller_motion[:] = kept
            energy = _evaluate(ring, motions, load, d, slack, state, gradient)
            left = _unbalance(ring, state, gradient)
            relative = max(10.0 * relative, 1e-6)
    return left, _MOST_ITERATIONS


@jit_inline
def _unit_stiffness(ring):
    """Stiffness of a raceway's contact at a typical approach [N/m]."""
    width = ring.strip_coefficient * ring.profile.size
    return width * _TYPICAL_APPROACH ** (ring.strip_exponent - 1.0)


@jit_inline
def _start(ring, d, state):
    """Put the ring into the middle, and rollers between the rings."""
    d[:] = 0.0
    state.roller_motion[:] = 0.0
    state.roller_motion[:, 1] = 0.5 * ring.preload
    state.damping[:] = 1e-4 * _unit_stiffness(ring)


@jit
def solve_series(ring, shaft_angle, loads, tolerance, results):
    """Fill the balances of a load history, each from the one before.

    Parameters
    ----------
    ring : TaperedRing
    shaft_angle : ndarray, shape (n,)
        Angle of the shaft [rad].
    loads : ndarray, shape (n, 5)
        Forces [N] and moments [N m] on the ring.
    tolerance : ndarray, shape (n,)
        Unbalanced force at which a balance has converged [N].
    results : TaperedBalance
        Written.
    """
    rollers = ring.sign.size
    motions = np.empty((rollers, 3, 5))
    state = _new_state(rollers)
    d = np.zeros(5)
    _start(ring, d, state)
    for n in range(shaft_angle.size):
        for j in range(rollers):
            angle = ring.angle[j] + ring.orbit_ratio * shaft_angle[n]
            _motion_map(ring, j, angle, motions[j])
        if n > 0:
            _turn_on(ring, motions, d, state)
        allowed = tolerance[n]
        left, iterations = _descend(ring, motions, loads[n], allowed, d, state)
        if not left <= allowed:
            # Small loads on loose rollers are approached from larger ones.
            _start(ring, d, state)
            for factor in _FALLING_LOADS:
                load = factor * loads[n]
                left, again = _descend(ring, motions, load, factor * allowed, d, state)
                iterations += again
        results.displacement[n] = d
        results.unbalanced[n] = left
        results.iterations[n] = iterations
        results.rib_force[n] = state.rib_force
        results.inner_load[n] = state.inner_load
        results.outer_load[n] = state.outer_load
        results.roller_motion[n] = state.roller_motion
