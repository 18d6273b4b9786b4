"""Ring balance of tapered roller bearings against closed forms, energy and independent tables."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize

from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.ring.tapered import gearbox_support, strip_loads, tapered_balance, tapered_ring

MAIN = TaperedBearing.read("tdo-main-bearing")
SMALL = TaperedBearing.read("32216-pair")
L0 = ((50e3, -1300e3, 700e3), (0.0, 0.0))
L1 = (L0[0], (-700e3, 200e3))
L2 = ((0.0, -300e3, 300e3), (0.0, 0.0))


def solve(bearing, load, angle=0.0, **options):
    ring = tapered_ring(bearing, **options)
    force, moment = (np.array([part], dtype=float) for part in load)
    return ring, tapered_balance(ring, np.array([angle]), force, moment)


#: Largest and least outer load of the row that carries thrust and of the other one [kN], by preload
#: [mm] and load, of a program of others under the same law of a strip.
TABLE = [
    (-0.2, L0, (112.1, 21.8, 134.2, 0.0)),
    (0.0, L0, (112.3, 22.8, 113.5, 0.0)),
    (0.2, L0, (122.7, 34.1, 85.9, 0.0)),
    (0.4, L0, (203.3, 114.6, 162.8, 74.4)),
    (-0.2, L1, (309.2, 0.0, 75.9, 0.0)),
    (0.0, L1, (273.6, 0.0, 76.2, 0.0)),
    (0.2, L1, (234.7, 0.0, 89.4, 10.9)),
    (0.4, L1, (287.1, 44.5, 159.9, 81.2)),
    (0.0, L2, (33.77, 13.06, 27.79, 0.0)),
    (0.2, L2, (70.42, 49.95, 52.99, 32.64)),
]


@pytest.mark.parametrize(("preload", "load", "expected"), TABLE)
def test_extreme_roller_loads_are_those_of_an_independent_program(preload, load, expected):
    _, balance = solve(MAIN.replace(preload=preload * 1e-3), load)
    loads = balance.outer_load[0].reshape(2, -1) / 1e3
    numbers = [loads[0].max(), loads[0].min(), loads[1].max(), loads[1].min()]
    assert numbers == pytest.approx(expected, rel=0.02, abs=0.2)


def test_x_arrangement_is_loaded_more_by_a_moment():
    _, balance = solve(MAIN.replace(preload=0.4e-3, arrangement="X"), L1)
    loads = balance.outer_load[0].reshape(2, -1) / 1e3
    numbers = [loads[0].max(), loads[0].min(), loads[1].max(), loads[1].min()]
    assert numbers == pytest.approx((406.2, 0.0, 269.5, 19.5), rel=0.02, abs=0.2)


def test_displacements_under_force_and_moment():
    _, balance = solve(MAIN, L1)
    dy, dz, tilt = balance.displacement[0, [1, 2, 3]] * 1e6
    assert (dy, dz, tilt) == pytest.approx((-41.61, 8.88, -219.1), rel=1e-3)


@pytest.mark.parametrize(
    ("stiffness", "carried", "largest"), [(1e8, 46.2, 206.9), (1e9, 148.4, 158.5)]
)
def test_a_gearbox_takes_its_part_of_a_moment(stiffness, carried, largest):
    _, balance = solve(MAIN, L1, support=gearbox_support(stiffness, 3.0))
    _, dy, _, turn_x, _ = balance.displacement[0]
    force = stiffness * (dy - 3.0 * turn_x)
    assert force / 1e3 == pytest.approx(carried, rel=0.02)
    assert balance.outer_load.max() / 1e3 == pytest.approx(largest, rel=0.02)


@pytest.mark.parametrize(("preload", "load"), [(0.1, 17.96), (0.2, 51.02), (0.4, 137.2)])
def test_preload_alone_presses_every_roller_alike(preload, load):
    _, balance = solve(MAIN.replace(preload=preload * 1e-3), ((0.0, 0.0, 0.0), (0.0, 0.0)))
    assert balance.outer_load / 1e3 == pytest.approx(load, rel=0.005)
    assert balance.displacement == pytest.approx(0.0, abs=1e-12)


def test_without_load_a_bearing_with_play_carries_nothing():
    _, balance = solve(MAIN.replace(preload=-0.2e-3), ((0.0, 0.0, 0.0), (0.0, 0.0)))
    assert balance.outer_load.max() == 0.0
    assert balance.displacement == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("bearing", [MAIN.replace(preload=-0.1e-3), SMALL])
def test_thrust_alone_has_its_closed_form(bearing):
    row = tapered_geometry(bearing)
    thrust = 6000.0
    _, balance = solve(bearing, ((0.0, 0.0, thrust), (0.0, 0.0)))
    outer = thrust / (bearing.rollers_per_row * math.sin(row.outer_angle))
    beta = row.half_cone_angle
    rib = outer * math.sin(2.0 * beta) / math.cos(row.rib_angle - beta)
    inner = outer - rib * math.sin(row.rib_angle) / math.cos(beta)
    carrying = slice(0, bearing.rollers_per_row)
    assert balance.outer_load[0, carrying] == pytest.approx(outer, rel=1e-6)
    assert balance.rib_force[0, carrying] == pytest.approx(rib, rel=1e-6)
    assert balance.inner_load[0, carrying] == pytest.approx(inner, rel=1e-6)
    assert balance.outer_load[0, bearing.rollers_per_row :].max() == 0.0


def test_a_pair_under_radial_load_thrusts_against_itself():
    ring, balance = solve(SMALL, ((0.0, -10e3, 0.0), (0.0, 0.0)))
    assert balance.outer_load.max() == pytest.approx(1425.6, rel=0.02)
    sine = math.sin(tapered_geometry(SMALL).outer_angle)
    induced = balance.outer_load[0].reshape(2, -1).sum(axis=1) * sine
    assert induced == pytest.approx([1691.0, 1691.0], rel=0.02)
    _, pushed = solve(SMALL, ((0.0, -10e3, 3e3), (0.0, 0.0)))
    induced = pushed.outer_load[0].reshape(2, -1).sum(axis=1) * sine
    assert induced == pytest.approx([4543.0, 1543.0], rel=0.02)
    assert ring.preload == 0.0


def test_rows_are_mirror_images():
    """Thrust the other way round, and moments likewise, exchange the rows."""
    _, balance = solve(MAIN, L1)
    (fx, fy, fz), (mx, my) = L1
    # Rows are staggered by half a pitch: after that way each has the places of the other.
    half_pitch = math.pi / MAIN.rollers_per_row / tapered_geometry(MAIN).orbit_ratio
    _, mirrored = solve(MAIN, ((fx, fy, -fz), (-mx, -my)), angle=half_pitch)
    mirrored.outer_load[0, MAIN.rollers_per_row :] = np.roll(
        mirrored.outer_load[0, MAIN.rollers_per_row :], 1
    )
    assert mirrored.outer_load[0].reshape(2, -1)[::-1] == pytest.approx(
        balance.outer_load[0].reshape(2, -1), rel=1e-5, abs=1.0
    )


def test_forces_of_the_outer_ring_balance_the_load_of_the_inner_one():
    """The outer ring holds all that the inner ring is loaded with, force and moment about the middle."""
    ring, balance = solve(MAIN, L1, angle=0.7)
    row = tapered_geometry(MAIN)
    _, outer = strip_loads(ring, balance, np.array([0.7]), 0)
    angle = ring.angle + ring.orbit_ratio * 0.7
    force = np.zeros(3)
    moment = np.zeros(3)
    places = MAIN.roller_length * ((np.arange(41) + 0.5) / 41 - 0.5)
    for roller, phi in enumerate(angle):
        sign = ring.sign[roller]
        along = row.apex_distance + places
        distance = along / math.cos(row.half_cone_angle)
        radius = distance * math.sin(row.outer_angle)
        apex = ring.axial_position[roller] + sign * row.apex_distance * math.cos(row.axis_angle)
        axial = apex - sign * distance * math.cos(row.outer_angle)
        out = np.array([math.cos(phi), math.sin(phi), 0.0])
        for strip, load in enumerate(outer[roller]):
            point = radius[strip] * out + np.array([0.0, 0.0, axial[strip]])
            normal = math.cos(row.outer_angle) * out
            normal = normal + np.array([0.0, 0.0, sign * math.sin(row.outer_angle)])
            force += load * normal
            moment += np.cross(point, load * normal)
    # Strips are taken at the nominal place of the roller, and their sum follows to rounding.
    assert force == pytest.approx(L1[0], rel=1e-5, abs=10.0)
    assert moment[:2] == pytest.approx(L1[1], rel=1e-4, abs=50.0)


def test_a_general_minimiser_finds_no_lower_energy():
    """Π of few rollers and strips, written anew here, by BFGS."""
    few = SMALL.replace(rollers_per_row=4)
    load = ((1e3, -4e3, 2e3), (40.0, -30.0))
    ring, balance = solve(few, load, strips=21)
    row = tapered_geometry(few)
    places = few.roller_length * ((np.arange(21) + 0.5) / 21 - 0.5)
    sine, cosine = math.sin(row.axis_angle), math.cos(row.axis_angle)
    radius = row.radius_at(places)

    def approaches(d, v, phi, sign, station):
        """Approaches of inner and outer strips and of the rib, in space."""
        tilt = d[4] * math.cos(phi) - d[3] * math.sin(phi)

        def ring_at(r, z):
            return (
                d[0] * math.cos(phi) + d[1] * math.sin(phi) + tilt * z,
                d[2] - tilt * r + sign * ring.preload,
            )

        def roller_at(r, z):
            return v[0] + v[2] * (z - station), v[1] - v[2] * (r - few.pitch_radius)

        def offset(zeta, eta):
            return (
                few.pitch_radius + zeta * sine + eta * cosine,
                station + sign * (-zeta * cosine + eta * sine),
            )

        inner_at, outer_at = offset(places, -radius), offset(places, radius)
        rib_at = offset(row.rib_station, -row.rib_radius_on_roller)
        ring_in, roller_in = ring_at(*inner_at), roller_at(*inner_at)
        n_in = math.cos(row.inner_angle), sign * math.sin(row.inner_angle)
        n_out = math.cos(row.outer_angle), sign * math.sin(row.outer_angle)
        lean = row.axis_angle - row.rib_angle
        n_rib = math.sin(lean), -sign * math.cos(lean)
        inner = sum(n * (a - b) for n, a, b in zip(n_in, ring_in, roller_in, strict=True))
        outer = sum(n * b for n, b in zip(n_out, roller_at(*outer_at), strict=True))
        rib = sum(
            n * (b - a) for n, a, b in zip(n_rib, ring_at(*rib_at), roller_at(*rib_at), strict=True)
        )
        return inner - ring.profile, outer - ring.profile, rib

    def energy(unknowns):
        d = unknowns[:5] * 1e-5
        total = -np.dot(np.concatenate(load), d)
        for roller in range(8):
            v = unknowns[5 + 3 * roller : 8 + 3 * roller] * 1e-5
            inner, outer, rib = approaches(
                d, v, ring.angle[roller], ring.sign[roller], ring.axial_position[roller]
            )
            pressed = np.maximum(np.concatenate([inner, outer]), 0.0)
            total += 9.0 / 19.0 * ring.strip_coefficient * (pressed ** (19.0 / 9.0)).sum()
            total += 0.4 * ring.rib_stiffness * max(rib, 0.0) ** 2.5
        return total

    roller = balance.roller_motion[0].copy()
    roller[:, 1:] *= ring.sign[:, None]
    ours = energy(np.concatenate([balance.displacement[0], roller.ravel()]) * 1e5)
    start = np.concatenate([balance.displacement[0], roller.ravel()]) * 1e5
    start += np.random.default_rng(1).normal(0.0, 0.3, start.size)
    best = minimize(energy, start, method="BFGS", options={"maxiter": 800, "gtol": 1e-7})
    assert best.fun >= ours - 1e-7 * abs(ours)
    assert best.fun == pytest.approx(ours, rel=1e-3)


def test_strips_converge():
    _, coarse = solve(MAIN, L1, strips=41)
    _, fine = solve(MAIN, L1, strips=301)
    assert coarse.outer_load.max() == pytest.approx(fine.outer_load.max(), rel=1e-3)


def test_plane_strain_is_stiffer_than_palmgren():
    _, soft = solve(MAIN, ((0.0, 0.0, 0.0), (0.0, 0.0)))
    _, stiff = solve(MAIN, ((0.0, 0.0, 0.0), (0.0, 0.0)), ring_thickness=0.036)
    assert stiff.outer_load.max() / soft.outer_load.max() == pytest.approx(1.2, abs=0.05)
