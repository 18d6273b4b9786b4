"""Rolling resistance of a contact: action and reaction, energy, limits, derivatives, and the base bearing's torque."""

import math

import numba
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from macroslip.errors import InputError
from macroslip.rolling import martin
from macroslip.rolling.biboulet_houpert import starvation_factor
from macroslip.rolling.elastic_line import InletFilm, WholeFilm, line_rolling
from macroslip.rolling.film import light_film
from macroslip.rolling.gap import film_at_load
from macroslip.rolling.resistance import LOWEST_SPEED, beside_ellipse, rolling_resistance
from macroslip.rolling.rolling_law import NoRolling, prepare_rolling

pytestmark = pytest.mark.slow

SPEED = 0.396
SHAFT_SPEED = 20.463 * math.pi / 30.0


@pytest.fixture(scope="module")
def laws(contacts):
    return {
        (name, where): prepare_rolling(name, *contacts[where])
        for name in ("inlet", "whole-film")
        for where in ("inner", "outer", "cage")
    }


@pytest.mark.parametrize("name", ["inlet", "whole-film"])
@pytest.mark.parametrize("where", ["inner", "outer", "cage"])
@settings(deadline=None)
@given(log_load=st.floats(-2.0, 5.2), u1=st.floats(-2.0, 2.0), u2=st.floats(-2.0, 2.0))
def test_forces_add_up_and_power_is_what_the_surfaces_lose(laws, name, where, log_load, u1, u2):
    forces = rolling_resistance(laws[name, where], 10.0**log_load, u1, u2)
    size = abs(forces.shear)
    assert 2.0 * forces.shear + forces.push_1 + forces.push_2 == pytest.approx(0.0, abs=1e-12 * size)
    # The pressure's push acts through axes that stand still beside the contact, and does no work.
    assert -forces.shear * (u1 + u2) == pytest.approx(forces.power, rel=1e-12)
    assert forces.power >= 0.0
    mirrored = rolling_resistance(laws[name, where], 10.0**log_load, -u1, -u2)
    assert (mirrored.shear, mirrored.by_speed) == (-forces.shear, forces.by_speed)


def test_pushes_go_with_curvature(laws, contacts):
    _, shape, roller_radius = contacts["inner"]
    forces = rolling_resistance(laws["inlet", "inner"], 1e4, SPEED, SPEED)
    assert forces.push_1 == pytest.approx(-2.0 * forces.shear * shape.rolling_radius / roller_radius)
    # At the outer raceway, which is concave, the push on the ring is against the motion.
    outer = rolling_resistance(laws["inlet", "outer"], 1e4, SPEED, SPEED)
    assert outer.push_2 < 0.0 < forces.push_2


@pytest.mark.parametrize("name", ["inlet", "whole-film"])
@pytest.mark.parametrize("where", ["inner", "cage"])
@pytest.mark.parametrize("load", [0.3, 40.0, 400.0, 1500.0, 2e4, 2e5])
@pytest.mark.parametrize("speed", [0.05, 0.8])
def test_derivatives(laws, name, where, load, speed):
    law, step = laws[name, where], 1e-5
    forces = rolling_resistance(law, load, speed, speed)
    up, down = (rolling_resistance(law, load * (1.0 + e), speed, speed).shear for e in (step, -step))
    assert forces.by_load * load == pytest.approx((up - down) / (2.0 * step), rel=1e-6, abs=1e-7)
    up, down = (rolling_resistance(law, load, speed * (1.0 + e), speed * (1.0 + e)).shear for e in (step, -step))
    assert forces.by_speed * speed == pytest.approx((up - down) / (2.0 * step), rel=1e-6)


def test_below_the_lowest_speed_force_is_proportional(laws):
    law = laws["inlet", "inner"]
    at, half = (rolling_resistance(law, 100.0, u, u) for u in (LOWEST_SPEED, 0.5 * LOWEST_SPEED))
    assert half.shear == pytest.approx(0.5 * at.shear)
    assert half.by_speed == pytest.approx(at.shear / LOWEST_SPEED)
    assert rolling_resistance(law, 100.0, 0.2, -0.2).shear == 0.0
    assert rolling_resistance(law, 0.0, 0.2, 0.2).power == 0.0


@pytest.mark.parametrize("where", ["inner", "cage"])
def test_light_contact_is_the_rigid_gap(laws, where):
    law = laws["whole-film", where]
    _, _, rolling, _, _, _ = film_at_load(law.gap, math.log(0.5 / (law.viscosity * SPEED)))
    expected = law.viscosity * SPEED * math.exp(rolling)
    assert -rolling_resistance(law, 0.5, SPEED, SPEED).shear == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize(("name", "elastic"), [("inlet", InletFilm()), ("whole-film", WholeFilm())])
