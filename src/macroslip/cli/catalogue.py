"""`macroslip bearing`, `lubricant` and `turbine`: catalogue, own files, estimates, drawings."""

from __future__ import annotations

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
from macroslip.storage.files import check_new_file, new_file, write_new

if TYPE_CHECKING:
    from macroslip.bearing import Bearing
    from macroslip.bearing.estimate import EstimatedBearing
    from macroslip.bearing.tapered import TaperedBearing
    from macroslip.bearing.tapered.estimate import EstimatedTaperedBearing
    from macroslip.input.record import Record
    from macroslip.input.units import Dimension
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


def _of_tapered(bearing: TaperedBearing) -> list[list[str]]:
    from macroslip.bearing.tapered import tapered_geometry
    from macroslip.result.tapered import STEEL_EXPANSION

    row = tapered_geometry(bearing)
    warmer = row.preload_per_kelvin(STEEL_EXPANSION, bearing.row_offset, bearing.arrangement)
    sliding = 1e3 * row.inner_rolling_ratio * row.rib_contact_height
    return [
        ["apex", f"{1e3 * row.apex_distance:.4g} mm", "distance from the middle of a roller"],
        ["rib share", f"{row.rib_share:.4f}", "force of the rib / load of the outer raceway"],
        ["rib sliding", f"{sliding:.4g} mm", "sliding speed at the rib / shaft speed"],
        ["preload by heat", f"{1e6 * warmer:.4g} um", "for each kelvin of temperature_difference"],
        [
            "orbit ratio",
            f"{row.orbit_ratio:.4f}",
            "orbital speed of rollers in pure rolling / shaft speed",
        ],
    ]


def _of_bearing(bearing: Bearing | TaperedBearing) -> list[list[str]]:
    if bearing.kind == "tapered":
        return _of_tapered(bearing)
    from macroslip import Lubricant
    from macroslip.contact.interface import truncation_load
    from macroslip.roller.model import roller_model

    lubricant = Lubricant.read("vg460-pao")  # none of these depends on it
    model = roller_model(bearing, lubricant, 1, tilt=0.0)
    orbit = [
        "orbit ratio",
        f"{model.orbit_ratio:.4f}",
        "orbital speed of rollers in pure rolling / shaft speed",
    ]
    if bearing.touches_along_line:
        return [
            [
                "stiffness C",
                f"{model.line_stiffness:.4g} N/m^(10/9)",
                "load of a straight roller = C (half the approach of the raceways)^(10/9)",
            ],
            [
                "profile depth d",
                f"{1e6 * model.profile_depth:.4g} um",
                "drop of the profile = d ln 1/(1 - (2 place/length)^2)",
            ],
            orbit,
        ]
    longest = truncation_load(bearing, lubricant)
    return [
        [
            "stiffness K",
            f"{model.stiffness:.4g} N/m^1.5",
            "roller load = K (approach of the raceways)^1.5",
        ],
        [
            "truncation load",
            f"{longest / 1e3:.4g} kN",
            "roller load at which a contact reaches the roller's ends",
        ],
        orbit,
    ]


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


class Kind(StrEnum):
    """Kinds of bearings whose inside is estimated."""

    SPHERICAL = "spherical"
    TAPERED = "tapered"


#: Options that each kind of bearing needs, and those of the other kind, which it does not have.
_NEEDED = {
    Kind.SPHERICAL: ("--bore", "--outside", "--width", "--c0", "--e"),
    Kind.TAPERED: ("--c0",),
}
_OF_OTHERS = {
    Kind.SPHERICAL: ("--rows", "--arrangement", "--y", "--a", "--distance"),
    Kind.TAPERED: ("--shoulder", "--groove", "--y1", "--y2", "--y0", "--bpfo", "--bpfi"),
}


