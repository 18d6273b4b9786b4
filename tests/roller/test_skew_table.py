"""The table of skew: against the function it is made from, limits of its stops, and its mirrors."""

from __future__ import annotations

import math

import numpy as np
import pytest

from macroslip import Bearing, Laws, Lubricant
from macroslip.contact.laws import prepare
from macroslip.contact.table import Box
from macroslip.roller.skew import SkewStop, equilibrium, raceways, skew_stop
from macroslip.roller.skew_table import guide_of, skew_table, turned

BEARING, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
LAWS = prepare(Laws.physical().but(skew="quasi-static"), BEARING, OIL, 1)
SPAR = skew_stop(BEARING, "conforming-pocket", 0.5e-3)
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def table():
    return skew_table(LAWS, BEARING, Box(16384.0, 0.37, 0.42, 1.0))


def held(largest):
    return guide_of(SkewStop(largest, SPAR.arm, 0.0), 1)


def test_the_table_gives_what_the_equilibrium_gives(table):
    """Between its nodes."""
    random, pair, guide = np.random.default_rng(1), raceways(LAWS, BEARING, 1), guide_of(SPAR, 1)
    load = np.exp(random.uniform(math.log(2.5e3), math.log(16e3), 40))
    speed, push = -random.uniform(0.37, 0.42, 40), random.uniform(0.0, 60.0, 40)
    looked_up = np.array(
        [turned(table, guide, *state) for state in zip(load, speed, push, strict=True)]
    )
    skew, held, inner, outer, axial, tilt, inner_moment, _, remains, shift, slip, *rough = (
        looked_up.T
    )
    exact, straight = (equilibrium(pair, LAWS, load, speed, angle) for angle in (skew, 0.0))
    reach = LAWS.inner.interface.hertz.semi_axis_across * np.cbrt(load)
    assert (remains < 1e-5 * np.abs(inner_moment)).all()
    # What pulls either way is .04 Q: a rest is where two moments of that size are equal.
    left = (
        exact.moment
        - push * np.clip(guide.effective_radius * skew, -0.5 * guide.arm, 0.5 * guide.arm)
        - held
    )
    assert (np.abs(left) < 1e-3 * 0.04 * load * reach).all()
    assert (np.abs(inner_moment - exact.moments[:, 0]) < 1e-3 * 0.04 * load * reach).all()
    assert (
        np.abs(np.stack([inner, outer], 1) - exact.power + straight.power) < 0.01 * exact.power
    ).all()
    assert (np.abs(axial - exact.axial) < 5e-4 * load).all()
    assert tilt == pytest.approx(exact.tilt, abs=0.02 * np.abs(exact.tilt).max())
    assert shift == pytest.approx(exact.shift, abs=0.02 * np.abs(exact.shift).max())
    # Microslip is 10 to 20 mm/s, and what skew adds to the slip up to 0.02 mm/s.
    assert slip == pytest.approx(exact.slip - straight.slip, abs=5e-6)
    left = np.stack(rough, 1) - exact.asperity_power + straight.asperity_power
    assert (np.abs(left) < 0.02 * exact.asperity_power).all()


def test_a_rotor_that_stands_has_a_table():
    still = skew_table(LAWS, BEARING, Box(16384.0, 0.0, 1e-4, 1.0))
    assert np.isfinite(turned(still, guide_of(SPAR, 1), 1e4, -1e-6, 0.0)).all()


def test_a_straight_roller_has_nothing_added(table):
    straight = turned(table, held(0.0), 1e4, -0.4, 20.0)
    assert (
        straight.skew,
        straight.inner_power,
        straight.outer_power,
        straight.axial,
        straight.tilt,
    ) == (
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    )
    exact = equilibrium(raceways(LAWS, BEARING, 1), LAWS, 1e4, -0.4, 0.0)
    assert straight.stop_moment == pytest.approx(exact.moment, rel=0.02)


