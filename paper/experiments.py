"""Single rollers (figure 3), and what the numerical method does to energy and power (figure A1 and beside it).

Two properties of backward Euler on the spin, measured and not ascribed to anyone: an iteration that stops on a relative
change of spin leaves force unbalanced, which (32) turns into cage force; and a fixed step does not resolve the
milliseconds in which a roller snaps back to pure rolling.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial

import numpy as np
import xarray as xr

import macroslip as ms
from macroslip import BearingLoads, Laws
from macroslip.bearing import geometry
from macroslip.bearing.geometry import ROWS, initial_angles
from macroslip.imposed.zones import relaxation_rate
from macroslip.machine import usable_processors
from macroslip.result.prepared import prepare
from macroslip.ring.orbit import travel
from macroslip.roller.model import with_tables
from paper.studies import DETAILED_CASE, put

#: Names of the static loads, and whether the mean thrust acts too.
STATIC_LOADS = {"downward": False, "downward and thrust": True}
#: Kept points of a turn, and integrated samples between them: 0.5° and, at 20 rpm, a quarter of a millisecond.
_POINTS, _FINE = 720, 36
_RECOVERED = 0.99  # spin, as a part of pure rolling, from which on a roller counts as recovered
_LOST = 0.02  # deviation from the converged spin, as a part of pure rolling, at which a method counts as having lost it
TOLERANCES = tuple(10.0**exponent for exponent in range(-14, -4))
STEPS = (3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4)
_CONVERGED = ms.Radau(tolerance=1e-8)
_STATIC_DURATION = 26.0  # four orbits at 20 rpm [s]
_TIGHT = 1e-12  # stopping tolerance at which the iteration adds nothing of its own
_PAPER = Laws.paper()


def varying_load() -> BearingLoads:
    """Load on the main bearing in the detailed case."""
    return ms.main_bearing_load(ms.HubLoads.bundled(DETAILED_CASE), ms.Drivetrain())


def static_load(variable: BearingLoads, *, thrust: bool, duration: float) -> BearingLoads:
    """Constant load and speed from the means over the samples of a history, for a duration [s].

    The downward part alone, (0, mean F_Y0, 0), leaves an unloaded zone at the top; with thrust it is
    (0, mean F_Y0, mean F_Z0).
    """
    _, down, axial = variable.force.mean(axis=0)
    return BearingLoads.constant(
        [0.0, down, axial if thrust else 0.0], float(variable.shaft_speed.mean()), duration
    )


def trace_turn(
    loads: BearingLoads, row: str, roller: int, time: float, laws: Laws = _PAPER
) -> xr.Dataset:
    """Spin and cumulative frictional energy of one roller of a row over the turn from the bottom that holds a time [s].

    The history is integrated from its start, so the roller arrives with its own past. The shaft must not stop or turn back.

    Returns
    -------
    xarray.Dataset
        Over `angle`, degrees from the bottom along the orbit (180 is the top), 721 points: spin_speed and
        spin_speed_pure [rad/s], energy_fraction, roller_load [N]. Attributes: start and end [s], energy [J] of the turn,
        peak_power [W] at any interface, lowest spin ratio, recovery_time [s] from the lowest spin to 99 % of pure rolling
        (NaN if it is never that slow, or does not recover).

    Raises
    ------
    InputError
        If no whole turn holds that time.
    """
    case = ms.Case(loads=loads, rollers=[roller], laws=laws)
    if loads.shaft_speed.min() <= 0.0:
        raise ms.InputError(
            "the shaft stops or turns back", where=loads.source, allowed="speeds above 0"
        )
    # Angle from the bottom at the load samples, rising without wrap [rad].
    begin = initial_angles(row, case.bearing.rollers_per_row)[roller] + 0.5 * np.pi
    turned = begin + travel(loads.time, loads.shaft_speed, geometry.orbit_ratio(case.bearing))
    start, end = _turn(loads, turned, time)
    # The history after the turn has no influence.
    until = loads.window(None, float(loads.time[np.searchsorted(loads.time, end)]))
    step = (end - start) / (_POINTS * _FINE)
    # Rounding may put the last trace time past the end of the turn by one unit in the last place.
    traces = ms.Traces(step=step * (1.0 - 1e-12), start=start, end=end)
    result = ms.simulate(
        replace(case, loads=until, window=ms.Window(start=start, end=end), traces=traces), threads=1
    )
    result = result.sel(row=row).isel(roller=0)
    power = result.power.values.sum(axis=1)
    seconds = result.time.values
    cumulative = np.concatenate(
        [[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(seconds))]
    )
    angle = np.degrees(np.interp(seconds, loads.time, turned))
    angle -= 360.0 * np.round(angle[0] / 360.0)
    ratio = result.spin.values / result.spin_pure.values
    turn = _over_angle(angle[::_FINE])
    for name, values, units, words in (
        ("spin_speed", np.abs(result.spin.values), "rad/s", "spin speed"),
        ("spin_speed_pure", np.abs(result.spin_pure.values), "rad/s", "spin speed in pure rolling"),
        (
            "energy_fraction",
            cumulative / cumulative[-1],
            "1",
            "energy so far over that of the turn",
        ),
        ("roller_load", result.roller_load.values, "N", "load of the roller"),
    ):
        put(turn, name, ("angle", values[::_FINE]), units, words)
    return turn.assign_attrs(
        status=int(result.status),
        start_s=start,
        end_s=end,
        energy_J=float(result.energy.sum(skipna=False)),
        energy_from_traces_J=float(cumulative[-1]),
        peak_power_W=float(result.power.max()),
        lowest_spin_ratio=float(ratio.min()),
        recovery_time_s=_recovery_time(seconds, ratio),
    )


def _over_angle(angle: np.ndarray) -> xr.Dataset:
    words = {"units": "degree", "long_name": "angle from the bottom along the orbit"}
    return xr.Dataset(coords={"angle": ("angle", angle, words)})


def _turn(loads: BearingLoads, angle: np.ndarray, time: float) -> tuple[float, float]:
    """Start and end [s] of the turn from bottom to bottom that holds `time`."""
    # A roller that has just come to the bottom begins a turn, whatever the rounding.
    turns = np.floor(np.interp(time, loads.time, angle) / (2.0 * np.pi) + 1e-9)
    marks = 2.0 * np.pi * np.array([turns, turns + 1.0])
    if marks[0] < angle[0] - 1e-9 or marks[1] > angle[-1]:
        raise ms.InputError(
            f"no whole turn holds t = {time:g} s", where=loads.source, remedy="Choose another time."
        )
    start, end = np.interp(marks, angle, loads.time)
    return float(start), float(end)


def _recovery_time(seconds: np.ndarray, ratio: np.ndarray) -> float:
    lowest = int(np.argmin(ratio))
    recovered = np.flatnonzero(ratio[lowest:] >= _RECOVERED)
    if ratio[lowest] >= _RECOVERED or recovered.size == 0:
        return float("nan")
    return float(seconds[lowest + recovered[0]] - seconds[lowest])


def static_turn(
    variable: BearingLoads, row: str, *, thrust: bool, laws: Laws = _PAPER
) -> xr.Dataset:
    """The ninth turn of the row's first roller under the `static_load` of a history; by then spin is periodic."""
    period = (
        2.0
        * np.pi
        / (
            geometry.orbit_ratio(ms.Case(loads=variable, laws=Laws.paper()).bearing)
            * float(variable.shaft_speed.mean())
        )
    )
    return trace_turn(
        static_load(variable, thrust=thrust, duration=9.5 * period), row, 0, 8.5 * period, laws
    )


