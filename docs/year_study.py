"""Tables and figures of a-year.md, from the two studies of the page.

macroslip study examples/year.yaml -o year
macroslip study examples/year_variants.yaml -o variants
python docs/year_study.py year variants
macroslip study examples/year_balance.yaml -o own
python docs/year_study.py own
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import matplotlib
import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.figure import Figure

from macroslip import open_study
from macroslip.report.style import BLUE, GREEN, GREY, ORANGE, finish, log_ticks, new_figure
from macroslip.study.aggregation import aggregation_in_use
from macroslip.study.over_temperature import RunsOverTemperature, weighted_study
from macroslip.study.weights import stored_weighting
from macroslip.study.year import coverage, year

#: Of energy and entries both rows count, of wear the row and place with most.
QUANTITIES = {"energy": BLUE, "wear": ORANGE, "entries": GREEN}
NAMES = {"energy": "energy", "wear": "wear", "entries": "entries under slip"}
VARIANTS = [
    "as it is",
    "oil_supply flooded",
    "oil_supply 0.7",
    "oil_supply 0.5",
    "oil at 25 °C",
    "oil at 50 °C",
]
#: Mean temperature of three sound main bearings of La Haute Borne by wind speed, while they turn [degC].
MEASURED = {4: 27.3, 6: 29.0, 8: 29.9, 10: 29.6, 12: 29.6, 14: 29.8, 16: 29.5, 18: 29.1, 20: 29.3}
MEASURED |= {22: 30.0, 24: 30.0}
#: Heat that a main bearing loses, by estimates of its conductance, to 20 degC.
CONDUCTANCES = (40, 60, 80)
MODELS = {"straight rollers": {"marker": "o", "mfc": "white"}, "skewed rollers": {"marker": "o"}}


def own_temperatures(folder: str) -> None:
    """Print a year of production at 35 degC, at measured temperatures and at those of its own friction."""
    study = open_study(folder)
    years = {"35 °C": {"by_wind": dict.fromkeys(MEASURED, "35 degC")}}
    years["measured"] = {"by_wind": {wind: f"{at} degC" for wind, at in MEASURED.items()}}
    for conductance in CONDUCTANCES:
        loss = {"conductance": f"{conductance} W/K", "ambient": "20 degC"}
        years[f"{conductance} W/K"] = {"balance": loss}
    fixed = None
    for name, temperature in years.items():
        content = json.loads(study.attrs["study"])
        content["weights"] = {"wind": {"weibull": "IEC II"}, "temperature": temperature}
        known = study.assign_attrs(study=json.dumps(content))
        if "balance" in temperature:
            weighting = stored_weighting(known)
            assert weighting is not None, "the weights were given above"
            loss = weighting.balance
            assert loss is not None, "as a balance"
            balance = RunsOverTemperature.of(known).balance(loss, "wind_speed", 2.0)
            print(name, {wind: round(at - 273.15, 1) for wind, at in balance.items()})
        annual = year(weighted_study(known), aggregation_in_use(known))
        bins = xr.Dataset(
            {
                "energy": annual.energy.sum("row"),
                "wear": annual.wear.isel(row=0),
                "entries": annual.entries.sum("row"),
            }
        ).isel(group=0)
        fixed = bins.sum() if fixed is None else fixed
        low = bins.sel(bin=bins.bin < 11.0)
        print(name, {key: f"{float(bins[key].sum() / fixed[key]):.3g}" for key in bins})
        print(
            "  below 11 m/s",
            {key: f"{float(low[key].sum() / bins[key].sum()):.3g}" for key in bins},
        )
        shares = 100.0 * bins / bins.sum()
        print(shares.to_dataframe()[list(bins.data_vars)].round(1).T.to_string())


def of_a_year(folder: str) -> tuple[xr.Dataset, xr.DataArray, np.ndarray]:
    """The year of a study; energy [J], wear [m] and entries over (quantity, group, bin); names of the bins."""
    study = open_study(folder)
    annual = year(study, aggregation_in_use(study))
    worse = annual.wear.sum("bin", skipna=False).fillna(0.0).idxmax("row")
    # Entries are counted by orbits, of which idling and parked rotors complete none.
    entries = annual.entries.where(~annual.event.isin(["idle-6", "idle-25", "parked-12"]), 0.0)
    drawn = [
        annual.energy.sum("row", skipna=False),
        annual.wear.sel(row=worse),
        entries.sum("row", skipna=False),
    ]
    values = xr.concat(drawn, "quantity", coords="minimal")
    wind = [f"{speed:g}" for speed in annual.bin.values]
    names = np.where(annual.event.values == "", wind, annual.event.values)
    return annual, values.assign_coords(quantity=list(QUANTITIES)), names


def parts_of(annual: xr.Dataset) -> dict[str, np.ndarray]:
    """Bins of the parts of a year."""
    event, speed = annual.event.values != "", annual.bin.values
    return {"4 to 10 m/s": speed < 11.0, "12 to 24 m/s": speed > 11.0, "events": event}


def parts_figure(values: xr.DataArray, names: np.ndarray, parts: dict[str, np.ndarray]) -> Figure:
    """Shares of the year by wind speed, and of all events together."""
    figure, (axes,) = new_figure(7.6, 3.0)
    shares = 100.0 * values.isel(group=0) / values.isel(group=0).sum("bin")
    windy = ~parts["events"]
    for k, (name, colour) in enumerate(QUANTITIES.items()):
        share = shares.sel(quantity=name).values
        heights = np.append(share[windy], share[~windy].sum())
        axes.bar(
            np.arange(heights.size) + 0.27 * (k - 1), heights, 0.25, color=colour, label=NAMES[name]
        )
    axes.set_xticks(np.arange(heights.size), [*names[windy], "events"])
    axes.axvspan(
        3.5, 10.5, color=GREY, alpha=0.12, linewidth=0, zorder=0, label="the paper's range"
    )
    axes.legend(frameon=False)
    finish(axes, "wind speed [m/s]", "share of a year [%]")
    return figure


def events_figure(
    annual: xr.Dataset, values: xr.DataArray, names: np.ndarray, parts: dict[str, np.ndarray]
) -> Figure:
    """Share of a year of every event, and what an hour of it does over an hour of the mean wind speed."""
    figure, (left, right) = new_figure(8.4, 3.8, columns=2, sharey=True)
    of_design = values.isel(group=0)
    windy, some = ~parts["events"], parts["events"]
    share = 100.0 * of_design / of_design.sum("bin")
    hourly = (of_design / annual.hours) / (
        of_design.isel(bin=windy).sum("bin") / annual.hours[windy].sum()
    )
    order = np.flatnonzero(some)[np.argsort(annual.energy.isel(group=0).sum("row").values[some])]
    for axes, shown, label in (
        (left, share, "share of a year [%]"),
        (right, hourly, "an hour over one of production"),
    ):
        for k, (name, colour) in enumerate(QUANTITIES.items()):
            at = shown.sel(quantity=name).values[order]
            places = np.arange(order.size) + 0.2 * (1 - k)
            axes.plot(
                np.where(at > 0.0, at, np.nan),
                places,
                marker="osD"[k],
                color=colour,
                linestyle="none",
                label=NAMES[name],
            )
        axes.set_xscale("log")
        axes.grid(axis="y", color=GREY, alpha=0.2)
        finish(axes, label, "")
    left.set_xlim(1e-4, 20.0)
    right.set_xlim(1e-3, 30.0)
    left.set_yticks(np.arange(order.size), names[order])
    right.axvline(1.0, color=GREY, linewidth=0.8)
    handles, labels = left.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3, frameon=False)
    return figure


def variants_figure(table: pd.DataFrame) -> Figure:
    """Energy, wear and entries of every variant over those of the base turbine."""
    figure, panels = new_figure(8.4, 3.2, columns=3, sharey=True)
    for axes, (name, colour) in zip(panels, QUANTITIES.items(), strict=True):
        for model, style in MODELS.items():
            axes.plot(
                table.loc[model, name],
                VARIANTS,
                color=colour,
                linestyle="none",
                label=model,
                **style,
            )
        axes.axvline(1.0, color=GREY, linewidth=0.8)
        axes.grid(axis="y", color=GREY, alpha=0.2)
        finish(axes, "over the base turbine [1]", "", NAMES[name])
    log_ticks(panels[1], "x")
    panels[0].invert_yaxis()
    panels[0].legend(frameon=False, fontsize=8)
    return figure


def variants_table(folder: str) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Sums of a year of every variant by model and name; and shares of them [%] by part of the year."""
    annual, values, _ = of_a_year(folder)
    supply, at = annual["oil_supply"].values, annual["lubricant.at"].values
    names = [
        f"oil_supply {s}" if s else "as it is" if np.isnan(t) else f"oil at {t:g} °C"
        for s, t in zip(supply.astype(str), at, strict=True)
    ]
    index = pd.MultiIndex.from_arrays([annual.model.values, names])
    table = pd.DataFrame(
        values.sum("bin", skipna=False).transpose("group", "quantity").values,
        index,
        list(QUANTITIES),
    )
    for name in ("peak", "entry_slip"):
        table[name] = annual[name].max(("bin", "row")).values
    shares = {
        f"{quantity}, {name}": 100.0
        * values.sel(quantity=quantity)[:, part].sum("bin", skipna=False).values
        / table[quantity]
        for quantity in QUANTITIES
        for name, part in parts_of(annual).items()
    }
    return table, pd.DataFrame(shares, index)


