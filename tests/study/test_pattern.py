"""Fields from file names."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip import InputError
from macroslip.study.pattern import Pattern

words = st.text("abcXYZ-_. ", min_size=1, max_size=8).filter(lambda text: text.strip(". ") == text)


@given(st.floats(-1e3, 1e3, allow_nan=False), st.integers(0, 10**6), words)
def test_what_was_written_into_a_name_is_read_from_it(speed, seed, site):
    name = f"{site}/dlc12_{speed!r}mps_seed{seed}.outb"
    found = Pattern("{site}/dlc12_{wind_speed:g}mps_seed{seed:d}.outb").fields_of(name)
    assert found == {"site": site, "wind_speed": speed, "seed": seed}


def test_other_names_do_not_fit():
    pattern = Pattern("{wind_speed:g}mps_seed{seed:d}.outb")
    for name in (
        "12mps_seedA.outb",
        "12mps_seed1.out",
        "x12mps_seed1.outb",
        "12mps_seed1.outb.bak",
        "12mps_seed1xoutb",
    ):
        assert pattern.fields_of(name) is None


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
    found, unread = Pattern("./a/**/s{seed:d}.csv").files(tmp_path)
    assert found == [("a/b/s2.csv", {"seed": 2}), ("a/s1.csv", {"seed": 1})] and unread == ["a/sX.csv"]
    assert Pattern("c[1]/s{seed:d}.csv").files(tmp_path)[0] == [("c[1]/s3.csv", {"seed": 3})]
    assert Pattern("../a/s1.csv").files(tmp_path / "c1")[0] == [("../a/s1.csv", {})]
    absolute = (tmp_path / "a").as_posix() + "/s{seed:d}.csv"
    assert Pattern(absolute).files(tmp_path / "c1")[0] == [((tmp_path / "a/s1.csv").as_posix(), {"seed": 1})]


@pytest.mark.parametrize("text", ["{seed:x}.csv", "{}.csv", "{2nd:d}.csv", "{seed.csv", "{a.b}.csv", "{seed:d:d}"])
def test_wrong_fields_are_refused(text):
    with pytest.raises(InputError, match="is no field"):
        Pattern(text)


@pytest.mark.parametrize("text", [".", "/", "runs", "./runs", "runs/.."])
def test_a_folder_is_no_pattern(tmp_path, text):
    (tmp_path / "runs").mkdir()
    with pytest.raises(InputError, match="is a folder.*Name the files in it"):
        Pattern(text).files(tmp_path)
