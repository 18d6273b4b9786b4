"""Free bodies of the shaft on its mounts, for drawings.py."""

from __future__ import annotations

from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, Polygon, Rectangle

SHAFT, SUPPORT, WEIGHT, PALE = "#1f5a96", "#b3261e", "#7a4b00", "#e6e6e6"


@dataclass(frozen=True)
class Support:
    """A support of the shaft at x, and the forces of the shaft on it."""

    x: float
    name: str
    force: str
    thrust: str = ""


def three_point() -> Figure:
    """One main bearing and the gearbox."""
    figure, axes = _canvas(
        "Three-point mount: one main bearing, and the gearbox on its torque arms"
    )
    _rotor(axes)
    _gearbox(axes, 6.0, "gearbox:\ntorque and forces\nacross the shaft", supported=True)
    _support(axes, Support(2.2, "main bearing", "$F_{Y0}$", "$F_{Z0} = f_x + W\\,\\sin(tilt)$"))
    _force(axes, 6.0, "$f_z - W\\,\\cos(tilt) - F_{Y0}$")
    _weight(axes, 3.6)
    _length(axes, 0.0, 2.2, "$h$  hub_to_bearing")
    _length(axes, 2.2, 6.0, "$b$  bearing_to_gearbox")
    return figure


def four_point() -> Figure:
    """Two main bearings, of which one is locating."""
    figure, axes = _canvas(
        "Four-point mount: two main bearings, drawn with  locating: rear;  the gearbox takes torque only"
    )
    _rotor(axes)
    _gearbox(axes, 7.0, "gearbox:\ntorque only", supported=False)
    _support(axes, Support(1.8, "front\nfloats along the shaft", "$F_{Y0}$, front"))
    _support(
        axes,
        Support(
            5.2,
            "rear\nlocating",
            "$f_z - W\\,\\cos(tilt) - F_{Y0}$",
            "$F_{Z0} = f_x + W\\,\\sin(tilt)$",
        ),
    )
    _weight(axes, 3.3)
    _length(axes, 0.0, 1.8, "$h$  hub_to_bearing")
    _length(axes, 1.8, 5.2, "$b$  front_to_rear")
    return figure


def moment_carrying() -> Figure:
    """A front that holds the shaft against tilting, and a rear bearing that is simulated."""
    figure, axes = _canvas(
        "Four-point mount with  front: moment-carrying, locating: front;  the gearbox takes torque only",
        "Seen along $+X_0$, shaft drawn level. Blue: loads of the rotor. Red: loads of the shaft on its supports; minus "
        "them act on the shaft.\nRear bearing:  $F_{X0} = (1-\\lambda)\\,M_z/b$,   $F_{Y0} = -(1-\\lambda)\\,M_y/b$,   with "
        "$M_y = m_y + h\\,f_z + (s-h)\\,W\\,\\cos(tilt)$,   $M_z = m_z - h\\,f_y$.",
    )
    _rotor(axes)
    _gearbox(axes, 7.0, "gearbox:\ntorque only", supported=False)
    _support(
        axes,
        Support(
            1.8,
            "front, a pair\nlocating",
            "what the rear leaves",
            "$F_{Z0} = f_x + W\\,\\sin(tilt)$",
        ),
    )
    axes.add_patch(
        FancyArrowPatch(
            (1.4, -0.45), (1.4, 0.45), arrowstyle="-|>", mutation_scale=13, color=SUPPORT, lw=1.6,
            connectionstyle="arc3,rad=-0.5",
        )
    )  # fmt: skip
    _text(axes, 0.75, -0.62, "$\\lambda\\,M_y$", SUPPORT, size=12)
    _support(axes, Support(5.2, "rear\nsimulated", "$-(1-\\lambda)\\,M_y/b$"))
    _weight(axes, 3.3)
    _length(axes, 0.0, 1.8, "$h$  hub_to_bearing")
    _length(axes, 1.8, 5.2, "$b$  front_to_rear")
    return figure


_FIRST_SUPPORT = (
    "Seen along $+X_0$, shaft drawn level. Blue: loads of the rotor. Red: loads of the shaft on its supports; minus "
    "them act on the shaft.\nFirst support:  $F_{X0} = (a\\,f_y - m_z)/b$,   "
    "$F_{Y0} = (a\\,f_z + m_y - (a - s)\\,W\\,\\cos(tilt))/b$,   $a = h + b$."
)


