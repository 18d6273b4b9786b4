"""Criteria of damage of a result: rates per second by row and surface, and one line a criterion."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from macroslip.damage import wear
from macroslip.errors import InputError
from macroslip.result.criteria import CRITERIA
from macroslip.result.criteria.criterion import Threshold, Values
from macroslip.result.criteria.evaluation import SURFACES, Evaluation
from macroslip.result.run_input import run_input, stored_settings
from macroslip.variables import ALWAYS, Variable, VariableTable

_NO_DETAILS = (
    "The result keeps no details of its contacts, from which damage is computed: it needs laws "
    "with microslip or asperities, such "
    "as laws: {model: physical}, with contact_details: true; of a study, keep has to name them."
)
_FEW_ROLLERS = (
    "Of {all} rollers a row {some} were simulated, {reason}: values at the outer raceway may be "
    "off by several times, because "
    "what lasts a short time falls on the few places where these rollers are. Leave rollers away "
    "to compute all."
)
_NO_ORBIT = (
    "No roller completed an orbit in the window, so nothing is said of a year like it: energies "
    "and wear of a part of an orbit "
    "depend on where the rollers were. Give loads that last for some orbits."
)
_PER_CRITERION = ("criterion",)
#: Variables of the answer: of each criterion its own, and a line.
DAMAGE = VariableTable(
    "Criteria of damage, `macroslip.result.damage.damage`",
    (
        *(variable for criterion in CRITERIA for variable in criterion.declares),
        Variable(
            "value", _PER_CRITERION, "see unit", ALWAYS, "worst value of either row and any place"
        ),
        Variable("factor", _PER_CRITERION, "1", ALWAYS, "the value holds within this factor"),
        Variable(
            "reference",
            _PER_CRITERION,
            "see unit",
            ALWAYS,
            "what it is compared with; NaN where nothing could be traced",
        ),
        Variable(
            "reference_low",
            _PER_CRITERION,
            "see unit",
            ALWAYS,
            "least reference that its source leaves open",
        ),
        Variable(
            "reference_high",
            _PER_CRITERION,
            "see unit",
            ALWAYS,
            "largest reference that its source leaves open",
        ),
        Variable(
            "ratio",
            _PER_CRITERION,
            "1",
            ALWAYS,
            "value over reference; of a time reference over value",
        ),
    ),
)
#: Columns of a line of the answer, in their order.
_COLUMNS = (
    "criterion",
    "title",
    "mechanism",
    "quantity",
    "value",
    "unit",
    "reference",
    "compared_with",
    "ratio",
    "factor",
    "how_sure",
    "in_answer",
)


def damage(
    result: xr.Dataset,
    *,
    wear_coefficients: Sequence[float] | None = None,
    hardness: float | None = None,
    thresholds: Mapping[str, Threshold] | None = None,
) -> xr.Dataset:
    """Criteria of damage of a result, each with its reference; none of them holds generally.

    Parameters
    ----------
    result : xarray.Dataset
        From `simulate`, with details of the contacts.
    wear_coefficients : sequence of float, optional
        k [m²/N], rising; 1e-18, 1e-17 and 1e-16 by default.
    hardness : float, optional
        Hardness [Pa], with which the coefficients are dimensionless, and k is they over it.
    thresholds : mapping, optional
        Your own thresholds by the name of the criterion, each with its source, in place of a
        reference.

    Returns
    -------
    xarray.Dataset
        Rates per second over row, surface and station; over `criterion` the worst `value`, its
        `reference` and `ratio`, and
        as coordinates `unit`, `compared_with` and `how_sure`. The attribute `not_kept` says what is
        missing, and why.

    Raises
    ------
    InputError
        If the result keeps no details; if wear is asked for where no asperities were chosen; for a
        criterion that does
        not exist, or numbers out of range.
    """
    if "surface_work" not in result:
        raise InputError(_NO_DETAILS, allowed="results of contacts with microslip or asperities")
    own = dict(thresholds or {})
    _check_thresholds(own)
    evaluation = Evaluation(
        result,
        run_input(result),
        thresholds=own,
        wear_coefficients=_coefficients(wear_coefficients, hardness),
        wear_is_asked_for=wear_coefficients is not None,
    )
    values: Values = {}
    for criterion in CRITERIA:
        values |= criterion.variables(evaluation)
    missing = [*_few_rollers(evaluation), *_failed(result)]
    if not evaluation.tells_of_year:
        missing.append(_NO_ORBIT)
    for criterion in CRITERIA:
        if criterion.missing is not None:
            missing += criterion.missing(evaluation, values)
    references = {work for criterion in CRITERIA for work in criterion.references}
    return xr.Dataset(
        DAMAGE.put(values | _answer(evaluation, values)),
        _coordinates(evaluation),
        {
            "title": f"Criteria of damage: {result.attrs.get('title', '')}",
            "model": result.attrs.get("model", ""),
            "oil": result.attrs.get("oil", ""),
            "not_kept": "\n".join(missing),
            "references": "\n".join(sorted(references)),
        },
    )


def _check_thresholds(own: Mapping[str, Threshold]) -> None:
    names = [criterion.name for criterion in CRITERIA]
    for name, threshold in own.items():
        is_positive = math.isfinite(threshold.value) and threshold.value > 0.0
        if not (name in names and is_positive and threshold.source.strip()):
            raise InputError(
                f"the threshold of '{name}' is {threshold.value!r}, source {threshold.source!r}",
                allowed=f"a number above 0 and where it comes from, for one of {', '.join(names)}",
            )


def _coefficients(
    coefficients_given: Sequence[float] | None, hardness: float | None
) -> list[float]:
    """Coefficients of wear k [m²/N], rising, of those that were given and the hardness [Pa]."""
    values = wear.COEFFICIENTS
    if coefficients_given is not None:
        values = coefficients_given
    coefficients = [float(value) for value in values]
    are_positive = all(math.isfinite(value) and value > 0.0 for value in coefficients)
    are_rising = coefficients == sorted(set(coefficients)) and coefficients
    hardness_is_valid = hardness is None or (math.isfinite(hardness) and hardness > 0.0)
    if not (are_positive and are_rising and hardness_is_valid):
        raise InputError(
            f"the wear coefficients are {coefficients}, the hardness {hardness}",
            where="wear",
            allowed="rising numbers above 0 in m²/N; with a hardness above 0 in Pa they are "
            "dimensionless",
        )
    if hardness is None:
        return coefficients
    if coefficients_given is None:
        raise InputError(
            "a hardness is given without wear coefficients",
            where="wear",
            allowed="both, K and H, or k alone",
        )
    return [value / hardness for value in coefficients]


def _few_rollers(evaluation: Evaluation) -> list[str]:
    """A note where the simulated rollers do not represent all at the outer raceway."""
    simulated = evaluation.result.sizes["roller"]
    every = evaluation.bearing.rollers_per_row
    outer_passes = evaluation.result.surface_passes.sel(raceway="outer")
    if simulated == every:
        return []
    if evaluation.run_input.is_event:
        reason = "in an event"
    elif bool((outer_passes == 0.0).any()):
        reason = "and these did not pass the whole raceway"
    else:
        return []
    return [_FEW_ROLLERS.format(all=every, some=simulated, reason=reason)]


def _failed(result: xr.Dataset) -> list[str]:
    failed = int((result.status != 0).sum())
    if not failed:
        return []
    return [f"{failed} rollers failed: their rows have no maps, and their entries are left out."]


def _answer(evaluation: Evaluation, values: Mapping[str, np.ndarray]) -> Values:
    """Value, factor, reference and ratio of every criterion."""
    value = np.array([criterion.value(values) for criterion in CRITERIA])
    reference = np.array([evaluation.reference(criterion) for criterion in CRITERIA])
    lowest = np.array([criterion.lowest for criterion in CRITERIA])
    ranges = np.array([evaluation.reference_range(criterion) for criterion in CRITERIA])
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(lowest, reference / value, value / reference)
    return {
        "value": value,
        "factor": [criterion.factor for criterion in CRITERIA],
        "reference": reference,
        "reference_low": ranges[:, 0],
        "reference_high": ranges[:, 1],
        "ratio": ratio,
    }


def _coordinates(evaluation: Evaluation) -> dict[str, Any]:
    result = evaluation.result

    def compared_with(name: str, source: str) -> str:
        own = evaluation.thresholds.get(name)
        if own is None:
            return source
        return f"your threshold: {own.source}"

    compared = [compared_with(criterion.name, criterion.compared_with) for criterion in CRITERIA]
    coordinates: dict[str, Any] = {
        "row": result.row,
        "surface": list(SURFACES),
        "raceway": result.raceway,
        "station": result.station,
    }
    for criterion in CRITERIA:
        if criterion.coordinates is not None:
            coordinates |= criterion.coordinates(evaluation)
    return coordinates | {
        "criterion": [criterion.name for criterion in CRITERIA],
        "title": ("criterion", [criterion.title for criterion in CRITERIA]),
        "mechanism": ("criterion", [criterion.mechanism for criterion in CRITERIA]),
        "quantity": ("criterion", [criterion.quantity for criterion in CRITERIA]),
        "in_answer": ("criterion", [criterion.in_answer for criterion in CRITERIA]),
        "unit": ("criterion", [criterion.unit for criterion in CRITERIA]),
        "compared_with": ("criterion", compared),
        "how_sure": ("criterion", [criterion.how_sure for criterion in CRITERIA]),
    }


def lines(result: xr.Dataset) -> tuple[list[dict[str, Any]], list[str]]:
    """The answer of a result: a dictionary for each criterion, and sentences on what is missing."""
    if "surface_work" not in result:
        return [], [_NO_DETAILS]
    if not stored_settings(result):
        return [], ["The result does not hold its input, which criteria of damage need."]
    return criterion_lines(damage(result))


def criterion_lines(criteria: xr.Dataset) -> tuple[list[dict[str, Any]], list[str]]:
    """The lines of a dataset of `damage`, and the sentences on what is missing."""
    is_known = criteria.value.notnull().values
    known = criteria.isel(criterion=np.flatnonzero(is_known))
    headings = [name.replace("_", " ") for name in _COLUMNS]
    columns = [known[name].values.tolist() for name in _COLUMNS]
    table = zip(*columns, strict=True)
    rows = [dict(zip(headings, line, strict=True)) for line in table]
    for row in rows:
        row["compared with"] = row["compared with"] or "no traced reference"
    return rows, criteria.attrs["not_kept"].splitlines()
