"""Options that several commands share, each declared once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from macroslip.study import weights

AsJson = Annotated[bool, typer.Option("--json", help="Print it as JSON.")]
Force = Annotated[bool, typer.Option("--force", help="Replace the output file if it exists.")]
Quiet = Annotated[bool, typer.Option("--quiet", help="Show failures only, each error on one line.")]
Threads = Annotated[
    int | None,
    typer.Option(min=1, help="Threads over the rollers of a case; all processors if not given."),
]
Weibull = Annotated[
    tuple[float, float] | None,
    typer.Option(
        help="Of a study: scale [m/s] and shape of the distribution of the wind speed, in place of "
        "the study file's."
    ),
]
By = Annotated[
    list[str] | None,
    typer.Option(help="Of a study: a label to keep apart, such as bearing. Repeatable."),
]


def wind_of(weibull: tuple[float, float] | None) -> weights.Weibull | None:
    """The distribution that `--weibull` gives; None where the option is left out."""
    from macroslip.study import weights

    if weibull is None:
        return None
    scale, shape = weibull
    return weights.Weibull(scale=scale, shape=shape)
