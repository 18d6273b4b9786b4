"""Film laws against their formulas in 40 digits, their ranges and their joints."""

import math
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip import Bearing
from macroslip.contact import film
from macroslip.contact.film import log_moes

RATED_SURFACE_SPEED = 0.39594  # Ω r~_out at 20.463 rpm [m/s]
NUMBERS = pytest.mark.parametrize("number", [0, 1, 2], ids=["inner", "outer", "cage"])
LAWS = {"heavy": film.masjedi_khonsari, "light": film.moes, "every": film.masjedi_khonsari_moes}
log_loads, log_speeds = st.floats(-3.0, math.log10(3e5)), st.floats(-6.0, 1.0)
d = mpmath.mpf


def heavy_formula(load, speed, material, roughness, hardness):
    """Masjedi and Khonsari's smooth H and roughness term, exponents as decimals."""
    smooth = (
        d("2.691") * d(load) ** d("-0.135") * d(speed) ** d("0.705") * d(material) ** d("0.556")
    )
    rough = (
        d("0.2") * d(roughness) ** d("1.222") * d(hardness) ** d("0.223") * d(load) ** d("-0.229")
    )
    return smooth, rough * d(speed) ** d("-0.748") * d(material) ** d("-0.842")


def light_formula(load, material):
    """Moes' N, coefficients as decimals."""
    load, material = d(load), d(material)
    rigid, elastic = 3 / load, d("2.621") * load ** d("-0.2")
    stiff, heavy = (
        d("1.287") * material ** (d(2) / 3),
        d("1.311") * load ** d("-0.125") * material ** d("0.75"),
    )
    s = (7 + 8 * mpmath.exp(-2 * elastic / rigid)) / 5
    isoviscous = (rigid ** (d(7) / 3) + elastic ** (d(7) / 3)) ** (3 * s / 7)
    return (isoviscous + (stiff ** d("-3.5") + heavy ** d("-3.5")) ** (-2 * s / 7)) ** (1 / s)


def exact(law, interface, load, speed):
    """h of each law from the interface's data, with w = 3Q/(4a)."""
    radius, modulus, oil = d(interface.rolling_radius), d(interface.modulus), interface.lubricant
    w = (
        3
        * d(load)
        / (4 * d(interface.hertz.semi_axis_across) * mpmath.cbrt(d(load)))
        / (modulus * radius)
    )
    u = d(oil.viscosity) * d(speed) / (modulus * radius)
    g = d(oil.pressure_viscosity) * modulus
    sigma, v = d(interface.roughness) / radius, d(interface.hardness) / modulus
    smooth, rough = heavy_formula(w, u, g, sigma, v)
    if law == "heavy":
        return radius * smooth * (1 + rough)
    light = (
        radius
        * mpmath.sqrt(2 * u)
        * light_formula(w / mpmath.sqrt(2 * u), g * mpmath.root(2 * u, 4))
    )
    if law == "light":
        return light
    pressure = d(interface.hertz.pressure) * mpmath.cbrt(load) / d("1e9")
    light /= 1 + d("0.6") * pressure / (1 + d("1.7") * pressure)
    fraction = min(max(mpmath.log10(w / d("2e-6")), d(0)), d(1))
    weight = fraction**3 * (10 - 15 * fraction + 6 * fraction**2)
    level_w, level_u = mpmath.sqrt(w**2 + d("2e-6") ** 2), mpmath.sqrt(u**2 + d("1e-13") ** 2)
    gap = radius * d("2.691") * d("0.2") * sigma ** d("1.222") * v ** d("0.223")
    gap *= level_w ** d("-0.364") * level_u ** d("-0.043") * g ** d("-0.286")
    return (radius * smooth) ** weight * light ** (1 - weight) + gap


def group(interface, load):
    """W of an interface."""
    return (
        0.75
        * load ** (2 / 3)
        / interface.hertz.semi_axis_across
        / (interface.modulus * interface.rolling_radius)
    )


@pytest.mark.parametrize("law", LAWS)
@NUMBERS
@given(log_load=log_loads, log_speed=log_speeds)
@settings(deadline=None, max_examples=60)
def test_every_law_is_its_formula(base, law, number, log_load, log_speed):
    load, speed = 10.0**log_load, 10.0**log_speed
    with mpmath.workdps(40):
        for interface in (base[number], base[number]._replace(roughness=0.0)):
            expected = float(exact(law, interface, load, speed))
            assert LAWS[law](interface, load, speed) == pytest.approx(expected, rel=1e-11, abs=0.0)


@pytest.mark.parametrize("law", LAWS)
def test_arrays_broadcast_and_give_what_numbers_give(base, law):
    load, speed = np.array([1.0, 1e3, 1e5]), np.array([[0.01], [1.0]])
    table = LAWS[law](base[0], load, speed)
    assert table.shape == (2, 3) and table.dtype == float
    for i in range(2):
        for k in range(3):
            assert table[i, k] == pytest.approx(LAWS[law](base[0], load[k], speed[i, 0]), rel=1e-14)
    assert np.ndim(LAWS[law](base[0], 1e3, 0.4)) == 0