def typical_turn(loads: BearingLoads, result: xr.Dataset, row: str, laws: Laws) -> xr.Dataset:
    """The turn of the row's first roller whose energy comes closest to the median of all rollers' orbits but the last.

    `result` is the result of simulating these loads. Its orbits are counted from the roller's place at the start, which
    for the first roller is the bottom or half a pitch past it.
    """
    energy = (
        result.orbit_energy.sel(row=row).isel(orbit=slice(None, -1)).sum("interface", skipna=False)
    )
    orbit = int(np.argmin(np.abs(energy.isel(roller=0).values - np.median(energy.values))))
    middle = 0.5 * (result.orbit_start.values[orbit] + result.orbit_end.values[orbit])
    return trace_turn(loads, row, int(result.roller.values[0]), float(middle), laws)


def largest_peak(result: xr.Dataset, row: str) -> tuple[int, int]:
    """Number of the roller and of the orbit with the row's largest power at any interface, the last orbit left out.

    A turn from the bottom that begins in the last orbit may not end before the loads do.
    """
    peak = result.peak_power.sel(row=row).isel(orbit=slice(None, -1)).max("interface").values
    # A failed roller (NaN) has no peak to compare.
    roller, orbit = np.unravel_index(int(np.argmax(np.nan_to_num(peak, nan=-1.0))), peak.shape)
    return int(result.roller.values[roller]), int(orbit)


