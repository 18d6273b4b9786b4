"""The inside of bearings from their maker's page: exact relations, consistency over a catalogue, known bearings."""

import dataclasses
import math

import numpy as np
import pytest

from macroslip.bearing import Bearing, geometry
from macroslip.bearing.estimate import INNER_WALL, MakersPage, estimate_bearing
from macroslip.bearing.load_ratings import dynamic_load_rating, static_load_rating
from macroslip.errors import InputError
from tools.shipped_bearings import FOLDER, pages, shipped_bearing

from .test_load_ratings import CATALOGUE

PAGE = MakersPage(
    0.60, 0.87, 0.272, 16300e3, 0.30, shoulder=0.784, groove=0.0461, dynamic_load_rating=8502e3
)


def page_of(row):
    size = {
        key: float(text)
        for key, text in row.items()
        if key not in ("designation", "variant") and text != "–"
    }
    return MakersPage(
        1e-3 * size["d_mm"], 1e-3 * size["D_mm"], 1e-3 * size["B_mm"], 1e3 * size["C0_kN"], size["e"],
        shoulder=1e-3 * size["D1_mm"], groove=1e-3 * size["groove_b_mm"] if "groove_b_mm" in size else None,
        dynamic_load_rating=1e3 * size["C_kN"],
    )  # fmt: skip


def rating(function, bearing):
    return function(2, bearing.rollers_per_row, bearing.roller_diameter, bearing.roller_length,
                    bearing.contact_angle, 2 * bearing.pitch_radius)  # fmt: skip


@pytest.fixture(scope="module")
def estimates():
    """Estimate of every bearing of the catalogue, by family."""
    by_family = {}
    for row in CATALOGUE:
        name = row["designation"].replace("/", "-")
        family = row["designation"][:3] + row["variant"][:2]
        by_family.setdefault(family, []).append(
            (page_of(row), estimate_bearing(page_of(row), name).bearing, row)
        )
    return by_family


def test_every_bearing_of_the_catalogue_can_be_estimated(estimates):
    assert sum(map(len, estimates.values())) == 108
    for page, bearing, _ in (estimate for family in estimates.values() for estimate in family):
        # The medians have the static rating of the page, within the scatter of medians and whole rollers.
        assert rating(static_load_rating, bearing) == pytest.approx(
            page.static_load_rating, rel=0.04
        )
        ranged = {
            key: origin for key, origin in bearing.provenance.items() if origin.range is not None
        }
        assert {
            "roller_diameter",
            "roller_length",
            "rollers_per_row",
            "pitch_radius",
        } <= ranged.keys()
        for key, origin in ranged.items():
            assert origin.range[0] <= origin.value <= origin.range[1], key


def test_dynamic_ratings_scatter_little_within_a_family(estimates):
    # The dynamic rating is not used by the estimate: that its ratio is one number for a family speaks for the inside.
    families = [
        [
            rating(dynamic_load_rating, bearing) / page.dynamic_load_rating
            for page, bearing, _ in family
        ]
        for family in estimates.values()
    ]
    assert all(0.78 < np.mean(ratios) < 0.97 for ratios in families)
    scatter = [np.std(ratios) / np.mean(ratios) for ratios in families if len(ratios) >= 5]
    assert len(scatter) >= 5 and max(scatter) < 0.03


def test_flanges_of_the_inner_ring_lie_above_its_raceway(estimates):
    # The shoulder diameter of the inner ring is published and not used: the raceway's edge must lie below it, by a
    # twentieth to a quarter of the roller. Bearings with sheet-metal cages (J) have no flanges.
    families = [estimates[name] for name in ("230CA", "231CA", "240BC", "241EC")]
    flanged = [
        estimate for family in families for estimate in family if "J" not in estimate[2]["variant"]
    ]
    assert len(flanged) == 45
    for _, bearing, row in flanged:
        flange = 5e-4 * float(row["d2_mm"]) - geometry.envelope(bearing).inside
        assert 0.05 * bearing.roller_diameter <= flange <= 0.25 * bearing.roller_diameter


