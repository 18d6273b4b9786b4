"""Cases of tapered roller bearings: slip over preload, torque, results, pages, and what is refused."""

import math

import numpy as np
import pytest

from macroslip import BearingLoads, Case, HubLoads, InputError, Laws, Lubricant, simulate
from macroslip.bearing.kinds import read_bearing
from macroslip.bearing.tapered import tapered_geometry
from macroslip.case.parts import Traces, Window
from macroslip.constants import YEAR
from macroslip.contact.rib import rib_contact
from macroslip.kinds.tapered.of_case import tapered_ring_motion
from macroslip.loads import Drivetrain
from macroslip.report.answer import answer
from macroslip.report.result_numbers import row_numbers
from macroslip.result.damage import damage
from macroslip.result.plausibility import doubtful_result
from macroslip.result.rating import with_rating
from macroslip.result.variables import VARIABLES
from macroslip.ring.tapered import tapered_balance, tapered_ring
from macroslip.whole.cage import Cage
from tests.quick import COARSE
from tests.variables import check_variables

MAIN = read_bearing("tdo-main-bearing")
OIL = Lubricant.read("vg460-pao")
SPEED = 12.0 * 2.0 * math.pi / 60.0
ALONE = Drivetrain(mount="alone", tilt=0.0)
L0 = ((50e3, -1300e3, 700e3), (0.0, 0.0))
L1 = (L0[0], (-700e3, 200e3))
L2 = ((0.0, -300e3, 300e3), (0.0, 0.0))
#: Orbit of a roller [s].
ORBIT = 2.0 * math.pi / (tapered_geometry(MAIN).orbit_ratio * SPEED)


def case(force=L0[0], duration=1.6 * ORBIT, preload=0.2e-3, **values):
    loads = BearingLoads.constant(force, SPEED, duration, step=0.2)
    defaults = {
        "bearing": MAIN.replace(preload=preload),
        "lubricant": OIL,
        "temperature": 308.15,
        "loads": loads,
        "drivetrain": ALONE,
        "rollers": [0],
        "oil_supply": 0.7,
        "window": Window(start=0.5 * ORBIT),
        "integrator": COARSE,
    }
    return Case(**defaults | values)


@pytest.mark.parametrize(
    ("arrangement", "load", "preload"),
    [
        ("O", L0, 0.263),
        ("O", L1, 0.328),
        ("O", L2, 0.154),
        ("X", L0, 0.262),
        ("X", L1, 0.481),
        ("X", L2, 0.154),
    ],
)
def test_least_preload_for_grip_of_all_rollers(arrangement, load, preload):
    """An independent program's preloads from which on every roller carries 16.5 kN."""
    bearing = MAIN.replace(preload=1e-3 * preload, arrangement=arrangement)
    force, moment = (np.array([part], dtype=float) for part in load)
    ring = tapered_ring(bearing)
    angles = np.linspace(0.0, 2.0 * math.pi / 34 / ring.orbit_ratio, 9)
    least = min(
        float(tapered_balance(ring, np.array([angle]), force, moment).outer_load.min())
        for angle in angles
    )
    assert least / 1e3 == pytest.approx(16.5, abs=0.7)


@pytest.mark.slow
def test_idle_rollers_slip_and_preloaded_ones_do_not():
    """Below grip a roller slows down between its load zones; above it every roller keeps rolling."""
    by_preload = {preload: simulate(case(preload=preload)) for preload in (0.0, 0.3e-3)}
    assert all((result.status == 0).all() for result in by_preload.values())
    slipping = by_preload[0.0].min_spin_ratio.sel(row="upwind").item()
    assert slipping < 0.9
    assert (by_preload[0.3e-3].min_spin_ratio > 0.99).all()
    below = {
        preload: result.rollers_below_grip.sel(row="upwind").item()
        for preload, result in by_preload.items()
    }
    assert below[0.0] == pytest.approx(24.0, abs=1.5)
    assert below[0.3e-3] == 0.0
    # One load zone an orbit in the row that the thrust unloads; entries and maps know it.
    for preload, entries in ((0.0, 1.0), (0.3e-3, 0.0)):
        result = by_preload[preload]
        assert result.sizes["orbit"] == 1
        assert (result.entries.sel(row="upwind") == entries).all()
        mapped = result.surface_energy.sum(("angle", "station", "slip_sign", "film_regime"))
        spent = result.energy.sel(interface=["inner", "outer"]).sum("roller")
        assert mapped.values == pytest.approx(spent.values, rel=1e-6)
    assert float(damage(by_preload[0.0]).sel(criterion="entry_slide_roll_ratio").value) > 0.05
    assert float(damage(by_preload[0.3e-3]).sel(criterion="wear_time").value) > 20.0
    (sentence,) = [line for line in answer(by_preload[0.3e-3]) if "preload" in line]
    assert "With 0.3 mm of preload, 0 downwind and 0 upwind of 34 rollers are in the" in sentence
    # Preload loads rollers of a light load far more than its equivalent load says.
    for force, is_said in ((L0[0], False), (L2[0], True)):
        rated = with_rating(by_preload[0.3e-3], case(force=force, preload=0.3e-3))
        said = " ".join(doubtful_result(rated))
        assert ("know neither the preload" in said) == is_said
    numbers = row_numbers(by_preload[0.3e-3])[0]
    assert numbers["rib"] == float(by_preload[0.3e-3].rib_energy.sel(row="downwind")[0])


