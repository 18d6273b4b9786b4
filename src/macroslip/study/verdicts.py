"""What the paper states, beside what a converged solution gives: verdicts computed from numbers."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr

AGREES, PARTLY, DIFFERS, UNKNOWN = "agrees", "agrees in part", "differs", "cannot be judged"
#: "About" in a statement allows this factor either way.
ABOUT = 2.0
#: Relative standard deviation from which on a quantity varies highly.
HIGH_VARIATION = 0.5
#: Probability below which a rank correlation with wind speed counts as a trend.
TREND_LEVEL = 0.05
#: Distance from the top within which an inflexion is at the top [degrees].
AT_TOP = 15.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Statement:
    """One statement of the paper and what was found.

    Parameters
    ----------
    paper : str
        What the paper states.
    verdict : str
        "agrees", "agrees in part", "differs" or "cannot be judged" (a number is NaN).
    found : str
        What a converged solution gives, in words with numbers.
    numbers : dict
        The numbers the verdict rests on.
    """

    paper: str
    verdict: str
    found: str
    numbers: dict[str, float | list[float]] = field(default_factory=dict)

    def line(self) -> str:
        """The statement in one line."""
        return f"Paper: {self.paper}. Converged: {self.found} ({self.verdict})."


def verdict(parts: list[bool], numbers: dict[str, float | list[float]]) -> str:
    """The verdict on a statement of several parts that rests on `numbers`.

    Examples
    --------
    >>> verdict([True, False], {"ratio": 2.0}), verdict([True], {"ratio": float("nan")})
    ('agrees in part', 'cannot be judged')
    """
    values = [one for value in numbers.values() for one in (value if isinstance(value, list) else [value])]
    if not all(math.isfinite(value) for value in values):
        return UNKNOWN
    return AGREES if all(parts) else (PARTLY if any(parts) else DIFFERS)


def _about(value: float, stated: float) -> bool:
    return stated / ABOUT <= value <= stated * ABOUT


def _by_wind_speed(values: xr.DataArray) -> xr.DataArray:
    """Mean over the turbulence classes; NaN if any of them is."""
    return values.groupby("wind_speed").mean(skipna=False)


def energy_over_wind_speed(numbers: xr.Dataset) -> Statement:
    """Where frictional energy is highest."""
    energy = _by_wind_speed(numbers.both_rows_normalised)
    order = energy.wind_speed.values[np.argsort(-energy.values)]
    highest = sorted(float(speed) for speed in order[:2])
    spread = float(energy.max() / energy.min() - 1.0)
    found = {"highest_mps": highest, "normalised_energy": energy.values.tolist(), "spread": spread}
    words = f"highest at {order[0]:g} and {order[1]:g} m/s, and {100 * spread:.1f} % between the highest and the lowest"
    return Statement(
        paper="energy is highest at 12 and 14 m/s",
        verdict=verdict([highest == [12.0, 14.0]], found),
        found=words,
        numbers=found,
    )


def energy_between_rows(numbers: xr.Dataset) -> Statement:
    """Energy of the downwind over the upwind row."""
    ratio = numbers.energy_ratio
    found = {"lowest": float(ratio.min(skipna=False)), "highest": float(ratio.max(skipna=False))}
    good = all(_about(value, 10.0) for value in found.values())
    return Statement(
        paper="the downwind row spends about 10 times the energy of the upwind row",
        verdict=verdict([good], found),
        found=f"{found['lowest']:.2f} to {found['highest']:.2f} times",
        numbers=found,
    )


def peak_power_over_wind_speed(numbers: xr.Dataset) -> Statement:
    """Trend and variation of peak power."""
    from scipy.stats import spearmanr

    found: dict[str, float | list[float]] = {}
    words, parts = [], []
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
    return Statement(
        paper="peak power has no trend over wind speed but high variance",
        verdict=verdict(parts, found),
        found="; ".join(words),
        numbers=found,
    )


def peak_power_between_rows(numbers: xr.Dataset) -> Statement:
    """Mean peak power of the downwind over the upwind row."""
    ratio = numbers.peak_power_ratio
    mean = _by_wind_speed(ratio)
    highest_at = float(mean.wind_speed[int(np.argmax(mean.values))])
    found = {
        "lowest": float(ratio.min(skipna=False)),
        "highest": float(ratio.max(skipna=False)),
        "highest_at_mps": highest_at,
        "mean_by_wind_speed": mean.values.tolist(),
    }
    return Statement(
        paper="the downwind row's mean peak power is up to 5 times the upwind row's, most at 12 m/s",
        verdict=verdict([_about(found["highest"], 5.0), highest_at == 12.0], found),
        found=f"{found['lowest']:.2f} to {found['highest']:.2f} times, most at {highest_at:g} m/s",
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
        paper="an unloaded roller slows with an inflexion at the top and snaps back in the load zone",
        # No inflexion and no return are findings; only a failed integration leaves nothing to judge.
        verdict=verdict(
            [lowest < 0.99, abs(inflexion - 180.0) <= AT_TOP, recovery < 0.02 * period], {"lowest": lowest}
        ),
        found=words,
        numbers=found,
    )


def varying_over_static(numbers: xr.Dataset, case: str, static: dict[str, dict[str, float]]) -> Statement:
    """Energy per orbit under time-varying over that under static load.

    Parameters
    ----------
    numbers : xarray.Dataset
        From `paper_numbers`.
    case : str
        The time-varying case whose means the static loads are.
    static : dict
        Energy per orbit [J] by name of the static load and row.
    """
    found, words = {}, []
    for name, rows in static.items():
        for row, energy in rows.items():
            found[f"{name}_{row}"] = float(numbers.orbit_energy.sel(case=case, row=row)) / energy
        ratios = ", ".join(f"{found[f'{name}_{row}']:.2f} {row}" for row in rows)
        words.append(f"{ratios} against the {name} static load")
    return Statement(
        paper="time-varying loads give about 100 times the static energy",
        verdict=verdict([all(_about(ratio, 100.0) for ratio in found.values())], found),
        found="; ".join(words),
        numbers=found,
    )


def euler_stability(stability: xr.Dataset) -> Statement:
    """Explicit against backward Euler at the same step."""
    values = stability.attrs
    explicit, backward = values["largest_deviation_explicit"], values["largest_deviation_backward"]
    found = {"explicit": explicit, "backward": backward}
    failed = values["status_explicit"] != 0
    # Where it is unstable its deviation is chaotic; only the order of magnitude is the same on every machine.
    order = "leaves the range that friction allows" if failed else f"is off by more than {10.0 ** math.floor(math.log10(explicit)):g} times"
    words = f"explicit Euler at {1e3 * values['step_s']:g} ms {order if failed else f'{order} pure rolling'}"
    if math.isfinite(values["lost_angle_deg"]):
        words += f", lost {values['lost_angle_deg']:.0f}° from the bottom at {values['lost_load_N'] / 1e3:.1f} kN"
    words += f"; backward Euler is off by at most {backward:.2g}"
    if failed:
        # An explicit method that was stopped is unstable; its missing numbers do not hide that.
        found.pop("explicit")
    return Statement(
        paper="explicit Euler is unstable in the load zone, backward Euler is not",
        verdict=verdict([failed or explicit > 0.1, backward < 0.1], found),
        found=words,
        numbers=found,
    )


def tolerance_line(experiment: xr.Dataset) -> str:
    """Between which stopping tolerances backward Euler passes 100 times the static energy, in one line."""
    one = experiment.sel(row="downwind").sortby("stopping_tolerance")
    ratio, tolerance = one.ratio.values, one.stopping_tolerance.values
    if not np.isfinite(ratio).all():
        return f"Backward Euler against its stopping tolerance: {UNKNOWN}, an integration failed."
    said = [f"{value:,.3g}" if value < 1e3 else f"{value:,.0f}" for value in ratio]
    beyond = np.flatnonzero(ratio >= 100.0)
    if beyond.size and beyond[0] > 0:
        k = int(beyond[0])
        passes = (
            f"passes 100 times between a relative change of {tolerance[k - 1]:.0e} ({said[k - 1]} times) and "
            f"{tolerance[k]:.0e} ({said[k]} times)"
        )
    else:
        passes = f"is {said[-1]} times at a relative change of {tolerance[-1]:.0e}"
    return (
        f"Backward Euler at {1e3 * experiment.attrs['step_s']:g} ms, downwind roller: with an iteration on spin that "
        f"stops early, energy over the static one {passes}; it is {said[0]} at {tolerance[0]:.0e} and "
        f"{float(one.ratio_converged):.3g} converged. What the paper's authors did is not known."
    )


def step_line(experiment: xr.Dataset) -> str:
    """Mean peak power of the upwind row at the largest and the smallest fixed step, in one line."""
    peak = experiment.mean_peak_power.sel(row="upwind").sortby("step").values
    converged = float(experiment.mean_peak_power_converged.sel(row="upwind"))
    if not np.isfinite([*peak, converged]).all():
        return f"Backward Euler against its step: {UNKNOWN}, an integration failed."
    steps = np.sort(experiment.step.values)
    return (
        f"Backward Euler, mean peak power per orbit upwind: {peak[-1]:.2g} W at a fixed step of "
        f"{1e3 * steps[-1]:g} ms, {peak[0]:.2g} W at {1e3 * steps[0]:g} ms; converged {converged:.2g} W."
    )


def failure_line(failed: dict[str, int], study_rollers: int) -> str:
    """How many integrations failed, of the study and beside it, in one line."""
    if not any(failed.values()):
        return f"All {study_rollers} rollers of the study and all integrations beside it completed, explicit Euler in A1 apart."
    parts = ", ".join(f"{count} in {place.replace('_', ' ')}" for place, count in failed.items() if count)
    return f"FAILED INTEGRATIONS: {parts} (the study has {study_rollers} rollers); every mean they enter is missing."
