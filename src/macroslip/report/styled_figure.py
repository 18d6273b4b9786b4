"""A figure that keeps the program's style wherever it is drawn or saved."""

from __future__ import annotations

from typing import Any

from matplotlib.figure import Figure

from macroslip.report.style import program_style


class StyledFigure(Figure):
    """Figure whose ticks, fonts and widths are the program's, whoever draws it."""

    def __init__(self, *arguments: Any, **options: Any):
        with program_style():
            super().__init__(*arguments, **options)

    def draw(self, renderer: Any) -> None:
        """Draw in the program's style: ticks and fonts are found only now."""
        with program_style():
            super().draw(renderer)

    def savefig(self, fname: Any, **options: Any) -> None:
        """Save in the program's style; takes what Matplotlib's own method takes."""
        with program_style():
            super().savefig(fname, **options)
