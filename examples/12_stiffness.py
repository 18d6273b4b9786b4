"""Stiffness of the main bearing over its load, for programs of drivetrain and rotor dynamics.

python examples/12_stiffness.py
"""

import matplotlib.pyplot as plt

from macroslip import BearingLoads, Case
from macroslip.result.stiffness import ring_stiffness, stiffness_table

radial = (100e3, 200e3, 400e3, 800e3)
cases = {
    f"{force / 1e3:g} kN": Case(loads=BearingLoads.constant([0.0, -force, 100e3], 2.1, 1.0))
    for force in radial
}
rings = ring_stiffness(cases)
stiffness_table(rings).to_csv("stiffness.csv", index=False)

mean = rings.isel(point=rings.kind == "mean load").stiffness / 1e9
figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
for axis in "XYZ":
    values = mean.sel(load=f"F_{axis}0", motion=f"d_{axis}0")
    axes.plot([force / 1e3 for force in radial], values, marker="o", label=f"along {axis}0")
    print(f"along {axis}0:", ", ".join(f"{float(value):.2f}" for value in values), "GN/m")
axes.set(xlabel="radial load [kN], with 100 kN of thrust", ylabel="stiffness [GN/m]")
axes.legend()
figure.savefig("12_stiffness.png", dpi=80)
