"""Friction over temperature: loaded films thin, so that their friction falls."""

import pytest

from macroslip import Case, HubLoads, Laws, Lubricant, simulate
from tests.quick import COARSE

pytestmark = pytest.mark.slow

OIL = Lubricant.read("vg460-pao")


def downwind_energy(oil, rheology):
    """Energy [J] of one roller of the loaded row in 30 s of turbulence."""
    loads = HubLoads.bundled("12B").window(0.0, 30.0)
    laws = Laws.physical().but(rheology=rheology)
    result = simulate(Case(loads=loads, lubricant=oil, laws=laws, rollers=[0], integrator=COARSE))
    return float(result.energy.sum("interface").sel(row="downwind").item())


@pytest.mark.parametrize("rheology", ["limiting-shear", "eyring"])
def test_friction_of_a_loaded_row_falls_with_temperature(rheology):
    cold, own, warm = (
        downwind_energy(OIL.at(f"{celsius} degC"), rheology) for celsius in (20, 35, 50)
    )
    assert cold > 1.1 * own > 1.2 * warm
