"""`macroslip bearing`, `macroslip lubricant` and `macroslip turbine`."""

import json

import pytest

from macroslip import Bearing, Lubricant, Turbine
from macroslip.bearing.kinds import bearing_catalogue
from macroslip.bearing.tapered import TaperedBearing
from tests.records import values_of

KINDS = [("bearing", Bearing), ("lubricant", Lubricant), ("turbine", Turbine)]


@pytest.mark.parametrize(("noun", "kind"), KINDS)
def test_list(macroslip, noun, kind):
    done = macroslip(noun, "list")
    assert (done.code, done.err) == (0, "")
    for name in kind.catalogue():
        assert any(
            line.split()[0] == name and kind.read(name).title in line
            for line in done.out.splitlines()
        )


@pytest.mark.parametrize(("noun", "kind"), KINDS)
def test_show_tells_every_value_as_written_with_its_origin(macroslip, noun, kind):
    for name in kind.catalogue():
        done = macroslip(noun, "show", name)
        assert (done.code, done.err) == (0, "")
        lines = {line.split()[0]: line for line in done.out.splitlines() if line.split()}
        for key, origin in kind.read(name).provenance.items():
            unit = "" if origin.unit == "1" else f" {origin.unit}"
            # Derived numbers to six digits.
            value = f"{origin.value:.6g}" if len(str(origin.value)) > 12 else origin.value
            assert f"  {value}{unit}  {origin.tag}: " in lines[key]
            assert " ".join(origin.note.split()[:3]) in lines[key]


def test_show_tells_what_follows_from_a_bearing(macroslip):
    out = " ".join(macroslip("bearing", "show", "skf-240-600-bc").out.split())
    assert "stiffness K 9.258e+10 N/m^1.5" in out
    assert "truncation load 203.2 kN" in out
    assert "orbit ratio 0.4539" in out
    assert "contact_angle 11.2 deg D: derived" in out


def test_show_tells_what_is_assumed_of_a_turbine(macroslip):
    out = " ".join(macroslip("turbine", "show", "nrel5-rear").out.split())
    assert "four-point, moment-carrying front, front locating, rear simulated" in out
    assert "its parts, and what is assumed of them" in out
    printed = json.loads(macroslip("turbine", "show", "nrel5", "--json").out)
    parts = {part["quantity"]: part for part in printed["its parts, and what is assumed of them"]}
    assert parts["bearing"]["value"] == "skf-240-950-bc"
    assert parts["bearing"]["meaning"].startswith("Assumed:")


def test_show_a_file_of_the_users_own(folder, macroslip):
    entries = Lubricant.read("vg460-pao").as_dict() | {
        "name": "mine",
        "viscosity": {"value": 0.6, "unit": "Pa s"},
    }
    (folder / "mine.yaml").write_text(json.dumps(entries))
    out = macroslip("lubricant", "show", "mine.yaml").out
    assert out.startswith("mine: ") and "0.6 Pa s  U: user" in out


@pytest.mark.parametrize(("noun", "kind"), KINDS)
def test_schema(macroslip, noun, kind):
    done = macroslip(noun, "schema")
    assert (done.code, json.loads(done.out)) == (0, kind.json_schema())


def test_a_name_that_does_not_exist(folder, macroslip):
    done = macroslip("bearing", "show", "skf")
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        "error: no bearing can be read from 'skf' (No such file or directory). Allowed: the path of a YAML file, or a "
        f"catalogue name: {', '.join(bearing_catalogue())}. Relative paths start at {folder}.\n"
    )


@pytest.mark.slow
@pytest.mark.parametrize(("noun", "kind"), KINDS)
def test_show_as_a_file_that_can_be_read_again(folder, macroslip, noun, kind):
    for name in kind.catalogue():
        done = macroslip(noun, "show", name, "--yaml")
        assert (done.code, done.err) == (0, "")
        (folder / "mine.yaml").write_text(done.out, encoding="utf-8")
        assert kind.read(folder / "mine.yaml") == kind.read(name)


