"""Random examples: the same ones in every run, so that a run cannot fail by chance; fresh ones for a search.

`make test` draws from a fixed seed. `make test-deep` searches with fresh examples.
"""

from hypothesis import HealthCheck, settings

settings.register_profile("fixed", deadline=None, derandomize=True, database=None)
settings.register_profile("deep", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("fixed")
