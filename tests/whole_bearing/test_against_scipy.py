"""The coupled integrator against SciPy's Radau on the plain equations in angles and speeds.

Newton's law and the spin equation of every roller, the cage's rotation and translation, written again in φ, Ω, ω, without
slips as unknowns, offsets or elimination; only the laws of the contacts are shared, which have references of their own.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from macroslip.bearing.geometry import initial_angles
from macroslip.mechanisms import Laws
from macroslip.roller.contact import cage_contact, raceway_contact
from macroslip.roller.films import Films
from macroslip.roller.play import film_load
from macroslip.rolling.light_contact import light_contact, pocket_contact
from macroslip.whole_bearing.cage import Cage
from macroslip.whole_bearing.guidance import guide_force
from macroslip.whole_bearing.pocket import pocket_force

pytestmark = pytest.mark.slow

ROLLERS = 3


def oil_forces(found):
    """Spin force, pull and power of the oil of a contact, from its forces on the roller."""
    shear, push = found.rolling.shear, found.rolling.push_1
    return found.sliding + shear, found.sliding + shear + push, found.sliding_power + found.rolling.power


def plain_equations(prepared, bearing, displacement, shaft_speed, gap=5e-4):
    """dy/dt for y = (φ, Ω, ω of all rollers; θ_c, Ω_c, a, b, p, q; energies of inner, outer and cage contacts)."""
    start = np.concatenate([initial_angles(row, ROLLERS) for row in ("downwind", "upwind")])
    r, pitch, alpha = bearing.roller_diameter / 2, bearing.pitch_radius, bearing.contact_angle
    inner, outer = pitch - r * math.cos(alpha), pitch + r * math.cos(alpha)
    mass = bearing.density * math.pi * r**2 * bearing.roller_length
    n = 2 * ROLLERS

    def rate(_, y):
        phi, orbit, spin = y[:n], y[n : 2 * n], y[2 * n : 3 * n]
        cage_angle, cage_speed, a, b, p, q = y[3 * n : 3 * n + 6]
        found = np.zeros_like(y)
        torque, force_x, force_y = 0.0, 0.0, -prepared.cage_weight
        push, n_x, n_y, _, _ = guide_force(prepared.radial_play, a, b, p, q)
        force_x -= push * n_x
        force_y -= push * n_y
        for j in range(n):
            model = prepared.models[0 if j < ROLLERS else 1]
            theta = start[j] + cage_angle
            cosine, sine = math.cos(theta), math.sin(theta)
            offset = pitch * (phi[j] - theta) + a * sine - b * cosine
            closing = pitch * (orbit[j] - cage_speed) + p * sine - q * cosine + cage_speed * (a * cosine + b * sine)
            spar, _, _ = pocket_force(prepared.pocket, offset, closing)
            radial = displacement[0] * math.cos(phi[j]) + displacement[1] * math.sin(phi[j]) - model.radial_play
            depth = radial * model.cos_contact_angle + displacement[2] * model.sin_contact_angle
            load = model.stiffness * max(depth, 0.0) ** 1.5
            films = prepared.films
            outward = mass * pitch * orbit[j] ** 2 - model.weight_in_plane * math.sin(phi[j])
            outward = outward * model.cos_contact_angle + model.weight_along_axis * model.sin_contact_angle
            relative = spin[j] - orbit[j] * math.cos(alpha)
            ring_in, ring_out = -(shaft_speed - orbit[j]) * inner, -orbit[j] * outer
            slip_in, slip_out = ring_in - relative * r, ring_out - relative * r
            load += film_load(films, load, depth, outward, ring_out)
            inner_load, outer_load = load + max(-outward, 0.0), load + max(outward, 0.0)
            at_inner = raceway_contact(model.inner, inner_load, ring_in, slip_in)
            at_outer = raceway_contact(model.outer, outer_load, ring_out, slip_out)
            sliding = -r * (spin[j] - cage_speed * math.cos(alpha))
            at_cage = cage_contact(model.cage, abs(spar), sliding)
            inner_oil = outer_oil = cage_oil = (0.0, 0.0, 0.0)
            if isinstance(films, Films):
                inner_oil = oil_forces(light_contact(films.inner, inner_load, relative * r, ring_in))
                outer_oil = oil_forces(light_contact(films.outer, outer_load, relative * r, ring_out))
                cage_oil = oil_forces(pocket_contact(films.cage, abs(spar), -sliding, 0.0, 0.5 * gap))
            against = model.weight_in_plane * math.cos(phi[j]) + model.drag * orbit[j] * abs(orbit[j])
            found[j] = orbit[j]
            along = at_inner.pull + inner_oil[1] - at_outer.pull - outer_oil[1]
            found[n + j] = (spar - against - along) / (mass * pitch)
            friction = at_cage.force + cage_oil[0]
            turning = at_inner.spin + inner_oil[0] + at_outer.spin + outer_oil[0] + friction
            found[2 * n + j] = turning / (0.5 * mass * r)
            torque -= spar * (pitch - a * cosine - b * sine) + r * math.cos(alpha) * friction
            force_x += spar * sine
            force_y -= spar * cosine
            found[3 * n + 6 :] += [
                at_inner.power + inner_oil[2], at_outer.power + outer_oil[2], at_cage.power + cage_oil[2]
            ]  # fmt: skip
        found[3 * n : 3 * n + 6] = [
            cage_speed, torque / (prepared.cage_mass * pitch**2), p, q,
            force_x / prepared.cage_mass, force_y / prepared.cage_mass,
        ]  # fmt: skip
        return found

    return rate, start


@pytest.mark.parametrize(
    ("displacement", "cage", "span", "laws"),
    [
        ((0.0, -1.05e-4, 0.0), Cage(mass=8.0), 0.12, Laws.paper()),
        ((0.0, 0.0, -3e-4), Cage(mass=8.0, film_fullness=0.1), 0.12, Laws.paper()),
        ((0.0, -1.05e-4, 0.0), Cage(mass=8.0), 0.12, Laws.paper().but(rolling="whole-film")),
        ((0.0, -1.05e-4, 0.0), Cage(mass=8.0), 0.12, Laws.physical()),
        ((0.0, -1.05e-4, 0.0), Cage(mass=8.0, impact="dry"), 0.06, Laws.paper()),
    ],
    ids=["squeeze film", "thrust", "rolling resistance", "physical", "dry impacts"],
)
def test_speeds_places_and_energies(run, bearing, displacement, cage, span, laws):
    speed = 2.143
    # Errors of dry impacts grow from one to the next: the finer the tolerance, the longer solutions agree.
    tolerance = 1e-9 if cage.impact == "dry" else 1e-8
    status, record, prepared = run(
        cage, displacement, speed, span, rollers=ROLLERS, tolerance=tolerance, outputs=5, laws=laws
    )
    assert status == 0
    assert np.abs(record.largest_push).max() > 1.0
    small = bearing.replace(rollers_per_row=ROLLERS)
    rate, start = plain_equations(prepared, small, displacement, speed, cage.gap)
    orbit = speed * prepared.inner_radius / (2.0 * prepared.pitch_radius)
    spin = -orbit * prepared.pitch_radius / prepared.radius
    n = 2 * ROLLERS
    begin = np.concatenate([start, np.full(n, orbit), np.full(n, spin), [0.0, orbit], np.zeros(4), np.zeros(3)])
    # Places at rounding of the angles (1e-16 rad) over pockets of 1e-4 m leave ten digits.
    # Energies act on nothing; SciPy enlarges their differences until they overflow.
    with np.errstate(over="ignore"):
        found = solve_ivp(
            rate, (0.0, span), begin, method="Radau", t_eval=record.out_time, rtol=1e-8, atol=1e-11, max_step=2e-3
        )
    assert found.success
    relative = found.y[2 * n : 3 * n] - found.y[n : 2 * n] * math.cos(bearing.contact_angle)
    scale = np.abs(relative).max()
    assert np.transpose(record.trace[:, :, 0]) == pytest.approx(relative, abs=3e-5 * scale)
    assert record.cage_trace[:, 0, 0] == pytest.approx(found.y[3 * n + 1], rel=3e-5)
    assert record.cage_trace[:, 0, 3] == pytest.approx(found.y[3 * n + 3], abs=2e-8)
    theta = start[:, None] + found.y[3 * n]
    offset = prepared.pitch_radius * (found.y[:n] - theta)
    offset += found.y[3 * n + 2] * np.sin(theta) - found.y[3 * n + 3] * np.cos(theta)
    assert np.transpose(record.trace[:, :, 11]) == pytest.approx(offset, abs=5e-8)
    dissipated = record.energy.sum(axis=0) + record.rolling_energy.sum(axis=0)
    assert dissipated == pytest.approx(found.y[3 * n + 6 :, -1], rel=2e-3, abs=1e-7)
