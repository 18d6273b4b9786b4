"""From an OpenFAST output file to the slip of both rows.

python examples/02_openfast_file.py
"""

from pathlib import Path

from macroslip import Case, Drivetrain, HubLoads, Traces, main_bearing_load, simulate
from macroslip.report.answer import answer

# The time axis is the file's own: this sample begins at 60 s.
file = Path(__file__).parents[1] / "tests" / "data" / "sample14B.outb"
hub = HubLoads.read(file, end=75.0)
print(f"hub loads from {hub.start:g} s to {hub.end:g} s:", ", ".join(hub.reading[:3]), "...")

# Distances and tilt of your own drivetrain belong here; these are the defaults.
drivetrain = Drivetrain(hub_to_bearing=1.26, bearing_to_gearbox=2.2)
mean = main_bearing_load(hub, drivetrain).force.mean(axis=0) / 1e3
print(f"mean load on the bearing: X0 {mean[0]:.1f}, Y0 {mean[1]:.1f}, Z0 {mean[2]:.1f} kN")

case = Case(loads=hub, drivetrain=drivetrain, rollers=[0, 7, 14, 21], traces=Traces(step=0.05))
result = simulate(case)
for sentence in answer(result):
    print(sentence)
axes = result.macroslip.plot.load_zone("downwind")
axes.figure.savefig("02_openfast_file.png", dpi=80)
