"""Friction of a tapered roller's rib: kinematics, its laws, the spin, and the power of a turn."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from macroslip import Laws, Lubricant
from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.compiled import jit
from macroslip.contact.rib import rib_contact, rib_state
from macroslip.contact.strips import PreparedStrips, ellipse_load, strip_approach
from macroslip.contact.table import table_box
from macroslip.mechanics.spin import CONDITIONS, powers
from macroslip.roller.model import roller_model, with_tables
from macroslip.roller.step import STEP, write_stage
from tests.one_roller import forces_of

MAIN = TaperedBearing.read("tdo-main-bearing")
OIL = Lubricant.read("vg460-pao").at(308.15)
ROW = tapered_geometry(MAIN)
SHAFT = 1.2566
RING_SPEED = -float(ROW.surface_speed(SHAFT))
LAWS = Laws.paper()


@pytest.fixture(scope="module")
def made():
    model = roller_model(MAIN, OIL, 1, tilt=0.0, gravity=False, drag=False, laws=LAWS)
    box = table_box(np.array([RING_SPEED, 0.9 * RING_SPEED]), 3e5, 2e-4)
    rollers, report = with_tables({"downwind": model}, box)
    assert report.typical_error < 1e-4
    return model, rollers["downwind"]


def test_numbers_of_the_rib(made):
    rib = made[0].rib
    assert (rib.arm, rib.pull) == pytest.approx((0.904, 1.065), abs=6e-4)
    assert 0.073 < rib.share < 0.0765


def test_the_rib_slides_in_pure_rolling_by_the_turning_rate_times_its_height(made):
    rib = made[0].rib
    sliding = rib.speed * RING_SPEED - rib.arm * RING_SPEED
    assert sliding == pytest.approx(-float(ROW.rib_sliding_speed(SHAFT)), rel=1e-10)
    assert -sliding == pytest.approx(41.71e-3, rel=1e-3)


@pytest.mark.parametrize("load", [2e4, 5e4, 2e5])
def test_friction_and_power_in_pure_rolling_are_those_of_the_contact(made, load):
    """By hand: µ F_f v_f with the film's own coefficient of friction."""
    model, roller = made
    forces = forces_of(roller, station(load), 0.0)
    pressed = model.rib.share * load
    sliding = float(ROW.rib_sliding_speed(SHAFT))
    entrainment = float(ROW.rib_entrainment_speed(SHAFT))
    bare = rib_contact(MAIN, OIL)._replace(roughness=1e-12)
    state = rib_state(bare, pressed, entrainment, sliding, LAWS)
    friction = float(state.friction_coefficient) * pressed
    assert -float(forces["rib"]) == pytest.approx(friction, rel=2e-3)
    assert float(forces["rib_power"]) == pytest.approx(friction * sliding, rel=2e-3)
    assert float(forces["rib_rough"]) == 0.0


def test_slope_of_all_forces_by_slip(made):
    """The rib's is in it, which a roller far below grip feels as much as its raceways' films."""
    _, roller = made
    at = station(300.0)
    step = 1e-6
    for slip in (-0.004, -0.01, -0.1):
        low, high = (net_force(forces_of(roller, at, slip + change)) for change in (-step, step))
        slope = float(forces_of(roller, at, slip)["slope"])
        assert slope == pytest.approx((high - low) / (2.0 * step), rel=1e-3)


def station(load):
    at = np.zeros(1, CONDITIONS)
    at["ring_speed"] = RING_SPEED
    at["approach"] = 1e-5
    for name in ("elastic_load", "inner_load", "outer_load"):
        at[name] = load
    for name in ("inner", "outer"):
        at[f"log_{name}_load"] = math.log(load)
        at[f"root_{name}_load"] = load ** (1.0 / 3.0)
    return at[0]


def net_force(forces):
    return float(sum(forces[name] for name in ("inner", "outer", "cage", "resistance")))


def held_slip(roller, at):
    """Slip at which nothing changes the spin, by Newton's method."""
    slip = 0.0
    for _ in range(50):
        forces = forces_of(roller, at, slip)
        slip -= net_force(forces) / float(forces["slope"])
    return slip, forces_of(roller, at, slip)


