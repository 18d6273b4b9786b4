"""`macroslip aggregate`: from the results of a study to the tables a load team works with."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from macroslip.cli.excel import Xlsx, check_workbook, write_workbook
from macroslip.cli.options import AsJson, By, Force, Quiet, wind_of
from macroslip.cli.options import Weibull as WeibullOption
from macroslip.cli.printing import number, print_json, print_table
from macroslip.cli.progress import command_progress
from macroslip.errors import InputError, safe_text
from macroslip.storage.files import check_not_input, check_regular, make_folder

if TYPE_CHECKING:
    import pandas as pd

    from macroslip.study.weights import BinProbabilities, Weibull

#: Lines of the table that is printed.
_MOST_LINES = 20


def aggregate(
    directory: Annotated[Path, typer.Argument(help="The folder that macroslip study has written.")],
    output: Annotated[
        Path,
        typer.Option(
            "--output",
            "-o",
            help="The folder for the tables; those of the same names are replaced.",
        ),
    ],
    weibull: WeibullOption = None,
    probabilities: Annotated[
        Path | None,
        typer.Option(help="CSV table with the columns bin and probability, instead of --weibull."),
    ] = None,
    years: Annotated[float, typer.Option(help="The lifetime [years].")] = 20.0,
    field: Annotated[
        str | None,
        typer.Option(
            help="The label to sort into bins; that of the study file, or wind_speed, if not given."
        ),
    ] = None,
    width: Annotated[
        float | None, typer.Option(help="Width of a bin [unit of the label]; else 2.")
    ] = None,
    by: By = None,
    form: Annotated[str, typer.Option("--format", help="csv or parquet.")] = "csv",
    xlsx: Xlsx = None,
    force: Force = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Write lifetime energy, percentiles, worst cases and exceedance curves."""
    from macroslip.study.aggregation import aggregation_in_use
    from macroslip.study.export import FORMATS, tables, write_tables
    from macroslip.study.over_temperature import MIXED, NOT_MIXED, weighted_study
    from macroslip.study.reader import open_study
    from macroslip.study.year import coverage, year

    if form not in FORMATS:
        raise InputError(f"the format is '{form}'", where="--format", allowed=" or ".join(FORMATS))
    if xlsx is not None and xlsx.parent == output:
        make_folder(output)
    inputs = [probabilities] if probabilities else []
    check_workbook(xlsx, force=force, inputs=inputs)
    study = weighted_study(open_study(directory))
    wind = _weights(weibull, probabilities)
    stored = aggregation_in_use(study, wind, years)
    aggregation = replace(
        stored,
        field=field or stored.field,
        width=stored.width if width is None else width,
        by=by or (),
    )
    with command_progress(quiet=quiet, work="adding up the runs"):
        frames = tables(study, aggregation)
    for name in frames:
        check_not_input(output / f"{name}.{form}", inputs)
    written = write_tables(frames, output, form)
    if xlsx is not None:
        from macroslip.report.sheets import ORIGIN, origin_sheet

        origin = origin_sheet({"study": study}, choices={"aggregation": aggregation})
        write_workbook(xlsx, frames | {ORIGIN: origin}, force=force)
        written.append(xlsx)
    if as_json:
        lifetime = None
        if "lifetime" in frames:
            lifetime = frames["lifetime"].to_dict("records")
        names = [str(path) for path in written]
        print_json({"lifetime": lifetime, "written": names})
        return
    if quiet:
        return
    if "lifetime" in frames:
        _lifetime(frames["lifetime"], years)
        annual = year(study, aggregation)
        typer.echo(coverage(annual))
    if MIXED in study.attrs:
        typer.echo(f"note: {NOT_MIXED}")
    for path in written:
        typer.echo(f"written: {path}")


def _weights(
    weibull: tuple[float, float] | None, probabilities: Path | None
) -> Weibull | BinProbabilities | None:
    from macroslip.study.weights import BinProbabilities

    if weibull is not None and probabilities is not None:
        raise InputError(
            "--weibull and --probabilities are given together", remedy="Give one of them."
        )
    if probabilities is None:
        return wind_of(weibull)
    import pandas as pd

    check_regular(probabilities, "Name a CSV table.")
    try:
        of_bins = pd.read_csv(probabilities)
        centres = of_bins["bin"].astype(float)
        shares = of_bins["probability"].astype(float)
        return BinProbabilities(dict(zip(centres, shares, strict=True)))
    except InputError:
        raise
    except (OSError, ValueError, KeyError) as error:
        fault = f"the probabilities cannot be read ({error})"
        allowed = "a CSV table with the columns bin and probability"
        raise InputError(fault, where=str(probabilities), allowed=allowed) from None


def _lifetime(lifetime: pd.DataFrame, years: float) -> None:
    numbers = [name for name in lifetime if lifetime[name].dtype.kind == "f"]
    title = f"energy of a roller in {years:g} years, mean over the row"
    shown = lifetime
    if len(lifetime) > _MOST_LINES:
        ranked = lifetime.sort_values("lifetime_energy [J]", ascending=False, kind="stable")
        shown = ranked.head(_MOST_LINES)
        title += (
            f"; the {_MOST_LINES} highest of {len(lifetime)}, all of them are in the table lifetime"
        )
    rows = []
    for line in shown.itertuples(index=False):
        cells = []
        for name, value in zip(shown, line, strict=True):
            cells.append(number(value) if name in numbers else safe_text(value))
        rows.append(cells)
    columns = ["r" if name in numbers else "l" for name in shown]
    headings = list(map(str, shown))
    print_table(title, headings, rows, columns)
