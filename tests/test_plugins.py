"""Laws of one's own from a file: what a user is shown when it is wrong, and that nothing is left behind then."""

import os
import sys
from pathlib import Path

import pytest

from macroslip import InputError, load_laws, plugins
from macroslip.contact.registry import FILM_LAWS, TRACTION_LAWS, own_laws

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).parents[1] / "examples"
FILM = (EXAMPLES / "own_film.py").read_text(encoding="utf-8")
TRACTION = (EXAMPLES / "own_law.py").read_text(encoding="utf-8")


@pytest.fixture
def reported(tmp_path, monkeypatch):
    """What the user is shown about a file that is wrong; no law and no module of it may stay behind."""
    monkeypatch.chdir(tmp_path)

    def reported(text, name="my_laws.py"):
        if text is not None:
            Path(name).write_text(text, encoding="utf-8")
        before = FILM_LAWS.names(), TRACTION_LAWS.names(), set(sys.modules)
        with pytest.raises(InputError) as caught:
            load_laws(name)
        assert FILM_LAWS.names() == before[0] and TRACTION_LAWS.names() == before[1]
        assert not [module for module in set(sys.modules) - before[2] if "my_laws" in module]
        assert "\n" not in str(caught.value)
        return str(caught.value)

    return reported


def line_of(text, words):
    """Number of the last line with these words."""
    return text[: text.rindex(words)].count("\n") + 1


ALLOWED = "Allowed: a Python file that registers film or traction laws, as macroslip init --example laws writes."


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            None,
            f"my_laws.py: the file cannot be read (No such file or directory). {ALLOWED} Check its path, which starts at "
            "the current folder.",
        ),
        (
            "import math\n",
            f"my_laws.py: the file registers no law. {ALLOWED} Call macroslip.register_film or "
            "macroslip.register_traction in it.",
        ),
        (
            "x = 1\n\ndef law(:\n",
            "my_laws.py, line 3: SyntaxError while its laws were read (invalid syntax). Mend it; python my_laws.py "
            "shows where the error comes from.",
        ),
        (
            FILM + "\n1 / 0\n",
            f"my_laws.py, line {FILM.count(chr(10)) + 2}: ZeroDivisionError while its laws were read (division by zero). "
            "Mend it; python my_laws.py shows where the error comes from.",
        ),
        (
            "import json\n\n\ndef read():\n    return json.loads('{')\n\n\nread()\n",
            "my_laws.py, line 5: JSONDecodeError while its laws were read (Expecting property name enclosed in double "
            "quotes: line 1 column 2 (char 1)). Mend it; python my_laws.py shows where the error comes from.",
        ),
        (
            "raise SystemExit\n",
            "my_laws.py, line 1: SystemExit while its laws were read. Mend it; python my_laws.py shows where the error "
            "comes from.",
        ),
        (
            FILM.replace('"dowson-higginson"', '"moes"'),
            f"my_laws.py, line {line_of(FILM, 'register_film(')}: the film law 'moes' cannot be "
            "registered: the name is taken. Allowed: a name other than masjedi-khonsari, masjedi-khonsari-moes, moes. "
            "Choose another name; a law that was changed in its file needs a new Python process.",
        ),
        (
            TRACTION.replace('"isothermal-barus"', '"mechanisms"'),
            f"my_laws.py, line {line_of(TRACTION, 'register_traction(')}: the traction law "
            "'mechanisms' cannot be registered: the name is taken. Allowed: a name other than kellstroem, mechanisms. Choose another "
            "name; a law that was changed in its file needs a new Python process.",
        ),
    ],
    ids=["missing", "nothing", "syntax", "raises", "deeper", "exits", "taken", "reserved"],
)
def test_what_a_user_is_reported(reported, text, message):
    assert reported(text) == message


def test_a_file_that_was_wrong_can_be_mended_and_read_again(reported, tmp_path):
    reported(FILM + "\n1 / 0\n")
    (tmp_path / "my_laws.py").write_text(FILM, encoding="utf-8")
    laws = load_laws("my_laws.py")
    try:
        assert laws == (("dowson-higginson",), ())
        # Read again, under another name of the same path, it is the same law.
        assert load_laws(tmp_path / "my_laws.py") is laws
        # Its name is taken now, by whatever else the file may become.
        (tmp_path / "my_laws.py").write_text(FILM + "\n# changed\n", encoding="utf-8")
        with pytest.raises(
            InputError, match="'dowson-higginson' cannot be registered: the name is taken"
        ):
            load_laws("my_laws.py")
        assert "dowson-higginson" in FILM_LAWS.names()
    finally:
        FILM_LAWS.remove("dowson-higginson")


def test_a_law_changed_within_a_second_is_read_anew_and_leaves_no_other_file(tmp_path, monkeypatch):
    """Bytecode beside the file would pass for that of any text of the same length and the same second."""
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    path = tmp_path / "my_laws.py"
    for name in ("one", "two"):
        path.write_text(TRACTION.replace("isothermal-barus", name), encoding="utf-8")
        os.utime(path, (1.7e9, 1.7e9))
        assert load_laws(path).traction == (name,)
        TRACTION_LAWS.remove(name)
    assert list(tmp_path.iterdir()) == [path]


def test_a_law_has_one_source_wherever_its_file_lies_and_another_when_it_changes(tmp_path):
    """Tables of a law, and results of a study, are found again by it."""
    sources = []
    for folder, text in (("one", FILM), ("two", FILM), ("three", FILM.replace("2.65", "2.66"))):
        path = tmp_path / folder / "my_laws.py"
        path.parent.mkdir()
        path.write_text(text, encoding="utf-8")
        plugins._loaded.clear()
        assert load_laws(path).film == ("dowson-higginson",)
        assert own_laws() == [FILM_LAWS.named("dowson-higginson").source] != [""]
        sources += own_laws()
        FILM_LAWS.remove("dowson-higginson")
    assert sources[0] == sources[1] != sources[2] and own_laws() == []
