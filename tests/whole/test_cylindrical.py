"""A single-row cylindrical roller bearing, its loads, and a cage that a ring guides."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy.optimize import brentq

from macroslip import (
    Bearing,
    BearingLoads,
    Cage,
    Case,
    HubLoads,
    InputError,
    Laws,
    Lubricant,
    Radau,
    Window,
    read_study,
    simulate,
)
from macroslip.bearing import geometry
from macroslip.bearing.geometry import row_names
from macroslip.case.parts import Traces
from macroslip.contact.interface import contact_shape, interfaces
from macroslip.rating.kinds import ratings_of
from macroslip.rating.rate import rate, roller_load_history
from macroslip.ring.balance import balance, roller_loads
from macroslip.roller.model import ring_geometry, roller_model
from macroslip.study.reader import open_study
from macroslip.study.run import run_study
from tests.quick import COARSE

FILE = Path(__file__).parents[2] / "validation" / "data" / "cylindrical-160.yaml"
BEARING, OIL = Bearing.read(FILE), Lubricant.read("vg320-mineral").at(333.15)
SPEED = 1500.0 * math.pi / 30.0
LED = Cage(
    gap=3e-4,
    mass=4.0,
    guided_by="outer-ring",
    land_diameter=0.244,
    land_width=0.016,
    land_clearance=6e-4,
)


def case(force=(0.0, -8e3, 0.0), span=0.6, speed=SPEED, **choices):
    given = {
        "bearing": BEARING, "lubricant": OIL, "oil_supply": "flooded", "dynamics": "whole-bearing", "cage": LED, "rating": False,
        "loads": BearingLoads.constant(force, speed, span), "traces": Traces(step=5e-3), "integrator": COARSE,
    }  # fmt: skip
    return Case(**given | choices)


@pytest.fixture(scope="module")
def light():
    return simulate(case(window=Window(start=0.3)))


def test_its_file_is_read_as_one_row_of_crowned_rollers_on_straight_raceways():
    assert BEARING.rows == 1 and row_names(BEARING) == ("single",)
    assert Bearing.from_dict(BEARING.as_dict()) == BEARING
    for curvatures, sign in (
        (geometry.inner_curvatures(BEARING), 1.0),
        (geometry.outer_curvatures(BEARING), -1.0),
    ):
        assert curvatures.lateral == pytest.approx(1.0 / 20.0)
        assert curvatures.rolling == pytest.approx(1.0 / 16e-3 + sign / (112.5e-3 - sign * 16e-3))
    shape = contact_shape(BEARING, interfaces(BEARING, OIL)[0], 1, microslip=True)
    # A pressed contact bends half as much as the crown, and without contact angle nothing spins.
    assert shape.contour_radius == pytest.approx(40.0) and shape.spin_ratio == 0.0


def test_its_load_zone_carries_the_load_as_a_search_for_the_displacement_finds():
    model = roller_model(BEARING, OIL, 1, tilt=0.0)
    ring, angle = ring_geometry(BEARING, model), np.zeros(1)
    displacement, _ = balance(ring, angle, np.array([[0.0, -50e3, 0.0]]), np.zeros((1, 3)))
    loads = roller_loads(ring, angle, displacement)[0]
    below = -np.sin(-0.5 * np.pi + 2.0 * np.pi * np.arange(18) / 18)

    def load(drop):
        return model.stiffness * np.maximum(drop * below - 5e-5, 0.0) ** 1.5

    drop = brentq(lambda drop: load(drop) @ below - 50e3, 5e-5, 1e-3, xtol=1e-16)
    assert loads == pytest.approx(load(drop), rel=1e-8, abs=1e-3)


@pytest.mark.slow
def test_books_close_and_a_light_load_lets_the_cage_slip(light):
    assert light.sizes["row"] == 1 and light.row.item() == "single"
    assert light.status.max() == 0 and "books_warning" not in light.attrs
    assert -0.75 < light.cage_slip.item() < -0.5
    heavy = simulate(case((0.0, -50e3, 0.0), window=Window(start=0.3)))
    assert -0.02 < heavy.cage_slip.item() < 0.0


@pytest.mark.slow
def test_turned_loads_give_the_same_slip_without_weight(light):
    def slip(force):
        free = simulate(case(force, gravity=False, window=Window(start=0.3)))
        return free.cage_slip.item()

    assert slip((8e3, 0.0, 0.0)) == pytest.approx(slip((0.0, -8e3, 0.0)), rel=2e-3)


@pytest.mark.slow
@pytest.mark.parametrize(("ring", "turns"), [("outer-ring", 0.0), ("inner-ring", 1.0)])
def test_a_land_alone_brings_the_cage_to_its_ring_as_petroff_says(ring, turns):
    """Pockets so wide that no roller meets the cage: dw/dt = k/m (Ω_ring r~ − w), and its loss is what is booked."""
    loose = replace(LED, guided_by=ring, gap=6e-3, impact="dry", weight=False, mass=40.0)
    slow, span = 0.2, 0.2
    result = simulate(
        case(
            span=span,
            speed=slow,
            cage=loose,
            laws=Laws.paper(),
            integrator=Radau(),
            oil_supply=None,
            drag=False,
            gravity=False,
        )
    )
    drag, pitch = LED.land_drag(0.1125, OIL.viscosity), 0.1125
    radius = 0.122
    assert drag == pytest.approx(
        2 * math.pi * radius**2 * 0.016 * OIL.viscosity * radius / 3e-4 / pitch**2
    )
    ratio = geometry.orbit_ratio(BEARING)
    rate = drag / 40.0
    assert result.pocket_contact_time.sum() == 0.0
    expected = slow * (turns + (ratio - turns) * np.exp(-rate * result.time))
    assert result.cage_speed.values[0] == pytest.approx(expected.values, rel=1e-4)
    lost = (
        drag
        * (pitch * slow * (ratio - turns)) ** 2
        * (1.0 - np.exp(-2.0 * rate * span))
        / (2.0 * rate)
    )
    assert float(result.book_guide_loss[-1]) == pytest.approx(lost, rel=1e-3)
    assert np.abs(result.energy_residual).max() < 1e-2 * lost


@pytest.mark.slow
def test_a_roller_past_the_peak_of_traction_does_not_run_away():
    """Beyond the peak of the paper's law friction falls with slip; slopes that serve too long would turn its sign."""
    time = np.linspace(0.0, 1.6, 81)
    force = np.column_stack([0.0 * time, -30e3 * np.exp(-0.34 * time), 0.0 * time])
    loads = BearingLoads(time, np.full(time.size, SPEED), force, "a load that falls")
    result = simulate(case(loads=loads, laws=Laws.paper(), oil_supply=None))
    assert result.status.max() == 0
    ring = SPEED * geometry.inner_contact_radius(BEARING)
    assert np.abs(result.raceway_slip).max() < ring


