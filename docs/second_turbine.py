"""Numbers and figure of second-turbine.md: conclusions drawn from one turbine, asked of another one.

    python docs/second_turbine.py compute OUT SEAT     every case of a seat, into OUT/SEAT.csv
    python docs/second_turbine.py table OUT            tables, and figures/second_turbine.svg

Two rollers of each row stand for all, over the first two minutes of the load cases of turbulence
class B. Seats are the named turbines; two minutes of a processor each. `compute` goes on where it
stopped.
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
from second_turbine_conclusions import CONCLUSIONS, Seat, summary_text, table_text

from macroslip import (
    Bearing,
    BearingLoads,
    Case,
    HubLoads,
    Laws,
    Lubricant,
    Traces,
    Turbine,
    main_bearing_load,
    simulate,
)
from macroslip.constants import ZERO_CELSIUS
from macroslip.measures.along import FILM_EDGES
from macroslip.report.style import BLUE, GREEN, ORANGE, finish, new_figure
from macroslip.result.criteria import CRITERIA
from macroslip.result.damage import damage
from macroslip.result.rating import rate_case, roller_load_series
from macroslip.torque import palmgren_torque, skf_torque

SECONDS = 120.0
WINDS = tuple(range(4, 25, 2))
#: Series of the bearing of each seat in the handbooks.
SEATS = {"windpact1.5": "240", "nrel5": "240", "nrel5-rear": "230"}
COLOURS = {"windpact1.5": BLUE, "nrel5": ORANGE, "nrel5-rear": GREEN}
#: The lower end of what the estimate allows, which the file of the rear seat's bearing has. With the
#: median contacts of the other seat would reach beyond the ends of the rollers under `paper`.
CLOSER_OSCULATION = 0.972
PAPER_WINDS = WINDS[4:]
AS_IT_IS = "as it is"


@dataclass(frozen=True)
class Run:
    """A case of a seat: wind, model, and what differs from the seat as it is."""

    seat: str
    wind: int
    model: str = "physical"
    variant: str = AS_IT_IS
    changes: Mapping[str, Any] = field(default_factory=dict)
    clearance: float = 1.0  #: Diametral clearance over the bearing's own
    oval: float = 0.0  #: Second harmonic of the outer raceway [m]
    steady: str = ""  #: "mean": the mean load; "radial": the mean load without its thrust

    @property
    def key(self) -> tuple[str, int, str, str]:
        """What names the run in the table of measures."""
        return self.seat, self.wind, self.model, self.variant


def runs(seat: str) -> Iterator[Run]:
    """All cases of a seat, those on which most rests first."""
    for wind in WINDS:
        yield Run(seat, wind)
    # Under `paper` contacts end where rollers end, and the rear seat's loads are beyond that.
    models = ("physical",) if seat == "nrel5-rear" else ("physical", "paper")
    for wind in PAPER_WINDS if "paper" in models else ():
        yield Run(seat, wind, "paper")
    for model in models:
        yield Run(seat, 14, model, "mean load", steady="mean")
        yield Run(seat, 14, model, "mean radial load", steady="radial")
    for supply in ("flooded", 0.5):
        yield Run(seat, 12, variant=f"supply {supply}", changes={"oil_supply": supply})
    for celsius in (25, 50):
        kelvin = ZERO_CELSIUS + celsius
        yield Run(seat, 12, variant=f"oil at {celsius} °C", changes={"temperature": kelvin})
    yield Run(
        seat, 12, variant="skew", changes={"laws": replace(Laws.physical(), skew="quasi-static")}
    )
    yield Run(seat, 12, variant="half the clearance", clearance=0.5)
    yield Run(seat, 12, variant="oval +50 µm", oval=50e-6)
    yield Run(seat, 12, variant="oval -50 µm", oval=-50e-6)


def bearing_of(run: Run) -> Bearing:
    """The bearing of a run."""
    bearing = Bearing.read(Turbine.read(run.seat).bearing)
    if run.seat == "nrel5" and run.model == "paper":  # without microslip nothing is cut off
        closer = CLOSER_OSCULATION
        bearing = bearing.replace(osculation_inner=closer, osculation_outer=closer)
    if run.clearance != 1.0:
        bearing = bearing.replace(diametral_clearance=run.clearance * bearing.diametral_clearance)
    return bearing.replace(out_of_round_second=run.oval) if run.oval else bearing


def case_of(run: Run) -> Case:
    """The case as the program takes it."""
    turbine, bearing = Turbine.read(run.seat), bearing_of(run)
    prefix = "nrel5-" if turbine.load_set == "nrel5" else ""
    hub = HubLoads.bundled(f"{prefix}{run.wind}B")
    loads = main_bearing_load(hub, turbine.drivetrain).window(0.0, SECONDS)
    if run.steady:
        force = loads.force.mean(axis=0) * ([1, 1, 1] if run.steady == "mean" else [1, 1, 0])
        loads = BearingLoads.constant(force, float(loads.shaft_speed.mean()), 30.0)
    laws = Laws.paper() if run.model == "paper" else Laws.physical()
    settings = {"laws": laws, **run.changes}
    return Case(
        loads=loads,
        bearing=bearing,
        lubricant=Lubricant.read(turbine.lubricant),
        drivetrain=turbine.drivetrain,
        rollers=[0, bearing.rollers_per_row // 2],
        rating=False,
        traces=Traces(step=0.1) if run.variant == AS_IT_IS else None,
        **settings,
    )


Measures = dict[tuple[str, str], float]


def measures(run: Run) -> Measures:
    """Numbers of a case by row, or "both" for those of the bearing, and quantity."""
    case = case_of(run)
    result = simulate(case)
    assert (result.status == 0).all(), run.key
    numbers = powers(result) | films(result) | damages(result) | torques(run, case, result)
    if run.variant == AS_IT_IS and run.model == "physical":
        numbers |= loads_and_spin(case, result)
    return numbers


def powers(result: xr.Dataset) -> Measures:
    """Mean powers of a roller [W] by interface, and its peaks in complete orbits [W]."""
    length = result.attrs["window_end"] - result.attrs["window_start"]
    scale = 1.0 / result.sizes["roller"] / length
    numbers: Measures = {}
    for row in result.row.values.tolist():
        of_row = result.sel(row=row)
        for interface in result.interface.values.tolist():
            at = of_row.sel(interface=interface)
            numbers[row, f"energy {interface}"] = float(at.energy.sum()) * scale
            numbers[row, f"rolling {interface}"] = float(at.rolling_energy.sum()) * scale
        peak = of_row.peak_power.max("interface")
        numbers[row, "lowest spin"] = float(of_row.min_spin_ratio.min())
        numbers[row, "peak mean"] = float(peak.mean())
        numbers[row, "peak std"] = float(peak.std())
        numbers[row, "peak largest"] = float(of_row.window_peak_power.max())
    return numbers


def films(result: xr.Dataset) -> Measures:
    """Shares of the loaded time with thin films at the inner raceway, and the least film ratio."""
    numbers: Measures = {}
    if "film_slip_time" not in result:
        return numbers
    for row in result.row.values.tolist():
        of_row = result.sel(row=row)
        time = of_row.film_slip_time.sel(raceway="inner").sum("slip_class").values
        total = float(time.sum())
        for below in (1.0, 3.0):
            thin = float(time[: FILM_EDGES.index(below) + 1].sum())
            numbers[row, f"mixed below {below:g}"] = thin / total if total > 0.0 else np.nan
        least = of_row.min_film_ratio.sel(interface=["inner", "outer"])
        numbers[row, "least film ratio"] = float(least.min())
    return numbers


def damages(result: xr.Dataset) -> Measures:
    """Criteria of damage: rates by row, and the worst value of each."""
    numbers: Measures = {}
    if "surface_work" not in result:
        return numbers
    criteria = damage(result)
    for yearly in (of_criterion for criterion in CRITERIA for of_criterion in criterion.yearly):
        value = yearly.of_run(criteria, result)
        if value is None:
            continue
        for row in result.row.values.tolist():
            of_row = value.sel(row=row) if "row" in value.dims else value
            numbers[row, yearly.run_name] = float(of_row.max())
    for name in criteria.criterion.values.tolist():
        line = criteria.sel(criterion=name)
        numbers["both", f"criterion {name}"] = float(line.value)
        numbers["both", f"reference {name}"] = float(line.reference)
    return numbers


def torques(run: Run, case: Case, result: xr.Dataset) -> Measures:
    """Mean loads [N] and speed [rad/s]; friction torque beside the handbooks' [N m]."""
    first, last = result.attrs["window_start"], result.attrs["window_end"]
    loads = case.loads
    assert isinstance(loads, BearingLoads)
    inside = (loads.time >= first) & (loads.time <= last)
    force, speed = loads.force[inside], loads.shaft_speed[inside]
    radial, mean = np.hypot(force[:, 0], force[:, 1]), float(speed.mean())
    share = case.bearing.rollers_per_row / result.sizes["roller"] / (last - first)
    power = float((result.energy + result.rolling_energy).sum()) * share
    numbers = {
        ("both", "radial"): float(radial.mean()),
        ("both", "thrust"): float(force[:, 2].mean()),
        ("both", "speed"): mean,
        ("both", "torque"): (power + float(result.attrs["drag_power"])) / mean,
    }
    for name, law in (("skf", skf_torque), ("palmgren", palmgren_torque)):
        torque = law(case.bearing, case.oil, radial, force[:, 2], speed, series=SEATS[run.seat])
        numbers["both", name] = float(np.mean(torque.total))
    return numbers


