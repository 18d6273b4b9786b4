"""Film and traction laws by name, the package's and the user's, and the contract of a law.

A film law is `film(interface, load, entrainment_speed) -> h` and a traction law
`traction(interface, load, film_thickness, slip) -> F`, both on NumPy arrays of one shape, in SI
units, by values alone: a law of one's own is the same kind of function as one of the package.
"""

from __future__ import annotations

import functools
import math
import threading
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from macroslip.bearing import Bearing
from macroslip.constants import KELLSTROEM, MECHANISMS
from macroslip.contact import film
from macroslip.contact.interface import Interface, highest_load, interfaces
from macroslip.contact.mechanisms import Laws
from macroslip.errors import InputError, MacroslipError, on_one_line
from macroslip.lubricant import Lubricant

#: Slip [m/s] below which the force of a traction law of one's own is in proportion to slip.
LEAST_SLIP = 1e-10

#: Part by which a force may differ from proportion at small slip.
_PROPORTIONAL = 0.01
#: Load of the cage, as part of what raceways bear: weight and friction of a roller.
_CAGE_SHARE = 0.01
#: Thinnest and thickest film [m] that a traction law is tried with.
_THINNEST = 1e-9
_THICKEST = 1e-3
#: Time [s] that a law may take for one call.
_LONGEST = 60.0
#: Begin of the last call of a law [s].
_begun = [0.0]


class Law(NamedTuple):
    """A film or traction law that a case chooses by its name."""

    kind: str  #: `film` or `traction`
    name: str  #: Name in a case
    function: Callable  #: Of an interface and arrays
    reference: str  #: Work to cite
    #: Of a film law: whether its formula is in its range, at (interface, load, entrainment_speed);
    #: None for everywhere.
    in_range: Callable | None = None
    #: Of a film law: numbers outside its range whatever load and speed, a list of str for an
    #: interface.
    range_notes: Callable | None = None

    def __call__(self, interface: Interface, *states: Any) -> np.ndarray:
        """Values at broadcastable states.

        Raises InputError if the law raises, or gives anything but finite, positive numbers, one for
        each state.
        """
        values = self._values(self.function, interface, states, "fiu", "real numbers").astype(float)
        bad = ~(np.isfinite(values) & (values > 0.0))
        if bad.any():
            known = zip(
                _STATES[self.kind],
                (np.broadcast_to(state, bad.shape)[bad][0] for state in states),
                strict=True,
            )
            at = ", ".join(f"{name} {value:.4g} {unit}" for (name, unit), value in known)
            fault = f"it gives {values[bad][0]:.4g} {_UNITS[self.kind]}"
            raise _wrong(
                fault,
                f"{self.kind} law '{self.name}', {interface.name}, {at}",
                "a finite number above zero",
            )
        return values[()]

    def inside(self, interface: Interface, load, entrainment_speed) -> np.ndarray:
        """True where a film law is in its range."""
        if self.in_range is None:
            return np.ones(np.broadcast(load, entrainment_speed).shape, dtype=bool)[()]
        if not self.is_own:
            # Asked for every buffer of steps: what is checked of a user's function takes longer.
            return self.in_range(interface, load, entrainment_speed)
        return self._values(
            self.in_range, interface, (load, entrainment_speed), "b", "truth values", "in_range of "
        )[()]

    def _values(
        self,
        function: Callable,
        interface: Interface,
        states: tuple,
        kinds: str,
        noun: str,
        part: str = "",
    ) -> np.ndarray:
        """Values of a function of the law at states, refused if of a wrong kind or shape."""
        # A law may change the arrays it is given.
        arrays = [np.array(state, dtype=float) for state in np.broadcast_arrays(*states)]
        where = f"{part}{self.kind} law '{self.name}', {interface.name}"
        size = arrays[0].size
        _begun[0] = time.monotonic()
        try:
            with np.errstate(all="ignore"):
                values = np.asarray(function(interface, *(state.ravel() for state in arrays)))
        except (KeyboardInterrupt, MacroslipError):
            raise
        except BaseException as error:
            reason = on_one_line(error)[:200]
            raise _wrong(
                f"{type(error).__name__} in it ({reason})", where, "a function that raises nothing"
            ) from error
        if values.shape != (size,) or values.dtype.kind not in kinds:
            received = (
                f"an array of shape {values.shape} of type {values.dtype}"
                if values.ndim
                else f"{values.item()!r:.80}"
            )
            raise _wrong(
                f"for {size} states it gives {received}",
                where,
                f"an array of {size} {noun}, one for each state",
            )
        return values.reshape(arrays[0].shape)

    @property
    def is_own(self) -> bool:
        """True if the law is the user's."""
        return not getattr(self.function, "__module__", "").startswith("macroslip.")

    @property
    def source(self) -> str:
        """Text that changes whenever a law of one's own may; empty for the package's.

        Tables of the law are kept under it.
        """
        if not self.is_own:
            return ""
        code = getattr(self.function, "__code__", None)
        path = Path(code.co_filename) if code else Path()
        text = (
            path.read_text(encoding="utf-8")
            if path.is_file()
            else repr(code and (code.co_code, code.co_consts))
        )
        return f"{self.kind} {self.name}\n{self.function.__module__}\n{text}"


