"""Two main bearings on a four-point mount: what each of them carries.

python examples/11_both_main_bearings.py
"""

import matplotlib.pyplot as plt
import numpy as np

from macroslip import Drivetrain, HubLoads, support_loads

loads = HubLoads.bundled("14B").window(0.0, 60.0)
drivetrain = Drivetrain(
    mount="four-point",
    hub_to_bearing=1.1,
    front_to_rear=1.6,
    locating="rear",  # it carries all thrust
    bearing="rear",  # the one that simulate() would take
)
figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
for name, force in support_loads(loads, drivetrain).items():
    radial = np.hypot(force[:, 0], force[:, 1]) / 1e3
    axes.plot(loads.time, radial, label=f"{name}, radial")
    print(
        f"{name}: radial {radial.mean():.0f} kN, axial {force[:, 2].mean() / 1e3:.0f} kN in the mean"
    )
axes.set(xlabel="time [s]", ylabel="load on the bearing [kN]")
axes.legend()
figure.savefig("11_both_main_bearings.png", dpi=80)
