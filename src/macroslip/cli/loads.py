"""`macroslip loads inspect`: content of a load file, and the load on the main bearing."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from macroslip.cli.catalogue import si
from macroslip.cli.failure import command, to_stderr
from macroslip.cli.needs import PICTURE, require
from macroslip.cli.options import AsJson, Force
from macroslip.cli.printing import number, print_json, print_table
from macroslip.errors import InputError
from macroslip.storage.files import check_new_file, new_file

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from macroslip.case.case import Case
    from macroslip.loads import BearingLoads, Drivetrain, HubLoads

loads = typer.Typer(
    name="loads", help="Load histories.", no_args_is_help=True, rich_markup_mode=None
)

_PICTURES = (".png", ".svg", ".pdf")
_NO_UNIT = ("mount", "locating", "bearing", "front", "front_moment_share", "windio")


def _length(help: str) -> Any:
    return typer.Option(help=f"{help}: '1.9 m'. Overrides the case file's.")


def inspect(
    file: Annotated[
        Path,
        typer.Argument(
            help="Output of OpenFAST, Bladed or HAWC2, or a table (.parquet, .csv, .xlsx) of hub or bearing loads."
        ),
    ],
    case: Annotated[
        Path | None,
        typer.Option(
            help="Case file whose drivetrain, bearing and lubricant are used; its loads are not."
        ),
    ] = None,
    hub_to_bearing: Annotated[
        str | None, _length("From the hub centre to the main bearing")
    ] = None,
    bearing_to_gearbox: Annotated[
        str | None, _length("From the main bearing to the gearbox's support")
    ] = None,
    tilt: Annotated[
        str | None, typer.Option(help="Tilt of the shaft, positive with the hub end up: '5 deg'.")
    ] = None,
    shaft_mass: Annotated[
        str | None, typer.Option(help="Mass of the shaft without the rotor: '8000 kg'.")
    ] = None,
    shaft_mass_station: Annotated[
        str | None, _length("Distance of that mass behind the hub centre")
    ] = None,
    shaft_speed: Annotated[
        str | None, typer.Option(help="Constant shaft speed, in place of the file's: '20 rpm'.")
    ] = None,
    decimal: Annotated[str, typer.Option(help="Mark before the decimals of a CSV table.")] = "",
    thousands: Annotated[
        str, typer.Option(help="Mark between groups of three digits in a CSV table.")
    ] = "",
    sheet: Annotated[
        str, typer.Option(help="Sheet of a workbook of Excel; the first one if not given.")
    ] = "",
    hub_to_output: Annotated[
        str | None,
        typer.Option(
            help="From the hub back to where the file has its loads, if elsewhere: '2 m'."
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="A picture of the loads to write: .png, .svg or .pdf."),
    ] = None,
    force: Force = False,
    as_json: AsJson = False,
) -> None:
    """Show the channels taken from a load file, statistics, and the load on the main bearing."""
    from macroslip.case.case_file import bearings_in, load_source, read_case
    from macroslip.input.units import ANGLE, LENGTH, MASS, SPEED
    from macroslip.loads import Drivetrain
    from macroslip.result.plausibility import doubtful_loads

    if output is not None:
        if output.suffix not in _PICTURES:
            raise InputError(
                "this is no kind of picture", where=str(output), allowed=f"{', '.join(_PICTURES)}"
            )
        require(PICTURE)
        inputs = [file]
        if case:
            inputs.append(case)
        check_new_file(output, force=force, inputs=inputs)
    options: dict[str, Any] = {
        "shaft_speed": si("--shaft-speed", shaft_speed, SPEED),
        "hub_to_output": si("--hub-to-output", hub_to_output, LENGTH),
        "decimal": decimal or None,
        "thousands": thousands or None,
        "sheet": sheet or None,
    }
    options = {name: value for name, value in options.items() if value is not None}
    own = {
        "hub_to_bearing": si("--hub-to-bearing", hub_to_bearing, LENGTH),
        "bearing_to_gearbox": si("--bearing-to-gearbox", bearing_to_gearbox, LENGTH),
        "tilt": si("--tilt", tilt, ANGLE),
        "shaft_mass": si("--shaft-mass", shaft_mass, MASS),
        "shaft_mass_station": si("--shaft-mass-station", shaft_mass_station, LENGTH),
    }
    bearings = bearings_in(case) if case else ("",)
    base = None
    if case:
        base = read_case(case, bearing=bearings[0])
    # The case file's drivetrain, or the default one, with single values replaced.
    own = {name: value for name, value in own.items() if value is not None}
    default = base.drivetrain if base else Drivetrain()
    drivetrain = replace(default, **own)
    if case:
        source = load_source(case)
        if source.file and file.exists() and file.samefile(case.parent / source.file):
            whole = dict(source.cut)
            whole.pop("start", None)
            whole.pop("end", None)
            options = whole | options
    description, loads, bearing = _read(file, options, drivetrain, bearings[1:])
    doubts = doubtful_loads(loads, base.bearing if base else None)
    if as_json:
        print_json(description | {"doubtful": doubts})
    else:
        _print(description)
        for sentence in doubts:
            to_stderr(f"doubtful: {sentence}")
    if output is not None:
        figure = _picture(bearing, base, drivetrain)
        with new_file(output, force=force) as temporary:
            figure.savefig(temporary, format=output.suffix[1:], dpi=150)
        if not as_json:
            typer.echo(f"\nwritten: {output}")


command(loads, inspect)


def _read(
    file: Path,
    options: dict[str, Any],
    drivetrain: Drivetrain,
    others: Sequence[str],
) -> tuple[dict[str, Any], HubLoads | BearingLoads, BearingLoads]:
    """Texts on a file, its loads, and its load on the main bearing; of `others` texts alone."""
    from macroslip.loads import BearingLoads, Drivetrain, HubLoads, main_bearing_load

    if _holds_bearing_loads(file, options.get("sheet", "")):
        if not options.keys() <= {"decimal", "thousands", "sheet"}:
            raise InputError(
                "--shaft-speed and --hub-to-output are for hub loads",
                where=str(file),
                remedy="Write the speed into the table's column.",
            )
        bearing = BearingLoads.read(file, **options)
        return _described(bearing, "load on the main bearing"), bearing, bearing
    hub = HubLoads.read(file, **options)
    bearing = main_bearing_load(hub, drivetrain)
    description = _described(hub, "hub loads in non-rotating shaft axes")
    description["reading"] = list(hub.reading)
    units = {"tilt": "deg", "shaft_mass": "kg"}
    plain = asdict(drivetrain)
    plain["tilt"] = math.degrees(drivetrain.tilt)
    described: dict[str, Any] = {"default": drivetrain == Drivetrain()}
    for name, value in plain.items():
        heading = name
        if name not in _NO_UNIT:
            heading = f"{name} [{units.get(name, 'm')}]"
        described[heading] = value
    description["drivetrain"] = described
    description["main bearing"] = _statistics(_forces(bearing))
    for name in others:
        other = replace(drivetrain, bearing=name)
        load = main_bearing_load(hub, other)
        description[f"{name} main bearing"] = _statistics(_forces(load))
    return description, hub, bearing


def _holds_bearing_loads(file: Path, sheet: str) -> bool:
    """True if a table has the columns of main-bearing loads; other faults show when it is read."""
    from macroslip.loads.table import open_table

    if not file.is_file() or file.suffix.lower() not in (
        ".parquet",
        ".csv",
        ".xlsx",
    ):  # a pipe would wait for ever
        return False
    try:
        names = open_table(file, None, sheet).names
        return any(name.startswith("F_X0") for name in names)
    except InputError:
        return False


def _described(read: HubLoads | BearingLoads, kind: str) -> dict[str, Any]:
    import numpy as np

    from macroslip.loads import HubLoads

    steps = np.diff(read.time)
    speed = read.shaft_speed * 30.0 / math.pi
    quantities = {"shaft speed [rpm]": speed}
    if isinstance(read, HubLoads):
        names = ("fx [kN]", "fy [kN]", "fz [kN]", "mx [kN m]", "my [kN m]", "mz [kN m]")
        loads_in_kilo = np.hstack([read.force, read.moment]).T / 1e3
        quantities |= dict(zip(names, loads_in_kilo, strict=True))
    else:
        quantities |= _forces(read)
    return {
        "source": read.source,
        "kind": kind,
        "samples": read.time.size,
        "time [s]": [read.time[0], read.time[-1]],
        "step [s]": {"median": np.median(steps), "min": steps.min(), "max": steps.max()},
        "statistics": _statistics(quantities),
    }


def _forces(read: BearingLoads) -> dict[str, NDArray]:
    forces = {}
    for name, values in zip(("F_X0", "F_Y0", "F_Z0"), read.force.T, strict=True):
        forces[f"{name} [kN]"] = values / 1e3
    square = read.force[:, 0] ** 2 + read.force[:, 1] ** 2
    radial = square**0.5
    return forces | {"radial [kN]": radial / 1e3}


def _statistics(quantities: dict[str, NDArray]) -> dict[str, dict[str, float]]:
    return {
        name: {"mean": values.mean(), "std": values.std(), "min": values.min(), "max": values.max()}
        for name, values in quantities.items()
    }


def _print(description: dict[str, Any]) -> None:
    step = description["step [s]"]
    range_of_steps = step["max"] - step["min"]
    spread = ""
    if range_of_steps > 1e-3 * step["median"]:
        spread = f" (median; {step['min']:.6g} s to {step['max']:.6g} s)"
    start, end = description["time [s]"]
    lines = {
        "source": description["source"],
        "kind": description["kind"],
        "taken": "\n          ".join(description.get("reading", ())),
        "samples": f"{description['samples']}",
        "time": f"{start:.6g} s to {end:.6g} s",
        "step": f"{step['median']:.6g} s{spread}",
    }
    for name, text in lines.items():
        if text:
            typer.echo(f"{name:<10}{text}")
    typer.echo()
    _table("statistics over the samples", description["statistics"])
    if "main bearing" in description:
        typer.echo()
        _table(
            f"load on the main bearing, with {_words(description['drivetrain'])}",
            description["main bearing"],
        )
    others = [key for key in description if key.endswith(" main bearing")]
    for name in others:
        typer.echo()
        _table(f"load on the {name}", description[name])


def _table(title: str, statistics: dict[str, dict[str, float]]) -> None:
    rows = [
        [name, *(number(float(value)) for value in values.values())]
        for name, values in statistics.items()
    ]
    print_table(title, ["", "mean", "std", "min", "max"], rows, "lrrrr")


def _words(drivetrain: dict[str, Any]) -> str:
    shaft = "no shaft mass"
    if mass := drivetrain["shaft_mass [kg]"]:
        station = drivetrain["shaft_mass_station [m]"]
        shaft = f"a shaft of {mass:g} kg {station:g} m behind the hub"
    whose = "the default" if drivetrain["default"] else "your"
    distance = drivetrain["hub_to_bearing [m]"]
    start = f"{whose} drivetrain ({distance:g} m from hub to "
    if drivetrain["mount"] == "four-point":
        between = drivetrain["front_to_rear [m]"]
        rear = f"{between:g} m from front to rear bearing, {drivetrain['locating']} locating"
        if drivetrain["front"] == "moment-carrying":
            share = drivetrain["front_moment_share"] or 0.0
            rear += f", a moment-carrying front that takes {share:g} of the moment"
        return f"{start}front bearing, {rear}, {shaft}): the {drivetrain['bearing']} bearing"
    to_gearbox = drivetrain["bearing_to_gearbox [m]"]
    return f"{start}bearing, {to_gearbox:g} m from bearing to gearbox, {shaft})"


def _picture(bearing: BearingLoads, base: Case | None, drivetrain: Drivetrain) -> Figure:
    from macroslip.bearing.geometry import ROWS
    from macroslip.case.case import Case
    from macroslip.report.load_figures import load_figure
    from macroslip.result.rating import roller_load_series

    parts = {}
    if base:
        parts = {"bearing": base.bearing, "lubricant": base.lubricant, "laws": base.laws}
    case = Case(loads=bearing, drivetrain=drivetrain, **parts)
    time, rollers = roller_load_series(case, bearing.start, bearing.end)
    upwind = rollers[:, ROWS.index("upwind")]
    return load_figure(bearing, time, upwind.sum(axis=-1))
