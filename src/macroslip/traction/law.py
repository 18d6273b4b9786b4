"""What a traction law is to the kernels, and the list of those that exist.

Built like `macroslip.film.law`: a `NamedTuple` of numbers for one interface, whose type chooses the compiled functions.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba.extending import overload

from macroslip.compiled import depend_on
from macroslip.contact.interface import Interface
from macroslip.errors import InputError

_traction: dict[type, Callable] = {}
_rising_slip: dict[type, Callable] = {}
_prepare: dict[str, Callable[[Interface], Any]] = {}
_references: dict[str, str] = {}


def register(
    name: str, law: type, *, reference: str, prepare: Callable, traction: Callable, rising_slip: Callable
) -> None:
    """Make a traction law usable by name.

    Parameters
    ----------
    name : str
        Name in case files.
    law : type
        `NamedTuple` class holding the law's numbers for one interface.
    reference : str
        What to cite where the law was used.
    prepare : callable
        `prepare(interface) -> law`.
    traction : callable
        Compiled `traction(law, load [N], film_thickness [m], slip [m/s]) -> (F [N], ∂F/∂Δu [N s/m], ∂F/∂h [N/m],
        ∂F/∂Q [-])`; F has the sign of the slip and vanishes with it.
    rising_slip : callable
        Compiled `rising_slip(law, load) -> |Δu|` [m/s] up to which traction surely rises with slip. The integrator
        needs it to know where an implicit step can have more than one root.
    """
    depend_on(traction, rising_slip)
    _prepare[name] = prepare
    _references[name] = reference
    _traction[law] = traction
    _rising_slip[law] = rising_slip


def reference(name: str) -> str:
    """What to cite where the law called `name` was used."""
    return _references[name]


def names() -> list[str]:
    """Names of the registered traction laws."""
    return sorted(_prepare)


def prepare(name: str, interface: Interface) -> Any:
    """The law called `name`, prepared for an interface.

    Raises
    ------
    InputError
        If there is no such law; the message lists those that exist.
    """
    if name not in _prepare:
        raise InputError(
            f"there is no traction law '{name}'",
            where="laws.traction",
            allowed=", ".join(names()),
            remedy="Choose one of these",
        )
    return _prepare[name](interface)


def patch_traction(law, load, film_thickness, slip):
    """Traction force [N] of the whole contact patch and its derivatives by slip, film thickness and load."""
    return _traction[type(law)](law, load, film_thickness, slip)


def rising_slip(law, load):
    """Slip [m/s] up to which traction surely rises with slip at this load [N]."""
    return _rising_slip[type(law)](law, load)


@overload(patch_traction)
def _patch_traction(law, load, film_thickness, slip):
    implementation = _traction[law.instance_class]
    return lambda law, load, film_thickness, slip: implementation(law, load, film_thickness, slip)


@overload(rising_slip)
def _rising_slip_of(law, load):
    implementation = _rising_slip[law.instance_class]
    return lambda law, load: implementation(law, load)
