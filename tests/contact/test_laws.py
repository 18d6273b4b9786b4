"""Laws by name: what a roller's contacts get, and that a law of one's own which breaks its contract is refused."""

import math
import time

import numpy as np
import pytest

from macroslip import Bearing, Laws, Lubricant
from macroslip.contact import film, registry
from macroslip.contact.gap import film_at_gap, prepare_gap, starved_martin
from macroslip.contact.laws import LOWEST_ENTRAINMENT_SPEED, prepare, references
from macroslip.contact.registry import (
    FILM_LAWS,
    LEAST_SLIP,
    TRACTION_LAWS,
    check_own_laws,
    film_range_notes,
    register_film,
    register_traction,
)
from macroslip.contact.starvation import film_factor
from macroslip.errors import InputError

BEARING, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")


@pytest.fixture(autouse=True)
def own():
    """A test's own laws end with it."""
    lists = FILM_LAWS._laws, TRACTION_LAWS._laws
    before = [dict(registered) for registered in lists]
    yield
    for registered, old in zip(lists, before, strict=True):
        registered.clear()
        registered.update(old)


def tried(*, kind="film", **options):
    """What a case with a law of one's own is told before its first step."""
    laws = Laws.paper().but(**{kind: "mine"})
    check_own_laws(laws, BEARING, OIL, 0.5)
    return prepare(laws, BEARING, OIL, 1)


def message(kind, function):
    register = {"film": register_film, "traction": register_traction}[kind]
    register("mine", function, reference="none")
    with pytest.raises(InputError) as caught:
        tried(kind=kind)
    assert "Mend the law" in str(caught.value) and "\n" not in str(caught.value)
    return str(caught.value)


def exits(interface, load, speed):
    raise SystemExit(3)


def shifts_its_input(interface, load, speed):
    load *= 2.0
    return 1e-6 * np.sqrt(speed)


def list_of(interface, load, speed):
    return [1e-6] * (load.size - 1)


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (lambda interface, load, speed: 1e-6 * (speed - 0.1), "film law 'mine', inner, load"),
        (
            lambda interface, load, speed: 0.0 * speed,
            "it gives 0 m. Allowed: a finite number above zero.",
        ),
        (lambda interface, load, speed: np.where(load < 1e4, 1e-6, math.nan), "it gives nan m"),
        (lambda interface, load, speed: np.full(load.shape, math.inf), "it gives inf m"),
        (
            lambda interface, load, speed: 1e-6,
            "169 states it gives 1e-06. Allowed: an array of 169 real numbers",
        ),
        (list_of, "real numbers, one for each state"),
        (
            lambda interface, load, speed: (1e-6 * speed, speed, load),
            "real numbers, one for each state",
        ),
        (
            lambda interface, load, speed: load > 0.0,
            "it gives an array of shape (169,) of type bool.",
        ),
        (lambda interface, load, speed: 1e-6 * speed + 0.0j, "real numbers, one for each state"),
        (
            lambda interface, load, speed: np.full(load.shape, "thick"),
            "real numbers, one for each state",
        ),
        (lambda interface, load, speed: None, "it gives None."),
        (
            lambda interface, load, speed: interface.no_such_thing,
            "film law 'mine', inner: AttributeError in it (",
        ),
        (exits, "SystemExit in it (3)"),
        (lambda interface, load: load, "TypeError in it ("),
    ],
)
def test_a_wrong_film_law_is_refused_with_the_state_at_which_it_is(function, words):
    assert words in message("film", function)


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (lambda interface, load, h, slip: -slip, "N. Allowed: a finite number above zero."),
        (
            lambda interface, load, h, slip: 0.1 * load,
            "a force in proportion to slip where that is small",
        ),
        (
            lambda interface, load, h, slip: load * np.sqrt(slip),
            "a force in proportion to slip where that is small",
        ),
        (
            lambda interface, load, h, slip: load * slip / (h - 1e-7),
            "traction law 'mine', inner, load",
        ),
        (lambda interface, load, h, slip: slip.sum(), "one for each state"),
    ],
)
def test_a_wrong_traction_law_is_refused(function, words):
    assert words in message("traction", function)


