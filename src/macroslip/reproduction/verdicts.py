"""What the paper states, beside what a converged solution gives: verdicts computed from numbers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.wording import three_digits
from macroslip.reproduction.statement import Statement, about, verdict

if TYPE_CHECKING:
    import xarray as xr

#: Statements that need more than a study.
UNLOADED = "an unloaded roller slows with an inflexion at the top and snaps back in the load zone"
VARYING = "time-varying loads give about 100 times the static energy"
EULER = "explicit Euler is unstable in the load zone, backward Euler is not"
#: Relative standard deviation from which on a quantity varies highly.
HIGH_VARIATION = 0.5
#: Probability below which a rank correlation with wind speed counts as a trend.
TREND_LEVEL = 0.05
#: Relative distance from the energy of a roller gripped all round within which that explains a row's energy.
GRIPPED = 0.1
#: Share of the energy from which on an interface dominates.
DOMINANT = 0.5
#: Distance from the top within which an inflexion is at the top [degrees].
AT_TOP = 15.0


def _by_wind_speed(values: xr.DataArray) -> xr.DataArray:
    """Mean over the turbulence classes; NaN if any of them is."""
    return values.groupby("wind_speed").mean(skipna=False)


def _range(values: xr.DataArray) -> float:
    return float(values.max(skipna=False) / values.min(skipna=False) - 1.0)


def energy_over_wind_speed(numbers: xr.Dataset, study: xr.Dataset) -> Statement:
    """Where frictional energy is highest, and how much of that is the number of orbits (from the study)."""
    energy = _by_wind_speed(numbers.both_rows_normalised)
    order = energy.wind_speed.values[np.argsort(-energy.values)]
    highest = sorted(float(speed) for speed in order[:2])
    spread = float(energy.max() / energy.min() - 1.0)
    found = {"highest_mps": highest, "normalised_energy": energy.values.tolist(), "spread": spread}
    words = f"highest at {order[0]:g} and {order[1]:g} m/s, and {100 * spread:.1f} % between the highest and the lowest"
    orbits = _by_wind_speed(study.orbits)
    slowest = float(orbits.wind_speed[int(np.argmin(orbits.values))])
    change = {row: _range(_by_wind_speed(study.orbit_energy.sel(row=row))) for row in study.row.values.tolist()}
    per_orbit = " and ".join(f"{100 * value:.1f} % {row}" for row, value in change.items())
    because = (
        f"between wind speeds the energy of one orbit changes by {per_orbit}, the number of orbits by "
        f"{100 * _range(orbits):.1f} %: it is least at {slowest:g} m/s, where the shaft turns slowest"
    )
    return Statement(
        paper="energy is highest at 12 and 14 m/s",
        verdict=verdict([highest == [12.0, 14.0]], found),
        found=words,
        because="" if highest == [12.0, 14.0] else because,
        numbers=found,
    )


def energy_between_rows(numbers: xr.Dataset, thrust_energy: float = math.nan) -> Statement:
    """Energy of the downwind over the upwind row.

    Parameters
    ----------
    numbers : xarray.Dataset
        From `paper_numbers`.
    thrust_energy : float
        Energy per orbit [J] of a downwind roller under the constant mean load with thrust, gripped all round.
    """
    ratio = numbers.energy_ratio
    per_orbit = numbers.orbit_energy.sel(row="downwind") / thrust_energy
    explained = bool((np.abs(per_orbit - 1.0) < GRIPPED).all())
    because = (
        "a roller that is gripped all round spends nothing but the friction of its own weight at the cage, "
        f"{1e3 * thrust_energy:.0f} mJ an orbit whatever its load; the downwind rollers spend "
        f"{float(per_orbit.min()):.2f} to {float(per_orbit.max()):.2f} times that, and no load adds to it"
    )
    found = {"lowest": float(ratio.min(skipna=False)), "highest": float(ratio.max(skipna=False))}
    parts = [about(value, 10.0) for value in found.values()]
    good = all(parts)
    return Statement(
        paper="the downwind row spends about 10 times the energy of the upwind row",
        verdict=verdict(parts, found),
        found=f"{three_digits(found['lowest'])} to {three_digits(found['highest'])} times",
        because=because if explained and not good else "",
        numbers=found,
    )


def peak_power_over_wind_speed(numbers: xr.Dataset) -> Statement:
    """Trend and variation of peak power."""
    from scipy.stats import spearmanr

    found: dict[str, float | list[float]] = {}
    words, parts, trends = [], [], []
    for row in numbers.row.values:
        mean = numbers.peak_power_mean.sel(row=row)
        rank = spearmanr(numbers.wind_speed.values, mean.values)
        variation = float((numbers.peak_power_std.sel(row=row) / mean).median(skipna=False))
        found |= {f"rank_correlation_{row}": float(rank.statistic), f"probability_{row}": float(rank.pvalue)}
        found[f"variation_{row}"] = variation
        trend = rank.pvalue < TREND_LEVEL
        kind = ("rises" if rank.statistic > 0 else "falls") if trend else "has no trend"
        words.append(
            f"{row} the mean {kind} over wind speed (rank correlation {rank.statistic:.2f}) and the standard deviation "
            f"is {variation:.1f} times the mean"
        )
        parts += [not trend, variation >= HIGH_VARIATION]
        speeds = _by_wind_speed(mean)
        trends.append(f"{float(f'{float(speeds[-1] / speeds[0]):.2g}'):g} times {row}")
    return Statement(
        paper="peak power has no trend over wind speed but high variance",
        verdict=verdict(parts, found),
        found="; ".join(words),
        because=""
        if all(parts)
        else f"from the lowest to the highest wind speed the mean becomes {' and '.join(trends)}",
        numbers=found,
    )


def peak_power_between_rows(numbers: xr.Dataset, steps: xr.Dataset | None = None) -> Statement:
    """Mean peak power of the downwind over the upwind row; `steps` from `step_size` has the effect of a fixed step."""
    ratio = numbers.peak_power_ratio
    mean = _by_wind_speed(ratio)
    highest_at = float(mean.wind_speed[int(np.argmax(mean.values))])
    found = {
        "lowest": float(ratio.min(skipna=False)),
        "highest": float(ratio.max(skipna=False)),
        "highest_at_mps": highest_at,
        "mean_by_wind_speed": mean.values.tolist(),
    }
    good = about(found["highest"], 5.0) and highest_at == 12.0
    because = ""
    if steps is not None:
        coarse = steps.mean_peak_power.isel(step=int(np.argmax(steps.step.values)))
        fixed, converged = (
            float(one.sel(row="downwind") / one.sel(row="upwind")) for one in (coarse, steps.mean_peak_power_converged)
        )
        because = (
            "the largest powers are those of unloaded upwind rollers that are gripped again, which wind and turbulence "
            f"make more frequent; a fixed step does not resolve them: in an excerpt the ratio is {fixed:.2g} with "
            f"backward Euler at {1e3 * float(coarse.step):g} ms and {converged:.2g} converged"
        )
    return Statement(
        paper="the downwind row's mean peak power is up to 5 times the upwind row's, most at 12 m/s",
        verdict=verdict([about(found["highest"], 5.0), highest_at == 12.0], found),
        found=f"{three_digits(found['lowest'])} to {three_digits(found['highest'])} times, most at {highest_at:g} m/s",
        because="" if good else because,
        numbers=found,
    )


def unloaded_roller(turn: xr.Dataset, inflexion: float) -> Statement:
    """How a roller behaves in the unloaded zone of a downward static load."""
    lowest, recovery = turn.attrs["lowest_spin_ratio"], turn.attrs["recovery_time_s"]
    found = {"lowest_spin_ratio": lowest, "inflexion_deg": inflexion, "recovery_s": recovery}
    period = turn.attrs["end_s"] - turn.attrs["start_s"]
    inflects = "has no inflexion" if math.isnan(inflexion) else f"inflects {abs(inflexion - 180.0):.1f}° from the top"
    returns = "does not return" if math.isnan(recovery) else f"is back at 99 % within {1e3 * recovery:.0f} ms"
    words = f"it slows to {100 * lowest:.0f} % of pure rolling, {inflects} and {returns}"
    return Statement(
        paper=UNLOADED,
        # No inflexion and no return are findings; only a failed integration leaves nothing to judge.
        verdict=verdict(
            [lowest < 0.99, abs(inflexion - 180.0) <= AT_TOP, recovery < 0.02 * period], {"lowest": lowest}
        ),
        found=words,
        numbers=found,
    )


def varying_over_static(
    numbers: xr.Dataset, case: str, static: dict[str, dict[str, float]], tolerances: xr.Dataset | None = None
) -> Statement:
    """Energy per orbit under time-varying over that under static load.

    Parameters
    ----------
    numbers : xarray.Dataset
        From `paper_numbers`.
    case : str
        The time-varying case whose means the static loads are.
    static : dict
        Energy per orbit [J] by name of the static load and row.
    tolerances : xarray.Dataset, optional
        From `nonlinear_tolerance`: what an iteration that stops early adds.
    """
    found, words = {}, []
    for name, rows in static.items():
        for row, energy in rows.items():
            found[f"{name}_{row}"] = float(numbers.orbit_energy.sel(case=case, row=row)) / energy
        ratios = ", ".join(f"{three_digits(found[f'{name}_{row}'])} {row}" for row in rows)
        words.append(f"{ratios} against the {name} static load")
    good = all(about(ratio, 100.0) for ratio in found.values())
    because = (
        "force balance bounds the difference of a gripped roller's raceway forces by its weight, drag and inertia, "
        "so its cage carries these and no more, however the load varies"
    )
    if tolerances is not None:
        one = tolerances.sel(row="downwind").sortby("stopping_tolerance")
        loose = one.isel(stopping_tolerance=int(np.argmin(np.abs(np.log10(one.stopping_tolerance.values) + 6.0))))
        because += (
            f"; an iteration on spin that stops at a relative change of {float(loose.stopping_tolerance):.0e} breaks "
            f"that balance and gives {float(loose.ratio):,.0f} times"
        )
    return Statement(
        paper=VARYING,
        verdict=verdict([good], found),
        found="; ".join(words),
        because="" if good else because,
        numbers=found,
    )


def cage_dominates(study: xr.Dataset) -> Statement:
    """The cage's share of a roller's energy, of both rows over all cases."""
    energy = study.energy.sum("roller", skipna=False)
    shares = energy / energy.sum("interface", skipna=False)
    share = shares.sel(interface="cage")
    found: dict[str, float | list[float]] = {}
    words, parts, others = [], [], []
    for row in study.row.values.tolist():
        mean = shares.sel(row=row).mean("case")
        others.append(f"{row} the {mean.interface.values[int(np.argmax(mean.values))]} interface takes most")
        least, most = (float(getattr(share.sel(row=row), name)(skipna=False)) for name in ("min", "max"))
        found |= {f"least_{row}": least, f"most_{row}": most}
        words.append(f"{three_digits(100 * least)} to {three_digits(100 * most)} % of the energy {row}")
        parts.append(least >= DOMINANT)
    return Statement(
        paper="friction at the cage dominates the energy",
        verdict=verdict(parts, found),
        found=f"the cage takes {', '.join(words)}",
        because="" if all(parts) else f"on average over the cases {' and '.join(others)}",
        numbers=found,
    )


def euler_stability(stability: xr.Dataset) -> Statement:
    """Explicit against backward Euler at the same step."""
    values = stability.attrs
    explicit, backward = values["largest_deviation_explicit"], values["largest_deviation_backward"]
    found = {"explicit": explicit, "backward": backward}
    failed = values["status_explicit"] != 0
    # Where it is unstable its deviation is chaotic; only the order of magnitude is the same on every machine.
    order = (
        "leaves the range that friction allows"
        if failed
        else f"is off by more than {10.0 ** math.floor(math.log10(explicit)):g} times"
    )
    words = f"explicit Euler at {1e3 * values['step_s']:g} ms {order if failed else f'{order} pure rolling'}"
    if math.isfinite(values["lost_angle_deg"]):
        words += f", lost {values['lost_angle_deg']:.0f}° from the bottom at {values['lost_load_N'] / 1e3:.1f} kN"
    words += f"; backward Euler is off by at most {backward:.2g}"
    if failed:
        # An explicit method that was stopped is unstable; its missing numbers do not hide that.
        found.pop("explicit")
    return Statement(
        paper=EULER,
        verdict=verdict([failed or explicit > 0.1, backward < 0.1], found),
        found=words,
        numbers=found,
    )
