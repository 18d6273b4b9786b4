"""Speed of this state beside an earlier one: `python -m benchmarks.pair REVISION`.

Both states integrate the same rollers in turns, each in a process and with compiled kernels of its own, so that a loss of
speed is seen when it is made. CPU time counts, the least of several turns; a ratio below 1 is a loss.
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
LAST_STATE = "b2f5b5e"
MODELS = ("paper", "physical")
ROOT = Path(__file__).parents[1]

#: What both states run. Rollers beyond the first of each row are timed by difference: what a case costs beside them is left out.
_DRIVER = """
import json, sys, time
from macroslip import Case, HubLoads, Laws, simulate

model, turns = sys.argv[1], int(sys.argv[2])
laws = {"paper": Laws.paper, "physical": Laws.physical}[model]()
loads = HubLoads.bundled("14B")

def spent(rollers):
    case = Case(loads=loads, laws=laws, rollers=rollers, contact_details=False)
    start = time.process_time()
    result = simulate(case, threads=1)
    return time.process_time() - start, result

spent([0])
few = min(spent([0])[0] for _ in range(turns))
many, result = min((spent(list(range(6))) for _ in range(turns)), key=lambda pair: pair[0])
rollers = 10
print(json.dumps({
    "times_real_time": rollers * loads.duration / (many - few),
    "evaluations": int(result["force_evaluations"].sum()),
    "energy": float(result["energy"].sum()),
}))
"""


class Speed(NamedTuple):
    """What one state gave for one model."""

    times_real_time: float  #: Time of the history over CPU time, of one roller [-]
    evaluations: int  #: Force evaluations of twelve rollers
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


def run(sources: Path, kernels: Path, model: str, turns: int) -> Speed:
    """Time one state in a process of its own."""
    environment = os.environ | {"PYTHONPATH": str(sources), "NUMBA_CACHE_DIR": str(kernels)}
    done = subprocess.run(
        [sys.executable, "-c", _DRIVER, model, str(turns)],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    return Speed(**json.loads(done.stdout))


def compare(revision: str, turns: int) -> dict[str, tuple[Speed, Speed]]:
    """Speeds of the earlier state and of this one, by model, run in turns."""
    speeds = {}
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        states = {
            "before": (unpack(revision, folder / "before"), folder / "kernels_before"),
            "now": (ROOT / "src", folder / "kernels_now"),
        }
        for model in MODELS:
            runs: dict[str, list[Speed]] = {name: [] for name in states}
            for _ in range(turns):
                for name, (sources, kernels) in states.items():
                    runs[name].append(run(sources, kernels, model, turns=2))
            # By its first field, a run's speed, the largest is the fastest.
            speeds[model] = (max(runs["before"]), max(runs["now"]))
    return speeds


def main() -> None:
    """Print a table of both states."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.pair", description=__doc__)
    parser.add_argument("revision", nargs="?", default=LAST_STATE, help="the earlier state")
    parser.add_argument("--turns", type=int, default=2, help="runs of each state")
    given = parser.parse_args()
    if given.revision == LAST_STATE and not is_known(LAST_STATE):
        print(f"{LAST_STATE} is not in this copy of the sources: nothing to compare with")
        return
    print(f"14B, 600 s, six rollers a row, one thread; before: {given.revision}")
    print("model      times real time: before     now    ratio   evaluations: before       now")
    for model, (before, now) in compare(given.revision, given.turns).items():
        ratio = now.times_real_time / before.times_real_time
        print(
            f"{model:10s} {before.times_real_time:23,.0f} {now.times_real_time:7,.0f} {ratio:8.2f}"
            f" {before.evaluations:21,d} {now.evaluations:9,d}"
        )


if __name__ == "__main__":
    main()
