"""`macroslip bearing`, `lubricant` and `turbine`: catalogue, own files, estimates, drawings."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple, overload

import typer

from macroslip.cli.failure import command
from macroslip.cli.needs import PICTURE, require
from macroslip.cli.options import AsJson, Force
from macroslip.cli.printing import print_json, print_table
from macroslip.errors import InputError
from macroslip.kinds import KINDS, kind_of
from macroslip.storage.files import check_new_file, new_file, write_new

if TYPE_CHECKING:
    from macroslip.bearing.kinds import AnyBearing
    from macroslip.bearing.sampled import Estimated
    from macroslip.input.record import Record
    from macroslip.input.units import Dimension
    from macroslip.kinds.kind import Kind
    from macroslip.kinds.makers_page import PageOption
    from macroslip.turbine import Turbine

_BASE = "skf-240-600-bc"
_DRAWINGS = (".svg", ".pdf", ".png")

NameOrFile = Annotated[str, typer.Argument(help="A catalogue name, or the path of a file.")]


@overload
def si(option: str, text: str, dimension: Dimension) -> float: ...


@overload
def si(option: str, text: str | None, dimension: Dimension) -> float | None: ...


def si(option: str, text: str | None, dimension: Dimension) -> float | None:
    """The value of an option, in SI."""
    from macroslip.input.units import parse_quantity

    if text is None:
        return None
    value, unit = parse_quantity(text, dimension, option)
    return dimension.to_si(value, unit)


def _write(path: Path, record: Record, force: bool) -> None:
    write_new(path, record.as_yaml(), force=force)


def _record(noun: str) -> type[Record]:
    from macroslip import Bearing, Lubricant, Turbine

    return {"bearing": Bearing, "lubricant": Lubricant, "turbine": Turbine}[noun]


def _names(noun: str) -> Sequence[str]:
    """Names of a catalogue; of bearings those of every kind."""
    if noun == "bearing":
        from macroslip.bearing.kinds import bearing_catalogue

        return bearing_catalogue()
    return _record(noun).catalogue()


def _read(noun: str, name_or_file: str) -> Record:
    """A record of a catalogue or a file; a bearing of any kind."""
    if noun == "bearing":
        from macroslip.bearing.kinds import read_bearing

        return read_bearing(name_or_file)
    return _record(noun).read(name_or_file)


_HELP = {
    "bearing": "The bearing catalogue and files of your own.",
    "lubricant": "The lubricant catalogue and files of your own.",
    "turbine": "Named turbines, each with bearing, mount, loads and oil, and files of your own.",
}


def _catalogue(noun: str) -> typer.Typer:
    app = typer.Typer(
        name=noun,
        help=_HELP[noun],
        no_args_is_help=True,
        rich_markup_mode=None,
    )

    def list(as_json: AsJson = False) -> None:
        records = [_read(noun, name) for name in _names(noun)]
        if as_json:
            printed = [{"name": record.name, "title": record.title} for record in records]
            print_json(printed)
            return
        rows = [[record.name, record.title] for record in records]
        print_table(f"{noun}s", ["name", "title"], rows)

    def show(
        name_or_file: NameOrFile,
        yaml: Annotated[
            bool, typer.Option("--yaml", help="Print it as a file, to save and to change.")
        ] = False,
        as_json: AsJson = False,
    ) -> None:
        record = _read(noun, name_or_file)
        if yaml:
            typer.echo(record.as_yaml(), nl=False)
        else:
            about = _ABOUT.get(noun)
            more = None
            if about:
                more = _Rows(about.heading, about.rows(record))
            _show(record, more, as_json)

    def schema() -> None:
        import json

        content = _record(noun).json_schema()
        typer.echo(json.dumps(content, indent=2))

    list.__doc__ = f"List the {noun}s of the catalogue."
    show.__doc__ = f"Show every value of a {noun} and its origin."
    schema.__doc__ = f"Print the JSON Schema of {noun} files."
    for function in (list, show, schema):
        command(app, function)
    return app


class _Rows(NamedTuple):
    """Rows of name, value and meaning beside the quantities of a record."""

    heading: str
    lines: list[list[str]]


def _show(record: Record, more: _Rows | None, as_json: bool) -> None:
    """Print a record, and notes beside its quantities."""
    from dataclasses import asdict

    from macroslip.input.record import TAGS
    from macroslip.input.units import with_unit

    if as_json:
        names = ("quantity", "value", "meaning")
        values = {key: asdict(origin) for key, origin in record.provenance.items()}
        printed = {"name": record.name, "title": record.title, "values": values}
        heading, lines = more or _Rows(_FOLLOWS, [])
        entries = [dict(zip(names, line, strict=True)) for line in lines]
        print_json(printed | {heading: entries})
        return
    rows = []
    for key, origin in record.provenance.items():
        value = with_unit(origin.value, origin.unit)
        rows.append([key, value, f"{origin.tag}: {TAGS[origin.tag]}", origin.note])
    title = record.name
    if record.title:
        title = f"{record.name}: {record.title}"
    print_table(title, ["key", "value", "where it comes from", "note"], rows, "lrll")
    if more:
        typer.echo()
        print_table(more.heading, ["quantity", "value", "meaning"], more.lines, "lrl")


def _of_bearing(bearing: AnyBearing) -> list[list[str]]:
    return kind_of(bearing).consequences(bearing)


def _of_turbine(turbine: Turbine) -> list[list[str]]:
    mount = turbine.mount
    if turbine.mount == "four-point":
        front = ""
        if turbine.front:
            front = f", {turbine.front} front"
        mount += f"{front}, {turbine.locating} locating, {turbine.simulated} simulated"
    return [
        ["bearing", turbine.bearing, turbine.bearing_choice],
        ["lubricant", turbine.lubricant, turbine.lubricant_choice],
        ["mount", mount, "supports of the shaft"],
        ["loads", turbine.loads, f"simulated; all of them: bundled: [{turbine.load_set}]"],
        ["not known", "", turbine.not_known],
    ]


class _About(NamedTuple):
    """Text about a kind of record beside its quantities."""

    heading: str
    rows: Callable[[Any], list[list[str]]]


_FOLLOWS = "what follows from it"
_ABOUT = {
    "bearing": _About(_FOLLOWS, _of_bearing),
    "turbine": _About("its parts, and what is assumed of them", _of_turbine),
}


def _option(help: str) -> Any:
    return typer.Option(help=help)


#: Kinds of bearings whose inside is estimated; the first one is meant where none is named.
_ESTIMATED = {name: kind for name, kind in KINDS.items() if kind.page}
_Estimated = StrEnum("_Estimated", list(_ESTIMATED))
#: Numbers of makers' pages of all kinds, by the name of the option.
_PAGE = {option.name: option for kind in _ESTIMATED.values() for option in kind.page}


def _with_page(function: Callable[..., None]) -> Callable[..., None]:
    """The function of a command with an option for every number of `_PAGE` in place of `page`."""
    signature = inspect.signature(function, eval_str=True)
    options = []
    for parameter in signature.parameters.values():
        if parameter.kind is not parameter.VAR_KEYWORD:
            options.append(parameter.replace(kind=parameter.KEYWORD_ONLY))
    after_kind = 1 + [option.name for option in options].index("kind")
    options[after_kind:after_kind] = [_parameter(number) for number in _PAGE.values()]
    function.__signature__ = signature.replace(parameters=options)  # pyright: ignore[reportFunctionMemberAccess]
    function.__annotations__ = {option.name: option.annotation for option in options}
    return function


def _parameter(number: PageOption) -> inspect.Parameter:
    """A number of a maker's page as a parameter that Typer makes an option of."""
    least, most = number.range or (None, None)
    about = typer.Option(help=number.help, min=least, max=most)
    plain = str if number.dimension else number.type
    annotation = Annotated[plain | None, about]
    keyword = inspect.Parameter.KEYWORD_ONLY
    return inspect.Parameter(number.name, keyword, default=None, annotation=annotation)


