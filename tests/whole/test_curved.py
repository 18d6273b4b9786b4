"""Curved contacts in the whole bearing: what they leave behind adds up, and the books close with them."""

from __future__ import annotations

import numpy as np
import pytest

from macroslip import BearingLoads, Case, Laws, simulate
from tests.whole.conftest import losses_of_closed_books

pytestmark = pytest.mark.slow

#: Two orbits under weight and thrust, so that one row is loaded all round and the other hardly.
LOADS = BearingLoads.constant([0.0, -300e3, 100e3], 2.143, 14.0)


@pytest.fixture(scope="module")
def result():
    return simulate(Case(loads=LOADS, laws=Laws.physical(), dynamics="whole-bearing"))


def test_it_runs_to_the_end(result):
    assert (result.status == 0).all()
    assert (result.end_time == 14.0).all()
    assert result.sizes["orbit"] == 1
    for name in (
        "energy",
        "rolling_energy",
        "orbit_energy",
        "peak_power",
        "mechanism_energy",
        "station_energy",
    ):
        assert np.isfinite(result[name]).all()


def test_mechanisms_stations_and_maps_add_up_to_the_energies(result):
    raceways = (
        result.energy.sel(interface=["inner", "outer"])
        .transpose("row", "roller", "interface")
        .values
    )
    mechanisms = result.mechanism_energy.sum("mechanism").transpose(*result.energy.dims)
    np.testing.assert_allclose(mechanisms.values, result.energy.values, rtol=1e-12)
    stations = result.station_energy.sum("station").transpose("row", "roller", "raceway")
    np.testing.assert_allclose(stations.values, raceways, rtol=1e-9)
    maps = result.surface_energy.sum(("angle", "station", "slip_sign", "film_regime")).transpose(
        "row", "raceway"
    )
    np.testing.assert_allclose(maps.values, raceways.sum(axis=1), rtol=1e-9)


def test_every_mechanism_and_the_asperities_dissipate(result):
    """In the loaded row; the other one's rollers slide as a whole."""
    loaded = result.mechanism_energy.sel(row="downwind", interface=["inner", "outer"]).sum("roller")
    assert (loaded > 0.0).all()
    assert (loaded.sel(mechanism="sliding") < loaded.drop_sel(mechanism="sliding")).all()
    idle = result.mechanism_energy.sel(row="upwind", interface=["inner", "outer"]).sum("roller")
    assert (idle.sel(mechanism="sliding") > 0.99 * idle.sum("mechanism")).all()
    raceways = result.energy.sel(interface=["inner", "outer"])
    rough = result.asperity_energy.sel(interface=["inner", "outer"])
    assert (rough >= 0.0).all() and (rough < raceways).all() and float(rough.sum()) > 0.0


def test_books_close(result):
    """The couple that keeps rollers from skewing is an outside one: its power is no part of the books."""
    lost = losses_of_closed_books(result)
    spent = (result.energy + result.rolling_energy).sum(("row", "roller"))
    skew = result.mechanism_energy.sel(mechanism="contact angle").sum(("row", "roller"))
    booked = (spent - skew).sel(interface=["inner", "outer"]).sum()
    assert float(booked) == pytest.approx(lost["raceway_loss"], rel=1e-6)
    assert float(spent.sel(interface="cage")) == pytest.approx(lost["friction_loss"], rel=1e-6)


def test_extremes_have_the_size_of_their_contacts(result):
    raceways = {"interface": ["inner", "outer"]}
    # A cage's spar is at rest past its roller, so slip is twice the entrainment speed.
    np.testing.assert_allclose(result.slide_roll_ratio.sel(interface="cage").values, 2.0, rtol=1e-9)
    ratio = result.slide_roll_ratio.sel(raceways)
    assert (ratio.sel(row="downwind") < 1.0).all()
    # Slip of the middle makes this ratio; looks miss the slowest instant, by 1e-4 of it here.
    spin = result.min_spin_ratio.sel(row="upwind")
    assert (ratio.sel(row="upwind") > 0.999 * 2.0 * (1.0 - spin) / (1.0 + spin)).all() and (
        ratio < 2.0
    ).all()
    assert (result.flash_temperature > 0.0).all() and (result.flash_temperature < 50.0).all()
    assert (result.min_film_ratio > 0.0).all()
    assert (result.quadrature_error < 0.01).all()
