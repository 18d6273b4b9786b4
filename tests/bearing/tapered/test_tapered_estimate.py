"""The inside of tapered bearings from their makers' pages: known bearings, exact relations, refusals."""

import dataclasses
import math

import numpy as np
import pytest

from macroslip.bearing.load_ratings import static_load_rating
from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.bearing.tapered.estimate import (
    STATIC_RATING,
    TaperedPage,
    estimate_tapered_bearing,
)
from macroslip.errors import InputError

#: Of a bearing 32216: dimensions and ratings of a catalogue, load centre a = 30 mm.
SMALL = TaperedPage(
    rows=1,
    bore=0.080,
    outside=0.140,
    width=0.03525,
    static_load_rating=260e3,
    axial_factor_e=0.42,
    axial_factor_y=1.43,
    load_centre=0.030,
    distance=0.120,
)
#: Of BT2B 332493/HA430, whose boundary dimensions are not at hand: C, C0, Pu and Y1.
MAIN = TaperedPage(
    rows=2,
    static_load_rating=16000e3,
    dynamic_load_rating=8090e3,
    fatigue_load_limit=1060e3,
    axial_factor_y=0.77,
)


@pytest.mark.parametrize(("page", "known"), [(SMALL, "32216-pair"), (MAIN, "tdo-main-bearing")])
def test_the_known_inside_lies_within_the_ranges(page, known):
    """Rollers of a 32216 were measured; those of the main bearing were worked out by hand."""
    bearing = estimate_tapered_bearing(page, "again").bearing
    expected = TaperedBearing.read(known)
    for key in ("rollers_per_row", "roller_diameter", "roller_length", "pitch_radius"):
        origin = bearing.provenance[key]
        low, high = origin.range
        assert low <= expected.provenance[key].value <= high, key
    assert bearing.outer_angle == pytest.approx(expected.outer_angle, abs=math.radians(0.15))
    assert bearing.arrangement == expected.arrangement


def test_the_load_centre_of_the_small_bearing_is_that_of_its_page():
    """The rollers' large ends then have room for a rib of usual thickness beside them."""
    bearing, samples = estimate_tapered_bearing(SMALL, "pair")
    row = tapered_geometry(bearing)
    reach = 0.5 * row.roller_length * math.cos(row.axis_angle)
    rib = SMALL.load_centre - row.load_centre - reach
    assert 0.05 < rib / SMALL.width < 0.16
    assert np.ptp(samples["row_offset"]) == 0.0
    assert bearing.row_offset == 0.060
    assert bearing.preload == 0.0


@pytest.mark.parametrize("page", [SMALL, MAIN])
def test_every_sample_has_the_static_rating_of_the_page(page):
    samples = estimate_tapered_bearing(page, "again").samples
    for k in range(0, samples["rollers_per_row"].size, 997):
        rating = static_load_rating(
            page.rows,
            int(samples["rollers_per_row"][k]),
            samples["roller_diameter"][k],
            samples["roller_length"][k],
            samples["outer_angle"][k],
            2.0 * samples["pitch_radius"][k],
        )
        assert STATIC_RATING.low <= rating / page.static_load_rating <= STATIC_RATING.high


@pytest.mark.parametrize("arrangement", ["O", "X"])
def test_load_centres_of_a_double_row_are_as_far_apart_as_the_page_says(arrangement):
    """Spread 2 (c + centre) in O and 2 (c − centre) in X arrangement."""
    apart = 0.60 if arrangement == "O" else 0.10
    page = dataclasses.replace(MAIN, arrangement=arrangement, load_centre=apart)
    bearing = estimate_tapered_bearing(page, "again").bearing
    centre = tapered_geometry(bearing).load_centre
    spread = 2.0 * (bearing.row_offset + (centre if arrangement == "O" else -centre))
    # Medians of the parts and the median of the sum differ a little.
    assert spread == pytest.approx(apart, abs=0.012)


def test_e_and_y_of_a_page_give_the_same_angle():
    only_e = dataclasses.replace(SMALL, axial_factor_y=None)
    only_y = dataclasses.replace(SMALL, axial_factor_e=None)
    angles = [
        np.median(estimate_tapered_bearing(page, "again").samples["outer_angle"])
        for page in (only_e, only_y)
    ]
    assert angles[0] == pytest.approx(angles[1], abs=math.radians(0.05))
    assert math.tan(angles[0]) == pytest.approx(0.42 / 1.5, rel=0.01)


def test_values_say_whether_they_are_published_or_estimated(tmp_path):
    bearing = estimate_tapered_bearing(SMALL, "pair").bearing
    tags = {key: origin.tag for key, origin in bearing.provenance.items()}
    assert tags["bore_diameter"] == tags["outside_diameter"] == "V"
    assert tags["outer_angle"] == tags["static_load_rating"] == "D"
    estimated = ("rollers_per_row", "roller_diameter", "rib_sphere_ratio", "rib_contact_height")
    assert {tags[key] for key in estimated} == {"E"}
    assert bearing.static_load_rating == pytest.approx(520e3)
    path = tmp_path / "pair.yaml"
    path.write_text(bearing.as_yaml(), encoding="utf-8")
    assert TaperedBearing.read(path) == bearing


def test_ratings_of_a_pair_are_those_of_two_rows():
    page = dataclasses.replace(SMALL, dynamic_load_rating=199e3, fatigue_load_limit=30e3)
    bearing = estimate_tapered_bearing(page, "pair").bearing
    assert bearing.dynamic_load_rating == pytest.approx(2 ** (7 / 9) * 199e3, rel=1e-4)
    assert bearing.fatigue_load_limit == pytest.approx(60e3)


@pytest.mark.parametrize(
    ("change", "reported"),
    [
        ({"axial_factor_y": 2.0}, "two different contact angles, 15.64 and 11.31 deg"),
        ({"axial_factor_e": None, "axial_factor_y": None}, "neither e nor Y is given"),
        ({"bore": 0.15}, "bore is 150 mm. Allowed: below the outside diameter, 140 mm"),
        ({"bore": None}, "the size of the bearing is not given"),
        ({"distance": None}, "the distance of the two rows is missing"),
        ({"rows": 2}, "a distance of two bearings is given for a double-row bearing"),
        ({"arrangement": "T"}, "arrangement is 'T'. Allowed: O or X"),
        ({"static_load_rating": 26e6}, "no bearing of usual proportions fits"),
        ({"width": -0.03}, "width is -0.03. Allowed: a finite number above 0"),
    ],
)
def test_a_page_that_contradicts_itself_is_refused_in_a_paragraph(change, reported):
    with pytest.raises(InputError) as caught:
        estimate_tapered_bearing(dataclasses.replace(SMALL, **change), "pair")
    assert reported in str(caught.value)
