"""Heat of the bearing over the wind, 4 to 24 m/s, and over the speed, beside measured heat of another turbine's main bearing.

Own heat is that of the base bearing at 35 °C in all bundled load cases but events, over 600 s, of two rollers of each row. The measured heat is of a turbine of 2 MW whose rotor turns at rated speed from 7 m/s on: its trend over
the wind is compared with the loads of the cases at rated speed, that over the speed with the loads of 8 m/s. SKF's and
Palmgren's friction under the same loads stand beside it.
"""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from benchmarks.friction_torque import ROLLERS, SPEED, torque
from macroslip import (
    BearingLoads,
    Case,
    Drivetrain,
    HubLoads,
    Laws,
    bundled_cases,
    main_bearing_load,
)
from validation.comparison import Comparison, Range

DATA = Path(__file__).parent / "data" / "main_bearing_heat.csv"
#: Rated speed of the measured turbine [r/min]; heat capacity of its bearing [J/K], 4 to 8 t of steel.
RATED_RPM, CAPACITY = 17.0, (2e6, 4e6)
MODELS = ("own", "skf", "palmgren")


class Heat(NamedTuple):
    """Friction power [W]: own, and the handbooks' under the same loads; mean speed of the shaft [rad/s]."""

    own: float
    skf: float
    palmgren: float
    speed: float


def wind_cases() -> dict[int, list[str]]:
    """Names of the bundled cases by mean wind speed [m/s], without events."""
    found: dict[int, list[str]] = {}
    for name in bundled_cases("year"):
        wind = re.match(r"\d+", name)
        if wind:
            found.setdefault(int(wind[0]), []).append(name)
    return dict(sorted(found.items()))


@lru_cache
def heat(
    name: str, speed: float | None = None, oil_supply: str | None = None, every: bool = False
) -> Heat:
    """Heat of a load case, at its own speed or at a constant one [rad/s]; with `every` of all rollers."""
    loads = main_bearing_load(HubLoads.bundled(name), Drivetrain())
    if speed is not None:
        loads = BearingLoads(
            loads.time, np.full_like(loads.time, speed), loads.force, source=loads.source
        )
    case = Case(
        loads=loads,
        rollers="all" if every else ROLLERS,
        laws=Laws.physical(),
        oil_supply=oil_supply,
        rating=False,
    )
    found, mean = torque(case, loads), float(np.mean(loads.shaft_speed))
    return Heat(found.total * mean, found.skf * mean, found.palmgren * mean, mean)


def over_wind(speed: float | None = None, oil_supply: str | None = None) -> pd.DataFrame:
    """Heat [W] by model over wind speed [m/s]: mean of all cases; at another speed or supply turbulence class B, first seed."""
    changed = speed is not None or oil_supply is not None
    rows = {
        wind: np.mean(
            [heat(name, speed, oil_supply) for name in ([f"{wind}B"] if changed else names)], axis=0
        )
        for wind, names in wind_cases().items()
    }
    return pd.DataFrame.from_dict(rows, orient="index", columns=list(Heat._fields))


@lru_cache
def measured() -> pd.DataFrame:
    """Heat in K per hour over rotor speed [r/min] and wind [m/s], with its error; without wind below rated speed."""
    return pd.read_csv(DATA, comment="#")


def measured_ratio(over: tuple[float, float | None], under: tuple[float, float | None]) -> Range:
    """Heat at one rotor speed [r/min] and wind [m/s] over that at another, less and plus the error."""
    table = measured()

    def at(place: tuple[float, float | None]) -> tuple[float, float]:
        speed, wind = place
        here = table.wind_mps.isna() if wind is None else table.wind_mps == wind
        row = table[(table.rotor_speed_rpm == speed) & here].iloc[0]
        return float(row.q_K_per_h), float(row.error)

    (high, high_error), (low, low_error) = at(over), at(under)
    ratio = high / low
    error = ratio * float(np.hypot(high_error / high, low_error / low))
    return Range(ratio - error, ratio + error)


def at_rated_speed(wind: float, model: str = "own") -> float:
    """Heat [W] at a wind speed [m/s] and rated rotor speed, between the two cases beside it."""
    winds = list(wind_cases())
    above = int(np.searchsorted(winds, wind))
    near = winds[max(above - 1, 0) : above + 1]
    return float(np.interp(wind, near, [getattr(heat(f"{one}B", SPEED), model) for one in near]))


def computed_ratio(over: float, under: float, model: str = "own") -> float:
    """Heat at one wind over that at another [m/s], loads of the cases at rated speed."""
    return at_rated_speed(over, model) / at_rated_speed(under, model)


