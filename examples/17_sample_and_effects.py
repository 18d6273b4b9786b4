"""A sample of two uncertain values, and which of them matters: main effects.

python examples/17_sample_and_effects.py
"""

from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt

from macroslip import open_study, read_study, run_study
from macroslip.study.effects import effects

with open("sample.yaml", "w", encoding="utf-8") as file:
    file.write("""
case: {rollers: [0], laws: {model: paper}, loads: {start: 0 s, end: 8 s}}
loads: {bundled: [14B]}
variations:
  sample:
    {method: sobol, count: 8, seed: 1, ranges: {
      bearing.diametral_clearance: {low: 0.0, high: 0.4, unit: mm},
      drivetrain.hub_to_bearing: {low: 1.0, high: 1.5, unit: m}}}
""")
with TemporaryDirectory() as folder:
    run_study(read_study("sample.yaml"), folder)
    of_sample = effects(open_study(folder))

name = str(of_sample.quantity.values[0])
of_quantity = of_sample.sel(quantity=name)
for parameter, effect, error in zip(
    of_quantity.parameter.values,
    of_quantity.main_effect.values,
    of_quantity.main_effect_error.values,
    strict=True,
):
    print(f"{name} with {parameter}: {100 * effect:+.1f} % ± {100 * error:.1f} %")
figure, axes = plt.subplots(figsize=(7, 2.6), layout="constrained")
axes.barh(
    of_quantity.parameter.values,
    100 * of_quantity.main_effect,
    xerr=100 * of_quantity.main_effect_error,
)
axes.set_xlabel(f"main effect on {name} [%]")
figure.savefig("17_sample_and_effects.png", dpi=80)
