"""Golden numbers: what the program computed at a known state, and how far a later state may be from it.

python -m tools.golden --check [--only imposed-paper]     compares, and prints the worst ratio of error to bound
python -m tools.golden --verdicts results/summary.json    compares what `make reproduce` says of the paper
python -m tools.golden --write [--only imposed-paper]     computes them anew, in a commit that names the fault it mends

Numbers are those of tight tolerances (`TIGHT`), at which no tables were used. A check computes with those of `LOOSE`. Its
bounds are the promised ones (`NOMINAL`). Where the program kept less, or hardly that, when the numbers were written, a bound is three
times what it was off by then, so that a state that is as converged passes.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path

import numpy as np

from macroslip import BearingLoads, Cage, Case, HubLoads, Laws, Radau, Window, simulate

FILE = Path(__file__).parents[1] / "tests" / "golden" / "numbers.json"
VERDICTS = FILE.with_name("verdicts.json")
MODELS = {"paper": Laws.paper, "physical": Laws.physical}
#: Bundled histories with their first and last time [s], and rollers of both rows.
HISTORIES = {
    "12A": (300.0, 340.0),
    "14B": (100.0, 140.0),
    "18C": (300.0, 340.0),
    "24A": (60.0, 100.0),
}
ROLLERS = [0, 9]
#: Tolerances of numbers and of checks, by kind of case.
TIGHT = {"imposed": 1e-7, "short": 1e-7, "film": 1e-7, "dry": 1e-6}
LOOSE = {"imposed": 1e-5, "short": 1e-5, "film": 2e-6, "dry": 2e-6}
#: Nominal bounds, relative to a variable's scale, which `errors` has.
ENERGIES = (
    "energy",
    "rolling_energy",
    "asperity_energy",
    "mechanism_energy",
    "orbit_energy",
    "energy of rows",
)
PEAKS = ("peak_power", "flash_temperature", "power_density", "slide_roll_ratio", "min_film_ratio",
         "surface_power_density by angle", "surface_power_density by station")  # fmt: skip
NOMINAL = {
    "imposed": {
        **dict.fromkeys(ENERGIES, 1e-4),
        **dict.fromkeys(PEAKS, 1e-2),
        "min_spin_ratio": 1e-4,
    },
    "film": {**dict.fromkeys(ENERGIES, 5e-4), **dict.fromkeys(PEAKS, 1e-2), "min_spin_ratio": 2e-3},
    "dry": {**dict.fromkeys(ENERGIES, 2e-2), **dict.fromkeys(PEAKS, 2e-2), "min_spin_ratio": 1e-2},
}
NOMINAL["short"] = NOMINAL["imposed"]
#: One force of all: under the physical laws 1e-14 m of gap change the largest by 4 %, while quantiles of rollers stay within 1 %.
NOMINAL["dry"]["largest_pocket_force"] = 0.1
#: Maps, stations and shares that have no promise of their own: of their largest value, or as converged as today. Dry impacts
#: are chaotic: at neighbouring tolerances the cage's slip differs by 0.4 %.
OTHERS = {"imposed": 1e-3, "short": 1e-3, "film": 1e-3, "dry": 2e-2}
#: Counts of the integrator, and books that are round-off.
LEFT_OUT = ("steps", "rejections", "force_evaluations", "unbalanced_force", "quadrature_error", "end_time", "end_slip",
            "momentum_residual", "energy_residual", "spin", "slip", "outside_film_range", "roller_load", "cage_force")  # fmt: skip
QUANTILES = (0.1, 0.5, 0.9, 1.0)


def _short(shaft, force=lambda t: np.tile([20e3, -300e3, 60e3], (t.size, 1))) -> BearingLoads:
    times = np.linspace(0.0, 20.0, 401)
    return BearingLoads(times, shaft(times), force(times), "golden")


def _step(times: np.ndarray) -> np.ndarray:
    return np.outer(np.where(times < 10.0, 1.0, 2.0), [10e3, -200e3, 30e3])


SHORT = {
    "reversal": lambda: _short(lambda t: 2.1 * np.cos(np.pi * t / 10.0)),
    "standstill": lambda: _short(np.zeros_like),
    "step": lambda: _short(lambda t: np.full_like(t, 2.1), _step),
    "constant": lambda: _short(lambda t: np.full_like(t, 2.1)),
}


def cases() -> dict[str, tuple[str, dict]]:
    """Kind and settings of every case by its name, without tolerance."""
    golden_cases = {}
    for model, laws in MODELS.items():
        for name, (start, end) in HISTORIES.items():
            settings = {
                "loads": lambda n=name, s=start, e=end: HubLoads.bundled(n).window(s, e),
                "laws": laws(),
            }
            golden_cases[f"imposed-{model}-{name}"] = "imposed", {**settings, "rollers": ROLLERS}
        for name, loads in SHORT.items():
            settings = {
                "loads": loads,
                "laws": laws(),
                "rollers": ROLLERS,
                "window": Window(start=0.0),
            }
            golden_cases[f"short-{model}-{name}"] = "short", settings
        for kind, name, last in (("film", "14B", 10.0), ("film", "24A", 10.0), ("dry", "14B", 4.0)):
            last = (
                last if model == "paper" else 0.4 * last
            )  # by the laws it takes some ten times as long
            start = HISTORIES[name][0]
            settings = {
                "loads": lambda n=name, s=start, e=start + last: HubLoads.bundled(n).window(s, e), "laws": laws(),
                "dynamics": "whole-bearing", "window": Window(start=start + 1.0),
                "cage": Cage(impact="dry" if kind == "dry" else "squeeze-film"),
            }  # fmt: skip
            golden_cases[f"{kind}-{model}-{name}"] = kind, settings
    return golden_cases


def compute(kind: str, case_settings: dict, tolerance: float) -> dict[str, np.ndarray]:
    """Variables of a result as arrays; of maps sums and largest values, of dry impacts quantiles over the rollers."""
    settings = {
        **case_settings,
        "loads": case_settings["loads"](),
        "integrator": Radau(tolerance=tolerance),
    }
    result, arrays = simulate(Case(**settings)), {}
    speed = settings["loads"].shaft_speed
    if speed.min() < 0.0 < speed.max():
        # Both spins and the entrainment speed pass zero: the least of these ratios means nothing there.
        result = result.drop_vars(
            ["min_spin_ratio", "slide_roll_ratio", "min_film_ratio"], errors="ignore"
        )
    kept = {name: values for name, values in result.data_vars.items() if name not in LEFT_OUT}
    if "surface_energy" in kept:
        energy = kept.pop("surface_energy")
        kinds = ("slip_sign", "film_regime")
        kept["surface_energy by angle"] = energy.sum(("station", *kinds)).coarsen(angle=6).sum()
        kept["surface_energy by station"] = energy.sum(("angle", *kinds))
        kept["surface_energy by kind"] = energy.sum(("angle", "station"))
        density = kept.pop("surface_power_density")
        kept["surface_power_density by angle"] = density.max("station").coarsen(angle=6).max()
        kept["surface_power_density by station"] = density.max("angle")
    if settings.get("dynamics") == "whole-bearing":
        # Rollers of a bearing share what its cage takes from them; rows are known better than each of them.
        kept["energy of rows"] = result.energy.sum("roller", skipna=False)
    for name, values in kept.items():
        if "time" in values.dims or not values.size or name.startswith("book_"):
            continue
        array = values.values.astype(float)
        if kind == "dry" and "roller" in values.dims and name != "status":
            array = np.quantile(array, QUANTILES, axis=values.dims.index("roller"))
        arrays[name] = array
    return arrays


def errors(kind: str, computed: np.ndarray, stored: np.ndarray, name: str) -> float:
    """Largest difference over the scale; infinite where shapes differ, or one is a number and the other not.

    Energies are measured by themselves, or by a hundredth of the largest of all rollers where that is more; other
    variables by the largest, but the ratio of spins, which is a ratio already.
    """
    if computed.shape != stored.shape or (np.isnan(computed) != np.isnan(stored)).any():
        return np.inf
    known = ~np.isnan(stored)
    largest = float(np.max(np.abs(stored[known]), initial=0.0))
    if name == "min_spin_ratio":
        scale = np.maximum(np.abs(stored), 0.1)
    elif name in ENERGIES and name != "mechanism_energy" and kind != "dry":
        scale = np.maximum(np.abs(stored), 0.01 * largest)
    else:
        scale = np.full(stored.shape, largest)
    different = np.abs(computed - stored)
    return float(np.max(different[known] / np.maximum(scale[known], 1e-12), initial=0.0))


def nominal(kind: str, name: str) -> float:
    """The bound a variable is promised; 0 for the status."""
    return 0.0 if name == "status" else NOMINAL[kind].get(name, OTHERS[kind])


def write(only: str) -> None:
    """Compute the numbers of the chosen cases, with their bounds, and store them beside the others."""
    for case, (kind, settings) in cases().items():
        if only not in case:
            continue
        began = time.process_time()
        right, loose = compute(kind, settings, TIGHT[kind]), compute(kind, settings, LOOSE[kind])
        bounds = {}
        for name, values in right.items():
            spread, promised = errors(kind, loose[name], values, name), nominal(kind, name)
            bounds[name] = promised if 1.5 * spread <= promised else float(f"{3.0 * spread:.2g}")
            if spread > promised:
                print(
                    f"{case:26} {name:24} promised {promised:.1e}, today's spread {spread:.1e}",
                    flush=True,
                )
        plain = {
            name: np.vectorize(lambda x: float(f"{x:.7g}"))(values).tolist()
            for name, values in right.items()
        }
        stored = json.loads(FILE.read_text()) if FILE.exists() else {}
        stored[case] = {"bounds": bounds, "values": plain}
        print(f"{case:26} {time.process_time() - began:6.1f} s of CPU", flush=True)
        FILE.parent.mkdir(parents=True, exist_ok=True)
        lines = [f'"{case}": {json.dumps(content)}' for case, content in sorted(stored.items())]
        FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n")


def check(only: str) -> dict[str, tuple[float, str]]:
    """The worst ratio of error to bound of every chosen case, and the variable it belongs to."""
    stored, worst = json.loads(FILE.read_text()), {}
    for case, (kind, settings) in cases().items():
        if only not in case:
            continue
        computed, ratios = compute(kind, settings, LOOSE[kind]), {}
        for name, values in stored[case]["values"].items():
            error = (
                errors(kind, computed[name], np.array(values, float), name)
                if name in computed
                else np.inf
            )
            bound = stored[case]["bounds"][name]
            ratios[name] = error / bound if bound else (0.0 if error == 0.0 else np.inf)
        name = max(ratios, key=lambda each: ratios[each])
        worst[case] = ratios[name], name
    return worst


def check_verdicts(summary: Path) -> list[str]:
    """Verdicts in a `summary.json` of `make reproduce` that are not as stored, in words."""
    verdicts_now = {
        statement["paper"]: statement["models"]
        for statement in json.loads(summary.read_text())["statements"]
    }
    return [
        f"{paper} ({model}): {verdict} before, now {verdicts_now.get(paper, {}).get(model, {}).get('verdict')}"
        for paper, models in json.loads(VERDICTS.read_text()).items()
        for model, verdict in models.items()
        if verdicts_now.get(paper, {}).get(model, {}).get("verdict") != verdict
    ]


def main() -> int:
    """Write or check; 1 where a number is out of its bound."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--write", action="store_true", help="compute the numbers anew")
    parser.add_argument("--check", action="store_true", help="compare with the stored numbers")
    parser.add_argument(
        "--only", default="", help="part of the name of the cases to take, such as imposed-paper"
    )
    parser.add_argument(
        "--verdicts", type=Path, help="compare the summary.json that `make reproduce` has written"
    )
    chosen = parser.parse_args()
    if chosen.verdicts:
        changed = check_verdicts(chosen.verdicts)
        print("\n".join(changed) or "the verdicts are as they were")
        return int(bool(changed))
    if chosen.write:
        write(chosen.only)
    if not chosen.check:
        return 0
    worst = check(chosen.only)
    for case, (ratio, name) in worst.items():
        print(f"{case:26} {ratio:8.3f}  {name}")
    return int(any(ratio > 1.0 for ratio, _ in worst.values()))


if __name__ == "__main__":
    raise SystemExit(main())
