"""Case files: what they become, and the schema that describes them."""

import json
import math
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from macroslip import (
    BackwardEuler,
    BearingLoads,
    Cage,
    Case,
    Drivetrain,
    ExplicitEuler,
    HubLoads,
    InputError,
    Laws,
    Radau,
    simulate,
)
from macroslip.case.case_file import case_schema, read_case
from tests.quick import COARSE

DATA = Path(__file__).parents[1] / "data"
LOADS = "loads: {bundled: 14B, start: 0 s, end: 10 s}\n"


@pytest.fixture
def write(tmp_path):
    """Write a case file and give back its path."""

    def write(text):
        path = tmp_path / "case.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_loads_alone_are_a_case_with_the_defaults(write):
    case = read_case(write("loads: {bundled: 14B}\n"))
    plain = Case(loads=HubLoads.bundled("14B"))
    assert plain.laws == Laws.physical()
    assert case.as_dict() == plain.as_dict()


def test_every_key_arrives_in_si(write):
    case = read_case(
        write(f"""
bearing: skf-240-600-bc
lubricant: vg460-pao
temperature: 50 degC
loads: {{file: {DATA / "sample14B.outb"}, start: 61 s, end: 71 s}}
drivetrain: {{hub_to_bearing: 1300 mm, bearing_to_gearbox: 2.1 m, tilt: 6 deg,
             shaft_mass: 9000 kg, shaft_mass_station: 2 m}}
forces: {{gravity: false, drag: true}}
laws: {{model: physical, film: moes, starvation: false, inlet_heating: false, viscosity: barus, rheology: eyring,
       heating: false, microslip: false, asperities: film-ratio, rolling: inlet, traction: mechanisms}}
integrator: {{method: radau, tolerance: 1e-5, max_steps: 1000}}
window: {{start: 62 s, end: 70.5 s}}
rollers: [0, 7]
traces: {{step: 10 ms, start: 63 s, end: 64 s}}
""")
    )
    assert case.loads.time[[0, -1]].tolist() == [61.0, 71.0]
    assert case.drivetrain == Drivetrain(
        hub_to_bearing=1.3,
        bearing_to_gearbox=2.1,
        tilt=6 * math.pi / 180,
        shaft_mass=9000.0,
        shaft_mass_station=2.0,
    )
    assert (case.gravity, case.drag, case.rollers) == (False, True, (0, 7))
    assert (case.temperature, case.heat) == (323.15, None)
    assert case.laws == Laws(
        film="moes", starvation=False, inlet_heating=False, viscosity="barus", rheology="eyring", heating=False,
        microslip=False, asperities="film-ratio", rolling="inlet", traction="mechanisms",
    )  # fmt: skip
    assert case.integrator == Radau(tolerance=1e-5, max_steps=1000)
    assert (case.window.start, case.window.end) == (62.0, 70.5)
    assert (case.traces.step, case.traces.start, case.traces.end) == (0.01, 63.0, 64.0)


def test_words_stand_for_the_defaults(write):
    case = read_case(write(LOADS + "window: {start: auto}\nrollers: all\ntraces: none\nforces:\n"))
    assert case.as_dict() == Case(loads=HubLoads.bundled("14B").window(0.0, 10.0)).as_dict()


@pytest.mark.parametrize(
    ("text", "laws"),
    [
        ("{model: paper}", Laws.paper()),
        ("{model: physical}", Laws.physical()),
        ("{microslip: false}", Laws.physical().but(microslip=False)),
        ("{model: paper, microslip: true}", Laws.paper().but(microslip=True)),
        ("{model: physical, asperities: none}", Laws.physical().but(asperities="none")),
    ],
)
def test_a_model_and_what_differs_from_it(write, text, laws):
    assert read_case(write(f"{LOADS}laws: {text}\n")).laws == laws


def test_the_whole_bearing_with_its_cage(write):
    text = """dynamics: whole-bearing
cage: {gap: 0.2 mm, impact: dry, damping: 30 s/m, arrangement: per-row, mass: 40 kg, weight: false, guide_friction: 5 N,
  offsets: random, diameter_scatter: 1.5 um, seed: 7}
"""
    case = read_case(write(LOADS + text))
    assert case.dynamics == "whole-bearing"
    assert case.cage == Cage(
        gap=2e-4, impact="dry", damping=30.0, arrangement="per-row", mass=40.0, weight=False, guide_friction=5.0,
        offsets="random", diameter_scatter=1.5e-6, seed=7,
    )  # fmt: skip
    assert case.as_dict()["cage"]["gap"] == 2e-4
    assert not {"dynamics", "cage"} & set(read_case(write(LOADS)).as_dict())


