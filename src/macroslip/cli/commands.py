"""The commands and their options."""

from __future__ import annotations

from typing import Annotated

import typer

import macroslip
from macroslip.cli.aggregate import aggregate
from macroslip.cli.catalogue import bearing, lubricant, turbine
from macroslip.cli.compare import compare
from macroslip.cli.damage import damage
from macroslip.cli.doctor import doctor
from macroslip.cli.failure import command
from macroslip.cli.init import init
from macroslip.cli.loads import loads
from macroslip.cli.report import report
from macroslip.cli.reproduce import reproduce
from macroslip.cli.run import run
from macroslip.cli.scada import scada
from macroslip.cli.stiffness import stiffness
from macroslip.cli.study import study

app = typer.Typer(
    name="macroslip",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    epilog="Exit codes: 0 fine, 1 internal error, 2 bad input or usage, 3 some rollers failed, "
    "or some cases of a study, 130 interrupted.",
)
command(app, init)
command(app, run)
command(app, study)
command(app, aggregate)
command(app, damage)
command(app, report)
command(app, compare)
command(app, stiffness)
command(app, reproduce)
command(app, doctor)
app.add_typer(loads)
app.add_typer(scada)
app.add_typer(bearing)
app.add_typer(lubricant)
app.add_typer(turbine)


def _version(requested: bool) -> None:
    if requested:
        typer.echo(f"macroslip {macroslip.__version__}")
        raise typer.Exit()


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Slip, friction power and frictional energy of every roller of a wind-turbine main bearing."""
