"""Study files: load histories, settings and samples, what they make, and what they are refused for."""

import itertools
import math
import os
from dataclasses import replace

import numpy as np
import openpyxl
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip import Bearing, InputError, Lubricant, read_study
from macroslip.case.case_file import read_case
from macroslip.study.loads_list import Load, Pattern, load_list
from macroslip.study.settings import Range, Sample, Setting, replaced, template
from macroslip.study.study_file import study_of


def write(folder, text):
    (folder / "study.yaml").write_text(text, encoding="utf-8")
    return folder / "study.yaml"


FULL = """
title: everything at once
case:
  rollers: [0]
  loads: {start: 0.1 s}
loads:
  files: runs/{wind_speed:g}mps_seed{seed:d}.csv
  kind: main-bearing
  units: {seed: "1"}
bearings: [skf-240-600-bc, own.yaml]
lubricants: vg460-pao
models:
  base: {}
  no drag: {forces.drag: false}
variations:
  grid:
    bearing.diametral_clearance: {values: [0.1, 0.2, 0.3], unit: mm}
  list:
    - {drivetrain.tilt: 4 deg}
    - {drivetrain.tilt: 5 deg, window.start: 0.5 s}
  sample: {method: sobol, count: 4, seed: 3, ranges: {integrator.tolerance: {low: 1e-5, high: 1e-3, scale: log}}}
"""


def test_runs_are_every_combination(load_files):
    from ruamel.yaml import YAML

    with (load_files / "own.yaml").open("w") as file:
        YAML(typ="safe").dump(Bearing.read("skf-240-600-bc").replace(name="own").as_dict(), file)
    study = read_study(write(load_files, FULL))
    runs = list(study.runs())
    assert len(study) == len(runs) == 4 * 2 * 1 * 2 * 3 * 2 * 4
    assert len({run.name for run in runs}) == len(runs)
    # Runs on the same loads follow each other.
    loads = [run.load.name for run in runs]
    assert len([1 for a, b in itertools.pairwise(loads) if a != b]) == 3
    labels = runs[-1].labels
    assert [labels[name] for name in ("wind_speed", "seed", "bearing", "model")] == [
        14.0,
        2,
        "own.yaml",
        "no drag",
    ]
    assert (
        labels["bearing.diametral_clearance"],
        labels["window.start"],
        labels["forces.drag"],
    ) == (0.3, 0.5, False)
    assert (
        study.labels["bearing.diametral_clearance"][0] == "mm"
        and study.labels["wind_speed"][0] == "m/s"
    )
    assert study.bearings["own.yaml"].name == "own"