def test_the_base_bearing_lies_within_the_ranges():
    # Its inside was worked out by hand from the same page.
    base, estimated = Bearing.read("skf-240-600-bc"), estimate_bearing(PAGE, "again").bearing
    for key in ("rollers_per_row", "roller_diameter", "roller_length", "outer_raceway_radius", "pitch_radius", "row_offset",
                "contact_angle", "diametral_clearance"):  # fmt: skip
        low, high = (
            estimated.written(key, limit * found_scale(estimated, key))
            for limit in estimated.provenance[key].range
        )
        assert (
            float(low.split()[0])
            <= float(estimated.written(key, getattr(base, key)).split()[0]) * 1.0015
        )
        assert (
            float(estimated.written(key, getattr(base, key)).split()[0])
            <= float(high.split()[0]) * 1.0015
        )


def found_scale(bearing, key):
    """SI value of one unit in which the quantity is written."""
    return getattr(bearing, key) / bearing.provenance[key].value


def test_every_sample_is_a_bearing_with_the_static_rating():
    _, samples = estimate_bearing(PAGE, "x")
    projected = samples["roller_diameter"] * np.cos(samples["contact_angle"])
    product = 2 * samples["rollers_per_row"] * samples["roller_length"] * projected
    c0 = 44e6 * (1 - projected / (2 * samples["pitch_radius"])) * product
    assert np.all((c0 / PAGE.static_load_rating > 0.93) & (c0 / PAGE.static_load_rating < 1.07))
    assert np.ptp(c0) > 0.13 * PAGE.static_load_rating
    centre = np.hypot(samples["pitch_radius"], samples["row_offset"])
    np.testing.assert_allclose(
        centre + samples["roller_diameter"] / 2, samples["outer_raceway_radius"], rtol=1e-13
    )
    assert np.all(samples["rollers_per_row"] == np.round(samples["rollers_per_row"]))
    base = Bearing.read("skf-240-600-bc")
    for k in range(0, samples["contact_angle"].size, 500):
        values = {key: float(sample[k]) for key, sample in samples.items()}
        osculation = values.pop("osculation")
        bearing = base.replace(osculation_inner=osculation, osculation_outer=osculation, **values)
        wall = 2 * geometry.envelope(bearing).inside - PAGE.bore
        share = wall / (PAGE.outside - PAGE.bore)
        assert INNER_WALL.low - 0.006 <= share <= INNER_WALL.high + 0.006


def test_the_same_page_and_seed_give_the_same_bearing():
    assert estimate_bearing(PAGE, "x").bearing == estimate_bearing(PAGE, "x").bearing
    other = estimate_bearing(PAGE, "x", seed=2).bearing
    assert other != estimate_bearing(PAGE, "x").bearing
    # Another seed moves the medians by no more than the sampling error.
    for key in ("roller_diameter", "roller_length", "pitch_radius"):
        assert getattr(other, key) == pytest.approx(
            getattr(estimate_bearing(PAGE, "x").bearing, key), rel=5e-3
        )


def test_overrolling_frequencies_give_number_and_diameter():
    # Exact frequencies of the base bearing, as a maker prints them: Z/2 (1 -+ Dw cos(alpha)/Dpw).
    base = Bearing.read("skf-240-600-bc")
    gamma = base.roller_diameter * math.cos(base.contact_angle) / (2 * base.pitch_radius)
    bpfo, bpfi = (round(14 * (1 + sign * gamma), 2) for sign in (-1, 1))
    narrow = estimate_bearing(dataclasses.replace(PAGE, bpfo=bpfo, bpfi=bpfi), "x").bearing
    assert narrow.rollers_per_row == 28 and narrow.provenance["rollers_per_row"].range == (28, 28)
    assert narrow.roller_diameter == pytest.approx(base.roller_diameter, rel=0.01)
    low, high = narrow.provenance["roller_diameter"].range
    assert high - low < 1.0  # mm; ten without the frequencies
    with pytest.raises(InputError, match="only one overrolling frequency"):
        dataclasses.replace(PAGE, bpfo=bpfo)
    with pytest.raises(InputError, match=r"together 27\.6.*Divide frequencies in hertz"):
        dataclasses.replace(PAGE, bpfo=bpfo - 0.4, bpfi=bpfi)


