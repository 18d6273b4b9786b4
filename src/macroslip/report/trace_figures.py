"""Series of one roller over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from macroslip.errors import InputError
from macroslip.report.style import BLACK, BLUE, finish

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes


def plot_spin_over_time(axes: Axes, result: xr.Dataset, row: str, roller: int) -> Axes:
    """Spin speed of a roller [rad/s] over time, with that of pure rolling; where they part, the roller slips.

    Takes a result with traces.
    """
    if "time" not in result.dims:
        raise InputError("the result has no traces", remedy="Give the case traces, such as traces: {step: 0.05 s}.")
    one = result.sel(row=row, roller=roller)
    time = one.time.values
    axes.plot(time, abs(one.spin_pure.values), color=BLACK, linestyle="--", linewidth=1.2, label="pure rolling")
    axes.plot(time, abs(one.spin.values), color=BLUE, linewidth=1.6, label="roller")
    axes.set_ylim(bottom=0.0)
    axes.legend(frameon=False, fontsize=9)
    return finish(axes, "time [s]", "spin speed |ω| [rad/s]", f"roller {roller} of the {row} row")
