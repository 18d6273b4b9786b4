"""What a worker does: one run, from its load file to a stored result. The same for threads, processes and clusters."""

from __future__ import annotations

import functools
import time
import traceback
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from macroslip.case.case import Case
from macroslip.errors import InputError, MacroslipError
from macroslip.files import is_special, write_durably
from macroslip.loads import BearingLoads, HubLoads, main_bearing_load
from macroslip.loads.source_file import without_folders
from macroslip.study.build import read_loads, template
from macroslip.study.key import case_key, program
from macroslip.study.outcome import Outcome
from macroslip.study.settings import RECORDS, Setting
from macroslip.study.store import case_path, checksum, layout, read_manifest, to_bytes
from macroslip.study.summary import case_values, kept, row_values


class StoreError(MacroslipError):
    """A result cannot be stored; no fault of the case, so the study stops."""


def work(task: dict[str, Any], progress: Callable[[int, int], None] | None = None) -> dict[str, Any]:
    """Do one run.

    Parameters
    ----------
    task : dict
        Plain data: `directory`, `setup` (checksum of its manifest), `session` (a name that no other has), `run` (name),
        `load`, `bearing`, `lubricant`, `settings` (list of key, value, unit), `threads`, and `again`: whether to
        compute even if a result is there.
    progress : callable, optional
        As for `macroslip.simulate`; what it raises ends the run.

    Returns
    -------
    dict
        The record for the journal: `run`, `key`, `outcome`, `reason`, `detail` (checksum of the result), `size`,
        `layout`, `values`; and `program`, by which the study verifies that a worker runs the same version. With `found`
        true nothing was computed: a result of that key is there, and the journal decides whether it is sound.

    Raises
    ------
    StoreError
        If the result cannot be stored: the disk is full, for example.
    """
    started = time.perf_counter()
    record: dict[str, Any] = {"run": task["run"], "program": program()}
    try:
        setup = _setup(task["directory"], task["setup"])
        case = _case(setup, task)
        options = {name: setup[name] for name in ("cycles", "keep")}
        record["key"] = case_key(case, options)
        path = case_path(Path(task["directory"]), record["key"])
        if not task["again"] and (stored := _stored(path)) is not None:
            return record | {"found": True, "detail": checksum(stored)}
        result, values = _computed(case, options, task["threads"], progress)
    except StoreError:
        raise
    except InputError as problem:
        reason = str(problem).replace(task["load"], without_folders(task["load"]))
        return record | {"outcome": Outcome.FAILED, "reason": reason}
    except MemoryError:
        reason = "not enough memory; use shorter loads, fewer rollers or no traces"
        return record | {"outcome": Outcome.FAILED, "reason": reason}
    except Exception as error:
        # A fault of the program in one case must not stop the others; the log has the traceback.
        reason = f"internal error, please report it: {type(error).__name__}: {error}"
        return record | {"outcome": Outcome.FAILED, "reason": reason, "traceback": traceback.format_exc()}
    content = to_bytes(result)
    try:
        write_durably(path, content)
    except OSError as error:
        raise StoreError(f"{path}: the result cannot be stored ({error.strerror or error})") from None
    values["other_seconds"] = time.perf_counter() - started - values["simulate_seconds"]
    failed = int(sum(values["failed_rollers"]))
    return record | {
        "outcome": Outcome.ROLLERS_FAILED if failed else Outcome.COMPLETED,
        "reason": _failed_rollers(result) if failed else "",
        "detail": checksum(content),
        "size": len(content),
        "layout": layout(result),
        "values": values,
    }


def work_several(
    tasks: list[dict[str, Any]], progress: Callable[[int, int], None] | None = None
) -> list[dict[str, Any]]:
    """Do several runs, one after the other; after one that cannot be stored, the others are not begun.

    Returns
    -------
    list of dict
        What `work` returns, or `stop` with the reason why the study has to stop.
    """
    found: list[dict[str, Any]] = []
    for task in tasks:
        try:
            found.append(work(task, progress))
        except StoreError as error:
            return [*found, {"run": task["run"], "stop": str(error)}]
    return found


@functools.lru_cache(maxsize=2)
def _setup(directory: str, expected: str) -> dict[str, Any]:
    """What all runs of a study share, from its manifest."""
    manifest, found = read_manifest(Path(directory))
    if found != expected:
        raise StoreError(f"{directory}: the manifest is not that of this study; another one was begun there.")
    setup = manifest["setup"]
    records = {
        noun: {name: kind.from_dict(entries) for name, entries in setup[f"{noun}s"].items()}
        for noun, kind in RECORDS.items()
    }
    return setup | {"records": records}


def _case(setup: dict[str, Any], task: dict[str, Any]) -> Case:
    settings = [Setting(*one) for one in task["settings"]]
    records = {noun: setup["records"][noun][task[noun]] for noun in RECORDS}
    case, cut = template(setup["case"], settings, records, keep=setup["keep"])
    loads = _loads(task["session"], setup["source"], task["load"], tuple(sorted(cut.items())))
    try:
        return replace(case, loads=loads)
    except InputError as problem:
        raise InputError(
            problem.what, where=f"{loads.source}, {problem.where}", allowed=problem.allowed, remedy=problem.remedy
        ) from None


@functools.lru_cache(maxsize=2)
def _loads(session: str, source: str, path: str, cut: tuple[tuple[str, float], ...]) -> HubLoads | BearingLoads:
    """Read a load history; runs with the same one follow each other. A session does not notice that a file changes."""
    return read_loads(source, path, dict(cut))


def _stored(path: Path) -> bytes | None:
    try:
        return None if is_special(path) else path.read_bytes()
    except OSError:
        return None


def _computed(
    case: Case, options: dict[str, Any], threads: int | None, progress: Callable[[int, int], None] | None
) -> tuple[Any, dict]:
    """What is stored of a case, and the numbers of its summary."""
    from macroslip.result.simulate import simulate

    started = time.perf_counter()
    result = simulate(case, threads=threads, progress=progress)
    seconds = time.perf_counter() - started
    values: dict[str, Any] = row_values(result) | case_values(result, case)
    values["simulate_seconds"] = seconds
    result = kept(result, options["keep"])
    if options["cycles"]:
        from macroslip.study.cycles import counted

        loads = case.loads
        on_bearing = loads if isinstance(loads, BearingLoads) else main_bearing_load(loads, case.drivetrain)
        result = result.merge(counted(on_bearing))
    return result, values


def _failed_rollers(result: Any) -> str:
    """Which rollers failed, and how the first of them."""
    from macroslip.imposed.status import Status

    failed = [one for one in result.status.stack(one=("row", "roller")) if one != Status.COMPLETED]
    first = failed[0]
    ended = float(result.end_time.sel(row=first.row, roller=first.roller))
    return (
        f"{len(failed)} of {result.status.size} rollers failed; "
        f"roller {int(first.roller)} of the {first.row.item()} row at t = {ended:.6g} s: {Status(int(first)).sentence}"
    )
