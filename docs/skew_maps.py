"""Draws skew-maps.svg of skew.md: the rest of a roller, its power and axial force over osculation, load and film.

python docs/skew_maps.py
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import NamedTuple

import matplotlib
import numpy as np
from matplotlib.colors import TwoSlopeNorm
from matplotlib.figure import Figure

from macroslip import Bearing, BearingLoads, Case, Laws, Lubricant, simulate
from macroslip.contact.laws import prepare
from macroslip.roller.skew import equilibrium, raceways, skew_stop

BASE, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
#: u2 at 20.463 rpm [m/s], load of the maps over osculation [N], and skews [rad] up to the stop of a pocket with 0.5 mm play.
SPEED, LOAD = -0.39594, 40e3
STOP = skew_stop(BASE, "conforming-pocket", 0.5e-3).largest
SKEWS = 2e-4 * np.sinh(np.linspace(0.0, np.arcsinh(STOP / 2e-4), 13))
INNER, OUTER = np.linspace(0.96, 0.985, 5), np.linspace(0.96, 0.985, 5)
#: Of the last map: radial load [N], F_a/F_r, and speeds of the shaft [rpm].
RADIAL, RATIOS, SPEEDS = (
    300e3,
    np.array([0.1, 0.2, 0.35, 0.5, 0.75, 1.0, 1.5]),
    np.array([3.0, 6.0, 10.0, 15.0, 20.463]),
)
LOADS, TEMPERATURES = np.geomspace(5e3, 120e3, 9), np.linspace(20.0, 90.0, 6)
PHYSICAL = Laws.physical()
ROWS = {
    "Eyring, 35 °C": (PHYSICAL, 35.0),
    "limiting shear, 35 °C": (PHYSICAL.but(rheology="limiting-shear"), 35.0),
    "Eyring, mixed film, 80 °C": (PHYSICAL, 80.0),
}


class Rest(NamedTuple):
    """Where a straight roller turns to: skew [mrad], power over that without skew, axial force over load [%]."""

    skew: np.ndarray
    power: np.ndarray
    axial: np.ndarray


def rest(bearing: Bearing, laws: Laws, celsius: float, load: np.ndarray) -> Rest:
    """The rests of rollers of the downwind row that no spar presses on; the shaft turns forward."""
    prepared = prepare(laws, bearing, OIL.at(celsius + 273.15), 1)
    pair, equilibria, last = raceways(prepared, bearing, 1), [], None
    both = np.array([-1.0, 1.0])[:, None]
    for skew in SKEWS:
        last = equilibrium(pair, prepared, load, SPEED, both * skew, last)
        equilibria.append(np.stack([last.moment, last.power.sum(axis=-1), last.axial], axis=-1))
    moment, power, axial = np.moveaxis(np.array(equilibria), -1, 0)  # each over (skew, side, load)
    columns = []
    for k in range(load.size):
        side = int(moment[0, 1, k] > 0.0)
        sign = 2 * side - 1
        against = np.flatnonzero(sign * moment[:, side, k] <= 0.0)
        angle = STOP
        if against.size:
            n = against[0]
            before, behind = moment[n - 1 : n + 1, side, k]
            angle = SKEWS[n - 1] + (SKEWS[n] - SKEWS[n - 1]) * before / (before - behind)
        here = [np.interp(angle, SKEWS, values[:, side, k]) for values in (power, axial)]
        columns.append((1e3 * sign * angle, here[0] / power[0, side, k], 100.0 * here[1] / load[k]))
    return Rest(*np.array(columns).T)


def over_osculation(laws: Laws, celsius: float) -> Rest:
    """Over outer and inner osculation."""
    lines = [
        [
            rest(
                BASE.replace(osculation_inner=float(i), osculation_outer=float(o)),
                laws,
                celsius,
                np.array([LOAD]),
            )
            for i in INNER
        ]
        for o in OUTER
    ]
    return Rest(
        *(
            np.array([[getattr(of_bearing, name)[0] for of_bearing in line] for line in lines])
            for name in Rest._fields
        )
    )


def over_load() -> Rest:
    """Over temperature and load, with the base bearing under Eyring's law."""
    lines = [rest(BASE, PHYSICAL, celsius, LOADS) for celsius in TEMPERATURES]
    return Rest(*(np.array([getattr(line, name) for line in lines]) for name in Rest._fields))


