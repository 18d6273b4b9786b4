"""The coupled integrator against SciPy's Radau on the plain equations in angles and speeds.

Newton's law and the spin equation of every roller, the cage's rotation and translation, written again in φ, Ω, ω, without
slips as unknowns, offsets or elimination; only the laws of the contacts are shared, which have references of their own.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from macroslip.bearing.geometry import initial_angles
from macroslip.compiled import jit
from macroslip.contact.look_up import contact_load, contact_speeds, log_speed
from macroslip.contact.mechanisms import Laws
from macroslip.mechanics.cage import cage_forces
from macroslip.mechanics.film_sharing import film_load
from macroslip.mechanics.raceway import raceway_forces, raceway_state
from macroslip.whole.cage import Cage
from macroslip.whole.pocket import pocket_force, stop_force
from tests.quick import COARSE

pytestmark = pytest.mark.slow

ROLLERS = 3


@jit
def raceway(body, law, tables, load, speed, slip):
    """Spin force, pull [N] and power [W] of a raceway contact with its oil."""
    if load <= 0.0:
        return 0.0, 0.0, 0.0
    speeds = contact_speeds(speed, slip, body.closed_form)
    state = raceway_state(law, tables, body.closed_form, contact_load(load), speeds)
    forces = raceway_forces(body, law, tables, state, speeds)
    spin = forces.friction + forces.shear
    pull = forces.pull
    power = forces.friction * slip + speed * (
        law.curvature * forces.lag - law.spin_ratio * forces.skew
    )
    power += forces.rolling_power
    return spin, pull, power


@jit
def roller_contacts(body, tables, load, depth, outward, inner, outer, push, sliding):
    """Spin force, pull [N] and power [W] of both raceways, given ring speeds and slips, and friction of the cage [N]."""
    load += film_load(body, tables, load, depth, outward, outer[0]).load
    at_inner = raceway(body, body.inner, tables, load + max(-outward, 0.0), inner[0], inner[1])
    at_outer = raceway(body, body.outer, tables, load + max(outward, 0.0), outer[0], outer[1])
    cage = cage_forces(body, tables, abs(push), -sliding, log_speed(sliding))
    return at_inner, at_outer, cage.friction + cage.resistance


def plain_equations(prepared, assembly, bearing, displacement, shaft_speed):
    """dy/dt for y = (φ, Ω, ω of all rollers; θ_c, Ω_c, a, b, p, q; energies of inner, outer and cage contacts)."""
    start = np.concatenate([initial_angles(row, ROLLERS) for row in ("downwind", "upwind")])
    r, pitch, alpha = bearing.roller_diameter / 2, bearing.pitch_radius, bearing.contact_angle
    inner, outer = pitch - r * math.cos(alpha), pitch + r * math.cos(alpha)
    mass = bearing.density * math.pi * r**2 * bearing.roller_length
    n = 2 * ROLLERS

    def rate(_, y):
        phi, orbit, spin = y[:n], y[n : 2 * n], y[2 * n : 3 * n]
        cage_angle, cage_speed, a, b, p, q = y[3 * n : 3 * n + 6]
        derivative = np.zeros_like(y)
        torque, force_x, force_y = 0.0, 0.0, -prepared.cage_weight
        push, n_x, n_y, _, _ = stop_force(prepared.radial_play, a, b, p, q)
        force_x -= push * n_x
        force_y -= push * n_y
        for j in range(n):
            row = 0 if j < ROLLERS else 1
            model = prepared.models["upwind" if row else "downwind"]
            theta = start[j] + cage_angle
            cosine, sine = math.cos(theta), math.sin(theta)
            offset = pitch * (phi[j] - theta) + a * sine - b * cosine
            closing = (
                pitch * (orbit[j] - cage_speed)
                + p * sine
                - q * cosine
                + cage_speed * (a * cosine + b * sine)
            )
            spar, _, _ = pocket_force(prepared.pocket, offset, closing)
            radial = (
                displacement[0] * math.cos(phi[j])
                + displacement[1] * math.sin(phi[j])
                - model.radial_play
            )
            depth = radial * model.cos_contact_angle + displacement[2] * model.sin_contact_angle
            load = model.stiffness * max(depth, 0.0) ** 1.5
            outward = mass * pitch * orbit[j] ** 2 - model.weight_in_plane * math.sin(phi[j])
            outward = (
                outward * model.cos_contact_angle
                + model.weight_along_axis * model.sin_contact_angle
            )
            relative = spin[j] - orbit[j] * math.cos(alpha)
            ring_in, ring_out = -(shaft_speed - orbit[j]) * inner, -orbit[j] * outer
            slip_in, slip_out = ring_in - relative * r, ring_out - relative * r
            sliding = -r * (spin[j] - cage_speed * math.cos(alpha))
            at_inner, at_outer, friction = roller_contacts(
                assembly.bodies[row], assembly.tables.ctypes.data, load, depth, outward, (ring_in, slip_in), (ring_out, slip_out),
                spar, sliding,
            )  # fmt: skip
            against = model.weight_in_plane * math.cos(phi[j]) + model.drag * orbit[j] * abs(
                orbit[j]
            )
            derivative[j] = orbit[j]
            derivative[n + j] = (spar - against - at_inner[1] + at_outer[1]) / (mass * pitch)
            derivative[2 * n + j] = (at_inner[0] + at_outer[0] + friction) / (0.5 * mass * r)
            torque -= spar * (pitch - a * cosine - b * sine) + r * math.cos(alpha) * friction
            force_x += spar * sine
            force_y -= spar * cosine
            derivative[3 * n + 6 :] += [at_inner[2], at_outer[2], friction * sliding]
        derivative[3 * n : 3 * n + 6] = [
            cage_speed, torque / (prepared.cage_mass * pitch**2), p, q,
            force_x / prepared.cage_mass, force_y / prepared.cage_mass,
        ]  # fmt: skip
        return derivative

    return rate, start


@pytest.mark.parametrize(
    ("displacement", "cage", "span", "laws", "oil_gap"),
    [
        ((0.0, -1.05e-4, 0.0), Cage(mass=8.0), 0.12, Laws.paper(), math.inf),
        ((0.0, 0.0, -3e-4), Cage(mass=8.0), 0.12, Laws.paper(), 2e-5),
        (
            (0.0, -1.05e-4, 0.0),
            Cage(mass=8.0),
            0.12,
            Laws.paper().but(rolling="whole-film"),
            math.inf,
        ),
        ((0.0, -1.05e-4, 0.0), Cage(mass=8.0), 0.12, Laws.physical(), math.inf),
        ((0.0, -1.05e-4, 0.0), Cage(mass=8.0, impact="dry"), 0.06, Laws.paper(), math.inf),
    ],
    ids=["squeeze film", "thrust, little oil", "rolling resistance", "physical", "dry impacts"],
)
def test_speeds_places_and_energies(run, bearing, displacement, cage, span, laws, oil_gap):
    speed = 2.143
    # Errors of dry impacts grow from one to the next: the finer the tolerance, the longer solutions agree.
    tolerance = 1e-9 if cage.impact == "dry" else 1e-8
    # The coarsest tables serve: both integrators have them.
    result = run(
        cage, displacement, speed, span, rollers=ROLLERS, tolerance=tolerance, outputs=5, laws=laws,
        table_tolerance=COARSE.tolerance,
        change=lambda made: replace(made, pocket=made.pocket._replace(oil_gap=oil_gap)),
    )  # fmt: skip
    assert result.status == 0
    assert np.abs(result.steps["cage_load"]).max() > 1.0
    small, prepared = bearing.replace(rollers_per_row=ROLLERS), result.bearing
    rate, start = plain_equations(prepared, result.assembly, small, displacement, speed)
    orbit = speed * prepared.inner_radius / (2.0 * prepared.pitch_radius)
    spin = -orbit * prepared.pitch_radius / prepared.radius
    n = 2 * ROLLERS
    begin = np.concatenate(
        [start, np.full(n, orbit), np.full(n, spin), [0.0, orbit], np.zeros(4), np.zeros(3)]
    )
    # Places at rounding of the angles (1e-16 rad) over pockets of 1e-4 m leave ten digits.
    # Energies act on nothing; SciPy enlarges their differences until they overflow.
    with np.errstate(over="ignore"):
        solution = solve_ivp(
            rate,
            (0.0, span),
            begin,
            method="Radau",
            t_eval=result.books.times,
            rtol=1e-8,
            atol=1e-11,
            max_step=2e-3,
        )
    assert solution.success
    relative = solution.y[2 * n : 3 * n] - solution.y[n : 2 * n] * math.cos(bearing.contact_angle)
    scale = np.abs(relative).max()
    surface = result.at_end("outer_speed") - result.at_end("outer_slip")
    assert surface.T / prepared.radius == pytest.approx(relative, abs=3e-5 * scale)
    assert result.cage_speed() == pytest.approx(solution.y[3 * n + 1], rel=3e-5)
    outputs = result.at_outputs()
    assert result.whole["cages"][outputs, 0, 5] == pytest.approx(solution.y[3 * n + 3], abs=2e-8)
    theta = start[:, None] + solution.y[3 * n]
    offset = prepared.pitch_radius * (solution.y[:n] - theta)
    offset += solution.y[3 * n + 2] * np.sin(theta) - solution.y[3 * n + 3] * np.cos(theta)
    np.testing.assert_allclose(result.offset[outputs].T, offset, rtol=0.0, atol=5e-8)
    dissipated = result.energy().sum(axis=0) + result.energy("rolling").sum(axis=0)
    assert dissipated == pytest.approx(solution.y[3 * n + 6 :, -1], rel=2e-3, abs=1e-7)
