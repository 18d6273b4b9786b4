"""`macroslip scada`: what ten-minute means of a turbine say."""

from __future__ import annotations

import typer

from macroslip.cli.failure import command
from macroslip.cli.scada_heat import heat

scada = typer.Typer(
    name="scada",
    no_args_is_help=True,
    help="Ten-minute means of a turbine: the heat of its main bearing.",
)
command(scada, heat)
