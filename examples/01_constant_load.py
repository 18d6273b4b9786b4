"""One roller under a constant load: it coasts through the unloaded top and is caught again at the bottom.

python examples/01_constant_load.py
"""

from macroslip import BearingLoads, Case, Traces, simulate

# 343.5 kN downward on the inner ring and no thrust, at 20.5 rpm, the rated speed of a 1.5 MW turbine.
loads = BearingLoads.constant([0.0, -343.5e3, 0.0], shaft_speed=2.143, duration=20.0)
result = simulate(Case(loads=loads, rollers=[0], traces=Traces(step=0.01)))

roller = result.sel(row="downwind").isel(roller=0)
print(f"lowest spin: {100 * float(roller.min_spin_ratio):.1f} % of pure rolling")
for name in ("inner", "outer", "cage"):
    energy = float(roller.orbit_energy.sel(interface=name).mean())
    print(f"{name:5}: {energy:.3g} J an orbit")
axes = result.macroslip.plot.spin("downwind", 0)
axes.figure.savefig("01_constant_load.png", dpi=80)
