"""Which design dissipates least, by how much, and which designs cannot be distinguished."""

from __future__ import annotations

import numpy as np
import pandas as pd

from macroslip.constants import HOURS_A_YEAR
from macroslip.report.style import scaled
from macroslip.study.year import DESIGN_COLUMNS

#: Quantity by which designs are ranked.
ENERGY = DESIGN_COLUMNS["energy"].meaning
#: Designs that the first sentence names beside the best.
_MOST_NAMED = 4
#: Ends of quantities of which more is better; of all others less is.
_MORE_IS_BETTER = ("life", "static safety", "lowest spin over pure rolling")
#: Numbers that differ by less than this are alike; lives beyond this many hours are, too.
_ALIKE = 0.05
_LONG_LIFE = 500.0 * HOURS_A_YEAR


def ranking_sentences(comparison: pd.DataFrame) -> list[str]:
    """Sentences on the energies of a comparison: the least, the others, and how sure that is.

    Takes the table of `macroslip.compare`; the first sentence names the best.
    """
    energies = comparison.loc[comparison["quantity"] == ENERGY].rename(
        columns={"difference [%]": "change", "low [%]": "low", "high [%]": "high"}
    )
    is_known = np.isfinite(energies["value"])
    unknown = ", ".join(energies["design"][~is_known])
    known = energies.loc[is_known].sort_values("value", kind="stable")
    if len(known) < 2:
        return [f"The designs cannot be ranked: the energy of {unknown} is not known."]
    values = known["value"]
    if values.iloc[0] == values.iloc[-1]:
        return ["All dissipate the same energy."]
    if len(known) > _MOST_NAMED + 1:
        shown = pd.concat([known[:_MOST_NAMED], known[-1:]])
        hidden = len(known) - len(shown)
        between = f"; {hidden} others between them"
    else:
        shown = known
        between = ""
    sentences = [f"{_order(shown)}{between}."]
    if unknown:
        sentences.append(f"The energy of {unknown} is not known.")
    first = energies["design"].iloc[0]
    others = shown[shown["design"] != first]
    sentences += _differences(first, others)
    best = shown["design"].iloc[0]
    worse = [
        f"{quantity} ({other})"
        for quantity, of_quantity in comparison.groupby("quantity", sort=False)
        if not str(quantity).startswith("energy")
        and (other := _better_design(str(quantity), of_quantity, best))
    ]
    if worse:
        listed = "; ".join(worse)
        sentences.append(f"Others are more than 5 % better than {best} in: {listed}.")
    return sentences


def _better_design(quantity: str, numbers: pd.DataFrame, best: str) -> str:
    """The design with a clearly better number of a quantity than `best`; empty without one."""
    values = numbers.set_index("design")["value"].dropna()
    if best not in values.index:
        return ""
    if quantity.partition(",")[0].endswith(_MORE_IS_BETTER):
        if quantity.endswith("life"):
            values = values.clip(upper=_LONG_LIFE)
        largest = float(values.max())
        is_better = largest > (1.0 + _ALIKE) * float(values[best])
        return str(values.idxmax()) if is_better else ""
    least = float(values.min())
    is_better = least < (1.0 - _ALIKE) * float(values[best])
    return str(values.idxmin()) if is_better else ""


def _order(ranked: pd.DataFrame) -> str:
    """The best design with its energy, and the excess of the others."""
    best = ranked.iloc[0]
    least = best["value"]
    factor, units = scaled(least, best["units"])
    parts = [f"{best['design']} dissipates least, {factor * least:.4g} {units} ({ENERGY})"]
    others = ranked[1:]
    for design, value in zip(others["design"], others["value"], strict=True):
        if least > 0.0:
            percent = 100.0 * (value / least - 1.0)
            parts.append(f"{design} {percent:.3g} % more")
        else:
            factor, units = scaled(value, best["units"])
            parts.append(f"{design} {factor * value:.4g} {units}")
    return "; ".join(parts)


def _differences(first: str, others: pd.DataFrame) -> list[str]:
    """Sentences on the differences from the first design, and how sure they are."""
    sentences = []
    within_scatter = []
    unsure = []
    for other in others.itertuples():
        if not np.isfinite(other.low):
            unsure.append(other.design)
        elif other.low <= 0.0 <= other.high:
            half = 0.5 * (other.high - other.low)
            within_scatter.append(
                f"{other.design}, {other.change:.3g} %, is smaller than its scatter of {half:.2g} %"
            )
        else:
            sentences.append(
                f"From {first} to {other.design} the energy changes by {other.change:+.3g} % "
                f"({other.low:+.3g} to {other.high:+.3g} %)."
            )
    if within_scatter:
        sentences.append(
            f"The difference between {first} and {'; and '.join(within_scatter)}: "
            "they cannot be distinguished."
        )
    if unsure:
        pairs = (
            "these differences are"
            if len(unsure) == len(others) > 1
            else f"the difference is between {first} and {'; and '.join(unsure)}"
        )
        sentences.append(f"How sure {pairs} cannot be seen from these results.")
    return sentences
