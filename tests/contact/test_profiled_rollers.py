"""Cylindrical rollers that touch along a line: approach, load share, pressure, traction and refusals."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from macroslip import Bearing, BearingLoads, Case, InputError, Laws, Lubricant
from macroslip.contact.interface import highest_load, truncation_load
from macroslip.contact.laws import prepare
from macroslip.contact.line_approach import (
    line_approach,
    line_approaches,
    line_load,
    line_loads,
)
from macroslip.contact.line_rolling import LineContact, line_film, line_traction
from macroslip.contact.strips import PreparedStrips, load_at_pressure, strip_approach, strips_of
from macroslip.contact.traction import chord_stress
from macroslip.mechanics.elastic import approach_under_load, elastic_load
from macroslip.ring.balance import balance, roller_loads
from macroslip.roller.model import BODY, ring_geometry, roller_model

CROWNED = Bearing.read(Path(__file__).parents[2] / "validation" / "data" / "cylindrical-160.yaml")
LENGTH, DIAMETER, COUNT = 0.05, 0.032, 18
OIL = Lubricant.read("vg320-mineral").at(333.15)
PROFILES = ("straight", "logarithmic")
#: Laws without roughness, so that a film is all there is.
FILM = Laws.physical().but(
    film="masjedi-khonsari", asperities="none", starvation=False, rolling="none"
)
SPEED = 8.0


def profiled(profile, **values):
    return CROWNED.replace(roller_crown_radius=None, roller_profile=profile, **values)


def drop(station, profile):
    """P of ISO/TS 16281, in millimetres as printed there: 0.00035 Dw ln 1/(1 − (2x/Lwe)²)."""
    if profile == "straight":
        return 0.0
    return 1e-3 * 0.00035 * 32.0 * math.log(1.0 / (1.0 - (2.0 * 1e3 * station / 50.0) ** 2))


def per_length(each, station, profile):
    """Load per length [N/m] at an approach of one contact, by Palmgren's δ = 3.84e-5 Q^0.9/l^0.8 in N and mm."""
    pressed = 1e3 * max(each - drop(station, profile), 0.0)
    whole = (pressed * 50.0**0.8 / 3.84e-5) ** (1.0 / 0.9)
    return whole / 50e-3


def load_of(approach, profile):
    """Load of a roller between both rings by adaptive quadrature [N]."""
    each = 0.5 * approach
    if each <= 0.0:
        return 0.0
    end = 0.5 * LENGTH
    if profile == "logarithmic":
        end *= math.sqrt(-math.expm1(-each / (0.00035 * DIAMETER)))
    half, _ = quad(lambda station: per_length(each, station, profile), 0.0, end, epsrel=1e-12)
    return 2.0 * half


def numbers(profile):
    model = roller_model(profiled(profile), OIL, 1, tilt=0.0)
    return model.line_stiffness, model.profile_depth


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("approach", [2e-8, 3e-6, 2e-5, 3e-4])
def test_load_of_an_approach_is_that_of_palmgrens_strips_by_quadrature(profile, approach):
    assert line_load(*numbers(profile), approach).load == pytest.approx(
        load_of(approach, profile), rel=1e-8
    )


def test_a_straight_roller_has_palmgrens_law_at_each_raceway():
    for load in (1.0, 5e3, 2e5):
        approach = 2.0 * 1e-3 * 3.84e-5 * load**0.9 / 50.0**0.8
        assert line_load(*numbers("straight"), approach).load == pytest.approx(load, rel=1e-10)
        inner = strips_of(profiled("straight"))[0]
        assert float(strip_approach(inner, load)) == pytest.approx(0.5 * approach, rel=1e-10)


@pytest.mark.parametrize("profile", PROFILES)
def test_work_slope_and_inverse_belong_to_the_load(profile):
    own = numbers(profile)
    approach = 2.6e-5
    work, _ = quad(lambda reached: load_of(reached, profile), 0.0, approach, epsrel=1e-10)
    line = line_load(*own, approach)
    assert line.work == pytest.approx(work, rel=1e-7)
    step = 1e-4 * approach
    slope = (load_of(approach + step, profile) - load_of(approach - step, profile)) / (2.0 * step)
    assert line.slope == pytest.approx(slope, rel=1e-6)
    back = line_approach(*own, math.log(line.load))
    assert back.approach == pytest.approx(approach, rel=1e-7)
    assert back.growth == pytest.approx(line.load / (approach * slope), rel=1e-5)
    loads = line_loads(*own, np.array([-1e-6, 0.0, approach]))
    assert loads[0].tolist() == [0.0, 0.0, line.load]
    approaches = line_approaches(*own, np.array([-1.0, 0.0, line.load]))
    assert approaches.tolist() == [0.0, 0.0, back.approach]


