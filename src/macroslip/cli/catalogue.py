"""`macroslip bearing` and `macroslip lubricant`: list, show, describe and estimate catalogue entries."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from macroslip.cli.bearing import add_commands
from macroslip.cli.failure import command
from macroslip.files import check_new_file, new_file

if TYPE_CHECKING:
    from macroslip.bearing import Bearing
    from macroslip.input.record import Record
    from macroslip.lubricant import Lubricant

AsJson = Annotated[bool, typer.Option("--json", help="Print it as JSON.")]


def _catalogue(
    noun: str, load: Callable[[], type[Record]], derived: Callable[[Record], list[list[str]]]
) -> typer.Typer:
    """The commands for one kind of record; `derived` gives name, value and meaning of what follows from it."""
    app = typer.Typer(
        name=noun, help=f"The {noun} catalogue and files of your own.", no_args_is_help=True, rich_markup_mode=None
    )

    def list(as_json: AsJson = False) -> None:
        from macroslip.cli.printing import print_json, print_table

        records = [load().read(name) for name in load().catalogue()]
        if as_json:
            print_json([{"name": record.name, "title": record.title} for record in records])
            return
        print_table(
            f"{noun}s", [("name", False), ("title", False)], [[record.name, record.title] for record in records]
        )

    def show(
        name_or_file: Annotated[str, typer.Argument(help="A catalogue name, or the path of a file.")],
        yaml: Annotated[bool, typer.Option("--yaml", help="Print it as a file, to save and to change.")] = False,
        as_json: AsJson = False,
    ) -> None:
        from macroslip.cli.printing import print_json, print_table
        from macroslip.input.record import TAGS
        from macroslip.input.units import with_unit

        record = load().read(name_or_file)
        if yaml:
            typer.echo(record.as_yaml(), nl=False)
            return
        if as_json:
            from dataclasses import asdict

            follows = [dict(zip(("quantity", "value", "meaning"), line, strict=True)) for line in derived(record)]
            values = {key: asdict(origin) for key, origin in record.provenance.items()}
            print_json({"name": record.name, "title": record.title, "values": values, "what follows from it": follows})
            return
        rows = [
            [key, with_unit(origin.value, origin.unit), f"{origin.tag}: {TAGS[origin.tag]}", origin.note]
            for key, origin in record.provenance.items()
        ]
        headings = [("key", False), ("value", True), ("where it comes from", False), ("note", False)]
        print_table(f"{record.name}: {record.title}" if record.title else record.name, headings, rows)
        follows = derived(record)
        if follows:
            typer.echo()
            print_table("what follows from it", [("quantity", False), ("value", True), ("meaning", False)], follows)

    def schema() -> None:
        import json

        typer.echo(json.dumps(load().json_schema(), indent=2))

    list.__doc__ = f"List the {noun}s of the catalogue."
    show.__doc__ = f"Show every value of a {noun} and its origin."
    schema.__doc__ = f"Print the JSON Schema of {noun} files."
    for function in (list, show, schema):
        command(app, function)
    return app


def _bearing_class() -> type[Bearing]:
    from macroslip.bearing import Bearing

    return Bearing


def _lubricant_class() -> type[Lubricant]:
    from macroslip.lubricant import Lubricant

    return Lubricant


def _of_bearing(bearing: Bearing) -> list[list[str]]:
    from macroslip.contact.interface import truncation_load
    from macroslip.roller.model import roller_model

    lubricant = _lubricant_class().read("vg460-pao")  # none of these depends on it
    model = roller_model(bearing, lubricant, 1, tilt=0.0)
    longest = truncation_load(bearing, lubricant)
    return [
        ["stiffness K", f"{model.stiffness:.4g} N/m^1.5", "roller load = K (approach of the raceways)^1.5"],
        ["truncation load", f"{longest / 1e3:.4g} kN", "roller load at which a contact reaches the roller's ends"],
        ["orbit ratio", f"{model.orbit_ratio:.4f}", "orbital speed of rollers in pure rolling / shaft speed"],
    ]


def estimate(
    v40: Annotated[str, typer.Option("--v40", help="Kinematic viscosity at 40 degC, '320 mm2/s' for example.")],
    v100: Annotated[str, typer.Option("--v100", help="Kinematic viscosity at 100 degC.")],
    base: Annotated[str, typer.Option("--base", help="Base oil, 'pao' or 'mineral' for example.")],
    name: Annotated[str, typer.Option("--name", help="Short name of the lubricant, used in results.")] = "estimated",
    output: Annotated[Path | None, typer.Option("-o", "--output", help="File to write; else it is printed.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the file if it exists.")] = False,
) -> None:
    """Write a lubricant file from two viscosities and the base oil; what is estimated has the tag E and a range."""
    from macroslip.input.units import KINEMATIC_VISCOSITY, parse_quantity
    from macroslip.lubricant.estimate import estimate_lubricant

    def viscosity(text: str, option: str) -> float:
        return KINEMATIC_VISCOSITY.to_si(*parse_quantity(text, KINEMATIC_VISCOSITY, option))

    oil = estimate_lubricant(viscosity(v40, "--v40"), viscosity(v100, "--v100"), base, name)
    if output is None:
        typer.echo(oil.as_yaml(), nl=False)
        return
    check_new_file(output, force=force)
    with new_file(output, force=force) as temporary:
        temporary.write_text(oil.as_yaml(), encoding="utf-8")
    typer.echo(f"written: {output}\nshow it: macroslip lubricant show {output}")


bearing = _catalogue("bearing", _bearing_class, _of_bearing)
add_commands(bearing)
lubricant = _catalogue("lubricant", _lubricant_class, lambda lubricant: [])
command(lubricant, estimate)
