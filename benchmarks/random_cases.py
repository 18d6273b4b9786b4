"""Random legal cases at the default tolerance beside a tight one: whether anything is wrong without a sign.

    python -m benchmarks.random_cases --cases 10000 --seed 1 -o random_cases.csv

A case is drawn from its number alone, so that any line of the table can be computed again: `--first NUMBER --cases 1`.
Energies of rollers have to agree to 1e-3 and peak powers to 2 %, or the case has to say that it failed. Where the whole
bearing moves, energies of its rows to 5e-3, or the result warns that its books do not close. The reference has a tolerance of
5e-5, and the tight one where the difference is more than three tenths of what is allowed. Which rollers touch the cage
can be chaotic: a row that is off is computed once more at the tight tolerance with pockets wider by a thousand-millionth,
and counts as chaotic where that changes it by a third of the difference or more.
"""

from __future__ import annotations

import argparse
import contextlib
import csv
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from macroslip import Bearing, BearingLoads, Case, HubLoads, Lubricant, simulate
from macroslip.bearing.geometry import orbit_ratio
from macroslip.case.case import IMPOSED_ORBIT, WHOLE_BEARING, Radau, Window
from macroslip.contact.interface import highest_load, truncation_load
from macroslip.contact.mechanisms import Laws
from macroslip.errors import InputError
from macroslip.loads import Drivetrain, main_bearing_load
from macroslip.ring.motion import ring_motion
from macroslip.roller.model import ring_geometry, roller_model

TIGHT = 1e-6
#: Allowed relative errors of a roller's energy in the window, and of its peak power in each orbit.
ENERGY, PEAK = 1e-3, 0.02
#: The same of rows of a whole bearing, whose largest touches depend on rounding and are not judged.
ROW_ENERGY = 5e-3
#: Relative change of the pockets' gap, and the part of a difference that it has to make where touches are chaotic.
_WIDENED, _CHAOTIC = 1e-9, 1.0 / 3.0
#: Tolerance of the first reference, and the part of an allowed error up to which it decides: tables of contacts for a
#: tighter one take ten times as long as the run that is judged.
_FIRST, _CLEAR = 5e-5, 0.3
#: Energies [J] and powers [W] below which only the absolute error counts: a millionth of what a roller dissipates.
SMALL_ENERGY, SMALL_POWER = 1e-6, 1e-4
HISTORIES = (
    "constant",
    "waves",
    "bundled",
    "thrust reversal",
    "load through zero",
    "stop and go",
    "shaft reversal",
)
#: Kinds of speed and of force that wide cases combine, with samples of 1 ms to 1 s, and oil of -10 to 140 degC.
SPEEDS = (
    "constant", "backwards", "turbulent", "ramp", "start", "stop", "stop and go", "reversal", "jumps", "square",
    "oscillating", "creeping", "standstill",
)  # fmt: skip
FORCES = "constant", "waves", "rotating", "thrust reversal", "through zero", "jumps", "thrust"
#: Kinds of speed that change within a sample or are hardly there, and forces beside `FORCES` that go with them.
SUDDEN_SPEEDS = ("sawtooth", "held steps", "knocks", "inching", "run-down")
SUDDEN_FORCES = (*FORCES, "held steps", "knocks")
WIDE, SUDDEN = "wide", "sudden"
#: Most samples of a wide or sudden history, and steps after which an integration is given up.
_MOST_SAMPLES, _MOST_STEPS = 3000, 50_000
_STEP = 0.05


class Outcome(NamedTuple):
    """What became of one case: errors of energy and peak, with the largest values they belong to, and times."""

    number: int
    history: str
    laws: str
    dynamics: str
    bearing: str
    lubricant: str
    verdict: str
    energy_error: float
    energy: float
    peak_error: float
    peak: float
    seconds: float
    tight_seconds: float


