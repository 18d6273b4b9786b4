"""Entries of catalogue files: text with a unit, mappings, ranges."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip import Bearing
from macroslip.errors import InputError
from macroslip.input.files import Source
from macroslip.input.record import Provenance, read_entry
from macroslip.input.units import INVERSE_PRESSURE, LENGTH, MASS, NUMBER, TEMPERATURE
from tests.records import values_of

SOURCE = Source("mine.yaml", {("bore",): 3, ("bore", "range"): 4})


@pytest.mark.parametrize(
    ("entry", "dimension", "si_value", "value", "unit"),
    [
        ("75 mm", LENGTH, 0.075, 75, "mm"),
        ("75mm", LENGTH, 0.075, 75, "mm"),
        (" 7.5e1  mm ", LENGTH, 0.075, 75.0, "mm"),
        ("50 degC", TEMPERATURE, 323.15, 50, "degC"),
        ("323 K", TEMPERATURE, 323.0, 323, "K"),
        ("-5 degC", TEMPERATURE, 268.15, -5, "degC"),
        ("21 1/GPa", INVERSE_PRESSURE, 21e-9, 21, "1/GPa"),
        ("28", NUMBER, 28, 28, "1"),
        (28, NUMBER, 28, 28, "1"),
        (0.98, NUMBER, 0.98, 0.98, "1"),
    ],
)
def test_a_quantity_may_be_text(entry, dimension, si_value, value, unit):
    read, origin = read_entry("bore", entry, dimension, SOURCE)
    assert (read, origin) == (si_value, Provenance(value, unit, "U", "", None))
    assert type(origin.value) is type(value)


@given(st.floats(allow_nan=False, allow_infinity=False, min_value=-1e300, max_value=1e300))
def test_text_and_mapping_give_the_same(value):
    assert (
        read_entry("bore", f"{value!r} mm", LENGTH, SOURCE)[0]
        == (read_entry("bore", {"value": value, "unit": "mm"}, LENGTH, SOURCE)[0])
    )


@pytest.mark.parametrize(
    ("entry", "dimension", "message"),
    [
        ("75", LENGTH, "it is .75., which does not give its unit. Allowed: .* Write 75 m or 75 mm or 75 um, whichever it is."),
        ("75 inch", LENGTH, "it is '75 inch', which has the unit 'inch'. Allowed: a number with its unit, m or mm or um. Convert"),
        ("7,5 mm", LENGTH, "it is '7,5 mm', which is not a quantity. Allowed: .* Use a decimal point"),
        ("wide", LENGTH, "it is 'wide', which is not a quantity. .* Write 1 m, for example."),
        ("7.5.1 mm", LENGTH, "it is '7.5.1 mm', which is not a quantity."),
        ("7 5 mm", LENGTH, "it is '7 5 mm', which has the unit '5 mm'."),
        ("nan mm", LENGTH, "it is 'nan mm', which is not a quantity."),
        ("1e400 kg", MASS, "it is '1e400 kg', which is too large for a number"),
        ("0.98 mm", NUMBER, "it is '0.98 mm', which has the unit 'mm'. Allowed: a number. Write the number alone."),
        (75, LENGTH, "it is 75, which does not give its unit. Allowed: bore: 1 m; or bore: {value: a number, unit"),
        (True, NUMBER, "it is True, which is no quantity. Allowed: bore: 1; or bore: {value"),
    ],
)  # fmt: skip
def test_wrong_text_is_refused_in_one_paragraph(entry, dimension, message):
    with pytest.raises(InputError, match=f"^mine.yaml, line 3, bore: {message}") as caught:
        read_entry("bore", entry, dimension, SOURCE)
    assert "\n" not in str(caught.value)


def test_a_range_goes_with_the_value():
    entry = {"value": 70, "unit": "mm", "tag": "E", "note": "guess", "range": [66, 74.5]}
    si_value, origin = read_entry("bore", entry, LENGTH, SOURCE)
    assert si_value == 0.07
    assert origin == Provenance(70, "mm", "E", "guess", (66, 74.5))


@pytest.mark.parametrize(
    "limits",
    [[71, 74], [60, 69], [66], "66 74", [66, "74"], [66, float("nan")], 3, None, [1, 2, 3]],
)
def test_a_wrong_range_is_refused(limits):
    with pytest.raises(
        InputError,
        match="^mine.yaml, line 4, bore.range: it is .* Allowed: two numbers in the unit",
    ):
        read_entry("bore", {"value": 70, "unit": "mm", "range": limits}, LENGTH, SOURCE)


def test_a_bearing_file_in_text_is_the_bearing():
    base = Bearing.read("skf-240-600-bc")
    short = {
        key: entry
        if isinstance(entry, str)
        else f"{entry['value']} {entry['unit']}".removesuffix(" 1")
        for key, entry in base.as_dict().items()
    }
    assert values_of(Bearing.from_dict(short)) == values_of(base)
