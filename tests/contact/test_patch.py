"""Traction summed over a contact against integration over its area with the local law written anew."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip import Bearing, Laws, Lubricant
from macroslip.bearing import geometry
from macroslip.contact.laws import prepare
from macroslip.contact.patch import (
    fine_power,
    patch_of,
    patch_power,
    patch_tractions,
    rolling_lines,
)
from macroslip.contact.table import tractions
from macroslip.contact.traction import chord_table

BEARING, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
FULL = Laws.physical().but(rolling="none")
LIMITED = FULL.but(rheology="limiting-shear")
RADIUS, PITCH, ALPHA, GAMMA = 0.035, 0.3727, math.radians(11.2), 0.042
CHOICES = {
    "physical": FULL,
    "limiting shear": LIMITED,
    "cool": LIMITED.but(heating=False),
    "newtonian": FULL.but(rheology="newtonian"),
    "barus": FULL.but(rheology="newtonian", viscosity="barus"),
}
LOADS = (3.0, 300.0, 5e3, 5e4, 2e5)
SLIPS = (-0.1, -3e-3, -1e-5, 1e-9, 2e-3, 2e-2, 0.1)
RATED = 20.463 * 2 * math.pi / 60
rings = pytest.mark.parametrize("ring", ["inner", "outer"])


def contact(laws, ring="inner", sign=1):
    return getattr(prepare(laws, BEARING, OIL, sign), ring)


def slip_along(patch, station, ring_speed, slip):
    """v(ζ) = Δu + κ h − s ζ."""
    curvature = ring_speed * patch.curvature_ratio - slip / patch.roller_radius
    return (
        slip
        + curvature * station**2 / (2.0 * patch.contour_radius)
        - ring_speed * patch.spin_ratio * station
    )


def power(patch, traction, ring_speed, slip):
    """Δu (F − lag) + κ0 r lag − s skew with κ0 the curvature rate in pure rolling."""
    rolling = (
        patch.curvature_ratio * patch.roller_radius * traction[1] - patch.spin_ratio * traction[2]
    )
    return slip * (traction[0] - traction[1]) + ring_speed * rolling


# --- Slip ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("sign", [1, -1], ids=["downwind", "upwind"])
@pytest.mark.parametrize("speed", [RATED, -RATED], ids=["ahead", "back"])
@rings
@pytest.mark.parametrize("skid", [0.0, 0.004, -0.2])
def test_slip_is_that_of_rigid_bodies(sign, speed, ring, skid):
    """Velocities of ring and roller in space, in the frame that orbits with the roller."""
    orbital = speed * geometry.inner_contact_radius(BEARING) / (2 * PITCH)
    ring_speed = -orbital * geometry.outer_contact_radius(BEARING)
    spin = (ring_speed - skid) / RADIUS
    law = contact(FULL, ring, sign)
    patch = patch_of(law)._replace(spin_ratio=law.shape.spin_ratio)
    outward, axial = np.array([math.cos(0.7), math.sin(0.7), 0.0]), np.array([0.0, 0.0, 1.0])
    tilt, side = sign * ALPHA, 1.0 if ring == "outer" else -1.0
    normal = math.cos(tilt) * outward + math.sin(tilt) * axial
    axis = -math.sin(tilt) * outward + math.cos(tilt) * axial
    of_ring, along = (speed if ring == "inner" else 0.0) - orbital, np.cross(outward, axial)
    for station in np.linspace(-0.053, 0.053, 9):
        drop = 0.25 * station**2 * (1 / (0.98 * 0.4149) + 1 / 0.4149)
        arm = station * axis + side * (RADIUS - drop) * normal
        ring_velocity = np.cross([0.0, 0.0, of_ring], PITCH * outward + arm)
        difference = float((ring_velocity - np.cross(spin * axis, arm)) @ along)
        direction = math.copysign(1.0, np.cross(axis, arm) @ along)
        assert slip_along(patch, station, ring_speed, skid) == pytest.approx(
            difference * direction, abs=1e-14
        )


@given(
    slip=st.floats(-0.05, 0.05).map(lambda x: round(x, 12)),
    bend=st.floats(-37.0, 37.0).map(lambda x: round(x, 9)),
    spin=st.floats(-0.6, 0.6).map(lambda x: round(x, 12)),
)
@settings(max_examples=200)
def test_rolling_lines_are_where_slip_changes_sign(slip, bend, spin):
    end = 0.03
    first, second = rolling_lines(bend, spin, slip, end)
    assert -end <= first <= second <= end
    grid = np.linspace(-end, end, 20001)
    values = slip + bend * grid**2 - spin * grid
    for turn in grid[np.flatnonzero(np.diff(np.sign(values)) != 0)]:
        assert min(abs(first - turn), abs(second - turn)) <= 2.1 * (grid[1] - grid[0])
    scale = abs(slip) + abs(bend) * end**2 + abs(spin) * end
    for left, right in ((-end, first), (first, second), (second, end)):
        if right - left > 1e-6:
            inside = np.linspace(left + 1e-9, right - 1e-9, 50)
            local_slip = slip + bend * inside**2 - spin * inside
            assert local_slip.min() >= -1e-9 * scale or local_slip.max() <= 1e-9 * scale


# --- Film ------------------------------------------------------------------------------------------------------------


def local_stress(laws, pressure, film, speed):
    """τ ≥ 0 from the heat balance c tanh c = (β h Δu/8k) t(2c η Δu/(h sinh 2c)), by bisection in ln c."""
    pressure, speed = np.maximum(pressure, 1e-30), np.maximum(speed, 1e-300)
    if laws.viscosity == "barus":
        eta = 0.54 * np.exp(21e-9 * pressure)
    else:
        index = 21e-9 * 1.96e8 / (math.log(0.54) + 9.67)
        eta = 0.54 * np.exp((math.log(0.54) + 9.67) * ((1 + pressure / 1.96e8) ** index - 1))

    def stress(c):
        viscous = eta * speed / film * 4 * c * np.exp(-2 * c) / -np.expm1(-4 * c)
        if laws.rheology == "limiting-shear":
            return -GAMMA * pressure * np.expm1(-viscous / (GAMMA * pressure))
        return 6.7e6 * np.arcsinh(viscous / 6.7e6) if laws.rheology == "eyring" else viscous

    if not laws.heating:
        return stress(np.full_like(pressure, 1e-9))
    heat = 0.056 * film * speed / (8 * 0.125)
    low, high = np.full_like(pressure, math.log(1e-12)), np.full_like(pressure, math.log(300.0))
    for _ in range(52):
        middle = 0.5 * (low + high)
        c = np.exp(middle)
        above = c * np.tanh(c) > heat * stress(c)
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return stress(np.exp(0.5 * (low + high)))


def graded(breaks, panels=8, nodes=6):
    """Gauss nodes and weights on panels that shrink by a factor of six towards every break."""
    t, w = np.polynomial.legendre.leggauss(nodes)
    ladder = 0.5 * np.concatenate([[0.0], 6.0 ** np.arange(1.0 - panels, 1.0)])
    ladder = np.concatenate([ladder, 1.0 - ladder[-2::-1]])
    abscissae, weights = [], []
    for left, right in itertools.pairwise(breaks):
        edges = left + (right - left) * ladder
        half = 0.5 * np.diff(edges)
        abscissae.append((0.5 * (edges[1:] + edges[:-1])[:, None] + half[:, None] * t).ravel())
        weights.append((half[:, None] * w).ravel())
    return np.concatenate(abscissae), np.concatenate(weights)


def whole_area(laws, patch, load, film, ring_speed, slip):
    """F, ∫τ h/r dA, ∫τ ζ dA and ∫τ v dA over the ellipse between the roller's ends, by rules in both directions."""
    root = load ** (1.0 / 3.0)
    across, along, peak = patch.across * root, patch.along * root, patch.pressure * root
    end = min(across, patch.half_length)
    bend = (ring_speed * patch.curvature_ratio - slip / patch.roller_radius) / (
        2.0 * patch.contour_radius
    )
    roots = np.roots([bend, -ring_speed * patch.spin_ratio, slip])
    inside = sorted(
        float(z.real) for z in roots if abs(z.imag) < 1e-12 and abs(z.real) < end * (1 - 1e-9)
    )
    z, w = graded([-end, *inside, end])
    height = np.sqrt(1.0 - (z / across) ** 2)
    t, wt = np.polynomial.legendre.leggauss(60)
    angle = 0.25 * np.pi * (t + 1.0)
    v = slip_along(patch, z, ring_speed, slip)
    stress = local_stress(
        laws, peak * height[:, None] * np.cos(angle), film, np.abs(v)[:, None] + 0.0 * angle
    )
    # x = b √(1 − ζ²/a²) sin θ
    part = w * 2.0 * along * height * (stress @ (0.25 * np.pi * wt * np.cos(angle))) * np.sign(v)
    drop = z**2 / (2 * patch.contour_radius)
    return part.sum(), (part * drop).sum() / patch.roller_radius, (part * z).sum(), (part * v).sum()