@pytest.mark.parametrize("load", [1e4, 2e4, 5e4, 1e5])
def test_heavy_contact_is_its_slices_and_the_film_beside_them(contacts, name, elastic, load):
    interface, shape, roller_radius = contacts["inner"]
    law = prepare_rolling(name, interface, shape, roller_radius, heating=False)
    radius, modulus, oil = interface.rolling_radius, interface.modulus, interface.lubricant
    across = interface.hertz.semi_axis_across * load ** (1.0 / 3.0)
    doubled = 2.0 * oil.viscosity * SPEED / (modulus * radius)
    middle = 0.75 * load / across / (modulus * radius) / math.sqrt(doubled)
    material = oil.pressure_viscosity * modulus * doubled**0.25

    def slice_at(place):
        return line_rolling(elastic, middle * (1.0 - place * place), material)

    inside = across * modulus * radius * doubled**0.75 * 2.0 * quad(slice_at, 0.0, 1.0, limit=200)[0]
    beside = beside_ellipse(law, math.log(load), math.log(SPEED))[0]
    force = -rolling_resistance(law, load, SPEED, SPEED).shear
    assert force == pytest.approx(inside + beside, rel=0.03)


def test_beside_the_ellipse_every_slice_is_martins(laws, contacts):
    law, (interface, shape, _) = laws["inlet", "outer"], contacts["outer"]
    load = 2e4
    across = interface.hertz.semi_axis_across * load ** (1.0 / 3.0)
    lowest = math.exp(light_film(law, math.log(load), math.log(SPEED))[0]) / martin.FLOW

    def per_length(z):
        gap = lowest + (z * z - across * across) / (2.0 * shape.lateral_radius)
        return martin.ROLLING_AT_GAP * law.viscosity * SPEED * math.sqrt(shape.rolling_radius / gap)

    expected = 2.0 * quad(per_length, across, 0.5 * shape.length)[0]
    assert beside_ellipse(law, math.log(load), math.log(SPEED))[0] == pytest.approx(expected, rel=1e-8)


@pytest.mark.parametrize("name", ["inlet", "whole-film"])
@pytest.mark.parametrize("where", ["inner", "outer", "cage"])
def test_force_rises_with_load_and_speed_and_has_no_step(laws, name, where):
    loads = np.geomspace(0.01, 1e5, 1500)
    forces = np.array([-rolling_resistance(laws[name, where], q, SPEED, SPEED).shear for q in loads])
    assert (np.diff(forces) > 0.0).all()
    assert np.max(np.diff(np.log(forces))) < 0.75 * np.log(loads[1] / loads[0])
    speeds = np.geomspace(0.01, 3.0, 300)
    forces = [-rolling_resistance(laws[name, where], 1e3, u, u).shear for u in speeds]
    assert (np.diff(forces) > 0.0).all()


def test_factors_of_the_inlet(contacts):
    full = prepare_rolling("inlet", *contacts["inner"], heating=False)
    starved = prepare_rolling("inlet", *contacts["inner"], heating=False, inlet_film=10.0)
    beside = beside_ellipse(full, math.log(5e4), math.log(SPEED))[0]
    flooded = -rolling_resistance(full, 5e4, SPEED, SPEED).shear - beside
    less = (
        -rolling_resistance(starved, 5e4, SPEED, SPEED).shear
        - beside_ellipse(starved, math.log(5e4), math.log(SPEED))[0]
    )
    assert less / flooded == pytest.approx(float(starvation_factor(10.0)), rel=0.02)
    # A light contact at a given load is a full one over a part of its length, which carries the whole load.
    light = prepare_rolling("inlet", *contacts["inner"], fullness=0.1)
    part = 0.1 * rolling_resistance(full, 5.0, SPEED, SPEED).shear
    assert rolling_resistance(light, 0.5, SPEED, SPEED).shear == pytest.approx(part, rel=2e-3)
    # The heavy contact does not change, but for the film beside its ellipse.
    heavy = -rolling_resistance(
        prepare_rolling("inlet", *contacts["inner"], heating=False, fullness=0.1), 5e4, SPEED, SPEED
    ).shear
    assert heavy - 0.1 * beside == pytest.approx(flooded, rel=0.02)


def test_base_bearing(laws):
    """Inlets of the ellipses alone: 7 to 13 N a raceway contact; torque of 28 rollers at rated speed."""

    def torque(name, load, beside):
        total = 0.0
        for where in ("inner", "outer"):
            law = laws[name, where]
            force = -rolling_resistance(law, load, SPEED, SPEED).shear
            total += force if beside else force - beside_ellipse(law, math.log(load), math.log(SPEED))[0]
        return 28 * 2.0 * total * SPEED / SHAFT_SPEED

    assert 170.0 < torque("inlet", 2e4, False) < torque("inlet", 3.5e4, False) < 230.0
    assert 225.0 < torque("inlet", 2e4, True) < torque("inlet", 3.5e4, True) < 280.0
    assert 290.0 < torque("whole-film", 2e4, True) < torque("whole-film", 3.5e4, True) < 365.0


def test_none_costs_nothing_and_compiles(contacts):
    law = prepare_rolling("none", *contacts["inner"])
    assert isinstance(law, NoRolling)

    @numba.njit
    def kernel(law):
        return rolling_resistance(law, 1e4, 0.3, 0.3).power

    assert kernel(law) == rolling_resistance(law, 1e4, 0.3, 0.3).power == 0.0
    full = prepare_rolling("whole-film", *contacts["inner"])
    assert kernel(full) == rolling_resistance(full, 1e4, 0.3, 0.3).power > 1.0


def test_unknown_names_and_impossible_inlets_are_refused(contacts):
    with pytest.raises(InputError, match="no rolling law 'some'"):
        prepare_rolling("some", *contacts["inner"])
    with pytest.raises(InputError, match="at the inlet"):
        prepare_rolling("inlet", *contacts["inner"], inlet_film=0.5)
