"""Maps over a lifetime: sums against `lifetime_energy`, and the inner ring spread over the angle."""

import numpy as np
import pytest

from macroslip import InputError, open_study, run_study
from macroslip.report.study_page import CLASS_ONE
from macroslip.result.surface_maps import energy_density
from macroslip.study.aggregation import Aggregation
from macroslip.study.lifetime import LIFETIME_MAPS, lifetime_energy, weighted_maps
from macroslip.study.study_file import study_of
from macroslip.study.weights import BinProbabilities
from tests.variables import check_variables

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    folder = tmp_path_factory.mktemp("study") / "out"
    content = {
        "case": {
            "rollers": [0],
            "loads": {"end": "3 s"},
            "laws": {"model": "physical"},
            "window": {"start": "0 s"},
        },
        "loads": {"bundled": ["12A", "18B", "18C"]},
    }
    run_study(study_of(content), folder)
    return open_study(folder)


def test_sums_are_the_lifetime_energy_of_the_raceways(study):
    maps = weighted_maps(study, Aggregation(CLASS_ONE, years=20.0))
    check_variables(maps, LIFETIME_MAPS)
    energy = maps.surface_energy.sum(
        ("raceway", "angle", "station", "slip_sign", "film_regime")
    ).isel(group=0)
    # One roller a row is simulated, so the mean over rollers is that roller; the cage is no raceway.
    raceways = study.assign(energy_mean=study.energy_inner + study.energy_outer)
    expected = lifetime_energy(raceways, Aggregation(CLASS_ONE, years=20.0)).lifetime_energy.isel(
        group=0
    )
    np.testing.assert_allclose(energy.values, expected.values, rtol=1e-9)


def test_one_bin_that_is_always_there_is_the_mean_of_its_cases(study):
    maps = weighted_maps(study, Aggregation(BinProbabilities({12.0: 0.0, 18.0: 1.0}), years=1.0))
    outer = study.isel(case=[1, 2]).sel(raceway="outer")
    per_pass = outer.surface_energy / outer.surface_passes.where(outer.surface_passes > 0.0, 1.0)
    kinds = ("angle", "station", "slip_sign", "film_regime")
    even = per_pass * outer.surface_energy.sum(kinds) / per_pass.sum(kinds)
    expected = (even / outer.window_length).mean("case") * 365.25 * 86400.0
    density = maps.surface_energy.isel(group=0).sel(raceway="outer")
    np.testing.assert_allclose(
        density.values, expected.transpose(*density.dims).values, rtol=1e-12, atol=0.0
    )


def test_the_inner_ring_is_alike_all_round_and_the_outer_one_is_not(study):
    maps = weighted_maps(study, Aggregation(CLASS_ONE))
    along = energy_density(maps).isel(group=0).sel(row="downwind")
    inner, outer = along.sel(raceway="inner"), along.sel(raceway="outer")
    assert float((inner.max("angle") - inner.min("angle")).max()) == 0.0
    assert float((outer.max("angle") - outer.min("angle")).max()) > 0.0
    largest = maps.surface_power_density.isel(group=0).sel(raceway="outer")
    expected = study.surface_power_density.sel(raceway="outer").max("case")
    np.testing.assert_allclose(largest.transpose(*expected.dims).values, expected.values)


def test_a_study_of_the_paper_has_no_maps(tmp_path):
    content = {
        "case": {"laws": {"model": "paper"}, "rollers": [0], "loads": {"end": "1 s"}},
        "loads": {"bundled": ["12A"]},
    }
    run_study(study_of(content), tmp_path / "out")
    with pytest.raises(InputError, match="no maps of the raceways.*model: physical"):
        weighted_maps(open_study(tmp_path / "out"), Aggregation(CLASS_ONE))
