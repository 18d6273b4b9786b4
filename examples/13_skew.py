"""How far a roller turns about its contact normal, at rest in every position of its orbit.

python examples/13_skew.py
"""

import matplotlib.pyplot as plt

from macroslip import BearingLoads, Case, Laws, Traces, simulate

loads = BearingLoads.constant([0.0, -343.5e3, 100e3], shaft_speed=2.143, duration=14.0)
laws = Laws.physical().but(skew="quasi-static")
result = simulate(Case(loads=loads, laws=laws, rollers=[0], traces=Traces(step=0.02)))

figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
for row in result.row.values:
    skew = 1e3 * result.skew_angle.sel(row=row).isel(roller=0)
    axes.plot(result.time, skew, label=row)
    if skew.notnull().any():  # under this thrust the rings press no upwind roller
        print(f"{row}: skew between {float(skew.min()):.2f} and {float(skew.max()):.2f} mrad")
axes.set(xlabel="time [s]", ylabel="skew [mrad]")
axes.legend()
figure.savefig("13_skew.png", dpi=80)
