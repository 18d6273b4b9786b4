"""Loads from a table whose columns name quantity and unit, here as a German spreadsheet writes it.

python examples/05_csv_with_units.py
"""

import matplotlib.pyplot as plt
import numpy as np

from macroslip import Drivetrain, HubLoads, main_bearing_load

time = np.arange(0.0, 20.0, 0.05)
thrust = 164.4 + 40.0 * np.sin(2.1 * time)
rows = [
    f"{t:.2f};20,46;{fx:.3f};0;-263;726;154,4;0".replace(".", ",")
    for t, fx in zip(time, thrust, strict=True)
]
header = "time_s;rotor_speed_rpm;fx_kN;fy_kN;fz_kN;mx_kNm;my_kNm;mz_kNm"
with open("loads.csv", "w", encoding="utf-8") as file:
    file.write("\n".join([header, *rows]) + "\n")

# Separator and decimal comma are found out; decimal="," says it, where numbers do not.
hub = HubLoads.read("loads.csv")
print(hub)
force = main_bearing_load(hub, Drivetrain()).force / 1e3
figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
axes.plot(hub.time, np.hypot(force[:, 0], force[:, 1]), label="radial")
axes.plot(hub.time, force[:, 2], label="axial")
axes.set(xlabel="time [s]", ylabel="load on the bearing [kN]")
axes.legend()
figure.savefig("05_csv_with_units.png", dpi=80)
