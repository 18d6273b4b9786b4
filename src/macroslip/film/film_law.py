"""Film laws: their interface to the kernels, and the list of those that exist.

A law is a `NamedTuple` of numbers prepared for one interface, together with compiled functions of it. Which functions
belong to a law follows from its type, when the kernel is compiled; so a law costs nothing at run time, and the kernel
need not know which laws exist.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from numba.extending import overload

from macroslip.compiled import depend_on
from macroslip.contact.interface import Interface
from macroslip.contact.law_registry import LawList
from macroslip.reference import taking

_laws = LawList("film")
names, reference, prepare, remove = _laws.names, _laws.reference, _laws.prepare, _laws.remove
_thickness: dict[type, Callable] = {}
_in_range: dict[type, Callable] = {}
_of_lanes: set[type] = set()
_range_notes: dict[str, Callable[[Interface], list[str]]] = {}


def register(
    name: str,
    law: type,
    *,
    reference: str,
    prepare: Callable,
    thickness: Callable,
    in_range: Callable,
    range_notes: Callable = lambda interface: [],
    lanes: bool = False,
) -> None:
    """Make a film law usable by name.

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
    thickness : callable
        Compiled `thickness(law, load [N], entrainment_speed [m/s]) -> (h [m], ∂h/∂u_e [s], ∂h/∂Q [m/N])`.
    in_range : callable
        Compiled `in_range(law, load, entrainment_speed) -> bool`.
    range_notes : callable
        `range_notes(interface) -> list of str`: what is outside the range whatever load and speed.
    lanes : bool
        Whether `thickness` takes numbers in lanes too.

    Raises
    ------
    InputError
        If the name is taken by a law of another module.
    """
    register_name(name, reference=reference, prepare=prepare, range_notes=range_notes)
    register_type(law, thickness=thickness, in_range=in_range)
    if lanes:
        _of_lanes.add(law)


def film_takes_lanes(law: type) -> bool:
    """Whether films under a law of this type can be had for several states at once, in `macroslip.contact.lanes`."""
    return law in _of_lanes


def register_name(
    name: str, *, reference: str, prepare: Callable, range_notes: Callable = lambda interface: []
) -> None:
    """Make a law usable by name whose type is registered already; parameters and errors are those of `register`."""
    _laws.add(name, prepare, reference)
    _range_notes[name] = range_notes


def register_type(law: type, *, thickness: Callable, in_range: Callable) -> None:
    """Register the compiled functions of a `NamedTuple` class that has no name of its own in case files.

    For classes that hold another law and change what it gives; parameters are those of `register`.
    """
    depend_on(thickness, in_range)
    _thickness[law] = thickness
    _in_range[law] = in_range


def film_range_notes(name: str, interfaces: Iterable[Interface]) -> list[str]:
    """What lies outside the range of the law called `name` at some interface, whatever load and speed."""
    return [f"{interface.name}: {note}" for interface in interfaces for note in _range_notes[name](interface)]


def film_thickness(law, load, entrainment_speed):
    """Film thickness h [m] and its derivatives by entrainment speed [s] and by load [m/N], by the law's own formula."""
    return _thickness[type(law)](law, load, entrainment_speed)


def film_in_range(law, load, entrainment_speed):
    """Whether the law's formula is inside the range it was fitted in."""
    return _in_range[type(law)](law, load, entrainment_speed)


@overload(film_thickness)
def _film_thickness(law, load, entrainment_speed):
    implementation = taking(law, _thickness[law.instance_class])
    return lambda law, load, entrainment_speed: implementation(law, load, entrainment_speed)


@overload(film_in_range)
def _film_in_range(law, load, entrainment_speed):
    implementation = taking(law, _in_range[law.instance_class])
    return lambda law, load, entrainment_speed: implementation(law, load, entrainment_speed)
