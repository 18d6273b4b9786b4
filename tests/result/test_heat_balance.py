"""Heat balance of a bearing: exact cases, and what has no balance."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.special import lambertw

from macroslip import Heat
from macroslip.errors import InputError
from macroslip.result.heat_balance import (
    HOTTEST,
    balance_temperature,
    ring_temperatures,
    tabulated_power,
)


@given(st.floats(0.0, 3000.0), st.floats(40.0, 80.0), st.floats(250.0, 310.0))
def test_constant_power_warms_by_power_over_conductance(power, conductance, ambient):
    expected = ambient + power / conductance
    assert balance_temperature(lambda _: power, conductance, ambient) == pytest.approx(
        expected, abs=1e-8
    )


@given(st.floats(10.0, 3000.0), st.floats(0.0, 50.0), st.floats(250.0, 310.0))
def test_power_that_falls_in_proportion(power, slope, ambient):
    # P0 - s (T - Ta) = G (T - Ta)
    temperature = balance_temperature(
        lambda t: max(power - slope * (t - ambient), 0.0), 60.0, ambient
    )
    assert temperature == pytest.approx(ambient + power / (60.0 + slope), abs=1e-8)


@pytest.mark.parametrize("beta", [0.01, 0.056, 0.2])
def test_power_that_falls_exponentially(beta):
    # x = (P0/G) exp(-beta x) is solved by x = W(beta P0/G)/beta, W being Lambert's function.
    expected = 288.15 + lambertw(beta * 900.0 / 60.0).real / beta
    temperature = balance_temperature(
        lambda t: 900.0 * math.exp(-beta * (t - 288.15)), 60.0, 288.15
    )
    assert temperature == pytest.approx(expected, abs=1e-8)


def test_a_better_cooled_bearing_is_colder_and_no_friction_leaves_it_at_ambient():
    temperatures = [
        balance_temperature(lambda t: 3e5 / t, conductance, 288.15)
        for conductance in (40.0, 60.0, 80.0)
    ]
    assert temperatures[0] > temperatures[1] > temperatures[2] > 288.15
    assert balance_temperature(lambda _: 0.0, 60.0, 288.15) == 288.15


def test_a_bearing_that_warms_stops_at_the_lowest_of_its_balances():
    """Surplus −(x − 10)(x − 30)(x − 60)/100 W at a rise x: balances at 10, 30 and 60 K over the
    surroundings.
    """

    def power(temperature):
        rise = temperature - 288.15
        return 60.0 * rise - 0.01 * (rise - 10.0) * (rise - 30.0) * (rise - 60.0)

    assert balance_temperature(power, 60.0, 288.15) == pytest.approx(298.15, abs=1e-8)


def test_no_balance_is_an_error():
    with pytest.raises(
        InputError, match=f"^there is no heat balance up to {HOTTEST:g} K: .* by 3700 W. Allowed: "
    ):
        balance_temperature(lambda _: 10_000.0, 60.0, 288.15)
    with pytest.raises(InputError, match="^there is no heat balance up to 320 K: .* by 89 W"):
        balance_temperature(lambda _: 2000.0, 60.0, 288.15, hottest=320.0)


@pytest.mark.parametrize("power", [math.nan, math.inf, -1.0])
def test_a_power_that_is_none(power):
    with pytest.raises(
        InputError,
        match="^the friction power at 288.15 K is .* Allowed: a finite number, not negative",
    ):
        balance_temperature(lambda _: power, 60.0, 288.15)


@pytest.mark.parametrize(("conductance", "ambient"), [(0.0, 290.0), (-1.0, 290.0), (math.nan, 290.0), (60.0, 400.0),
                                                      (60.0, math.nan), (60.0, -5.0)])  # fmt: skip
def test_a_conductance_or_ambient_that_is_none(conductance, ambient):
    with pytest.raises(InputError, match="^the (conductance|ambient temperature) is .* Allowed: "):
        balance_temperature(lambda _: 600.0, conductance, ambient)


def test_a_table_is_met_at_its_points_and_stays_between_them():
    at, powers = [283.15, 293.15, 308.15, 323.15], [1200.0, 800.0, 500.0, 350.0]
    power = tabulated_power(at, powers)
    assert [power(t) for t in at] == pytest.approx(powers, rel=1e-12)
    fine = [power(t) for t in np.linspace(270.0, 340.0, 200)]
    assert max(fine) == 1200.0 and min(fine) == 350.0 and (np.diff(fine) <= 0.0).all()
    # A table of a straight line is the line.
    line = tabulated_power([280.0, 300.0, 320.0], [1000.0, 800.0, 600.0])
    assert balance_temperature(line, 60.0, 288.15) == pytest.approx(
        (1000.0 + 10.0 * 280.0 + 60.0 * 288.15) / 70.0
    )


@pytest.mark.parametrize(
    ("temperatures", "powers"),
    [([290.0], [1.0]), ([290.0, 300.0], [1.0]), ([300.0, 290.0], [1.0, 1.0]), ([290.0, 300.0], [1.0, -1.0]),
     ([290.0, 300.0], [1.0, math.nan]), ([290.0, math.nan], [1.0, 1.0])],
)  # fmt: skip
def test_a_table_that_is_none(temperatures, powers):
    with pytest.raises(InputError):
        tabulated_power(temperatures, powers)


RINGS = Heat(
    conductance=60.0, ambient=293.15, inner_mass=4000.0, outer_mass=2500.0, ring_conductance=100.0
)


def test_rings_warm_as_their_equations_say():
    time = np.array([600.0, 7200.0, 36000.0])
    temperatures = ring_temperatures(RINGS, 1200.0, time, (300.0, 290.0))

    def rise(_, now):
        flow = 100.0 * (now[0] - now[1])
        return [
            (600.0 - flow) / (4000.0 * 460.0),
            (600.0 + flow - 60.0 * (now[1] - 293.15)) / (2500.0 * 460.0),
        ]

    known = solve_ivp(rise, (0.0, 36000.0), [300.0, 290.0], t_eval=time, rtol=1e-10, atol=1e-9).y.T
    assert temperatures == pytest.approx(known, abs=1e-5)


def test_rings_in_the_steady_state_lose_what_they_get():
    inner, outer = ring_temperatures(RINGS, 1200.0, [math.inf], (293.15, 293.15))[0]
    assert 100.0 * (inner - outer) == pytest.approx(600.0, rel=1e-12)
    assert 60.0 * (outer - 293.15) == pytest.approx(1200.0, rel=1e-12)
    # The oil has their mean, at which the conductance to the oil carries off the same power.
    assert RINGS.to_oil * (0.5 * (inner + outer) - 293.15) == pytest.approx(1200.0, rel=1e-12)


def test_one_node_is_the_limit_of_rings_that_conduct_well():
    lumped = Heat(conductance=60.0, ambient=293.15)
    assert lumped.to_oil == 60.0
    close = Heat(
        conductance=60.0, ambient=293.15, inner_mass=1.0, outer_mass=1.0, ring_conductance=1e9
    )
    assert close.to_oil == pytest.approx(60.0, rel=1e-7)
    # Cooling, the masses lose their heat at one rate: exp(−G t/((m_i + m_o) c)).
    both = Heat(
        conductance=60.0, ambient=293.15, inner_mass=4000.0, outer_mass=2500.0, ring_conductance=1e6
    )
    cooled = ring_temperatures(both, 0.0, [36000.0], (313.15, 313.15))[0]
    assert cooled - 293.15 == pytest.approx(
        20.0 * math.exp(-60.0 * 36000.0 / (6500.0 * 460.0)), rel=1e-4
    )


def test_part_of_the_rings_is_refused():
    with pytest.raises(
        InputError, match="need inner_mass, outer_mass and ring_conductance. Allowed: all three"
    ):
        Heat(conductance=60.0, ambient=293.15, inner_mass=4000.0)
    with pytest.raises(InputError, match="the masses of the rings are not given"):
        ring_temperatures(Heat(conductance=60.0, ambient=293.15), 1.0, [0.0], (1.0, 1.0))
