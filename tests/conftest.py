"""What all tests share: how random examples are drawn, and the base bearing, its oil and rollers.

`make test` draws the same examples in every run, so that it cannot fail by chance. `make test-deep` searches with fresh ones.
"""

import math

import pytest
from hypothesis import HealthCheck, settings

from macroslip import compiled, plugins
from macroslip.bearing import Bearing
from macroslip.film import film_law
from macroslip.lubricant import Lubricant
from macroslip.roller.model import roller_model
from macroslip.traction import traction_law

settings.register_profile("fixed", deadline=None, derandomize=True, database=None)
settings.register_profile("deep", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("fixed")


def pytest_collection_modifyitems(items):
    """Files with slow tests first, so that no worker begins with one when the others have nothing left to do."""
    slow = {item.path for item in items if item.get_closest_marker("slow")}
    items.sort(key=lambda item: item.path not in slow)


@pytest.fixture(scope="module", autouse=True)
def package_laws():
    """A module's own laws end with its tests.

    Other tests list the laws of the package, and kernels depend on every law that a process knows: one that stays
    would make the process compile the kernels of all later tests once more.
    """
    lists = (film_law._laws._entries, traction_law._laws._entries, plugins._loaded)
    before, sources = [dict(one) for one in lists], list(compiled._own_laws)
    yield
    for one, old in zip(lists, before, strict=True):
        one.clear()
        one.update(old)
    if compiled._own_laws != sources:
        compiled._own_laws[:] = sources
        with compiled._storing() as folder:
            for dispatcher in compiled._stored if folder else ():
                dispatcher.enable_caching()


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
    return {sign: roller_model(bearing, lubricant, sign, tilt=math.radians(5.0)) for sign in (1, -1)}
