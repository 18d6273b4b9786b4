"""Filled areas of a drawing, for tests of sections."""

from matplotlib.colors import to_rgba
from matplotlib.patches import Polygon


def outlines(figure, colour):
    """Corners of the filled areas of a colour [mm]."""
    return [
        patch.get_xy()
        for patch in figure.axes[0].patches
        if isinstance(patch, Polygon) and patch.get_facecolor() == to_rgba(colour)
    ]
