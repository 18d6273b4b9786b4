"""Criteria of damage of whole results against numbers derived by hand, and against what the result holds elsewhere."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from macroslip import Bearing, BearingLoads, Case, HubLoads, InputError, Laws, Window, simulate
from macroslip.bearing import geometry
from macroslip.constants import YEAR
from macroslip.result.criteria.criterion import Threshold
from macroslip.result.criteria.evaluation import SURFACES
from macroslip.result.damage import DAMAGE, damage, lines
from macroslip.result.stored import to_netcdf
from macroslip.result.surface_maps import energy_density
from macroslip.result.variables import VARIABLES
from tests.quick import COARSE
from tests.variables import check_variables

BEARING = Bearing.read("skf-240-600-bc")
RATED = 20.463 * math.pi / 30.0


def thrust(load: float) -> Case:
    """A downwind row whose every roller carries a load [N]."""
    force = [0.0, 0.0, 28 * load * math.sin(BEARING.contact_angle)]
    loads = BearingLoads.constant(force, RATED, 30.0)
    return Case(
        loads=loads,
        laws=Laws.physical(),
        oil_supply=0.7,
        rollers=[0, 14],
        gravity=False,
        drag=False,
    )


@pytest.fixture(scope="module")
def result():
    """Thrust and weight that turn in direction, so that rollers leave the load zone and enter it."""
    return simulate(
        Case(
            loads=HubLoads.bundled("14B").window(0.0, 30.0),
            laws=Laws.physical(),
            rollers=[0, 14],
            temperature=323.15,
        )
    )


@pytest.mark.parametrize(
    ("load", "inner", "outer"),
    [(20e3, 0.59e4, 0.48e4), (35e3, 1.15e4, 0.93e4), (50e3, 1.74e4, 1.41e4)],
)
def test_pressure_times_slip_of_a_pass(load, inner, outer):
    """Derived apart from this code for films of 0.7 times the flooded thickness: largest ∫ p |v| dt of a pass [J/m²], and passes a second at rated speed."""
    result = simulate(thrust(load))
    criteria = damage(result)
    passes = criteria.pass_rate.values
    check_variables(criteria, DAMAGE)
    check_variables(result, VARIABLES)
    assert passes[:2] == pytest.approx([5.21, 4.33], rel=2e-3)
    spin = (
        RATED
        * geometry.orbit_ratio(BEARING)
        * geometry.outer_contact_radius(BEARING)
        / geometry.roller_radius(BEARING)
    )
    assert passes[2] == pytest.approx(2.0 * spin / (2.0 * math.pi), rel=1e-6)
    inner_pass = (
        float(criteria.pressure_slip_rate.sel(row="downwind", surface="inner").max()) / passes[0]
    )
    outer_pass = (
        float(criteria.pressure_slip_rate.sel(row="downwind", surface="outer").max()) / passes[1]
    )
    # Stations of 4.4 mm do not catch the very top.
    assert [inner_pass, outer_pass] == pytest.approx([inner, outer], rel=0.025)
    where = (
        1e3
        * result.station.values[
            criteria.pressure_slip_rate.sel(row="downwind", surface="inner").argmax("station")
        ]
    )
    assert 15.0 < abs(where) < 25.0
    assert float(result.working_load.sel(row="downwind", raceway="inner")) == pytest.approx(
        load, rel=1e-6
    )
    # Full contact at k = 1e-17 m²/N for a year: 9.8, 18.9, 28.7 µm.
    full = (
        1e-17 * YEAR * float(criteria.pressure_slip_rate.sel(row="downwind", surface="inner").max())
    )
    assert 1e6 * full == pytest.approx({20e3: 9.8, 35e3: 18.9, 50e3: 28.7}[load], rel=0.025)


@pytest.mark.slow
@pytest.mark.parametrize("orbits", [1.05, 1.5, 2.05, 4.05])
@pytest.mark.parametrize("rollers", [[0], [0, 14]])
def test_a_sector_that_is_passed_once_more_is_no_worse_than_the_others(orbits, rollers):
    """Under thrust alone all sectors of the outer raceway are alike, however many orbits and rollers there are.

    A pass does 0.93e4 J/m² (as above), 4.33 times a second: 0.0403 W/mm².
    """
    case = thrust(35e3)
    period = 2.0 * math.pi / (RATED * geometry.orbit_ratio(BEARING))
    loads = BearingLoads.constant(case.loads.force[0], RATED, orbits * period)
    result = simulate(replace(case, loads=loads, rollers=rollers, window=Window(start=0.0)))
    criteria = damage(result).sel(row="downwind", surface="outer")
    assert float(criteria.pressure_slip_rate.max()) == pytest.approx(0.0405e6, rel=1e-3)
    assert float(criteria.pressure_slip_rate.max()) == pytest.approx(0.93e4 * 4.33, rel=0.01)
    # The sum over all sectors does not know how often each was passed.
    outer = result.sel(row="downwind", raceway="outer")
    mean = outer.surface_asperity_energy.mean("angle") / outer.cell_area
    mean = mean * 28 / len(rollers) / (orbits * period)
    friction = json.loads(result.attrs["input"])["lubricant"]["boundary_friction"]["value"]
    assert float(criteria.asperity_work_rate.max()) == pytest.approx(
        float(mean.max()) / friction, rel=1e-3
    )
    density = energy_density(result).sel(row="downwind", raceway="outer")
    passed = density.where(outer.surface_passes > 0.0).max("station")
    assert float(passed.max()) == pytest.approx(float(passed.mean()), rel=1e-3)


@pytest.mark.slow
def test_passes_are_the_way_of_the_rollers(result):
    passes = result.surface_passes.sum("angle").transpose("row", "raceway").values
    loads, start = HubLoads.bundled("14B").window(0.0, 30.0), result.attrs["window_start"]
    time = np.append(start, loads.time[loads.time > start])
    angle = np.trapezoid(np.interp(time, loads.time, loads.shaft_speed), time)
    ratio = geometry.orbit_ratio(BEARING)
    expected = np.array([1.0 - ratio, ratio]) * angle / (2.0 * math.pi) * 72 * 2
    np.testing.assert_allclose(passes, np.tile(expected, (2, 1)), rtol=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "within"), [("12B", 0.1), ("idle-6", 0.1)])
def test_two_rollers_tell_what_all_of_them_do(name, within):
    """Of ten minutes of wind each sector has seen many passes; of an event without an orbit some sectors have seen one."""
    loads = HubLoads.bundled(name)
    if name == "12B":
        loads = loads.window(0.0, 120.0)
    case = Case(loads=loads, laws=Laws.physical(), integrator=COARSE)
    every, some = (damage(simulate(replace(case, rollers=rollers))) for rollers in ("all", [0, 14]))
    for rate in ("pressure_slip_rate", "asperity_work_rate"):
        ratio = some[rate].max("station") / every[rate].max("station")
        outer = ratio.sel(row="downwind", surface="outer")
        assert float(outer) == pytest.approx(1.0, rel=within)
    assert "in an event" not in every.attrs["not_kept"]
    assert ("in an event" in some.attrs["not_kept"]) == (name == "idle-6")


def test_rollers_that_do_not_pass_the_whole_raceway_are_told():
    quarter = replace(thrust(20e3), loads=BearingLoads.constant([0.0, 0.0, 3e5], RATED, 1.6))
    told = damage(simulate(replace(quarter, rollers=[0]))).attrs["not_kept"]
    assert "Of 28 rollers a row 1 were simulated, and these did not pass" in told
    assert "did not pass" not in damage(simulate(replace(quarter, rollers="all"))).attrs["not_kept"]


def test_the_result_says_for_how_long_the_law_of_asperities_was_out_of_its_range():
    """Two seconds of thrust: the downwind row is pressed by 20 kN (W 8e-5), the upwind one by its films alone (W 1e-6)."""
    held = replace(thrust(20e3), rollers=[0], window=Window(start=0.0))
    held = replace(held, loads=BearingLoads.constant(held.loads.force[0], RATED, 2.0))
    result = simulate(held)
    share = result.outside_asperity_range.sel(interface=["inner", "outer"])
    assert share.attrs["units"] == "1" and "asperities" in share.attrs["long_name"]
    assert (share.sel(row="downwind") == 0.0).all() and (share.sel(row="upwind") == 1.0).all()
    told = damage(result).attrs["not_kept"]
    assert "0 % in the downwind row and 100 % in the upwind row of the loaded time" in told
    # An idle film of Λ 16 leaves nothing to wear but what tables are off by.
    wear = damage(result).asperity_work_rate
    assert float(wear.sel(row="upwind").max()) < 1e-6 * float(wear.sel(row="downwind").max())
    by_film = replace(held, laws=held.laws.but(asperities="film-ratio"))
    assert "outside_asperity_range" not in simulate(by_film)


def test_maps_of_films_that_leave_asperities_nothing_hold_numbers():
    """Cold oil: of an idle roller's load asperities carry less than the least number."""
    cold = replace(thrust(20e3), rollers=[0], temperature=273.15, window=Window(start=0.0))
    cold = replace(cold, loads=BearingLoads.constant(cold.loads.force[0], RATED, 1.0))
    energy = simulate(cold).surface_asperity_energy
    assert np.isfinite(energy).all() and (energy >= 0.0).all()