@jit
def write(row, body, at, forces, slip, power):
    write_stage(row, 0, body, at, forces, slip, power)


def step_at(roller, at):
    """A step's stage of a roller at rest in its spin, and its frictional powers."""
    slip, forces = held_slip(roller, at)
    power = np.zeros(3)
    powers(roller.body[0], at, forces, slip, power)
    row = np.zeros(1, STEP)
    write(row[0], roller.body[0], at, forces, slip, power)
    return row[0], power


def newtonian_slope(load):
    """dF/dΔu of the two raceways' isothermal Newtonian films by SciPy's quadrature, Barus' law."""
    total = 0.0
    laws = roller_model(MAIN, OIL, 1, tilt=0.0, laws=LAWS).laws
    for law in (laws.inner, laws.outer):
        strips = law.strips
        approach = float(strip_approach(strips, load))

        def along(station, law=law, strips=strips, approach=approach):
            drop = float(strips.profile(station))
            per_length = strips.coefficient * max(approach - drop, 1e-15) ** (10 / 9)
            ellipse = np.array(ellipse_load(law.interface.hertz, per_length))
            film = float(super(PreparedStrips, law).film_thickness(ellipse, abs(RING_SPEED)))
            pressure = math.sqrt(per_length * strips.curvature * strips.modulus / (2.0 * math.pi))
            width = math.sqrt(8.0 * per_length / (math.pi * strips.modulus * strips.curvature))
            chord = quad(
                lambda t: math.exp(OIL.pressure_viscosity * pressure * math.cos(t)) * math.cos(t),
                0.0,
                0.5 * math.pi,
            )[0]
            return 2.0 * width * OIL.viscosity * chord / film

        end = float(strips.reach(approach)) * (1.0 - 1e-9)
        total += quad(along, -end, end, limit=200)[0]
    return total


@pytest.mark.parametrize("load", [5e3, 2e4])
def test_a_gripped_roller_slips_by_the_closed_form_of_a_newtonian_contact(made, load):
    """Δu = −e F_f/(dF_i/dΔu + dF_o/dΔu): the rib's friction over the stiffness of both films."""
    model, roller = made
    slip, forces = held_slip(roller, station(load))
    expected = -model.rib.arm * float(forces["rib"]) / newtonian_slope(load)
    assert slip == pytest.approx(expected, rel=5e-3)


def test_grip_passes_the_ribs_friction_to_the_cone(made):
    """F_i = −(e + g)/2 F_f and F_o = (g − e)/2 F_f where no other force acts."""
    model, roller = made
    row, _ = step_at(roller, station(6e4))
    inner, outer, cage = row["force"][0]
    rib = float(row["rib_force"][0])
    assert abs(cage) < 1e-4 * abs(rib)
    e, g = model.rib.arm, model.rib.pull
    assert inner == pytest.approx(-(e + g) / 2.0 * rib, rel=2e-3)
    assert outer == pytest.approx((g - e) / 2.0 * rib, rel=2e-2)
    # The cage has nothing to do with it.
    assert abs(float(row["cage_load"][0])) < 1e-3 * abs(rib)


def test_power_of_a_turn_is_torque_times_angle(made):
    """What the shaft does on a roller is what raceways and rib dissipate, but for the cage's part."""
    _, roller = made
    row, power = step_at(roller, station(3e4))
    inner, _, cage = row["force"][0]
    rib = float(row["rib_force"][0])
    push = float(row["cage_load"][0])
    orbit = ROW.orbit_ratio * SHAFT
    shaft = -SHAFT * (inner * ROW.inner_radius + rib * ROW.rib_radius)
    pocket = orbit * (push * ROW.pitch_radius + cage * ROW.roller_radius * math.cos(ROW.axis_angle))
    dissipated = power.sum() + float(row["rib_power"][0])
    assert shaft + pocket == pytest.approx(dissipated, rel=1e-6)
    assert shaft == pytest.approx(dissipated, rel=1e-2)
