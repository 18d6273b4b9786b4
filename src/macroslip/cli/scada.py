"""`macroslip scada`: ten-minute means of a turbine, and the heat and year of its main bearing."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from macroslip.cli.failure import command
from macroslip.cli.needs import FIGURES, require
from macroslip.cli.options import AsJson, Force, Quiet, Weibull, wind_of
from macroslip.cli.printing import number, print_json, print_notes, print_table
from macroslip.cli.progress import command_progress
from macroslip.cli.scada_heat import heat
from macroslip.storage.files import check_new_file, make_folder, write_new

if TYPE_CHECKING:
    from macroslip.scada import Scada
    from macroslip.study.real_year import RealYear

scada = typer.Typer(
    name="scada",
    help="Ten-minute means of a turbine: a year at its temperatures, and its bearing's heat.",
    no_args_is_help=True,
    rich_markup_mode=None,
)

Description = Annotated[
    Path, typer.Argument(help="The file that describes the means; `scada init` writes one.")
]
StudyFolder = Annotated[
    Path, typer.Option("--study", help="The folder that macroslip study has written.")
]
PAGE = "page.html"
#: Tables of `year`.
_TABLES = ("bins.csv", "year.csv")


def init(
    file: Annotated[
        Path, typer.Argument(help="An export of a turbine: csv, csv.gz, parquet or xlsx.")
    ],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The file to write; scada.yaml beside the export."),
    ] = None,
    sheet: Annotated[str | None, typer.Option(help="Name of the sheet of an xlsx file.")] = None,
    force: Force = False,
) -> None:
    """Write the description of an export, with the columns that were recognized."""
    from macroslip.scada.draft import draft

    output = output or file.with_name("scada.yaml")
    check_new_file(output, force=force, inputs=[file])
    text, notes = draft(file, output.parent, sheet)
    write_new(output, text, force=force)
    for line in notes:
        typer.echo(line)
    typer.echo(f"written:    {output}")
    typer.echo(f"look at it: macroslip scada inspect {output}")


def inspect(
    description: Description,
    study: Annotated[
        Path | None,
        typer.Option(
            "--study", help="Folder of a study whose speeds are put beside the turbine's."
        ),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Show what is in the means of a turbine: rows by month and filter, winds and temperatures."""
    from macroslip.scada import Scada
    from macroslip.scada.bins import histogram
    from macroslip.scada.reader import rows_by_month, told_rows
    from macroslip.study.speeds import speed_notes, speeds_beside

    read = Scada.read(description)
    beside = None
    notes = list(read.notes)
    if study is not None:
        beside = speeds_beside(read, study)
        notes += speed_notes(beside)
    counts = rows_by_month(read.counts)
    shares = histogram(read)
    if as_json:
        report = {
            "about": told_rows(read),
            "notes": notes,
            "counts": read.counts.astype({"filter": str}).to_dict("records"),
            "histogram": shares.to_dict("records"),
        }
        if beside is not None:
            report["speeds"] = beside.to_dict("records")
        print_json(report)
        return
    typer.echo(told_rows(read))
    print_notes(notes)
    typer.echo()
    shown = [str(name) for name, rows in counts.items() if rows.sum() > 0]
    lines = []
    for month in counts.index:
        cells = [f"{counts.loc[month, name]}" for name in shown]
        lines.append([month, *cells])
    sums = [f"{counts[name].sum()}" for name in shown]
    lines.append(["all", *sums])
    print_table(
        "rows by month, and the first filter that drops them; absent: steps without a row",
        ["", *shown],
        lines,
        "l" + "r" * len(shown),
    )
    typer.echo()
    _print_histogram(read)
    if beside is not None:
        typer.echo()
        print_table(
            "speed of the rotor",
            [str(name) for name in beside],
            [map(number, line) for line in beside.itertuples(index=False)],
            "r" * len(beside.columns),
        )


def _print_histogram(read: Scada) -> None:
    from macroslip.scada.bins import histogram

    shares = histogram(read)
    shares = shares.rename(columns={"bearing_temperature [degC]": "temperature"})
    turning = shares[shares["state"] == "turning"]
    table = turning.pivot_table(
        index="wind_speed [m/s]", columns="temperature", values="share", aggfunc="sum"
    )
    idle = shares[shares["state"] == "idle"]
    share_at = idle.groupby("temperature")["share"].sum()
    stood = share_at.to_dict()
    lines = []
    for wind, row in zip(table.index, table.to_numpy(), strict=True):
        percents = [_percent(share) for share in row]
        lines.append([f"{wind:g}", *percents])
    idle_shares = [_percent(stood.get(at, 0.0)) for at in table.columns]
    lines.append(["idle", *idle_shares])
    temperatures = [f"{at:g}" for at in table.columns]
    print_table(
        "% of the rows with data, by wind speed [m/s] and temperature of the bearing [degC]",
        ["", *temperatures],
        lines,
        "r" + "r" * len(temperatures),
    )


def _percent(share: float) -> str:
    """A share in per cent with two digits; a dash for none."""
    if not share > 0.0:
        return "-"
    return f"{100.0 * share:.2g}"


def year(
    description: Description,
    study: StudyFolder,
    output: Annotated[Path, typer.Option("--output", "-o", help="The folder for tables and page.")],
    weibull: Weibull = None,
    allow_short: Annotated[
        bool, typer.Option("--allow-short", help="Let less than 30 days stand for a year.")
    ] = False,
    force: Force = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Compute a year at the winds and temperatures of a turbine, beside years at one temperature."""
    require(FIGURES)
    from macroslip.report.real_year_page import real_year_page
    from macroslip.study.real_year import real_year

    make_folder(output)
    for name in (*_TABLES, PAGE):
        check_new_file(output / name, force=force, inputs=[description])
    with command_progress(quiet=quiet, work="computing the year"):
        real = real_year(description, study, wind=wind_of(weibull), allow_short=allow_short)
        contents = {
            "bins.csv": real.bins.to_csv(index=False, lineterminator="\n"),
            "year.csv": real.table.to_csv(index=False, lineterminator="\n"),
            PAGE: real_year_page(real),
        }
    for name, text in contents.items():
        write_new(output / name, text, force=force)
    if as_json:
        written = [str(output / name) for name in contents]
        print_json(
            {"year": real.table.to_dict("records"), "notes": list(real.notes), "written": written}
        )
        return
    if quiet:
        return
    _print_year(real)
    for name in contents:
        typer.echo(f"written: {output / name}")


def _print_year(real: RealYear) -> None:
    from macroslip.report.real_year_page import verdict

    for sentence in verdict(real):
        typer.echo(sentence)
    print_notes(real.notes)
    typer.echo()
    names = ["real", "at_mean", "fixed", "real_over_fixed", "oil_cooler", "oil_warmer", "seeds [%]"]
    lines = []
    for line in real.table.to_dict("records"):
        head = f"{line['design']} {line['quantity']} [{line['unit']}]".strip()
        values = [number(line[name]) for name in names]
        lines.append([head, *values])
    headings = ["", "real", "at the mean", "at 35 degC", "real/35 degC", "oil −5 K", "oil +5 K"]
    columns = "l" + "r" * len(names)
    print_table(f"a year: {real.source}", [*headings, "seeds [%]"], lines, columns)


command(scada, init)
command(scada, inspect)
command(scada, year)
command(scada, heat)
