"""Bladed output in the original layout, text and binary, and everything that can be wrong with it."""

import numpy as np
import pytest

from macroslip.case.case_file import read_case
from macroslip.errors import InputError
from macroslip.loads import HubLoads
from macroslip.study.settings import read_loads, template
from macroslip.study.study_file import read_study

HUB = ["Mx", "My", "Mz", "Myz", "Fx", "Fy", "Fz", "Fyz"]


def _group(folder, stem, number, title, names, units, columns, form, step=0.05, wrap=False):
    """A group as Bladed writes it: header `.%nn` and data `.$nn`."""
    columns = np.asarray(columns, dtype=np.float32)
    quoted = [f"'{name}'" for name in names]
    half = len(names) // 2
    variables = (
        "\n".join([" ".join(quoted[:half]), " ".join(quoted[half:])]) if wrap else " ".join(quoted)
    )
    mean = "   ".join(f"{value:.7E}" for value in columns.astype(float).mean(axis=0))
    (folder / f"{stem}.%{number}").write_text(
        f"FILE\t{stem}.${number}\nACCESS\tD\nFORM\t{form}\nRECL\t4\nFORMAT\tR*4\nCONTENT\t'POWPROD'\nCONFIG\t'STATIONARY'\n"
        f"NDIMENS\t2\nDIMENS\t{columns.shape[1]}\t{columns.shape[0]}\nGENLAB\t'{title}'\nVARIAB\t{variables}\n"
        f"VARUNIT\t{' '.join(units)}\nAXISLAB\t'Time'\nAXIUNIT\tT\nAXIMETH\t2\nMIN \t0.0000000E+000\n"
        f"STEP\t{step:.7E}\nNVARS\t0\nULOADS   1.0000000E+000\n   2.0000000E+000\nMEAN   {mean}\n",
        encoding="latin-1",
    )
    data = folder / f"{stem}.${number}"
    if form == "U":
        data.write_bytes(columns.astype("<f4").tobytes())
    else:
        np.savetxt(data, columns, fmt="%15.7E")
    return folder / f"{stem}.%{number}"


@pytest.fixture
def truth(sample_outb):
    return HubLoads.read(sample_outb)


def _run(folder, truth, form="U", with_speed=True, **options):
    mx, my, mz = truth.moment.T
    fx, fy, fz = truth.force.T
    columns = np.column_stack([mx, my, mz, np.hypot(my, mz), fx, fy, fz, np.hypot(fy, fz)])
    names = [f"Stationary hub {name}" for name in HUB]
    units = ["FL"] * 4 + ["F"] * 4
    header = _group(
        folder,
        "demo",
        23,
        "Hub loads: fixed frame GL coordinates",
        names,
        units,
        columns,
        form,
        **options,
    )
    if with_speed:
        azimuth = np.cumsum(truth.shaft_speed) * 0.05
        drive = np.column_stack([truth.shaft_speed, azimuth])
        _group(
            folder,
            "demo",
            "05",
            "Drive train variables",
            ["Rotor speed", "Rotor azimuth angle"],
            ["A/T", "A"],
            drive,
            form,
        )
    return header


def _message(path, *words):
    with pytest.raises(InputError) as caught:
        HubLoads.read(path)
    assert [word for word in words if word not in str(caught.value)] == []
    return str(caught.value)


@pytest.mark.parametrize("form", ["U", "F"])
@pytest.mark.parametrize("extension", [".%23", ".$23", ".%05"])
@pytest.mark.parametrize("wrap", [False, True])
def test_the_loads_come_back(tmp_path, truth, form, extension, wrap):
    _run(tmp_path, truth, form, wrap=wrap)
    read = HubLoads.read(tmp_path / f"demo{extension}")
    np.testing.assert_allclose(read.force, truth.force, rtol=1e-6, atol=0.1)
    np.testing.assert_allclose(read.moment, truth.moment, rtol=1e-6, atol=0.1)
    np.testing.assert_allclose(read.shaft_speed, truth.shaft_speed, rtol=1e-6)
    assert read.time == pytest.approx(truth.time - truth.time[0], abs=1e-4)
    assert any("demo.%05" in line for line in read.reading)


def test_the_speed_may_be_given(tmp_path, truth):
    header = _run(tmp_path, truth, with_speed=False)
    _message(header, "no Rotor speed", "loads.shaft_speed")
    read = HubLoads.read(header, shaft_speed=2.1)
    assert (read.shaft_speed == 2.1).all()


def test_a_group_with_the_speed_does_not_matter_where_the_speed_is_given(tmp_path, truth):
    header = _run(tmp_path, truth)
    (tmp_path / "demo.$05").unlink()
    _message(header, "there is no demo.$05")
    read = HubLoads.read(header, shaft_speed=2.1)
    assert (read.shaft_speed == 2.1).all()
    assert not any("demo.%05" in line for line in read.reading)


