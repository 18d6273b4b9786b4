"""Bearings built in Python: the same checks, in SI."""

import math
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip.bearing import Bearing
from macroslip.errors import InputError
from macroslip.input.record import Provenance, quantities
from tests.records import values_of


@pytest.fixture(scope="module")
def base():
    return Bearing.read("skf-240-600-bc")


def test_constructor_takes_si_numbers(base):
    bearing = Bearing(**values_of(base))
    assert values_of(bearing) == values_of(base)
    assert bearing.provenance["contact_angle"] == Provenance(base.contact_angle, "rad", "U", "")
    assert Bearing.from_dict(bearing.as_dict()) == bearing


def test_constructor_tells_all_problems_together(base):
    values = values_of(base) | {"density": -1.0, "mas": 3.0}
    del values["hardness"]
    with pytest.raises(InputError) as caught:
        Bearing(**values)
    message = str(caught.value)
    assert message.startswith(
        "3 problems: (1) the key 'mas' is unknown. Did you mean 'mass'? (2) density: it is -1.0 kg/m3."
    )
    assert (
        "density: it is -1.0 kg/m3. Allowed: 500 to 25000 kg/m3. It is the density of the rollers; check value and unit."
        in message
    )
    assert (
        "(3) 'hardness' is missing (Vickers hardness of the softer surface, as a pressure). Allowed: a number"
        in message
    )
    assert "pydantic" not in message


def test_replace_checks_and_marks_what_it_replaced(base):
    other = base.replace(diametral_clearance=1e-4, title="mine")
    assert (other.diametral_clearance, other.title) == (1e-4, "mine")
    assert other.provenance["diametral_clearance"] == Provenance(1e-4, "m", "U", "")
    assert (
        other.provenance["mass"] is not None and other.provenance["mass"] == base.provenance["mass"]
    )
    assert base.diametral_clearance == 2e-4
    with pytest.raises(
        InputError, match="^contact_angle: it is 11.2 rad. Allowed: 0 to below 0.785398 rad"
    ):
        base.replace(contact_angle=11.2)
    with pytest.raises(
        InputError, match="^the key 'roller_lenght' is unknown. Did you mean 'roller_length'"
    ):
        base.replace(roller_lenght=0.1)


@pytest.mark.parametrize(
    "value", ["7850", None, True, math.nan, math.inf, [7850.0], 10**400, 7850j]
)
def test_what_is_no_finite_number_is_refused(base, value):
    with pytest.raises(InputError, match="^density: it is "):
        base.replace(density=value)


def test_numpy_numbers_are_welcome(base):
    other = base.replace(
        density=np.float32(7800), rollers_per_row=np.int64(27), mass=np.float64(500)
    )
    assert (type(other.density), type(other.rollers_per_row), type(other.mass)) == (
        float,
        int,
        float,
    )
    assert base.replace(rollers_per_row=27.0).rollers_per_row == 27


def test_a_copy_with_other_values_is_checked(base):
    assert base.replace() == base != base.replace(diametral_clearance=1e-4)
    with pytest.raises(InputError, match="^34 rollers do not fit"):
        base.replace(rollers_per_row=34)
    with pytest.raises(InputError, match="^roller_diameter: it is -1.0 m"):
        base.replace(roller_diameter=-1.0)


def test_values_cannot_be_set(base):
    with pytest.raises(InputError, match=r"mass cannot be set.*replace\(mass=\.\.\.\)"):
        base.mass = 1.0
    with pytest.raises(TypeError):
        base.provenance["mass"] = None


# The ends of each range, in SI.
RANGES = {
    "bore_diameter": (0, 10), "outside_diameter": (0, 10), "width": (0, 5), "dynamic_load_rating": (0, 1e9),
    "static_load_rating": (0, 1e9), "fatigue_load_limit": (0, 1e9), "axial_factor_e": (0, 5), "axial_factor_y1": (0, 100), "axial_factor_y2": (0, 100),
    "axial_factor_y0": (0, 100), "mass": (0, 1e6), "rollers_per_row": (2, 501), "roller_diameter": (0, 1),
    "roller_length": (0, 2), "contact_angle": (-1e-9, math.pi / 4), "pitch_radius": (0, 5),
    "outer_raceway_radius": (0, 10), "row_offset": (-1e-9, 5), "osculation_inner": (0.9, 1),
    "osculation_outer": (0.9, 1), "diametral_clearance": (-1e-3, 5e-3), "youngs_modulus": (1e9, 1e12),
    "poisson_ratio": (-1e-9, 0.5), "density": (500, 25000), "cage_youngs_modulus": (1e8, 1e12),
    "cage_poisson_ratio": (-1e-9, 0.5),
    "composite_roughness": (0, 1e-4), "hardness": (1e8, 1e11),
    "thermal_conductivity": (0, 1000), "specific_heat": (0, 10000), "roller_crown_radius": (0, 1000),
    "out_of_round_second": (-1e-3, 1e-3), "out_of_round_third": (-1e-3, 1e-3), "out_of_round_angle": (-math.pi, math.pi),
}  # fmt: skip


