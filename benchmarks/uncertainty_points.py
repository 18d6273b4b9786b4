"""Write the study file of the sample over estimated values, from their ranges.

python benchmarks/uncertainty_points.py > src/macroslip/reproduction/studies/uncertainty_physical.yaml
"""

from __future__ import annotations

import json

from macroslip.reproduction.uncertain_points import POINTS, SEED, sample_points
from macroslip.reproduction.uncertain_values import VALUES

HEAD = f"""\
# A sample over the estimated values, all changed together; the first point is the base case. Made by
# benchmarks/uncertainty_points.py from the ranges in uncertain_values.py: a scrambled Sobol sequence, {POINTS} points of
# {len(VALUES)} values, seed {SEED}.
title: Study under values drawn from their ranges
case:
  rating: false
  laws: {{model: physical}}
  drivetrain: {{shaft_mass_station: 1.73 m}}
  rollers: [0]
  loads: {{end: 100 s}}
loads: {{bundled: [12B, 24B]}}
keep: [energy]
variations:
  list:"""

if __name__ == "__main__":
    print(HEAD)
    for point in sample_points():
        texts = {key: value if isinstance(value, str) else json.dumps(value) for key, value in point.items()}
        written = ", ".join(f"{key}: {value}" for key, value in texts.items())
        print(f"    - {{{written}}}")
