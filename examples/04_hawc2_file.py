"""From HAWC2 output to the load on the main bearing: hub loads in, statics of the shaft, forces out.

python examples/04_hawc2_file.py
"""

from pathlib import Path

import matplotlib.pyplot as plt

from macroslip import Drivetrain, HubLoads, main_bearing_load

# Name the list of channels; its numbers are in the .dat beside it.
file = Path(__file__).parents[1] / "tests" / "data" / "hawc2" / "run.sel"
hub = HubLoads.read(file)
for line in hub.reading:
    print("read:", line)

bearing = main_bearing_load(hub, Drivetrain(hub_to_bearing=1.26, bearing_to_gearbox=2.2))
figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
for name, force in zip(("X0, to the left", "Y0, up", "Z0, downwind"), bearing.force.T, strict=True):
    axes.plot(bearing.time, force / 1e3, label=name)
axes.set(xlabel="time [s]", ylabel="load on the bearing [kN]")
axes.legend()
figure.savefig("04_hawc2_file.png", dpi=80)
