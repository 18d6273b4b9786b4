"""Two short histories: a roller that leaves the load zone and comes back, and one that coasts all the time."""

import pytest

from benchmarks.histories import histories_of


@pytest.fixture(scope="session")
def histories():
    return histories_of("24A", 100.0, 103.0, [0])
