"""Figures draw the numbers they are given, with units, and differ without their colours."""

import io

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_rgb

from macroslip import Bearing
from macroslip.report import bearing_figures as draw
from macroslip.report.bearing_drawing import draw_bearing
from macroslip.report.study_figures import plot_case_energies
from macroslip.report.style import INTERFACE, ROW, new_figure, save
from macroslip.result.orbit_profile import orbit_profile

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def profile(result):
    return orbit_profile(result)


@pytest.fixture
def axes():
    return new_figure(4.0, 3.0)[1][0]


def in_grey(colour):
    return float(np.dot(to_rgb(colour), (0.299, 0.587, 0.114)))


def test_polar_lines_are_in_millijoules_and_closed(profile):
    energy = profile["orbit"].energy_over_orbit
    axes = new_figure(4.0, 4.0, subplot_kw={"projection": "polar"})[1][0]
    assert draw.plot_energy_over_orbit(axes, energy, "upwind") is axes
    cage = axes.lines[2]
    np.testing.assert_allclose(cage.get_ydata()[:-1], 1e3 * energy.sel(row="upwind", interface="cage"))
    assert cage.get_xdata()[-1] == pytest.approx(cage.get_xdata()[0] + 2.0 * np.pi)
    per_orbit = 5e3 * float(energy.sel(row="upwind", interface="cage").sum())
    assert f"cage: {per_orbit:.3g} mJ per orbit" in [text.get_label() for text in axes.lines]
    # Looking downwind the bottom is below and rollers rise on the left.
    assert axes.get_theta_offset() == pytest.approx(1.5 * np.pi) and axes.get_theta_direction() == -1
    assert "[mJ/°]" in axes.get_title(loc="left")


def test_film_and_its_parameter_share_an_axis(axes, profile):
    draw.plot_film_over_orbit(axes, profile["orbit"], "downwind")
    inner = profile["orbit"].film_thickness.sel(row="downwind", interface="inner", quantile=0.5)
    np.testing.assert_allclose(axes.lines[0].get_ydata(), 1e6 * inner)
    axes.figure.draw_without_rendering()
    left, right = axes.get_ylim(), axes.child_axes[0].get_ylim()
    np.testing.assert_allclose(np.array(right) / left, 1e-6 / 3e-7)  # roughness 0.3 µm
    assert "[µm]" in axes.get_ylabel() and "Λ [–]" in axes.child_axes[0].get_ylabel()


def test_load_zone(axes, profile):
    load = profile["load_zone"].roller_load
    draw.plot_load_zone(axes, load, "downwind")
    np.testing.assert_allclose(axes.images[0].get_array(), 1e-3 * load.sel(row="downwind").values.T)
    assert "[s]" in axes.get_xlabel() and "[°]" in axes.get_ylabel()
    assert "[kN]" in axes.figure.axes[-1].get_ylabel()


def test_spread_of_rollers(axes, result):
    draw.plot_roller_spread(axes, result.energy, "upwind")
    energy = result.energy.sum("interface").sel(row="upwind")
    np.testing.assert_allclose(axes.lines[1].get_ydata(), energy / energy.mean())
    np.testing.assert_array_equal(axes.lines[1].get_xdata(), [0, 7, 14, 21])


def test_film_range_leaves_out_what_never_carries_load(axes, result):
    share = result.outside_film_range.copy(deep=True)
    share.loc[{"row": "upwind", "interface": "outer"}] = np.nan
    draw.plot_outside_film_range(axes, share)
    assert [len(one) for one in axes.containers if hasattr(one, "patches")] == [3, 2]
    heights = [bar.get_height() for bar in axes.containers[0].patches]
    np.testing.assert_allclose(heights, 100.0 * share.sel(row="downwind").mean("roller"))
    assert "[%]" in axes.get_ylabel()


def test_energy_by_interface(axes, result):
    draw.plot_energy_by_interface(axes, result.energy)
    heights = [bar.get_height() for bar in axes.containers[1].patches]
    np.testing.assert_allclose(heights, result.energy.sel(row="upwind").mean("roller"))
    assert axes.get_yscale() == "log" and "[J]" in axes.get_ylabel()


def test_peak_exceedance_begins_at_one_and_counts_orbits(axes, result):
    draw.plot_peak_exceedance(axes, result)
    power, share = axes.lines[0].get_data()
    peak = np.sort(result.peak_power.sel(row="downwind").max("interface").values.ravel())
    np.testing.assert_allclose(power[1:], peak)
    assert share[0] == share[1] == 1.0
    assert share[-1] == pytest.approx(1.0 / peak.size)


def test_cases_of_a_study(axes, result):
    names = xr.DataArray(["a", "b"], dims="case", name="case")
    study = xr.concat([result[["energy"]], 2.0 * result[["energy"]]], names)
    plot_case_energies(axes, study)
    middle = axes.containers[0].lines[0].get_ydata()
    assert middle[1] == pytest.approx(2.0 * middle[0])
    assert axes.get_ylim()[0] == 0.0


def test_lines_and_markers_differ_without_their_colours():
    both = ("linestyle", "marker")
    for group, marks in ((INTERFACE, ("linestyle",)), (ROW, both)):
        for mark in marks:
            assert len({one[mark] for one in group.values()}) == len(group)
        # None vanishes on white paper.
        assert max(in_grey(one["color"]) for one in group.values()) < 0.6


def test_bars_differ_in_grey(result):
    axes = new_figure(4.0, 3.0)[1][0]
    draw.plot_energy_by_interface(axes, result.energy)
    hatches = [{bar.get_hatch() for bar in group.patches} for group in axes.containers]
    assert hatches[0] != hatches[1]
    content = io.BytesIO()
    axes.figure.savefig(content, format="raw", dpi=100)
    pixels = np.frombuffer(content.getvalue(), np.uint8).reshape(-1, 4)[:, :3] @ np.array([0.299, 0.587, 0.114])
    assert (pixels < 130).sum() > 1000 < (pixels > 250).sum()


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


def test_a_figure_is_saved_as_picture_and_as_drawing(axes, tmp_path):
    axes.plot([0.0, 1.0])
    assert save(axes.figure, tmp_path, "one") == ["one.png", "one.svg"]
    assert (tmp_path / "one.png").read_bytes().startswith(b"\x89PNG")
    assert "<dc:date>" not in (tmp_path / "one.svg").read_text(encoding="utf-8")
