"""`open_study`: labelled, lazy, and honest about what is not there."""

import numpy as np
import pytest

from macroslip import BearingLoads, Case, Laws, open_study, run_study, simulate
from macroslip.study import reader as module
from macroslip.study.result_files import from_bytes, to_bytes
from macroslip.study.study_file import study_of

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def directory(tmp_path_factory):
    """Runs that differ in rollers and in orbits; one fails."""
    content = {
        "case": {"laws": {"model": "paper"}, "loads": {"end": "40 s"}},
        "loads": {"bundled": ["12A", "14B"]},
        "variations": {
            "list": [
                {"rollers": [0, 14]},
                {"rollers": [3], "window.start": "1 s", "window.end": "20 s"},
                {"rollers": [99]},
            ]
        },
    }
    folder = tmp_path_factory.mktemp("study") / "out"
    run_study(study_of(content), folder)
    return folder


def test_nothing_is_read_until_it_is_asked_for(directory, monkeypatch):
    read, original = [], module.read_result
    study = open_study(directory)

    def watched(directory, key, checksum):
        read.append(key)
        return original(directory, key, checksum)

    module._result.cache_clear()
    monkeypatch.setattr(module, "read_result", watched)
    case = study.isel(case=1)
    assert (study.energy_mean.notnull().sum("row") == 2).sum() == 4 and read == []
    assert case.energy.shape == (2, 3, 3) and read == []
    assert np.isfinite(case.energy.sel(roller=3).values).all() and len(read) == 1
    assert (
        case.orbit_energy.sel(roller=3).notnull().any() and len(read) == 1
    )  # kept for the next variable
    study.energy.sel(row="upwind").load()
    assert len(set(read)) == 4


def test_every_way_of_indexing_gives_the_same(directory):
    study = open_study(directory)
    whole = study.orbit_energy.values
    for key in (
        (0,), (slice(None, None, 2),), ([3, 0],), (slice(None), 1), (0, 1, [2, 0]),
        (slice(1, 4), slice(None), slice(1, 3), [0, 2], 1),
        ([4, 1], 0, 1, 0, 2), (slice(0, 0),),
    ):  # fmt: skip
        dims = dict(zip(study.orbit_energy.dims, key, strict=False))
        np.testing.assert_array_equal(
            study.orbit_energy.isel(dims).values,
            study.orbit_energy.copy(data=whole).isel(dims).values,
        )


def test_dask_gives_the_same_piece_by_piece(directory):
    pytest.importorskip("dask")
    study = open_study(directory)
    pieces = study.chunk({"case": 2}).orbit_energy
    np.testing.assert_array_equal(
        pieces.sum("interface", skipna=False).compute(),
        study.orbit_energy.sum("interface", skipna=False),
    )


def test_what_a_run_does_not_have_is_nan(directory):
    study = open_study(directory)
    assert (
        list(study.roller.values) == [0, 3, 14]
        and (study.outcome.isel(case=[2, 5]) == "failed").all()
    )
    finite = np.isfinite(study.energy.isel(row=0, interface=0).values)
    assert finite.tolist() == [[True, False, True], [False, True, False], [False] * 3] * 2
    orbits = np.isfinite(study.orbit_start.values).sum(axis=1)
    assert orbits.tolist() == [5, 2, 0, 5, 2, 0]
    assert study["window.start"].values[1] == 1.0 and np.isnan(study["window.start"].values[0])


def test_everything_has_units_and_a_name(directory):
    study = open_study(directory)
    for name, variable in study.variables.items():
        if name not in ("row", "interface"):
            assert variable.attrs.get("units") and variable.attrs.get("long_name"), name
    assert study["window.start"].units == "s"


@pytest.mark.parametrize("seconds", [0.2, 8.0])
def test_a_result_survives_its_file(seconds):
    import xarray as xr

    loads = BearingLoads.constant([0.0, -300e3, 0.0], 2.0, seconds)
    result = simulate(Case(loads=loads, laws=Laws.paper(), rollers=[0, 1]))
    result.attrs["title"] = "ä ≤ 日本"
    stored = from_bytes(to_bytes(result))
    xr.testing.assert_identical(stored, result)
    large = result.assign(steps=result.steps.astype("int64") + 2**40)
    np.testing.assert_array_equal(from_bytes(to_bytes(large)).steps, large.steps)
