"""The input of a result is made once, and from a file as from memory."""

import numpy as np
import pytest
import xarray as xr

from macroslip import BearingLoads, Case, InputError, Laws, simulate
from macroslip.result import run_input as run_inputs
from macroslip.result.damage import damage
from macroslip.result.prepared import prepare
from macroslip.result.run_input import run_input
from tests.quick import COARSE

LOADS = BearingLoads.constant([0.0, -300e3, 100e3], 0.0, 1.0)


@pytest.fixture(scope="module")
def result():
    return simulate(
        Case(
            loads=LOADS,
            laws=Laws.physical(),
            temperature=330.0,
            rollers=[0],
            integrator=COARSE,
        )
    )


def test_parts_of_a_result_share_one_input(result):
    of_result = run_input(result)
    assert run_input(result.isel(roller=0)) is of_result
    assert run_input(result[["energy", "status"]]) is of_result
    assert run_input(result.sel(row=["upwind"])).models.keys() == {"upwind"}


def test_a_result_in_memory_has_the_rollers_that_it_was_computed_with(monkeypatch):
    case = Case(
        loads=LOADS, laws=Laws.physical(), temperature=331.0, rollers=[0], integrator=COARSE
    )
    result = simulate(case)
    monkeypatch.delattr(run_inputs, "bearing_from_dict")
    monkeypatch.delattr(run_inputs, "roller_model")
    of_result = run_input(result)
    assert of_result.bearing is case.bearing
    assert of_result.models.keys() == {"downwind", "upwind"}
    assert damage(result).attrs["title"]


def test_a_result_from_a_file_has_the_input_of_the_case(result, tmp_path):
    result.to_netcdf(tmp_path / "result.nc", engine="h5netcdf")
    stored = xr.load_dataset(tmp_path / "result.nc", engine="h5netcdf", decode_times=False)
    case = Case(loads=LOADS, laws=Laws.physical(), temperature=330.0)
    film = prepare(case).models["downwind"].laws.inner.film_thickness
    load, speed = np.array([1e4]), np.array([2.0])
    for dataset in (result, stored):
        of_dataset = run_input(dataset)
        assert of_dataset.bearing == case.bearing
        assert of_dataset.start == 0.0
        assert not of_dataset.is_event
        # The oil at the temperature of the case, supplied as the case says.
        inner = of_dataset.models["downwind"].laws.inner
        assert inner.film_thickness(load, speed) == film(load, speed)


def test_a_dataset_without_input_is_refused(result):
    for text in ("{}", "no JSON", "[]"):
        with pytest.raises(InputError, match="what it was computed with"):
            run_input(result.assign_attrs(input=text))
    with pytest.raises(InputError, match="what it was computed with"):
        run_input(result.drop_attrs())