@given(loads=st.integers(1, 200), settings=st.integers(1, 3))
def test_any_stretch_of_the_mixed_runs_is_a_sample_of_the_whole(loads, settings):
    """Every quarter of them has a mean rank near the middle, whose error is that of even points: of order 1/N."""
    tilts = [4.0 + 0.1 * number for number in range(settings)]
    study = study_of({"loads": {"bundled": ["14B"]}, "variations": {"grid": {"drivetrain.tilt": {
        "values": tilts, "unit": "deg"}}}})  # fmt: skip
    listed = replace(study.loads, loads=[Load(str(number), {}) for number in range(loads)])
    study = replace(study, loads=listed)
    ranks = [int(run.load.name) for run in study.mixed_runs()]
    assert sorted(run.name for run in study.mixed_runs()) == sorted(
        run.name for run in study.runs()
    )
    # Those with the same loads follow each other.
    assert all(
        len(set(ranks[start : start + settings])) == 1 for start in range(0, len(ranks), settings)
    )
    quarter = max(loads // 4, 1)
    means = np.convolve(ranks[::settings], np.full(quarter, 1.0 / quarter), mode="valid")
    # In their own order the first quarter would be 3/8 off.
    assert max(abs(means - (loads - 1) / 2.0)) / loads <= 2.0 / quarter


def test_names_of_runs_do_not_depend_on_the_order_or_on_fields(load_files, content):
    before = {run.name for run in study_of(content, load_files).runs()}
    renamed = content | {
        "loads": {
            "files": ["runs/14mps_seed{s:d}.csv", "runs/12mps_seed{s:d}.csv"],
            "kind": "main-bearing",
        }
    }
    assert {run.name for run in study_of(renamed, load_files).runs()} == before


def test_a_table_gives_files_and_fields(load_files):
    (load_files / "list.csv").write_text(
        "file,wind_speed,site,night\nruns/12mps_seed1.csv,12.5,north,true\nruns/14mps_seed2.csv,14,south,false\n"
    )
    study = read_study(
        write(
            load_files, "loads: {table: list.csv, kind: main-bearing, units: {wind_speed: m/s}}\n"
        )
    )
    assert [run.labels["wind_speed"] for run in study.runs()] == [12.5, 14.0]
    assert next(study.runs()).load.fields == {"wind_speed": 12.5, "site": "north", "night": True}


def test_a_sheet_of_a_workbook_gives_files_and_fields(load_files):
    book = openpyxl.Workbook()
    book.active.append(["only words"])
    sheet = book.create_sheet("runs")
    for row in (
        ["file", "wind_speed", "seed", "site"],
        ["runs/12mps_seed1.csv", 12.5, 1, "north"],
        ["runs/14mps_seed2.csv", 14, 2, "south"],
    ):
        sheet.append(row)
    book.save(load_files / "list.xlsx")
    text = "loads: {table: list.xlsx, sheet: runs, kind: main-bearing, units: {wind_speed: m/s}}\n"
    loads = read_study(write(load_files, text)).loads.loads
    assert [load.name for load in loads] == ["runs/12mps_seed1.csv", "runs/14mps_seed2.csv"]
    # A column with a fraction is one of fractions, as of a CSV table.
    assert [repr(load.fields["wind_speed"]) for load in loads] == ["12.5", "14.0"]
    assert [repr(load.fields["seed"]) for load in loads] == ["1", "2"]
    for wrong, message in (("other", "no sheet 'other'"), ("''", "no column 'file'")):
        if wrong == "''":
            text = "loads: {table: list.xlsx, kind: main-bearing}\n"
        with pytest.raises(InputError, match=message):
            read_study(write(load_files, text.replace("sheet: runs", f"sheet: {wrong}")))


AXIS = "loads: {bundled: all}\nvariations:\n  grid: {drivetrain.tilt: "


@pytest.mark.parametrize(
    ("text", "messages"),
    [
        ("loads: {bundled: all}\nvariation: {}\n", ["line 2", "Did you mean 'variations'"]),
        ("case: {rollers: [0]}\n", ["'loads' is missing"]),
        ("loads: {bundled: 99Z}\n", ["line 1", "no bundled case '99Z'"]),
        ("loads: {bundled: all, sheet: x}\n", ["sheet 'x' is named without a table"]),
        ("loads: {bundled: all, files: x.csv}\n", ["(bundled and files|files and bundled) stand together"]),
        ("loads: {files: 'nothing{seed:d}.csv'}\n", ["no file fits the pattern", "Relative paths start at"]),
        ("loads: {files: '{load}.csv'}\n", ["no file fits|a field is called 'load'"]),
        ("loads: {bundled: all}\ncase:\n  loads:\n    bundled: 14B\n", ["line 4", "'bundled' cannot stand here"]),
        ("loads: {bundled: all}\ncase:\n  drivetrain:\n    tilt: 50 deg\n", ["line 4", "drivetrain.tilt", "50 deg"]),
        ("loads: {bundled: all}\ncase:\n  rolers: all\n", ["line 3", "Did you mean 'rollers'"]),
        ("loads: {bundled: all}\nbearings: [skf-240-600]\n", ["bearings", "skf-240-600"]),
        ("loads: {bundled: all}\nbearings: [a, a]\n", ["different texts"]),
        ("loads: {bundled: all}\nmodels:\n  new: {laws.film: odd}\n", ["line 3", "models.new.laws.film", "odd"]),
        ("loads: {bundled: all}\nvariations:\n  grid:\n    drivetrain.tilt: [1, 2]\n", ["line 4", "values"]),
        (AXIS + "{values: [1, 1], unit: deg}}\n", ["stands twice"]),
        (AXIS + "{values: [1], unit: deg, to: 3}}\n", ["'to'"]),
        ("loads: {bundled: all}\nvariations: {list: [{drivetrain.tilt: 1 deg}, {drivetrain.tilt: 1 rad}]}\n", ["one unit"]),
        (AXIS + "{values: [1], unit: deg}}\n  list: [{drivetrain.tilt: 1 deg}]\n", ["varied in (grid|list)", "one place"]),
        ("loads: {bundled: all}\nvariations:\n  sample: {method: sobol, count: 5, seed: 1, ranges: "
         "{drivetrain.tilt: {low: 1, high: 2, unit: deg}}}\n", ["power of 2"]),
        ("loads: {bundled: all}\nvariations:\n  sample: {count: 5, seed: 1}\n", ["ranges' is missing"]),
        ("loads: {bundled: all, units: {size: m}}\n", ["units names size"]),
        ("loads: {bundled: all}\nkeep: [energy, enrgy]\n", ["line 2", "keep", "'enrgy'", "orbit_energy"]),
        ("loads: [1]\n", ["it is \\[1\\]"]), ("- 1\n", ["a mapping"]),
        ("loads: {bundled: 99Z}\ncase: {rollers: some}\nvariations: {grid: {forces.drg: {values: [true]}}}\n",
         ["3 problems"]),
    ],
)  # fmt: skip
def test_mistakes_are_reported_with_their_place(tmp_path, text, messages):
    with pytest.raises(InputError) as caught:
        read_study(write(tmp_path, text))
    for message in messages:
        assert caught.match(message)
    assert str(tmp_path) in str(caught.value)


def test_a_case_file_is_reported_from_a_study(tmp_path):
    with pytest.raises(
        InputError,
        match=r"the keys bearing, laws are those of a case\. .*macroslip run; .*key case",
    ):
        read_study(
            write(
                tmp_path, "bearing: skf-240-600-bc\nloads: {bundled: 14B}\nlaws: {model: paper}\n"
            )
        )
    with pytest.raises(
        InputError, match="this is a study file, not a case file. Run it by macroslip study"
    ):
        read_case(write(tmp_path, "case: {rollers: [0]}\nloads: {bundled: [14B]}\n"))


@pytest.mark.parametrize(
    "text",
    ["loads: !!python/object/apply:os.system ['touch made']\n", "loads: {files: !include x}\n"],
)
def test_a_study_file_is_data(tmp_path, monkeypatch, text):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError):
        read_study(write(tmp_path, text))
    assert not (tmp_path / "made").exists()


