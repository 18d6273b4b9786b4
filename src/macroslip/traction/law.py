"""What a traction law is to the kernels, and the list of those that exist.

Built like `macroslip.film.law`: a `NamedTuple` of numbers for one interface, whose type chooses the compiled functions.
"""

from __future__ import annotations

from collections.abc import Callable

from numba.extending import overload

from macroslip.compiled import depend_on
from macroslip.contact.law_list import LawList

_laws = LawList("traction")
names, reference, prepare = _laws.names, _laws.reference, _laws.prepare
_traction: dict[type, Callable] = {}
_rising_slip: dict[type, Callable] = {}


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
    _laws.add(name, prepare, reference)
    _traction[law] = traction
    _rising_slip[law] = rising_slip


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
