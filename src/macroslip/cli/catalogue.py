"""`macroslip bearing` and `macroslip lubricant`: list, show and describe catalogue entries."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated

import typer

from macroslip.cli.failure import command

if TYPE_CHECKING:
    from macroslip.bearing import Bearing
    from macroslip.catalogue import Record
    from macroslip.lubricant import Lubricant


def _catalogue(
    noun: str, load: Callable[[], type[Record]], derived: Callable[[Record], list[list[str]]]
) -> typer.Typer:
    """The commands for one kind of record; `derived` gives name, value and meaning of what follows from it."""
    app = typer.Typer(
        name=noun, help=f"The {noun} catalogue and files of your own.", no_args_is_help=True, rich_markup_mode=None
    )

    def list() -> None:
        from macroslip.cli.printing import table

        records = [load().read(name) for name in load().catalogue()]
        table(f"{noun}s", [("name", False), ("title", False)], [[record.name, record.title] for record in records])

    def show(
        name_or_file: Annotated[str, typer.Argument(help="A catalogue name, or the path of a file.")],
        yaml: Annotated[bool, typer.Option("--yaml", help="Print it as a file, to save and to change.")] = False,
    ) -> None:
        from macroslip.catalogue import TAGS
        from macroslip.cli.printing import table

        record = load().read(name_or_file)
        if yaml:
            typer.echo(record.as_yaml(), nl=False)
            return
        rows = [
            [key, _written(origin.value, origin.unit), f"{origin.tag}: {TAGS[origin.tag]}", origin.note]
            for key, origin in record.provenance.items()
        ]
        headings = [("key", False), ("value", True), ("where it comes from", False), ("note", False)]
        table(f"{record.name}: {record.title}" if record.title else record.name, headings, rows)
        follows = derived(record)
        if follows:
            typer.echo()
            table("what follows from it", [("quantity", False), ("value", True), ("meaning", False)], follows)

    def schema() -> None:
        import json

        typer.echo(json.dumps(load().json_schema(), indent=2, ensure_ascii=False))

    list.__doc__ = f"List the {noun}s of the catalogue."
    show.__doc__ = f"Show every value of a {noun} and its origin."
    schema.__doc__ = f"Print the JSON Schema of {noun} files."
    for function in (list, show, schema):
        command(app, function)
    return app


def _written(value: float, unit: str) -> str:
    return f"{value}" if unit == "1" else f"{value} {unit}"


def _bearing_class() -> type[Bearing]:
    from macroslip.bearing import Bearing

    return Bearing


def _lubricant_class() -> type[Lubricant]:
    from macroslip.lubricant import Lubricant

    return Lubricant


def _of_bearing(bearing: Bearing) -> list[list[str]]:
    from macroslip.roller.model import roller_model, truncation_load

    lubricant = _lubricant_class().read("vg460-pao")  # none of these depends on it
    model = roller_model(bearing, lubricant, 1, tilt=0.0)
    longest = truncation_load(bearing, lubricant)
    return [
        ["stiffness K", f"{model.stiffness:.4g} N/m^1.5", "roller load = K (approach of the raceways)^1.5"],
        ["truncation load", f"{longest / 1e3:.4g} kN", "roller load at which a contact reaches the roller's ends"],
        ["orbit ratio", f"{model.orbit_ratio:.4f}", "orbital speed of rollers in pure rolling / shaft speed"],
    ]


bearing = _catalogue("bearing", _bearing_class, _of_bearing)
lubricant = _catalogue("lubricant", _lubricant_class, lambda lubricant: [])