def test_maps_hold_all_that_asperities_dissipate(result):
    by_row = result.surface_asperity_energy.sum(("angle", "station"))
    total = (
        result.asperity_energy.sel(interface=["inner", "outer"])
        .sum("roller")
        .rename(interface="raceway")
    )
    assert (total > 0.0).all()
    np.testing.assert_allclose(by_row.values, total.transpose("row", "raceway").values, rtol=1e-9)
    # Asperities dissipate no more than µ_b times pressure times slip, nor more than the contact does.
    friction = json.loads(result.attrs["input"])["lubricant"]["boundary_friction"]["value"]
    places = ("angle", "station")
    assert (
        result.surface_asperity_energy.sum(places) <= friction * result.surface_work.sum(places)
    ).all()
    energy = result.surface_energy.sum(("slip_sign", "film_regime"))
    assert (
        float(result.surface_asperity_energy.sum())
        < float(energy.sum())
        < float(result.surface_work.sum())
    )


def test_wear_goes_with_the_energy_of_asperities_and_with_k(result):
    criteria = damage(result)
    settings = json.loads(result.attrs["input"])
    friction = settings["lubricant"]["boundary_friction"]["value"]
    seconds = result.attrs["window_end"] - result.attrs["window_start"]
    area = result.cell_area.sel(raceway="inner") * result.sizes["angle"]
    volume = (criteria.asperity_work_rate.sel(surface="inner", drop=True) * area).sum("station")
    energy = result.asperity_energy.sel(interface="inner").sum("roller") * (
        28 / result.sizes["roller"]
    )
    np.testing.assert_allclose(volume.values, energy.values / friction / seconds, rtol=1e-9)
    half = damage(result, wear_coefficients=[5e-18])
    np.testing.assert_allclose(
        half.wear_time.values[..., 0], 2.0 * criteria.wear_time.values[..., 1], rtol=1e-12
    )
    hard = damage(result, wear_coefficients=[7e-8], hardness=7e9)
    np.testing.assert_allclose(
        hard.wear_time.values[..., 0], criteria.wear_time.values[..., 1], rtol=1e-12
    )
    # A thousandth of the time to 1 µm wears a thousandth of it, at the place that wears most.
    rate = criteria.asperity_work_rate.max("station")
    first = criteria.wear_time.isel(depth=0, wear_coefficient=1) * 1e-17 * rate
    # The profile grows under the mean load, whose place of most wear has a tenth more than that of all loads.
    np.testing.assert_allclose(first.sel(row="downwind").values, 1e-6, rtol=0.2)
    year = criteria.asperity_work_rate * 1e-17 * YEAR
    worn = criteria.worn_depth.isel(age=0).sum("station") / year.sum("station")
    np.testing.assert_allclose(worn.sel(row="downwind").values, 1.0, rtol=1e-3)
    assert list(criteria.surface.values) == list(SURFACES)


