"""What a user is shown about a case file that is wrong."""

import os
import re
from pathlib import Path

import pytest

from macroslip import InputError, Lubricant
from macroslip.bearing.kinds import bearing_catalogue
from macroslip.case.case_file import read_case

DATA = Path(__file__).parents[1] / "data"
LOADS = "loads: {bundled: 14B, start: 0 s, end: 10 s}\n"


@pytest.fixture
def reported(tmp_path):
    """What the user is shown about a case file that is wrong."""

    def reported(text):
        path = tmp_path / "case.yaml"
        path.write_text(text, encoding="utf-8")
        with pytest.raises(InputError) as caught:
            read_case(path)
        message = str(caught.value)
        assert str(path) in message and "\n" not in message
        return message.replace(str(path), "case.yaml").replace(str(path.parent), "FOLDER")

    return reported


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "laods: {bundled: 14B}\n",
            "case.yaml, line 1: the key 'laods' is unknown. Did you mean 'loads'?",
        ),
        (
            LOADS + "window:\n  strat: 5 s\n",
            "case.yaml, line 3: the key 'strat' inside window is unknown. Did you mean 'start'?",
        ),
        (
            LOADS + "weather: fair\n",
            "case.yaml, line 2: the key 'weather' is unknown. Allowed: bearing, lubricant, temperature, "
            "heat, temperature_difference, oil_supply, loads, drivetrain, forces, laws, dynamics, cage, integrator, window, rollers, traces, contact_details, rating. Remove it.",
        ),
        (
            "rollers: all\n",
            "case.yaml: 'loads' is missing (loads, from exactly one source). Allowed: a section with the keys bundled, "
            "file, bearing_file, roller_loads, hub, main_bearing, start, end, shaft_speed, decimal, thousands, hub_to_output, sheet. Add it.",
        ),
        (
            "loads: {bundled: 14B, file: x.outb}\n",
            "case.yaml, line 1, loads: bundled and file stand together. Allowed: exactly one of bundled, file, "
            "bearing_file, roller_loads, hub, main_bearing. Remove or comment out the others.",
        ),
        (
            "loads:\n  start: 5 s\n",
            "case.yaml, line 1, loads: none of the keys it needs is there. Allowed: exactly one of bundled, file, "
            "bearing_file, roller_loads, hub, main_bearing. Add one of them.",
        ),
        (
            "loads: {bundled: 14D}\n",
            "case.yaml, line 1, loads.bundled: '14D' does not exist. Allowed: 12A, 12B, 12C, 14A, 14B, 14C, 16A, "
            "16B, 16C, 18A, 18B, 18C, 20A, 20B, 20C, 22A, 22B, 22C, 24A, 24B, 24C, 4A, "
            "4B, 6A, 6B, 8A, 8B, 10A, 10B, 8B-2, 10B-2, 12B-2, 16B-2, 24B-2, start-8, start-14, stop-14, stop-24, "
            "estop-20, gridloss-14, idle-6, idle-25, parked-12, eog-14, ecd-14, yaw20-14, nrel5-4B, nrel5-6B, nrel5-8B, "
            "nrel5-10B, nrel5-12B, nrel5-14B, nrel5-16B, nrel5-18B, nrel5-20B, nrel5-22B, nrel5-24B, nrel5-12A, nrel5-18A, "
            "nrel5-8B-2, nrel5-12B-2, nrel5-18B-2. Did you mean 14C?",
        ),
        (
            "loads: {file: nothing.outb}\n",
            "case.yaml, line 1, loads.file: there is no file 'nothing.outb'. Relative paths start at FOLDER.",
        ),
        (
            "loads: {bundled: 14B, end: 700 s}\n",
            "case.yaml, line 1, loads.bundled: bundled case 14B: the window from 0 s to 700 s cannot be cut out. "
            "Allowed: start before end, both within 0 s to 599.95 s. Choose a window on the record's own time "
            "axis, which need not begin at zero.",
        ),
        (
            "loads:\n  main_bearing:\n    force: [0 N, -3e5 N]\n    shaft_speed: 2 rad/s\n",
            "2 problems: (1) case.yaml, line 3, loads.main_bearing.force: it is ['0 N', '-3e5 N']. Allowed: a "
            "list of three quantities, such as [0 N, 0 N, 0 N]. It is the three components of the force. (2) "
            "case.yaml, line 2, loads.main_bearing: 'duration' is missing (time for which the loads act). "
            "Allowed: a number with its unit, s or ms or min. Add it.",
        ),
        (
            "loads:\n  main_bearing: {force: [0 N, -3e5 N, 0 N], shaft_speed: 2 rad/s, duration: 5 s}\n  end: 3 s\n",
            "case.yaml, line 2, loads.main_bearing: end would cut a series, but these loads are constant. Remove them; "
            "loads.main_bearing.duration says how long.",
        ),
        (
            "loads:\n  main_bearing: {force: [0 N, -3e5 N, 0 N], shaft_speed: 1800 rpm, duration: 5 s}\n",
            "case.yaml, line 1, loads: the shaft turns at up to 188.5 rad/s, beyond any rotor. Allowed: up to 100 rad/s on a "
            "double-row spherical roller bearing. Check the unit. Is it in rpm, or the speed of the generator?",
        ),
        (
            LOADS + "drivetrain:\n  hub_to_bearing: 1.26\n",
            "case.yaml, line 3, drivetrain.hub_to_bearing: it is 1.26, which does not give its unit. Allowed: a number with its unit, m "
            "or mm or um. Write 1.26 m or 1.26 mm or 1.26 um, whichever it is.",
        ),
        (
            LOADS + "drivetrain:\n  hub_to_bearing: 4 ft\n",
            "case.yaml, line 3, drivetrain.hub_to_bearing: it is '4 ft', which has the unit 'ft'. Allowed: a number with its "
            "unit, m or mm or um. Convert it to one of these units.",
        ),
        (
            LOADS + "drivetrain:\n  hub_to_bearing: 1,26 m\n",
            "case.yaml, line 3, drivetrain.hub_to_bearing: it is '1,26 m', which is not a quantity. Allowed: a number with its "
            "unit, m or mm or um. Use a decimal point, not a comma.",
        ),
        (
            LOADS + "drivetrain:\n  hub_to_bearing: about one metre\n",
            "case.yaml, line 3, drivetrain.hub_to_bearing: it is 'about one metre', which is not a quantity. Allowed: a number "
            "with its unit, m or mm or um. Write 1 m, for example.",
        ),
        (
            LOADS + "drivetrain:\n  hub_to_bearing: 1e999 m\n",
            "case.yaml, line 3, drivetrain.hub_to_bearing: it is '1e999 m', which is too large for a number. Allowed: a number "
            "with its unit, m or mm or um.",
        ),
        (
            LOADS
            + "drivetrain:\n  hub_to_bearing: 1260 m\n  tilt: 50 deg\n  shaft_mass_station: 4 m\n",
            "2 problems: (1) case.yaml, line 3, drivetrain.hub_to_bearing: it is 1260 m. Allowed: 0 to 20 m, "
            "downwind of the hub; rotors downwind of the tower are not modelled. It "
            "is the distance from hub centre to main bearing; check value and unit. (2) case.yaml, line 4, "
            "drivetrain.tilt: it is 50 deg. Allowed: -17.1887 to 17.1887 deg. It is the shaft tilt, positive with the hub "
            "end up; check value and unit.",
        ),
        (
            LOADS + "drivetrain: {tilt: 5 rad, bearing_to_gearbox: 0mm, shaft_mass: -1 kg}\n",
            "3 problems: (1) case.yaml, line 2, drivetrain.bearing_to_gearbox: it is 0mm. Allowed: above 0, up to 20000 "
            "mm. It is the distance from main bearing to gearbox support; check value and unit. (2) case.yaml, line 2, "
            "drivetrain.tilt: it is 5 rad. Allowed: -0.3 to 0.3 rad. It is the shaft tilt, positive with the hub end up; "
            "check value and unit. (3) case.yaml, line 2, drivetrain.shaft_mass: it is -1 kg. Allowed: 0 to 1e6 kg. It is "
            "the mass of the shaft without rotor; check value and unit.",
        ),
        (
            LOADS + "drivetrain:\n  shaft_mass_station: 4 m\n",
            "case.yaml, line 3, drivetrain.shaft_mass_station: it is 4 m. Allowed: 0 to 3.46 m, from the hub to the "
            "end of the shaft. It is the distance of that mass behind the hub centre; check value and unit.",
        ),
        (
            LOADS + "dynamics: free\n",
            "case.yaml, line 2, dynamics: 'free' does not exist. Allowed: imposed-orbit, whole-bearing. Choose one of these.",
        ),
        (
            LOADS + "cage: {gap: 1 mm}\n",
            "case.yaml, line 2, cage: a cage is described, but rollers on imposed orbits do not use it. Allowed: with "
            "dynamics: whole-bearing. Set dynamics: whole-bearing, or remove the cage.",
        ),
        (
            LOADS + "dynamics: whole-bearing\ncage:\n  gap: -0.1 mm\n",
            "case.yaml, line 4, cage.gap: it is -0.1 mm. Allowed: 0 to 100 mm. It is the play of a roller between the "
            "two spars of its pocket; check value and unit.",
        ),
        (
            LOADS + "forces: {gravity: yes}\n",
            "case.yaml, line 2, forces.gravity: it is 'yes'. Allowed: true or false.",
        ),
        (
            LOADS + "laws: {film: dowson, traction: barus-crook}\n",
            "2 problems: (1) case.yaml, line 2, laws.film: 'dowson' does not exist. Allowed: masjedi-khonsari, "
            "masjedi-khonsari-moes, moes. Choose one of these. A law of your own needs its file: macroslip run CASE "
            "--laws FILE. (2) case.yaml, line 2, laws.traction: 'barus-crook' does not exist. Allowed: mechanisms, "
            "kellstroem. Choose one of these. A law of your own needs its file: macroslip run CASE --laws FILE.",
        ),
        (
            LOADS + "laws: {model: real, rheology: limiting_shear, microslip: on}\n",
            "3 problems: (1) case.yaml, line 2, laws.model: 'real' does not exist. Allowed: paper, physical. Choose one "
            "of these. (2) case.yaml, line 2, laws.rheology: 'limiting_shear' does not exist. Allowed: newtonian, "
            "limiting-shear, eyring. Did you mean limiting-shear? (3) case.yaml, line 2, laws.microslip: it is 'on'. "
            "Allowed: true or false.",
        ),
        (
            LOADS + "integrator: {method: euler}\n",
            "case.yaml, line 2, integrator.method: 'euler' does not exist. Allowed: radau, backward-euler, "
            "explicit-euler. Choose one of these.",
        ),
        (
            LOADS + "integrator: {method: explicit-euler}\n",
            "case.yaml, line 2, integrator: 'step' is missing (fixed time step). Allowed: a number with its unit, "
            "s or ms or min. Add it.",
        ),
        (
            LOADS + "integrator: {method: explicit-euler, step: 1 ms, tolerance: 1e-4}\n",
            "case.yaml, line 2: the key 'tolerance' inside integrator is unknown. Allowed: method, step. Remove it.",
        ),
        (
            LOADS + "integrator:\n  method: radau\n  tables: false\n",
            "case.yaml, line 4: the key 'tables' inside integrator is unknown. Allowed: method, tolerance, "
            "max_steps. Remove it.",
        ),
        (
            LOADS + "integrator:\n  tolerance: 0.5\n",
            "case.yaml, line 3, integrator.tolerance: it is 0.5. Allowed: 1e-10 to 0.01. 2e-4 gives "
            "energies and spin to 1e-4 and peak power to 1 %.",
        ),
        (
            LOADS + "integrator:\n  tolerance: '1e-4'\n  max_steps: 1.5\n",
            "2 problems: (1) case.yaml, line 3, integrator.tolerance: it is '1e-4'. Allowed: a number without "
            "unit. Write it without quotes and units. (2) case.yaml, line 4, integrator.max_steps: it is 1.5. "
            "Allowed: a whole number, 1 to 1e15.",
        ),
        (
            LOADS + "integrator: {method: backward-euler, step: 3 s}\n",
            "case.yaml, line 2, integrator.step: it is 3 s. Allowed: 1e-7 to 1 s. It is the fixed time step; check value "
            "and unit.",
        ),
        (
            LOADS + "window: {start: 5 s, end: 11 s}\n",
            "case.yaml, line 2, window: the window runs from 5.0 s to 11.0 s. Allowed: start before end, both "
            "within the loads' 0 s to 10 s.",
        ),
        (
            LOADS + "window: 5 s\n",
            "case.yaml, line 2, window: it is '5 s'. Allowed: a section with the keys start, end.",
        ),
        (
            LOADS + "window: {end: auto}\n",
            "case.yaml, line 2, window.end: it is 'auto', which is not a quantity. Allowed: a number with its unit, s or ms or min. "
            "Write 1 s, for example.",
        ),
        (
            LOADS + "rollers: [0, 28]\n",
            "case.yaml, line 2, rollers: rollers is [0, 28]. Allowed: all, or a list of different numbers from 0 "
            "to 27.",
        ),
        (
            LOADS + "rollers: 7\n",
            "case.yaml, line 2, rollers: it is 7. Allowed: all, or a list of whole numbers such as [0, 7].",
        ),
        (
            LOADS + "traces: {step: 0 s}\n",
            "case.yaml, line 2, traces.step: it is 0 s. Allowed: a number above 0 s. It is the time between samples; "
            "check value and unit.",
        ),
        (
            LOADS + "traces: {step: 1 s, end: 99 s}\n",
            "case.yaml, line 2, traces: the traces run from 0.0 s to 99.0 s. Allowed: times within the loads' 0 s "
            "to 10 s.",
        ),
        (
            LOADS + "traces: some\n",
            "case.yaml, line 2, traces: it is 'some'. Allowed: none or a section with the keys step, start, end.",
        ),
        (
            LOADS + "bearing: skf-240-600\nlubricant: oil.yaml\n",
            "2 problems: (1) case.yaml, line 2, bearing: 'skf-240-600' is neither in the catalogue nor a file. "
            f"Allowed: {', '.join(bearing_catalogue())}, or the path of a bearing file. Did you mean skf-240-600-bc? "
            f"(2) case.yaml, line 3, lubricant: 'oil.yaml' is neither in the catalogue nor a file. Allowed: "
            f"{', '.join(Lubricant.catalogue())}, or the path of a lubricant file. Relative paths start at FOLDER.",
        ),
        (LOADS + "bearing: 3\n", "case.yaml, line 2, bearing: it is 3. Allowed: non-empty text."),
        (
            LOADS + LOADS,
            'case.yaml, line 2: found duplicate key "loads". Allowed: every key once. Delete one of the two.',
        ),
        (
            "just text\n",
            "case.yaml: the file holds text or a number. Allowed: a mapping of keys to entries. Write a case file that "
            "runs with: macroslip init.",
        ),
    ],
)
def test_what_a_user_is_reported(reported, text, message):
    assert reported(text) == message


