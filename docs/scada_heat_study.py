"""Tables and figures of scada-heat.md: synthetic years of known truth, and the crack of a real bearing.

python docs/scada_heat_study.py      # some minutes; prints the tables, writes the figures
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from macroslip.report.heat_figures import MODEL
from macroslip.report.style import BLUE, GREY, ORANGE, finish, new_figure, program_style
from macroslip.scada import Scada
from macroslip.scada.friction_table import FrictionTable
from macroslip.scada.heat import BearingHeat, bearing_heat
from macroslip.scada.heat_balance import HeatFit
from macroslip.scada.heat_index import first_flag
from macroslip.scada.heat_models import FRICTION, FRICTION_ALONE, RISE, SPEED
from macroslip.scada.synthetic import (
    SyntheticYear,
    base_turbine_friction,
    synthetic_year,
    write_record,
)

CRACK = Path(__file__).parents[1] / "validation" / "data" / "wt23_index.csv"
FIGURES = Path(__file__).parent / "figures"
DESCRIPTION = """\
turbine: synthetic
files: [record.csv]
time: {column: time, zone: UTC}
columns:
  wind_speed: {column: wind_mps, unit: m/s}
  rotor_speed: {column: rotor_rpm, unit: rpm}
  power: {column: power_kW, unit: kW}
  bearing_temperature: {column: bearing_degC, unit: degC}
  nacelle_temperature: {column: nacelle_degC, unit: degC}
  ambient_temperature: {column: ambient_degC, unit: degC}
