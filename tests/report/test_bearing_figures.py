"""Figures of the whole bearing: the numbers they are given, units, and what grey leaves."""

import io

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_rgb

from macroslip.report import bearing_figures as draw
from macroslip.report.style import INTERFACE, ROW, new_figure
from macroslip.result.orbit_profile import orbit_profile

pytestmark = pytest.mark.slow

ROWS, INTERFACES = ["downwind", "upwind"], ["inner", "outer", "cage"]


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
    draw.plot_case_energies(axes, study)
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