def test_all_problems_are_reported_together(reported):
    message = reported("""
loads: {bundled: 14B, end: 60 s}
bering: skf-240-600-bc
drivetrain: {tilt: 5}
window: {start: 50 s, end: 90 s}
rollers: [99]
""")
    assert message.startswith("4 problems: (1) ")
    assert [int(line) for line in re.findall(r"line (\d+)", message)] == [3, 4, 6, 5]


@pytest.mark.parametrize(
    ("key", "file", "advice"),
    [
        ("bearing_file", "hub14B_50Hz.parquet", "This table holds hub loads: name it under file."),
        ("bearing_file", "sample14B.outb", "Hub loads from OpenFAST belong under file."),
        ("file", "bearing.csv", "This table holds main-bearing loads: name it under bearing_file."),
        (
            "file",
            "gap.csv",
            "Read the part before or after the gap (loads.start, loads.end), or resample the record.",
        ),
    ],
)
def test_a_load_file_under_the_wrong_key(reported, tmp_path, key, file, advice):
    (tmp_path / "bearing.csv").write_text(
        "time_s,rotor_speed_rpm,F_X0_kN,F_Y0_kN,F_Z0_kN\n0,1,1,1,1\n1,1,1,1,1\n"
    )
    header = "time_s,rotor_speed_rpm,fx_kN,fy_kN,fz_kN,mx_kNm,my_kNm,mz_kNm\n"
    (tmp_path / "gap.csv").write_text(
        header + "".join(f"{t},1,1,1,1,1,1,1\n" for t in (0, 1, 2, 9))
    )
    path = tmp_path / file if (tmp_path / file).exists() else DATA / file
    message = reported(f"loads:\n  {key}: {path}\n")
    assert message.startswith(f"case.yaml, line 2, loads.{key}: ") and message.endswith(advice)
    assert file in message