def main(base: str, variants: str) -> None:
    annual, values, names = of_a_year(base)
    parts = parts_of(annual)
    of_design = values.isel(group=0)
    table = pd.DataFrame(of_design.transpose("bin", "quantity").values, names, list(QUANTITIES))
    hours = pd.Series(annual.hours.values, names)
    for name, part in parts.items():
        table.loc[name], hours[name] = (
            table[: names.size][part].sum(),
            hours[: names.size][part].sum(),
        )
    whole = of_design.sum("bin", skipna=False).to_series()
    print(coverage(annual), whole.to_string(), sep="\n")
    shown = (
        (100.0 * table / whole)
        .join(table.div(hours, axis=0).add_suffix(" an hour"))
        .assign(hours=hours)
    )
    every, shares = variants_table(variants)
    over = every / every.loc["straight rollers", "as it is"]
    for frame in (shown, every, over, shares):
        print(frame.to_string(float_format=lambda value: f"{value:.3g}"))
    matplotlib.rcParams["svg.hashsalt"] = "macroslip"
    for name, figure in (
        ("parts", parts_figure(values, names, parts)),
        ("events", events_figure(annual, values, names, parts)),
        ("variants", variants_figure(over)),
    ):
        figure.savefig(
            Path(__file__).parent / "figures" / f"year_{name}.svg", metadata={"Date": None}
        )


if __name__ == "__main__":
    (own_temperatures if len(sys.argv) == 2 else main)(*sys.argv[1:])
