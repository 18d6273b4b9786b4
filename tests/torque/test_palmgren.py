"""Palmgren's torque: the other table it has to agree with, its exponents, limits and errors."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip import Bearing, InputError, Lubricant
from macroslip.torque import palmgren_torque
from macroslip.torque.handbooks import PALMGREN_SERIES as SERIES

BEARING, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
MEAN_DIAMETER = 0.735
loads = st.floats(min_value=1e2, max_value=1e7)

#: f1 of ISO 15312, at a radial load of 0.05 C0.
STANDARD = {"213": 0.00019, "222": 0.00019, "223": 0.00030, "230": 0.00017, "231": 0.00027, "232": 0.00036,
            "240": 0.00027, "241": 0.00049}  # fmt: skip


@pytest.mark.parametrize("series", SERIES)
def test_load_part_is_that_of_the_standard_at_its_reference_load(series):
    load = 0.05 * BEARING.static_load_rating
    torque = palmgren_torque(BEARING, OIL, load, 0.0, 2.0, series=series)
    assert round(torque.load / (load * MEAN_DIAMETER), 5) == STANDARD[series]


def test_slow_viscous_part_in_si():
    # 160e-7 N mm per mm³ are 16 Pa.
    torque = palmgren_torque(BEARING, OIL, 0.0, 0.0, 1e-3)
    assert torque.viscous == pytest.approx(16 * 6.5 * MEAN_DIAMETER**3, rel=1e-12)


def test_viscous_part_grows_with_the_two_thirds_power_of_speed_and_viscosity():
    slow = palmgren_torque(BEARING, OIL, 1e5, 1e4, 2.0)
    assert palmgren_torque(BEARING, OIL, 1e5, 1e4, -16.0).viscous == pytest.approx(
        4 * slow.viscous, rel=1e-12
    )
    thick = OIL.replace(viscosity=8 * OIL.viscosity)
    assert palmgren_torque(BEARING, thick, 1e5, 1e4, 2.0).viscous == pytest.approx(
        4 * slow.viscous, rel=1e-12
    )


def test_step_between_slow_and_fast_is_small():
    viscosity = OIL.viscosity / OIL.density * 1e6
    edge = 2000 / viscosity * np.pi / 30
    below, above = palmgren_torque(
        BEARING, OIL, 0.0, 0.0, edge * np.array([1 - 1e-9, 1 + 1e-9])
    ).viscous
    assert below / above - 1 == pytest.approx(0.008, abs=2e-4)


@given(radial=loads, axial=loads, speed=st.floats(0, 50))
def test_load_part_scales_with_load_and_not_with_speed(radial, axial, speed):
    torque = palmgren_torque(BEARING, OIL, radial, axial, speed)
    # f1 grows with the root of the load.
    doubled = palmgren_torque(BEARING, OIL, 2 * radial, 2 * axial, 3 * speed)
    assert doubled.load == pytest.approx(2**1.5 * torque.load, rel=1e-12, abs=0.0)
    assert palmgren_torque(BEARING, OIL, -radial, -axial, -speed).total == torque.total
    assert palmgren_torque(BEARING, OIL, radial, 1.01 * axial, speed).load > torque.load


def test_driving_load_is_continuous_where_thrust_takes_over():
    axial = BEARING.axial_factor_e * 3e5 * np.array([1 - 1e-9, 1 + 1e-9])
    less, more = palmgren_torque(BEARING, OIL, 3e5, axial, 2.0).load
    assert less == pytest.approx(more, rel=1e-8)


def test_without_load_only_oil_resists():
    torque = palmgren_torque(BEARING, OIL, 0.0, 0.0, 2.0)
    assert torque.load == 0.0 and torque.total == torque.viscous > 0


def test_arrays_broadcast_and_agree_with_single_numbers():
    radial, speed = np.array([0.0, 1e5, 3e5]), np.array([[0.0], [2.0]])
    torque = palmgren_torque(BEARING, OIL, radial, 5e4, speed)
    assert torque.viscous.shape == torque.load.shape == torque.total.shape == (2, 3)
    assert torque.total[1, 2] == palmgren_torque(BEARING, OIL, 3e5, 5e4, 2.0).total


def test_errors_say_what_to_do():
    with pytest.raises(
        InputError,
        match="no constants for series '999'. Allowed: 213, 222.*beginning of the bearing",
    ):
        palmgren_torque(BEARING, OIL, 1.0, 1.0, 1.0, series="999")
    with pytest.raises(
        InputError, match="no static_load_rating, no axial_factor_y0. Add what is missing"
    ):
        palmgren_torque(
            BEARING.replace(static_load_rating=None, axial_factor_y0=None), OIL, 1.0, 1.0, 1.0
        )
    with pytest.raises(InputError, match="axial_load holds a number that is not finite"):
        palmgren_torque(BEARING, OIL, 1.0, [0.0, np.nan], 1.0)
