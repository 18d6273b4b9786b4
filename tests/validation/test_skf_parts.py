"""Rolling and sliding torque beside SKF's, with the agreement that was found as bound; and the replenishment factor."""

import numpy as np
import pytest

from macroslip import Bearing, Lubricant
from macroslip.contact.rolling import replenishment
from macroslip.torque import OilBath, skf_torque
from validation import skf_parts

BEARING = Bearing.read("skf-240-600-bc")


def test_replenishment_is_what_a_covered_roller_has_more_than_a_greased_one():
    oil = Lubricant.read("vg460-pao")
    greased, covered = (
        skf_torque(BEARING, oil, 3e5, 1e5, 2.0, bath=bath) for bath in (None, OilBath(0.2, 0.0))
    )
    factor = replenishment(
        oil.viscosity / oil.density, 2.0, BEARING.bore_diameter, BEARING.outside_diameter
    )
    assert greased.rolling / covered.rolling == pytest.approx(float(factor), rel=1e-12)


def test_replenishment_is_whole_at_rest_and_falls_with_speed_and_viscosity():
    factor = replenishment(np.array([1e-4, 6e-4]), np.array([0.0, -1.0, 3.0])[:, None], 0.6, 0.87)
    assert np.all(factor[0] == 1.0)
    assert np.all(np.diff(factor[1:], axis=0) < 0.0)
    assert np.all(np.diff(factor[1:], axis=1) < 0.0)


@pytest.mark.slow
def test_full_rolling_is_skfs_without_replenishment_over_a_factor_of_20_in_viscosity():
    cold, warm = (skf_parts.parts(temperature=at) for at in (skf_parts.COLD, skf_parts.WARM))
    ratio = [state.rolling / state.skf_rolling for state in (cold, warm)]
    assert ratio[0] == pytest.approx(1.37, abs=0.02)
    assert ratio[1] == pytest.approx(0.89, abs=0.02)
    assert [state.replenishment for state in (cold, warm)] == pytest.approx(
        [0.577, 0.974], abs=1e-3
    )
    # Sliding falls with viscosity, and SKF's does not.
    assert warm.sliding / warm.skf_sliding < 0.37
    assert warm.skf_sliding > 0.99 * cold.skf_sliding
