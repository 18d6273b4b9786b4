"""What clearance does to the load zone: the load of each roller around the downwind row.

python examples/10_clearance.py
"""

import matplotlib.pyplot as plt
import numpy as np

from macroslip import Bearing, BearingLoads, Lubricant
from macroslip.rating import roller_load_history

base = Bearing.read("skf-240-600-bc")
loads = BearingLoads.constant([0.0, -343.5e3, 60e3], shaft_speed=2.143, duration=1.0)
figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
for clearance in (0.0, 0.2e-3, 0.4e-3):
    bearing = base.replace(diametral_clearance=clearance)
    _, load = roller_load_history(bearing, Lubricant.read("vg460-pao"), loads)
    downwind = load[0, :, 0]  # row, roller, time
    carrying = 100.0 * np.mean(downwind > 0.0)
    angle = 360.0 * np.arange(downwind.size) / downwind.size
    label = f"{1e3 * clearance:.1f} mm"
    axes.plot(angle, downwind / 1e3, marker=".", label=label)
    print(f"clearance {label}: {carrying:.0f} % carry, at most {downwind.max() / 1e3:.1f} kN")
axes.set(xlabel="angle from the bottom [°]", ylabel="load of a roller [kN]")
axes.legend(title="diametral clearance")
figure.savefig("10_clearance.png", dpi=80)
