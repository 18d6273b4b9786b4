"""A simulation with the traction law of own_law.py, under the load of 01_constant_load.py.

    python examples/05_use_own_law.py

The law is evaluated once, for a table of each contact; later runs find the tables on the disk.
"""

import numpy as np
import own_law  # noqa: F401  registers "isothermal-barus"

from macroslip import BearingLoads, Case, Laws, simulate

loads = BearingLoads.constant([0.0, -343.5e3, 0.0], shaft_speed=20.463 * np.pi / 30, duration=20.0)
result = simulate(
    Case(loads=loads, rollers=[0], laws=Laws.paper().but(traction="isothermal-barus"))
)
roller = result.sel(row="downwind").isel(roller=0)
print(
    f"completed: {int(roller.status) == 0}, lowest spin {100 * float(roller.min_spin_ratio):.1f} % of pure rolling"
)
for name in ("inner", "outer", "cage"):
    energy = float(roller.orbit_energy.sel(interface=name).mean())
    peak = float(roller.peak_power.sel(interface=name).max())
    print(f"{name:5}: {1e3 * energy:8.3f} mJ an orbit, at most {peak:.3g} W")
print("cited:", result.attrs["citations"].splitlines()[3])
