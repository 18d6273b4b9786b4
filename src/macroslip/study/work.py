"""Computation of one run of a study: load file, result, storage.

It is the same in threads, processes and clusters.
"""

from __future__ import annotations

import functools
import hashlib
import json
import time
import traceback
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import xarray as xr

from macroslip.case.case import Case
from macroslip.contact.registry import own_laws
from macroslip.errors import InputError, MacroslipError
from macroslip.imposed.status import Status
from macroslip.loads import BearingLoads, HubLoads
from macroslip.loads.source_file import without_folders
from macroslip.storage.files import make_folder, write_durably
from macroslip.storage.fingerprint import fingerprint
from macroslip.study.database import Outcome
from macroslip.study.result_files import case_path, checksum, claim_path, layout, to_bytes
from macroslip.study.settings import RECORDS, Setting, read_loads, template
from macroslip.study.store import read_manifest
from macroslip.study.summary import load_cycles, summary_values

#: Variables that are stored whatever is to be kept: which rollers failed, and how.
ALWAYS_KEPT = ("status", "end_time", "end_slip")


class StoreError(MacroslipError):
    """A result cannot be stored; no fault of the case, so the study stops."""


def program() -> str:
    """Hash of the program's sources and of registered laws of the user's own."""
    sources = [fingerprint(), *own_laws()]
    return hashlib.sha256("\0".join(sources).encode()).hexdigest()


def case_key(case: Case, options: Mapping[str, Any]) -> str:
    """Hash of a case's full input, of the program and of the options of storage.

    The options are all that is stored beyond the result of `simulate`.

    Only the numbers of the loads enter, not their source: a file may be moved, renamed or
    converted.

    Examples
    --------
    >>> loads = BearingLoads.constant([0.0, -300e3, 0.0], 2.0, 10.0)
    >>> key = case_key(Case(loads=loads), {})
    >>> len(key), key == case_key(Case(loads=loads, drag=False), {})
    (64, False)
    """
    inputs = case.as_dict()
    loads = dict(inputs["loads"])
    loads.pop("source", None)
    content = {"case": inputs | {"loads": loads}, "program": program(), "options": options}
    text = json.dumps(content, sort_keys=True, ensure_ascii=False)
    return hashlib.sha256(text.encode()).hexdigest()


def work(
    task: dict[str, Any], progress: Callable[[int, int], None] | None = None
) -> dict[str, Any]:
    """Do one run.

    Raises StoreError if the result cannot be stored: the disk is full, for example.

    The record is for the database: `run`, `key`, `outcome`, `reason`, `detail` (checksum of the
    result), `layout`, `values`; and `program`, by which the study verifies that a worker runs the
    same version. With `found` true nothing was computed: a result of that key is there, and the
    database decides whether it is sound. With `waits` true nothing was done: another run of this
    session has the same key and is under way.

    A task is plain data: `directory`, `setup` (checksum of its manifest), `session` (a name that no
    other has), `run` (name), `load`, `bearing`, `lubricant`, `settings` (list of key, value, unit),
    `threads`, and `again`: whether to compute even if a result is there. `progress` is as for
    `macroslip.simulate`; an exception in it ends the run.
    """
    started = time.perf_counter()
    record: dict[str, Any] = {"run": task["run"], "program": program()}
    try:
        setup = _setup(task["directory"], task["setup"])
        case = _case(setup, task)
        options = {name: setup[name] for name in ("cycles", "keep")}
        record["key"] = case_key(case, options)
        path = case_path(Path(task["directory"]), record["key"])
        claim = claim_path(path, task["session"])
        if not _claimed(claim, task["run"]):
            return record | {"waits": True}
        with suppress(OSError):  # what cannot be read is computed again
            if not task["again"] and path.is_file():
                return record | {"found": True, "detail": checksum(path.read_bytes())}
        result, values = _computed(case, options, task["threads"], progress)
    except StoreError:
        raise
    except InputError as problem:
        load = task["load"]
        reason = str(problem).replace(load, without_folders(load))
        return record | {"outcome": Outcome.FAILED, "reason": reason}
    except MemoryError:
        reason = "not enough memory; use shorter loads, fewer rollers or no traces"
        return record | {"outcome": Outcome.FAILED, "reason": reason}
    except Exception as error:
        # A fault of the program in one case must not stop the others; the log has the traceback.
        reason = f"internal error, please report it: {type(error).__name__}: {error}"
        return record | {
            "outcome": Outcome.FAILED,
            "reason": reason,
            "traceback": traceback.format_exc(),
        }
    content = to_bytes(result)
    try:
        write_durably(path, content)
    except OSError as error:
        raise StoreError(
            f"{path}: the result cannot be stored ({error.strerror or error})"
        ) from None
    seconds = time.perf_counter() - started
    values["other_seconds"] = seconds - values["simulate_seconds"]
    reason = _failed_rollers(result)
    return record | {
        "outcome": Outcome.ROLLERS_FAILED if reason else Outcome.COMPLETED, "reason": reason,
        "detail": checksum(content), "layout": layout(result), "values": values,
    }  # fmt: skip