PAGE = [
    "--bore",
    "630 mm",
    "--outside",
    "920 mm",
    "--width",
    "290 mm",
    "--c0",
    "17600 kN",
    "--e",
    "0.30",
]


def test_a_bearing_from_its_makers_page(folder, macroslip):
    done = macroslip(
        "bearing",
        "estimate",
        *PAGE,
        "--shoulder",
        "828 mm",
        "--groove",
        "5.65e-2 m",
        "-o",
        "mine.yaml",
    )
    assert (done.code, done.err) == (0, "")
    assert "not the maker's drawing" in done.out and "written: mine.yaml" in done.out
    assert "C by ISO 281" not in done.out  # C is not published: there is nothing to compare with
    mine, shipped = Bearing.read("mine.yaml"), Bearing.read("skf-240-630-bc")
    assert mine.name == "mine"
    for key in (
        "rollers_per_row",
        "roller_diameter",
        "roller_length",
        "contact_angle",
        "outer_raceway_radius",
    ):
        assert getattr(mine, key) == getattr(shipped, key)
        low, high = mine.provenance[key].range
        assert low < mine.provenance[key].value < high
    assert macroslip("bearing", "estimate", *PAGE, "-o", "mine.yaml").code == 2  # it exists
    done = macroslip("bearing", "estimate", *PAGE, "--c", "9307 kN", "-o", "mine.yaml", "--force")
    assert done.code == 0 and "C by ISO 281 from these dimensions is 0.8" in done.out


@pytest.mark.parametrize(
    ("options", "reported"),
    [
        (["--shoulder", "828"], "--shoulder is '828', which does not give its unit"),
        (
            ["--shoulder", "928 mm"],
            "shoulder is 928 mm. Allowed: between bore and outside diameter",
        ),
        (["--bpfo", "13.2"], "only one overrolling frequency is given"),
        (
            ["--bpfo", "13.2", "--bpfi", "16.2"],
            "together 29.4. Allowed: a sum that is the whole number of rollers",
        ),
        (["--y", "1.4"], "--y does not count with --kind spherical"),
        (["--c", "0 kN"], "dynamic_load_rating is 0.0. Allowed: a finite number above 0"),
    ],
)
def test_a_page_that_contradicts_itself(folder, macroslip, options, reported):
    done = macroslip("bearing", "estimate", *PAGE, *options, "-o", "mine.yaml")
    assert (done.code, done.out) == (2, "") and reported in done.err
    assert not list(folder.iterdir())


TAPERED = ["--kind", "tapered", "--c0", "16000 kN", "--y", "0.77", "--cu", "1060 kN"]


def test_a_tapered_bearing_from_its_makers_page(folder, macroslip):
    done = macroslip("bearing", "estimate", *TAPERED, "--c", "8090 kN", "-o", "mine.yaml")
    assert (done.code, done.err) == (0, "")
    assert "not the maker's drawing" in done.out and "on no maker's page" in done.out
    bearing = TaperedBearing.read("mine.yaml")
    assert bearing.provenance["dynamic_load_rating"].tag == "V"
    assert bearing.provenance["rib_contact_height"].tag == "E"


@pytest.mark.parametrize(
    ("options", "reported"),
    [
        (["--e", "0.3"], "e and Y mean two different contact angles, 11.31 and 30.30 deg"),
        (["--rows", "1"], "the distance of the two rows is missing"),
        (["--shoulder", "800 mm"], "--shoulder does not count with --kind tapered"),
    ],
)
def test_a_page_of_a_tapered_bearing_that_contradicts_itself(folder, macroslip, options, reported):
    done = macroslip("bearing", "estimate", *TAPERED, *options, "-o", "mine.yaml")
    assert (done.code, done.out) == (2, "") and reported in done.err
    assert not list(folder.iterdir())


