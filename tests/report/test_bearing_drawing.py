"""The section of a bearing is to scale and names every dimension."""

import numpy as np
import pytest

from macroslip import Bearing
from macroslip.report.bearing_drawing import draw_bearing

DIMENSIONS = ("bore_diameter", "outside_diameter", "width", "rollers_per_row", "roller_diameter", "roller_length",
              "contact_angle", "pitch_radius", "outer_raceway_radius", "row_offset", "osculation_inner",
              "osculation_outer", "diametral_clearance")  # fmt: skip


@pytest.mark.parametrize("name", ["skf-240-600-bc", "skf-230-900-ca", "skf-241-600-eca"])
def test_every_dimension_stands_beside_the_drawing(name):
    bearing = Bearing.read(name)
    words = [text.get_text() for text in draw_bearing(bearing).axes[0].texts]
    for key in DIMENSIONS:
        assert sum(one.startswith(f"{key} = {bearing.written(key)}") for one in words) == 1


@pytest.mark.parametrize("name", Bearing.catalogue())
def test_rollers_lie_between_the_raceways_and_touch_both(name):
    bearing = Bearing.read(name)
    axes = draw_bearing(bearing).axes[0]
    rollers = [patch.get_xy() for patch in axes.patches]
    assert len(rollers) == 2
    for outline in rollers:
        # On the sphere, within what the drawing's own rounding of the centre allows.
        reach = np.hypot(*outline.T).max()
        assert reach == pytest.approx(1e3 * bearing.outer_raceway_radius, rel=1e-3)
        assert np.ptp(outline[:, 0]) < 0.5e3 * bearing.width
        assert outline[:, 1].min() > 0.5e3 * bearing.bore_diameter
    np.testing.assert_allclose(rollers[0][:, 0], -rollers[1][:, 0], rtol=1e-12)


def test_a_bearing_without_rings_is_drawn_too():
    bare = Bearing.read("skf-240-600-bc").replace(bore_diameter=None, outside_diameter=None, width=None)
    words = " ".join(text.get_text() for text in draw_bearing(bare).axes[0].texts)
    assert "roller_diameter" in words and "bore_diameter" not in words
