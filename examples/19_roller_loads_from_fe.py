"""Loads of the rollers from elsewhere, such as a finite-element model, in place of the ring's balance.

python examples/19_roller_loads_from_fe.py
"""

import numpy as np
import pandas as pd

from macroslip import Case, RollerLoads, Traces, simulate

# Places around both rows at two times. A real table has them as the model gives them.
angle = np.arange(0.0, 360.0, 15.0)
lines = [
    (time, 20.46, row, position, max(0.0, peak * np.cos(np.radians(position + 90.0))) * 1e3)
    for time in (0.0, 14.0)
    for row, peak in (("downwind", 60.0), ("upwind", 15.0))
    for position in angle
]
columns = ["time_s", "shaft_speed_rpm", "row", "angle_deg", "load_N"]
pd.DataFrame(lines, columns=columns).to_csv("rollers.csv", index=False)

loads = RollerLoads.read("rollers.csv")
result = simulate(Case(loads=loads, rollers=[0, 14], traces=Traces(step=0.02)))
for row in result.row.values:
    spin = 100.0 * float(result.min_spin_ratio.sel(row=row).min())
    print(f"{row}: lowest spin {spin:.0f} % of pure rolling")
axes = result.macroslip.plot.spin("downwind", 0)
axes.figure.savefig("19_roller_loads_from_fe.png", dpi=80)
