"""What all tests share: how random examples are drawn, and the base bearing, its oil and rollers.

`make test` draws the same examples in every run, so that it cannot fail by chance. `make test-deep` searches with fresh ones.
"""

import gc
import math
import os
import re

import pytest

# Every worker has a processor to itself. Where its linear algebra takes threads for all processors, they wait for each
# other, and a small system takes five times as long. NumPy reads this when it is imported; so do processes of the tests.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from hypothesis import HealthCheck, settings
from xdist.scheduler import LoadScopeScheduling

from macroslip import plugins
from macroslip.bearing import Bearing
from macroslip.contact.registry import FILM_LAWS, TRACTION_LAWS
from macroslip.lubricant import Lubricant
from macroslip.roller.model import roller_model

settings.register_profile("fixed", deadline=None, derandomize=True, database=None)
settings.register_profile("deep", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("fixed")

#: Tests of these files stay with one worker: they compile the same kernels, of the whole bearing or of the rivals.
TOGETHER = (
    re.compile(r"tests/(whole/|torque/test_rings\.py|report/test_whole_section\.py)"),
    re.compile(r"tests/benchmarks/"),
)
#: What takes longest, or compiles what others need.
FIRST = (
    "tests/whole/",
    "tests/docs/test_pages.py",
    "tests/torque/test_rings.py",
    "tests/paper/",
    "tests/docs/",
)


#: What `make check` runs and `make test` does not: what shows that pages, the paper's study, comparisons and numbers hold,
#: and second examples of what quicker tests show.
CHECKED = (
    "tests/docs/test_examples.py",
    "tests/docs/test_pages.py",
    "tests/docs/test_site.py",
    "tests/paper/",
    "paper/",
    "tests/validation/",
    "tests/benchmarks/",
    "tests/golden/",
    "tests/report/test_browser.py",
    # More kills, and second examples of processes that end; one of each kind stays in `make test`.
    "tests/study/test_workers.py::test_kills_lose_nothing[fifteen]",
    "tests/study/test_workers.py::test_a_scheduler_that_dies_loses_nothing",
    "tests/cli/test_study.py::test_interrupted_and_resumed_as_a_user_does[workers1]",
    *(
        f"tests/study/test_faults.py::test_a_disk_that_is_full_at_any_moment[2-{k}]"
        for k in (1, 2, 4, 5, 6)
    ),
    *(
        f"tests/cli/test_failure.py::test_a_number_of_threads_that_is_none[{n}]"
        for n in ("0", "-3", "1.5")
    ),
    *(
        f"tests/storage/test_kernels.py::test_a_damaged_archive_is_compiled_again[{damage}]"
        for damage in ("empty", "flip_first", "exchange", "unlink")
    ),
    # Tables of rotors that stand or stop; other events have physical slices in `make test`.
    "tests/result/test_events.py::test_a_slice_of_bundled_events[physical-",
    # A long search; the other files of tests/fuzz have shorter ones.
    "tests/fuzz/test_study_folder.py::test_damaged",
    # Five commands in a process whose doors are shut, and what they have written.
    "tests/cli/test_nothing_else.py::test_nothing_that_is_written_says",
    "tests/cli/test_nothing_else.py::test_results_name_their_loads",
    # Compile everything anew, in folders of their own.
    "tests/storage/test_kernels.py::test_a_simulation_keeps_its_kernels_before_the_process_ends",
    "tests/cli/test_current_folder.py::test_a_first_run_and_a_study_with_workers",
    "tests/cli/test_nothing_else.py::test_the_network_is_never_asked_for",
    # The stored table of friction, which takes six temperatures of a physical case.
    "tests/study/test_friction.py::test_the_table_of_the_base_turbine_is_what_its_command_computes",
    # Tables for tolerances of 5e-5 and finer; one example of each stays in `make test`.
    "tests/imposed/test_histories.py::test_shaft_reversal_with_microslip[default-",
    "tests/physics/test_skew_of_a_case.py::test_energy_is_that_at_a_tight_tolerance",
    "tests/result/test_contact_tables.py::test_a_shaft_that_turns_round[physical]",
)
#: Golden cases that stay in `make test`, one of each kind.
QUICK_GOLDEN = (
    "imposed-paper-14B",
    "imposed-physical-14B",
    "film-paper-14B",
    "every_case_is_stored",
)


#: Examples that stay in `make test`.
QUICK_EXAMPLES = ("01_constant_load",)


def is_checked(nodeid: str) -> bool:
    """True if a test belongs to `make check`."""
    if nodeid.startswith("tests/docs/test_examples.py"):
        return not any(name in nodeid for name in QUICK_EXAMPLES)
    if nodeid.startswith("tests/golden/"):
        return not any(name in nodeid for name in QUICK_GOLDEN)
    return nodeid.startswith(CHECKED)


class Scheduling(LoadScopeScheduling):
    """A file of tests stays with one worker, so that what its tests share is computed once."""

    def _split_scope(self, nodeid):
        together = (files.pattern for files in TOGETHER if files.match(nodeid))
        return next(together, nodeid.split("::", 1)[0])


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    return Scheduling(config, log)


def pytest_collection_modifyitems(items):
    """Files with slow tests first, so that no worker begins with one when the others have nothing left to do."""
    for item in items:
        if is_checked(item.nodeid):
            item.add_marker(pytest.mark.check)
    slow = {item.path for item in items if item.get_closest_marker("slow")}

    def rank(item):
        place = next(
            (k for k, name in enumerate(FIRST) if item.nodeid.startswith(name)), len(FIRST)
        )
        return item.path not in slow, place

    items.sort(key=rank)


def pytest_collection_finish():
    """The collector of garbage leaves alone what stays to the end: modules, and thousands of tests.

    It would go through all of them again and again, and begins less often for what tests make.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000)


@pytest.fixture(scope="module", autouse=True)
def package_laws():
    """A module's own laws end with its tests: other tests list the laws of the package."""
    lists = (FILM_LAWS._laws, TRACTION_LAWS._laws, plugins._loaded)
    before = [dict(one) for one in lists]
    yield
    for one, old in zip(lists, before, strict=True):
        one.clear()
        one.update(old)


@pytest.fixture(scope="session")
def bearing():
    """The base bearing."""
    return Bearing.read("skf-240-600-bc")


@pytest.fixture(scope="session")
def lubricant():
    """Its oil."""
    return Lubricant.read("vg460-pao")


@pytest.fixture(scope="session")
def models(bearing, lubricant):
    """Rollers of both rows by axial sign, tilt 5°."""
    return {
        sign: roller_model(bearing, lubricant, sign, tilt=math.radians(5.0)) for sign in (1, -1)
    }
