"""An interrupt ends a running computation at once, however long the roller under way would take."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time

import pytest

pytestmark = pytest.mark.slow

#: Seconds from the interrupt to the end of the process.
PROMISED = 2.0

PROGRAM = """
import signal

from macroslip import BackwardEuler, BearingLoads, Case, Laws, Radau, simulate

# Tests that run in the background of a shell leave interrupts to be ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)
integrator, slow = {integrator}, {slow}
laws = Laws.physical()
simulate(Case(loads=BearingLoads.constant([0.0, -3e5, 0.0], 2.0, 1.0), laws=laws, rollers=[0], integrator=integrator))
print("ready", flush=True)
try:
    simulate(Case(loads=BearingLoads.constant([0.0, -3e5, 0.0], 2.0, 1e4), laws=laws, rollers=[0, 1], integrator=slow))
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT to send to another process")
@pytest.mark.parametrize(
    ("integrator", "slow"),
    [
        ("Radau()", "Radau(tolerance=1e-10, max_steps=10**12)"),
        ("BackwardEuler(step=0.01, tolerance=1e-9)", "BackwardEuler(step=1e-5, tolerance=1e-9)"),
    ],
    ids=["radau", "backward-euler"],
)
def test_an_interrupt_does_not_wait_for_the_roller_under_way(integrator, slow):
    program = PROGRAM.format(integrator=integrator, slow=slow)
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout.readline() == "ready\n"
            time.sleep(1.0)
            assert process.poll() is None
            start = time.monotonic()
            process.send_signal(signal.SIGINT)
            found, _ = process.communicate(timeout=60.0)
            assert found == "interrupted\n" and process.returncode == 0
            assert time.monotonic() - start < PROMISED
        finally:
            process.kill()
