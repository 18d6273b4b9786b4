"""A roller in equilibrium under skew: conditions, check values, rests and stops."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from macroslip import Bearing, Laws, Lubricant
from macroslip.contact.laws import prepare
from macroslip.contact.registry import FILM_LAWS, register_film
from macroslip.contact.skewed import constant_friction, resultants
from macroslip.roller.skew import LARGEST_SKEW, equilibrium, raceways, skew_stop

BEARING, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
CHOICE = Laws.physical().but(rolling="none", asperities="none")
LAWS = prepare(CHOICE, BEARING, OIL, 1)
SPEED, LOADS = -0.39594, np.array([2e4, 3.5e4, 5e4])


#: Angles between which rests are looked for, denser where a law of shear turns its traction [rad].
ANGLES = 2e-4 * np.sinh(np.linspace(0.0, np.arcsinh(LARGEST_SKEW / 2e-4), 25))
ANGLES = np.concatenate([-ANGLES[:0:-1], ANGLES])


def pair(shear=None):
    return raceways(LAWS, BEARING, 1, shear)


def stable_rests(both, load, alignment=0.0):
    """Skews from whose either side a roller turns to them [rad]; `alignment` is a spar's moment per skew [N m/rad]."""

    def moment(skew):
        return equilibrium(both, LAWS, load, SPEED, skew).moment - alignment * skew

    left = moment(ANGLES)
    places = np.flatnonzero((left[:-1] > 0.0) & (left[1:] < 0.0))
    return [
        brentq(lambda angle: float(moment(angle)), *ANGLES[n : n + 2], xtol=1e-7) for n in places
    ]


# Of films of 0.7 times the flooded thickness: net moment [N m], power of inner and outer raceway [W] and force on the inner ring [N], twice derived elsewhere.
CHECK = {
    0.0: [(0.543, 0.431, 0.215, 0), (1.267, 1.759, 1.054, 0), (1.549, 3.866, 2.506, 0)],
    1e-3: [(0.541, 0.450, 0.233, 39), (1.208, 1.801, 1.124, 121), (1.367, 3.916, 2.635, 216)],
    4.7e-3: [(0.493, 0.708, 0.447, 151), (1.006, 2.379, 1.717, 413), (1.047, 4.782, 3.635, 700)],
    10e-3: [(0.436, 1.40, 1.03, 254), (0.865, 3.87, 3.11, 635), (0.963, 7.07, 5.89, 1049)],
}


@pytest.mark.parametrize("skew", CHECK)
def test_check_values_of_a_second_derivation(skew, package_laws):
    flooded = FILM_LAWS.named(Laws.physical().film)
    register_film("thinner", lambda *contact: 0.7 * flooded(*contact), reference="none")
    laws = prepare(CHOICE.but(film="thinner", starvation=False), BEARING, OIL, 1)
    state = equilibrium(raceways(laws, BEARING, 1, None), laws, LOADS, SPEED, skew)
    moment, inner, outer, axial = np.array(CHECK[skew]).T
    # The other derivation leaves out what the ellipse's own width and turn do: 2 % at the largest skew and load.
    assert state.moment == pytest.approx(moment, rel=0.025)
    assert state.power[..., 0] == pytest.approx(inner, rel=0.011)
    assert state.power[..., 1] == pytest.approx(outer, rel=0.011)
    # Those are rounded to newtons.
    assert (np.abs(state.axial - axial) < 0.51 + 0.01 * axial).all()


def test_conditions_hold_with_contacts_where_the_roller_puts_them():
    both, load, skew = pair(), 5e4, 5e-3
    state = equilibrium(both, LAWS, load, SPEED, skew)
    tilt, shift, forces, couple = state.tilt, state.shift, 0.0, 0.0
    for contact in both:
        k, r, bend = contact.side, contact.roller_radius, contact.along
        middle = (-k * tilt + bend * (shift + k * r * tilt)) / contact.lateral
        traction = resultants(contact, load, SPEED, state.slip, skew, middle, tilt).axial
        station = middle + shift + k * r * tilt
        normal = np.array([-k * load, -load * bend * station])  # along y' and z'
        forces += traction + normal[1]
        couple += k * r * (traction + normal[1]) - (station - shift) * normal[0]
    assert forces == pytest.approx(0.0, abs=0.1)
    assert couple == pytest.approx(0.0, abs=0.01)


@pytest.mark.parametrize("guidance", ["conforming-pocket", "straight-bars"])
def test_a_pocket_without_play_holds_a_roller_with_a_finite_force(guidance):
    """Roughness leaves an arm: 1 N m takes a wedge's force, 0.2 kN between conforming and 1.5 kN between straight spars."""
    held = skew_stop(BEARING, guidance, 0.0)
    assert 0.0 < held.largest < 2e-3
    assert 50.0 < 1.0 / held.arm < 2000.0


def test_mixed_film_has_an_equilibrium():
    """Where asperities press, the slope of the spin moment falls on both sides of its zero."""
    laws = prepare(Laws.physical(), BEARING, OIL.at("50 degC"), 1)
    loads, skew = np.geomspace(2e3, 5e4, 12), np.array([0.0, 1e-4, 2e-3])[:, None]
    assert (
        equilibrium(raceways(laws, BEARING, 1), laws, loads, -0.498, skew).unbalanced < 1e-7
    ).all()


def test_the_law_of_shear_decides_the_side_on_which_a_roller_rests():
    assert stable_rests(pair(constant_friction(0.05)), 5e4) == [
        pytest.approx(-0.26e-3, rel=0.1)
    ]  # a second derivation
    assert not stable_rests(pair(), 5e4)


def test_a_pressing_spar_aligns_the_roller():
    (held,) = stable_rests(
        pair(), 5e4, 73.0 * skew_stop(BEARING, "conforming-pocket", 0.5e-3).effective_radius
    )
    assert held == pytest.approx(1e-3, abs=0.5e-3)


@pytest.mark.parametrize(
    ("guidance", "gap"),
    [("conforming-pocket", 0.5e-3), ("conforming-pocket", 5e-5), ("straight-bars", 0.5e-3)],
)
def test_a_roller_at_its_stop_touches_its_pocket(guidance, gap):
    """Arcs of roller and pocket turned against one another, with no small angle."""
    r, half = BEARING.roller_diameter / 2, BEARING.roller_length / 2
    contour = BEARING.osculation_outer * BEARING.outer_raceway_radius

    def clearance(skew):
        def at(zeta):
            x0 = r - (contour - np.sqrt(contour**2 - zeta**2))
            x, z = x0 * np.cos(skew) + zeta * np.sin(skew), zeta * np.cos(skew) - x0 * np.sin(skew)
            wall = r + gap / 2
            if guidance == "conforming-pocket":
                wall -= BEARING.outer_raceway_radius - np.sqrt(
                    BEARING.outer_raceway_radius**2 - z**2
                )
            return wall - x

        return min(
            minimize_scalar(
                at, bounds=(-half, half), method="bounded", options={"xatol": 1e-9}
            ).fun,
            at(half),
        )

    stop = skew_stop(BEARING, guidance, gap)
    touching = brentq(clearance, 1e-5, 0.1)
    assert stop.largest == pytest.approx(touching, rel=0.01)
