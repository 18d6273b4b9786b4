"""What traces say of the orbit agrees with the integrator's own accounts, and with geometry."""

import numpy as np
import pytest

from macroslip import BearingLoads, Case, HubLoads, InputError, Laws, Traces, Window, simulate
from macroslip.bearing import geometry
from macroslip.result.orbit import (
    AVERAGES,
    SCENE,
    STILL,
    energy_over_orbit,
    in_window,
    load_zone,
    orbit_profile,
    over_orbit,
    position,
    scene,
)
from macroslip.result.run_input import run_input
from tests.variables import check_variables

pytestmark = pytest.mark.slow

SPEED = 2.1


@pytest.fixture(scope="module")
def varying():
    loads = HubLoads.bundled("20A").window(0.0, 40.0)
    # As fine as the milliseconds in which rollers recover.
    return simulate(
        Case(loads=loads, laws=Laws.paper(), rollers=[0, 9, 18], traces=Traces(step=0.002))
    )


@pytest.fixture(scope="module")
def constant():
    loads = BearingLoads.constant([0.0, -300e3, 0.0], SPEED, 20.0)
    return simulate(Case(loads=loads, laws=Laws.paper(), traces=Traces(step=0.02)))


def test_position_is_that_of_a_uniform_orbit(constant):
    ratio = geometry.inner_contact_radius(run_input(constant).bearing) / (
        2 * run_input(constant).bearing.pitch_radius
    )
    turned = np.degrees(SPEED * ratio * constant.time.values)
    angle = position(constant)
    np.testing.assert_allclose(angle.sel(row="downwind", roller=0), turned % 360.0, atol=1e-6)
    pitch = 360.0 / 28
    np.testing.assert_allclose(
        angle.sel(row="upwind", roller=3), (3.5 * pitch + turned) % 360.0, atol=1e-6
    )


@pytest.mark.parametrize("factor", [-1.0, 0.0])
def test_energy_over_the_orbit_is_in_proportion_to_any_power(constant, factor):
    """A file may hold powers that no contact has; its page has them then, and no overflow."""
    energy = energy_over_orbit(constant)
    other = energy_over_orbit(constant.assign(power=factor * constant.power))
    np.testing.assert_allclose(other, factor * energy, rtol=1e-12)


def test_energy_over_the_orbit_adds_up_to_the_integrators_own(varying):
    energy = energy_over_orbit(varying)
    per_orbit = (energy.sum("angle") * 5.0).sum("interface")
    duration = varying.attrs["window_end"] - varying.attrs["window_start"]
    assert energy.attrs["energy_ratio"] == pytest.approx(1.0, rel=5e-3)
    own = varying.energy.sum("interface").mean("roller") / energy.attrs["orbits"]
    np.testing.assert_allclose(per_orbit, own, rtol=1e-2)
    assert energy.attrs["orbits"] == pytest.approx(duration / 6.5, rel=0.05)
    assert (energy >= 0.0).all()


@pytest.mark.parametrize("orbits", [1.05, 1.5, 3.05])
def test_energy_over_the_orbit_is_even_under_thrust_alone(orbits):
    """A sector that is passed once more than another has no more energy of an orbit."""
    bearing = Case(loads=HubLoads.bundled("14B")).bearing
    period = 2.0 * np.pi / (SPEED * geometry.orbit_ratio(bearing))
    loads = BearingLoads.constant([0.0, 0.0, 400e3], SPEED, orbits * period)
    laws = Laws.physical().but(rolling="none")
    options = {"rollers": [0], "gravity": False, "drag": False, "window": Window(start=0.0)}
    case = Case(loads=loads, laws=laws, traces=Traces(step=0.01), **options)
    outer = energy_over_orbit(simulate(case)).sel(row="downwind", interface="outer")
    np.testing.assert_allclose(outer, outer.mean(), rtol=2e-2)


def test_a_gripped_roller_spends_energy_where_its_weight_presses_on_the_cage():
    loads = BearingLoads.constant([0.0, -300e3, 400e3], SPEED, 20.0)
    energy = energy_over_orbit(
        simulate(Case(loads=loads, laws=Laws.paper(), traces=Traces(step=0.02)))
    )
    cage = energy.sel(row="downwind", interface="cage")
    sides, ends = cage.sel(angle=[92.5, 267.5]), cage.sel(angle=[2.5, 177.5])
    assert sides.min() > 8.0 * ends.max()  # sectors of 5 degrees, not points
    # Left and right differ by drag alone, which is small.
    assert float(sides[0]) == pytest.approx(float(sides[1]), rel=0.02)