@_with_page
def _estimate_bearing(
    output: Annotated[Path, typer.Option("--output", "-o", help="The bearing file to write.")],
    kind: Annotated[_Estimated, _option("Kind of the bearing.")] = next(iter(_Estimated)),
    seed: Annotated[int, typer.Option(min=0, help="Seed of the random numbers.")] = 1,
    force: Force = False,
    as_json: AsJson = False,
    **page: Any,
) -> None:
    """Estimate the inside of a bearing from its maker's page, and write a bearing file.

    Dimensions that the page leaves open are sampled within usual proportions. The file holds the
    median of every inner dimension and the range in which four out of five samples lie. It is an
    estimate, not the maker's drawing.
    """
    check_new_file(output, force=force)
    estimated_kind = _ESTIMATED[kind]
    _check_options(estimated_kind, page)
    values = {}
    for option in estimated_kind.page:
        value = page[option.name]
        if option.dimension:
            value = si(f"--{option.name}", value, option.dimension)
        values[option.field] = value
    title = f"Estimated from its maker's page{_size(values)}"
    estimated = estimated_kind.estimate(values, output.stem, title, seed)
    _write(output, estimated.bearing, force)
    _tell_estimate(estimated, output, as_json)


def _check_options(kind: Kind, page: dict[str, Any]) -> None:
    """InputError for options that a kind of bearing needs or does not have."""
    needed = [f"--{name}" for name in kind.needed_of_page]
    missing = [f"--{name}" for name in kind.needed_of_page if page[name] is None]
    if missing:
        raise InputError(
            f"{' and '.join(missing)} {'is' if len(missing) == 1 else 'are'} missing",
            allowed=f"with --kind {kind.name}: {', '.join(needed)}",
            remedy="Take what is missing from the maker's page.",
        )
    own = {option.name for option in kind.page}
    foreign = [f"--{name}" for name in page if page[name] is not None and name not in own]
    if foreign:
        raise InputError(
            f"{' and '.join(foreign)} {'does' if len(foreign) == 1 else 'do'} not count with --kind "
            f"{kind.name}",
            remedy="Remove what does not count, or choose the other --kind.",
        )