@pytest.mark.slow
def test_free_orbits_change_the_criteria_little(result):
    """The whole bearing has its rollers on orbits of their own; the loads and the slip under them are nearly the same."""
    case = Case(
        loads=HubLoads.bundled("14B").window(0.0, 20.0),
        laws=Laws.physical(),
        temperature=323.15,
        integrator=COARSE,
    )
    imposed, free = (
        damage(simulate(replace(case, dynamics=dynamics)))
        for dynamics in ("imposed-orbit", "whole-bearing")
    )
    value = (free.value / imposed.value).sel(
        criterion=["entry_slide_roll_ratio", "friction_energy_rate"]
    )
    np.testing.assert_allclose(value.values, 1.0, rtol=0.03)
    times = (free.wear_time / imposed.wear_time).isel(wear_coefficient=1)
    np.testing.assert_allclose(times.sel(row="downwind").values, 1.0, rtol=0.05)


def test_films_and_slip_are_shares_of_loaded_time(result):
    criteria = damage(result)
    mixed = criteria.mixed_time.sel(row="downwind").values
    assert (np.diff(mixed, axis=-1) >= 0.0).all() and (mixed <= 1.0).all() and mixed.max() > 0.9
    loaded = result.film_slip_time.sum(("film_class", "slip_class"))
    seconds = result.attrs["window_end"] - result.attrs["window_start"]
    assert (loaded <= seconds * result.sizes["roller"]).all() and (
        loaded.sel(row="downwind") > 0.0
    ).all()
    passes = result.film_slip_passes.sum(("film_class", "slip_class")) / loaded
    # Over either ring a roller travels as its orbit does against it.
    np.testing.assert_allclose(
        passes.sel(row="downwind").values * 28, criteria.pass_rate.values[:2], rtol=0.05
    )


