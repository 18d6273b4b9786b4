"""The look of figures and numbers: colours for the colour-blind, numbers of three digits."""

from __future__ import annotations

import base64
import io
import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from macroslip.constants import HOURS_A_YEAR

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure

#: From Okabe and Ito's palette.
BLACK = "#000000"
BLUE = "#0072B2"
ORANGE = "#D55E00"
GREEN = "#009E73"
GREY = "#6E6E6E"

_Styles = Mapping[str, Mapping[str, Any]]
#: Line and marker of each row.
ROW: _Styles = MappingProxyType(
    {
        "downwind": {"color": BLUE, "marker": "o", "linestyle": "-"},
        "upwind": {"color": ORANGE, "marker": "s", "linestyle": "--"},
        "single": {"color": BLUE, "marker": "o", "linestyle": "-"},
    }
)
#: Line of each interface.
INTERFACE: _Styles = MappingProxyType(
    {
        "inner": {"color": BLUE, "linestyle": "-"},
        "outer": {"color": ORANGE, "linestyle": "--"},
        "cage": {"color": GREEN, "linestyle": "-."},
    }
)
#: Size of a picture [inches] that a telephone held upright shows without making letters smaller
#: than the text's; and size of a round one.
WIDTH = 4.2
HEIGHT = 3.1
ROUND: Mapping[str, Any] = MappingProxyType({"height": 4.6, "polar": True})
#: Options of `picture` in the opening of a page.
OPENING: Mapping[str, Any] = MappingProxyType({"legend": "above"})
#: Size of letters: labels and titles; numbers at the axes and legends.
LABEL = 11
SMALL = 10


def three_digits(value: float) -> str:
    """A number with three digits, without a power of ten where one can do without.

    Examples
    --------
    >>> three_digits(0.21014), three_digits(1925.7)
    ('0.21', '1,926')
    """
    return f"{value:,.0f}" if abs(value) >= 1000.0 else f"{value:.3g}"


def years(hours: float) -> str:
    """Write a life in years, with three digits; lives beyond 500 years as such.

    Examples
    --------
    >>> years(175320.0), years(4000.0), years(2e16), years(float("nan"))
    ('20 years', '4000 h', 'beyond 500 years', '–')
    """
    if math.isnan(hours):
        return "–"
    if hours > 500.0 * HOURS_A_YEAR:
        return "beyond 500 years"
    return f"{hours / HOURS_A_YEAR:.3g} years" if hours >= HOURS_A_YEAR else f"{hours:.0f} h"


def scaled(largest: float, units: str) -> tuple[float, str]:
    """Factor and unit in which a quantity of the given size [SI] is written.

    Examples
    --------
    >>> scaled(2.13e7, "J/year"), scaled(3e-9, "m/year"), scaled(5.0, "W")
    ((1e-06, 'MJ/year'), (1000000.0, 'µm/year'), (1.0, 'W'))
    """
    amount, per, span = units.partition("/")
    if amount == "m" and largest < 1e-2:
        return 1e6, f"µm{per}{span}"
    if amount in ("J", "W") and largest >= 1e4:
        return (1e-6, f"M{units}") if largest >= 1e6 else (1e-3, f"k{units}")
    return 1.0, units


@contextmanager
def program_style() -> Iterator[None]:
    """Context or decorator in which figures have the program's style, not the user's.

    Matplotlib reads a file `matplotlibrc` of the current folder or the home: fonts, widths, and TeX
    that may be missing.
    """
    import matplotlib.style

    # Names inside an SVG file follow from its content: the same numbers give the same page.
    with matplotlib.style.context(["default", {"svg.hashsalt": "macroslip"}]):
        yield


@program_style()
def new_figure(
    width: float, height: float, rows: int = 1, columns: int = 1, **options: Any
) -> tuple[Figure, list]:
    """A figure of the program's style with a grid of axes, row by row.

    Parameters
    ----------
    width, height : float
        Size [inches].
    rows, columns : int, optional
        Size of the grid of axes.
    **options
        As `matplotlib.figure.Figure.subplots` takes them.

    Returns
    -------
    tuple of matplotlib.figure.Figure and list of matplotlib.axes.Axes
        What is plotted on the axes has the program's style inside `program_style` only.
    """
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    from macroslip.report.styled_figure import StyledFigure

    figure = StyledFigure(figsize=(width, height), layout=ConstrainedLayoutEngine(wspace=0.06))
    grid = figure.subplots(rows, columns, squeeze=False, **options)
    return figure, list(grid.ravel())


def finish(axes: Axes, x_label: str, y_label: str, title: str = "") -> Axes:
    """Label the axes and remove lines that carry no information.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    x_label, y_label : str
        Quantity and [unit].
    title : str, optional
        Left above the axes.
    """
    axes.set_xlabel(x_label, fontsize=LABEL)
    axes.set_ylabel(y_label, fontsize=LABEL)
    if title:
        axes.set_title(title, fontsize=LABEL, loc="left")
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=SMALL)
    return axes


def colour_scale(axes: Axes, shown: ScalarMappable, label: str, **options: Any) -> None:
    """Scale of the colours of an image or of patches.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    shown : matplotlib.cm.ScalarMappable
    label : str
        Quantity and [unit].
    **options
        As `matplotlib.figure.Figure.colorbar` takes them.
    """
    scale = axes.figure.colorbar(shown, ax=axes, pad=0.02, **options)
    scale.set_label(label, fontsize=LABEL)
    scale.ax.tick_params(labelsize=SMALL)


