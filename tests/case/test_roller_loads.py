"""Loads of the rollers from a file, in place of the balance of the inner ring."""

import numpy as np
import pandas as pd
import pytest

from macroslip import BearingLoads, Case, RollerLoads, simulate
from macroslip.case.case_file import read_case
from macroslip.errors import InputError
from macroslip.result.rating import roller_load_series

SPEED, DURATION = 2.0, 8.0
FORCE = np.array([0.0, -3e5, 2e5])


def table(case, thin=1):
    """The roller loads of a case as a file would have them: every roller at its place."""
    time, load = roller_load_series(case, 0.0, DURATION)
    time, load = time[::thin], load[::thin]
    count = case.bearing.rollers_per_row
    start = -90.0 + 360.0 / count * (np.arange(count) + np.array([[0.0], [0.5]]))
    inner = case.bearing.pitch_radius - 0.5 * case.bearing.roller_diameter * np.cos(
        case.bearing.contact_angle
    )
    turned = np.degrees(inner / (2.0 * case.bearing.pitch_radius) * SPEED * time)
    lines = [
        (t, SPEED * 30.0 / np.pi, name, (start[row, j] + turn) % 360.0, load[k, row, j])
        for k, (t, turn) in enumerate(zip(time, turned, strict=True))
        for row, name in enumerate(("downwind", "upwind"))
        for j in range(count)
    ]
    return pd.DataFrame(lines, columns=["time_s", "shaft_speed_rpm", "row", "angle_deg", "load_N"])


@pytest.fixture(scope="module")
def balanced():
    return Case(loads=BearingLoads.constant(FORCE, SPEED, DURATION, step=0.01), rollers=[0, 9])


def test_loads_of_a_balance_from_a_file_give_the_results_of_the_balance(tmp_path, balanced):
    table(balanced).sample(frac=1.0, random_state=1).to_csv(tmp_path / "loads.csv", index=False)
    (tmp_path / "case.yaml").write_text("loads: {roller_loads: loads.csv}\nrollers: [0, 9]\n")
    case = read_case(tmp_path / "case.yaml")
    assert isinstance(case.loads, RollerLoads)
    middle = case.bearing_loads.force[:-20]
    assert middle == pytest.approx(np.tile(FORCE, (len(middle), 1)), abs=1.0)
    known, result = simulate(balanced), simulate(case)
    assert (result.status == 0).all()
    window = result.attrs["window_end"] - result.attrs["window_start"]
    share = window / (known.attrs["window_end"] - known.attrs["window_start"])
    # The upwind row has no load, and how far its rollers are from the rings is not in the file.
    loaded = (dataset.energy.sel(row="downwind").sum() for dataset in (result, known))
    assert float(next(loaded)) == pytest.approx(float(next(loaded)) * share, rel=2e-3)


def test_rows_and_signs_reach_the_resultant(bearing):
    count = bearing.rollers_per_row
    angle = np.tile(2 * np.pi * np.arange(count) / count, (2, 2, 1))
    load = np.zeros((2, 2, count))
    load[:, 0, 7] = 1e4  # downwind at 90 degrees
    force = (
        RollerLoads(np.arange(2.0), np.ones(2), angle, load, "one")
        .resultant(bearing.contact_angle, count)
        .force[0]
    )
    assert force == pytest.approx(
        [0.0, 1e4 * np.cos(bearing.contact_angle), 1e4 * np.sin(bearing.contact_angle)], abs=1e-9
    )


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda lines: lines.drop(columns="load_N"), "no column load_N"),
        (lambda lines: lines.replace({"row": {"upwind": "left"}}), "row is left"),
        (lambda lines: lines.iloc[1:], "rows have 27 to 28 places"),
        (lambda lines: lines.assign(load_N=-1.0), "a load is negative"),
        (lambda lines: lines.assign(angle_deg=3.0), "a place is given twice"),
        (
            lambda lines: lines.assign(shaft_speed_rpm=np.arange(len(lines))),
            "the shaft has two speeds at one time",
        ),
        (lambda lines: lines.assign(load_N=np.nan), "finite"),
    ],
)
def test_faulty_tables_are_refused(tmp_path, balanced, change, words):
    change(table(balanced, thin=10)).to_csv(tmp_path / "loads.csv", index=False)
    with pytest.raises(InputError, match=words):
        RollerLoads.read(tmp_path / "loads.csv")


def test_a_whole_bearing_has_no_given_loads(tmp_path, balanced):
    table(balanced, thin=10).to_parquet(tmp_path / "loads.parquet")
    (tmp_path / "case.yaml").write_text(
        "loads: {roller_loads: loads.parquet}\ndynamics: whole-bearing\n"
    )
    with pytest.raises(
        InputError,
        match=r"line 1, loads.roller_loads: .*follow from the simulation.*dynamics: imposed-orbit",
    ):
        read_case(tmp_path / "case.yaml")
