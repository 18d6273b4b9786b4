"""A turbine, or one of its main-bearing seats: parts by name, mount as quantities with provenance."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from typing import Annotated, Any, ClassVar

from macroslip.errors import InputError
from macroslip.input.fields import Choice, Positive, Quantity, Text
from macroslip.input.files import Source
from macroslip.input.record import TAGS, Record, quantities
from macroslip.input.units import ANGLE, LENGTH, MASS, NUMBER, SPEED
from macroslip.loads import Drivetrain
from macroslip.loads.bundled import SETS, bundled_names

_Optional = float | None
#: Words of a drivetrain, and the fields that hold them.
_WORDS = {"mount": "mount", "front": "front", "locating": "locating", "bearing": "simulated"}
#: Quantities of a drivetrain in the order of a case file.
_LENGTHS = (
    "hub_to_bearing", "bearing_to_gearbox", "front_to_rear", "front_moment_share", "tilt", "shaft_mass",
    "shaft_mass_station",
)  # fmt: skip
_CASE = """\
# {title}.
#
#     macroslip run case.yaml -o case.nc
#
# Every quantity carries its unit; behind its meaning stands where the value comes from. An engineering estimate is an
# assumption: replace it where you know better. Keys that are not here have their defaults; `macroslip init` without
# --turbine writes them all. What is not known: {not_known}

# Bearing. {bearing_choice}
bearing: {bearing}

# Lubricant. {lubricant_choice}
lubricant: {lubricant}

loads:
  # A load case of this turbine. In a study  bundled: [{load_set}]  is all of them.
  bundled: {loads}
  # Part of it. Leave both out for all of it.
  start: 0 s
  end: 60 s

# Supports and mass of the shaft.
drivetrain:
"""
#: Fields that stand in the text.
_TEXTS = (
    "title", "bearing", "bearing_choice", "lubricant", "lubricant_choice", "loads", "load_set", "not_known",
)  # fmt: skip
_WIDTH = 118


def _sets() -> tuple[str, ...]:
    """Names of the sets of bundled load cases."""
    return SETS


class Turbine(Record):
    """A turbine or a main-bearing seat of it: bearing, mount, loads and oil that belong together.

    Attributes are in SI units (m, rad, rad/s, kg); `provenance` gives the source of each quantity,
    and the texts `bearing_choice`, `lubricant_choice` and `not_known` say what is assumed. Raises
    InputError if a value is missing or out of range, or if the mount is none.

    Examples
    --------
    >>> turbine = Turbine.read("nrel5")
    >>> turbine.bearing, turbine.loads, turbine.drivetrain.hub_to_bearing
    ('skf-240-950-bc', 'nrel5-12B', 1.912)
    """

    noun: ClassVar[str] = "turbine"

    name: Annotated[str, Text("short name of the turbine or seat", line=True)]
    title: Annotated[str, Text("one line that describes it", may_be_empty=True, line=True)] = ""
    bearing: Annotated[str, Text("main bearing: a name of the catalogue, or a file", line=True)]
    bearing_choice: Annotated[str, Text("why this bearing, in sentences", line=True)]
    lubricant: Annotated[str, Text("lubricant: a name of the catalogue, or a file", line=True)]
    lubricant_choice: Annotated[str, Text("why this lubricant, in sentences", line=True)]
    loads: Annotated[str, Choice("bundled load case to begin with", bundled_names)]
    load_set: Annotated[str, Choice("set of bundled load cases", _sets)]
    not_known: Annotated[str, Text("what is not known of it, in sentences", line=True)]
    mount: Annotated[str, Text("mount of the shaft: three-point or four-point", line=True)]
    front: Annotated[
        str, Text("four-point mount: kind of front main bearing", may_be_empty=True, line=True)
    ] = ""
    locating: Annotated[
        str, Text("four-point mount: bearing that carries thrust", may_be_empty=True, line=True)
    ] = ""
    simulated: Annotated[
        str, Text("four-point mount: bearing that is simulated", may_be_empty=True, line=True)
    ] = ""

    rotor_diameter: Annotated[float, Positive("diameter of the rotor", LENGTH, 500)]
    rated_speed: Annotated[float, Positive("rated speed of the rotor", SPEED, 100)]
    hub_to_bearing: Annotated[
        float, Quantity("hub centre to main bearing, the front one of two", LENGTH, 0, 20)
    ]
    bearing_to_gearbox: Annotated[
        _Optional, Positive("main bearing to gearbox support", LENGTH, 20)
    ] = None
    front_to_rear: Annotated[_Optional, Positive("front to rear main bearing", LENGTH, 20)] = None
    front_moment_share: Annotated[
        _Optional,
        Quantity(
            "share of the moment that a moment-carrying front takes", NUMBER, 0, 1, below=True
        ),
    ] = None
    tilt: Annotated[float, Quantity("shaft tilt, positive with the hub end up", ANGLE, -0.3, 0.3)]
    shaft_mass: Annotated[float, Quantity("mass of the shaft without the rotor", MASS, 0, 1e6)]
    shaft_mass_station: Annotated[
        float, Quantity("distance of that mass behind the hub centre", LENGTH, 0, 50)
    ]

    @property
    def drivetrain(self) -> Drivetrain:
        """Supports and weight of the shaft."""
        words: dict[str, Any] = {key: getattr(self, field) for key, field in _WORDS.items()}
        lengths = {key: getattr(self, key) for key in _LENGTHS}
        known_lengths = {key: value for key, value in lengths.items() if value is not None}
        return Drivetrain(**{key: word for key, word in words.items() if word}, **known_lengths)

    def _inconsistencies(self, source: Source) -> Iterator[InputError]:
        try:
            _ = self.drivetrain
        except InputError as problem:
            yield problem

    def case_text(self) -> str:
        """Text of a case file of this turbine, with the origin of every value above it."""
        texts = {key: getattr(self, key) for key in _TEXTS}
        lines = [part for line in _CASE.format(**texts).splitlines() for part in _wrapped(line)]
        for key, field in _WORDS.items():
            if word := getattr(self, field):
                lines.append(f"  {key}: {word}")
        for key in _LENGTHS:
            if getattr(self, key) is None:
                continue
            origin = self.provenance[key]
            about = quantities(type(self))[key].about
            head = f"{about[0].upper()}{about[1:]}"
            meaning = f"{head}: {TAGS[origin.tag]}; {origin.note}"
            lines += [*_wrapped(f"  # {meaning}."), f"  {key}: {origin.written}"]
        return "\n".join(lines) + "\n"


def _wrapped(line: str) -> list[str]:
    """A line, a comment longer than a line as several."""
    start = line[: len(line) - len(line.lstrip(" #"))]
    if len(line) <= _WIDTH or "#" not in start:
        return [line]
    return textwrap.wrap(line, _WIDTH, subsequent_indent=start)
