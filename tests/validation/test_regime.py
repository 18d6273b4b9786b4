"""Regime of lubrication, with the agreement with the film study that was found as bound."""

import numpy as np
import pytest

from validation import regime

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    ("case", "at_30", "at_35", "at_40"), [("12B", 0.0, 0.82, 1.0), ("24B", 0.0, 0.44, 0.96)]
)
def test_films_become_mixed_between_30_and_40_degrees(case, at_30, at_35, at_40):
    shares = [regime.mixed_share(case, celsius, 0.7) for celsius in (30.0, 35.0, 40.0)]
    assert shares == pytest.approx([at_30, at_35, at_40], abs=0.01)


def test_change_takes_three_kelvin_and_load_hardly_matters():
    assert regime.change() == pytest.approx(3.05, abs=0.1)
    # The line's film goes with W^−0.135, and its W with Q^(2/3); roughness adds some.
    assert 1.0 < 2.0 ** (0.135 * 2 / 3) < regime.half_load() < 1.07


def test_more_oil_means_a_thicker_film():
    load, speed = regime.states("12B")
    mean = np.array(np.mean(load)), np.array(np.mean(speed))
    rich, poor = (regime.film_ratio("12B", *mean, 35.0, supply) for supply in (1.0, 0.5))
    # The supply is the film over the flooded film under the mean load, here that of all loaded rollers.
    assert float(poor / rich) == pytest.approx(0.5, abs=0.01)
    rich, poor = (regime.film_ratio("12B", load, speed, 35.0, supply) for supply in (1.0, 0.5))
    # Thick films, under little load, have the same gap where their inlets begin to be full.
    thick = rich > 2.0 * np.median(rich)
    assert (poor < rich).all() and np.median(poor[thick] / rich[thick]) < 0.4
