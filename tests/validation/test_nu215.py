"""Signs of slip of an assumed NU 215 that the program has, and the words for those that it has not."""

from __future__ import annotations

import pytest

from macroslip.rating.iso import minimum_load_of_rollers
from macroslip.rating.kinds import ratings_of
from validation import nu215

pytestmark = pytest.mark.slow


def test_slip_rises_with_oil_and_speed_and_falls_with_load():
    assert nu215.slip(supply=0.5) < nu215.slip() - 0.05
    assert nu215.slip(rpm=1000.0) < nu215.slip() - 0.05
    assert nu215.slip(load=2000.0) < nu215.SLIPS < nu215.slip()


def test_a_set_without_clearance_does_not_slip():
    assert abs(nu215.slip(clearance=nu215.TIGHT, contour="crowned")) < 0.01
    assert abs(nu215.slip(clearance=nu215.TIGHT)) < nu215.SLIPS


def test_the_least_load_is_that_of_the_assumed_rating():
    rating = ratings_of(nu215.BEARING).dynamic
    assert minimum_load_of_rollers(rating) == pytest.approx(0.02 * rating, rel=1e-12)
    # Makers print about 150 kN for this size.
    assert 120e3 < rating < 160e3
