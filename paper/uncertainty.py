"""The study under values drawn from their ranges: how far results spread, what drives them, and how often trends hold."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from macroslip import open_study
from macroslip.study.database import Outcome
from macroslip.study.effects import rank_correlations
from paper.studies import between_rows, put
from paper.values import VALUES, sample_places
from paper.verdicts import ABOUT, DOMINANT

OUTCOMES = ("completed", "failed", "refused")  # meaning of the variable `outcome`
QUANTILES = (0.05, 0.5, 0.95)  # quantiles that are given
#: Probability below which a rank correlation is taken to name a driver. With 24 values and eleven quantities a smaller
DRIVER_LEVEL = 0.001  # one than usual: about one of them in four samples is found by chance
TOLD_INDEX = 0.05  # part of the variance from which on a Sobol' index is shown


def uncertainty(directory: Path) -> xr.Dataset:
    """The results of a study that runs a sample of values under several loads; its first point has the base values.

    Returns
    -------
    xarray.Dataset
        Over (sample, case, row, interface): orbit_energy [J]; over (sample, case, row): peak_power [W]; over (sample, case):
        window_energy [J], torque [N m] and friction_power [W]; over (sample): outcome, the position in `OUTCOMES`, and its
        reason. What did not complete is NaN. Sample 0 are the base values, which are no part of the statistics.
    """
    study = open_study(directory)
    names = list(dict.fromkeys(study.loads.values.tolist()))
    stored = np.array([Outcome(outcome).stored for outcome in study.outcome.values])
    failed = study.failed_rollers.fillna(0.0).sum("row").values > 0
    # All loads have the same points in the same order.
    parts = [np.flatnonzero(study.loads.values == name) for name in names]
    refused = np.any([~stored[part] for part in parts], axis=0)
    outcomes = np.where(refused, 2, np.any([failed[part] for part in parts], axis=0)).astype(
        np.int8
    )
    reasons = [
        " ".join(filter(None, words))
        for words in zip(*(study.reason.values[part] for part in parts), strict=True)
    ]

    def gathered(name: str) -> xr.DataArray:
        """A variable over (sample, case, ...); NaN for samples that did not complete."""
        of_cases = [
            study[name]
            .isel(case=part)
            .reset_coords(drop=True)
            .drop_vars("case")
            .rename(case="sample")
            for part in parts
        ]
        of_cases = xr.concat(of_cases, xr.DataArray(names, dims="case", name="case"))
        return of_cases.where(xr.DataArray(outcomes == 0, dims="sample"))

    interfaces = xr.DataArray(["inner", "outer", "cage"], dims="interface", name="interface")
    sample = xr.Dataset(
        {
            "orbit_energy": xr.concat(
                [gathered(f"orbit_energy_{name}") for name in interfaces.values], interfaces
            ),
            "peak_power": gathered("peak_power_mean"),
            "window_energy": gathered("energy_mean").sum("row", skipna=False),
            "torque": gathered("contact_torque"),
            "friction_power": gathered("friction_power"),
            "outcome": ("sample", outcomes),
            "reason": ("sample", reasons),
        },
        {"sample": np.arange(len(outcomes))},
    )
    return sample.transpose("sample", "case", "row", "interface")


_PARTS = 10  # parts into which the sample is divided to measure the error of the fit
_MOST_TERMS = 0.25  # most terms of a fit, as a part of the number of samples


@dataclass(frozen=True, slots=True, eq=False)
class Polynomial:
    """A sum of products of Legendre polynomials of places from 0 to 1; the first term is the constant.

    `degrees` over (term, value); `coefficients` of terms that have the variance 1 over evenly likely places.
    """

    degrees: NDArray[np.int64]
    coefficients: NDArray[np.float64]

    def __call__(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Value at each of n places, shape (n, values)."""
        return _columns(places, self.degrees) @ self.coefficients


def _columns(places: NDArray[np.float64], degrees: NDArray[np.int64]) -> NDArray[np.float64]:
    """Every term at every place, shape (places, terms)."""
    x = 2.0 * places - 1.0
    legendre = np.stack([np.ones_like(x), math.sqrt(3.0) * x, math.sqrt(5.0) * (1.5 * x * x - 0.5)])
    columns = np.ones((len(places), len(degrees)))
    for k in range(degrees.shape[1]):
        columns *= legendre[degrees[:, k], :, k].T
    return columns