def test_a_law_that_does_not_return_is_given_up(monkeypatch):
    monkeypatch.setattr(registry, "_LONGEST", 0.5)
    ended = []

    def endless(interface, load, speed):
        while not ended:
            time.sleep(0.01)
        return load

    try:
        assert "it has given nothing for 0.5 s" in message("film", endless)
    finally:
        ended.append(True)


@pytest.mark.parametrize(
    "function",
    [
        lambda interface, load, speed: 1e-6 * np.maximum(speed, 0.1),
        lambda interface, load, speed: np.ones(load.shape, dtype=int),
        shifts_its_input,
    ],
    ids=["kinked", "whole numbers", "changes its input"],
)
def test_a_sound_law_is_not_refused(function):
    register_film("mine", function, reference="none")
    film = tried().inner.film_thickness(np.array([[1.0], [1e4]]), np.array([0.1, 0.4, 0.9]))
    assert film.shape == (2, 3) and film.dtype == float
    assert film == pytest.approx(
        np.broadcast_to(function(None, np.ones(3), np.array([0.1, 0.4, 0.9])), (2, 3))
    )


def test_a_law_of_ones_own_is_what_the_contact_uses():
    """The package's laws as functions of one's own give what they give, signs and small slip included."""
    register_film("mine", lambda *state: film.moes(*state), reference="Moes")
    register_traction(
        "mine", lambda interface, load, h, slip: 1e-4 * load * slip / h, reference="Couette"
    )
    laws = Laws.paper().but(film="mine", traction="mine", inlet_heating=True)
    check_own_laws(laws, BEARING, OIL, 0.5)
    inner = prepare(laws, BEARING, OIL, 1).inner
    theirs = prepare(Laws.paper().but(film="moes", inlet_heating=True), BEARING, OIL, 1).inner
    load, speed = np.array([1.0, 1e4]), np.array([0.01, 0.7])
    assert np.array_equal(inner.film_thickness(load, speed), theirs.film_thickness(load, speed))
    slip = np.array([-0.2, -1e-14, 0.0, 1e-300, 3e-5])
    assert inner.uniform_traction(10.0, 1e-6, slip) == pytest.approx(1e3 * slip, rel=1e-12, abs=0.0)
    assert inner.film_in_range(1e9, speed).all() and not theirs.film_in_range(1e9, speed).any()
    assert inner.curved is False and inner.fluid is None and inner.closed_form is None
    assert references(laws)[0] == "Moes" and references(laws)[-1] == "Couette"
    assert "test_laws.py" not in theirs.own_sources == "" and "Couette" in inner.own_sources


def test_in_range_of_a_law_of_ones_own_is_used_and_checked():
    register_film(
        "mine",
        lambda interface, load, speed: 1e-6 * speed,
        reference="none",
        in_range=lambda interface, load, speed: (load < 10.0) & (speed > 0.0),
        range_notes=lambda interface: [f"always at the {interface.name}"],
    )
    inner = tried().inner
    assert inner.film_in_range(np.array([9.0, 11.0]), 0.4).tolist() == [True, False]
    assert film_range_notes("mine", [inner.interface]) == ["inner: always at the inner"]
    register_film(
        "mine", lambda interface, load, speed: 1e-6 * speed, reference="", in_range=lambda *_: True
    )
    with pytest.raises(
        InputError,
        match="in_range of film law 'mine', inner: for 169 states it gives True. Allowed: an array of 169 truth values",
    ):
        tried()


def test_names_that_are_taken_or_unknown_are_refused():
    def mine(interface, load, speed):
        return 1e-6 * speed

    with pytest.raises(
        InputError,
        match="the film law 'moes' cannot be registered: the name is taken. Allowed: a name",
    ):
        register_film("moes", mine, reference="none")
    with pytest.raises(InputError, match="the traction law 'mechanisms' cannot be registered"):
        register_traction("mechanisms", mine, reference="none")
    register_film("mine", mine, reference="first")
    register_film("mine", mine, reference="mended at a prompt")
    assert FILM_LAWS.named("mine").reference == "mended at a prompt"
    FILM_LAWS.remove("mine")
    assert "mine" not in FILM_LAWS.names()
    with pytest.raises(
        InputError, match="^laws.film: 'dowson' does not exist. Allowed: .*masjedi-khonsari"
    ):
        prepare(Laws.paper().but(film="dowson"), BEARING, OIL, 1)
    with pytest.raises(
        InputError, match="^laws.traction: 'coulomb' does not exist. Allowed: mechanisms"
    ):
        prepare(Laws.paper().but(traction="coulomb"), BEARING, OIL, 1)


