"""Traction of a whole contact against integration over its area with the local law written anew."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from macroslip.bearing import Bearing
from macroslip.lubricant import Lubricant
from macroslip.mechanisms import Laws
from macroslip.roller.contact_force import slip_field
from macroslip.roller.model import roller_model
from macroslip.traction.barus_crook import traction as barus_crook_traction
from macroslip.traction.film_shear_law import (
    FilmShear,
    chord_traction,
    microslip_traction,
    rising_slip,
    uniform_traction,
)
from macroslip.traction.slip_field import SlipField, slip_at

pytestmark = pytest.mark.slow

BEARING, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
FULL = Laws.physical()
LIMITED = FULL.but(rheology="limiting-shear")
RADIUS, GAMMA = 0.035, 0.042
CHOICES = {
    "physical": FULL,
    "limiting shear": LIMITED,
    "cool": LIMITED.but(heating=False),
    "newtonian": FULL.but(rheology="newtonian"),
    "barus": FULL.but(rheology="newtonian", viscosity="barus"),
}
choices = pytest.mark.parametrize("name", CHOICES)
interfaces = pytest.mark.parametrize("ring", ["inner", "outer"])
LOADS = (3.0, 300.0, 5e3, 5e4, 2e5)
SLIPS = (-0.1, -3e-3, -1e-5, 1e-9, 2e-3, 2e-2, 0.1)


def decades(low, high):
    return st.floats(low, high).map(lambda x: 10.0**x)


def contact(laws, ring="inner", sign=1):
    return getattr(roller_model(BEARING, OIL, sign, tilt=0.0, laws=laws), ring)


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
    found, weights = [], []
    for left, right in itertools.pairwise(breaks):
        edges = left + (right - left) * ladder
        half = 0.5 * np.diff(edges)
        found.append((0.5 * (edges[1:] + edges[:-1])[:, None] + half[:, None] * t).ravel())
        weights.append((half[:, None] * w).ravel())
    return np.concatenate(found), np.concatenate(weights)


def whole_area(laws, law, load, film, field, shape):
    """F, ∫τ h/r dA, ∫τ ζ dA and ∫τ v dA over the ellipse between the roller's ends, by rules in both directions."""
    root = load ** (1.0 / 3.0)
    across, along, peak = law.semi_axis_across * root, law.semi_axis_along * root, law.pressure * root
    end = min(across, shape.half_length)
    roots = np.roots([field.curvature_rate / (2 * shape.contour_radius), -field.spin_rate, field.sliding])
    inside = sorted(float(z.real) for z in roots if abs(z.imag) < 1e-12 and abs(z.real) < end * (1 - 1e-9))
    z, w = graded([-end, *inside, end])
    height = np.sqrt(1.0 - (z / across) ** 2)
    t, wt = np.polynomial.legendre.leggauss(60)
    angle = 0.25 * np.pi * (t + 1.0)
    slip = slip_at.py_func(field, shape.contour_radius, z)
    stress = local_stress(laws, peak * height[:, None] * np.cos(angle), film, np.abs(slip)[:, None] + 0.0 * angle)
    # x = b √(1 − ζ²/a²) sin θ
    per_length = 2.0 * along * height * (stress @ (0.25 * np.pi * wt * np.cos(angle)))
    part = w * per_length * np.sign(slip)
    drop = z**2 / (2 * shape.contour_radius)
    return part.sum(), (part * drop).sum() / shape.roller_radius, (part * z).sum(), (part * slip).sum()


def power(found, shape, slip, ring_speed):
    """Δu (F − lag) + κ0 r lag − s skew with κ0 the curvature rate in pure rolling."""
    rolling = shape.curvature_ratio * shape.roller_radius * found.lag - shape.spin_ratio * found.skew
    return slip * (found.force - found.lag) + ring_speed * rolling


@choices
@interfaces
def test_whole_contact_against_integration_over_its_area(name, ring):
    """Errors are relative to the traction if no part of the contact slipped against another."""
    laws = CHOICES[name]
    here = contact(laws, ring)
    law, shape = here.traction, here.shape
    heavy, promised = (5e4, 2e-3) if name != "barus" else (5e3, 4e-3)
    for load in (load for load in LOADS if load <= heavy or name != "barus"):
        for slip in SLIPS:
            field = slip_field(shape, slip, -0.396)
            force, lag, skew, spent = whole_area(laws, law, load, 6e-7, field, shape)
            found = microslip_traction(law, load, 6e-7, field, shape, False)
            across = law.semi_axis_across * load ** (1 / 3)
            fastest = np.abs(slip_at.py_func(field, shape.contour_radius, np.linspace(-across, across, 101))).max()
            largest = abs(uniform_traction(law, load, 6e-7, fastest)[0])
            reach = across**2 / (2 * shape.contour_radius * RADIUS)
            assert found.force == pytest.approx(force, abs=promised * largest), (load, slip)
            assert found.lag == pytest.approx(lag, abs=promised * largest * reach), (load, slip)
            assert found.skew == pytest.approx(skew, abs=promised * largest * across), (load, slip)
            assert power(found, shape, slip, -0.396) == pytest.approx(spent, rel=promised), (load, slip)


