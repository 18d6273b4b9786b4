"""Numbers of docs/whole-bearing.md: python docs/whole_bearing.py NAME …, each a line a simulation.

Names: `cases` (imposed orbit and whole bearing over mean wind speed), `cage` (gap, weight, arrangement, scatter, damping),
`physical` (the same with all mechanisms), `operation` (start, stop, reversal, idling, emergency stop).
"""

from __future__ import annotations

import sys
import time
from dataclasses import replace

import numpy as np

from macroslip import BearingLoads, Cage, Case, HubLoads, Laws, simulate


def line(name: str, case: Case) -> None:
    """Simulate and print energies by row and interface [J], cage slip, forces and speed."""
    start = time.process_time()
    result = simulate(case)
    spent = time.process_time() - start
    energy = result.energy.sum("roller").values
    print(f"{name:34s}", " ".join(f"{value:10.4g}" for value in energy.ravel()), end=" ")
    if case.dynamics == "whole-bearing":
        slip = ", ".join(f"{100 * value:.4f} %" for value in result.cage_slip.values)
        force = result.largest_pocket_force.max(("roller", "side")).values
        top = float(result.largest_force_by_position.sel(position=np.radians(90), method="nearest").max())
        print(f"slip {slip} force {force[0]:.0f} {force[1]:.0f} N top {top:.0f} N", end=" ")
        print(
            f"momentum {float(abs(result.momentum_residual).max()):.1e} energy {float(result.energy_residual[-1]):.1e} J",
            end=" ",
        )
        print(f"pocket {float(result.pocket_loss[-1]):.3g} J steps {int(result.steps.max())}", end=" ")
    print(f"{(case.loads.time[-1] - case.loads.time[0]) / spent:.0f} x status {int(result.status.max())}", flush=True)


def cases(laws: Laws, names: tuple[str, ...], duration: float) -> None:
    """Both dynamics for bundled load cases."""
    for name in names:
        loads = HubLoads.bundled(name)
        case = Case(loads=loads.window(None, min(duration, float(loads.time[-1]))), laws=laws)
        line(f"{name} imposed orbit", case)
        line(f"{name} whole bearing", replace(case, dynamics="whole-bearing"))
        line(f"{name} weightless cage", replace(case, dynamics="whole-bearing", cage=Cage(weight=False)))
        line(f"{name} cage a row", replace(case, dynamics="whole-bearing", cage=Cage(arrangement="per-row")))


def cage(laws: Laws, duration: float) -> None:
    """What the cage's choices do under 14B."""
    loads = HubLoads.bundled("14B")
    case = Case(loads=loads.window(None, min(duration, float(loads.time[-1]))), laws=laws, dynamics="whole-bearing")
    for gap in (2e-4, 5e-4, 1e-3):
        line(f"gap {gap * 1e3:g} mm", replace(case, cage=Cage(gap=gap)))
    for fullness in (0.03, 0.3):
        line(f"film fullness {fullness:g}", replace(case, cage=Cage(film_fullness=fullness)))
    for mass in (35.0, 60.0):
        line(f"cage {mass:g} kg", replace(case, cage=Cage(mass=mass)))
    line("guide friction 50 N", replace(case, cage=Cage(guide_friction=50.0)))
    line("random offsets", replace(case, cage=Cage(offsets="random")))
    for scatter in (0.5e-6, 1.5e-6):
        line(f"diameter scatter {scatter * 1e6:g} um", replace(case, cage=Cage(diameter_scatter=scatter)))


def dry(laws: Laws, duration: float) -> None:
    """Dry impacts under 14B."""
    loads = HubLoads.bundled("14B")
    case = Case(loads=loads.window(None, min(duration, float(loads.time[-1]))), laws=laws, dynamics="whole-bearing")
    for damping in (10.0, 50.0, 250.0):
        line(f"dry, damping {damping:g} s/m", replace(case, cage=Cage(impact="dry", damping=damping)))


def operation(laws: Laws) -> None:
    """Starts, stops, reversals, idling and an emergency stop, at 343 kN radial load."""
    rated = 2.143
    series = {
        "start from rest": ([0.0, 20.0, 40.0], [0.0, rated, rated]),
        "stop": ([0.0, 20.0, 40.0], [rated, rated, 0.0]),
        "reversal": ([0.0, 10.0, 20.0, 40.0], [rated, rated, -rated, -rated]),
        "idling at a tenth": ([0.0, 60.0], [0.1 * rated, 0.1 * rated]),
        "emergency stop in 2 s": ([0.0, 10.0, 12.0, 20.0], [rated, rated, 0.0, 0.0]),
    }
    for name, (times, speeds) in series.items():
        when = np.arange(0.0, times[-1] + 0.025, 0.05)
        force = np.tile([0.0, -343e3, 0.0], (when.size, 1))
        loads = BearingLoads(time=when, shaft_speed=np.interp(when, times, speeds), force=force, source=name)
        case = Case(loads=loads, laws=laws)
        line(f"{name}, imposed orbit", case)
        line(f"{name}, whole bearing", replace(case, dynamics="whole-bearing"))


if __name__ == "__main__":
    paper, physical = Laws.paper(), Laws.physical().but(rolling="none")
    chosen = sys.argv[1:] or ["cases", "cage", "dry", "operation", "physical"]
    parts = {
        "cases": lambda: cases(paper, ("14B", "24B"), 600.0),
        "cage": lambda: cage(paper, 60.0),
        "dry": lambda: dry(paper, 10.0),
        "operation": lambda: operation(paper),
        "physical": lambda: cases(physical, ("14B", "24B"), 60.0),
    }
    for part in chosen:
        print(f"# {part}: energies [J] downwind inner, outer, cage, upwind inner, outer, cage", flush=True)
        parts[part]()
