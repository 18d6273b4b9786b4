"""The rating beside slip: the numbers of `rate_case`, one switch, and bearings that lack ratings."""

import numpy as np
import pytest

from macroslip import Bearing, BearingLoads, Case, Laws, rate_case, simulate
from macroslip.rating.variables import RATING
from macroslip.result.rating import with_rating
from macroslip.result.variables import VARIABLES
from macroslip.study.summary import RATING_VARIABLES, rating_values
from tests.variables import check_variables

pytestmark = pytest.mark.slow

LOADS = BearingLoads.constant([0.0, -400e3, 60e3], 2.1, 1.0)


@pytest.fixture(scope="module")
def case():
    return Case(loads=LOADS, laws=Laws.paper(), rollers=[0])


@pytest.fixture(scope="module")
def result(case):
    return simulate(case)


def test_a_result_has_the_numbers_of_the_rating(case, result):
    both, rating = with_rating(result, case), rate_case(case)
    for name, values in rating.data_vars.items():
        np.testing.assert_array_equal(both[name].values, values.values)
        assert both[name].attrs == values.attrs
    for name, values in result.data_vars.items():
        assert both[name].identical(values)
    assert both.attrs["rating_contamination"] == 0.5
    assert both.attrs["title"] == result.attrs["title"]
    check_variables(both, VARIABLES, RATING)
    np.testing.assert_array_equal(both.load_class_middle, rating.load_class)


def test_a_case_may_ask_for_none(result):
    case = Case(loads=LOADS, laws=Laws.paper(), rollers=[0], rating=False)
    assert with_rating(result, case) is result
    assert np.isnan(list(rating_values(case).values())).all()


def test_a_bearing_without_load_ratings_is_not_rated(result):
    entries = Bearing.read("skf-240-600-bc").as_dict()
    del entries["static_load_rating"]
    case = Case(loads=LOADS, laws=Laws.paper(), rollers=[0], bearing=Bearing.from_dict(entries))
    rating = with_rating(result, case)
    assert "static_safety" not in rating
    assert "static_load_rating" in rating.attrs["rating_problem"]
    assert np.isnan(list(rating_values(case).values())).all()


def test_the_summary_keeps_what_the_rating_gives(case):
    values, rating = rating_values(case), rate_case(case)
    assert list(values) == list(RATING_VARIABLES)
    assert values["static_safety"] == float(rating.static_safety)
    assert values["reference_life"] == float(rating.reference_life.sel(load_along_roller="hertz"))
    assert values["largest_pressure"] == float(rating.largest_pressure.max())
    assert values["damage_equivalent_load_10"] == float(
        rating.damage_equivalent_load.sel(load="radial").isel(wohler_exponent=1)
    )
    shared = [name for name in RATING_VARIABLES if name in rating]
    assert {"static_safety", "basic_life", "largest_pressure"} <= set(shared)
    for name in shared:
        assert rating[name].units == RATING_VARIABLES[name].units
