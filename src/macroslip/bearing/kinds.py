"""Bearings of every kind, from the catalogues or from files, whose key `kind` names the kind."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from macroslip.bearing.bearing import Bearing
from macroslip.bearing.tapered import TaperedBearing
from macroslip.input.files import Source, parse, read_text
from macroslip.input.messages import shown

#: A bearing of any kind.
AnyBearing = Bearing | TaperedBearing
#: Classes of bearings.
BEARING_KINDS = (Bearing, TaperedBearing)


def bearing_catalogue() -> list[str]:
    """Names of the shipped bearings of every kind.

    Examples
    --------
    >>> {"skf-240-600-bc", "tdo-main-bearing"} <= set(bearing_catalogue())
    True
    """
    return sorted(name for kind in BEARING_KINDS for name in kind.catalogue())


def bearing_from_dict(entries: Mapping[str, Any], source: Source | None = None) -> AnyBearing:
    """Build a bearing of the kind that the content of its file names.

    Parameters
    ----------
    entries : mapping
        As `Bearing.as_dict` or `TaperedBearing.as_dict` gives it.
    source : Source, optional
        Where it was written, for messages.

    Returns
    -------
    Bearing or TaperedBearing

    Raises
    ------
    InputError
        If a value is missing, unknown, out of its range or inconsistent with the others.
    """
    kind = TaperedBearing if entries.get("kind") == "tapered" else Bearing
    return kind.from_dict(entries, source)


def read_bearing(source: str | PathLike[str]) -> AnyBearing:
    """Read a shipped bearing or a bearing file, of any kind.

    Parameters
    ----------
    source : path
        A name of `bearing_catalogue`, or the path of a YAML file.

    Returns
    -------
    Bearing or TaperedBearing

    Raises
    ------
    InputError
        If there is no such file or name, or the content is wrong.

    Examples
    --------
    >>> read_bearing("tdo-main-bearing").kind, read_bearing("skf-240-600-bc").kind
    ('tapered', 'spherical')
    """
    name = fspath(source)
    for kind in BEARING_KINDS:
        if name in kind.catalogue():
            return kind.read(name)
    text = read_text(
        Path(name),
        f"no bearing can be read from {shown(name)}",
        allowed=f"the path of a YAML file, or a catalogue name: {', '.join(bearing_catalogue())}",
        remedy=f"Relative paths start at {Path.cwd()}.",
    )
    return bearing_from_dict(*parse(text, name))
