"""Tables that studies make, and the CPU time they take: `python -m benchmarks.tables`.

Sets of cases under the physical model: the 21 load cases of the paper, a year, a year of rollers
that skew, and one load case with 16 supplies of oil. Each set begins without any tables; kernels
are compiled before.
"""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from macroslip import Case, HubLoads, Laws
from macroslip.loads.bundled import bundled_cases
from macroslip.result.prepared import prepare
from macroslip.result.skew import skewing
from macroslip.roller.model import with_tables
from macroslip.storage import tables


def cases_of(names: Iterable[str]) -> list[Case]:
    """Bundled load cases at 35 °C under the physical model, straight rollers."""
    return [Case(loads=HubLoads.bundled(name), laws=Laws.physical()) for name in names]


def supplies() -> list[Case]:
    """14B with films of 0.3 to 0.99 of the flooded ones, even in steps of the film."""
    loads = HubLoads.bundled("14B")
    return [
        Case(loads=loads, laws=Laws.physical(), oil_supply=float(film))
        for film in np.linspace(0.3, 0.99, 16)
    ]


def measured(cases: list[Case], *, skew: bool = False) -> tuple[int, float]:
    """Parts of sheets that these cases make and store, and CPU time for tables [s]."""
    kept: dict[str, bytes] = {}
    reading = tables.read_cache
    writing = tables.write_cache
    tables.read_cache = kept.get
    tables.write_cache = kept.__setitem__
    tables._in_memory.clear()
    spent = 0.0
    try:
        for case in cases:
            ready = prepare(case)
            start = time.process_time()
            if skew:
                turning = replace(case, laws=case.laws.but(skew="quasi-static"))
                skewing(turning, ready.model.laws, ready.box)
            else:
                with_tables(ready.models, ready.box)
            spent += time.process_time() - start
    finally:
        tables.read_cache = reading
        tables.write_cache = writing
    return len(kept), spent


def main() -> None:
    """Print a row of each set."""
    first = cases_of(["14B"])
    measured(first)  # compiles
    year = cases_of(bundled_cases("year"))
    sets = {
        "one case": (first, False),
        "the 21 cases": (year[:21], False),
        "a year, 46 cases": (year, False),
        "a year, tables of skew": (year, True),
        "16 supplies of oil": (supplies(), False),
    }
    print("| cases | parts of sheets made | CPU time [s] |\n|---|---|---|")
    for name, (cases, skew) in sets.items():
        sheets, spent = measured(cases, skew=skew)
        print(f"| {name} | {sheets} | {spent:.1f} |", flush=True)


if __name__ == "__main__":
    main()