def _waves(random: np.random.Generator, time_s: np.ndarray, size: float) -> np.ndarray:
    """A sum of waves of wind and rotor, 0.05 to 2 Hz, with a standard deviation of `size`."""
    frequencies = np.exp(random.uniform(np.log(0.05), np.log(2.0), 6))
    phases, sizes = random.uniform(0, 2 * np.pi, 6), 1.0 / frequencies**0.5
    wave = (
        sizes[:, None] * np.sin(2 * np.pi * frequencies[:, None] * time_s + phases[:, None])
    ).sum(axis=0)
    return size * wave / np.sqrt(0.5 * (sizes**2).sum())


def _history(
    random: np.random.Generator, kind: str, heavy: float, speed: float, period: float
) -> BearingLoads:
    """Loads of a kind: `heavy` [N] is what the bearing bears, `speed` [rad/s], `period` [s] of an orbit."""
    seconds = float(random.uniform(1.3, 2.4)) * period
    t = np.arange(int(seconds / _STEP) + 1) * _STEP
    down, thrust = -heavy * random.uniform(0.02, 0.6), heavy * random.uniform(-0.25, 0.25)
    force = np.column_stack([np.zeros(t.size), np.full(t.size, down), np.full(t.size, thrust)])
    turn = np.full(t.size, speed)
    slow = 2 * np.pi * t / random.uniform(2.0, 20.0) + random.uniform(0, 2 * np.pi)
    if kind != "constant":
        force += np.column_stack(
            [_waves(random, t, abs(down) * random.uniform(0.02, 0.2)) for _ in range(3)]
        )
        turn = speed * (1.0 + _waves(random, t, random.uniform(0.0, 0.05)))
    if kind == "thrust reversal":
        force[:, 2] = max(abs(thrust), 0.02 * heavy) * np.sin(slow)
    elif kind == "load through zero":
        force[:, :2] *= np.sin(slow)[:, None]
        force[:, 2] *= random.choice([0.0, 1.0])
    elif kind == "stop and go":
        turn = speed * np.clip(2.0 * np.sin(slow) + random.uniform(-0.5, 1.0), 0.0, 1.0)
    elif kind == "shaft reversal":
        turn = speed * np.sin(slow)
    return BearingLoads(t, turn, force, kind)


def _levels(random: np.random.Generator, x: np.ndarray, low: float) -> np.ndarray:
    """A value that jumps at random times, from `low` to 1; `x` is the part of the history that has passed."""
    jumps = np.sort(random.uniform(0.0, 1.0, int(random.integers(2, 20))))
    return random.uniform(low, 1.0, jumps.size + 1)[np.searchsorted(jumps, x)]


def _held(random: np.random.Generator, time_s: np.ndarray) -> np.ndarray:
    """The times [s], each held for as long as a controller or recorder holds its output, 0.05 to 2 s."""
    hold = float(np.exp(random.uniform(np.log(0.05), np.log(2.0))))
    return np.floor(time_s / hold) * hold


def _knocks(random: np.random.Generator, size: int) -> np.ndarray:
    """A value of 0 that rises to 1 for one to five of `size` samples, two to ten times."""
    knocks = np.zeros(size)
    for _ in range(int(random.integers(2, 11))):
        first = int(random.integers(0, size))
        knocks[first : first + int(random.integers(1, 6))] = 1.0
    return knocks


def _sudden_speed(random: np.random.Generator, kind: str, time_s: np.ndarray) -> np.ndarray:
    """A speed of a kind of `SUDDEN_SPEEDS` over its largest one, at times from zero on."""
    if kind == "sawtooth":
        # It rises or falls over a period and comes back within a sample.
        phase = time_s / random.uniform(0.5, 10.0) % 1.0
        low = random.uniform(0.0, 0.8)
        return low + (1.0 - low) * (phase if random.random() < 0.5 else 1.0 - phase)
    if kind == "held steps":
        return 1.0 + _waves(random, _held(random, time_s), 0.1)
    if kind == "knocks":
        return 1.0 - random.uniform(0.05, 1.0) * _knocks(random, time_s.size)
    if kind == "inching":
        # Short turns, forth or forth and back, with rests between them.
        moves = np.sin(2.0 * np.pi * time_s / random.uniform(1.0, 8.0))
        moves = np.clip(4.0 * moves - 2.0, 0.0, 1.0) - random.choice([0.0, 1.0]) * np.clip(
            -4.0 * moves - 2.0, 0.0, 1.0
        )
        return random.uniform(0.05, 0.5) * moves
    # A run-down by friction and drag ends at a finite time, after which the shaft is at rest.
    left = np.clip(1.0 - time_s / (random.uniform(0.3, 1.1) * time_s[-1]), 0.0, 1.0)
    return left ** random.uniform(1.0, 2.0)


