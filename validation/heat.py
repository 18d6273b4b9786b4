"""Heat of the bearing over speed and wind, at the measured temperatures, beside that of two turbines.

The measured heat is of main bearings of unknown type: those of a 2 MW turbine (La Haute Borne) over
rotor speed and wind, and the front and rear one of a turbine of 1.45 MW (WT23) over rotor speed.
Own heat is that of two rollers of each row of the base bearing. Its loads are the bundled ones of
class B at the wind of the point, between those of the winds beside it; the record's time is
stretched so that the rotor has the same part of its rated speed, and the oil has the temperature of
the bearing. SKF's and Palmgren's friction at the same states stand beside it.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from benchmarks.friction_torque import ROLLERS, SPEED, torque
from macroslip import BearingLoads, Case, Drivetrain, HubLoads, Laws, main_bearing_load
from macroslip.constants import ZERO_CELSIUS
from validation.comparison import Comparison, Range

DATA = Path(__file__).parent / "data"
MODELS = ("own", "skf", "palmgren")
SUPPLIES: tuple[str | float, ...] = ("skf", "flooded", 0.7)
#: Part of a load case that is simulated [s], before its time is stretched.
SECONDS = 600.0
#: Winds of the bundled cases [m/s].
WINDS = tuple(range(4, 25, 2))
BEARINGS = ("front", "rear")
#: Rated rotor speeds [r/min].
RATED_LHB, RATED_WT23 = 17.1, 17.7
#: Rate at which a warm bearing of La Haute Borne cools [1/h]; heat capacity [J/K] of 4 to 8 t of
#: steel.
COOLING, CAPACITY = 0.1, (2e6, 4e6)
#: Mean temperature [degC] of the bearings of the three turbines of La Haute Borne over wind [m/s].
LHB_MEANS = {4: 27.2, 6: 29.0, 8: 30.1, 10: 29.4, 12: 29.1, 14: 29.7, 16: 29.5}
#: Temperature at rated speed and 8 m/s there [degC].
LHB_RATED = LHB_MEANS[8]


class Heat(NamedTuple):
    """Friction power [W]: own, and the handbooks' under the same loads."""

    own: float
    skf: float
    palmgren: float


class State(NamedTuple):
    """What a bearing runs under."""

    wind: float  #: Of its loads [m/s]
    speed: float  #: Of the rotor, over its rated speed [1]
    celsius: float  #: Temperature of bearing and oil [degC]
    supply: str | float = "skf"  #: As `oil_supply` has it


@lru_cache
def power_of_case(wind: int, speed: float, celsius: float, supply: str | float) -> Heat:
    """Heat under the loads of a bundled wind [m/s], its time stretched to a part of rated speed."""
    whole = main_bearing_load(HubLoads.bundled(f"{wind}B"), Drivetrain()).window(0.0, SECONDS)
    faster = speed * SPEED / float(np.mean(whole.shaft_speed))
    loads = BearingLoads(
        whole.time / faster, whole.shaft_speed * faster, whole.force, source=whole.source
    )
    case = Case(
        loads=loads,
        rollers=ROLLERS,
        laws=Laws.physical(),
        oil_supply=supply,
        temperature=ZERO_CELSIUS + celsius,
        rating=False,
    )
    parts = torque(case, loads)
    return Heat(
        *(
            speed * SPEED * torque_of_model
            for torque_of_model in (parts.total, parts.skf, parts.palmgren)
        )
    )


def power(state: State) -> Heat:
    """Heat in a state, between those of the two bundled winds beside its wind."""
    wind = float(np.clip(state.wind, WINDS[0], WINDS[-1]))
    below = max(tabulated for tabulated in WINDS if tabulated <= wind)
    part = (wind - below) / 2.0
    heat = np.array(power_of_case(below, *state[1:]))
    if part > 0.0:
        heat = (1.0 - part) * heat + part * np.array(power_of_case(below + 2, *state[1:]))
    return Heat(*(float(heat_of_model) for heat_of_model in heat))


def ratio(over: State, under: State) -> Heat:
    """Heat in a state over that in another one, by model [1]."""
    return Heat(*(a / b for a, b in zip(power(over), power(under), strict=True)))


