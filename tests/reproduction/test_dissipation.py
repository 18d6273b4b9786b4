"""Energy by mechanism and station adds up, and the reasons given follow the numbers."""

import numpy as np
import pytest
import xarray as xr

from macroslip.reproduction.dissipation import PARTS, dissipation, explained, knows_mechanisms, reasons
from macroslip.reproduction.paper_numbers import paper_numbers
from macroslip.reproduction.statement import AGREES, Statement

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def study(small_paper_study):
    return small_paper_study("study_physical", ("12C", "14A", "24A"), window={"end": "20 s"})


@pytest.fixture(scope="module")
def parts(study):
    return dissipation(study)


def test_the_study_keeps_what_curved_contacts_know(study):
    assert knows_mechanisms(study)
    assert not knows_mechanisms(study.drop_vars("mechanism_energy"))
    assert study.flash_temperature.dims == ("case", "row", "roller", "interface")
    assert (study.flash_temperature.sel(row="downwind", interface="inner") > 0.1).all()
    assert (study.min_film_ratio.sel(row="downwind", interface="inner") > 0.1).all()
    assert "in the window" in study.flash_temperature.attrs["long_name"]
    assert study.attrs["model"] == "physical"


def test_parts_add_up_to_the_energy_per_orbit(study, parts):
    whole = study.energy.sum("interface").mean("roller") / study.orbits
    np.testing.assert_allclose(parts.part_energy.sum("part"), whole, rtol=1e-6)
    assert parts.part.values.tolist() == list(PARTS)


def test_stations_add_up_to_the_raceways_energy(study, parts):
    width = float(np.diff(study.station).mean())
    along = (parts.station_energy * width).sum("station").sel(raceway=["inner", "outer"])
    raceways = study.energy.sel(interface=["inner", "outer"]).mean("roller") / study.orbits
    # A contact without load but a roller's weight may be shorter than a station.
    np.testing.assert_allclose(along.sel(row="downwind"), raceways.sel(row="downwind"), rtol=1e-3)


def test_microslip_dissipates_downwind_where_the_load_is(parts):
    down = parts.part_energy.sel(row="downwind")
    micro = down.sel(part=[one for one in PARTS if "," in one and "sliding" not in one]).sum("part")
    cage = down.sel(part="cage")
    assert (micro > 0.95 * (down.sum("part") - cage)).all()
    # Rolling resistance presses the rollers against the cage: 12 to 20 % of the row's energy, as the study page says.
    share = cage / down.sum("part")
    assert ((share > 0.12) & (share < 0.2)).all()
    assert ((parts.asperity_share >= 0.0) & (parts.asperity_share < 1.0)).all()


def test_the_exponent_is_that_of_a_power_law(study):
    load = xr.DataArray([[1e4, 1e2], [2e4, 0.0], [4e4, 1e2]], dims=("case", "row"), coords={"row": study.row})
    scaled = study.assign(roller_load=load)
    weight = (load.sel(row="downwind") ** 1.5).drop_vars("row")
    for name in ("energy", "mechanism_energy"):
        one = study[name].isel(case=[0, 0, 0]).assign_coords(case=study.case)
        scaled[name] = one * weight * study.orbits
    found = dissipation(scaled).load_exponent
    assert float(found.sel(row="downwind")) == pytest.approx(1.5)
    assert np.isnan(found.sel(row="upwind"))


def test_reasons_hold_the_numbers(study):
    numbers = paper_numbers(study)
    words = reasons(study, numbers)
    assert all(words.values())
    cage = 100.0 * study.energy.sel(interface="cage").sum("roller") / study.energy.sum(("roller", "interface"))
    assert f"{100.0 - float(cage.sel(row='downwind').max()):.1f} % or more" in words["cage"]
    thrust = [float(study.thrust.sel(case=one)) for one in ("12C", "24A")]
    assert f"mean thrust falls from {1e-3 * thrust[0]:.3g} to {1e-3 * thrust[1]:.3g} kN" in words["energy"]
    failed = study.copy(deep=True)
    failed.status[0, 0, 0] = 3
    assert not any(reasons(failed, numbers).values())


def test_statements_get_reasons_and_keep_their_verdicts(study):
    subjects = ("Euler", "energy", "rows", "peaks", "peak ratio", "unloaded", "static", "cage")
    statements = {one: Statement(paper=one, verdict=AGREES, found="so", because="old") for one in subjects}
    found = explained(statements, study, paper_numbers(study))
    assert [one.verdict for one in found.values()] == [AGREES] * 8
    assert {subject for subject, one in found.items() if one.because == "old"} == {"unloaded", "Euler"}
    assert found["cage"].because == reasons(study, paper_numbers(study))["cage"]
