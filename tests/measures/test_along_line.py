"""Strips along a tapered roller: their loads and power, beside those of the whole contact."""

import numpy as np
import pytest

from macroslip import Laws, Lubricant
from macroslip.bearing.kinds import read_bearing
from macroslip.measures.along import ALONG, STATIONS, contacts_of
from macroslip.measures.along_line import line_power_along, strips_along
from macroslip.measures.maps import MAPS
from macroslip.measures.samples import SAMPLE
from macroslip.roller.model import roller_model

BEARING = read_bearing("tdo-main-bearing")
OIL = Lubricant.read("vg460-pao").at(308.15)
LAWS = roller_model(BEARING, OIL, 1, tilt=0.0, laws=Laws.physical()).laws
SPEED = 0.24
#: Loads [N] and slips [m/s].
STATES = [(20e3, 1e-3), (100e3, 0.0), (100e3, -5e-5), (235e3, 2e-5), (300e3, 1e-2)]


@pytest.mark.parametrize(("load", "slip"), STATES)
def test_strips_carry_the_load_and_dissipate_the_power_of_the_contact(load, slip):
    """Power of all strips beside ∫τ v dA of the contact's own graded quadrature."""
    law = LAWS.inner
    strips = strips_along(law, *(np.array([value]) for value in (load, SPEED, slip)))
    width = BEARING.roller_length / STATIONS
    carried = float((strips["load"] * strips["covered"]).sum()) * width
    assert carried == pytest.approx(load, rel=0.01)
    maps = np.zeros(1, MAPS)
    along = np.zeros(1, ALONG)
    sample = np.zeros(1, SAMPLE)
    sample["film"][0, 0] = 1e-6
    sample["time"] = 1.0
    sample["at"]["elastic_load"] = load
    state = (load, SPEED, slip)
    line_power_along(maps[0], 0, contacts_of(LAWS)[0], state, sample[0], 2.0, strips[0], along[0])
    whole = law.tractions(*(np.array([value]) for value in state))
    # v = Δu (1 + ζ/A − P/(2r)) + u2 κ P/2, of which ∫τ (1 + ζ/A) dA and ∫τ P/(2r) dA are known.
    rolling = SPEED * law.strips.curvature * law.strips.radius
    expected = slip * float((whole.pull - whole.lag)[0]) + rolling * float(whole.lag[0])
    assert along["total"][0] * width == pytest.approx(expected, rel=0.03)
    # All of the time and both passes belong to strips that touch.
    touching = float(strips["covered"].sum()) / STATIONS
    assert maps["film_slip"][0, 0, ..., 0].sum() == pytest.approx(touching)
    assert maps["film_slip"][0, 0, ..., 1].sum() == pytest.approx(2.0 * touching)


def test_two_stations_of_a_gripped_roller_roll_without_slip():
    """At no slip in the mean the middle of the roller is slower than the ends, or faster."""
    strips = strips_along(LAWS.inner, np.array([200e3]), np.array([SPEED]), np.array([-2e-5]))[0]
    signs = np.sign(strips["slip"][strips["covered"] > 0.0])
    assert np.count_nonzero(np.diff(signs)) == 2
