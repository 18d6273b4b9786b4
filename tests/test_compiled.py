"""The compile cache: shared by processes, never stale, and never in the way of a process without somebody's law."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import macroslip

SOURCE = Path(macroslip.__file__).parents[1]

LAW = """
from typing import NamedTuple
from macroslip.compiled import jit
from macroslip.traction.traction_law import register

class Linear(NamedTuple):
    conductance: float

def prepare(interface):
    return Linear({conductance})

@jit
def traction(law, load, film_thickness, slip):
    return law.conductance * slip * FACTOR, law.conductance * FACTOR, 0.0, 0.0

FACTOR = {factor}

@jit
def rising_slip(law, load, film_thickness):
    return 1e30

register("linear", Linear, reference="a test", prepare=prepare, traction=traction, rising_slip=rising_slip)
"""

RUN = """
import sys
sys.path.insert(0, sys.argv[1])
name = "mechanisms"
if sys.argv[2] == "law":
    import own_law
    name = "linear"
from macroslip import BearingLoads, Case, Laws, Window, simulate
loads = BearingLoads.constant([0.0, 0.0, -1e3], 2.0, 1.0)
found = simulate(Case(loads=loads, rollers=[0], laws=Laws(traction=name), window=Window(start=0.0)))
print(repr(float(found.end_slip.sel(row="downwind").item())))
"""


@pytest.fixture
def copy(tmp_path):
    """A copy of the package with an empty cache of its own."""
    shutil.copytree(SOURCE / "macroslip", tmp_path / "src" / "macroslip", ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path


def run(copy, which):
    environment = os.environ | {"PYTHONPATH": str(copy / "src")}
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", RUN, str(copy), which], env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return float(done.stdout)


def test_laws_of_ones_own_and_the_cache(copy):
    """One copy, four processes: plain, with a law, with the law changed, and plain again."""
    plain = run(copy, "plain")
    law = copy / "own_law.py"
    law.write_text(LAW.format(conductance=0.2, factor=1.0), encoding="utf-8")
    own = run(copy, "law")
    assert own != pytest.approx(plain, rel=1e-3)
    law.write_text(LAW.format(conductance=0.2, factor=2.0), encoding="utf-8")
    changed = run(copy, "law")
    assert changed != pytest.approx(own, rel=1e-2)
    # A process that has never heard of the law reads the shared cache and gets the old answer to the last bit.
    assert run(copy, "plain") == plain


def test_elementwise_broadcasts_and_keeps_scalars():
    from macroslip.compiled import elementwise, jit

    double = elementwise(jit(lambda x, y: 2.0 * x + y))
    assert double(1.0, 2.0) == 4.0
    assert np.ndim(double(1.0, 2.0)) == 0
    assert double(np.array([1.0, 2.0]), np.array([[0.0], [1.0]])).tolist() == [[2.0, 4.0], [3.0, 5.0]]
