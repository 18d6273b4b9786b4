"""Reading bearing files: values, units, provenance, and what a user is shown when a file is wrong."""

import copy
import json
import pickle
from importlib import resources

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from ruamel.yaml import YAML

from macroslip.bearing import Bearing
from macroslip.errors import InputError
from macroslip.input.record import TAGS, Provenance, fields_of
from macroslip.study.settings import Setting, replaced
from tests.records import values_of

NAME = "skf-240-600-bc"
TEXT = (resources.files("macroslip.bearing") / "catalogue" / f"{NAME}.yaml").read_text(
    encoding="utf-8"
)
#: Keys that a ring which is round does without.
WAVES = {key for key in fields_of(Bearing) if key.startswith("out_of_round_")}


@pytest.fixture
def base():
    return Bearing.read(NAME)


@pytest.fixture
def reported(tmp_path, monkeypatch):
    """Change the shipped file and give back what its reader is shown, with the line number of the first change."""

    monkeypatch.chdir(tmp_path)

    def change(*pairs, text=TEXT, end=""):
        line = 0
        for old, new in pairs:
            assert text.count(old) == 1, old
            line = line or text[: text.index(old)].count("\n") + 1
            text = text.replace(old, new)
        (tmp_path / "mine.yaml").write_text(text + end, encoding="utf-8")
        with pytest.raises(InputError) as caught:
            Bearing.read("mine.yaml")
        message = str(caught.value)
        assert "pydantic" not in message and "http" not in message and "\n" not in message
        return message, line

    return change


def test_base_bearing_has_the_specified_values_in_si(base):
    expected = {
        "name": NAME, "bore_diameter": 0.6, "outside_diameter": 0.87, "width": 0.272, "dynamic_load_rating": 8502e3,
        "static_load_rating": 16300e3, "fatigue_load_limit": 1100e3, "axial_factor_e": 0.3, "axial_factor_y1": 2.3, "axial_factor_y2": 3.4,
        "axial_factor_y0": 2.2, "mass": 519.0, "rollers_per_row": 28, "roller_diameter": 0.07, "roller_length": 0.106,
        "contact_angle": pytest.approx(np.radians(11.2), rel=1e-15), "pitch_radius": 0.3727,
        "outer_raceway_radius": 0.4149, "row_offset": 0.074,
        "osculation_inner": 0.98, "osculation_outer": 0.98, "diametral_clearance": 2e-4, "clearance_state": "warm", "youngs_modulus": 210e9,
        "poisson_ratio": 0.3, "density": 7850.0, "cage_youngs_modulus": 210e9, "cage_poisson_ratio": 0.3,
        "composite_roughness": 3e-7, "hardness": 7e9, "thermal_conductivity": 46.0, "specific_heat": 460.0,
        "out_of_round_second": None, "out_of_round_third": None, "out_of_round_angle": None, "roller_crown_radius": None,
        "roller_profile": None,
    }  # fmt: skip
    values = values_of(base)
    del values["title"]
    assert values == expected
    assert isinstance(base.rollers_per_row, int) and isinstance(base.mass, float)


def test_every_quantity_says_where_it_comes_from(base):
    assert set(base.provenance) == set(fields_of(Bearing)) - {
        "name",
        "title",
        "clearance_state",
        *WAVES,
        "roller_crown_radius",
        "roller_profile",
    }
    assert all(
        origin.tag in TAGS and origin.tag != "U" and origin.note
        for origin in base.provenance.values()
    )
    assert base.provenance["roller_diameter"] == Provenance(
        70, "mm", "E", "back-calculated from the load ratings"
    )


def test_every_line_of_the_shipped_file_is_explained():
    lines = TEXT.splitlines()
    keys = [n for n, line in enumerate(lines) if line and line[0].isalpha()]
    assert len(keys) == len(fields_of(Bearing)) - len(WAVES) - 2
    assert all(lines[n - 1].startswith("# ") for n in keys)


def test_catalogue_lists_the_names_that_can_be_read():
    assert NAME in Bearing.catalogue()
    assert [Bearing.read(name).name for name in Bearing.catalogue()] == Bearing.catalogue()


