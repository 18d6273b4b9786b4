"""`macroslip bearing estimate`, `init` and `draw`: bearing files of the user's own, and pictures of them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from macroslip.cli.failure import command
from macroslip.cli.needs import PICTURE, require
from macroslip.errors import InputError
from macroslip.files import check_new_file, new_file

if TYPE_CHECKING:
    from macroslip.bearing import Bearing
    from macroslip.bearing.estimate import EstimatedBearing
    from macroslip.input.units import Dimension

_BASE = "skf-240-600-bc"

Output = Annotated[Path, typer.Option("--output", "-o", help="The bearing file to write.")]
Force = Annotated[bool, typer.Option("--force", help="Replace the file if it exists.")]


def _option(help: str) -> object:
    return typer.Option(help=help)


def estimate(
    bore: Annotated[str, _option("Bore diameter d, with its unit: '630 mm'.")],
    outside: Annotated[str, _option("Outside diameter D: '920 mm'.")],
    width: Annotated[str, _option("Width B: '290 mm'.")],
    c0: Annotated[str, _option("Static load rating C0: '17600 kN'.")],
    e: Annotated[float, _option("Axial factor e: 0.30.")],
    output: Output,
    shoulder: Annotated[str | None, _option("Shoulder diameter of the outer ring D1: '828 mm'.")] = None,
    groove: Annotated[str | None, _option("Width of the lubrication groove b: '56.5 mm'.")] = None,
    c: Annotated[str | None, _option("Dynamic load rating C: '9307 kN'.")] = None,
    cu: Annotated[str | None, _option("Fatigue load limit C_u or P_u: '1180 kN'.")] = None,
    y1: Annotated[float | None, _option("Axial factor Y1.")] = None,
    y2: Annotated[float | None, _option("Axial factor Y2.")] = None,
    y0: Annotated[float | None, _option("Static axial factor Y0.")] = None,
    mass: Annotated[str | None, _option("Mass: '623 kg'.")] = None,
    bpfo: Annotated[float | None, _option("Overrolling frequency of the outer ring, per turn of the shaft.")] = None,
    bpfi: Annotated[float | None, _option("Overrolling frequency of the inner ring, per turn of the shaft.")] = None,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the random numbers.")] = 1,
    force: Force = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print it as JSON.")] = False,
) -> None:
    """Estimate the inside of a bearing from its maker's page, and write a bearing file.

    What the page leaves open is sampled within usual proportions. The file holds the median of every inner dimension and
    the range in which four out of five samples lie. It is an estimate, not the maker's drawing.
    """
    from macroslip.bearing.estimate import MakersPage, estimate_bearing
    from macroslip.input.units import FORCE, LENGTH, MASS

    check_new_file(output, force=force)
    page = MakersPage(
        bore=_required("--bore", bore, LENGTH),
        outside=_required("--outside", outside, LENGTH),
        width=_required("--width", width, LENGTH),
        static_load_rating=_required("--c0", c0, FORCE),
        axial_factor_e=e,
        shoulder=_si("--shoulder", shoulder, LENGTH),
        groove=_si("--groove", groove, LENGTH),
        dynamic_load_rating=_si("--c", c, FORCE),
        fatigue_load_limit=_si("--cu", cu, FORCE),
        axial_factor_y1=y1,
        axial_factor_y2=y2,
        axial_factor_y0=y0,
        mass=_si("--mass", mass, MASS),
        bpfo=bpfo,
        bpfi=bpfi,
    )
    size = " x ".join(f"{1e3 * one:g}" for one in (page.bore, page.outside, page.width))
    found = estimate_bearing(page, output.stem, f"Estimated from its maker's page, {size} mm", seed=seed)
    _write(output, found.bearing, force)
    if as_json:
        from macroslip.cli.printing import print_json

        print_json(_numbers(found) | {"written": str(output)})
        return
    _report(found, output)


def init(
    path: Annotated[Path, typer.Argument(help="The bearing file to write.")] = Path("bearing.yaml"),
    force: Force = False,
) -> None:
    """Write a bearing file with every key explained, to change into your own: the base bearing's values."""
    from macroslip.bearing import Bearing

    check_new_file(path, force=force)
    _write(path, Bearing.read(_BASE).replace(name=path.stem, title=f"Started from {_BASE}"), force)
    typer.echo(
        f"written: {path}\nlook at it:  macroslip bearing show {path}\nuse it:      bearing: {path}, in a case file"
    )


