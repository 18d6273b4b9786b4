"""Loads of the rows against what statics says."""

import numpy as np
import pytest

from macroslip import BearingLoads, Case, HubLoads, Laws
from paper.studies import row_loads


def test_thrust_is_shared_by_the_rollers_of_one_row():
    case = Case(loads=BearingLoads.constant([0.0, 0.0, 200e3], 2.1, 3.0), laws=Laws.paper())
    loads = row_loads(case, 0.0, 3.0)
    each = 200e3 / (28 * np.sin(case.bearing.contact_angle))
    np.testing.assert_allclose(loads.roller_load, [each, 0.0], rtol=1e-6)
    np.testing.assert_array_equal(loads.loaded_share, [1.0, 0.0])
    assert (float(loads.thrust), float(loads.radial_load)) == (200e3, 0.0)


def test_a_radial_load_is_shared_by_both_rows_and_leaves_the_top_free():
    loads = row_loads(
        Case(loads=BearingLoads.constant([0.0, -300e3, 0.0], 2.1, 10.0), laws=Laws.paper()),
        0.0,
        10.0,
    )
    assert float(loads.roller_load[0]) == pytest.approx(float(loads.roller_load[1]), rel=0.01)
    assert (loads.loaded_share > 0.1).all()
    assert (loads.loaded_share < 0.5).all()


def test_only_the_times_asked_for_count():
    case = Case(loads=HubLoads.bundled("24A").window(0.0, 30.0), laws=Laws.paper())
    halves = [row_loads(case, *span) for span in ((0.0, 15.0), (15.0, 30.0))]
    both = row_loads(case, 0.0, 30.0)
    mean = 0.5 * (halves[0].roller_load + halves[1].roller_load)
    np.testing.assert_allclose(both.roller_load, mean, rtol=0.01)
    assert abs(float(halves[0].thrust) - float(halves[1].thrust)) > 1e3
    assert all(variable.attrs["units"] for variable in both.data_vars.values())