def legend_above(figure: Figure, axes: Axes, **options: object) -> None:
    """The legend of one of the figure's axes, above all of them."""
    handles, labels = axes.get_legend_handles_labels()
    options = {
        "frameon": False,
        "fontsize": SMALL,
        "title_fontsize": SMALL,
        "ncols": len(labels),
    } | options
    figure.legend(handles, labels, loc="outside upper center", **options)


def log_ticks(axes: Axes, which: str = "y") -> Axes:
    """A logarithmic axis with plain numbers at 1, 2 and 5 of every decade."""
    axes.set(**{f"{which}scale": "log"})
    decade_ticks(axes.yaxis if which == "y" else axes.xaxis)
    return axes


def decade_ticks(axis: Axis) -> None:
    """Plain numbers at 1, 2 and 5 of every decade."""
    from matplotlib.ticker import LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())


@program_style()
def save(figure: Figure, folder: Path, name: str) -> list[str]:
    """Write the figure as PNG (200 dpi) and SVG into a folder; returns the file names."""
    files = [f"{name}.png", f"{name}.svg"]
    figure.savefig(folder / files[0], dpi=200)
    # The layout is computed by now; computing it again would take as long as drawing.
    figure.set_layout_engine("none")
    figure.savefig(folder / files[1], metadata={"Date": None})
    return files


@dataclass(frozen=True, slots=True)
class Picture:
    """A figure for a page."""

    source: str  #: Data URI
    words: str  #: Content, for those who cannot see it
    width: int  #: [px]
    height: int  #: [px]


def picture(plot: Callable[..., object], about: str, *data: Any, **options: Any) -> Picture:
    """Draw one axes as SVG inside the page, so that it stays sharp without another file.

    Parameters
    ----------
    plot : callable
        A plot function, called with the axes and `data`.
    about : str
        The content, for those who cannot see it.
    *data
        What the plot function takes beside the axes.
    **options
        As `compared` takes them.
    """
    return compared(plot, {about: data}, **options)[0]


@program_style()
def compared(
    plot: Callable[..., object],
    panels: Mapping[str, Sequence[Any]],
    *,
    width: float = WIDTH,
    height: float = HEIGHT,
    polar: bool = False,
    legend: str = "",
) -> list[Picture]:
    """Pictures that are compared, and so share the scale of colours or of their axis.

    Parameters
    ----------
    plot : callable
        A plot function, called with the axes and the data of a panel.
    panels : mapping
        Data of every panel by its content, for those who cannot see it.
    width, height : float, optional
        Size of each [inches].
    polar : bool, optional
        Whether the axes are polar.
    legend : str, optional
        Empty for none, "above", or "below" with one entry a line.
    """
    drawn = [
        new_figure(width, height, subplot_kw={"projection": "polar" if polar else None})
        for _ in panels
    ]
    for (_, (axes,)), data in zip(drawn, panels.values(), strict=True):
        plot(axes, *data)
    _share_scales([axes for _, (axes,) in drawn])
    return [
        Picture(_svg(figure, axes, legend), about, round(96 * width), round(96 * height))
        for (figure, (axes,)), about in zip(drawn, panels, strict=True)
    ]


def _share_scales(panels: Sequence[Axes]) -> None:
    images = [panel.images[0] for panel in panels if panel.images]
    if len(panels) < 2:
        return
    if images:
        low, high = zip(*(image.get_clim() for image in images), strict=True)
        for image in images:
            image.set_clim(min(low), max(high))
        return
    low, high = zip(*(panel.get_ylim() for panel in panels), strict=True)
    for panel in panels:
        panel.set_ylim(min(low), max(high))


def _svg(figure: Figure, axes: Axes, legend: str) -> str:
    handles, labels = axes.get_legend_handles_labels()
    if labels and legend == "above":
        # Long names do not fit beside each other, and four are two by two.
        beside = 3 if sum(map(len, labels)) < 36 and len(labels) != 4 else 2
        legend_above(figure, axes, ncols=min(len(labels), beside))
    elif labels and legend:
        figure.legend(handles, labels, loc="outside lower center", frameon=False, fontsize=SMALL)
    content = io.BytesIO()
    figure.savefig(content, format="svg", metadata={"Date": None}, dpi=160)
    # Without comments and metadata, which a page does not show, and outlines to a hundredth of a
    # point.
    svg = re.sub(rb"<!--.*?-->|<metadata>.*?</metadata>", b"", content.getvalue(), flags=re.DOTALL)
    svg = re.sub(rb' d="[^"]*"', lambda outline: re.sub(rb"(\.\d\d)\d+", rb"\1", outline[0]), svg)
    encoded = base64.b64encode(re.sub(rb"\n\s*", b"\n", svg)).decode("ascii")
    return f"data:image/svg+xml;base64,{encoded}"


def row_pictures(
    plot: Callable[..., object], about: str, data: Any, rows: Sequence[str], **options: Any
) -> list[Picture]:
    """Pictures of one kind for every row, on one scale.

    Parameters
    ----------
    plot : callable
        A plot function, called with the axes, `data` and the name of the row.
    about : str
        The content, with braces where the name of the row belongs.
    data
        Data of all rows.
    rows : sequence of str
        Names of the rows.
    **options
        As `compared` takes them.
    """
    return compared(plot, {about.format(row): (data, row) for row in rows}, **options)
