"""`macroslip damage`: criteria of damage of a result on disk."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from macroslip.cli.excel import Xlsx, check_workbook, write_workbook
from macroslip.cli.options import AsJson, Force
from macroslip.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.result.criteria.criterion import Threshold

#: Beyond this many years of wear no number is given.
_LONG = 500.0


def damage(
    result: Annotated[Path, typer.Argument(help="A file that `macroslip run` wrote.")],
    k: Annotated[
        list[float] | None,
        typer.Option(
            "--k",
            help="Coefficient of wear [m2/N]; with --hardness dimensionless. Repeatable, rising.",
        ),
    ] = None,
    hardness: Annotated[
        str | None,
        typer.Option(help="Hardness '7 GPa' by which the coefficients of wear are divided."),
    ] = None,
    threshold: Annotated[
        list[str] | None,
        typer.Option(
            help="Threshold of your own, 'entry_flash_temperature=120 K, our rig'. Repeatable."
        ),
    ] = None,
    xlsx: Xlsx = None,
    force: Force = False,
    as_json: AsJson = False,
) -> None:
    """Criteria of damage by slip (smearing, friction energy, micropitting, wear) and references."""
    from macroslip.cli.catalogue import si
    from macroslip.cli.printing import print_json, print_table
    from macroslip.constants import YEAR
    from macroslip.input.units import PRESSURE
    from macroslip.report.accessor import open_result
    from macroslip.result.damage import criterion_lines
    from macroslip.result.damage import damage as computed

    check_workbook(xlsx, force=force, inputs=[result])
    own = dict(map(_threshold, threshold or ()))
    dataset = open_result(result)
    criteria = computed(
        dataset,
        wear_coefficients=k or None,
        hardness=si("--hardness", hardness, PRESSURE),
        thresholds=own,
    )
    lines, missing = criterion_lines(criteria)
    if xlsx is not None:
        from macroslip.report.sheets import damage_sheets

        sheets = damage_sheets(criteria, lines, dataset)
        write_workbook(xlsx, sheets, force=force)
    if as_json:
        named = {name: criteria.attrs[name] for name in ("title", "model", "oil")}
        named |= {"criteria": lines, "wear": _wear(criteria), "not kept": missing}
        print_json(named)
        return
    print_criteria(lines, missing, title=criteria.attrs["title"])
    if "wear_time" in criteria:
        years = (criteria.wear_time / YEAR).values
        rows = []
        for i, row in enumerate(criteria.row.values.tolist()):
            for j, surface in enumerate(criteria.surface.values.tolist()):
                ranges = [_range_of_years(line.min(), line.max()) for line in years[i, j]]
                rows.append([row, surface, *ranges])
        smallest_last = criteria.wear_coefficient.values[::-1]
        coefficients = ", ".join(f"{k:.2g}" for k in smallest_last)
        title = f"years of wear at k = {coefficients} m²/N"
        depths = [f"{1e6 * worn:g} µm" for worn in criteria.depth.values]
        sides = "ll" + "r" * len(depths)
        print_table(title, ["row", "surface", *depths], rows, sides)
    if xlsx is not None:
        typer.echo(f"written: {xlsx}")


def _range_of_years(least: float, most: float) -> str:
    """Years to a depth from the fastest to the slowest wear.

    Examples
    --------
    >>> _range_of_years(5.4, 540.0), _range_of_years(74.0, 74.0), _range_of_years(2e3, 2e5)
    ('5.4 to beyond 500', '74', 'beyond 500')
    """
    from macroslip.printed import number

    ends = ["beyond 500" if end > _LONG else number(end, 2) for end in (least, most)]
    return " to ".join(dict.fromkeys(ends))


def print_criteria(lines: list[dict[str, Any]], missing: list[str], *, title: str) -> None:
    """Print a line for every criterion, and a sentence for what is missing."""
    from macroslip.cli.printing import print_table
    from macroslip.report.result_numbers import criteria_table, how_sure

    if lines:
        shown = criteria_table(lines)
        columns = ["r" if name in ("value", "ratio") else "l" for name in shown.headings]
        print_table(title, shown.headings, shown.rows, columns)
        typer.echo(f"how sure: {how_sure(lines)}")
    for sentence in missing:
        typer.echo(sentence)


def _wear(criteria: xr.Dataset) -> list[dict[str, Any]]:
    """Years to each depth by row and surface, over the coefficients of wear."""
    if "wear_time" not in criteria:
        return []
    from macroslip.constants import YEAR

    return [
        {
            "row": row,
            "surface": surface,
            "depth [m]": depth,
            "wear coefficients [m2/N]": criteria.wear_coefficient.values.tolist(),
            "years": (
                criteria.wear_time.sel(row=row, surface=surface, depth=depth).values / YEAR
            ).tolist(),
        }
        for row in criteria.row.values.tolist()
        for surface in criteria.surface.values.tolist()
        for depth in criteria.depth.values.tolist()
    ]  # fmt: skip


def _threshold(text: str) -> tuple[str, Threshold]:
    from fractions import Fraction

    from macroslip.input.units import NUMBER, Dimension, Unit, parse_quantity
    from macroslip.result.criteria import CRITERIA
    from macroslip.result.criteria.criterion import Threshold

    name, _, setting = text.partition("=")
    value, _, source = setting.partition(",")
    units = {criterion.name: criterion.unit for criterion in CRITERIA}
    key = name.strip()
    source = source.strip()
    if key not in units or not source:
        allowed = f"'NAME=VALUE UNIT, SOURCE' with a name of {', '.join(units)}"
        raise InputError(
            f"the threshold '{text}' cannot be read", where="--threshold", allowed=allowed
        )
    unit = units[key]
    known = {unit: Unit(Fraction(1))}
    if unit.endswith("/m2"):
        per_square_millimetre = f"{unit[0]}/mm2"
        known[per_square_millimetre] = Unit(Fraction(10**6))
    dimension = NUMBER if unit == "1" else Dimension(known)
    number, unit_given = parse_quantity(value, dimension, name, "--threshold")
    return key, Threshold(dimension.to_si(number, unit_given), source)