def test_a_case_and_a_study_may_give_the_speed(tmp_path, truth):
    header = _run(tmp_path, truth, with_speed=False)
    case = tmp_path / "case.yaml"
    case.write_text(f"loads: {{file: {header.name}, shaft_speed: 20 rpm, end: 5 s}}\n")
    read = read_case(case).loads
    assert read.shaft_speed == pytest.approx(20.0 * np.pi / 30.0)
    assert read.duration == pytest.approx(5.0, abs=0.1)
    assert "given" in read.reading[-1]
    study = tmp_path / "study.yaml"
    study.write_text(f"case: {{loads: {{shaft_speed: 20 rpm}}}}\nloads: {{files: {header.name}}}\n")
    study_file = read_study(study)
    _, cut = template(study_file.case, [], {})
    assert cut == {"shaft_speed": pytest.approx(20.0 * np.pi / 30.0)}
    assert read_loads("file", str(header), cut).shaft_speed == pytest.approx(20.0 * np.pi / 30.0)


@pytest.mark.parametrize("source", ["bundled: 14B", "bearing_file: x.csv"])
@pytest.mark.parametrize(("key", "value"), [("shaft_speed", "20 rpm"), ("hub_to_output", "2 m")])
def test_only_hub_loads_from_a_file_take_a_speed_and_a_point(tmp_path, source, key, value):
    case = tmp_path / "case.yaml"
    case.write_text(f"loads: {{{source}, {key}: {value}}}\n")
    with pytest.raises(
        InputError, match=rf"{key} is given, but .* has its own\. Remove loads\.{key}"
    ):
        read_case(case)


def test_a_case_and_a_study_may_give_the_point_of_the_loads(tmp_path, truth):
    """From a point d behind the hub the moments are moved by (−d fz, d fy)."""
    header = _run(tmp_path, truth)
    case = tmp_path / "case.yaml"
    case.write_text(f"loads: {{file: {header.name}, hub_to_output: 2000 mm}}\n")
    moved = read_case(case).loads
    arm = np.column_stack([0.0 * truth.time, -2.0 * truth.force[:, 2], 2.0 * truth.force[:, 1]])
    np.testing.assert_allclose(moved.moment, truth.moment + arm, rtol=1e-6, atol=1.0)
    study = tmp_path / "study.yaml"
    study.write_text(f"case: {{loads: {{hub_to_output: 2 m}}}}\nloads: {{files: {header.name}}}\n")
    _, cut = template(read_study(study).case, [], {})
    np.testing.assert_array_equal(read_loads("file", str(header), cut).moment, moved.moment)


@pytest.mark.parametrize(
    ("form", "change", "words"),
    [
        ("U", lambda content: content[:-4], ["cut off", "demo.$23"]),
        ("F", lambda content: content[:-200], ["numbers, its header announces"]),
        (
            "U",
            lambda content: (np.frombuffer(content, "<f4") * 1.1).astype("<f4").tobytes(),
            ["the header states", "not of the same run"],
        ),
        ("F", lambda content: b" 1E308" * 8 + content[128:], ["beyond any wind turbine"]),
        ("F", lambda content: b" inf" * 8 + content[128:], ["fx is inf (1 of 1201 samples"]),
    ],
)
def test_damaged_data(tmp_path, truth, form, change, words):
    # Warnings are errors in these tests: NumPy must not say anything before the paragraph.
    header = _run(tmp_path, truth, form)
    data = tmp_path / "demo.$23"
    data.write_bytes(change(data.read_bytes()))
    _message(header, *words)


@pytest.mark.parametrize(
    ("absent", "named", "words"),
    [
        ([".%23", ".%05"], ".$23", ["no header demo.%nn"]),
        ([".%23"], ".%05", ["Stationary hub Fx", "hub loads in the fixed frame"]),
        ([".$23"], ".%23", ["no demo.$23 beside the header"]),
    ],
)
def test_files_that_are_absent(tmp_path, truth, absent, named, words):
    _run(tmp_path, truth)
    for extension in absent:
        (tmp_path / f"demo{extension}").unlink()
    _message(tmp_path / f"demo{named}", *words)


def test_units_that_are_not_si(tmp_path, truth):
    header = _run(tmp_path, truth)
    header.write_text(header.read_text().replace("FL FL FL FL F F F F", "FL FL FL FL kF F F F"))
    _message(header, "unit code kF")


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("DIMENS\t8", "DIMENS\tx"),
        ("DIMENS\t8", "DIMENS\t9"),
        ("FORMAT\tR*4", "FORMAT\tI*2"),
        ("VARIAB\t", "VARIAX\t"),
        ("FORM\tU", "FORM\tX"),
        ("STEP\t5.0000000E-02", "STEP\tinf"),
        ("STEP\t5.0000000E-02", "STEP\t1E+308"),
        ("STEP\t5.0000000E-02", "STEP\t-0.05"),
        ("MIN \t0.0000000E+000", "MIN \tnan"),
        ("MEAN   ", "MEAN   nan "),
    ],
)
def test_a_damaged_header(tmp_path, truth, old, new):
    header = _run(tmp_path, truth)
    header.write_text(header.read_text().replace(old, new))
    _message(header, str(header), "run Bladed again")


