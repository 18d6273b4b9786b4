"""Kernels that another process compiles at a first run: those this process then finds, and none where it is not needed."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest
from numba import typeof

from macroslip import BearingLoads, Case
from macroslip.integrate import ahead
from macroslip.result import simulate as simulate_module

FIRST_RUN = """
from numba import typeof
from macroslip.integrate import ahead
from macroslip.integrate.radau import integrate_radau
ahead.compile_ahead(physical=False)
assert ahead._running is not None
ahead.wait_for_integrator()
assert ahead._is_stored(ahead.kernel_folder(), "integrate_radau")
integrate_radau.compile(tuple(map(typeof, ahead.integrator_arguments())))
print(sum(integrate_radau.stats.cache_hits.values()), sum(integrate_radau.stats.cache_misses.values()))
ahead.wait_for_all()
ahead.compile_ahead(physical=False)
assert ahead._running is None
"""


@pytest.fixture
def case():
    return Case(loads=BearingLoads.constant([0.0, -300e3, 0.0], 2.0, 1.0), rollers=[0])


def test_the_integrator_is_compiled_for_the_types_it_is_called_with(case, monkeypatch):
    called = []
    kernel = simulate_module.integrate_radau
    monkeypatch.setattr(simulate_module, "integrate_radau", lambda *args: called.append(args) or kernel(*args))
    simulate_module.simulate(case)
    assert called
    for arguments in called:
        assert tuple(map(typeof, arguments)) == tuple(map(typeof, ahead.integrator_arguments()))


def test_a_process_that_fails_is_not_waited_for(monkeypatch, tmp_path):
    monkeypatch.setattr(ahead, "kernel_folder", lambda: tmp_path)
    with subprocess.Popen([sys.executable, "-c", "raise SystemExit(1)"]) as failing:
        monkeypatch.setattr(ahead, "_running", failing)
        ahead.wait_for_integrator()
        ahead.wait_for_all()
    assert ahead._running is None


def test_nothing_is_started_where_nothing_can_be_stored(monkeypatch):
    monkeypatch.setattr(ahead, "kernel_folder", lambda: None)
    ahead.compile_ahead(physical=True)
    assert ahead._running is None
    ahead.wait_for_integrator()


@pytest.mark.slow
@pytest.mark.skipif(ahead.usable_processors() < 2, reason="one processor")
def test_a_first_run_finds_what_the_other_process_compiled(tmp_path):
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
    found = subprocess.run(
        [sys.executable, "-c", FIRST_RUN], env=environment, capture_output=True, text=True, timeout=300, check=False
    )
    assert found.returncode == 0, found.stderr
    assert found.stdout.split() == ["1", "0"]
