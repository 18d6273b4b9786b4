"""An interrupt ends a running computation at once, however long the roller under way would take."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time

import psutil
import pytest

pytestmark = pytest.mark.slow

#: Processor time from the interrupt to what follows the call [s]; by the clock another process may have its part of it.
PROMISED = 2.0

PROGRAM = """
import signal
import time

from macroslip import BackwardEuler, BearingLoads, Case, Laws, Radau, run_study, simulate
from macroslip.study.study_file import study_of

# Tests that run in the background of a shell leave interrupts to be ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)
# Without tables, whose making is waited for, and with few samples: a second later it integrates.
laws = Laws.paper()


def of(seconds, integrator):
    loads = BearingLoads.constant([0.0, -3e5, 0.0], 2.0, seconds, step=0.1 * seconds)
    return Case(loads=loads, laws=laws, rollers=[0, 1], integrator=integrator)


simulate(of(1.0, {integrator}))
print("ready", flush=True)
try:
    {slow}
except KeyboardInterrupt:
    print("interrupted", time.process_time(), flush=True)
"""

#: Two runs of two rollers each, which take seven seconds.
STUDY = {
    "case": {
        "rollers": [0],
        "laws": {"model": "paper"},
        "integrator": {"tolerance": 1e-10, "max_steps": 10**9},
    },
    "loads": {"bundled": ["14B", "24A"]},
}


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT to send to another process")
@pytest.mark.parametrize(
    ("integrator", "slow"),
    [
        ("Radau()", "simulate(of(2e3, Radau(tolerance=1e-10, max_steps=10**12)))"),
        (
            "BackwardEuler(step=0.01, tolerance=1e-9)",
            "simulate(of(1e3, BackwardEuler(step=1e-5, tolerance=1e-9)))",
        ),
        ("Radau()", f"run_study(study_of({STUDY}, '.'), 'out', threads=2)"),
    ],
    ids=["radau", "backward-euler", "two runs of a study at once"],
)
def test_an_interrupt_does_not_wait_for_the_roller_under_way(integrator, slow, tmp_path):
    program = PROGRAM.format(integrator=integrator, slow=slow)
    command = [sys.executable, "-c", program]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=tmp_path) as process:
        try:
            assert process.stdout.readline() == "ready\n"
            time.sleep(1.0)
            assert process.poll() is None
            before = psutil.Process(process.pid).cpu_times()
            process.send_signal(signal.SIGINT)
            printed, _ = process.communicate(timeout=60.0)
            word, spent = printed.split()
            assert word == "interrupted" and process.returncode == 0
            assert float(spent) - (before.user + before.system) < PROMISED
        finally:
            process.kill()
