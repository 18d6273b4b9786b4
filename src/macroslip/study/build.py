"""From the settings of a run to its case, by the reader of case files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from macroslip.case.case import Case
from macroslip.case.case_file import build_case
from macroslip.case.load_source import LoadSource
from macroslip.errors import InputError
from macroslip.input.files import Source
from macroslip.input.record import Record
from macroslip.loads import BearingLoads, HubLoads
from macroslip.result.variables import CONTACT_DETAILS
from macroslip.study.settings import Setting, replaced, with_settings

#: Used in place of the loads until they are read: so long that any window lies within it.
_ANY_LOADS = BearingLoads(np.array([-1e10, 1e10]), np.zeros(2), np.zeros((2, 3)), "no loads yet")


def template(
    mapping: Mapping[str, Any],
    settings: list[Setting],
    records: Mapping[str, Record],
    *,
    keep: Sequence[str] | None = None,
    source: Source | None = None,
    folder: Path | None = None,
) -> tuple[Case, dict[str, float]]:
    """A case with everything but its loads, and how to read them.

    Parameters
    ----------
    mapping : mapping
        Base case: keys of a case file, of `loads` only start, end and shaft_speed.
    settings : list of Setting
        Values in place of the base case's.
    records : mapping of str to Record
        `bearing` and `lubricant` in place of the base case's, if there.
    keep : sequence of str, optional
        Variables of a result that are stored, None: all. Details of contacts are recorded only where some are.
    source, folder : Source, Path, optional
        Where the mapping was written, for messages, and where relative paths start.

    Raises
    ------
    InputError
        If anything but the loads is wrong.
    """
    cut: dict[str, float] = {}

    def unread(given: LoadSource) -> BearingLoads:
        cut.update(given.cut)
        return _ANY_LOADS

    names = {noun: record.name for noun, record in records.items()}
    # The source is named only because a case has to have one; it is not read.
    content = {**with_settings(mapping, settings), **names}
    content["loads"] = (content.get("loads") or {}) | {"file": "-"}
    case = build_case(content, source or Source(), folder or Path(), records=records, series=unread)
    changed = {noun: replaced(getattr(case, noun), settings) for noun in ("bearing", "lubricant")}
    details = case.contact_details and (keep is None or not set(CONTACT_DETAILS).isdisjoint(keep))
    return replace(case, **changed, contact_details=details), cut


def read_loads(source: str, path: str, cut: Mapping[str, float]) -> HubLoads | BearingLoads:
    """Read the loads of a run.

    Parameters
    ----------
    source : str
        `file`, `bearing_file` or `bundled`.
    path : str
        Path of the file, or name of a bundled case.
    cut : mapping
        `start` and `end` [s], if the loads are to be cut, and `shaft_speed` [rad/s] of files without one.

    Raises
    ------
    InputError
        If they cannot be used, or a file cannot be read.
    """
    try:
        if "shaft_speed" in cut and source != "file":
            raise InputError(
                "shaft_speed is given in the base case, but these loads have a speed",
                where=path,
                remedy="Remove loads.shaft_speed; it serves hub loads from files only.",
            )
        if source == "bundled":
            return HubLoads.bundled(path).window(cut.get("start"), cut.get("end"))
        return (HubLoads if source == "file" else BearingLoads).read(path, **cut)
    except OSError as error:
        raise InputError(f"the file cannot be read ({error.strerror or error})", where=path) from None