@pytest.mark.parametrize(
    ("choices", "said"),
    [
        ({"force": (0.0, -8e3, 1.0)}, "axial part of up to 1 N"),
        (
            {"loads": HubLoads.constant((0.0, 0.0, -1e3), (0.0, 0.0, 0.0), 2.0, 1.0)},
            "loads are given at the hub",
        ),
        ({"laws": Laws.physical().but(skew="quasi-static")}, "held by flanges"),
        ({"cage": replace(LED, arrangement="per-row")}, "in a bearing of one row"),
        ({"bearing": Bearing.read("skf-240-600-bc")}, "beyond any rotor"),
    ],
)
def test_what_it_cannot_carry_is_refused(choices, said):
    with pytest.raises(InputError, match=said):
        case(**choices)


@pytest.mark.parametrize(
    ("entries", "said"),
    [
        ({"contact_angle": 0.1}, "contact_angle is 0.1"),
        ({"row_offset": 0.1}, "row_offset is 0.1"),
        ({"osculation_outer": 0.98}, "osculation_outer is 0.98, and roller_crown_radius tells"),
        ({"roller_crown_radius": None}, "osculation_inner and osculation_outer are missing"),
    ],
)
def test_a_bearing_is_spherical_or_cylindrical(entries, said):
    with pytest.raises(InputError, match=said):
        BEARING.replace(**entries)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"land_width": 0.01}, "land_width describes a ring's land, and rollers guide the cage"),
        (
            {"guided_by": "inner-ring", "land_width": 0.01},
            "land_diameter and land_clearance are not given",
        ),
    ],
)
def test_a_land_is_described_in_full_or_not_at_all(given, said):
    with pytest.raises(InputError, match=said):
        Cage(**given)


