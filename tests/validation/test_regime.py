"""Regime of lubrication, with the agreement with the film study that was found as bound."""

import numpy as np
import pytest

from validation import regime

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    ("case", "at_30", "at_35", "at_40"), [("12B", 0.02, 0.72, 0.99), ("24B", 0.0, 0.47, 0.90)]
)
def test_films_become_mixed_between_30_and_40_degrees(case, at_30, at_35, at_40):
    found = [regime.mixed_share(case, celsius, 0.7) for celsius in (30.0, 35.0, 40.0)]
    assert found == pytest.approx([at_30, at_35, at_40], abs=0.01)


def test_change_takes_five_kelvin_and_load_hardly_matters():
    assert regime.change() == pytest.approx(4.74, abs=0.1)
    # The line's film goes with W^−0.135, and its W with Q^(2/3); roughness adds some.
    assert 1.0 < 2.0 ** (0.135 * 2 / 3) < regime.half_load() < 1.07


def test_more_oil_means_a_thicker_film():
    load, speed = regime.states("12B")
    rich, poor = (regime.film_ratio(load, speed, 35.0, supply) for supply in (1.0, 0.5))
    assert np.allclose(rich, 2.0 * poor)
