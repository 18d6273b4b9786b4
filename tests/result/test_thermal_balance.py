"""Temperature of the oil: one place where it enters, its effect on friction, and the balance of
heat.
"""

import numpy as np
import pytest
from scipy.optimize import minimize

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
from macroslip.bearing import geometry
from macroslip.bearing.geometry import initial_angles
from macroslip.contact.rolling import light_contact
from macroslip.errors import InputError
from macroslip.result.heat_balance import at_balance, bearing_friction_power, operating_clearance
from macroslip.result.plausibility import doubtful_result
from macroslip.result.prepared import prepare
from macroslip.result.run_input import run_input
from tests.quick import COARSE

pytestmark = pytest.mark.slow

LOADS = BearingLoads.constant([-20.3e3, -343.5e3, 164.4e3], shaft_speed=2.143, duration=9.0)


def case(**changes):
    return Case(loads=LOADS, rollers=[0], laws=Laws.physical(), integrator=COARSE, **changes)


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
    for series in (sliding, rolling, power):
        assert series == sorted(series, reverse=True)
    # Rolling resistance goes about with the viscosity's power 0.6 to 0.75: 1.27, 0.54 and 0.25 Pa
    # s.
    assert 0.5 < np.log(rolling[0] / rolling[2]) / np.log(1.27 / 0.2496) < 0.8


def test_the_oil_given_is_the_oil_at_that_temperature(by_temperature):
    oil = Lubricant.read("vg460-pao").at("50 degC")
    direct = simulate(
        Case(loads=LOADS, rollers=[0], laws=Laws.physical(), lubricant=oil, integrator=COARSE)
    )
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
    case = read_case(path)
    assert (
        case.temperature == pytest.approx(expected)
        if expected != "balance"
        else case.temperature == expected
    )
    assert case.heat == (Heat(conductance=60.0, ambient=293.15) if expected == "balance" else None)


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


def rings(conductance: float, **more: float) -> Heat:
    """Two-node heat with the ring conductance [W/K]."""
    return Heat(
        conductance=60.0,
        ambient=293.15,
        inner_mass=4000.0,
        outer_mass=3000.0,
        ring_conductance=conductance,
        **more,
    )


def bearing_with(clearance: float, state: str) -> Bearing:
    """The base bearing with a diametral clearance [m] given in a state."""
    base = Bearing.read("skf-240-600-bc")
    return base.replace(diametral_clearance=clearance, clearance_state=state)


def growth(oil: float, conductance: float) -> float:
    """Clearance [m] that an inner ring takes which is warmer by P/(2 G_r), P = G_oil (T − T_a)."""
    to_oil = 1.0 / (1.0 / 60.0 + 0.25 / conductance)
    return 11.9e-6 * 0.7454 * 0.5 * to_oil * (oil - 293.15) / conductance


@pytest.mark.parametrize(
    ("state", "given", "reference"),
    [
        ("cold", None, 293.15),
        ("warm", None, 308.15),
        ("warm", 320.0, 320.0),
        ("warm", 280.0, 293.15),
    ],
)
def test_rings_take_clearance_from_the_state_for_which_it_is_given(state, given, reference):
    warm = case(
        temperature="balance",
        heat=rings(100.0, clearance_temperature=given),
        bearing=bearing_with(2e-4, state),
    )
    for oil in (293.15, 308.15, 330.0):
        left = 2e-4 - growth(oil, 100.0) + growth(reference, 100.0)
        assert operating_clearance(warm, oil) == pytest.approx(left, rel=1e-12)
        assert at_balance(warm, oil).bearing.diametral_clearance == pytest.approx(left, rel=1e-12)


def test_rings_of_their_own_temperature_share_the_balance():
    bearing = bearing_with(2e-4, "cold")
    result = simulate(case(temperature="balance", heat=rings(100.0), bearing=bearing))
    inner, outer = result.attrs["inner_ring_temperature"], result.attrs["outer_ring_temperature"]
    assert 293.15 < outer < inner
    assert 0.5 * (inner + outer) == pytest.approx(float(result.inlet_temperature), abs=1e-6)
    assert 60.0 * (outer - 293.15) == pytest.approx(bearing_friction_power(result), rel=0.03)
    loss = result.attrs["clearance_loss"]
    assert loss == pytest.approx(11.9e-6 * 0.7454 * (inner - outer), rel=1e-6)
    # The rollers ran in the clearance that is left.
    left = 2e-4 - loss
    assert 0.0 < left == pytest.approx(run_input(result).bearing.diametral_clearance)
    assert result.attrs["operating_clearance"] == pytest.approx(left)
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


