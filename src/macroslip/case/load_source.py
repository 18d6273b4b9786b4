"""The section `loads` of a case file: source of the loads, and the part of it to read."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

from macroslip.errors import InputError
from macroslip.input.fields import Choice, Quantity, Text, Vector
from macroslip.input.section import input_section
from macroslip.input.units import FORCE, LENGTH, MOMENT, SPEED, TIME
from macroslip.loads import BearingLoads, HubLoads, RollerLoads
from macroslip.loads.bundled import bundled_names
from macroslip.loads.csv_text import DECIMAL_MARKS, THOUSANDS_MARKS

#: Keys of values that files with hub loads may lack: speed [rad/s] and point of output [m].
FOR_HUB_FILES = ("shaft_speed", "hub_to_output")
LOAD_SOURCES = ("bundled", "file", "bearing_file", "roller_loads", "hub", "main_bearing")
#: Keys that say how loads are read from a file.
CUT_KEYS = ("start", "end", *FOR_HUB_FILES, "decimal", "thousands", "sheet")

# Advice for programs, in the words of a case file.
_ADVICE = {
    "read it with BearingLoads.read": "name it under bearing_file",
    "read it with HubLoads.read, then main_bearing_load": "name it under file",
    "become bearing loads by main_bearing_load(HubLoads.read(path), "
    "Drivetrain())": "belong under file",
    "(start=, end=)": "(loads.start, loads.end)",
}
_Force = Annotated[list[float], Vector("three components of the force", FORCE)]
_Moment = Annotated[list[float], Vector("three components of the moment", MOMENT)]
_Speed = Annotated[float, Quantity("shaft speed", SPEED)]
_Duration = Annotated[float, Quantity("time for which the loads act", TIME)]


@input_section("loads.hub", "constant hub loads")
class ConstantHubLoads:
    """Arguments of `HubLoads.constant`."""

    force: _Force
    shaft_speed: _Speed
    duration: _Duration
    moment: _Moment


@input_section("loads.main_bearing", "constant main-bearing load")
class ConstantBearingLoads:
    """Arguments of `BearingLoads.constant`."""

    force: _Force
    shaft_speed: _Speed
    duration: _Duration


@input_section("loads", "loads, from exactly one source", one_of=LOAD_SOURCES)
class LoadSource:
    """Source of the loads, and the part to read of it."""

    bundled: Annotated[
        str | None, Choice("load case that comes with the package", bundled_names)
    ] = None
    file: Annotated[
        str | None, Text("hub loads: output of OpenFAST, Bladed or HAWC2, or a table")
    ] = None
    bearing_file: Annotated[
        str | None, Text("main-bearing loads: a table (.parquet, .csv, .xlsx)")
    ] = None
    roller_loads: Annotated[
        str | None,
        Text(
            "loads of the rollers: a table of time_s, shaft_speed_rpm, row, angle_deg, load_N "
            "(.parquet, .csv, .xlsx)"
        ),
    ] = None
    hub: ConstantHubLoads | None = None
    main_bearing: ConstantBearingLoads | None = None
    start: Annotated[float | None, Quantity("first time to read", TIME)] = None
    end: Annotated[float | None, Quantity("last time to read", TIME)] = None
    shaft_speed: Annotated[
        float | None,
        Quantity("constant shaft speed in place of the one in the file", SPEED, -100.0, 100.0),
    ] = None
    decimal: Annotated[
        str | None, Choice("mark before the decimals of a CSV table", lambda: DECIMAL_MARKS)
    ] = None
    thousands: Annotated[
        str | None,
        Choice("mark between groups of three digits in a CSV table", lambda: THOUSANDS_MARKS),
    ] = None
    hub_to_output: Annotated[
        float | None,
        Quantity("distance behind the hub at which the file has its loads", LENGTH, 0.0, 20.0),
    ] = None
    sheet: Annotated[str | None, Text("sheet of a workbook of Excel; without it the first one")] = (
        None
    )

    @property
    def key(self) -> str:
        """The key of the source."""
        return next(key for key in LOAD_SOURCES if getattr(self, key) is not None)

    @property
    def cut(self) -> dict[str, Any]:
        """Keys that say how a file is read, as far as they are given [s], [rad/s], [m]."""
        options = {}
        for key in CUT_KEYS:
            value = getattr(self, key)
            if value is not None:
                options[key] = value
        return options

    def series(self, folder: Path) -> HubLoads | BearingLoads | RollerLoads:
        """Read or make the loads; relative paths start at `folder`."""
        try:
            return self._series(folder)
        except InputError as problem:
            remedy = problem.remedy
            for programs_words, words in _ADVICE.items():
                remedy = remedy.replace(programs_words, words)
            raise problem.but(remedy=remedy) from None

    def _series(self, folder: Path) -> HubLoads | BearingLoads | RollerLoads:
        key = self.key
        cut = self.cut
        value: Any = getattr(self, key)
        for name in FOR_HUB_FILES:
            if name in cut and key != "file":
                raise InputError(
                    f"{name} is given, but {key} has its own",
                    remedy=f"Remove loads.{name}; it serves hub loads from a file only.",
                )
        if key in ("hub", "main_bearing"):
            if cut:
                raise InputError(
                    f"{' and '.join(cut)} would cut a series, but these loads are constant",
                    remedy=f"Remove them; loads.{key}.duration says how long.",
                )
            kind = HubLoads if key == "hub" else BearingLoads
            return kind.constant(**asdict(value))
        if key == "bundled":
            if marks := cut.keys() & {"decimal", "thousands", "sheet"}:
                raise InputError(
                    f"{' and '.join(sorted(marks))} would say how a table is read",
                    remedy="Remove them; a bundled case needs nothing of the kind.",
                )
            start = cut.get("start")
            return HubLoads.bundled(value).window(start, cut.get("end"))
        if not (folder / value).exists():
            remedy = f"Relative paths start at {folder.resolve()}."
            raise InputError(f"there is no file '{value}'", remedy=remedy)
        kinds = {"file": HubLoads, "bearing_file": BearingLoads, "roller_loads": RollerLoads}
        return kinds[key].read(folder / value, **cut)
