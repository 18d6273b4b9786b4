"""Criteria of micropitting: thin films, and on which side the slip is."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from macroslip.constants import HOUR
from macroslip.damage import micropitting
from macroslip.measures.along import FILM_EDGES, SLIP_EDGES
from macroslip.result.criteria.criterion import (
    Criterion,
    PageColumn,
    Values,
    Yearly,
    largest,
    largest_of,
)
from macroslip.result.criteria.evaluation import Evaluation
from macroslip.result.run_input import window_length
from macroslip.variables import ALWAYS, Variable, described

_NO_THIN_FILMS = (
    "No film under load was thinner than Λ = 3, so nothing is said of the sign of slip in thin "
    "films."
)
_OVER = ("row", "raceway")
#: Classes of Λ that lie below 1, and below 3.
_BELOW_ONE = FILM_EDGES.index(1.0) + 1
_BELOW_THREE = FILM_EDGES.index(3.0) + 1
_MEANINGS = {"time": "loaded time", "passes": "passes"}


def _amounts(evaluation: Evaluation, kind: str) -> np.ndarray:
    """Time [s] or passes over row, raceway, class of Λ and class of slip."""
    amounts = evaluation.result[f"film_slip_{kind}"]
    return amounts.transpose(*_OVER, "film_class", "slip_class").values


def _mixed(evaluation: Evaluation) -> Values:
    """Shares of loaded time and of passes with Λ below each of its edges."""
    values: Values = {}
    for kind in _MEANINGS:
        amounts = _amounts(evaluation, kind)
        shares = [micropitting.share_below(amounts, FILM_EDGES, edge) for edge in FILM_EDGES]
        values[f"mixed_{kind}"] = np.stack(shares, axis=-1)
    return values


def _film_ratios(_: Evaluation) -> dict[str, Any]:
    about = described("1", "upper limit of Lambda")
    return {"film_ratio": ("film_ratio", list(FILM_EDGES), about)}


def _slower(evaluation: Evaluation) -> Values:
    by_class = _amounts(evaluation, "time")
    thin = by_class[:, :, :_BELOW_THREE].sum(axis=2)
    return {"slower_share": micropitting.slower_share(thin, SLIP_EDGES)}


def _without_thin_films(evaluation: Evaluation, variables: Mapping[str, np.ndarray]) -> list[str]:
    if np.isfinite(variables["slower_share"]).any():
        return []
    return [_NO_THIN_FILMS]


def _mixed_film_time(_: xr.Dataset, result: xr.Dataset) -> xr.DataArray:
    """Share of a roller's time with load and Λ < 1 [-], over row, at the raceway with more."""
    thin = result.film_slip_time.isel(film_class=slice(_BELOW_ONE))
    time = thin.sum(["film_class", "slip_class"], skipna=False)
    simulated = window_length(result) * result.sizes["roller"]
    return (time / simulated).max("raceway", skipna=False)


CRITERIA = (
    Criterion(
        order=30,
        name="mixed_time",
        mechanism="micropitting",
        quantity="loaded time with Λ < 1",
        unit="1",
        declares=tuple(
            Variable(
                f"mixed_{kind}",
                (*_OVER, "film_ratio"),
                "1",
                ALWAYS,
                f"share of {meaning} with Lambda below film_ratio",
            )
            for kind, meaning in _MEANINGS.items()
        ),
        variables=_mixed,
        coordinates=_film_ratios,
        value=lambda variables: largest(variables["mixed_time"][..., _BELOW_ONE - 1]),
        reference=math.nan,
        compared_with="",
        factor=3.0,
        reason="roughness, oil supply",
        references=micropitting.REFERENCES,
        yearly=(
            Yearly(
                run_name="mixed_film_time",
                run_unit="1",
                run_meaning="share of time of a roller under load with Lambda < 1, "
                "raceway with more",
                of_run=_mixed_film_time,
                name="mixed_time",
                drawn="max",
                year_unit="s",
                year_meaning="time of a roller under load with Lambda below 1",
                unit="1",
                meaning="share of time with Λ < 1",
                mean_over=1.0,
                design_column=PageColumn("time with Λ < 1 [%]", 100.0),
                year_column=PageColumn("Λ < 1 [h]", 1.0 / HOUR),
            ),
        ),
    ),
    Criterion(
        order=31,
        name="slower_time",
        mechanism="micropitting",
        quantity="ring slower, Λ < 3",
        unit="1",
        declares=(
            Variable(
                "slower_share",
                _OVER,
                "1",
                ALWAYS,
                "of the time with Lambda below 3 the share with the ring the slower surface",
            ),
        ),
        variables=_slower,
        value=largest_of("slower_share"),
        missing=_without_thin_films,
        reference=math.nan,
        compared_with="",
        factor=1.5,
        reason="profile of slip",
    ),
)
