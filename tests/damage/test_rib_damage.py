"""Rib damage beside the numbers of an independent program, hand sums and the limits of the film."""

import math

import numpy as np
import pytest

from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.contact.rib import rib_contact, rib_state
from macroslip.damage.rib import STEEL_EFFUSIVITY, pass_energy, rib_flash_temperature
from macroslip.kinds.tapered.ribs import rib_values
from macroslip.lubricant import Lubricant

MAIN = TaperedBearing.read("tdo-main-bearing")
OIL = Lubricant.read("vg460-pao").at(308.15)
SPEED = 12.0 * 2.0 * math.pi / 60.0


def test_pressure_times_speed_is_that_of_an_independent_program():
    """Main bearing, 17.9 kN at 12 r/min: 260 MPa and pv of 7.2 MPa m/s in the mean of the ellipse.

    The mean pressure of Hertz' ellipse is two thirds of the largest.
    """
    values = rib_values(MAIN, OIL, np.full((1, 1, 1), 17.9e3), np.array([SPEED]))
    assert values["rib_pressure"][0, 0] == pytest.approx(260e6, rel=0.01)
    assert values["rib_pressure_speed"][0, 0] * 2.0 / 3.0 == pytest.approx(7.2e6, rel=0.01)
    assert values["rib_sliding_speed"] == pytest.approx(41.71e-3, rel=1e-3)


def test_a_place_suffers_pressure_times_slip_for_as_long_as_it_is_in_the_ellipse():
    """∫ p v dt through the middle of the ellipse is π/4 of the largest pressure all the time."""
    pressure, along, sliding, speed = 2e8, 4e-3, 0.05, 0.3
    time = np.linspace(-along / speed, along / speed, 20001)
    p = pressure * np.sqrt(np.maximum(1.0 - (speed * time / along) ** 2, 0.0))
    integral = np.trapezoid(p * sliding, time)
    assert integral / pass_energy(pressure, along, sliding, speed) == pytest.approx(
        math.pi / 4.0, rel=1e-4
    )


def test_flash_temperature_is_that_of_blok_s_band():
    """1.11 µ w v/[(ε1 √u1 + ε2 √u2) √(2b)], w the load per length of the middle station."""
    load = 2e8 * 4e-3 * math.pi / 2.0
    heat = 0.08 * load * 0.05
    uptake = STEEL_EFFUSIVITY * (math.sqrt(0.3) + math.sqrt(0.2))
    expected = 1.11 * heat / (uptake * math.sqrt(2.0 * 4e-3))
    rise = rib_flash_temperature(2e8, 4e-3, 0.08, 0.05, (0.3, 0.2))
    assert rise == pytest.approx(expected, rel=2e-3)
    assert rib_flash_temperature(0.0, 0.0, 0.0, 0.05, (0.3, 0.2)) == 0.0


def test_work_for_wear_is_what_asperities_press_and_slide_over_both_surfaces():
    """All p v of the contacts, spread over a ring of the rib and a circle of the roller's end.

    Over the width of the contact both get the same power, since they slide on each other.
    """
    bearing = MAIN.replace(rib_oil_supply=0.05)
    row = tapered_geometry(bearing)
    force = np.full((1, 1, bearing.rollers_per_row), 10e3)
    values = rib_values(bearing, OIL, force, np.array([SPEED]))
    rib, roller = values["rib_asperity_work"][0, 0]
    share = values["rib_asperity_share"][0, 0]
    assert 0.3 < share <= 1.0
    rings = rib * 2.0 * math.pi * row.rib_radius
    ends = roller * 2.0 * math.pi * row.rib_radius_on_roller * bearing.rollers_per_row
    assert rings == pytest.approx(ends, rel=1e-9)


def test_less_oil_wears_and_heats_the_ribs():
    supplies = (1.0, 0.3, 0.1, 0.03)
    force = np.full((1, 1, 3), 10e3)
    results = [
        rib_values(MAIN.replace(rib_oil_supply=supply), OIL, force, np.array([SPEED]))
        for supply in supplies
    ]
    for name in ("rib_asperity_share", "rib_friction", "rib_flash_temperature", "rib_power"):
        values = [float(result[name].max()) for result in results]
        assert values == sorted(values), name
    assert results[0]["rib_pass_energy"] == pytest.approx(results[-1]["rib_pass_energy"])


@pytest.mark.parametrize(
    ("temperature", "friction"),
    [(35.0, (0.0007, 0.018)), (50.0, (0.0005, 0.034)), (65.0, (0.0005, 0.055))],
)
def test_friction_full_and_starved_is_near_that_of_an_independent_program(temperature, friction):
    """µ at 12 r/min with the inlet full and a tenth full; boundary friction and shear law differ."""
    oil = Lubricant.read("vg460-pao").at(273.15 + temperature)
    row = tapered_geometry(MAIN)
    for supply, expected in zip((1.0, 0.1), friction, strict=True):
        contact = rib_contact(MAIN.replace(rib_oil_supply=supply), oil)
        state = rib_state(
            contact, 10e3, row.rib_entrainment_speed(SPEED), row.rib_sliding_speed(SPEED)
        )
        assert float(state.friction_coefficient) == pytest.approx(expected, rel=0.5)


def test_an_ellipse_that_is_wider_than_the_rib_contact_is_high_is_cut():
    low = MAIN.replace(rib_contact_height=1e-3)
    force = np.array([[[100.0]], [[200e3]]])
    margin = rib_values(low, OIL, force, np.full(2, SPEED))["rib_ellipse_margin"][:, 0]
    assert margin[0] > 0.0 > margin[1]


def test_friction_of_a_history_is_that_of_every_contact_by_itself():
    """The spline over load and speed against the integral over every ellipse."""
    rng = np.random.default_rng(3)
    force = 20e3 * rng.uniform(0.0, 1.0, (12, 2, 5)) ** 2
    force[:, :, 0] = 0.0
    speed = SPEED * rng.uniform(0.5, 1.1, 12)
    values = rib_values(MAIN, OIL, force, speed)
    row = tapered_geometry(MAIN)
    each = rib_state(
        rib_contact(MAIN, OIL),
        force,
        row.rib_entrainment_speed(speed)[:, None, None],
        row.rib_sliding_speed(speed)[:, None, None],
    )
    assert values["rib_power"] == pytest.approx(each.power.sum(axis=2), rel=1e-4)
    assert values["rib_friction"] == pytest.approx(
        (each.friction_coefficient * force).sum(axis=2) / force.sum(axis=2), rel=1e-4
    )