def fit(places: NDArray[np.float64], values: NDArray[np.float64]) -> Polynomial:
    """The sparse polynomial of second degree that predicts the values of a sample best.

    Terms are taken up one by one, each the one that most lowers what is left; the number of terms is that at which leaving
    one sample out is predicted best.

    References
    ----------
    G. Blatman, B. Sudret, "Adaptive sparse polynomial chaos expansion based on least angle regression", J. Comput. Phys.
    230 (2011) 2345, doi:10.1016/j.jcp.2010.12.021; here by forward selection.
    """
    unit = np.eye(places.shape[1], dtype=int)
    pairs = [unit[i] + unit[k] for i, k in combinations(range(len(unit)), 2)]
    degrees = np.concatenate(
        [0 * unit[:1], unit, 2 * unit, np.array(pairs, dtype=int).reshape(-1, len(unit))]
    )
    columns = _columns(places, degrees)
    chosen, best, least = [0], [0], math.inf
    norms = np.linalg.norm(columns, axis=0)
    for _ in range(max(1, int(_MOST_TERMS * len(values)))):
        basis, _ = np.linalg.qr(columns[:, chosen])
        left = values - basis @ (basis.T @ values)
        # Beyond the error of leaving one out: the more terms have been tried, the more one of them fits by chance.
        error = float(np.mean((left / (1.0 - (basis**2).sum(axis=1))) ** 2)) / max(
            1e-9, 1.0 - len(chosen) / len(values)
        )
        if error < least:
            best, least = chosen.copy(), error
        residuals = np.linalg.norm(columns - basis @ (basis.T @ columns), axis=0)
        gain = np.where(
            residuals > 1e-6 * norms, np.abs(left @ columns) / np.maximum(residuals, 1e-300), 0.0
        )
        if gain.max() <= 1e-12 * np.linalg.norm(values):
            break
        chosen.append(int(np.argmax(gain)))
    coefficients, *_ = np.linalg.lstsq(columns[:, best], values, rcond=None)
    return Polynomial(degrees[best], coefficients)


def explained_variance(places: NDArray[np.float64], values: NDArray[np.float64]) -> float:
    """Part of the variance that the fit predicts for samples it was not fitted to [1], below 1; 0 and less: nothing.

    The sample is divided into ten parts; each is predicted by a fit to the other nine.
    """
    order = np.random.default_rng(0).permutation(len(values))
    error = 0.0
    for part in np.array_split(order, _PARTS):
        others = np.setdiff1d(order, part)
        error += float(
            ((fit(places[others], values[others])(places[part]) - values[part]) ** 2).sum()
        )
    return 1.0 - error / float(((values - values.mean()) ** 2).sum())


