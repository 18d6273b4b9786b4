"""One roller under a constant downward load: it coasts through the unloaded top and is caught again at the bottom.

python examples/01_constant_load.py
"""

import numpy as np

from macroslip import BearingLoads, Case, Traces, simulate

# 343.5 kN downward on the inner ring and no thrust, at the rated speed of a 1.5 MW turbine, for three orbits.
loads = BearingLoads.constant([0.0, -343.5e3, 0.0], shaft_speed=20.463 * np.pi / 30, duration=20.0)
result = simulate(Case(loads=loads, rollers=[0], traces=Traces(step=0.002)))

roller = result.sel(row="downwind").isel(roller=0)
print(f"completed: {int(roller.status) == 0}, orbits in the window: {result.sizes['orbit']}")
print(f"lowest spin: {100 * float(roller.min_spin_ratio):.1f} % of pure rolling")
for name in ("inner", "outer", "cage"):
    energy = float(roller.orbit_energy.sel(interface=name).mean())
    peak = float(roller.peak_power.sel(interface=name).max())
    print(f"{name:5}: {energy:.3g} J an orbit, at most {peak:.3g} W")
unloaded = roller.time.values[roller.roller_load.values == 0.0]
print(f"share of the time without load: {100 * unloaded.size / roller.time.size:.1f} %")
