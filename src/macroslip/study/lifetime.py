"""From the runs of a study to a lifetime: means of each bin, weighted by how likely it is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.errors import InputError
from macroslip.study.weights import YEAR, Binning, Weights, binned

if TYPE_CHECKING:
    import xarray as xr


def lifetime_energy(
    study: xr.Dataset,
    weights: Weights,
    *,
    years: float = 20.0,
    field: str = "wind_speed",
    width: float = 2.0,
    by: Sequence[str] = (),
) -> xr.Dataset:
    """Frictional energy of a roller over a lifetime, mean over the rollers of a row.

        E = T Σ_b p_b P_b,    P_b = (1/N_b) Σ_{c in b} E_c / t_c

    with the lifetime T, the probability p_b of bin b, the energy E_c (`energy_mean`) of its N_b runs and the length t_c
    of their windows. Time outside the bins of the study contributes nothing; `covered` is the share of all time in the
    bins.

    Parameters
    ----------
    study : xarray.Dataset
        From `open_study`.
    weights : Weibull or Given
    years : float
        T [years of 365.25 days], above 0.
    field, width, by
        As in `macroslip.study.weights.binned`.

    Returns
    -------
    xarray.Dataset
        Over (group, row): `lifetime_energy` [J], NaN where a bin has no run. Over (group, bin, row): `power`
        [W], `bin_energy` [J], the bin's part of the sum. Over (group, bin): `runs`, those that were used, and `left_out`,
        those that failed or are missing. Over bin: `probability`; and `covered`, their sum.

    Raises
    ------
    InputError
        If a label, a probability or the lifetime is wrong.

    Examples
    --------
    One bin that is always there, at 3 W for 20 years:

    >>> import xarray as xr
    >>> from macroslip.study.weights import Given
    >>> one = {name: ("case", ["-"]) for name in ("bearing", "lubricant", "model")}
    >>> study = xr.Dataset({"energy_mean": (("case", "row"), [[1800.0, 1800.0]]), "window_length": ("case", [600.0])},
    ...                    one | {"wind_speed": ("case", [12.0], {"units": "m/s"}), "row": ["downwind", "upwind"]})
    >>> found = lifetime_energy(study, Given({12.0: 1.0}))
    >>> f"{float(found.lifetime_energy[0, 0]):.4g} J"
    '1.893e+09 J'
    """
    import xarray as xr

    if not (math.isfinite(years) and years > 0.0):
        raise InputError(f"the lifetime is {years!r} years", allowed="a number above 0")
    bins = binned(study, field, width, by)
    probability = bins.probabilities(weights)
    rate = study.energy_mean.transpose("case", "row").values / study.window_length.values[:, None]
    power, used, left_out = _bin_means(bins, rate)
    with np.errstate(invalid="ignore"):
        # A bin of no weight needs no run.
        parts = np.where(probability[:, None] > 0.0, years * YEAR * probability[:, None] * power, 0.0)
    return xr.Dataset(
        {
            "lifetime_energy": (("group", "row"), parts.sum(axis=1), _about(
                "J", f"energy dissipated by a roller in {years:g} years, mean over the rollers of the row")),
            "bin_energy": (("group", "bin", "row"), parts, _about("J", "part of the bin in it")),
            "power": (("group", "bin", "row"), power, _about("W", "energy of a roller per time, mean over runs")),
            "runs": (("group", "bin"), used, _about("1", "runs of the means")),
            "left_out": (("group", "bin"), left_out, _about("1", "runs without a result for all rollers")),
            "probability": ("bin", probability, _about("1", "share of time in the bin")),
            "covered": ((), probability.sum(), _about("1", "share of time in all bins")),
        },
        bins.coordinates(study) | {"row": study.row},
        {"title": f"Lifetime energy: {study.attrs.get('title', '')}", "years": years},
    )  # fmt: skip


def percentiles(
    study: xr.Dataset,
    *,
    quantiles: Sequence[float] = (0.05, 0.5, 0.95),
    field: str = "wind_speed",
    width: float = 2.0,
    by: Sequence[str] = (),
) -> xr.Dataset:
    """Spread of the runs in each bin, which differ in their seeds.

    Parameters
    ----------
    study : xarray.Dataset
        From `open_study`.
    quantiles : sequence of float
        From 0 to 1.
    field, width, by
        As in `macroslip.study.weights.binned`.

    Returns
    -------
    xarray.Dataset
        Over (group, bin, row, quantile), linear between runs (`numpy.quantile`): `power` [W], energy of a roller per
        time, `orbit_energy_mean` [J], `peak_power_mean` and `peak_power_max` [W], `lowest_spin_ratio` [1]; and `runs`,
        over (group, bin). Runs without a value are left out.

    Raises
    ------
    InputError
        If a label or a quantile is wrong.
    """
    import xarray as xr

    if not quantiles or not all(0.0 <= quantile <= 1.0 for quantile in quantiles):
        raise InputError(f"the quantiles are {list(quantiles)!r}", allowed="numbers from 0 to 1")
    bins = binned(study, field, width, by)
    rate = study.energy_mean / study.window_length
    names = ("orbit_energy_mean", "peak_power_mean", "peak_power_max", "lowest_spin_ratio")
    wanted = {"power": (rate, _about("W", "energy dissipated by a roller per time"))}
    wanted |= {name: (study[name], dict(study[name].attrs)) for name in names}
    data: dict[str, Any] = {}
    for name, (values, about) in wanted.items():
        values = values.transpose("case", "row").values
        runs = bins.by_cell(np.where(np.isfinite(values), values, np.nan))
        found = np.stack([bins.as_array(runs.quantile(quantile)) for quantile in quantiles], axis=-1)
        data[name] = (("group", "bin", "row", "quantile"), found, about)
    _, used, _ = _bin_means(bins, rate.transpose("case", "row").values)
    data["runs"] = (("group", "bin"), used, _about("1", "runs of the quantiles"))
    coordinates = {"row": study.row, "quantile": ("quantile", list(quantiles), _about("1", "share of runs below"))}
    title = {"title": f"Percentiles over runs: {study.attrs.get('title', '')}"}
    return xr.Dataset(data, bins.coordinates(study) | coordinates, title)


def worst(
    study: xr.Dataset, variable: str = "peak_power_max", *, count: int = 10, smallest: bool = False
) -> xr.Dataset:
    """The runs and rows with the largest values of a variable of the summary.

    Parameters
    ----------
    study : xarray.Dataset
        From `open_study`.
    variable : str
        Any variable over case and row.
    count : int
        How many, above 0.
    smallest : bool
        The smallest ones instead, as for `lowest_spin_ratio`.

    Returns
    -------
    xarray.Dataset
        The variables of the summary and all labels, over `rank` from 1; `row` is a coordinate of it. Runs without a
        value are left out.

    Raises
    ------
    InputError
        If there is no such variable.
    """
    import pandas as pd
    import xarray as xr

    names = [name for name, one in study.data_vars.items() if set(one.dims) == {"case", "row"}]
    if variable not in names:
        raise InputError(f"the summary has no variable '{variable}'", allowed=", ".join(map(str, names)))
    if count < 1:
        raise InputError(f"the count is {count}", allowed="a whole number above 0")
    summary = study[[name for name, one in study.data_vars.items() if set(one.dims) <= {"case", "row"}]]
    summary = summary.drop_vars(
        [name for name in study.coords if not set(study[name].dims) <= {"case", "row"}], errors="ignore"
    )
    values = study[variable].transpose("case", "row").values
    finite = pd.Series(values.ravel())[np.isfinite(values.ravel())]
    order = (finite.nsmallest(count) if smallest else finite.nlargest(count)).index.to_numpy()
    cases, rows = np.unravel_index(order, values.shape)
    found = summary.isel(case=xr.DataArray(cases, dims="rank"), row=xr.DataArray(rows, dims="rank"))
    return found.assign_coords(rank=("rank", np.arange(1, order.size + 1), _about("1", f"rank by {variable}")))


def _bin_means(bins: Binning, values: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mean of values (runs, k) in each cell over runs that have all k, their number, and that of the others."""
    whole = np.asarray(np.isfinite(values).all(axis=1))
    used = bins.as_array(bins.by_cell(whole).sum(), 0.0)
    left_out = bins.as_array(bins.by_cell(~whole).sum(), 0.0)
    means = bins.as_array(bins.by_cell(np.where(whole[:, None], values, np.nan)).mean())
    return means, used[..., 0], left_out[..., 0]


def _about(units: str, long_name: str) -> dict[str, str]:
    return {"units": units, "long_name": long_name}
