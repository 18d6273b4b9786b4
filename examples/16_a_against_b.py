"""Design A against design B: the same loads, two clearances, all differences.

python examples/16_a_against_b.py
"""

import matplotlib.pyplot as plt

from macroslip import Bearing, Case, HubLoads, compare, simulate

loads = HubLoads.bundled("14B").window(0.0, 30.0)
base = Bearing.read("skf-240-600-bc")
results = [
    simulate(Case(loads=loads, bearing=base.replace(diametral_clearance=gap), rollers=[0, 14]))
    for gap in (0.1e-3, 0.3e-3)
]
comparison = compare(*results)
print(comparison.attrs["ranking"])
for note in comparison.attrs["notes"]:
    print("note:", note)

changed = comparison.dropna(subset="difference [%]")
figure, axes = plt.subplots(figsize=(7, 3.6), layout="constrained")
axes.barh(changed["quantity"], changed["difference [%]"])
axes.axvline(0.0, color="black", linewidth=0.8)
axes.set_xlabel("clearance of 0.3 mm against 0.1 mm: difference [%]")
figure.savefig("16_a_against_b.png", dpi=80)
