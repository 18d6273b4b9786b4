"""Figures of mechanisms, uncertainty and torque draw the numbers they are given, with units on the axes."""

import numpy as np
import pytest
import xarray as xr

from macroslip.report.style import new_figure
from macroslip.reproduction.dissipation import PARTS
from macroslip.reproduction.mechanism_figures import (
    mechanisms_figure,
    models_figure,
    plot_models,
    plot_parts,
    plot_stations,
    shown_cases,
)
from macroslip.reproduction.torque_figures import plot_torque, torque_figure
from macroslip.reproduction.uncertainty_figures import plot_correlations, plot_indices, plot_ranges, uncertainty_figure
from macroslip.torque import TorqueHistory

CASES, ROWS = ["12A", "12B", "24B"], ["downwind", "upwind"]


@pytest.fixture
def axes():
    return new_figure(4.0, 3.0)[1][0]


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
            "case": CASES,
            "row": ROWS,
            "part": list(PARTS),
            "raceway": ["inner", "outer"],
            "station": [-0.03, -0.01, 0.01, 0.03],
            "wind_speed": ("case", [12.0, 12.0, 24.0]),
        },
    )


@pytest.fixture
def numbers():
    def made(scale):
        one = xr.DataArray(scale * np.array([1.0, 3.0, 5.0]), dims="case")
        rows = xr.concat([one, 2.0 * one], xr.DataArray(ROWS, dims="row", name="row"))
        names = ("both_rows_normalised", "energy_ratio", "peak_power_ratio")
        data = xr.Dataset(dict.fromkeys(names, one) | {"peak_power_mean": rows})
        return data.assign_coords(case=CASES, wind_speed=("case", [12.0, 12.0, 24.0]))

    return {"paper": made(1.0), "physical": made(10.0)}


@pytest.fixture
def summary():
    return xr.Dataset(
        {
            "base": ("quantity", [2.0, 100.0]),
            "range": (("quantity", "quantile"), [[1.0, 2.0, 4.0], [50.0, 80.0, 100.0]]),
            "rank_correlation": (("quantity", "parameter"), [[0.9, -0.2], [np.nan, -0.8]]),
            "probability": (("quantity", "parameter"), [[1e-6, 0.4], [np.nan, 1e-4]]),
            "first_order": (("quantity", "parameter"), [[0.8, 0.0], [np.nan, 0.5]]),
            "total_order": (("quantity", "parameter"), [[0.9, 0.01], [np.nan, 0.5]]),
            "explained": ("quantity", [0.93, np.nan]),
        },
        {
            "quantity": ["energy", "ratio"],
            "units": ("quantity", ["J", "1"]),
            "quantile": [0.05, 0.5, 0.95],
            "parameter": ["clearance", "osculation"],
        },
    )


def test_parts_are_stacked_and_what_is_negative_hangs_below(axes, parts):
    plot_parts(axes, parts.part_energy, "downwind")
    bars = {container.get_label(): container for container in axes.containers}
    assert list(bars) and set(bars) == set(PARTS)
    tops = max(bar.get_y() + bar.get_height() for container in bars.values() for bar in container)
    last = parts.part_energy.sel(case="24B", row="downwind")
    assert tops == pytest.approx(float(last.where(last > 0.0).sum()))
    assert min(bar.get_y() + bar.get_height() for bar in bars["raceways, sliding"]) == -0.5
    mean = parts.part_energy.sel(row="downwind", part="cage").values[:2].mean()
    assert bars["cage"][0].get_height() == pytest.approx(mean)
    assert "[J]" in axes.get_ylabel()


def test_stations_of_the_chosen_cases(axes, parts):
    assert shown_cases(parts) == ("12B", "24B")
    plot_stations(axes, parts.station_energy, "upwind", shown_cases(parts))
    line = next(one for one in axes.lines if one.get_label() == "24B, outer")
    np.testing.assert_allclose(line.get_ydata(), parts.station_energy.sel(case="24B", row="upwind", raceway="outer"))
    np.testing.assert_allclose(line.get_xdata(), [-30.0, -10.0, 10.0, 30.0])


def test_models_stand_on_the_same_axes(axes, numbers):
    plot_models(axes, numbers, "energy_ratio", "ratio [–]")
    lines = {one.get_label(): one.get_ydata().tolist() for one in axes.lines}
    assert lines == {"paper": [2.0, 5.0], "physical": [20.0, 50.0]}
    assert len({one.get_linestyle() for one in axes.lines}) == 2
    other = plot_models(new_figure(4.0, 3.0)[1][0], numbers, "peak_power_mean", "power [W]")
    assert {one.get_label() for one in other.lines} == {f"{model}, {row}" for model in numbers for row in ROWS}


def test_ranges_and_correlations(axes, summary):
    plot_ranges(axes, summary)
    assert [list(one.get_xdata()) for one in axes.lines[:2]] == [[0.5, 2.0], [1.0]]
    assert axes.get_yticklabels()[0].get_text() == "energy\n2 J (1 to 4)"
    other = plot_correlations(new_figure(4.0, 3.0)[1][0], summary)
    assert [text.get_text() for text in other.texts] == ["+", "−"]
    assert len(other.collections) == 3


def test_indices_are_drawn_where_they_are_worth_telling(axes, summary):
    plot_indices(axes, summary)
    sizes = [float(one.get_sizes()[0]) for one in axes.collections]
    assert sizes == pytest.approx([330.0 * part for part in (0.9, 0.8, 0.5, 0.5)])
    assert [text.get_text() for text in axes.texts] == ["0.93"]


def test_torque_over_a_part_of_the_history(axes):
    time = np.arange(10.0)
    histories = {"model": TorqueHistory(time, time + 1.0), "SKF": TorqueHistory(time, time + 5.0)}
    plot_torque(axes, histories, 2.0, 4.0)
    np.testing.assert_allclose(axes.lines[0].get_data(), ([2.0, 3.0, 4.0], [3.0, 4.0, 5.0]))
    assert axes.get_ylabel() == "friction torque [N m]"
    labels = [one.get_text() for one in torque_figure(histories, 0.0, 9.0).legends[0].get_texts()]
    assert labels == ["model (mean 5.5 N m)", "SKF (mean 9.5 N m)"]


@pytest.mark.slow
def test_whole_figures(parts, numbers, summary, tmp_path):
    for k, figure in enumerate((mechanisms_figure(parts), models_figure(numbers), uncertainty_figure(summary))):
        figure.savefig(tmp_path / f"{k}.png")
        assert all(one.get_xlabel() or not one.get_subplotspec().is_last_row() for one in figure.axes[:2])
