"""The figures draw the numbers they are given, with units on the axes."""

import numpy as np
import pytest
import xarray as xr

from macroslip.report.style import new_figure, save
from macroslip.torque import TorqueHistory
from paper import figures as draw
from paper.studies import PARTS

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
            "energy_converged": ("row", [0.2, 0.1]),
            "cage_energy": (two, values),
            "cage_energy_converged": ("row", [0.2, 0.1]),
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
    return next(line for line in axes.lines if line.get_label() == label).get_data()


@pytest.fixture
def parts():
    energy = np.arange(36.0).reshape(3, 2, 6) + 1.0
    energy[:, :, 4] = -0.5
    along = np.arange(3.0 * 2 * 2 * 4).reshape(3, 2, 2, 4)
    return xr.Dataset(
        {
            "part_energy": (("case", "row", "part"), energy),
            "station_energy": (("case", "row", "raceway", "station"), along),
        },
        {
            "case": ["12A", "12B", "24B"],
            "row": ROWS,
            "part": list(PARTS),
            "raceway": ["inner", "outer"],
            "station": [-0.03, -0.01, 0.01, 0.03],
            "wind_speed": ("case", [12.0, 12.0, 24.0]),
        },
    )


@pytest.fixture
def summary():
    of_value = ("quantity", "parameter")
    return xr.Dataset(
        {
            "base": ("quantity", [2.0, 100.0]),
            "range": (("quantity", "quantile"), [[1.0, 2.0, 4.0], [50.0, 80.0, 100.0]]),
            "rank_correlation": (of_value, [[0.9, -0.2], [np.nan, -0.8]]),
            "probability": (of_value, [[1e-6, 0.4], [np.nan, 1e-4]]),
            "first_order": (of_value, [[0.8, 0.0], [np.nan, 0.5]]),
            "total_order": (of_value, [[0.9, 0.01], [np.nan, 0.5]]),
            "explained": ("quantity", [0.93, 0.5]),
        },
        {
            "quantity": ["energy", "ratio"],
            "units": ("quantity", ["J", "1"]),
            "quantile": [0.05, 0.5, 0.95],
            "parameter": ["clearance", "osculation"],
        },
    )


def test_energy_of_a_row_with_the_range_of_its_rollers(axes, numbers):
    draw.plot_by_class(axes, numbers, "energy_normalised", "energy [–]", "upwind")
    speed, energy = line(axes, "C")
    np.testing.assert_allclose(energy, [4.0, 8.0])
    np.testing.assert_allclose(np.round(speed), [12.0, 14.0])
    ends = axes.containers[0].lines[2][0].get_segments()[0][:, 1]
    np.testing.assert_allclose(ends, [2.0 - 0.25, 2.0 + 0.5])
    assert axes.get_xlabel() == "mean wind speed [m/s]"


def test_classes_differ_in_more_than_colour(axes, numbers):
    draw.plot_by_class(axes, numbers, "energy_ratio", "ratio [–]")
    np.testing.assert_allclose(line(axes, "A")[1], [31.0, 35.0])
    drawn = [container.lines[0] for container in axes.containers]
    assert (
        len({line.get_marker() for line in drawn})
        == len({line.get_linestyle() for line in drawn})
        == len(drawn)
        == 2
    )


def test_peak_power_with_standard_deviation_from_zero(numbers):
    axes = draw.peak_power_figure(numbers).axes[0]
    np.testing.assert_allclose(line(axes, "A")[1], [41.0, 45.0])
    ends = axes.containers[0].lines[2][0].get_segments()[0][:, 1]
    np.testing.assert_allclose(ends, [41.0 - 101.0, 41.0 + 101.0])
    assert axes.get_ylim()[0] == 0.0


def test_marks_of_the_paper_say_so_and_widen_the_axis(numbers):
    axes = draw.ratio_figure(numbers, "energy_ratio").axes[0]
    assert axes.get_ylim()[0] <= 5.0 and axes.get_ylim()[1] >= 37.0
    assert [text.get_text() for text in axes.texts] == ["paper: about 10"]
    axes = draw.ratio_figure(numbers, "peak_power_ratio").axes[0]
    assert "paper: up to 5, highest at 12 m/s" in [text.get_text() for text in axes.texts]


def test_a_turn(axes, turn):
    draw.plot_spin(axes, turn, "a title")
    np.testing.assert_allclose(line(axes, "roller")[1], turn.spin_speed)
    np.testing.assert_allclose(line(axes, "pure rolling")[1], turn.spin_speed_pure)
    assert axes.get_ylabel() == "spin speed |ω| [rad/s]"
    shaded = [path.get_extents() for path in axes.collections[0].get_paths()]
    assert [(box.x0, box.x1) for box in shaded] == [(0.0, 45.0), (315.0, 360.0)]
    other = draw.plot_cumulative_energy(new_figure(4.0, 3.0)[1][0], turn)
    np.testing.assert_allclose(other.lines[0].get_ydata(), turn.energy_fraction)
    assert "0.165 J" in other.texts[0].get_text()


