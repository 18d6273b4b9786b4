"""The figures draw the numbers they are given, with units on the axes."""

import numpy as np
import pytest
import xarray as xr

from macroslip.report.orbit_figures import plot_cumulative_energy, plot_spin, plot_varying_over_static
from macroslip.report.style import new_figure, save
from macroslip.reproduction import paper_figures
from macroslip.reproduction.solver_figures import (
    plot_deviation,
    plot_nonlinear_tolerance,
    plot_stability,
    plot_step_size,
)
from macroslip.reproduction.wind_speed_figures import (
    plot_energy,
    plot_energy_ratio,
    plot_peak_power,
    plot_peak_power_ratio,
)

NAMES = ["12A", "12C", "14A", "14C"]
ROWS = ["downwind", "upwind"]


@pytest.fixture
def numbers():
    values = np.arange(1.0, 9.0).reshape(4, 2)
    two = ("case", "row")
    return xr.Dataset(
        {
            "energy_normalised": (two, values),
            "energy_min_normalised": (two, values - 0.25),
            "energy_max_normalised": (two, values + 0.5),
            "both_rows_normalised": ("case", values[:, 0] + 20.0),
            "energy_ratio": ("case", values[:, 0] + 30.0),
            "peak_power_mean_normalised": (two, values + 40.0),
            "peak_power_std_normalised": (two, values + 100.0),
            "peak_power_ratio": ("case", values[:, 0] + 50.0),
        },
        {
            "case": NAMES,
            "row": ROWS,
            "wind_speed": ("case", [12.0, 12.0, 14.0, 14.0]),
            "turbulence": ("case", ["A", "C", "A", "C"]),
        },
    )


@pytest.fixture
def turn():
    angle = np.linspace(0.0, 360.0, 9)
    return xr.Dataset(
        {
            "spin_speed": ("angle", np.linspace(9.0, 10.0, 9)),
            "spin_speed_pure": ("angle", np.full(9, 11.0)),
            "energy_fraction": ("angle", np.linspace(0.0, 1.0, 9)),
            "roller_load": ("angle", np.where(np.abs(angle - 180.0) < 100.0, 0.0, 1e3)),
        },
        {"angle": angle},
        {"energy_J": 0.165},
    )


@pytest.fixture
def stability():
    angle = np.linspace(300.0, 330.0, 7)
    names = [f"spin_ratio_{method}" for method in ("explicit", "backward", "converged")]
    names += ["deviation_explicit", "deviation_backward"]
    values = {name: ("angle", np.linspace(0.1, 1.0, 7) + k) for k, name in enumerate(names)}
    return xr.Dataset(values, {"angle": angle}, {"limit_angle_deg": 312.0, "step_s": 1e-3})


@pytest.fixture
def tolerance_experiment():
    values = np.array([[0.2, 0.1], [20.0, 0.1]])
    two = ("stopping_tolerance", "row")
    return xr.Dataset(
        {
            "energy": (two, values),
            "static_energy": (two, np.full((2, 2), 0.16)),
            "ratio": (two, values / 0.16),
            "energy_converged": ("row", [0.19, 0.1]),
        },
        {"stopping_tolerance": [1e-12, 1e-7], "row": ROWS},
    )


@pytest.fixture
def step_experiment():
    return xr.Dataset(
        {
            "mean_peak_power": (("step", "row"), np.array([[0.04, 0.02], [0.04, 0.4]])),
            "mean_peak_power_converged": ("row", [0.041, 0.45]),
        },
        {"step": [3e-2, 1e-4], "row": ROWS},
    )


@pytest.fixture
def axes():
    return new_figure(4.0, 3.0)[1][0]


def line(axes, label):
    """Data of the line or of the error bar's middle with this label."""
    for container in axes.containers:
        if container.get_label() == label:
            return container.lines[0].get_data()
    return next(one for one in axes.lines if one.get_label() == label).get_data()


def test_energy_of_a_row_with_the_range_of_its_rollers(axes, numbers):
    assert plot_energy(axes, numbers, "upwind") is axes
    speed, energy = line(axes, "C")
    np.testing.assert_allclose(energy, [4.0, 8.0])
    np.testing.assert_allclose(np.round(speed), [12.0, 14.0])
    ends = axes.containers[0].lines[2][0].get_segments()[0][:, 1]
    np.testing.assert_allclose(ends, [2.0 - 0.25, 2.0 + 0.5])
    assert axes.get_xlabel() == "mean wind speed [m/s]"
    assert "[–]" in axes.get_ylabel()


def test_energy_of_both_rows(axes, numbers):
    plot_energy(axes, numbers, None)
    np.testing.assert_allclose(line(axes, "A")[1], [21.0, 25.0])


