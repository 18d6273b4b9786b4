"""Numbers, types and text as they are pasted from documents and other programs."""

import pytest

from macroslip.errors import InputError
from macroslip.input.fields import IN_FILE, Quantity, Text, Texts
from macroslip.input.files import parse
from macroslip.input.units import FORCE, MOMENT, parse_quantity


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("263\u00a0kN", FORCE, (263, "kN")),
        ("726 kN\u00a0m", MOMENT, (726, "kN m")),
        ("726\u2009kN\u202fm", MOMENT, (726, "kN m")),
    ],
)
def test_spaces_of_any_kind_are_spaces(text, dimension, value):
    assert parse_quantity(text, dimension) == value


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("\u2212263 kN", ["minus sign", "U+2212", "write a hyphen"]),
        ("17,600 kN", ["Write 17600 if the comma separates thousands, and a decimal point if it"]),
        ("17 600 kN", ["Write 17600, without marks between thousands"]),
        ("17\u2009600\u00a0kN", ["Write 17600, without marks between thousands"]),
        ("17'600 kN", ["Write 17600, without marks between thousands"]),
        ("1'017'600 kN", ["Write 1017600, without"]),
        ("1.080,5 kN", ["a decimal point, and no marks between thousands"]),
        ("1,08 kN", ["Use a decimal point, not a comma"]),
        ("a lot", ["Write 1 N, for example"]),
        ("3 lbf", ["has the unit 'lbf'", "Convert it"]),
    ],
)
def test_the_likely_cause_is_named(text, words):
    with pytest.raises(InputError) as caught:
        parse_quantity(text, FORCE)
    message = str(caught.value)
    assert [word for word in words if word not in message] == []
    # Whatever the mark was, none of the advice is another number than the one that was meant.
    assert "17.6" not in message and "1.08 " not in message


@pytest.mark.parametrize("value", ["0,5", "\u22120.5"])
def test_a_number_without_unit_has_the_same_advice(value):
    with pytest.raises(InputError, match="decimal point|U\\+2212"):
        Quantity("tolerance").read(value, IN_FILE)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("rollers: !!set {0, 1}", ["line 1", "type 'tag:yaml.org,2002:set'", "[0, 1] is a list"]),
        ("a: {b: [1, !!omap [c: 2]]}", ["line 1", "omap"]),
        ("a: !!binary aGk=", ["binary"]),
        ("a: !!timestamp 2025-01-01", ["timestamp"]),
        ("a: !!int 3", ["type 'tag:yaml.org,2002:int'", "Remove the type"]),
        ("a: !own 3", ["type '!own'"]),
        ("a: 0xA0", ["'0xA0' is not a decimal number"]),
        ("a: [1, 0o17]", ["'0o17' is not a decimal number"]),
        ("a: [1_0, 2]", ["'1_0' is not a decimal number", "in quotes if it is text"]),
        ("a: 2024_01.5e3", ["'2024_01.5e3' is not a decimal number"]),
        ('a: "C:\\work"', ["escape character", "single quotes"]),
        ('a: "C:\\Users\\me"', ["escape sequence", "single quotes"]),
        ('a: "runs\\x.out"', ["escape sequence", "single quotes"]),
    ],
)
def test_types_and_numbers_that_would_be_something_else(text, words):
    with pytest.raises(InputError) as caught:
        parse(text + "\n", "case.yaml")
    assert [word for word in ("case.yaml", *words) if word not in str(caught.value)] == []


def test_text_in_quotes_may_look_like_a_number():
    assert parse("{a: '0xA0', b: 7}", "case.yaml")[0] == {"a": "0xA0", "b": 7}


@pytest.mark.parametrize("form", [Text("loads"), Texts("files")])
def test_a_backslash_that_became_a_line_end(form):
    data, _ = parse('file: "runs\\new\\turbine.outb"\n', "case.yaml")
    with pytest.raises(InputError, match=r"control character '\\n'.*backslash.*single quotes"):
        form.read(data["file"], IN_FILE)
    data, _ = parse("file: 'runs\\new\\turbine.outb'\n", "case.yaml")
    assert "\\new" in str(form.read(data["file"], IN_FILE))
