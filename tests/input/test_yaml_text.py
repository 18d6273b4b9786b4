"""A record written as a catalogue file, and read again."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip import Bearing, Lubricant
from macroslip.input.files import parse

RECORDS = [(kind, name) for kind in (Bearing, Lubricant) for name in kind.catalogue()]
TEXT = st.text(
    st.characters(
        exclude_categories=("Cc", "Cs", "Zl", "Zp"), exclude_characters="\ufeff\ufffe\uffff"
    ),
    max_size=80,
)


@pytest.mark.parametrize(("kind", "name"), RECORDS)
def test_a_shipped_record_written_and_read_is_the_same(kind, name, tmp_path):
    record = kind.read(name)
    (tmp_path / "mine.yaml").write_text(record.as_yaml(), encoding="utf-8")
    again = kind.read(tmp_path / "mine.yaml")
    assert again == record and again.provenance == record.provenance
    assert again.as_yaml() == record.as_yaml()


def test_every_key_is_explained_in_the_line_above_it():
    base = Bearing.read("skf-240-600-bc")
    lines = base.as_yaml().splitlines()
    keys = {line.partition(":")[0]: n for n, line in enumerate(lines) if line and line[0].isalpha()}
    assert list(keys) == list(base.as_dict())
    assert all(lines[n - 1].startswith("# ") for n in keys.values())
    assert max(len(line) for line in lines if line.startswith("#")) <= 120
    assert (
        'rollers_per_row: {value: 28, unit: "1", tag: E, note: "back-calculated from the catalogue"}'
        in lines
    )


@pytest.mark.slow
@settings(deadline=None)
@given(
    value=st.floats(1e-3, 100.0), note=TEXT, title=TEXT,
    spread=st.none() | st.tuples(st.floats(1e-9, 1.0), st.floats(1.0, 10.0)),
)  # fmt: skip
def test_any_number_note_title_and_range_survive(value, note, title, spread):
    entries = Lubricant.read("vg460-pao").as_dict()
    viscosity = {"value": value, "unit": "Pa s", "tag": "E", "note": note}
    if spread:
        viscosity["range"] = [value * spread[0], value * spread[1]]
    lubricant = Lubricant.from_dict(entries | {"title": title, "viscosity": viscosity})
    data, _ = parse(lubricant.as_yaml(), "mine.yaml")
    assert Lubricant.from_dict(data) == lubricant
    assert lubricant.as_dict()["viscosity"] == viscosity
