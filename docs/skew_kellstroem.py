"""Draws skew-kellstroem.svg of skew.md and prints its numbers: which friction guides a roller, and the skew of least power.

python docs/skew_kellstroem.py
"""

from __future__ import annotations

import math
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import TwoSlopeNorm
from matplotlib.figure import Figure

from macroslip import Bearing, Laws, Lubricant
from macroslip.contact.laws import prepare
from macroslip.contact.skewed import constant_friction
from macroslip.roller.skew import Equilibrium, equilibrium, raceways, skew_stop

BASE = Bearing.read("skf-240-600-bc")
OIL = Lubricant.read("vg460-pao")
#: u2 at 20.463 rpm [m/s].
SPEED = -0.39594
STOP = skew_stop(BASE, "conforming-pocket", 0.5e-3).largest
#: Skews up to the stop at which rests are looked for [rad].
SKEWS = 1e-4 * np.sinh(np.linspace(0.0, math.asinh(STOP / 1e-4), 25))
LOADS = np.array([5e3, 1e4, 2e4, 3.5e4, 5e4, 8e4, 1.2e5])
SATURATIONS = np.array([0.0005, 0.001, 0.002, 0.003, 0.005, 0.0075, 0.01, 0.015, 0.02, 0.03, 0.1])
#: Loads of straight rollers whose thrust is kept [N], and the skews tried [rad].
STRAIGHT = np.array([2e4, 3.5e4, 5e4, 8e4])
TRIED = 1e-3 * np.concatenate([np.linspace(-6.6, -2.0, 12)[:-1], np.linspace(-2.0, 1.0, 61)])
#: Contacts without asperities and rolling resistance, whose power is that of the sheared surfaces.
FILM = Laws.physical().but(rolling="none", asperities="none")


def kellstroem(saturation: float, inner: float = 0.05, outer: float = 0.05) -> Laws:
    """Kellström's friction in place of the film's."""
    return FILM.but(
        traction="kellstroem",
        traction_limit_inner=inner,
        traction_limit_outer=outer,
        traction_saturation=saturation,
    )


#: Laws, temperatures [°C] and constant coefficients of friction of the least power.
CHOICES: dict[str, tuple[Laws, float, float | None]] = {
    "constant coefficient .05": (FILM, 35.0, 0.05),
    "Kellström, s0 .001": (kellstroem(0.001), 35.0, None),
    "Kellström, s0 .003": (kellstroem(0.003), 35.0, None),
    "Kellström, s0 .01": (kellstroem(0.01), 35.0, None),
    "Kellström, s0 .03": (kellstroem(0.03), 35.0, None),
    "limiting shear": (FILM.but(rheology="limiting-shear"), 35.0, None),
    "Eyring": (FILM, 35.0, None),
    "Eyring, mixed film, 80 °C": (FILM.but(asperities="masjedi-khonsari"), 80.0, None),
}


def states(
    choice: tuple[Laws, float, float | None], loads: np.ndarray, skews: np.ndarray
) -> list[Equilibrium]:
    """Equilibria at loads [N] and skews [rad], which grow from the first on."""
    laws, celsius, coefficient = choice
    prepared = prepare(laws, BASE, OIL.at(celsius + 273.15), 1)
    shear = None if coefficient is None else constant_friction(coefficient)
    pair = raceways(prepared, BASE, 1, shear)
    equilibria: list[Equilibrium] = []
    for skew in skews:
        start = equilibria[-1] if equilibria else None
        equilibria.append(equilibrium(pair, prepared, loads, SPEED, skew, start))
    return equilibria


def rests(laws: Laws) -> np.ndarray:
    """Where straight rollers that no spar presses turn to, or the stop [mrad], over `LOADS`."""
    sides = [
        np.array([state.moment for state in states((laws, 35.0, None), LOADS, sign * SKEWS)])
        for sign in (1.0, -1.0)
    ]
    result = []
    for k in range(LOADS.size):
        sign = 1.0 if sides[0][0, k] > 0.0 else -1.0
        moment = sign * sides[0 if sign > 0.0 else 1][:, k]
        against = np.flatnonzero(moment <= 0.0)
        angle = STOP
        if against.size:
            n = against[0]
            part = moment[n - 1] / (moment[n - 1] - moment[n])
            angle = SKEWS[n - 1] + part * (SKEWS[n] - SKEWS[n - 1])
        result.append(1e3 * sign * angle)
    return np.array(result)


