"""A turbine file of windIO gives a shaft its tilt and distances; what it lacks is asked for by name."""

import math
import re

import pytest

from macroslip.case.case_file import files_named_in, read_case
from macroslip.errors import InputError
from macroslip.loads import Drivetrain

#: A turbine of our own with the keys of windIO's schema that are read, and some that are not.
TURBINE = """\
windIO_version: '2.0'
name: a turbine for tests
assembly: {drivetrain: direct_drive, rotor_orientation: Upwind}
components:
  hub: {diameter: 5.0, cone_angle: 3.0, cd: 0.5}
  drivetrain:
    outer_shape:
      uptilt: 6.0
      distance_tt_hub: 4.0
      distance_hub_mb: 1.25
      distance_mb_mb: 1.5
      overhang: 9.0
    other_components: {mb1Type: CARB, mb2Type: SRB, uptower: true}
"""


@pytest.fixture
def turbine(tmp_path):
    def write(*changes, name="turbine.yaml"):
        text = TURBINE
        for pattern, replacement in changes:
            text, count = re.subn(pattern, replacement, text)
            assert count == 1
        (tmp_path / name).write_text(text, encoding="utf-8")
        return tmp_path / name

    return write


def test_values_and_their_units(turbine):
    shaft = Drivetrain.from_windio(turbine(), bearing="rear")
    assert shaft == Drivetrain(
        mount="four-point",
        tilt=math.radians(6.0),
        hub_to_bearing=3.75,  # half of the hub, and from its flange
        front_to_rear=1.5,
        locating="rear",  # a toroidal bearing carries no thrust
        bearing="rear",
        windio="turbine.yaml: front bearing CARB, rear SRB",
    )


def test_own_values_come_first(turbine):
    shaft = Drivetrain.from_windio(
        turbine(), bearing="front", locating="front", hub_to_bearing=2.0, tilt=0.1
    )
    assert (shaft.hub_to_bearing, shaft.tilt, shaft.locating) == (2.0, 0.1, "front")
    drivetrain = Drivetrain.from_windio(turbine(), mount="three-point", bearing_to_gearbox=1.9)
    assert (drivetrain.mount, drivetrain.front_to_rear, drivetrain.bearing_to_gearbox) == (
        "three-point",
        None,
        1.9,
    )


@pytest.mark.parametrize(
    ("changes", "own", "asked"),
    [
        ([(r"\n +distance_hub_mb.*", "")], {"bearing": "rear"}, ["hub_to_bearing"]),
        ([(r"diameter: 5.0, ", "")], {"bearing": "rear"}, ["hub_to_bearing"]),
        ([(r"\n +distance_mb_mb.*", ""), (r"\n +uptilt.*", "")], {}, ["tilt", "front_to_rear", "bearing"]),
        ([("CARB", "TRB")], {"bearing": "rear"}, ["locating"]),
        ([("mb1Type: CARB, ", "")], {"bearing": "rear"}, ["locating"]),
        ([], {"mount": "three-point"}, ["bearing_to_gearbox"]),
    ],
)  # fmt: skip
def test_what_is_missing_is_asked_for(turbine, changes, own, asked):
    with pytest.raises(InputError) as caught:
        Drivetrain.from_windio(turbine(*changes), **own)
    for key in ("tilt", "hub_to_bearing", "front_to_rear", "locating", "bearing_to_gearbox"):
        assert (f"{key}: " in caught.value.remedy) == (key in asked), key
    assert "such as" in caught.value.remedy and "turbine.yaml" in caught.value.where


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ([("'2.0'", "'1.0'")], "windIO_version is 1.0.*windIO2windIO"),
        ([("windIO_version: '2.0'\n", "")], "no windIO_version"),
        ([("uptilt: 6.0", "uptilt: six")], "uptilt is 'six'"),
        ([("distance_mb_mb: 1.5", "distance_mb_mb: -1")], "distance_mb_mb is -1"),
        ([("hub: {", "hub: {{")], "damaged"),
        ([("uptilt: 6.0", "uptilt: 60")], "tilt"),
    ],
)
def test_what_is_wrong_is_named(turbine, changes, message):
    with pytest.raises(InputError, match=message):
        Drivetrain.from_windio(turbine(*changes), bearing="rear")


def test_nothing_in_the_file_is_executed(turbine, tmp_path):
    """The loader makes numbers, text, lists and mappings; a call of Python in YAML is refused."""
    call = f"!!python/object/apply:os.mkdir ['{tmp_path / 'made'}']"
    with pytest.raises(InputError, match="damaged"):
        Drivetrain.from_windio(turbine(("uptilt: 6.0", f"uptilt: {call}")), bearing="rear")
    assert not (tmp_path / "made").exists()


def test_no_file(tmp_path):
    with pytest.raises(InputError, match="no such turbine file"):
        Drivetrain.from_windio(tmp_path / "none.yaml", bearing="rear")


def case_file(turbine, drivetrain):
    path = turbine().parent / "case.yaml"
    path.write_text(f"loads: {{bundled: 14B}}\ndrivetrain: {drivetrain}\n", encoding="utf-8")
    return path


def test_a_case_file_names_it(turbine):
    path = case_file(turbine, "{windio: turbine.yaml, bearing: rear, shaft_mass: 9 t}")
    case = read_case(path)
    own = {"bearing": "rear", "shaft_mass": 9000.0}
    assert case.drivetrain == Drivetrain.from_windio(path.parent / "turbine.yaml", **own)
    assert case.as_dict()["drivetrain"]["windio"] == "turbine.yaml: front bearing CARB, rear SRB"
    assert path.parent / "turbine.yaml" in files_named_in(path)
    both = case_file(turbine, "{windio: turbine.yaml, bearing: both}")
    assert read_case(both, bearing="front").drivetrain.bearing == "front"


def test_a_case_without_it_is_as_before():
    from macroslip import Case, HubLoads

    given = Case(loads=HubLoads.bundled("14B").window(0.0, 1.0)).as_dict()
    assert "windio" not in given["drivetrain"]


def test_messages_of_a_case_file_name_line_and_key(turbine):
    path = case_file(turbine, "{windio: turbine.yaml}\nrolers: all")
    with pytest.raises(InputError) as caught:
        read_case(path)
    told = str(caught.value)
    assert "line 2, drivetrain.windio" in told and "bearing (windIO does not have it)" in told
    assert "Did you mean 'rollers'" in told


def test_a_file_that_changed_is_read_again(turbine):
    assert Drivetrain.from_windio(turbine(), bearing="rear").front_to_rear == 1.5
    changed = turbine(("distance_mb_mb: 1.5", "distance_mb_mb: 1.75"))
    assert Drivetrain.from_windio(changed, bearing="rear").front_to_rear == 1.75