def test_stability(stability):
    left, right = draw.stability_figure(stability).axes
    labels = {
        "explicit": "explicit Euler",
        "backward": "backward Euler",
        "converged": "converged (Radau)",
    }
    for name, label in labels.items():
        np.testing.assert_allclose(line(left, label)[1], stability[f"spin_ratio_{name}"])
    assert any(np.allclose(line.get_xdata(), 312.0) for line in left.lines)
    np.testing.assert_allclose(right.lines[1].get_ydata(), stability.deviation_backward)


def test_experiments(tolerance_experiment, step_experiment):
    left, right = draw.nonlinear_tolerance_figure(tolerance_experiment).axes
    np.testing.assert_allclose(line(left, "downwind row"), ([1e-12, 1e-7], [0.2, 20.0]))
    assert [text.get_text() for text in right.texts] == ["100 ×"]
    (other,) = draw.step_size_figure(step_experiment).axes
    np.testing.assert_allclose(line(other, "upwind row"), ([3e-2, 1e-4], [0.02, 0.4]))


def test_parts_are_stacked_and_what_is_negative_hangs_below(axes, parts):
    draw.plot_parts(axes, parts.part_energy, "downwind")
    bars = {container.get_label(): container for container in axes.containers}
    assert set(bars) == set(PARTS)
    tops = max(bar.get_y() + bar.get_height() for container in bars.values() for bar in container)
    last = parts.part_energy.sel(case="24B", row="downwind")
    assert tops == pytest.approx(float(last.where(last > 0.0).sum()))
    assert min(bar.get_y() + bar.get_height() for bar in bars["raceways, sliding"]) == -0.5
    mean = parts.part_energy.sel(row="downwind", part="cage").values[:2].mean()
    assert bars["cage"][0].get_height() == pytest.approx(mean)


def test_stations_of_the_chosen_cases(axes, parts):
    assert draw.shown_cases(parts) == ["12B", "24B"]
    draw.plot_stations(axes, parts.station_energy, "upwind", draw.shown_cases(parts))
    _, drawn = line(axes, "24B, outer")
    np.testing.assert_allclose(
        drawn, parts.station_energy.sel(case="24B", row="upwind", raceway="outer")
    )


def test_models_stand_on_the_same_axes(axes, numbers):
    draw.plot_models(
        axes, {"paper": numbers, "physical": 10.0 * numbers}, "energy_ratio", "ratio [–]"
    )
    lines = {line.get_label(): line.get_ydata().tolist() for line in axes.lines}
    assert lines == {"paper": [32.0, 36.0], "physical": [320.0, 360.0]}
    assert len({line.get_linestyle() for line in axes.lines}) == 2


def test_ranges_correlations_and_indices(axes, summary):
    draw.plot_ranges(axes, summary)
    assert [list(line.get_xdata()) for line in axes.lines[:2]] == [[0.5, 2.0], [1.0]]
    assert axes.get_yticklabels()[0].get_text() == "energy\n2 J (1 to 4)"
    other = draw.plot_squares(new_figure(4.0, 3.0)[1][0], summary, "rank_correlation")
    assert [text.get_text() for text in other.texts] == ["+", "−"]
    indices = draw.plot_squares(new_figure(4.0, 3.0)[1][0], summary, "total_order")
    sizes = [float(collection.get_sizes()[0]) for collection in indices.collections]
    assert sizes == pytest.approx([330.0 * part for part in (0.9, 0.8, 0.5, 0.5)])
    assert [text.get_text() for text in indices.texts] == ["0.93", "0.50"]


def test_torque_over_a_part_of_the_history():
    time = np.arange(10.0)
    histories = {"model": TorqueHistory(time, time + 1.0), "SKF": TorqueHistory(time, time + 5.0)}
    figure = draw.torque_figure(histories, 2.0, 4.0)
    np.testing.assert_allclose(
        figure.axes[0].lines[0].get_data(), ([2.0, 3.0, 4.0], [3.0, 4.0, 5.0])
    )
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels == ["model (mean 5.5 N m)", "SKF (mean 9.5 N m)"]


@pytest.mark.slow
def test_figures_are_written_as_png_and_svg_with_units(tmp_path, numbers, turn, parts, summary):
    figures = [
        draw.turns_figure({"left": turn, "right": turn}),
        draw.energy_figure(numbers),
        draw.mechanisms_figure(parts),
        draw.uncertainty_figure(summary),
    ]
    for k, figure in enumerate(figures):
        for name in save(figure, tmp_path, f"figure_{k}"):
            assert (tmp_path / name).stat().st_size > 1000
        assert all(
            axes.get_xlabel() or not axes.get_subplotspec().is_last_row() for axes in figure.axes
        )
