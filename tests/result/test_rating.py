"""The rating of a case uses the case's loads, bearing and lubricant."""

import dataclasses

import numpy as np
import xarray as xr

from macroslip import Bearing, BearingLoads, Case, HubLoads, Laws, main_bearing_load
from macroslip.rating import rate, roller_load_history
from macroslip.result.rating import rate_case


def test_hub_loads_go_through_the_statics():
    hub = HubLoads.bundled("14B").window(100.0, 102.0)
    case = Case(loads=hub, laws=Laws.paper())
    loads = main_bearing_load(hub, case.drivetrain)
    by_hand = rate(
        case.bearing, case.lubricant, *roller_load_history(case.bearing, case.lubricant, loads)
    )
    xr.testing.assert_identical(rate_case(case), by_hand)


def test_another_bearing_rates_otherwise():
    case = Case(loads=BearingLoads.constant([0.0, -400e3, 60e3], 2.1, 1.0), laws=Laws.paper())
    larger = dataclasses.replace(case, bearing=Bearing.read("skf-240-800-bc"))
    assert np.all(rate_case(larger).reference_life > rate_case(case).reference_life)
    assert rate_case(case, contamination=0.1).modified_life < rate_case(case).modified_life
