"""`macroslip init` writes a case file that runs, and whose every key is explained."""

import pytest
from ruamel.yaml import YAML

from macroslip.case.case import Case
from macroslip.input.section import keys_of

pytestmark = pytest.mark.slow


def test_init_then_run(folder, macroslip):
    done = macroslip("init")
    assert (done.code, done.err) == (0, "")
    assert done.out == "written:    case.yaml\nrun it:     macroslip run case.yaml -o case.nc\n"
    done = macroslip("run", "case.yaml", "-o", "case.nc")
    assert (done.code, done.err) == (0, "")
    assert (
        "bundled case 14B, model physical, vg460-pao at 35 °C, from 6.40203 s to 60 s, 8 complete orbits"
        in done.out
    )


def test_init_keeps_an_existing_file_unless_forced(folder, macroslip):
    (folder / "mine.yaml").write_text("precious")
    done = macroslip("init", "mine.yaml")
    assert done.code == 2
    assert (
        done.err
        == "error: mine.yaml: the file exists. Choose another name, or replace it with --force.\n"
    )
    assert (folder / "mine.yaml").read_text() == "precious"
    assert macroslip("init", "mine.yaml", "--force").code == 0
    assert "loads:" in (folder / "mine.yaml").read_text()
    assert [path.name for path in folder.iterdir()] == ["mine.yaml"]


def test_the_template_shows_every_key_with_a_comment_above(folder, macroslip):
    macroslip("init")
    lines = (folder / "case.yaml").read_text().splitlines()

    for key in {name.rpartition(".")[2] for name, _ in keys_of(Case)}:
        places = [n for n, line in enumerate(lines) if line.lstrip(" #").startswith(f"{key}:")]
        assert places, f"{key} is not in the template"
        explained = (
            line
            for n in places
            for line in reversed(lines[:n])
            if not line.lstrip(" #").startswith("force:")
        )
        assert any(line.lstrip().startswith("#") for line in explained), f"{key} has no comment"


def test_the_values_of_the_template_are_the_defaults(folder, macroslip):
    from macroslip import Case, HubLoads
    from macroslip.case.case_file import read_case

    macroslip("init")
    case = read_case("case.yaml").as_dict()
    plain = Case(loads=HubLoads.bundled("14B").window(0.0, 60.0)).as_dict()
    # The shaft's mass is an estimate for the rotor of the load cases, and marked as such; by default there is none.
    assert case["drivetrain"].pop("shaft_mass") == pytest.approx(0.0142 * 70.0**2.888, rel=1e-3)
    assert case["drivetrain"].pop("shaft_mass_station") == pytest.approx(0.5 * (1.26 + 2.2))
    assert (
        plain["drivetrain"].pop("shaft_mass")
        == plain["drivetrain"].pop("shaft_mass_station")
        == 0.0
    )
    assert case == plain


def test_who_changes_only_the_loads_of_the_template_has_a_case(folder, macroslip):
    """Nothing else in it may depend on how long the loads are."""
    from macroslip import read_case

    macroslip("init")
    text = (folder / "case.yaml").read_text()
    old = "  start: 0 s\n  end: 60 s\n"
    assert text.count(old) == 1
    (folder / "case.yaml").write_text(text.replace(old, "  start: 60 s\n  end: 90 s\n"))
    case = read_case("case.yaml")
    assert case.loads.time[[0, -1]].tolist() == [60.0, 90.0] and case.window.end is None


