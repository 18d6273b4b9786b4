"""Laws of one's own that break their contract are refused before the first step, those of the examples are not."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest
from numba import NumbaError, njit

from macroslip.result.own_laws import _reason

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).parents[2] / "examples"

#: Registers wrong laws, and prints what a case with each of them says. Laws stay registered as long as a process lives.
SCRIPT = """
import json, math, sys
from typing import NamedTuple

from macroslip import BearingLoads, Case, load_laws, simulate
from macroslip.compiled import jit
from macroslip.errors import InputError
from macroslip.film import film_law as film_law
from macroslip.mechanisms import Laws
from macroslip.traction import traction_law as traction_law

FILMS = {
    "negative": "h = 1e-6 * (u - 1.0); return h, 1e-6, 0.0",
    "nan": "return math.nan, 0.0, 0.0",
    "nan in part": "return (1e-6 * u if load < 1e4 else math.nan), 1e-6, 0.0",
    "wrong by speed": "return 1e-6 * u ** 0.7, 1e-6 * u ** 0.7 / u, 0.0",
    "wrong by load": "return 1e-6 * u * load ** -0.1, 1e-6 * load ** -0.1, 0.1e-6 * u * load ** -1.1",
    "not compiled": "return {}[load], 0.0, 0.0",
    "two numbers": "return 1e-6 * u, 1e-6",
    "text": "return 'thick', 0.0, 0.0",
    "nothing": "pass",
    "endless": "while u > 0.0: load += 1.0\\n    return load, 0.0, 0.0",
    "kinked": "return 1e-6 * max(u, 0.1), (1e-6 if u >= 0.1 else 0.0), 0.0",
}
TRACTIONS = {
    "backwards": ("return -slip, -1.0, 0.0, 0.0", "return 1.0"),
    "at rest": ("return 1.0 + slip, 1.0, 0.0, 0.0", "return 1.0"),
    "wrong by slip": ("return load * slip / h, 2.0 * load / h, -load * slip / h ** 2, slip / h", "return 1.0"),
    "wrong by film": ("return load * slip / h, load / h, 0.0, slip / h", "return 1.0"),
    "rises nowhere": ("return slip, 1.0, 0.0, 0.0", "return -1.0"),
    "sound": ("return load * slip / h * 1e-12, 1e-12 * load / h, -1e-12 * load * slip / h ** 2, 1e-12 * slip / h", "return 1.0"),
}

class Film(NamedTuple):
    scale: float

PREPARED = {
    "prepare raises": lambda interface: interface.no_such_thing,
    "prepare gives nothing": lambda interface: None,
    "prepare gives a number": lambda interface: 1.0,
    "prepare gives text": lambda interface: Film("thick"),
}

def function(name, arguments, text):
    space = {"math": math, "jit": jit}
    exec(f"def {name}({arguments}):\\n    {text}", space)
    return jit(space[name])

def message(**laws):
    loads = BearingLoads.constant([0.0, -300e3, 0.0], 2.0, 0.1)
    try:
        simulate(Case(loads=loads, rollers=[0], laws=Laws.paper().but(**laws)))
    except InputError as error:
        return str(error)
    return ""

if __name__ == "__main__":
    messages, always = {}, jit(lambda law, load, u: True)
    for name, text in FILMS.items():
        kind = type("Film", (Film,), {})
        film_law.register(name, kind, reference="", prepare=lambda interface, kind=kind: kind(1.0),
                          thickness=function("thickness", "law, load, u", text), in_range=always)
    for name, (text, rising) in TRACTIONS.items():
        kind = type("Traction", (Film,), {})
        traction_law.register(name, kind, reference="", prepare=lambda interface, kind=kind: kind(1.0),
                              traction=function("traction", "law, load, h, slip", text),
                              rising_slip=function("rising", "law, load, h", rising))
    for name, prepare in PREPARED.items():
        kind = type("Film", (Film,), {})
        film_law.register(name, kind, reference="", prepare=prepare, in_range=always,
                          thickness=function("thickness", "law, load, u", "return 1e-6 * u, 1e-6, 0.0"))
    from macroslip.result import own_laws
    from macroslip.result.own_laws import check_own_laws
    for path in sys.argv[1:]:
        load_laws(path)
    case = Case(loads=BearingLoads.constant([0.0, -300e3, 0.0], 2.0, 0.1))
    films = [name for name in FILMS if name != "endless"]
    for kind, names in (("film", [*films, *PREPARED, "dowson-higginson"]), ("traction", [*TRACTIONS, "isothermal-barus"])):
        for name in names:
            laws = Laws.paper().but(**{kind: name})
            try:
                check_own_laws(laws, case.bearing, case.oil, 0.5)
                messages[name] = ""
            except InputError as error:
                messages[name] = str(error)
    messages["simulated"] = message(film="negative")
    own_laws._LONGEST = 3.0
    messages["endless"] = message(film="endless")
    print(json.dumps(messages))
"""


@pytest.fixture(scope="module")
def messages(tmp_path_factory):
    path = tmp_path_factory.mktemp("laws") / "wrong.py"
    path.write_text(SCRIPT, encoding="utf-8")
    command = [sys.executable, path, EXAMPLES / "own_film.py", EXAMPLES / "own_law.py"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=800, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize(
    ("law", "message"),
    [
        ("negative", "film law 'negative', inner, load"),
        ("nan", "the film is nan m. Allowed: a finite thickness above zero."),
        ("nan in part", "the film is nan m"),
        ("wrong by speed", "dh/du is"),
        ("wrong by load", "dh/dQ is"),
        ("two numbers", "film law 'two numbers': it"),
        ("text", "film law 'text': it"),
        ("nothing", "film law 'nothing': it"),
        ("endless", "film law 'endless' or traction law 'mechanisms': it has given nothing for 3 s"),
        ("prepare raises", "film law 'prepare raises', inner: AttributeError in prepare"),
        ("prepare gives nothing", "prepare gives NoneType None. Allowed: a NamedTuple of the law's numbers."),
        ("prepare gives a number", "prepare gives float 1.0"),
        ("prepare gives text", "film law 'prepare gives text'"),
        ("not compiled", "film law 'not compiled': it cannot be compiled (TypingError"),
        ("backwards", "Allowed: a finite force with the sign of the slip."),
        ("at rest", "traction is 1 N. Allowed: none without slip."),
        ("wrong by slip", "dF/dslip is"),
        ("wrong by film", "dF/dh is 0, but the law itself changes by"),
        ("rises nowhere", "rising_slip is -1 m/s"),
    ],
)
def test_a_wrong_law_is_refused_with_the_state_at_which_it_is(messages, law, message):
    assert message in messages[law] and "Mend the law" in messages[law]


@pytest.mark.parametrize("law", ["kinked", "sound", "dowson-higginson", "isothermal-barus"])
def test_a_sound_law_is_not(messages, law):
    assert messages[law] == ""


def test_a_simulation_looks_before_its_first_step(messages):
    assert messages["simulated"] == messages["negative"] != ""


def test_the_compilers_pages_become_two_lines():
    @njit
    def stumbles(x):
        return x + nowhere  # noqa: F821

    @njit
    def mixed(x):
        return "a" + x

    for function, words in (
        (stumbles, "NameError: name 'nowhere' is not defined"),
        (mixed, r"No implementation of .*: >>> add\(Literal\[str\]\(a\), float64\); test_own_laws.py, line \d+"),
    ):
        with pytest.raises(NumbaError) as found:
            function(1.0)
        assert re.fullmatch(words, _reason(found.value))
