"""Lifetime energies of a study: means of each bin, weighted by its probability."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from macroslip.constants import YEAR
from macroslip.errors import InputError
from macroslip.result.surface_maps import even_energy
from macroslip.result.variables import VARIABLES
from macroslip.study.aggregation import Aggregation
from macroslip.study.labels import of_runs_and_rows
from macroslip.study.summary import ROW_VARIABLES
from macroslip.study.weights import binned, weighted
from macroslip.study.year import YEAR_VARIABLES, year
from macroslip.variables import ALWAYS, Variable, VariableTable, described

#: Variables over the places of the raceways in a result.
_PLACES = VARIABLES["surface_power_density"].dims


_CELLS = ("group", "bin")
#: All variables of `lifetime_energy`.
LIFETIME = VariableTable(
    "Lifetime energy, `macroslip.study.lifetime.lifetime_energy`",
    (
        Variable(
            "lifetime_energy",
            ("group", "row"),
            "J",
            ALWAYS,
            "energy dissipated by a roller in the lifetime, mean over the rollers of the row",
        ),
        Variable("bin_energy", (*_CELLS, "row"), "J", ALWAYS, "part of the bin"),
        Variable(
            "power", (*_CELLS, "row"), "W", ALWAYS, "energy of a roller per time, mean over runs"
        ),
        Variable("probability", ("bin",), "1", ALWAYS, "share of time in the bin"),
        *(YEAR_VARIABLES[name] for name in ("runs", "left_out", "covered")),
    ),
)
_QUANTILES = (*_CELLS, "row", "quantile")
#: Numbers of the summary whose spread over the runs of a bin is taken.
_SPREAD = ("orbit_energy_mean", "peak_power_mean", "peak_power_max", "lowest_spin_ratio")
#: All variables of `percentiles`.
PERCENTILES = VariableTable(
    "Percentiles over runs, `macroslip.study.lifetime.percentiles`",
    (
        Variable("power", _QUANTILES, "W", ALWAYS, "energy dissipated by a roller per time"),
        *(ROW_VARIABLES[name]._replace(dims=_QUANTILES) for name in _SPREAD),
        Variable("runs", _CELLS, "1", ALWAYS, "runs of the quantiles"),
    ),
)
#: All variables of `weighted_maps`.
LIFETIME_MAPS = VariableTable(
    "Maps of the raceways over the lifetime, `macroslip.study.lifetime.weighted_maps`",
    (
        Variable(
            "surface_energy",
            ("group", *VARIABLES["surface_energy"].dims),
            "J",
            ALWAYS,
            "energy at each place of a raceway in the lifetime",
        ),
        VARIABLES["surface_power_density"]._replace(dims=("group", *_PLACES), when=ALWAYS),
    ),
)


def lifetime_energy(study: xr.Dataset, aggregation: Aggregation) -> xr.Dataset:
    """Frictional energy of a roller over a lifetime, mean over the rollers of a row.

        E = T Σ_b p_b P_b,    P_b = (1/N_b) Σ_{c in b} E_c / t_c

    with the lifetime T, the probability p_b of bin b, the energy E_c (`energy_mean`) of its N_b
    runs and the length t_c of their windows. An event is a bin of its own, whose p_b is the share
    of time that its rate gives it, and wind speeds share the rest. Time outside the bins
    contributes nothing; `covered` is the share of all time in the bins. Raises InputError if a
    label or a probability is wrong.

    Over (group, row) there is `lifetime_energy` [J], NaN where a bin has no run; over (group, bin,
    row) `power` [W] and `bin_energy` [J], the bin's part of the sum; over (group, bin) `runs`,
    those that were used, and `left_out`, those that failed or are missing; over bin `probability`;
    and `covered`, their sum.

    Examples
    --------
    One bin that is always there, at 3 W for 20 years:

    >>> from macroslip.study.weights import BinProbabilities
    >>> labels = {name: ("case", ["-"]) for name in ("bearing", "lubricant", "model")}
    >>> labels["wind_speed"] = ("case", [12.0], {"units": "m/s"})
    >>> summary = {"energy_mean": (("case", "row"), [[1800.0]]), "window_length": ("case", [600.0])}
    >>> study = xr.Dataset(summary, labels | {"row": ["downwind"]})
    >>> life = lifetime_energy(study, Aggregation(BinProbabilities({12.0: 1.0}), years=20.0))
    >>> f"{float(life.lifetime_energy[0, 0]):.4g} J"
    '1.893e+09 J'
    """
    years = aggregation.years
    of_year = year(study, aggregation)
    values = {
        "lifetime_energy": years * of_year.total.values,
        "bin_energy": years * of_year.energy.values,
        "power": of_year.per_hour.values / 3600.0,
        "probability": of_year.hours.values * 3600.0 / YEAR,
        **{name: of_year[name].values for name in ("runs", "left_out", "covered")},
    }
    title = f"Lifetime energy: {study.attrs.get('title', '')}"
    attributes = of_year.attrs | {"title": title, "years": years}
    return xr.Dataset(LIFETIME.put(values), of_year.coords, attributes)


def percentiles(
    study: xr.Dataset,
    aggregation: Aggregation = Aggregation(),
    quantiles: Sequence[float] = (0.05, 0.5, 0.95),
) -> xr.Dataset:
    """Spread of the runs in each bin, which differ in their seeds.

    Over (group, bin, row, quantile), linear between runs (`numpy.quantile`): `power` [W], energy of
    a roller per time, `orbit_energy_mean` [J], `peak_power_mean` and `peak_power_max` [W],
    `lowest_spin_ratio` [1]; and `runs`, over (group, bin). Runs without a value are left out.
    Quantiles are from 0 to 1; weights and lifetime have no effect. Raises InputError if a label or
    a quantile is wrong.
    """
    if not quantiles or not all(0.0 <= quantile <= 1.0 for quantile in quantiles):
        raise InputError(f"the quantiles are {list(quantiles)!r}", allowed="numbers from 0 to 1")
    bins = binned(study, aggregation.field, aggregation.width, aggregation.by)
    power = (study.energy_mean / study.window_length).transpose("case", "row")
    wanted = {"power": power} | {name: study[name].transpose("case", "row") for name in _SPREAD}
    shape = len(bins.groups), bins.centres.size, study.sizes["row"]
    count = shape[-1]
    group_of_value = np.repeat(bins.group, count)
    bin_of_value = np.repeat(bins.bin, count)
    row_of_value = np.tile(np.arange(count), study.sizes["case"])
    values_of_runs = {}
    for name, variable in wanted.items():
        values_of_runs[name] = ("run", variable.values.ravel())
    frame = xr.Dataset(values_of_runs).to_dataframe()
    by_cell = frame.groupby([group_of_value, bin_of_value, row_of_value])
    table = by_cell.quantile(list(quantiles))
    # A cell without runs has no line.
    every = [*map(range, shape), list(quantiles)]
    every_cell = dict(zip(_QUANTILES, every, strict=True))
    known = table.rename_axis(index=_QUANTILES).to_xarray()
    array = known.reindex(every_cell).transpose(*_QUANTILES)
    values = {name: array[name].values for name in wanted}
    _, values["runs"], _ = bins.means(power.values)
    coordinates = {
        "row": study.row,
        "quantile": ("quantile", list(quantiles), described("1", "share of runs below")),
    }
    title = {"title": f"Percentiles over runs: {study.attrs.get('title', '')}"}
    return xr.Dataset(PERCENTILES.put(values), bins.coordinates(study) | coordinates, title)


def worst(
    study: xr.Dataset, variable: str = "peak_power_max", *, count: int = 10, smallest: bool = False
) -> xr.Dataset:
    """The runs and rows with the largest values of a variable of the summary.

    Parameters
    ----------
    study : xarray.Dataset
        From `macroslip.study.reader.open_study`.
    variable : str
        Any variable over case and row.
    count : int
        How many, above 0.
    smallest : bool
        Whether to take the smallest values instead, as for `lowest_spin_ratio`.

    Returns
    -------
    xarray.Dataset
        Variables of the summary and all labels over `rank` from 1, with `row` as a coordinate of
        it. Runs without a value are left out.

    Raises
    ------
    InputError
        If there is no such variable.
    """
    names = [
        name
        for name, candidate in study.data_vars.items()
        if set(candidate.dims) == {"case", "row"}
    ]
    if variable not in names:
        raise InputError(
            f"the summary has no variable '{variable}'", allowed=", ".join(map(str, names))
        )
    if count < 1:
        raise InputError(f"the count is {count}", allowed="a whole number above 0")
    summary = of_runs_and_rows(study)
    values = study[variable].transpose("case", "row").values
    finite = np.flatnonzero(np.isfinite(values))
    sign = 1 if smallest else -1
    ranked = np.argsort(sign * values.ravel()[finite], kind="stable")
    order = finite[ranked][:count]
    cases, rows = np.unravel_index(order, values.shape)
    case_of_rank = xr.DataArray(cases, dims="rank")
    row_of_rank = xr.DataArray(rows, dims="rank")
    selected = summary.isel(case=case_of_rank, row=row_of_rank)
    ranks = np.arange(1, order.size + 1)
    about = described("1", f"rank by {variable}")
    return selected.assign_coords(rank=("rank", ranks, about))


def weighted_maps(study: xr.Dataset, aggregation: Aggregation) -> xr.Dataset:
    """Maps of frictional energy of the raceways over a lifetime, and the largest power per area.

    As `lifetime_energy`, at every place and for every sign of slip and film regime, as if all
    sectors of a raceway had been passed equally often. Raises InputError if a label or a
    probability is wrong, or the study has no maps.

    `surface_energy` [J] and `surface_power_density` [W/m²] are over group and their dimensions in a
    result, beside `cell_area` [m²]. Energies are NaN where a bin of some weight has no complete
    run. In which place the inner ring is when a case begins is by chance, so its map is spread
    evenly over the angle.
    """
    kept = ("surface_energy", "surface_passes", "surface_power_density")
    if not all(name in study for name in kept):
        raise InputError(
            "the study has no maps of the raceways",
            allowed=f"cases with microslip or asperities that keep {', '.join(kept)}",
            remedy="Write laws: {model: physical} and contact_details: true in the case, and leave keep out or add all "
            "three to it.",
        )
    years = aggregation.years
    bins = aggregation.bins(study)
    dims = VARIABLES["surface_energy"].dims
    places = [study.sizes[dim] for dim in _PLACES]
    largest = np.zeros((len(bins.groups), *places))

    def rates() -> Any:
        for case, group in enumerate(bins.group):
            result = study.isel(case=case)
            energy = even_energy(result).transpose(*dims).values
            if np.isfinite(energy).all():
                density = result.surface_power_density.transpose(*_PLACES).values
                largest[group] = np.maximum(largest[group], density)
            yield energy / float(result.window_length)

    mean_rates, _, _ = bins.means(rates())
    share = bins.probabilities(aggregation.weights)
    energies = years * YEAR * weighted(mean_rates, share)
    inner = study.raceway.values.tolist().index("inner")
    at_inner = energies[:, :, inner]
    energies[:, :, inner] = at_inner.mean(axis=2, keepdims=True)
    density_at_inner = largest[:, :, inner]
    largest[:, :, inner] = density_at_inner.max(axis=2, keepdims=True)
    values = {"surface_energy": energies, "surface_power_density": largest}
    return xr.Dataset(
        LIFETIME_MAPS.put(values),
        bins.coordinates(study, bins=False)
        | {name: study[name] for name in dims}
        | {"cell_area": _area(study)},
        {"title": f"Maps of the raceways: {study.attrs.get('title', '')}", "years": years},
    )


def _area(study: xr.Dataset) -> xr.DataArray:
    """Areas of the cells of a map, which all bearings of the study have to share."""
    area = study.cell_area
    if "case" not in area.dims:
        return area
    values = area.values
    other_axes = tuple(range(1, values.ndim))
    is_known = np.isfinite(values).all(axis=other_axes)
    known = np.flatnonzero(is_known)
    of_known = values[known]
    if not known.size or np.ptp(of_known, axis=0).max() > 1e-12 * of_known.max():
        remedy = "Select the cases of one bearing first: study.isel(case=study.bearing == 'name')."
        raise InputError("the bearings of the study have raceways of different size", remedy=remedy)
    return area.isel(case=int(known[0]), drop=True)