def test_groups_with_different_steps(tmp_path, truth):
    header = _run(tmp_path, truth)
    drive = tmp_path / "demo.%05"
    drive.write_text(drive.read_text().replace("STEP\t5.0000000E-02", "STEP\t4.0000000E-02"))
    _message(header, "different time steps")


def _second_speed(folder, truth, number, step, name="Rotor speed"):
    """Another group with a rotor's speed, half of the true one, in steps [s]."""
    count = round(60.0 / step) + 1
    columns = np.column_stack([np.full(count, 1.0), np.zeros(count)])
    names, units = [name, "Electrical power"], ["A/T", "P"]
    return _group(folder, "demo", number, "Summary", names, units, columns, "U", step=step)


def test_of_two_speeds_that_at_the_steps_of_the_loads_is_taken(tmp_path, truth):
    header = _run(tmp_path, truth)
    _second_speed(tmp_path, truth, "04", step=1.0)
    read = HubLoads.read(header)
    np.testing.assert_allclose(read.shaft_speed, truth.shaft_speed, rtol=1e-6)
    assert read.reading[-1] == "shaft speed: Rotor speed of demo.%05"


def test_a_speed_at_other_steps_does_not_matter_where_it_is_given(tmp_path, truth):
    header = _run(tmp_path, truth, with_speed=False)
    _second_speed(tmp_path, truth, "04", step=1.0)
    _message(header, "demo.%04, have different time steps", "loads.shaft_speed")
    assert (HubLoads.read(header, shaft_speed=2.1).shaft_speed == 2.1).all()


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("FORMAT\tR*4", "FORMAT\tI*4"),
        ("'Electrical power'", "'Electrical power"),
        ("\t2\t", "\tx\t"),
    ],
)
def test_a_group_that_nobody_needs_may_be_of_another_kind(tmp_path, truth, old, new):
    header = _run(tmp_path, truth)
    other = _second_speed(tmp_path, truth, "04", step=1.0, name="Pitch rate")
    other.write_text(other.read_text().replace(old, new))
    np.testing.assert_allclose(HubLoads.read(header).force, truth.force, rtol=1e-6, atol=0.1)


@pytest.mark.parametrize("access", ["ACCESS\tS\n", "ACCESS\tD\n", ""])
def test_text_and_binary_data_under_a_header_of_text(tmp_path, truth, access):
    """Some versions write FORM F, text, above binary data with direct access, ACCESS D."""
    for form in ("F", "U"):
        header = _run(tmp_path, truth, form)
        for path in (header, tmp_path / "demo.%05"):
            text = path.read_text().replace("ACCESS\tD\n", access)
            path.write_text(text.replace("FORM\tU", "FORM\tF"))
        if form == "U" and access != "ACCESS\tD\n":
            _message(header, "numbers, its header announces")
        else:
            read = HubLoads.read(header)
            np.testing.assert_allclose(read.force, truth.force, rtol=1e-6, atol=0.1)


def test_a_header_with_blanks_behind_its_keys(tmp_path, truth):
    """Some versions part keys and numbers by blanks, others by a tab."""
    header = _run(tmp_path, truth)
    for path in (header, tmp_path / "demo.%05"):
        path.write_text(path.read_text().replace("\t", "  "))
    read = HubLoads.read(header)
    np.testing.assert_allclose(read.force, truth.force, rtol=1e-6, atol=0.1)
    np.testing.assert_allclose(read.shaft_speed, truth.shaft_speed, rtol=1e-6)


def test_keys_of_other_versions_and_a_label_with_a_line_break_of_its_encoding(tmp_path, truth):
    header = _run(tmp_path, truth)
    text = header.read_text(encoding="latin-1")
    text = text.replace("ACCESS\tD", "ACCESS\tD\nVERSION\t4.8 ")
    text = text.replace("fixed frame GL", "fixed frame\x85 GL")
    header.write_bytes(text.replace("NDIMENS\t2", "NDIMENS\t2\nPRECISION\t4").encode("latin-1"))
    np.testing.assert_allclose(HubLoads.read(header).force, truth.force, rtol=1e-6, atol=0.1)


def test_asterisks_in_text(tmp_path, truth):
    """They matter in channels that are taken: Stationary hub Myz is none of them, My is one."""
    header = _run(tmp_path, truth, form="F")
    data = tmp_path / "demo.$23"
    lines = data.read_text().splitlines()

    def write(column):
        words = lines[7].split()
        words[column] = "*" * 13
        data.write_text("\n".join([*lines[:7], " ".join(words), *lines[8:]]))

    write(3)
    words = header.read_text().split("MEAN")[1].split()
    header.write_text(header.read_text().replace(words[3], "*" * 13))
    np.testing.assert_allclose(HubLoads.read(header).moment, truth.moment, rtol=1e-6, atol=0.1)
    write(1)
    _message(header, "channel Stationary hub My holds '*************' (sample 8)")
