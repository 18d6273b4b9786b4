"""Laws of one's own, tried over the states of a case before its first step: a wrong one may give plausible numbers."""

from __future__ import annotations

import functools
import itertools
import math
import re
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numba import NumbaError

from macroslip.constants import MECHANISMS
from macroslip.errors import InputError
from macroslip.film import film_law
from macroslip.roller.model import highest_load, interfaces
from macroslip.traction import traction_law

if TYPE_CHECKING:
    from macroslip.bearing import Bearing
    from macroslip.contact.interface import Interface
    from macroslip.lubricant import Lubricant
    from macroslip.mechanisms import Laws

#: Part of a derivative by which it may differ from differences of the law itself.
_AGREE = 0.02
#: Relative step of those differences.
_STEP = 1e-4
#: Load of the cage, as part of what raceways bear: weight and friction of a roller.
_CAGE_SHARE = 0.01
#: Thinnest and thickest film [m] that a traction law is tried with.
_THINNEST, _THICKEST = 1e-9, 1e-3
#: Time [s] that a law may take for one state, with compiling.
_LONGEST = 120.0
#: Lines of the compiler's messages without information.
_FAILED = "Failed in nopython mode pipeline"
#: Begin of the last call of a law [s].
_begun = [0.0]


def check_own_laws(laws: Laws, bearing: Bearing, lubricant: Lubricant, speed: float) -> None:
    """Refuse a law of the user's own that breaks what the integrator relies on, with the state at which it does.

    Film has to be finite and positive; traction finite, of the sign of the slip, and without jumps at zero; derivatives
    have to be those of the law. Laws of the package are tested elsewhere, and not tried here.

    Parameters
    ----------
    laws : Laws
    bearing : Bearing
    lubricant : Lubricant
    speed : float
        Highest speed of the raceways [m/s]; nothing is tried for 0.

    Raises
    ------
    InputError
        Naming the law, the interface and the state.
    """
    if speed > 0.0:
        # The grid needs the order of the speed only, so that the cases of a study share what was found.
        _in_time(lambda: _check(laws, bearing, lubricant, 2.0 ** math.ceil(math.log2(speed))), laws)


def _in_time(check: Callable[[], None], laws: Laws) -> None:
    """Run a check in a thread that is abandoned if a law does not return: compiled code cannot be interrupted."""
    problems: list[BaseException] = []

    def run() -> None:
        try:
            check()
        except BaseException as problem:
            problems.append(problem)

    _begun[0] = time.monotonic()
    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    while thread.is_alive():
        thread.join(0.5)
        if thread.is_alive() and time.monotonic() - _begun[0] > _LONGEST:
            what = f"it has given nothing for {_LONGEST:g} s"
            raise _wrong(what, f"film law '{laws.film}' or traction law '{laws.traction}'", "a function that ends")
    if problems:
        raise problems[0]


@functools.lru_cache(maxsize=64)
def _check(laws: Laws, bearing: Bearing, lubricant: Lubricant, speed: float) -> None:
    for interface in interfaces(bearing, lubricant):
        heaviest = highest_load(bearing, lubricant, laws) * (_CAGE_SHARE if interface.name == "cage" else 1.0)
        film = film_law.prepare(laws.film, interface)
        states = list(itertools.product(np.geomspace(1e-3, 1.0, 7) * heaviest, np.geomspace(1e-3, 1.0, 9) * speed))
        if _is_own(film):
            for load, entrainment in states:
                _check_film(laws.film, film, interface, float(load), float(entrainment))
        if laws.traction == MECHANISMS:
            continue
        traction = traction_law.prepare(laws.traction, interface)
        if _is_own(traction):
            films = [film_law.film_thickness(film, load, entrainment)[0] for load, entrainment in states]
            thin, thick = (min(max(value, _THINNEST), _THICKEST) for value in (min(films), max(films)))
            for load, height in itertools.product(np.geomspace(1e-3, 1.0, 5) * heaviest, np.geomspace(thin, thick, 4)):
                _check_traction(laws.traction, traction, interface, float(load), float(height), speed)


def _is_own(law: Any) -> bool:
    return not type(law).__module__.startswith("macroslip.")


