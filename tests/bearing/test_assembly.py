"""Bearings whose parts do not fit into each other are refused, each with one paragraph."""

import math

import numpy as np
import pytest

from macroslip.bearing import Bearing, geometry
from macroslip.errors import InputError

NAME = "skf-240-600-bc"


@pytest.fixture(scope="module")
def base():
    return Bearing.read(NAME)


def on_sphere(base, **values):
    """The bearing with other values, roller centres moved on to the sphere."""
    new = {
        key: getattr(base, key)
        for key in ("outer_raceway_radius", "roller_diameter", "contact_angle")
    } | values
    centre = new["outer_raceway_radius"] - new["roller_diameter"] / 2
    angle = new["contact_angle"]
    return base.replace(
        **{"pitch_radius": centre * math.cos(angle), "row_offset": centre * math.sin(angle)}
        | values
    )


@pytest.mark.parametrize("name", Bearing.catalogue())
def test_envelope_is_that_of_a_turned_barrel(name):
    # The roller's meridian, leaning by the contact angle, point by point.
    bearing = Bearing.read(name)
    contour, half, r = (
        geometry.roller_contour_radius(bearing),
        bearing.roller_length / 2,
        bearing.roller_diameter / 2,
    )
    along = np.linspace(-half, half, 2001)
    radius = r - contour + np.sqrt(contour**2 - along**2)
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    axial = [bearing.row_offset + along * cosine + side * radius * sine for side in (1, -1)]
    radial = [bearing.pitch_radius - along * sine + side * radius * cosine for side in (1, -1)]
    space = geometry.envelope(bearing)
    assert space.nearest == pytest.approx(np.min(axial), rel=1e-12)
    assert space.farthest == pytest.approx(np.max(axial), rel=1e-12)
    assert space.inside == pytest.approx(radial[1][-1], rel=1e-12)
    # The outer contact lies on the sphere all along but for the osculation.
    assert np.hypot(axial[0], radial[0]).max() <= bearing.outer_raceway_radius * 1.0005


def test_rows_that_coincide(base):
    with pytest.raises(InputError) as caught:
        on_sphere(base, contact_angle=0.0)
    assert str(caught.value).startswith(
        "both rows lie in one plane: row_offset is 0 m, roller_length 106 mm. Allowed: "
    )


def test_rows_that_interpenetrate(base):
    with pytest.raises(
        InputError, match="^the rollers of the two rows overlap by 0.0080.* m: row_offset is"
    ):
        on_sphere(base, contact_angle=math.radians(8.0))
    assert on_sphere(base, contact_angle=math.radians(9.0)).row_offset < base.row_offset


def test_a_width_too_small_for_the_rows(base):
    least = 2.0 * geometry.envelope(base).farthest
    with pytest.raises(
        InputError, match="^the rollers reach 0.1321.* m from .* width 0.06 m. Allowed: .*0.264"
    ):
        base.replace(width=0.06)
    with pytest.raises(InputError, match="width"):
        base.replace(width=least - 1e-6)
    assert base.replace(width=least + 1e-6).width == least + 1e-6


def test_a_bore_larger_than_the_inner_raceway(base):
    largest = 2.0 * geometry.envelope(base).inside
    with pytest.raises(
        InputError, match="^bore_diameter is 0.7 m, so that nothing is left .* below 0.66"
    ):
        base.replace(bore_diameter=0.7)
    assert base.replace(bore_diameter=largest - 1e-6).bore_diameter == largest - 1e-6
    with pytest.raises(InputError, match="bore_diameter is"):
        base.replace(bore_diameter=0.9, outside_diameter=None)


def test_an_outer_ring_smaller_than_the_raceway_sphere(base):
    with pytest.raises(
        InputError,
        match="^outside_diameter is 0.8 m, smaller than the outer raceway sphere. .* 0.8298 m",
    ):
        base.replace(outside_diameter=0.8)
    assert base.replace(outside_diameter=0.83).outside_diameter == 0.83


def test_dimensions_that_are_not_given_are_not_checked(base):
    bare = base.replace(bore_diameter=None, outside_diameter=None, width=None)
    assert bare.pitch_radius == base.pitch_radius


def test_problems_in_a_file_come_with_its_lines(tmp_path, base):
    entries = base.as_dict() | {
        "width": {"value": 60, "unit": "mm"},
        "bore_diameter": {"value": 700, "unit": "mm"},
    }
    text = Bearing.read(NAME).as_yaml()
    for key in ("width", "bore_diameter"):
        line = next(line for line in text.splitlines() if line.startswith(f"{key}:"))
        text = text.replace(line, f"{key}: {entries[key]['value']} mm")
    path = tmp_path / "mine.yaml"
    path.write_text(text, encoding="utf-8")
    numbers = [
        n
        for n, line in enumerate(text.splitlines(), 1)
        if line.startswith(("width:", "bore_diameter:"))
    ]
    with pytest.raises(InputError) as caught:
        Bearing.read(path)
    assert str(caught.value).startswith("2 problems: (1) ")
    assert all(f"mine.yaml, line {number}: " in str(caught.value) for number in numbers)
