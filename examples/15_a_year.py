"""A year of a site from a few wind speeds: hours and friction energy of each.

python examples/15_a_year.py
"""

from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt

from macroslip import open_study, read_study, run_study
from macroslip.study.aggregation import aggregation_in_use
from macroslip.study.year import year

with open("year.yaml", "w", encoding="utf-8") as file:
    file.write("""
case: {rollers: [0], loads: {start: 0 s, end: 14 s}}     # whole records and all rollers in earnest
loads: {bundled: [12A, 14A, 18A, 24A]}
weights: {wind: {weibull: IEC II}}
""")
with TemporaryDirectory() as folder:
    run_study(read_study("year.yaml"), folder)
    study = open_study(folder)
    of_year = year(study, aggregation_in_use(study)).isel(group=0)

energy = of_year.energy.sum("row") / 1e6
for wind, hours, part in zip(of_year.bin.values, of_year.hours.values, energy.values, strict=True):
    print(f"{float(wind):g} m/s: {float(hours):.0f} h, {part:.2f} MJ of a mean roller in both rows")
figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
axes.bar([f"{float(wind):g}" for wind in of_year.bin.values], energy)
axes.set(xlabel="wind speed [m/s]", ylabel="friction in a year [MJ]")
figure.savefig("15_a_year.png", dpi=80)
