"""Where wear is nil: the lines of pure rolling of a curved contact in boundary lubrication.

In spherical roller thrust bearings that ran in boundary lubrication the raceways were worn but for two places along the
contact, the lines of pure rolling (Olofsson 1997, abstract). The program puts its lines where v(ζ) vanishes,
v = Δu + κ ζ²/(2 R_d) − s ζ, and Δu is such that friction turns the roller neither faster nor slower. With one coefficient
all over and no tilt that is an exact number: half of the load lies between the lines, x³ − 3x + 1 = 0, x = 2 sin 10° = 0.347
of the contact's half length.

Neither bearing nor load of those tests is public in numbers. Assumed is an asymmetrical roller whose axis meets the
bearing's where the raceway's tangent does, but for an error of the cone's angle: this alone leaves a spin s.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from macroslip.contact.asperities import FULL_SLIP, asperity_patch
from macroslip.contact.patch import rolling_lines
from validation.comparison import Comparison, Range

#: Half length of the contact, contour radius, roller radius and pitch radius [m] of a bearing of 60 mm bore; assumed.
HALF, CONTOUR, RADIUS, PITCH = 8e-3, 60e-3, 9e-3, 47e-3
#: Speed of the raceway past the contact [m/s]. Fast enough for asperities to slide all over: lines do not depend on it then.
SPEED = 20.0
#: Spin over raceway speed and curvature's κ, as angle between roller axis and its ideal direction [rad].
ERRORS = np.radians([0.0, 1.0, 2.0, 3.0])
EXACT = 2.0 * math.sin(math.radians(10.0))


def lines(error: float) -> tuple[float, float]:
    """Places of pure rolling over the half length of the contact, from Δu at which friction adds up to nothing."""
    bend = SPEED * (1.0 / RADIUS + math.cos(math.radians(50.0)) / PITCH) / (2.0 * CONTOUR)
    spin = SPEED * math.sin(error) / RADIUS

    def force(slip: float) -> float:
        return float(asperity_patch(1.0, FULL_SLIP, HALF, HALF, slip, bend, spin)[0])

    most = bend * HALF**2 + abs(spin) * HALF
    slip = brentq(force, -most, most, xtol=1e-14)
    first, second = rolling_lines(bend, spin, slip, HALF)
    return first / HALF, second / HALF


def wear(error: float, position: np.ndarray) -> np.ndarray:
    """Pressure times |v| along the contact in units of its own, which Archard's law takes for wear."""
    first, second = lines(error)
    return (1.0 - position**2) * np.abs((position - first) * (position - second))


def compare() -> list[Comparison]:
    """The lines of the table."""
    lines_of_errors = np.array([lines(error) for error in ERRORS])
    inside = int(np.sum(np.abs(lines_of_errors[0]) < 1.0))
    return [
        Comparison(
            "places of nil wear along a contact in boundary lubrication", Range(2.0, 2.0), Range(inside, inside),
            Range(0.5 * inside, 0.5 * inside), "microslip by curvature; a roller's cone is off by less than 4° (assumed geometry), beyond which one line leaves the contact",
        ),
    ]  # fmt: skip


def draw(path: Path) -> None:
    """Wear along the contact."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6, 3.2), layout="constrained")
    axis = figure.subplots()
    position = np.linspace(-1.0, 1.0, 801)
    for error in ERRORS:
        axis.plot(position, wear(error, position), label=f"cone off by {math.degrees(error):.0f}°")
    axis.set(
        xlabel="place along the contact, over its half length",
        ylabel="p |v| [own unit]",
        ylim=(0.0, None),
    )
    axis.legend(fontsize="x-small")
    figure.savefig(path, dpi=110)