def _estimate_bearing(
    context: typer.Context,
    output: Annotated[Path, typer.Option("--output", "-o", help="The bearing file to write.")],
    kind: Annotated[Kind, _option("Kind of the bearing.")] = Kind.SPHERICAL,
    bore: Annotated[str | None, _option("Bore diameter d, with its unit: '630 mm'.")] = None,
    outside: Annotated[str | None, _option("Outside diameter D: '920 mm'.")] = None,
    width: Annotated[str | None, _option("Width B, of a tapered bearing T or B: '290 mm'.")] = None,
    c0: Annotated[str | None, _option("Static load rating C0: '17600 kN'.")] = None,
    e: Annotated[float | None, _option("Axial factor e: 0.30.")] = None,
    shoulder: Annotated[
        str | None, _option("Shoulder diameter of the outer ring D1: '828 mm'.")
    ] = None,
    groove: Annotated[str | None, _option("Width of the lubrication groove b: '56.5 mm'.")] = None,
    c: Annotated[str | None, _option("Dynamic load rating C: '9307 kN'.")] = None,
    cu: Annotated[str | None, _option("Fatigue load limit C_u or P_u: '1180 kN'.")] = None,
    y1: Annotated[float | None, _option("Axial factor Y1.")] = None,
    y2: Annotated[float | None, _option("Axial factor Y2.")] = None,
    y0: Annotated[float | None, _option("Static axial factor Y0.")] = None,
    mass: Annotated[str | None, _option("Mass: '623 kg'.")] = None,
    bpfo: Annotated[
        float | None, _option("Overrolling frequency of the outer ring, per turn of the shaft.")
    ] = None,
    bpfi: Annotated[
        float | None, _option("Overrolling frequency of the inner ring, per turn of the shaft.")
    ] = None,
    rows: Annotated[
        int | None, typer.Option(min=1, max=2, help="Tapered: rows of the page's bearing, 1 or 2.")
    ] = None,
    arrangement: Annotated[str | None, _option("Tapered: O or X.")] = None,
    y: Annotated[
        float | None, _option("Tapered: axial factor Y of a single, Y1 of a double row.")
    ] = None,
    a: Annotated[
        str | None,
        _option(
            "Tapered: load centre from the back face of the inner ring; double row: distance of "
            "both load centres."
        ),
    ] = None,
    distance: Annotated[
        str | None, _option("Tapered: distance of two single rows' rollers on one shaft.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the random numbers.")] = 1,
    force: Force = False,
    as_json: AsJson = False,
) -> None:
    """Estimate the inside of a bearing from its maker's page, and write a bearing file.

    Dimensions that the page leaves open are sampled within usual proportions. The file holds the
    median of every inner dimension and the range in which four out of five samples lie. It is an
    estimate, not the maker's drawing.
    """
    from macroslip.input.units import FORCE, LENGTH, MASS

    check_new_file(output, force=force)
    _check_options(kind, context.params)
    page: dict[str, Any] = {
        "bore": si("--bore", bore, LENGTH),
        "outside": si("--outside", outside, LENGTH),
        "width": si("--width", width, LENGTH),
        "static_load_rating": si("--c0", c0, FORCE),
        "dynamic_load_rating": si("--c", c, FORCE),
        "fatigue_load_limit": si("--cu", cu, FORCE),
        "mass": si("--mass", mass, MASS),
        "axial_factor_e": e,
    }
    if kind is Kind.TAPERED:
        page |= {
            "rows": rows or (1 if distance else 2),
            "arrangement": arrangement or "O",
            "axial_factor_y": y,
            "load_centre": si("--a", a, LENGTH),
            "distance": si("--distance", distance, LENGTH),
        }
    else:
        page |= {
            "shoulder": si("--shoulder", shoulder, LENGTH),
            "groove": si("--groove", groove, LENGTH),
            "axial_factor_y1": y1,
            "axial_factor_y2": y2,
            "axial_factor_y0": y0,
            "bpfo": bpfo,
            "bpfi": bpfi,
        }
    estimated = _estimate(kind, page, output.stem, seed)
    _write(output, estimated.bearing, force)
    _tell_estimate(estimated, output, as_json)


