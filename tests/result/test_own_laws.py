"""Laws of one's own in a simulation: looked at before the first step, the same as the package's, and cited."""

from pathlib import Path

import numpy as np
import pytest

from macroslip import BearingLoads, Case, InputError, Laws, load_laws, register_film, simulate
from macroslip.contact import registry

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).parents[2] / "examples"
LOADS = BearingLoads.constant([0.0, -300e3, 0.0], 2.0, 0.5)


@pytest.fixture(scope="module", autouse=True)
def registered(package_laws):
    register_film("negative", lambda interface, load, speed: 1e-6 * (speed - 1.0), reference="none")
    for name in ("own_film.py", "own_law.py"):
        load_laws(EXAMPLES / name)


def test_a_simulation_looks_before_its_first_step():
    with pytest.raises(InputError, match="film law 'negative', inner, load"):
        simulate(Case(loads=LOADS, rollers=[0], laws=Laws.paper().but(film="negative")))


def test_a_copy_of_a_law_of_the_package_gives_its_results():
    """The shipped film under another name: the same tables, so the same energies."""
    case = Case(loads=LOADS, rollers=[0], laws=Laws.paper())
    mine = registry.FILM_LAWS.named(case.laws.film).function
    register_film(
        "copy", lambda interface, load, speed: mine(interface, load, speed), reference="none"
    )
    result = simulate(Case(loads=LOADS, rollers=[0], laws=Laws.paper().but(film="copy")))
    np.testing.assert_array_equal(result.energy, simulate(case).energy)


def test_the_examples_run_and_are_cited():
    laws = Laws.paper().but(film="dowson-higginson", traction="isothermal-barus")
    result = simulate(Case(loads=LOADS, rollers=[0], laws=laws))
    assert (result.status == 0).all() and float(result.energy.sum()) > 0.0
    assert "Barus" in result.attrs["citations"] and "Dowson" in result.attrs["citations"]
    # The paper's traction heats its film; a roller that grips slips so little that it hardly matters.
    heated = simulate(Case(loads=LOADS, rollers=[0], laws=laws.but(traction="mechanisms")))
    raceways = ["inner", "outer"]
    assert float(result.energy.sel(interface=raceways).sum()) == pytest.approx(
        float(heated.energy.sel(interface=raceways).sum()), rel=0.05
    )
