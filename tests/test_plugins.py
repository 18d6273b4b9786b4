"""Laws of one's own from a file: what a user is shown when it is wrong, and that nothing is left behind then."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from macroslip import InputError, load_laws
from macroslip.film import film_law as film_law
from macroslip.traction import traction_law as traction_law

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
        before = film_law.names(), traction_law.names(), set(sys.modules)
        with pytest.raises(InputError) as caught:
            load_laws(name)
        assert film_law.names() == before[0] and traction_law.names() == before[1]
        assert not [module for module in set(sys.modules) - before[2] if "my_laws" in module]
        assert "\n" not in str(caught.value)
        return str(caught.value)

    return reported


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
            f"my_laws.py: the file registers no law. {ALLOWED} Call macroslip.film.film_law.register or "
            "macroslip.traction.traction_law.register in it.",
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
            f"my_laws.py, line {FILM[: FILM.index('film_law.register(')].count(chr(10)) + 1}: the film law 'moes' cannot be "
            "registered: the name is taken. Allowed: a name other than masjedi-khonsari, masjedi-khonsari-moes, moes. "
            "Choose another name; a law that was changed in its file needs a new Python process.",
        ),
        (
            TRACTION.replace('"isothermal-barus"', '"mechanisms"'),
            f"my_laws.py, line {TRACTION[: TRACTION.index('traction_law.register(')].count(chr(10)) + 1}: the traction law "
            "'mechanisms' cannot be registered: the name is taken. Allowed: a name other than mechanisms. Choose another "
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
    found = load_laws("my_laws.py")
    try:
        assert found == (("dowson-higginson",), ())
        # Read again, under another name of the same path, it is the same law.
        assert load_laws(tmp_path / "my_laws.py") is found
        # Its name is taken now, by whatever else the file may become.
        (tmp_path / "my_laws.py").write_text(FILM + "\n# changed\n", encoding="utf-8")
        with pytest.raises(InputError, match="'dowson-higginson' cannot be registered: the name is taken"):
            load_laws("my_laws.py")
        assert "dowson-higginson" in film_law.names()
    finally:
        film_law.remove("dowson-higginson")


ASK = """
import sys
from macroslip import Bearing, Laws, Lubricant, load_laws
from macroslip.roller import contact_force
from macroslip.roller.model import roller_model
load_laws(sys.argv[1])
laws = Laws(film="dowson-higginson")
model = roller_model(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"), 1, tilt=0.0, laws=laws)
force = contact_force.raceway_force(model.inner, 2e4, 1e-4, -0.4, 0.4, -0.5)
kernel = contact_force._plain_raceway.stats
print(sum(kernel.cache_hits.values()), sum(kernel.cache_misses.values()), repr(force.spin))
"""


def test_a_law_changed_within_a_second_is_read_anew_and_leaves_no_other_file(tmp_path, monkeypatch):
    """Bytecode beside the file would pass for that of any text of the same length and the same second."""
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    path = tmp_path / "my_laws.py"
    for name in ("one", "two"):
        path.write_text(TRACTION.replace("isothermal-barus", name), encoding="utf-8")
        os.utime(path, (1.7e9, 1.7e9))
        assert load_laws(path).traction == (name,)
        traction_law.remove(name)
    assert list(tmp_path.iterdir()) == [path]


def test_kernels_of_a_law_are_found_again_by_another_process_and_from_another_folder(tmp_path):
    (tmp_path / "other").mkdir()
    found = []
    for folder in (tmp_path, tmp_path, tmp_path / "other"):
        (folder / "my_laws.py").write_text(FILM, encoding="utf-8")
        command = [sys.executable, "-W", "error", "-c", ASK, str(folder / "my_laws.py")]
        environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "kernels")}
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=300)
        assert done.returncode == 0, done.stderr
        hits, misses, force = done.stdout.split()
        found.append((int(hits), int(misses), force))
    force = found[0][2]
    assert found == [(0, 1, force), (1, 0, force), (1, 0, force)]
