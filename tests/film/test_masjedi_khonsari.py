"""Masjedi and Khonsari's film against the formula in 30 digits, and its place in the list of laws."""

import math
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip.bearing import Bearing
from macroslip.contact.hertz import elliptical_contact
from macroslip.contact.interface import Interface
from macroslip.errors import InputError
from macroslip.film import film_law as law
from macroslip.film import masjedi_khonsari_thickness
from macroslip.film.masjedi_khonsari import masjedi_khonsari
from macroslip.lubricant import Lubricant
from macroslip.roller.model import interfaces

RATED_SURFACE_SPEED = 0.39594  # Ω r~_out at 20.463 rpm [m/s]

loads = st.floats(-1.0, 5.2).map(lambda x: 10.0**x)
speeds = st.floats(-6.0, 1.0).map(lambda x: 10.0**x)


def formula(load, speed, material, roughness, hardness):
    """H of the correlation in high precision, exponents as decimals."""
    d = mpmath.mpf
    smooth = d("2.691") * d(load) ** d("-0.135") * d(speed) ** d("0.705") * d(material) ** d("0.556")
    rough = d("0.2") * d(roughness) ** d("1.222") * d(hardness) ** d("0.223") * d(load) ** d("-0.229")
    return smooth * (1 + rough * d(speed) ** d("-0.748") * d(material) ** d("-0.842"))


def thickness(interface, load, entrainment_speed):
    """h [m] of an interface from its dimensionless groups, with w = 3Q/(4a)."""
    radius, modulus, oil = mpmath.mpf(interface.rolling_radius), mpmath.mpf(interface.modulus), interface.lubricant
    semi_axis = interface.hertz.semi_axis_across * mpmath.cbrt(load)
    return radius * formula(
        3 * mpmath.mpf(load) / (4 * semi_axis) / (modulus * radius),
        oil.viscosity * mpmath.mpf(entrainment_speed) / (modulus * radius),
        oil.pressure_viscosity * modulus,
        interface.roughness / radius,
        interface.hardness / modulus,
    )


