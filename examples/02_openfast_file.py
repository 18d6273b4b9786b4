"""From an OpenFAST output file to the slip of every roller.

python examples/02_openfast_file.py tests/data/sample14B.outb
"""

import sys

from macroslip import Case, Drivetrain, HubLoads, main_bearing_load, simulate

if len(sys.argv) != 2:
    sys.exit("Give the path of an OpenFAST output, for example tests/data/sample14B.outb")

# The time axis is the file's own: this sample begins at 60 s.
hub = HubLoads.read(sys.argv[1])
print(f"hub loads from {hub.time[0]:g} s to {hub.time[-1]:g} s, {hub.time.size} samples")
hub = hub.window(hub.time[0], hub.time[0] + 30.0)

# Distances and tilt of your own drivetrain belong here; these are the defaults.
drivetrain = Drivetrain(hub_to_bearing=1.26, bearing_to_gearbox=2.2)
mean = main_bearing_load(hub, drivetrain).force.mean(axis=0) / 1e3
print(
    f"mean load on the main bearing: X0 {mean[0]:.1f} kN, Y0 {mean[1]:.1f} kN, Z0 {mean[2]:.1f} kN"
)

result = simulate(Case(loads=hub, drivetrain=drivetrain))
print(f"failed rollers: {int((result.status != 0).sum())} of {result.status.size}")
for row in result.row.values:
    energy = result.energy.sel(row=row).sum("interface", skipna=False)
    print(
        f"{row:8}: energy {float(energy.mean()):.3f} J a roller, lowest spin "
        f"{100 * float(result.min_spin_ratio.sel(row=row).min()):.0f} % of pure rolling"
    )