def peak_turn(loads: BearingLoads, result: xr.Dataset, row: str, laws: Laws) -> xr.Dataset:
    """The turn with the row's largest frictional power. Parameters are those of `typical_turn`."""
    roller, orbit = largest_peak(result, row)
    # An orbit counted from the roller's place at the start lies in two turns from the bottom.
    ends = float(result.orbit_start.values[orbit]), float(result.orbit_end.values[orbit]) - 1e-6
    return max(
        (trace_turn(loads, row, roller, end, laws) for end in ends),
        key=lambda turn: turn.peak_power_W,
    )


def turns(
    result: xr.Dataset, laws: Laws, threads: int | None, report: Callable[[int, int], None]
) -> dict[str, dict[str, xr.Dataset]]:
    """Turns by figure ("static", "typical", "peak") and title, from the result of the detailed case."""
    varying = varying_load()
    jobs = {
        ("static", f"{name}, {row}"): partial(static_turn, varying, row, thrust=thrust, laws=laws)
        for name, thrust in STATIC_LOADS.items()
        for row in ROWS
    }
    for name, trace in (("typical", typical_turn), ("peak", peak_turn)):
        jobs |= {(name, f"{row} row"): partial(trace, varying, result, row, laws) for row in ROWS}
    turns_by_figure: dict[str, dict[str, xr.Dataset]] = {}
    with ThreadPoolExecutor(threads or usable_processors()) as pool:
        for done, ((figure, title), turn) in enumerate(
            zip(jobs, pool.map(lambda job: job(), jobs.values()), strict=True), start=1
        ):
            turns_by_figure.setdefault(figure, {})[title] = turn
            report(done, len(jobs))
    return turns_by_figure


def inflexion_angle(turn: xr.Dataset) -> float:
    """Angle of the inflexion of spin nearest the top [degrees from the bottom], in the unloaded zone; NaN if none.

    There the deceleration is least: the slope of the spin speed has a maximum.
    """
    angle, free = turn.angle.values, turn.roller_load.values == 0.0
    slope = np.gradient(turn.spin_speed.values, angle)
    middle = slice(1, -1)
    # The load affects neighbours of a loaded sample through the difference quotient.
    inside = free[middle] & free[2:] & free[:-2]
    inside &= np.roll(inside, 1) & np.roll(inside, -1)
    inflexions = angle[middle][inside & (slope[middle] >= slope[:-2]) & (slope[middle] > slope[2:])]
    return (
        float(inflexions[np.argmin(np.abs(inflexions - 180.0))])
        if inflexions.size
        else float("nan")
    )