def loads_and_spin(case: Case, result: xr.Dataset) -> Measures:
    """Shares of the time with and without load, spin without load, and the basic life [h]."""
    first, last = result.attrs["window_start"], result.attrs["window_end"]
    _, load = roller_load_series(case, first, last)
    numbers: Measures = {("both", "basic life"): float(rate_case(case).basic_life)}
    for k, row in enumerate(result.row.values.tolist()):
        pressed = load[:, k] > 0.0
        numbers[row, "pressed"] = float(pressed.mean())
        numbers[row, "empty"] = float((~pressed.any(axis=1)).mean())
        of_row = result.sel(row=row, time=slice(first, last))
        idle = (of_row.spin / of_row.spin_pure).where(of_row.roller_load <= 0.0)
        numbers[row, "spin idle"] = float(idle.mean())
        for share in (0.05, 0.95):
            numbers[row, f"spin idle {share}"] = float(idle.quantile(share))
    return numbers


def compute(folder: Path, seat: str) -> None:
    """Simulate every case of a seat that is not there yet."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{seat}.csv"
    names = ["seat", "wind", "model", "variant"]
    there = set()
    if path.exists():
        there = set(pd.read_csv(path)[names].itertuples(index=False, name=None))
    for run in runs(seat):
        if run.key in there:
            continue
        lines = [
            [*run.key, row, quantity, value] for (row, quantity), value in measures(run).items()
        ]
        frame = pd.DataFrame(lines, columns=[*names, "row", "quantity", "value"])
        frame.to_csv(path, mode="a", header=not path.exists(), index=False)
        print(*run.key, flush=True)


def figure(seats: Mapping[str, Seat]) -> Figure:
    """Energy, cage, films, wear, entries and torque over the wind, of all seats."""
    drawn, panels = new_figure(9.6, 5.6, columns=3, rows=2)
    axes = np.ravel(panels)
    for name, seat in seats.items():
        colour = COLOURS[name]
        for row, style in (("downwind", "-"), ("upwind", "--")):
            label = f"{name}, {row}"
            axes[0].plot(WINDS, seat.friction(row), style, color=colour, label=label)
            axes[1].plot(WINDS, 100.0 * seat.cage_share(row), style, color=colour)
            axes[2].plot(WINDS, 100.0 * seat.over(row, "mixed below 3"), style, color=colour)
            wear = 1e6 * seat.per_year(row, "wear_rate")
            axes[3].plot(WINDS, np.where(wear > 1e-5, wear, np.nan), style, color=colour)
            entries = 3600.0 * seat.over(row, "entry_rate")
            axes[4].plot(WINDS, entries, style, color=colour)
        axes[5].plot(WINDS, seat.over("both", "torque") / seat.over("both", "skf"), color=colour)
    axes[0].set_yscale("log")
    axes[3].set_yscale("log")
    axes[5].set_ylim(0.0, 1.3)
    wind = "mean wind speed [m/s]"
    names = (
        "friction power of a roller [W]",
        "share of the cage [%]",
        "loaded time with Λ < 3 [%]",
        "wear of the deepest place [µm/year]",
        "entries beyond 0.05 [1/h]",
        "torque over SKF's [1]",
    )
    for axis, label in zip(axes, names, strict=True):
        finish(axis, wind, label)
    handles, labels = axes[0].get_legend_handles_labels()
    drawn.legend(handles, labels, loc="outside upper center", ncols=3, frameon=False, fontsize=8)
    return drawn


def tell(folder: Path) -> None:
    """Print the tables and draw the figure."""
    seats = {name: Seat(pd.read_csv(folder / f"{name}.csv")) for name in SEATS}
    print(table_text(CONCLUSIONS, seats))
    print("", summary_text(seats), sep="\n")
    matplotlib.rcParams["svg.hashsalt"] = "macroslip"
    path = Path(__file__).parent / "figures" / "second_turbine.svg"
    figure(seats).savefig(path, metadata={"Date": None})


if __name__ == "__main__":
    if sys.argv[1] == "compute":
        compute(Path(sys.argv[2]), sys.argv[3])
    else:
        tell(Path(sys.argv[2]))
