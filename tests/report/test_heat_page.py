"""The page on the heat of a bearing says when computed friction does not improve the fit, and that an index is no alarm."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from macroslip.report.heat_page import block_scatter, fit_table, heat_page, heat_sentences
from macroslip.scada.heat import bearing_heat
from macroslip.scada.heat_models import FRICTION, SPEED
from macroslip.scada.synthetic import SyntheticYear, base_turbine_friction, synthetic_year

pytestmark = pytest.mark.slow


def record_of(truth: SyntheticYear, friction):
    """A synthetic record as the reader gives it, without files."""
    data = synthetic_year(truth, friction)
    data = data.assign(jump=False, filter=pd.Categorical([""] * len(data)))
    described = SimpleNamespace(
        turbine="T1",
        rated=SimpleNamespace(rotor_speed=17.1 * np.pi / 30.0, power=1.5e6),
        oil_offset=0.0,
        reference=None,
        capacity=SimpleNamespace(mass=6000.0, range=(4000.0, 8000.0)),
    )
    return SimpleNamespace(description=described, data=data, step=600.0, notes=("Told.",))


@pytest.fixture(scope="module")
def scada():
    return record_of(SyntheticYear(days=180), base_turbine_friction())


@pytest.fixture(scope="module")
def heat(scada):
    return bearing_heat(scada, base_turbine_friction())


def test_computed_friction_is_told_better_than_speed(heat, scada):
    caution, worth, constants, index = heat_sentences(heat, scada.description)
    assert "no alarm" in caution and "Lubrication cannot be read off one turbine" in caution
    assert "explains the heat better than its rivals" in worth
    assert "1.84 to 3.68 MJ/K: the fitted capacity lies inside" in constants
    assert "in proportion to the level of the computed friction" in constants
    assert "its cumulative sum" in index


def test_a_rival_with_the_same_heat_takes_the_keep_away(heat, scada):
    # The heat of the chosen fit under the name of a rival, with noise of its own.
    own = heat.chosen
    rivals = [
        replace(own, heat=own.heat + 1e-3 * np.random.default_rng(k).standard_normal(own.heat.size))
        for k in range(40)
    ]
    scatters = np.array([block_scatter(heat, rival) for rival in rivals])
    assert scatters.std() == pytest.approx(1.0, abs=0.3)
    closest = rivals[int(np.argmin(np.abs(scatters)))]
    twin = replace(closest, model=replace(own.model, name=SPEED, supply=""))
    equal = replace(heat, fits=(*heat.fits, twin))
    assert "does not improve the fit" in heat_sentences(equal, scada.description)[1]


def test_a_better_rival_is_told(heat, scada):
    own = heat.chosen
    closer = replace(
        own,
        model=replace(own.model, name=SPEED, supply=""),
        heat=own.heat + 0.5 * own.residuals,
        residual=0.5 * own.residual,
    )
    worse = heat_sentences(replace(heat, fits=(*heat.fits, closer)), scada.description)[1]
    assert "worse than a rival" in worse
    assert block_scatter(heat, closer) < -2.0


def test_the_page_has_every_model_and_its_limits(heat, scada):
    page = heat_page(heat, scada.description, "a study")
    for fit in heat.fits:
        assert fit.model.name in page
    assert "starvation cools" in page
    assert "Told." in page
    table = fit_table(heat)
    assert table.rows[0][0] == f"{FRICTION}, skf"
    assert len(table.rows) == sum(len(fit.values) for fit in heat.fits)