def test_its_ratings_are_those_of_a_line_contact_by_hand():
    """C by Lundberg and Palmgren's theory, whose values ISO 281 tabulates to 0.05 of about 86."""
    gamma = 32.0 / 225.0
    inner_over_outer = 1.04 * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)
    shape = 172.56 * gamma ** (2.0 / 9.0) * (1.0 - gamma) ** (29.0 / 27.0) / (1.0 + gamma) ** 0.25
    factor = shape * (1.0 + inner_over_outer**4.5) ** (-2.0 / 9.0)
    dynamic = 1.1 * factor * 50.0 ** (7.0 / 9.0) * 18.0**0.75 * 32.0 ** (29.0 / 27.0)
    static = 44.0 * (1.0 - gamma) * 18.0 * 50.0 * 32.0
    ratings = ratings_of(BEARING)
    assert ratings.dynamic == pytest.approx(dynamic, rel=1e-3)
    assert ratings.static == pytest.approx(static, rel=1e-12)
    assert ratings.fatigue_limit == pytest.approx(static / 8.2 * (100.0 / 225.0) ** 0.3, rel=1e-12)
    assert ratings.minimum == pytest.approx(0.02 * dynamic, rel=1e-3)
    given = BEARING.replace(dynamic_load_rating=600e3, static_load_rating=900e3)
    assert ratings_of(given)[:2] == (600e3, 900e3)


def test_its_lives_follow_from_the_loads_of_its_rollers():
    """ISO 281 with P = F_r; ISO/TS 16281 from loads by a search, laminae of Hertz' ellipse by quadrature."""
    force = 40e3
    loads = BearingLoads.constant([0.0, -force, 0.0], SPEED, 0.2)
    rating = rate(BEARING, OIL, *roller_load_history(BEARING, OIL, loads))
    ratings = ratings_of(BEARING)
    turns_an_hour = SPEED / (2.0 * np.pi) * 3600.0
    assert rating.row.values.tolist() == ["single"]
    assert float(rating.equivalent_load) == pytest.approx(force, rel=1e-12)
    assert float(rating.static_safety) == pytest.approx(ratings.static / force, rel=1e-12)
    basic = 1e6 * (ratings.dynamic / force) ** (10.0 / 3.0) / turns_an_hour
    assert float(rating.basic_life) == pytest.approx(basic, rel=1e-9)

    stiffness = sum(
        interface.hertz.stiffness ** (-2.0 / 3.0) for interface in interfaces(BEARING, OIL)[:2]
    )
    stiffness **= -1.5
    semi_axes = [interface.hertz.semi_axis_across for interface in interfaces(BEARING, OIL)[:2]]
    gamma = 32.0 / 225.0
    ratio = 1.038 * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)
    share = ratings.dynamic / 18.0
    # Load on a lamina that spread over the whole roller would give what the lamina bears, over 30 laminae.
    edges = np.linspace(-25e-3, 25e-3, 31)
    lives = {"hertz": [], "uniform": []}
    for turn in np.arange(20) / 20.0:
        angles = 2.0 * np.pi * (np.arange(18) + turn) / 18.0

        def roller_loads_at(depth, angles=angles):
            return stiffness * np.maximum(depth * np.cos(angles) - 5e-5, 0.0) ** 1.5

        def unbalanced(depth, angles=angles):
            return roller_loads_at(depth) @ np.cos(angles) - force

        # Off the middle of a symmetric place the ring yields sideways a little; its part is below 1e-4.
        carried = roller_loads_at(brentq(unbalanced, 5e-5, 1e-3))
        for name, factors in lives.items():
            damage = 0.0
            for axis, scale, power, exponent in (
                (semi_axes[0], share / 0.378 * (1.0 + ratio**4.5) ** (2.0 / 9.0), 4.0, 9.0 / 8.0),
                (semi_axes[1], share / 0.364 * (1.0 + ratio**-4.5) ** (2.0 / 9.0), 4.5, 1.0),
            ):
                if name == "uniform":
                    damage += np.mean((carried / scale) ** power) ** exponent
                    continue
                lamina = np.zeros((18, 30))
                for roller, load in enumerate(carried):
                    if load <= 0.0:
                        continue
                    half = axis * load ** (1.0 / 3.0)
                    places = np.clip(edges / half, -1.0, 1.0)
                    reached = 0.75 * places - 0.25 * places**3
                    inside = reached[-1] - reached[0]
                    lamina[roller] = 30.0 * load * np.diff(reached) / inside
                damage += np.mean(np.mean((0.83 * lamina / scale) ** power, axis=0) ** exponent)
            factors.append(damage ** (-8.0 / 9.0))
    for name, factors in lives.items():
        life = 1e6 / np.mean(1.0 / np.array(factors)) / turns_an_hour
        assert float(rating.reference_life.sel(load_along_roller=name)) == pytest.approx(
            life, rel=2e-3
        )