def test_ratios(axes, numbers):
    plot_energy_ratio(axes, numbers)
    np.testing.assert_allclose(line(axes, "A")[1], [31.0, 35.0])
    other = plot_peak_power_ratio(new_figure(4.0, 3.0)[1][0], numbers)
    np.testing.assert_allclose(line(other, "C")[1], [53.0, 57.0])
    assert other.get_yscale() == "log"


def test_peak_power_with_standard_deviation_from_zero(axes, numbers):
    plot_peak_power(axes, numbers, "downwind")
    np.testing.assert_allclose(line(axes, "A")[1], [41.0, 45.0])
    ends = axes.containers[0].lines[2][0].get_segments()[0][:, 1]
    np.testing.assert_allclose(ends, [41.0 - 101.0, 41.0 + 101.0])
    assert axes.get_ylim()[0] == 0.0


def test_classes_differ_in_more_than_colour(axes, numbers):
    plot_energy_ratio(axes, numbers)
    lines = axes.lines
    assert len({one.get_marker() for one in lines}) == len(lines)
    assert len({one.get_linestyle() for one in lines}) == len(lines)


def test_turn(axes, turn):
    plot_spin(axes, turn, "a title")
    np.testing.assert_allclose(line(axes, "roller")[1], turn.spin_speed)
    np.testing.assert_allclose(line(axes, "pure rolling")[1], turn.spin_speed_pure)
    assert axes.get_ylabel() == "spin speed |ω| [rad/s]"
    assert "[°]" in axes.get_xlabel()
    assert axes.get_xlim() == (0.0, 360.0)
    shaded = [path.get_extents() for path in axes.collections[0].get_paths()]
    assert [(box.x0, box.x1) for box in shaded] == [(0.0, 45.0), (315.0, 360.0)]


def test_cumulative_energy(axes, turn):
    plot_cumulative_energy(axes, turn)
    np.testing.assert_allclose(axes.lines[0].get_ydata(), turn.energy_fraction)
    assert "165 mJ" in axes.texts[0].get_text()


def test_varying_over_static(axes):
    plot_varying_over_static(axes, {"downward": {"downwind": 1.07, "upwind": 0.86}, "thrust": {"downwind": 0.0042}})
    assert [float(one.get_ydata()[0]) for one in axes.lines] == [1.07, 0.86, 0.0042]
    assert [text.get_text() for text in axes.texts] == ["1.07", "0.86", "0.0042"]
    assert axes.get_legend_handles_labels()[1] == ["downwind row", "upwind row"]
    assert "[–]" in axes.get_ylabel()


def test_stability(axes, stability):
    plot_stability(axes, stability)
    labels = {"explicit": "explicit Euler", "backward": "backward Euler", "converged": "converged (Radau)"}
    for name, label in labels.items():
        np.testing.assert_allclose(line(axes, label)[1], stability[f"spin_ratio_{name}"])
    assert any(np.allclose(one.get_xdata(), 312.0) for one in axes.lines)
    other = plot_deviation(new_figure(4.0, 3.0)[1][0], stability)
    np.testing.assert_allclose(line(other, "backward Euler")[1], stability.deviation_backward)


def test_experiments(axes, tolerance_experiment, step_experiment):
    plot_nonlinear_tolerance(axes, tolerance_experiment)
    np.testing.assert_allclose(line(axes, "downwind, time-varying load"), ([1e-12, 1e-7], [0.2, 20.0]))
    np.testing.assert_allclose(line(axes, "converged (downwind, time-varying)")[1], 0.19)
    assert [text.get_text() for text in axes.texts] == ["125 × static"]
    assert "[J]" in axes.get_ylabel()
    other = plot_step_size(new_figure(4.0, 3.0)[1][0], step_experiment)
    np.testing.assert_allclose(line(other, "upwind row"), ([3e-2, 1e-4], [0.02, 0.4]))
    assert "[s]" in other.get_xlabel()
    assert "[W]" in other.get_ylabel()


@pytest.mark.slow
def test_every_figure_is_written_as_png_and_svg(
    tmp_path, numbers, turn, stability, tolerance_experiment, step_experiment
):
    figures = [
        paper_figures.turns_figure({"left": turn, "right": turn}),
        paper_figures.energy_figure(numbers),
        paper_figures.energy_ratio_figure(numbers),
        paper_figures.peak_power_figure(numbers),
        paper_figures.peak_power_ratio_figure(numbers),
        paper_figures.stability_figure(stability),
        paper_figures.nonlinear_tolerance_figure(tolerance_experiment),
        paper_figures.step_size_figure(step_experiment),
    ]
    for k, figure in enumerate(figures):
        for name in save(figure, tmp_path, f"figure_{k}"):
            assert (tmp_path / name).stat().st_size > 1000
        assert all(one.get_xlabel() or not one.get_subplotspec().is_last_row() for one in figure.axes)