def test_strips_converge_to_the_line():
    """The sum over finite strips, with the middle of each, falls into the integral as they get more."""
    approach = 2e-5
    exact = load_of(approach, "logarithmic")
    errors = []
    for count in (10, 40, 160, 640):
        places = LENGTH * ((np.arange(count) + 0.5) / count - 0.5)
        total = sum(per_length(0.5 * approach, station, "logarithmic") for station in places)
        errors.append(abs(total * LENGTH / count / exact - 1.0))
    assert np.all(np.diff(errors) < 0.0)
    assert errors[0] < 0.03 and errors[-1] < 2e-4


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("force", [3e3, 50e3, 400e3])
def test_load_shares_of_a_row_are_those_of_a_root_search(profile, force):
    bearing = profiled(profile)
    ring = ring_geometry(bearing, roller_model(bearing, OIL, 1, tilt=0.0))
    displacement, left = balance(
        ring, np.zeros(1), np.array([[0.0, -force, 0.0]]), np.zeros((1, 3))
    )
    assert left[0] < 1e-8 * force
    shared = roller_loads(ring, np.zeros(1), displacement)[0]
    below = -np.sin(-0.5 * np.pi + 2.0 * np.pi * np.arange(COUNT) / COUNT)

    def loads(dropped):
        return np.array([load_of(dropped * direction - 5e-5, profile) for direction in below])

    dropped = brentq(lambda depth: loads(depth) @ below - force, 5e-5, 2e-3, xtol=1e-16)
    assert shared == pytest.approx(loads(dropped), rel=1e-6, abs=1e-3)


def test_line_contacts_share_a_load_among_other_rollers_than_crowned_ones():
    """Without play the largest load is 4 F/Z times an integral of cos^(n+1): Sjövall's 4.37 at 3/2, 4.08 at 10/9."""
    for bearing, factor in (
        (CROWNED, _sjoevall(1.5)),
        (profiled("straight"), _sjoevall(10.0 / 9.0)),
    ):
        known = bearing.replace(diametral_clearance=0.0)
        ring = ring_geometry(known, roller_model(known, OIL, 1, tilt=0.0))
        displacement, _ = balance(
            ring, np.zeros(1), np.array([[0.0, -60e3, 0.0]]), np.zeros((1, 3))
        )
        largest = roller_loads(ring, np.zeros(1), displacement).max()
        assert largest == pytest.approx(factor * 60e3 / COUNT, rel=2e-3)


def _sjoevall(exponent):
    integral, _ = quad(
        lambda angle: math.cos(angle) ** (exponent + 1.0), -0.5 * math.pi, 0.5 * math.pi
    )
    return 2.0 * math.pi / integral


def test_pressure_of_a_straight_roller_is_hertz_line_and_a_profile_ends_without_one():
    steel = 210e9 / (1.0 - 0.3**2)
    curvature = 1.0 / 16e-3 + 1.0 / 96.5e-3
    load = 20e3
    straight = strips_of(profiled("straight"))[0]
    assert straight.curvature == pytest.approx(curvature, rel=1e-12)
    expected = math.sqrt(load / LENGTH * steel * curvature / (2.0 * math.pi))
    assert load_at_pressure(straight, expected) == pytest.approx(load, rel=1e-9)
    inner = strips_of(profiled("logarithmic"))[0]
    approach = float(strip_approach(inner, load))
    end = float(inner.reach(approach))
    assert end < 0.5 * LENGTH
    assert per_length(approach, end * (1.0 - 1e-9), "logarithmic") < 1e-6 * load / LENGTH
    # What the ends do not carry the middle does.
    middle = math.sqrt(per_length(approach, 0.0, "logarithmic") * steel * curvature / (2 * math.pi))
    assert load_at_pressure(inner, middle) == pytest.approx(load, rel=1e-4)
    assert 1.02 * expected < middle < 1.3 * expected


def test_a_line_has_no_truncation_and_a_load_up_to_4_gpa():
    bearing = profiled("straight")
    assert truncation_load(bearing, OIL) == math.inf
    most = highest_load(bearing, OIL, Laws.paper())
    assert (
        most == load_at_pressure(strips_of(bearing)[0], 4e9) > 10.0 * truncation_load(CROWNED, OIL)
    )


def _contact(strips):
    return LineContact(strips.curvature, LENGTH, strips.modulus, 3e-7, CROWNED.hardness, OIL)


@pytest.mark.parametrize("name", ["inner", "outer"])
def test_a_straight_roller_has_film_and_traction_of_an_even_line(name):
    laws = prepare(FILM, profiled("straight"), OIL, 1)
    law = getattr(laws, name)
    assert isinstance(law, PreparedStrips)
    line = _contact(law.strips)
    loads = np.array([2e3, 2e4, 1e5])
    slip = np.array([-1e-3, 2e-2, 0.4])
    ring_speed = np.full(3, SPEED)
    film = line_film(line, loads, SPEED - 0.5 * slip)
    assert law.film_thickness(loads, SPEED - 0.5 * slip) == pytest.approx(film, rel=1e-9)
    tractions = law.tractions(loads, ring_speed, slip)
    even = np.sign(slip) * line_traction(line, loads, film, np.abs(slip), FILM)
    assert tractions.pull == pytest.approx(even, rel=1e-3)
    assert np.all(tractions.lag == 0.0) and np.allclose(tractions.skew, 0.0, atol=1e-9 * LENGTH)


