"""Slip of tapered rollers over preload, as docs/tapered.md has it.

python docs/tapered_slip.py        # prints the table; some minutes
"""

from macroslip import Case, HubLoads, Lubricant, simulate
from macroslip.bearing.kinds import read_bearing
from macroslip.loads import Drivetrain

PRELOADS = (-0.1, 0.0, 0.1, 0.2, 0.3)


def line(preload: float) -> str:
    """A line of the table, of a preload [mm]."""
    case = Case(
        bearing=read_bearing("tdo-main-bearing").replace(preload=1e-3 * preload),
        lubricant=Lubricant.read("vg460-pao"),
        temperature=308.15,
        oil_supply=0.7,
        loads=HubLoads.bundled("14B").window(100.0, 130.0),
        drivetrain=Drivetrain(mount="alone"),
        rollers=[0, 11, 22],
    )
    result = simulate(case)
    span = result.attrs["window_end"] - result.attrs["window_start"]
    raceways = result.energy.sel(interface=["inner", "outer"]).sum("interface").mean("roller")
    columns = [
        *(f"{float(count):.1f}" for count in result.rollers_below_grip),
        *(f"{float(ratio):.2f}" for ratio in result.min_spin_ratio.min("roller")),
        *(f"{1e3 * float(power):.2g}" for power in raceways / span),
        f"{float(result.rib_energy.mean()) / span:.2f}",
        f"{float(result.rolling_energy.sum('interface').mean()) / span:.1f}",
    ]
    return " | ".join([f"{preload:g}", *columns])


if __name__ == "__main__":
    for preload in PRELOADS:
        print(line(preload), flush=True)