def _size(page: dict[str, Any]) -> str:
    """Boundary dimensions of a page in words; empty if it has none."""
    lengths = [page[key] for key in ("bore", "outside", "width") if page[key] is not None]
    if not lengths:
        return ""
    millimetres = [f"{1e3 * length:g}" for length in lengths]
    return f", {' x '.join(millimetres)} mm"


def _tell_estimate(estimate: Estimated[AnyBearing], output: Path, as_json: bool) -> None:
    """Print medians and ranges of an estimate, and compare it with published values."""
    numbers = _numbers(estimate)
    if as_json:
        print_json(numbers | {"written": str(output)})
        return
    rows = []
    for key, entry in numbers["values"].items():
        unit = "" if entry["unit"] == "1" else f" {entry['unit']}"
        low, high = entry["10 to 90 %"]
        median = f"{entry['median']:g}{unit}"
        rows.append([key, median, f"{low:g} to {high:g}{unit}"])
    title = (
        f"{estimate.bearing.name}: median and range of four out of five of "
        f"{numbers['bearings that fit the page']} bearings that fit the page"
    )
    print_table(title, ["key", "median", "10 to 90 %"], rows, "lrl")
    typer.echo()
    ratio = numbers["C by ISO 281 / published [1]"]
    typer.echo(kind_of(estimate.bearing).about_estimated_rating(ratio))
    for name in numbers["in the catalogue"]:
        typer.echo(f"The catalogue has a bearing of this size: bearing: {name}")
    typer.echo(f"An estimate from published values, not the maker's drawing.\nwritten: {output}")