@pytest.mark.parametrize(
    ("change", "reported"),
    [
        ({"bore": 0.9}, "bore is 900 mm. Allowed: below the outside diameter, 870 mm"),
        ({"width": math.nan}, "width is nan. Allowed: a finite number above 0"),
        ({"groove": 0.3}, "groove is 300 mm. Allowed: below the width, 272 mm"),
        ({"shoulder": 0.9}, "shoulder is 900 mm. Allowed: between bore and outside"),
    ],
)
def test_a_page_that_contradicts_itself(change, reported):
    with pytest.raises(InputError, match=reported):
        dataclasses.replace(PAGE, **change)


@pytest.mark.parametrize(
    "change",
    [
        {"static_load_rating": 33e6},
        {"static_load_rating": 5e6},
        {"axial_factor_e": 0.9},
        {"width": 0.1},
    ],
)
def test_a_page_of_no_bearing(change):
    with pytest.raises(
        InputError,
        match="^no bearing of usual proportions fits these values: of 20000 tried, 0 did",
    ):
        estimate_bearing(dataclasses.replace(PAGE, **change), "x")


def test_what_the_page_leaves_out_follows_from_the_standards():
    bare = MakersPage(0.60, 0.87, 0.272, 16300e3, 0.30)
    bearing, _ = estimate_bearing(bare, "x")
    assert bearing.provenance["dynamic_load_rating"].tag == "D"
    assert bearing.dynamic_load_rating == pytest.approx(
        rating(dynamic_load_rating, bearing), rel=1e-4
    )
    assert bearing.axial_factor_y2 == pytest.approx(
        0.67 / math.tan(bearing.contact_angle), abs=0.005
    )
    assert bearing.fatigue_load_limit == pytest.approx(1100e3, rel=0.02)  # as published
    # Without the shoulder the sphere is less well known.
    with_shoulder = estimate_bearing(PAGE, "x").bearing.provenance["outer_raceway_radius"].range
    without = bearing.provenance["outer_raceway_radius"].range
    assert without[1] - without[0] > 2 * (with_shoulder[1] - with_shoulder[0])


@pytest.mark.parametrize("name", sorted(pages()))
def test_shipped_files_are_what_the_estimate_gives(name):
    text = (FOLDER / f"{name}.yaml").read_text(encoding="utf-8")
    assert text == shipped_bearing(name).as_yaml()
    bearing = Bearing.read(name)
    tags = {key: origin.tag for key, origin in bearing.provenance.items()}
    assert set(tags.values()) == {"V", "D", "E"}
    assert all(origin.note for origin in bearing.provenance.values())
    # A maker's factors are those of one contact angle, and what was typed from its page agrees with itself.
    cot = 1 / math.tan(bearing.contact_angle)
    assert bearing.axial_factor_y1 == pytest.approx(0.45 * cot, rel=0.04)
    assert bearing.axial_factor_y2 == pytest.approx(0.67 * cot, rel=0.04)
    assert bearing.axial_factor_y0 == pytest.approx(0.44 * cot, rel=0.08)
    annulus = (
        math.pi
        / 4
        * (bearing.outside_diameter**2 - bearing.bore_diameter**2)
        * bearing.width
        * 7850
    )
    assert 0.76 < bearing.mass / annulus < 0.88


def test_the_catalogue_has_what_was_promised():
    sizes = ("240-560", "240-600", "240-630", "240-710", "240-800", "240-1120")
    promised = {f"skf-{size}-bc" for size in sizes} | {"skf-230-600-ca", "skf-230-900-ca", "skf-231-630-ca",
                                                       "skf-241-600-eca"}  # fmt: skip
    assert promised <= set(Bearing.catalogue())