def test_what_the_template_comments_out_is_right_too(folder, macroslip):
    """Each alternative has to run the moment its comment signs are taken away."""
    from macroslip import Cage
    from macroslip.case.case_file import read_case

    macroslip("init")
    text = (folder / "case.yaml").read_text()
    data = YAML(typ="safe", pure=True).load(text)
    for start in ("  # hub:\n", "  # main_bearing:\n"):
        block = text[text.index(start) :].split("\n\n")[0]
        uncommented = "loads:\n" + block.replace("  # ", "  ", 1).replace("\n  # ", "\n  ")
        (folder / "one.yaml").write_text(uncommented)
        read_case("one.yaml")
    for start in (
        "# integrator:\n#   method: backward",
        "# integrator:\n#   method: explicit",
        "# traces:\n",
    ):
        block = text[text.index(start) :].split("\n\n")[0]
        block = (
            block if block.count("# integrator:") < 2 else block[: block.rindex("# integrator:")]
        )
        uncommented = "\n".join(
            line.removeprefix("# ").removeprefix("#") for line in block.splitlines()
        )
        (folder / "one.yaml").write_text("loads: {bundled: 14B}\n" + uncommented + "\n")
        read_case("one.yaml")
    cage = text[text.index("# cage:\n") :].split("\n\n")[0].replace("\n# ", "\n").removeprefix("# ")
    (folder / "one.yaml").write_text(f"loads: {{bundled: 14B}}\ndynamics: whole-bearing\n{cage}\n")
    assert read_case("one.yaml").cage == Cage()
    assert data["loads"] == {"bundled": "14B", "start": "0 s", "end": "60 s"}


def test_every_other_example_does_what_its_last_line_proposes(folder, macroslip):
    """The line is run as printed, in the folder it was printed in."""
    written = {
        "study": ["study.yaml"],
        "bearing": ["bearing.yaml"],
        "lubricant": ["lubricant.yaml"],
        "laws": ["own_laws.yaml", "own_film.py", "own_law.py"],
    }
    for example, files in written.items():
        done = macroslip("init", "--example", example)
        assert (done.code, done.err) == (0, "")
        assert [
            line.split()[1] for line in done.out.splitlines() if line.startswith("written:")
        ] == files
        assert all((folder / name).is_file() for name in files)
    assert macroslip("bearing", "show", "bearing.yaml").code == 0
    assert macroslip("lubricant", "show", "lubricant.yaml").code == 0
    assert macroslip("study", "study.yaml", "--dry-run").out.startswith(
        "Clearance of the base bearing"
    )


def test_an_example_replaces_nothing(folder, macroslip):
    (folder / "own_law.py").write_text("precious")
    done = macroslip("init", "--example", "laws")
    assert done.code == 2 and "own_law.py: the file exists" in done.err
    assert [path.name for path in folder.iterdir()] == ["own_law.py"]


def test_the_case_of_a_turbine(folder, macroslip):
    from macroslip import Turbine, read_case

    for name in Turbine.catalogue():
        done = macroslip("init", f"{name}.yaml", "--turbine", name)
        assert (done.code, done.err) == (0, "")
        assert done.out.splitlines()[0] == f"written:    {name}.yaml"
        assert read_case(f"{name}.yaml").bearing.name == Turbine.read(name).bearing


def test_a_turbine_and_an_example_are_two_different_files(folder, macroslip):
    done = macroslip("init", "--turbine", "nrel5", "--example", "study")
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        "error: --turbine nrel5 and --example study ask for two different files. Allowed: one of them. "
        "--turbine writes a case of that turbine; leave --example out for it.\n"
    )
    assert not list(folder.iterdir())


def test_a_turbine_that_does_not_exist(folder, macroslip):
    done = macroslip("init", "--turbine", "nrel15")
    assert (done.code, done.out) == (2, "")
    assert "no turbine can be read from 'nrel15'" in done.err
    assert "nrel5, nrel5-rear, windpact1.5" in done.err and not list(folder.iterdir())


def test_the_example_of_ten_minute_means_has_its_record_and_its_study(folder, macroslip):
    from macroslip import Scada, read_study

    done = macroslip("init", "--example", "scada")
    assert (done.code, done.err) == (0, "")
    assert sorted(path.name for path in folder.iterdir()) == [
        "scada.csv.gz",
        "scada.yaml",
        "scada_study.yaml",
    ]
    assert len(Scada.read("scada.yaml").data) == 52_560
    assert len(read_study("scada_study.yaml")) == 28
    text = (folder / "scada_study.yaml").read_text()
    (folder / "weighted.yaml").write_text(text.replace("# weights:", "weights:"))
    weights = read_study("weighted.yaml").content["weights"]
    assert sum(map(sum, weights["scada"]["turning"])) + sum(weights["scada"]["idle"]) == (
        pytest.approx(1.0)
    )