def _claimed(claim: Path, run: str) -> bool:
    """Claim a key for a run, so that no other run of this session computes it too.

    A run whose worker has died finds its own claim and goes on. Raises StoreError if nothing can be
    written.
    """
    try:
        make_folder(claim.parent)
        with claim.open("x", encoding="utf-8") as file:
            file.write(run)
    except FileExistsError:
        with suppress(FileNotFoundError):  # the other run has ended meanwhile
            return claim.read_text(encoding="utf-8") == run
        return False
    except OSError as error:
        fault = f"{claim}: nothing can be stored ({error.strerror or error})"
        raise StoreError(fault) from None
    return True


def work_several(
    tasks: list[dict[str, Any]], progress: Callable[[int, int], None] | None = None
) -> list[dict[str, Any]]:
    """Do runs one after the other.

    After one that cannot be stored, whose `stop` has the reason, no other is begun.
    """
    results: list[dict[str, Any]] = []
    for task in tasks:
        try:
            results.append(work(task, progress))
        except StoreError as error:
            return [*results, {"run": task["run"], "stop": str(error)}]
    return results


@functools.lru_cache(maxsize=2)
def _setup(directory: str, expected: str) -> dict[str, Any]:
    try:
        manifest, actual = read_manifest(Path(directory))
    except InputError as error:
        raise StoreError(f"a worker does not find the study: {error}") from None
    if actual != expected:
        raise StoreError(
            f"{directory}: the manifest is not that of this study; another one was begun there."
        )
    setup = manifest["setup"]
    records = {
        noun: {name: kind.from_dict(entries) for name, entries in setup[f"{noun}s"].items()}
        for noun, kind in RECORDS.items()
    }
    return setup | {"records": records}


def _case(setup: dict[str, Any], task: dict[str, Any]) -> Case:
    settings = [Setting(*entry) for entry in task["settings"]]
    records = {noun: setup["records"][noun][task[noun]] for noun in RECORDS}
    case, cut = template(setup["case"], settings, records, keep=setup["keep"])
    loads = _loads(task["session"], setup["source"], task["load"], tuple(sorted(cut.items())))
    if task["all_rollers"]:
        case = replace(case, rollers="all")
    try:
        return replace(case, loads=loads)
    except InputError as problem:
        raise problem.but(where=f"{loads.source}, {problem.where}") from None


@functools.lru_cache(maxsize=2)
def _loads(
    session: str, source: str, path: str, cut: tuple[tuple[str, float], ...]
) -> HubLoads | BearingLoads:
    """Read a load history; runs with the same one follow each other.

    A session does not notice that a file changes.
    """
    return read_loads(source, path, dict(cut))


def _computed(
    case: Case,
    options: Mapping[str, Any],
    threads: int | None,
    progress: Callable[[int, int], None] | None,
) -> tuple[xr.Dataset, dict[str, float]]:
    from macroslip.result.simulate import simulate

    started = time.perf_counter()
    result = simulate(case, threads=threads, progress=progress)
    seconds = time.perf_counter() - started
    values = summary_values(result, case) | {"simulate_seconds": seconds}
    if options["keep"] is not None:
        kept = (*options["keep"], *ALWAYS_KEPT)
        others = [name for name in result.data_vars if name not in kept]
        result = result.drop_vars(others)
    if options["cycles"]:
        result = result.merge(load_cycles(case.bearing_loads))
    return result, values


def _failed_rollers(result: xr.Dataset) -> str:
    if (result.status.values == Status.COMPLETED).all():
        return ""
    failed = [
        status
        for status in result.status.stack(roller_of_row=("row", "roller"))
        if status != Status.COMPLETED
    ]
    first = failed[0]
    ended = float(result.end_time.sel(row=first.row, roller=first.roller))
    return (
        f"{len(failed)} of {result.status.size} rollers failed; "
        f"roller {int(first.roller)} of the {first.row.item()} row at t = {ended:.6g} s: "
        f"{Status(int(first)).sentence}"
    )
