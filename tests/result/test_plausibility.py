"""Loads and results that cannot be meant so are told in words, and loads as they should be are not."""

import json
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from macroslip import (
    Bearing,
    BearingLoads,
    Case,
    HubLoads,
    Laws,
    Traces,
    Window,
    bundled_cases,
    simulate,
)
from macroslip.result.plausibility import doubtful_loads, doubtful_result
from macroslip.result.rating import with_rating
from tests.quick import COARSE

BEARING = Bearing.read("skf-240-600-bc")
FORCE, MOMENT = (164e3, -2e3, -263e3), (726e3, 154e3, 37e3)


def test_bundled_loads_are_plausible():
    assert all(
        doubtful_loads(HubLoads.bundled(name), BEARING) == [] for name in bundled_cases("year")
    )


@pytest.mark.parametrize(
    ("force", "speed", "words"),
    [
        (
            (164.0, -2.0, -263.0),
            2.14,
            "the rotor weighs 0.263 kN, which is 1/",
        ),  # kN in a column named N
        (
            (164e3, 0.0, 263e3),
            2.14,
            "the rotor's weight acts upwards: the mean of the vertical force is +263 kN",
        ),
        ((-164e3, 0.0, -263e3), 2.14, "the mean thrust is -164 kN, against the wind"),
        (FORCE, 20.0, "the shaft turns at up to 191 rpm"),
    ],
)
def test_what_cannot_be_meant_so_is_told(force, speed, words):
    (doubt,) = doubtful_loads(HubLoads.constant(force, MOMENT, speed, 1.0), BEARING)
    assert words in doubt


def _turned(angle):
    """A rotor of 263 kN in axes that are turned by an angle [rad] over 40 s."""
    times = np.linspace(0.0, 40.0, 401)
    turn = np.broadcast_to(angle(times), times.shape)
    force = np.stack([np.full(401, 164e3), -263e3 * np.sin(turn), -263e3 * np.cos(turn)], axis=1)
    return HubLoads(times, np.full(401, 2.1), force, np.tile(MOMENT, (401, 1)), "turned")


@pytest.mark.parametrize("bearing", [None, BEARING])
def test_axes_that_turn_with_the_rotor_are_told(bearing):
    (doubt,) = doubtful_loads(_turned(lambda time: 2.1 * time), bearing)
    # The weight goes round: its standard deviation is 263 kN / sqrt 2.
    assert "goes up and down by 186 kN" in doubt and "turn with the rotor" in doubt


@pytest.mark.parametrize("degrees", [-30.0, 30.0, 90.0])
def test_a_weight_that_acts_sideways_is_told(degrees):
    (doubt,) = doubtful_loads(_turned(lambda time: np.radians(degrees)), BEARING)
    assert f"by {-degrees:.0f} degrees" in doubt and "AzimB1Up" in doubt


def test_a_lateral_mean_of_a_fifth_of_the_weight_is_none():
    """Simulations have up to a tenth."""
    assert doubtful_loads(HubLoads.constant((164e3, 52e3, -263e3), MOMENT, 2.1, 1.0)) == []
    assert len(doubtful_loads(HubLoads.constant((164e3, 53e3, -263e3), MOMENT, 2.1, 1.0))) == 1


def test_a_rotor_downwind_of_the_tower_is_asked_for():
    """Its x axis, from hub to gearbox, points against the wind."""
    (doubt,) = doubtful_loads(HubLoads.constant((-164e3, 0.0, -263e3), MOMENT, 2.1, 1.0))
    assert "downwind of the tower" in doubt


def test_without_a_bearing_a_rotor_is_neither_a_hundredweight_nor_a_ship():
    (doubt,) = doubtful_loads(HubLoads.constant((164.0, -2.0, -263.0), MOMENT, 2.14, 1.0))
    assert doubt.startswith("the rotor weighs 0.263 kN, and rotors weigh 5 to 10,000 kN")


def test_a_rating_by_an_estimated_c_is_told():
    case = Case(
        loads=BearingLoads.constant([0.0, -300e3, 60e3], 2.1, 0.5), laws=Laws.paper(), rollers=[0]
    )
    result = with_rating(simulate(case), case)
    assert not any("lives are 0.5 to 0.9" in line for line in doubtful_result(result))
    given = json.loads(result.attrs["input"])
    given["bearing"]["dynamic_load_rating"]["tag"] = "D"
    result.attrs["input"] = json.dumps(given)
    assert any("lives are 0.5 to 0.9" in line for line in doubtful_result(result))


def test_means_count_and_not_samples():
    """A gust may push a rotor against the wind, or lift it, for a while."""
    times = np.linspace(0.0, 10.0, 101)
    force = np.tile(FORCE, (times.size, 1))
    force[:10] *= -1.0
    assert (
        doubtful_loads(
            HubLoads(times, np.full_like(times, 2.1), force, np.tile(MOMENT, (101, 1)), "gust"),
            BEARING,
        )
        == []
    )


def test_loads_in_another_unit_show_in_the_result():
    case = Case(
        loads=BearingLoads.constant([0.0, -300.0, 60.0], 2.1, 0.5), laws=Laws.paper(), rollers=[0]
    )
    doubts = " ".join(doubtful_result(with_rating(simulate(case), case)))
    assert (
        "the static safety is" in doubts
        and "below the minimum that the maker requires for 100 % of the time" in doubts
    )
    pressed = with_rating(simulate(case), case)
    pressed["largest_pressure"] = pressed.largest_pressure + 5e9
    assert "beyond the 4 GPa" in " ".join(doubtful_result(pressed))


@pytest.mark.parametrize(("load", "doubted"), [(3e3, True), (300e3, False)])
def test_films_that_carry_what_the_rings_do_not_know_are_told(load, doubted):
    """Cold oil under a load of a hundredth of the usual; with all rollers the rings' load balances what is applied."""
    turning = BearingLoads.constant([0.0, -load, 0.2 * load], 2.1, 2.0)
    case = Case(
        loads=turning,
        temperature=273.15,
        rollers=[0, 9],
        window=Window(start=0.0),
        traces=Traces(step=1e-3),
        contact_details=False,
        integrator=COARSE,
    )
    result = simulate(case)
    assert any("films of oil carry" in sentence for sentence in doubtful_result(result)) == doubted
    assert (result.mean_film_load.values > 0.0).all()
    everything = simulate(replace(case, rollers="all", laws=Laws.paper(), traces=Traces(step=0.02)))
    assert everything.attrs["mean_elastic_load"] == pytest.approx(
        float(everything.roller_load.mean()), rel=1e-2
    )


@pytest.mark.parametrize(("share", "told"), [(0.0, False), (0.005, False), (0.09, True)])
def test_contacts_that_are_cut_off_at_the_ends_are_told(share, told):
    doubts = doubtful_result(xr.Dataset(attrs={"truncated_share": share}))
    assert any("is cut off there, with 9 % of its load" in doubt for doubt in doubts) == told
