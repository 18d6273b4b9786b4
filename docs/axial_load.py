"""Numbers of axial-load.md: what the ratio of axial to radial load does to both rows of a main bearing.

python docs/axial_load.py runs      # axial-load.csv: a line a ratio, temperature and guidance; minutes of a processor
python docs/axial_load.py turbines  # axial-load-turbines.csv: ratios that bundled load cases have, over the wind
python docs/axial_load.py figure    # figures/axial_load.svg, from both tables
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

import matplotlib
import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from macroslip import (
    BearingLoads,
    Case,
    HubLoads,
    Laws,
    Traces,
    Turbine,
    bundled_cases,
    main_bearing_load,
    simulate,
)
from macroslip.constants import ZERO_CELSIUS
from macroslip.result.damage import damage
from macroslip.whole.cage import Cage

DOCS = Path(__file__).parent
RUNS, TURBINES = DOCS / "axial-load.csv", DOCS / "axial-load-turbines.csv"
#: Radial load [N], speed of the shaft [rad/s] and duration [s]: two orbits after the first.
RADIAL = 350e3
SHAFT_SPEED = 2.143
DURATION = 20.0
RATIOS = (0.0, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.75, 1.0, 1.25, 1.5)
TEMPERATURES = (35.0, 60.0)
#: Below this a roller is taken as not pressed [N].
PRESSED = 1.0
SKEWED = Laws.physical().but(skew="quasi-static")
#: What guides the rollers: laws and cage.
GUIDANCE = {
    "straight": (Laws.physical(), Cage()),
    "pressing spar": (SKEWED, Cage()),
    "stop only": (SKEWED, Cage(alignment="none")),
    "stop only, Kellström": (SKEWED.but(traction="kellstroem"), Cage(alignment="none")),
}
#: Turbines with the sets of load cases of theirs, and cases of turbulent production by wind [m/s].
SEATS = {"windpact1.5": "year", "nrel5": "nrel5", "nrel5-rear": "nrel5"}
PRODUCTION = re.compile(r"(?:nrel5-)?(\d+)[ABC]")
PICTURE = DOCS / "figures" / "axial_load.svg"
ROWS = {"downwind": ("#0072b2", "-"), "upwind": ("#d55e00", "--")}
GUIDED = {
    "pressing spar": ("#0072b2", "o", "-"),
    "stop only": ("#d55e00", "s", "--"),
    "stop only, Kellström": ("#009e73", "^", ":"),
}
#: Of the base bearing, from the maker's page.
CATALOGUE_E = 0.30
YEAR = 365.25 * 86400.0
RATIO = "axial / radial load [–]"


def case_of(ratio: float, celsius: float, guidance: str) -> Case:
    """A constant load of a ratio of axial to radial load on the base bearing."""
    laws, cage = GUIDANCE[guidance]
    return Case(
        loads=BearingLoads.constant([0.0, -RADIAL, ratio * RADIAL], SHAFT_SPEED, DURATION),
        temperature=celsius + ZERO_CELSIUS,
        laws=laws,
        cage=cage,
        rollers=[0],
        traces=Traces(step=0.005),
    )


def rows_of(ratio: float, celsius: float, guidance: str) -> list[dict[str, object]]:
    """A line for either row: load, load zone, spin, film, skew, damage; SI units."""
    case = case_of(ratio, celsius, guidance)
    result = simulate(case)
    criteria = damage(result)
    return [
        {
            "ratio": ratio,
            "celsius": celsius,
            "guidance": guidance,
            "row": row,
            **row_quantities(result.sel(row=row), criteria.sel(row=row)),
        }
        for row in result.row.values.tolist()
    ]


def row_quantities(result: xr.Dataset, criteria: xr.Dataset) -> dict[str, float]:
    """The quantities of one row."""
    load = result.roller_load.isel(roller=0)
    inside = load.time >= result.attrs["window_start"]
    load = load.where(inside, drop=True)
    spin = (result.spin / result.spin_pure).isel(roller=0).where(inside, drop=True)
    raceways = result.sel(interface=["inner", "outer"])
    duration = result.attrs["window_end"] - result.attrs["window_start"]
    wear = criteria.wear_time.sel(depth=1e-5, wear_coefficient=1e-17)
    quantities = {
        "mean_load": float(load.mean()),
        "largest_load": float(load.max()),
        "loaded_share": float((load > PRESSED).mean()),
        "least_spin_ratio": float(spin.min()),
        "power": float(raceways.energy.sum()) / duration,
        "film_ratio": float(raceways.min_film_ratio.min()),
        "mixed_share": float(criteria.mixed_time.sel(film_ratio=3.0).max()),
        "thin_share": float(criteria.mixed_time.sel(film_ratio=1.0).max()),
        "slower_share": float(criteria.slower_share.max()),
        "pressure_slip": float(criteria.pressure_slip_rate.max()),
        "wear_time": float(wear.min()),
        "entry_slip": float(result.entry_slide_roll_ratio.max()),
    }
    if "skew_angle" in result:
        skew = result.skew_angle.isel(roller=0).where(inside, drop=True)
        quantities["mean_skew"] = float(skew.mean())
        quantities["largest_skew"] = float(skew.max())
        quantities["least_skew"] = float(skew.min())
        quantities["frictional_thrust"] = float(result.frictional_thrust)
    return quantities


def runs() -> None:
    """Compute all lines of the table."""
    lines = [
        line
        for guidance in GUIDANCE
        for celsius in TEMPERATURES
        for ratio in RATIOS
        for line in rows_of(ratio, celsius, guidance)
    ]
    pd.DataFrame(lines).to_csv(RUNS, index=False, float_format="%.5g")


def turbines() -> None:
    """Median and spread of the ratio at a main bearing, by load case of turbulent production."""
    lines = []
    for name, load_set in SEATS.items():
        seat = Turbine.read(name)
        for label in bundled_cases(load_set):
            wind = PRODUCTION.fullmatch(label)
            if wind is None:
                continue
            at_bearing = main_bearing_load(HubLoads.bundled(label), seat.drivetrain)
            radial = np.hypot(at_bearing.force[:, 0], at_bearing.force[:, 1])
            axial = at_bearing.force[:, 2]
            spread = np.percentile(np.abs(axial) / radial, [5.0, 50.0, 95.0])
            lines.append((name, label, float(wind[1]), radial.mean(), axial.mean(), *spread))
    columns = ["turbine", "case", "wind", "radial", "axial", "low", "median", "high"]
    pd.DataFrame(lines, columns=columns).to_csv(TURBINES, index=False, float_format="%.4g")


def figure() -> None:
    """Ratios of turbines over the wind, and what they do to load, slip, skew, power and wear."""
    matplotlib.rcParams["svg.hashsalt"] = "macroslip"
    runs_of, seats = pd.read_csv(RUNS), pd.read_csv(TURBINES)
    drawing = Figure(figsize=(8.6, 9.4), layout="constrained")
    panels = drawing.subplots(3, 2).ravel()
    straight = runs_of[(runs_of.guidance == "straight") & (runs_of.celsius == 35.0)]
    draw_seats(panels[0], seats)
    for row, (colour, line) in ROWS.items():
        lines = straight[straight.row == row]
        style = {"color": colour, "linestyle": line, "marker": ".", "label": f"{row} row"}
        panels[1].plot(lines.ratio, 1e-3 * lines.mean_load, **style)
        panels[2].plot(lines.ratio, 100.0 * lines.least_spin_ratio, **style)
    panels[1].set(ylabel="mean load of a roller [kN]", title="load")
    panels[2].set(ylabel="lowest spin / rolling [%]", title="slip between load zones")
    draw_guidance(panels[3:5], runs_of, straight)
    draw_wear(panels[5], runs_of)
    for panel in panels[1:]:
        panel.set_xlabel(RATIO)
        panel.axvspan(0.2, 0.25, color="0.85", zorder=0)
    for panel in panels:
        panel.legend(fontsize=8, frameon=False)
        panel.spines[["top", "right"]].set_visible(False)
    drawing.savefig(PICTURE, metadata={"Date": None})


def draw_seats(panel: Axes, seats: pd.DataFrame) -> None:
    """Median of the ratio over the wind, shaded from 5 to 95 % of the time."""
    shown = {"windpact1.5": ("#0072b2", "-"), "nrel5": ("#009e73", "--")}
    for name, (colour, line) in shown.items():
        by_wind = seats[seats.turbine == name].groupby("wind")[["low", "median", "high"]].mean()
        panel.fill_between(by_wind.index, by_wind.low, by_wind.high, color=colour, alpha=0.18)
        panel.plot(by_wind.index, by_wind["median"], color=colour, linestyle=line, label=name)
    panel.axhline(CATALOGUE_E, color="0.3", linewidth=0.8)
    panel.text(24.0, CATALOGUE_E - 0.01, "e of the maker", ha="right", va="top", fontsize=8)
    panel.set(xlabel="wind speed [m/s]", ylabel=RATIO, title="ratio in turbulent wind")


def draw_guidance(panels: np.ndarray, runs_of: pd.DataFrame, straight: pd.DataFrame) -> None:
    """Mean skew of the downwind row, and its power over that of straight rollers."""
    power = straight[straight.row == "downwind"].set_index("ratio").power
    for name, (colour, marker, line) in GUIDED.items():
        lines = runs_of[
            (runs_of.guidance == name) & (runs_of.celsius == 35.0) & (runs_of.row == "downwind")
        ]
        style = {"color": colour, "marker": marker, "linestyle": line, "markersize": 4}
        panels[0].plot(lines.ratio, 1e3 * lines.mean_skew, label=name, **style)
        if name in ("pressing spar", "stop only"):
            added = lines.power.to_numpy() / power[lines.ratio].to_numpy()
            panels[1].plot(lines.ratio, added, label=name, **style)
    panels[0].set(ylabel="mean skew [mrad]", title="skew of the downwind row")
    panels[1].set(ylabel="power / straight rollers", title="what skew costs")


def draw_wear(panel: Axes, runs_of: pd.DataFrame) -> None:
    """Years to 10 µm of wear of the downwind row in mixed film, with and without skew."""
    styles = {"straight": ("0.2", "D", "-"), **GUIDED}
    for name in ("straight", "pressing spar", "stop only"):
        colour, marker, line = styles[name]
        lines = runs_of[
            (runs_of.guidance == name) & (runs_of.celsius == 60.0) & (runs_of.row == "downwind")
        ]
        panel.plot(
            lines.ratio,
            lines.wear_time / YEAR,
            color=colour,
            marker=marker,
            linestyle=line,
            markersize=4,
            label=name,
        )
    panel.set(ylabel="years to 10 µm, k = 1e-17 m²/N", title="wear at 60 °C", ylim=(0.0, None))


if __name__ == "__main__":
    {"runs": runs, "turbines": turbines, "figure": figure}[sys.argv[1]]()