def sobol_indices(polynomial: Polynomial) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Sobol' indices of a polynomial over its values: of first order, and total [1].

    Its terms are orthonormal, so a part of its variance is a sum of squared coefficients.

    References
    ----------
    B. Sudret, "Global sensitivity analysis using polynomial chaos expansions", Reliab. Eng. Syst. Saf. 93 (2008) 964,
    doi:10.1016/j.ress.2007.04.002.

    Examples
    --------
    >>> first, total = sobol_indices(Polynomial(np.array([[0, 0], [1, 0], [1, 1]]), np.array([5.0, 3.0, 4.0])))
    >>> first.tolist(), total.tolist()
    ([0.36, 0.0], [1.0, 0.64])
    """
    acts = polynomial.degrees > 0
    square = np.where(acts.any(axis=1), polynomial.coefficients**2, 0.0)
    if not square.any():
        return np.zeros(acts.shape[1]), np.zeros(acts.shape[1])
    alone = acts & (acts.sum(axis=1) == 1)[:, None]
    return square @ alone / square.sum(), square @ acts / square.sum()


def quantities(sample: xr.Dataset) -> xr.Dataset:
    """The results whose uncertainty is given: `result` over (sample, quantity), with the coordinate `units`.

    NaN where a sample did not complete.
    """
    energy = sample.orbit_energy.sum("interface", skipna=False)
    down = energy.sel(row="downwind")
    ratio, peak = between_rows(energy), between_rows(sample.peak_power)
    inner = sample.orbit_energy.sel(row="downwind", interface="inner") / down
    names = sample.case.values.tolist()
    first, last = names[0], names[-1]
    window, power = sample.window_energy, sample.friction_power
    by_name = {
        f"energy per orbit, downwind, {name}": (down.sel(case=name), "J") for name in (first, last)
    }
    by_name[f"energy in {first} / {last}"] = window.sel(case=first) / window.sel(case=last), "1"
    by_name |= {f"energy, downwind / upwind, {name}": (ratio.sel(case=name), "1") for name in names}
    by_name[f"share of the inner raceway, downwind, {first}"] = inner.sel(case=first), "1"
    by_name |= {
        f"mean P_max, downwind / upwind, {name}": (peak.sel(case=name), "1") for name in names
    }
    by_name[f"sliding torque, {first}"] = sample.torque.sel(case=first), "N m"
    by_name[f"friction power of the bearing, {first}"] = power.sel(case=first), "W"
    by_name[f"friction power in {first} / {last}"] = (
        power.sel(case=first) / power.sel(case=last),
        "1",
    )
    values = np.stack([numbers.values for numbers, _ in by_name.values()], axis=1)
    return xr.Dataset(
        {
            "result": (
                ("sample", "quantity"),
                values,
                {"units": "1", "long_name": "result, in its quantity's unit"},
            )
        },
        {
            "sample": sample.sample,
            "quantity": list(by_name),
            "units": ("quantity", [unit for _, unit in by_name.values()]),
        },
    )


def trends(sample: xr.Dataset) -> dict[str, xr.DataArray]:
    """Whether each sample shows what the paper states, as far as its cases can."""
    names = sample.case.values.tolist()
    first, others, cases = names[0], names[1:], ", ".join(names)
    energy = sample.orbit_energy.sum("interface", skipna=False)
    ratio, peak = between_rows(energy), between_rows(sample.peak_power)
    cage = sample.orbit_energy.sel(interface="cage").sum("row") / energy.sum("row")
    down = sample.orbit_energy.sel(row="downwind")
    below = down.sel(interface="cage") / down.sum("interface", skipna=False)
    window, power = sample.window_energy, sample.friction_power

    def highest(values: xr.DataArray) -> xr.DataArray:
        return (values.sel(case=first) > values.sel(case=others)).all("case")

    def about(values: xr.DataArray, stated: float) -> xr.DataArray:
        return ((values >= stated / ABOUT) & (values <= stated * ABOUT)).any("case")

    return {
        f"energy highest in {first} of {cases}": highest(window),
        "downwind row spends more than the upwind row, every case": (ratio > 1.0).all("case"),
        "energy ratio within a factor of 2 of 10, any case": about(ratio, 10.0),
        f"ratio of peak powers highest in {first}": highest(peak),
        f"ratio of peak powers falls from case to case of {cases}": (peak.diff("case") < 0.0).all(
            "case"
        ),
        "ratio of peak powers within a factor of 2 of 5, any case": about(peak, 5.0),
        "cage takes at least half of the energy of both rows, any case": (cage >= DOMINANT).any(
            "case"
        ),
        "raceways take at least half of the downwind row's energy, every case": (
            below < DOMINANT
        ).all("case"),
        f"friction power of the bearing highest in {first}": highest(power),
    }


def uncertainty_summary(sample: xr.Dataset) -> xr.Dataset:
    """Ranges, rank correlations and indices over the samples that completed, of what `uncertainty` gives.

    Returns
    -------
    xarray.Dataset
        base over quantity; range over (quantity, quantile); rank_correlation, its probability, first_order and total_order
        (Sobol' indices of the logarithm) over (quantity, parameter); explained over quantity, the part of the variance that
        the polynomial behind the indices predicts; trend_share and trend_base over trend: how many samples show it, and
        whether the base values do. Attributes: how many samples completed, failed and were refused.
    """
    of_sample = quantities(sample)
    drawn = sample.sample > 0
    good = (sample.outcome == 0) & drawn
    result, places = of_sample.result.values[good], sample_places()[sample.sample.values[good] - 1]
    shape = of_sample.sizes["quantity"], len(VALUES)
    ranks, chance, first, total = (np.full(shape, np.nan) for _ in range(4))
    explained = np.full(shape[0], np.nan)
    for q, values in enumerate(result.T):
        if len(values) < 3 or np.ptp(values) == 0.0:
            continue  # what does not change has no rank, and no variance to divide
        ranks[q], chance[q] = rank_correlations(places, values)
        if len(values) > shape[1] and (values > 0.0).all():
            first[q], total[q] = sobol_indices(fit(places, np.log(values)))
            explained[q] = explained_variance(places, np.log(values))
    shown = {name: flags.values for name, flags in trends(sample).items()}
    shares = [float(flags[good].mean()) if good.any() else np.nan for flags in shown.values()]
    quantile = (
        np.quantile(result, QUANTILES, axis=0).T if len(result) else np.full((shape[0], 3), np.nan)
    )
    counts = {name: int(((sample.outcome == k) & drawn).sum()) for k, name in enumerate(OUTCOMES)}
    summary = xr.Dataset(
        coords={
            "quantity": of_sample.quantity,
            "units": of_sample.units,
            "quantile": list(QUANTILES),
            "trend": list(shown),
            "parameter": [uncertain.name for uncertain in VALUES],
            "case": sample.case.values,
        },
        attrs=counts,
    )
    for name, dims, values, words in (
        ("base", "quantity", of_sample.result.values[0], "with the base values"),
        ("range", ("quantity", "quantile"), quantile, "quantiles over the samples"),
        ("rank_correlation", ("quantity", "parameter"), ranks, "Spearman's rank correlation"),
        (
            "probability",
            ("quantity", "parameter"),
            chance,
            "probability of such a correlation by chance",
        ),
        (
            "first_order",
            ("quantity", "parameter"),
            first,
            "Sobol' index of first order, of the logarithm",
        ),
        ("total_order", ("quantity", "parameter"), total, "total Sobol' index, of the logarithm"),
        (
            "explained",
            "quantity",
            explained,
            "part of the variance that the polynomial behind the indices predicts",
        ),
        ("trend_share", "trend", shares, "share of the samples that show it"),
        (
            "trend_base",
            "trend",
            [int(flags[0]) for flags in shown.values()],
            "whether the base values show it",
        ),
    ):
        put(summary, name, (dims, values), "1", words)
    return summary


def robust(summary: xr.Dataset) -> list[tuple[str, str]]:
    """Every trend with the word for it: robust, where all samples show it; robustly not, where none does; or not robust."""
    shares = zip(summary.trend.values.tolist(), summary.trend_share.values.tolist(), strict=True)
    return [
        (name, {1.0: "robust", 0.0: "robustly not so"}.get(share, "not robust"))
        for name, share in shares
    ]


def strongest(summary: xr.Dataset, quantity: str) -> list[tuple[str, float, float]]:
    """Parameters with a total Sobol' index worth telling, the largest first: name, first order, total."""
    of_quantity = summary.sel(quantity=quantity)
    indices = zip(
        of_quantity.parameter.values.tolist(),
        of_quantity.first_order.values.tolist(),
        of_quantity.total_order.values.tolist(),
        strict=True,
    )
    return sorted((each for each in indices if each[2] >= TOLD_INDEX), key=lambda each: -each[2])


def drivers(summary: xr.Dataset, quantity: str) -> list[tuple[str, float]]:
    """Parameters whose rank correlation with a quantity is no chance, the strongest first, with its value."""
    of_quantity = summary.sel(quantity=quantity)
    sure = of_quantity.isel(parameter=of_quantity.probability.values < DRIVER_LEVEL)
    correlations = zip(
        sure.parameter.values.tolist(), sure.rank_correlation.values.tolist(), strict=True
    )
    return sorted(correlations, key=lambda each: -abs(each[1]))