def test_units_are_converted_exactly(base, tmp_path):
    other = TEXT
    for old, new in (
        ("{value: 70, unit: mm", "{value: 7e4, unit: um"),
        ("{value: 106, unit: mm", "{value: 0.106, unit: m"),
        ("{value: 8502, unit: kN", "{value: 8502e3, unit: N"),
        ("hardness: {value: 7.0, unit: GPa", "hardness: {value: 7000, unit: MPa"),
        (
            "contact_angle: {value: 11.2, unit: deg",
            f"contact_angle: {{value: {base.contact_angle!r}, unit: rad",
        ),
    ):
        assert other.count(old) == 1
        other = other.replace(old, new)
    path = tmp_path / "mine.yaml"
    path.write_text(other, encoding="utf-8")
    assert values_of(Bearing.read(path)) == values_of(base)


def test_a_file_may_leave_out_catalogue_data_tags_and_notes(tmp_path):
    entries = Bearing.read(NAME).as_dict()
    needed = {key for key, field in fields_of(Bearing).items() if field.is_required} | {
        "osculation_inner",
        "osculation_outer",
    }
    short = {key: entries[key] for key in needed}
    short["density"] = {"value": 7800, "unit": "kg/m3"}
    with (tmp_path / "mine.yaml").open("w", encoding="utf-8") as file:
        YAML().dump(short, file)
    bearing = Bearing.read(str(tmp_path / "mine.yaml"))
    assert bearing.bore_diameter is None and "bore_diameter" not in bearing.provenance
    assert bearing.provenance["density"] == Provenance(7800, "kg/m3", "U", "")


def test_as_dict_survives_yaml_and_json(base, tmp_path):
    with (tmp_path / "mine.yaml").open("w", encoding="utf-8") as file:
        YAML().dump(base.as_dict(), file)
    assert Bearing.read(tmp_path / "mine.yaml") == base
    assert Bearing.from_dict(json.loads(json.dumps(base.as_dict()))) == base
    assert base.replace(mass=None).as_dict().keys() == base.as_dict().keys() - {"mass"}


def test_a_bearing_can_be_hashed_copied_and_pickled(base):
    for twin in (copy.deepcopy(base), pickle.loads(pickle.dumps(base))):
        assert twin == base and hash(twin) == hash(base) and twin.provenance == base.provenance


def test_provenance_is_part_of_equality(base):
    assert values_of(base.replace(roller_diameter=0.07)) == values_of(base)
    assert base.replace(roller_diameter=0.07) != base


def test_unknown_key_gets_a_suggestion_and_a_line(reported):
    message, line = reported(("roller_diameter: {", "roler_diameter: {"))
    assert (
        message
        == f"mine.yaml, line {line}: the key 'roler_diameter' is unknown. Did you mean 'roller_diameter'?"
    )


def test_unknown_key_without_likeness_gets_the_whole_list(reported):
    message, _ = reported(end="xyz: 1\n")
    line = TEXT.count("\n") + 1
    assert message.startswith(
        f"mine.yaml, line {line}: the key 'xyz' is unknown. Allowed: name, title, bore_diameter,"
    )


