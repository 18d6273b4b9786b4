"""The work-precision diagram: what accuracy costs, method by method."""

from __future__ import annotations

import math
from types import MappingProxyType
from typing import TYPE_CHECKING

from benchmarks.comparison import Entry
from benchmarks.histories import History
from benchmarks.outcome import ASKED
from macroslip.report.style import BLACK, BLUE, GREEN, GREY, ORANGE, finish

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: From Okabe and Ito's palette, as the others.
_SKY, _PURPLE = "#56B4E9", "#CC79A7"
_LOOKS = MappingProxyType(
    {
        "own": {"color": BLACK, "marker": "o", "linewidth": 2.4, "linestyle": "-"},
        "lsoda": {"color": BLUE, "marker": "s", "linestyle": "-"},
        "cvode_compiled": {"color": ORANGE, "marker": "^", "linestyle": "-"},
        "cvode": {"color": ORANGE, "marker": "v", "linestyle": ":", "markerfacecolor": "white"},
        "backward_euler": {"color": GREEN, "marker": "D", "linestyle": "--"},
        "scipy_bdf": {"color": _PURPLE, "marker": "P", "linestyle": "-."},
        "scipy_radau": {"color": _SKY, "marker": "X", "linestyle": "-."},
    }
)
#: Errors at which curves have a point.
_LEVELS = tuple(10.0 ** (-0.5 * k) for k in range(4, 17))


def least_cost(
    entries: list[Entry], histories: list[History], quantity: str
) -> list[tuple[float, float]]:
    """Pairs (error, CPU time over simulated time) of one method: the least cost at which an error is not exceeded.

    Parameters
    ----------
    entries : list of Entry
        One for each history.
    histories : list of History
    quantity : str
        "energy_error" or "spin_error"; for the latter histories without a coast do not count.

    Returns
    -------
    list of tuple
        The geometric mean over histories, at errors that every history reaches by some setting tried; where no setting
        is cheaper than at a smaller error there is no point.
    """
    chosen = [
        (entry, history.end - history.start)
        for entry, history in zip(entries, histories, strict=True)
        if quantity == "energy_error" or history.marks.size
    ]
    points: list[tuple[float, float]] = []
    for level in _LEVELS:
        costs = []
        for entry, length in chosen:
            good = [
                outcome.seconds / length
                for outcome in entry.outcomes
                if getattr(outcome, quantity) <= level
            ]
            costs.append(min(good, default=math.nan))
        if not costs or any(math.isnan(cost) for cost in costs):
            break
        mean = math.exp(sum(map(math.log, costs)) / len(costs))
        if points and mean == points[-1][1]:
            points.pop()
        points.append((level, mean))
    return points


def plot_work_precision(
    axes: Axes,
    results: dict[str, list[Entry] | None],
    histories: list[History],
    quantity: str,
    titles: dict[str, str],
) -> Axes:
    """Error against CPU time per second of history, one line a method; `quantity` as in `least_cost`."""
    for key, style in _LOOKS.items():
        if not results.get(key):
            continue
        points = least_cost(results[key], histories, quantity)
        if points:
            error, cost = zip(*points, strict=True)
            axes.plot(
                cost,
                error,
                label=titles[key],
                markersize=6,
                zorder=3 if key == "own" else 2,
                **style,
            )
    axes.axhline(ASKED, color=GREY, linewidth=1.0, zorder=0, label=f"accuracy asked, {ASKED:g}")
    axes.set_xscale("log")
    axes.set_yscale("log")
    name = "total energy" if quantity == "energy_error" else "mid-coast spin"
    return finish(axes, "CPU time per second simulated, one roller [s]", f"error of {name} [–]")
