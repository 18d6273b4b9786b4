"""The section of a tapered roller bearing: where rows lie, apexes, and what it says."""

import numpy as np
import pytest

from macroslip.bearing.kinds import read_bearing
from macroslip.kinds.captions import ROLLER
from macroslip.report.bearing_drawing import draw_bearing
from tests.outlines import outlines

BEARING = read_bearing("tdo-main-bearing")


def words(figure) -> dict[str, str]:
    """What the drawing says of either row."""
    texts = [text.get_text() for text in figure.axes[0].texts]
    return {
        row: next(text for text in texts if f"“{row}”" in text) for row in ("downwind", "upwind")
    }


@pytest.mark.parametrize(("arrangement", "side"), [("O", "upwind"), ("X", "downwind")])
def test_the_drawing_says_where_the_row_lies_that_carries_thrust_downwind(arrangement, side):
    said = words(draw_bearing(BEARING.replace(arrangement=arrangement)))
    assert "thrust along +Z0" in said["downwind"]
    assert f"lies {side} of the mid-plane" in said["downwind"]
    assert f"lies {side} of the mid-plane" not in said["upwind"]


@pytest.mark.parametrize("arrangement", ["O", "X"])
def test_rollers_have_their_size_and_the_thick_end_away_from_the_apex(arrangement):
    """Of the outline alone: its area, its corners, and where both sides of the cone meet."""
    figure = draw_bearing(BEARING.replace(arrangement=arrangement))
    rollers = outlines(figure, ROLLER)
    assert len(rollers) == 2
    apexes = []
    for points in rollers:
        corners = points[[0, 1, -3, -2]]
        small = np.linalg.norm(corners[3] - corners[0])
        large = np.linalg.norm(corners[2] - corners[1])
        assert 0.5 * (small + large) == pytest.approx(1e3 * BEARING.roller_diameter, rel=1e-3)
        side = corners[1] - corners[0]
        other = corners[2] - corners[3]
        along = np.linalg.solve(np.stack([side, -other], axis=1), corners[3] - corners[0])
        meet = corners[0] + along[0] * side
        assert meet[1] == pytest.approx(0.0, abs=0.5)
        assert small < large
        apexes.append(meet[0])
    middles = [points[:, 0].mean() for points in rollers]
    # In O arrangement the lines of both rows cross the mid-plane.
    crosses = [middle * apex < 0.0 for middle, apex in zip(middles, apexes, strict=True)]
    assert crosses == [arrangement == "O"] * 2
