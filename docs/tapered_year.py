"""A spherical and a tapered roller bearing on the same year of hub loads, as docs/tapered.md has it.

    python docs/tapered_year.py compute     every case that docs/tapered-year.csv lacks
    python docs/tapered_year.py table       the tables, and figures/tapered_year.svg

The year is thinned: the first minute of four load cases of turbulence class B of the 1.5 MW turbine,
two rollers of each row, weighted by the hours of IEC class II around each wind speed, no events. What
ribs of other shapes do follows from the loads of their rollers in pure rolling. `compute` goes on
where it stopped; from an empty file it takes twenty minutes of a processor.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.figure import Figure

from macroslip import Case, HubLoads, Laws, Lubricant, Turbine, simulate
from macroslip.bearing.kinds import read_bearing
from macroslip.constants import HOURS_A_YEAR, YEAR
from macroslip.kinds.tapered.kind import TiltingRingBalance
from macroslip.kinds.tapered.ribs import rib_values
from macroslip.measures.along import FILM_EDGES
from macroslip.report.style import BLUE, GREEN, GREY, ORANGE, finish, new_figure
from macroslip.result.criteria import YEARLY
from macroslip.result.damage import damage
from macroslip.result.prepared import prepare
from macroslip.study.summary import rating_values

#: Results of every case, and the figure.
RESULTS = Path(__file__).with_name("tapered-year.csv")
FIGURE = Path(__file__).parent / "figures" / "tapered_year.svg"
SECONDS = 60.0
#: Wind speeds [m/s], and the edges of the classes for which they stand.
WINDS = (4, 8, 14, 20)
EDGES = (3.0, 6.0, 11.0, 17.0, 25.0)
#: Mean wind speed of IEC class II [m/s], Rayleigh.
MEAN_WIND = 8.5
TURBINE = Turbine.read("windpact1.5")
SPHERICAL = TURBINE.bearing
TAPERED = "tdo-main-bearing"
#: Stiffness of the gearbox's support that takes a part of the moment, an estimate [N/m].
SUPPORT = 1e8
#: Film over that of full inlets at the raceways of both bearings: SKF's factor needs diameters, which
#: the tapered one's page does not give.
SUPPLY = 0.7
#: Coefficient of wear [m²/N], known to a factor of ten.
WEAR = 1e-17
#: Hours of twenty years, for which turbines are designed (IEC 61400-1).
DESIGN_HOURS = 20.0 * HOURS_A_YEAR
#: Columns of the year that the page leaves out.
BESIDE = (
    "friction [GJ]",
    "largest pressure [GPa]",
    "lowest spin [1]",
    "wear of ribs [nm]",
    "least film at ribs [1]",
)
#: Film at a rib over that of a full inlet, where it is starved.
STARVED = 0.1


@dataclass(frozen=True)
class Variant:
    """A bearing in the turbine: values that differ from its file, and from the mount."""

    name: str
    bearing: str = TAPERED
    values: Mapping[str, float] = field(default_factory=dict)
    mount: Mapping[str, Any] = field(default_factory=dict)
    supply: float | str = SUPPLY


VARIANTS = (
    Variant("spherical, 240/600", SPHERICAL),
    Variant("tapered, no preload", values={"preload": 0.0}),
    Variant("tapered, preload 0.2 mm"),
    Variant("tapered, preload 0.3 mm", values={"preload": 0.3e-3}),
    Variant("tapered, preload 0.4 mm", values={"preload": 0.4e-3}),
    Variant("tapered, alone on the shaft", mount={"mount": "alone", "gearbox_stiffness": None}),
    Variant("spherical, half the film", SPHERICAL, supply=0.5),
    Variant("tapered, half the film", supply=0.5),
    Variant("spherical, flooded", SPHERICAL, supply="flooded"),
    Variant("tapered, flooded", supply="flooded"),
)
#: Variants of which the ribs alone are computed; raceways do not feel them.
RIBS = (
    Variant("ribs as estimated"),
    Variant("rib contact 3 mm high", values={"rib_contact_height": 3e-3}),
    Variant("rib contact 9 mm high", values={"rib_contact_height": 9e-3}),
    Variant("rib sphere 0.7", values={"rib_sphere_ratio": 0.7}),
    Variant("rib sphere 0.95", values={"rib_sphere_ratio": 0.95}),
    Variant("half the film at the rib", values={"rib_oil_supply": 0.5}),
    Variant("a tenth of the film at the rib", values={"rib_oil_supply": STARVED}),
)


def case_of(variant: Variant, wind: int) -> Case:
    """A variant at a wind speed [m/s]."""
    bearing = read_bearing(variant.bearing)
    if variant.values:
        bearing = bearing.replace(**variant.values)
    drivetrain = TURBINE.drivetrain
    if bearing.kind == "tapered":
        drivetrain = replace(drivetrain, **{"gearbox_stiffness": SUPPORT, **variant.mount})
    return Case(
        loads=HubLoads.bundled(f"{wind}B").window(0.0, SECONDS),
        bearing=bearing,
        lubricant=Lubricant.read(TURBINE.lubricant),
        drivetrain=drivetrain,
        rollers=[0, bearing.rollers_per_row // 2],
        laws=Laws.physical(),
        oil_supply=variant.supply,
    )


def measures(case: Case) -> dict[str, float]:
    """Numbers of a case: powers of the bearing [W], rates of damage, shares of time and lives."""
    result = simulate(case)
    assert (result.status == 0).all(), case.loads.source
    window = float(result.attrs["window_end"] - result.attrs["window_start"])
    scale = case.bearing.rollers_per_row / result.sizes["roller"] / window
    raceways = result.energy.sel(interface=["inner", "outer"])
    ribs = float(result.rib_energy.sum()) if "rib_energy" in result else 0.0
    rating = rating_values(case)
    return {
        "raceway power": scale * float(raceways.sum()),
        "cage power": scale * float(result.energy.sel(interface="cage").sum()),
        "rolling power": scale * float(result.rolling_energy.sum()),
        "rib power": scale * ribs,
        "lowest spin": float(result.min_spin_ratio.min()),
        "reference life": rating["reference_life"],
        "largest pressure": rating["largest_pressure"],
        **films(result),
        **rates(result),
    }


def rib_measures(case: Case) -> dict[str, float]:
    """Power of all ribs [W], their wear [m/s] and least film [1] in the window, in pure rolling."""
    ready = prepare(case)
    assert isinstance(ready.balance, TiltingRingBalance), "the bearing is not a tapered one"
    time = ready.motion.time
    inside = (time >= ready.edges[0]) & (time <= ready.end)
    force = ready.balance.tapered.balance.rib_force[inside]
    by_row = force.reshape(len(force), 2, -1)
    speed = np.abs(ready.motion.shaft_speed[inside])
    ribs = rib_values(case.bearing, case.oil, by_row, speed, case.laws)
    return {
        "rib power": float(ribs["rib_power"].sum(axis=1).mean()),
        "rib_wear_rate": WEAR * float(ribs["rib_asperity_work"].mean(axis=0).max()),
        "least film at ribs": float(ribs["rib_film_ratio"].min()),
        "rib flash temperature": float(ribs["rib_flash_temperature"].max()),
    }


def films(result: xr.Dataset) -> dict[str, float]:
    """Shares of the loaded time of both raceways and rows with thin films, and at the ribs."""
    time = result.film_slip_time.sum(("row", "raceway", "slip_class")).values
    shares = {
        f"film below {edge:g}": float(time[: FILM_EDGES.index(edge) + 1].sum() / time.sum())
        for edge in (1.0, 3.0)
    }
    if "min_rib_film_ratio" in result:
        shares["least film at ribs"] = float(result.min_rib_film_ratio.min())
    return shares


def rates(result: xr.Dataset) -> dict[str, float]:
    """Numbers of damage: sums of both rows, or the worse one."""
    criteria = damage(result)
    values = {}
    for yearly in YEARLY:
        of_rows = yearly.of_run(criteria, result)
        if of_rows is not None:
            known = of_rows.fillna(0.0)
            values[yearly.run_name] = float(known.sum() if yearly.drawn == "sum" else known.max())
    return values


def cases(there: set[tuple[str, int]]) -> Iterator[tuple[Variant, int]]:
    """Variants and wind speeds that are not there yet."""
    for variant in (*VARIANTS, *RIBS):
        for wind in WINDS:
            if (variant.name, wind) not in there:
                yield variant, wind


def compute() -> None:
    """Simulate every case that is not there yet."""
    there: set[tuple[str, int]] = set()
    if RESULTS.exists():
        known = pd.read_csv(RESULTS)[["variant", "wind"]].drop_duplicates()
        there = set(known.itertuples(index=False, name=None))
    for variant, wind in cases(there):
        case = case_of(variant, wind)
        numbers = rib_measures(case) if variant in RIBS else measures(case)
        lines = [[variant.name, wind, name, value] for name, value in numbers.items()]
        frame = pd.DataFrame(lines, columns=["variant", "wind", "quantity", "value"])
        frame.to_csv(RESULTS, mode="a", header=not RESULTS.exists(), index=False)
        print(variant.name, wind, flush=True)


def seconds_of_year() -> pd.Series:
    """Time of a year [s] in the class of each wind speed."""
    exceeded = np.exp(-np.pi / 4.0 * (np.array(EDGES) / MEAN_WIND) ** 2)
    return pd.Series(-YEAR * np.diff(exceeded), WINDS)


def results() -> pd.DataFrame:
    """Numbers of all cases, over variant and quantity, with a column for each wind speed."""
    table = pd.read_csv(RESULTS)
    return table.pivot(index=["variant", "quantity"], columns="wind", values="value")


def years() -> pd.DataFrame:
    """A year of every variant, by name and quantity."""
    values = results()
    seconds = seconds_of_year()
    share = seconds / seconds.sum()
    rows = {}
    for variant in VARIANTS:
        of_variant = values.loc[variant.name]

        def total(quantity: str, numbers: pd.DataFrame = of_variant) -> float:
            return float((numbers.loc[quantity] * seconds).sum())

        parts = ("raceway", "cage", "rolling", "rib")
        energy = {f"{part} [GJ]": 1e-9 * total(f"{part} power") for part in parts}
        rows[variant.name] = energy | {
            "friction [GJ]": sum(energy.values()),
            "entries under slip [million]": 1e-6 * total("entry_rate"),
            "Λ < 3 [% of loaded time]": 100.0
            * float((of_variant.loc["film below 3"] * share).sum()),
            "Λ < 1 [%]": 100.0 * float((of_variant.loc["film below 1"] * share).sum()),
            "wear of raceways [nm]": 1e9 * total("wear_rate"),
            "reference life [million h]": 1e-6
            / float((share / of_variant.loc["reference life"]).sum()),
            "largest pressure [GPa]": 1e-9 * float(of_variant.loc["largest pressure"].max()),
            "lowest spin [1]": float(of_variant.loc["lowest spin"].min()),
        }
        if "rib_wear_rate" in of_variant.index:
            rows[variant.name] |= {
                "wear of ribs [nm]": 1e9 * total("rib_wear_rate"),
                "least film at ribs [1]": float(of_variant.loc["least film at ribs"].min()),
            }
    return pd.DataFrame(rows).T


def rib_years() -> pd.DataFrame:
    """Friction, wear and films of the ribs in a year, by variant of the rib."""
    values = results()
    seconds = seconds_of_year()
    rows = {}
    for variant in RIBS:
        of_variant = values.loc[variant.name]
        rows[variant.name] = {
            "ribs [GJ]": 1e-9 * float((of_variant.loc["rib power"] * seconds).sum()),
            "wear of ribs [nm]": 1e9 * float((of_variant.loc["rib_wear_rate"] * seconds).sum()),
            "least film over roughness [1]": float(of_variant.loc["least film at ribs"].min()),
            "flash temperature [K]": float(of_variant.loc["rib flash temperature"].max()),
        }
    return pd.DataFrame(rows).T


def figure() -> Figure:
    """Friction by part, entries, films and life of every variant, beside the spherical bearing."""
    table = years()
    drawn, panels = new_figure(10.6, 4.2, columns=4, sharey=True)
    places = np.arange(len(table))
    left = np.zeros(len(table))
    for part, colour in (("raceway", BLUE), ("cage", GREY), ("rolling", GREEN), ("rib", ORANGE)):
        values = table[f"{part} [GJ]"].to_numpy()
        panels[0].barh(places, values, left=left, color=colour, label=part)
        left += values
    colours = [GREY if variant.bearing == SPHERICAL else BLUE for variant in VARIANTS]
    for axes, (name, label) in zip(
        panels[1:],
        (
            ("entries under slip [million]", "entries under slip [million]"),
            ("Λ < 3 [% of loaded time]", "loaded time with Λ < 3 [%]"),
            ("reference life [million h]", "reference life [million h]"),
        ),
        strict=True,
    ):
        finish(axes, label, "")
        if name == "reference life [million h]":
            axes.scatter(table[name], places, color=colours)
        else:
            axes.barh(places, table[name], color=colours)
    panels[3].set_xscale("log")
    panels[3].axvline(1e-6 * DESIGN_HOURS, color="black", linestyle=":")
    finish(panels[0], "friction of a year [GJ]", "")
    panels[0].set_yticks(places, table.index)
    panels[0].invert_yaxis()
    handles, labels = panels[0].get_legend_handles_labels()
    drawn.legend(handles, labels, loc="outside upper center", ncols=4, frameon=False)
    return drawn


def page_tables() -> tuple[pd.DataFrame, pd.DataFrame]:
    """The two tables of the page."""
    return years().drop(columns=list(BESIDE)), rib_years()


def text_of(table: pd.DataFrame) -> str:
    """A table as the page has it."""
    lines = [["", *table.columns], ["---"] * (1 + len(table.columns))]
    for name, values in table.iterrows():
        lines.append([str(name), *(plain(value) for value in values)])
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def plain(value: float) -> str:
    """A number with two digits, three from 100 on, and less than a hundredth in powers of ten."""
    if value != 0.0 and abs(value) < 0.01:
        return f"{value:.1e}".replace("e-0", "e-")
    if abs(value) >= 1000.0:
        return f"{float(f'{value:.2g}'):,.0f}"
    return f"{value:.3g}" if abs(value) >= 99.5 else f"{value:.2g}"


def tell() -> None:
    """Print the tables and draw the figure."""
    print(f"hours: {seconds_of_year().sum() / 3600.0:.0f}")
    for table in page_tables():
        print(f"\n{text_of(table)}")
    matplotlib.rcParams["svg.hashsalt"] = "macroslip"
    figure().savefig(FIGURE, metadata={"Date": None})


if __name__ == "__main__":
    {"compute": compute, "table": tell}[sys.argv[1]]()
