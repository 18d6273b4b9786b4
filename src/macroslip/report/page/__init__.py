"""A page: its blocks, and the one self-contained HTML file they become."""

from macroslip.report.page.blocks import (
    Beside,
    Block,
    Opening,
    Paragraph,
    Pictures,
    Points,
    Section,
    Statements,
    Table,
    Verbatim,
    View,
)
from macroslip.report.page.render import render

__all__ = [
    "Beside",
    "Block",
    "Opening",
    "Paragraph",
    "Pictures",
    "Points",
    "Section",
    "Statements",
    "Table",
    "Verbatim",
    "View",
    "render",
]