def _sudden_history(
    random: np.random.Generator, heavy: float, speed: float, period: float
) -> BearingLoads:
    """Speeds of `SUDDEN_SPEEDS` with any kind of force, in samples of 1 ms to 0.2 s."""
    way, kind = str(random.choice(SUDDEN_SPEEDS)), str(random.choice(SUDDEN_FORCES))
    step = float(np.exp(random.uniform(np.log(1e-3), np.log(0.2))))
    t = np.arange(min(int(random.uniform(0.5, 1.5) * period / step), _MOST_SAMPLES) + 3) * step
    turn = _sudden_speed(random, way, t)
    size = heavy * 10.0 ** random.uniform(-3.0, -0.3)
    force = _force(random, kind, t, size, 2 * np.pi * t / random.uniform(0.5, 20.0))
    return BearingLoads(t, speed * turn, force, f"{SUDDEN}: {way}, {kind}")


def _force(
    random: np.random.Generator, kind: str, t: np.ndarray, size: float, slow: np.ndarray
) -> np.ndarray:
    """Forces [N] of a kind of `SUDDEN_FORCES` at times [s], with the phase `slow` [rad] of what comes back."""
    ones = np.ones_like(t)
    force = np.column_stack([0.0 * t, -size * ones, size * random.uniform(-0.4, 0.4) * ones])
    if kind == "waves":
        force += np.column_stack([_waves(random, t, 0.2 * size) for _ in range(3)])
    elif kind == "rotating":
        force[:, :2] = size * np.column_stack([np.cos(slow), np.sin(slow)])
    elif kind == "thrust reversal":
        force[:, 2] = 0.4 * size * np.sin(slow)
    elif kind == "through zero":
        force *= np.sin(slow)[:, None]
    elif kind == "jumps":
        force *= _levels(random, t / t[-1], 0.0)[:, None]
    elif kind == "thrust":
        force[:, :2] = 0.0
    elif kind == "held steps":
        force *= 1.0 + _waves(random, _held(random, t), 0.3)[:, None]
    elif kind == "knocks":
        force *= 1.0 + random.uniform(1.0, 10.0) * _knocks(random, t.size)[:, None]
    return force


def _wide_history(
    random: np.random.Generator, heavy: float, speed: float, period: float
) -> BearingLoads:
    """Any kind of speed with any kind of force, from a thousandth of what the bearing bears on."""
    way, kind = str(random.choice(SPEEDS)), str(random.choice(FORCES))
    step = float(np.exp(random.uniform(np.log(1e-3), 0.0)))
    t = np.arange(min(int(random.uniform(0.3, 1.5) * period / step), _MOST_SAMPLES) + 3) * step
    x, slow = t / t[-1], 2 * np.pi * t / random.uniform(0.5, 20.0) + random.uniform(0, 2 * np.pi)
    ones = np.ones_like(t)
    turn = {
        "constant": ones, "backwards": -ones, "turbulent": ones + _waves(random, t, 0.05), "ramp": x,
        "start": np.clip(4.0 * x - 1.0, 0.0, 1.0), "stop": np.clip(3.0 - 4.0 * x, 0.0, 1.0),
        "stop and go": np.clip(2.0 * np.sin(slow) + random.uniform(-0.5, 1.0), 0.0, 1.0), "reversal": np.sin(slow),
        "jumps": _levels(random, x, 0.1), "square": np.where(np.sin(slow) > 0.0, 1.0, 0.5),
        "oscillating": 1.0 + 0.5 * np.sin(slow), "creeping": 0.01 * ones, "standstill": 0.0 * ones,
    }[way]  # fmt: skip
    size = heavy * 10.0 ** random.uniform(-3.0, -0.3)
    force = _force(random, kind, t, size, slow)
    return BearingLoads(t, speed * turn, force, f"{WIDE}: {way}, {kind}")


