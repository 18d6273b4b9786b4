"""Choices of mechanisms: the named sets, what differs from them, and what cannot stand together."""

from dataclasses import fields

import pytest

from macroslip import InputError, Laws, register_traction


@pytest.fixture(scope="module", autouse=True)
def coulomb(package_laws):
    """A traction law of one's own."""
    register_traction("coulomb", lambda interface, load, film, slip: 0.1 * load, reference="none")


#: Keys that have an effect beside `traction: kellstroem` only.
KELLSTROEM_NUMBERS = ("traction_limit_inner", "traction_limit_outer", "traction_saturation")


def test_named_sets_and_what_differs():
    assert Laws.named("paper") == Laws.paper() == Laws()
    assert Laws.named("physical") == Laws.physical()
    assert Laws.paper().name == "paper" and Laws.physical().name == "physical"
    assert Laws.physical().but(microslip=False).name == "physical, but microslip off"
    assert (
        Laws.paper().but(microslip=True, film="moes").name == "paper, but film moes, microslip on"
    )


def test_every_mechanism_of_the_physical_model_changes_the_choice():
    paper, physical = Laws.paper(), Laws.physical()
    for field in fields(Laws):
        choice = paper.but(**{field.name: getattr(physical, field.name)})
        alike = ("heating", "traction", "skew", *KELLSTROEM_NUMBERS)
        assert (choice == paper) == (field.name in alike)


def test_the_closed_form_serves_the_papers_traction_alone():
    assert Laws.paper().is_closed_form and Laws.paper().but(heating=False).is_closed_form
    assert Laws.paper().but(film="moes", starvation=True, asperities="film-ratio").is_closed_form
    for change in ({"viscosity": "roelands"}, {"rheology": "eyring"}, {"microslip": True}):
        assert not Laws.paper().but(**change).is_closed_form


@pytest.mark.parametrize(
    ("choice", "message"),
    [
        (
            {"viscosity": "arrhenius"},
            "laws.viscosity: 'arrhenius' does not exist. Allowed: barus, roelands. Choose one of these.",
        ),
        (
            {"rheology": "maxwell"},
            "laws.rheology: 'maxwell' does not exist. Allowed: newtonian, limiting-shear, eyring. Choose one of these.",
        ),
        (
            {"asperities": "some"},
            "laws.asperities: 'some' does not exist. Allowed: film-ratio, masjedi-khonsari, none. Choose one of these.",
        ),
        ({"microslip": "yes"}, "laws.microslip: it is 'yes'. Allowed: true or false."),
        (
            {"traction": "coulomb"},
            "laws.traction: the traction law 'coulomb' excludes viscosity (roelands) and rheology (eyring) and "
            "microslip (on): a traction law of one's own replaces these mechanisms. "
            "Allowed: mechanisms, or a law of one's own without these. With your law, set model: paper and name the "
            "mechanisms you want to add to it, or keep the model and set viscosity: barus, rheology: newtonian, "
            "microslip: false.",
        ),
    ],
)
def test_what_a_user_is_reported(choice, message):
    with pytest.raises(InputError) as caught:
        Laws.physical().but(**choice)
    assert str(caught.value) == message


def test_the_way_out_that_the_message_names_is_one():
    own = Laws.physical().but(
        traction="coulomb", viscosity="barus", rheology="newtonian", microslip=False
    )
    assert own.asperities == "masjedi-khonsari" and own.starvation


def test_a_law_that_does_not_exist_is_reported_with_those_that_do():
    with pytest.raises(InputError) as caught:
        Laws(film="dowson")
    assert str(caught.value) == (
        "laws.film: 'dowson' does not exist. Allowed: masjedi-khonsari, masjedi-khonsari-moes, moes. Choose one of these. "
        "A law of your own needs its file: macroslip run CASE --laws FILE."
    )
