"""Power along rollers that touch a raceway along a line, beside that of the whole contact."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from macroslip import Bearing, Laws, Lubricant
from macroslip.measures.along import ALONG, STATIONS, contacts_of, power_along
from macroslip.measures.maps import MAPS
from macroslip.measures.samples import SAMPLE
from macroslip.roller.model import roller_model

CYLINDER = Path(__file__).parents[2] / "validation" / "data" / "cylindrical-160.yaml"
CROWNED = Bearing.read(CYLINDER)
BEARING = CROWNED.replace(roller_crown_radius=None, roller_profile="logarithmic")
OIL = Lubricant.read("vg320-mineral").at(333.15)
LOAD = 60e3
SPEED = -0.8
SLIP = 2e-3


def distribution(law, contact):
    """Record of `ALONG` of a loaded raceway."""
    sample = np.zeros(1, SAMPLE)[0]
    film = law.film_thickness(np.array([LOAD]), np.array([abs(SPEED)]))
    sample["film"][0] = film[0]
    sample["share"][0] = law.asperity_share(np.array([LOAD]), np.array([abs(SPEED)]), film)[0]
    sample["time"] = 1.0
    sample["at"]["elastic_load"] = LOAD
    along = np.zeros(1, ALONG)[0]
    power_along(np.zeros(1, MAPS)[0], 0, contact, (LOAD, SPEED, SLIP), sample, 2.0, along)
    return along


@pytest.mark.parametrize("microslip", [True, False])
def test_power_of_all_stations_is_that_of_the_contact(microslip):
    """∫τ v dA of the contact's own graded quadrature; without microslip v is Δu all along the line."""
    chosen = replace(Laws.physical(), microslip=microslip)
    laws = roller_model(BEARING, OIL, 1, tilt=0.0, laws=chosen).laws
    law = laws.inner
    along = distribution(law, contacts_of(laws)[0])
    whole = law.tractions(np.array([LOAD]), np.array([SPEED]), np.array([SLIP]))
    # v = Δu (1 − P/(2r)) + u2 κ P/2, of which ∫τ dA and ∫τ P/(2r) dA are known.
    rolling = SPEED * law.strips.curvature * law.strips.radius
    expected = SLIP * float((whole.pull - whole.lag)[0]) + rolling * float(whole.lag[0])
    width = BEARING.roller_length / STATIONS
    assert along["total"] * width == pytest.approx(abs(expected), rel=0.03)
    if not microslip:
        assert along["work_total"] == pytest.approx(LOAD * SLIP, rel=0.01)