def _borne(loads: BearingLoads, case: Case) -> BearingLoads:
    """The loads, made smaller by the part needed for no contact to reach the rollers' ends: such a case is refused."""
    allowed = highest_load(case.bearing, case.oil, case.laws)
    ring = ring_geometry(
        case.bearing, roller_model(case.bearing, case.oil, 1, tilt=case.drivetrain.tilt)
    )
    while (largest := ring_motion(loads, case.bearing, ring, np.inf)[1]) > allowed:
        loads = replace(loads, force=loads.force * 0.9 * allowed / largest)
    return loads


def _laws(random: np.random.Generator, physical: float) -> Laws:
    if random.random() < physical:
        return (
            Laws.physical()
            if random.random() < 0.7
            else Laws.physical().but(rheology="limiting-shear")
        )
    changes: dict[str, Any] = random.choice(
        [
            {},
            {},
            {},
            {"film": "masjedi-khonsari-moes", "inlet_heating": True, "starvation": True},
            {"heating": False},
        ]
    )
    return Laws.paper().but(**changes)


def _temperature(random: np.random.Generator, lubricant: Lubricant, *, wide: bool) -> float:
    """A temperature [K] that the oil can have."""
    while True:
        temperature = float(
            random.uniform(263.15, 413.15) if wide else random.uniform(293.15, 343.15)
        )
        with contextlib.suppress(InputError):
            lubricant.at(temperature)
            return temperature


def random_case(
    number: int,
    seed: int = 1,
    physical: float = 0.1,
    whole: float = 0.0,
    wide: float = 0.0,
    sudden: float = 0.0,
) -> tuple[str, Case]:
    """The kind of loads and the case with a number: the same ones whenever it is asked for.

    Parameters
    ----------
    number, seed : int
        From which all is drawn.
    physical, whole, wide, sudden : float
        Shares of cases with laws of the set physical, in which the whole bearing moves, with any kind of speed, force
        and sample, and with speeds that change within a sample [-].

    Returns
    -------
    kind : str
        Of loads.
    case : Case
    """
    random = np.random.default_rng([seed, number])
    bearing = Bearing.read(random.choice(Bearing.catalogue()))
    bearing = bearing.replace(diametral_clearance=float(random.uniform(0.0, 0.4e-3)))
    lubricant = Lubricant.read(random.choice(Lubricant.catalogue()))
    laws = _laws(random, physical)
    dynamics = WHOLE_BEARING if random.random() < whole else IMPOSED_ORBIT
    kind = str(random.choice(HISTORIES))
    speed = float(random.choice([-1.0, 1.0], p=[0.1, 0.9]) * random.uniform(4.0, 22.0) * np.pi / 30)
    heavy = truncation_load(bearing, lubricant) * bearing.rollers_per_row * 0.4
    period = 2 * np.pi / (orbit_ratio(bearing) * abs(speed))
    # Nothing is drawn for a share of zero, so that a number gives the case that it gave before there was the share.
    is_sudden = sudden > 0.0 and random.random() < sudden
    is_wide = not is_sudden and wide > 0.0 and random.random() < wide
    if is_sudden or is_wide:
        history = _sudden_history if is_sudden else _wide_history
        loads = history(random, heavy, speed, period)
        kind = loads.source
    elif kind == "bundled":
        start = float(random.uniform(0.0, 500.0))
        cases = [f"{wind}{letter}" for wind in range(12, 26, 2) for letter in "ABC"]
        loads = HubLoads.bundled(str(random.choice(cases))).window(
            start, start + float(random.uniform(8.0, 16.0))
        )
        loads = main_bearing_load(loads, Drivetrain())
    else:
        loads = _history(random, kind, heavy, speed, period)
    rollers = sorted({int(n) for n in random.integers(0, bearing.rollers_per_row, 2)})
    case = Case(
        loads=loads,
        bearing=bearing,
        lubricant=lubricant,
        temperature=None
        if random.random() < 0.5
        else _temperature(random, lubricant, wide=is_wide),
        laws=laws,
        dynamics=dynamics,
        gravity=bool(random.random() < 0.9),
        drag=bool(random.random() < 0.9),
        rollers="all" if dynamics == WHOLE_BEARING else rollers,
        window=Window(start=0.0) if is_wide or is_sudden else Window(),
    )
    return kind, replace(case, loads=_borne(loads, case))


