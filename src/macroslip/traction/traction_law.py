"""Traction laws: their interface to the kernels, and the list of those that exist.

Built like `macroslip.film.film_law`: a `NamedTuple` of numbers for one interface, whose type chooses the compiled functions.
"""

from __future__ import annotations

from collections.abc import Callable

from numba.extending import overload

from macroslip.compiled import depend_on
from macroslip.constants import MECHANISMS
from macroslip.contact.law_registry import LawList
from macroslip.reference import taking
from macroslip.traction.patch import Patch

_laws = LawList("traction", reserved=(MECHANISMS,))
names, reference, prepare, remove = _laws.names, _laws.reference, _laws.prepare, _laws.remove
_traction: dict[type, Callable] = {}
_rising_slip: dict[type, Callable] = {}
_microslip: dict[type, Callable] = {}
_chord: dict[type, Callable] = {}
_of_lanes: set[type] = set()


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
        Compiled `rising_slip(law, load, film_thickness) -> |Δu|` [m/s] up to which traction is sure to rise with slip. The
        integrator needs it to know where an implicit step can have more than one root.

    Raises
    ------
    InputError
        If the name is taken by a law of another module.
    """
    register_name(name, reference=reference, prepare=prepare)
    register_type(law, traction=traction, rising_slip=rising_slip)


def register_name(name: str, *, reference: str, prepare: Callable) -> None:
    """Make a law usable by name whose type is registered already; parameters and errors are those of `register`."""
    _laws.add(name, prepare, reference)


def register_type(
    law: type,
    *,
    traction: Callable,
    rising_slip: Callable,
    microslip: Callable | None = None,
    chord: Callable | None = None,
    lanes: bool = False,
) -> None:
    """Register the compiled functions of a law's type, without a name to choose it by.

    Parameters
    ----------
    law, traction, rising_slip
        As for `register`.
    microslip : callable, optional
        Compiled `microslip(law, load, film_thickness, field, shape, fine) -> Patch` for a slip that varies over the
        contact. A law without it takes the slip of the middle for the whole contact.
    chord : callable, optional
        Compiled `chord(law, load, film_thickness, cosine, |slip|)`: traction per length [N/m] on the chord whose length and
        largest pressure are `cosine` times those of the middle. A law without it spreads traction as the load.
    lanes : bool
        Whether `traction` takes numbers in lanes too.
    """
    depend_on(traction, rising_slip)
    _traction[law] = traction
    _rising_slip[law] = rising_slip
    if microslip is not None:
        depend_on(microslip)
        _microslip[law] = microslip
    if chord is not None:
        depend_on(chord)
        _chord[law] = chord
    if lanes:
        _of_lanes.add(law)


def traction_takes_lanes(law: type) -> bool:
    """Whether traction under a law of this type can be had for several states at once, in `macroslip.contact.lanes`."""
    return law in _of_lanes


def patch_traction(law, load, film_thickness, slip):
    """Traction force [N] of the whole contact patch and its derivatives by slip, film thickness and load."""
    return _traction[type(law)](law, load, film_thickness, slip)


def patch_traction_microslip(law, load, film_thickness, field, shape, fine):
    """Traction of a contact over which slip varies by `field`, a `Patch`; with `fine` by a finer quadrature."""
    if shape.microslip and type(law) in _microslip:
        return _microslip[type(law)](law, load, film_thickness, field, shape, fine)
    force, slope, by_film, _ = _traction[type(law)](law, load, film_thickness, field.sliding)
    return Patch(force, 0.0, 0.0, slope, 0.0, by_film, 0.0)


def rising_slip(law, load, film_thickness):
    """Slip [m/s] up to which traction is sure to rise with slip at this load [N] and film thickness [m]."""
    return _rising_slip[type(law)](law, load, film_thickness)


@overload(patch_traction)
def _patch_traction(law, load, film_thickness, slip):
    implementation = taking(law, _traction[law.instance_class])
    return lambda law, load, film_thickness, slip: implementation(law, load, film_thickness, slip)


@overload(patch_traction_microslip)
def _patch_traction_microslip(law, load, film_thickness, field, shape, fine):
    uniform = taking(law, _traction[law.instance_class])
    varying = _microslip.get(law.instance_class)
    varying = varying and taking(law, varying)

    def alike(law, load, film_thickness, field, shape, fine):
        force, slope, by_film, _ = uniform(law, load, film_thickness, field.sliding)
        return Patch(force, 0.0, 0.0, slope, 0.0, by_film, 0.0)

    def either(law, load, film_thickness, field, shape, fine):
        if shape.microslip:
            return varying(law, load, film_thickness, field, shape, fine)  # pyright: ignore[reportOptionalCall]
        force, slope, by_film, _ = uniform(law, load, film_thickness, field.sliding)
        return Patch(force, 0.0, 0.0, slope, 0.0, by_film, 0.0)

    return alike if varying is None else either


@overload(rising_slip)
def _rising_slip_of(law, load, film_thickness):
    implementation = taking(law, _rising_slip[law.instance_class])
    return lambda law, load, film_thickness: implementation(law, load, film_thickness)


def chord_traction(law, load, film_thickness, across, cosine, slip):
    """Traction per length across rolling [N/m] at one station, for |slip| [m/s] there."""
    if type(law) in _chord:
        return _chord[type(law)](law, load, film_thickness, cosine, slip)
    return 0.75 * cosine * cosine / across * _traction[type(law)](law, load, film_thickness, slip)[0]


@overload(chord_traction)
def _chord_traction(law, load, film_thickness, across, cosine, slip):
    chord = _chord.get(law.instance_class)
    if chord is not None:
        chord = taking(law, chord)
        return lambda law, load, film_thickness, across, cosine, slip: chord(law, load, film_thickness, cosine, slip)
    whole = taking(law, _traction[law.instance_class])
    return lambda law, load, film_thickness, across, cosine, slip: (
        0.75 * cosine * cosine / across * whole(law, load, film_thickness, slip)[0]
    )
