"""Speed of this state beside an earlier one: `python -m benchmarks.pair REVISION`.

Both states integrate the same rollers in turns, each in a process and with compiled kernels of its own, so that a loss of
speed is seen when it is made; with `--whole` the whole bearing too. CPU time counts, the least of several turns; a ratio
below 1 is a loss.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tarfile
import tempfile
from io import BytesIO
from pathlib import Path
from typing import NamedTuple

#: The state that `make check` compares with: the last one before this round of changes.
LAST_STATE = "8cf7cf05"
ROOT = Path(__file__).parents[1]


class Setting(NamedTuple):
    """What is timed."""

    name: str
    dynamics: str
    model: str
    impact: str = "squeeze-film"  #: How a roller meets a spar of the cage
    supply: str = ""  #: Oil supply, where it is not the default; the first states were flooded


IMPOSED = (
    Setting("paper", "imposed-orbit", "paper"),
    Setting("physical", "imposed-orbit", "physical"),
    Setting("physical, flooded", "imposed-orbit", "physical", supply="flooded"),
)
WHOLE = (
    Setting("whole, paper", "whole-bearing", "paper"),
    Setting("whole, physical", "whole-bearing", "physical"),
    Setting("whole, physical, dry", "whole-bearing", "physical", "dry"),
)

#: What both states run. Rollers beyond the first of each row are timed by difference, or the whole
#: bearing beyond its first two seconds: what a case costs beside them is left out.
_DRIVER = """
import inspect, json, sys, time
from macroslip import Cage, Case, HubLoads, Laws, simulate

dynamics, model, impact, supply = sys.argv[1:5]
turns = int(sys.argv[5])
loads = HubLoads.bundled("14B")
if dynamics == "whole-bearing":
    beyond = 3.0 if impact == "dry" else 10.0
    common = {"dynamics": dynamics, "cage": Cage(impact=impact)}
    small = {"loads": loads.window(0.0, 2.0)}
    large = {"loads": loads.window(0.0, 2.0 + beyond)}
else:
    beyond = 10 * loads.duration
    common = {"loads": loads}
    small = {"rollers": [0]}
    large = {"rollers": list(range(6))}

if supply and "oil_supply" in inspect.signature(Case).parameters:
    common["oil_supply"] = supply

def spent(part):
    laws = {"paper": Laws.paper, "physical": Laws.physical}[model]()
    case = Case(laws=laws, contact_details=False, **common, **part)
    start = time.process_time()
    result = simulate(case, threads=1)
    return time.process_time() - start, result

spent(small)
few = min(spent(small)[0] for _ in range(turns))
many, result = min((spent(large) for _ in range(turns)), key=lambda pair: pair[0])
print(json.dumps({
    "times_real_time": beyond / (many - few),
    "evaluations": int(result["force_evaluations"].sum()),
    "energy": float(result["energy"].sum()),
}))
"""


class Speed(NamedTuple):
    """What one state gave for one setting."""

    #: Time of the history over CPU time, of one roller or of the whole bearing [-]
    times_real_time: float
    evaluations: int  #: Force evaluations
    energy: float  #: Their frictional energy [J]


def is_known(revision: str) -> bool:
    """True if the sources lie in a clone that holds a revision."""
    command = ["git", "cat-file", "-e", f"{revision}^{{commit}}"]
    try:
        return subprocess.run(command, cwd=ROOT, capture_output=True, check=False).returncode == 0
    except FileNotFoundError:  # no git
        return False


def unpack(revision: str, folder: Path) -> Path:
    """Unpack the package of a revision into a folder; returns the folder of its sources.

    Raises SystemExit with git's words where there is no such revision.
    """
    archive = subprocess.run(
        ["git", "archive", revision, "src"], cwd=ROOT, capture_output=True, check=False
    )
    if archive.returncode:
        sys.exit(f"{revision} cannot be unpacked: {archive.stderr.decode().strip()}")
    with tarfile.open(fileobj=BytesIO(archive.stdout)) as packed:
        packed.extractall(folder, filter="data")
    return folder / "src"


def run(sources: Path, kernels: Path, setting: Setting, turns: int) -> Speed:
    """Time one state in a process of its own."""
    environment = os.environ | {"PYTHONPATH": str(sources), "NUMBA_CACHE_DIR": str(kernels)}
    done = subprocess.run(
        [sys.executable, "-c", _DRIVER, *setting[1:], str(turns)],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    return Speed(**json.loads(done.stdout))


def compare(
    revision: str, turns: int, settings: tuple[Setting, ...]
) -> dict[str, tuple[Speed, Speed]]:
    """Speeds of the earlier state and of this one, by setting, run in turns."""
    speeds = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        states = {
            "before": (unpack(revision, folder / "before"), folder / "kernels_before"),
            "now": (ROOT / "src", folder / "kernels_now"),
        }
        for setting in settings:
            runs: dict[str, list[Speed]] = {name: [] for name in states}
            for _ in range(turns):
                for name, (sources, kernels) in states.items():
                    runs[name].append(run(sources, kernels, setting, turns=2))
            # By its first field, a run's speed, the largest is the fastest.
            speeds[setting.name] = (max(runs["before"]), max(runs["now"]))
    return speeds


def main() -> None:
    """Print a table of both states."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.pair", description=__doc__)
    parser.add_argument("revision", nargs="?", default=LAST_STATE, help="the earlier state")
    parser.add_argument("--turns", type=int, default=2, help="runs of each state")
    parser.add_argument("--whole", action="store_true", help="the whole bearing too")
    wanted = parser.parse_args()
    if wanted.revision == LAST_STATE and not is_known(LAST_STATE):
        print(f"{LAST_STATE} is not in this copy of the sources: nothing to compare with")
        return
    settings = IMPOSED + WHOLE if wanted.whole else IMPOSED
    print(
        f"14B, one thread; 600 s of six rollers a row, 10 s of all (dry 3 s); before: {wanted.revision}"
    )
    print(
        "setting               times real time: before      now   ratio   evaluations: before       now"
    )
    for name, (before, now) in compare(wanted.revision, wanted.turns, settings).items():
        ratio = now.times_real_time / before.times_real_time
        print(
            f"{name:22s} {before.times_real_time:22,.1f} {now.times_real_time:8,.1f} {ratio:7.2f}"
            f" {before.evaluations:21,d} {now.evaluations:9,d}"
        )


if __name__ == "__main__":
    main()
