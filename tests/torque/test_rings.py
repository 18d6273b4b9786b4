"""Friction torque on both rings: action and reaction with the rollers between them, and the power of the shaft."""

import numpy as np
import pytest

from macroslip import Bearing, BearingLoads, Case, Laws, Traces, simulate
from macroslip.torque import computed_torque

LOADS = BearingLoads.constant([0.0, -300e3, 150e3], shaft_speed=2.143, duration=4.0)
TRACES = Traces(step=1.0, start=2.0)
BEARING = Bearing.read("skf-240-600-bc")


def of(laws):
    result = simulate(Case(loads=LOADS, laws=laws, traces=TRACES, gravity=False))
    return result, computed_torque(result)


@pytest.mark.parametrize("laws", [Laws.paper().but(rolling="whole-film"), Laws.physical()])
def test_the_inner_ring_takes_the_power_that_is_dissipated(laws):
    """Rollers hardly accelerate here: all that the shaft gives goes into contacts and drag, or into the cage's guide.

    (32) has the cage push every roller along its orbit with N, which moves at Ω r~: that power is not dissipated, it is
    what keeps the orbit as imposed.
    """
    result, torque = of(laws)
    inner = torque.ring_torque.sel(raceway="inner").values
    orbit = np.abs(result.spin_pure.values[0, 0] * 0.035 / (BEARING.pitch_radius + 0.035 * np.cos(BEARING.contact_angle)))
    drag = torque.drag_torque.values * torque.shaft_speed.values
    guide = result.cage_force.sum(("row", "roller")).values * BEARING.pitch_radius * orbit - drag
    skew = 0.0
    assert np.all(inner < 0.0)
    given = -inner * torque.shaft_speed.values + guide + drag
    assert given == pytest.approx(torque.torque.values * torque.shaft_speed.values, rel=0.02) or skew


def test_torques_on_rings_and_rollers_balance():
    """One slip a contact: what both rings get is what cage, drag and the rollers' spin leave."""
    result, torque = of(Laws.paper().but(rolling="whole-film"))
    rings = torque.ring_torque.sum("raceway").values
    push = result.cage_force.sum(("row", "roller")).values * BEARING.pitch_radius
    orbital = np.abs(torque.shaft_speed.values) * 0.451
    drag = torque.drag_torque.values * torque.shaft_speed.values / orbital
    size = np.abs(torque.ring_torque).sum("raceway").values
    assert np.all(np.abs(rings - (push - drag)) < 0.03 * size)