def test_unknown_key_inside_an_entry(reported):
    message, line = reported(
        ("pitch_radius: {value: 372.7, unit: mm,", "pitch_radius:\n  {value: 372.7, units: mm,")
    )
    expected = "the key 'units' inside pitch_radius is unknown. Did you mean 'unit'?"
    assert message == f"mine.yaml, line {line + 1}: {expected}"


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("roller_length: {value: 106, unit: mm", "roller_length: {value: 106, unit: inch",
         "roller_length.unit: 'inch' does not exist. Allowed: m, mm, um. Choose one of these."),
        ("poisson_ratio: {value: 0.3, unit: \"1\", tag: E, note: \"bearing steel\"",
         "poisson_ratio: {value: 0.3, unit: 1",
         'poisson_ratio.unit: 1 does not exist. Allowed: "1". Write it with its quotes.'),
        ("roller_length: {value: 106, unit: mm", "roller_length: {value: 106",
         "roller_length: 'unit' is missing (unit of the value). Allowed: m, mm, um. Add it."),
        ("roller_length: {value: 106, unit: mm", "roller_length: {unit: mm", "roller_length: 'value' is missing (number, without its unit). Allowed: a finite number"),
        ("roller_length: {value: 106, unit: mm", "roller_length: {value: 106 mm, unit: mm",
         "roller_length.value: it is '106 mm'. Allowed: a finite number, without its unit."),
        ("roller_length: {value: 106, unit: mm", "roller_length: {value: true, unit: mm",
         "roller_length.value: it is True. Allowed: a finite number"),
        ("roller_length: {value: 106, unit: mm", "roller_length: {value: .nan, unit: mm",
         "roller_length.value: it is nan. Allowed: a finite number"),
        ("mass: {value: 519, unit: kg, tag: V, note: \"catalogue\"}", "mass: 519",
         "mass: it is 519, which does not give its unit. Allowed: mass: 1 kg; or mass: {value: a number, unit: kg or t,"),
        ("mass: {value: 519, unit: kg, tag: V", "mass: {value: 519, unit: kg, tag: Q",
         "mass.tag: 'Q' does not exist. Allowed: P, V, D, R, E, U. Choose one of these. P: paper; V: catalogue or public model;"),
        ("mass: {value: 519, unit: kg, tag: V, note: \"catalogue\"", "mass: {value: 519, unit: kg, note: 3",
         "mass.note: it is 3. Allowed: text."),
        ("name: skf-240-600-bc", "name: 240", "name: it is 240. Allowed: non-empty text."),
        ("contact_angle: {value: 11.2", "contact_angle: {value: 45",
         "contact_angle: it is 45 deg. Allowed: 0 to below 45 deg. It is the angle of the contact"),
        ("rollers_per_row: {value: 28", "rollers_per_row: {value: 28.5",
         "rollers_per_row: it is 28.5. Allowed: a whole number, 3 to 500."),
        ("hardness: {value: 7.0, unit: GPa", "hardness: {value: 7.0, unit: Pa",
         "hardness: it is 7.0 Pa. Allowed: 1e8 to 1e11 Pa."),
    ],
)  # fmt: skip
def test_wrong_entry_is_reported_with_its_line(reported, old, new, expected):
    message, line = reported((old, new))
    assert message.startswith(f"mine.yaml, line {line}, {expected}")


def test_missing_keys_are_reported_together(reported):
    assert reported(text="name: x\ntitle: y\n")[0].startswith(
        "15 problems: (1) mine.yaml: 'rollers_per_row' is missing ("
    )
    lines = [
        line for line in TEXT.splitlines(keepends=True) if not line.startswith("roller_length:")
    ]
    assert reported(text="".join(lines))[0] == (
        "mine.yaml: 'roller_length' is missing (roller length). Allowed: a number with its unit, m or mm or um. Add it."
    )


def test_all_problems_are_reported_together(reported):
    message, _ = reported(("osculation_inner: {value: 0.98", "osculation_inner: {value: 1.02"),
                      ("diametral_clearance: {value: 0.20", "diametral_clearance: {value: 20"))  # fmt: skip
    assert message.startswith("2 problems: (1) mine.yaml, line ")
    assert "osculation_inner: it is 1.02. Allowed: above 0.9 and below 1." in message
    assert "diametral_clearance: it is 20 mm. Allowed: -1 to 5 mm." in message


def test_duplicate_key(reported):
    message, _ = reported(end="density: {value: 7800, unit: kg/m3}\n")
    expected = 'found duplicate key "density". Allowed: every key once. Delete one of the two.'
    assert message == f"mine.yaml, line {TEXT.count(chr(10)) + 1}: {expected}"
    message, line = reported(("mass: {value: 519,", "mass: {value: 519, value: 520,"))
    assert message.startswith(f'mine.yaml, line {line}: found duplicate key "value".')


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("name: x\nmass: {value: 1\ntitle: y\n", "mine.yaml, line 3: this is not valid YAML ("),
        (
            "name: x\nmass: *nowhere\n",
            "mine.yaml, line 2: this is not valid YAML (found undefined alias",
        ),
        ("name: x\n---\nname: y\n", "mine.yaml, line 2: this is not valid YAML ("),
        ("name: \x01\n", "mine.yaml: this is not valid YAML (unacceptable character"),
        ("name: 2001-99-99\n", "mine.yaml: this is not valid YAML ("),
        ("", "mine.yaml: the file holds nothing. Allowed: a mapping of keys to entries."),
        ("- name\n", "mine.yaml: the file holds a list. Allowed: a mapping"),
    ],
)
def test_broken_file(reported, text, expected):
    assert reported(text=text)[0].startswith(expected)


