"""A film law and a traction law of one's own beside the mechanisms of the package, in the contacts of a roller."""

import math
from pathlib import Path

import numpy as np
import pytest

from macroslip import Bearing, Laws, Lubricant, load_laws
from macroslip.roller.cage_force import cage_force
from macroslip.roller.contact_force import raceway_force
from macroslip.roller.friction_power import friction_power
from macroslip.roller.model import interfaces, roller_model
from macroslip.traction import traction_law

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).parents[2] / "examples"
LOAD, RING_SPEED = 2e4, -0.4


@pytest.fixture(scope="module")
def own_laws(package_laws):
    load_laws(EXAMPLES / "own_film.py")
    load_laws(EXAMPLES / "own_law.py")


@pytest.fixture(scope="module", params=["film", "traction"])
def model(request, own_laws):
    laws = {
        "film": Laws.physical().but(film="dowson-higginson"),
        "traction": Laws.paper().but(
            film="masjedi-khonsari-moes",
            starvation=True,
            inlet_heating=True,
            asperities="film-ratio",
            traction="isothermal-barus",
        ),
    }[request.param]
    return roller_model(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"), 1, tilt=0.0, laws=laws)


def at_slip(model, slip):
    mean = RING_SPEED - 0.5 * slip
    return raceway_force(model.inner, LOAD, slip, RING_SPEED, abs(mean), -0.5 if mean >= 0.0 else 0.5)


@pytest.mark.parametrize("slip", [-3e-2, 2e-3, 3e-2])
def test_the_slope_is_the_derivative_of_the_force(model, slip):
    """By slip and by what slip changes in the film: corrections of the package act on either law.

    Limited shear comes from a table, whose slopes serve Newton's iteration and are near.
    """
    step = 1e-4 * abs(slip)
    before, found, after = (at_slip(model, one) for one in (slip - step, slip, slip + step))
    assert found.spin_slope == pytest.approx((after.spin - before.spin) / (2.0 * step), rel=2e-2)
    assert found.pull_slope == pytest.approx((after.pull - before.pull) / (2.0 * step), rel=2e-2)


@pytest.mark.parametrize("slip", [-3e-2, 3e-2])
def test_friction_brakes_and_asperities_take_part(model, slip):
    found = at_slip(model, slip)
    assert found.pull * slip > 0.0
    power = friction_power(model.inner, slip, RING_SPEED, found.spin, found.detail)
    assert power > found.detail.asperity_power > 0.0
    force, _, _, detail = cage_force(model.cage, 300.0, slip, 0.2, 0.5)
    assert force * slip > detail.asperity_power >= 0.0


def test_chords_add_up_to_the_contact(own_laws):
    """A law that knows no chords spreads its traction as the load."""
    oil = Lubricant.read("vg460-pao")
    law = traction_law.prepare("isothermal-barus", interfaces(Bearing.read("skf-240-600-bc"), oil)[0])
    across, film, slip = 0.02, 5e-7, 1e-2
    nodes, weights = np.polynomial.legendre.leggauss(8)
    chords = [
        traction_law.chord_traction(law, LOAD, film, across, math.sqrt(1.0 - place * place), slip) for place in nodes
    ]
    whole = traction_law.patch_traction(law, LOAD, film, slip)[0]
    assert across * float(weights @ chords) == pytest.approx(whole, rel=1e-13)
