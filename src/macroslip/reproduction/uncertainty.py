"""How sure the study's results are: a seeded Sobol sample over the values that are estimates, all changed together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.case.case import Case, Window
from macroslip.errors import InputError, MacroslipError
from macroslip.loads import HubLoads
from macroslip.mechanisms import Laws
from macroslip.reproduction.uncertain_values import VALUES, with_values
from macroslip.result.run_input import run_input
from macroslip.result.simulate import simulate, usable_processors

if TYPE_CHECKING:
    import xarray as xr

#: Size of the sample, a power of two as Sobol's sequence asks for, and the seed of its scrambling.
SAMPLES, SEED = 64, 20240613
#: Cases that stand for the study, the rollers of each row that stand for the row, and the end of the window [s].
CASES, ROLLERS, END = ("12B", "18B", "24B"), (0,), 200.0
#: Meaning of the variable `outcome`.
OUTCOMES = ("completed", "a roller failed", "refused")


def draw(samples: int = SAMPLES) -> np.ndarray:
    """A scrambled Sobol sample of `VALUES`, shape (samples, values), in their units; the same every time.

    Examples
    --------
    >>> drawn = draw(4)
    >>> drawn.shape, all(one.low <= value <= one.high for one, value in zip(VALUES, drawn[0]))
    ((4, 13), True)
    """
    from scipy.stats import qmc

    unit = qmc.Sobol(len(VALUES), scramble=True, seed=SEED).random(samples)
    return qmc.scale(unit, [one.low for one in VALUES], [one.high for one in VALUES])


def uncertainty(
    laws: Laws,
    *,
    samples: int = SAMPLES,
    cases: Sequence[str] = CASES,
    rollers: Sequence[int] = ROLLERS,
    end: float = END,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """Run cases with every set of values of the sample, and with the base values.

    Parameters
    ----------
    laws : Laws
        With limiting shear, starvation and asperities; without them their values have no effect.
    samples : int
        A power of two.
    cases : sequence of str
        Names of bundled cases.
    rollers : sequence of int
        Rollers of each row that stand for the row.
    end : float
        End of the window [s]; it opens when the first orbit is complete.
    threads : int, optional
        Threads over samples; the number of usable processors by default.
    progress : callable, optional
        Called as progress(done, total) after each sample.

    Returns
    -------
    xarray.Dataset
        Over (sample, case, row, interface): orbit_energy [J] per orbit, mean over rollers and orbits; over (sample,
        case, row): peak_power [W], mean over rollers and orbits of the largest power at any interface per orbit; over
        (sample, case): window_energy [J], both rows, and torque [N m], friction torque of both rows' contacts, mean
        over the turns of the shaft. Over (sample, parameter): value, in the unit of the coordinate `unit`. outcome over
        (sample): position in `OUTCOMES`; what did not complete is NaN, and `reason` says why. Sample 0 are the base
        values, which are no part of the statistics.

    Raises
    ------
    InputError
        For an unknown case, or a window without a complete orbit.
    """
    import xarray as xr

    loads = [HubLoads.bundled(name) for name in cases]
    first, last = loads[0].time[0], min(float(one.time[-1]) for one in loads)
    if not first < end <= last:
        raise InputError(f"the window ends at {end:g} s", where="uncertainty", allowed=f"above {first:g} to {last:g} s")
    base = [Case(loads=one.window(None, end), laws=laws, rollers=tuple(rollers), window=Window()) for one in loads]
    values = np.vstack([_base_values(base[0]), draw(samples)])

    def run(k: int) -> tuple[int, str, list[dict[str, np.ndarray]]]:
        changed = dict(zip([one.name for one in VALUES], values[k].tolist(), strict=True)) if k else None
        found = []
        for case in base:
            try:
                found.append(_case_values(simulate(case if changed is None else with_values(case, changed), threads=1)))
            except MacroslipError as error:
                return 2, f"{case.loads.source}: {error}", []
        failed = sum(int(one["failed"]) for one in found)
        return (1, f"{failed} rollers failed", found) if failed else (0, "", found)

    total, results = len(values), {}
    pool = ThreadPoolExecutor(threads or usable_processors())
    try:
        futures = {pool.submit(run, k): k for k in range(total)}
        for done, future in enumerate(as_completed(futures), start=1):
            results[futures[future]] = future.result()
            if progress:
                progress(done, total)
    finally:
        pool.shutdown(cancel_futures=True)
    return _as_dataset([results[k] for k in range(total)], values, cases, laws, xr)


def _base_values(case: Case) -> list[float]:
    bearing, oil, drivetrain = case.bearing, case.lubricant, case.drivetrain
    return [
        1e3 * bearing.diametral_clearance,
        bearing.osculation_outer,
        1e3 * bearing.roller_diameter,
        1e3 * bearing.roller_length,
        1e6 * bearing.composite_roughness,
        1e-9 * bearing.hardness,
        1e-9 * bearing.cage_youngs_modulus,
        oil.limiting_shear,
        oil.boundary_friction,
        oil.starvation,
        oil.inlet_temperature - 273.15,
        drivetrain.hub_to_bearing,
        drivetrain.bearing_to_gearbox,
    ]


def _case_values(result: xr.Dataset) -> dict[str, Any]:
    """Numbers of one run: energies of a mean roller, peaks, torque of the contacts."""
    if not result.sizes["orbit"]:
        raise InputError("the window holds no complete orbit", where="uncertainty", allowed="one orbit or more")
    energy = result.orbit_energy.mean(("roller", "orbit"), skipna=False)
    peak = result.peak_power.max("interface", skipna=False).mean(("roller", "orbit"), skipna=False)
    window = result.energy.sum("interface", skipna=False).mean("roller", skipna=False)
    bearing, models, _ = run_input(result)
    # In an orbit the shaft turns by 2π over the ratio of the speeds.
    turned = 2.0 * np.pi / next(iter(models.values())).orbit_ratio
    return {
        "failed": int((result.status != 0).sum()),
        "orbit_energy": energy.values,
        "peak_power": peak.values,
        "window_energy": float(window.sum("row", skipna=False)),
        "torque": bearing.rollers_per_row * float(energy.sum(skipna=False)) / turned,
    }


def _as_dataset(results: list, values: np.ndarray, cases: Sequence[str], laws: Laws, xr: Any) -> xr.Dataset:
    rows, interfaces = ("downwind", "upwind"), ("inner", "outer", "cage")
    shapes = {
        "orbit_energy": ((2, 3), ("row", "interface"), "J", "energy per orbit, mean over rollers and orbits"),
        "peak_power": ((2,), ("row",), "W", "largest power per orbit at any interface, mean over rollers and orbits"),
        "window_energy": ((), (), "J", "energy in the window of a mean downwind and a mean upwind roller together"),
        "torque": ((), (), "N m", "friction torque of all contacts, mean over the turns of the shaft"),
    }
    data: dict[str, Any] = {}
    for name, (shape, dims, units, long_name) in shapes.items():
        found = np.full((len(results), len(cases), *shape), np.nan)
        for k, (outcome, _, one) in enumerate(results):
            if outcome == 0:
                found[k] = [case[name] for case in one]
        data[name] = (("sample", "case", *dims), found, {"units": units, "long_name": long_name})
    data["value"] = (
        ("sample", "parameter"),
        values,
        {"units": "1", "long_name": "value set, in the unit of its parameter"},
    )
    outcomes = np.array([outcome for outcome, _, _ in results], dtype=np.int8)
    data["outcome"] = (
        "sample",
        outcomes,
        {
            "units": "1",
            "long_name": "what became of the sample",
            "flag_values": np.arange(len(OUTCOMES), dtype=np.int8),
            "flag_meanings": " ".join(one.replace(" ", "_") for one in OUTCOMES),
        },
    )
    reasons = [reason for _, reason, _ in results]
    data["reason"] = ("sample", reasons, {"units": "1", "long_name": "why it did not complete"})
    return xr.Dataset(
        data,
        {
            "sample": ("sample", np.arange(len(results)), {"units": "1", "long_name": "number; 0 are the base values"}),
            "case": list(cases),
            "row": list(rows),
            "interface": list(interfaces),
            "parameter": [one.name for one in VALUES],
            "unit": ("parameter", [one.unit for one in VALUES]),
            "wind_speed": (
                "case",
                [float(name[:-1]) for name in cases],
                {"units": "m/s", "long_name": "mean wind speed"},
            ),
        },
        {"title": "Study under values drawn from their ranges", "model": laws.name, "seed": SEED},
    )
