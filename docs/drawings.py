"""Draws the pictures of frames.md, mounts.md and bearings.md, as SVG, into the folder of this file: python docs/drawings.py

The axial view is to scale, and its roller loads are computed with the program.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, FancyArrowPatch, Polygon, Rectangle, Wedge
from mount_drawings import four_point, moment_carrying, three_point
from skew_drawing import skewed_rollers

from macroslip import Bearing, BearingLoads, Case, Laws, Traces, simulate
from macroslip.bearing import geometry
from macroslip.bearing.tapered import TaperedBearing
from macroslip.report.bearing_drawing import draw_bearing

SHAFT, BEARING, FORCE, MOTION, PALE = "#1f5a96", "#b3261e", "#7a4b00", "#1b7a3d", "#e6e6e6"


def new_figure(
    width: float, height: float, x: tuple[float, float], y: tuple[float, float]
) -> tuple:
    """A figure [inches] with one frameless axes of equal scales."""
    figure = Figure(figsize=(width, height))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=x, ylim=y, aspect="equal")
    axes.axis("off")
    return figure, axes


def arrow(axes, start, end, colour, *, style="-|>", width=1.6, curve=0.0) -> None:
    axes.add_patch(
        FancyArrowPatch(
            start,
            end,
            arrowstyle=style,
            mutation_scale=13,
            color=colour,
            lw=width,
            connectionstyle=f"arc3,rad={curve}",
            shrinkA=0,
            shrinkB=0,
            zorder=5,
        )
    )


def text(axes, x, y, words, colour="black", *, size=10, ha="center", va="center") -> None:
    box = {"boxstyle": "round,pad=0.12", "fc": "white", "ec": "none", "alpha": 0.85}
    axes.text(x, y, words, color=colour, size=size, ha=ha, va=va, zorder=6, bbox=box)


def into_page(axes, x, y, colour, radius) -> None:
    """An arrow that points away from the viewer: a crossed circle."""
    axes.add_patch(Circle((x, y), radius, fc="white", ec=colour, lw=1.5, zorder=6))
    d = radius * math.sqrt(0.5)
    for sign in (1, -1):
        axes.plot([x - d, x + d], [y - sign * d, y + sign * d], color=colour, lw=1.3, zorder=7)


def side_view() -> Figure:
    """Hub, main bearing and gearbox, seen along +X0: the wind comes from the left."""
    figure, axes = new_figure(9.4, 4.7, (-2.1, 7.3), (-2.75, 1.95))
    tilt = math.radians(9.0)
    along, up = (
        np.array([math.cos(tilt), -math.sin(tilt)]),
        np.array([math.sin(tilt), math.cos(tilt)]),
    )

    def at(x: float, z: float) -> np.ndarray:
        return x * along + z * up

    def box(x0, x1, z0, z1, **style) -> None:
        axes.add_patch(
            Polygon([at(x0, z0), at(x1, z0), at(x1, z1), at(x0, z1)], closed=True, **style)
        )

    hub, bearing, gearbox = 0.0, 2.1, 5.3
    box(hub, gearbox - 0.35, -0.16, 0.16, fc=PALE, ec="black", lw=1.0)
    box(-0.32, 0.32, -0.38, 0.38, fc="#cfcfcf", ec="black", lw=1.0)
    for sign in (1, -1):
        axes.add_patch(
            Polygon(
                [
                    at(-0.16, sign * 0.38),
                    at(0.16, sign * 0.38),
                    at(0.06, sign * 1.75),
                    at(-0.06, sign * 1.75),
                ],
                closed=True,
                fc="white",
                ec="black",
                lw=1.0,
            )
        )
    for sign in (1, -1):
        box(
            bearing - 0.42,
            bearing + 0.42,
            sign * 0.16,
            sign * 0.28,
            fc="#cfcfcf",
            ec="black",
            lw=0.8,
        )
        box(
            bearing - 0.42,
            bearing + 0.42,
            sign * 0.58,
            sign * 0.72,
            fc="#cfcfcf",
            ec="black",
            lw=0.8,
        )
        for side, colour in ((-1, "white"), (1, "#bcd3ea")):
            centre, lean = (
                at(bearing + side * 0.2, sign * 0.43),
                -sign * side * math.radians(11.2) - tilt,
            )
            a, b = (
                np.array([math.cos(lean), math.sin(lean)]),
                np.array([-math.sin(lean), math.cos(lean)]),
            )
            corners = [
                centre + p * 0.15 * a + q * 0.13 * b
                for p, q in ((-1, -1), (1, -1), (1, 1), (-1, 1))
            ]
            axes.add_patch(Polygon(corners, closed=True, fc=colour, ec="black", lw=1.0, zorder=3))
    box(gearbox - 0.35, gearbox + 0.9, -0.75, 0.75, fc=PALE, ec="black", lw=1.0)
    text(axes, *at(gearbox + 0.28, 0.45), "gearbox")
    text(axes, *at(bearing - 0.55, 1.05), "upwind row", size=9, ha="right")
    text(axes, *at(bearing + 0.75, 1.05), "downwind row", size=9, ha="left")
    for side, x in ((-1, -0.55), (1, 0.75)):
        ends = zip(at(bearing + x, 1.0), at(bearing + side * 0.2, 0.5), strict=True)
        axes.plot(*ends, color="black", lw=0.7, zorder=4)
    # Axes of the loads at the hub, and of the bearing.
    for origin, colour, names, radius in (
        ((hub, 0.0), SHAFT, ("$x_s$", "$z_s$", "$y_s$"), 0.09),
        ((bearing, 0.0), BEARING, ("$Z_0$", "$Y_0$", "$X_0$"), 0.09),
    ):
        start = at(*origin)
        arrow(axes, start, at(origin[0] + 1.05, 0.0), colour, width=2.0)
        arrow(axes, start, at(origin[0], 1.3), colour, width=2.0)
        into_page(axes, *start, colour, radius)
        text(axes, *at(origin[0] + 1.05, 0.3), names[0], colour, size=13)
        text(axes, *at(origin[0] + 0.22, 1.3), names[1], colour, size=13)
        text(axes, *at(origin[0] - 0.3, 0.02), names[2], colour, size=13)
    # Distances, along the shaft.
    for x0, x1, name in (
        (hub, bearing, "$L_h$  hub_to_bearing"),
        (bearing, gearbox, "$L_g$  bearing_to_gearbox"),
    ):
        arrow(axes, at(x0, -1.15), at(x1, -1.15), "black", style="<|-|>", width=1.0)
        text(axes, *at(0.5 * (x0 + x1), -1.37), name)
    for x in (hub, bearing, gearbox):
        low = -0.8 if x != hub else -0.4
        axes.plot(*zip(at(x, low), at(x, -1.25), strict=True), color="black", lw=0.7, ls=":")
    axes.plot(*zip(at(gearbox, -0.75), at(gearbox, -0.95), strict=True), color="black", lw=2)
    # Tilt, wind and gravity.
    axes.plot([0.0, 6.9], [0.0, 0.0], color="black", lw=0.8, ls="--")
    axes.add_patch(Arc((0, 0), 13.2, 13.2, theta1=-math.degrees(tilt), theta2=0, lw=1.0))
    text(axes, 6.72, 0.22, "tilt > 0", size=10)
    for y in (-0.7, 0.0, 0.7):
        arrow(axes, (-2.0, y), (-0.95, y), MOTION)
    text(axes, -1.5, 1.0, "wind", MOTION, size=11)
    arrow(axes, (6.6, -1.45), (6.6, -2.2), FORCE)
    text(axes, 6.6, -2.38, "gravity", FORCE)
    text(
        axes,
        -2.0,
        -2.4,
        "Seen from the side, looking along $+X_0$ (= $+y_s$), which points away from you.\n"
        "Tilt is drawn too large; distances are not to scale.",
        size=9,
        ha="left",
    )
    return figure


def bearing_loads_of_rollers(force_down: float) -> np.ndarray:
    """Load of every downwind roller at its starting place under a static downward force [N]."""
    loads = BearingLoads.constant([0.0, -force_down, 0.0], 2.14, 0.1)
    result = simulate(Case(loads=loads, laws=Laws.paper(), traces=Traces(step=0.1)))
    return result.roller_load.sel(row="downwind").isel(time=0).values


def axial_view() -> Figure:
    """Both rings and the rollers of the downwind row, seen along +Z0."""
    bearing = Bearing.read("skf-240-600-bc")
    pitch, radius = bearing.pitch_radius * 1e3, bearing.roller_diameter * 500.0
    inner, outer = (
        f(bearing) * 1e3 for f in (geometry.inner_contact_radius, geometry.outer_contact_radius)
    )
    figure, axes = new_figure(9.4, 6.9, (-775, 795), (-590, 562))

    # Looking along +Z0 with Y0 up, +X0 points to the left.
    def page(phi: float, distance: float) -> tuple[float, float]:
        return -distance * math.cos(phi), distance * math.sin(phi)

    axes.add_patch(Wedge((0, 0), outer + 28, 0, 360, width=28, fc=PALE, ec="black", lw=0.9))
    axes.add_patch(Wedge((0, 0), inner, 0, 360, width=38, fc=PALE, ec="black", lw=0.9))
    loads = bearing_loads_of_rollers(343.5e3)
    count = bearing.rollers_per_row
    for number, load in enumerate(loads):
        phi = -math.pi / 2 + 2 * math.pi * number / count
        x, y = page(phi, pitch)
        share = load / loads.max()
        colour = (1.0, 1.0 - 0.55 * share, 1.0 - 0.75 * share) if load > 0 else "white"
        axes.add_patch(Circle((x, y), radius, fc=colour, ec="black", lw=0.9, zorder=3))
        axes.text(x, y, str(number), size=9, ha="center", va="center", zorder=4)
    upwind = page(-math.pi / 2 + math.pi / count, pitch)
    axes.add_patch(Circle(upwind, radius, fc="none", ec="black", lw=1.0, ls="--", zorder=4))
    axes.annotate(
        "dashed: roller 0 of the upwind row,\nhalf a pitch further along the orbit",
        (upwind[0], upwind[1] - radius),
        (-755, -520),
        size=9,
        ha="left",
        va="center",
        arrowprops={"arrowstyle": "-", "lw": 0.7, "shrinkB": 0},
        zorder=6,
    )
    # Bearing axes.
    arrow(axes, (0, 0), (-215, 0), BEARING, width=2.0)
    arrow(axes, (0, 0), (0, 215), BEARING, width=2.0)
    into_page(axes, 0, 0, BEARING, 13)
    text(axes, -240, 0, "$X_0$", BEARING, size=13)
    text(axes, 0, 240, "$Y_0$", BEARING, size=13)
    text(axes, 48, -24, "$Z_0$", BEARING, size=13)
    # Angle of roller 11, and its frame.
    phi = -math.pi / 2 + 2 * math.pi * 11 / count
    axes.plot(*zip((0, 0), page(phi, pitch - radius), strict=True), color="black", lw=0.8, ls="--")
    axes.add_patch(Arc((0, 0), 280, 280, theta1=180 - math.degrees(phi), theta2=180, lw=1.2))
    arrow(axes, page(phi - 0.12, 140), page(phi, 140), "black", width=1.2)
    text(axes, *page(phi / 2 + 0.03, 165), r"$\varphi$", size=14)
    origin, outward, along = (
        page(phi, pitch),
        (-math.cos(phi), math.sin(phi)),
        (math.sin(phi), math.cos(phi)),
    )
    tip_y = (origin[0] + 135 * outward[0], origin[1] + 135 * outward[1])
    tip_x = (origin[0] - 135 * along[0], origin[1] - 135 * along[1])
    arrow(axes, origin, tip_y, SHAFT, width=2.0)
    arrow(axes, origin, tip_x, SHAFT, width=2.0)
    text(axes, tip_y[0] - 14, tip_y[1] + 18, "$y$", SHAFT, size=13)
    text(axes, tip_x[0] - 16, tip_x[1] - 16, "$x$", SHAFT, size=13)
    # Motions.
    arrow(axes, page(math.radians(200), 268), page(math.radians(232), 268), MOTION, curve=-0.15)
    text(axes, *page(math.radians(217), 215), r"$\Omega_{in}>0$", MOTION, size=12)
    arrow(axes, page(math.radians(96), 462), page(math.radians(124), 462), MOTION, curve=-0.13)
    text(axes, *page(math.radians(112), 495), r"orbit  $\Omega>0$", MOTION, size=12)
    x, y = page(-math.pi / 2 + 2 * math.pi * 21 / count, pitch)
    angles = np.radians(np.linspace(-150, 60, 40))
    axes.plot(
        x + 25 * np.cos(angles[:-4]), y + 25 * np.sin(angles[:-4]), color=MOTION, lw=1.5, zorder=5
    )
    ends = [(x + 25 * math.cos(a), y + 25 * math.sin(a)) for a in (angles[-7], angles[-1])]
    arrow(axes, *ends, MOTION, width=1.5)
    axes.annotate(
        "the roller turns the other\nway:  spin < 0",
        (x + 22, y - 12),
        (500, -190),
        size=10,
        color=MOTION,
        ha="left",
        arrowprops={"arrowstyle": "-", "lw": 0.7, "color": MOTION},
    )
    # Load and cage force.
    arrow(axes, (0, -30), (0, -170), FORCE, width=2.4)
    text(axes, -12, -130, "$F_{Y0}<0$: weight on\nthe inner ring", FORCE, ha="right")
    text(
        axes,
        -755,
        45,
        "rollers rise: weight\nholds them back,\nthe cage pushes\nfrom behind:\n$cage\\_force > 0$",
        FORCE,
        ha="left",
    )
    text(
        axes,
        500,
        45,
        "rollers descend: weight\npulls them on, the cage\nholds them:\n$cage\\_force < 0$",
        FORCE,
        ha="left",
    )
    text(
        axes,
        450,
        -440,
        "load zone at the bottom:\nthe redder, the more load\n(343.5 kN downward)",
        FORCE,
        ha="left",
    )
    text(
        axes,
        -755,
        520,
        "Seen from the hub, looking downwind along $+Z_0$.\nDownwind row of skf-240-600-bc, to scale.",
        size=9,
        ha="left",
    )
    return figure


def one_roller() -> Figure:
    """One roller at the top of the bearing, seen along +Z0 from the frame that orbits with it."""
    figure, axes = new_figure(9.4, 6.4, (-4.7, 4.7), (-3.2, 3.2))
    radius = 1.15
    axes.add_patch(Circle((0, 0), radius, fc="white", ec="black", lw=1.4))
    axes.add_patch(Wedge((0, -radius - 11), 11, 70, 110, width=0.45, fc=PALE, ec="black", lw=1.0))
    axes.add_patch(Wedge((0, radius - 13), 13.45, 73, 107, width=0.45, fc=PALE, ec="black", lw=1.0))
    text(axes, -3.25, -2.05, "inner ring", size=10)
    text(axes, -2.75, 1.07, "outer ring (at rest)", size=10)
    axes.add_patch(Rectangle((-radius - 0.37, -0.45), 0.3, 0.9, fc="#d9d2c5", ec="black", lw=1.0))
    axes.add_patch(Rectangle((radius + 0.07, -0.45), 0.3, 0.9, fc="#d9d2c5", ec="black", lw=1.0))
    text(axes, -1.33, -0.65, "cage", size=10)
    # Roller frame.
    arrow(axes, (0, 0), (-0.8, 0), SHAFT, width=2.0)
    arrow(axes, (0, 0), (0, 0.72), SHAFT, width=2.0)
    into_page(axes, 0, 0, SHAFT, 0.07)
    for x, y, name in ((-0.72, 0.2, "$x$"), (0.17, 0.68, "$y$"), (0.2, -0.17, "$z$")):
        text(axes, x, y, name, SHAFT, size=13)
    # Motions as they are when the shaft turns forward.
    angles = np.radians(np.linspace(-70, 45, 40))
    axes.plot(0.83 * np.cos(angles[:-2]), 0.83 * np.sin(angles[:-2]), color=MOTION, lw=1.6)
    arrow(
        axes,
        tuple(0.83 * f(angles[-4]) for f in (np.cos, np.sin)),
        tuple(0.83 * f(angles[-1]) for f in (np.cos, np.sin)),
        MOTION,
    )
    text(axes, 0.33, -0.6, r"$\omega<0$", MOTION, size=11)
    arrow(axes, (-1.0, -1.52), (1.0, -1.52), MOTION)
    text(
        axes,
        0.0,
        -1.85,
        "inner surface:  $u_{2,in}=-(\\Omega_{in}-\\Omega)\\,\\tilde r_{in}<0$",
        MOTION,
        size=10,
    )
    arrow(axes, (1.0, 1.5), (-1.0, 1.5), MOTION)
    text(
        axes, 0.0, 1.84, "outer surface:  $u_{2,out}=-\\Omega\\,\\tilde r_{out}<0$", MOTION, size=10
    )
    arrow(axes, (2.1, 2.45), (3.8, 2.45), MOTION)
    text(axes, 2.95, 2.75, r"the roller travels this way  ($\Omega>0$)", MOTION, size=10)
    # Forces on the roller in their positive directions.
    arrow(axes, (0, -radius + 0.05), (-1.35, -radius + 0.05), FORCE, width=2.4)
    text(axes, -1.6, -radius + 0.03, "$F_i$", FORCE, size=13)
    arrow(axes, (0, radius - 0.05), (1.35, radius - 0.05), FORCE, width=2.4)
    text(axes, 1.6, radius - 0.03, "$F_o$", FORCE, size=13)
    arrow(axes, (-radius, 0.0), (-radius, 0.95), FORCE, width=2.4)
    text(axes, -radius - 0.22, 0.78, "$F_c$", FORCE, size=13)
    arrow(axes, (-2.6, 0.0), (-radius - 0.4, 0.0), FORCE, width=2.4)
    text(axes, -3.55, 0.0, "$cage\\_force > 0$\npushes along the orbit", FORCE)
    text(
        axes,
        3.3,
        0.1,
        "A roller that lags ($|\\omega|$ below\npure rolling) has  slip < 0;\n"
        "then $F_i, F_o < 0$ speed it up.\nThe cage brakes it:  $F_c > 0$.",
        "black",
        size=10,
    )
    text(
        axes,
        -4.55,
        -2.8,
        "Roller at the top of the bearing, looking downwind along $+Z_0$, seen from the frame that "
        "orbits with it.\nBrown: forces on the roller in their positive directions.   "
        "Green: motions when the shaft turns forward.",
        size=9,
        ha="left",
    )
    return figure


def bearing_section() -> Figure:
    """Section of the base bearing with the name of every dimension, to scale."""
    return draw_bearing(Bearing.read("skf-240-600-bc"))


def tapered_section() -> Figure:
    """Section of a tapered roller main bearing, with rows, apexes and dimensions, to scale."""
    return draw_bearing(TaperedBearing.read("tdo-main-bearing"))


PICTURES = {
    "tapered-section.svg": tapered_section,
    "frames-side.svg": side_view,
    "frames-axial.svg": axial_view,
    "frames-roller.svg": one_roller,
    "frames-skew.svg": skewed_rollers,
    "bearing.svg": bearing_section,
    "mount-three-point.svg": three_point,
    "mount-four-point.svg": four_point,
    "mount-moment-carrying.svg": moment_carrying,
}


def main(folder: Path) -> None:
    """Write every picture into `folder`."""
    with matplotlib.rc_context({"svg.hashsalt": "macroslip", "mathtext.fontset": "dejavusans"}):
        for name, draw in PICTURES.items():
            path = folder / name
            draw().savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)
            print(f"written: {name}")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
