"""A bearing of one's own, from a file with a provenance tag at every value.

python examples/06_own_bearing.py
"""

import json

import matplotlib.pyplot as plt

from macroslip import Bearing, BearingLoads, Case, Traces, simulate

base = Bearing.read("skf-240-600-bc")
# A file of one's own: the content of the shipped one with two entries replaced. YAML reads JSON.
entries = base.as_dict()
entries["name"] = "my-bearing"
note = "warm, by our thermal model"
entries["diametral_clearance"] = {"value": 0.1, "unit": "mm", "tag": "E", "note": note}
entries["composite_roughness"] = {"value": 0.25, "unit": "um"}  # without a tag it is U, the user's
with open("my-bearing.yaml", "w", encoding="utf-8") as file:
    json.dump(entries, file, indent=1)
own = Bearing.read("my-bearing.yaml")
for key in ("diametral_clearance", "composite_roughness", "contact_angle"):
    origin = own.provenance[key]
    print(f"{key}: {origin.value} {origin.unit} [{origin.tag}] {origin.note}")

loads = BearingLoads.constant([0.0, -343.5e3, 0.0], shaft_speed=2.143, duration=14.0)
figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
for bearing in (base, own):
    case = Case(loads=loads, bearing=bearing, rollers=[0], traces=Traces(step=0.02))
    roller = simulate(case).sel(row="downwind").isel(roller=0)
    axes.plot(roller.time, 100.0 * roller.spin / roller.spin_pure, label=bearing.name)
axes.set(xlabel="time [s]", ylabel="spin / pure rolling [%]")
axes.legend()
figure.savefig("06_own_bearing.png", dpi=80)