def test_a_spherical_bearing_needs_its_whole_page(folder, macroslip):
    done = macroslip("bearing", "estimate", "--c0", "1 kN", "-o", "mine.yaml")
    assert done.code == 2
    assert "--bore and --outside and --width and --e are missing" in done.err


def test_a_bearing_file_to_start_from(folder, macroslip):
    assert macroslip("bearing", "init").code == 0
    assert Bearing.read("bearing.yaml").name == "bearing"
    own, base = (values_of(Bearing.read(name)) for name in ("bearing.yaml", "skf-240-600-bc"))
    assert own | {"name": "", "title": ""} == base | {"name": "", "title": ""}
    assert macroslip("bearing", "init").code == 2
    assert macroslip("bearing", "init", "-o", "other.yaml").code == 0
    assert Bearing.read("other.yaml").name == "other"
    assert macroslip("bearing", "init", "--force").code == 0


def test_estimate_a_lubricant_that_can_be_read_and_shown(folder, macroslip):
    arguments = (
        "lubricant",
        "estimate",
        "--v40",
        "320 mm2/s",
        "--v100",
        "35 cSt",
        "--base",
        "pao",
        "--name",
        "mine",
    )
    done = macroslip(*arguments, "-o", "mine.yaml")
    assert (done.code, done.err) == (0, "")
    oil = Lubricant.read(folder / "mine.yaml")
    assert (oil.name, oil.base_oil, oil.kinematic_viscosity_100) == ("mine", "pao", 35e-6)
    assert macroslip(*arguments).out == (folder / "mine.yaml").read_text(encoding="utf-8")
    assert "reference_pressure_viscosity" in macroslip("lubricant", "show", "mine.yaml").out
    again = macroslip(*arguments, "-o", "mine.yaml")
    assert again.code == 2 and "the file exists" in again.err
    assert macroslip(*arguments, "-o", "mine.yaml", "--force").code == 0


@pytest.mark.parametrize(
    ("v40", "v100", "base", "message"),
    [
        ("320", "35 mm2/s", "pao", "error: --v40 is '320', which does not give its unit. Allowed: a number with its unit, m2/s"),
        ("320 mm2/s", "35 Pa s", "pao", "error: --v100 is '35 Pa s', which has the unit 'Pa s'. Allowed: a number with its unit, m2/s"),
        ("320 mm2/s", "35 mm2/s", "whale", "error: there is no base oil 'whale'. Allowed: pao (polyalphaolefin), "),
        ("35 mm2/s", "320 mm2/s", "pao", "error: the viscosity is 35 mm2/s at 313.15 K and 320 mm2/s at 373.15 K."),
    ],
)  # fmt: skip
def test_estimate_refuses_what_is_no_lubricant(folder, macroslip, v40, v100, base, message):
    done = macroslip(
        "lubricant", "estimate", "--v40", v40, "--v100", v100, "--base", base, "-o", "mine.yaml"
    )
    assert done.code == 2 and done.err.startswith(message) and done.err.count("\n") == 1
    assert not (folder / "mine.yaml").exists()


def test_a_drawing(folder, macroslip):
    done = macroslip("bearing", "draw", "skf-240-630-bc", "-o", "drawing.svg")
    assert (done.code, done.out, done.err) == (0, "written: drawing.svg\n", "")
    assert "<svg" in (folder / "drawing.svg").read_text(encoding="utf-8")
    done = macroslip("bearing", "draw", "skf-240-630-bc", "-o", "drawing.txt")
    assert done.code == 2 and "ends with .svg, .pdf or .png" in done.err
    assert macroslip("bearing", "draw", "skf-240-630-bc", "-o", "drawing.svg").code == 2
    assert macroslip("bearing", "draw", "32216-pair", "-o", "pair.svg").code == 0
    assert "<svg" in (folder / "pair.svg").read_text(encoding="utf-8")
