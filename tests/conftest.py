"""Random examples: the same ones in every run, so that a run cannot fail by chance; fresh ones for a search.

`make test` draws from a fixed seed. `make test-deep` searches with fresh examples.
"""

import pytest
from hypothesis import HealthCheck, settings

from macroslip import compiled

settings.register_profile("fixed", deadline=None, derandomize=True, database=None)
settings.register_profile("deep", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("fixed")


@pytest.fixture(scope="module", autouse=True)
def laws_of_ones_own_end_with_their_tests():
    """Kernels depend on every law of one's own that a process knows.

    A module that registers one would make its process compile all kernels of later modules once more.
    """
    before = list(compiled._own_laws)
    yield
    if compiled._own_laws != before:
        compiled._own_laws[:] = before
        with compiled._storing() as folder:
            for dispatcher in compiled._stored if folder else ():
                dispatcher.enable_caching()