def _largest(error: np.ndarray, of: np.ndarray, small: float) -> tuple[float, float]:
    """Largest relative error, and the value it belongs to; what is small counts as `small`."""
    if not error.size:
        return 0.0, float("nan")
    relative = np.abs(error) / np.maximum(np.abs(of), small)
    worst = np.unravel_index(np.nanargmax(relative), relative.shape)
    return float(relative[worst]), float(of[worst])


def _judged(result: Any, dynamics: str) -> tuple[np.ndarray, np.ndarray]:
    """Energies [J] and peak powers [W] that have to agree: of every roller, or of every row where rollers share a cage.

    There gripped rollers push each other through the cage, and which of them touches it is chaotic.
    """
    energy = result.energy.sum("interface")
    # An orbit need not be complete for its peak to be right.
    peak = np.concatenate(
        [
            result.peak_power.transpose("row", "roller", ..., "interface"),
            result.window_peak_power.values[:, :, None],
        ],
        axis=2,
    ).max(axis=-1)
    if dynamics == WHOLE_BEARING:
        energy, peak = energy.sum("roller"), peak.max(axis=1)
    return energy.values, peak


def compare(number: int, seed: int = 1, tight: float = TIGHT, **shares: float) -> Outcome:
    """One case at both tolerances."""
    kind, case = random_case(number, seed, **shares)
    about = number, kind, case.laws.name, case.dynamics, case.bearing.name, case.lubricant.name

    def timed(tolerance: float, **changes: Any) -> tuple[Any, float]:
        start = time.process_time()
        limits = Radau(tolerance=tolerance, max_steps=_MOST_STEPS)
        result = simulate(replace(case, integrator=limits, **changes), threads=1)
        return result, time.process_time() - start

    nothing = float("nan")
    try:
        result, seconds = timed(Radau().tolerance)
    except InputError as problem:
        verdict = f"refused: {' '.join(str(problem).split())[:120]}"
        return Outcome(*about, verdict, *[nothing] * 6)
    if bool((result.status != 0).any()):
        codes = sorted({int(code) for code in np.unique(result.status) if code})
        return Outcome(*about, f"failed with status {codes}", *[nothing] * 4, seconds, nothing)
    energy, peak = _judged(result, case.dynamics)
    tight_seconds, most = 0.0, ROW_ENERGY if case.dynamics == WHOLE_BEARING else ENERGY
    for tolerance in sorted({max(_FIRST, tight), tight}, reverse=True):
        exact, spent = timed(tolerance)
        tight_seconds += spent
        if bool((exact.status != 0).any()):
            return Outcome(*about, "no reference", *[nothing] * 4, seconds, tight_seconds)
        reference, peak_reference = _judged(exact, case.dynamics)
        energy_error, at = _largest(energy - reference, reference, SMALL_ENERGY)
        peak_error, peak_at = _largest(peak - peak_reference, peak_reference, SMALL_POWER)
        near = case.dynamics == WHOLE_BEARING or peak_error <= _CLEAR * PEAK
        if near and energy_error <= _CLEAR * most:
            break
    if case.dynamics == WHOLE_BEARING:
        verdict = "agrees" if energy_error <= ROW_ENERGY else "off: energy"
        if energy_error > ROW_ENERGY and "books_warning" in result.attrs:
            verdict = "warned: books do not close"
        elif energy_error > ROW_ENERGY:
            wider, _ = timed(tight, cage=replace(case.cage, gap=case.cage.gap * (1.0 + _WIDENED)))
            scatter, _ = _largest(
                _judged(wider, case.dynamics)[0] - reference, reference, SMALL_ENERGY
            )
            verdict = f"chaotic: {scatter:.1e}" if scatter > _CHAOTIC * energy_error else verdict
        return Outcome(
            *about, verdict, energy_error, at, peak_error, peak_at, seconds, tight_seconds
        )
    wrong = [
        name
        for name, error, most in (("energy", energy_error, ENERGY), ("peak", peak_error, PEAK))
        if error > most
    ]
    verdict = f"off: {' and '.join(wrong)}" if wrong else "agrees"
    return Outcome(*about, verdict, energy_error, at, peak_error, peak_at, seconds, tight_seconds)


