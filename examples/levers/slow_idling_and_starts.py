"""Control as a lever: idling at a tenth of the speed, a turning gear, and starts with half and double the slope.

Speeds and times of bundled loads are scaled and their forces kept: what aerodynamics and controller would change is not in it.
"""

from dataclasses import replace

import numpy as np

from macroslip import Case, HubLoads, Laws, simulate
from macroslip.study.summary import damage_values

idle, start = HubLoads.bundled("idle-25"), HubLoads.bundled("start-8")
slow = replace(idle, shaft_speed=0.1 * idle.shaft_speed)
trials = {"idling": idle, "idling at a tenth of the speed": slow}
parked = HubLoads.bundled("parked-12").window(0.0, 120.0)
turned = np.full_like(parked.shaft_speed, 2.0 * np.pi / 60.0)
trials |= {"parked": parked, "parked, turned at 1 rpm": replace(parked, shaft_speed=turned)}
for name, slope in (
    ("start", 1.0),
    ("start, half the slope", 0.5),
    ("start, double the slope", 2.0),
):
    trials[name] = replace(start, time=start.time / slope)
for name, loads in trials.items():
    result = simulate(Case(loads=loads, laws=Laws.physical()))
    energy = result.energy.sum("interface").mean("roller")
    told = ", ".join(
        f"{row}: {float(energy.sel(row=row)):.3g} J, {3600.0 * float(energy.sel(row=row)) / loads.duration:.3g} J/h, "
        f"{float(result.window_peak_power.sel(row=row).max()):.3g} W"
        for row in result.row.values
    )
    wear = 3600e6 * float(damage_values(result)["wear_rate"].max())
    print(f"{name} ({loads.duration:.0f} s): {told}; wear {wear:.2g} µm/h", flush=True)