_STATES = {
    "film": (("load", "N"), ("entrainment speed", "m/s")),
    "traction": (("load", "N"), ("film", "m"), ("slip", "m/s")),
}
_UNITS = {"film": "m", "traction": "N"}


class LawList:
    """Names of the laws of one kind.

    `kind` is `film` or `traction`, the key in case files; `reserved` are names that mean something
    else under that key.
    """

    def __init__(self, kind: str, reserved: tuple[str, ...] = ()):
        self.kind = kind
        self._reserved = reserved
        self._laws: dict[str, Law] = {}

    def add(self, law: Law) -> None:
        """Add a law.

        The module that registered a name may register it again, so that a law can be mended at a
        prompt.

        Raises InputError if the name belongs to another module's law, or means something else.
        """
        module = getattr(law.function, "__module__", None)
        owner = (
            getattr(self._laws[law.name].function, "__module__", None)
            if law.name in self._laws
            else module
        )
        if law.name in self._reserved or owner != module:
            raise InputError(
                f"the {self.kind} law '{law.name}' cannot be registered: the name is taken",
                allowed=f"a name other than {', '.join(sorted([*self.names(), *self._reserved]))}",
                remedy="Choose another name; a law that was changed in its file needs a new Python process",
            )
        self._laws[law.name] = law

    def remove(self, name: str) -> None:
        """Take a law away again."""
        del self._laws[name]

    def names(self) -> list[str]:
        """Names of the laws."""
        return sorted(self._laws)

    def named(self, name: str) -> Law:
        """The law of this name.

        Raises InputError if there is none, with those that exist.
        """
        if name not in self._laws:
            fault = f"there is no {self.kind} law '{name}'"
            allowed = ", ".join([*self._reserved, *self.names()])
            remedy = "Choose one of these, or register your own first: macroslip.load_laws(path of its file)"
            raise InputError(fault, where=f"laws.{self.kind}", allowed=allowed, remedy=remedy)
        return self._laws[name]


FILM_LAWS = LawList("film")
TRACTION_LAWS = LawList("traction", reserved=(MECHANISMS, KELLSTROEM))


def own_laws() -> list[str]:
    """Source texts of the user's registered laws, sorted; empty without any.

    They change whenever one of the laws may.
    """
    laws = [kind.named(name) for kind in (FILM_LAWS, TRACTION_LAWS) for name in kind.names()]
    return sorted(law.source for law in laws if law.is_own)


def register_film(
    name: str,
    function: Callable,
    *,
    reference: str,
    in_range: Callable | None = None,
    range_notes: Callable[[Interface], list[str]] | None = None,
) -> None:
    """Make a film law usable by name.

    Raises InputError if the name is taken by a law of another module.

    Parameters
    ----------
    name : str
        Name in case files.
    function : callable
        `function(interface, load [N], entrainment_speed [m/s]) -> h [m]`, with arrays of one shape;
        finite, above zero and without jumps.
    reference : str
        Work to cite where the law was used.
    in_range : callable, optional
        `in_range(interface, load, entrainment_speed)`: whether the formula holds, an array of truth
        values, counted in `outside_film_range`.
    range_notes : callable, optional
        `range_notes(interface)`: a list of texts on numbers outside the range whatever load and
        speed.

    Examples
    --------
    >>> register_film("square-root", lambda interface, load, speed: 1e-6 * np.sqrt(speed), reference="none")
    >>> FILM_LAWS.remove("square-root")
    """
    FILM_LAWS.add(Law("film", name, function, reference, in_range, range_notes))


def register_traction(name: str, function: Callable, *, reference: str) -> None:
    """Make a traction law usable by name.

    As `register_film`, with
    `function(interface, load [N], film_thickness [m], slip [m/s]) -> F [N]`, arrays of one shape
    and slip above zero; finite, above zero and without jumps, and in proportion to slip where that
    is small.

    Examples
    --------
    >>> register_traction("couette", lambda interface, load, film, slip: 1e-4 * slip / film, reference="none")
    >>> TRACTION_LAWS.remove("couette")
    """
    TRACTION_LAWS.add(Law("traction", name, function, reference))