@pytest.mark.parametrize("name", CHOICES)
@rings
def test_whole_contact_against_integration_over_its_area(name, ring):
    """Errors are relative to the traction if no part of the contact slipped against another."""
    laws, law = CHOICES[name], contact(CHOICES[name], ring)
    patch, chords = patch_of(law), chord_table(law.fluid)
    heavy, promised = (2e5, 2e-3) if name != "barus" else (5e3, 4e-3)
    for load, slip in itertools.product(
        (candidate for candidate in LOADS if candidate <= heavy), SLIPS
    ):
        force, lag, skew, spent = whole_area(laws, patch, load, 6e-7, -0.396, slip)
        sums = patch_tractions(patch, chords, load, 6e-7, 0.0, -0.396, slip)
        across = patch.across * load ** (1 / 3)
        fastest = np.abs(slip_along(patch, np.linspace(-across, across, 101), -0.396, slip)).max()
        largest = abs(float(law.uniform_traction(load, 6e-7, fastest)))
        reach = across**2 / (2 * patch.contour_radius * RADIUS)
        assert sums[0] == pytest.approx(force, abs=promised * largest), (load, slip)
        assert sums[1] == pytest.approx(lag, abs=promised * largest * reach), (load, slip)
        assert sums[2] == pytest.approx(skew, abs=promised * largest * across), (load, slip)
        assert power(patch, sums, -0.396, slip) == pytest.approx(spent, rel=promised), (load, slip)
        assert patch_power(patch, chords, load, 6e-7, -0.396, slip) == power(
            patch, sums, -0.396, slip
        )


