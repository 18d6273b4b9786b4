"""Criteria of damage: each module of this folder with `CRITERIA`, a tuple, adds its own."""

from __future__ import annotations

import pkgutil
from importlib import import_module

from macroslip.result.criteria.criterion import Criterion, Yearly


def _declared() -> list[Criterion]:
    modules = (
        import_module(f"{__name__}.{module_of_criteria.name}")
        for module_of_criteria in pkgutil.iter_modules(__path__)
    )
    criteria = []
    for module in modules:
        criteria += getattr(module, "CRITERIA", ())
    return criteria


#: All criteria in their order.
CRITERIA: tuple[Criterion, ...] = tuple(sorted(_declared(), key=lambda criterion: criterion.order))
#: What a study keeps of them.
YEARLY: tuple[Yearly, ...] = tuple(yearly for criterion in CRITERIA for yearly in criterion.yearly)
#: Those of which a year is a sum over its hours; of the others the largest value counts.
SUMMED: tuple[Yearly, ...] = tuple(yearly for yearly in YEARLY if yearly.drawn != "largest")
#: The criterion of each number of a year, by its name.
OF_NUMBER: dict[str, Criterion] = {
    yearly.name: criterion for criterion in CRITERIA for yearly in criterion.yearly
}