@pytest.mark.slow
def test_wear_of_the_rib_is_that_of_its_asperities_energy():
    """Thrust alone: all rollers alike, and a rib whose film is a tenth of a full one.

    Steps give the energy of asperities, µ_b X F v_f of a roller. Over the width 2b of the ellipse
    and the circumference of the rib it wears 3/(πb) times as deep in the middle as in the mean,
    F = 2π/3 a b p0, and Z rollers pass.
    """
    result = simulate(
        case(force=(0.0, 0.0, 700e3), bearing=MAIN.replace(rib_oil_supply=0.1), gravity=False)
    )
    bearing = read_bearing("tdo-main-bearing")
    row = tapered_geometry(bearing)
    span = result.attrs["window_end"] - result.attrs["window_start"]
    contact = rib_contact(bearing, OIL.at(308.15))
    for name in ("downwind", "upwind"):
        of_row = result.sel(row=name)
        pressed = OIL.boundary_friction * span
        work = float(of_row.rib_asperity_energy.mean()) / pressed
        half_width = contact.hertz.semi_axis_across * float(of_row.largest_rib_force) ** (1 / 3)
        expected = 34 * 3.0 * work / (math.pi * half_width * 2.0 * math.pi * row.rib_radius)
        rib_work = float(of_row.rib_asperity_work.sel(rib_surface="rib"))
        assert rib_work == pytest.approx(expected, rel=0.01)
    criteria = damage(result)
    faster = float(result.rib_asperity_work.max())
    years = float(criteria.sel(criterion="rib_wear_time").value)
    assert years == pytest.approx(1e-5 / (1e-17 * faster) / YEAR)
    smearing = float(criteria.sel(criterion="rib_pressure_speed").value)
    assert smearing == pytest.approx(
        float(result.rib_pressure.max()) * float(row.rib_sliding_speed(SPEED)), rel=1e-6
    )


@pytest.mark.slow
def test_energy_of_a_turn_is_torque_times_angle():
    """The shaft's work on a roller over an orbit, with the cage's part, is what contacts dissipate."""
    laws = Laws.paper()
    made = case(
        preload=0.35e-3,
        laws=laws,
        oil_supply=None,
        gravity=False,
        drag=False,
        traces=Traces(step=0.01),
        window=Window(start=0.5 * ORBIT, end=1.5 * ORBIT),
    )
    result = simulate(made)
    row = tapered_geometry(MAIN)
    turn = result.isel(roller=0).sel(time=slice(0.5 * ORBIT, 1.5 * ORBIT))
    traction = turn.traction
    orbit = row.orbit_ratio * SPEED
    shaft = -SPEED * (
        traction.sel(interface="inner") * row.inner_radius + turn.rib_friction * row.rib_radius
    )
    cage = orbit * (
        turn.cage_force * row.pitch_radius
        + traction.sel(interface="cage") * row.roller_radius * math.cos(row.axis_angle)
    )
    work = (shaft + cage).integrate("time")
    dissipated = (turn.power.sum("interface") + turn.rib_power).integrate("time")
    assert work.values == pytest.approx(dissipated.values, rel=1e-3)
    energy = result.energy.sum("interface") + result.rib_energy
    span = result.attrs["window_end"] - result.attrs["window_start"]
    mean = dissipated / (float(turn.time[-1]) - float(turn.time[0]))
    assert energy.isel(roller=0).values / span == pytest.approx(mean.values, rel=0.02)