def measured_lhb() -> pd.DataFrame:
    """Heat at La Haute Borne [K/h] over rotor speed [r/min] and, at rated speed, wind [m/s]."""
    return pd.read_csv(DATA / "main_bearing_heat.csv", comment="#")


def measured_wt23(bearing: str) -> pd.DataFrame:
    """Heat of a bearing of WT23 over that at 16 r/min, by speed, with wind and temperature."""
    table = pd.read_csv(DATA / "wt23_heat.csv", comment="#")
    return pd.DataFrame(table[(table.bearing == bearing) & (table.part == "all sound")])


def measured_ratio(over: tuple[float, float | None], under: tuple[float, float | None]) -> Range:
    """Heat at La Haute Borne at one speed [r/min] and wind [m/s] over that at another."""
    (high, high_error), (low, low_error) = _lhb_at(over), _lhb_at(under)
    quotient = high / low
    error = quotient * float(np.hypot(high_error / high, low_error / low))
    return Range(quotient - error, quotient + error)


def _lhb_at(state: tuple[float, float | None]) -> tuple[float, float]:
    """Heat and error [K/h] at a rotor speed [r/min] and wind [m/s]."""
    table = measured_lhb()
    speed, wind = state
    here = table.wind_mps.isna() if wind is None else table.wind_mps == wind
    row = table[(table.rotor_speed_rpm == speed) & here].iloc[0]
    return float(row.q_K_per_h), float(row.error)


def wt23_states(bearing: str, supply: str | float = "skf") -> list[State]:
    """States of the points of a main bearing of WT23, the last one at 16 r/min."""
    table = measured_wt23(bearing)
    parts = table.rotor_speed_rpm / RATED_WT23
    points = zip(table.wind_mps, parts, table.bearing_degC, strict=True)
    return [
        State(float(wind), float(part), float(celsius), supply) for wind, part, celsius in points
    ]


def wt23_ratios(
    bearing: str, *, equal_loads: bool = False, supply: str | float = "skf"
) -> list[Heat]:
    """Heat of the points over that at 16 r/min; with `equal_loads` all under the loads there."""
    states = wt23_states(bearing, supply)
    last = states[-1]
    if equal_loads:
        states = [state._replace(wind=last.wind) for state in states]
    return [ratio(state, last) for state in states]


def wt23_slowest(bearing: str, *, equal_loads: bool = False, supply: str | float = "skf") -> Heat:
    """Heat at the lowest speed over that at 16 r/min."""
    first, *_, last = wt23_states(bearing, supply)
    return ratio(first._replace(wind=last.wind) if equal_loads else first, last)


def wt23_parts(bearing: str) -> Heat:
    """Own heat at the lowest speed over that at 16 r/min: factors of speed, temperature, load."""
    first, *_, last = wt23_states(bearing)
    slow = last._replace(speed=first.speed)
    cool = slow._replace(celsius=first.celsius)
    return Heat(ratio(slow, last).own, ratio(cool, slow).own, ratio(first, cool).own)


def lhb_temperatures(speed: float, wind: float | None) -> Range:
    """Temperature of a bearing at La Haute Borne [degC] at a rotor speed [r/min] and wind [m/s].

    Its two ends are the mean of the bearing's temperature in the rows at such a wind, in which cold
    and warm seasons are mixed, and that in equal surroundings, where temperature goes with heat.
    """
    heat, _ = _lhb_at((speed, wind))
    rated, _ = _lhb_at((17.0, 8.0))
    equal = LHB_RATED + (heat - rated) / COOLING
    # Below rated speed the wind is 4 m/s at the lowest speeds, and 8 m/s at rated speed.
    share = (speed / RATED_LHB - 0.4) / 0.6
    near = wind if wind is not None else float(np.interp(share, (0.0, 1.0), (4.0, 8.0)))
    mean = float(np.interp(near, list(LHB_MEANS), list(LHB_MEANS.values())))
    return Range(min(equal, mean), max(equal, mean))


