"""All rollers of both rows together with the cage: forces of the spars in two tenths of a second.

python examples/24_whole_bearing.py
"""

from macroslip import BearingLoads, Case, Laws, Traces, simulate

loads = BearingLoads.constant([0.0, -343.5e3, 60e3], shaft_speed=2.143, duration=0.2)
case = Case(
    loads=loads,
    dynamics="whole-bearing",
    laws=Laws.paper(),
    traces=Traces(step=0.005),
    rating=False,
)
result = simulate(case)
force = result.largest_pocket_force.max("roller")
for row in result.row.values:
    for side in result.side.values:
        print(f"{row}, {side} spar: at most {float(force.sel(row=row, side=side)):.3g} N")
axes = result.macroslip.plot.load_zone("downwind")
axes.figure.savefig("24_whole_bearing.png", dpi=80)
