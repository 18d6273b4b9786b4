"""The cache of kernels: shared by processes, never stale, and never in the way of a process without somebody's law."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numba
import numpy as np
import pytest

import macroslip
from macroslip import kernel_cache
from macroslip.compiled import jit
from macroslip.kernel_cache import KEPT

pytestmark = pytest.mark.slow

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
    # A law is a tuple to its own functions.
    (conductance,) = law
    return conductance * slip * FACTOR, conductance * FACTOR, 0.0, 0.0

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
from macroslip import Bearing, Laws, Lubricant
from macroslip.roller.contact_force import raceway_force
from macroslip.roller.model import roller_model
laws = Laws(traction=name)
model = roller_model(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"), 1, tilt=0.0, laws=laws)
print(repr(raceway_force(model.inner, 2e4, 1e-4, -0.4, 0.4, -0.5).spin))
"""


@pytest.fixture
def copy(tmp_path):
    """A copy of the package with an empty cache of its own."""
    shutil.copytree(SOURCE / "macroslip", tmp_path / "src" / "macroslip", ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path


def run(copy, which):
    environment = os.environ | {"PYTHONPATH": str(copy / "src"), "NUMBA_CACHE_DIR": str(copy / "kernels")}
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


KERNEL = """
from macroslip.compiled import jit
from macroslip.contact.part_of_a_kernel import part

@jit
def kernel(x):
    return 2.0 * part(x)
"""

PART = """
from macroslip.compiled import jit_part

@jit_part
def part(x):
    return x + {number}
"""

ASK = """
import macroslip, numba
before = numba.config.CACHE_DIR
from macroslip.traction.kernel import kernel
assert numba.config.CACHE_DIR == before
print(kernel(1.0), sum(kernel.stats.cache_hits.values()), kernel.stats.cache_path)
"""

LATE_LAW = """
from macroslip.compiled import depend_on, jit
depend_on(jit(lambda x: x))
"""


@pytest.fixture
def small(copy):
    """A copy of the package with a kernel that takes no time to compile, in two files."""
    (copy / "src/macroslip/traction/kernel.py").write_text(KERNEL, encoding="utf-8")
    (copy / "src/macroslip/contact/part_of_a_kernel.py").write_text(PART.format(number=1.0), encoding="utf-8")
    return copy


def ask(copy, program=ASK, *, without=(), launcher=(), **environment):
    """Number that the kernel gives, how often it came from the disk, and the folder it is stored in."""
    kept = {name: value for name, value in os.environ.items() if name not in ("NUMBA_CACHE_DIR", *without)}
    done = subprocess.run(
        [*launcher, sys.executable, "-W", "error", "-c", program],
        env=kept | {"PYTHONPATH": str(copy / "src")} | environment,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    value, hits, folder = done.stdout.strip().split(" ", 2)
    return float(value), int(hits), folder


def test_kernels_are_compiled_again_when_a_part_of_them_changes(small):
    folder = str(small / "kernels")
    assert ask(small, NUMBA_CACHE_DIR=folder)[:2] == (4.0, 0)
    assert ask(small, NUMBA_CACHE_DIR=folder)[:2] == (4.0, 1)
    part = small / "src/macroslip/contact/part_of_a_kernel.py"
    part.write_text(PART.format(number=2.0), encoding="utf-8")
    assert ask(small, NUMBA_CACHE_DIR=folder)[:2] == (6.0, 0)
    part.write_text(PART.format(number=1.0), encoding="utf-8")
    assert ask(small, NUMBA_CACHE_DIR=folder)[:2] == (4.0, 1)


@pytest.mark.skipif(os.name != "posix", reason="the variables that name these folders are those of POSIX")
def test_kernels_are_stored_where_the_user_can_write(small):
    """Best first: the user's cache folder, then the temporary files, then nowhere; a file is a folder for nobody."""
    cache, temporary, file = small / "cache", small / "temporary", small / "file"
    temporary.mkdir()
    file.touch()
    value, _, folder = ask(small, XDG_CACHE_HOME=str(cache))
    assert value == 4.0 and Path(folder).is_relative_to(cache / "macroslip")
    for names in ({"XDG_CACHE_HOME": str(file)}, {"HOME": str(file / "home")}):
        without = {"XDG_CACHE_HOME"} - set(names)
        value, _, folder = ask(small, without=without, TMPDIR=str(temporary), **names)
        assert value == 4.0 and Path(folder).is_relative_to(temporary / f"macroslip-{os.getuid()}")
    assert ask(small, NUMBA_CACHE_DIR=str(file)) == (4.0, 0, "None")
    # Others may write in this folder, so nothing is read from it.
    (temporary / f"macroslip-{os.getuid()}").chmod(0o777)
    assert ask(small, XDG_CACHE_HOME=str(file), TMPDIR=str(temporary)) == (4.0, 0, "None")
    assert not list(SOURCE.rglob("kernel.*.nbi")) and not list((small / "src").rglob("*.nbi"))


def test_a_system_without_numbers_of_users(monkeypatch, tmp_path):
    """Windows has none; its temporary files are the user's own."""
    monkeypatch.delattr(os, "getuid", raising=False)
    monkeypatch.setattr(numba.config, "CACHE_DIR", "")
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    assert list(kernel_cache._homes())[-1] == tmp_path / "macroslip"


def small_disk(folder):
    """How to start a process that finds a disk of 1 MB in a folder; None where the system does not let us."""
    if shutil.which("unshare") is None:
        return None
    mount = f"mount -t tmpfs -o size=1m tmpfs '{folder}' && exec \"$@\""
    launcher = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", mount, "sh"]
    return launcher if subprocess.run([*launcher, "true"], capture_output=True).returncode == 0 else None


def test_a_full_disk_is_no_obstacle(small):
    full = small / "full"
    full.mkdir()
    launcher = small_disk(full)
    if launcher is None:
        pytest.skip("this system gives no disk of our own")
    assert ask(small, launcher=launcher, NUMBA_CACHE_DIR=str(full)) == (4.0, 0, "None")


@pytest.mark.parametrize("number", ["0", " -1 "])
def test_a_number_of_threads_that_numba_refuses(small, number):
    assert ask(small, NUMBA_NUM_THREADS=number, NUMBA_CACHE_DIR=str(small / "kernels"))[0] == 4.0


def test_folders_of_older_sources_go(small):
    home = small / "kernels" / "macroslip"
    old = [home / f"{number:016x}" for number in range(2 * KEPT)]
    for number, folder in enumerate([*old, home / "of somebody else"]):
        folder.mkdir(parents=True)
        os.utime(folder, (1e9 + number, 1e9 + number))
    os.utime(old[0], (time.time() - 60.0,) * 2)  # in use by a process that began a minute ago
    used = Path(ask(small, NUMBA_CACHE_DIR=str(home.parent))[2]).parent
    assert set(home.iterdir()) == {used, old[0], *old[-(KEPT - 2) :], home / "of somebody else"}


def test_a_law_that_comes_late_moves_kernels_to_a_folder_of_its_own(small):
    plain = ask(small, NUMBA_CACHE_DIR=str(small / "kernels"))[2]
    late = ASK.replace("print", LATE_LAW + "print")
    value, hits, own = ask(small, late, NUMBA_CACHE_DIR=str(small / "kernels"))
    assert (value, hits) == (4.0, 0) and Path(own).parent.name.startswith(Path(plain).parent.name + "-")
    assert ask(small, late, NUMBA_CACHE_DIR=str(small / "kernels"))[1] == 1
    assert ask(small, NUMBA_CACHE_DIR=str(small / "kernels"))[1:] == (1, plain)


def test_a_kernel_without_laws_stays_where_it_is_when_one_comes(small):
    kernel = KERNEL.replace("import jit\n", "import jit_lawless as jit\n")
    (small / "src/macroslip/traction/kernel.py").write_text(kernel, encoding="utf-8")
    plain = ask(small, NUMBA_CACHE_DIR=str(small / "kernels"))
    assert plain[:2] == (4.0, 0)
    before = "from macroslip.traction.kernel"  # the law comes before the kernel is made, or after it
    for place in (before, "print"):
        program = ASK.replace(place, LATE_LAW + place)
        assert ask(small, program, NUMBA_CACHE_DIR=str(small / "kernels")) == (4.0, 1, plain[2])


def test_the_integrators_and_the_ring_balance_are_stored_once_for_all_laws():
    """They are most of what a case under the paper's laws compiles, and know laws by address or not at all."""
    from macroslip.integrate.fixed_step import integrate_fixed_step
    from macroslip.integrate.radau import integrate_radau

    from macroslip import compiled
    from macroslip.ring.balance import balance_series

    for kernel in (integrate_radau, integrate_fixed_step, balance_series):
        assert kernel not in compiled._stored and kernel.stats.cache_path


def test_elementwise_broadcasts_and_keeps_scalars():
    from macroslip.compiled import elementwise

    double = elementwise(jit(lambda x, y: 2.0 * x + y))
    assert double(1.0, 2.0) == 4.0
    assert np.ndim(double(1.0, 2.0)) == 0
    assert double(np.array([1.0, 2.0]), np.array([[0.0], [1.0]])).tolist() == [[2.0, 4.0], [3.0, 5.0]]
