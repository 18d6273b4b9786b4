"""A result as a workbook of Excel, and a chart from what stands in it.

python examples/21_result_to_excel.py
"""

import matplotlib.pyplot as plt
import pandas as pd

from macroslip import Case, HubLoads, simulate
from macroslip.report.sheets import result_sheets
from macroslip.storage.workbook import workbook

loads = HubLoads.bundled("14B").window(0.0, 20.0)
result = simulate(Case(loads=loads, rollers=[0, 7, 14, 21]))
# `macroslip run case.yaml -o case.nc --xlsx case.xlsx` writes the same.
with open("case.xlsx", "wb") as file:
    file.write(workbook(result_sheets(result, sentences=[], criteria=[])))

sheets = pd.read_excel("case.xlsx", sheet_name=None)
print("sheets:", ", ".join(sheets))
energy = sheets["row roller interface"].groupby(["row", "interface"])["energy [J]"].mean()
axes = energy.unstack().plot.bar(figsize=(6, 3.2), rot=0, ylabel="energy of a mean roller [J]")
axes.figure.set_layout_engine("constrained")
axes.figure.savefig("21_result_to_excel.png", dpi=80)
plt.close(axes.figure)
