"""Random examples: the same ones in every run, so that a run cannot fail by chance; fresh ones for a search.

`make test` draws from a fixed seed. `make test-deep` searches with fresh examples.
"""

import pytest
from hypothesis import HealthCheck, settings

from macroslip import compiled, plugins
from macroslip.film import film_law
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
