"""The section of a cylindrical roller bearing: one roller between straight raceways, and what it says."""

import numpy as np
import pytest

from macroslip.kinds.captions import ROLLER, STEEL
from macroslip.report.bearing_drawing import draw_bearing
from tests.outlines import outlines
from validation.cage_slip import BEARING as CROWNED
from validation.nu215 import BEARING as PROFILED


@pytest.mark.parametrize("bearing", [CROWNED, PROFILED], ids=["crowned", "profiled"])
def test_the_roller_fills_the_space_between_the_raceways(bearing):
    figure = draw_bearing(bearing)
    (roller,) = outlines(figure, ROLLER)
    assert np.ptp(roller[:, 0]) == pytest.approx(1e3 * bearing.roller_length)
    assert np.ptp(roller[:, 1]) == pytest.approx(1e3 * bearing.roller_diameter)
    outer, inner = outlines(figure, STEEL)
    assert outer[:, 1].min() == pytest.approx(roller[:, 1].max())
    assert inner[:, 1].max() == pytest.approx(roller[:, 1].min())
    assert outer[:, 1].max() == pytest.approx(500.0 * bearing.outside_diameter)


@pytest.mark.parametrize("bearing", [CROWNED, PROFILED], ids=["crowned", "profiled"])
def test_rings_end_behind_the_raceways_where_no_envelope_is_given(bearing):
    bare = bearing.replace(bore_diameter=None, outside_diameter=None, width=None)
    outer, inner = outlines(draw_bearing(bare), STEEL)
    assert outer[:, 1].max() > 1e3 * bearing.outer_raceway_radius
    assert 0.0 < inner[:, 1].min() < 1e3 * bearing.pitch_radius


def test_every_dimension_is_named_with_its_value_and_its_source():
    texts = [text.get_text() for text in draw_bearing(PROFILED).axes[0].texts]
    assert "pitch_radius = 51.5 mm (E)" in texts and "roller_profile: logarithmic" in texts
    assert "bore_diameter = 75 mm (V)" in texts and "nu215" in texts
