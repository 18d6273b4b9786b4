"""The look of the figures: one typeface, colours for the colour-blind, markers and line styles that differ in grey."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: From Okabe and Ito's palette.
BLACK, BLUE, ORANGE, GREEN, GREY = "#000000", "#0072B2", "#D55E00", "#009E73", "#6E6E6E"

#: Line and marker of each row.
ROW: Mapping[str, Mapping[str, object]] = MappingProxyType(
    {
        "downwind": {"color": BLUE, "marker": "o", "linestyle": "-"},
        "upwind": {"color": ORANGE, "marker": "s", "linestyle": "--"},
    }
)
#: Line of each interface.
INTERFACE: Mapping[str, Mapping[str, object]] = MappingProxyType(
    {
        "inner": {"color": BLUE, "linestyle": "-"},
        "outer": {"color": ORANGE, "linestyle": "--"},
        "cage": {"color": GREEN, "linestyle": "-."},
    }
)


def new_figure(width: float, height: float, rows: int = 1, columns: int = 1, **options: Any) -> tuple[Figure, list]:
    """A figure of the given size [inches] with a grid of axes, row by row, without any global plotting state."""
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    figure = Figure(figsize=(width, height), layout=ConstrainedLayoutEngine(wspace=0.06))
    grid = figure.subplots(rows, columns, squeeze=False, **options)
    return figure, list(grid.ravel())


def finish(axes: Axes, x_label: str, y_label: str, title: str = "") -> Axes:
    """Label the axes and take away what carries no information."""
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    if title:
        axes.set_title(title, fontsize=10, loc="left")
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=9)
    return axes


def legend_above(figure: Figure, axes: Axes, **options: object) -> None:
    """The legend of one of the figure's axes, above all of them."""
    handles, labels = axes.get_legend_handles_labels()
    options = {"frameon": False, "fontsize": 9, "title_fontsize": 9, "ncols": len(labels)} | options
    figure.legend(handles, labels, loc="outside upper center", **options)


def log_ticks(axes: Axes, which: str = "y") -> Axes:
    """A logarithmic axis, vertical or `which` is "x", with plain numbers at 1, 2 and 5 of every decade."""
    from matplotlib.ticker import LogLocator, NullFormatter

    axes.set(**{f"{which}scale": "log"})
    axis = axes.yaxis if which == "y" else axes.xaxis
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())
    return axes


def save(figure: Figure, folder: Path, name: str) -> list[str]:
    """Write the figure as PNG (200 dpi) and SVG into a folder; returns the file names."""
    files = [f"{name}.png", f"{name}.svg"]
    figure.savefig(folder / files[0], dpi=200)
    # The places of everything are found by now; finding them takes as long as drawing.
    figure.set_layout_engine("none")
    figure.savefig(folder / files[1], metadata={"Date": None})
    return files
