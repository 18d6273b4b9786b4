"""Exceedance curves and load spectra against counts by hand, on stored results."""

import numpy as np
import pytest

from macroslip import BearingLoads, InputError, open_study, run_study
from macroslip.constants import YEAR
from macroslip.result.variables import VARIABLES
from macroslip.study.aggregation import Aggregation
from macroslip.study.exceedance import (
    EXCEEDANCE,
    LOAD_SPECTRUM,
    THRESHOLDS,
    exceedance,
    load_spectrum,
)
from macroslip.study.export import tables, write_tables
from macroslip.study.study_file import study_of
from macroslip.study.summary import CASE_VARIABLES, RANGE_EDGES, ROW_VARIABLES
from macroslip.study.summary import load_cycles as counted
from macroslip.study.weights import BinProbabilities, Weibull
from tests.variables import check_variables

pytestmark = pytest.mark.slow

WEIGHTS = BinProbabilities({12.0: 0.6, 14.0: 0.3})


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """Three bundled cases of 40 s, two rollers a row, and one run that fails."""
    folder = tmp_path_factory.mktemp("study")
    content = {
        "case": {"laws": {"model": "paper"}, "rollers": [0, 14], "loads": {"end": "40 s"}},
        "loads": {"bundled": ["12A", "12B", "14B"]},
        "variations": {"list": [{"drivetrain.tilt": "5 deg"}, {"drivetrain.tilt": "50 deg"}]},
        "cycles": True,
    }
    run_study(study_of(content), folder / "out")
    return open_study(folder / "out")


