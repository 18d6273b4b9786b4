"""A traction law of one's own, from own_law.py, beside the one of the paper.

python examples/18_own_law.py
"""

import matplotlib.pyplot as plt
import own_law  # noqa: F401  registers "isothermal-barus"

from macroslip import BearingLoads, Case, Laws, Traces, simulate

loads = BearingLoads.constant([0.0, -343.5e3, 0.0], shaft_speed=2.143, duration=14.0)
figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
for name, laws, style in (
    ("paper", Laws.paper(), "-"),
    ("isothermal Barus", Laws.paper().but(traction="isothermal-barus"), "--"),
):
    # The law is evaluated once, for a table of each contact; later runs find it on the disk.
    result = simulate(Case(loads=loads, rollers=[0], laws=laws, traces=Traces(step=0.02)))
    roller = result.sel(row="downwind").isel(roller=0)
    axes.plot(roller.time, 100.0 * roller.spin / roller.spin_pure, style, label=name)
    print(f"{name}: lowest spin {100 * float(roller.min_spin_ratio):.1f} % of pure rolling")
axes.set(xlabel="time [s]", ylabel="spin / pure rolling [%]")
axes.legend()
figure.savefig("18_own_law.png", dpi=80)
