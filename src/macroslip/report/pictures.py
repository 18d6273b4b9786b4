"""Plots as pictures for a page: one axes each, as SVG inside the page, so that they stay sharp without other files."""

from __future__ import annotations

import base64
import io
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from macroslip.report.style import legend_above, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Size of a picture [inches]: what a telephone held upright shows without making letters smaller than the text's.
WIDTH, HEIGHT = 4.2, 3.1
#: Size of a picture of a page's opening [inches]: four of them and five sentences fit on one screen.
OPENING_WIDTH, OPENING_HEIGHT = 3.5, 2.55


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """One picture.

    Parameters
    ----------
    source : str
        Data URI.
    words : str
        What it shows, for those who cannot see it.
    width, height : int
        Size in the page [px].
    wide : bool
        Whether it keeps its width where the page is narrower, and is moved sideways in a frame.
    """

    source: str
    words: str
    width: int
    height: int
    wide: bool = False


def picture(
    draw: Callable[[Axes], object],
    words: str,
    *,
    width: float = WIDTH,
    height: float = HEIGHT,
    polar: bool = False,
    legend: str = "",
    wide: bool = False,
) -> Picture:
    """Draw one axes.

    Parameters
    ----------
    draw : callable
        draw(axes), one of the plot functions with its data.
    words : str
        What the picture shows.
    width, height : float
        [inches].
    polar : bool
        Whether the axes are polar.
    legend : str
        "" for none, "above", "below" (one entry a line), or a place inside the axes such as "upper left".
    wide : bool
        Whether the picture keeps its width where the page is narrower.
    """
    import matplotlib

    options = {"subplot_kw": {"projection": "polar"}} if polar else {}
    figure, axes = new_figure(width, height, **options)
    draw(axes[0])
    if legend == "above":
        labels = axes[0].get_legend_handles_labels()[1]
        # Long names do not fit beside each other.
        legend_above(figure, axes[0], ncols=min(len(labels), 3 if sum(map(len, labels)) < 36 else 2))
    elif legend == "below":
        handles, labels = axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", frameon=False, fontsize=9)
    elif legend:
        axes[0].legend(loc=legend, frameon=False, fontsize=9)
    content = io.BytesIO()
    # Names inside the file follow from its content: the same numbers give the same page.
    with matplotlib.rc_context({"svg.hashsalt": "macroslip"}):
        figure.savefig(content, format="svg", metadata={"Date": None}, dpi=160)
    encoded = base64.b64encode(_shorter(content.getvalue())).decode("ascii")
    pixels = (round(96 * width), round(96 * height))
    return Picture(
        source=f"data:image/svg+xml;base64,{encoded}", words=words, width=pixels[0], height=pixels[1], wide=wide
    )


def _shorter(svg: bytes) -> bytes:
    """Without comments and metadata, which a page does not show, and outlines to a hundredth of a point."""
    svg = re.sub(rb"<!--.*?-->|<metadata>.*?</metadata>", b"", svg, flags=re.DOTALL)
    svg = re.sub(rb' d="[^"]*"', lambda outline: re.sub(rb"(\.\d\d)\d+", rb"\1", outline[0]), svg)
    return re.sub(rb"\n\s*", b"\n", svg)
