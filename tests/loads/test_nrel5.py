"""The bundled cases of the NREL 5 MW turbine: whole, thinned without loss, and of one turbine."""

import numpy as np
import pyarrow.parquet as pq
import pytest

import macroslip
from macroslip import HubLoads
from macroslip.errors import InputError
from macroslip.loads import bundled_cases
from macroslip.loads.bundled import bundled_case, bundled_labels, bundled_names
from macroslip.study.loads_list import load_list

COLUMNS = ("wind_mps", "rotor_speed_rpm", "fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm")
UNITS = np.array([1.0, 1.0, 1e3, 1e3, 1e3, 1e3, 1e3, 1e3])
#: Half a unit of the last digit of the table below.
ROUNDING = np.array([0.0051, 0.0051, 0.051, 0.051, 0.0051, 0.051, 0.051, 0.051])
#: Means and standard deviations of the records at 50 Hz, as their provenance has them: wind [m/s],
#: rotor speed [r/min], force [kN], moment [kN m].
RECORDED = {
    "nrel5-4B": ((3.96, 7.18, 210.2, -0.6, -1074.22, 251.8, -233.1, 4.0),
        (1.11, 0.16, 31.3, 2.9, 3.23, 144.7, 387.3, 409.0)),
    "nrel5-6B": ((6.17, 8.05, 331.8, -2.8, -1074.39, 1034.0, 148.3, -8.6),
        (1.41, 0.48, 68.2, 7.2, 9.13, 430.7, 772.4, 880.4)),
    "nrel5-8B": ((8.15, 9.37, 477.8, -4.1, -1076.83, 1956.2, 372.8, 322.3),
        (1.66, 1.03, 106.2, 8.1, 9.96, 612.7, 930.1, 856.5)),
    "nrel5-10B": ((10.35, 11.12, 647.7, -6.6, -1080.80, 3070.3, 876.0, 613.9),
        (1.67, 0.82, 93.5, 10.8, 14.43, 642.1, 1092.4, 1097.9)),
    "nrel5-12B": ((12.04, 11.91, 673.6, -7.7, -1080.87, 3836.5, 934.3, 611.9),
        (2.03, 0.40, 106.7, 15.9, 18.86, 476.0, 1345.1, 1396.9)),
    "nrel5-14B": ((14.09, 12.04, 565.3, -13.3, -1078.34, 4076.6, 1210.0, 363.9),
        (2.35, 0.34, 111.9, 16.8, 18.59, 337.0, 1246.0, 1230.7)),
    "nrel5-16B": ((16.00, 12.10, 490.5, -19.6, -1077.91, 4181.1, 1631.7, 464.6),
        (2.40, 0.40, 100.8, 21.9, 26.36, 219.8, 1575.3, 1589.0)),
    "nrel5-18B": ((17.94, 12.10, 441.3, -22.2, -1075.97, 4186.2, 1673.8, 428.6),
        (2.62, 0.41, 86.5, 24.3, 27.11, 234.9, 1642.2, 1500.8)),
    "nrel5-20B": ((20.03, 12.09, 408.5, -29.2, -1070.35, 4186.6, 2030.4, 175.4),
        (2.88, 0.40, 67.6, 25.1, 28.47, 239.8, 1467.0, 1410.7)),
    "nrel5-22B": ((22.11, 12.09, 382.4, -33.8, -1069.20, 4188.5, 2177.4, 226.6),
        (3.12, 0.41, 63.3, 30.5, 35.13, 267.8, 1737.6, 1732.3)),
    "nrel5-24B": ((24.09, 12.09, 367.3, -39.3, -1064.65, 4187.2, 2357.1, 62.4),
        (3.31, 0.45, 61.7, 35.5, 36.76, 287.6, 1765.8, 1669.3)),
    "nrel5-8B-2": ((8.11, 9.29, 471.3, -4.4, -1076.16, 1931.4, 378.9, 229.8),
        (1.57, 0.84, 86.4, 9.8, 10.98, 499.8, 1133.7, 818.4)),
    "nrel5-12B-2": ((11.86, 11.90, 673.9, -9.2, -1081.02, 3825.4, 1127.1, 556.6),
        (1.95, 0.41, 104.2, 14.3, 16.47, 482.2, 1309.2, 1166.5)),
    "nrel5-18B-2": ((17.87, 12.08, 447.7, -23.0, -1076.08, 4179.2, 1756.1, 474.9),
        (2.68, 0.48, 99.0, 23.3, 27.72, 253.6, 1532.0, 1572.1)),
    "nrel5-12A": ((12.40, 11.96, 646.3, -8.9, -1079.25, 3935.3, 1001.6, 413.4),
        (2.20, 0.49, 124.6, 19.2, 23.14, 470.0, 1638.5, 1739.5)),
    "nrel5-18A": ((18.13, 12.10, 438.8, -22.5, -1074.53, 4184.8, 1638.3, 383.6),
        (3.18, 0.40, 77.9, 26.8, 29.48, 224.8, 1858.4, 1664.0)),
}  # fmt: skip