@pytest.mark.slow
def test_a_whole_bearing_whose_rollers_skew(write):
    """From file to result: both rows' rollers, and the case that the result holds."""
    loads = (
        "loads: {main_bearing: {force: [0 N, -60 kN, 40 kN], shaft_speed: 20 rpm, duration: 1 s}}\n"
    )
    text = "dynamics: whole-bearing\nlaws: {model: physical, skew: quasi-static}\ncage: {gap: 0.3 mm, skew_play: 4 mrad}\n"
    text += f"integrator: {{tolerance: {COARSE.tolerance}}}\n"
    result = simulate(read_case(write(loads + text)))
    assert (result.status == 0).all() and result.attrs["dynamics"] == "whole-bearing"
    told = json.loads(result.attrs["input"])
    assert (told["cage"]["skew_play"], told["cage"]["gap"], told["laws"]["skew"]) == (
        4e-3,
        3e-4,
        "quasi-static",
    )
    assert float(result.skew_energy.sum()) > 0.0 and float(result.stop_energy.sum()) > 0.0
    assert np.nanmax(np.abs(result.skew_by_position)) <= 4e-3


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("cage: {gap: 20 mm}\n", r"line 3, cage\.gap: .*pockets would overlap"),
        (
            "integrator: {method: backward-euler, step: 1 ms}\n",
            "line 3, integrator: .*cannot resolve the impacts",
        ),
    ],
)
def test_a_whole_bearing_that_cannot_be(write, text, message):
    with pytest.raises(InputError, match=message):
        read_case(write(f"{LOADS}dynamics: whole-bearing\n{text}"))


@pytest.mark.parametrize(
    ("text", "integrator"),
    [
        ("{method: backward-euler, step: 1 ms}", BackwardEuler(step=1e-3)),
        (
            "{method: backward-euler, step: 0.001 s, tolerance: 1e-6}",
            BackwardEuler(step=1e-3, tolerance=1e-6),
        ),
        ("{method: explicit-euler, step: 1e-2 ms}", ExplicitEuler(step=1e-5)),
        ("{tolerance: 1e-4}", Radau(tolerance=1e-4)),
        ("{tolerance: 0.001}", Radau(tolerance=1e-3)),
    ],
)
def test_integrators(write, text, integrator):
    assert read_case(write(f"{LOADS}integrator: {text}\n")).integrator == integrator


def test_constant_hub_loads(write):
    loads = read_case(
        write("""
loads:
  hub:
    force: [164.4 kN, -2.3 kN, -263000 N]
    moment: [726 kN m, 154400 N m, .5 kN m]
    shaft_speed: 20.463 rpm
    duration: 2e3 ms
""")
    ).loads
    assert isinstance(loads, HubLoads)
    assert loads.force[-1].tolist() == [164400.0, -2300.0, -263000.0]
    assert loads.moment[0].tolist() == [726000.0, 154400.0, 500.0]
    assert loads.shaft_speed[0] == pytest.approx(20.463 * np.pi / 30, rel=1e-15)
    assert loads.duration == 2.0


@pytest.mark.parametrize("speed", ["0 rpm", "-2.1 rad/s"])
def test_constant_main_bearing_load(write, speed):
    loads = read_case(
        write(
            f"loads: {{main_bearing: {{force: [0 N, -3e5 N, 0 kN], shaft_speed: {speed}, duration: 1 s}}}}"
        )
    ).loads
    assert isinstance(loads, BearingLoads)
    assert loads.force[0].tolist() == [0.0, -3e5, 0.0] and loads.shaft_speed[0] in (0.0, -2.1)


def test_relative_paths_start_at_the_folder_of_the_case_file(write, tmp_path, monkeypatch):
    from macroslip import Bearing

    monkeypatch.chdir("/")
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "bearing.yaml").write_text(
        json.dumps(Bearing.read("skf-240-600-bc").as_dict())
    )
    (tmp_path / "mine" / "loads.csv").write_text(
        "time_s,shaft_speed_rpm,F_X0_kN,F_Y0_kN,F_Z0_kN\n0,20,0,-300,0\n0.1,20,0,-310,0\n"
    )
    case = read_case(write("loads: {bearing_file: mine/loads.csv}\nbearing: mine/bearing.yaml\n"))
    assert case.bearing == Bearing.read("skf-240-600-bc")
    assert case.loads.force[:, 1].tolist() == [-300e3, -310e3]


