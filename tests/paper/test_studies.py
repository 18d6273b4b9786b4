"""Studies of the paper run like any other, and their tables hold what the simulation gives."""

import numpy as np
import pytest
import xarray as xr

from macroslip import Case, HubLoads, InputError, Laws, Window, simulate
from macroslip.study.study_file import study_of
from paper.studies import (
    DETAILED_CASE,
    PARTS,
    compute,
    content,
    dissipation,
    paper_numbers,
    paper_study,
)

pytestmark = pytest.mark.slow


def test_the_detailed_case_is_one_of_the_study():
    (load,) = study_of(content("detail", "paper")).loads.loads
    assert load.name == DETAILED_CASE
    assert load.name in [load.name for load in study_of(content("study", "paper")).loads.loads]


def test_a_second_run_computes_nothing(small, tmp_path):
    made = study_of(
        small("study", "paper", bundled=["14A", "14B"], rollers=[0], window={"end": "20 s"})
    )
    calls = []
    assert compute(made, tmp_path / "out", progress=lambda *call: calls.append(call))
    assert calls[-1] == (2, 2) and calls == sorted(calls)
    assert not compute(made, tmp_path / "out")


def test_a_window_without_an_orbit_is_refused(small, tmp_path):
    made = small(
        "study", "paper", bundled=["14B"], rollers=[0], window={"start": "1 s", "end": "2 s"}
    )
    compute(study_of(made), tmp_path / "out")
    with pytest.raises(InputError, match="no complete orbit"):
        paper_study(tmp_path / "out")


def test_study_holds_what_the_simulation_gives(study):
    result = simulate(
        Case(
            loads=HubLoads.bundled("14A"),
            laws=Laws.paper(),
            rollers=[0, 14],
            window=Window(end=30.0),
        )
    )
    case = study.sel(case="14A")
    np.testing.assert_array_equal(case.energy, result.energy)
    samples = result.peak_power.max("interface").values.reshape(2, -1)
    np.testing.assert_allclose(case.peak_power_mean, samples.mean(axis=1), rtol=1e-14)
    np.testing.assert_allclose(case.peak_power_std, samples.std(axis=1), rtol=1e-12)
    assert int(case.orbits) == result.sizes["orbit"]
    assert study.wind_speed.values.tolist() == [12.0, 14.0, 14.0]
    assert all(variable.attrs["units"] for variable in study.data_vars.values())


def test_numbers_are_normalised_by_the_reference_case(study):
    numbers = paper_numbers(study)
    assert (numbers.energy_normalised.sel(case="12C") == 1.0).all()
    assert numbers.both_rows_normalised.sel(case="12C") == 1.0
    assert (numbers.peak_power_mean_normalised.sel(case="14A") == 1.0).all()
    total = study.energy.sum("interface").mean("roller")
    np.testing.assert_allclose(numbers.energy, total, rtol=1e-15)
    np.testing.assert_allclose(
        numbers.energy_ratio, total.sel(row="downwind") / total.sel(row="upwind"), rtol=1e-15
    )
    assert (numbers.energy_min <= numbers.energy).all()
    assert (numbers.energy <= numbers.energy_max).all()


def test_parts_and_stations_add_up_to_the_energy_per_orbit(physical_study):
    parts = dissipation(physical_study)
    per_orbit = physical_study.energy.mean("roller") / physical_study.orbits
    np.testing.assert_allclose(parts.part_energy.sum("part"), per_orbit.sum("interface"), rtol=1e-6)
    width = float(np.diff(physical_study.station).mean())
    along = (
        (parts.station_energy * width)
        .sum("station")
        .sel(raceway=["inner", "outer"], row="downwind")
    )
    # A contact without load but a roller's weight may be shorter than a station.
    np.testing.assert_allclose(
        along, per_orbit.sel(interface=["inner", "outer"], row="downwind"), rtol=1e-3
    )
    down = parts.part_energy.sel(row="downwind")
    micro = down.sel(part=[part for part in PARTS if "," in part and "sliding" not in part]).sum(
        "part"
    )
    assert (micro > 0.85 * (down.sum("part") - down.sel(part="cage"))).all()
    # Rolling resistance presses the rollers against the cage: 25 to 36 % of the row's energy, as the study page says.
    share = down.sel(part="cage") / down.sum("part")
    assert ((share > 0.25) & (share < 0.36)).all()


def test_the_exponent_is_that_of_a_power_law(physical_study):
    study = physical_study
    load = xr.DataArray(
        [[1e4, 1e2], [2e4, 0.0], [4e4, 1e2]], dims=("case", "row"), coords={"row": study.row}
    )
    scaled = study.assign(roller_load=load)
    weight = (load.sel(row="downwind") ** 1.5).drop_vars("row")
    for name in ("energy", "mechanism_energy"):
        energy = study[name].isel(case=[0, 0, 0]).assign_coords(case=study.case)
        scaled[name] = energy * weight * study.orbits
    exponent = dissipation(scaled).load_exponent
    assert float(exponent.sel(row="downwind")) == pytest.approx(1.5)
    assert np.isnan(exponent.sel(row="upwind"))
