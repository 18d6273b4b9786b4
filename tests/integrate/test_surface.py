"""Energy on the places of a raceway, against the overlap of intervals by brute force."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from macroslip.compiled import jit
from macroslip.integrate.detail import _spread
from macroslip.integrate.surface import SECTORS, STATIONS, Way, raise_density, sectors_of, spread

WIDTH = 2.0 * math.pi / SECTORS


@jit
def spread_once(surface, interface, way, powers, energy, growth=0.0):
    per_power = energy / np.abs(powers[:STATIONS]).sum()
    spread(surface, interface, sectors_of(way, interface), powers, per_power, growth)


@jit
def raise_once(largest, interface, way, station, density):
    raise_density(largest, interface, sectors_of(way, interface), station, density)


def by_brute_force(start, end, energy):
    """Energy of each sector from a hundred thousand equal pieces of the way."""
    places = start + (end - start) * (np.arange(100_000) + 0.5) / 100_000
    return energy * np.bincount(np.floor(places / WIDTH).astype(int) % SECTORS, minlength=SECTORS) / places.size


@pytest.mark.parametrize("interface", [0, 1])
@pytest.mark.parametrize(
    ("start", "before", "after"),
    [(-1.5, 0.0, 0.03), (0.4, 100.0, 101.3), (3.1, 2.0, -0.4), (0.0, 0.0, 40.0), (1.0, 5.0, 5.0)],
)
def test_energy_lies_where_the_roller_passes(interface, start, before, after):
    powers = np.zeros(STATIONS + 2)
    powers[3], powers[10], powers[STATIONS + 1] = -2.0, 6.0, 1.0
    surface = np.zeros((2, SECTORS, STATIONS, 2, 2))
    ratio, energy = 0.454, 8.0
    spread_once(surface, interface, Way(start, ratio, before, after), powers, energy)
    turning = ratio if interface == 1 else ratio - 1.0
    ends = [start + turning * (before + part * (after - before)) for part in (0.0, 1.0)]
    np.testing.assert_allclose(surface.sum(axis=(0, 2, 3, 4)), by_brute_force(*ends, energy), atol=2e-3)
    assert surface.sum() == pytest.approx(energy, rel=1e-12)
    assert surface[1 - interface].sum() == 0.0
    # A quarter of it where slip is negative, the rest where it is positive, all in the film regime of the powers.
    assert surface[interface, :, 3, 0, 1].sum() == pytest.approx(0.25 * energy)
    assert surface[interface, :, 10, 1, 1].sum() == pytest.approx(0.75 * energy)


@pytest.mark.parametrize("interface", [0, 1])
@pytest.mark.parametrize(("before", "after"), [(0.0, 0.9), (0.9, 0.0), (2.0, 2.3)])
def test_energy_that_grows_along_the_way_lies_where_it_was_spent(interface, before, after):
    powers = np.zeros(STATIONS + 2)
    powers[3] = 1.0
    surface = np.zeros((2, SECTORS, STATIONS, 2, 2))
    start, ratio, energy, growth = 0.3, 0.454, 8.0, 0.7
    spread_once(surface, interface, Way(start, ratio, before, after), powers, energy, growth)
    parts = (np.arange(100_000) + 0.5) / 100_000
    turning = ratio if interface == 1 else ratio - 1.0
    places = start + turning * (before + parts * (after - before))
    weights = energy * (1.0 + growth * (2.0 * parts - 1.0)) / parts.size
    expected = np.bincount(np.floor(places / WIDTH).astype(int) % SECTORS, weights, minlength=SECTORS)
    np.testing.assert_allclose(surface[interface].sum(axis=(1, 2, 3)), expected, atol=2e-3)
    assert surface.sum() == pytest.approx(energy, rel=1e-12)


def test_no_power_takes_no_energy():
    record = SimpleNamespace(
        station_work=np.zeros((2, STATIONS + 3)),
        station_energy=np.zeros((2, STATIONS)),
        surface_energy=np.zeros((2, SECTORS, STATIONS, 2, 2)),
    )
    record.station_work[0, STATIONS] = 5.0
    _spread(record, 0, sectors_of(Way(0.0, 0.45, 0.0, 1.0), 0), 1.0, 0.5)
    assert record.surface_energy.sum() == 0.0 == record.station_energy.sum()
    assert record.station_work[0, STATIONS] == 5.0


def test_density_is_raised_at_every_sector_passed():
    largest = np.zeros((2, SECTORS, STATIONS))
    raise_once(largest, 1, Way(0.5 * WIDTH, 0.5, 0.0, 4.0 * WIDTH), 7, 3.0)
    raise_once(largest, 1, Way(0.5 * WIDTH, 0.5, 0.0, 0.0), 7, 2.0)
    assert largest[1, :, 7].tolist() == [3.0, 3.0, 3.0] + [0.0] * (SECTORS - 3)
    assert largest.sum() == 9.0
