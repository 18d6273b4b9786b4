"""Colours and captions that the drawings of all kinds of bearings share."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from macroslip.bearing.kinds import AnyBearing

STEEL = "#e6e6e6"
ROLLER = "#bcd3ea"
LINE = "#1f5a96"
#: Distance of lines in a column over the outside radius of the bearing.
_LINE_DISTANCE = 0.075


def caption(bearing: AnyBearing, key: str) -> str:
    """Name and value of a dimension, with the tag of its source.

    Examples
    --------
    >>> from macroslip import Bearing
    >>> caption(Bearing.read("skf-240-600-bc"), "bore_diameter")
    'bore_diameter = 600 mm (V)'
    """
    return f"{key} = {bearing.written(key)} ({bearing.provenance[key].tag})"


def write_column(
    axes: Axes, lines: Iterable[str], side: int, reach: float, first: float, outside: float
) -> None:
    """Write lines below each other at the left or right edge of a drawing.

    Parameters
    ----------
    axes : Axes
    lines : iterable of str
        From the top.
    side : int
        -1 at the left edge, 1 at the right one.
    reach : float
        Distance of the edges from the middle [mm].
    first : float
        Height of the first line above the bearing's axis over `outside` [-].
    outside : float
        Outside radius of the bearing [mm].
    """
    alignment = "left" if side < 0 else "right"
    for number, line in enumerate(lines):
        height = (first - _LINE_DISTANCE * number) * outside
        axes.text(side * 0.97 * reach, height, line, ha=alignment, va="center", fontsize=9)