def _check_options(kind: Kind, options: dict[str, Any]) -> None:
    """InputError for options that a kind of bearing needs or does not have."""
    missing = [name for name in _NEEDED[kind] if options[name[2:]] is None]
    if missing:
        raise InputError(
            f"{' and '.join(missing)} {'is' if len(missing) == 1 else 'are'} missing",
            allowed=f"with --kind {kind}: {', '.join(_NEEDED[kind])}",
            remedy="Take what is missing from the maker's page.",
        )
    foreign = [name for name in _OF_OTHERS[kind] if options[name[2:]] is not None]
    if foreign:
        raise InputError(
            f"{' and '.join(foreign)} {'does' if len(foreign) == 1 else 'do'} not count with --kind "
            f"{kind}",
            remedy="Remove what does not count, or choose the other --kind.",
        )


def _estimate(
    kind: Kind, page: dict[str, Any], name: str, seed: int
) -> EstimatedBearing | EstimatedTaperedBearing:
    """The estimate of a kind of bearing from the numbers of its page."""
    from macroslip.bearing.estimate import MakersPage, estimate_bearing
    from macroslip.bearing.tapered.estimate import TaperedPage, estimate_tapered_bearing

    given = (page["bore"], page["outside"], page["width"])
    sizes = [length for length in given if length is not None]
    size = ""
    if sizes:
        millimetres = [f"{1e3 * length:g}" for length in sizes]
        size = f", {' x '.join(millimetres)} mm"
    title = f"Estimated from its maker's page{size}"
    if kind is Kind.TAPERED:
        tapered_page = TaperedPage(**page)
        return estimate_tapered_bearing(tapered_page, name, title, seed=seed)
    makers_page = MakersPage(**page)
    return estimate_bearing(makers_page, name, title, seed=seed)


def _tell_estimate(
    estimate: EstimatedBearing | EstimatedTaperedBearing, output: Path, as_json: bool
) -> None:
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
    if estimate.bearing.kind == "tapered":
        typer.echo(
            "C is no check of a tapered bearing: makers publish up to 40 % more than ISO 281. Rib and "
            "preload are on no maker's page, and they decide friction and slip."
        )
    elif ratio is not None:
        typer.echo(
            f"C by ISO 281 from these dimensions is {ratio:.3f} of the published one; "
            "within one family of bearings that scatters by 1 to 2 %."
        )
    else:
        typer.echo(
            "C is that of these dimensions, and lives are 0.5 to 0.9 of those by a maker's; "
            "give it by --c."
        )
    for name in numbers["in the catalogue"]:
        typer.echo(f"The catalogue has a bearing of this size: bearing: {name}")
    typer.echo(f"An estimate from published values, not the maker's drawing.\nwritten: {output}")


def _numbers(estimate: EstimatedBearing | EstimatedTaperedBearing) -> dict[str, Any]:
    """Every estimated value with its range, and C by ISO 281 over the published one, if known."""
    from macroslip.bearing.load_ratings import dynamic_load_rating

    bearing = estimate.bearing
    ratio = None
    published = bearing.dynamic_load_rating
    if published is not None and bearing.provenance["dynamic_load_rating"].tag == "V":
        roller = (bearing.rollers_per_row, bearing.roller_diameter, bearing.roller_length)
        angle = bearing.outer_angle if bearing.kind == "tapered" else bearing.contact_angle
        pitch = 2 * bearing.pitch_radius
        by_iso = dynamic_load_rating(2, *roller, angle, pitch, kind=bearing.kind)
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
    from macroslip.report.tapered_drawing import draw_tapered_bearing

    bearing = read_bearing(name_or_file)
    draw = draw_tapered_bearing if bearing.kind == "tapered" else draw_bearing
    figure = draw(bearing)
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
