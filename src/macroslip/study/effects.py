"""Effects of sampled parameters on a year: main effects, rank correlations and ranges."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from macroslip.errors import InputError
from macroslip.study.aggregation import Aggregation
from macroslip.study.labels import labels_over, sampled_parameters
from macroslip.study.year import DESIGN_UNITS, designs, year
from macroslip.variables import ALWAYS, Variable, VariableTable

#: Quantiles of a quantity over the sample, and points below which nothing is said.
QUANTILES = (0.05, 0.5, 0.95)
_FEWEST = 4


def rank_correlations(values: ArrayLike, results: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Spearman's rank correlation of results with each value of a sample, and its p-value.

    Both have the shape (parameters,): NaN where a value or the results do not change, and for fewer
    than three points. `values` has the shape (n, parameters), `results` (n,).

    `scipy.stats.spearmanr`.

    Examples
    --------
    >>> ranks, chance = rank_correlations([[1.0, 7.0], [2.0, 7.0], [3.0, 7.0], [4.0, 7.0]], [1.0, 4.0, 9.0, 16.0])
    >>> ranks.tolist()
    [1.0, nan]
    """
    from scipy.stats import spearmanr

    points = np.asarray(values, float)
    outcomes = np.asarray(results, float)
    ranks, chance = np.full((2, points.shape[1]), np.nan)
    if outcomes.size >= 3 and np.ptp(outcomes) > 0.0:
        varied = np.ptp(points, axis=0) > 0.0
        for p in np.flatnonzero(varied):
            ranks[p], chance[p] = spearmanr(points[:, p], outcomes)
    return ranks, chance


def main_effects(values: ArrayLike, results: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Main effects of each value of a sample, and their standard errors.

    An effect is the mean of the results in the upper half of a value less that in its lower half.

    `values` has the shape (n, parameters), `results` (n,).

    Examples
    --------
    >>> effect, error = main_effects([[1.0], [2.0], [3.0], [4.0]], [10.0, 12.0, 20.0, 22.0])
    >>> effect.item(), round(error.item(), 3)
    (10.0, 1.414)
    """
    points = np.asarray(values, float)
    outcomes = np.asarray(results, float)
    effect, error = np.full((2, points.shape[1]), np.nan)
    for p, coordinate in enumerate(points.T):
        middle = np.median(coordinate)
        upper = outcomes[coordinate > middle]
        lower = outcomes[coordinate <= middle]
        if min(upper.size, lower.size) >= 2:
            effect[p] = upper.mean() - lower.mean()
            variances = [half.var(ddof=1) / half.size for half in (upper, lower)]
            error[p] = np.sqrt(sum(variances))
    return effect, error


_OVER = ("quantity", "parameter")
#: All variables of `effects`.
EFFECTS = VariableTable(
    "Effects of sampled values, `macroslip.study.effects.effects`",
    (
        Variable(
            "main_effect",
            _OVER,
            "1",
            ALWAYS,
            "change from the lower to the upper half, over the mean",
        ),
        Variable("main_effect_error", _OVER, "1", ALWAYS, "standard error of it"),
        Variable("rank_correlation", _OVER, "1", ALWAYS, "Spearman's rank correlation"),
        Variable("probability", _OVER, "1", ALWAYS, "probability of such a correlation by chance"),
        Variable(
            "range", ("quantity", "quantile"), "see units", ALWAYS, "quantiles over the sample"
        ),
        Variable("points", (), "1", ALWAYS, "designs of the sample"),
    ),
)


def effects(study: xr.Dataset, aggregation: Aggregation = Aggregation()) -> xr.Dataset:
    """Sensitivity of the criteria and lives of a year to each sampled parameter.

    Raises InputError if the study has no sample, or a label or a weight is wrong.

    Over (quantity, parameter) there are `main_effect`, mean of the upper half of the parameter's
    values less that of the lower half, in parts of the mean [1], its standard error
    `main_effect_error`, Spearman's `rank_correlation` and its `probability` by chance; over
    (quantity, quantile) `range`, in the coordinate `units`; and `points` of the sample. Where
    bearing, lubricant, model or a grid vary as well, quantities are taken relative to their mean
    over the sample in each.

    Points without a value are left out, and quantities with fewer than four. An effect beside a
    standard error of its size is none.
    """
    names = sampled_parameters(study)
    if not names:
        raise InputError(
            "the study has no sample", allowed="studies with variations: {sample: ...}"
        )
    every_design = replace(aggregation, by=())
    annual = year(study, every_design)
    table, _ = designs(annual)
    labels = [name for name in labels_over(annual, "group") if name not in names]
    table["_block"] = table.groupby(labels, dropna=False, sort=False).ngroup()
    quantities = []
    for name in DESIGN_UNITS:
        if name in table and np.isfinite(table[name].to_numpy()).sum() >= _FEWEST:
            quantities.append(name)
    shape = len(quantities), len(names)
    effect, error, ranks, chance = np.full((4, *shape), np.nan)
    spread = np.full((shape[0], len(QUANTILES)), np.nan)
    for q, name in enumerate(quantities):
        known = table[np.isfinite(table[name])]
        values = known[names].to_numpy(dtype=float)
        mean = known.groupby("_block")[name].transform("mean")
        over_mean = known[name] / mean.where(mean != 0.0)
        relative = over_mean.fillna(1.0).to_numpy()
        effect[q], error[q] = main_effects(values, relative)
        ranks[q], chance[q] = rank_correlations(values, relative)
        spread[q] = np.quantile(known[name], QUANTILES)
    effects_of_values = {
        "main_effect": effect,
        "main_effect_error": error,
        "rank_correlation": ranks,
        "probability": chance,
        "range": spread,
        "points": len(table),
    }
    return xr.Dataset(
        EFFECTS.put(effects_of_values),
        {
            "quantity": quantities,
            "parameter": names,
            "quantile": list(QUANTILES),
            "units": ("quantity", [DESIGN_UNITS[name] for name in quantities]),
        },
    )
