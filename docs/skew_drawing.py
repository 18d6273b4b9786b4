"""The picture of skew's sign in frames.md; `drawings.py` draws it."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, Polygon

ROLLER, FORCE, MOTION = "#1f5a96", "#7a4b00", "#1b7a3d"


def skewed_rollers() -> Figure:
    """A roller of each row from outside, along its contact normal; the shaft turns forward, and skew is drawn far too large."""
    figure = Figure(figsize=(9.0, 3.4))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0.0, 18.0), ylim=(-3.4, 3.4), aspect="equal")
    axes.axis("off")

    def arrow(start, end, colour, curve=0.0) -> None:
        style = {
            "arrowstyle": "-|>",
            "mutation_scale": 13,
            "color": colour,
            "lw": 1.6,
            "shrinkA": 0,
            "shrinkB": 0,
        }
        axes.add_patch(FancyArrowPatch(start, end, connectionstyle=f"arc3,rad={curve}", **style))

    for middle, sign, row in ((4.6, -1.0, "upwind row"), (12.4, 1.0, "downwind row")):
        angle = sign * math.radians(14.0)
        turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        ends = np.linspace(-1.9, 1.9, 30)
        bulge = 0.95 - 0.06 * ends**2
        outline = np.concatenate([np.stack([ends, bulge], 1), np.stack([ends, -bulge], 1)[::-1]])
        axes.add_patch(Polygon(outline @ turn.T + (middle, 0.0), fc="#dce7f3", ec=ROLLER, lw=1.6))
        tip = turn @ np.array([2.5, 0.0])
        axes.plot(
            [middle - tip[0], middle + tip[0]], [-tip[1], tip[1]], color=ROLLER, lw=1.0, ls="-."
        )
        axes.plot([middle - 2.6, middle + 2.6], [0.0, 0.0], color="0.5", lw=0.9)
        arrow((middle + 2.5, 0.0), (middle + tip[0], tip[1]), ROLLER, sign * 0.2)
        axes.text(
            middle + 2.75, sign * 0.33, "ψ > 0" if sign > 0 else "ψ < 0", color=ROLLER, va="center"
        )
        arrow((middle, -1.2), (middle, -2.5), MOTION)
        axes.text(middle + 0.2, -2.0, "travel", color=MOTION, va="center")
        arrow((middle, 1.6), (middle + sign * 1.8, 1.6), FORCE)
        axes.text(
            middle + sign * 0.9, 1.95, "axial force on the inner ring", color=FORCE, ha="center"
        )
        axes.text(middle, 2.9, row, ha="center", weight="bold")
    arrow((16.2, -2.6), (17.5, -2.6), "black")
    arrow((16.2, -2.6), (16.2, -1.3), "black")
    axes.text(17.6, -2.6, "z'", va="center")
    axes.text(16.2, -1.1, "x", ha="center")
    axes.text(16.4, -3.1, "y' towards the viewer", ha="center", size=8)
    return figure