def power_at_thrust(choice: tuple[Laws, float, float | None]) -> np.ndarray:
    """Power of both raceways at the thrust of a straight roller over that of it, (skews, loads).

    The inner ring passes on the thrust of the normal force less the axial friction, so that a
    roller that pushes against the thrust carries less.
    """
    sine = math.sin(BASE.contact_angle)
    cosine = math.cos(BASE.contact_angle)
    loads = np.broadcast_to(STRAIGHT, (TRIED.size, STRAIGHT.size)).copy()
    skews = np.broadcast_to(TRIED[:, None], loads.shape)
    for _ in range(8):
        at = states(choice, loads, [skews])[0]
        loads = STRAIGHT + at.axial * cosine / sine
    power = at.power.sum(axis=-1)
    straight = states(choice, STRAIGHT, np.zeros(1))[0].power.sum(axis=-1)
    return power / straight


def draw_rests(axes: Axes, values: np.ndarray) -> None:
    """Map of rests over saturation and load."""
    norm = TwoSlopeNorm(0.0, -1e3 * STOP, 1e3 * STOP)
    across = np.arange(LOADS.size)
    upward = np.arange(SATURATIONS.size)
    axes.pcolormesh(across, upward, values, norm=norm, cmap="RdBu_r", shading="nearest")
    for (j, i), value in np.ndenumerate(values):
        at_stop = abs(value) > 0.999e3 * STOP
        dark = abs(float(norm(value)) - 0.5) > 0.3
        axes.text(
            i,
            j,
            "stop" if at_stop else f"{value:.2f}",
            ha="center",
            va="center",
            fontsize=7,
            color="white" if dark else "black",
        )
    axes.set_xticks(across, [f"{load / 1e3:g}" for load in LOADS])
    axes.set_yticks(upward, [f"{saturation:g}" for saturation in SATURATIONS])
    axes.set_xlabel("roller load [kN]")
    axes.set_ylabel("slide-roll ratio at which friction saturates, s0 [-]")
    axes.set_title("skew at rest [mrad], limits .05 and .05", fontsize=10)


def main() -> None:
    """Print rests and least powers, and write the picture beside this file."""
    matplotlib.rcParams["svg.hashsalt"] = "kellstroem"
    figure = Figure(figsize=(11, 4.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    values = np.array([rests(kellstroem(float(saturation))) for saturation in SATURATIONS])
    print("loads [kN]", (LOADS / 1e3).tolist())
    for saturation, line in zip(SATURATIONS, values, strict=True):
        print(f"rest, s0 {saturation:g}", np.round(line, 2).tolist())
    for inner, outer in ((0.04, 0.05), (0.05, 0.04)):
        line = rests(kellstroem(0.01, inner, outer))
        print(f"rest, s0 0.01, limits {inner:g}/{outer:g}", np.round(line, 2).tolist())
    draw_rests(left, values)
    print("least power at fixed thrust: skew [mrad] and change [%] at", (STRAIGHT / 1e3).tolist())
    for name, choice in CHOICES.items():
        power = power_at_thrust(choice)
        least = power.argmin(axis=0)
        change = 100.0 * (power.min(axis=0) - 1.0)
        print(f"| {name} |", " | ".join(
            f"{1e3 * TRIED[n]:.2f}, {percent:.1f}" for n, percent in zip(least, change, strict=True)
        ), "|")  # fmt: skip
        right.plot(1e3 * TRIED, power[:, 1], label=name)
    right.axhline(1.0, color="0.6", linewidth=0.8)
    right.set_xlim(-4.0, 1.0)
    right.set_ylim(0.9, 1.3)
    right.set_xlabel("skew [mrad], favourable side negative")
    right.set_ylabel("power of both raceways / straight")
    right.set_title("at the thrust of a straight roller of 35 kN", fontsize=10)
    right.legend(fontsize=7)
    figure.savefig(Path(__file__).with_name("skew-kellstroem.svg"), metadata={"Date": None})


if __name__ == "__main__":
    main()
