"""What the chord table is made of: the local stress by table, and a straight line beyond all slips of a contact."""

import math

import numpy as np
import pytest

from macroslip import Lubricant
from macroslip.mechanisms import Laws
from macroslip.roller.contacts import fluid
from macroslip.traction.chord import chord_stress
from macroslip.traction.chord_build import local_stress, looked_up
from macroslip.traction.chord_table import chord_table, film_place, interpolated_stress
from macroslip.traction.film_shear import heated_shear
from macroslip.traction.rheology import EYRING, LIMITING_SHEAR


@pytest.mark.parametrize("rheology", [LIMITING_SHEAR, EYRING])
def test_looked_up_stress_is_that_of_the_heat_balance(rheology):
    table, random = local_stress(rheology), np.random.default_rng(3)
    assert table.good.mean() > 0.9
    for viscous, heat in zip(random.uniform(-20.0, 12.0, 5000), random.uniform(-30.0, 10.0, 5000), strict=True):
        expected = heated_shear(rheology, math.exp(viscous), 1.0, math.exp(heat))[0]
        assert looked_up(table, rheology, viscous, heat) == pytest.approx(math.log(expected), abs=5e-6)


@pytest.mark.parametrize("rheology", ["limiting-shear", "eyring", "newtonian"])
def test_a_chord_is_good_up_to_the_slip_of_a_shaft_that_turns_round(rheology):
    oil = fluid(Laws.physical().but(rheology=rheology), Lubricant.read("vg460-pao"))
    table, random = chord_table(oil), np.random.default_rng(5)
    for _ in range(500):
        pressure, film = 10.0 ** random.uniform(3.0, 7.0), 10.0 ** random.uniform(-7.0, -4.5)
        slip = random.uniform(1.0, 5.0)
        found = interpolated_stress(table, film_place(table, film), pressure, slip, False).stress
        assert found == pytest.approx(chord_stress(oil, pressure, film, slip), rel=1e-3)
