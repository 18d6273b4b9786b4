"""A figure that keeps the program's style wherever it is drawn or saved."""

from __future__ import annotations

from typing import Any

from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from macroslip.report.style import program_style


class StyledFigure(Figure):
    """Figure whose ticks, fonts and widths are the program's, whoever draws it."""

    def __init__(self, *arguments: Any, **options: Any):
        with program_style():
            super().__init__(*arguments, **options)

    def draw(self, renderer: Any) -> None:
        """Draw in the program's style: ticks and fonts are found only now.

        Matplotlib saves a figure that has a layout in two passes: the first draws nothing and only
        finds the layout, which is switched off for the second. The first would go through all that
        is drawn nevertheless, a sixth of what a picture takes.
        """
        layout = self.get_layout_engine()
        with program_style():
            if self.canvas.is_saving() and isinstance(layout, ConstrainedLayoutEngine):
                layout.execute(self)
            else:
                super().draw(renderer)

    def savefig(self, fname: Any, **options: Any) -> None:
        """Save in the program's style; takes what Matplotlib's own method takes."""
        with program_style():
            super().savefig(fname, **options)