@pytest.mark.parametrize(("load", "slip"), [(2e3, 1e-4), (3e4, -2e-4), (3e4, 5e-2)])
def test_traction_of_a_profile_by_quadrature(load, slip):
    law = prepare(FILM, profiled("logarithmic"), OIL, 1).outer
    strips = law.strips
    approach = brentq(
        lambda local: load_of(2.0 * local, "logarithmic") - load, 1e-9, 1e-3, xtol=1e-18
    )
    end = 0.5 * LENGTH * math.sqrt(-math.expm1(-approach / (0.00035 * DIAMETER)))
    line = _contact(strips)
    curvature = 1.0 / 16e-3 - 1.0 / 128.5e-3

    def force(station):
        own = per_length(approach, station, "logarithmic") + 1e-12
        local = slip * (1.0 - drop(station, "logarithmic") / 32e-3)
        local += 0.5 * SPEED * curvature * drop(station, "logarithmic")
        film = float(line_film(line, own * LENGTH, SPEED - 0.5 * slip))
        pressure = math.sqrt(own * curvature * strips.modulus / (2.0 * math.pi))
        width = math.sqrt(8.0 * own / (math.pi * strips.modulus * curvature))
        stress = float(chord_stress(law.fluid, pressure, film, max(abs(local), 1e-30)))
        return 2.0 * width * stress * math.copysign(1.0, local)

    def pulled(low, high):
        return quad(force, low, high, epsrel=1e-5, limit=200)[0]

    turn = _pure_rolling(slip, curvature, end)
    expected = 2.0 * (pulled(0.0, turn) + pulled(turn, end * (1.0 - 1e-9)))
    tractions = law.tractions(np.array([load]), np.array([SPEED]), np.array([slip]))
    assert float(tractions.pull[0]) == pytest.approx(expected, rel=5e-3)


def _pure_rolling(slip, curvature, end):
    """Place at which the profile's slip takes away that of the middle; the end where it does not."""

    def local(station):
        fallen = drop(station, "logarithmic")
        return slip * (1.0 - fallen / 32e-3) + 0.5 * SPEED * curvature * fallen

    if local(0.0) * local(end) >= 0.0:
        return 0.5 * end
    return brentq(local, 0.0, end)


def test_crowned_and_barrel_rollers_have_the_laws_they_had_to_the_last_bit():
    for bearing in (CROWNED, Bearing.read("skf-240-600-bc")):
        model = roller_model(bearing, OIL, 1, tilt=0.0)
        assert model.line_stiffness == 0.0
        body = np.zeros(1, BODY).view(np.recarray)[0]
        body["stiffness"] = model.stiffness
        body["compliance"] = model.stiffness ** (-2.0 / 3.0)
        for approach in (1e-7, 3.3e-5):
            assert elastic_load(body, approach) == model.stiffness * approach * math.sqrt(approach)
        assert approach_under_load(body, 7e3) == body["compliance"] * 7e3 ** (2.0 / 3.0)
        ring = ring_geometry(bearing, model)
        displacement = np.array([[1e-5, -2e-4, 0.0]])
        radial = (
            displacement[0, 0] * ring.cosine + displacement[0, 1] * ring.sine - ring.radial_play
        )
        approach = np.maximum(radial * ring.cos_contact_angle, 0.0)
        expected = model.stiffness * approach * np.sqrt(approach)
        assert roller_loads(ring, np.zeros(1), displacement)[0] == pytest.approx(
            expected, rel=1e-12
        )


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"roller_profile": "logarithmic"}, "a roller has one or the other"),
        ({"roller_crown_radius": None, "roller_profile": "round"}, "straight, logarithmic"),
        (
            {"roller_crown_radius": None, "roller_profile": "logarithmic", "roller_length": 0.081},
            "up to 2.5 times roller_diameter, 0.08 m",
        ),
        (
            {"roller_crown_radius": None, "roller_profile": "straight", "youngs_modulus": 310e9},
            "known of steel on steel",
        ),
        (
            {"roller_crown_radius": None, "roller_profile": "straight", "osculation_inner": 0.98},
            "osculation_inner is 0.98, and roller_profile tells",
        ),
    ],
)
def test_rollers_that_cannot_be_are_refused(values, said):
    with pytest.raises(InputError, match=said):
        CROWNED.replace(**values)


def test_a_file_of_a_profile_is_read_and_written():
    bearing = profiled("logarithmic")
    assert bearing.kind == "cylindrical" and bearing.touches_along_line and bearing.rows == 1
    assert Bearing.from_dict(bearing.as_dict()) == bearing
    assert Bearing.from_dict(bearing.as_dict()).as_dict()["roller_profile"] == "logarithmic"


def test_kellstroems_law_is_refused_along_a_line():
    loads = BearingLoads.constant([0.0, -8e3, 0.0], 10.0, 1.0)
    with pytest.raises(InputError, match="a cylindrical roller with a straight profile touches"):
        Case(
            bearing=profiled("straight"),
            loads=loads,
            laws=Laws.physical().but(traction="kellstroem"),
        )