@pytest.mark.parametrize("name", ["physical", "limiting shear", "cool"])
def test_fine_rule_is_finer(name):
    """The power with which the error estimate compares must itself be far closer to the truth."""
    law = contact(CHOICES[name])
    patch = patch_of(law)
    for load, slip in ((300.0, -1e-3), (5e4, 4e-3), (5e4, 2e-2), (1.5e5, 3e-3)):
        spent = whole_area(CHOICES[name], patch, load, 6e-7, -0.396, slip)[3]
        assert fine_power(patch, law.fluid, load, 6e-7, -0.396, slip) == pytest.approx(
            spent, rel=2e-5
        )


def random_states(count=2000):
    random = np.random.default_rng(2)
    load, film = 10.0 ** random.uniform(0.0, 5.3, count), 10.0 ** random.uniform(-7.0, -5.0, count)
    slip = random.choice([-1.0, 1.0], count) * 10.0 ** random.uniform(-9.0, -0.5, count)
    return load, film, random.uniform(-1.0, 1.0, count), slip


@pytest.mark.parametrize("name", CHOICES)
def test_bounds_and_signs(name):
    law = contact(CHOICES[name])
    patch, chords = patch_of(law), chord_table(law.fluid)
    load, film, ring_speed, slip = random_states()
    none = np.zeros_like(load)
    tractions = patch_tractions(patch, chords, load, film, none, ring_speed, slip)
    spent = power(patch, tractions.T, ring_speed, slip)
    scale = np.abs(slip * tractions[:, 0]) + np.abs(
        ring_speed * (tractions[:, 1] + tractions[:, 2] * patch.spin_ratio)
    )
    assert (spent >= -1e-12 * scale).all() and (tractions[:, 3] == 0.0).all()
    back = patch_tractions(patch, chords, load, film, none, -ring_speed, -slip)
    np.testing.assert_allclose(
        back, -tractions, rtol=1e-9, atol=1e-9 * float(np.abs(tractions).max())
    )
    if CHOICES[name].rheology == "limiting-shear":
        half = np.minimum(patch.across * np.cbrt(load), patch.half_length)
        for values, arm in zip(
            tractions.T, (1.0, half**2 / (2 * patch.contour_radius * RADIUS), half), strict=False
        ):
            assert (np.abs(values) <= GAMMA * load * arm * (1 + 1e-4)).all()