def _numbers(estimate: Estimated[AnyBearing]) -> dict[str, Any]:
    """Every estimated value with its range, and C by ISO 281 over the published one, if known."""
    from macroslip.bearing.load_ratings import dynamic_load_rating_of

    bearing = estimate.bearing
    ratio = None
    published = bearing.dynamic_load_rating
    if published is not None and bearing.provenance["dynamic_load_rating"].tag == "V":
        by_iso = dynamic_load_rating_of(bearing)
        ratio = by_iso / published
    kind = type(bearing)
    known = [kind.read(name) for name in kind.catalogue()]
    size = ("bore_diameter", "outside_diameter", "width")
    values = {
        key: {"median": origin.value, "unit": origin.unit, "10 to 90 %": [*origin.range]}
        for key, origin in bearing.provenance.items()
        if origin.range is not None
    }
    count = int(estimate.samples["rollers_per_row"].size)
    return {
        "name": bearing.name,
        "bearings that fit the page": count,
        "values": values,
        "C by ISO 281 / published [1]": ratio,
        "in the catalogue": [
            known_bearing.name
            for known_bearing in known
            if all(getattr(known_bearing, key) == getattr(bearing, key) is not None for key in size)
        ],
    }


def _init(
    path: Annotated[Path, typer.Argument(help="The bearing file to write.")] = Path("bearing.yaml"),
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="The same, as elsewhere.")
    ] = None,
    force: Force = False,
) -> None:
    """Write a bearing file with the base bearing's values and every key explained, to change."""
    from macroslip import Bearing

    path = output or path
    check_new_file(path, force=force)
    base = Bearing.read(_BASE)
    started = base.replace(name=path.stem, title=f"Started from {_BASE}")
    _write(path, started, force)
    typer.echo(
        f"written: {path}\nlook at it:  macroslip bearing show {path}\n"
        f"use it:      bearing: {path}, in a case file"
    )


def _draw(
    name_or_file: NameOrFile,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="The drawing to write: .svg, .pdf or .png.")
    ],
    force: Force = False,
) -> None:
    """Draw the section of a bearing, with the name and value of every dimension."""
    from macroslip.bearing.kinds import read_bearing

    if output.suffix not in _DRAWINGS:
        allowed = "a name that ends with .svg, .pdf or .png"
        raise InputError("this is no kind of drawing", where=str(output), allowed=allowed)
    check_new_file(output, force=force)
    require(PICTURE)
    from macroslip.report.bearing_drawing import draw_bearing

    figure = draw_bearing(read_bearing(name_or_file))
    with new_file(output, force=force) as temporary:
        figure.savefig(temporary, format=output.suffix[1:])
    typer.echo(f"written: {output}")


def _estimate_lubricant(
    v40: Annotated[
        str, typer.Option("--v40", help="Kinematic viscosity at 40 degC, '320 mm2/s' for example.")
    ],
    v100: Annotated[str, typer.Option("--v100", help="Kinematic viscosity at 100 degC.")],
    base: Annotated[str, typer.Option("--base", help="Base oil, 'pao' or 'mineral' for example.")],
    name: Annotated[
        str, typer.Option("--name", help="Short name of the lubricant, used in results.")
    ] = "estimated",
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="File to write; else it is printed.")
    ] = None,
    force: Force = False,
) -> None:
    """Write a lubricant file from two viscosities and the base oil; estimates have the tag E."""
    from macroslip.input.units import KINEMATIC_VISCOSITY
    from macroslip.lubricant.estimate import estimate_lubricant

    at_40 = si("--v40", v40, KINEMATIC_VISCOSITY)
    at_100 = si("--v100", v100, KINEMATIC_VISCOSITY)
    oil = estimate_lubricant(at_40, at_100, base, name)
    if output is None:
        typer.echo(oil.as_yaml(), nl=False)
        return
    check_new_file(output, force=force)
    _write(output, oil, force)
    typer.echo(f"written: {output}\nshow it: macroslip lubricant show {output}")


bearing = _catalogue("bearing")
lubricant = _catalogue("lubricant")
turbine = _catalogue("turbine")
command(bearing, _estimate_bearing, "estimate")
command(bearing, _init, "init")
command(bearing, _draw, "draw")
command(lubricant, _estimate_lubricant, "estimate")
