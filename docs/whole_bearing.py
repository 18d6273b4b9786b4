"""Numbers of docs/notes/whole-bearing.md: python docs/whole_bearing.py PART …, each part a table as the page has it.

Parts, each with `-paper` or `-physical`: `cases` (imposed orbit and whole bearing under the 21 load cases), `choices` (gap, oil,
weight, arrangement, guidance, scatter under 14B), `places` (forces by place on the orbit under a radial load), `operation`
(start, stop, reversal, idling, emergency stop), `speed` (600 s), `accuracy` (energies against a tight tolerance) and `rollers` (cost
by their number). Under the paper's laws alone: `dry` (dry impacts and their cost),
`tolerance` and `scatter` (energies by tolerance and by initial offsets) and `long` (what grows over many orbits). Under the
physical laws alone: `supply` (imposed orbit and whole bearing by oil supply).
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from macroslip import BearingLoads, Cage, Case, HubLoads, Laws, Radau, simulate

PAPER, PHYSICAL = Laws.paper(), Laws.physical()
#: The part of each load case that is simulated [s]; the window opens after one orbit.
BEGIN, SPAN = 100.0, 60.0
RATED = 2.143


def timed(case: Case):
    """A result, and the time of one core that it took [s]."""
    start = time.process_time()
    return simulate(case), time.process_time() - start


def energies(result) -> np.ndarray:
    """Energy of friction of all rollers [J], by row and raceways, cage."""
    by_interface = result.energy.sum("roller").values
    return np.column_stack([by_interface[:, :2].sum(axis=1), by_interface[:, 2]])


def cells(*values: object) -> str:
    """A row of a table."""
    return (
        "| "
        + " | ".join(f"{value:.3g}" if isinstance(value, float) else str(value) for value in values)
        + " |"
    )


def heading(*names: str) -> None:
    """The first two lines of a table."""
    print(cells(*names))
    print("| " + " | ".join("---" for _ in names) + " |", flush=True)


def share(part: float, whole: float) -> str:
    """A ratio, or a dash."""
    return f"{part / whole:.3g}" if whole > 0.0 else "–"


def bundled(laws: Laws) -> Iterator[tuple[str, Case]]:
    """The 21 load cases."""
    for speed in range(12, 25, 2):
        for turbulence in "ABC":
            name = f"{speed}{turbulence}"
            yield name, Case(loads=HubLoads.bundled(name).window(BEGIN, BEGIN + SPAN), laws=laws)


def cases(laws: Laws) -> None:
    """What the imposed orbit changes, and the cage's slip."""
    heading(
        "case", "downwind raceways, imposed [J]", "whole/imposed", "downwind cage, imposed [J]", "whole/imposed",
        "upwind raceways, imposed [J]", "whole/imposed", "upwind cage, imposed [J]", "whole/imposed", "rolling, whole/imposed",
        "down/up, imposed", "down/up, whole", "cage slip [%]", "a cage a row, slip [%]",
        "largest spar force downwind, upwind [N]", "over the top [N]",
    )  # fmt: skip
    for name, case in bundled(laws):
        imposed = simulate(case)
        whole = simulate(replace(case, dynamics="whole-bearing"))
        apart = simulate(replace(case, dynamics="whole-bearing", cage=Cage(arrangement="per-row")))
        before, after = energies(imposed), energies(whole)
        rolling = [float(result.rolling_energy.sum()) for result in (whole, imposed)]
        force = whole.largest_pocket_force.max(("roller", "side")).values
        top = whole.largest_force_by_position.where(
            abs(whole.position - np.pi / 2) < np.radians(30)
        ).max()
        pairs = [
            x
            for i in (0, 1)
            for k in (0, 1)
            for x in (float(before[i, k]), share(after[i, k], before[i, k]))
        ]
        print(cells(
            name, *pairs, share(*rolling), share(*before.sum(axis=1)), share(*after.sum(axis=1)),
            f"{100 * float(whole.cage_slip[0]):.3g}",
            ", ".join(f"{100 * slip:.3g}" for slip in apart.cage_slip.values),
            ", ".join(f"{largest:.3g}" for largest in force), float(top),
        ), flush=True)  # fmt: skip


