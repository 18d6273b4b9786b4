"""Explicit and backward Euler at the same fixed step on the way into the load zone (the paper's figure A1)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from macroslip.bearing.geometry import AXIAL_SIGNS
from macroslip.case.case import Case
from macroslip.case.parts import BackwardEuler, ExplicitEuler, Radau, Traces
from macroslip.integrate.held_contact import relaxation_rate
from macroslip.result.simulate import simulate
from macroslip.roller.model import RollerModel, roller_model

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.loads import BearingLoads

#: Deviation from the converged spin, as a part of pure rolling, at which a method counts as having lost it.
LOST = 0.02
#: Tolerance of the converged solution.
_CONVERGED = 1e-7


def compare_stability(static: BearingLoads, *, step: float = 1e-3) -> xr.Dataset:
    """Half an orbit of a downwind roller, from pure rolling at the top through the unloaded zone to the bottom.

    Parameters
    ----------
    static : BearingLoads
        Constant load that leaves the top unloaded, for at least half an orbit.
    step : float
        Of both Euler methods [s].

    Returns
    -------
    xarray.Dataset
        Over `angle` [degrees from the bottom]: spin over pure rolling by each method, their deviation from the
        converged one, roller_load [N] and relaxation_time [s] of a gripped roller (NaN without load). Attributes:
        step_s; the angle, load and relaxation time at which the step first exceeds twice the relaxation time, the
        limit of explicit Euler; the angle at which it has lost the solution by 2 % of pure rolling (NaN: never);
        the largest deviations of both methods, and their statuses.
    """
    import xarray as xr

    bearing = Case(loads=static).bearing
    case = Case(loads=static, rollers=[bearing.rollers_per_row // 2], traces=Traces(step=step))
    methods = {
        "explicit": ExplicitEuler(step=step),
        "backward": BackwardEuler(step=step),
        "converged": Radau(tolerance=_CONVERGED),
    }
    runs = {
        name: simulate(replace(case, integrator=method)).sel(row="downwind").isel(roller=0)
        for name, method in methods.items()
    }
    converged = runs["converged"]
    model = roller_model(bearing, case.lubricant, AXIAL_SIGNS["downwind"], tilt=case.drivetrain.tilt)
    turned = np.degrees(model.orbit_ratio * converged.time.values * float(static.shaft_speed[0]))
    kept = turned <= 180.0
    angle = np.degrees(float(converged.start_angle)) + 90.0 + turned[kept]
    ratios = {name: (run.spin.values / run.spin_pure.values)[kept] for name, run in runs.items()}
    load = converged.roller_load.values[kept]
    ring_speed = abs(float(converged.spin_pure[0])) * model.radius
    relaxation = np.array([_relaxation_time(model, one, ring_speed) for one in load])
    beyond = np.flatnonzero(step > 2.0 * np.nan_to_num(relaxation, nan=np.inf))
    deviations = {name: np.abs(ratios[name] - ratios["converged"]) for name in ("explicit", "backward")}
    lost = np.flatnonzero(deviations["explicit"] > LOST)

    def variable(values: np.ndarray, units: str, long_name: str) -> tuple:
        return ("angle", values, {"units": units, "long_name": long_name})

    def at(values: np.ndarray, found: np.ndarray) -> float:
        return float(values[found[0]]) if found.size else float("nan")

    return xr.Dataset(
        {
            **{
                f"spin_ratio_{name}": variable(values, "1", f"spin over pure rolling, {name}")
                for name, values in ratios.items()
            },
            **{
                f"deviation_{name}": variable(values, "1", f"|spin - converged spin| over pure rolling, {name}")
                for name, values in deviations.items()
            },
            "roller_load": variable(load, "N", "load of the roller"),
            "relaxation_time": variable(relaxation, "s", "relaxation time of a gripped roller's slip"),
        },
        {"angle": variable(angle, "degree", "angle from the bottom along the orbit")},
        {
            "step_s": step,
            "limit_angle_deg": at(angle, beyond),
            "limit_load_N": at(load, beyond),
            "limit_relaxation_time_s": at(relaxation, beyond),
            "bottom_relaxation_time_s": float(relaxation[-1]),
            "lost_angle_deg": at(angle, lost),
            "lost_load_N": at(load, lost),
            **{f"largest_deviation_{name}": float(np.nanmax(values)) for name, values in deviations.items()},
            **{f"status_{name}": int(run.status) for name, run in runs.items()},
        },
    )


def _relaxation_time(model: RollerModel, load: float, ring_speed: float) -> float:
    rate = relaxation_rate(model, load, ring_speed)
    return 1.0 / rate if rate > 0.0 else float("nan")
