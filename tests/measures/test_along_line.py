"""Strips along rollers that touch a raceway along a line, beside the whole contact."""

from pathlib import Path

import numpy as np
import pytest

from macroslip import Bearing, Laws, Lubricant
from macroslip.bearing.kinds import read_bearing
from macroslip.measures.along import STATIONS, contacts_of
from macroslip.measures.along_line import strips_along
from macroslip.measures.samples import SAMPLE
from macroslip.roller.model import roller_model
from tests.measures.one_contact import power_along

DATA = Path(__file__).parents[2] / "validation" / "data"
CROWNED = Bearing.read(DATA / "cylindrical-160.yaml")
#: Bearing, oil and u2 [m/s] by the shape of the roller.
ROLLERS = {
    "tapered": (
        read_bearing("tdo-main-bearing"),
        Lubricant.read("vg460-pao").at(308.15),
        0.24,
    ),
    "logarithmic": (
        CROWNED.replace(roller_crown_radius=None, roller_profile="logarithmic"),
        Lubricant.read("vg320-mineral").at(333.15),
        -0.8,
    ),
    "straight": (
        CROWNED.replace(roller_crown_radius=None, roller_profile="straight"),
        Lubricant.read("vg320-mineral").at(333.15),
        -0.8,
    ),
}
#: Shapes, loads [N] and slips [m/s].
STATES = [
    ("tapered", 20e3, 1e-3),
    ("tapered", 100e3, 0.0),
    ("tapered", 100e3, -5e-5),
    ("tapered", 235e3, 2e-5),
    ("tapered", 300e3, 1e-2),
    ("logarithmic", 60e3, 2e-3),
    ("logarithmic", 60e3, 0.0),
    ("logarithmic", 5e3, -1e-2),
    ("straight", 60e3, 2e-3),
]


def laws_of(shape, *, microslip=True):
    """Laws of a roller."""
    bearing, oil, _ = ROLLERS[shape]
    chosen = Laws.physical().but(microslip=microslip)
    return roller_model(bearing, oil, 1, tilt=0.0, laws=chosen).laws


def booked(laws, state):
    """Strips of the inner raceway, a record of `ALONG`, and times by classes, at Q, u2 and Δu."""
    strips = strips_along(laws.inner, *(np.array([value]) for value in state))[0]
    sample = np.zeros(1, SAMPLE)[0]
    sample["film"][0] = 1e-6
    sample["time"] = 1.0
    sample["under_load"] = 1.0
    along, times = power_along(contacts_of(laws)[0], 0, state, sample, 2.0, strips)
    return strips, along, times


@pytest.mark.parametrize("microslip", [True, False])
@pytest.mark.parametrize(("shape", "load", "slip"), STATES)
def test_strips_carry_the_load_and_dissipate_the_power_of_the_contact(shape, load, slip, microslip):
    """Power of all strips beside ∫τ v dA of the contact's own graded quadrature.

    Without microslip v is Δu all along the line.
    """
    bearing, _, speed = ROLLERS[shape]
    laws = laws_of(shape, microslip=microslip)
    law = laws.inner
    strips, along, times = booked(laws, (load, speed, slip))
    width = bearing.roller_length / STATIONS
    carried = float((strips["load"] * strips["covered"]).sum()) * width
    assert carried == pytest.approx(load, rel=0.01)
    whole = law.tractions(*(np.array([value]) for value in (load, speed, slip)))
    # v = Δu (1 + ζ/A − P/(2r)) + u2 κ P/2, of which ∫τ (1 + ζ/A) dA and ∫τ P/(2r) dA are known.
    rolling = speed * law.strips.curvature * law.strips.radius
    expected = slip * float((whole.pull - whole.lag)[0]) + rolling * float(whole.lag[0])
    assert along["total"] * width == pytest.approx(expected, rel=0.03)
    if not microslip:
        assert along["work_total"] == pytest.approx(load * abs(slip), rel=0.01)
    # All of the time and both passes belong to strips that touch.
    touching = float(strips["covered"].sum()) / STATIONS
    assert times[..., 0].sum() == pytest.approx(touching)
    assert times[..., 1].sum() == pytest.approx(2.0 * touching)


def test_two_stations_of_a_gripped_roller_roll_without_slip():
    """At no slip in the mean the middle of the roller is slower than the ends, or faster."""
    state = (np.array([200e3]), np.array([0.24]), np.array([-2e-5]))
    strips = strips_along(laws_of("tapered").inner, *state)[0]
    signs = np.sign(strips["slip"][strips["covered"] > 0.0])
    assert np.count_nonzero(np.diff(signs)) == 2


def test_a_straight_roller_is_pressed_and_slips_alike_all_along():
    strips = booked(laws_of("straight"), (60e3, -0.8, 2e-3))[0]
    for name in ("covered", "load", "film", "share", "slip", "pressure"):
        assert np.ptp(strips[name]) <= 1e-12 * abs(strips[name][0])
    assert strips["slip"][0] == 2e-3