@pytest.mark.slow
def test_laws_are_not_imported_unless_they_are_named(write):
    code = (
        "import sys; from macroslip.case.case_file import read_case; read_case(sys.argv[1]);"
        "print('numba' in sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(write(LOADS + "laws: {model: paper}\n"))],
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    assert done.stdout.strip() == "False"


def accepts(schema, value):
    """Check a value against the words of JSON Schema that the schema uses, and against no others."""
    known = {"$schema", "title", "description", "type", "properties", "required", "additionalProperties", "enum",
             "const", "pattern", "minLength", "items", "minItems", "maxItems", "minimum", "uniqueItems", "oneOf",
             "anyOf"}  # fmt: skip
    assert schema.keys() <= known, schema.keys() - known
    kinds = {
        "object": dict,
        "array": list,
        "string": str,
        "boolean": bool,
        "integer": int,
        "number": (int, float),
    }
    if "type" in schema:
        if not isinstance(value, kinds[schema["type"]]):
            return False
        if isinstance(value, bool) and schema["type"] != "boolean":
            return False
    checks = [
        "enum" not in schema or value in schema["enum"],
        "const" not in schema or value == schema["const"],
        "pattern" not in schema or bool(re.search(schema["pattern"], value)),
        "oneOf" not in schema or sum(accepts(branch, value) for branch in schema["oneOf"]) == 1,
        "anyOf" not in schema or any(accepts(branch, value) for branch in schema["anyOf"]),
    ]
    if isinstance(value, dict):
        properties = schema.get("properties", {})
        checks += [
            accepts(properties[key], inner) for key, inner in value.items() if key in properties
        ]
        checks.append(set(schema.get("required", [])) <= value.keys())
        checks.append(schema.get("additionalProperties", True) or value.keys() <= properties.keys())
    if isinstance(value, list) and schema.get("type") == "array":
        checks.append(schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)))
        checks.append(not schema.get("uniqueItems") or len(set(value)) == len(value))
        checks += [accepts(schema["items"], item) for item in value]
    if isinstance(value, int) and "minimum" in schema:
        checks.append(value >= schema["minimum"])
    return all(checks)


CONSTANT = {"force": ["1 kN", "2 N", "0 N"], "shaft_speed": "20 rpm", "duration": "3 s"}


@pytest.mark.parametrize(
    ("changes", "good"),
    [
        ({}, True),
        ({"loads": {"main_bearing": CONSTANT}}, True),
        ({"loads": {"hub": CONSTANT | {"moment": ["1 kN m", "0 N m", "0 N m"]}}}, True),
        ({"loads": {"hub": CONSTANT}}, False),
        ({"loads": {"bundled": "14B", "hub": CONSTANT}}, False),
        ({"loads": {"main_bearing": CONSTANT | {"force": ["1 kN", "2 N"]}}}, False),
        ({"loads": {"bundled": "14B", "start": "0 s", "end": "1e4 ms"}}, True),
        ({"loads": {"bundled": "14B", "start": "0"}}, False),
        ({"drivetrain": {"tilt": "5deg", "hub_to_bearing": " 1.26  m "}}, True),
        ({"drivetrain": {"tilt": "5 degrees"}}, False),
        ({"forces": {"gravity": "true"}}, False),
        ({"laws": {"film": "masjedi-khonsari"}}, True),
        ({"laws": {"film": "other"}}, False),
        ({"laws": {"model": "physical", "rheology": "eyring", "microslip": False}}, True),
        ({"laws": {"model": "real"}}, False),
        ({"laws": {"microslip": "on"}}, False),
        ({"laws": {"traction": "barus-crook"}}, False),
        ({"integrator": {"tolerance": 1e-4}}, True),
        ({"integrator": {"method": "radau", "tolerance": 1e-4, "max_steps": 10}}, True),
        ({"integrator": {"method": "radau", "step": "1 ms"}}, False),
        ({"integrator": {"method": "backward-euler", "step": "1 ms", "tolerance": 1e-9}}, True),
        ({"integrator": {"method": "explicit-euler"}}, False),
        ({"window": {"start": "auto", "end": "9 s"}}, True),
        ({"window": {"start": "now"}}, False),
        ({"rollers": "all"}, True),
        ({"rollers": [0, 7]}, True),
        ({"rollers": [0, 0]}, False),
        ({"rollers": "none"}, False),
        ({"traces": "none"}, True),
        ({"traces": {"step": "1 ms"}}, True),
        ({"traces": {}}, False),
        ({"dynamics": "whole-bearing", "cage": {"gap": "0.2 mm", "impact": "dry"}}, True),
        ({"dynamics": "whole-bearing", "cage": {"damping": "50 m/s"}}, False),
        ({"dynamics": "free"}, False),
        ({"extra": 1}, False),
    ],
)
def test_schema_and_reader_accept_the_same(write, changes, good):
    content = {"loads": {"bundled": "14B", "end": "10 s"}} | changes
    assert accepts(json.loads(json.dumps(case_schema())), content) is good
    path = write(json.dumps(content))
    if good:
        read_case(path)
    else:
        with pytest.raises(InputError):
            read_case(path)