def test_package_laws_are_not_tried(monkeypatch):
    monkeypatch.setattr(registry, "_check_at", lambda *_: pytest.fail("tried"))
    check_own_laws(Laws.physical(), BEARING, OIL, 0.5)


@pytest.mark.parametrize("laws", [Laws.paper(), Laws.physical()], ids=["paper", "physical"])
def test_film_has_its_corrections_and_a_floor_of_speed(laws):
    gap = 2e-6
    short = OIL.supplied(gap)
    contact = prepare(laws.but(starvation=True, inlet_heating=True), BEARING, short, 1).outer
    plain = prepare(laws.but(starvation=False, inlet_heating=False), BEARING, short, 1).outer
    load, speed = np.geomspace(1.0, 1e5, 7), np.geomspace(1e-3, 2.0, 7)[:, None]
    heated = plain.film_thickness(load, speed) / (
        1.0 + 0.1 * (0.54 * 0.056 / 0.125 * speed**2) ** 0.64
    )
    film = contact.film_thickness(load, speed)
    assert (film < gap).all()
    # The inlet begins to be full at the gap.
    assert film == pytest.approx(film_factor(gap / film) * heated, rel=1e-6)
    at_rest = contact.film_thickness(1e4, np.array([0.0, 1e-9, LOWEST_ENTRAINMENT_SPEED]))
    assert at_rest[0] == at_rest[1] == at_rest[2] > 0.0


def test_contacts_of_the_papers_model():
    inner, outer, cage, _ = prepare(Laws.paper(), BEARING, OIL, 1)
    assert (inner.name, outer.name, cage.name) == ("inner", "outer", "cage")
    for contact in (inner, outer, cage):
        assert (
            not contact.curved
            and contact.rolling is None
            and contact.boundary_friction == 0.0
            and contact.fluid is None
        )
        assert contact.asperity_share(1e4, 0.4, 1e-6) == 0.0 and not contact.shape.microslip
    assert any("10.1098/rsta.1961.0014" in reference for reference in references(Laws.paper()))
    assert not any(
        "10.1098/rsta.1961.0014" in reference
        for reference in references(Laws.paper().but(heating=False))
    )


def test_contacts_with_all_mechanisms(contacts):
    laws = Laws.physical()
    up, down = (prepare(laws, BEARING, OIL, sign) for sign in (-1, 1))
    assert up.inner.shape.spin_ratio == -down.inner.shape.spin_ratio != 0.0
    assert down.inner.curved and down.cage.curved and not down.cage.shape.microslip
    # A roller floats in its pocket on tens of micrometres: no asperity touches. The film of a raceway is thinner.
    assert (
        down.cage.asperity_share(1e4, 1e-3, 1e-7)
        == 0.0
        < down.inner.asperity_share(1e4, 1e-3, 1e-7)
    )
    without = prepare(laws.but(rolling="none"), BEARING, OIL, 1)
    assert without.cage.asperity_share(1e4, 1e-3, 1e-7) > 0.0 and without.cage.rolling is None
    # The spar of a pocket ends where its gap is at most seven times the least; raceways are flooded.
    for contact, inlet in ((down.cage, 7.0), (down.inner, math.inf)):
        full = film_at_gap(prepare_gap(contacts[contact.name][1]), math.log(2e-5))
        assert np.exp(
            np.subtract(film_at_gap(contact.rolling.gap, math.log(2e-5)), full)
        ) == pytest.approx(starved_martin(inlet), rel=1e-12)
    conductance = down.inner.uniform_traction(1e4, 1e-6, np.array([LEAST_SLIP, -1e-8])) / [
        LEAST_SLIP,
        -1e-8,
    ]
    assert conductance[0] == pytest.approx(conductance[1], rel=1e-3)
    assert len(references(laws)) == 7


@pytest.mark.parametrize(
    ("missing", "purpose"),
    [("eyring_stress", "Eyring's rheology"), ("boundary_friction", "asperity friction")],
)
def test_values_that_the_lubricant_lacks_are_named(missing, purpose):
    with pytest.raises(InputError, match=missing) as caught:
        prepare(Laws.physical(), BEARING, OIL.replace(**{missing: None}), 1)
    assert purpose in str(caught.value)