def lhb_ratio(
    over: tuple[float, float | None], *, loads: float | None = None, supply: str | float = "skf"
) -> dict[str, Range]:
    """Heat at a place over that at rated speed and 8 m/s by model, over its two temperatures.

    `loads` is the wind of the loads [m/s], the place's own if not given.
    """
    speed, wind = over
    under = State(8.0, 1.0, LHB_RATED, supply)
    part = 1.0 if speed == 17.0 else speed / RATED_LHB
    drawn = loads if loads is not None else wind
    assert drawn is not None
    ratios = [
        ratio(State(drawn, part, celsius, supply), under)
        for celsius in lhb_temperatures(speed, wind)
    ]
    return {model: Range.of([getattr(heat, model) for heat in ratios]) for model in MODELS}


def compare() -> list[Comparison]:
    """The lines of the table."""
    rows = []
    for bearing in BEARINGS:
        low = measured_wt23(bearing).iloc[0]
        measured = Range(low.ratio_to_16rpm - low.ratio_error, low.ratio_to_16rpm + low.ratio_error)
        own = _by_model([wt23_slowest(bearing)])
        rows.append(
            _row(
                f"heat at 10.4 over 16 r/min, WT23 {bearing} [-]",
                measured,
                own,
                "load, speed, temperature",
            )
        )
        equal = _by_model([wt23_slowest(bearing, equal_loads=True)])
        rows.append(
            _row(
                "the same with equal loads at both speeds [-]",
                measured,
                equal,
                "how thrust and load are shared",
            )
        )
    slow = measured_ratio((8.7, None), (17.0, 8.0))
    for wind in (8.0, 4.0):
        own = lhb_ratio((8.7, None), loads=wind)
        rows.append(
            _row(
                f"heat at 8.7 over 17 r/min, loads of {wind:g} m/s [-]",
                slow,
                own,
                "load at low speed",
            )
        )
    growth = measured_ratio((17.0, 12.0), (17.0, 8.0))
    own = lhb_ratio((17.0, 12.0))
    rows.append(_row("heat at 12 over 8 m/s, rated speed [-]", growth, own, "growth with load"))
    level, own = measured_level(), _level()
    rows.append(
        Comparison(
            "heat at 12 m/s [W]", level, own, Range(own.low / level.high, own.high / level.low),
            "nothing alone: another turbine, its heat capacity estimated",
        )
    )  # fmt: skip
    return rows


def _by_model(heats: list[Heat]) -> dict[str, Range]:
    """Range by model."""
    return {model: Range.of([getattr(heat, model) for heat in heats]) for model in MODELS}


def _row(quantity: str, measured: Range, own: dict[str, Range], decides: str) -> Comparison:
    """A line with the handbooks' ratios beside the quantity."""
    others = f"; SKF {own['skf']}, Palmgren {own['palmgren']}"
    computed = own["own"]
    quotient = Range(computed.low / measured.high, computed.high / measured.low)
    return Comparison(quantity + others, measured, computed, quotient, decides)


def measured_level() -> Range:
    """Heat at rated speed and 12 m/s [W] with the estimated heat capacity."""
    q, _ = _lhb_at((17.0, 12.0))
    return Range(*(q * capacity / 3600.0 for capacity in CAPACITY))


def _level() -> Range:
    """Own heat at rated speed and 12 m/s [W] over the two temperatures there."""
    return Range.of(
        [power(State(12.0, 1.0, celsius)).own for celsius in lhb_temperatures(17.0, 12.0)]
    )


def print_supplies() -> None:
    """Print what the supply of oil changes, and the factors of speed, temperature and load."""
    for bearing in BEARINGS:
        print(
            bearing,
            "speed, temperature, load:",
            *(f"{factor:.2f}" for factor in wt23_parts(bearing)),
        )
        for supply in SUPPLIES:
            own, equal = (
                wt23_slowest(bearing, equal_loads=same, supply=supply).own for same in (False, True)
            )
            print(bearing, supply, f"{own:.3f}, equal loads {equal:.3f}")
    for supply in SUPPLIES:
        ratios = lhb_ratio((8.7, None), loads=8.0, supply=supply)
        print("La Haute Borne, 8.7 over 17 r/min", supply, ratios["own"])


