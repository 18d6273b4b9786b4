"""Numbers of housing.md: what the shape of the outer raceway does to slip, damage and life.

python docs/housing_study.py runs      # appends a line a shape to housing.csv, an hour; goes on where it was stopped
python docs/housing_study.py figure    # figures/housing.svg and the table, from housing.csv
python docs/housing_study.py lives     # life, largest load and entries by phase, over all of the load cases
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from macroslip import Bearing, Case, Drivetrain, HubLoads, Lubricant, main_bearing_load, simulate
from macroslip.rating import rate, roller_load_history
from macroslip.result.damage import damage
from macroslip.result.rating import rate_case

BASE = Bearing.read("skf-240-600-bc")
OIL = Lubricant.read("vg460-pao")
TABLE = Path(__file__).with_name("housing.csv")
CASES = ("12B", "24B")
#: End of the loads [s] and rollers of either row.
DURATION = 80.0
ROLLERS = [0, 14]
AMPLITUDES = (25e-6, 50e-6, 100e-6)
#: Angles of a widest place [deg] by number of waves; half a wave apart a wave changes its sign.
ANGLES = {2: (0.0, 45.0, 90.0, 135.0), 3: (30.0, 60.0, 90.0)}
QUANTITIES = {
    "energy": "raceway energy, downwind / round",
    "peak": "largest power / round",
    "entries": "entries into load zones [1/s]",
    "film": "least film in an orbit / round",
    "pressure_slip": "e_a / round",
    "wear": "deepest wear a second / round",
    "life": "life, ISO/TS 16281 / round",
}


class Shape(NamedTuple):
    """Waves of the radial clearance."""

    waves: int  #: Crests round the ring
    amplitude: float  #: [m]
    angle: float  #: Where a crest is widest, from the horizontal [deg]

    def bearing(self) -> Bearing:
        """The base bearing with this outer raceway."""
        if not self.amplitude:
            return BASE
        name = "out_of_round_second" if self.waves == 2 else "out_of_round_third"
        angle = math.radians(self.angle)
        return BASE.replace(**{name: self.amplitude, "out_of_round_angle": angle})


def shapes() -> Iterator[Shape]:
    """The round raceway first, then both waves at all amplitudes and angles."""
    yield Shape(2, 0.0, 0.0)
    for waves, angles in ANGLES.items():
        for amplitude in AMPLITUDES:
            for angle in angles:
                yield Shape(waves, amplitude, angle)


def quantities(name: str, shape: Shape) -> dict[str, float]:
    """The quantities of a load case with a shape of the raceway, in SI units."""
    loads = HubLoads.bundled(name).window(0.0, DURATION)
    case = Case(loads=loads, bearing=shape.bearing(), rollers=ROLLERS)
    result = simulate(case)
    life = rate_case(case).reference_life.sel(load_along_roller="hertz")
    criteria = damage(result)
    raceways = ["inner", "outer"]
    energy = result.energy.sel(row="downwind", interface=raceways)
    film = result.min_film_ratio.sel(row="downwind", interface="inner")
    wear = criteria.wear_time.sel(depth=1e-5).min(("row", "surface"))
    return {
        "energy": float(energy.sum()),
        "peak": float(result.window_peak_power.sel(interface=raceways).max()),
        "entries": float(criteria.entry_rate.sum()),
        "film": float(film.median()),
        "pressure_slip": float(criteria.pressure_slip_rate.max()),
        "wear": 1.0 / float(np.ravel(wear)[wear.size // 2]),
        "life": float(life),
    }


def runs() -> None:
    """Compute what the table lacks, and append it line by line."""
    known = pd.read_csv(TABLE) if TABLE.exists() else pd.DataFrame(columns=["case"])
    done = set()
    if len(known):
        keys = ["case", "waves", "amplitude", "angle"]
        done = {tuple(row) for row in known[keys].itertuples(index=False)}
    for shape in shapes():
        for name in CASES:
            if (name, *shape) in done:
                continue
            row = {"case": name, **shape._asdict(), **quantities(name, shape)}
            pd.DataFrame([row]).to_csv(TABLE, mode="a", header=not TABLE.exists(), index=False)
            print(row, flush=True)


def relative() -> pd.DataFrame:
    """The table over the round raceway, case by case; entries as they are, since it may have none."""
    table = pd.read_csv(TABLE)
    columns = [name for name in QUANTITIES if name != "entries"]
    round_ones = table[table.amplitude == 0.0].set_index("case")
    table[columns] = table[columns] / round_ones.loc[table.case, columns].to_numpy()
    return table


def draw(axes: Axes, table: pd.DataFrame, name: str) -> None:
    """A quantity over amplitude, a line for every phase: full for two waves, dashed for three."""
    phases = {2: ("C0", "C1", "C2", "C3"), 3: ("C4", "C5", "C6")}
    for waves, angles in ANGLES.items():
        for angle, colour in zip(angles, phases[waves], strict=True):
            alike = (table.waves == waves) & (table.angle == angle)
            means = table[alike | (table.amplitude == 0.0)].groupby("amplitude")[name].mean()
            axes.plot(
                1e6 * means.index.to_numpy(),
                means.to_numpy(),
                color=colour,
                linestyle="-" if waves == 2 else "--",
                label=f"{waves} waves, widest at {angle:g}°",
            )
    axes.set_title(QUANTITIES[name], fontsize=9)
    axes.tick_params(labelsize=8)
    if name != "entries":
        axes.axhline(1.0, color="0.7", linewidth=0.8)


def figure() -> None:
    """Draw the picture and print the table."""
    matplotlib.rcParams["svg.hashsalt"] = "housing"
    table = relative()
    drawn = Figure(figsize=(11, 5.6), layout="constrained")
    axes = drawn.subplots(2, 4).ravel()
    for panel, name in zip(axes, QUANTITIES, strict=False):
        draw(panel, table, name)
        panel.set_xlabel("amplitude [µm]", fontsize=8)
    handles, labels = axes[0].get_legend_handles_labels()
    axes[-1].axis("off")
    axes[-1].legend(handles, labels, fontsize=8, loc="center")
    folder = Path(__file__).parent / "figures"
    drawn.savefig(folder / "housing.svg", metadata={"Date": None})
    for shape, rows in table[table.amplitude > 0.0].groupby(["waves", "amplitude", "angle"]):
        waves, amplitude, angle = shape
        cells = [
            " / ".join(f"{value:.2f}" for value in rows.sort_values("case")[name])
            for name in QUANTITIES
        ]
        print(f"| {waves:g} | {1e6 * amplitude:g} | {angle:g}° |", " | ".join(cells), "|")


def lives() -> None:
    """Life, largest load of a roller and loaded share of the downwind row by phase, over that of the round ring."""
    for name in CASES:
        loads = main_bearing_load(HubLoads.bundled(name), Drivetrain())
        reference = None
        for shape in shapes():
            history, load = roller_load_history(shape.bearing(), OIL, loads)
            rating = rate(shape.bearing(), OIL, history, load)
            values = np.array(
                [
                    float(rating.reference_life.sel(load_along_roller="hertz")),
                    float(load.max()),
                    float((load[0] > 0.0).mean()),
                ]
            )
            reference = values if reference is None else reference
            print(name, tuple(shape), np.round(values / reference, 2).tolist(), flush=True)


if __name__ == "__main__":
    {"runs": runs, "figure": figure, "lives": lives}[sys.argv[1]]()
