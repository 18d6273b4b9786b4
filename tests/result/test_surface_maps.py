"""Maps of the raceways: sums against the energies of the integrator, places against the motion, signs against slip."""

import math

import numpy as np
import pytest

from macroslip import (
    BackwardEuler,
    BearingLoads,
    Case,
    HubLoads,
    InputError,
    Laws,
    Traces,
    simulate,
)
from macroslip.result.surface_maps import energy_density, roller_energy_density, share_above

pytestmark = pytest.mark.slow

SPLIT = ("slip_sign", "film_regime")


@pytest.fixture(scope="module")
def turbulent():
    """Six seconds of the wind, and all rollers."""
    return simulate(Case(loads=HubLoads.bundled("14B").window(0.0, 6.0), laws=Laws.physical()))


@pytest.fixture(scope="module")
def weight():
    """A weight and no thrust, one roller of each row, with the window open from the first sample for two orbits."""
    loads = BearingLoads.constant([0.0, -400e3, 0.0], 2.1, 13.5)
    # The oil between a roller and rings that it has play to is sheared too; here the loaded contacts are looked at.
    laws = Laws.physical().but(rolling="none")
    return simulate(Case(loads=loads, laws=laws, rollers=[0], traces=Traces(step=0.005)))


def test_sums_over_the_maps_are_the_energies(turbulent):
    total = turbulent.surface_energy.sum(("angle", "station", *SPLIT))
    expected = turbulent.energy.sel(interface=["inner", "outer"]).sum("roller").values
    assert (expected > 0.0).all()
    np.testing.assert_allclose(total.transpose("row", "raceway").values, expected, rtol=1e-9)


def test_sums_along_the_roller_are_those_of_the_stations(turbulent):
    along = (
        turbulent.surface_energy.sum(("angle", *SPLIT))
        .transpose("row", "raceway", "station")
        .values
    )
    expected = turbulent.station_energy.sum("roller").transpose("row", "raceway", "station").values
    np.testing.assert_allclose(along, expected, rtol=1e-9, atol=1e-12 * expected.max())


def test_densities_times_areas_are_the_energies(turbulent):
    density = energy_density(turbulent)
    total = (
        (density * turbulent.cell_area).sum(("angle", "station")).transpose("row", "raceway").values
    )
    np.testing.assert_allclose(
        total, turbulent.energy.sel(interface=["inner", "outer"]).sum("roller").values, rtol=1e-9
    )
    bearing = Case(loads=HubLoads.bundled("14B"), laws=Laws.paper()).bearing
    along = roller_energy_density(turbulent, bearing)
    area = math.pi * bearing.roller_diameter * bearing.roller_length / turbulent.sizes["station"]
    computed = (along * area * turbulent.sizes["roller"]).sum(("station", *SPLIT))
    expected = turbulent.energy.sel(interface=["inner", "outer"]).sum(("roller", "interface"))
    np.testing.assert_allclose(computed.values, expected.values, rtol=1e-9)


def test_areas_add_up_to_the_raceway_between_its_edges(turbulent):
    """Each raceway is nearly a zone of a cone; its lateral area is 2π times mean radius times slant length."""
    bearing = Case(loads=HubLoads.bundled("14B"), laws=Laws.paper()).bearing
    total = (turbulent.cell_area.sum("station") * turbulent.sizes["angle"]).values
    cosine = math.cos(bearing.contact_angle)
    radii = np.array(
        [bearing.pitch_radius + sign * 0.5 * bearing.roller_diameter * cosine for sign in (-1, 1)]
    )
    np.testing.assert_allclose(
        total, np.tile(2.0 * math.pi * radii * bearing.roller_length, (2, 1)), rtol=1e-12
    )


def test_the_outer_raceway_suffers_in_the_load_zone(weight):
    """A weight loads the rollers at the bottom."""
    outer = weight.surface_energy.sel(row="downwind", raceway="outer").sum(("station", *SPLIT))
    loaded = outer.where(
        outer.angle % (2 * math.pi) > math.pi, drop=True
    )  # the lower half, 180° to 360°
    assert float(loaded.sum()) > 0.99 * float(outer.sum())
    assert float(outer.angle[outer.argmax("angle")]) == pytest.approx(1.5 * math.pi, abs=0.2)


