"""Laws of one's own that break their contract are refused before the first step, those of the examples are not."""

import threading
from pathlib import Path

import numpy as np
import pytest

from macroslip import BearingLoads, Case, InputError, Laws, load_laws, register_film, register_traction, simulate
from macroslip.contact import registry
from macroslip.contact.registry import check_own_laws

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).parents[2] / "examples"
LOADS = BearingLoads.constant([0.0, -300e3, 0.0], 2.0, 0.5)


def raises(interface, load, speed):
    raise ZeroDivisionError("no such film")


FILMS = {
    "negative": lambda interface, load, speed: 1e-6 * (speed - 1.0),
    "nan": lambda interface, load, speed: np.nan * load,
    "nan in part": lambda interface, load, speed: np.where(load < 1e4, 1e-6 * speed, np.nan),
    "one number": lambda interface, load, speed: 1e-6,
    "two numbers": lambda interface, load, speed: (1e-6 * speed, 1e-6),
    "text": lambda interface, load, speed: "thick",
    "nothing": lambda interface, load, speed: None,
    "complex": lambda interface, load, speed: 1e-6 * speed + 0j,
    "truth": lambda interface, load, speed: load > 0.0,
    "raises": raises,
    "kinked": lambda interface, load, speed: 1e-6 * np.maximum(speed, 0.1),
}
TRACTIONS = {
    "backwards": lambda interface, load, film, slip: -slip,
    "at rest": lambda interface, load, film, slip: 1.0 + slip,
    "not finite": lambda interface, load, film, slip: load * slip / (film - film),
    "sound": lambda interface, load, film, slip: 1e-12 * load * slip / film,
}


@pytest.fixture(scope="module", autouse=True)
def registered(package_laws):
    for name, function in FILMS.items():
        register_film(name, function, reference="none")
    for name, function in TRACTIONS.items():
        register_traction(name, function, reference="none")
    always = lambda interface, load, speed: True  # noqa: E731
    register_film("one truth", FILMS["kinked"], reference="none", in_range=always)
    for name in ("own_film.py", "own_law.py"):
        load_laws(EXAMPLES / name)


def check(kind, name):
    case = Case(loads=LOADS)
    check_own_laws(Laws.paper().but(**{kind: name}), case.bearing, case.oil, 0.5)


@pytest.mark.parametrize(
    ("kind", "law", "message"),
    [
        ("film", "negative", "film law 'negative', inner, load"),
        ("film", "nan", "it gives nan m. Allowed: a finite number above zero."),
        ("film", "nan in part", "it gives nan m"),
        ("film", "one number", "states it gives 1e-06. Allowed: an array of 169 real numbers, one for each state."),
        ("film", "two numbers", "film law 'two numbers', inner: "),
        ("film", "text", "film law 'text', inner: for 169 states it gives 'thick'"),
        ("film", "nothing", "film law 'nothing', inner: for 169 states it gives None"),
        ("film", "complex", "an array of shape (169,) of type complex128"),
        ("film", "truth", "an array of shape (169,) of type bool"),
        ("film", "raises", "ZeroDivisionError in it (no such film). Allowed: a function that raises nothing."),
        ("film", "one truth", "in_range of film law 'one truth', inner: for 169 states it gives True"),
        ("traction", "backwards", "traction law 'backwards', inner, load"),
        ("traction", "at rest", "Allowed: a force in proportion to slip where that is small."),
        ("traction", "not finite", "it gives inf N. Allowed: a finite number above zero."),
    ],
)
def test_a_wrong_law_is_refused_with_the_state_at_which_it_is(kind, law, message):
    with pytest.raises(InputError) as caught:
        check(kind, law)
    assert message in str(caught.value) and "Mend the law" in str(caught.value)


@pytest.mark.parametrize(
    ("kind", "law"),
    [("film", "kinked"), ("film", "dowson-higginson"), ("traction", "sound"), ("traction", "isothermal-barus")],
)
def test_a_sound_law_is_not(kind, law):
    check(kind, law)


def test_a_law_that_does_not_return_is_given_up(monkeypatch):
    over = threading.Event()

    def endless(interface, load, speed):
        over.wait()
        return 1e-6 * speed

    register_film("endless", endless, reference="none")
    monkeypatch.setattr(registry, "_LONGEST", 1.0)
    try:
        with pytest.raises(InputError, match="film law 'endless': it has given nothing for 1 s"):
            check("film", "endless")
    finally:
        over.set()


def test_a_simulation_looks_before_its_first_step():
    with pytest.raises(InputError, match="film law 'negative', inner, load"):
        simulate(Case(loads=LOADS, rollers=[0], laws=Laws.paper().but(film="negative")))


def test_a_copy_of_a_law_of_the_package_gives_its_results():
    """The shipped film under another name: the same tables, so the same energies."""
    case = Case(loads=LOADS, rollers=[0], laws=Laws.paper())
    mine = registry.FILM_LAWS.named(case.laws.film).function
    register_film("copy", lambda interface, load, speed: mine(interface, load, speed), reference="none")
    found = simulate(Case(loads=LOADS, rollers=[0], laws=Laws.paper().but(film="copy")))
    np.testing.assert_array_equal(found.energy, simulate(case).energy)


def test_the_examples_run_and_are_cited():
    laws = Laws.paper().but(film="dowson-higginson", traction="isothermal-barus")
    found = simulate(Case(loads=LOADS, rollers=[0], laws=laws))
    assert (found.status == 0).all() and float(found.energy.sum()) > 0.0
    assert "Barus" in found.attrs["citations"] and "Dowson" in found.attrs["citations"]
    # The paper's traction heats its film; a roller that grips slips so little that it hardly matters.
    heated = simulate(Case(loads=LOADS, rollers=[0], laws=laws.but(traction="mechanisms")))
    raceways = ["inner", "outer"]
    assert float(found.energy.sel(interface=raceways).sum()) == pytest.approx(
        float(heated.energy.sel(interface=raceways).sum()), rel=0.05
    )