def test_merged_entries_fall_back_to_the_line_of_the_entry(reported):
    merged = TEXT.replace("poisson_ratio: {value: 0.3, unit: \"1\", tag: E, note: \"bearing steel\"}",
                          "poisson_ratio: &steel {value: 0.7, unit: \"1\"}")  # fmt: skip
    old = 'cage_poisson_ratio: {value: 0.3, unit: "1", tag: E,'
    message, line = reported((old, "cage_poisson_ratio: {<<: *steel, tag: E,"), text=merged)
    assert f"(2) mine.yaml, line {line}, cage_poisson_ratio: it is 0.7." in message


def test_file_that_is_not_there_or_not_text(tmp_path):
    with pytest.raises(InputError, match=rf"'skf-240' \(No such file.*catalogue name: .*{NAME}"):
        Bearing.read("skf-240")
    with pytest.raises(InputError, match="no bearing can be read from"):
        Bearing.read(tmp_path)
    (tmp_path / "mine.yaml").write_bytes(b"name: \xff\xfe\n")
    with pytest.raises(InputError, match="not UTF-8 text"):
        Bearing.read(tmp_path / "mine.yaml")


def test_from_dict_tells_the_same_without_a_place(base):
    entries = base.as_dict()
    entries["density"] = {"value": -1, "unit": "kg/m3"}
    with pytest.raises(InputError, match="^density: it is -1 kg/m3. Allowed: 500 to 25000 kg/m3"):
        Bearing.from_dict(entries)


@settings(max_examples=50, deadline=None)
@given(st.recursive(st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
                    lambda inner: st.dictionaries(st.sampled_from(["value", "unit", "tag", "x"]), inner, max_size=4)
                    | st.lists(inner, max_size=2), max_leaves=6))  # fmt: skip
def test_any_entry_is_either_right_or_reported(entry):
    entries = Bearing.read(NAME).as_dict() | {"mass": entry}
    try:
        bearing = Bearing.from_dict(entries)
    except InputError as error:
        assert "mass" in str(error)
    else:
        assert 0 < bearing.mass <= 1e6


def test_waves_of_the_ring_are_a_section_of_the_file(tmp_path):
    text = (
        Bearing.read("skf-240-600-bc").as_yaml()
        + "out_of_round:\n  second: 20 um\n  angle: {value: 90, unit: deg, tag: E}\n"
    )
    (tmp_path / "oval.yaml").write_text(text)
    oval = Bearing.read(tmp_path / "oval.yaml")
    assert (oval.out_of_round_second, oval.out_of_round_third) == (2e-5, None)
    assert oval.provenance["out_of_round_angle"].tag == "E"
    assert Bearing.from_dict(oval.as_dict()) == oval
    (tmp_path / "again.yaml").write_text(oval.as_yaml())
    assert Bearing.read(tmp_path / "again.yaml") == oval
    varied = replaced(oval, [Setting("bearing.out_of_round.second", 35.0, "um").checked()])
    assert (
        varied.out_of_round_second == 35e-6 and varied.out_of_round_angle == oval.out_of_round_angle
    )


@pytest.mark.parametrize(
    ("section", "words"),
    [
        (
            "{secnd: 1 um}",
            r"the key 'secnd' inside out_of_round is unknown. Did you mean 'second'\?",
        ),
        ("{second: 20 mm}", r"line \d+, out_of_round_second: it is 20 mm. Allowed: -1 to 1 mm"),
        (
            "20 um",
            r"out_of_round: it is '20 um'. Allowed: a section with the keys second, third, angle",
        ),
    ],
)
def test_faulty_waves_are_refused_with_their_line(tmp_path, section, words):
    text = Bearing.read("skf-240-600-bc").as_yaml() + f"out_of_round: {section}\n"
    (tmp_path / "oval.yaml").write_text(text)
    with pytest.raises(InputError, match=words):
        Bearing.read(tmp_path / "oval.yaml")


def test_the_file_of_a_tapered_bearing_is_refused_in_one_sentence():
    """It would lack or have too much of nearly every key, which says nothing."""
    file = resources.files("macroslip.bearing.tapered") / "catalogue" / "tdo-main-bearing.yaml"
    with pytest.raises(InputError, match=r"tapered roller bearing.*read_bearing") as caught:
        Bearing.read(str(file))
    assert str(caught.value).count("Allowed") == 1
