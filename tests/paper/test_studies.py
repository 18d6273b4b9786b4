"""Studies of the paper run like any other, and their tables hold what the simulation gives."""

import numpy as np
import pytest
import xarray as xr

from macroslip import Case, HubLoads, InputError, MacroslipError, Window, simulate
from macroslip.study.study_file import study_of
from paper.studies import (
    DETAILED_CASE,
    PARTS,
    compute,
    content,
    dissipation,
    paper_numbers,
    paper_study,
    sensitivity,
)

pytestmark = pytest.mark.slow

SHORT = {"rollers": [0, 14], "loads": {"end": "16 s"}}  # holds a roller load of 110 kN


def test_the_detailed_case_is_one_of_the_study():
    (load,) = study_of(content("detail", "paper")).loads.loads
    assert load.name == DETAILED_CASE
    assert load.name in [one.name for one in study_of(content("study", "paper")).loads.loads]


def test_a_second_run_computes_nothing(small, tmp_path):
    made = study_of(small("study", "paper", bundled=["14A", "14B"], rollers=[0], window={"end": "20 s"}))
    calls = []
    assert compute(made, tmp_path / "out", progress=lambda *call: calls.append(call))
    assert calls == [(1, 2), (2, 2)]
    assert not compute(made, tmp_path / "out")


def test_a_window_without_an_orbit_is_refused(small, tmp_path):
    made = small("study", "paper", bundled=["14B"], rollers=[0], window={"start": "1 s", "end": "2 s"})
    compute(study_of(made), tmp_path / "out")
    with pytest.raises(InputError, match="no complete orbit"):
        paper_study(tmp_path / "out")


def test_study_holds_what_the_simulation_gives(study):
    result = simulate(Case(loads=HubLoads.bundled("14A"), rollers=[0, 14], window=Window(end=30.0)))
    one = study.sel(case="14A")
    np.testing.assert_array_equal(one.energy, result.energy)
    samples = result.peak_power.max("interface").values.reshape(2, -1)
    np.testing.assert_allclose(one.peak_power_mean, samples.mean(axis=1), rtol=1e-14)
    np.testing.assert_allclose(one.peak_power_std, samples.std(axis=1), rtol=1e-12)
    assert int(one.orbits) == result.sizes["orbit"]
    assert study.wind_speed.values.tolist() == [12.0, 14.0, 14.0]
    assert all(variable.attrs["units"] for variable in study.data_vars.values())


def test_numbers_are_normalised_by_the_reference_case(study):
    numbers = paper_numbers(study)
    assert (numbers.energy_normalised.sel(case="12C") == 1.0).all()
    assert numbers.both_rows_normalised.sel(case="12C") == 1.0
    assert (numbers.peak_power_mean_normalised.sel(case="14A") == 1.0).all()
    total = study.energy.sum("interface").mean("roller")
    np.testing.assert_allclose(numbers.energy, total, rtol=1e-15)
    np.testing.assert_allclose(numbers.energy_ratio, total.sel(row="downwind") / total.sel(row="upwind"), rtol=1e-15)
    assert (numbers.energy_min <= numbers.energy).all()
    assert (numbers.energy <= numbers.energy_max).all()


def test_parts_and_stations_add_up_to_the_energy_per_orbit(physical_study):
    parts = dissipation(physical_study)
    per_orbit = physical_study.energy.mean("roller") / physical_study.orbits
    np.testing.assert_allclose(parts.part_energy.sum("part"), per_orbit.sum("interface"), rtol=1e-6)
    width = float(np.diff(physical_study.station).mean())
    along = (parts.station_energy * width).sum("station").sel(raceway=["inner", "outer"], row="downwind")
    # A contact without load but a roller's weight may be shorter than a station.
    np.testing.assert_allclose(along, per_orbit.sel(interface=["inner", "outer"], row="downwind"), rtol=1e-3)
    down = parts.part_energy.sel(row="downwind")
    micro = down.sel(part=[one for one in PARTS if "," in one and "sliding" not in one]).sum("part")
    assert (micro > 0.95 * (down.sum("part") - down.sel(part="cage"))).all()
    # Rolling resistance presses the rollers against the cage: 12 to 20 % of the row's energy, as the study page says.
    share = down.sel(part="cage") / down.sum("part")
    assert ((share > 0.12) & (share < 0.2)).all()


def test_the_exponent_is_that_of_a_power_law(physical_study):
    study = physical_study
    load = xr.DataArray([[1e4, 1e2], [2e4, 0.0], [4e4, 1e2]], dims=("case", "row"), coords={"row": study.row})
    scaled = study.assign(roller_load=load)
    weight = (load.sel(row="downwind") ** 1.5).drop_vars("row")
    for name in ("energy", "mechanism_energy"):
        one = study[name].isel(case=[0, 0, 0]).assign_coords(case=study.case)
        scaled[name] = one * weight * study.orbits
    found = dissipation(scaled).load_exponent
    assert float(found.sel(row="downwind")) == pytest.approx(1.5)
    assert np.isnan(found.sel(row="upwind"))


@pytest.fixture(scope="module")
def varied(small, tmp_path_factory):
    directory = tmp_path_factory.mktemp("sensitivity") / "out"
    made = study_of(small("sensitivity", "paper", **SHORT))
    with pytest.raises(MacroslipError, match="1 cases of 'Sensitivity of case 14B' failed, case 14B first: .*ellipse"):
        compute(made, directory)
    assert not compute(made, directory, may_fail=True), "the others were computed before"
    return sensitivity(directory, "paper")


def test_every_point_is_a_run_of_its_own_over_the_base_case(varied):
    case = Case(loads=HubLoads.bundled("14B").window(None, 16.0), rollers=[0, 14])
    warm = Case(loads=case.loads, rollers=case.rollers, lubricant=case.lubricant.at("60 degC"))
    base, other = (simulate(one).energy.sum("interface").mean("roller") for one in (case, warm))
    np.testing.assert_allclose(varied.energy.sel(point="oil temperature 60 °C"), other / base, rtol=1e-12)
    assert (varied.energy.sel(point="oil temperature 20 °C") > 1.0).all()
    assert (varied.energy.sel(point="film factor 0.7") > 1.0).all()
    assert (varied.failed == 0).all()


def test_a_refused_value_has_its_reason_and_no_number(varied):
    refused = varied.sel(point="osculation 0.99")
    assert "contact ellipse would reach beyond the roller's ends" in str(refused.reason.values)
    assert np.isnan(refused.energy).all()
    others = varied.drop_sel(point="osculation 0.99")
    assert not any(others.reason.values)
    assert np.isfinite(others.energy).all()


@pytest.mark.parametrize("model", ["paper", "physical"])
def test_every_point_changes_one_value_with_what_follows_from_it(model):
    base, *points = content("sensitivity", model)["variations"]["list"]
    assert base == {}
    for point in points:
        together = {"bearing.osculation_inner", "laws.starvation"}
        assert len(point.keys() - together) == 1
        if "bearing.osculation_inner" in point:
            assert point["bearing.osculation_inner"] == point["bearing.osculation_outer"]
