"""Temperature of the oil: one place where it enters, its effect on friction, and the balance of heat."""

import numpy as np
import pytest

from macroslip import (
    Bearing,
    BearingLoads,
    Case,
    Heat,
    Laws,
    Lubricant,
    Traces,
    read_case,
    simulate,
)
from macroslip.errors import InputError
from macroslip.result.heat_balance import bearing_friction_power
from macroslip.result.plausibility import doubtful_result
from macroslip.result.run_input import run_input

pytestmark = pytest.mark.slow

LOADS = BearingLoads.constant([-20.3e3, -343.5e3, 164.4e3], shaft_speed=2.143, duration=9.0)


def case(**changes):
    return Case(loads=LOADS, rollers=[0], laws=Laws.physical(), **changes)


@pytest.fixture(scope="module")
def by_temperature():
    return {celsius: simulate(case(temperature=celsius + 273.15)) for celsius in (20.0, 35.0, 50.0)}


def test_the_lubricants_own_temperature_changes_no_digit():
    own = Lubricant.read("vg460-pao").inlet_temperature
    plain = simulate(Case(loads=LOADS, laws=Laws.paper(), rollers=[0]))
    stated = simulate(Case(loads=LOADS, laws=Laws.paper(), rollers=[0], temperature=own))
    for name in ("energy", "rolling_energy", "end_slip", "min_spin_ratio"):
        np.testing.assert_array_equal(plain[name], stated[name])
    assert float(stated.inlet_temperature) == own
    assert stated.inlet_temperature.attrs["units"] == "K"
    assert not plain.rolling_energy.any()


def test_friction_of_every_kind_falls_with_temperature(by_temperature):
    sliding, rolling, power = [], [], []
    for result in by_temperature.values():
        loaded = result.sel(row="downwind")
        sliding.append(float(loaded.energy.sum()))
        rolling.append(float(loaded.rolling_energy.sum()))
        power.append(bearing_friction_power(result))
    for found in (sliding, rolling, power):
        assert found == sorted(found, reverse=True)
    # Rolling resistance goes about with the viscosity's power 0.6 to 0.75: 1.27, 0.54 and 0.25 Pa s.
    assert 0.5 < np.log(rolling[0] / rolling[2]) / np.log(1.27 / 0.2496) < 0.8


def test_the_oil_given_is_the_oil_at_that_temperature(by_temperature):
    oil = Lubricant.read("vg460-pao").at("50 degC")
    direct = simulate(Case(loads=LOADS, rollers=[0], laws=Laws.physical(), lubricant=oil))
    np.testing.assert_array_equal(direct.energy, by_temperature[50.0].energy)
    # What a result tells of its own input has that oil too.
    np.testing.assert_array_equal(
        run_input(direct).models["upwind"].laws.inner.rolling.viscosity,
        run_input(by_temperature[50.0]).models["upwind"].laws.inner.rolling.viscosity,
    )


def test_at_the_balance_friction_heats_as_much_as_is_lost():
    result = simulate(
        case(
            temperature="balance",
            heat=Heat(conductance=60.0, ambient=288.15),
            traces=Traces(step=1.0),
        )
    )
    lost = 60.0 * (float(result.inlet_temperature) - 288.15)
    # 0.2 K of 60 W/K.
    assert bearing_friction_power(result) == pytest.approx(lost, abs=0.4 * 60.0)
    assert result.sizes["time"] == 10
    less = simulate(case(temperature="balance", heat=Heat(conductance=120.0, ambient=288.15)))
    assert 288.15 < float(less.inlet_temperature) < float(result.inlet_temperature)


@pytest.mark.parametrize(
    ("text", "expected"), [("50 degC", 323.15), ("323 K", 323.0), ("balance", "balance")]
)
def test_keys_of_a_case_file(tmp_path, text, expected):
    path = tmp_path / "case.yaml"
    loads, heat = (
        f"loads: {{bundled: 14B, end: 20 s}}\ntemperature: {text}\n",
        "heat: {conductance: 60 W/K, ambient: 20 degC}\n",
    )
    path.write_text(loads + heat)
    if expected != "balance":
        with pytest.raises(InputError, match="line 3, heat: only a balance of heat uses it"):
            read_case(path)
        path.write_text(loads)
    found = read_case(path)
    assert (
        found.temperature == pytest.approx(expected)
        if expected != "balance"
        else found.temperature == expected
    )
    assert found.heat == (Heat(conductance=60.0, ambient=293.15) if expected == "balance" else None)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"temperature": "warm"}, "temperature"),
        ({"temperature": 35.0}, "253.15 to 423.15 K"),
        ({"temperature": "balance"}, "conductance"),
        ({"temperature": True}, "temperature"),
    ],
)
def test_what_is_no_temperature_is_refused(changes, message):
    with pytest.raises(InputError, match=message):
        case(**changes)


def test_an_oil_whose_temperature_is_not_found_yet_is_refused():
    with pytest.raises(InputError, match="only a simulation finds"):
        _ = case(temperature="balance", heat=Heat(conductance=60.0, ambient=288.15)).oil


def test_rings_of_their_own_temperature_share_the_balance():
    heat = Heat(
        conductance=60.0,
        ambient=293.15,
        inner_mass=4000.0,
        outer_mass=3000.0,
        ring_conductance=100.0,
    )
    result = simulate(case(temperature="balance", heat=heat))
    inner, outer = result.attrs["inner_ring_temperature"], result.attrs["outer_ring_temperature"]
    assert 293.15 < outer < inner
    assert 0.5 * (inner + outer) == pytest.approx(float(result.inlet_temperature), abs=1e-6)
    assert 60.0 * (outer - 293.15) == pytest.approx(bearing_friction_power(result), rel=0.03)
    loss = result.attrs["clearance_loss"]
    assert loss == pytest.approx(11.9e-6 * 0.7454 * (inner - outer), rel=1e-6)
    # The rollers ran in the clearance that is left.
    bearing = Bearing.read("skf-240-600-bc")
    left = bearing.diametral_clearance - loss
    assert 0.0 < left == pytest.approx(run_input(result).bearing.diametral_clearance)
    alone = simulate(
        case(
            temperature=float(result.inlet_temperature),
            bearing=bearing.replace(diametral_clearance=left),
        )
    )
    np.testing.assert_array_equal(alone.energy, result.energy)
    assert not (
        alone.energy == simulate(case(temperature=float(result.inlet_temperature))).energy
    ).all()


def test_rings_that_leave_no_clearance_say_so():
    heat = Heat(
        conductance=60.0, ambient=293.15, inner_mass=4000.0, outer_mass=3000.0, ring_conductance=5.0
    )
    result = simulate(case(temperature="balance", heat=heat))
    assert run_input(result).bearing.diametral_clearance == 0.0
    assert result.attrs["clearance_loss"] > Bearing.read("skf-240-600-bc").diametral_clearance
    assert any("preload is not modelled" in line for line in doubtful_result(result))
