"""Speed of this state beside an earlier one: `python -m benchmarks.pair REVISION`.

Both states integrate the same rollers in turns, each in a process and with compiled kernels of its own, so that a loss of
speed is seen when it is made; with `--whole` the whole bearing too. CPU time counts, the least of several turns; a ratio
below 1 is a loss. The scatter is that of the ratios of single turns.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import NamedTuple

#: The state that `make check` compares with: the last one before this round of changes.
LAST_STATE = "151e2ce3"
ROOT = Path(__file__).parents[1]
#: Runs of each length in a process, of which the fastest counts.
_RUNS = 2


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

#: What both states run, after a run that compiles. Rollers beyond the first of each row are timed by
#: difference, or the whole bearing beyond its first two seconds: what a case costs beside them is left out.
_DRIVER = """
import inspect, json, sys, time
from macroslip import Cage, Case, HubLoads, Laws, simulate

dynamics, model, impact, supply = sys.argv[1:5]
runs = int(sys.argv[5])
loads = HubLoads.bundled("14B")
if dynamics == "whole-bearing":
    beyond = 20.0 if impact == "dry" else 100.0
    common = {"dynamics": dynamics, "cage": Cage(impact=impact)}
    small = {"loads": loads.window(0.0, 2.0)}
    large = {"loads": loads.window(0.0, 2.0 + beyond)}
else:
    rollers = list(range(28))
    beyond = 2 * (len(rollers) - 1) * loads.duration
    common = {"loads": loads}
    small = {"rollers": rollers[:1]}
    large = {"rollers": rollers}

if supply and "oil_supply" in inspect.signature(Case).parameters:
    common["oil_supply"] = supply

def spent(part):
    laws = {"paper": Laws.paper, "physical": Laws.physical}[model]()
    case = Case(laws=laws, contact_details=False, **common, **part)
    start = time.process_time()
    result = simulate(case, threads=1)
    return time.process_time() - start, result["force_evaluations"].values

spent(small)
spent(large)
few = [spent(small) for _ in range(runs)]
many = [spent(large) for _ in range(runs)]
# A whole bearing gives each of its rollers the evaluations of all.
count = (lambda x: int(x.max())) if dynamics == "whole-bearing" else (lambda x: int(x.sum()))
print(json.dumps({
    "beyond": beyond,
    "small": min(seconds for seconds, _ in few),
    "large": min(seconds for seconds, _ in many),
    "evaluations": count(many[0][1]) - count(few[0][1]),
}))
"""


class Turn(NamedTuple):
    """What one process measured of one state."""

    beyond: float  #: Time that the larger run has beyond the smaller one, of all its rollers [s]
    small: float  #: CPU time of the smaller run [s]
    large: float  #: CPU time of the larger run [s]
    evaluations: int  #: Force evaluations of the larger run beyond those of the smaller one


def times_real_time(turns: list[Turn]) -> float:
    """Time of the history over CPU time, of one roller or of the whole bearing [-]."""
    large = min(turn.large for turn in turns)
    small = min(turn.small for turn in turns)
    return turns[0].beyond / (large - small)


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


def run(sources: Path, kernels: Path, setting: Setting) -> Turn:
    """Time one state in a process of its own."""
    environment = os.environ | {
        "PYTHONPATH": str(sources),
        "NUMBA_CACHE_DIR": str(kernels),
        "OPENBLAS_NUM_THREADS": "1",
    }
    done = subprocess.run(
        [sys.executable, "-c", _DRIVER, *setting[1:], str(_RUNS)],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    return Turn(**json.loads(done.stdout))


def compare(
    revision: str, turns: int, settings: tuple[Setting, ...]
) -> Iterator[tuple[Setting, list[Turn], list[Turn]]]:
    """Turns of the earlier state and of this one, by setting."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        earlier = unpack(revision, folder / "before"), folder / "kernels_before"
        present = ROOT / "src", folder / "kernels_now"
        for setting in settings:
            before = []
            now = []
            for _ in range(turns):
                before.append(run(*earlier, setting))
                now.append(run(*present, setting))
            yield setting, before, now


def row(setting: Setting, before: list[Turn], now: list[Turn]) -> str:
    """Line of the table that is printed."""
    earlier = times_real_time(before)
    present = times_real_time(now)
    single = [
        times_real_time([new]) / times_real_time([old])
        for old, new in zip(before, now, strict=True)
    ]
    scatter = f"{min(single):.2f} to {max(single):.2f}"
    return (
        f"{setting.name:22s} {earlier:22,.1f} {present:9,.1f} {present / earlier:7.2f} {scatter:>14s}"
        f" {before[0].evaluations:21,d} {now[0].evaluations:10,d}"
    )


def main() -> None:
    """Print a table of both states."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.pair", description=__doc__)
    parser.add_argument("revision", nargs="?", default=LAST_STATE, help="the earlier state")
    parser.add_argument("--turns", type=int, default=2, help="processes of each state")
    parser.add_argument("--whole", action="store_true", help="the whole bearing too")
    wanted = parser.parse_args()
    if wanted.revision == LAST_STATE and not is_known(LAST_STATE):
        print(f"{LAST_STATE} is not in this copy of the sources: nothing to compare with")
        return
    settings = IMPOSED + WHOLE if wanted.whole else IMPOSED
    print(
        "14B, one thread; 600 s of 28 rollers a row less one, 100 s of the whole bearing (dry 20 s);"
        f" before: {wanted.revision}"
    )
    print(
        "setting               times real time: before       now   ratio   single turns"
        "   evaluations: before        now"
    )
    for measured in compare(wanted.revision, wanted.turns, settings):
        print(row(*measured), flush=True)


if __name__ == "__main__":
    main()