def choices(laws: Laws) -> None:
    """What the choices for the cage change under 14B."""
    case = Case(
        loads=HubLoads.bundled("14B").window(BEGIN, BEGIN + SPAN),
        laws=laws,
        dynamics="whole-bearing",
    )
    described = {
        "default": Cage(),
        "gap 0.2 mm": Cage(gap=2e-4),
        "gap 1 mm": Cage(gap=1e-3),
        "mass 35 kg": Cage(mass=35.0),
        "mass 60 kg": Cage(mass=60.0),
        "without weight": Cage(weight=False),
        "a cage a row": Cage(arrangement="per-row"),
        "guide friction 50 N": Cage(guide_friction=50.0),
        "random offsets": Cage(offsets="random"),
        "diameters ± 0.5 µm": Cage(diameter_scatter=0.5e-6),
        "diameters ± 1.5 µm": Cage(diameter_scatter=1.5e-6),
    }
    heading(
        "cage", "downwind raceways [J]", "downwind cage [J]", "upwind raceways [J]", "upwind cage [J]", "slip [%]",
        "largest spar force downwind, upwind [N]", "over the top [N]",
    )  # fmt: skip
    changed = {name: replace(case, cage=cage) for name, cage in described.items()}
    if laws.asks_for_oil:
        changed |= {
            f"oil_supply: {supply}": replace(case, oil_supply=supply) for supply in ("flooded", 0.7)
        }
    for name, changed_case in changed.items():
        result = simulate(changed_case)
        force = result.largest_pocket_force.max(("roller", "side")).values
        top = result.largest_force_by_position.where(
            abs(result.position - np.pi / 2) < np.radians(30)
        ).max()
        slip = ", ".join(f"{100 * part:.3g}" for part in result.cage_slip.values)
        print(
            cells(
                name,
                *(float(x) for x in energies(result).ravel()),
                slip,
                ", ".join(f"{x:.3g}" for x in force),
                float(top),
            ),
            flush=True,
        )


def supply() -> None:
    """The cage of 14B on imposed orbits and in the whole bearing by the supply of oil."""
    heading(
        "oil_supply",
        "downwind cage, imposed [J]",
        "whole/imposed",
        "upwind cage, imposed [J]",
        "whole/imposed",
    )
    loads = HubLoads.bundled("14B").window(BEGIN, BEGIN + SPAN)
    for name in ("flooded", "skf", 0.7):
        case = Case(loads=loads, laws=PHYSICAL, oil_supply=name)
        imposed, whole = (
            energies(simulate(case))[:, 1],
            energies(simulate(replace(case, dynamics="whole-bearing")))[:, 1],
        )
        print(
            cells(
                name, *(x for k in (0, 1) for x in (float(imposed[k]), share(whole[k], imposed[k])))
            ),
            flush=True,
        )


def radial(laws: Laws, duration: float = 30.0, cage: Cage = Cage()) -> Case:
    """A bearing under its rotor's weight alone, 343 kN down at rated speed."""
    loads = BearingLoads.constant([0.0, -343e3, 0.0], RATED, duration)
    return Case(loads=loads, laws=laws, dynamics="whole-bearing", cage=cage)


def places(laws: Laws) -> None:
    """Largest force of a spar by place on the orbit; a roller goes from the bottom (270°) by the left (0°) to the top (90°)."""
    heading("row", *(f"{30 * k}°" for k in range(12)))
    result = simulate(radial(laws))
    for row in result.row.values:
        force = result.largest_force_by_position.sel(row=row).values
        # Sectors of 30° about 0°, 30° …
        print(
            cells(row, *(f"{x:.3g}" for x in np.roll(force, 3).reshape(12, 6).max(axis=1))),
            flush=True,
        )


def dry() -> None:
    """Dry impacts: energies and cost."""
    case = Case(
        loads=HubLoads.bundled("14B").window(BEGIN, BEGIN + 10.0),
        laws=PAPER,
        dynamics="whole-bearing",
    )
    heading(
        "spars", "downwind cage [J]", "upwind cage [J]", "impacts and films take [J]", "largest force [N]", "steps a second",
        "times real time",
    )  # fmt: skip
    described = {"squeeze film": Cage()} | {
        f"dry, D {damping:g} s/m": Cage(impact="dry", damping=damping)
        for damping in (10.0, 50.0, 250.0)
    }
    for name, cage in described.items():
        result, spent = timed(replace(case, cage=cage))
        energy = energies(result)
        steps = int((result.steps + result.rejections).max()) / 10.0
        force = float(result.largest_pocket_force.max())
        lost = float(result.pocket_loss[-1])
        print(
            cells(
                name,
                float(energy[0, 1]),
                float(energy[1, 1]),
                lost,
                force,
                f"{steps:.0f}",
                10.0 / spent,
            ),
            flush=True,
        )


