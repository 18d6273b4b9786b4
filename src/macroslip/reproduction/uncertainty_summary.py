"""What the sample over uncertain values says: ranges of the results, what drives them, and how often trends hold."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.wording import three_digits
from macroslip.reproduction.sobol import sobol_indices
from macroslip.reproduction.statement import ABOUT, Statement
from macroslip.reproduction.uncertain_values import VALUES
from macroslip.reproduction.verdicts import DOMINANT

if TYPE_CHECKING:
    import xarray as xr

#: Quantiles that are given.
QUANTILES = (0.05, 0.5, 0.95)
#: Probability below which a rank correlation is taken to name a driver. With 23 values and ten quantities a smaller one
#: than usual: about one of them in four samples is found by chance.
DRIVER_LEVEL = 0.001
#: Part of the variance from which on a Sobol' index is shown.
TOLD_INDEX = 0.05


def quantities(sample: xr.Dataset) -> xr.Dataset:
    """The results whose uncertainty is given, over (sample, quantity).

    Parameters
    ----------
    sample : xarray.Dataset
        From `uncertainty`.

    Returns
    -------
    xarray.Dataset
        `result` over (sample, quantity), with the coordinate `units`; NaN where a sample did not complete.
    """
    import xarray as xr

    energy = sample.orbit_energy.sum("interface", skipna=False)
    down, up = (energy.sel(row=row) for row in ("downwind", "upwind"))
    peak = sample.peak_power.sel(row="downwind") / sample.peak_power.sel(row="upwind")
    inner = sample.orbit_energy.sel(row="downwind", interface="inner") / down
    names = sample.case.values.tolist()
    first, last = names[0], names[-1]
    found: dict[str, tuple[xr.DataArray, str]] = {}
    for name in (first, last):
        found[f"energy per orbit, downwind, {name}"] = down.sel(case=name), "J"
    window = sample.window_energy
    found[f"energy in {first} / {last}"] = window.sel(case=first) / window.sel(case=last), "1"
    for name in names:
        found[f"energy, downwind / upwind, {name}"] = (down / up).sel(case=name), "1"
    found[f"share of the inner raceway, downwind, {first}"] = inner.sel(case=first), "1"
    for name in names:
        found[f"mean P_max, downwind / upwind, {name}"] = peak.sel(case=name), "1"
    found[f"sliding torque, {first}"] = sample.torque.sel(case=first), "N m"
    power = sample.friction_power
    found[f"friction power of the bearing, {first}"] = power.sel(case=first), "W"
    found[f"friction power in {first} / {last}"] = power.sel(case=first) / power.sel(case=last), "1"
    values = np.stack([one.values for one, _ in found.values()], axis=1)
    return xr.Dataset(
        {"result": (("sample", "quantity"), values, {"units": "1", "long_name": "result, in its quantity's unit"})},
        {"sample": sample.sample, "quantity": list(found), "units": ("quantity", [one for _, one in found.values()])},
    )


def uncertainty_summary(sample: xr.Dataset) -> xr.Dataset:
    """Ranges and rank correlations over the samples that completed.

    Parameters
    ----------
    sample : xarray.Dataset
        From `uncertainty`.

    Returns
    -------
    xarray.Dataset
        base [unit of the quantity] over quantity; range over (quantity, quantile); over (quantity, parameter):
        rank_correlation and probability [1] (Spearman), first_order and total_order [1], Sobol' indices of the quantity's
        logarithm; explained [1] over quantity, the part of its variance that the polynomial behind them foretells of
        samples it has not seen. trend_share [1] over trend: how many of the completed samples show it, and trend_base
        whether the base values do. Attributes: completed, failed, refused: numbers of samples. `case` has the load cases of the samples.
    """
    import xarray as xr
    from scipy.stats import spearmanr

    found = quantities(sample)
    good = (sample.outcome == 0) & (sample.sample > 0)
    result, values = found.result.values[good], sample.value.values[good]
    ranks = np.full((found.sizes["quantity"], values.shape[1]), np.nan)
    chance = ranks.copy()
    if len(result) > 2:
        for q in range(ranks.shape[0]):
            for p in range(ranks.shape[1]):
                # What does not change has no rank.
                if np.ptp(result[:, q]) > 0.0 and np.ptp(values[:, p]) > 0.0:
                    ranks[q, p], chance[q, p] = spearmanr(values[:, p], result[:, q])
    first_order, total_order, explained = _indices(result, values)
    trends = {name: flags.values for name, flags in _trends(sample).items()}
    shares = [float(flags[good].mean()) if good.any() else np.nan for flags in trends.values()]
    quantile = np.quantile(result, QUANTILES, axis=0).T if len(result) else np.full((ranks.shape[0], 3), np.nan)

    def of(outcome: int) -> int:
        return int(((sample.outcome == outcome) & (sample.sample > 0)).sum())

    return xr.Dataset(
        {
            "base": ("quantity", found.result.values[0], {"units": "1", "long_name": "with the base values"}),
            "range": (("quantity", "quantile"), quantile, {"units": "1", "long_name": "quantiles over the samples"}),
            "rank_correlation": (
                ("quantity", "parameter"),
                ranks,
                {"units": "1", "long_name": "Spearman's rank correlation"},
            ),
            "probability": (
                ("quantity", "parameter"),
                chance,
                {"units": "1", "long_name": "of such a rank correlation by chance"},
            ),
            "first_order": (
                ("quantity", "parameter"),
                first_order,
                {"units": "1", "long_name": "Sobol' index of first order, of the logarithm"},
            ),
            "total_order": (
                ("quantity", "parameter"),
                total_order,
                {"units": "1", "long_name": "total Sobol' index, of the logarithm"},
            ),
            "explained": (
                "quantity",
                explained,
                {"units": "1", "long_name": "part of the variance that the polynomial behind the indices foretells"},
            ),
            "trend_share": ("trend", shares, {"units": "1", "long_name": "share of the samples that show the trend"}),
            "trend_base": (
                "trend",
                [int(flags[0]) for flags in trends.values()],
                {"units": "1", "long_name": "whether the base values show it"},
            ),
        },
        {
            "quantity": found.quantity,
            "units": found.units,
            "quantile": list(QUANTILES),
            "trend": list(trends),
            "parameter": sample.parameter,
            "case": sample.case.values,
        },
        {"completed": of(0), "failed": of(1), "refused": of(2)},
    )


def _indices(result: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Sobol' indices over (quantity, parameter), first and total, and what is explained; NaN for too few samples."""
    shape = result.shape[1], values.shape[1]
    first, total, known = np.full(shape, np.nan), np.full(shape, np.nan), np.full(shape[0], np.nan)
    if len(result) <= values.shape[1]:
        return first, total, known
    places = np.stack([one.place(values[:, k]) for k, one in enumerate(VALUES)], axis=1)
    for q in range(shape[0]):
        if (result[:, q] > 0.0).all() and np.ptp(result[:, q]) > 0.0:
            first[q], total[q], known[q] = sobol_indices(places, np.log(result[:, q]))
    return first, total, known