def test_half_the_play_leaves_half_the_skew_and_a_quarter_of_what_goes_with_its_square(table):
    whole, half = (turned(table, held(angle), 1e4, -0.4, 0.0) for angle in (1e-4, 0.5e-4))
    assert half.skew == pytest.approx(0.5 * whole.skew, rel=1e-12)
    assert half.axial == pytest.approx(0.5 * whole.axial, rel=0.03)
    # What is even in the skew, beside what tilt and shift add.
    assert half.inner_power + half.outer_power < 0.5 * (whole.inner_power + whole.outer_power)


def test_rows_and_directions_of_turning_are_mirrored(table):
    down, up = (turned(table, guide_of(SPAR, side), 1e4, -0.4, 10.0) for side in (1, -1))
    back = turned(table, guide_of(SPAR, 1), 1e4, 0.4, 10.0)
    assert up == (-down.skew, -down.stop_moment, down.inner_power, down.outer_power, -down.axial, -down.tilt, -down.inner_moment,
                  -down.outer_moment, down.unbalanced, -down.shift, down.slip, down.inner_rough, down.outer_rough)  # fmt: skip
    assert back == (-down.skew, -down.stop_moment, down.inner_power, down.outer_power, down.axial, down.tilt, -down.inner_moment,
                    -down.outer_moment, down.unbalanced, down.shift, -down.slip, down.inner_rough, down.outer_rough)  # fmt: skip


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("speed", [-0.4, 0.4])
def test_the_mirrors_are_those_of_the_contacts(sign, speed):
    """The row's own contacts and the direction's own speed, without a table."""
    laws = prepare(Laws.physical().but(skew="quasi-static"), BEARING, OIL, sign)
    base = equilibrium(raceways(LAWS, BEARING, 1), LAWS, 2e4, -0.4, 3e-3)
    turn = -sign * math.copysign(1.0, speed)
    here = equilibrium(raceways(laws, BEARING, sign), laws, 2e4, speed, turn * 3e-3)
    assert here.moment == pytest.approx(turn * base.moment, rel=1e-5)
    assert here.axial == pytest.approx(sign * base.axial, rel=1e-5)
    assert (here.tilt, here.shift) == pytest.approx((sign * base.tilt, sign * base.shift), rel=1e-5)
    assert here.slip == pytest.approx(-math.copysign(1.0, speed) * base.slip, rel=1e-5)
    assert here.power == pytest.approx(base.power, rel=1e-6)


def test_a_spar_that_presses_harder_leaves_less_skew(table):
    angles = [
        abs(turned(table, guide_of(SPAR, 1), 1e4, -0.4, push).skew)
        for push in (0.0, 20.0, 50.0, 200.0)
    ]
    assert angles == sorted(angles, reverse=True)
    assert angles[0] == pytest.approx(SPAR.largest, rel=1e-12)
    assert angles[-1] < 0.2 * angles[0]


def test_spars_touch_no_farther_than_the_roller_s_ends(table):
    """A spar straightens by its force times half the length at most; less than that leaves the roller to both spars."""
    guide = guide_of(SPAR, 1)
    reach = (
        0.5
        * BEARING.roller_length
        * (1.0 - 0.5 * BEARING.roller_diameter / BEARING.outer_raceway_radius)
    )
    farthest = reach / SPAR.effective_radius
    moment = turned(table, held(farthest), 1e4, -0.4, 0.0).stop_moment
    pressed = turned(table, guide, 1e4, -0.4, 1.05 * moment / reach)
    assert pressed.stop_moment == 0.0 and 0.8 * farthest < pressed.skew < farthest
    push = 0.95 * moment / reach
    stopped = turned(table, guide, 1e4, -0.4, push)
    far = stopped.stop_moment / guide.arm
    near = far + push
    assert stopped.skew == pytest.approx(SPAR.largest, rel=1e-12) and far > 0.0
    assert (near + far) * reach == pytest.approx(
        stopped.inner_moment + stopped.outer_moment, rel=1e-9
    )
