"""The same loads with two oils: what friction dissipates in either row.

python examples/08_two_oils.py
"""

import matplotlib.pyplot as plt

from macroslip import Case, HubLoads, Lubricant, simulate

loads = HubLoads.bundled("14B").window(0.0, 20.0)
figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
for k, name in enumerate(("vg460-pao", "vg320-mineral")):
    case = Case(loads=loads, lubricant=Lubricant.read(name), temperature=308.15, rollers=[0, 14])
    result = simulate(case)
    energy = result.energy.sum("interface", skipna=False).mean("roller", skipna=False)
    seconds = result.attrs["window_end"] - result.attrs["window_start"]
    lowest = 100.0 * result.min_spin_ratio.min("roller")
    for row in result.row.values:
        power, spin = float(energy.sel(row=row)) / seconds, float(lowest.sel(row=row))
        print(f"{name:14} {row:8}: {power:.2f} W a roller, lowest spin {spin:.0f} % of rolling")
    axes.bar([0.4 * k, 1.2 + 0.4 * k], energy / seconds, width=0.35, label=name)
axes.set_xticks([0.2, 1.4], result.row.values)
axes.set_ylabel("friction of a mean roller [W]")
axes.legend()
figure.savefig("08_two_oils.png", dpi=80)
