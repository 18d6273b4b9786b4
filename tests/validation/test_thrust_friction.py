"""Friction of thrust bearings: the model of the bearing against the program's patch, and the agreement that was found."""

import math

import pytest

from macroslip import Laws
from macroslip.contact.patch import Patch, patch_tractions
from macroslip.contact.traction import chord_table, prepare_fluid
from validation import thrust_friction as friction
from validation.thrust_bearing import ROLLER_81107, ThrustBearing, friction_torque, interface_of

BEARING = ThrustBearing(20, 4.2e-3, 5e-3, 21.75e-3, True, 0.0, 0.05)


@pytest.mark.slow
def test_crowned_roller_is_the_programs_patch():
    oil = friction.estimated("PAOR").at("75 degC")
    fluid = prepare_fluid(Laws.physical(), oil)
    speed, load = 60.0, 350.0
    sliding = friction_torque(BEARING, oil, fluid, 20 * load, speed).sliding
    contact = interface_of(BEARING, load, oil)
    hertz, washer = contact.hertz, 0.5 * speed * BEARING.pitch_radius
    # v = −s ζ with s/u2 = 1/R: the washer turns under the roller, and the contour has no drop.
    patch = Patch(
        True, 1e9, 2.5e-3, 2.1e-3, 1e-9, 1.0 / BEARING.pitch_radius, hertz.semi_axis_across, hertz.semi_axis_along,
        hertz.pressure, 0.0, 1e-4,
    )  # fmt: skip
    from macroslip.contact.film import inlet_heating_factor, masjedi_khonsari_moes, thermal_loading

    film = masjedi_khonsari_moes(contact, load, washer) * inlet_heating_factor(
        thermal_loading(contact.lubricant) * washer**2
    )
    parts = patch_tractions(patch, chord_table(fluid), load, film, 0.0, washer, 0.0)
    power = -washer / BEARING.pitch_radius * parts[2]
    assert sliding == pytest.approx(2 * 20 * power / speed, rel=2e-3)


@pytest.mark.parametrize(("crowned", "arm"), [(False, 1.0 / 4.0), (True, 3.0 / 16.0)])
def test_friction_of_a_constant_coefficient_has_the_arm_of_the_profile(crowned, arm):
    # Rough enough for asperities to carry all: µ_b F times the mean distance from the roller's middle.
    bearing = BEARING._replace(crowned=crowned, roughness=2e-6)
    oil = friction.estimated("MINR").at("100 degC")
    sliding = friction_torque(bearing, oil, prepare_fluid(Laws.physical(), oil), 7e3, 10.0).sliding
    assert sliding == pytest.approx(0.05 * 7e3 * 4.2e-3 * arm, rel=1e-3)


def test_rebuilt_torque_is_the_catalogues_form():
    assert ROLLER_81107.sliding_of_unit(7e3) == pytest.approx(11.18, abs=0.01)
    # So fast that the film is full, φ_bl = e^−15: the film's coefficient alone.
    assert ROLLER_81107.torque(1.0, 0.0177, 100.0, 7e3, 1200.0).sliding == pytest.approx(
        0.0177 * 11.18, rel=1e-3
    )


def test_published_coefficients_are_of_another_contact():
    low, high = friction.boundary_friction()
    assert 0.034 < low < 0.035
    assert 0.088 < high < 0.10


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "low", "high"),
    [
        ("MINR", 0.73, 1.58),
        ("MINE", 0.73, 1.62),
        ("PAOR", 0.63, 1.49),
        ("ESTR", 0.57, 1.43),
        ("PAGD", 0.72, 1.46),
    ],
)
def test_torque_lies_around_the_measured_one(name, low, high):
    _, _, ratio = friction.torques(name, "eyring", friction.FAST)
    assert low < ratio.low < 1.0 < ratio.high < high


@pytest.mark.slow
def test_estimated_coefficients_of_mineral_oil_and_pao_give_the_measured_friction_and_others_are_low():
    factor = {name: friction.needed_coefficient(name)[0] for name in friction.oils().index}
    for name in ("MINR", "MINE", "PAOR"):
        assert factor[name].low < 1.0 < factor[name].high
    for name in ("ESTR", "PAGD"):
        assert 1.0 < factor[name].low < factor[name].high < 1.42


@pytest.mark.slow
def test_laws_of_shear_are_not_told_apart():
    for name in ("MINR", "PAGD"):
        eyring, limit = (
            friction.torques(name, law, friction.FAST)[2] for law in friction.RHEOLOGIES
        )
        assert eyring.low < 1.0 < eyring.high
        assert limit.low < 1.0 < limit.high
        assert math.log(limit.high / eyring.high) < 0.06


def test_spin_alone_cannot_be_the_ball_bearings_film_friction():
    # The limit of a paraffinic mineral oil is 0.044 to 0.050.
    assert friction.spin_friction("MINR").low > 1.15 * 0.050


@pytest.mark.slow
def test_half_the_eyring_stress_serves_a_mineral_oil_and_none_serves_most_bearings_with_ester_and_polyglycol():
    every = len(friction.TEMPERATURES) * len(friction.bearings())
    none, factor = friction.needed_eyring_stress("MINR")
    assert none == 0
    assert factor.low < 0.5 < 1.0 < factor.high < 1.4
    assert all(friction.needed_eyring_stress(name)[0] > 0.8 * every for name in ("ESTR", "PAGD"))