def _columns(name):
    table = pq.read_table(bundled_case(name).path)
    return np.column_stack([table[column].to_numpy() for column in COLUMNS]).astype(float)


def test_the_set_has_every_record():
    assert set(bundled_cases("nrel5")) == set(RECORDED)
    assert not set(RECORDED) & set(bundled_cases("year"))
    assert bundled_names() == bundled_cases("year") + bundled_cases("nrel5")


@pytest.mark.parametrize("name", RECORDED)
def test_thinned_cases_have_the_means_of_their_records(name):
    mean, spread = RECORDED[name]
    # End samples weigh more at 20 Hz than at 50 Hz, by 0.01 % of the record.
    off = np.abs(_columns(name).mean(axis=0) / UNITS - mean)
    assert (off <= ROUNDING + 1e-3 * np.array(spread)).all()


@pytest.mark.parametrize("name", RECORDED)
def test_thinned_cases_have_the_spread_of_their_records(name):
    _, spread = RECORDED[name]
    # Above 9 Hz the records have next to nothing.
    off = np.abs(_columns(name).std(axis=0) / UNITS - spread)
    assert (off <= ROUNDING + 2e-3 * np.array(spread)).all()


@pytest.mark.parametrize("name", RECORDED)
def test_every_case_is_whole_and_says_where_it_comes_from(name):
    loads = HubLoads.bundled(name)
    assert np.array_equal(loads.time, np.arange(12000) / 20)
    assert (loads.source, loads.event) == (f"bundled case {name}", False)
    metadata = {
        key.decode(): text.decode()
        for key, text in pq.read_schema(bundled_case(name).path).metadata.items()
    }
    assert metadata["case"] == name and metadata["turbine"] == "NREL 5 MW reference turbine"
    assert "OpenFAST v3.5.5" in metadata["source"] and "simulated" in metadata["nature"]
    # The weight of the rotor, 109 993 kg on a shaft tilted by 5 degrees, is in every load.
    assert loads.force[:, 2].mean() == pytest.approx(-1074.56e3, rel=0.01)


def test_no_wind_is_used_twice():
    seeds = [
        pq.read_schema(bundled_case(name).path).metadata[b"turbsim_seeds"]
        for name in bundled_names()
        if not bundled_case(name).event
    ]
    assert len(set(seeds)) == len(seeds)


def test_data_of_the_package_stay_below_25_mb():
    folder = next(iter(macroslip.__path__))
    total = sum(
        path.stat().st_size
        for path in bundled_case("14B").path.parents[2].rglob("*")
        if path.is_file() and path.suffix not in (".py", ".pyc")
    )
    assert total < 25e6 and str(bundled_case("nrel5-4B").path).startswith(folder)


def test_labels_in_a_study():
    loads = load_list(None, kind="hub", bundled=["nrel5"]).loads
    assert [load.name for load in loads] == bundled_cases("nrel5")
    fields = {load.name: load.fields for load in loads}
    assert fields["nrel5-8B-2"] == {"wind_speed": 8.0, "turbulence": "B", "seed": 2, "event": ""}


def test_one_bearing_does_not_get_the_loads_of_two_turbines():
    with pytest.raises(InputError) as caught:
        bundled_labels(["12B", "nrel5-12B", "14B"])
    assert "the bundled cases 12B and nrel5-12B are of two turbines" in str(caught.value)
    assert "a study for each" in str(caught.value)
