"""Friction torque on both rings: action and reaction with the rollers between them, and the power of the shaft."""

import functools

import numpy as np
import pytest

from macroslip import Bearing, BearingLoads, Cage, Case, Laws, Traces, simulate
from macroslip.bearing import geometry
from macroslip.torque import computed_torque

pytestmark = pytest.mark.slow

#: Thrust alone, without weight: every roller of a row runs as all others, and after some seconds steadily.
LOADS = BearingLoads.constant([0.0, 0.0, 150e3], shaft_speed=2.143, duration=8.0)
TRACES = Traces(step=1.0, start=8.0)
#: Books of the whole bearing that its rings' torques are held against.
BOOKS = ("inner_impulse", "outer_impulse", "body_impulse", "shaft_work")
BEARING = Bearing.read("skf-240-600-bc")
ORBIT = 2.143 * geometry.inner_contact_radius(BEARING) / (2.0 * BEARING.pitch_radius)


@functools.cache
def of(laws):
    result = simulate(Case(loads=LOADS, laws=laws, traces=TRACES, gravity=False))
    return result.isel(time=0), computed_torque(result).isel(time=0)


@pytest.mark.parametrize(
    "laws", [Laws.paper().but(rolling="whole-film"), Laws.physical()], ids=["plain", "physical"]
)
def test_both_rings_give_what_contacts_dissipate(laws):
    """In the frame of the orbit the inner ring turns with Ω_in − Ω and the outer one with −Ω."""
    _, torque = of(laws)
    inner, outer = torque.ring_torque.values
    assert inner < 0.0 < outer
    dissipated = float(torque.contact_torque.sum() + torque.rolling_torque.sum()) * 2.143
    assert -inner * (2.143 - ORBIT) + outer * ORBIT == pytest.approx(dissipated, rel=1e-4)
    total = dissipated / 2.143 + float(torque.drag_torque)
    assert float(torque.torque) == pytest.approx(total, rel=1e-12)


def test_torques_on_rings_and_rollers_balance():
    """What the rings get, the rollers get from drag and cage: Σ r~ (N − F_d) + r cos α F_c, F_c with its own resistance.

    N is found from the forces of all contacts along the orbit, the sideways push of their pressure among them; the
    torques of the rings know nothing of that push.
    """
    result, torque = of(Laws.paper().but(rolling="whole-film"))
    radius = geometry.roller_radius(BEARING)
    surface = result.spin * radius
    cage = (
        result.traction.sel(interface="cage") - result.rolling_power.sel(interface="cage") / surface
    )
    drag = float(torque.drag_torque) * 2.143 / (ORBIT * BEARING.pitch_radius)
    expected = BEARING.pitch_radius * (float(result.cage_force.sum()) - drag)
    expected += radius * np.cos(BEARING.contact_angle) * float(cage.sum())
    size = float(np.abs(torque.ring_torque).sum())
    assert abs(float(torque.ring_torque.sum()) - expected) < 1e-3 * size
    assert abs(expected) > 1e-2 * size


def test_rings_of_the_whole_bearing_feel_what_its_books_hold():
    """Let go, the orbit carries nothing: what the inner ring gets and the outer one does not is drag.

    The books are summed from the forces on the rollers; the torques come from powers and tractions.
    """
    traces = Traces(step=0.5, start=7.5)
    case = Case(
        loads=LOADS, laws=Laws.paper().but(rolling="whole-film"), traces=traces, gravity=False,
        dynamics="whole-bearing", cage=Cage(weight=False),
    )  # fmt: skip
    result = simulate(case)
    torque = computed_torque(result).isel(time=-1)
    inner, outer = torque.ring_torque.values
    last = result.sel(book_time=slice(7.5, 8.0)).isel(book_time=[0, -1])
    rates = {name: float(np.diff(last[f"book_{name}"].values)[0]) / 0.5 for name in BOOKS}
    assert inner < 0.0 < outer
    assert [inner, outer] == pytest.approx(
        [-rates["inner_impulse"], -rates["outer_impulse"]], rel=1e-4
    )
    assert inner + outer == pytest.approx(rates["body_impulse"], rel=1e-2)
    assert float(torque.torque) * 2.143 == pytest.approx(rates["shaft_work"], rel=1e-3)


def test_without_rolling_resistance_nothing_is_booked_for_it():
    _, torque = of(Laws.paper())
    assert not torque.rolling_torque.any()