register_film(
    "masjedi-khonsari",
    film.masjedi_khonsari,
    reference=film.MASJEDI_KHONSARI_REFERENCE,
    in_range=film.masjedi_khonsari_in_range,
    range_notes=film.masjedi_khonsari_notes,
)
register_film("moes", film.moes, reference=film.MOES_REFERENCE, in_range=film.moes_in_range)
register_film(
    "masjedi-khonsari-moes",
    film.masjedi_khonsari_moes,
    reference=film.BLEND_REFERENCE,
    in_range=film.masjedi_khonsari_moes_in_range,
    range_notes=film.masjedi_khonsari_notes,
)


def film_range_notes(name: str, raceways_and_cage: Iterable[Interface]) -> list[str]:
    """Numbers outside the range of the film law `name` at some interface, at any load and speed."""
    notes = FILM_LAWS.named(name).range_notes
    return [
        f"{interface.name}: {note}"
        for interface in raceways_and_cage
        for note in (notes(interface) if notes else [])
    ]


def check_own_laws(laws: Laws, bearing: Bearing, lubricant: Lubricant, speed: float) -> None:
    """Refuse a law of the user's own that breaks its contract, with the state at which it does.

    It is tried over the states that a case can reach before the first step: a wrong law may give
    plausible numbers.

    Parameters
    ----------
    laws : Laws
        The chosen mechanisms.
    bearing : Bearing
        Its dimensions, which bound the loads.
    lubricant : Lubricant
        The oil of the contacts.
    speed : float
        Highest speed of the raceways [m/s], ≥ 0; nothing is tried for 0.

    Raises
    ------
    InputError
        Naming the law, the interface and the state; also if a law does not return.
    """
    chosen = [FILM_LAWS.named(laws.film)]
    if laws.traction not in (MECHANISMS, KELLSTROEM):
        chosen.append(TRACTION_LAWS.named(laws.traction))
    if speed > 0.0 and any(law.is_own for law in chosen):
        # The grid needs the order of the speed only, so that the cases of a study share the
        # finding.
        _check(laws, bearing, lubricant, 2.0 ** math.ceil(math.log2(speed)), tuple(chosen))


@functools.lru_cache(maxsize=64)
def _check(
    laws: Laws, bearing: Bearing, lubricant: Lubricant, speed: float, chosen: tuple[Law, ...]
) -> None:
    """Run the check in a thread that is abandoned if a law does not return."""
    problems: list[BaseException] = []

    def run() -> None:
        try:
            for interface in interfaces(bearing, lubricant):
                share = _CAGE_SHARE if interface.name == "cage" else 1.0
                _check_at(chosen, interface, share * highest_load(bearing, lubricant, laws), speed)
        except BaseException as problem:
            problems.append(problem)

    _begun[0] = time.monotonic()
    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    while thread.is_alive():
        thread.join(0.2)
        if thread.is_alive() and time.monotonic() - _begun[0] > _LONGEST:
            where = " or ".join(f"{law.kind} law '{law.name}'" for law in chosen)
            raise _wrong(f"it has given nothing for {_LONGEST:g} s", where, "a function that ends")
    if problems:
        raise problems[0]


def _check_at(chosen: tuple[Law, ...], interface: Interface, heaviest: float, speed: float) -> None:
    loads = np.geomspace(1e-6, 1.0, 13)[:, None] * heaviest
    speeds = np.geomspace(1e-4, 1.0, 13) * speed
    heights = chosen[0](interface, loads, speeds)
    chosen[0].inside(interface, loads, speeds)
    if len(chosen) == 1:
        return
    law = chosen[1]
    thin, thick = np.clip([heights.min(), heights.max()], _THINNEST, _THICKEST)
    small = [LEAST_SLIP, 2.0 * LEAST_SLIP]
    slips = np.concatenate([small, np.geomspace(1e-6, 1.0, 19) * speed])
    films = np.geomspace(thin, thick, 5)
    loads, films, slips = np.meshgrid(loads[:, 0], films, slips, indexing="ij")
    force = law(interface, loads, films, slips)
    ratio = 0.5 * force[..., 1] / force[..., 0]
    off = np.abs(ratio - 1.0)
    if off.max() > _PROPORTIONAL:
        i, k = np.unravel_index(off.argmax(), off.shape)
        load = loads[i, k, 0]
        height = films[i, k, 0]
        where = (
            f"traction law '{law.name}', {interface.name}, load {load:.4g} N, film {height:.4g} m"
        )
        near, far = (f"{force[i, k, j]:.4g} N at {slips[i, k, j]:.4g} m/s" for j in (0, 1))
        ends = f"{near} and {far}"
        raise _wrong(f"it gives {ends}", where, "a force in proportion to slip where that is small")


def _wrong(fault: str, where: str, allowed: str) -> InputError:
    remedy = "Mend the law; the page on laws of one's own has its contract."
    return InputError(fault, where=where, allowed=allowed, remedy=remedy)