def test_the_power_over_the_angle_is_that_of_the_traces(weight):
    """Energy by sector from the trapezoid rule over finely sampled traces, placed by the known motion."""
    weights = weight.isel(row=0, roller=0)
    time = weights.time.values
    bearing = Case(loads=HubLoads.bundled("14B"), laws=Laws.paper()).bearing
    inner = bearing.pitch_radius - 0.5 * bearing.roller_diameter * math.cos(bearing.contact_angle)
    ratio = inner / (2.0 * bearing.pitch_radius)
    sectors = weight.sizes["angle"]
    for raceway, turning in (("outer", ratio), ("inner", ratio - 1.0)):
        angle = float(weights.start_angle) + turning * 2.1 * (time - time[0])
        power = weights.power.sel(interface=raceway).values
        inside = time[1:] > weight.attrs["window_start"]
        energy = (0.5 * (power[1:] + power[:-1]) * np.diff(time))[inside]
        sector = (
            np.floor(0.5 * (angle[1:] + angle[:-1]) / (2 * math.pi) * sectors).astype(int) % sectors
        )[inside]
        expected = np.bincount(sector, weights=energy, minlength=sectors)
        computed = (
            weight.surface_energy.isel(row=0).sel(raceway=raceway).sum(("station", *SPLIT)).values
        )
        # A step is spread evenly by stages, so neighbouring sectors may exchange a little.
        reached = np.abs(np.cumsum(computed) - np.cumsum(expected)).max()
        assert reached < 0.02 * expected.sum()
        assert computed.sum() == pytest.approx(expected.sum(), rel=5e-3)


def test_the_sign_of_slip_follows_the_contour(weight):
    """Where a gripped roller touches in an arc, the middle slips one way and the ends the other."""
    by_sign = weight.surface_energy.isel(row=0).sum(("angle", "film_regime"))
    for raceway in ("inner", "outer"):
        energy = by_sign.sel(raceway=raceway)
        share = energy.sel(slip_sign="positive") / energy.sum("slip_sign")
        share = share.where(
            energy.sum("slip_sign") > 1e-3 * energy.sum("slip_sign").max(), drop=True
        )
        middle, ends = (
            float(share.sel(station=0.0, method="nearest")),
            share.isel(station=[0, -1]).values,
        )
        assert abs(middle - ends.mean()) > 0.5


def test_film_regimes_follow_the_films(weight):
    """No film below the roughness in the traces, no energy below; and the other way round."""
    film = weight.film_thickness.sel(interface=["inner", "outer"])
    ratio = (
        film / Case(loads=HubLoads.bundled("14B"), laws=Laws.paper()).bearing.composite_roughness
    )
    energy = weight.surface_energy.sum(("row", "raceway", "angle", "station", "slip_sign"))
    assert float(ratio.min()) > 1.0
    assert float(energy.sel(film_regime="below 1")) == 0.0
    assert float(energy.sel(film_regime="1 and above")) > 0.0


def test_the_largest_power_per_area_is_that_of_the_orbits():
    loads = HubLoads.bundled("14B").window(0.0, 16.0)
    result = simulate(Case(loads=loads, laws=Laws.physical(), rollers=[0]))
    largest = (
        result.surface_power_density.max(("angle", "station")).transpose("row", "raceway").values
    )
    expected = (
        result.power_density.sel(interface=["inner", "outer"]).max(("roller", "orbit")).values
    )
    assert result.sizes["orbit"] >= 1
    # The maps take the time before the first and after the last whole orbit too.
    assert (largest >= expected * (1.0 - 1e-12)).all() and (expected > 0.0).all()


def test_thresholds_are_the_users(turbulent):
    density = turbulent.surface_power_density
    assert (share_above(density, turbulent.cell_area, 0.0) > 0.0).all()
    assert float(share_above(density, turbulent.cell_area, float(density.max())).max()) == 0.0
    half = float(density.sel(row="downwind", raceway="inner").median())
    share = share_above(density, turbulent.cell_area, half).sel(row="downwind", raceway="inner")
    assert float(share) == pytest.approx(0.5, abs=0.05)


def test_fixed_steps_fill_the_maps_too():
    loads = BearingLoads.constant([0.0, -400e3, 0.0], 2.1, 0.3)
    case = Case(loads=loads, laws=Laws.physical(), rollers=[0], integrator=BackwardEuler(step=1e-3))
    result = simulate(case)
    total = (
        result.surface_energy.sum(("angle", "station", *SPLIT)).transpose("row", "raceway").values
    )
    np.testing.assert_allclose(
        total, result.energy.sel(interface=["inner", "outer"]).sum("roller").values, rtol=1e-9
    )


def test_results_without_microslip_have_no_maps():
    result = simulate(
        Case(
            loads=BearingLoads.constant([0.0, -4e5, 0.0], 0.0, 1.0), laws=Laws.paper(), rollers=[0]
        )
    )
    with pytest.raises(InputError, match="no maps of the raceways.*model: physical"):
        energy_density(result)
