"""Variables of cages and pockets of a whole bearing, and its books of momentum and energy."""

from __future__ import annotations

from typing import Any

import numpy as np

from macroslip.case.case import Case
from macroslip.imposed.run import Outcome
from macroslip.imposed.status import Status
from macroslip.measures.cage import CageMeasures
from macroslip.whole.books import FLOWS, STOCKS, Books

#: Part of momentum and energy that may be missing in the books of a whole bearing without a word.
LARGEST_RESIDUAL = 0.005
#: Part of the dissipated energy that friction may seem to give back. What it gives is lost elsewhere,
#: so rows are off by more.
_LARGEST_GAIN = 0.001
#: Energy [J] and impulse [N m s] of which no part is missed: those of a bearing at rest are
#: rounding.
_SLIGHT = 1e-4
#: Traces of a cage, in the order of `CageMeasures.traces`.
_CAGE_TRACES = ("cage_speed", "cage_lag", "cage_x", "cage_y", "cage_torque")


def cage_values(case: Case, outcome: Outcome, cages: CageMeasures) -> dict[str, Any]:
    """Values by name of the variables that a whole bearing adds."""
    values = _pocket_values(case, outcome, cages) | _book_values(cages.books)
    span, first, second = cages.slip.T
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = first / span
        mean_square = second / span
        variance = mean_square - mean * mean
    values |= {
        "cage_slip": mean,
        "cage_slip_deviation": np.sqrt(np.maximum(variance, 0.0)),
    }
    if case.traces is not None:
        values |= _trace_values(case, cages)
    return values


def _pocket_values(case: Case, outcome: Outcome, cages: CageMeasures) -> dict[str, Any]:
    """Forces of spars over the chosen rollers; NaN where the integration did not complete."""
    rows = case.bearing.rows
    count = case.bearing.rollers_per_row

    def by_roller(values: np.ndarray) -> np.ndarray:
        every = np.array(values, dtype=float).reshape(rows, count, *values.shape[1:])
        chosen = every[:, list(case.roller_numbers)]
        if outcome.status != Status.COMPLETED:
            return np.full_like(chosen, np.nan)
        return chosen

    by_sector = cages.largest_by_sector.reshape(rows, count, -1)
    return {
        "pocket_impulse": by_roller(cages.impulse),
        "largest_pocket_force": by_roller(cages.largest),
        "pocket_contact_time": by_roller(cages.time),
        "largest_force_by_position": by_sector.max(axis=1),
    }


def _book_values(books: Books) -> dict[str, Any]:
    names = (*STOCKS, *FLOWS)
    columns = (*books.stocks.T, *books.flows.T)
    named = {f"book_{name}": column for name, column in zip(names, columns, strict=True)}
    return named | {
        "momentum_residual": books.momentum_residual(),
        "energy_residual": books.energy_residual(),
        "pocket_loss": books.pocket_loss(),
    }


def _trace_values(case: Case, cages: CageMeasures) -> dict[str, Any]:
    shape = (-1, case.bearing.rows, case.bearing.rollers_per_row)

    def over_time(values: np.ndarray) -> np.ndarray:
        by_roller = values.reshape(shape)
        chosen = by_roller[:, :, list(case.roller_numbers)]
        return np.moveaxis(chosen, 0, -1)

    offset = cages.offset.reshape(shape)
    ahead = np.roll(offset, -1, axis=2)
    spacing = ahead - offset
    traces = np.moveaxis(cages.traces, -1, 0).swapaxes(1, 2)
    return {
        "pocket_offset": over_time(cages.offset),
        "orbit_speed_deviation": over_time(cages.deviation),
        "spacing_deviation": over_time(spacing),
    } | dict(zip(_CAGE_TRACES, traces, strict=True))


def open_books(books: Books) -> str:
    """A sentence where momentum or energy is missing, or friction drives; empty otherwise.

    More than `LARGEST_RESIDUAL` is told. Energy is compared with what was dissipated by the end,
    momentum with the impulse of one kind that was largest.
    """
    flows = {name: np.abs(books.flows[:, k]) for k, name in enumerate(FLOWS)}
    losses = ("raceway_loss", "friction_loss", "guide_loss")
    friction = sum(flows[name][-1] for name in losses)
    dissipated = friction + books.pocket_loss()[-1]
    impulses = []
    for name, values in flows.items():
        if name.endswith("_impulse"):
            impulses.append(values.max())
    residuals = (
        ("energy", books.energy_residual(), dissipated, "what is dissipated"),
        (
            "angular momentum",
            books.momentum_residual(),
            max(impulses),
            "what passes through the bearing",
        ),
    )
    missing = []
    for quantity, residual, whole, of in residuals:
        largest = np.abs(residual).max()
        share = largest / max(whole, _SLIGHT)
        if share > LARGEST_RESIDUAL:
            missing.append(
                f"the balance of {quantity} has a residual of {100.0 * share:.2g} % of {of}"
            )
    sentences = []
    if missing:
        listed = " and ".join(missing)
        sentences.append(f"{listed}, where 0.5 % is good")
    gain = books.driven / max(dissipated, _SLIGHT)
    if gain > _LARGEST_GAIN:
        sentences.append(
            f"friction adds {100.0 * gain:.2g} % of the dissipated energy, which is impossible"
        )
    if not sentences:
        return ""
    return (
        f"{'; '.join(sentences)}; results may be off by several times that. "
        "Compute again with a smaller integrator.tolerance."
    )