def _check_film(name: str, law: Any, interface: Interface, load: float, entrainment: float) -> None:
    def height(*state: float) -> tuple[float, ...]:
        return _called(law_of, 3, film_law.film_thickness, law, *state)

    law_of = f"film law '{name}'"
    where = f"{law_of}, {interface.name}, load {load:.4g} N, entrainment speed {entrainment:.4g} m/s"
    thickness, by_speed, by_load = height(load, entrainment)
    if not (math.isfinite(thickness) and thickness > 0.0):
        raise _wrong(f"the film is {thickness:.4g} m", where, "a finite thickness above zero")
    _called(law_of, 1, film_law.film_in_range, law, load, entrainment)
    for position, derivative, symbol in ((0, by_load, "dh/dQ"), (1, by_speed, "dh/du")):
        _check_derivative(lambda *state: height(*state)[0], (load, entrainment), position, derivative, symbol, where)


def _check_traction(name: str, law: Any, interface: Interface, load: float, height: float, speed: float) -> None:
    def force(*state: float) -> tuple[float, ...]:
        return _called(law_of, 4, traction_law.patch_traction, law, *state)

    law_of = f"traction law '{name}'"
    for slip in _slips(speed):
        where = f"{law_of}, {interface.name}, load {load:.4g} N, film {height:.4g} m, slip {slip:.4g} m/s"
        traction, by_slip, by_film, by_load = force(load, height, slip)
        if not (math.isfinite(traction) and traction * slip >= 0.0):
            raise _wrong(f"traction is {traction:.4g} N", where, "a finite force with the sign of the slip")
        if slip == 0.0 and traction != 0.0:
            raise _wrong(f"traction is {traction:.4g} N", where, "none without slip")
        if slip == 0.0:
            continue
        state = load, height, slip
        for position, derivative, symbol in ((0, by_load, "dF/dQ"), (1, by_film, "dF/dh"), (2, by_slip, "dF/dslip")):
            _check_derivative(lambda *state: force(*state)[0], state, position, derivative, symbol, where)
    (rising,) = _called(law_of, 1, traction_law.rising_slip, law, load, height)
    if not rising >= 0.0:
        where = f"{law_of}, {interface.name}, load {load:.4g} N, film {height:.4g} m"
        raise _wrong(f"rising_slip is {rising:.4g} m/s", where, "a slip of 0 or more")


def _slips(speed: float) -> Iterator[float]:
    yield 0.0
    for size in np.geomspace(1e-5, 1.0, 6) * speed:
        yield from (float(size), -float(size))


def _check_derivative(
    value: Callable[..., float], state: tuple[float, ...], position: int, derivative: float, symbol: str, where: str
) -> None:
    """Refuse a derivative that is neither that to the left nor that to the right, nor between them."""
    change = _STEP * abs(state[position])

    def moved(steps: float) -> float:
        return value(*state[:position], state[position] + steps * change, *state[position + 1 :])

    here = moved(0.0)
    sides = [(here - moved(-1.0)) / change, (moved(1.0) - here) / change]
    # A difference within rounding and curvature counts as zero.
    slack = _AGREE * max(map(abs, sides)) + 1e-9 * abs(here) / change
    if not min(sides) - slack <= derivative <= max(sides) + slack:
        raise _wrong(
            f"{symbol} is {derivative:.4g}, but the law itself changes by {sides[1]:.4g}",
            where,
            f"the derivative to {100 * _AGREE:.0f} %",
        )


def _called(law_of: str, count: int, function: Callable[..., Any], *arguments: Any) -> tuple[float, ...]:
    """The `count` numbers that the law gives, with any error in it reported as the law's."""
    _begun[0] = time.monotonic()
    try:
        found = function(*arguments)
    except NumbaError as error:
        raise _wrong(
            f"it cannot be compiled ({type(error).__name__}: {_reason(error)})", law_of, "what numba compiles"
        ) from None
    except Exception as error:
        raise _wrong(f"{type(error).__name__} in it ({error})", law_of, "a function that raises nothing") from None
    numbers = found if isinstance(found, tuple) else (found,)
    if len(numbers) != count or not all(isinstance(one, (int, float)) for one in numbers):
        raise _wrong(f"it gives {found!r:.80}", law_of, f"{count} number{'s' if count > 1 else ''}")
    return numbers


def _reason(error: NumbaError) -> str:
    """The compiler's reason, and the line of the law: two lines out of pages of text."""
    text = str(error)
    lines = [line.strip() for line in text.splitlines() if line.strip() and not line.startswith(_FAILED)]
    reason = " ".join(lines[: 2 if lines[:1] and lines[0].endswith(":") else 1])
    places = re.findall(r'File "([^"]+)", line (\d+)', text)
    return f"{reason}; {Path(places[-1][0]).name}, line {places[-1][1]}" if places else reason


def _wrong(what: str, where: str, allowed: str) -> InputError:
    return InputError(
        what, where=where, allowed=allowed, remedy="Mend the law; the page on laws of one's own has its contract."
    )
