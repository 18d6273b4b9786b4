"""Balances of angular momentum and energy: what the bearing holds, and what has flowed in and out.

Momentum Σ(m r~² Ω + I_z' cos α ω_z') + Σ I_c Ω_c changes by the torques alone that raceways, weight, drag and guide exert,
and by that of the pushes on a cage off the axis. A step's torques are summed with the method's weights, so that the balances
close to what Newton's method leaves unbalanced. Kinetic energy of rollers and cages and elastic energy of the spars change
by the work of the shaft and of weights, less what friction and pockets dissipate; the residual is the error of the
method.
"""

from __future__ import annotations

import math

from macroslip.compiled import jit_called, jit_merged
from macroslip.whole_bearing.guidance import guide_energy, guide_force
from macroslip.whole_bearing.pocket import elastic_energy
from macroslip.whole_bearing.stage import GUIDE_SPEED

#: What is booked over time: angular impulses [N m s] and energies [J].
FLOWS = (
    "inner_impulse", "outer_impulse", "body_impulse", "guide_impulse", "eccentric_impulse",
    "shaft_work", "body_work", "cage_weight_work", "raceway_loss", "friction_loss", "guide_loss", "pocket_work", "support_work",
)  # fmt: skip
#: What the bearing holds: angular momentum [N m s], kinetic and elastic energy [J].
STOCKS = ("momentum", "kinetic_energy", "elastic_energy")


@jit_merged
def stocks(bearing, shaft_speed, state, cages, held):
    """Write angular momentum, kinetic energy and elastic energy into `held`, shape (3,)."""
    pitch, mass = bearing.pitch_radius, bearing.roller_mass
    momentum, kinetic, elastic = 0.0, 0.0, 0.0
    rollers = bearing.rollers
    for j in range(rollers.row.size):
        ring = shaft_speed * rollers.inner_radius[j]
        orbital = 0.5 * (state[j, 0] - state[j, 1] + ring)
        spinning = -0.5 * (state[j, 0] + state[j, 1] + ring)
        momentum += mass * (pitch * orbital + 0.5 * bearing.lever * pitch * spinning)
        kinetic += 0.5 * mass * (orbital * orbital + 0.5 * spinning * spinning)
        elastic += elastic_energy(bearing.pocket, state[j, 2])
    for c in range(bearing.cages):
        turning = cages[c, 0] + 0.5 * shaft_speed * bearing.inner_radius
        momentum += bearing.cage_mass * pitch * turning
        kinetic += 0.5 * bearing.cage_mass * (turning * turning + cages[c, 2] ** 2 + cages[c, 3] ** 2)
        elastic += guide_energy(bearing.radial_play, cages[c, 4], cages[c, 5]) if bearing.translates else 0.0
    held[0], held[1], held[2] = momentum, kinetic, elastic


@jit_called
def book_flows(bearing, shaft_speed, moment, span, flows):
    """Add what flows during `span` [s] in the state of a solved stage to `flows`, shape (13,)."""
    stations, state, cages, force = moment.stations, moment.values.rollers, moment.values.cages, moment.force
    pitch = bearing.pitch_radius
    arm = bearing.lever * pitch
    rollers = bearing.rollers
    for j in range(rollers.row.size):
        spin_in, spin_out, pull_in, pull_out = force[j, 0], force[j, 1], force[j, 2], force[j, 3]
        friction, push, sliding, speed = force[j, 4], force[j, 5], force[j, 6], force[j, 7]
        inner_radius = rollers.inner_radius[j]
        orbital = 0.5 * (state[j, 0] - state[j, 1] + shaft_speed * inner_radius)
        lag_in, lag_out = pull_in - spin_in, pull_out - spin_out
        c = rollers.cage[j]
        off_axis = cages[c, 4] * stations.cosine[j] + cages[c, 5] * stations.sine[j]
        flows[0] -= span * (pitch * pull_in - arm * spin_in)
        flows[1] += span * (pitch * pull_out + arm * spin_out)
        flows[2] -= span * pitch * stations.tangential[j]
        flows[4] += span * push * off_axis
        flows[5] -= span * shaft_speed * (inner_radius * spin_in + pitch * lag_in)
        flows[6] -= span * stations.tangential[j] * orbital
        loss = spin_in * state[j, 0] - lag_in * (shaft_speed * pitch - orbital)
        loss += spin_out * state[j, 1] - lag_out * orbital
        flows[8] += span * loss
        flows[9] += span * friction * sliding
        flows[11] -= span * push * speed
    for c in range(bearing.cages):
        turning = cages[c, 0] + 0.5 * shaft_speed * bearing.inner_radius
        drag = bearing.guide_friction * math.tanh(turning / GUIDE_SPEED)
        flows[3] -= span * pitch * drag
        flows[7] -= span * bearing.cage_weight * cages[c, 3]
        flows[10] += span * drag * turning
        if bearing.translates:
            push, n_x, n_y, _, _ = guide_force(bearing.radial_play, cages[c, 4], cages[c, 5], cages[c, 2], cages[c, 3])
            flows[12] += span * push * (n_x * cages[c, 2] + n_y * cages[c, 3])