def test_a_wrong_bearing_file_is_named_with_its_own_line(reported, tmp_path):
    (tmp_path / "mine.yaml").write_text("name: mine\nwitdh: {value: 3, unit: mm}\n")
    message = reported(LOADS + "bearing: mine.yaml\n")
    assert message == (
        "case.yaml, line 2, bearing: FOLDER/mine.yaml, line 2: the key 'witdh' is unknown. Did you mean 'width'?"
    )


def test_a_file_that_cannot_be_read(tmp_path):
    with pytest.raises(
        InputError,
        match=r"nowhere\.yaml: the case file cannot be read \(No such file or directory\)",
    ):
        read_case(tmp_path / "nowhere.yaml")
    (tmp_path / "latin.yaml").write_bytes("# Lagergröße\n".encode("latin-1"))
    with pytest.raises(InputError, match=r"the file is not UTF-8 text. Save it as UTF-8"):
        read_case(tmp_path / "latin.yaml")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes are a thing of Unix")
def test_a_pipe_in_place_of_a_case_file_is_refused_at_once(tmp_path):
    os.mkfifo(tmp_path / "case.yaml")
    with pytest.raises(
        InputError,
        match="the case file cannot be read .it is a pipe, a socket or a device, not a file",
    ):
        read_case(tmp_path / "case.yaml")


def test_names_with_a_nul_and_files_that_are_none_of_ours(tmp_path):
    with pytest.raises(
        InputError, match="the case file cannot be read .no file can have this name"
    ):
        read_case(tmp_path / "a\0.yaml")
    (tmp_path / "secret.txt").write_text("user: alice\npassword: hunter2\n", encoding="utf-8")
    for name in ('"a\\0.yaml"', "secret.txt"):
        (tmp_path / "case.yaml").write_text(
            f"loads: {{bundled: 14B}}\nbearing: {name}\n", encoding="utf-8"
        )
        with pytest.raises(InputError) as caught:
            read_case(tmp_path / "case.yaml")
        assert str(caught.value).isprintable()
        assert "hunter2" not in str(caught.value) and "password" not in str(caught.value)