def tolerance() -> None:
    """Energies under 14B by tolerance, with the cage's weight and without."""
    heading(
        "cage", "tolerance", "downwind raceways [J]", "downwind cage [J]", "upwind raceways [J]", "upwind cage [J]",
        "energy residual [J]",
    )  # fmt: skip
    loads = HubLoads.bundled("14B").window(BEGIN, BEGIN + 30.0)
    for name, cage in (("default", Cage()), ("without weight", Cage(weight=False))):
        for value in (2e-3, 2e-4, 2e-5):
            case = Case(
                loads=loads,
                laws=PAPER,
                dynamics="whole-bearing",
                cage=cage,
                integrator=Radau(tolerance=value),
            )
            result = simulate(case)
            cells_of_energy = [f"{x:.5g}" for x in energies(result).ravel()]
            print(
                cells(name, value, *cells_of_energy, float(result.energy_residual[-1])), flush=True
            )


def scatter() -> None:
    """Energy of the downwind cage under 14B by initial offsets drawn at random, at two tolerances."""
    heading(
        "tolerance",
        "downwind cage, mean of 5 draws [J]",
        "standard deviation [J]",
        "upwind cage, mean [J]",
        "standard deviation [J]",
    )
    loads = HubLoads.bundled("14B").window(BEGIN, BEGIN + 30.0)
    for value in (2e-4, 2e-5):
        energy_of_draws = []
        for seed in range(1, 6):
            cage = Cage(offsets="random", seed=seed)
            case = Case(
                loads=loads,
                laws=PAPER,
                dynamics="whole-bearing",
                cage=cage,
                integrator=Radau(tolerance=value),
            )
            energy_of_draws.append(energies(simulate(case))[:, 1])
        mean, deviation = np.mean(energy_of_draws, axis=0), np.std(energy_of_draws, axis=0, ddof=1)
        print(
            cells(value, *(f"{x:.4g}" for k in (0, 1) for x in (mean[k], deviation[k]))), flush=True
        )


def operation(laws: Laws) -> None:
    """Starts, stops, reversals, idling and an emergency stop, at 343 kN radial load."""
    series = {
        "start in 20 s, then rated speed for 20 s": ([0.0, 20.0, 40.0], [0.0, RATED, RATED]),
        "rated speed for 20 s, stop in 20 s": ([0.0, 20.0, 40.0], [RATED, RATED, 0.0]),
        "reversal in 10 s": ([0.0, 10.0, 20.0, 40.0], [RATED, RATED, -RATED, -RATED]),
        "idling at a tenth of the speed, 60 s": ([0.0, 60.0], [0.1 * RATED, 0.1 * RATED]),
        "emergency stop in 2 s": ([0.0, 10.0, 12.0, 20.0], [RATED, RATED, 0.0, 0.0]),
    }
    heading(
        "", "raceways, imposed / whole [J]", "cage, imposed / whole [J]", "largest spar force [N]"
    )
    for name, (times, speeds) in series.items():
        when = np.arange(0.0, times[-1] + 0.025, 0.05)
        force = np.tile([0.0, -343e3, 0.0], (when.size, 1))
        loads = BearingLoads(
            time=when, shaft_speed=np.interp(when, times, speeds), force=force, source=name
        )
        case = Case(loads=loads, laws=laws)
        imposed, whole = simulate(case), simulate(replace(case, dynamics="whole-bearing"))
        before, after = energies(imposed).sum(axis=0), energies(whole).sum(axis=0)
        pairs = (f"{before[k]:.3g} / {after[k]:.3g}" for k in (0, 1))
        print(cells(name, *pairs, float(whole.largest_pocket_force.max())), flush=True)


def long() -> None:
    """Rest of the books and cost of the orbits of a bearing with three rollers a row over many orbits."""
    from macroslip.bearing import Bearing

    bearing = Bearing.read("skf-240-600-bc").replace(rollers_per_row=3)
    heading(
        "orbits", "time of one core [s]", "momentum left open in the first, in the last tenth [N m s]",
        "impulse through the bearing in a tenth [N m s]", "energy left open in the first, in the last tenth [J]",
        "energy of the last tenth / of the second",
    )  # fmt: skip
    for orbits in (100, 1000, 10_000, 100_000):
        duration = orbits * 2.0 * np.pi / (RATED * 0.45397)
        loads = BearingLoads.constant([0.0, -12e3, 0.0], RATED, duration, step=1.0)
        cage = Cage(weight=False, mass=8.0)
        case = Case(loads=loads, laws=PAPER, bearing=bearing, dynamics="whole-bearing", cage=cage)
        result, spent = timed(case)
        at = result.sel(book_time=np.linspace(0.0, duration, 11), method="nearest")
        lost = np.diff((at.book_raceway_loss + at.book_friction_loss).values)
        momentum, energy = np.diff(at.momentum_residual.values), np.diff(at.energy_residual.values)
        impulse = float(abs(np.diff(at.book_inner_impulse.values)[-1]))
        print(
            cells(
                orbits, spent, f"{momentum[0]:.1e}, {momentum[-1]:.1e}", impulse,
                f"{energy[0]:.1e}, {energy[-1]:.1e}", f"{lost[-1] / lost[1]:.6f}",
            ), flush=True,
        )  # fmt: skip