@pytest.mark.parametrize("key", list(quantities(Bearing)))
def test_every_quantity_has_a_range(base, key):
    low, high = RANGES[key]
    step = 1 if key == "rollers_per_row" else 1e-6 * (high - low)
    reported = re.compile(
        rf"\b{key.replace('round_', 'round[._]')}: it is [^ ]+( [^.]+)?\. Allowed: (a whole number, )?(above )?\S+,? (to|up to|and|to below) "
    )
    for outside in (low - step, high + step):
        with pytest.raises(InputError, match=reported):
            base.replace(**{key: outside})
    for inside in (low + step, high - step):
        try:
            assert getattr(base.replace(**{key: inside}), key) == inside
        except InputError as error:  # within its range, but inconsistent with the other values
            assert not reported.search(str(error))


def test_rollers_have_to_fit(base):
    assert base.replace(rollers_per_row=33).rollers_per_row == 33
    with pytest.raises(
        InputError,
        match="^34 rollers do not fit .* centres are 68.7.* mm apart.*at most 33 rollers",
    ):
        base.replace(rollers_per_row=34)


@given(st.integers(3, 60), st.floats(0.02, 0.15))
@settings(max_examples=50, deadline=None)
def test_the_largest_number_of_rollers_is_reported_right(count, diameter):
    # Without the values of the whole bearing, which go with its own rollers.
    base = Bearing.read("skf-240-600-bc").replace(
        bore_diameter=None,
        outside_diameter=None,
        width=None,
        dynamic_load_rating=None,
        static_load_rating=None,
        fatigue_load_limit=None,
    )
    centre = 0.38
    sphere = {"outer_raceway_radius": centre + diameter / 2, "pitch_radius": centre * math.cos(base.contact_angle),
              "row_offset": centre * math.sin(base.contact_angle), "roller_diameter": diameter,
              "roller_length": 0.6 * diameter}  # fmt: skip
    try:
        base.replace(rollers_per_row=count, **sphere)
    except InputError as error:
        most = int(str(error).split("at most ")[1].split()[0])
        assert most < count
        assert base.replace(rollers_per_row=most, **sphere).rollers_per_row == most
        with pytest.raises(InputError, match="do not fit"):
            base.replace(rollers_per_row=most + 1, **sphere)


def test_roller_centres_have_to_lie_on_the_sphere(base):
    for key, formula in (("pitch_radius", "cos"), ("row_offset", "sin")):
        value = getattr(base, key)
        reported = rf"^{key} is .* roller_diameter/2\) {formula}\(contact_angle\) = .* m\. Allowed: agreement within 1%"
        with pytest.raises(InputError, match=reported):
            base.replace(**{key: 1.015 * value})
        assert getattr(base.replace(**{key: 1.006 * value}), key) == 1.006 * value


def test_roller_and_ring_proportions_have_to_be_sane(base):
    with pytest.raises(
        InputError, match="^roller_length is 0.3 m, which is 4.29 times .* Allowed: 0.5 to 4"
    ):
        base.replace(roller_length=0.3)
    with pytest.raises(InputError, match="^roller_length is 0.03 m"):
        base.replace(roller_length=0.03)
    with pytest.raises(
        InputError, match="^bore_diameter is 0.9 m. Allowed: less than outside_diameter, 0.87 m."
    ):
        base.replace(bore_diameter=0.9)


def test_thermal_data_may_be_left_out_and_are_asked_for_by_name(base):
    old = base.replace(thermal_conductivity=None, specific_heat=None)
    assert "specific_heat" not in old.as_dict() and Bearing.from_dict(old.as_dict()) == old
    keys = ("thermal_conductivity", "specific_heat", "density")
    base.require(*keys, purpose="the flash temperature")
    with pytest.raises(InputError) as caught:
        old.require(*keys, purpose="the flash temperature")
    assert str(caught.value) == (
        "bearing skf-240-600-bc: it has no thermal_conductivity, no specific_heat, which the flash temperature needs. "
        "Allowed: thermal_conductivity: above 0, up to 1000 W/(m K); specific_heat: above 0, up to 10000 J/(kg K). Add to its file: thermal_conductivity: {value: ..., unit: W/(m K)}, "
        "specific_heat: {value: ..., unit: J/(kg K)}."
    )


@pytest.mark.parametrize(
    ("key", "value", "expected"),
    [
        ("dynamic_load_rating", 1.0, "7084 kN"),  # 0.001 kN; ISO 281 as in load_ratings' example
        ("dynamic_load_rating", 8.5e8, "7084 kN"),
        ("static_load_rating", 17.6, "16283"),  # 17.6 N, ISO 76
        ("fatigue_load_limit", 1e9, "1087"),
        ("mass", 519e3, "665.6 kg"),  # pi/4 (0.87^2 - 0.6^2) 0.272 m3 of steel with 7850 kg/m3
    ],
)
def test_ratings_and_mass_in_another_unit_are_refused(base, key, value, expected):
    with pytest.raises(InputError, match=f"{key} is .* rings and rollers of this size") as caught:
        base.replace(**{key: value})
    assert "unit" in str(caught.value)
    number = float(expected.split()[0])
    told = float(str(caught.value).partition("size have ")[2].split()[0])
    assert told == pytest.approx(number, rel=2e-3) or told == pytest.approx(1e3 * number, rel=2e-3)
