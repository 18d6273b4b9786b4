"""From the study's table to the numbers of the paper's figures 4 and 5."""

from __future__ import annotations

from typing import TYPE_CHECKING

from macroslip.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

#: Cases to which the paper refers energy (figure 4) and peak power (figure 5).
ENERGY_REFERENCE, PEAK_REFERENCE = "12C", "14A"


def paper_numbers(study: xr.Dataset) -> xr.Dataset:
    """Row values, their normalised forms and the ratios between rows.

    A row's energy is the mean over its rollers of E_in + E_out + E_cage (34); the spread over rollers is given with it.
    P_max is the largest power (33) at any interface in an orbit; mean and standard deviation (of the whole population)
    are over all (roller, orbit) samples of a row. A row is normalised by its own value in the reference case.

    Parameters
    ----------
    study : xarray.Dataset
        From `paper_study`.

    Returns
    -------
    xarray.Dataset
        Variables over (case, row) or (case); NaN wherever a roller failed.

    Raises
    ------
    InputError
        If the study lacks a reference case.
    """
    missing = {ENERGY_REFERENCE, PEAK_REFERENCE} - set(study.case.values.tolist())
    if missing:
        raise InputError(
            f"the study lacks {', '.join(sorted(missing))}",
            allowed=f"a study with the reference cases {ENERGY_REFERENCE} and {PEAK_REFERENCE}",
        )
    numbers = study[["peak_power_mean", "peak_power_std", "peak_power_max", "orbit_energy"]].drop_vars(
        ["roller", "interface", "start_angle"], errors="ignore"
    )
    numbers.attrs = {}

    def put(name: str, values: xr.DataArray, units: str, long_name: str) -> None:
        numbers[name] = values
        numbers[name].attrs = {"units": units, "long_name": long_name}

    total = study.energy.sum("interface", skipna=False)
    put("energy", total.mean("roller", skipna=False), "J", "energy in the window, mean over the rollers of the row")
    put("energy_std", total.std("roller", skipna=False), "J", "standard deviation of energy over the rollers")
    put("energy_min", total.min("roller", skipna=False), "J", "smallest energy of a roller")
    put("energy_max", total.max("roller", skipna=False), "J", "largest energy of a roller")
    by_interface = study.energy.mean("roller", skipna=False)
    put("energy_by_interface", by_interface, "J", "energy at each interface, mean over the rollers of the row")
    reference = numbers.energy.sel(case=ENERGY_REFERENCE, drop=True)
    for name in ("energy", "energy_min", "energy_max"):
        long_name = f"{numbers[name].long_name}, over the row's energy in case {ENERGY_REFERENCE}"
        put(f"{name}_normalised", numbers[name] / reference, "1", long_name)
    both = numbers.energy.sum("row", skipna=False)
    put("both_rows", both, "J", "energy of a mean downwind and a mean upwind roller together")
    both_long_name = f"energy of both rows over that in case {ENERGY_REFERENCE}"
    put("both_rows_normalised", both / both.sel(case=ENERGY_REFERENCE, drop=True), "1", both_long_name)
    put("energy_ratio", _between_rows(numbers.energy), "1", "energy of the downwind over the upwind row")
    reference = numbers.peak_power_mean.sel(case=PEAK_REFERENCE, drop=True)
    for name in ("peak_power_mean", "peak_power_std"):
        long_name = f"{numbers[name].long_name}, over the row's mean in case {PEAK_REFERENCE}"
        put(f"{name}_normalised", numbers[name] / reference, "1", long_name)
    ratio = _between_rows(numbers.peak_power_mean)
    put("peak_power_ratio", ratio, "1", "mean P_max of the downwind over the upwind row")
    return numbers


def _between_rows(values: xr.DataArray) -> xr.DataArray:
    return values.sel(row="downwind", drop=True) / values.sel(row="upwind", drop=True)