def test_files_whose_fields_cannot_be_read_are_reported(load_files, content):
    (load_files / "runs" / "12mps_seedX.csv").touch()
    study = study_of(content, load_files)
    assert (
        len(study) == 4
        and "1 files" in study.loads.remarks[0]
        and "12mps_seedX.csv" in study.loads.remarks[0]
    )


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("loads: {files: .}\n", ["line 1", "'.' is a folder", "runs/*.outb"]),
        ('loads: {files: "a\\0{seed:d}.csv"}\n', ["loads.files", "zero byte"]),
        ("loads: {files: 's{seed:d}.csv'}\n", ["the field seed of s99999999999999999999.csv", "9007199254740992"]),
        ("loads: {bundled: 14B}\nvariations:\n  sample: {count: 1e18, seed: 1, ranges: {drivetrain.tilt: {low: 1, high: "
         "2, unit: deg}}}\n", ["variations.sample.count: it is 1e+18. Allowed: a whole number, 1 to 1e7."]),
        ("loads: {bundled: 14B}\nvariations:\n  sample: {count: 4, seed: 1, ranges: {drivetrain.tilt: {low: a, hgh: 2}}}\n",
         ["2 problems", "Did you mean 'high'?", "ranges.drivetrain.tilt.low: it is 'a'. Allowed: a number without unit."]),
    ],
)  # fmt: skip
def test_hostile_values_are_refused_in_one_paragraph(tmp_path, text, words):
    (tmp_path / "s99999999999999999999.csv").touch()
    with pytest.raises(InputError) as caught:
        read_study(write(tmp_path, text))
    message = str(caught.value)
    assert "\n" not in message and [word for word in words if word not in message] == []


WORDS = st.text("abcXYZ-_. ", min_size=1, max_size=8).filter(lambda text: text.strip(". ") == text)


@given(st.floats(-1e3, 1e3, allow_nan=False), st.integers(0, 10**6), WORDS)
def test_what_was_written_into_a_name_is_read_from_it(speed, seed, site):
    name = f"{site}/dlc12_{speed!r}mps_seed{seed}.outb"
    fields = Pattern("{site}/dlc12_{wind_speed:g}mps_seed{seed:d}.outb").fields_of(name)
    assert fields == {"site": site, "wind_speed": speed, "seed": seed}