def compare_stability(static: BearingLoads, *, step: float = 1e-3) -> xr.Dataset:
    """Figure A1: half an orbit of a downwind roller, from pure rolling at the top through the unloaded zone to the bottom.

    `static` is a constant load that leaves the top unloaded, for at least half an orbit; `step` [s] that of both methods.

    Returns
    -------
    xarray.Dataset
        Over `angle` [degrees from the bottom]: spin over pure rolling by each method, deviation from the converged one,
        roller_load [N], relaxation_time [s] of a gripped roller (NaN without load). Attributes: where the step first exceeds
        twice the relaxation time, the limit of explicit Euler; where that has lost the solution by 2 % of pure rolling
        (NaN: never); largest deviations and statuses of the methods.
    """
    bearing = ms.Case(loads=static, laws=Laws.paper()).bearing
    case = ms.Case(
        loads=static,
        laws=Laws.paper(),
        rollers=[bearing.rollers_per_row // 2],
        traces=ms.Traces(step=step),
    )
    methods = {
        "explicit": ms.ExplicitEuler(step=step),
        "backward": ms.BackwardEuler(step=step),
        "converged": ms.Radau(tolerance=1e-7),
    }
    runs = {
        name: ms.simulate(replace(case, integrator=method)).sel(row="downwind").isel(roller=0)
        for name, method in methods.items()
    }
    converged = runs["converged"]
    ready = prepare(case)
    model, roller = ready.model, with_tables(ready.models, ready.box)[0]["downwind"]
    turned = np.degrees(model.orbit_ratio * converged.time.values * float(static.shaft_speed[0]))
    kept = turned <= 180.0
    angle = np.degrees(float(converged.start_angle)) + 90.0 + turned[kept]
    ratios = {name: (run.spin.values / run.spin_pure.values)[kept] for name, run in runs.items()}
    load = converged.roller_load.values[kept]
    ring_speed = abs(float(converged.spin_pure[0])) * model.radius
    rates = np.array(
        [
            relaxation_rate(roller.body[0], roller.tables, roller_load, ring_speed)
            if roller_load > 0.0
            else 0.0
            for roller_load in load
        ]
    )
    relaxation = np.divide(1.0, rates, out=np.full_like(rates, np.nan), where=rates > 0.0)
    deviations = {
        name: np.abs(ratios[name] - ratios["converged"]) for name in ("explicit", "backward")
    }
    beyond = np.flatnonzero(step * np.maximum(rates, 0.0) > 2.0)
    lost = np.flatnonzero(deviations["explicit"] > _LOST)

    def at(values: np.ndarray, samples: np.ndarray) -> float:
        return float(values[samples[0]]) if samples.size else float("nan")

    stability = _over_angle(angle)
    for name, values in ratios.items():
        put(
            stability,
            f"spin_ratio_{name}",
            ("angle", values),
            "1",
            f"spin over pure rolling, {name}",
        )
    for name, values in deviations.items():
        words = f"|spin - converged spin| over pure rolling, {name}"
        put(stability, f"deviation_{name}", ("angle", values), "1", words)
    put(stability, "roller_load", ("angle", load), "N", "load of the roller")
    put(
        stability,
        "relaxation_time",
        ("angle", relaxation),
        "s",
        "relaxation time of a gripped roller's slip",
    )
    return stability.assign_attrs(
        step_s=step,
        limit_angle_deg=at(angle, beyond),
        limit_load_N=at(load, beyond),
        limit_relaxation_time_s=at(relaxation, beyond),
        lost_angle_deg=at(angle, lost),
        lost_load_N=at(load, lost),
        **{
            f"largest_deviation_{name}": float(np.nanmax(values))
            for name, values in deviations.items()
        },
        **{f"status_{name}": int(run.status) for name, run in runs.items()},
    )


def nonlinear_tolerance(
    variable: BearingLoads,
    *,
    tolerances: Sequence[float] = TOLERANCES,
    step: float = 1e-2,
    threads: int | None = None,
) -> xr.Dataset:
    """Energy per orbit of the first roller of each row against the stopping tolerance of backward Euler.

    All of the time-varying load is used: what a loose iteration adds comes in few orbits, so that a short part gives a
    mean by chance. Beside it stands its downward static load, under which orbits are alike. `tolerances` are the relative
    changes of spin at which the iteration stops, `step` [s] is the method's.

    Returns
    -------
    xarray.Dataset
        Over (stopping_tolerance, row): energy and cage_energy per orbit [J] under time-varying load, static_energy per
        orbit [J] under static load, ratio of the means [1]; the same over (row), converged.
    """
    loads = {
        "varying": variable,
        "static": static_load(variable, thrust=False, duration=_STATIC_DURATION),
    }

    def per_orbit(integrator: ms.BackwardEuler | ms.Radau) -> xr.Dataset:
        runs = {
            name: ms.simulate(
                ms.Case(loads=history, laws=Laws.paper(), rollers=[0], integrator=integrator),
                threads=1,
            ).isel(roller=0)
            for name, history in loads.items()
        }
        varying, static = (run.orbit_energy.mean("orbit", skipna=False) for run in runs.values())
        whole, still = (energies.sum("interface", skipna=False) for energies in (varying, static))
        failed = sum((run.status != 0).astype(int) for run in runs.values())
        values = xr.Dataset()
        for name, energies, units, words in (
            ("energy", whole, "J", "energy per orbit, time-varying load"),
            ("cage_energy", varying.sel(interface="cage", drop=True), "J", "energy per orbit at the cage, time-varying load"),
            ("static_energy", still, "J", "energy per orbit, downward static load"),
            ("ratio", whole / still, "1", "energy, time-varying over static load"),
            ("failed", failed, "1", "failed integrations"),
        ):  # fmt: skip
            put(values, name, energies, units, words)
        return values.drop_vars(["roller", "start_angle"], errors="ignore")

    methods = [
        _CONVERGED,
        *(ms.BackwardEuler(step=step, tolerance=tolerance) for tolerance in tolerances),
    ]
    with ThreadPoolExecutor(threads or usable_processors()) as pool:
        converged, *runs = pool.map(per_orbit, methods)
    about = ("stopping_tolerance", "1", "relative change of spin at which the iteration stops")
    attributes = {"step_s": step, "load": variable.source, "load_duration_s": variable.duration}
    return _beside_converged(dict(zip(tolerances, runs, strict=True)), converged, about, attributes)


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

    The part of the loads from `start` to `end` [s] is used, at least two orbits; rollers begin it in pure rolling at
    their initial places.

    Returns
    -------
    xarray.Dataset
        Over (step, row): mean_peak_power and largest_peak_power [W] over all (roller, orbit) samples; the same over
        (row), converged.
    """
    loads = variable.window(start, end)

    def peaks(integrator: ms.BackwardEuler | ms.Radau) -> xr.Dataset:
        run = ms.simulate(
            ms.Case(loads=loads, laws=Laws.paper(), rollers=rollers, integrator=integrator),
            threads=threads,
        )
        peak, samples = run.peak_power.max("interface", skipna=False), ("roller", "orbit")
        values = xr.Dataset()
        put(
            values, "mean_peak_power", peak.mean(samples, skipna=False), "W", "mean P_max per orbit"
        )
        put(
            values,
            "largest_peak_power",
            peak.max(samples, skipna=False),
            "W",
            "largest P_max of all orbits",
        )
        put(values, "failed", (run.status != 0).sum("roller"), "1", "failed integrations")
        return values

    return _beside_converged(
        {step: peaks(ms.BackwardEuler(step=step, tolerance=_TIGHT)) for step in steps},
        peaks(_CONVERGED),
        ("step", "s", "fixed step"),
        {
            "tolerance": _TIGHT,
            "start_s": loads.start,
            "end_s": loads.end,
            "load": loads.source,
        },
    )


def _beside_converged(
    runs: Mapping[float, xr.Dataset],
    converged: xr.Dataset,
    dimension: tuple[str, str, str],
    attributes: Mapping,
) -> xr.Dataset:
    """Runs along a new dimension, and the converged values with `_converged` appended to their names."""
    name, units, long_name = dimension
    values = xr.DataArray(
        np.array(list(runs)), dims=name, name=name, attrs={"units": units, "long_name": long_name}
    )
    along = xr.concat(list(runs.values()), values, combine_attrs="override")
    along = along.merge(
        converged.rename({variable: f"{variable}_converged" for variable in converged.data_vars})
    )
    return along.assign_attrs(
        attributes, converged_method="Radau", converged_tolerance=_CONVERGED.tolerance
    )


def experiments(
    result: xr.Dataset, threads: int | None, report: Callable[[int, int], None]
) -> dict[str, xr.Dataset]:
    """Figure A1 and the two experiments, under the paper's model; `result` is the detailed case under it."""
    varying = varying_load()
    _, orbit = largest_peak(result, "upwind")
    # Two orbits before the largest peak and one after it.
    start = max(float(result.orbit_start[orbit]) - 14.0, float(varying.time[0]))
    end = min(float(result.orbit_end[orbit]) + 7.0, float(varying.time[-1]))
    jobs = {
        "A1": lambda: compare_stability(static_load(varying, thrust=False, duration=4.0)),
        "nonlinear_tolerance": lambda: nonlinear_tolerance(varying, threads=threads),
        "step_size": lambda: step_size(varying, start=start, end=end, threads=threads),
    }
    datasets = {}
    for done, (name, job) in enumerate(jobs.items(), start=1):
        datasets[name] = job()
        report(done, len(jobs))
    return datasets