def _trends(sample: xr.Dataset) -> dict[str, xr.DataArray]:
    """Whether each sample shows what the paper states, as far as three cases can."""
    names = sample.case.values.tolist()
    first = names[0]
    energy = sample.orbit_energy.sum("interface", skipna=False)
    ratio = energy.sel(row="downwind") / energy.sel(row="upwind")
    peak = sample.peak_power.sel(row="downwind") / sample.peak_power.sel(row="upwind")
    cage = sample.orbit_energy.sel(interface="cage").sum("row") / energy.sum("row")
    down = sample.orbit_energy.sel(row="downwind")
    below = down.sel(interface="cage") / down.sum("interface", skipna=False)
    others, cases, window, power = names[1:], ", ".join(names), sample.window_energy, sample.friction_power

    def about(values: xr.DataArray, stated: float) -> xr.DataArray:
        return ((values >= stated / ABOUT) & (values <= stated * ABOUT)).any("case")

    return {
        f"energy highest in {first} of {cases}": (window.sel(case=first) > window.sel(case=others)).all("case"),
        "downwind row spends more than the upwind row, every case": (ratio > 1.0).all("case"),
        "energy ratio within a factor of 2 of 10, any case": about(ratio, 10.0),
        f"ratio of peak powers highest in {first}": (peak.sel(case=first) > peak.sel(case=others)).all("case"),
        f"ratio of peak powers falls from case to case of {cases}": (peak.diff("case") < 0.0).all("case"),
        "ratio of peak powers within a factor of 2 of 5, any case": about(peak, 5.0),
        "cage takes at least half of the energy of both rows, any case": (cage >= DOMINANT).any("case"),
        "raceways take at least half of the downwind row's energy, every case": (below < DOMINANT).all("case"),
        f"friction power of the bearing highest in {first}": (power.sel(case=first) > power.sel(case=others)).all(
            "case"
        ),
    }