def test_it_is_studied_and_not_beside_bearings_of_another_kind(tmp_path):
    for name, force in (("s5", -50e3), ("s7", -60e3)):
        rows = "".join(f"{0.02 * k:.2f},1500,0,{force},0\n" for k in range(21))
        (tmp_path / f"{name}.csv").write_text(
            f"time_s,rotor_speed_rpm,F_X0_N,F_Y0_N,F_Z0_N\n{rows}", encoding="utf-8"
        )
    text = (
        "case: {lubricant: vg320-mineral, temperature: 60 degC, rollers: [0]}\n"
        f"loads: {{files: 's{{wind_speed:g}}.csv', kind: main-bearing}}\nbearings: [{FILE}MORE]\n"
    )
    (tmp_path / "study.yaml").write_text(text.replace("MORE", ""), encoding="utf-8")
    ended = run_study(read_study(tmp_path / "study.yaml"), tmp_path / "out", threads=1)
    assert not ended.failures
    study = open_study(tmp_path / "out")
    assert study.row.values.tolist() == ["single"]
    assert (study.energy_mean > 0.0).all()
    assert study.basic_life[0] / study.basic_life[1] == pytest.approx((60 / 50) ** (10 / 3))
    assert "energy_mean_upwind" not in pd.read_parquet(tmp_path / "out" / "summary.parquet")
    (tmp_path / "both.yaml").write_text(text.replace("MORE", ", skf-240-600-bc"), encoding="utf-8")
    with pytest.raises(InputError, match="there are cylindrical and spherical roller bearings"):
        read_study(tmp_path / "both.yaml")


def _profiled(profile):
    return BEARING.replace(roller_crown_radius=None, roller_profile=profile)


@pytest.mark.slow
@pytest.mark.parametrize("profile", ["straight", "logarithmic"])
@pytest.mark.parametrize("laws", [Laws.paper(), Laws.physical()], ids=["paper", "physical"])
def test_line_contacts_run_in_both_dynamics_and_agree_where_rollers_are_gripped(profile, laws):
    """Under 50 kN rollers are held: films drive the same energy on imposed orbits and on free ones."""
    given = {
        "bearing": _profiled(profile),
        "laws": laws,
        "oil_supply": "flooded" if laws.asks_for_oil else None,
        "window": Window(start=0.2),
        "integrator": COARSE if laws.asks_for_oil else Radau(),
    }
    free = simulate(case((0.0, -50e3, 0.0), 0.4, **given))
    assert free.status.max() == 0 and "books_warning" not in free.attrs
    assert -0.02 < free.cage_slip.item() < 0.0
    held = simulate(case((0.0, -50e3, 0.0), 0.4, dynamics="imposed-orbit", cage=Cage(), **given))
    assert held.status.max() == 0 and held.table_error_typical < 1e-4
    assert float(held.energy.sum()) > 0.0
    if laws.asks_for_oil:
        ratio = float(free.energy.sum("roller").sum() / held.energy.sum("roller").sum())
        assert 0.8 < ratio < 1.3


@pytest.mark.slow
@pytest.mark.parametrize("profile", ["straight", "logarithmic"])
def test_maps_of_line_contacts_hold_the_energy_of_raceways(profile):
    """Energy over stations is that of the raceways, and a straight roller's lies evenly."""
    result = simulate(
        case(
            (0.0, -50e3, 0.0),
            0.3,
            bearing=_profiled(profile),
            dynamics="imposed-orbit",
            cage=Cage(),
        )
    )
    along = result.station_energy.sum("roller").isel(row=0)
    raceways = result.energy.sum("roller").isel(row=0)
    for raceway in ("inner", "outer"):
        total = float(along.sel(raceway=raceway).sum("station"))
        assert total > 0.0
        assert total == pytest.approx(float(raceways.sel(interface=raceway)), rel=1e-6)
    outer = along.sel(raceway="outer").values
    assert outer == pytest.approx(outer[::-1], rel=1e-9)
    if profile == "straight":
        assert outer == pytest.approx(outer.mean(), rel=1e-9)
    else:
        assert outer[0] < 0.5 * outer.max()
