"""What a user may say of the cage."""

import numpy as np
import pytest

from macroslip import BackwardEuler, BearingLoads, Cage, Case, InputError, Laws
from macroslip.bearing import Bearing
from macroslip.whole.model import whole_bearing

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"gap": -1e-4}, "cage.gap: it is -0.0001"),
        ({"mass": 0.0}, "without mass"),
        ({"impact": "wet"}, "squeeze-film, dry"),
        ({"arrangement": "two"}, "one, per-row"),
        ({"damping": float("nan")}, "cage.damping: it is nan"),
        ({"damping": 30.0}, "a squeeze film has none"),
        ({"seed": -1}, "cage.seed: it is -1"),
        ({"weight": 1}, "true or false"),
        ({"offsets": "left"}, "centred, random"),
    ],
)
def test_wrong_values_are_named(wrong, words):
    with pytest.raises(InputError, match=words):
        Cage(**wrong)


def test_pockets_must_fit_between_the_rollers():
    with pytest.raises(InputError, match="pockets would overlap"):
        Cage(gap=0.02).check_fit(Bearing.read("skf-240-600-bc"))


def test_a_fixed_step_is_refused_because_of_impacts():
    loads = BearingLoads.constant([0.0, -3e5, 0.0], 2.0, 1.0)
    with pytest.raises(InputError, match="cannot resolve the impacts"):
        Case(
            loads=loads,
            laws=Laws.paper(),
            dynamics="whole-bearing",
            integrator=BackwardEuler(step=1e-3),
        )
    with pytest.raises(InputError, match="dynamics"):
        Case(loads=loads, laws=Laws.paper(), dynamics="free")
    with pytest.raises(InputError, match="do not use it"):
        Case(loads=loads, laws=Laws.paper(), cage=Cage(gap=1e-3))


def test_random_starts_are_seeded_and_within_the_pocket():
    cage = Cage(offsets="random", diameter_scatter=1.5e-6, seed=7)
    offsets = cage.start_offsets(56)
    assert np.array_equal(offsets, cage.start_offsets(56))
    assert not np.array_equal(offsets, Cage(offsets="random", seed=8).start_offsets(56))
    assert np.abs(offsets).max() <= 0.5 * cage.gap
    deviations = cage.diameter_deviations(2, 28)
    assert deviations.mean(axis=1) == pytest.approx(0.0, abs=1e-20)
    assert 0.5e-6 < deviations.std() < 2.5e-6


@pytest.mark.parametrize(
    ("given", "free"),
    [
        ({}, True),
        ({"weight": False}, False),
        ({"weight": False, "axis": "free"}, True),
        ({"axis": "pinned"}, False),
    ],
)
def test_axis_is_free_unless_pinned_or_without_weight(given, free, bearing, lubricant):
    assembly = whole_bearing(bearing, lubricant, Cage(**given), tilt=0.1, laws=Laws.paper())
    assert (assembly.translates, assembly.cage_weight > 0.0) == (free, given.get("weight", True))