def speed(laws: Laws) -> None:
    """Time of one core for all 600 s of load case 14B, after a first run that compiles."""
    heading(
        "spars",
        "simulated [s]",
        "time of one core [s]",
        "times real time",
        "steps",
        "contact evaluations",
    )
    for name, cage in (("squeeze film", Cage()), ("dry", Cage(impact="dry"))):
        loads = HubLoads.bundled("14B")
        case = Case(loads=loads, laws=laws, dynamics="whole-bearing", cage=cage)
        simulate(replace(case, loads=loads.window(BEGIN, BEGIN + 8.0)))
        result, spent = timed(case)
        steps = int((result.steps + result.rejections).max())
        span = loads.duration
        print(
            cells(name, span, spent, span / spent, steps, int(result.force_evaluations.max())),
            flush=True,
        )


def accuracy(laws: Laws) -> None:
    """Energies of 14B at the default tolerance over those at a finer one."""
    heading(
        "spars", "downwind raceways", "downwind cage", "upwind raceways", "upwind cage", "rolling resistance",
        "cage, a roller, most", "energy left open / lost",
    )  # fmt: skip
    runs = ("squeeze film", Cage(), 60.0, 2e-6), ("dry", Cage(impact="dry"), 8.0, 2e-5)
    for name, cage, span, fine in runs:
        loads = HubLoads.bundled("14B").window(BEGIN, BEGIN + span)
        case = Case(loads=loads, laws=laws, dynamics="whole-bearing", cage=cage)
        energy_of_runs, cages = [], []
        for integrator in (Radau(), Radau(tolerance=fine)):
            result = simulate(replace(case, integrator=integrator))
            cages.append(result.energy.sel(interface="cage").values)
            energy_of_runs.append(
                np.append(energies(result).ravel(), float(result.rolling_energy.sum()))
            )
            if len(energy_of_runs) == 1:
                lost = float(result.book_raceway_loss[-1] + result.book_friction_loss[-1])
                left = float(abs(result.energy_residual).max()) / lost
        parts = [
            f"{a / b - 1.0:+.1e}" if b > 0.0 else "–" for a, b in zip(*energy_of_runs, strict=True)
        ]
        most = abs(cages[0] / cages[1] - 1.0).max()
        print(cells(name, *parts, f"{most:.1e}", f"{left:.1e}"), flush=True)


def rollers(laws: Laws) -> None:
    """Time of one core by the number of rollers, under thrust in proportion to them."""
    from macroslip.bearing import Bearing

    heading("rollers", "time of one core [ms/s]", "steps a second", "µs a step and roller")
    for count in (7, 14, 28):
        bearing = Bearing.read("skf-240-600-bc").replace(rollers_per_row=count)
        loads = BearingLoads.constant([0.0, -12e3 * count, 4e3 * count], RATED, 60.0)
        cage = Cage(mass=50.0 * count / 28)
        case = Case(loads=loads, laws=laws, bearing=bearing, dynamics="whole-bearing", cage=cage)
        result, spent = min((timed(case) for _ in range(3)), key=lambda run: run[1])
        steps = int((result.steps + result.rejections).max())
        print(
            cells(2 * count, 1e3 * spent / 60.0, steps / 60.0, 1e6 * spent / (steps * 2 * count)),
            flush=True,
        )


BY_LAWS = {
    "cases": cases, "choices": choices, "places": places, "operation": operation, "speed": speed,
    "accuracy": accuracy, "rollers": rollers,
}  # fmt: skip
PARTS = {
    **{f"{name}-paper": partial(part, PAPER) for name, part in BY_LAWS.items()},
    **{f"{name}-physical": partial(part, PHYSICAL) for name, part in BY_LAWS.items()},
    "dry": dry,
    "tolerance": tolerance,
    "scatter": scatter,
    "long": long,
    "supply": supply,
}

if __name__ == "__main__":
    for part in sys.argv[1:] or PARTS:
        print(f"\n## {part}\n", flush=True)
        PARTS[part]()
