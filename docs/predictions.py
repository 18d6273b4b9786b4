"""Numbers of predictions.md: what the program says of quantities that nobody has measured in a main bearing yet.

python docs/predictions.py           # all of it, half an hour of processor time
python docs/predictions.py travel    # or one of: idle, heat, skew
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable

import numpy as np
from skew_kellstroem import FILM, LOADS, rests

from macroslip import Case, HubLoads, Traces, bundled_cases, simulate
from macroslip.constants import ZERO_CELSIUS
from macroslip.result.dataset import axial_values
from macroslip.result.prepared import prepare
from macroslip.torque import skf_torque

ROLLERS = [0, 14]
#: Temperatures of the oil [°C] and oil supplies of the idle rows.
TEMPERATURES = (10.0, 20.0, 35.0, 50.0)
SUPPLIES = ("skf", "flooded", 0.5)


def travel() -> None:
    """Axial travel of the inner ring and reversals of thrust over the wind, and in events."""
    by_wind: dict[str, list[tuple[float, float]]] = {}
    for name in bundled_cases("year"):
        ready = prepare(Case(loads=HubLoads.bundled(name), rollers=[0], rating=False))
        axial = axial_values(ready)
        wind = re.match(r"\d+", name)
        values = (float(axial["axial_travel"]), float(axial["thrust_reversals"]))
        by_wind.setdefault(f"{int(wind[0])} m/s" if wind else name, []).append(values)
    for group, values in by_wind.items():
        ways, reversals = np.transpose(values)
        print(
            f"| {group} | {ways.min():.2f} to {ways.max():.2f} "
            f"| {reversals.min():.0f} to {reversals.max():.0f} |",
            flush=True,
        )


def idle() -> None:
    """Spin of rollers without load over that of pure rolling, and slide-roll ratio at entry."""
    for supply in SUPPLIES:
        for celsius in TEMPERATURES:
            case = Case(
                loads=HubLoads.bundled("14B").window(0.0, 60.0),
                rollers=ROLLERS,
                temperature=celsius + ZERO_CELSIUS,
                oil_supply=supply,
                traces=Traces(step=0.05),
                rating=False,
            )
            result = simulate(case)
            free = result.roller_load == 0.0
            spin = (result.spin / result.spin_pure).where(free).sel(row="upwind")
            entry = result.entry_slide_roll_ratio.sel(row="downwind")
            middle = [float(np.nanquantile(spin, part)) for part in (0.1, 0.5, 0.9)]
            print(
                f"| {supply} | {celsius:g} | {middle[0]:.2f}, {middle[1]:.2f}, {middle[2]:.2f} "
                f"| {float(entry.median()):.2f}, {float(entry.max()):.2f} |",
                flush=True,
            )


def heat() -> None:
    """Friction power of the bearing at 4, 8 and 12 m/s, beside SKF's formula [W]."""
    for supply in SUPPLIES:
        line = []
        for name in ("4B", "8B", "12B"):
            case = Case(
                loads=HubLoads.bundled(name), rollers=ROLLERS, oil_supply=supply, rating=False
            )
            result = simulate(case)
            duration = result.attrs["window_end"] - result.attrs["window_start"]
            scale = case.bearing.rollers_per_row / len(ROLLERS) / duration
            friction = float((result.energy + result.rolling_energy).sum()) * scale
            loads = case.bearing_loads
            radial = np.hypot(loads.force[:, 0], loads.force[:, 1])
            operation = (radial, loads.force[:, 2], loads.shaft_speed)
            skf = skf_torque(case.bearing, case.oil, *operation).total * loads.shaft_speed
            line.append(f"{friction + result.attrs['drag_power']:.0f} ({skf.mean():.0f})")
        print(f"| {supply} |", " | ".join(line), "|", flush=True)


def skew() -> None:
    """Rest of a roller that no spar presses, over load, by the default film."""
    print("load [kN]", (LOADS / 1e3).tolist())
    print("rest [mrad]", np.round(rests(FILM), 2).tolist())


PARTS: dict[str, Callable[[], None]] = {"travel": travel, "idle": idle, "heat": heat, "skew": skew}


if __name__ == "__main__":
    for part in sys.argv[1:] or list(PARTS):
        print(part)
        PARTS[part]()