rated: {rotor_speed: 17.1 rpm, power: 1500 kW}
"""
#: Last day before a step of the friction; the days up to it are the reference.
STEP = 200
REFERENCE = "reference: [2024-01-01, 2024-07-18]\n"
SEEDS = range(11, 15)
#: Change of the bearing in ten minutes that parts a record [K].
LARGEST_JUMP = 1.2


def read(record: pd.DataFrame, more: str = "") -> Scada:
    """A synthetic record as the reader gives it."""
    with tempfile.TemporaryDirectory() as folder:
        write_record(record.iloc[::10], Path(folder) / "record.csv")
        path = Path(folder) / "scada.yaml"
        path.write_text(DESCRIPTION + more)
        described = Scada.read(path)
    jump = np.abs(record["bearing_temperature"].diff()) > LARGEST_JUMP
    kept = pd.Categorical.from_codes(np.zeros(len(record), dtype=int), [""])
    return replace(described, data=record.assign(filter=kept, jump=jump), notes=())


def only(friction: FrictionTable, *supplies: str) -> FrictionTable:
    """The table with some of its supplies."""
    entries = friction.entries[friction.entries["supply"].isin(supplies)]
    return replace(friction, entries=entries.reset_index(drop=True))


def fit_of(heat: BearingHeat, supply: str, model: str = FRICTION) -> HeatFit:
    """The fit of a model with a supply."""
    return next(f for f in heat.fits if (f.model.name, f.model.supply) == (model, supply))


def identified(friction: FrictionTable) -> pd.DataFrame:
    """What fits find in years of known truth: capacity over the true one, seals, loss, residual."""
    lines = []
    for name, truth, fit in _fits(friction):
        loss = fit.values["to_nacelle"] + fit.values["to_ambient"]
        seals = fit.values.get("seal_torque", np.nan)
        error = fit.errors["capacity"] / truth.capacity
        capacity = fit.values["capacity"] / truth.capacity
        lines.append((name, capacity, error, seals, loss, fit.residual))
    columns = ["year and fit", "C over true", "error", "seals [N m]", "loss [1/h]", "residual"]
    return pd.DataFrame(lines, columns=columns).set_index("year and fit")


def _fits(friction: FrictionTable) -> Iterator[tuple[str, SyntheticYear, HeatFit]]:
    """Name of a year and how it is read, its truth, and the fit."""
    plain = SyntheticYear()
    record = synthetic_year(plain, friction)
    sound = bearing_heat(read(record), friction)
    yield "right supply", plain, fit_of(sound, "skf")
    yield "seals left out", plain, fit_of(sound, "skf", FRICTION_ALONE)
    for supply in ("flooded", "0.7", "0.5"):
        yield f"truth skf read as {supply}", plain, fit_of(sound, supply)
    for supply in ("flooded", "0.5"):
        truth = SyntheticYear(supply=supply)
        heat = bearing_heat(read(synthetic_year(truth, friction)), friction)
        for other in friction.supplies:
            yield f"truth {supply} read as {other}", truth, fit_of(heat, other)
    table = only(friction, "skf")
    disturbed = {
        "noise 0.5 K": SyntheticYear(noise=0.5),
        "steps of 1 K": SyntheticYear(resolution=1.0),
        "20 % missing": SyntheticYear(missing=0.2),
        "fan, 3 % for each m/s": SyntheticYear(fan=0.03),
    }
    for name, truth in disturbed.items():
        heat = bearing_heat(read(synthetic_year(truth, friction)), table)
        yield name, truth, heat.chosen
    yield (
        "oil 5 K warmer than thought",
        plain,
        bearing_heat(read(record, "oil_offset: -5 K\n"), table).chosen,
    )
    for shift in (-0.5, 0.5):
        windy = record.assign(wind_speed=(record["wind_speed"] + shift).clip(lower=0.0))
        yield f"wind {shift:+} m/s", plain, bearing_heat(read(windy), table).chosen


def detected(friction: FrictionTable) -> pd.DataFrame:
    """Flags by model and step: years flagged after it, days until then, and years flagged before."""
    lines = []
    for more in (1.0, 1.2, 1.35):
        for seed in SEEDS:
            truth = SyntheticYear(seed=seed, more_friction=more, more_from=STEP)
            scada = read(synthetic_year(truth, friction), REFERENCE)
            heat = bearing_heat(scada, only(friction, "skf"))
            lines += [(more, model, *flag(heat, model)) for model in (FRICTION, SPEED, RISE)]
            wrong = bearing_heat(scada, only(friction, "flooded"))
            lines.append((more, "read as flooded", *flag(wrong, FRICTION)))
    flags = pd.DataFrame(lines, columns=["factor", "model", "day", "r"])
    return flags.groupby(["model", "factor"], sort=False).apply(_counted, include_groups=False)


def shared(friction: FrictionTable) -> pd.DataFrame:
    """Flags in years whose friction wanders, alone and over a sibling that shares it."""
    table = only(friction, "skf")
    lines = []
    for wander in (0.08, 0.15):
        for more in (1.0, 1.35):
            for seed in SEEDS:
                own = SyntheticYear(
                    seed=seed, wander=wander, noise=0.0, more_friction=more, more_from=STEP
                )
                scada, sibling = (
                    read(noisy(synthetic_year(truth, friction), number), REFERENCE)
                    for number, truth in enumerate((own, replace(own, more_friction=1.0)))
                )
                heat = bearing_heat(scada, table, sibling)
                kind = (wander, more)
                lines.append((*kind, "alone", *flag(heat, FRICTION)))
                lines.append((*kind, "over the sibling", *flag(heat, FRICTION, "_sibling")))
    flags = pd.DataFrame(lines, columns=["wander", "factor", "index", "day", "r"])
    groups = flags.groupby(["index", "wander", "factor"], sort=False)
    return groups.apply(_counted, include_groups=False)


def noisy(record: pd.DataFrame, seed: int) -> pd.DataFrame:
    """A record with noise of 0.2 K of its own at the bearing's sensor."""
    noise = np.random.default_rng(seed).normal(0.0, 0.2, len(record))
    return record.assign(bearing_temperature=record["bearing_temperature"] + noise)


def flag(heat: BearingHeat, model: str, over: str = "") -> tuple[float, float]:
    """Days from the step to the first flag, and the mean index after the step.

    Of the index, or of that over the sibling's, `_sibling`.
    """
    index = heat.index
    days = index[(index["model"] == model) & (index["period"] == "day")]
    day = first_flag(days, f"cusum{over}")
    after = days[days["start"] > pd.Timestamp("2024-01-01") + pd.Timedelta(days=STEP)]
    number = np.nan if day is None else (day - pd.Timestamp("2024-01-01")).days - STEP
    return number, float(np.average(after[f"r{over}"], weights=after["windows"]))


def _counted(years: pd.DataFrame) -> pd.Series:
    late = years["day"][years["day"] >= 0]
    return pd.Series(
        {
            "flagged after": late.size,
            "days, median": late.median(),
            "days, worst": late.max(),
            "flagged before": int((years["day"] < 0).sum()),
            "r after": years["r"].mean(),
        }
    )