@pytest.mark.parametrize("name", CHOICES)
def test_without_microslip_slip_is_uniform(name):
    """The rule along the stations then has one segment only, and serves Barus' peaked stress up to some 5 kN."""
    law = contact(CHOICES[name])
    # What is promised of the rule wherever slip varies.
    chords, promised = chord_table(law.fluid), 4e-3 if name == "barus" else 2e-3
    # The contact with microslip is the same where its curvature and spin vanish.
    still = patch_of(law)._replace(curvature_ratio=0.0, spin_ratio=0.0, roller_radius=math.inf)
    patch = still._replace(microslip=False)
    for load, slip in itertools.product(LOADS[:4], (-0.05, 1e-9, 1e-4, 0.1)):
        if name == "barus" and load > 1e4:
            continue
        sums = patch_tractions(patch, chords, load, 6e-7, 0.0, -0.4, slip)
        exact, _, _, spent = whole_area(
            CHOICES[name], patch._replace(contour_radius=1e9), load, 6e-7, 0.0, slip
        )
        assert sums[0] == pytest.approx(exact, rel=promised)
        assert float(law.uniform_traction(load, 6e-7, slip)) == pytest.approx(sums[0], rel=1e-12)
        assert sums[2] == pytest.approx(0.0, abs=1e-9 * abs(exact)) and sums[1] == 0.0
        assert spent == pytest.approx(exact * slip, rel=1e-3)
        assert patch_tractions(still, chords, load, 6e-7, 0.0, -0.4, slip)[0] == pytest.approx(
            sums[0], rel=1e-12
        )


def test_contact_is_cut_off_at_the_ends_of_the_roller():
    """Coulomb-like stress γ p: what Hertz pressure carries beyond ±l/2 is left out, a known part of the load."""
    law = contact(CHOICES["cool"].but(microslip=False))
    patch, chords, load = patch_of(law), chord_table(law.fluid), 4e5
    across = patch.across * load ** (1 / 3)
    x = patch.half_length / across
    kept = 0.5 * (3.0 * x - x**3)
    assert x < 1.0
    assert patch_tractions(patch, chords, load, 2e-8, 0.0, 0.0, 0.3)[0] == pytest.approx(
        GAMMA * load * kept, rel=2e-3
    )
    longer = patch._replace(half_length=1.0)
    assert patch_tractions(longer, chords, load, 2e-8, 0.0, 0.0, 0.3)[0] == pytest.approx(
        GAMMA * load, rel=2e-3
    )


# --- Asperities ------------------------------------------------------------------------------------------------------


@given(
    load=st.floats(0.0, 5.5).map(lambda x: 10.0**x),
    share=st.floats(1e-6, 1.0),
    slip=st.floats(-0.05, 0.05).map(lambda x: round(x, 9)),
    ring_speed=st.floats(-1.0, 1.0).map(lambda x: round(x, 9)),
)
@settings(max_examples=60)
def test_friction_of_asperities_along_the_roller_against_dense_integration(
    load, share, slip, ring_speed
):
    """µ_b p min(|v|/v_full, 1) over the stations of the Hertz contact, beside the film's part of the load."""
    law = contact(FULL)
    patch, chords = patch_of(law), chord_table(law.fluid)
    sums = patch_tractions(patch, chords, load, 6e-7, share, ring_speed, slip)
    sums[:3] -= (1.0 - share) * patch_tractions(patch, chords, load, 6e-7, 0.0, ring_speed, slip)[
        :3
    ]
    across = patch.across * load ** (1 / 3)
    half = min(across, patch.half_length)
    z = (np.arange(100001) + 0.5) / 100001 * 2 * half - half
    v = slip_along(patch, z, ring_speed, slip)
    carried = 0.75 * load / across * (1 - (z / across) ** 2) * (2 * half / 100001)
    part = 0.1 * share * carried * np.clip(v / law.full_slip, -1.0, 1.0)
    drop, largest = z**2 / (2 * patch.contour_radius), 0.1 * share * load
    film = 1e-9 * (1.0 - share) * 0.1 * load
    assert sums[0] == pytest.approx(part.sum(), abs=1e-6 * largest + film)
    reach = across**2 / (2 * patch.contour_radius * RADIUS)
    assert sums[1] == pytest.approx(
        (part * drop).sum() / RADIUS, abs=(1e-6 * largest + film) * reach
    )
    assert sums[2] == pytest.approx((part * z).sum(), abs=(1e-6 * largest + film) * across)
    assert sums[3] == pytest.approx((part * v).sum(), rel=1e-5, abs=1e-12 * largest)


def test_film_and_asperities_share_the_load():
    law = contact(FULL.but(asperities="film-ratio"))
    load, speed, slip = (np.full(1, number) for number in (2e4, 0.02, 3e-3))
    film = law.film_thickness(load, speed - 0.5 * slip)
    share = float(law.asperity_share(load, speed - 0.5 * slip, film)[0])
    assert 0.01 < share < 1.0
    patch, chords = patch_of(law), chord_table(law.fluid)
    both = [patch_tractions(patch, chords, 2e4, film[0], part, 0.02, 3e-3) for part in (0.0, 1.0)]
    computed = np.array([traction[0] for traction in tractions(law, load, speed, slip)])
    np.testing.assert_allclose(computed, (1.0 - share) * both[0] + share * both[1], rtol=1e-9)
