"""A single-row cylindrical roller bearing, its loads, and a cage that a ring guides."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
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
    Window,
    read_study,
    simulate,
)
from macroslip.bearing import geometry
from macroslip.bearing.geometry import row_names
from macroslip.case.parts import Traces
from macroslip.contact.interface import contact_shape, interfaces
from macroslip.ring.balance import balance, roller_loads
from macroslip.roller.model import ring_geometry, roller_model

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
        "loads": BearingLoads.constant(force, speed, span), "traces": Traces(step=5e-3),
    }  # fmt: skip
    return Case(**given | choices)


@pytest.fixture(scope="module")
def light():
    return simulate(case(window=Window(start=0.3)))


def test_its_file_is_read_as_one_row_of_crowned_rollers_on_straight_raceways():
    assert BEARING.rows == 1 and row_names(BEARING) == ("single",)
    assert Bearing.from_dict(BEARING.as_dict()) == BEARING
    for one, sign in (
        (geometry.inner_curvatures(BEARING), 1.0),
        (geometry.outer_curvatures(BEARING), -1.0),
    ):
        assert one.lateral == pytest.approx(1.0 / 20.0)
        assert one.rolling == pytest.approx(1.0 / 16e-3 + sign / (112.5e-3 - sign * 16e-3))
    shape = contact_shape(BEARING, interfaces(BEARING, OIL)[0], 1, microslip=True)
    # A pressed contact bends half as much as the crown, and without contact angle nothing spins.
    assert shape.contour_radius == pytest.approx(40.0) and shape.spin_ratio == 0.0


def test_its_load_zone_carries_the_load_as_a_search_for_the_displacement_finds():
    model = roller_model(BEARING, OIL, 1, tilt=0.0)
    ring, place = ring_geometry(BEARING, model), np.zeros(3)
    balance(ring, 0.0, np.array([0.0, -50e3, 0.0]), place)
    found = np.empty(18)
    roller_loads(ring, 0.0, place, found)
    below = -np.sin(-0.5 * np.pi + 2.0 * np.pi * np.arange(18) / 18)

    def load(drop):
        return model.stiffness * np.maximum(drop * below - 5e-5, 0.0) ** 1.5

    drop = brentq(lambda drop: load(drop) @ below - 50e3, 5e-5, 1e-3, xtol=1e-16)
    assert found == pytest.approx(load(drop), rel=1e-8, abs=1e-3)


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
    found = simulate(
        case(
            span=span,
            speed=slow,
            cage=loose,
            laws=Laws.paper(),
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
    assert found.pocket_contact_time.sum() == 0.0
    expected = slow * (turns + (ratio - turns) * np.exp(-rate * found.time))
    assert found.cage_speed.values[0] == pytest.approx(expected.values, rel=1e-4)
    lost = (
        drag
        * (pitch * slow * (ratio - turns)) ** 2
        * (1.0 - np.exp(-2.0 * rate * span))
        / (2.0 * rate)
    )
    assert float(found.book_guide_loss[-1]) == pytest.approx(lost, rel=1e-3)
    assert np.abs(found.energy_residual).max() < 1e-2 * lost


@pytest.mark.slow
def test_a_roller_past_the_peak_of_traction_does_not_run_away():
    """Beyond the peak of the paper's law friction falls with slip; slopes that serve too long would turn its sign."""
    time = np.linspace(0.0, 1.6, 81)
    force = np.column_stack([0.0 * time, -30e3 * np.exp(-0.34 * time), 0.0 * time])
    loads = BearingLoads(time, np.full(time.size, SPEED), force, "a load that falls")
    found = simulate(case(loads=loads, laws=Laws.paper(), oil_supply=None))
    assert found.status.max() == 0
    ring = SPEED * geometry.inner_contact_radius(BEARING)
    assert np.abs(found.raceway_slip).max() < ring


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


def test_it_is_neither_rated_nor_studied(tmp_path):
    from macroslip.rating.rate import roller_load_history

    with pytest.raises(InputError, match="cylindrical roller bearing"):
        roller_load_history(BEARING, OIL, BearingLoads.constant([0.0, -8e3, 0.0], 2.0, 1.0))
    (tmp_path / "study.yaml").write_text(
        f"loads: {{bundled: [12B]}}\nbearings: [{FILE}]\n", encoding="utf-8"
    )
    with pytest.raises(InputError, match="compare rows of spherical ones"):
        read_study(tmp_path / "study.yaml")