def draw(
    name_or_file: Annotated[str, typer.Argument(help="A catalogue name, or the path of a file.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="The drawing to write: .svg, .pdf or .png.")],
    force: Force = False,
) -> None:
    """Draw the section of a bearing, with the name and value of every dimension."""
    from macroslip.bearing import Bearing

    if output.suffix not in (".svg", ".pdf", ".png"):
        raise InputError(
            "this is no kind of drawing", where=str(output), allowed="a name that ends with .svg, .pdf or .png"
        )
    check_new_file(output, force=force)
    require(PICTURE)
    from macroslip.report.bearing_drawing import draw_bearing

    figure = draw_bearing(Bearing.read(name_or_file))
    with new_file(output, force=force) as temporary:
        figure.savefig(temporary, format=output.suffix[1:])
    typer.echo(f"written: {output}")


def add_commands(app: typer.Typer) -> None:
    """Add the commands that make bearing files."""
    command(app, estimate)
    command(app, init)
    command(app, draw)


def _required(option: str, text: str, dimension: Dimension) -> float:
    from macroslip.input.units import parse_quantity

    return dimension.to_si(*parse_quantity(text, dimension, option))


def _si(option: str, text: str | None, dimension: Dimension) -> float | None:
    return None if text is None else _required(option, text, dimension)


def _write(path: Path, bearing: Bearing, force: bool) -> None:
    with new_file(path, force=force) as temporary:
        temporary.write_text(bearing.as_yaml(), encoding="utf-8")


def _numbers(found: EstimatedBearing) -> dict[str, Any]:
    """Every estimated value with its range, and the check by the dynamic load rating."""
    bearing = found.bearing
    return {
        "name": bearing.name,
        "bearings that fit the page": int(found.samples["contact_angle"].size),
        "values": {
            key: {"median": origin.value, "unit": origin.unit, "10 to 90 %": list(origin.range)}
            for key, origin in bearing.provenance.items()
            if origin.range is not None
        },
        "C by ISO 281 / published [1]": _rating_ratio(bearing),
    }


def _rating_ratio(bearing: Bearing) -> float | None:
    """Dynamic load rating by ISO 281 from the estimated dimensions over the published one, where there is one."""
    from macroslip.bearing.load_ratings import dynamic_load_rating

    published = bearing.dynamic_load_rating
    if published is None or bearing.provenance["dynamic_load_rating"].tag != "V":
        return None
    rating = dynamic_load_rating(
        2, bearing.rollers_per_row, bearing.roller_diameter, bearing.roller_length, bearing.contact_angle,
        2 * bearing.pitch_radius,
    )  # fmt: skip
    return rating / published


def _report(found: EstimatedBearing, output: Path) -> None:
    from macroslip.cli.printing import print_table

    numbers = _numbers(found)
    rows = []
    for key, one in numbers["values"].items():
        unit = "" if one["unit"] == "1" else f" {one['unit']}"
        low, high = one["10 to 90 %"]
        rows.append([key, f"{one['median']:g}{unit}", f"{low:g} to {high:g}{unit}"])
    print_table(
        f"{found.bearing.name}: median and range of four out of five of {numbers['bearings that fit the page']} bearings "
        "that fit the page",
        [("key", False), ("median", True), ("10 to 90 %", False)],
        rows,
    )
    typer.echo()
    ratio = numbers["C by ISO 281 / published [1]"]
    if ratio is not None:
        typer.echo(
            f"C by ISO 281 from these dimensions is {ratio:.3f} of the published one; "
            "within one family of bearings that scatters by 1 to 2 %."
        )
    typer.echo(f"An estimate from published values, not the maker's drawing.\nwritten: {output}")