def _canvas(title: str, formulas: str = "") -> tuple[Figure, Axes]:
    figure = Figure(figsize=(9.4, 4.6))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(-2.2, 8.6), ylim=(-3.2, 2.1), aspect="equal")
    axes.axis("off")
    axes.add_patch(Rectangle((0.0, -0.14), 6.6, 0.28, fc=PALE, ec="black", lw=1.0))
    axes.text(-2.0, 1.85, title, size=11, va="center")
    axes.text(-2.0, -2.95, formulas or _FIRST_SUPPORT, size=9, va="center")
    return figure, axes


def _arrow(
    axes: Axes,
    start: tuple[float, float],
    end: tuple[float, float],
    colour: str,
    style: str = "-|>",
) -> None:
    axes.add_patch(
        FancyArrowPatch(
            start,
            end,
            arrowstyle=style,
            mutation_scale=13,
            color=colour,
            lw=2.0,
            shrinkA=0,
            shrinkB=0,
            zorder=5,
        )
    )


def _text(
    axes: Axes, x: float, y: float, words: str, colour: str = "black", **style: str | float
) -> None:
    box = {"boxstyle": "round,pad=0.12", "fc": "white", "ec": "none", "alpha": 0.85}
    axes.text(
        x,
        y,
        words,
        color=colour,
        zorder=6,
        bbox=box,
        **{"ha": "center", "va": "center", "size": 10} | style,
    )


def _rotor(axes: Axes) -> None:
    axes.add_patch(
        Rectangle((-0.28, -0.38), 0.56, 0.76, fc="#cfcfcf", ec="black", lw=1.0, zorder=3)
    )
    _arrow(axes, (-1.7, 0.0), (-0.32, 0.0), SHAFT)
    _text(axes, -1.1, 0.27, "$f_x$", SHAFT, size=13)
    _arrow(axes, (0.0, 0.42), (0.0, 1.25), SHAFT)
    _text(axes, 0.28, 1.15, "$f_z$", SHAFT, size=13)
    axes.add_patch(
        FancyArrowPatch(
            (-0.62, -0.5), (-0.62, 0.5), arrowstyle="-|>", mutation_scale=13, color=SHAFT, lw=1.6,
            connectionstyle="arc3,rad=-0.5",
        )
    )  # fmt: skip
    _text(axes, -1.0, -0.62, "$m_y$", SHAFT, size=13)


def _support(axes: Axes, support: Support) -> None:
    for side in (1, -1):
        axes.add_patch(
            Rectangle(
                (support.x - 0.2, side * 0.29 - 0.13), 0.4, 0.26, fc="#bcd3ea", ec="black", zorder=3
            )
        )
    foot = [(support.x, -0.42), (support.x - 0.28, -0.8), (support.x + 0.28, -0.8)]
    axes.add_patch(Polygon(foot, closed=True, fc="white", ec="black", lw=1.2))
    axes.plot([support.x - 0.42, support.x + 0.42], [-0.8, -0.8], color="black", lw=1.6)
    _text(axes, support.x, -1.12 - 0.14 * support.name.count("\n"), support.name)
    _force(axes, support.x, support.force)
    if support.thrust:
        _arrow(axes, (support.x + 0.25, 0.62), (support.x + 1.15, 0.62), SUPPORT)
        _text(axes, support.x + 1.2, 0.62, support.thrust, SUPPORT, ha="left")


def _force(axes: Axes, x: float, words: str) -> None:
    _arrow(axes, (x, 0.45), (x, 1.25), SUPPORT)
    _text(axes, x, 1.45, words, SUPPORT)


def _weight(axes: Axes, x: float) -> None:
    _arrow(axes, (x, 0.0), (x, -1.0), WEIGHT)
    axes.plot([x], [0.0], "o", color=WEIGHT, ms=6, zorder=6)
    _text(axes, x, -1.2, "$W$, at $s$", WEIGHT)


def _gearbox(axes: Axes, x: float, words: str, *, supported: bool) -> None:
    axes.add_patch(Rectangle((x - 0.4, -0.6), 1.2, 1.0, fc=PALE, ec="black", lw=1.0, zorder=3))
    _text(axes, x + 0.2, -1.05, words, size=9, va="top")
    if supported:
        axes.plot([x - 0.3, x + 0.3], [-0.75, -0.75], color="black", lw=1.6)
        axes.plot([x, x], [-0.6, -0.75], color="black", lw=1.6)


def _length(axes: Axes, start: float, end: float, name: str) -> None:
    for x in (start, end):
        axes.plot([x, x], [-1.5, -2.1], color="black", lw=0.7, ls=":")
    _arrow(axes, (start, -2.0), (end, -2.0), "black", style="<|-|>")
    _text(axes, 0.5 * (start + end), -2.25, name)