def test_power_is_force_times_slip(varying):
    radius = geometry.roller_radius(run_input(varying).bearing)
    sample = varying.sel(row="upwind", roller=9).isel(time=3500)
    power = varying.power.sel(row="upwind", roller=9).isel(time=3500)
    assert float(power.sel(interface="inner")) == abs(
        float(sample.traction.sel(interface="inner")) * float(sample.slip)
    )
    assert float(power.sel(interface="cage")) == pytest.approx(
        abs(float(sample.traction.sel(interface="cage")) * float(sample.spin)) * radius
    )


def test_films_are_those_of_the_law(constant):
    sample = constant.isel(time=0).sel(row="downwind", roller=0)
    model = run_input(constant).models["downwind"]
    angle = np.radians(float(position(constant).isel(time=0).sel(row="downwind", roller=0)))
    orbital = float(sample.spin_pure) * model.radius / model.outer_radius
    outward = model.weight_in_plane * np.cos(angle) + model.centrifugal * orbital**2
    outward = outward * model.cos_contact_angle + model.weight_along_axis * model.sin_contact_angle
    load = float(sample.roller_load) + max(outward, 0.0)
    speed = abs(float(sample.spin_pure + sample.spin)) / 2 * model.radius
    thickness = float(model.laws.outer.film_thickness(load, speed))
    assert float(sample.film_thickness.sel(interface="outer")) == pytest.approx(thickness, rel=1e-9)
    orbit = orbit_profile(constant)["orbit"]
    ratio = (orbit.film_parameter / orbit.film_thickness).values
    np.testing.assert_allclose(
        ratio[np.isfinite(ratio)], 1.0 / run_input(constant).bearing.composite_roughness
    )


def test_quantiles_over_the_orbit(varying):
    film, angle = varying.film_thickness, position(varying)
    middle = over_orbit(film, angle, sectors=4)
    here = film.where((angle >= 90.0) & (angle < 180.0))
    expected = here.sel(row="upwind", interface="cage").median()
    assert float(middle.sel(row="upwind", interface="cage", quantile=0.5)[1]) == pytest.approx(
        float(expected)
    )
    wide = middle.sel(interface="cage")
    assert (wide.sel(quantile=0.05) <= wide.sel(quantile=0.95)).all()


def test_load_zone_of_a_constant_load_stands_still_and_is_symmetric(constant):
    zone = load_zone(constant).sel(row="downwind")
    mean = zone.mean("time")
    np.testing.assert_allclose(mean, mean[::-1], rtol=0.05, atol=200.0)
    assert float(mean.sel(angle=2.5)) > 1e4
    assert float(mean.sel(angle=177.5)) == 0.0
    assert zone.max() <= constant.roller_load.max()


def test_scene_is_the_part_with_the_largest_power(varying):
    part = scene(varying, samples=100, step=0.05)
    assert part.sizes["time"] == 100
    assert np.median(np.diff(part.time)) == pytest.approx(0.05)
    power = varying.power.sum("interface").isel(time=slice(None, None, 25))
    largest = in_window(power.to_dataset(name="power").assign_attrs(varying.attrs)).power.max()
    assert float(part.power.max()) == pytest.approx(float(largest), rel=1e-6)
    now = position(varying).sel(time=part.time[-1])
    moved = (part.angle + part.travelled[-1]) % 360.0
    np.testing.assert_allclose(moved, now, atol=1e-6)


def test_a_profile_keeps_no_traces(varying):
    profile = orbit_profile(varying)
    assert "time" not in profile["result"].dims
    for name, table in (
        ("orbit", AVERAGES),
        ("load_zone", AVERAGES),
        ("scene", SCENE),
        ("still", STILL),
    ):
        check_variables(profile[name], table)
    assert profile["scene"].slip.dtype == np.float32
    assert set(profile) == {"result", "orbit", "load_zone", "scene", "still"}


def test_traces_that_begin_late_or_not_at_all_are_refused(varying):
    with pytest.raises(InputError, match="Leave traces.start away"):
        position(varying.isel(time=slice(5, None)))
    with pytest.raises(InputError, match="no traces"):
        position(varying.drop_dims("time"))
    with pytest.raises(InputError, match="does not say what it was computed with"):
        orbit_profile(varying.assign_attrs(input="nothing"))


def test_failed_rollers_are_left_out(varying):
    failed = varying.copy(deep=True)
    failed.status[1, 0] = 3
    for name in ("energy", "traction", "slip", "spin"):
        failed[name][1, 0] = np.nan
    energy = energy_over_orbit(failed)
    assert np.isfinite(energy).all()
    others = varying.isel(roller=[1, 2])
    np.testing.assert_allclose(
        energy.sel(row="upwind"), energy_over_orbit(others).sel(row="upwind"), rtol=1e-5
    )