def test_range_changes_at_the_edges_of_load_and_speed(base):
    interface = base[0]
    load_unit = interface.modulus * interface.rolling_radius
    speed_unit = load_unit / interface.lubricant.viscosity

    def load(group):
        # w = 3Q/(4a), a = a1 Q^(1/3).
        return (np.array(group) * load_unit * 4.0 / 3.0 * interface.hertz.semi_axis_across) ** 1.5

    ends = [False, True, True, False]
    by_load = film.masjedi_khonsari_in_range(
        interface, load([1.99e-5, 2.01e-5, 4.99e-4, 5.01e-4]), 1e-11 * speed_unit
    )
    speeds = np.array([0.99e-12, 1.01e-12, 0.99e-10, 1.01e-10]) * speed_unit
    by_speed = film.masjedi_khonsari_in_range(interface, load(1e-4), speeds)
    assert by_load.tolist() == by_speed.tolist() == ends


def test_groups_outside_the_range_whatever_the_load_are_noted(base):
    # V = 7.0/230.77 = 0.0303 at every interface, just above 0.03.
    assert film.masjedi_khonsari_notes(base[0]) == [
        "the hardness group 0.03033 is outside 0.005 to 0.03"
    ]
    oil = SimpleNamespace(viscosity=0.54, pressure_viscosity=5000.0 / base[0].modulus)
    bounded = base[0]._replace(
        roughness=1e-5 * base[0].rolling_radius, hardness=0.02 * base[0].modulus, lubricant=oil
    )
    assert film.masjedi_khonsari_notes(bounded) == []
    assert (
        len(film.masjedi_khonsari_notes(bounded._replace(roughness=1e-4 * base[0].rolling_radius)))
        == 1
    )


def test_extreme_groups_stay_finite_and_slopes_have_their_signs():
    log_load, log_material = np.meshgrid(
        [-700.0, -50.0, 0.0, 50.0, 700.0], [-700.0, -50.0, 0.0, 50.0, 700.0]
    )
    assert np.isfinite(log_moes(math.log(3.0) - log_load, log_load, log_material)).all()
    log_load, log_material = np.meshgrid(
        np.linspace(-14.0, 9.0, 231), np.linspace(-7.0, 4.6, 117), indexing="ij"
    )
    moes = log_moes(math.log(3.0) - log_load, log_load, log_material)
    by_load, by_material = np.diff(moes, axis=0) / 0.1, np.diff(moes, axis=1) / 0.1
    assert by_load.min() >= -1.001 and by_load.max() < -0.02
    assert by_material.min() >= -1e-12 and by_material.max() <= 0.75


def test_range_of_moes_is_where_numerical_solutions_were_compared(base):
    # M = 32 at 100 kN, L = 16.9 at 1 m/s.
    in_range = film.moes_in_range(
        base[0], np.array([1e-3, 3e4, 1e5, 1e3]), np.array([0.4, 0.4, 0.4, 1.0])
    )
    assert in_range.tolist() == [True, True, False, False]


@NUMBERS
def test_film_for_every_load_is_the_heavy_one_where_that_was_fitted(base, number):
    load, speed = np.meshgrid(np.geomspace(1e3, 3e5, 40), np.geomspace(1e-3, 10.0, 40))
    inside = film.masjedi_khonsari_in_range(base[number], load, speed)
    ratio = film.masjedi_khonsari_moes(base[number], load, speed) / film.masjedi_khonsari(
        base[number], load, speed
    )
    assert number == 2 or inside.sum() > 400
    assert np.abs(ratio[inside] - 1.0).max(initial=0.0) < 1e-3


def test_film_rises_with_speed_and_a_stopped_roller_keeps_the_gap_of_its_asperities(base):
    speeds = np.geomspace(1e-6, 10.0, 400)
    for load in (1e-2, 30.0, 2e4, 2e5):
        assert np.diff(film.masjedi_khonsari_moes(base[0], load, speeds)).min() > 0.0
    heights = film.masjedi_khonsari_moes(base[0], 2e4, np.array([1e-6, 1e-8, 1e-10]))
    assert heights == pytest.approx(heights[0], rel=0.01)
    assert 0.1 < heights[0] / 0.3e-6 < 1.0


def test_range_is_that_of_the_formula_that_counts(base):
    in_range = film.masjedi_khonsari_moes_in_range(
        base[0],
        np.array([1e-2, 30.0, 1e3, 2e4, 2e5, 4e5, 2e4, 30.0]),
        np.array([*[RATED_SURFACE_SPEED] * 6, 1e-3, 1.0]),
    )
    # W; U; L.
    assert in_range.tolist() == [True] * 5 + [False] * 3
    assert film.masjedi_khonsari_moes_in_range(base[2], 32.0, RATED_SURFACE_SPEED / 2)


def test_softer_steel_is_inside_the_range(base):
    from macroslip import Lubricant
    from macroslip.contact.interface import interfaces
    from macroslip.contact.registry import film_range_notes

    lubricant = Lubricant.read("vg460-pao")
    notes = film_range_notes("masjedi-khonsari-moes", base)
    assert notes == [
        f"{interface.name}: the hardness group 0.03033 is outside 0.005 to 0.03"
        for interface in base
    ]
    softer = interfaces(Bearing.read("skf-240-600-bc").replace(hardness=6.5e9), lubricant)
    assert film_range_notes("masjedi-khonsari", softer) == film_range_notes("moes", base) == []