def speed_ratio(model: str = "own", low: float = 8.7) -> float:
    """Heat at a low rotor speed [r/min of the measured turbine] over that at rated speed, loads of 8 m/s."""
    slow, fast = (getattr(heat("8B", speed), model) for speed in (SPEED * low / RATED_RPM, SPEED))
    return float(slow / fast)


def compare() -> list[Comparison]:
    """The lines of the table."""
    rows = []

    def add(quantity: str, found: Range, own: dict[str, float], decides: str) -> None:
        others = f"; SKF {own['skf']:.2f}, Palmgren {own['palmgren']:.2f}"
        ratio = Range(own["own"] / found.high, own["own"] / found.low)
        rows.append(Comparison(quantity + others, found, Range.of(own["own"]), ratio, decides))

    for over, under, decides in (
        (12.0, 15.0, "nothing: all three models have it"),
        (12.0, 13.25, "nothing: all three models have it"),
        (12.0, 8.0, "growth with load: microslip has a part of it, the handbooks have less"),
    ):
        found = measured_ratio((RATED_RPM, over), (RATED_RPM, under))
        own = {model: computed_ratio(over, under, model) for model in MODELS}
        add(f"heat at {over:g} over {under:g} m/s, rated speed [-]", found, own, decides)
    add(
        "heat at 8.7 over 17 r/min [-]",
        measured_ratio((8.7, None), (RATED_RPM, 8.0)),
        {model: speed_ratio(model) for model in MODELS},
        "power of speed; a dry part such as seals is missing",
    )
    level = measured_level()
    own = float(np.mean([heat(name).own for name in wind_cases()[12]]))
    rows.append(
        Comparison(
            "heat at 12 m/s [W]", level, Range.of(own), Range(own / level.high, own / level.low),
            "nothing alone: another turbine, its heat capacity estimated",
        )
    )  # fmt: skip
    return rows


def measured_level() -> Range:
    """Heat at rated speed and 12 m/s [W] with the estimated heat capacity."""
    table = measured()
    q = float(table[table.wind_mps == 12.0].q_K_per_h.iloc[0])
    return Range(*(q * capacity / 3600.0 for capacity in CAPACITY))


def draw(path: Path) -> None:
    """Heat over the wind by model; its trend at rated speed and over the speed beside measured values."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13, 3.8), layout="constrained")
    level, trend, slow = figure.subplots(1, 3)
    labels = dict(zip(MODELS, ("this program", "SKF", "Palmgren"), strict=True))
    table, rated = over_wind(), over_wind(SPEED)
    for model, colour in zip(MODELS, ("C0", "C1", "C2"), strict=True):
        level.plot(table.index, table[model], color=colour, label=labels[model])
        trend.plot(rated.index, rated[model] / rated[model][12], color=colour, label=labels[model])
        speeds = (4.0, 8.7, 11.4, 14.8, RATED_RPM)
        slow.plot(
            speeds, [speed_ratio(model, one) for one in speeds], color=colour, label=labels[model]
        )
    level.plot(
        table.index,
        over_wind(oil_supply="flooded").own,
        "--",
        color="C0",
        label="this program, flooded",
    )
    for wind, names in wind_cases().items():
        level.plot([wind] * len(names), [heat(name).own for name in names], ".", color="C0", ms=4)
    found = measured()
    full = found[found.wind_mps.notna()]
    for axis, rows, place, unit in (
        (trend, full, full.wind_mps, float(full[full.wind_mps == 12.0].q_K_per_h.iloc[0])),
        (slow, found[found.wind_mps.isna() | (found.wind_mps == 8.0)], None, float(full[full.wind_mps == 8.0].q_K_per_h.iloc[0])),
    ):  # fmt: skip
        where = rows.rotor_speed_rpm if place is None else place
        axis.errorbar(
            where,
            rows.q_K_per_h / unit,
            rows.error / unit,
            fmt="ko",
            ms=4,
            capsize=2,
            label="measured",
        )
    level.set(xlabel="mean wind speed [m/s]", ylabel="friction power [W]", ylim=(0.0, None))
    trend.set(
        xlabel="wind speed [m/s]",
        ylabel="heat at rated speed, over that at 12 m/s",
        ylim=(0.0, None),
    )
    slow.set(
        xlabel="rotor speed [r/min]",
        ylabel="heat, over that at 17 r/min and 8 m/s",
        ylim=(0.0, None),
    )
    for axis in (level, trend, slow):
        axis.legend(fontsize="x-small")
    figure.savefig(path, dpi=110)