@pytest.mark.parametrize("name", ["physical", "limiting shear", "cool"])
def test_fine_rule_is_finer(name):
    """What the error estimate compares with must itself be far closer to the truth."""
    laws = CHOICES[name]
    here = contact(laws)
    law, shape = here.traction, here.shape
    for load, slip in ((300.0, -1e-3), (5e4, 4e-3), (5e4, 2e-2), (1.5e5, 3e-3)):
        field = slip_field(shape, slip, -0.396)
        force, _, skew, spent = whole_area(laws, law, load, 6e-7, field, shape)
        fine = microslip_traction(law, load, 6e-7, field, shape, True)
        largest = abs(uniform_traction(law, load, 6e-7, 1.0)[0])
        assert fine.force == pytest.approx(force, abs=1e-4 * largest)
        assert fine.skew == pytest.approx(skew, abs=1e-4 * largest * law.semi_axis_across * load ** (1 / 3))
        assert power(fine, shape, slip, -0.396) == pytest.approx(spent, rel=2e-4)


@choices
def test_power_is_never_negative(name):
    here = contact(CHOICES[name])
    rng = np.random.default_rng(2)
    for _ in range(1000):
        load, film = 10.0 ** rng.uniform([0.0, -7.0], [5.3, -5.0])
        ring_speed = rng.uniform(-1.0, 1.0)
        slip = rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-9.0, -0.5)
        found = microslip_traction(
            here.traction, load, film, slip_field(here.shape, slip, ring_speed), here.shape, False
        )
        spent = power(found, here.shape, slip, ring_speed)
        scale = abs(slip * found.force) + abs(ring_speed * (found.lag + found.skew * here.shape.spin_ratio))
        assert spent >= -1e-12 * scale


@interfaces
@given(load=decades(0.5, 5.3), slip=st.floats(-0.12, 0.12), film=decades(-7, -5.5), ring_speed=st.floats(-0.6, 0.6))
@settings(deadline=None, max_examples=80)
def test_traction_is_bounded_by_limiting_shear(ring, load, slip, film, ring_speed):
    here = contact(LIMITED, ring)
    found = microslip_traction(here.traction, load, film, slip_field(here.shape, slip, ring_speed), here.shape, False)
    assert abs(found.force) <= GAMMA * load * (1 + 1e-4)
    half = min(here.semi_axis_across * load ** (1 / 3), here.shape.half_length)
    assert abs(found.lag) <= GAMMA * load * half**2 / (2 * here.shape.contour_radius * RADIUS) * (1 + 1e-4)
    assert abs(found.skew) <= GAMMA * load * half * (1 + 1e-4)
    assert abs(uniform_traction(here.traction, load, film, slip)[0]) <= GAMMA * load * (1 + 1e-4)


def test_no_heat_and_no_slip_are_beyond_the_bound():
    """Extremes of every argument."""
    here = contact(LIMITED)
    for load in (1e-9, 3.0, 2e5, 1e7):
        for film in (1e-12, 1e-7, 1e-2):
            for slip in (0.0, 1e-300, 1e-12, 10.0, 1e6):
                force, *slopes = uniform_traction(here.traction, load, film, slip)
                assert abs(force) <= GAMMA * load * (1 + 1e-4) and np.isfinite(slopes).all(), (load, film, slip)
                found = microslip_traction(
                    here.traction, load, film, slip_field(here.shape, slip, -0.4), here.shape, False
                )
                assert np.isfinite(found).all() and abs(found.force) <= GAMMA * load * (1 + 1e-4), (load, film, slip)