def robust(summary: xr.Dataset) -> list[tuple[str, str]]:
    """Every trend with the word for it: robust, where all samples show it; robustly not, where none does; or not robust."""
    shares = zip(summary.trend.values.tolist(), summary.trend_share.values.tolist(), strict=True)
    return [(name, {1.0: "robust", 0.0: "robustly not so"}.get(share, "not robust")) for name, share in shares]


def strongest(summary: xr.Dataset, quantity: str) -> list[tuple[str, float, float]]:
    """Parameters with a total Sobol' index worth telling, the largest first: name, first order, total."""
    one = summary.sel(quantity=quantity)
    order = np.argsort(-np.nan_to_num(one.total_order.values))
    return [
        (str(one.parameter.values[k]), float(one.first_order.values[k]), float(one.total_order.values[k]))
        for k in order
        if one.total_order.values[k] >= TOLD_INDEX
    ]


def drivers(summary: xr.Dataset, quantity: str) -> list[tuple[str, float]]:
    """Parameters whose rank correlation with a quantity is no chance, the strongest first, with its value."""
    one = summary.sel(quantity=quantity)
    order = np.argsort(-np.abs(one.rank_correlation.values))
    return [
        (str(one.parameter.values[k]), float(one.rank_correlation.values[k]))
        for k in order
        if one.probability.values[k] < DRIVER_LEVEL
    ]


def sample_size(summary: xr.Dataset) -> str:
    """How many samples there are and what became of them, in words."""
    completed, failed, refused = (summary.attrs[name] for name in ("completed", "failed", "refused"))
    return f"{completed} of {completed + failed + refused} samples completed, {failed} failed, {refused} were refused"


def with_uncertainty(statements: Mapping[str, Statement], summary: xr.Dataset) -> dict[str, Statement]:
    """The statements on energy and peak power over wind speed and between rows, with what the sample says of them.

    Parameters
    ----------
    statements : mapping of str to Statement
        By subject, as `macroslip.reproduction.model_run.statements` has them.
    summary : xarray.Dataset
        From `uncertainty_summary`.
    """
    shares = dict(zip(summary.trend.values.tolist(), summary.trend_share.values.tolist(), strict=True))

    words_of = dict(robust(summary))

    def held(trend: str) -> str:
        return f"{100.0 * next(share for name, share in shares.items() if name.startswith(trend)):.0f} %"

    def sure(trend: str) -> str:
        return next(word for name, word in words_of.items() if name.startswith(trend))

    def reach(quantity: str) -> str:
        rows = [k for k, name in enumerate(summary.quantity.values.tolist()) if name.startswith(quantity)]
        ends = summary.range.isel(quantity=rows)
        low, high = float(ends.isel(quantile=0).min()), float(ends.isel(quantile=-1).max())
        return f"{three_digits(low)} to {three_digits(high)}"

    words = {
        "energy": f"with the estimated values anywhere in their ranges, {held('energy highest')} of the samples agree on the "
        f"lowest wind speed ({sure('energy highest')})",
        "rows": f"{reach('energy, downwind / upwind')} times with the estimated values anywhere in their ranges",
        "peak ratio": f"{reach('mean P_max, downwind / upwind')} times with the estimated values anywhere in their ranges, most "
        f"at the lowest wind speed in {held('ratio of peak powers highest')} of the samples "
        f"({sure('ratio of peak powers highest')})",
    }
    return {
        subject: replace(one, found=f"{one.found}; {words[subject]}") if subject in words else one
        for subject, one in statements.items()
    }