@pytest.mark.parametrize(
    ("pattern", "name", "fields"),
    [
        ("s{seed:d}.csv", "s0x12.csv", None),
        ("s{seed:d}.csv", "s0b11.csv", None),
        ("s{seed:d}.csv", "s 1.csv", None),
        ("s{seed:d}.csv", "s1.0.csv", None),
        ("v{speed:g}.csv", "vnan.csv", None),
        ("v{speed:g}.csv", "vinf.csv", None),
        ("v{speed:g}.csv", "v .5.csv", None),
        ("v{speed:g}.csv", "v.5.csv", {"speed": 0.5}),
        ("v{speed:g}.csv", "v1e1.csv", {"speed": 10.0}),
        ("s{_seed:d}.csv", "s007.csv", {"_seed": 7}),
    ],
)
def test_a_number_is_plain_decimal_digits(pattern, name, fields):
    """As one would read it; libraries that read formats take hexadecimal numbers, blanks and NaN as well."""
    assert Pattern(pattern).fields_of(name) == fields


def test_a_field_that_stands_twice_has_one_value():
    pattern = Pattern("seed{seed:d}/run_{seed:d}.outb")
    assert pattern.fields_of("seed3/run_3.outb") == {"seed": 3}
    assert pattern.fields_of("seed3/run_4.outb") is None