def crack() -> tuple[pd.DataFrame, pd.DataFrame]:
    """Weeks of the turbine with a cracked bearing, and means while it was cracked and afterwards."""
    weeks = pd.read_csv(CRACK, comment="#").set_index("week")
    parts = {
        "cracked, weeks 0 to 5": weeks.loc[0:5],
        "next 40 days, weeks 7 to 12": weeks.loc[7:12],
    }
    lines = {}
    for name, part in parts.items():
        ratio = {}
        for index in ("index", "rise_index"):
            means = {
                bearing: np.average(part[f"{index}_{bearing}"], weights=part["windows"])
                for bearing in ("front", "rear")
            }
            ratio |= {f"{index} {bearing}": value for bearing, value in means.items()}
            ratio[f"{index} rear/front"] = means["rear"] / means["front"]
        lines[name] = ratio
    return weeks, pd.DataFrame(lines).T


@program_style()
def crack_figure(weeks: pd.DataFrame) -> Figure:
    """Index of both bearings, and their ratio, by week."""
    figure, (left, right) = new_figure(8.4, 3.1, 1, 2)
    for bearing, colour, marker in (("rear", ORANGE, "s"), ("front", BLUE, "o")):
        style = {"color": colour, "marker": marker, "markersize": 3}
        left.plot(weeks.index, weeks[f"index_{bearing}"], label=f"{bearing}: heat", **style)
        rise = weeks[f"rise_index_{bearing}"]
        left.plot(weeks.index, rise, linestyle=":", label=f"{bearing}: regression", **style)
    right.plot(
        weeks.index, weeks["index_rear"] / weeks["index_front"], color=BLUE, marker="o",
        markersize=3, label="heat",
    )  # fmt: skip
    right.plot(
        weeks.index, weeks["rise_index_rear"] / weeks["rise_index_front"], color=GREY,
        linestyle=":", marker="d", markersize=3, label="regression of the rise",
    )  # fmt: skip
    for axes in (left, right):
        axes.axvspan(-0.5, 6.0, color=GREY, alpha=0.15, linewidth=0)
        axes.axhline(1.0, color=GREY, linewidth=0.8)
        axes.legend(frameon=False, fontsize=8)
    finish(left, "week", "index [-]", "grey: labelled as cracked")
    finish(right, "week", "rear over front [-]")
    return figure


@program_style()
def step_figure(friction: FrictionTable) -> Figure:
    """Weekly index of a year with a step of 35 %, and of a sound one."""
    figure, panels = new_figure(8.4, 3.1, 1, 2, sharey=True)
    for axes, more, name in zip(panels, (1.35, 1.0), ("+35 % from day 200", "sound"), strict=True):
        truth = SyntheticYear(seed=SEEDS[0], more_friction=more, more_from=STEP)
        record = synthetic_year(truth, friction)
        heat = bearing_heat(read(record, REFERENCE), only(friction, "skf"))
        weeks = heat.index[heat.index["period"] == "week"]
        for model, table in weeks.groupby("model", sort=False):
            day = (table["start"] - pd.Timestamp("2024-01-01")).dt.days
            axes.plot(day, table["r"], label=model, **{**MODEL[str(model)], "markersize": 3})
        axes.axvline(STEP, color=GREY, linewidth=0.8)
        axes.set_ylim(0.4, 2.0)
        finish(axes, "day", "index [-]", name)
    panels[1].legend(frameon=False, fontsize=8)
    return figure


def main() -> None:
    """Print the tables and write the figures."""
    matplotlib.use("agg")
    friction = base_turbine_friction()
    weeks, means = crack()
    print(means.round(2).to_string(), end="\n\n", flush=True)
    crack_figure(weeks).savefig(FIGURES / "scada_crack.png", dpi=130)
    print(identified(friction).round(4).to_string(), end="\n\n", flush=True)
    print(detected(friction).round(2).to_string(), end="\n\n", flush=True)
    print(shared(friction).round(2).to_string(), flush=True)
    step_figure(friction).savefig(FIGURES / "scada_step.png", dpi=130)


if __name__ == "__main__":
    main()
