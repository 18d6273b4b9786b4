"""A bearing of one's own: from a file with a provenance tag at every value, or by changing one value.

python examples/03_own_bearing.py
"""

import json
import tempfile
from pathlib import Path

import numpy as np

from macroslip import Bearing, BearingLoads, Case, simulate

base = Bearing.read("skf-240-600-bc")

# A file of one's own: as_dict gives the content of the shipped one, in which two entries are replaced. YAML reads JSON.
entries = base.as_dict()
entries["name"] = "my-bearing"
entries["diametral_clearance"] = {
    "value": 0.1,
    "unit": "mm",
    "tag": "E",
    "note": "warm, by our thermal model",
}
entries["composite_roughness"] = {"value": 0.25, "unit": "um"}  # without a tag it is U, the user's
with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "my-bearing.yaml"
    path.write_text(json.dumps(entries, indent=1), encoding="utf-8")
    own = Bearing.read(path)

for key in ("diametral_clearance", "composite_roughness", "contact_angle"):
    origin = own.provenance[key]
    print(f"{key}: {origin.value} {origin.unit} [{origin.tag}] {origin.note}")

# Or change single values, in SI units.
tight = own.replace(name="my-bearing, no clearance", diametral_clearance=0.0)

loads = BearingLoads.constant([0.0, -343.5e3, 0.0], shaft_speed=20.463 * np.pi / 30, duration=14.0)
for bearing in (base, own, tight):
    result = simulate(Case(loads=loads, bearing=bearing, rollers=[0])).isel(roller=0)
    lowest = float(result.min_spin_ratio.sel(row="downwind"))
    print(
        f"{bearing.name}: clearance {1e3 * bearing.diametral_clearance:.2f} mm, lowest spin {100 * lowest:.1f} %"
    )
