"""Marks of what the paper states, on figures of what was computed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from macroslip.report.style import BLUE

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def mark_wind_speeds(axes: Axes, speeds: tuple[float, ...], words: str) -> Axes:
    """Shade the wind speeds [m/s] at which a statement puts something, and write its words at the foot."""
    axes.axvspan(min(speeds) - 0.8, max(speeds) + 0.8, color=BLUE, alpha=0.10, linewidth=0.0, zorder=-1)
    place = axes.get_xaxis_transform()
    axes.text(min(speeds) - 0.6, 0.02, words, transform=place, va="bottom", fontsize=9, color=BLUE)
    return axes


def mark_level(axes: Axes, low: float, high: float, words: str) -> Axes:
    """Shade the values between which a statement puts something, extend the axis to them, and write its words there."""
    axes.axhspan(low, high, color=BLUE, alpha=0.10, linewidth=0.0, zorder=-1)
    bottom, top = axes.get_ylim()
    axes.set_ylim(min(bottom, 0.8 * low), max(top, 1.25 * high))
    axes.text(
        0.98,
        (low * high) ** 0.5,
        words,
        transform=axes.get_yaxis_transform(),
        ha="right",
        va="center",
        fontsize=9,
        color=BLUE,
    )
    return axes
