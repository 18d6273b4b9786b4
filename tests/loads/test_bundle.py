"""The bundled cases: what thinning from 50 Hz to 20 Hz keeps, and that all files are whole."""

import json
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from scipy.signal import freqz

import macroslip.loads
from macroslip.errors import InputError
from macroslip.loads import HubLoads, bundled_cases
from tools import bundled_loads as bundle


@pytest.fixture(scope="module")
def clip(clip_50hz):
    """The source at 50 Hz, t = 0 to 60 s, one column a channel."""
    table = pq.read_table(clip_50hz)
    return np.column_stack([table[name].to_numpy() for name in bundle.COLUMNS]).astype(float)


def _bundled(case, end=None):
    table = pq.read_table(macroslip.loads.__path__[0] + f"/cases/{case}.parquet")
    return np.column_stack([table[name].to_numpy() for name in bundle.COLUMNS]).astype(float)[:end]


def test_filter_is_as_documented():
    frequency, response = freqz(bundle.anti_alias_filter(), worN=1 << 16, fs=100)
    gain = np.abs(response)
    assert np.abs(gain[frequency <= 8.5] - 1).max() < 1e-4
    assert gain[frequency >= 10].max() < 1e-4
    assert np.interp(9.25, frequency, gain) == pytest.approx(0.5, abs=1e-3)


@pytest.mark.parametrize(
    ("frequency", "gain"), [(0.34, 1), (3.1, 1), (8.4, 1), (10.1, 0), (12.0, 0), (24.9, 0)]
)
def test_a_tone_keeps_amplitude_and_phase_or_vanishes(frequency, gain):
    fine, coarse = (
        2 * np.pi * frequency * np.arange(n) / rate + 0.3 for n, rate in ((3001, 50), (1201, 20))
    )
    assert bundle.decimate(np.cos(fine))[40:-40] == pytest.approx(
        gain * np.cos(coarse)[40:-40], abs=3e-4
    )


def test_a_ramp_is_kept_up_to_both_ends():
    assert bundle.decimate(np.arange(3001) / 50.0) == pytest.approx(
        np.arange(1201) / 20, rel=5e-6, abs=1e-6
    )


def test_mean_and_spread_are_kept_but_for_the_removed_band(clip):
    thinned = bundle.decimate(clip)
    # Parseval: the variance of the source without its content above the middle of the transition band.
    spectrum = np.fft.rfft(clip[:-1] - clip[:-1].mean(axis=0), axis=0)
    kept = np.fft.rfftfreq(len(clip) - 1, 1 / 50) <= 9.25
    spread = np.sqrt(2 * (np.abs(spectrum[kept]) ** 2).sum(axis=0)) / (len(clip) - 1)
    # Time means by the trapezoidal rule, so that the end samples have the same weight at both rates.
    means = [0.5 * (values[:-1] + values[1:]).mean(axis=0) for values in (thinned, clip)]
    assert (np.abs(means[0] - means[1]) < 1e-4 * spread).all()
    assert thinned[:-1].std(axis=0) == pytest.approx(spread, rel=1e-3)


def test_bundled_file_is_what_the_module_makes_of_the_source(clip):
    # The clip ends at 60 s, the bundled record goes on: the last 1.7 s rest on different continuations.
    assert bundle.decimate(clip)[:-34] == pytest.approx(
        _bundled("14B", 1201)[:-34], rel=1e-6, abs=0.05
    )


@pytest.mark.parametrize("case", bundled_cases())
def test_every_case_is_whole(case):
    loads = HubLoads.bundled(case)
    assert np.array_equal(loads.time, np.arange(12000) / 20)
    assert loads.source == f"bundled case {case}"
    wind = _bundled(case)[:, -1]
    assert wind.mean() == pytest.approx(float(case[:2]), abs=0.4)
    intensity = {"A": 0.16, "B": 0.14, "C": 0.12}[case[2]]
    assert wind.std() == pytest.approx(intensity * (0.75 * wind.mean() + 5.6), rel=0.15)
    assert 2.0 < loads.shaft_speed.mean() < 2.2
    assert loads.force[:, 2].mean() == pytest.approx(-261e3, abs=3e3)


def test_published_statistics_of_14b():
    loads = HubLoads.bundled("14B")
    assert loads.force.mean(axis=0) / 1e3 == pytest.approx([164.4, -2.3, -263.01], abs=0.05)
    assert loads.force.std(axis=0) / 1e3 == pytest.approx([29.3, 4.2, 4.82], abs=0.05)
    assert loads.moment.mean(axis=0) / 1e3 == pytest.approx([726.0, 154.4, 36.6], abs=0.05)
    assert loads.moment.std(axis=0) / 1e3 == pytest.approx([20.9, 231.2, 223.9], abs=0.06)


def test_provenance_and_size():
    folder = macroslip.loads.__path__[0] + "/cases"
    total = 0
    for case in bundled_cases():
        file = pq.ParquetFile(f"{folder}/{case}.parquet")
        metadata = {
            key.decode(): value.decode() for key, value in file.schema_arrow.metadata.items()
        }
        assert metadata["case"] == case and "OpenFAST v3.5.5" in metadata["source"]
        assert {"turbsim_seeds", "decimation", "frame", "nature", "turbine"} <= metadata.keys()
        assert list(json.loads(metadata["units"])) == file.schema_arrow.names
        total += file.metadata.serialized_size + sum(
            file.metadata.row_group(0).column(i).total_compressed_size
            for i in range(file.metadata.num_columns)
        )
    assert total < 8e6
    # All of them go into the wheel.
    assert sum(path.stat().st_size for path in Path(folder).iterdir()) < 16e6


def test_making_a_case(tmp_path, clip):
    columns = dict(zip(bundle.COLUMNS, clip.T, strict=True))
    bundle.write_case("14B", columns, {"source": "OpenFAST"}, tmp_path)
    loads = HubLoads.read(tmp_path / "14B.parquet")
    assert np.array_equal(loads.time, np.arange(1201) / 20)
    assert loads.force[:1100, 0] == pytest.approx(HubLoads.bundled("14B").force[:1100, 0], rel=1e-6)


def test_a_folder_without_the_records(tmp_path):
    with pytest.raises(
        InputError, match=r"no record of a bundled case.*windpact1\.5_12mps_A\.parquet"
    ):
        bundle.main([str(tmp_path)])
