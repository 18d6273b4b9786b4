"""Section of a bearing, to scale, with the name and value of every dimension."""

from __future__ import annotations

from typing import TYPE_CHECKING

from macroslip.kinds import kind_of
from macroslip.report.style import ROW, program_style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from macroslip.bearing.kinds import AnyBearing


@program_style()
def draw_bearing(bearing: AnyBearing) -> Figure:
    """Draw the section of a bearing above its axis to scale, as its kind has it.

    Parameters
    ----------
    bearing : Bearing or TaperedBearing

    Returns
    -------
    matplotlib.figure.Figure
    """
    from macroslip.report.styled_figure import StyledFigure

    figure = StyledFigure(figsize=(9.6, 6.2))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_aspect("equal")
    axes.axis("off")
    colours = {row: style["color"] for row, style in ROW.items()}
    kind_of(bearing).draw(axes, bearing, colours)
    return figure
