"""Effect of a fixed step, and of an iteration that stops early, on energy and power, beside the converged values.

Two properties of backward Euler on the spin, measured and not ascribed to anyone: an iteration that stops on a relative
change of spin leaves force unbalanced, which (32) turns into cage force; and a fixed step does not resolve the
milliseconds in which a roller snaps back to pure rolling.
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

import numpy as np

from macroslip.case.case import Case
from macroslip.case.parts import BackwardEuler, Radau
from macroslip.loads import BearingLoads
from macroslip.machine import usable_processors
from macroslip.reproduction.single_roller import static_load
from macroslip.result.simulate import simulate

if TYPE_CHECKING:
    import xarray as xr

TOLERANCES = tuple(10.0**exponent for exponent in range(-14, -4))
STEPS = (3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4)
_CONVERGED = Radau(tolerance=1e-8)
#: Four orbits at 20 rpm [s].
_STATIC_DURATION = 26.0
#: Stopping tolerance at which the iteration adds nothing of its own.
_TIGHT = 1e-12


def nonlinear_tolerance(
    variable: BearingLoads,
    *,
    tolerances: Sequence[float] = TOLERANCES,
    step: float = 1e-2,
    threads: int | None = None,
) -> xr.Dataset:
    """Energy per orbit of the first roller of each row against the stopping tolerance of backward Euler.

    Parameters
    ----------
    variable : BearingLoads
        Time-varying loads, all of which are used: what a loose iteration adds comes in few orbits, so that a short part
        of a history gives a mean by chance. Beside them their downward static load, under which orbits are alike.
    tolerances : sequence of float
        Relative changes of spin at which the iteration stops.
    step : float
        Of backward Euler [s].
    threads : int, optional
        Threads over tolerances; the number of usable processors by default.

    Returns
    -------
    xarray.Dataset
        Over (stopping_tolerance, row): energy and cage energy per orbit [J] under time-varying load, the largest energy
        of an orbit, energy per orbit under static load, the ratio of the means, and the largest unbalanced force [N];
        the same over (row), converged.
    """
    import xarray as xr

    loads = {"varying": variable, "static": static_load(variable, thrust=False, duration=_STATIC_DURATION)}

    def per_orbit(integrator: BackwardEuler | Radau) -> xr.Dataset:
        runs = {
            name: simulate(Case(loads=one, rollers=[0], integrator=integrator), threads=1).isel(roller=0)
            for name, one in loads.items()
        }
        energies = {name: run.orbit_energy.mean("orbit", skipna=False) for name, run in runs.items()}
        whole = {name: energy.sum("interface", skipna=False) for name, energy in energies.items()}
        values = xr.Dataset()
        _put(values, "energy", whole["varying"], "J", "energy per orbit, time-varying load")
        cage = energies["varying"].sel(interface="cage", drop=True)
        _put(values, "cage_energy", cage, "J", "energy per orbit at the cage, time-varying load")
        largest = runs["varying"].orbit_energy.sum("interface", skipna=False).max("orbit", skipna=False)
        _put(values, "largest_energy", largest, "J", "largest energy of an orbit, time-varying load")
        _put(values, "static_energy", whole["static"], "J", "energy per orbit, downward static load")
        _put(values, "ratio", whole["varying"] / whole["static"], "1", "energy, time-varying over static load")
        unbalanced = runs["varying"].unbalanced_force
        _put(values, "unbalanced_force", unbalanced, "N", "largest force left unbalanced, time-varying load")
        _put(values, "failed", sum((run.status != 0).astype(int) for run in runs.values()), "1", "failed integrations")
        return values.drop_vars(["roller", "start_angle"], errors="ignore")

    converged = per_orbit(_CONVERGED)
    with ThreadPoolExecutor(threads or usable_processors()) as pool:
        methods = [BackwardEuler(step=step, tolerance=tolerance) for tolerance in tolerances]
        runs = dict(zip(tolerances, pool.map(per_orbit, methods), strict=True))
    return _beside_converged(
        runs,
        converged,
        ("stopping_tolerance", "1", "relative change of spin at which the iteration stops"),
        {"step_s": step, "load": variable.source, "load_duration_s": variable.duration},
    )


def step_size(
    variable: BearingLoads,
    *,
    start: float,
    end: float,
    steps: Sequence[float] = STEPS,
    rollers: Sequence[int] = (0, 7, 14, 21),
    threads: int | None = None,
) -> xr.Dataset:
    """P_max per orbit against the fixed step of backward Euler.

    Parameters
    ----------
    variable : BearingLoads
        Time-varying loads, of which the part from `start` to `end` [s], at least two orbits, is used; rollers begin it
        in pure rolling at their initial places.
    steps : sequence of float
        [s].
    rollers : sequence of int
        Of each row.
    threads : int, optional

    Returns
    -------
    xarray.Dataset
        Over (step, row): mean and largest P_max over all (roller, orbit) samples [W]; the same over (row), converged
        and (production) with the default integrator.
    """
    loads = variable.window(start, end)

    def peaks(integrator: BackwardEuler | Radau) -> xr.Dataset:
        import xarray as xr

        run = simulate(Case(loads=loads, rollers=rollers, integrator=integrator), threads=threads)
        peak = run.peak_power.max("interface", skipna=False)
        samples = ("roller", "orbit")
        values = xr.Dataset()
        _put(values, "mean_peak_power", peak.mean(samples, skipna=False), "W", "mean P_max per orbit")
        _put(values, "largest_peak_power", peak.max(samples, skipna=False), "W", "largest P_max of all orbits")
        _put(values, "failed", (run.status != 0).sum("roller"), "1", "failed integrations")
        return values

    found = _beside_converged(
        {step: peaks(BackwardEuler(step=step, tolerance=_TIGHT)) for step in steps},
        peaks(_CONVERGED),
        ("step", "s", "fixed step"),
        {"tolerance": _TIGHT, "start_s": float(loads.time[0]), "end_s": float(loads.time[-1]), "load": loads.source},
    )
    production = peaks(Radau())
    return found.assign({f"{name}_production": production[name] for name in ("mean_peak_power", "largest_peak_power")})


def _put(into: xr.Dataset, name: str, values: xr.DataArray, units: str, long_name: str) -> None:
    into[name] = values
    into[name].attrs = {"units": units, "long_name": long_name}


def _beside_converged(
    runs: dict[float, xr.Dataset], converged: xr.Dataset, dimension: tuple[str, str, str], attributes: dict
) -> xr.Dataset:
    """Runs along a new dimension, and the converged values with `_converged` appended to their names."""
    import xarray as xr

    name, units, long_name = dimension
    values = xr.DataArray(np.array(list(runs)), dims=name, name=name, attrs={"units": units, "long_name": long_name})
    found = xr.concat(list(runs.values()), values, combine_attrs="override")
    found = found.merge(converged.rename({one: f"{one}_converged" for one in converged.data_vars}))
    return found.assign_attrs(attributes, converged_method="Radau", converged_tolerance=_CONVERGED.tolerance)
