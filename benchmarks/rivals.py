"""Who takes part in the comparison, with which settings, and how far the production integrator should be ahead."""

from __future__ import annotations

import functools
import importlib
import itertools
import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

from benchmarks.outcome import Setting, Solution

INSTALL = "pip install 'macroslip[bench,lsoda]'"


OWN, EULER, CVODE, CVODE_COMPILED = "own", "backward_euler", "cvode", "cvode_compiled"
OWN_TITLE = "macroslip"
#: Where backward Euler's iteration may stop, as a relative change of spin.
EULER_TOLERANCES = (1e-9, 1e-11, 1e-13)


class Rival(NamedTuple):
    """One method.

    Attributes
    ----------
    key : str
        Name in `bench.json`.
    title : str
        Name for a reader.
    target : float
        Ratio of CPU times that the production integrator should reach; NaN if none is set.
    load : callable
        Returns `solve(history, reference, **setting)`, or None if the rival is not installed.
    settings : callable
        `settings(has_edges, quick)` gives the settings to try, in that order.
    patience : float
        Budget of the search, CPU time [s] per second of history; see `benchmarks.scan.scan`.
    prune : bool
        See `benchmarks.scan.scan`.
    """

    key: str
    title: str
    target: float
    load: Callable[[], Callable[..., Solution] | None]
    settings: Callable[[bool, bool], Iterator[Setting]]
    patience: float
    prune: bool = False


def _room(name: str) -> Callable[..., Solution] | None:
    try:
        return importlib.import_module(f"benchmarks.{name}").solve
    except ImportError:
        return None


def _cvode_compiled() -> Callable[..., Solution] | None:
    from benchmarks import cvode_compiled

    return cvode_compiled.solve if cvode_compiled.available() else None


def scipy_solver(method: str) -> Callable[..., Solution]:
    """`solve` of SciPy's method of that name, "Radau" or "BDF"."""
    return functools.partial(_room("scipy_solvers"), method=method)


def _grid(rtol: list[float], atol: list[float], **others: list) -> Iterator[Setting]:
    """All combinations, the loosest tolerances first."""
    pairs = sorted(itertools.product(rtol, atol), key=lambda pair: -pair[0] * pair[1])
    for loose, absolute in pairs:
        for values in itertools.product(*others.values()):
            yield {"rtol": loose, "atol": absolute, **dict(zip(others, values, strict=True))}


def _decades(first: int, last: int, per_decade: int = 1) -> list[float]:
    return [10.0 ** (-k / per_decade) for k in range(first * per_decade, last * per_decade + 1)]


def _scipy_settings(edges: bool, quick: bool) -> Iterator[Setting]:
    # A restart where load begins or ends is never worse; the longest step is the loads' sample interval. From the
    # middle of the range outward: there the settings lie that suit most histories.
    steps = [0.05] if quick else [0.05, float("inf")]
    settings = _grid(_decades(4, 8), _decades(6, 10), stops=[True], longest_step=steps)
    return iter(
        sorted(
            settings,
            key=lambda setting: (
                abs(math.log10(setting["rtol"]) + 5.5) + abs(math.log10(setting["atol"]) + 7.5)
            ),
        )
    )


def _cvode_settings(edges: bool, quick: bool) -> Iterator[Setting]:
    steps = [0.0] if quick else [0.0, 0.05, 0.02]
    stops = ["stop", "restart"] if edges else ["none"]
    atol = [1e-4, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12]
    return _grid(_decades(4, 8, 1 if quick else 2), atol, stops=stops, longest_step=steps)


def _cvode_python_settings(edges: bool, quick: bool) -> Iterator[Setting]:
    stops = ["stop", "restart"] if edges else ["none"]
    return _grid(_decades(5, 8), [1e-6, 1e-8, 1e-10, 1e-12], stops=stops, longest_step=[0.0, 0.02])


def _lsoda_settings(edges: bool, quick: bool) -> Iterator[Setting]:
    stops = [False, True] if edges else [False]
    return _grid(_decades(4, 10, 1 if quick else 2), _decades(4, 12, 1), stops=stops)


def _euler_settings(edges: bool, quick: bool) -> Iterator[Setting]:
    steps = (
        [1e-2, 3e-3, 1e-3, 3e-4]
        if quick
        else [2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5]
    )
    for step in steps:
        for tolerance in EULER_TOLERANCES:
            yield {"step": step, "tolerance": tolerance}


def own_settings() -> Iterator[Setting]:
    """Tolerances of the production integrator, loose ones first."""
    tolerances = (5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5, 1e-6, 1e-7)
    return ({"tolerance": tolerance} for tolerance in tolerances)


RIVALS = (
    Rival(
        "scipy_radau",
        "SciPy solve_ivp, Radau",
        200.0,
        lambda: scipy_solver("Radau"),
        _scipy_settings,
        0.3,
        True,
    ),
    Rival(
        "scipy_bdf",
        "SciPy solve_ivp, BDF",
        200.0,
        lambda: scipy_solver("BDF"),
        _scipy_settings,
        0.3,
        True,
    ),
    Rival(
        CVODE_COMPILED,
        "SUNDIALS CVODE, compiled callbacks",
        14.0,
        _cvode_compiled,
        _cvode_settings,
        1.0,
    ),
    Rival(
        CVODE,
        "SUNDIALS CVODE, through scikit-sundae",
        14.0,
        lambda: _room("cvode"),
        _cvode_python_settings,
        0.15,
    ),
    Rival("lsoda", "LSODA (numbalsoda)", 10.0, lambda: _room("lsoda"), _lsoda_settings, 1.0),
    Rival(
        EULER,
        "the paper's backward Euler, fixed step",
        20.0,
        lambda: _room("euler"),
        _euler_settings,
        0.3,
    ),
)
