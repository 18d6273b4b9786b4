"""Slip of cage and rollers of a cylindrical roller bearing: trends that were measured, and jumps."""

import pytest

from macroslip import Laws
from validation.cage_slip import jumps, ramp, steady

pytestmark = pytest.mark.slow


def test_slip_is_large_in_cold_oil_and_under_light_loads_and_larger_without_load():
    cold, warm, loaded = steady(8e3, 40.0), steady(8e3, 80.0), steady(40e3, 60.0)
    assert 0.6 < cold.loaded < cold.unloaded < 0.9
    assert warm.loaded < 0.7 * cold.loaded and warm.unloaded < 0.7 * cold.unloaded
    assert loaded.loaded < 0.1 and loaded.unloaded < 0.35 and loaded.cage < 0.02


@pytest.mark.parametrize("laws", [Laws.paper(), Laws.physical()], ids=lambda laws: laws.name)
def test_a_cage_that_slips_is_caught_at_a_higher_load_than_that_at_which_it_was_lost(laws):
    lost, held = jumps(ramp(laws))
    assert held > 1.3 * lost