def table(outcomes: list[Outcome]) -> Iterator[str]:
    """Lines of a table by kind of loads, with the outliers below."""
    words = "agrees", "failed", "refused", "warned", "chaotic", "off"
    yield f"{'loads':<18}{'cases':>6}{''.join(f'{word:>8}' for word in words)}{'energy error':>14}{'peak error':>12}"
    kinds = (
        *HISTORIES,
        *(
            kind
            for kind in (WIDE, SUDDEN)
            if any(outcome.history.startswith(kind) for outcome in outcomes)
        ),
        "all",
    )
    for kind in kinds:
        some = [outcome for outcome in outcomes if kind in (outcome.history.split(":")[0], "all")]
        counts = "".join(
            f"{sum(outcome.verdict.startswith(word) for outcome in some):>8}" for word in words
        )
        energy = max(
            (outcome.energy_error for outcome in some if np.isfinite(outcome.energy_error)),
            default=0.0,
        )
        peak = max(
            (outcome.peak_error for outcome in some if np.isfinite(outcome.peak_error)), default=0.0
        )
        yield f"{kind:<18}{len(some):>6}{counts}{energy:>14.1e}{peak:>12.1e}"
    for outcome in outcomes:
        if not outcome.verdict.startswith(("agrees", "refused")):
            yield (
                f"  {outcome.number}: {outcome.history}, {outcome.laws}, {outcome.dynamics}: {outcome.verdict}; energy {outcome.energy_error:.1e} of "
                f"{outcome.energy:.3g} J, peak {outcome.peak_error:.1e} of {outcome.peak:.3g} W"
            )


def main(arguments: list[str] | None = None) -> None:
    """Compare cases one by one; each has its line in the table of results as soon as it is done."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cases", type=int, default=100)
    parser.add_argument("--first", type=int, default=0, help="number of the first case")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tight", type=float, default=TIGHT, help="tolerance of the reference")
    parser.add_argument(
        "--physical", type=float, default=0.1, help="share of cases with the set physical"
    )
    parser.add_argument(
        "--whole", type=float, default=0.0, help="share of cases in which the whole bearing moves"
    )
    parser.add_argument(
        "--wide",
        type=float,
        default=0.0,
        help="share of cases with any kind of speed, force and sample",
    )
    parser.add_argument(
        "--sudden",
        type=float,
        default=0.0,
        help="share of cases whose speed changes within a sample, or inches and runs down",
    )
    parser.add_argument("-o", "--output", type=Path, default=Path("random_cases.csv"))
    options = parser.parse_args(arguments)
    outcomes = []
    with options.output.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(Outcome._fields)
        for number in range(options.first, options.first + options.cases):
            outcome = compare(
                number,
                options.seed,
                options.tight,
                physical=options.physical,
                whole=options.whole,
                wide=options.wide,
                sudden=options.sudden,
            )
            outcomes.append(outcome)
            writer.writerow(outcome)
            file.flush()
            if not outcome.verdict.startswith("agrees"):
                print(
                    f"{number}: {outcome.history}: {outcome.verdict}", file=sys.stderr, flush=True
                )
    print("\n".join(table(outcomes)))


if __name__ == "__main__":
    main()