def test_a_balance_under_preload_has_the_heat_of_the_preloaded_rollers():
    """Fit, heat, clearance, preload: the heat lost is that of a bearing with the clearance that
    this heat leaves.
    """
    cold = bearing_with(-20e-6, "cold")
    result = simulate(case(temperature="balance", heat=rings(100.0), bearing=cold))
    oil = float(result.inlet_temperature)
    clearance = -20e-6 - growth(oil, 100.0)
    assert clearance < -50e-6
    assert result.attrs["operating_clearance"] == pytest.approx(clearance, rel=1e-6)
    alone = simulate(case(temperature=oil, bearing=cold.replace(diametral_clearance=clearance)))
    lost = 1.0 / (1.0 / 60.0 + 0.25 / 100.0) * (oil - 293.15)
    assert bearing_friction_power(alone) == pytest.approx(lost, abs=0.4 * 60.0)
    without = case(temperature=oil, bearing=cold.replace(diametral_clearance=0.0))
    assert bearing_friction_power(alone) > 1.2 * bearing_friction_power(simulate(without))
    assert any("preloads the rollers by" in line for line in doubtful_result(result))


def test_rings_that_preload_ever_more_have_no_balance():
    heat = rings(5.0)
    with pytest.raises(InputError, match="the bearing runs away: .* preloads the rollers by"):
        simulate(case(temperature="balance", heat=heat, bearing=bearing_with(2e-4, "cold")))


def rolling_power(clearance: float) -> float:
    """Power [W] of the rolling resistance at raceways: minima of the ring's energy by SciPy, and
    the law of a contact.
    """
    bearing = bearing_with(clearance, "warm")
    model = prepare(case(bearing=bearing)).model
    contacts = (model.laws.inner, model.laws.outer)
    stiffness = (
        sum(contact.interface.hertz.stiffness ** (-2.0 / 3.0) for contact in contacts) ** -1.5
    )
    force = LOADS.force[0]
    start = np.concatenate([initial_angles(row, 28) for row in ("downwind", "upwind")])
    side = np.repeat([1.0, -1.0], 28) * np.sin(bearing.contact_angle)
    inward = np.cos(bearing.contact_angle)
    ring_speed = 2.143 * geometry.orbit_ratio(bearing) * geometry.outer_contact_radius(bearing)
    total = 0.0
    turns = np.arange(4) * 2.0 * np.pi / (28 * 4)
    for angle in (start + turn for turn in turns):
        normal = np.column_stack([np.cos(angle) * inward, np.sin(angle) * inward, side])

        def approach(displacement, normal=normal):
            return np.maximum(normal @ displacement * 1e-4 - 0.5 * clearance * inward, 0.0)

        def energy(displacement, approach=approach):
            stored = 0.4 * stiffness * np.sum(approach(displacement) ** 2.5)
            return stored - force @ displacement * 1e-4

        def gradient(displacement, approach=approach, normal=normal):
            return (stiffness * approach(displacement) ** 1.5 @ normal - force) * 1e-4

        rest = minimize(energy, force / np.linalg.norm(force), jac=gradient, options={"gtol": 1e-6})
        loads = stiffness * approach(rest.x) ** 1.5
        loads = loads[loads > 0.0]
        for contact in contacts:
            _, resistance, _ = light_contact(
                contact.rolling, loads, np.full(loads.size, ring_speed)
            )
            total += 2.0 * float(resistance.sum()) * ring_speed / turns.size
    return total


def test_heat_of_a_preload_follows_from_the_loads_of_its_rollers():
    """50 um of preload add a third to the rolling power under these loads, 100 um double it."""
    orbit = 2.0 * np.pi / (2.143 * geometry.orbit_ratio(bearing_with(0.0, "warm")))
    loads = BearingLoads.constant(LOADS.force[0], shaft_speed=2.143, duration=2.000002 * orbit)
    heats, expected = [], []
    for clearance in (2e-4, -5e-5, -1e-4):
        result = simulate(
            Case(
                loads=loads,
                rollers=[0],
                bearing=bearing_with(clearance, "warm"),
                contact_details=False,
                integrator=COARSE,
            )
        )
        raceways = result.rolling_energy.sel(interface=["inner", "outer"])
        heats.append(28.0 * float(raceways.sum()) / orbit)
        expected.append(rolling_power(clearance))
    # Idle rollers add 1 %: their films share the play.
    np.testing.assert_allclose(heats, expected, rtol=0.03)
    assert expected[1] / expected[0] == pytest.approx(1.35, abs=0.01)
    assert heats[1] / heats[0] == pytest.approx(1.37, abs=0.02)
    assert heats[2] / heats[0] == pytest.approx(2.05, abs=0.03)
