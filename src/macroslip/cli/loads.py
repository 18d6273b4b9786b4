"""`macroslip loads inspect`: what a load file holds, and what it does to the main bearing."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from macroslip.cli.failure import command

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from macroslip.loads import BearingLoads, Drivetrain, HubLoads

loads = typer.Typer(name="loads", help="Load histories.", no_args_is_help=True, rich_markup_mode=None)


def inspect(
    file: Annotated[Path, typer.Argument(help="Output of OpenFAST, Bladed or HAWC2, or a table.")],
    shaft_speed: Annotated[
        str | None, typer.Option(help="Constant shaft speed of a file without one, such as '20 rpm'.")
    ] = None,
) -> None:
    """Show what was read from a load file, its statistics, and the load on the main bearing."""
    from macroslip.loads import BearingLoads, Drivetrain, HubLoads, main_bearing_load

    if _holds_bearing_loads(file):
        _describe(BearingLoads.read(file), "load on the main bearing", "shaft speed, F_X0, F_Y0, F_Z0")
        return
    hub_loads = HubLoads.read(file, shaft_speed=_speed(shaft_speed))
    _describe(hub_loads, "hub loads in non-rotating shaft axes", "shaft speed, fx, fy, fz, mx, my, mz")
    drivetrain = Drivetrain()
    bearing = main_bearing_load(hub_loads, drivetrain)
    typer.echo()
    _statistics(f"load on the main bearing, with {_words(drivetrain)}", _forces(bearing))


command(loads, inspect)


def _speed(text: str | None) -> float | None:
    """A speed with its unit, in rad/s."""
    from macroslip.catalogue.quantity import parse_quantity
    from macroslip.catalogue.units import SPEED

    if text is None:
        return None
    return SPEED.to_si(*parse_quantity(text, SPEED, "--shaft-speed"))


def _holds_bearing_loads(file: Path) -> bool:
    """Whether a table's columns are those of main-bearing loads; reading it tells what else may be wrong with it."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        if file.suffix.lower() == ".parquet":
            names = pq.read_schema(file).names
        elif file.suffix.lower() == ".csv":
            with file.open(encoding="utf-8") as text:
                names = text.readline().split(",")
        else:
            return False
    except (OSError, ValueError, pa.ArrowException):
        return False
    return any(name.strip(' "').startswith("F_X0") for name in names)


def _describe(read: HubLoads | BearingLoads, kind: str, channels: str) -> None:
    """Print where the loads come from, how they are sampled, and their statistics."""
    import numpy as np

    steps = np.diff(read.time)
    step = f"{np.median(steps):.6g} s"
    if np.ptp(steps) > 1e-3 * np.median(steps):
        step += f" (median; {steps.min():.6g} s to {steps.max():.6g} s)"
    typer.echo(f"source    {read.source}")
    typer.echo(f"kind      {kind}")
    typer.echo(f"channels  {channels}")
    for line in getattr(read, "reading", ()):
        typer.echo(f"read      {line}")
    typer.echo(f"samples   {read.time.size}")
    typer.echo(f"time      {read.time[0]:.6g} s to {read.time[-1]:.6g} s")
    typer.echo(f"step      {step}")
    typer.echo()
    quantities = {"shaft speed [rpm]": read.shaft_speed * 30.0 / math.pi}
    if hasattr(read, "moment"):
        quantities |= {
            f"{name} [kN]": values / 1e3 for name, values in zip(("fx", "fy", "fz"), read.force.T, strict=True)
        }
        quantities |= {
            f"{name} [kN m]": values / 1e3 for name, values in zip(("mx", "my", "mz"), read.moment.T, strict=True)
        }
    else:
        quantities |= _forces(read)
    _statistics("statistics over the samples", quantities)


def _forces(read: BearingLoads) -> dict[str, NDArray]:
    forces = {f"{name} [kN]": values / 1e3 for name, values in zip(("F_X0", "F_Y0", "F_Z0"), read.force.T, strict=True)}
    radial = (read.force[:, 0] ** 2 + read.force[:, 1] ** 2) ** 0.5
    return forces | {"radial [kN]": radial / 1e3}


def _statistics(title: str, quantities: dict[str, NDArray]) -> None:
    from macroslip.cli.printing import number, table

    rows = [
        [name, *(number(float(value)) for value in (values.mean(), values.std(), values.min(), values.max()))]
        for name, values in quantities.items()
    ]
    table(title, [("", False), ("mean", True), ("std", True), ("min", True), ("max", True)], rows)


def _words(drivetrain: Drivetrain) -> str:
    return (
        f"the default drivetrain ({drivetrain.hub_to_bearing:g} m from hub to bearing, "
        f"{drivetrain.bearing_to_gearbox:g} m from bearing to gearbox, no shaft mass)"
    )