def draw(path: Path) -> None:
    """Heat over rotor speed and over the wind, over that of a reference, measured and computed."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13, 3.8), layout="constrained")
    axes = figure.subplots(1, 4, sharey=False)
    for axis, bearing in zip(axes[:2], BEARINGS, strict=True):
        _draw_wt23(axis, bearing)
    _draw_lhb_speed(axes[2])
    _draw_lhb_wind(axes[3])
    for axis in axes:
        axis.set_ylim(0.0, None)
        axis.legend(fontsize="x-small")
    figure.savefig(path, dpi=110)


_LABELS = {"own": "this program", "skf": "SKF", "palmgren": "Palmgren"}
_COLOURS = {"own": "C0", "skf": "C1", "palmgren": "C2"}


def _draw_wt23(axis, bearing: str) -> None:
    """Heat of a bearing of WT23 over rotor speed."""
    table = measured_wt23(bearing)
    ratios = wt23_ratios(bearing)
    for model in MODELS:
        values = [getattr(heat, model) for heat in ratios]
        axis.plot(table.rotor_speed_rpm, values, color=_COLOURS[model], label=_LABELS[model])
    ends = [0, len(ratios) - 1]
    equal = [wt23_slowest(bearing, equal_loads=True).own, 1.0]
    axis.plot(table.rotor_speed_rpm.iloc[ends], equal, "--", color="C0", label="equal loads")
    axis.errorbar(
        table.rotor_speed_rpm, table.ratio_to_16rpm, table.ratio_error,
        fmt="ko", ms=4, capsize=2, label="measured",
    )  # fmt: skip
    axis.set(
        xlabel="rotor speed [r/min]", ylabel="heat, over that at 16 r/min", title=f"WT23, {bearing}"
    )


def _draw_lhb_speed(axis) -> None:
    """Heat at La Haute Borne over rotor speed, with loads of 8 and of 4 m/s."""
    speeds = (8.7, 11.4, 14.8)
    unit, _ = _lhb_at((17.0, 8.0))
    for wind, colour in ((8.0, "C0"), (4.0, "C3")):
        ranges = [lhb_ratio((speed, None), loads=wind)["own"] for speed in speeds]
        axis.fill_between(
            speeds, [interval.low for interval in ranges], [interval.high for interval in ranges],
            color=colour, alpha=0.5, label=f"this program, loads of {wind:g} m/s",
        )  # fmt: skip
    skf = [lhb_ratio((speed, None), loads=8.0)["skf"] for speed in speeds]
    axis.plot(speeds, [np.mean(ratios) for ratios in skf], color="C1", label="SKF, loads of 8 m/s")
    rows = [(*_lhb_at((speed, None)), speed) for speed in speeds] + [(*_lhb_at((17.0, 8.0)), 17.0)]
    axis.errorbar(
        [row[2] for row in rows], [row[0] / unit for row in rows], [row[1] / unit for row in rows],
        fmt="ko", ms=4, capsize=2, label="measured",
    )  # fmt: skip
    axis.set(
        xlabel="rotor speed [r/min]",
        ylabel="heat, over that at 17 r/min and 8 m/s",
        title="La Haute Borne",
    )


def _draw_lhb_wind(axis) -> None:
    """Heat at La Haute Borne at rated speed over wind."""
    table = measured_lhb().dropna()
    table = table[(table.wind_mps >= 8.0) & (table.wind_mps <= 15.0)]
    unit, _ = _lhb_at((17.0, 8.0))
    winds = (8.0, 10.0, 12.0)
    for model in MODELS:
        ranges = [lhb_ratio((17.0, wind))[model] for wind in winds]
        axis.fill_between(
            winds, [interval.low for interval in ranges], [interval.high for interval in ranges],
            color=_COLOURS[model], alpha=0.4, label=_LABELS[model],
        )  # fmt: skip
    axis.errorbar(
        table.wind_mps, table.q_K_per_h / unit, table.error / unit,
        fmt="ko", ms=4, capsize=2, label="measured",
    )  # fmt: skip
    axis.set(
        xlabel="wind speed [m/s]",
        ylabel="heat at rated speed, over that at 8 m/s",
        title="La Haute Borne",
    )


if __name__ == "__main__":
    print_supplies()