@pytest.fixture(scope="module")
def base():
    return interfaces(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"))


@pytest.fixture(scope="module")
def laws(base):
    return [law.prepare("masjedi-khonsari", interface) for interface in base]


@pytest.mark.parametrize("load", [2e-5, 1e-4, 5e-4])
@pytest.mark.parametrize("speed", [1e-12, 1e-11, 1e-10])
@pytest.mark.parametrize("material", [2500.0, 4846.0, 7500.0])
@pytest.mark.parametrize("roughness", [0.0, 1e-5, 5e-5])
@pytest.mark.parametrize("hardness", [0.005, 0.03])
def test_correlation_over_its_range(load, speed, material, roughness, hardness):
    groups = (load, speed, material, roughness, hardness)
    assert masjedi_khonsari(*groups) == pytest.approx(float(formula(*groups)), rel=1e-13, abs=0.0)


def test_roughness_thickens_the_film():
    smooth, rough = (masjedi_khonsari(1e-4, 1e-11, 4846.0, roughness, 0.03) for roughness in (0.0, 2e-5))
    assert smooth == pytest.approx(1.8365e-5, rel=1e-4, abs=0.0)
    assert 1.0 < rough / smooth < 3.0


@pytest.mark.parametrize("number", [0, 1, 2], ids=["inner", "outer", "cage"])
@given(load=loads, speed=speeds)
@settings(deadline=None, max_examples=60)
def test_prepared_law_is_the_correlation(base, laws, number, load, speed):
    height, by_speed, by_load = law.film_thickness(laws[number], load, speed)
    with mpmath.workdps(30):
        assert height == pytest.approx(float(thickness(base[number], load, speed)), rel=1e-12, abs=0.0)
        slope = mpmath.diff(lambda u: thickness(base[number], load, u), mpmath.mpf(speed), h=mpmath.mpf(speed) * 1e-9)
        assert by_speed == pytest.approx(float(slope), rel=1e-9, abs=0.0)
        slope = mpmath.diff(lambda q: thickness(base[number], q, speed), mpmath.mpf(load), h=mpmath.mpf(load) * 1e-9)
        assert by_load == pytest.approx(float(slope), rel=1e-9, abs=0.0)


def test_signs_film_grows_with_speed_and_shrinks_with_load(laws):
    for prepared in laws[:2]:
        _, by_speed, by_load = law.film_thickness(prepared, 2e4, RATED_SURFACE_SPEED)
        assert by_speed > 0.0 > by_load


def smooth_interface(base):
    return base[0]._replace(roughness=0.0)


def test_smooth_surfaces_give_pure_powers(base):
    prepared = law.prepare("masjedi-khonsari", smooth_interface(base))
    height, by_speed, by_load = law.film_thickness(prepared, 2e4, 0.4)
    assert height == pytest.approx(float(thickness(smooth_interface(base), 2e4, 0.4)), rel=1e-13, abs=0.0)
    faster, _, _ = law.film_thickness(prepared, 2e4, 4.0)
    heavier, _, _ = law.film_thickness(prepared, 2e5, 0.4)
    assert math.log10(faster / height) == pytest.approx(0.705, abs=1e-13)
    # W goes with Q^(2/3).
    assert math.log10(heavier / height) == pytest.approx(-0.135 * 2 / 3, abs=1e-13)
    assert (by_speed, by_load) == pytest.approx((0.705 * height / 0.4, -0.09 * height / 2e4), rel=1e-13, abs=0.0)


def test_lubricant_enters_with_the_exponents_of_its_groups(base):
    def height(**changes):
        interface = smooth_interface(base)
        oil = interface.lubricant.replace(**changes)
        return law.film_thickness(law.prepare("masjedi-khonsari", interface._replace(lubricant=oil)), 2e4, 0.4)[0]

    assert math.log2(height(viscosity=1.08) / height()) == pytest.approx(0.705, abs=1e-12)
    assert math.log2(height(pressure_viscosity=42e-9) / height()) == pytest.approx(0.556, abs=1e-12)


def test_elementwise_function_takes_floats_and_arrays():
    single = masjedi_khonsari_thickness(1e-4, 1e-11, 4846.0, 1e-5, 0.03)
    assert np.ndim(single) == 0 and single == masjedi_khonsari(1e-4, 1e-11, 4846.0, 1e-5, 0.03)
    load, speed = np.array([2e-5, 1e-4, 5e-4]), np.array([[1e-12], [1e-11]])
    table = masjedi_khonsari_thickness(load, speed, 4846.0, 1e-5, hardness=0.03)
    assert table.shape == (2, 3) and table.dtype == float
    for i in range(2):
        for k in range(3):
            assert table[i, k] == masjedi_khonsari(load[k], speed[i, 0], 4846.0, 1e-5, 0.03)


def bounded(base, **changes):
    """An interface that lies in the middle of the range of every group that does not depend on load or speed."""
    oil = SimpleNamespace(viscosity=0.54, pressure_viscosity=5000.0 / base[0].modulus)
    values = {"roughness": 1e-5 * base[0].rolling_radius, "hardness": 0.02 * base[0].modulus, "lubricant": oil}
    return base[0]._replace(**values | changes)


def test_range_flag_changes_at_the_edges_of_load_and_speed(base):
    interface = bounded(base)
    prepared = law.prepare("masjedi-khonsari", interface)
    load_unit = interface.modulus * interface.rolling_radius
    speed_unit = load_unit / 0.54

    def load(group):
        # w = 3Q/(4a), a = a1 Q^(1/3).
        return (group * load_unit * 4.0 / 3.0 * interface.hertz.semi_axis_across) ** 1.5

    for group, inside in [(1.99e-5, False), (2.01e-5, True), (4.99e-4, True), (5.01e-4, False)]:
        assert law.film_in_range(prepared, load(group), 1e-11 * speed_unit) is inside
    for group, inside in [(0.99e-12, False), (1.01e-12, True), (0.99e-10, True), (1.01e-10, False)]:
        assert law.film_in_range(prepared, load(1e-4), group * speed_unit) is inside


def test_cage_contact_lies_far_outside_the_range(base, laws):
    # Weight and drag of a roller on the pocket: W ~ 1e-8, about 8 µm by the formula.
    cage, speed = base[2], RATED_SURFACE_SPEED / 2
    load = 30.0
    group = 0.75 * load ** (2 / 3) / cage.hertz.semi_axis_across / (cage.modulus * cage.rolling_radius)
    assert 0.5e-8 < group < 5e-8
    assert law.film_thickness(laws[2], load, speed)[0] == pytest.approx(8e-6, rel=0.05, abs=0.0)
    assert not law.film_in_range(laws[2], load, speed)


def test_unknown_law_is_reported_with_the_choices():
    interface = Interface("inner", elliptical_contact(1.0, 1.0, 1e11), 1.0, 1e11, 0.0, 1e9, None)
    with pytest.raises(InputError, match="^laws.film: there is no film law 'dowson'. Allowed: .*masjedi-khonsari"):
        law.prepare("dowson", interface)
    assert "masjedi-khonsari" in law.names()
    assert "10.1115/1.4005514" in law.reference("masjedi-khonsari")


def test_groups_outside_the_range_whatever_the_load_are_reported():
    from macroslip import Bearing, Lubricant
    from macroslip.film.film_law import film_range_notes
    from macroslip.roller.model import interfaces

    bearing, lubricant = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
    notes = film_range_notes("masjedi-khonsari", interfaces(bearing, lubricant))
    # V = 7.0/230.77 = 0.0303 at every interface, just above 0.03.
    assert notes == [
        f"{name}: the hardness group 0.03033 is outside 0.005 to 0.03" for name in ("inner", "outer", "cage")
    ]
    softer = bearing.replace(hardness=6.5e9)
    assert film_range_notes("masjedi-khonsari", interfaces(softer, lubricant)) == []