@choices
@given(
    load=decades(0.5, 5.0),
    slip=st.floats(-0.06, 0.06).map(lambda x: round(x, 9)),
    ring_speed=st.sampled_from([-0.4, 0.15]),
)
@example(load=10**4.625, slip=0.0586, ring_speed=0.15)
@settings(deadline=None, max_examples=60)
def test_slopes_are_differences_of_the_function_itself(name, load, slip, ring_speed):
    here = contact(CHOICES[name])
    law, shape, film = here.traction, here.shape, 6e-7

    def at(change, thinner=0.0):
        return microslip_traction(
            law, load, film * (1 - thinner), slip_field(shape, slip + change, ring_speed), shape, False
        )

    found = at(0.0)
    scale = max(abs(uniform_traction(law, load, film, 1e-3)[0]), 1e-12)
    step = 1e-7
    force = (at(step).force - at(-step).force) / (2 * step)
    lag = (at(step).lag - at(-step).lag) / (2 * step)
    # Twice as far gives the same where the function is smooth over the step; corners of the grid are left out.
    wider = (at(2 * step).force - at(-2 * step).force) / (4 * step)
    assume(abs(wider - force) < 1e-3 * abs(force) + 1e-3 * scale)
    assert found.force_slope == pytest.approx(force, rel=2e-2, abs=3e-2 * scale)
    # The lag is the force weighted with the arm. Where traction has passed its peak the parts of its slope cancel, and
    # a share of these parts, not of the sum, is what the table is good to.
    half = min(law.semi_axis_across * load ** (1 / 3), shape.half_length)
    parts = scale + half**2 / (2 * shape.contour_radius * shape.roller_radius) * abs(force)
    assert found.lag_slope == pytest.approx(lag, rel=2e-2, abs=3e-4 * parts)


def test_uniform_slopes_are_differences():
    rng = np.random.default_rng(4)
    for laws in CHOICES.values():
        law = contact(laws).traction
        for _ in range(100):
            load, film, slip = 10.0 ** rng.uniform([0.0, -7.0, -9.0], [5.0, -5.0, -1.0])
            force, by_slip, by_film, by_load = uniform_traction(law, load, film, slip)
            s = 1e-5

            def log_change(*factors):
                ends = [
                    math.log(
                        uniform_traction(
                            law, *(x * math.exp(g * y) for x, y in zip((load, film, slip), factors, strict=False))
                        )[0]
                    )
                    for g in (s, -s)
                ]
                return (ends[0] - ends[1]) / (2 * s)

            tolerance = {"rel": 1e-4, "abs": 2e-5}
            assert by_load * load / force == pytest.approx(log_change(1, 0, 0), **tolerance)
            assert by_film * film / force == pytest.approx(log_change(0, 1, 0), **tolerance)
            assert by_slip * slip / force == pytest.approx(log_change(0, 0, 1), **tolerance)


@choices
@given(load=decades(0.5, 5.3), slip=st.floats(-0.1, 0.1), ring_speed=st.floats(-1.0, 1.0))
@settings(deadline=None, max_examples=40)
def test_everything_turns_its_sign_with_all_speeds(name, load, slip, ring_speed):
    here = contact(CHOICES[name])
    ahead, back = (
        microslip_traction(
            here.traction, load, 5e-7, slip_field(here.shape, s * slip, s * ring_speed), here.shape, False
        )
        for s in (1, -1)
    )
    odd = ("force", "lag", "skew", "force_by_film", "lag_by_film")
    for part in ahead._fields:
        sign = -1 if part in odd else 1
        scale = abs(getattr(ahead, part)) + (GAMMA * load if part in odd else 1.0)
        assert getattr(back, part) == pytest.approx(sign * getattr(ahead, part), abs=1e-9 * scale, rel=1e-9)


@interfaces
def test_the_other_row_is_the_mirror_image(ring):
    one, other = (contact(FULL, ring, sign) for sign in (1, -1))
    for slip in (-0.01, 1e-4, 0.02):
        here, there = (
            microslip_traction(c.traction, 3e4, 6e-7, slip_field(c.shape, slip, -0.4), c.shape, False)
            for c in (one, other)
        )
        assert there == pytest.approx(here._replace(skew=-here.skew), rel=1e-9)


@pytest.mark.parametrize(
    ("name", "load"), [(name, load) for name in CHOICES for load in LOADS[:4] if name != "barus" or load < 1e4]
)
def test_without_curvature_and_spin_slip_is_uniform(name, load):
    """The rule along the stations then has one segment only, and serves Barus' peaked stress up to some 5 kN."""
    here = contact(CHOICES[name])
    promised = 3e-3 if name == "barus" else 1.5e-3
    for slip in (-0.05, 1e-9, 1e-4, 0.1):
        field = SlipField(slip, 0.0, 0.0, 0.0)
        found = microslip_traction(here.traction, load, 6e-7, field, here.shape, False)
        force, by_slip, *_ = uniform_traction(here.traction, load, 6e-7, slip)
        assert found.force == pytest.approx(force, rel=promised)
        assert found.force_slope * slip == pytest.approx(by_slip * slip, abs=3 * promised * abs(force))
        assert found.skew == pytest.approx(0.0, abs=1e-9 * abs(force))
        exact, lag, _, spent = whole_area(CHOICES[name], here.traction, load, 6e-7, field, here.shape)
        assert force == pytest.approx(exact, rel=1e-3)
        assert found.lag == pytest.approx(lag, rel=10 * promised)
        assert spent == pytest.approx(force * slip, rel=1e-3)


