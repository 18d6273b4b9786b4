"""Errors of the imposed orbit on all bundled load cases, by tolerance: `python -m benchmarks.accuracy paper`.

Some rollers of each row over 600 s of each of the 21 cases, beside the same at a tight tolerance. Spin is
compared every half second without load, as part of pure rolling's; peak power orbit by orbit, of the
interface that has the largest.
"""

from __future__ import annotations

import argparse
import time
from typing import NamedTuple

import numpy as np
import xarray as xr

from macroslip import Case, HubLoads, Laws, Radau, Traces, simulate
from macroslip.loads import bundled_cases

#: Models with the oil supply of their cases and the tolerance of the reference. Tables of the physical
#: model at a tighter one take longer than all the rest.
SETTINGS = {
    "paper": (Laws.paper(), None, 1e-9),
    "physical": (Laws.physical(), "skf", 1e-7),
    "flooded": (Laws.physical(), "flooded", 1e-7),
}


class Errors(NamedTuple):
    """Largest errors of one case."""

    energy: float  #: Of a roller's energy [-]
    interface: float  #: Of the energy of one of its interfaces [-]
    spin: float  #: Of the spin without load, over that of pure rolling [-]
    peak: float  #: Of the peak power of an orbit [-]


def run(name: str, setting: str, rollers: list[int], tolerance: float) -> tuple[xr.Dataset, float]:
    """Result of a case for some rollers of each row, and its CPU time [s]."""
    laws, supply, _ = SETTINGS[setting]
    case = Case(
        loads=HubLoads.bundled(name),
        laws=laws,
        oil_supply=supply,
        rollers=rollers,
        integrator=Radau(tolerance=tolerance),
        traces=Traces(step=0.5),
        contact_details=False,
    )
    start = time.process_time()
    result = simulate(case, threads=1)
    return result, time.process_time() - start


def errors_of(result: xr.Dataset, exact: xr.Dataset) -> Errors:
    """Largest relative errors of a result beside a finer one."""
    energy = abs(result.energy.sum("interface") / exact.energy.sum("interface") - 1.0)
    interface = abs(result.energy / exact.energy - 1.0).where(exact.energy > 0.0)
    coasting = exact.roller_load == 0.0
    spin = abs(result.spin - exact.spin) / abs(exact.spin_pure)
    highest = exact.peak_power.max("interface")
    peak = abs(result.peak_power.max("interface") / highest - 1.0).where(highest > 0.0)
    return Errors(
        float(energy.max()),
        float(interface.max()),
        float(spin.where(coasting).max()),
        float(peak.max()),
    )


def main(arguments: list[str] | None = None) -> int:
    """Print the errors of each tolerance."""
    parser = argparse.ArgumentParser(
        description="Errors of the imposed orbit on all bundled load cases, by tolerance."
    )
    parser.add_argument("setting", choices=list(SETTINGS))
    parser.add_argument("--tolerances", type=float, nargs="+", default=[1e-2, 1e-3, 2e-4, 1e-5])
    parser.add_argument("--rollers", type=int, nargs="+", default=[3, 17], help="of each row")
    chosen = parser.parse_args(arguments)
    tight = SETTINGS[chosen.setting][2]
    exact = {name: run(name, chosen.setting, chosen.rollers, tight)[0] for name in bundled_cases()}
    print(
        "tolerance   evaluations  CPU [s]  largest and median error of energy; an interface; spin; a peak"
    )
    for tolerance in chosen.tolerances:
        evaluations = 0
        seconds = 0.0
        errors = []
        for name, reference in exact.items():
            result, spent = run(name, chosen.setting, chosen.rollers, tolerance)
            evaluations += int(result.force_evaluations.sum())
            seconds += spent
            errors.append(errors_of(result, reference))
        largest = np.max(errors, axis=0)
        median = np.median(errors, axis=0)
        columns = "; ".join(f"{a:.1e}, {b:.1e}" for a, b in zip(largest, median, strict=True))
        print(f"{tolerance:9.0e} {evaluations:13,d} {seconds:8.1f}  {columns}", flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