def over_thrust() -> Rest:
    """Over the shaft's speed and F_a/F_r: means over a case's downwind row, whose rollers spars press; the force over F_a."""
    lines = []
    for rpm in SPEEDS:
        speed = rpm * np.pi / 30.0
        line = []
        for ratio in RATIOS:
            loads = BearingLoads.constant(
                [0.0, -RADIAL, ratio * RADIAL], speed, 3.0 * 2.0 * np.pi / (0.454 * speed)
            )
            result = simulate(
                Case(
                    loads=loads,
                    rollers=[0],
                    laws=PHYSICAL.but(skew="quasi-static"),
                    contact_details=False,
                ),
            ).sel(row="downwind")
            energy, added = float(result.energy[0, :2].sum()), float(result.skew_energy.sum())
            thrust = float(result.frictional_thrust) / (ratio * RADIAL)
            line.append(
                (
                    1e3 * float(result.skew_by_position.mean()),
                    energy / (energy - added),
                    100.0 * thrust,
                )
            )
        lines.append(line)
    return Rest(*np.moveaxis(np.array(lines), -1, 0))


def draw(axes, x, y, maps: Rest, labels: tuple[str, str]) -> None:
    """Three maps."""
    norms = (
        TwoSlopeNorm(0.0, -1e3 * STOP, 1e3 * STOP), TwoSlopeNorm(1.0, 0.7, 2.0), TwoSlopeNorm(0.0, -2.0, 2.0),
    )  # fmt: skip
    for panel, values, norm, text in zip(axes, maps, norms, ("%.1f", "%.2f", "%.1f"), strict=True):
        panel.pcolormesh(x, y, values, norm=norm, cmap="RdBu_r", shading="nearest")
        for (j, i), value in np.ndenumerate(values):
            dark = abs(float(norm(value)) - 0.5) > 0.3
            panel.text(
                x[i],
                y[j],
                text % value,
                ha="center",
                va="center",
                fontsize=6.5,
                color="white" if dark else "black",
            )
        panel.set_xlabel(labels[0], fontsize=8)
        panel.set_ylabel(labels[1], fontsize=8)
        panel.tick_params(labelsize=7)


def main() -> None:
    """Print the maps and write the picture beside this file."""
    matplotlib.rcParams["svg.hashsalt"] = "skew"
    figure = Figure(figsize=(11, 16), layout="constrained")
    axes = figure.subplots(5, 3)
    for line, (name, (laws, celsius)) in zip(axes, ROWS.items(), strict=False):
        maps = over_osculation(laws, celsius)
        draw(line, INNER, OUTER, maps, ("inner osculation", f"{name}\nouter osculation"))
        print(name, np.round(maps.skew, 2).tolist(), flush=True)
    maps = over_load()
    draw(
        axes[3],
        LOADS / 1e3,
        TEMPERATURES,
        maps,
        ("load [kN]", "Eyring, .98/.98\ntemperature [°C]"),
    )
    for panel in axes[3]:
        panel.set_xscale("log")
    print("over load", np.round(maps.skew, 2).tolist())
    maps = over_thrust()
    labels = ("axial over radial load", "Eyring, a spar presses\nspeed [rpm]")
    draw(axes[4], np.arange(RATIOS.size), np.arange(SPEEDS.size), maps, labels)
    for panel in axes[4]:
        panel.set_xticks(np.arange(RATIOS.size), [f"{x:g}" for x in RATIOS])
        panel.set_yticks(np.arange(SPEEDS.size), [f"{x:.3g}" for x in SPEEDS])
    print("over thrust", *(np.round(values, 3).tolist() for values in maps), sep="\n")
    for panel, title in zip(
        axes[0],
        ("skew at rest [mrad]", "power / power without skew", "axial force / load [%]"),
        strict=True,
    ):
        panel.set_title(title, fontsize=9)
    figure.savefig(Path(__file__).with_name("skew-maps.svg"), metadata={"Date": None})


if __name__ == "__main__":
    sys.exit(main())