def test_files_are_found_in_folders_and_above(tmp_path):
    for name in ("a/s1.csv", "a/b/s2.csv", "a/sX.csv", "c[1]/s3.csv", "c1/s4.csv"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    files, unread = Pattern("./a/**/s{seed:d}.csv").files(tmp_path)
    assert files == [("a/b/s2.csv", {"seed": 2}), ("a/s1.csv", {"seed": 1})] and unread == [
        "a/sX.csv"
    ]
    assert Pattern("c[1]/s{seed:d}.csv").files(tmp_path)[0] == [("c[1]/s3.csv", {"seed": 3})]
    assert Pattern("../a/s1.csv").files(tmp_path / "c1")[0] == [("../a/s1.csv", {})]
    absolute = (tmp_path / "a").as_posix() + "/s{seed:d}.csv"
    assert Pattern(absolute).files(tmp_path / "c1")[0] == [
        ((tmp_path / "a/s1.csv").as_posix(), {"seed": 1})
    ]


@pytest.mark.parametrize(
    "text", ["runs/a**.csv", "runs/{a}{b}.csv", "runs/***.csv", "{a}{b}/a*.csv", "r*{a}/**/a*.csv"]
)
def test_wildcards_beside_each_other_are_one(tmp_path, text):
    (tmp_path / "runs" / "in").mkdir(parents=True)
    for name in ("runs/ab1.csv", "runs/in/ab2.csv"):
        (tmp_path / name).touch()
    files, unread = Pattern(text).files(tmp_path)
    both = ["runs/ab1.csv", "runs/in/ab2.csv"]
    assert [name for name, _ in files] == (
        sorted(both) if "**/" in text else both[:1]
    ) and unread == []


def test_folders_within_a_name_are_refused():
    with pytest.raises(InputError, match=r"not the whole name of a folder. Write runs/\*\*/"):
        Pattern("runs/a**/b.csv")


@pytest.mark.skipif(os.name != "posix", reason="other systems have no such names")
def test_a_name_that_is_no_text_is_refused(tmp_path):
    try:
        (tmp_path / os.fsdecode(b"a\xff.csv")).touch()
    except OSError:
        pytest.skip("this file system takes text only")
    with pytest.raises(InputError, match=r"a\\udcff.csv is not UTF-8. Rename it"):
        load_list(tmp_path, kind="hub", files=["*.csv"])


@pytest.mark.parametrize(
    "text", ["{seed:x}.csv", "{}.csv", "{2nd:d}.csv", "{seed.csv", "{a.b}.csv", "{seed:d:d}"]
)
def test_wrong_fields_are_refused(text):
    with pytest.raises(InputError, match="is no field"):
        Pattern(text)


@pytest.mark.parametrize("text", [".", "/", "runs", "./runs", "runs/.."])
def test_a_folder_is_no_pattern(tmp_path, text):
    (tmp_path / "runs").mkdir()
    with pytest.raises(InputError, match="is a folder.*Name the files in it"):
        Pattern(text).files(tmp_path)


RANGES = {
    "drivetrain.tilt": Range(2.0, 6.0, "deg"),
    "integrator.tolerance": Range(1e-6, 1e-2, "", "log"),
}


@pytest.mark.parametrize(("method", "count"), [("latin-hypercube", 12), ("sobol", 16)])
def test_every_parameter_is_spread_evenly(method, count):
    points = Sample(method=method, count=count, seed=7, ranges=RANGES).points()
    for column, position in (
        (0, lambda x: (x - 2.0) / 4.0),
        (1, lambda x: (math.log10(x) + 6.0) / 4.0),
    ):
        positions = np.array([position(point[column].value) for point in points])
        # One point in each of as many equal parts.
        assert sorted(np.floor(positions * count).astype(int)) == list(range(count))


def test_the_seed_decides():
    first, same, other = (
        Sample(method="latin-hypercube", count=5, seed=seed, ranges=RANGES).points()
        for seed in (1, 1, 2)
    )
    assert first == same and first != other


def test_wrong_samples_are_refused():
    with pytest.raises(InputError, match="Take 8 or 16"):
        Sample(method="sobol", count=12, seed=1, ranges=RANGES)
    with pytest.raises(InputError, match="sample.count: it is 0"):
        Sample(method="sobol", count=0, seed=1, ranges=RANGES)
    with pytest.raises(InputError, match="sample.seed: it is -1"):
        Sample(method="sobol", count=8, seed=-1, ranges=RANGES)
    with pytest.raises(InputError, match="low below high"):
        Range(1.0, 1.0)
    with pytest.raises(InputError, match="logarithmic"):
        Range(0.0, 1.0, "", "log")


def test_a_range_may_be_that_of_the_file(tmp_path):
    content = {
        "case": {"laws": {"model": "paper"}, "bearing": "skf-240-630-bc", "rollers": [0]},
        "loads": {"bundled": ["14B"]},
        "variations": {"sample": {"count": 16, "seed": 3, "ranges": {
            "bearing.roller_length": "range", "drivetrain.tilt": {"low": 4, "high": 6, "unit": "deg"}}}},
    }  # fmt: skip
    study = study_of(content, tmp_path)
    low, high = Bearing.read("skf-240-630-bc").provenance["roller_length"].range
    lengths = sorted(run.labels["bearing.roller_length"] for run in study.runs())
    assert study.parameters["bearing.roller_length"] == "mm"
    assert low <= lengths[0] < lengths[-1] <= high
    # A Latin hypercube of 16 points has one in each sixteenth.
    sixteenths = [int((length - low) / (high - low) * 16) for length in lengths]
    assert sixteenths == list(range(16))


@pytest.mark.parametrize(
    ("key", "bearings", "message"),
    [
        ("bearing.width", ["skf-240-630-bc"], "skf-240-630-bc has no range for width"),
        (
            "bearing.rollers_per_row",
            ["skf-240-630-bc"],
            "rollers_per_row is a count.*variations.grid",
        ),
        ("bearing.roller_length", ["skf-240-630-bc", "skf-240-600-bc"], "has 2 of them"),
        ("drivetrain.tilt", ["skf-240-630-bc"], "no value of a bearing or lubricant"),
        ("bearing.roller_lenght", ["skf-240-630-bc"], "Did you mean 'bearing.roller_length'"),
    ],
)
def test_a_range_that_no_file_has(tmp_path, key, bearings, message):
    content = {
        "loads": {"bundled": ["14B"]},
        "bearings": bearings,
        "variations": {"sample": {"count": 2, "seed": 3, "ranges": {key: "range"}}},
    }
    with pytest.raises(InputError, match=message):
        study_of(content, tmp_path)


def check(key, value, unit=""):
    Setting(key, value, unit).checked()


@pytest.mark.parametrize(
    ("key", "value", "unit"),
    [
        ("bearing.diametral_clearance", 0.2, "mm"), ("bearing.rollers_per_row", 27, ""), ("drivetrain.tilt", 4, "deg"),
        ("forces.drag", False, ""), ("integrator.tolerance", 1e-4, ""), ("integrator.step", 1.0, "ms"),
        ("laws.film", "masjedi-khonsari", ""), ("window.start", "auto", ""), ("traces", "none", ""),
        ("rollers", [0, 1], ""), ("lubricant.at", 50, "degC"),
    ],
)  # fmt: skip
def test_what_a_case_file_takes_is_taken(key, value, unit):
    check(key, value, unit)


@pytest.mark.parametrize(
    ("key", "value", "unit", "message"),
    [
        ("bearing.diametral_clearence", 0.2, "mm", "Did you mean 'bearing.diametral_clearance'"),
        ("bearing.diametral_clearance", 0.2, "", "unit"),
        ("bearing.diametral_clearance", "wide", "", "a number with its unit"),
        ("bearing.diametral_clearance", 0.2, "kg", "unit"),
        ("lubricant.at", 50, "mm", "unit"),
        ("bearing", "other", "", "its own key in a study: bearings"),
        ("loads.start", 3.0, "s", "its own key in a study: loads"),
        ("drivetrain.tlt", 4, "deg", "Did you mean 'drivetrain.tilt'"),
        ("drivetrain.tilt", 4, "", "does not give its unit"),
        ("drivetrain", 4, "", "unknown"),
        ("forces.drag", "no", "", "true or false"),
        ("forces.drag", True, "N", "without unit"),
        ("laws.film", "unheard-of", "", "does not exist"),
    ],
)
def test_what_it_does_not_take_is_refused_in_its_words(key, value, unit, message):
    with pytest.raises(InputError, match=message):
        check(key, value, unit)


def test_a_unit_that_does_not_exist_is_refused_with_its_place():
    grid = {"bearing.diametral_clearance": {"values": [0.1, 0.2], "unit": "kg"}}
    with pytest.raises(
        InputError,
        match=r"variations\.grid\.bearing\.diametral_clearance: unit 'kg' does not exist",
    ):
        study_of({"loads": {"bundled": ["14B"]}, "variations": {"grid": grid}})


def test_a_replaced_value_is_the_users_and_the_others_keep_their_origin():
    before = Lubricant.read("vg460-pao")
    key = next(key for key, origin in before.provenance.items() if origin.unit != "degC")
    entry = before.as_dict()[key]
    after = replaced(before, [Setting(f"lubricant.{key}", entry["value"] * 1.01, entry["unit"])])
    assert (
        getattr(after, key) == pytest.approx(1.01 * getattr(before, key))
        and after.provenance[key].tag == "U"
    )
    others = {name: origin for name, origin in before.provenance.items() if name != key}
    assert {name: origin for name, origin in after.provenance.items() if name != key} == others
    assert replaced(before, [Setting("bearing.diametral_clearance", 1, "mm")]) == before


def test_settings_reach_the_case():
    settings = [
        Setting("bearing.diametral_clearance", 0.1, "mm"),
        Setting("drivetrain.tilt", 4.0, "deg"),
        Setting("integrator.tolerance", 1e-5),
        Setting("forces.drag", False),
        Setting("traces.step", 0.1, "s"),
    ]
    case, cut = template({"loads": {"end": "3 s"}, "traces": "none"}, settings, {})
    assert (case.bearing.diametral_clearance, case.drivetrain.tilt) == (
        1e-4,
        pytest.approx(0.0698, abs=1e-4),
    )
    assert (case.integrator.tolerance, case.drag, case.traces.step, cut) == (
        1e-5,
        False,
        0.1,
        {"end": 3.0},
    )


def test_values_that_do_not_go_together_are_reported():
    with pytest.raises(InputError, match="rollers"):
        template({}, [Setting("bearing.rollers_per_row", 60)], {})


def test_a_lubricant_at_another_temperature_has_what_follows_from_it():
    before = Lubricant.read("vg460-pao")
    settings = [Setting("lubricant.at", 50.0, "degC"), Setting("lubricant.limiting_shear", 0.05)]
    after = replaced(before, settings)
    warm = before.at("50 degC")
    assert (after.viscosity, after.pressure_viscosity) == (warm.viscosity, warm.pressure_viscosity)
    assert after.limiting_shear == 0.05 and after.viscosity < before.viscosity
    alone = replaced(before, [Setting("lubricant.inlet_temperature", 50.0, "degC")])
    assert (alone.inlet_temperature, alone.viscosity) == (323.15, before.viscosity)