@interfaces
@pytest.mark.parametrize("load", [10.0, 1e3, 2e4, 8e4, 2e5])
def test_newtonian_barus_film_with_heating_is_the_papers(ring, load):
    """Two ways of integrating one film: chords from the table, and the closed form."""
    table = contact(CHOICES["barus"], ring).traction
    closed = contact(Laws.paper(), ring).traction
    assert isinstance(table, FilmShear) and not isinstance(closed, FilmShear)
    for film in (2e-7, 1e-6):
        for slip in (-0.3, -1e-4, 1e-12, 1e-8, 1e-5, 1e-2, 0.2):
            found, exact = uniform_traction(table, load, film, slip), barus_crook_traction(closed, load, film, slip)
            promised = 5e-4 if load <= 2e4 else 5e-3
            assert found[0] == pytest.approx(exact[0], rel=promised)
            scale = abs(exact[0])
            weights = (abs(slip), film, load)
            for mine, theirs, weight in zip(found[1:], exact[1:], weights, strict=True):
                assert mine * weight == pytest.approx(theirs * weight, rel=4 * promised, abs=4 * promised * scale)


def test_light_load_is_isoviscous():
    """F → η0 Δu/h times the area of the ellipse."""
    for name in ("physical", "newtonian", "barus"):
        law = contact(CHOICES[name]).traction
        for load in (1e-9, 1e-6):
            area = math.pi * law.semi_axis_across * law.semi_axis_along * load ** (2 / 3)
            assert uniform_traction(law, load, 1e-4, 1e-3)[0] == pytest.approx(0.54 * area * 1e-3 / 1e-4, rel=0.02)


def test_contact_is_cut_off_at_the_ends_of_the_roller():
    """Coulomb-like stress γ p: what Hertz pressure carries beyond ±l/2 is left out, a known part of the load."""
    here = contact(CHOICES["cool"])
    law = here.traction
    load = 4e5
    across = law.semi_axis_across * load ** (1 / 3)
    x = here.shape.half_length / across
    assert x < 1.0
    kept = 0.5 * (3.0 * x - x**3)
    field = SlipField(0.3, 0.0, 0.0, 0.0)
    found = microslip_traction(law, load, 2e-8, field, here.shape, False)
    assert found.force == pytest.approx(GAMMA * load * kept, rel=2e-3)
    assert found.force < GAMMA * load * (1 - 0.5 * (1 - kept))
    # ∫ p ζ² dA/Q = a² (x³/4·... ) by hand: 3/(4) ∫ (1 − t²) t² dt from −x to x.
    second = 1.5 * (x**3 / 3 - x**5 / 5) * across**2
    assert found.lag == pytest.approx(GAMMA * load * second / (2 * here.shape.contour_radius * RADIUS), rel=2e-3)
    longer = here.shape._replace(half_length=1.0)
    assert microslip_traction(law, load, 2e-8, field, longer, False).force == pytest.approx(GAMMA * load, rel=2e-3)


@choices
@pytest.mark.parametrize("load", [10.0, 1e3, 2e4, 1e5])
def test_stress_rises_up_to_rising_slip(name, load):
    law = contact(CHOICES[name]).traction
    for film in (2e-7, 1e-6, 1e-5):
        top = rising_slip(law, load, film)
        assert math.isfinite(top) or not CHOICES[name].heating
        # At every point of the contact, hence for every slip field below it.
        pressure = law.pressure * load ** (1 / 3) * np.array([0.05, 0.3, 0.7, 0.95, 1.0])
        slips = np.linspace(0.02, 1.0, 60) * min(top, 10.0)
        stress = local_stress(CHOICES[name], pressure[:, None] + 0 * slips, film, slips + 0 * pressure[:, None])
        assert np.all(np.diff(stress, axis=1) >= -1e-12 * stress[:, 1:])


def test_chord_traction_adds_up_to_the_contact():
    here = contact(FULL)
    law = here.traction
    for load, slip in ((5e3, 1e-3), (5e4, 0.02)):
        across = law.semi_axis_across * load ** (1 / 3)
        t, w = np.polynomial.legendre.leggauss(60)
        chords = [chord_traction(law, load, 6e-7, math.sqrt(1 - x * x), slip) for x in t]
        assert across * (w @ chords) == pytest.approx(uniform_traction(law, load, 6e-7, slip)[0], rel=1e-3)


@choices
def test_without_slip_there_is_no_traction(name):
    """Not even the least: a floor of slip would push a roller at rest to and fro."""
    law = contact(CHOICES[name]).traction
    for slip in (0.0, -0.0):
        assert uniform_traction(law, 40.0, 1e-7, slip)[0] == 0.0
    for slip in (1e-32, -1e-60):
        force, slope, _, _ = uniform_traction(law, 40.0, 1e-7, slip)
        assert force == pytest.approx(slope * slip, rel=1e-9, abs=0.0) and slope > 0.0
