"""Named turbines: parts that exist and belong together, a case of each, and what is assumed of it."""

import pytest

from macroslip import (
    Bearing,
    Drivetrain,
    HubLoads,
    Laws,
    Lubricant,
    Turbine,
    bundled_cases,
    main_bearing_load,
)
from macroslip.case.case_file import read_case
from macroslip.contact.interface import highest_load, truncated_share, truncation_load
from macroslip.errors import InputError
from macroslip.loads.bundled import bundled_case
from macroslip.ring.motion import ring_motion
from macroslip.roller.model import ring_geometry, roller_model

NAMES = Turbine.catalogue()


def test_the_catalogue():
    assert NAMES == ["nrel5", "nrel5-rear", "windpact1.5"]


@pytest.mark.parametrize("name", NAMES)
def test_parts_of_a_turbine_exist_and_are_its_own(name):
    turbine = Turbine.read(name)
    assert turbine.bearing in Bearing.catalogue() and turbine.lubricant in Lubricant.catalogue()
    assert turbine.loads in bundled_cases(turbine.load_set)
    assert name.startswith(bundled_case(turbine.loads).turbine)
    assert turbine.bearing_choice and turbine.lubricant_choice and turbine.not_known


@pytest.mark.parametrize("name", NAMES)
def test_every_value_says_where_it_comes_from(name):
    for key, origin in Turbine.read(name).provenance.items():
        assert origin.tag in ("V", "E") and origin.note, key


@pytest.mark.parametrize("name", NAMES)
def test_a_case_of_a_turbine_is_the_turbine(name, tmp_path):
    turbine = Turbine.read(name)
    (tmp_path / "case.yaml").write_text(turbine.case_text(), encoding="utf-8")
    case = read_case(tmp_path / "case.yaml")
    assert case.drivetrain == turbine.drivetrain
    assert (case.bearing.name, case.lubricant.name) == (turbine.bearing, turbine.lubricant)
    assert f"bundled case {turbine.loads}" in case.loads.source
    assert case.loads.time[[0, -1]].tolist() == [0.0, 60.0]


@pytest.mark.parametrize("name", NAMES)
def test_a_case_of_a_turbine_says_what_is_assumed(name):
    turbine = Turbine.read(name)
    text = turbine.case_text()
    comments = " ".join(line.lstrip(" #") for line in text.splitlines() if "#" in line)
    for sentence in (turbine.bearing_choice, turbine.lubricant_choice, turbine.not_known):
        assert sentence in comments
    for origin in turbine.provenance.values():
        if origin.tag == "E":
            assert f"engineering estimate; {origin.note}" in comments
    assert max(map(len, text.splitlines())) <= 120


def test_seats_are_those_of_the_published_turbine():
    front, rear = Turbine.read("nrel5").drivetrain, Turbine.read("nrel5-rear").drivetrain
    assert front == Drivetrain(
        hub_to_bearing=1.912,
        bearing_to_gearbox=3.107,
        shaft_mass=16.5e3,
        shaft_mass_station=2.0,
    )
    assert (rear.front, rear.bearing, rear.locating) == ("moment-carrying", "rear", "front")
    # 0.0142 kg (D/1 m)^2.888 for the shaft.
    for name in ("nrel5", "windpact1.5"):
        turbine = Turbine.read(name)
        assert turbine.shaft_mass == pytest.approx(0.0142 * turbine.rotor_diameter**2.888, rel=6e-3)


def test_a_turbine_of_ones_own(tmp_path):
    entries = Turbine.read("nrel5").as_dict() | {"name": "mine", "hub_to_bearing": "1.8 m"}
    assert Turbine.from_dict(entries).drivetrain.hub_to_bearing == 1.8
    (tmp_path / "mine.yaml").write_text(Turbine.from_dict(entries).as_yaml(), encoding="utf-8")
    assert "  hub_to_bearing: 1.8 m" in Turbine.read(tmp_path / "mine.yaml").case_text()


def test_a_turbine_whose_mount_is_none():
    entries = Turbine.read("nrel5").as_dict() | {"mount": "four-point"}
    with pytest.raises(InputError, match="front_to_rear and locating and bearing are missing"):
        Turbine.from_dict(entries)


@pytest.mark.slow
@pytest.mark.parametrize("loads", ["nrel5-24B", "nrel5-18A"])
def test_the_rear_seat_carries_ten_minutes_of_its_hardest_loads(loads):
    """What the contacts cut off at the rollers' ends stays below a tenth of the largest roller load."""
    turbine = Turbine.read("nrel5-rear")
    bearing = Bearing.read(turbine.bearing)
    oil = Lubricant.read(turbine.lubricant)
    laws = Laws.physical()
    ring = ring_geometry(bearing, roller_model(bearing, oil, 1, tilt=turbine.drivetrain.tilt))
    history = main_bearing_load(HubLoads.bundled(loads), turbine.drivetrain)
    assert history.time[-1] - history.time[0] > 599.0
    _, largest = ring_motion(history, bearing, ring, highest_load(bearing, oil, laws))
    share = truncated_share(largest, truncation_load(bearing, oil))
    assert 0.05 < share < 0.1