@pytest.mark.slow
def test_rib_variables_and_preload_of_a_result():
    warm = simulate(case(temperature_difference=10.0, traces=Traces(step=0.1)))
    check_variables(warm, VARIABLES)
    assert float(warm.preload_change) == pytest.approx(0.151e-3, rel=0.01)
    assert float(warm.preload) == pytest.approx(0.351e-3, rel=0.01)
    share = tapered_geometry(MAIN).rib_share
    history = tapered_ring_motion(case(temperature_difference=10.0))
    largest = history.balance.rib_force.reshape(len(history.motion.time), 2, -1).max(axis=(0, 2))
    assert warm.largest_rib_force.values == pytest.approx(largest, rel=1e-6)
    assert history.balance.rib_force == pytest.approx(share * history.balance.outer_load, rel=1e-5)
    assert (warm.rib_energy > 0.0).all()
    assert (warm.rib_peak_power >= 0.0).all()
    power = warm.rib_power.sel(time=slice(0.5 * ORBIT, None)).max("time")
    assert (power <= 1.001 * warm.rib_peak_power.max("orbit")).all()
    # By hand: a load of the balance in the trace of the solver.
    first_roller = history.balance.outer_load[:, 0]
    traced = warm.roller_load.isel(row=0, roller=0)
    expected = np.interp(traced.time, history.motion.time, first_roller)
    assert traced.values == pytest.approx(expected, rel=2e-3)


def test_a_gearbox_takes_a_part_of_the_moment():
    hub = HubLoads.constant([200e3, 0.0, -300e3], [0.0, 200e3, 50e3], SPEED, 1.0)
    alone, beside = (
        tapered_ring_motion(case(loads=hub, drivetrain=drivetrain, window=Window()))
        for drivetrain in (ALONE, Drivetrain(gearbox_stiffness=1e9, tilt=0.0))
    )
    assert beside.balance.outer_load.max() < alone.balance.outer_load.max()
    tilt = (
        np.hypot(*alone.balance.displacement[0, 3:]),
        np.hypot(*beside.balance.displacement[0, 3:]),
    )
    assert tilt[1] < tilt[0]


SPHERICAL = read_bearing("skf-240-600-bc")
HUB = HubLoads.constant([200e3, 0.0, -300e3], [0.0, 0.0, 0.0], SPEED, 20.0)


@pytest.mark.parametrize(
    ("values", "part"),
    [
        ({"dynamics": "whole-bearing"}, "free orbits"),
        ({"laws": Laws(**{"microslip": True, "skew": "quasi-static"})}, "skew is computed"),
        ({"laws": Laws(traction="kellstroem")}, "elliptical contact"),
        ({"temperature": "balance"}, "balance of heat"),
        ({"loads": HUB, "drivetrain": Drivetrain()}, "stiffness of its support"),
        (
            {
                "loads": HUB,
                "drivetrain": Drivetrain(
                    mount="four-point", front_to_rear=2.0, locating="front", bearing="front"
                ),
            },
            "share moments by their stiffness",
        ),
        ({"bearing": SPHERICAL, "temperature_difference": 5.0}, "clearance"),
        ({"bearing": SPHERICAL, "loads": HUB}, "carries no moment"),
    ],
)
def test_refused_in_a_sentence(values, part):
    with pytest.raises(InputError, match=part):
        case(**values)


def test_a_drivetrain_serves_both_kinds_of_bearing():
    """Beside a bearing without moments the gearbox's support is determinate, whatever its stiffness."""
    forces = [
        case(bearing=SPHERICAL, loads=HUB, drivetrain=drivetrain).ring_loads.force
        for drivetrain in (Drivetrain(), Drivetrain(gearbox_stiffness=1e8))
    ]
    np.testing.assert_array_equal(*forces)
    case(loads=HUB, drivetrain=Drivetrain(gearbox_stiffness=1e8))


def test_loads_beyond_all_steel_are_refused():
    with pytest.raises(InputError, match="pressure above 4 GPa"):
        tapered_ring_motion(case(force=(0.0, -60e6, 0.0)))


def test_cage_of_a_whole_bearing_is_refused():
    with pytest.raises(InputError, match="do not use it.*do not have. Remove the cage."):
        case(cage=Cage(mass=60.0))