def test_curves_count_orbits(study):
    curves = exceedance(study, Aggregation(WEIGHTS)).isel(group=0)
    good = study.isel(case=[0, 2, 4])
    for name, values in (
        ("energy_orbits", good.orbit_energy.sum("interface", skipna=False)),
        ("power_orbits", good.peak_power.max("interface")),
    ):
        for row in ("downwind", "upwind"):
            part, length = values.sel(row=row), (good.orbit_end - good.orbit_start)
            for threshold in curves.threshold.values[[1, curves.sizes["threshold"] // 2, -2]]:
                rates = []
                for cases in ([0, 1], [2]):
                    number = int((part.isel(case=cases) > threshold).sum())
                    seconds = float(
                        (length.isel(case=cases) * part.isel(case=cases).notnull()).sum()
                    )
                    rates.append(number / seconds)
                expected = YEAR * (0.6 * rates[0] + 0.3 * rates[1])
                assert float(curves[name].sel(row=row, threshold=threshold)) == pytest.approx(
                    expected, rel=1e-12
                )


def test_curves_fall_from_all_orbits_to_none(study):
    curves = exceedance(study, Aggregation(WEIGHTS)).isel(group=0)
    for name in ("energy_orbits", "power_orbits"):
        assert (np.diff(curves[name]) <= 0.0).all()
    assert (curves.energy_orbits.isel(threshold=-1) == 0.0).all() and (
        curves.power_orbits.isel(threshold=-1) == 0.0
    ).all()
    np.testing.assert_allclose(
        curves.orbits,
        np.maximum(curves.energy_orbits, curves.power_orbits).max("threshold"),
        rtol=1e-12,
    )
    # About 0.15 orbits a second.
    assert 0.1 < float(curves.orbits[0]) / (0.9 * YEAR) < 0.2


def test_a_group_without_results_has_no_curve(study):
    curves = exceedance(study, Aggregation(WEIGHTS))
    check_variables(curves, EXCEEDANCE)
    check_variables(load_spectrum(study, Aggregation(WEIGHTS)), LOAD_SPECTRUM)
    summary = study.drop_vars([name for name in study if name in VARIABLES])
    check_variables(summary.drop_vars("load_cycles"), ROW_VARIABLES, CASE_VARIABLES)
    assert curves.sizes["group"] == 2 and np.isnan(curves.energy_orbits.isel(group=1)).all()
    assert curves.left_out.values.tolist() == [[0, 0], [2, 1]]


def test_spectrum_is_the_weighted_sum_of_what_was_counted(study):
    spectrum = load_spectrum(study, Aggregation(WEIGHTS, years=3.0)).isel(group=0)
    cycles = (
        study.load_cycles.isel(case=[0, 2, 4]).sel(load_range=spectrum.load_range).values / 40.0
    )
    expected = 3.0 * YEAR * (0.6 * cycles[:2].mean(axis=0) + 0.3 * cycles[2])
    np.testing.assert_allclose(spectrum.cycles, expected, rtol=1e-9)
    with pytest.raises(InputError, match="has not counted cycles"):
        load_spectrum(study.drop_vars("load_cycles"), Aggregation(WEIGHTS))


@pytest.mark.parametrize(("amplitude", "number"), [(1e3, 3), (70e3, 25)])
def test_cycles_of_a_sine(amplitude, number):
    time = np.linspace(0.0, 10.0, 4001)
    force = np.zeros((time.size, 3))
    force[:, 2] = 100e3 + amplitude * np.sin(2.0 * np.pi * number * time / 10.0)
    force[:, 1] = -300e3
    cycles = counted(BearingLoads(time, np.full(time.size, 2.0), force, "a sine")).load_cycles
    assert cycles.sel(component="radial").sum() == 0  # a constant has no cycle
    axial = cycles.sel(component="axial")
    assert abs(float(axial.sum()) - number) <= 1.0
    largest = int(axial.argmax("load_range"))
    assert (
        RANGE_EDGES[largest] < 2.0 * amplitude * 1.03
        and RANGE_EDGES[largest + 1] > 2.0 * amplitude * 0.97
    )


def test_cycles_against_the_example_of_the_standard():
    """The history of ASTM E 1049, section 5.4.5, repeated: four cycles, of ranges 3, 4, 7 and 9."""
    peaks = np.array([-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0]) * 1e4
    fine = np.linspace(0, peaks.size - 1, 8 * 100 + 1)
    force = np.zeros((fine.size, 3))
    force[:, 2] = np.interp(fine, np.arange(peaks.size), peaks)
    cycles = counted(
        BearingLoads(fine, np.full(fine.size, 2.0), force, "standard")
    ).load_cycles.sel(component="axial")
    assert float(cycles.sum()) == 4.0
    counts = {
        float(r): float(n)
        for r, n in zip(cycles.load_range.values, cycles.values, strict=True)
        if n
    }
    assert sorted(round(r / 1e4) for r in counts) == [3, 4, 7, 9]


@pytest.mark.parametrize("form", ["csv", "parquet"])
def test_tables_are_written_with_units(study, tmp_path, form):
    import pandas as pd

    sheets = tables(study, Aggregation(Weibull(9.0, 2.0)))
    written = write_tables(sheets, tmp_path, form)
    assert {path.stem for path in written} == {
        "cases",
        "failures",
        "worst",
        "percentiles",
        "lifetime",
        "bins",
        "exceedance",
        "cycles",
        "year",
        "lives",
        "designs",
    }
    read = pd.read_csv if form == "csv" else pd.read_parquet
    cases = read(tmp_path / f"cases.{form}")
    np.testing.assert_allclose(
        cases["energy_mean [J]"].dropna(),
        study.energy_mean.values[~np.isnan(study.energy_mean.values)],
    )
    assert len(read(tmp_path / f"failures.{form}")) == 3
    assert {"lifetime_energy [J]", "covered", "drivetrain.tilt [deg]"} <= set(
        read(tmp_path / f"lifetime.{form}")
    )
    assert THRESHOLDS[0] < read(tmp_path / f"exceedance.{form}")["threshold [J or W]"].min()


def test_text_that_a_spreadsheet_would_run_is_harmless_in_csv(tmp_path, study):
    names = study.loads.values.copy()
    names[0] = '=HYPERLINK("x")'
    write_tables(
        tables(study.assign_coords(loads=("case", names, {"units": "1"})), Aggregation()),
        tmp_path,
        "csv",
    )
    text = (tmp_path / "cases.csv").read_text()
    assert "'=HYPERLINK" in text and ",=HYPER" not in text and ',"=HYPER' not in text
