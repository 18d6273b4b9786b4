"""Derivatives of the oil's forces, which Newton's method and the sheets of tractions rest on."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip.mechanisms import Laws
from macroslip.roller.films import NoFilms
from macroslip.roller.model import roller_model
from macroslip.roller.plane_build import film_table, pocket_table
from macroslip.roller.table_box import TableBox
from macroslip.whole_bearing.oil import cage_oil, has_oil, raceway_oil

SPEED, SLIP = -0.37, 2e-3


BOX = TableBox(highest_load=9e4, highest_cage_load=1.8e3, lowest_speed=0.35, highest_speed=0.42)


@pytest.fixture(scope="module")
def films(bearing, lubricant):
    return roller_model(bearing, lubricant, 1, tilt=0.0, laws=Laws.paper().but(rolling="whole-film")).films


@pytest.fixture(scope="module")
def tabled(films):
    return films._replace(
        inner_table=film_table(films, 0, BOX),
        outer_table=film_table(films, 1, BOX),
        cage_table=pocket_table(films, BOX),
    )


@pytest.mark.parametrize("outer", [False, True])
@pytest.mark.parametrize("load", [2.0, 300.0, 3e4])
@pytest.mark.parametrize("direction", [-1.0, 1.0])
@pytest.mark.parametrize("by", ["films", "tabled"])
def test_raceway(request, by, outer, load, direction):
    films = request.getfixturevalue(by)
    speed, slip = direction * SPEED, direction * SLIP
    found = raceway_oil(films, outer, load, speed, slip)
    for name, places in {
        "slip": ((load, speed, slip + 1e-6), (load, speed, slip - 1e-6)),
        "load": ((load * 1.00001, speed, slip), (load * 0.99999, speed, slip)),
        "speed": ((load, speed + 1e-6, slip), (load, speed - 1e-6, slip)),
    }.items():
        more, less = (raceway_oil(films, outer, *place) for place in places)
        width = 2e-5 * load if name == "load" else 2e-6
        for force in ("sliding", "shear"):
            slope = (getattr(more, force) - getattr(less, force)) / width
            assert getattr(found, f"{force}_by_{name}") == pytest.approx(slope, rel=1e-4, abs=1e-9)
    assert found.shear * speed < 0.0


@pytest.mark.parametrize("outer", [False, True])
@given(load=st.floats(-1.5, 4.9).map(lambda x: 10.0**x), speed=st.floats(0.36, 0.41), ratio=st.floats(-0.01, 1.0))
@settings(deadline=None, max_examples=50)
def test_a_raceway_by_its_table_is_that_of_the_laws(films, tabled, outer, load, speed, ratio):
    found, expected = (raceway_oil(one, outer, load, -speed, -ratio * speed) for one in (tabled, films))
    assert (found.sliding, found.shear) == pytest.approx((expected.sliding, expected.shear), rel=1e-4)
    for force in ("sliding", "shear"):
        size = abs(expected.sliding) + abs(expected.shear)
        for name, unit in (("slip", speed), ("speed", speed), ("load", load)):
            slope = getattr(expected, f"{force}_by_{name}")
            assert getattr(found, f"{force}_by_{name}") == pytest.approx(slope, rel=1e-2, abs=1e-3 * size / unit)


@pytest.mark.parametrize("load", [0.5, 30.0])
@pytest.mark.parametrize("by", ["films", "tabled"])
@pytest.mark.parametrize("slip", [0.35, -0.35])
def test_cage(request, by, load, slip):
    films = request.getfixturevalue(by)
    found = cage_oil(films, load, slip)
    more, less = cage_oil(films, load, slip + 1e-5), cage_oil(films, load, slip - 1e-5)
    assert found.sliding_by_slip == pytest.approx((more.sliding - less.sliding) / 2e-5, rel=1e-4)
    assert found.shear_by_slip == pytest.approx((more.shear - less.shear) / 2e-5, rel=1e-4)
    more, less = cage_oil(films, load * 1.0001, slip), cage_oil(films, load * 0.9999, slip)
    assert found.sliding_by_load == pytest.approx((more.sliding - less.sliding) / (2e-4 * load), rel=1e-4)
    assert found.shear_by_load == pytest.approx((more.shear - less.shear) / (2e-4 * load), rel=1e-4)


@given(load=st.floats(-1.9, 3.2).map(lambda x: 10.0**x), slip=st.floats(0.02, 0.4))
@settings(deadline=None, max_examples=50)
def test_a_pocket_by_its_table_is_that_of_the_laws(films, tabled, load, slip):
    found, expected = (cage_oil(one, load, slip) for one in (tabled, films))
    assert found == pytest.approx(expected, rel=1e-2, abs=1e-3 * (abs(expected.sliding) + abs(expected.shear)))
    assert (found.sliding, found.shear) == pytest.approx((expected.sliding, expected.shear), rel=1e-4)


def test_without_oil_there_is_nothing():
    assert not has_oil(NoFilms())
    assert not any(raceway_oil(NoFilms(), False, 1e3, SPEED, SLIP))
    assert not any(cage_oil(NoFilms(), 1e3, SLIP))
