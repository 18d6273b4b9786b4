"""Mean friction power of a bearing from the energies of the rollers that were simulated."""

import pytest
import xarray as xr

from macroslip.result.heat_balance import bearing_friction_power


def result_of(**ribs) -> xr.Dataset:
    """Two rows of one simulated roller each, of 34, over 10 s."""
    energy = xr.DataArray(
        [[[3.0, 2.0, 1.0]], [[6.0, 4.0, 2.0]]], dims=("row", "roller", "interface")
    )
    values = {"energy": energy, "rolling_energy": 10.0 * energy}
    values["status"] = xr.zeros_like(energy.isel(interface=0, drop=True))
    attrs = {"window_start": 5.0, "window_end": 15.0, "rollers_per_row": 34, "drag_power": 7.0}
    return xr.Dataset(values | ribs, attrs=attrs)


def test_sliding_and_rolling_of_all_rollers_and_drag():
    """(18 + 180) J of two rollers in 10 s, 34 times, and 7 W."""
    assert bearing_friction_power(result_of()) == pytest.approx(34 * 19.8 + 7.0)


def test_ribs_of_a_tapered_bearing_are_part_of_it():
    ribs = xr.DataArray([[20.0], [30.0]], dims=("row", "roller"))
    power = bearing_friction_power(result_of(rib_energy=ribs))
    assert power == pytest.approx(34 * (19.8 + 5.0) + 7.0)
