"""The SKF model: its maker's rule of thumb, limits, exponents of each part, and errors."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip import Bearing, InputError, Lubricant
from macroslip.torque import OilBath, skf_torque
from macroslip.torque.handbooks import SKF_SERIES as SERIES

BEARING, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
loads = st.floats(min_value=1e3, max_value=1e7)


def oil_of(kinematic):
    """The oil with another kinematic viscosity [mm²/s]."""
    return OIL.replace(viscosity=kinematic * 1e-6 * OIL.density)


def exponent(part, factor=1.01, **changed):
    """Local power with which a part of the torque grows as one input grows."""
    case = {"radial_load": 3e5, "axial_load": 0.0, "shaft_speed": 2.0} | changed.pop("case", {})
    ((key, value),) = changed.items()
    low, high = (
        getattr(skf_torque(BEARING, OIL, **case | {key: v}), part) for v in (value, factor * value)
    )
    return np.log(high / low) / np.log(factor)


@pytest.mark.parametrize("kinematic", [60.0, 150.0, 400.0])
@pytest.mark.parametrize("speed", [5.0, 15.0])
def test_agrees_with_the_rule_of_thumb_where_that_holds(kinematic, speed):
    # M = ½ µ P d with µ = 0.0018 for spherical roller bearings at P = 0.1 C, well lubricated.
    load = 0.1 * BEARING.dynamic_load_rating
    thumb = 0.5 * 0.0018 * load * BEARING.bore_diameter
    assert (
        0.5
        < skf_torque(BEARING, oil_of(kinematic), load, 0.0, speed, oil="mineral oil").total / thumb
        < 2.0
    )


def test_without_load_nothing_resists_but_the_bath():
    dry = skf_torque(BEARING, OIL, 0.0, 0.0, 2.0)
    assert dry.total == 0.0
    wet = skf_torque(BEARING, OIL, 0.0, 0.0, 2.0, bath=OilBath(0.2, 1e-3))
    assert wet.total == wet.drag > 0.0 == wet.rolling == wet.sliding


def test_at_rest_only_starting_friction_resists():
    rest = skf_torque(BEARING, OIL, 3e5, 1e5, 0.0, bath=OilBath(0.2, 1e-3))
    assert rest.rolling == rest.drag == 0.0
    # Boundary friction while turning is 0.12 and before that 0.15.
    creeping = skf_torque(BEARING, OIL, 3e5, 1e5, 1e-9)
    assert rest.sliding / creeping.sliding == pytest.approx(0.15 / 0.12, rel=1e-6)


def test_sliding_friction_falls_from_boundary_to_film():
    speed = np.geomspace(1e-6, 20, 200)
    sliding = skf_torque(BEARING, OIL, 3e5, 1e5, speed).sliding
    assert np.all(np.diff(sliding) <= 0)
    assert sliding[0] / sliding[-1] == pytest.approx(0.12 / 0.04, rel=1e-6)
    mineral = skf_torque(BEARING, OIL, 3e5, 1e5, speed[-1], oil="mineral oil").sliding
    assert mineral / sliding[-1] == pytest.approx(0.05 / 0.04, rel=1e-6)


def test_exponents_of_load():
    # G_rr.e and G_sl.e hold at the loads of this bearing; G_sl of a radial load grows with its 4/3rd power.
    assert exponent("rolling", radial_load=3e5) == pytest.approx(0.54, abs=1e-9)
    assert exponent("sliding", radial_load=3e5) == pytest.approx(4 / 3, abs=1e-9)
    # At heavier loads the linear ones take over.
    assert exponent("rolling", radial_load=1e8) == pytest.approx(0.31, abs=1e-9)
    assert exponent("sliding", radial_load=1e9) == pytest.approx(1.0, abs=1e-9)


def test_rolling_grows_with_the_0_6th_power_of_a_slow_speed_and_less_of_a_fast_one():
    assert exponent("rolling", shaft_speed=1e-6) == pytest.approx(0.6, abs=1e-5)
    powers = [exponent("rolling", shaft_speed=speed) for speed in (0.1, 1.0, 2.0, 5.0)]
    assert all(0.6 > slow > fast for slow, fast in itertools.pairwise(powers))


@pytest.mark.parametrize("series", SERIES)
def test_axial_load_counts_more_than_radial_load(series):
    radial = skf_torque(BEARING, OIL, 2e5, 0.0, 2.0, series=series)
    axial = skf_torque(BEARING, OIL, 0.0, 2e5, 2.0, series=series)
    assert axial.rolling > radial.rolling and axial.sliding > radial.sliding


@given(radial=loads, axial=loads, speed=st.floats(1e-3, 30))
def test_torque_grows_with_either_load_and_signs_do_not_matter(radial, axial, speed):
    torque = skf_torque(BEARING, OIL, radial, axial, speed)
    assert skf_torque(BEARING, OIL, -radial, -axial, -speed).total == torque.total
    for heavier in ((1.1 * radial, axial), (radial, 1.1 * axial)):
        more = skf_torque(BEARING, OIL, *heavier, speed)
        assert more.rolling > torque.rolling and more.sliding >= torque.sliding


def test_starvation_lowers_rolling_friction_in_the_known_order():
    def rolling(bath):
        return skf_torque(BEARING, OIL, 3e5, 1e5, 2.0, bath=bath).rolling

    grease, low, high = rolling(None), rolling(OilBath(0.01, 0.0)), rolling(OilBath(0.1, 0.0))
    assert grease < low < high
    # The exponent of a low bath is half that of grease.
    assert low / high == pytest.approx(np.sqrt(grease / high), rel=1e-12)


def test_drag_grows_with_level_until_the_bearing_is_drowned():
    levels = np.linspace(0.0, 1.2 * 0.735, 40)
    drag = [
        skf_torque(BEARING, OIL, 3e5, 0.0, 2.0, bath=OilBath(level, 1e-3)).drag for level in levels
    ]
    assert drag[0] == 0.0 and np.all(np.diff(drag) > 0)
    over = skf_torque(BEARING, OIL, 3e5, 0.0, 2.0, bath=OilBath(3.0, 1e-3)).drag
    assert over == pytest.approx(drag[-1], rel=1e-12)


def test_drag_exponents_of_speed():
    def power(variable):
        return np.log2(np.divide(*(skf_torque(BEARING, OIL, 0.0, 0.0, speed, bath=OilBath(0.4, variable)).drag
                                   for speed in (4.0, 2.0))))  # fmt: skip

    assert power(0.0) == pytest.approx(2 - 1.379, abs=1e-12)
    assert power(0.0) < power(1e-3) < 2


def test_oil_thicker_than_the_model_knows_is_said():
    assert skf_torque(BEARING, oil_of(100.0), 3e5, 0.0, 2.0).out_of_range == ()
    (note,) = skf_torque(BEARING, oil_of(750.0), 3e5, 0.0, 2.0).out_of_range
    assert note == "viscosity is 750 mm2/s; the model is stated for 2 to 500 mm2/s"
    # The drag does not follow a thicker oil.
    bath = OilBath(0.3, 1e-3)
    thick, limit = (
        skf_torque(BEARING, oil_of(v), 3e5, 0.0, 2.0, bath=bath).drag for v in (900.0, 500.0)
    )
    assert thick == pytest.approx(limit, rel=1e-12)


def test_arrays_broadcast_and_agree_with_single_numbers():
    radial, speed = np.array([0.0, 1e5, 3e5]), np.array([[0.0], [2.0]])
    torque = skf_torque(BEARING, OIL, radial, 5e4, speed, bath=OilBath(0.2, 1e-3))
    for part in (torque.rolling, torque.sliding, torque.drag, torque.total):
        assert part.shape == (2, 3)
    single = skf_torque(BEARING, OIL, 3e5, 5e4, 2.0, bath=OilBath(0.2, 1e-3))
    assert torque.total[1, 2] == pytest.approx(single.total, rel=1e-15)


def test_errors_say_what_is_allowed():
    with pytest.raises(InputError, match="no constants for series '24'. Allowed: .*240"):
        skf_torque(BEARING, OIL, 1.0, 1.0, 1.0, series="24")
    with pytest.raises(
        InputError, match="there is no oil 'water'. Allowed: synthetic oil, mineral oil"
    ):
        skf_torque(BEARING, OIL, 1.0, 1.0, 1.0, oil="water")
    with pytest.raises(InputError, match="no bore_diameter, no width"):
        skf_torque(BEARING.replace(bore_diameter=None, width=None), OIL, 1.0, 1.0, 1.0)
    with pytest.raises(InputError, match="level is -0.1. Allowed: not negative, in metres"):
        OilBath(-0.1, 1e-3)
    with pytest.raises(InputError, match="drag_variable is nan. Allowed: 0 to 0.01"):
        OilBath(0.1, float("nan"))
    with pytest.raises(InputError, match="shaft_speed holds a number that is not finite"):
        skf_torque(BEARING, OIL, 1.0, 1.0, np.inf)