def test_entries_into_the_load_zone(result):
    criteria = damage(result)
    held = result.entries > 0
    assert held.any() and (criteria.entry_rate > 0.0).any()
    for name in ("entry_slide_roll_ratio", "entry_power_density", "entry_flash_temperature"):
        values = result[name]
        assert (values.where(held.any("roller")).max() > 0.0).all()
        interface = result[name.removeprefix("entry_")].sel(interface=["inner", "outer"]).max()
        # A transient is below what the same power gives for ever, and no entry is above the orbit's extreme.
        assert float(values.max()) <= float(interface) * (1 + 1e-9)
    at_least, at_most = (
        criteria[f"entry_slide_roll_ratio_beyond_{end}"] for end in ("least", "most")
    )
    assert (at_least <= at_most).all() and (at_most <= criteria.entry_rate.max()).all()


def test_a_line_a_criterion_and_own_thresholds(result):
    rows, missing = lines(result)
    assert (
        all(row["value"] >= 0.0 and row["how sure"].startswith("factor") for row in rows)
        and len(rows) >= 7
    )
    assert not any("zero" in sentence for sentence in missing)
    own = damage(result, thresholds={"entry_power_density": Threshold(2e6, "our rig")}).sel(
        criterion="entry_power_density"
    )
    assert (
        float(own.ratio) == float(own.value) / 2e6
        and own.compared_with.item() == "your threshold: our rig"
    )
    assert {variable.attrs["units"] for variable in damage(result).data_vars.values()} and len(
        to_netcdf(damage(result))
    ) > 0


def test_what_was_not_kept_is_said_and_no_zero(result):
    rows, (sentence,) = lines(
        simulate(
            Case(loads=HubLoads.bundled("14B").window(0.0, 10.0), rollers=[0], laws=Laws.paper())
        )
    )
    assert rows == [] and "contact_details: true" in sentence
    rows, missing = lines(
        simulate(
            Case(
                loads=HubLoads.bundled("parked-12").window(0.0, 20.0),
                rollers=[0],
                integrator=COARSE,
            )
        )
    )
    assert not any("entry" in row["criterion"] for row in rows) and any(
        "No roller entered" in sentence for sentence in missing
    )
    bare = simulate(thrust(20e3))
    rows, missing = lines(bare)
    assert not any(row["criterion"].startswith("entry") for row in rows) and any(
        "No roller entered" in sentence for sentence in missing
    )


def test_a_part_of_an_orbit_tells_nothing_of_a_year(result):
    """Without a complete orbit, rates stay and what is said of a year is left out."""
    whole = {line["criterion"] for line in lines(result)[0]}
    kept, missing = lines(result.isel(orbit=slice(0, 0)))
    assert whole - {line["criterion"] for line in kept} >= {"friction_energy_year", "wear_time"}
    assert "friction_energy_rate" in {line["criterion"] for line in kept}
    assert any("completed an orbit" in sentence for sentence in missing)
    assert "wear_time" not in damage(result.isel(orbit=slice(0, 0)))


def test_wear_without_asperities_names_the_law_to_choose():
    smooth = simulate(
        Case(loads=thrust(20e3).loads, laws=Laws.physical().but(asperities="none"), rollers=[0])
    )
    rows, missing = lines(smooth)
    assert not any(row["criterion"] == "wear_time" for row in rows) and any(
        "masjedi-khonsari" in sentence for sentence in missing
    )
    with pytest.raises(InputError, match="masjedi-khonsari"):
        damage(smooth, wear_coefficients=[1e-17])


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"wear_coefficients": [1e-17, 1e-18]}, "rising"),
        ({"wear_coefficients": []}, "rising"),
        ({"wear_coefficients": [-1.0]}, "rising"),
        ({"hardness": 7e9}, "without wear coefficients"),
        ({"thresholds": {"luck": Threshold(1.0, "me")}}, "threshold of 'luck'"),
        ({"thresholds": {"mixed_time": Threshold(1.0, " ")}}, "where it comes from"),
    ],
)
def test_bad_options(result, given, words):
    with pytest.raises(InputError, match=words):
        damage(result, **given)
