"""Every sign of docs/frames.md, checked with a run.

python examples/23_signs.py
"""

import numpy as np

from macroslip import BearingLoads, Case, Traces, simulate

# A weight of 343.5 kN, shaft forward at 20.463 rpm, no thrust.
loads = BearingLoads.constant([0.0, -343.5e3, 0.0], shaft_speed=20.463 * np.pi / 30, duration=14.0)
result = simulate(Case(loads=loads, rollers=[0, 14], traces=Traces(step=0.01)))

angles = np.degrees(result.start_angle)
assert np.allclose(
    angles.sel(row="downwind"), [-90.0, 90.0]
)  # roller 0 at the bottom, roller 14 at the top
assert np.allclose(
    angles.sel(row="upwind"), [-90.0 + 180.0 / 28, 90.0 + 180.0 / 28]
)  # half a pitch on

start = result.sel(row="downwind").isel(time=0)
assert (
    start.roller_load.sel(roller=0) > 0 and start.roller_load.sel(roller=14) == 0
)  # weight: loaded at the bottom
assert (result.spin < 0).all()  # the shaft turns forward, the rollers backward
lagging = result.spin > 0.99 * result.spin_pure  # less negative than in pure rolling
assert (result.slip.where(lagging) <= 0).sum() == lagging.sum()  # lagging rollers slip negatively
assert (result.traction.sel(interface="cage") >= 0).all()  # the cage brakes

# A quarter of a turn after the bottom roller 0 is at the left and rises, after three quarters it descends.
quarter = float(result.orbit_end[0] - result.orbit_start[0]) / 4
cage = result.cage_force.sel(row="downwind", roller=0)
assert cage.sel(time=quarter, method="nearest") > 0 > cage.sel(time=3 * quarter, method="nearest")

# Thrust goes to the downwind row.
loads = BearingLoads.constant([0.0, 0.0, 164e3], shaft_speed=2.14, duration=0.1)
result = simulate(Case(loads=loads, traces=Traces(step=0.1)))
assert (result.roller_load.sel(row="downwind") > 0).all() and (
    result.roller_load.sel(row="upwind") == 0
).all()
print("loads, numbers, spin, slip and cage force have the signs of docs/frames.md")
axes = start.roller_load.to_series().plot.bar(rot=0, ylabel="load at the start [N]")
axes.set_xlabel("downwind roller: 0 at the bottom, 14 at the top")
axes.figure.savefig("23_signs.png", dpi=80)
